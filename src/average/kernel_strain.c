/// Moving least squares of displacements.
#include "average/kernel_strain.h"

#include "average/tensor.h"

#include <math.h>

/// Sums over the grains near a point, places relative to it.
typedef struct sums {
    double weight, place[3], moved[3], squares[9], products[9];
    size_t grains;
} sums;

/// First and last point along an axis that a grain reaches; false: none.
static bool find_range(const scree_average_points *points, double width, double x, int axis, size_t *from, size_t *to)
{
    const double first = ceil((x - width - points->first[axis]) / points->gap[axis]);
    const double last = floor((x + width - points->first[axis]) / points->gap[axis]);
    const double most = (double)points->number[axis] - 1;
    if (!(first <= most && last >= 0)) return false;
    *from = (size_t)fmax(first, 0);
    *to = (size_t)fmin(last, most);
    return true;
}

static void add(const scree_average_sample *sample, const scree_average_grain *grain, double width,
                const double point[3], sums *s)
{
    double away[3], place[3];
    scree_subtract(point, grain->position, away);
    if (sample->dimension == 2) away[2] = 0;
    const double weight = grain->mass * scree_average_kernel_value(sample->dimension, width, away);
    if (!(weight > 0)) return;
    for (int k = 0; k < 3; k++) place[k] = -away[k] - grain->displacement[k];
    s->weight += weight;
    scree_along(s->place, weight, place, s->place);
    scree_along(s->moved, weight, grain->displacement, s->moved);
    scree_tensor_add(s->squares, weight, place, place);
    scree_tensor_add(s->products, weight, grain->displacement, place);
    s->grains++;
}

static void add_grain(const scree_average_sample *sample, const scree_average_grain *grain, double width,
                      const scree_average_points *points, sums *at)
{
    size_t from[3] = {0}, to[3] = {0};
    for (int k = 0; k < sample->dimension; k++)
        if (!find_range(points, width, grain->position[k], k, &from[k], &to[k])) return;
    for (size_t k = from[2]; k <= to[2]; k++)
        for (size_t j = from[1]; j <= to[1]; j++)
            for (size_t i = from[0]; i <= to[0]; i++) {
                const double point[3] = {points->first[0] + (double)i * points->gap[0],
                                         points->first[1] + (double)j * points->gap[1],
                                         points->first[2] + (double)k * points->gap[2]};
                add(sample, grain, width, point, &at[(k * points->number[1] + j) * points->number[0] + i]);
            }
}

static void solve(const sums *sum, int dimension, double *displacement, double gradient[9])
{
    sums s = *sum;
    double inverse[9];
    scree_tensor_add(s.squares, -1 / s.weight, s.place, s.place);
    scree_tensor_add(s.products, -1 / s.weight, s.moved, s.place);
    const bool good = s.grains > (size_t)dimension && scree_tensor_invert(s.squares, dimension, inverse);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double value = 0;
            for (int k = 0; k < dimension && good; k++) value += s.products[3 * i + k] * inverse[3 * k + j];
            gradient[3 * i + j] = good ? value : i < dimension && j < dimension ? NAN : 0;
        }
    for (int i = 0; i < dimension; i++) {
        displacement[i] = s.moved[i] / s.weight;
        for (int j = 0; j < dimension; j++) displacement[i] -= gradient[3 * i + j] * s.place[j] / s.weight;
    }
}

scree_status scree_average_kernel_strain_find(const scree_average_sample *sample, double width,
                                              const scree_average_points *points, double *displacement,
                                              double (*gradient)[9], scree_error *error)
{
    const size_t count = points->number[0] * points->number[1] * points->number[2];
    sums *at;
    scree_status status = scree_allocate(&at, count, sizeof *at, error);
    if (status) return status;
    for (size_t p = 0; p < sample->count; p++)
        if (sample->grain[p].counted && sample->grain[p].moved) add_grain(sample, &sample->grain[p], width, points, at);
    for (size_t k = 0; k < count; k++)
        solve(&at[k], sample->dimension, displacement + (size_t)sample->dimension * k, gradient[k]);
    scree_release(&at);
    return SCREE_OK;
}
