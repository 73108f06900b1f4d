/// Area and volume of the sample and of its Delaunay boundary (shoelace formula; hull.h). Cost: O(length of the loop),
/// O(triangles of the hull). Servos, stages and strains read them: sums in integers.
#include "measure/measure.h"
#include "state/plates.h"

#include "base/integer_sum.h"
#include "measure/hull.h"
#include "measure/outline.h"
#include "state/periodic.h"

double scree_loop_area(const scree_state *state)
{
    scree_integer_sum area = {0};
    double origin[2] = {0}, a[2], b[2];
    if (scree_loop_of(state)->count > 0) scree_loop_position(state, 0, origin);
    while (scree_integer_sum_next(&area, 1))
        for (size_t k = 0; k < scree_loop_of(state)->count; k++) {
            scree_loop_position(state, k, a);
            scree_loop_position(state, scree_loop_next(scree_loop_of(state), k), b);
            scree_integer_sum_add(
                &area, ((a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0])) / 2);
        }
    return scree_integer_sum_total(&area);
}

/// Distance of two opposite walls: their normals are opposite, so their positions add up to minus that.
static double distance(const scree_wall *wall, int one, int other)
{
    return -(wall[one].position + wall[other].position);
}

double scree_sample_area(const scree_state *state)
{
    if (scree_cell(state)->directions) return scree_periodic_extent(state);
    const scree_wall *wall = scree_plates(state);
    bool closed = true;
    for (int w = 0; w <= SCREE_WALL_RIGHT; w++) closed = closed && wall[w].active;
    double centre[2];
    if (scree_loop_of(state)->count > 0 && !closed) return scree_outline_area(state, centre);
    return distance(wall, SCREE_WALL_LEFT, SCREE_WALL_RIGHT) * distance(wall, SCREE_WALL_BOTTOM, SCREE_WALL_TOP);
}

double scree_sample_volume(const scree_model *model, const scree_state *state)
{
    const scree_wall *wall = scree_plates(state);
    if (state->dimension == 2) return scree_sample_area(state) * model->thickness;
    if (scree_cell(state)->directions) return scree_periodic_extent(state);
    bool closed = true;
    for (int w = 0; w < SCREE_WALL_COUNT; w++) closed = closed && wall[w].active;
    scree_vector centre;
    if (scree_hull_of(state)->node_count > 0 && !closed) return scree_hull_sample_volume(state, centre);
    return distance(wall, SCREE_WALL_BOTTOM, SCREE_WALL_TOP) * distance(wall, SCREE_WALL_LEFT, SCREE_WALL_RIGHT) *
           distance(wall, SCREE_WALL_FRONT, SCREE_WALL_BACK);
}
