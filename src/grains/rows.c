/// Columns that grow by rows.
#include "grains/format.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double grain_unit(int column, const scree_grains_options *options)
{
    if (column <= SCREE_GRAIN_RADIUS) return options->length;
    if (column <= SCREE_GRAIN_VZ) return options->length / options->time;
    return column <= SCREE_GRAIN_WZ ? 1 / options->time : 1;
}

void grain_rows_leave_out(grain_rows *rows, size_t k, const char *name)
{
    char *list = rows->grains->left_out;
    const size_t length = strlen(list), room = sizeof rows->grains->left_out - length;
    rows->to[k] = GRAIN_IGNORED;
    if (snprintf(list + length, room, "%s%s", length ? ", " : "", name) >= (int)room)
        (void)snprintf(list + sizeof rows->grains->left_out - sizeof ", ...", sizeof ", ...", ", ...");
}

static scree_status grow(grain_rows *rows, size_t capacity, scree_error *error)
{
    scree_grains *g = rows->grains;
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < rows->cells && !status; k++) {
        const int to = rows->to[k];
        if (to < SCREE_GRAIN_COLUMNS)
            status = scree_reallocate(&g->column[to], g->count, capacity, sizeof **g->column, error);
        else if (to == GRAIN_KIND)
            status = scree_reallocate(&g->kind, g->count, capacity, sizeof *g->kind, error);
        else if (to == GRAIN_ID)
            status = scree_reallocate(&rows->id, g->count, capacity, sizeof *rows->id, error);
    }
    if (!status) rows->capacity = capacity;
    return status;
}

scree_status grain_rows_begin(grain_rows *rows, size_t expected, scree_error *error)
{
    return grow(rows, expected > 64 ? expected : 64, error);
}

static scree_status find_kind(grain_rows *rows, const grain_text *text, size_t k, uint8_t *kind, scree_error *error)
{
    scree_grains *g = rows->grains;
    size_t i = 0;
    while (i < g->kinds && strcmp(g->kind_name[i], text->cell[k]) != 0) i++;
    *kind = (uint8_t)i;
    if (i < g->kinds) return SCREE_OK;
    if (g->kinds == SCREE_GRAIN_KINDS || strlen(text->cell[k]) >= sizeof *g->kind_name)
        return grain_text_refuse(text, k, error, "there are more than %d materials", SCREE_GRAIN_KINDS);
    memcpy(g->kind_name[g->kinds++], text->cell[k], strlen(text->cell[k]) + 1);
    return SCREE_OK;
}

scree_status grain_rows_add(grain_rows *rows, const grain_text *text, scree_error *error)
{
    scree_grains *g = rows->grains;
    if (text->cells < rows->cells)
        return grain_text_refuse(text, SIZE_MAX, error, "this row has %zu values; %zu columns are named", text->cells,
                                 rows->cells);
    scree_status status = g->count == rows->capacity ? grow(rows, 2 * rows->capacity, error) : SCREE_OK;
    for (size_t k = 0; k < rows->cells && !status; k++) {
        const int to = rows->to[k];
        double value;
        if (to == GRAIN_KIND) status = find_kind(rows, text, k, &g->kind[g->count], error);
        if (to == GRAIN_KIND || to == GRAIN_IGNORED) continue;
        status = grain_text_number(text, k, &value, error);
        if (to == GRAIN_ID)
            rows->id[g->count] = (int64_t)value;
        else
            g->column[to][g->count] = rows->shift[k] + rows->factor[k] * value;
    }
    g->count += !status;
    return status;
}

// ---- by id ---------------------------------------------------------------------------------------------------------

typedef struct numbered {
    int64_t id;
    size_t row;
} numbered;

static int by_id(const void *one, const void *other)
{
    const int64_t a = ((const numbered *)one)->id, b = ((const numbered *)other)->id;
    return a < b ? -1 : a > b;
}

static scree_status permute(scree_grains *g, const numbered *order, scree_error *error)
{
    double *scratch = NULL;
    scree_status status = scree_allocate(&scratch, g->count, sizeof *scratch, error);
    for (int c = 0; c < SCREE_GRAIN_COLUMNS && !status; c++) {
        if (!g->column[c]) continue;
        for (size_t i = 0; i < g->count; i++) scratch[i] = g->column[c][order[i].row];
        memcpy(g->column[c], scratch, g->count * sizeof *scratch);
    }
    uint8_t *kind = (uint8_t *)scratch;
    for (size_t i = 0; i < g->count && g->kind && !status; i++) kind[i] = g->kind[order[i].row];
    if (g->kind && !status) memcpy(g->kind, kind, g->count);
    scree_release(&scratch);
    return status;
}

scree_status grain_rows_finish(grain_rows *rows, const grain_text *text, scree_error *error)
{
    scree_grains *g = rows->grains;
    numbered *order = NULL;
    if (!rows->id || g->count == 0) return SCREE_OK;
    scree_status status = scree_allocate(&order, g->count, sizeof *order, error);
    for (size_t i = 0; i < g->count && !status; i++) order[i] = (numbered){rows->id[i], i};
    if (!status) qsort(order, g->count, sizeof *order, by_id);
    for (size_t i = 0; i + 1 < g->count && !status; i++)
        if (order[i].id == order[i + 1].id)
            status = grain_text_refuse(text, SIZE_MAX, error, "two grains have the id %lld", (long long)order[i].id);
    if (!status) status = permute(g, order, error);
    if (!status) status = scree_allocate(&g->id, g->count, sizeof *g->id, error);
    for (size_t i = 0; i < g->count && !status; i++) g->id[i] = order[i].id;
    scree_release(&order);
    return status;
}

void grain_rows_release(grain_rows *rows)
{
    scree_release(&rows->id);
}
