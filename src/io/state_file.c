/// A state in HDF5: every array of the two tables in state/fields.h is a dataset of its own, with unit and description,
/// so it can be read by a person and by h5py; nothing is a dump of memory.
///
/// Attributes of the group: `layout` is a checksum over names, types and shapes of the tables and tells whether this
/// build knows what it reads; `case_checksum` tells which case it belongs to. Cost: about 125 bytes a body and 40 a
/// contact.
#include "io/state_file.h"

#include "base/checksum.h"
#include "comm/comm.h"
#include "state/row_table.h"

#include <scree/scree.h>

#include <string.h>

static const char PROGRAM[] = "Scree " SCREE_VERSION;

// ---- the tables as one list --------------------------------------------------------------------------------------

/// The field with this number; NULL when it is derived and therefore not stored, of the other dimension or of another
/// law.
static const scree_field *stored_field(const scree_state *state, size_t index)
{
    const scree_field *field = scree_field_at(index);
    return scree_field_is_stored(state, field) ? field : NULL;
}

static uint64_t layout_checksum(const scree_state *state)
{
    uint64_t checksum = (uint64_t)state->dimension;
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = stored_field(state, k);
        if (!field) continue;
        checksum = scree_checksum_bytes(checksum, field->name, strlen(field->name));
        checksum = scree_checksum_word(checksum, (uint64_t)scree_field_stored_type(state, field) << 32 |
                                                     (uint32_t)field->components);
        checksum = scree_checksum_word(checksum, field->rows);
    }
    return checksum;
}

// ---- the law whose memory contacts have --------------------------------------------------------------------------

static const char *const law_attributes[SCREE_LISTS][2] = {{"law", "law_option"},
                                                           {"persistent_law", "persistent_law_option"}};

/// Where contacts follow several laws, their names stand one after the other in the order of their numbers, and their
/// options, OPTION_BITS each, from the lowest bits on.
enum { LAWS_TEXT = 1024, OPTION_BITS = 3 };
_Static_assert(OPTION_BITS *(1 + SCREE_MOST_PAIR_LAWS) <= 64, "options of all laws fit in a word");

static void write_laws(scree_hdf5 *part, const char *group, const scree_state *state)
{
    for (int list = 0; list < SCREE_LISTS; list++) {
        const scree_remembered_law *law = &state->law[list];
        char text[LAWS_TEXT];
        uint64_t options = law->option;
        (void)snprintf(text, sizeof text, "%s", law->law ? law->law->name : "");
        for (int k = 0; k < state->pair_laws && list == SCREE_LIST_CONTACTS; k++) {
            const size_t used = strlen(text);
            (void)snprintf(text + used, sizeof text - used, " %s", state->pair_law[k].law->name);
            options |= (uint64_t)state->pair_law[k].option << OPTION_BITS * (k + 1);
        }
        scree_hdf5_set_text(part, group, law_attributes[list][0], text);
        scree_hdf5_set_integer(part, group, law_attributes[list][1], options);
    }
}

/// The law of this name, with its option in the lowest bits of `options`; none of a name that is not known.
static scree_remembered_law named_law(const char *name, size_t length, uint64_t options)
{
    scree_remembered_law law = {.option = (unsigned)options & ((1U << OPTION_BITS) - 1)};
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        if (scree_modules[m]->law && strncmp(scree_modules[m]->name, name, length) == 0 &&
            scree_modules[m]->name[length] == 0)
            law.law = scree_modules[m];
    return law;
}

static void read_laws(scree_hdf5 *file, const char *group, int list, scree_state *state)
{
    char text[LAWS_TEXT];
    uint64_t options = 0;
    scree_hdf5_get_text(file, group, law_attributes[list][0], text, sizeof text);
    scree_hdf5_get_integer(file, group, law_attributes[list][1], &options);
    if (file->status) return;
    const char *name = text;
    state->law[list] = named_law(name, strcspn(name, " "), options);
    while (list == SCREE_LIST_CONTACTS && name[strcspn(name, " ")] == ' ') {
        name += strcspn(name, " ") + 1;
        options >>= OPTION_BITS;
        const scree_remembered_law law = named_law(name, strcspn(name, " "), options);
        if (!law.law || state->pair_laws == SCREE_MOST_PAIR_LAWS) {
            scree_hdf5_damaged(file, "contacts of a law that is not known, or of more than there may be");
            return;
        }
        state->pair_law[state->pair_laws++] = law;
    }
}

// ---- writing -----------------------------------------------------------------------------------------------------

/// The times of process 0, so that all write the same.
static scree_time_spent shared_times(const scree_hdf5 *part, const scree_state *state)
{
    scree_time_spent spent = state->spent;
    if (part->together.path) scree_comm_share(&spent, sizeof spent);
    return spent;
}

scree_status scree_array_of_range(const scree_hdf5 *file, const scree_state *state, const scree_field *field,
                                  bool by_id, const scree_ranges *ranges, scree_array *array)
{
    const bool part = ranges && ranges->part;
    // Those of a part are put into the order of their ids on the way.
    by_id = (by_id || file->together.path) && !part;
    scree_status status = scree_array_from_field(state, field, by_id, array, file->error);
    return status ? status : scree_array_send(scree_ranges_of(ranges, state, field), array, file->error);
}

void scree_state_write(scree_hdf5 *part, const char *group, const char *shared, const scree_state *state,
                       const scree_ranges *ranges, uint64_t case_checksum)
{
    const scree_time_spent spent = shared_times(part, state);
    scree_hdf5_group(part, group);
    scree_hdf5_set_text(part, group, "program", PROGRAM);
    scree_hdf5_set_integer(part, group, "layout", layout_checksum(state));
    write_laws(part, group, state);
    scree_hdf5_set_integer(part, group, "case_checksum", case_checksum);
    scree_hdf5_set_number(part, group, "wall_time", spent.run);
    scree_hdf5_set_number(part, group, "stage_wall_time", spent.stage);
    scree_hdf5_set_number(part, group, "stage_processor_time", spent.processor);
    for (size_t k = 0; k < scree_field_total() && !part->status; k++) {
        const scree_field *field = stored_field(state, k);
        if (!field || (shared && field->snapshot)) continue;
        scree_array array;
        part->status = scree_array_of_range(part, state, field, shared != NULL, ranges, &array);
        scree_hdf5_write(part, group, &array);
        scree_array_destroy(&array);
    }
}

// ---- reading -----------------------------------------------------------------------------------------------------

/// Refuses what is whole but not ours: another version of the tables, another case.
static void check_origin(scree_hdf5 *file, const char *group, const scree_state *state, uint64_t case_checksum)
{
    char program[64];
    uint64_t layout = 0, origin = 0;
    scree_hdf5_get_text(file, group, "program", program, sizeof program);
    scree_hdf5_get_integer(file, group, "layout", &layout);
    scree_hdf5_get_integer(file, group, "case_checksum", &origin);
    if (file->status) return;
    if (layout != layout_checksum(state))
        file->status =
            scree_error_set(file->error, SCREE_ERROR_INPUT,
                            "'%s' is a checkpoint of another version of the state: it was written by %s, "
                            "this is %s%s: begin the run anew (--force)",
                            file->path, program, strcmp(program, PROGRAM) == 0 ? "another build of " : "", PROGRAM);
    else if (origin != case_checksum)
        file->status =
            scree_error_set(file->error, SCREE_ERROR_INPUT, "'%s' is a checkpoint of another case", file->path);
}

/// What lies beside the first array of contacts is there where the law needs it.
static scree_status make_beside(scree_state *state, const scree_field *field, scree_error *error)
{
    if (scree_field_is_made(state, field)) return SCREE_OK;
    return scree_allocate(scree_field_array(state, field), state->contact_capacity, field->stride, error);
}

/// The same for contacts. Where there are any all processes have the arrays.
static scree_status make_contact_room(scree_state *state, const scree_field *field, const scree_array *array,
                                      scree_error *error)
{
    scree_status status = SCREE_OK;
    if (scree_array_total(array) == 0) return SCREE_OK;
    if (state->contact_count == 0 &&
        !(status = scree_state_reserve_contacts(state, array->rows > 0 ? array->rows : 1, error)))
        state->contact_count = array->rows;
    if (!scree_field_is_shared(state, field)) return status ? status : make_beside(state, field, error);
    for (int k = 0; k <= state->pair_laws && !status; k++) {
        const scree_field *declared = scree_field_of_law(state, field, k);
        if (declared) status = make_beside(state, declared, error);
    }
    return status;
}

/// Makes the part of `state` that `field` describes have the rows of the array, when it has none yet.
static scree_status make_room(scree_state *state, const scree_field *field, const scree_array *array,
                              scree_error *error)
{
    const size_t rows = array->rows;
    if (field->rows == SCREE_ROWS_BODIES && !state->row) return scree_state_make_bodies(state, rows, error);
    if (field->rows == SCREE_ROWS_BODIES && field->optional && scree_array_total(array) > 0)
        return scree_state_begin_field(state, field, error);
    if (field->rows == SCREE_ROWS_GROUP && scree_field_rows_count(state, field) == 0) {
        scree_status status = scree_group_reserve(state, field->owner, field->group, rows, error);
        if (!status) scree_group_set_count(state, field->owner, field->group, rows);
        return status;
    }
    return field->rows == SCREE_ROWS_CONTACTS ? make_contact_room(state, field, array, error) : SCREE_OK;
}

/// A snapshot has no optional field that the run did not have.
static bool is_left_out(const scree_hdf5 *file, const char *group, const scree_field *field)
{
    char name[160];
    (void)snprintf(name, sizeof name, "%s/%s", group, field->name);
    return field->optional && field->snapshot && H5Lexists(file->file, name, H5P_DEFAULT) <= 0;
}

/// Whether its rows are with the processes that have the bodies.
static bool is_split(const scree_field *field)
{
    if (field->rows == SCREE_ROWS_GROUP) return field->group->pairs;
    return field->rows == SCREE_ROWS_BODIES || field->rows == SCREE_ROWS_CONTACTS;
}

/// A part has its range of rows that are split.
static void read_field(scree_hdf5 *file, const char *group, const scree_field *field, scree_state *state)
{
    scree_array array = scree_array_of_field(state, field);
    if (state->part && is_split(field))
        scree_hdf5_read_range(file, group, &array);
    else
        scree_hdf5_read(file, group, &array);
    if (field->rows == SCREE_ROWS_BODIES && !field->optional) state->total = array.total;
    if (!file->status) file->status = make_room(state, field, &array, file->error);
    if (!file->status && array.rows != scree_field_rows_count(state, field))
        scree_hdf5_damaged(file, "arrays of one kind have different lengths");
    if (!file->status) scree_array_to_field(&array, field, state);
    scree_array_destroy(&array);
}

/// Finds the row of each id.
static void find_rows(scree_hdf5 *file, scree_state *state)
{
    scree_error reason = {0};
    if (file->status) return;
    state->id_count = state->part ? state->next_id : 0;
    scree_status status =
        state->part ? scree_row_table_begin(state, 0, &reason) : scree_state_find_rows(state, &reason);
    if (status == SCREE_ERROR_INPUT)
        scree_hdf5_refuse(file, "dataset 'id', %s", reason.message);
    else if (status)
        file->status = scree_error_set(file->error, status, "%s", reason.message);
}

static void read_state(scree_hdf5 *file, const char *group, const char *shared, int dimension, uint64_t case_checksum,
                       bool part, scree_state *state)
{
    scree_status opened = scree_state_open(state, dimension, file->error);
    if (!file->status) file->status = opened;
    state->part = part;
    for (int list = 0; list < SCREE_LISTS && !file->status; list++) read_laws(file, group, list, state);
    check_origin(file, group, state, case_checksum);
    scree_time_spent spent = {0};
    scree_hdf5_get_number(file, group, "wall_time", &spent.run);
    scree_hdf5_get_number(file, group, "stage_wall_time", &spent.stage);
    scree_hdf5_get_number(file, group, "stage_processor_time", &spent.processor);
    for (size_t k = 0; k < scree_field_total() && !file->status; k++) {
        const scree_field *field = stored_field(state, k);
        if (!field) continue;
        const char *from = shared && field->snapshot ? shared : group;
        if (from == group || !is_left_out(file, from, field)) read_field(file, from, field, state);
    }
    find_rows(file, state);
    state->spent = spent;
    if (!file->status) return;
    scree_state_destroy(state);
    state->dimension = dimension;
}

void scree_state_read(scree_hdf5 *file, const char *group, const char *shared, int dimension, uint64_t case_checksum,
                      scree_state *state)
{
    read_state(file, group, shared, dimension, case_checksum, false, state);
}

void scree_state_read_range(scree_hdf5 *file, const char *group, const char *shared, int dimension,
                            uint64_t case_checksum, scree_state *state)
{
    read_state(file, group, shared, dimension, case_checksum, true, state);
}
