/// How far the boundary of a round sample leaves the affine ghost of what it was (P fig. 3.4).
///
/// The places of all grains now are pulled back by the affine motion that fits their displacements since the begin of
/// loading best (fluctuations.c). Around the centre, sectors two mean diameters wide are compared: the distance of the
/// outermost grain in each, now and at the begin. The roughness is the root mean square of their differences, in mean
/// diameters: zero for any affine motion, and the grains that bound the sample may change. Cost: O(grains).
#include "measure/measure.h"

#include <math.h>

#define SECTOR_DIAMETERS 2.0

typedef struct pulled {
    double *x0, *y0, *x1, *y1, *fx, *fy; ///< at the begin and pulled back from now, from the centre; non-affine parts
    size_t count;
} pulled;

static void centre(double *value, size_t count)
{
    double mean = 0;
    for (size_t k = 0; k < count; k++) mean += value[k] / (double)count;
    for (size_t k = 0; k < count; k++) value[k] -= mean;
}

/// x1, y1 become (1 + G)^-1 (x - centre).
static void pull_back(pulled *p, const double gradient[4])
{
    double a = 1 + gradient[0], b = gradient[1], c = gradient[2], d = 1 + gradient[3], determinant = a * d - b * c;
    for (size_t k = 0; k < p->count; k++) {
        double x = p->x1[k], y = p->y1[k];
        p->x1[k] = (d * x - b * y) / determinant;
        p->y1[k] = (a * y - c * x) / determinant;
    }
}

static void fill(const scree_state *state, pulled *p)
{
    size_t id = 0, k = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) {
        if (!scree_body_is_grain(state, row)) continue;
        p->x0[k] = state->reference[row][0];
        p->y0[k] = state->reference[row][1];
        p->x1[k] = state->row[row].x;
        p->y1[k++] = state->row[row].y;
    }
    centre(p->x0, p->count);
    centre(p->y0, p->count);
    centre(p->x1, p->count);
    centre(p->y1, p->count);
}

/// Distance of the outermost point of each sector.
static void find_outermost(const double *x, const double *y, size_t count, double *reach, size_t sectors)
{
    for (size_t s = 0; s < sectors; s++) reach[s] = NAN;
    for (size_t k = 0; k < count; k++) {
        double turn = atan2(y[k], x[k]) / (2 * M_PI) + 0.5;
        size_t s = (size_t)(turn * (double)sectors) % sectors;
        reach[s] = fmax(reach[s], hypot(x[k], y[k]));
    }
}

scree_status scree_boundary_roughness(const scree_model *model, const scree_state *state, double *roughness,
                                      scree_error *error)
{
    *roughness = NAN;
    if (state->dimension != 2) return SCREE_OK;
    size_t n = scree_grain_count(state);
    double *room = NULL, *reach = NULL, gradient[4], square = 0, sum = 0, used = 0;
    scree_status status = scree_allocate(&room, 6 * n, sizeof *room, error);
    if (status) return status;
    pulled p = {room, room + n, room + 2 * n, room + 3 * n, room + 4 * n, room + 5 * n, n};
    fill(state, &p);
    const double *const from[] = {p.x0, p.y0}, *const to[] = {p.x1, p.y1};
    double *const fluctuation[] = {p.fx, p.fy};
    (void)scree_fluctuations(2, from, to, n, fluctuation, gradient);
    pull_back(&p, gradient);
    // A disc filled evenly has <r^2> = R^2 / 2.
    for (size_t k = 0; k < n; k++) square += (p.x0[k] * p.x0[k] + p.y0[k] * p.y0[k]) / (double)n;
    double diameter = 2 * model->mean_radius, around = 2 * M_PI * sqrt(2 * square);
    size_t sectors = (size_t)fmax(1, around / (SECTOR_DIAMETERS * diameter));
    status = scree_allocate(&reach, 2 * sectors, sizeof *reach, error);
    if (!status) {
        find_outermost(p.x0, p.y0, n, reach, sectors);
        find_outermost(p.x1, p.y1, n, reach + sectors, sectors);
        for (size_t s = 0; s < sectors; s++) {
            double change = reach[sectors + s] - reach[s];
            if (isnan(change)) continue;
            sum += change * change;
            used++;
        }
        *roughness = sqrt(sum / used) / diameter;
    }
    scree_release(&reach);
    scree_release(&room);
    return status;
}
