/// Pressure on a membrane, and the volume that it encloses.
///
/// 2D. Every segment between two centres carries p t rot(b - a) along the inward normal of the deformed chain, shared
/// equally; the gap between an end and its plate is loaded too, all of it on the end. The integers telescope as in
/// pressure.c, so the two sides press against each other with equal forces p t (distance of the plates).
///
/// 3D. Every triangle gives each of its bodies a third of -p A; the upright walls between the rim and its plate are
/// loaded too (pressed_facet.h). So the horizontal forces on the tube add up to zero, as integers, and the vertical
/// ones to p times the difference of the areas inside the two rims, which the plates have to bear.
///
/// Volume. Plates have no horizontal normal: with the horizontal divergence of x (2D) or (x, y) / 2 (3D) the volume is
/// the integral over the sides alone. Hence the forces are -p dV / dx of the bodies, those along the axis of the rims
/// excepted, which the plates prescribe. Cost: O(bodies).
#include "boundary/membrane.h"
#include "state/body.h"

#include "base/fixed.h"
#include "base/wrapping.h"
#include "boundary/pressed_facet.h"
#include "boundary/sheet.h"
#include "state/plates.h"

#include <math.h>
#include <string.h>

static void add_press(scree_state *state, size_t k, const int64_t force[3])
{
    scree_membrane_add(state, k, force, scree_membrane_of(state)->press);
}

// ---- 2D ----------------------------------------------------------------------------------------------------------

/// Point j of the outline of bodies [first, last]: the foot of the first on its plate, the bodies, the foot of the
/// last.
static void side_point(const scree_state *state, size_t first, size_t last, size_t j, double position[2])
{
    size_t body = j == 0 ? first : j > last - first + 1 ? last : first + j - 1;
    bool foot = j == 0 || j > last - first + 1;
    scree_vector centre;
    scree_membrane_position(state, body, centre);
    position[0] = centre[0];
    position[1] = foot ? scree_plate_height(state, scree_membrane_plate(state, body)) : centre[1];
}

/// Pressure on one side: bodies [first, last], the sample on the left.
static void press_side(scree_state *state, size_t first, size_t last, double scale)
{
    double origin[2], position[2];
    side_point(state, 0, 1, 1, origin);
    int64_t before[2] = {0}, force[3] = {0};
    for (size_t j = 0; j <= last - first + 2; j++) {
        int64_t now[2];
        side_point(state, first, last, j, position);
        for (int i = 0; i < 2; i++) now[i] = scree_fixed_round((position[i] - origin[i]) * scale);
        force[0] = -(now[1] - before[1]);
        force[1] = now[0] - before[0];
        memcpy(before, now, sizeof before);
        if (j == 0) continue;
        add_press(state, j > 1 ? first + j - 2 : first, force);
        add_press(state, first + j - 1 > last ? last : first + j - 1, force);
    }
}

/// Area between the y axis and one side.
static double side_area(const scree_state *state, size_t first, size_t last)
{
    double area = 0, from[2], to[2];
    side_point(state, first, last, 0, from);
    for (size_t j = 1; j <= last - first + 2; j++) {
        side_point(state, first, last, j, to);
        area += 0.5 * (from[0] + to[0]) * (to[1] - from[1]);
        memcpy(from, to, sizeof from);
    }
    return area;
}

// ---- 3D ----------------------------------------------------------------------------------------------------------

/// Centre of body k relative to `origin`.
static void centre_of(const scree_state *state, size_t k, const scree_vector origin, scree_vector position)
{
    scree_membrane_position(state, k, position);
    for (int i = 0; i < 3; i++) position[i] -= origin[i];
}

/// Edge j of a rim, in the sense of a cap that closes the tube; what is between it and the plate is loaded.
static void rim_edge(const scree_state *state, int plate, size_t j, size_t end[2])
{
    size_t around = scree_membrane_of(state)->around,
           first = plate == SCREE_WALL_TOP ? scree_membrane_of(state)->count - around : 0;
    size_t next = first + (j + 1) % around;
    end[0] = plate == SCREE_WALL_TOP ? first + j : next;
    end[1] = plate == SCREE_WALL_TOP ? next : first + j;
}

static void press_sheet(scree_state *state, double scale)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    scree_vector origin, corner[3];
    int64_t force[2][3];
    scree_membrane_position(state, 0, origin);
    for (size_t t = 0; t < scree_sheet_triangle_count(membrane->around, membrane->count); t++) {
        size_t body[3];
        scree_sheet_triangle(membrane->around, membrane->count, t, body);
        for (int c = 0; c < 3; c++) centre_of(state, body[c], origin, corner[c]);
        scree_triangle_press(scale, corner, force[0]);
        for (int c = 0; c < 3; c++) add_press(state, body[c], force[0]);
    }
    for (int plate = SCREE_WALL_BOTTOM; plate <= SCREE_WALL_TOP; plate++) {
        double height = scree_plate_height(state, plate) - origin[2];
        for (size_t j = 0; j < membrane->around; j++) {
            size_t end[2];
            rim_edge(state, plate, j, end);
            for (int c = 0; c < 2; c++) centre_of(state, end[c], origin, corner[c]);
            scree_wall_press(scale, height, corner[0], corner[1], end[0] < end[1], force[0], force[1]);
            for (int c = 0; c < 2; c++) add_press(state, end[c], force[c]);
        }
    }
}

/// Horizontal virial of the triangles: integral of (x n_x + y n_y) dS / 2.
static double triangles_volume(const scree_state *state, const scree_vector origin)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    double volume = 0;
    scree_vector p[3];
    for (size_t t = 0; t < scree_sheet_triangle_count(membrane->around, membrane->count); t++) {
        size_t body[3];
        scree_sheet_triangle(membrane->around, membrane->count, t, body);
        for (int c = 0; c < 3; c++) centre_of(state, body[c], origin, p[c]);
        for (int i = 0; i < 2; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            double area = 0.5 * ((p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]));
            volume += 0.5 * area * (p[0][i] + p[1][i] + p[2][i]) / 3;
        }
    }
    return volume;
}

/// The same of the walls between a rim and its plate.
static double rim_volume(const scree_state *state, int plate, const scree_vector origin)
{
    double volume = 0, height = scree_plate_height(state, plate) - origin[2];
    for (size_t j = 0; j < scree_membrane_of(state)->around; j++) {
        size_t end[2];
        scree_vector a, b;
        rim_edge(state, plate, j, end);
        centre_of(state, end[0], origin, a);
        centre_of(state, end[1], origin, b);
        double at_a = (2 * (a[2] - height) + (b[2] - height)) / 6, at_b = ((a[2] - height) + 2 * (b[2] - height)) / 6;
        volume += 0.5 * ((a[1] - b[1]) * (at_a * a[0] + at_b * b[0]) + (b[0] - a[0]) * (at_a * a[1] + at_b * b[1]));
    }
    return volume;
}

// ---- both --------------------------------------------------------------------------------------------------------

void scree_membrane_press(const scree_model *model, scree_state *state, double pressure)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    if (state->dimension == 3) {
        press_sheet(state, pressure / 6 / state->force_quantum);
        return;
    }
    double scale = 0.5 * pressure * model->thickness / state->force_quantum;
    press_side(state, 0, membrane->right - 1, scale);
    press_side(state, membrane->right, membrane->count - 1, scale);
}

double scree_membrane_volume(const scree_model *model, const scree_state *state)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    if (state->dimension == 2)
        return model->thickness *
               (side_area(state, 0, membrane->right - 1) + side_area(state, membrane->right, membrane->count - 1));
    scree_vector origin;
    scree_membrane_position(state, 0, origin);
    return triangles_volume(state, origin) + rim_volume(state, SCREE_WALL_BOTTOM, origin) +
           rim_volume(state, SCREE_WALL_TOP, origin);
}
