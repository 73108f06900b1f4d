/// Cells in run.h5. Tensors lie in 3 x 3 in memory and have d x d components in files. Cost: about 130 bytes a
/// triangle, 230 a tetrahedron.
#include "io/cell_file.h"

#include "io/run_file.h"

#include <limits.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

typedef enum cell_shape { PER_CELL, PER_NODE, TENSOR } cell_shape;

typedef struct cell_member {
    const char *name;
    cell_shape shape;
    scree_field_type type;
    const char *unit, *meaning;
    size_t offset; ///< of the array in scree_cells
    size_t stride; ///< bytes from one cell to the next
} cell_member;

static const cell_member members[] = {
    {"cells/node", PER_NODE, SCREE_FIELD_UINT32, "1", "ids of the bodies at the corners, positively oriented",
     offsetof(scree_cells, node), 4 * sizeof(uint32_t)},
    {"cells/neighbour", PER_NODE, SCREE_FIELD_INT32, "1", "number of the cell opposite to each corner, -1: outside",
     offsetof(scree_cells, neighbour), 4 * sizeof(int32_t)},
    {"cells/volume", PER_CELL, SCREE_FIELD_DOUBLE, "m3", "volume; in 2D area times thickness of the discs",
     offsetof(scree_cells, volume), sizeof(double)},
    {"cells/velocity_gradient", TENSOR, SCREE_FIELD_DOUBLE, "1/s",
     "velocity gradient, row by row: d v_row / d x_column", offsetof(scree_cells, gradient), 9 * sizeof(double)},
    {"cells/stress", TENSOR, SCREE_FIELD_DOUBLE, "Pa", "stress from contacts, row by row, tension positive",
     offsetof(scree_cells, stress), 9 * sizeof(double)},
    {"cells/distortion_rate", PER_CELL, SCREE_FIELD_DOUBLE, "1/s",
     "L_II: root of the second invariant of the deviatoric rate of deformation", offsetof(scree_cells, distortion),
     sizeof(double)},
    {"cells/pressure", PER_CELL, SCREE_FIELD_DOUBLE, "Pa", "p: minus the mean normal stress, compression positive",
     offsetof(scree_cells, pressure), sizeof(double)},
};

size_t scree_cell_array_count(void)
{
    return sizeof members / sizeof *members;
}

static scree_array describe(const cell_member *member, int dimension, size_t rows)
{
    int components[] = {[PER_CELL] = 1, [PER_NODE] = dimension + 1, [TENSOR] = dimension * dimension};
    return (scree_array){.name = member->name,
                         .type = member->type,
                         .rows = rows,
                         .components = components[member->shape],
                         .unit = member->unit,
                         .meaning = member->meaning};
}

/// Component c of a cell: where it lies in memory.
static unsigned char *place_of(const cell_member *member, const scree_cells *cells, size_t cell, int c)
{
    unsigned char *base;
    memcpy(&base, (const unsigned char *)cells + member->offset, sizeof base);
    int d = cells->dimension, at = member->shape == TENSOR ? 3 * (c / d) + c % d : c;
    return base + cell * member->stride + (size_t)at * scree_field_size(member->type);
}

/// Corners are places in the assembly in memory, ids of bodies in files.
static bool is_node(const cell_member *member)
{
    return member->offset == offsetof(scree_cells, node);
}

scree_status scree_cell_array(const scree_cells *cells, size_t index, scree_array *array, scree_error *error)
{
    const cell_member *member = &members[index];
    *array = describe(member, cells->dimension, cells->count);
    scree_status status = scree_array_allocate(array, error);
    if (status) return status;
    size_t size = scree_field_size(member->type);
    unsigned char *target = array->data;
    for (size_t k = 0; k < cells->count; k++)
        for (int c = 0; c < array->components; c++, target += size) memcpy(target, place_of(member, cells, k, c), size);
    uint32_t *node = array->data;
    const size_t numbers = array->rows * (size_t)array->components;
    for (size_t k = 0; k < numbers && is_node(member) && cells->id; k++) node[k] = cells->id[node[k]];
    return SCREE_OK;
}

void scree_cells_write(scree_hdf5 *part, const char *group, const scree_cells *cells)
{
    char name[80];
    (void)snprintf(name, sizeof name, "%s/cells", group);
    scree_hdf5_group(part, name);
    scree_hdf5_set_integer(part, name, "dimension", (uint64_t)cells->dimension);
    for (size_t k = 0; k < scree_cell_array_count() && !part->status; k++) {
        scree_array array;
        part->status = scree_cell_array(cells, k, &array, part->error);
        scree_hdf5_write(part, group, &array);
        scree_array_destroy(&array);
    }
}

// ---- reading -----------------------------------------------------------------------------------------------------

static void read_member(scree_hdf5 *run, const char *group, const cell_member *member, scree_cells *cells, bool first)
{
    scree_array array = describe(member, cells->dimension, 0);
    scree_hdf5_read(run, group, &array);
    if (run->status) return;
    if (first) cells->count = array.rows;
    void *data = NULL;
    if (array.rows != cells->count)
        scree_hdf5_damaged(run, "arrays of one group have different lengths");
    else
        run->status = scree_allocate(&data, cells->count, member->stride, run->error);
    memcpy((unsigned char *)cells + member->offset, &data, sizeof data);
    size_t size = scree_field_size(member->type);
    const unsigned char *source = array.data;
    for (size_t k = 0; k < cells->count && !run->status; k++)
        for (int c = 0; c < array.components; c++, source += size) memcpy(place_of(member, cells, k, c), source, size);
    scree_array_destroy(&array);
}

/// Every number names a body or a cell, so that a reader may index with them; corners become places in the assembly.
static void check_numbers(scree_hdf5 *run, const scree_assembly *assembly, scree_cells *cells)
{
    size_t bad = 0;
    for (size_t k = 0; k < cells->count && !run->status; k++)
        for (int n = 0; n <= cells->dimension; n++) {
            cells->node[k][n] = (uint32_t)scree_position_of_id(assembly->id, assembly->count, cells->node[k][n]);
            bad += cells->node[k][n] >= assembly->count || cells->neighbour[k][n] >= (int64_t)cells->count;
        }
    for (size_t k = 0; k < cells->count && cells->dimension == 2 && !run->status; k++) {
        cells->node[k][3] = UINT32_MAX;
        cells->neighbour[k][3] = -1;
    }
    if (bad > 0) scree_hdf5_damaged(run, "a cell names a body or a cell that does not exist");
}

static void read_bodies(scree_hdf5 *run, const char *group, scree_assembly *assembly)
{
    size_t d = (size_t)assembly->dimension;
    scree_array place = {.name = "position", .type = SCREE_FIELD_DOUBLE, .components = assembly->dimension};
    scree_array radius = {.name = "radius", .type = SCREE_FIELD_DOUBLE, .components = 1};
    scree_array id = {.name = "id", .type = SCREE_FIELD_UINT32, .components = 1};
    scree_array mark = {.name = "mark", .type = SCREE_FIELD_UINT8, .components = 1};
    scree_array *const all[] = {&place, &radius, &id, &mark};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        scree_hdf5_read(run, group, all[k]);
        if (!run->status && all[k]->rows != place.rows)
            scree_hdf5_damaged(run, "arrays of one group have different lengths");
    }
    if (!run->status) run->status = scree_allocate(&assembly->position, 3 * place.rows, sizeof(double), run->error);
    if (!run->status) run->status = scree_allocate(&assembly->radius, place.rows, sizeof(double), run->error);
    if (!run->status) run->status = scree_allocate(&assembly->id, place.rows, sizeof(uint32_t), run->error);
    for (size_t i = 0; i < place.rows && !run->status; i++) {
        if (((const uint8_t *)mark.data)[i] != SCREE_MARK_GRAIN) continue;
        size_t k = assembly->count++;
        memcpy(assembly->position + 3 * k, (const double *)place.data + d * i, d * sizeof(double));
        assembly->radius[k] = ((const double *)radius.data)[i];
        assembly->id[k] = ((const uint32_t *)id.data)[i];
    }
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) scree_array_destroy(all[k]);
}

/// The group of the cells into `name`, which has to be there.
static void need_cells(scree_hdf5 *run, const char *group, int64_t index, char *name, size_t size)
{
    (void)snprintf(name, size, "%s/cells", group);
    if (!run->status && H5Lexists(run->file, name, H5P_DEFAULT) <= 0)
        run->status = scree_error_set(run->error, SCREE_ERROR_INPUT, "snapshot %lld of '%s' has no cells",
                                      (long long)index, run->path);
}

static void read_group(scree_hdf5 *run, const char *group, scree_cell_snapshot *snapshot)
{
    char name[80];
    uint64_t dimension = 0;
    need_cells(run, group, snapshot->index, name, sizeof name);
    scree_hdf5_get_integer(run, name, "dimension", &dimension);
    if (!run->status && dimension != 2 && dimension != 3) scree_hdf5_damaged(run, "cells are of no dimension");
    if (run->status) return;
    scree_hdf5_get_number(run, group, "time", &snapshot->time);
    scree_hdf5_get_number(run, group, "axial_strain", &snapshot->axial_strain);
    scree_hdf5_get_text(run, group, "stage", snapshot->stage, sizeof snapshot->stage);
    snapshot->assembly.dimension = snapshot->cells.dimension = (int)dimension;
    snapshot->assembly.thickness = 1;
    read_bodies(run, group, &snapshot->assembly);
    snapshot->cells.bodies = snapshot->assembly.count;
    for (size_t k = 0; k < scree_cell_array_count() && !run->status; k++)
        read_member(run, group, &members[k], &snapshot->cells, k == 0);
    check_numbers(run, &snapshot->assembly, &snapshot->cells);
}

scree_status scree_cell_snapshot_find(const char *directory, size_t which, scree_error *error)
{
    char path[PATH_MAX], group[64], name[80];
    int64_t index = 0;
    scree_hdf5 run;
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (status) return status;
    scree_run_file_open_snapshot(&run, path, which, &index, group, sizeof group, error);
    need_cells(&run, group, index, name, sizeof name);
    return scree_hdf5_close(&run);
}

scree_status scree_cell_snapshot_read(const char *directory, size_t which, scree_cell_snapshot *snapshot,
                                      scree_error *error)
{
    char path[PATH_MAX], group[64];
    scree_hdf5 run;
    *snapshot = (scree_cell_snapshot){0};
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (status) return status;
    scree_run_file_open_snapshot(&run, path, which, &snapshot->index, group, sizeof group, error);
    read_group(&run, group, snapshot);
    status = scree_hdf5_close(&run);
    if (status) scree_cell_snapshot_destroy(snapshot);
    return status;
}

void scree_cell_snapshot_destroy(scree_cell_snapshot *snapshot)
{
    scree_cells_destroy(&snapshot->cells);
    scree_assembly_destroy(&snapshot->assembly);
}

bool scree_cell_snapshots_agree(const scree_cell_snapshot *one, const scree_cell_snapshot *other)
{
    const scree_assembly *a = &one->assembly, *b = &other->assembly;
    return a->count == b->count && (a->count == 0 || memcmp(a->id, b->id, a->count * sizeof *a->id) == 0);
}
