/// Distortion of the corners of a sample under minimal kinematic conditions (P fig. 3.13): corners that deform more
/// than the rest lose their shape.
///
/// The displacements since the begin of loading are compared with the affine field that fits all grains best
/// (fluctuations.c). A corner is the grains that were within REACH mean diameters of a corner of the box around all
/// centres; its distortion is the length of the mean of their non-affine displacements. The largest of the four and
/// their root mean square over the width of that box are given: samples of different sizes that deform alike have the
/// same numbers, whatever their number of grains. The largest of four scatters more, and is larger, the more they
/// scatter. `rolling` is the mean of how far the grains of the corners have turned since the begin of loading over that
/// of all grains. Cost: O(grains).
#include "measure/measure.h"

#include <math.h>

#define REACH 4.0

/// Columns of one allocation: places at the begin and now, non-affine displacements.
typedef struct columns {
    double *x0, *y0, *x1, *y1, *fx, *fy;
    double *turn; ///< rad, size of the rotation since the begin
    size_t count;
} columns;

static void fill(const scree_state *state, columns *c)
{
    size_t id = 0, k = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) {
        if (!scree_body_is_grain(state, row)) continue;
        c->x0[k] = state->reference[row][0];
        c->y0[k] = state->reference[row][1];
        c->x1[k] = state->row[row].x;
        c->y1[k] = state->row[row].y;
        c->turn[k++] = fabs(state->angle[row]);
    }
}

static void find_range(const double *values, size_t count, double range[2])
{
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (size_t k = 0; k < count; k++) {
        range[0] = fmin(range[0], values[k]);
        range[1] = fmax(range[1], values[k]);
    }
}

/// Length of the mean non-affine displacement around one corner; 0 when no grain is near.
static double corner_motion(const columns *c, double x, double y, double reach)
{
    double sum_x = 0, sum_y = 0;
    size_t near = 0;
    for (size_t k = 0; k < c->count; k++) {
        double dx = c->x0[k] - x, dy = c->y0[k] - y;
        if (dx * dx + dy * dy > reach * reach) continue;
        sum_x += c->fx[k];
        sum_y += c->fy[k];
        near++;
    }
    return near > 0 ? hypot(sum_x, sum_y) / (double)near : 0;
}

/// Mean rotation of the grains near the corners over that of all.
static double rolling_of(const columns *c, const double x[2], const double y[2], double reach)
{
    double all = 0, sum = 0;
    size_t near = 0;
    for (size_t k = 0; k < c->count; k++) {
        double dx = fmin(fabs(c->x0[k] - x[0]), fabs(c->x0[k] - x[1]));
        double dy = fmin(fabs(c->y0[k] - y[0]), fabs(c->y0[k] - y[1]));
        all += c->turn[k];
        if (dx * dx + dy * dy > reach * reach) continue;
        sum += c->turn[k];
        near++;
    }
    return near > 0 && all > 0 ? sum / (double)near / (all / (double)c->count) : NAN;
}

scree_status scree_corner_distortion(const scree_model *model, const scree_state *state,
                                     scree_corner_motion *distortion, scree_error *error)
{
    *distortion = (scree_corner_motion){NAN, NAN, NAN};
    if (state->dimension != 2) return SCREE_OK;
    size_t n = scree_grain_count(state);
    double *room = NULL, gradient[4], x[2], y[2], largest = 0, squares = 0;
    scree_status status = scree_allocate(&room, 7 * n, sizeof *room, error);
    if (status) return status;
    columns c = {room, room + n, room + 2 * n, room + 3 * n, room + 4 * n, room + 5 * n, room + 6 * n, n};
    fill(state, &c);
    const double *const from[] = {c.x0, c.y0}, *const to[] = {c.x1, c.y1};
    double *const fluctuation[] = {c.fx, c.fy};
    (void)scree_fluctuations(2, from, to, n, fluctuation, gradient);
    find_range(c.x0, n, x);
    find_range(c.y0, n, y);
    for (int k = 0; k < 4; k++) {
        double motion = corner_motion(&c, x[k % 2], y[k / 2], REACH * 2 * model->mean_radius);
        largest = fmax(largest, motion);
        squares += motion * motion;
    }
    *distortion = (scree_corner_motion){largest / (x[1] - x[0]), sqrt(squares / 4) / (x[1] - x[0]),
                                        state->form ? NAN : rolling_of(&c, x, y, REACH * 2 * model->mean_radius)};
    scree_release(&room);
    return SCREE_OK;
}
