/// Putting the columns of a case together.
#include "run/columns.h"

#include "base/memory.h"
#include "case/problems.h"
#include "io/result_names.h"
#include "run/core_columns.h"

#include <stdio.h>
#include <string.h>

static size_t count_told(const scree_module *module, const scree_config *config)
{
    char about[SCREE_RESULT_NAME];
    size_t count = 0;
    if (!module->told) return 1;
    while (module->told(config, count, about)) count++;
    return count;
}

static size_t count_columns(const scree_config *config, size_t times[SCREE_MODULE_COUNT])
{
    size_t count = SCREE_SAMPLE_COUNT;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        times[m] = scree_modules[m]->columns.count > 0 ? count_told(scree_modules[m], config) : 0;
        count += times[m] * scree_modules[m]->columns.count;
    }
    return count;
}

static scree_status append(scree_columns *columns, const char *about, const scree_result *row, scree_error *error)
{
    char *name = columns->name[columns->count];
    scree_status status = scree_result_call(name, about, row, error);
    if (status) return status;
    if (scree_columns_find(columns, name) < columns->count)
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "two columns of series.csv would be called '%s': give '%s' another name", name, about);
    columns->column[columns->count++] = (scree_series_column){name, row->unit, row->meaning};
    return SCREE_OK;
}

static scree_status append_module(scree_columns *columns, int slot, const scree_config *config, scree_error *error)
{
    const scree_module *module = scree_modules[slot];
    char about[SCREE_RESULT_NAME] = "";
    scree_status status = SCREE_OK;
    for (size_t index = 0; index < columns->times[slot]; index++) {
        if (module->told) (void)module->told(config, index, about);
        for (size_t k = 0; k < module->columns.count && !status; k++)
            status = append(columns, about, &module->columns.row[k], error);
    }
    return status;
}

scree_status scree_columns_create(const scree_config *config, scree_columns *columns, scree_error *error)
{
    *columns = (scree_columns){0};
    size_t count = count_columns(config, columns->times);
    scree_status status = scree_allocate(&columns->column, count, sizeof *columns->column, error);
    if (!status) status = scree_allocate(&columns->name, count, sizeof *columns->name, error);
    for (int k = 0; k < SCREE_SAMPLE_COUNT && !status; k++)
        status = append(columns, "", &scree_sample_columns[k], error);
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++) status = append_module(columns, m, config, error);
    if (status) scree_columns_destroy(columns);
    return status;
}

void scree_columns_destroy(scree_columns *columns)
{
    scree_release(&columns->column);
    scree_release(&columns->name);
    columns->count = 0;
}

size_t scree_columns_find(const scree_columns *columns, const char *name)
{
    size_t k = 0;
    while (k < columns->count && strcmp(columns->column[k].name, name) != 0) k++;
    return k;
}

scree_status scree_columns_measure(const scree_columns *columns, const scree_context *context, bool in_parts,
                                   double *value, scree_error *error)
{
    scree_status status = SCREE_OK;
    value += SCREE_SAMPLE_COUNT;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        const scree_results *own = &scree_modules[m]->columns;
        for (size_t index = 0; index < columns->times[m] && !status; index++, value += own->count)
            if (own->in_parts == in_parts) status = own->measure(context, index, value, error);
    }
    return status;
}

bool scree_columns_look_at_whole(const scree_config *config)
{
    size_t times[SCREE_MODULE_COUNT];
    bool some = false;
    (void)count_columns(config, times);
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) some = some || (times[m] > 0 && !scree_modules[m]->columns.in_parts);
    return some;
}

bool scree_columns_want_whole(const scree_columns *columns, char *names, size_t size)
{
    size_t used = 0;
    names[0] = 0;
    for (int m = 0; m < SCREE_MODULE_COUNT && used < size; m++) {
        if (columns->times[m] == 0 || scree_modules[m]->columns.in_parts) continue;
        const int more = snprintf(names + used, size - used, "%s%s", used > 0 ? ", " : "", scree_modules[m]->name);
        used += more > 0 ? (size_t)more : 0;
    }
    return used > 0;
}

bool scree_column_is_known(const char *name, const char **nearest)
{
    const char *names[1024];
    size_t count = 0;
    for (int k = 0; k < SCREE_SAMPLE_COUNT; k++) names[count++] = scree_sample_columns[k].name;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        for (size_t k = 0; k < scree_modules[m]->columns.count; k++) {
            const char *own = scree_modules[m]->columns.row[k].name;
            if (own[0] != '_' && count < sizeof names / sizeof *names) names[count++] = own;
            if (own[0] == '_' && scree_result_ends(name, own)) return true;
        }
    for (size_t k = 0; k < count; k++)
        if (strcmp(names[k], name) == 0) return true;
    *nearest = scree_nearest(name, names, count);
    return false;
}
