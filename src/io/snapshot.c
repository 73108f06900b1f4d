/// Snapshots: what a run looks like at one instant, for figures, ParaView and people. Written by scree_snapshot_write
/// as a part of run.h5 (run_file.h), read back by index from a run that goes on or has ended. Cost: about 130 bytes a
/// body and 100 a contact on disk; a few milliseconds for 5000 discs.
#include "io/snapshot.h"
#include "boundary/membrane.h"

#include "boundary/sheet.h"
#include "comm/comm.h"
#include "io/cell_file.h"
#include "io/run_file.h"
#include "io/state_file.h"
#include "model/material_name.h"
#include "state/periodic.h"
#include "state/plates.h"
#include "state/pressure.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

// ---- writing -----------------------------------------------------------------------------------------------------

static void write_bodies(scree_hdf5 *part, const char *group, const scree_model *model, const scree_state *state,
                         const scree_ranges *ranges)
{
    for (size_t k = 0; k < scree_body_array_count(state) && !part->status; k++) {
        scree_array array;
        part->status = scree_body_array(model, state, k, &array, part->error);
        if (!part->status && state->part) part->status = scree_array_send(&ranges->bodies, &array, part->error);
        scree_hdf5_write(part, group, &array);
        scree_array_destroy(&array);
    }
}

/// Contacts of a part go to the processes that write them.
static scree_status route_contacts(const scree_state *state, const scree_contact_table *table, scree_route *route,
                                   scree_error *error)
{
    uint64_t *key;
    scree_status status = scree_allocate(&key, table->count + 1, sizeof *key, error);
    if (status) return status;
    for (size_t k = 0; k < table->count; k++) {
        const scree_contact *contact = &table->contact[k];
        key[k] = scree_route_key(state->id[contact->first], scree_contact_second_id(state, contact));
    }
    status = scree_route_open(route, key, table->count, state->next_id, error);
    scree_release(&key);
    return status;
}

static void write_contacts(scree_hdf5 *part, const char *group, const scree_state *state,
                           const scree_contact_table *table)
{
    char folder[80];
    scree_route route = {0};
    if (!part->status && state->part) part->status = route_contacts(state, table, &route, part->error);
    (void)snprintf(folder, sizeof folder, "%s/contacts", group);
    for (size_t k = 0; k < scree_contact_array_count() && !part->status; k++) {
        scree_array array;
        part->status = scree_contact_array(state, table, k, &array, part->error);
        if (!part->status && state->part) part->status = scree_array_send(&route, &array, part->error);
        scree_hdf5_write(part, folder, &array);
        scree_array_destroy(&array);
    }
    scree_route_close(&route);
}

/// Boundary loop and walls, as the table of members has them.
static void write_members(scree_hdf5 *part, const char *group, const scree_state *state, const scree_ranges *ranges)
{
    for (size_t k = 0; k < scree_field_total() && !part->status; k++) {
        const scree_field *field = scree_field_at(k);
        bool member = field->rows != SCREE_ROWS_BODIES && field->snapshot;
        if (!member || !scree_field_exists(field, state->dimension)) continue;
        scree_array array;
        part->status = scree_array_of_range(part, state, field, true, ranges, &array);
        if (!field->optional || scree_array_total(&array) > 0) scree_hdf5_write(part, group, &array);
        scree_array_destroy(&array);
    }
}

/// The walls of the case as triangles.
static void write_wall_triangles(scree_hdf5 *part, const char *group, const scree_wall_triangles *walls)
{
    size_t count = walls ? walls->count : 0;
    scree_hdf5_set_integer(part, group, "wall_triangles", count);
    if (count == 0) return;
    const scree_array corner = {.name = "case_walls/triangle",
                                .type = SCREE_FIELD_DOUBLE,
                                .rows = count,
                                .components = 9,
                                .unit = "m",
                                .meaning = "three corners of each triangle; in 2D lines, the last two the same",
                                .data = walls->corner};
    const scree_array wall = {.name = "case_walls/wall",
                              .type = SCREE_FIELD_INT32,
                              .rows = count,
                              .components = 1,
                              .unit = "1",
                              .meaning = "number of the wall that each triangle is of, in the case",
                              .data = walls->wall};
    scree_hdf5_write(part, group, &corner);
    scree_hdf5_write(part, group, &wall);
}

/// The triangles of the sheet of a membrane, by ids of bodies.
static void write_sheet(scree_hdf5 *part, const char *group, const scree_state *state)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    if (membrane->around == 0 || part->status) return;
    scree_array array = {.name = "membrane/triangle",
                         .type = SCREE_FIELD_UINT32,
                         .rows = scree_sheet_triangle_count(membrane->around, membrane->count),
                         .components = 3,
                         .unit = "1",
                         .meaning = "triangles of the membrane, by ids of bodies, counter-clockwise seen from outside"};
    part->status = scree_array_allocate(&array, part->error);
    for (size_t t = 0; t < array.rows && !part->status; t++) {
        size_t corner[3];
        scree_sheet_triangle(membrane->around, membrane->count, t, corner);
        for (size_t c = 0; c < 3; c++) ((uint32_t *)array.data)[3 * t + c] = (uint32_t)(membrane->first_id + corner[c]);
    }
    scree_hdf5_write(part, group, &array);
    scree_array_destroy(&array);
}

/// Names of the materials, by their numbers.
static void write_materials(scree_hdf5 *part, const char *group, const scree_model *model)
{
    char names[SCREE_MAX_MATERIALS * 65] = "";
    for (int k = 0; k < model->material_count; k++)
        (void)snprintf(names + strlen(names), sizeof names - strlen(names), k > 0 ? ",%s" : "%s",
                       scree_model_material_name(model, k));
    scree_hdf5_set_text(part, group, "materials", names);
}

void scree_snapshot_state_group(int64_t index, char *name, size_t size)
{
    char group[64];
    scree_part_group(SCREE_PART_SNAPSHOT, index, group, sizeof group);
    (void)snprintf(name, size, "%s/state", group);
}

static void write_attributes(scree_hdf5 *part, const char *group, const scree_model *model, const scree_state *state,
                             const scree_snapshot_info *info)
{
    int64_t grains = (int64_t)scree_grain_count(state);
    scree_comm_add(state, &grains, 1);
    scree_hdf5_set_integer(part, group, "step", state->step);
    scree_hdf5_set_integer(part, group, "dimension", (uint64_t)state->dimension);
    scree_hdf5_set_number(part, group, "time", info->time);
    scree_hdf5_set_text(part, group, "stage", info->stage);
    if (info->stage_name) scree_hdf5_set_text(part, group, "stage_name", info->stage_name);
    scree_hdf5_set_number(part, group, "axial_strain", info->axial_strain);
    scree_hdf5_set_number(part, group, "turned_since", state->turned_since);
    scree_hdf5_set_integer(part, group, "grains", (uint64_t)grains);
    write_materials(part, group, model);
    scree_hdf5_set_number(part, group, "pressure", scree_pressure_now(state));
    scree_hdf5_set_number(part, group, "gravity_x", model->gravity[0]);
    scree_hdf5_set_number(part, group, "gravity_y", model->gravity[1]);
    scree_hdf5_set_number(part, group, "gravity_z", model->gravity[2]);
    scree_hdf5_set_text(part, group, "attribute_units",
                        "step 1, dimension 1, grains 1, time s, axial_strain 1, turned_since s, pressure Pa, gravity_x "
                        "m/s2, gravity_y m/s2, gravity_z m/s2, wall_triangles 1");
}

scree_status scree_snapshot_write(const char *directory, const scree_model *model, const scree_state *state,
                                  const scree_contact_table *table, const scree_snapshot_info *info, scree_error *error)
{
    char path[PATH_MAX], group[64], folder[80];
    const bool writes = !info->ranges || scree_comm_rank() == 0;
    scree_status status = scree_part_path(directory, SCREE_PART_SNAPSHOT, info->index, path, sizeof path, error);
    if (!status && writes) status = scree_parts_folder_make(directory, error);
    if (status) return status;
    scree_part_group(SCREE_PART_SNAPSHOT, info->index, group, sizeof group);
    scree_hdf5 part;
    if (info->ranges)
        scree_hdf5_create_together(&part, path, error);
    else
        scree_hdf5_create(&part, path, error);
    scree_hdf5_group(&part, group);
    write_attributes(&part, group, model, state, info);
    write_bodies(&part, group, model, state, info->ranges);
    write_contacts(&part, group, state, table);
    write_members(&part, group, state, info->ranges);
    write_wall_triangles(&part, group, info->walls);
    write_sheet(&part, group, state);
    if (info->cells) scree_cells_write(&part, group, info->cells);
    if (info->restartable) {
        scree_snapshot_state_group(info->index, folder, sizeof folder);
        scree_state_write(&part, folder, group, state, info->ranges, info->case_checksum);
    }
    status = scree_hdf5_save(&part);
    const scree_kept all = SCREE_KEEP_ALL;
    const char *case_name = model->name ? model->name : "";
    return status || !writes ? status : scree_run_file_renew(directory, case_name, &all, NULL, error);
}

// ---- reading -----------------------------------------------------------------------------------------------------

scree_status scree_snapshot_count(const char *directory, size_t *count, scree_error *error)
{
    char path[PATH_MAX];
    *count = 0;
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (status) return status;
    scree_hdf5 run;
    scree_part_list list;
    scree_hdf5_open(&run, path, error);
    (void)scree_run_file_list(&run, SCREE_PART_SNAPSHOT, false, &list);
    *count = list.count;
    scree_part_list_destroy(&list);
    return scree_hdf5_close(&run);
}

/// Reads `name` with `components` columns of type `type` into `rows` (set when it is SIZE_MAX, else checked). The
/// caller owns the data.
static void *read_column(scree_hdf5 *run, const char *group, const char *name, scree_field_type type, int components,
                         size_t *rows)
{
    scree_array array = {.name = name, .type = type, .components = components};
    scree_hdf5_read(run, group, &array);
    if (!run->status && *rows != SIZE_MAX && array.rows != *rows) {
        scree_hdf5_damaged(run, "arrays of one group have different lengths");
        scree_array_destroy(&array);
    }
    *rows = run->status ? *rows : array.rows;
    return array.data;
}

/// Splits vectors of the snapshot's dimension into arrays of their components.
static void read_vectors(scree_hdf5 *run, const char *group, const char *name, int dimension, size_t *rows,
                         double **const components[3])
{
    double *vectors = read_column(run, group, name, SCREE_FIELD_DOUBLE, dimension, rows);
    for (int i = 0; i < dimension && !run->status; i++)
        run->status = scree_allocate(components[i], *rows, sizeof **components[i], run->error);
    for (int i = 0; i < dimension && !run->status; i++)
        for (size_t k = 0; k < *rows; k++) (*components[i])[k] = vectors[(size_t)dimension * k + (size_t)i];
    scree_release(&vectors);
}

/// Magnitudes of the spins of spheres.
static void read_spin_magnitudes(scree_hdf5 *run, const char *group, scree_snapshot *snapshot)
{
    double *spin = read_column(run, group, "spin", SCREE_FIELD_DOUBLE, 3, &snapshot->count);
    if (!run->status)
        run->status = scree_allocate(&snapshot->spin, snapshot->count, sizeof *snapshot->spin, run->error);
    for (size_t k = 0; k < snapshot->count && !run->status; k++) snapshot->spin[k] = scree_length(&spin[3 * k]);
    scree_release(&spin);
}

/// Times of birth, where there are some.
static void read_births(scree_hdf5 *run, const char *group, scree_snapshot *snapshot)
{
    char name[80];
    (void)snprintf(name, sizeof name, "%s/birth", group);
    if (run->status || H5Lexists(run->file, name, H5P_DEFAULT) <= 0) return;
    snapshot->birth = read_column(run, group, "birth", SCREE_FIELD_DOUBLE, 1, &snapshot->count);
}

static void read_bodies(scree_hdf5 *run, const char *group, scree_snapshot *snapshot)
{
    size_t *rows = &snapshot->count;
    double **const place[3] = {&snapshot->x, &snapshot->y, &snapshot->z};
    double **const velocity[3] = {&snapshot->vx, &snapshot->vy, &snapshot->vz};
    *rows = SIZE_MAX;
    uint64_t dimension = 2;
    scree_hdf5_get_integer(run, group, "dimension", &dimension);
    if (!run->status && dimension != 2 && dimension != 3) scree_hdf5_damaged(run, "it is neither plane nor solid");
    snapshot->dimension = run->status ? 2 : (int)dimension;
    snapshot->id = read_column(run, group, "id", SCREE_FIELD_UINT32, 1, rows);
    snapshot->mark = read_column(run, group, "mark", SCREE_FIELD_UINT8, 1, rows);
    snapshot->radius = read_column(run, group, "radius", SCREE_FIELD_DOUBLE, 1, rows);
    read_vectors(run, group, "position", snapshot->dimension, rows, place);
    read_vectors(run, group, "velocity", snapshot->dimension, rows, velocity);
    if (snapshot->dimension == 3) {
        read_spin_magnitudes(run, group, snapshot);
    } else {
        snapshot->angle = read_column(run, group, "angle", SCREE_FIELD_DOUBLE, 1, rows);
        snapshot->spin = read_column(run, group, "spin", SCREE_FIELD_DOUBLE, 1, rows);
    }
}

static void read_contacts(scree_hdf5 *run, const char *group, scree_snapshot *snapshot)
{
    size_t *rows = &snapshot->contact_count;
    double **const point[3] = {&snapshot->contact_x, &snapshot->contact_y, &snapshot->contact_z};
    double **const branch[3] = {&snapshot->branch_x, &snapshot->branch_y, &snapshot->branch_z};
    *rows = SIZE_MAX;
    snapshot->first = read_column(run, group, "contacts/first", SCREE_FIELD_UINT32, 1, rows);
    snapshot->second = read_column(run, group, "contacts/second", SCREE_FIELD_UINT32, 1, rows);
    snapshot->normal_force = read_column(run, group, "contacts/normal_force", SCREE_FIELD_DOUBLE, 1, rows);
    snapshot->tangential_force = read_column(run, group, "contacts/tangential_force", SCREE_FIELD_DOUBLE, 1, rows);
    read_vectors(run, group, "contacts/point", snapshot->dimension, rows, point);
    read_vectors(run, group, "contacts/branch", snapshot->dimension, rows, branch);
}

/// Walls and cell, through the table of members: they are read into an otherwise empty state.
static void read_members(scree_hdf5 *run, const char *group, scree_snapshot *snapshot)
{
    scree_state members;
    scree_status opened = scree_state_open(&members, snapshot->dimension, run->error);
    if (!run->status) run->status = opened;
    for (size_t k = 0; k < scree_field_total() && !run->status; k++) {
        const scree_field *field = scree_field_at(k);
        if (!field->snapshot || (field->owner != &scree_module_plates && field->owner != &scree_module_periodic_cell))
            continue;
        scree_array array = scree_array_of_field(&members, field);
        scree_hdf5_read(run, group, &array);
        if (!run->status && array.rows != scree_field_rows_count(&members, field))
            scree_hdf5_damaged(run, "it has another number of walls");
        if (!run->status) scree_array_to_field(&array, field, &members);
        scree_array_destroy(&array);
    }
    if (!opened) {
        memcpy(snapshot->wall, scree_plates(&members), sizeof snapshot->wall);
        snapshot->periodic = *scree_cell(&members);
    }
    scree_state_destroy(&members);
}

static void read_wall_triangles(scree_hdf5 *run, const char *group, scree_snapshot *snapshot)
{
    uint64_t count = 0;
    scree_hdf5_get_integer(run, group, "wall_triangles", &count);
    size_t rows = count;
    if (!run->status && count > 0)
        snapshot->wall_triangle = read_column(run, group, "case_walls/triangle", SCREE_FIELD_DOUBLE, 9, &rows);
    snapshot->wall_triangle_count = snapshot->wall_triangle ? rows : 0;
}

/// The sheet of a membrane, where there is one.
static void read_sheet(scree_hdf5 *run, const char *group, scree_snapshot *snapshot)
{
    char name[80];
    (void)snprintf(name, sizeof name, "%s/membrane", group);
    if (run->status || H5Lexists(run->file, name, H5P_DEFAULT) <= 0) return;
    snapshot->triangle_count = SIZE_MAX;
    snapshot->triangle = read_column(run, group, "membrane/triangle", SCREE_FIELD_UINT32, 3, &snapshot->triangle_count);
    if (run->status) snapshot->triangle_count = 0;
}

/// Outlines of polygons, where there are some.
static void read_polygons(scree_hdf5 *run, const char *group, scree_snapshot *snapshot)
{
    char name[80];
    (void)snprintf(name, sizeof name, "%s/corner_count", group);
    if (run->status || H5Lexists(run->file, name, H5P_DEFAULT) <= 0) return;
    snapshot->first_corner = read_column(run, group, "first_corner", SCREE_FIELD_UINT32, 1, &snapshot->count);
    snapshot->corner_count = read_column(run, group, "corner_count", SCREE_FIELD_UINT32, 1, &snapshot->count);
    snapshot->corners = SIZE_MAX;
    snapshot->corner = read_column(run, group, "polygons/corner", SCREE_FIELD_DOUBLE, 2, &snapshot->corners);
    for (size_t k = 0; k < snapshot->count && !run->status; k++)
        if ((size_t)snapshot->first_corner[k] + snapshot->corner_count[k] > snapshot->corners)
            scree_hdf5_damaged(run, "a body has corners that are not there");
    (void)snprintf(name, sizeof name, "%s/rounding", group);
    if (run->status || H5Lexists(run->file, name, H5P_DEFAULT) <= 0) return;
    snapshot->rounding = read_column(run, group, "rounding", SCREE_FIELD_DOUBLE, 1, &snapshot->count);
}

/// Turns ids into places in the snapshot; the number of those that name no body.
static size_t find_places(const scree_snapshot *snapshot, uint32_t *ids, size_t count)
{
    size_t bad = 0;
    for (size_t k = 0; k < count; k++) {
        ids[k] = (uint32_t)scree_position_of_id(snapshot->id, snapshot->count, ids[k]);
        bad += ids[k] >= snapshot->count;
    }
    return bad;
}

/// Every id names a body or a wall; those of bodies become places, with which a reader may index.
static void resolve_ids(scree_hdf5 *run, scree_snapshot *snapshot)
{
    if (run->status) return;
    size_t bad = 0;
    for (size_t k = 1; k < snapshot->count; k++) bad += snapshot->id[k] <= snapshot->id[k - 1];
    if (bad > 0) scree_hdf5_damaged(run, "ids of bodies do not ascend");
    bad = find_places(snapshot, snapshot->first, snapshot->contact_count);
    for (size_t k = 0; k < snapshot->contact_count; k++) {
        bool wall = snapshot->second[k] >= SCREE_PRIMITIVE_ID && snapshot->second[k] < SCREE_WALL_ID + SCREE_WALL_COUNT;
        if (!wall) bad += find_places(snapshot, &snapshot->second[k], 1);
    }
    bad += find_places(snapshot, snapshot->loop, snapshot->loop_count);
    for (size_t t = 0; t < snapshot->triangle_count; t++) bad += find_places(snapshot, snapshot->triangle[t], 3);
    if (bad > 0) scree_hdf5_damaged(run, "a contact, the boundary or a membrane names a body that does not exist");
}

scree_status scree_snapshot_read(const char *directory, size_t which, scree_snapshot *snapshot, scree_error *error)
{
    char path[PATH_MAX], group[64];
    *snapshot = (scree_snapshot){0};
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (status) return status;
    scree_hdf5 run;
    scree_run_file_open_snapshot(&run, path, which, &snapshot->index, group, sizeof group, error);
    scree_hdf5_get_number(&run, group, "time", &snapshot->time);
    scree_hdf5_get_integer(&run, group, "grains", &snapshot->grains);
    scree_hdf5_get_number(&run, group, "axial_strain", &snapshot->axial_strain);
    scree_hdf5_get_text(&run, group, "stage", snapshot->stage, sizeof snapshot->stage);
    read_bodies(&run, group, snapshot);
    read_births(&run, group, snapshot);
    read_contacts(&run, group, snapshot);
    if (snapshot->dimension == 2) {
        snapshot->loop_count = SIZE_MAX;
        snapshot->loop = read_column(&run, group, "boundary/id", SCREE_FIELD_UINT32, 1, &snapshot->loop_count);
    }
    read_members(&run, group, snapshot);
    read_wall_triangles(&run, group, snapshot);
    read_sheet(&run, group, snapshot);
    read_polygons(&run, group, snapshot);
    resolve_ids(&run, snapshot);
    status = scree_hdf5_close(&run);
    if (status) scree_snapshot_destroy(snapshot);
    return status;
}

void scree_snapshot_destroy(scree_snapshot *snapshot)
{
    void *const arrays[] = {&snapshot->id,        &snapshot->mark,         &snapshot->x,
                            &snapshot->y,         &snapshot->radius,       &snapshot->angle,
                            &snapshot->vx,        &snapshot->vy,           &snapshot->spin,
                            &snapshot->first,     &snapshot->second,       &snapshot->loop,
                            &snapshot->triangle,  &snapshot->normal_force, &snapshot->tangential_force,
                            &snapshot->contact_x, &snapshot->contact_y,    &snapshot->z,
                            &snapshot->vz,        &snapshot->contact_z,    &snapshot->wall_triangle,
                            &snapshot->wall_line, &snapshot->branch_x,     &snapshot->branch_y,
                            &snapshot->branch_z,  &snapshot->first_corner, &snapshot->corner_count,
                            &snapshot->corner,    &snapshot->birth,        &snapshot->rounding};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    *snapshot = (scree_snapshot){0};
}
