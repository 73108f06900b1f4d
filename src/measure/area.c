/// Area of the sample and of its Delaunay boundary (shoelace formula). Cost: O(length of the loop).
#include "measure/measure.h"

#include "measure/outline.h"
#include "state/cell.h"

double scree_loop_area(const scree_state *state)
{
    double area = 0, origin[2] = {0}, a[2], b[2];
    if (state->loop.count > 0) scree_loop_position(state, 0, origin);
    for (size_t k = 0; k < state->loop.count; k++) {
        scree_loop_position(state, k, a);
        scree_loop_position(state, k + 1 < state->loop.count ? k + 1 : 0, b);
        area += ((a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0])) / 2;
    }
    return area;
}

double scree_sample_area(const scree_state *state)
{
    if (state->cell.periodic) return scree_cell_extent(state);
    const scree_wall *wall = state->wall;
    bool closed = true;
    for (int w = 0; w <= SCREE_WALL_RIGHT; w++) closed = closed && wall[w].active;
    double centre[2];
    if (state->loop.count > 0 && !closed) return scree_outline_area(state, centre);
    // Opposite walls have opposite normals: their positions add up to minus their distance.
    double height = -(wall[SCREE_WALL_BOTTOM].position + wall[SCREE_WALL_TOP].position);
    double width = -(wall[SCREE_WALL_LEFT].position + wall[SCREE_WALL_RIGHT].position);
    return width * height;
}
