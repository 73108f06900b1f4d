/// A table: the first row names the columns, "x [mm], y [mm], radius [mm]"; commas or semicolons between cells.
#include "grains/format.h"

#include "base/units.h"

#include <scree/scree.h>

#include <stdio.h>
#include <string.h>

static const grain_meaning columns[] = {
    {"x", SCREE_GRAIN_X, 1},           {"y", SCREE_GRAIN_Y, 1},     {"z", SCREE_GRAIN_Z, 1},
    {"radius", SCREE_GRAIN_RADIUS, 1}, {"vx", SCREE_GRAIN_VX, 1},   {"vy", SCREE_GRAIN_VY, 1},
    {"vz", SCREE_GRAIN_VZ, 1},         {"wx", SCREE_GRAIN_WX, 1},   {"wy", SCREE_GRAIN_WY, 1},
    {"wz", SCREE_GRAIN_WZ, 1},         {"spin", SCREE_GRAIN_WZ, 1}, {"angle", SCREE_GRAIN_ANGLE, 1},
    {"material", GRAIN_KIND, 1},       {"id", GRAIN_ID, 1},         {"diameter", SCREE_GRAIN_RADIUS, 0.5},
};
enum { COLUMNS = sizeof columns / sizeof *columns };

static bool is(const char *bytes)
{
    return bytes[strcspn(bytes, ",;\n")] != '\n';
}

static const char *si_of(int column)
{
    if (column <= SCREE_GRAIN_RADIUS) return "m";
    if (column <= SCREE_GRAIN_VZ) return "m/s";
    return column <= SCREE_GRAIN_WZ ? "rad/s" : "rad";
}

/// The unit in [ ] behind a name, which is cut off.
static scree_status read_unit(const grain_text *text, size_t k, int column, double *factor, scree_error *error)
{
    char *open = strchr(text->cell[k], '['), *close = open ? strchr(open, ']') : NULL, one[80];
    if (!close) return SCREE_OK;
    *open = *close = 0;
    for (char *last = open; last > text->cell[k] && (last[-1] == ' ' || last[-1] == '\t'); last--) last[-1] = 0;
    if (column >= SCREE_GRAIN_COLUMNS) return SCREE_OK;
    (void)snprintf(one, sizeof one, "1 %.60s", open + 1);
    scree_error why;
    if (scree_units_parse(one, si_of(column), factor, &why))
        return grain_text_refuse(text, k, error, "the unit of the column %s: %s", text->cell[k], why.message);
    return SCREE_OK;
}

static scree_status read_name(const grain_text *text, size_t k, const scree_grains_options *options, grain_rows *rows,
                              scree_error *error)
{
    const char *names[COLUMNS];
    char *cell = text->cell[k];
    const size_t length = strcspn(cell, " \t[");
    char name[41];
    int found = -1;
    (void)snprintf(name, sizeof name, "%.*s", (int)(length < 40 ? length : 40), cell);
    for (int c = 0; c < COLUMNS; c++) {
        names[c] = columns[c].name;
        if (strlen(names[c]) == length && strncmp(names[c], cell, length) == 0) found = c;
    }
    if (found < 0) {
        const char *nearest = scree_nearest(name, names, COLUMNS);
        return grain_text_refuse(
            text, k, error,
            "there is no column '%s'%s%s%s; known are x, y, z, radius or diameter, vx, vy, vz, wx, wy, wz, spin, "
            "angle, material, id",
            name, nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'" : "");
    }
    for (size_t other = 0; other < k; other++)
        if (rows->to[other] == columns[found].to)
            return grain_text_refuse(text, k, error, "this column is there twice");
    rows->to[k] = columns[found].to;
    double unit = grain_unit(rows->to[k], options);
    scree_status status = read_unit(text, k, rows->to[k], &unit, error);
    rows->factor[k] = unit * columns[found].factor;
    return status;
}

static scree_status read(grain_text *text, const scree_grains_options *options, scree_grains *grains,
                         scree_error *error)
{
    grain_rows rows = {.grains = grains};
    text->commas = ",;";
    if (!grain_text_line(text)) return grain_text_refuse(text, SIZE_MAX, error, "the file is empty");
    scree_status status = SCREE_OK;
    rows.cells = text->cells;
    for (size_t k = 0; k < text->cells && !status; k++) status = read_name(text, k, options, &rows, error);
    if (!status) status = grain_rows_begin(&rows, 0, error);
    while (!status && grain_text_line(text)) status = grain_rows_add(&rows, text, error);
    if (!status) status = grain_rows_finish(&rows, text, error);
    grain_rows_release(&rows);
    return status;
}

const grain_format grain_format_csv = {"csv", is, read};
