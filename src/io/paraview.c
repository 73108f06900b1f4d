/// ParaView files of one snapshot: what lies in paraview/ and which data each file carries.
///
///   discs-000012.vtp     a point a disc; all fields of a snapshot
///   contacts-000012.vtp  a line a contact, between centres (a wall: from the centre to the contact point)
///   boundary-000012.vtp  a line an edge of the closed Delaunay boundary
///   plates-000012.vtp    a line an active plate, as long as the sample
///   cell-000012.vtp      the sides of the periodic cell, in a periodic run instead of the boundary
///   discs.pvd, ...       the collections of all snapshots with their times
#include "io/paraview.h"

#include "io/run_directory.h"
#include "io/vtp.h"
#include "state/cell.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// What a scene is drawn from.
typedef struct scene {
    const scree_model *model;
    const scree_state *state;
    const scree_contact_table *table;
} scene;

// ---- the scenes --------------------------------------------------------------------------------------------------

static scree_status build_discs(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    scree_status status = scree_vtp_create(vtp, state->count, SCREE_VTP_POINTS, false, error);
    if (status) return status;
    for (size_t id = 0; id < state->count; id++) {
        const scree_row *row = &state->row[state->row_of_id[id]];
        scree_vtp_place(vtp, id, row->x, row->y);
    }
    for (size_t k = 0; k < scree_body_array_count(from->state) && !status; k++) {
        scree_array array;
        status = scree_body_array(from->model, state, k, &array, error);
        if (!status) status = scree_vtp_add(vtp, false, array, error);
    }
    return status;
}

/// Force on the first body of each contact.
static scree_status add_contact_force(scree_vtp *vtp, const scree_contact_table *table, scree_error *error)
{
    scree_array array = {.name = "force", .rows = table->count, .components = 2, .unit = "N"};
    scree_status status = scree_array_allocate(&array, error);
    if (status) return status;
    double *force = array.data;
    for (size_t k = 0; k < table->count; k++) {
        const scree_contact *contact = &table->contact[k];
        const double *n = contact->normal;
        force[2 * k] = contact->normal_force * n[0] - contact->tangential_force * n[1];
        force[2 * k + 1] = contact->normal_force * n[1] + contact->tangential_force * n[0];
    }
    return scree_vtp_add(vtp, true, array, error);
}

static scree_status build_contacts(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    const scree_contact_table *table = from->table;
    scree_status status = scree_vtp_create(vtp, 2 * table->count, SCREE_VTP_LINES, false, error);
    if (status) return status;
    for (size_t k = 0; k < table->count; k++) {
        const scree_contact *contact = &table->contact[k];
        const scree_row *first = &state->row[contact->first];
        scree_vtp_place(vtp, 2 * k, first->x, first->y);
        scree_vtp_place(vtp, 2 * k + 1, first->x - contact->branch[0], first->y - contact->branch[1]);
    }
    for (size_t k = 0; k < scree_contact_array_count() && !status; k++) {
        scree_array array;
        status = scree_contact_array(state, table, k, &array, error);
        if (!status) status = scree_vtp_add(vtp, true, array, error);
    }
    return status ? status : add_contact_force(vtp, table, error);
}

static scree_status build_boundary(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    const scree_loop *loop = &state->loop;
    scree_status status = scree_vtp_create(vtp, loop->count, SCREE_VTP_LINES, true, error);
    if (status) return status;
    for (size_t k = 0; k < loop->count; k++) {
        const scree_row *row = &state->row[state->row_of_id[loop->id[k]]];
        scree_vtp_place(vtp, k, row->x, row->y);
    }
    for (size_t k = 0; k < scree_member_count && !status; k++) {
        const scree_field *field = &scree_members[k];
        if (field->rows != SCREE_ROWS_LOOP) continue;
        scree_array array;
        status = scree_array_from_field(state, field, false, &array, error);
        // `loaded` belongs to the edge that begins at the body, the rest to the body.
        if (!status) status = scree_vtp_add(vtp, strcmp(field->name, "boundary/loaded") == 0, array, error);
    }
    return status;
}

/// Ends of a wall: as far along its tangent as the bodies reach.
static void place_wall(scree_vtp *vtp, size_t line, const scree_wall *wall, const scree_state *state)
{
    const double tangent[2] = {-wall->normal[1], wall->normal[0]};
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < state->count; k++) {
        const scree_row *row = &state->row[k];
        double along = tangent[0] * row->x + tangent[1] * row->y;
        low = fmin(low, along - row->radius);
        high = fmax(high, along + row->radius);
    }
    if (!(low <= high)) low = high = 0;
    const double ends[2] = {low, high};
    for (size_t e = 0; e < 2; e++)
        scree_vtp_place(vtp, 2 * line + e, wall->position * wall->normal[0] + ends[e] * tangent[0],
                        wall->position * wall->normal[1] + ends[e] * tangent[1]);
}

/// Keeps the rows of the active walls.
static void keep_active(scree_array *array, const scree_state *state)
{
    const size_t size = (size_t)array->components * scree_field_size(array->type);
    unsigned char *data = array->data;
    array->rows = 0;
    for (size_t w = 0; w < SCREE_WALL_COUNT; w++)
        if (state->wall[w].active) memmove(data + size * array->rows++, data + size * w, size);
}

static scree_status build_plates(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    size_t active = 0, line = 0;
    for (size_t w = 0; w < SCREE_WALL_COUNT; w++) active += state->wall[w].active != 0;
    scree_status status = scree_vtp_create(vtp, 2 * active, SCREE_VTP_LINES, false, error);
    if (status) return status;
    for (size_t w = 0; w < SCREE_WALL_COUNT; w++)
        if (state->wall[w].active) place_wall(vtp, line++, &state->wall[w], state);
    for (size_t k = 0; k < scree_member_count && !status; k++) {
        if (scree_members[k].rows != SCREE_ROWS_WALLS) continue;
        scree_array array;
        status = scree_array_from_field(state, &scree_members[k], false, &array, error);
        if (status) break;
        keep_active(&array, state);
        status = scree_vtp_add(vtp, true, array, error);
    }
    return status;
}

/// The sides of the cell as a closed line, from the bottom to the top plate where they do not repeat.
static scree_status build_cell(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    double corner[4][2];
    scree_status status = scree_vtp_create(vtp, 4, SCREE_VTP_LINES, true, error);
    if (status) return status;
    scree_cell_corners(&state->cell, state->wall[SCREE_WALL_BOTTOM].position, -state->wall[SCREE_WALL_TOP].position,
                       corner);
    for (size_t k = 0; k < 4; k++) scree_vtp_place(vtp, k, corner[k][0], corner[k][1]);
    return SCREE_OK;
}

// ---- files -------------------------------------------------------------------------------------------------------

/// Copies the entries of snapshots before `index` from an old collection.
static void copy_entries(FILE *old, FILE *file, const char *kind, int64_t index)
{
    char line[256], start[64];
    (void)snprintf(start, sizeof start, "file=\"%s-", kind);
    while (fgets(line, sizeof line, old)) {
        const char *number = strstr(line, start);
        if (number && strtoll(number + strlen(start), NULL, 10) < index) fputs(line, file);
    }
}

/// Renews KIND.pvd: entries of earlier snapshots stay, those from `index` on (before a restart) go.
static scree_status renew_collection(const char *folder, const char *kind, int64_t index, double time,
                                     scree_error *error)
{
    char path[PATH_MAX], name[64];
    FILE *file;
    (void)snprintf(name, sizeof name, "%s.pvd", kind);
    scree_status status = scree_path_join(path, sizeof path, folder, name, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n", file);
    FILE *old = fopen(path, "re");
    if (old) {
        copy_entries(old, file, kind, index);
        (void)fclose(old);
    }
    fprintf(file, "    <DataSet timestep=\"%.17g\" part=\"0\" file=\"%s-%06" PRId64 ".vtp\"/>\n", time, kind, index);
    fputs("  </Collection>\n</VTKFile>\n", file);
    return scree_replace_finish(path, file, true, error);
}

static scree_status write_scene(const scree_vtp *vtp, const char *folder, const char *kind,
                                const scree_snapshot_info *info, scree_error *error)
{
    char path[PATH_MAX], name[64];
    (void)snprintf(name, sizeof name, "%s-%06" PRId64 ".vtp", kind, info->index);
    scree_status status = scree_path_join(path, sizeof path, folder, name, error);
    if (!status) status = scree_vtp_write(vtp, path, info->time, error);
    if (!status) status = renew_collection(folder, kind, info->index, info->time, error);
    return status;
}

scree_status scree_paraview_write(const char *directory, const scree_model *model, const scree_state *state,
                                  const scree_contact_table *table, const scree_snapshot_info *info, scree_error *error)
{
    char folder[PATH_MAX];
    scree_status status = scree_path_join(folder, sizeof folder, directory, SCREE_FOLDER_PARAVIEW, error);
    if (status) return status;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot make the folder '%s'", folder);
    static const struct {
        const char *kind;
        scree_status (*build)(scree_vtp *vtp, const scene *from, scree_error *error);
    } scenes[] = {
        {"discs", build_discs},   {"contacts", build_contacts}, {"boundary", build_boundary},
        {"plates", build_plates}, {"cell", build_cell},
    };
    const scene from = {model, state, table};
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes && !status; k++) {
        scree_vtp vtp;
        // A cell has no boundary, and only a periodic sample has a cell.
        if (state->cell.periodic ? scenes[k].build == build_boundary : scenes[k].build == build_cell) continue;
        status = scenes[k].build(&vtp, &from, error);
        if (!status) status = write_scene(&vtp, folder, scenes[k].kind, info, error);
        scree_vtp_destroy(&vtp);
    }
    return status;
}
