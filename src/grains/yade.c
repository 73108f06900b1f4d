/// Exports of YADE's `export.text` and `export.textExt` (yade-dem.org): a first line "#format x_y_z_r", and what stands
/// in the rows in its order; materials by their number, from 0 on.
#include "grains/format.h"

#include <string.h>

static const grain_meaning columns[] = {
    {"x", SCREE_GRAIN_X, 1},      {"y", SCREE_GRAIN_Y, 1},  {"z", SCREE_GRAIN_Z, 1},
    {"r", SCREE_GRAIN_RADIUS, 1}, {"matId", GRAIN_KIND, 1}, {"id", GRAIN_ID, 1},
};

static bool is(const char *bytes)
{
    return strncmp(bytes, "#format ", 8) == 0;
}

static scree_status read(grain_text *text, const scree_grains_options *options, scree_grains *grains,
                         scree_error *error)
{
    grain_rows rows = {.grains = grains};
    char *line = grain_text_raw(text);
    if (!line || !is(line))
        return grain_text_refuse(text, SIZE_MAX, error, "the first line is not '#format x_y_z_r' as YADE writes it");
    scree_status status = SCREE_OK;
    char *rest = NULL;
    for (char *name = strtok_r(line + 8, "_ \t\r", &rest); name && rows.cells < GRAIN_CELLS;
         name = strtok_r(NULL, "_ \t\r", &rest)) {
        const size_t k = rows.cells++;
        rows.to[k] = GRAIN_IGNORED;
        for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
            if (strcmp(columns[c].name, name) == 0) rows.to[k] = columns[c].to;
        rows.factor[k] = grain_unit(rows.to[k], options);
        if (rows.to[k] == GRAIN_IGNORED) grain_rows_leave_out(&rows, k, name);
    }
    status = grain_rows_begin(&rows, 0, error);
    while (!status && grain_text_line(text)) status = grain_rows_add(&rows, text, error);
    if (!status) status = grain_rows_finish(&rows, text, error);
    grain_rows_release(&rows);
    return status;
}

const grain_format grain_format_yade = {"yade", is, read};
