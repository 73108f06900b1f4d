/// Time of averages: bench_average [SIDE [THREADS]]. 6500 discs on 100 x 50 points, by elements of 150 grains and by a
/// smooth kernel of three diameters; SIDE^3 spheres on as many points, smooth, without and with the balance of momentum
/// (SIDE 100: a million, 0.6 GB), and for SIDE up to 30 by elements, too. Samples are shaken square lattices in which
/// all neighbours touch.
#include "bench.h"

#include "average/cuts.h"
#include "average/kernel.h"

#include <math.h>

enum { COLUMNS = 130, ROWS = 50, USUAL_SIDE = 30 };

static void add_grain(scree_average_sample *s, size_t number, const size_t at[3])
{
    s->grain[s->bodies++] =
        (scree_average_grain){.position = {(double)at[0] + 0.05 * sin((double)number), (double)at[1], (double)at[2]},
                              .radius = 0.5,
                              .volume = s->dimension == 2 ? M_PI / 4 : M_PI / 6,
                              .mass = 1,
                              .id = (uint32_t)number,
                              .counted = true};
}

static void add_contact(scree_average_sample *s, size_t first, size_t second)
{
    scree_average_contact *c = &s->contact[s->contacts++];
    *c = (scree_average_contact){.first = (uint32_t)first, .second = (uint32_t)second, .normal_force = 1};
    scree_subtract(s->grain[first].position, s->grain[second].position, c->branch);
    scree_along(s->grain[first].position, -0.5, c->branch, c->point);
    scree_along((double[3]){0}, 1, c->branch, c->normal);
    scree_along((double[3]){0}, 1, c->branch, c->force);
}

static scree_average_sample make(int dimension, const size_t side[3])
{
    scree_average_sample s = {.dimension = dimension, .thickness = 1};
    scree_error error;
    const size_t count = side[0] * side[1] * side[2], step[3] = {1, side[0], side[0] * side[1]};
    require(scree_allocate(&s.grain, count, sizeof *s.grain, &error), &error);
    require(scree_allocate(&s.contact, 3 * count, sizeof *s.contact, &error), &error);
    s.gravity[dimension - 1] = -9.81;
    for (size_t k = 0; k < count; k++) add_grain(&s, k, (size_t[]){k % side[0], k / step[1] % side[1], k / step[2]});
    for (size_t k = 0; k < count; k++)
        for (int axis = 0; axis < dimension; axis++)
            if (k / step[axis] % side[axis] + 1 < side[axis]) add_contact(&s, k, k + step[axis]);
    require(scree_average_sample_finish(&s, &error), &error);
    return s;
}

static void time_elements(scree_average_sample *s, const size_t grid[3], int threads)
{
    scree_error error;
    scree_average_view view;
    scree_average_table table = {0};
    const scree_average_plan plan = {.fields = (1U << SCREE_AVERAGE_FIELDS) - 1,
                                     .grains = 150,
                                     .points = 1,
                                     .threads = threads,
                                     .grid = {grid[0], grid[1], grid[2]}};
    const double begin = seconds(threads);
    require(scree_average_view_open(s, &plan, &view, &error), &error);
    require(scree_average_map_table(&view, &plan, &table, &error), &error);
    printf("%zu grains on %zu points, elements of 150 grains, %d threads: %.3g s\n", s->bodies, table.rows, threads,
           seconds(threads) - begin);
    scree_average_table_destroy(&table);
    scree_average_view_close(&view);
}

static void time_kernel(const scree_average_sample *s, const size_t grid[3], bool check, int threads)
{
    scree_error error;
    scree_average_kernel kernel;
    scree_average_points points = {.number = {grid[0], grid[1], grid[2]}, .gap = {1, 1, 1}};
    for (int k = 0; k < s->dimension; k++) points.gap[k] = (s->high[k] - s->low[k]) / (double)grid[k];
    const double begin = seconds(threads);
    require(scree_average_kernel_find(s, 3, &points, check, threads, &kernel, &error), &error);
    printf("%zu grains on %zu points, smooth%s, %d threads: %.3g s", s->bodies, kernel.count,
           check ? " with balance" : "", threads, seconds(threads) - begin);
    const scree_average_balance balance = check ? scree_average_kernel_balance(s, &kernel) : (scree_average_balance){0};
    if (check) printf(" (residual %.2g density g)", balance.residual / balance.scale);
    printf("\n");
    scree_average_kernel_destroy(&kernel);
}

int main(int count, char **argument)
{
    const long given = count > 1 ? strtol(argument[1], NULL, 10) : USUAL_SIDE;
    const int threads = count > 2 ? (int)strtol(argument[2], NULL, 10) : 1;
    const size_t side = given > 0 ? (size_t)given : USUAL_SIDE, cube[3] = {side, side, side};
    scree_average_sample discs = make(2, (size_t[]){COLUMNS, ROWS, 1});
    time_elements(&discs, (size_t[]){100, 50, 1}, threads);
    time_kernel(&discs, (size_t[]){100, 50, 1}, true, threads);
    scree_average_sample_destroy(&discs);
    scree_average_sample spheres = make(3, cube);
    for (int check = 0; check < 2; check++) time_kernel(&spheres, cube, check == 1, threads);
    if (side <= USUAL_SIDE) time_elements(&spheres, cube, threads);
    scree_average_sample_destroy(&spheres);
    return 0;
}
