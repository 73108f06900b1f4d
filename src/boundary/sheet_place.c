/// Places the sheet of a membrane around a sample of spheres.
///
/// Outline. Seen from above, the support points of the grains, each enlarged by the radius of the sheet, in DIRECTIONS
/// directions: a convex polygon that no grain reaches. The bodies of a ring stand on it at equal distances of at most
/// two radii, and the rings at equal heights of at most sqrt(3) radii, the first and last tangent to the plates: a
/// regular triangular net of spheres that touch or overlap.
///
/// Wrapping. Each body is then pushed in along the normal of the outline until it touches a grain, but nowhere deeper
/// than its neighbours by more than SLOPE times two radii: over a gap between grains the sheet is a bridge, until the
/// pressure pulls it on. Nothing is indented, since less deep is always free. The unstressed lengths of the springs are
/// the distances that this gives. A grain must not be able to slip through. Cost: O(grains x bodies), once.
#include "boundary/sheet.h"
#include "state/body.h"

#include "boundary/membrane.h"
#include "state/plates.h"

#include <math.h>

enum { DIRECTIONS = 360 };
#define SLOPE 0.5

/// A point of the outline: where it is and where out is.
typedef struct station {
    double position[2], normal[2];
} station;

/// The support points; returns the length around.
static double find_outline(const scree_state *state, double radius, double (*corner)[2])
{
    double length = 0;
    for (int d = 0; d < DIRECTIONS; d++) {
        double normal[2] = {cos(2 * M_PI * d / DIRECTIONS), sin(2 * M_PI * d / DIRECTIONS)}, farthest = -INFINITY;
        size_t id = 0; // of two that reach as far, the one with the lower id
        for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) {
            if (!scree_body_is_grain(state, row)) continue;
            const scree_row *grain = &state->row[row];
            double reach = grain->radius + radius, along = grain->x * normal[0] + grain->y * normal[1] + reach;
            if (!(along > farthest)) continue;
            farthest = along;
            corner[d][0] = grain->x + reach * normal[0];
            corner[d][1] = grain->y + reach * normal[1];
        }
        if (d > 0) length += hypot(corner[d][0] - corner[d - 1][0], corner[d][1] - corner[d - 1][1]);
    }
    return length + hypot(corner[0][0] - corner[DIRECTIONS - 1][0], corner[0][1] - corner[DIRECTIONS - 1][1]);
}

/// The point at the distance `at` along the outline, from its first corner.
static station find_station(double (*corner)[2], double at)
{
    for (int d = 0;; d++) {
        const double *from = corner[d], *to = corner[(d + 1) % DIRECTIONS];
        double dx = to[0] - from[0], dy = to[1] - from[1], length = hypot(dx, dy);
        if (at > length && d + 1 < DIRECTIONS) {
            at -= length;
            continue;
        }
        return (station){{from[0] + dx * at / length, from[1] + dy * at / length}, {dy / length, -dx / length}};
    }
}

/// How far a body at this height can be pushed in from the outline until it touches a grain; `deepest` at most.
static double free_depth(const scree_state *state, double radius, const station *from, double height, double deepest)
{
    double depth = deepest;
    for (size_t row = 0; row < state->count; row++) {
        if (!scree_body_is_grain(state, row)) continue;
        const scree_row *grain = &state->row[row];
        double dx = grain->x - from->position[0], dy = grain->y - from->position[1], dz = grain->z - height;
        double inwards = -(dx * from->normal[0] + dy * from->normal[1]), reach = grain->radius + radius;
        double beside = dx * dx + dy * dy + dz * dz - inwards * inwards;
        if (beside < reach * reach) depth = fmin(depth, inwards - sqrt(reach * reach - beside));
    }
    return depth;
}

/// Takes from every depth what is more than `most` deeper than a neighbour.
static void level_out(double *depth, size_t around, size_t count, double most)
{
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t k = 0; k < count; k++)
            for (int s = 0; s < SCREE_SHEET_SPRINGS; s++) {
                size_t other = scree_sheet_neighbour(around, count, k, s);
                if (other == SIZE_MAX || fabs(depth[k] - depth[other]) <= most * (1 + 1e-12)) continue;
                size_t deeper = depth[k] > depth[other] ? k : other;
                depth[deeper] = fmin(depth[k], depth[other]) + most;
                changed = true;
            }
    }
}

static void set_rest_lengths(scree_state *state)
{
    scree_membrane *membrane = scree_membrane_of(state);
    for (size_t k = 0; k < membrane->count; k++)
        for (int s = 0; s < SCREE_SHEET_SPRINGS; s++) {
            size_t other = scree_sheet_neighbour(membrane->around, membrane->count, k, s);
            if (other == SIZE_MAX) continue;
            const double *a = state->reference[scree_membrane_row(state, k)];
            const double *b = state->reference[scree_membrane_row(state, other)];
            scree_vector edge = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
            membrane->rest[k][s] = scree_length(edge);
        }
}

/// The places of all bodies, on the outline less their depths.
static void place_bodies(const scree_model *model, scree_state *state, double (*corner)[2], double length,
                         double *depth)
{
    scree_membrane *membrane = scree_membrane_of(state);
    size_t around = membrane->around, count = membrane->count, rings = count / around;
    double radius = membrane->radius, low = scree_plate_height(state, SCREE_WALL_BOTTOM) + radius;
    double rise = (scree_plate_height(state, SCREE_WALL_TOP) - radius - low) / (double)(rings - 1);
    // Half way to the middle of a round sample.
    double deepest = length / (4 * M_PI);
    for (int pass = 0; pass < 2; pass++) {
        for (size_t k = 0; k < count; k++) {
            double position = (double)(k % around) + (k / around % 2 == 1 ? 0.5 : 0);
            double height = low + rise * (double)(k / around);
            station from = find_station(corner, length * position / (double)around);
            if (pass == 0) {
                depth[k] = free_depth(state, radius, &from, height, deepest);
                continue;
            }
            size_t row = scree_membrane_row(state, k);
            state->row[row] =
                (scree_row){.x = from.position[0] - depth[k] * from.normal[0],
                            .y = from.position[1] - depth[k] * from.normal[1],
                            .z = height,
                            .radius = radius,
                            .mass = scree_model_mass(model, scree_membrane_numbers_of(model)->material, radius)};
            state->turn[row] = (scree_turn_row){.material = scree_membrane_numbers_of(model)->material};
            state->species[row] = SCREE_NO_SPECIES;
            scree_body_refer(state, row);
        }
        if (pass == 0) level_out(depth, around, count, 2 * SLOPE * radius);
    }
}

scree_status scree_sheet_place(const scree_model *model, scree_state *state, scree_error *error)
{
    double radius = scree_membrane_numbers_of(model)->radius, corner[DIRECTIONS][2], *depth = NULL;
    double height = scree_plate_height(state, SCREE_WALL_TOP) - scree_plate_height(state, SCREE_WALL_BOTTOM);
    double length = find_outline(state, radius, corner);
    size_t around = (size_t)ceil(length / (2 * radius)), rings = (size_t)ceil((height / radius - 2) / sqrt(3)) + 1;
    scree_status status = scree_allocate(&depth, around * rings, sizeof *depth, error);
    if (!status) status = scree_membrane_make_room(state, around * rings, error);
    if (!status) {
        scree_membrane_of(state)->radius = radius;
        scree_membrane_of(state)->around = around;
        place_bodies(model, state, corner, length, depth);
        set_rest_lengths(state);
        double hole = scree_sheet_hole(state);
        if (!(hole < model->radius_min))
            status = scree_error_set(error, SCREE_ERROR_GUARD,
                                     "a sphere of radius %.3g m can slip through a membrane of spheres of radius %.3g "
                                     "m around this sample, and the smallest has %.3g m: give another "
                                     "boundary.membrane_radius",
                                     hole, radius, model->radius_min);
    }
    scree_release(&depth);
    return status;
}
