/// Checkpoints: a state, bit for bit, in HDF5. Every array of the two tables in state/fields.h is a dataset of its own,
/// with unit and description, so a checkpoint can be read by a person and by h5py; nothing is a dump of memory.
///
/// Attributes of the group: `layout` is a checksum over names, types and shapes of the tables and tells whether this
/// build knows what it reads; `case_checksum` tells which case it belongs to. The seal of the file (seal.h) tells
/// whether it is whole; when it is not, the older of the two is read. Cost: about 125 bytes a body and 40 a contact on
/// disk.
#include "base/checksum.h"
#include "io/run_file.h"
#include "io/snapshot.h"

#include <scree/scree.h>

#include <inttypes.h>
#include <limits.h>
#include <string.h>
#include <unistd.h>

// ---- the tables as one list --------------------------------------------------------------------------------------

static size_t stored_count(void)
{
    return scree_field_count + scree_member_count;
}

/// The index-th of all fields and members; NULL when it is derived and therefore not stored, or of the other dimension.
static const scree_field *stored_field(int dimension, size_t index)
{
    const scree_field *field =
        index < scree_field_count ? &scree_fields[index] : &scree_members[index - scree_field_count];
    return field->role == SCREE_FIELD_STATE && scree_field_exists(field, dimension) ? field : NULL;
}

static uint64_t layout_checksum(int dimension)
{
    uint64_t checksum = (uint64_t)dimension;
    for (size_t k = 0; k < stored_count(); k++) {
        const scree_field *field = stored_field(dimension, k);
        if (!field) continue;
        checksum = scree_checksum_bytes(checksum, field->name, strlen(field->name));
        checksum = scree_checksum_word(checksum, (uint64_t)field->type << 32 | (uint32_t)field->components);
        checksum = scree_checksum_word(checksum, field->rows);
    }
    return checksum;
}

// ---- writing -----------------------------------------------------------------------------------------------------

static scree_status write_part(const char *path, const char *group, const scree_state *state, uint64_t case_checksum,
                               scree_error *error)
{
    scree_hdf5 part;
    scree_hdf5_create(&part, path, error);
    scree_hdf5_group(&part, group);
    scree_hdf5_set_text(&part, group, "program", "Scree " SCREE_VERSION);
    scree_hdf5_set_integer(&part, group, "layout", layout_checksum(state->dimension));
    scree_hdf5_set_integer(&part, group, "case_checksum", case_checksum);
    scree_hdf5_set_number(&part, group, "wall_time", state->spent.run);
    scree_hdf5_set_number(&part, group, "stage_wall_time", state->spent.stage);
    scree_hdf5_set_number(&part, group, "stage_processor_time", state->spent.processor);
    for (size_t k = 0; k < stored_count() && !part.status; k++) {
        const scree_field *field = stored_field(state->dimension, k);
        if (!field) continue;
        scree_array array;
        part.status = scree_array_from_field(state, field, false, &array, error);
        scree_hdf5_write(&part, group, &array);
        scree_array_destroy(&array);
    }
    return scree_hdf5_save(&part);
}

/// Removes all but the newest ones, which run.h5 has links to.
static scree_status remove_old(const char *directory, const scree_part_list *parts, scree_error *error)
{
    for (size_t k = 0; k + SCREE_CHECKPOINTS_KEPT < parts->count; k++) {
        char path[PATH_MAX];
        scree_status status =
            scree_part_path(directory, SCREE_PART_CHECKPOINT, parts->index[k], path, sizeof path, error);
        if (status) return status;
        if (unlink(path) != 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot remove '%s'", path);
    }
    return SCREE_OK;
}

/// Checkpoints in parts/ and, where a finished run.h5 holds some itself, in there.
typedef struct found {
    scree_part_list parts, groups;
} found;

static void found_destroy(found *all)
{
    scree_part_list_destroy(&all->parts);
    scree_part_list_destroy(&all->groups);
}

static scree_status find_all(const char *directory, found *all, scree_error *error)
{
    *all = (found){0};
    char path[PATH_MAX];
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (!status) status = scree_parts_list(directory, SCREE_PART_CHECKPOINT, &all->parts, error);
    if (!status && access(path, F_OK) == 0) {
        scree_hdf5 run;
        scree_hdf5_open_sealed(&run, path, error);
        (void)scree_run_file_list(&run, SCREE_PART_CHECKPOINT, true, &all->groups);
        status = scree_hdf5_close(&run);
    }
    if (status) found_destroy(all);
    return status;
}

static int64_t newest(const scree_part_list *list)
{
    return list->count > 0 ? list->index[list->count - 1] : -1;
}

scree_status scree_checkpoint_write(const char *directory, const scree_state *state, uint64_t case_checksum,
                                    scree_error *error)
{
    found all;
    char path[PATH_MAX], group[64];
    scree_status status = find_all(directory, &all, error);
    if (status) return status;
    int64_t part = newest(&all.parts), own = newest(&all.groups), index = (part > own ? part : own) + 1;
    found_destroy(&all);
    scree_part_group(SCREE_PART_CHECKPOINT, index, group, sizeof group);
    status = scree_parts_folder_make(directory, error);
    if (!status) status = scree_part_path(directory, SCREE_PART_CHECKPOINT, index, path, sizeof path, error);
    if (!status) status = write_part(path, group, state, case_checksum, error);
    if (!status) status = scree_run_file_renew(directory, NULL, INT64_MAX, error);
    scree_part_list parts = {0};
    if (!status) status = scree_parts_list(directory, SCREE_PART_CHECKPOINT, &parts, error);
    if (!status) status = remove_old(directory, &parts, error);
    scree_part_list_destroy(&parts);
    return status;
}

// ---- reading -----------------------------------------------------------------------------------------------------

/// Refuses what is whole but not ours: another version of the tables, another case.
static void check_origin(scree_hdf5 *file, const char *group, int dimension, uint64_t case_checksum)
{
    char program[64];
    uint64_t layout = 0, origin = 0;
    scree_hdf5_get_text(file, group, "program", program, sizeof program);
    scree_hdf5_get_integer(file, group, "layout", &layout);
    scree_hdf5_get_integer(file, group, "case_checksum", &origin);
    if (file->status) return;
    if (layout != layout_checksum(dimension))
        file->status = scree_error_set(file->error, SCREE_ERROR_INPUT,
                                       "'%s' is a checkpoint of another version of the state: it was written by %s, "
                                       "this is Scree %s",
                                       file->path, program, SCREE_VERSION);
    else if (origin != case_checksum)
        file->status =
            scree_error_set(file->error, SCREE_ERROR_INPUT, "'%s' is a checkpoint of another case", file->path);
}

/// Makes an empty loop of `rows` vertices.
static scree_status make_loop(scree_loop *loop, size_t rows, scree_error *error)
{
    scree_status status = scree_allocate(&loop->id, rows, sizeof *loop->id, error);
    if (!status) status = scree_allocate(&loop->loaded, rows, sizeof *loop->loaded, error);
    if (!status) status = scree_allocate(&loop->x, rows, sizeof *loop->x, error);
    if (!status) status = scree_allocate(&loop->y, rows, sizeof *loop->y, error);
    if (!status) status = scree_allocate(&loop->fx, rows, sizeof *loop->fx, error);
    if (!status) status = scree_allocate(&loop->fy, rows, sizeof *loop->fy, error);
    if (!status) loop->count = loop->capacity = rows;
    return status;
}

/// Makes bodies in a state that has only its dimension.
static scree_status make_bodies(scree_state *state, size_t rows, scree_error *error)
{
    return scree_state_create(state, state->dimension, rows, error);
}

/// Makes an empty hull of `rows` nodes, or of as many triangles.
static scree_status make_hull_nodes(scree_hull *hull, size_t rows, scree_error *error)
{
    scree_status status = scree_allocate(&hull->id, rows, sizeof *hull->id, error);
    if (!status) status = scree_allocate(&hull->place, rows, sizeof *hull->place, error);
    if (!status) status = scree_allocate(&hull->force, rows, sizeof *hull->force, error);
    if (!status) hull->node_count = hull->node_capacity = rows;
    return status;
}

static scree_status make_hull_triangles(scree_hull *hull, size_t rows, scree_error *error)
{
    scree_status status = scree_allocate(&hull->triangle, rows, sizeof *hull->triangle, error);
    if (!status) status = scree_allocate(&hull->loaded, rows, sizeof *hull->loaded, error);
    if (!status) hull->triangle_count = hull->triangle_capacity = rows;
    return status;
}

static scree_status make_drive(scree_drive *drive, size_t rows, scree_error *error)
{
    scree_status status = scree_allocate(&drive->force, rows, sizeof *drive->force, error);
    if (!status) drive->count = drive->capacity = rows;
    return status;
}

static scree_status make_membrane(scree_membrane *membrane, size_t rows, scree_error *error)
{
    scree_status status = scree_allocate(&membrane->rest, rows, sizeof *membrane->rest, error);
    if (!status) status = scree_allocate(&membrane->press, rows, sizeof *membrane->press, error);
    if (!status) status = scree_allocate(&membrane->force, rows, sizeof *membrane->force, error);
    if (!status) membrane->count = membrane->capacity = rows;
    return status;
}

/// Makes the part of `state` that `field` describes have `rows` rows, when it has none yet.
static scree_status make_room(scree_state *state, const scree_field *field, size_t rows, scree_error *error)
{
    if (field->rows == SCREE_ROWS_BODIES && !state->row) return make_bodies(state, rows, error);
    if (field->rows == SCREE_ROWS_LOOP && state->loop.count == 0) return make_loop(&state->loop, rows, error);
    scree_hull *hull = &state->hull;
    if (field->rows == SCREE_ROWS_HULL_NODES && hull->node_count == 0) return make_hull_nodes(hull, rows, error);
    if (field->rows == SCREE_ROWS_HULL_TRIANGLES && hull->triangle_count == 0)
        return make_hull_triangles(hull, rows, error);
    if (field->rows == SCREE_ROWS_DRIVE && state->drive.count == 0) return make_drive(&state->drive, rows, error);
    if (field->rows == SCREE_ROWS_MEMBRANE && state->membrane.count == 0)
        return make_membrane(&state->membrane, rows, error);
    if (field->rows == SCREE_ROWS_BOOKING && rows > 0) return scree_state_add_booking(state, error);
    if (field->rows == SCREE_ROWS_ROLLING && rows > 0) return scree_state_add_rolling(state, error);
    if (field->rows != SCREE_ROWS_CONTACTS || state->contact_count > 0) return SCREE_OK;
    scree_status status = scree_state_reserve_contacts(state, rows, error);
    if (!status) state->contact_count = rows;
    return status;
}

static void read_field(scree_hdf5 *file, const char *group, const scree_field *field, scree_state *state)
{
    scree_array array = scree_array_of_field(state, field);
    scree_hdf5_read(file, group, &array);
    if (!file->status) file->status = make_room(state, field, array.rows, file->error);
    if (!file->status && array.rows != scree_field_rows_count(state, field))
        scree_hdf5_damaged(file, "arrays of one kind have different lengths");
    if (!file->status) scree_array_to_field(&array, field, state);
    scree_array_destroy(&array);
}

/// Finds the row of each id.
static void find_rows(scree_hdf5 *file, scree_state *state)
{
    for (size_t row = 0; row < state->count && !file->status; row++)
        if (state->id[row] < state->count)
            state->row_of_id[state->id[row]] = (uint32_t)row;
        else
            scree_hdf5_damaged(file, "a body has an impossible id");
}

/// Reads one checkpoint. *damaged: the file is at fault, another one may be whole.
static scree_status read_one(const char *path, const char *group, scree_state *state, uint64_t case_checksum,
                             bool *damaged, scree_error *error)
{
    scree_hdf5 file;
    scree_hdf5_open_sealed(&file, path, error);
    check_origin(&file, group, state->dimension, case_checksum);
    scree_time_spent spent = {0};
    scree_hdf5_get_number(&file, group, "wall_time", &spent.run);
    scree_hdf5_get_number(&file, group, "stage_wall_time", &spent.stage);
    scree_hdf5_get_number(&file, group, "stage_processor_time", &spent.processor);
    for (size_t k = 0; k < stored_count() && !file.status; k++) {
        const scree_field *field = stored_field(state->dimension, k);
        if (field) read_field(&file, group, field, state);
    }
    find_rows(&file, state);
    state->spent = spent;
    *damaged = file.damaged;
    scree_status status = scree_hdf5_close(&file);
    if (status) {
        int dimension = state->dimension;
        scree_state_destroy(state);
        state->dimension = dimension;
    }
    return status;
}

/// Takes the newest checkpoint out of the lists; false when there is none left.
static bool take_newest(found *all, const char *directory, char path[PATH_MAX], int64_t *index, scree_status *status,
                        scree_error *error)
{
    if (all->parts.count + all->groups.count == 0) return false;
    bool part = newest(&all->parts) >= newest(&all->groups);
    scree_part_list *list = part ? &all->parts : &all->groups;
    *index = list->index[--list->count];
    *status = part ? scree_part_path(directory, SCREE_PART_CHECKPOINT, *index, path, PATH_MAX, error)
                   : scree_run_file_path(directory, path, PATH_MAX, error);
    return !*status;
}

scree_status scree_checkpoint_read(const char *directory, int dimension, scree_state *state, uint64_t case_checksum,
                                   scree_error *error)
{
    found all;
    char path[PATH_MAX], group[64];
    int64_t index = -1;
    scree_error reason = {0}, first = {0};
    bool damaged = true;
    *state = (scree_state){.dimension = dimension};
    scree_status status = find_all(directory, &all, error);
    if (status) return status;
    if (all.parts.count + all.groups.count == 0) {
        found_destroy(&all);
        return scree_error_set(error, SCREE_ERROR_INPUT, "there is no checkpoint in '%s'", directory);
    }
    while (damaged && take_newest(&all, directory, path, &index, &status, &reason)) {
        scree_part_group(SCREE_PART_CHECKPOINT, index, group, sizeof group);
        status = read_one(path, group, state, case_checksum, &damaged, &reason);
        if (damaged && !first.status) first = reason;
    }
    found_destroy(&all);
    if (!status && first.status)
        (void)scree_error_set(error, SCREE_OK, "checkpoint %" PRId64 " is used: %s", index, first.message);
    else if (status && damaged)
        (void)scree_error_set(error, SCREE_ERROR_IO, "no checkpoint in '%s' is whole: %s", directory, first.message);
    else if (error)
        *error = reason;
    return status;
}
