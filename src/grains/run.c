/// Snapshots of runs of Scree: the grains of one, round ones, from a run.h5 (docs/output.md). `frame` is the number of
/// the snapshot. Materials have their names where the snapshot says them. A rectangular periodic cell is the box.
#include "grains/format.h"

#include "base/memory.h"

#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The group of a snapshot, and what is being read of it.
typedef struct snapshot {
    const char *path;
    hid_t group;
    size_t count; ///< bodies
    int dimension;
    scree_error *error;
    scree_status status;
} snapshot;

static void refuse(snapshot *s, const char *format, ...) SCREE_PRINTF(2, 3);
static void refuse(snapshot *s, const char *format, ...)
{
    char text[512];
    va_list arguments;
    if (s->status) return;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    s->status = scree_error_set(s->error, SCREE_ERROR_INPUT, "'%s': %s", s->path, text);
}

static bool has(const snapshot *s, const char *name)
{
    return H5Lexists(s->group, name, H5P_DEFAULT) > 0;
}

/// Values of a dataset, `components` a body; NULL: there is none, or it cannot be read, which is noted.
static double *read_values(snapshot *s, const char *name, size_t components)
{
    double *value = NULL;
    if (s->status || !has(s, name)) return NULL;
    const hid_t set = H5Dopen2(s->group, name, H5P_DEFAULT), space = H5Dget_space(set);
    if (H5Sget_simple_extent_npoints(space) != (hssize_t)(s->count * components))
        refuse(s, "the dataset %s has another size than those of the bodies", name);
    else
        s->status = scree_allocate(&value, s->count * components + 1, sizeof *value, s->error);
    if (!s->status && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) < 0)
        refuse(s, "the dataset %s cannot be read", name);
    if (s->status) scree_release(&value);
    H5Sclose(space);
    H5Dclose(set);
    return value;
}

/// Puts component `k` of the grains into a column; bodies that are none have their mark.
static void fill(snapshot *s, scree_grains *g, int column, const double *value, size_t components, size_t k,
                 const double *mark)
{
    size_t row = 0;
    if (s->status || !value) return;
    s->status = scree_allocate(&g->column[column], s->count, sizeof **g->column, s->error);
    for (size_t i = 0; i < s->count && !s->status; i++)
        if (!mark || mark[i] == 0) g->column[column][row++] = value[components * i + k];
    g->count = row;
}

/// The columns of a dataset with a value or a vector a body: `first` and those behind it.
static void read_columns(snapshot *s, scree_grains *g, const char *name, int first, size_t components,
                         const double *mark)
{
    double *value = read_values(s, name, components);
    for (size_t k = 0; k < components; k++) fill(s, g, first + (int)k, value, components, k, mark);
    scree_release(&value);
}

/// Name of material `k`: the k-th word of the attribute `materials`, else its number from 1.
static void name_kind(const snapshot *s, size_t k, char *name, size_t size)
{
    char text[1200] = "", *rest = text, *word = NULL;
    (void)snprintf(name, size, "%zu", k + 1);
    if (H5Aexists(s->group, "materials") <= 0) return;
    const hid_t attribute = H5Aopen(s->group, "materials", H5P_DEFAULT), type = H5Aget_type(attribute);
    if (H5Tget_size(type) < sizeof text && !H5Tis_variable_str(type)) (void)H5Aread(attribute, type, text);
    H5Tclose(type);
    H5Aclose(attribute);
    for (size_t i = 0; i <= k; i++) word = strsep(&rest, ",");
    if (word && word[0]) (void)snprintf(name, size, "%s", word);
}

static void read_kinds(snapshot *s, scree_grains *g, const double *mark)
{
    size_t row = 0;
    double *material = read_values(s, "material", 1);
    if (!material) return;
    s->status = scree_allocate(&g->kind, s->count, sizeof *g->kind, s->error);
    for (size_t i = 0; i < s->count && !s->status; i++) {
        if (mark && mark[i] != 0) continue;
        if (!(material[i] >= 0 && material[i] < SCREE_GRAIN_KINDS))
            refuse(s, "a material has the number %g", material[i]);
        else
            g->kind[row++] = (uint8_t)material[i];
        if (!s->status && (size_t)material[i] >= g->kinds) g->kinds = (size_t)material[i] + 1;
    }
    for (size_t k = 0; k < g->kinds; k++) name_kind(s, k, g->kind_name[k], sizeof g->kind_name[k]);
    scree_release(&material);
}

/// The cell of a periodic sample; of one that is periodic in some directions only the sides say nothing of the others.
static void read_cell(snapshot *s, scree_grains *g)
{
    double lattice[9] = {0};
    if (s->status || !has(s, "periodic/lattice")) return;
    const hid_t set = H5Dopen2(s->group, "periodic/lattice", H5P_DEFAULT);
    if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, lattice) < 0)
        refuse(s, "its cell cannot be read");
    H5Dclose(set);
    g->bounded = true;
    for (int c = 0; c < s->dimension; c++) {
        g->bounded &= lattice[3 * c + c] > 0 && lattice[3 * c + c] != 1; // zeros or a unit vector: not periodic
        for (int k = 0; k < s->dimension; k++)
            if (k != c && lattice[3 * c + k] != 0)
                refuse(s,
                       "its periodic cell is sheared, and a box has right angles: go on with it by scree run --after");
        g->bounds[c][1] = lattice[3 * c + c];
    }
}

static void read_snapshot(snapshot *s, scree_grains *g)
{
    const size_t d = (size_t)s->dimension;
    double *mark = read_values(s, "mark", 1), *corners = read_values(s, "corner_count", 1);
    for (size_t i = 0; i < s->count && corners; i++)
        if (corners[i] > 0)
            refuse(s, "its grains are polygons, of which a file has no outlines: go on with them by scree run --after");
    read_columns(s, g, "position", SCREE_GRAIN_X, d, mark);
    read_columns(s, g, "radius", SCREE_GRAIN_RADIUS, 1, mark);
    read_columns(s, g, "velocity", SCREE_GRAIN_VX, d, mark);
    read_columns(s, g, "spin", d == 3 ? SCREE_GRAIN_WX : SCREE_GRAIN_WZ, d == 3 ? 3 : 1, mark);
    if (d == 2) read_columns(s, g, "angle", SCREE_GRAIN_ANGLE, 1, mark);
    read_kinds(s, g, mark);
    read_cell(s, g);
    scree_release(&mark);
    scree_release(&corners);
}

/// The group of the snapshot with this number, or of the last one (NAN).
static hid_t find_group(hid_t file, double frame, char *name, size_t size)
{
    H5G_info_t info = {0};
    if (!isnan(frame)) {
        (void)snprintf(name, size, "/snapshots/%06.0f", frame);
    } else {
        if (H5Lexists(file, "/snapshots", H5P_DEFAULT) > 0)
            (void)H5Gget_info_by_name(file, "/snapshots", &info, H5P_DEFAULT);
        (void)snprintf(name, size, "/snapshots/");
        if (info.nlinks > 0)
            (void)H5Lget_name_by_idx(file, "/snapshots", H5_INDEX_NAME, H5_ITER_INC, info.nlinks - 1,
                                     name + strlen(name), size - strlen(name), H5P_DEFAULT);
    }
    return H5Lexists(file, "/snapshots", H5P_DEFAULT) > 0 && H5Lexists(file, name, H5P_DEFAULT) > 0
               ? H5Gopen2(file, name, H5P_DEFAULT)
               : -1;
}

/// Bodies and dimension, by the positions.
static void measure(snapshot *s)
{
    hsize_t size[2] = {0};
    if (!has(s, "position")) {
        refuse(s, "the snapshot has no positions");
        return;
    }
    const hid_t set = H5Dopen2(s->group, "position", H5P_DEFAULT), space = H5Dget_space(set);
    if (H5Sget_simple_extent_ndims(space) == 2) (void)H5Sget_simple_extent_dims(space, size, NULL);
    H5Sclose(space);
    H5Dclose(set);
    s->count = (size_t)size[0];
    s->dimension = (int)size[1];
    if (s->count == 0 || s->dimension < 2 || s->dimension > 3) refuse(s, "the snapshot has no grains");
}

bool grain_run_is(const char *path)
{
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    return H5Fis_hdf5(path) > 0;
}

scree_status grain_run_read(const char *path, const scree_grains_options *options, scree_grains *grains,
                            scree_error *error)
{
    char name[64];
    snapshot s = {.path = path, .error = error};
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // errors are told by what is returned
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return scree_error_set(error, SCREE_ERROR_IO, "'%s' cannot be read: it is no whole HDF5 file", path);
    grains->format = "run";
    s.group = find_group(file, options->frame, name, sizeof name);
    if (s.group < 0)
        refuse(&s, isnan(options->frame) ? "this is no run.h5 with snapshots" : "there is no snapshot %.0f",
               options->frame);
    else
        measure(&s);
    if (!s.status) read_snapshot(&s, grains);
    if (s.group >= 0) H5Gclose(s.group);
    H5Fclose(file);
    return s.status;
}
