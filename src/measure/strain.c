/// Strain from the motion of a closed loop or hull (Bagi 1996; P 3.1-3.3): see polygon.h and polyhedron.h for the
/// formula and its exactness.
/// Accumulation: each increment is taken on its own mid configuration, so the sum is the logarithmic strain of the
/// region to third order in the increments.
///
/// The region is another one after each re-detection of the boundary: bodies that have come near its edge are taken in,
/// cells that have opened are left out. That change of what is enclosed happens at fixed positions, is no strain of any
/// region, and is in no increment. So the trace is the logarithm of the volume ratio only as long as the boundary
/// consists of the same bodies; in general
///     log V(t) / V(0) = trace + redetected,    redetected = sum over re-detections of log (V after / V before).
/// Where the surface is free to open (minimal conditions) the second term can be many times the first: a grain that has
/// come loose spans a bay with the rest (boundary_loop.c cannot cut where the loop would be pinched), the pressure
/// closes the bay, which is compression of the region, and the next boundary spans another. The sum of rates of a
/// boundary that is found again and again (P 3.1) then shows compression that the solid fraction does not have
/// (docs/theory.md). Strains end stages: the sums are in integers. Cost: O(length of the loop), O(triangles of the
/// hull).
#include "measure/measure.h"

#include "measure/hull.h"
#include "measure/outline.h"
#include "measure/polygon.h"
#include "measure/polyhedron.h"
#include "state/periodic.h"

#include <math.h>
#include <string.h>

void scree_loop_gradient(const double *x, const double *y, const double *ux, const double *uy, size_t count,
                         double gradient[4])
{
    scree_polygon_sum sum = {0};
    while (scree_polygon_next(&sum))
        for (size_t k = 0; k < count; k++) {
            size_t next = k + 1 < count ? k + 1 : 0;
            // Relative to the first vertex, so that the area loses no digits far from the origin.
            double a[2] = {x[k] - x[0], y[k] - y[0]}, b[2] = {x[next] - x[0], y[next] - y[0]};
            double ua[2] = {ux[k] - ux[0], uy[k] - uy[0]}, ub[2] = {ux[next] - ux[0], uy[next] - uy[0]};
            scree_polygon_add_edge(&sum, a, ua, b, ub);
        }
    scree_polygon_finish(&sum, gradient);
}

/// Increment of the loop since its update, 2 x 2.
static void loop_increment(const scree_state *state, double increment[4])
{
    const scree_loop *loop = scree_loop_of(state);
    scree_polygon_sum sum = {0};
    double first[2] = {0}, position[2], a[2] = {0}, ua[2] = {0};
    if (loop->count > 0) scree_loop_position(state, 0, first);
    // Behind the last edge a and ua are zero again.
    while (scree_polygon_next(&sum))
        for (size_t k = 0; k < loop->count; k++) {
            size_t next = scree_loop_next(loop, k);
            scree_loop_position(state, next, position);
            double b[2] = {loop->x[next] - loop->x[0], loop->y[next] - loop->y[0]};
            double ub[2] = {position[0] - first[0] - b[0], position[1] - first[1] - b[1]};
            scree_polygon_add_edge(&sum, a, ua, b, ub);
            for (int i = 0; i < 2; i++) {
                a[i] = b[i];
                ua[i] = ub[i];
            }
        }
    scree_polygon_finish(&sum, increment);
}

/// Increment of the hull since its update. Places are relative to the first node, which keeps the digits of the volume,
/// and so are displacements: a common part of them adds up to nothing.
static void hull_increment(const scree_state *state, double increment[9])
{
    const scree_hull *hull = scree_hull_of(state);
    scree_polyhedron_sum sum = {0};
    scree_vector first = {0};
    if (hull->node_count > 0) scree_hull_position(state, 0, first);
    while (scree_polyhedron_next(&sum))
        for (size_t t = 0; t < hull->triangle_count; t++) {
            scree_vector x[3], u[3];
            scree_hull_corners(state, t, first, u);
            for (int c = 0; c < 3; c++)
                for (int k = 0; k < 3; k++) {
                    x[c][k] = hull->position[hull->triangle[t][c]][k] - hull->position[0][k];
                    u[c][k] -= x[c][k];
                }
            scree_polyhedron_add(&sum, x, u);
        }
    scree_polyhedron_finish(&sum, increment);
}

/// Area or volume inside the boundary; 0 without one.
static double enclosed(const scree_state *state)
{
    return state->dimension == 3 ? scree_hull_volume(state) : scree_loop_area(state);
}

double scree_strain_close(scree_state *state)
{
    double closed[9];
    scree_strain_measure(state, closed);
    memcpy(scree_strain_of(state)->gradient, closed, sizeof closed);
    return enclosed(state);
}

void scree_strain_redetected(scree_state *state, double before)
{
    double after = enclosed(state);
    if (before > 0 && after > 0) scree_strain_of(state)->redetected += log(after / before);
}

double scree_enclosed_logarithm(const scree_state *state)
{
    double volume = enclosed(state);
    return volume > 0 ? log(volume) : NAN;
}

void scree_strain_measure(const scree_state *state, double gradient[9])
{
    if (scree_periodic_is_whole(state)) {
        memcpy(gradient, scree_cell(state)->strain, sizeof scree_cell(state)->strain);
        return;
    }
    for (int i = 0; i < 9; i++) gradient[i] = scree_strain_of(state)->gradient[i];
    if (state->dimension == 3) {
        double increment[9];
        hull_increment(state, increment);
        for (int i = 0; i < 9; i++) gradient[i] += increment[i];
        return;
    }
    double increment[4];
    loop_increment(state, increment);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) gradient[3 * i + j] += increment[2 * i + j];
}
