/// The columns of modules.
#include "run/module_series.h"

#include "run/sample.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

enum { NAME = 96, MOST_VALUES = 16 };

/// Calls `visit` for each owner of columns of each module.
static void visit_owners(const scree_simulation *s,
                         void (*visit)(void *user, const scree_columns *columns, int64_t index, const char *owner),
                         void *user)
{
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        const scree_columns *columns = scree_modules[m]->columns;
        for (int64_t k = 0; columns && k < SCREE_COLUMN_OWNERS; k++) {
            const char *owner = columns->owner(&s->model, k);
            assert(columns->count <= MOST_VALUES);
            if (owner) visit(user, columns, k, owner);
        }
    }
}

static void count_columns(void *user, const scree_columns *columns, int64_t index, const char *owner)
{
    (void)index, (void)owner;
    *(size_t *)user += columns->count;
}

// ---- the header --------------------------------------------------------------------------------------------------

typedef struct header {
    scree_series_column *column;
    char (*name)[NAME];
    size_t count;
} header;

static void name_columns(void *user, const scree_columns *columns, int64_t index, const char *owner)
{
    header *h = user;
    (void)index;
    for (size_t k = 0; k < columns->count; k++, h->count++) {
        (void)snprintf(h->name[h->count], NAME, "%s%s", owner, columns->column[k].name);
        h->column[h->count] =
            (scree_series_column){h->name[h->count], columns->column[k].unit, columns->column[k].meaning};
    }
}

scree_status scree_module_series_open(scree_series_writer *writer, const scree_simulation *s, const char *path,
                                      int64_t append_rows, scree_error *error)
{
    header h = {.count = SCREE_SAMPLE_COUNT};
    size_t count = SCREE_SAMPLE_COUNT;
    visit_owners(s, count_columns, &count);
    scree_status status = scree_allocate(&h.column, count, sizeof *h.column, error);
    if (!status) status = scree_allocate(&h.name, count, sizeof *h.name, error);
    if (!status) {
        memcpy(h.column, scree_sample_columns, SCREE_SAMPLE_COUNT * sizeof *h.column);
        visit_owners(s, name_columns, &h);
        status = scree_series_open(writer, path, h.column, h.count, append_rows, error);
    }
    scree_release(&h.column);
    scree_release(&h.name);
    return status;
}

// ---- a row -------------------------------------------------------------------------------------------------------

typedef struct values {
    const scree_simulation *s;
    double *value;
    size_t count;
} values;

static void take_values(void *user, const scree_columns *columns, int64_t index, const char *owner)
{
    values *v = user;
    (void)owner;
    columns->values(&v->s->state, index, v->value + v->count);
    v->count += columns->count;
}

scree_status scree_module_series_append(scree_series_writer *writer, const scree_simulation *s, scree_error *error)
{
    values v = {.s = s, .count = SCREE_SAMPLE_COUNT};
    scree_status status = scree_allocate(&v.value, writer->column_count, sizeof *v.value, error);
    if (status) return status;
    memcpy(v.value, s->sample.value, sizeof s->sample.value);
    visit_owners(s, take_values, &v);
    status = scree_series_append(writer, v.value, error);
    scree_release(&v.value);
    return status;
}

// ---- results -----------------------------------------------------------------------------------------------------

typedef struct conclusion {
    const scree_simulation *s;
    scree_summary *summary;
} conclusion;

static void conclude(void *user, const scree_columns *columns, int64_t index, const char *owner)
{
    const conclusion *c = user;
    double value[MOST_VALUES];
    char name[NAME];
    columns->values(&c->s->state, index, value);
    for (size_t k = 0; k < columns->count; k++) {
        (void)snprintf(name, sizeof name, "%s%s", owner, columns->column[k].name);
        scree_summary_set_number(c->summary, name, value[k]);
    }
}

void scree_module_series_summarise(const scree_simulation *s, scree_summary *summary)
{
    conclusion c = {s, summary};
    visit_owners(s, conclude, &c);
}
