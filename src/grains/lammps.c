/// Dumps and data files of LAMMPS (docs.lammps.org: dump custom; read_data, atom_style sphere). What a dump has beside
/// the columns below is left out, and named. Coordinates: x, xu (unwrapped), xs (scaled by the box).
#include "grains/format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const grain_meaning columns[] = {
    {"id", GRAIN_ID, 1},
    {"type", GRAIN_KIND, 1},
    {"x", SCREE_GRAIN_X, 1},
    {"y", SCREE_GRAIN_Y, 1},
    {"z", SCREE_GRAIN_Z, 1},
    {"xu", SCREE_GRAIN_X, 1},
    {"yu", SCREE_GRAIN_Y, 1},
    {"zu", SCREE_GRAIN_Z, 1},
    {"radius", SCREE_GRAIN_RADIUS, 1},
    {"diameter", SCREE_GRAIN_RADIUS, 0.5},
    {"vx", SCREE_GRAIN_VX, 1},
    {"vy", SCREE_GRAIN_VY, 1},
    {"vz", SCREE_GRAIN_VZ, 1},
    {"omegax", SCREE_GRAIN_WX, 1},
    {"omegay", SCREE_GRAIN_WY, 1},
    {"omegaz", SCREE_GRAIN_WZ, 1},
};
static const char *const scaled[3] = {"xs", "ys", "zs"};

// ---- dumps ---------------------------------------------------------------------------------------------------------

static bool is_dump(const char *bytes)
{
    return strncmp(bytes, "ITEM: ", 6) == 0;
}

static void read_column(const char *name, const scree_grains_options *options, const scree_grains *g, grain_rows *rows,
                        size_t k)
{
    rows->to[k] = GRAIN_IGNORED;
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
        if (strcmp(columns[c].name, name) == 0) {
            rows->to[k] = columns[c].to;
            rows->factor[k] = columns[c].factor * grain_unit(columns[c].to, options);
        }
    for (int c = 0; c < 3; c++)
        if (strcmp(scaled[c], name) == 0) {
            rows->to[k] = SCREE_GRAIN_X + c;
            rows->factor[k] = g->bounds[c][1] - g->bounds[c][0];
            rows->shift[k] = g->bounds[c][0];
        }
    for (size_t other = 0; other < k; other++)
        if (rows->to[other] == rows->to[k]) rows->to[k] = GRAIN_IGNORED; // x and xu: the first
    if (rows->to[k] == GRAIN_IGNORED) grain_rows_leave_out(rows, k, name);
}

/// "xy xz yz pp pp ff": whether there are tilts, and in which directions the box repeats itself.
static bool read_sides(const char *names, scree_grains *g)
{
    static const char *const tilts = " xy xz yz";
    const bool tilted = strncmp(names, tilts, strlen(tilts)) == 0;
    char sides[3][3];
    g->sided = sscanf(names + (tilted ? strlen(tilts) : 0), "%2s %2s %2s", sides[0], sides[1], sides[2]) == 3;
    for (int c = 0; c < 3 && g->sided; c++) g->periodic |= (unsigned)(strcmp(sides[c], "pp") == 0) << c;
    return tilted;
}

/// The bounds of a tilted box are those of the box around it.
static void make_bounds_of_box(scree_grains *g)
{
    const double *t = g->tilt, corner[] = {0, t[0], t[1], t[0] + t[1]};
    double least = 0, most = 0;
    for (int k = 0; k < 4; k++) {
        least = fmin(least, corner[k]);
        most = fmax(most, corner[k]);
    }
    g->bounds[0][0] -= least;
    g->bounds[0][1] -= most;
    g->bounds[1][0] -= fmin(0, t[2]);
    g->bounds[1][1] -= fmax(0, t[2]);
}

static scree_status read_bounds(grain_text *text, const char *names, const scree_grains_options *options,
                                scree_grains *g, scree_error *error)
{
    scree_status status = SCREE_OK;
    const size_t needed = read_sides(names, g) ? 3 : 2;
    g->bounded = true;
    for (int c = 0; c < 3 && !status; c++) {
        if (!grain_text_line(text) || text->cells < needed)
            return grain_text_refuse(text, SIZE_MAX, error, "the bounds of the box are not whole");
        for (size_t k = 0; k < 2 && !status; k++) status = grain_text_number(text, k, &g->bounds[c][k], error);
        if (!status && needed == 3) status = grain_text_number(text, 2, &g->tilt[c], error);
        for (int k = 0; k < 2; k++) g->bounds[c][k] *= options->length;
        g->tilt[c] *= options->length;
    }
    make_bounds_of_box(g);
    return status;
}

static bool is_scaled(const char *name)
{
    return strcmp(name, scaled[0]) == 0 || strcmp(name, scaled[1]) == 0 || strcmp(name, scaled[2]) == 0;
}

static scree_status read_atoms(grain_text *text, char *names, size_t count, const scree_grains_options *options,
                               scree_grains *g, scree_error *error)
{
    grain_rows rows = {.grains = g};
    grain_text_cut(text, names);
    rows.cells = text->cells;
    for (size_t k = 0; k < text->cells; k++) read_column(text->cell[k], options, g, &rows, k);
    for (size_t k = 0; k < text->cells; k++)
        if (is_scaled(text->cell[k]) && (g->tilt[0] != 0 || g->tilt[1] != 0 || g->tilt[2] != 0))
            return grain_text_refuse(text, k, error, "scaled positions in a tilted box are not known: dump x, y, z");
    scree_status status = grain_rows_begin(&rows, count, error);
    for (size_t i = 0; i < count && !status; i++) {
        if (!grain_text_line(text))
            status = grain_text_refuse(text, SIZE_MAX, error, "the file ends after %zu of %zu grains", i, count);
        if (!status) status = grain_rows_add(&rows, text, error);
    }
    if (!status) status = grain_rows_finish(&rows, text, error);
    grain_rows_release(&rows);
    return status;
}

static scree_status read_dump(grain_text *text, const scree_grains_options *options, scree_grains *g,
                              scree_error *error)
{
    double count = 0;
    scree_status status = grain_text_find_frame(text, options->frame, error);
    for (char *line, *names; !status && (line = grain_text_raw(text));) {
        if (grain_text_item(line, "NUMBER OF ATOMS"))
            status = grain_text_line(text) ? grain_text_number(text, 0, &count, error)
                                           : grain_text_refuse(text, SIZE_MAX, error, "the file ends here");
        else if (grain_text_item(line, "TIME") && !grain_text_item(line, "TIMESTEP")) {
            if (grain_text_line(text)) status = grain_text_number(text, 0, &g->time, error);
            g->time *= options->time;
        } else if ((names = grain_text_item(line, "BOX BOUNDS")))
            status = read_bounds(text, names, options, g, error);
        else if ((names = grain_text_item(line, "ATOMS")))
            return read_atoms(text, names, count > 0 ? (size_t)count : 0, options, g, error);
    }
    return status ? status : grain_text_refuse(text, SIZE_MAX, error, "the frame has no ITEM: ATOMS");
}

const grain_format grain_format_lammps_dump = {"lammps_dump", is_dump, read_dump};

// ---- data files ----------------------------------------------------------------------------------------------------

/// A line "N atoms" among the first ones.
static bool is_data(const char *bytes)
{
    enum { FIRST = 40 };
    const char *line = bytes;
    for (int k = 0; k < FIRST && line; k++) {
        char word[16] = "";
        long long count;
        if (sscanf(line, "%lld %15s", &count, word) == 2 && strcmp(word, "atoms") == 0) return true;
        line = strchr(line, '\n');
        if (line) line++;
    }
    return false;
}

/// "0 10 xlo xhi"
static scree_status read_side(const grain_text *text, const scree_grains_options *options, scree_grains *g,
                              scree_error *error)
{
    static const char *const sides[3] = {"xlo", "ylo", "zlo"};
    scree_status status = SCREE_OK;
    for (int c = 0; c < 3; c++) {
        if (text->cells < 4 || strcmp(text->cell[2], sides[c]) != 0) continue;
        g->bounded = true;
        for (size_t k = 0; k < 2 && !status; k++) status = grain_text_number(text, k, &g->bounds[c][k], error);
        for (int k = 0; k < 2; k++) g->bounds[c][k] *= options->length;
    }
    return status;
}

/// The rows of a section, which have these columns first.
static scree_status read_section(grain_text *text, grain_rows *rows, const int *to, size_t cells, size_t count,
                                 const scree_grains_options *options, scree_error *error)
{
    rows->cells = cells;
    for (size_t k = 0; k < cells; k++) {
        rows->to[k] = to[k];
        rows->factor[k] = grain_unit(to[k], options) * (to[k] == SCREE_GRAIN_RADIUS ? 0.5 : 1);
    }
    scree_status status = grain_rows_begin(rows, count, error);
    for (size_t i = 0; i < count && !status; i++) {
        if (!grain_text_line(text))
            status = grain_text_refuse(text, SIZE_MAX, error, "the file ends after %zu of %zu grains", i, count);
        if (!status) status = grain_rows_add(rows, text, error);
    }
    if (!status) status = grain_rows_finish(rows, text, error);
    return status;
}

/// Velocities stand in a section of their own, in any order.
static void take_motion(scree_grains *to, scree_grains *from)
{
    for (int c = SCREE_GRAIN_VX; c <= SCREE_GRAIN_WZ; c++) {
        to->column[c] = from->column[c];
        from->column[c] = NULL;
    }
}

static scree_status read_data(grain_text *text, const scree_grains_options *options, scree_grains *g,
                              scree_error *error)
{
    static const int atoms[] = {GRAIN_ID,      GRAIN_KIND,    SCREE_GRAIN_RADIUS, GRAIN_IGNORED,
                                SCREE_GRAIN_X, SCREE_GRAIN_Y, SCREE_GRAIN_Z};
    static const int motion[] = {GRAIN_ID,       SCREE_GRAIN_VX, SCREE_GRAIN_VY, SCREE_GRAIN_VZ,
                                 SCREE_GRAIN_WX, SCREE_GRAIN_WY, SCREE_GRAIN_WZ};
    double count = 0;
    scree_grains moving = {0};
    grain_rows rows = {.grains = g}, speeds = {.grains = &moving};
    scree_status status = SCREE_OK;
    (void)grain_text_raw(text); // the title
    while (!status && grain_text_line(text)) {
        if (text->cells == 2 && strcmp(text->cell[1], "atoms") == 0)
            status = grain_text_number(text, 0, &count, error);
        else if (strcmp(text->cell[0], "Atoms") == 0)
            status = read_section(text, &rows, atoms, 7, (size_t)count, options, error);
        else if (strcmp(text->cell[0], "Velocities") == 0)
            status = read_section(text, &speeds, motion, 7, (size_t)count, options, error);
        else
            status = read_side(text, options, g, error);
    }
    if (!status && g->count == 0)
        status = grain_text_refuse(text, SIZE_MAX, error, "the file has no section Atoms (atom_style sphere)");
    if (!status) take_motion(g, &moving);
    grain_rows_release(&rows);
    grain_rows_release(&speeds);
    scree_grains_destroy(&moving);
    return status;
}

const grain_format grain_format_lammps_data = {"lammps_data", is_data, read_data};
