/// Distributions of forces and of mobilised friction, roses of contacts.
#include "view/force_figures.h"

#include "view/chart.h"
#include "view/map.h"

#include <math.h>

enum { COLUMNS = 3 };

/// Columns of the first `count` rows, each times its factor, in one block: value[k] is the k-th.
typedef struct block {
    double *value[COLUMNS];
} block;

static scree_status take(const scree_average_table *table, size_t count, const char *const name[COLUMNS], block *b,
                         scree_error *error)
{
    scree_status status = scree_allocate(&b->value[0], COLUMNS * count, sizeof *b->value[0], error);
    for (size_t k = 0; k < COLUMNS && !status; k++) {
        const size_t column = scree_average_table_find(table, name[k]);
        b->value[k] = b->value[0] + k * count;
        for (size_t row = 0; row < count; row++)
            b->value[k][row] = column == SIZE_MAX ? NAN : scree_average_table_get(table, row, column);
    }
    return status;
}

/// The middle of bins in place of where they begin.
static void centre(block *b, const scree_average_table *table, size_t count)
{
    const size_t to = scree_average_table_find(table, "to");
    for (size_t k = 0; k < count; k++) b->value[0][k] = 0.5 * (b->value[0][k] + scree_average_table_get(table, k, to));
}

scree_status scree_draw_force_distribution(const char *path, const scree_average_table *table, scree_error *error)
{
    static const char *const name[COLUMNS] = {"from", "contacts", "bottom"};
    block b = {{NULL}};
    size_t n = 0;
    while (n < table->rows && scree_average_table_get(table, n, 0) == 0) n++;
    scree_status status = take(table, n, name, &b, error);
    if (status) return status;
    centre(&b, table, n);
    while (n > 1 && !(b.value[1][n - 1] > 0) && !(b.value[2][n - 1] > 0)) n--; // empty bins at the end
    const scree_chart_line line[] = {
        {.x = b.value[0], .y = b.value[1], .count = n, .label = "contacts, normal", .points = true},
        {.x = b.value[0], .y = b.value[2], .count = n, .label = "on the floor, vertical", .points = true}};
    const scree_chart chart = {.title = "Distribution of forces",
                               .x_label = "force over its mean, n",
                               .y_label = "P(n)",
                               .line = line,
                               .line_count = 2,
                               .log_y = true};
    status = scree_chart_draw(path, &chart, error);
    scree_release(&b.value[0]);
    return status;
}

scree_status scree_draw_friction_distribution(const char *path, const scree_average_table *table, scree_error *error)
{
    static const char *const name[COLUMNS] = {"from", "density", "sliding"};
    block b = {{NULL}};
    scree_status status = take(table, table->rows, name, &b, error);
    if (status) return status;
    centre(&b, table, table->rows);
    const scree_chart_line line = {.x = b.value[0], .y = b.value[1], .count = table->rows, .points = true};
    const scree_chart chart = {.title = "Mobilised friction",
                               .x_label = "tangential over normal force",
                               .y_label = "density",
                               .line = &line,
                               .line_count = 1};
    status = scree_chart_draw(path, &chart, error);
    scree_release(&b.value[0]);
    return status;
}

/// Sectors of elevation are of equal solid angle, hence of unequal width; each stands on both sides of the rose.
static scree_status draw_elevations(const char *path, const scree_average_table *table, scree_error *error)
{
    static const char *const name[COLUMNS] = {"angle", "contacts", "normal"};
    const size_t n = table->rows;
    double *both;
    block b = {{NULL}};
    scree_status status = take(table, n, name, &b, error);
    if (!status) status = scree_allocate(&both, 8 * n, sizeof *both, error);
    for (size_t k = 0; k < n && !status; k++) {
        const size_t other = 2 * n - 1 - k;
        both[2 * n + k] = both[2 * n + other] = b.value[1][k];
        both[4 * n + k] = both[4 * n + other] = b.value[2][k];
        const double low = asin(2 * (double)k / (double)n - 1), high = asin(2 * (double)(k + 1) / (double)n - 1);
        both[6 * n + k] = both[6 * n + other] = high - low;
        both[k] = 0.5 * (low + high), both[other] = M_PI - both[k];
    }
    const scree_rose rose = {.title = "Elevations of contacts and of their forces",
                             .name = "number of contacts by the elevation of their normals, 1 where all directions "
                                     "are alike",
                             .line_name = "mean normal force by elevation over that of all",
                             .sectors = 2 * n,
                             .angle = both,
                             .petal = both + 2 * n,
                             .line = both + 4 * n,
                             .width = both + 6 * n};
    if (!status) {
        status = scree_rose_draw(path, &rose, error);
        scree_release(&both);
    }
    scree_release(&b.value[0]);
    return status;
}

scree_status scree_draw_contact_rose(const char *path, const scree_average_table *table, scree_error *error)
{
    static const char *const name[COLUMNS] = {"angle", "contacts", "normal"};
    const size_t n = table->rows;
    block b = {{NULL}};
    if (n > 0 && scree_average_table_get(table, 0, 0) < 0) return draw_elevations(path, table, error);
    scree_status status = take(table, n, name, &b, error);
    if (status) return status;
    for (size_t k = 0; k < n; k++) b.value[0][k] *= M_PI / 180;
    const scree_rose rose = {.title = "Directions of contacts and of their forces",
                             .name = "number of contacts by the direction of their normals, 1 where all are alike",
                             .line_name = "mean normal force by direction over that of all",
                             .sectors = n,
                             .angle = b.value[0],
                             .petal = b.value[1],
                             .line = b.value[2]};
    status = scree_rose_draw(path, &rose, error);
    scree_release(&b.value[0]);
    return status;
}
