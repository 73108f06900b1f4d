/// Samples from snapshots: the arrays of a snapshot, put together body by body and contact by contact.
#include "io/sample_file.h"

#include "case/case.h"
#include "io/run_directory.h"
#include "io/run_file.h"
#include "state/periodic.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- snapshots of a run ------------------------------------------------------------------------------------------

bool scree_snapshot_mark_is_of(const scree_snapshot_mark *mark, const char *stage)
{
    return strcmp(mark->stage_name, stage) == 0 || strcmp(mark->stage, stage) == 0;
}

scree_status scree_snapshot_marks(const char *directory, scree_snapshot_mark **marks, size_t *count, scree_error *error)
{
    char path[PATH_MAX], group[64];
    scree_hdf5 run;
    scree_part_list list = {0};
    *marks = NULL;
    *count = 0;
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (status) return status;
    scree_hdf5_open(&run, path, error);
    (void)scree_run_file_list(&run, SCREE_PART_SNAPSHOT, false, &list);
    if (!run.status && list.count == 0)
        run.status = scree_error_set(error, SCREE_ERROR_INPUT, "the run in '%s' has no snapshot", directory);
    if (!run.status) run.status = scree_allocate(marks, list.count, sizeof **marks, error);
    for (size_t k = 0; k < list.count && !run.status; k++) {
        scree_snapshot_mark *mark = &(*marks)[k];
        mark->index = list.index[k];
        mark->place = k;
        scree_part_group(SCREE_PART_SNAPSHOT, mark->index, group, sizeof group);
        scree_hdf5_get_number(&run, group, "time", &mark->time);
        scree_hdf5_get_number(&run, group, "axial_strain", &mark->axial_strain);
        scree_hdf5_get_text(&run, group, "stage", mark->stage, sizeof mark->stage);
        (void)snprintf(mark->stage_name, sizeof mark->stage_name, "%s", mark->stage);
        if (!run.status && H5Aexists_by_name(run.file, group, "stage_name", H5P_DEFAULT) > 0)
            scree_hdf5_get_text(&run, group, "stage_name", mark->stage_name, sizeof mark->stage_name);
    }
    *count = list.count;
    scree_part_list_destroy(&list);
    status = scree_hdf5_close(&run);
    if (status) scree_release(marks);
    return status;
}

// ---- arrays ------------------------------------------------------------------------------------------------------

/// One group of a file that is being read into a sample.
typedef struct reading {
    scree_hdf5 *run;
    const char *group;
    scree_average_sample *sample;
} reading;

static bool has(const reading *r, const char *name)
{
    char path[128];
    (void)snprintf(path, sizeof path, "%s/%s", r->group, name);
    return !r->run->status && H5Lexists(r->run->file, path, H5P_DEFAULT) > 0;
}

/// An array with `rows` rows (SIZE_MAX: as many as there are, which it becomes); the caller releases it.
static void *read_array(const reading *r, const char *name, scree_field_type type, int components, size_t *rows)
{
    scree_array array = {.name = name, .type = type, .components = components};
    scree_hdf5_read(r->run, r->group, &array);
    if (!r->run->status && *rows != SIZE_MAX && array.rows != *rows) {
        scree_hdf5_damaged(r->run, "arrays of one group have different lengths");
        scree_array_destroy(&array);
    }
    if (!r->run->status) *rows = array.rows;
    return array.data;
}

/// Numbers of the bodies, or of their contacts, each with so many components, into a member at `offset` of structs of
/// `stride` bytes.
static void read_into(const reading *r, const char *name, int components, size_t rows, void *first, size_t stride,
                      size_t offset)
{
    double *value = read_array(r, name, SCREE_FIELD_DOUBLE, components, &rows);
    for (size_t k = 0; k < rows && !r->run->status; k++)
        memcpy((char *)first + k * stride + offset, value + (size_t)components * k, (size_t)components * sizeof *value);
    scree_release(&value);
}

#define INTO_GRAINS(r, name, components, member)                                                                       \
    read_into(r, name, components, (r)->sample->bodies, (r)->sample->grain, sizeof(scree_average_grain),               \
              offsetof(scree_average_grain, member))
#define INTO_CONTACTS(r, name, components, member)                                                                     \
    read_into(r, name, components, (r)->sample->contacts, (r)->sample->contact, sizeof(scree_average_contact),         \
              offsetof(scree_average_contact, member))

/// Areas of discs and of what has an equivalent radius; volumes of spheres.
static void find_volumes(const reading *r)
{
    scree_average_sample *sample = r->sample;
    double *radius = NULL;
    size_t rows = sample->bodies;
    if (has(r, "equivalent_radius")) radius = read_array(r, "equivalent_radius", SCREE_FIELD_DOUBLE, 1, &rows);
    for (size_t k = 0; k < sample->bodies && !r->run->status; k++) {
        const double of = radius ? radius[k] : sample->grain[k].radius;
        sample->grain[k].volume = M_PI * of * of * (sample->dimension == 2 ? 1 : 4.0 / 3 * of);
    }
    scree_release(&radius);
}

/// Which bodies are counted: grains whose motion is not wholly prescribed.
static void find_counted(const reading *r)
{
    scree_average_sample *sample = r->sample;
    const unsigned all = sample->dimension == 2 ? 3 : 7;
    size_t rows = sample->bodies, held_rows = SIZE_MAX;
    uint8_t *mark = read_array(r, "mark", SCREE_FIELD_UINT8, 1, &rows), *held = NULL;
    // There are no rows where nothing was ever prescribed.
    if (has(r, "state") && has(r, "state/held")) held = read_array(r, "state/held", SCREE_FIELD_UINT8, 1, &held_rows);
    if (held && held_rows != 0 && held_rows != rows) scree_hdf5_damaged(r->run, "there are other bodies in state/held");
    for (size_t k = 0; k < sample->bodies && !r->run->status; k++)
        sample->grain[k].counted =
            mark[k] == SCREE_MARK_GRAIN && !(held && held_rows == rows && (held[k] & all) == all);
    scree_release(&mark);
    scree_release(&held);
}

static void read_outlines(const reading *r)
{
    scree_average_sample *sample = r->sample;
    size_t rows = sample->bodies;
    if (!has(r, "corner_count")) return;
    uint32_t *first = read_array(r, "first_corner", SCREE_FIELD_UINT32, 1, &rows);
    uint32_t *count = read_array(r, "corner_count", SCREE_FIELD_UINT32, 1, &rows);
    sample->corner_count = SIZE_MAX;
    sample->corner = read_array(r, "polygons/corner", SCREE_FIELD_DOUBLE, 2, &sample->corner_count);
    for (size_t k = 0; k < sample->bodies && !r->run->status; k++) {
        sample->grain[k].first_corner = first[k];
        sample->grain[k].corner_count = count[k];
        if ((size_t)first[k] + count[k] > sample->corner_count || count[k] > 32)
            scree_hdf5_damaged(r->run, "a body has corners that are not there");
    }
    scree_release(&first);
    scree_release(&count);
    if (!has(r, "rounding")) return;
    double *rounding = read_array(r, "rounding", SCREE_FIELD_DOUBLE, 1, &rows);
    for (size_t k = 0; k < sample->bodies && !r->run->status; k++) sample->grain[k].rounding = rounding[k];
    scree_release(&rounding);
}

/// How bodies lie in 3D, where the run has kept it.
static void read_orientations(const reading *r)
{
    size_t rows = r->sample->bodies;
    if (r->sample->dimension == 3 && has(r, "orientation"))
        r->sample->orientation = read_array(r, "orientation", SCREE_FIELD_DOUBLE, 4, &rows);
}

static void read_grains(const reading *r)
{
    scree_average_sample *sample = r->sample;
    const int d = sample->dimension;
    sample->bodies = SIZE_MAX;
    uint32_t *id = read_array(r, "id", SCREE_FIELD_UINT32, 1, &sample->bodies);
    if (!r->run->status)
        r->run->status = scree_allocate(&sample->grain, sample->bodies, sizeof *sample->grain, r->run->error);
    for (size_t k = 0; k < sample->bodies && !r->run->status; k++) {
        sample->grain[k].id = id[k];
        if (k > 0 && id[k] <= id[k - 1]) scree_hdf5_damaged(r->run, "ids of bodies do not ascend");
    }
    scree_release(&id);
    INTO_GRAINS(r, "position", d, position);
    INTO_GRAINS(r, "velocity", d, velocity);
    INTO_GRAINS(r, "force", d, resultant);
    INTO_GRAINS(r, "radius", 1, radius);
    INTO_GRAINS(r, "mass", 1, mass);
    if (d == 2) INTO_GRAINS(r, "angle", 1, angle);
    find_volumes(r);
    find_counted(r);
    read_outlines(r);
    read_orientations(r);
}

/// Place of the body with this id; `count`: there is none.
static size_t place_of(const scree_average_sample *sample, uint32_t id)
{
    size_t low = 0, high = sample->bodies;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sample->grain[middle].id < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < sample->bodies && sample->grain[low].id == id ? low : sample->bodies;
}

static void read_partners(const reading *r)
{
    scree_average_sample *sample = r->sample;
    size_t rows = SIZE_MAX, bad = 0;
    uint32_t *first = read_array(r, "contacts/first", SCREE_FIELD_UINT32, 1, &rows);
    uint32_t *second = read_array(r, "contacts/second", SCREE_FIELD_UINT32, 1, &rows);
    uint8_t *sliding = read_array(r, "contacts/sliding", SCREE_FIELD_UINT8, 1, &rows);
    sample->contacts = r->run->status ? 0 : rows;
    if (!r->run->status)
        r->run->status = scree_allocate(&sample->contact, rows, sizeof *sample->contact, r->run->error);
    for (size_t k = 0; k < sample->contacts && !r->run->status; k++) {
        scree_average_contact *contact = &sample->contact[k];
        const size_t one = place_of(sample, first[k]);
        const bool outside = second[k] >= SCREE_PRIMITIVE_ID;
        const size_t other = outside ? SCREE_AVERAGE_OUTSIDE : place_of(sample, second[k]);
        bad += one == sample->bodies || other == sample->bodies;
        contact->first = (uint32_t)one;
        contact->second = (uint32_t)other;
        contact->sliding = sliding[k];
    }
    if (bad > 0) scree_hdf5_damaged(r->run, "a contact names a body that does not exist");
    scree_release(&first);
    scree_release(&second);
    scree_release(&sliding);
}

static void read_contacts(const reading *r)
{
    scree_average_sample *sample = r->sample;
    const int d = sample->dimension;
    if (!has(r, "contacts")) return;
    read_partners(r);
    INTO_CONTACTS(r, "contacts/normal", d, normal);
    INTO_CONTACTS(r, "contacts/point", d, point);
    INTO_CONTACTS(r, "contacts/branch", d, branch);
    INTO_CONTACTS(r, "contacts/tangent", d, force);
    INTO_CONTACTS(r, "contacts/normal_force", 1, normal_force);
    INTO_CONTACTS(r, "contacts/tangential_force", 1, tangential_force);
    for (size_t k = 0; k < sample->contacts && !r->run->status; k++) {
        scree_average_contact *c = &sample->contact[k];
        for (int i = 0; i < 3; i++) c->force[i] = c->tangential_force * c->force[i] + c->normal_force * c->normal[i];
    }
}

static void read_cell(const reading *r)
{
    scree_array lattice = {
        .name = "periodic/lattice", .type = SCREE_FIELD_DOUBLE, .components = 9, .rows = 1, .single = true};
    scree_array directions = {
        .name = "periodic/directions", .type = SCREE_FIELD_UINT64, .components = 1, .rows = 1, .single = true};
    scree_array reference = {
        .name = "periodic/reference", .type = SCREE_FIELD_DOUBLE, .components = 9, .rows = 1, .single = true};
    if (!has(r, "periodic") || !has(r, "periodic/lattice")) return;
    const bool referred = has(r, "periodic/reference");
    scree_hdf5_read(r->run, r->group, &lattice);
    if (referred) scree_hdf5_read(r->run, r->group, &reference);
    scree_hdf5_read(r->run, r->group, &directions);
    if (!r->run->status) {
        memcpy(r->sample->lattice, lattice.data, sizeof r->sample->lattice);
        memcpy(&r->sample->directions, directions.data, sizeof r->sample->directions);
        if (referred) memcpy(r->sample->reference, reference.data, sizeof r->sample->reference);
    }
    scree_array_destroy(&lattice);
    scree_array_destroy(&reference);
    scree_array_destroy(&directions);
}

// ---- the case ----------------------------------------------------------------------------------------------------

/// Thickness and gravity of the case.
static scree_status read_case(const char *directory, scree_average_sample *sample, scree_error *error)
{
    char path[PATH_MAX];
    scree_case *c = NULL;
    scree_problems *problems = NULL;
    scree_model model;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_CASE, error);
    if (status) return status;
    status = scree_case_reread(path, scree_former_keys, &c, &problems);
    if (status && error && scree_problems_count(problems) > 0) *error = *scree_problems_get(problems, 0);
    if (!status) status = scree_model_build(&c->config, &model, error);
    if (!status) {
        sample->thickness = sample->dimension == 2 ? model.thickness : 1;
        memcpy(sample->gravity, model.gravity, sizeof sample->gravity);
    }
    scree_problems_free(problems);
    scree_case_free(c);
    return status;
}

/// Snapshots of earlier versions do not say since when grains turn.
static void read_since(const reading *r)
{
    r->sample->turned_since = NAN;
    if (!r->run->status && H5Aexists_by_name(r->run->file, r->group, "turned_since", H5P_DEFAULT) > 0)
        scree_hdf5_get_number(r->run, r->group, "turned_since", &r->sample->turned_since);
}

/// What acted when the snapshot was written, where it says so.
static void read_gravity(const reading *r)
{
    static const char *const name[3] = {"gravity_x", "gravity_y", "gravity_z"};
    for (int k = 0; k < 3; k++)
        if (!r->run->status && H5Aexists_by_name(r->run->file, r->group, name[k], H5P_DEFAULT) > 0)
            scree_hdf5_get_number(r->run, r->group, name[k], &r->sample->gravity[k]);
}

scree_status scree_sample_read(const char *directory, int64_t index, scree_average_sample *sample, scree_error *error)
{
    char path[PATH_MAX], group[64];
    scree_hdf5 run;
    uint64_t dimension = 2;
    const reading r = {&run, group, sample};
    *sample = (scree_average_sample){0};
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (status) return status;
    scree_part_group(SCREE_PART_SNAPSHOT, index, group, sizeof group);
    scree_hdf5_open(&run, path, error);
    scree_hdf5_get_integer(&run, group, "dimension", &dimension);
    sample->dimension = dimension == 3 ? 3 : 2;
    scree_hdf5_get_number(&run, group, "time", &sample->time);
    scree_hdf5_get_text(&run, group, "stage", sample->stage, sizeof sample->stage);
    read_since(&r);
    read_grains(&r);
    read_contacts(&r);
    read_cell(&r);
    if (!run.status) run.status = read_case(directory, sample, error);
    read_gravity(&r);
    status = scree_hdf5_close(&run);
    if (status) scree_average_sample_destroy(sample);
    return status;
}
