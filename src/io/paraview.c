/// ParaView files of one snapshot: what lies in paraview/ and which data each file carries.
///
///   discs-000012.vtp     a point a disc (3D: spheres-000012.vtp); all fields of a snapshot
///   polygons-000012.vtp  the outlines of bodies that are not round, as triangles from their first corners, with the
///   same
///                        fields; discs-... have their centres and bounding radii
///   contacts-000012.vtp  a line a contact, between centres (a wall: from the centre to the contact point)
///   boundary-000012.vtp  2D: a line an edge of the closed Delaunay boundary
///   hull-000012.vtp      3D: a triangle a face of the closed Delaunay hull
///   membrane-000012.vtp  3D: a triangle a face of the sheet of a membrane, when there is one
///   plates-000012.vtp    a line (3D: a quadrilateral) an active plate, as long as the sample
///   lattice-000012.vtp   the edges of the periodic cell, in a periodic run instead of boundary or hull
///   cells-000012.vtu     the Delaunay cells with their fields, when the snapshot has them
///   discs.pvd, ...       the collections of all snapshots with their times
#include "io/paraview.h"
#include "measure/delaunay_boundary.h"
#include "shape/polygons.h"
#include "shape/rounding.h"
#include "state/plates.h"

#include "boundary/membrane.h"
#include "boundary/sheet.h"
#include "io/cell_file.h"
#include "io/run_directory.h"
#include "io/vtp.h"
#include "state/periodic.h"

#include <assert.h>
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
    const scree_cells *cells; ///< NULL: none
    const scree_wall_triangles *walls;
} scene;

// ---- the scenes ---------------------------------------------------------------------------------------------------

/// One point a body, in the order of ids.
static void place_bodies(scree_vtp *vtp, const scree_state *state)
{
    size_t point = 0, id = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW; point++) {
        scree_vector place;
        scree_body_position(state, row, place);
        scree_vtp_place(vtp, point, place);
    }
}

static scree_status build_bodies(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    scree_status status = scree_vtp_create(vtp, state->count, SCREE_VTP_POINTS, state->count, error);
    if (status) return status;
    place_bodies(vtp, state);
    for (size_t k = 0; k < scree_body_array_count(state) && !status; k++) {
        scree_array array;
        status = scree_body_array(from->model, state, k, &array, error);
        if (!status) status = scree_vtp_add(vtp, false, array, error);
    }
    return status;
}

/// Points of a rounded corner.
enum { ARC = 7 };

/// Points of the outline of a body; 0 of a disc.
static size_t outline_points(const scree_polygons *polygons, size_t row)
{
    const size_t corners = polygons->of[row].count;
    return scree_rounding_of_row(polygons, row) > 0 ? ARC * corners : corners;
}

/// The outline of a body as it lies.
static void trace_outline(const scree_state *state, size_t row, double placed[SCREE_POLYGON_CORNERS * ARC][2])
{
    const scree_polygons *polygons = scree_polygons_of(state);
    const scree_corners of = polygons->of[row];
    const double(*corner)[2] = (const double(*)[2])polygons->corner + of.first;
    const double rounding = scree_rounding_of_row(polygons, row);
    double rounded[SCREE_POLYGON_CORNERS * ARC][2];
    if (rounding > 0) {
        scree_rounding_trace((int)of.count, corner, rounding, ARC, rounded);
        corner = (const double(*)[2])rounded;
    }
    scree_polygon_place((int)outline_points(polygons, row), corner,
                        (const double[2]){state->row[row].x, state->row[row].y}, state->angle[row], placed);
}

/// Triangles of all outlines.
static size_t count_triangles(const scree_state *state, size_t *corners)
{
    const scree_polygons *polygons = scree_polygons_of(state);
    size_t triangles = 0;
    *corners = 0;
    for (size_t row = 0; row < state->count && polygons->of; row++) {
        const size_t count = outline_points(polygons, row);
        *corners += count;
        triangles += count > 2 ? count - 2 : 0;
    }
    return triangles;
}

static void place_outlines(scree_vtp *vtp, const scree_state *state)
{
    const scree_polygons *polygons = scree_polygons_of(state);
    size_t point = 0, cell = 0, id = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) {
        double placed[SCREE_POLYGON_CORNERS * ARC][2];
        const size_t count = outline_points(polygons, row);
        trace_outline(state, row, placed);
        for (size_t k = 0; k < count; k++)
            scree_vtp_place(vtp, point + k, (const double[3]){placed[k][0], placed[k][1], 0});
        for (size_t k = 2; k < count; k++, cell++) {
            scree_vtp_join(vtp, cell, 0, point);
            scree_vtp_join(vtp, cell, 1, point + k - 1);
            scree_vtp_join(vtp, cell, 2, point + k);
        }
        point += count;
    }
}

/// The element of a body for each of its triangles.
static scree_status spread_over_triangles(const scree_state *state, const scree_array *array, size_t triangles,
                                          scree_array *spread, scree_error *error)
{
    const size_t size = (size_t)array->components * scree_field_size(array->type);
    *spread = *array;
    spread->rows = triangles;
    scree_status status = scree_array_allocate(spread, error);
    if (status) return status;
    unsigned char *to = spread->data;
    const unsigned char *from = array->data;
    size_t id = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW; from += size)
        for (size_t k = 2; k < outline_points(scree_polygons_of(state), row); k++, to += size) memcpy(to, from, size);
    return SCREE_OK;
}

static scree_status build_polygons(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    size_t corners, triangles = count_triangles(state, &corners);
    scree_status status = scree_vtp_create(vtp, corners, SCREE_VTP_TRIANGLES, triangles, error);
    if (status) return status;
    place_outlines(vtp, state);
    for (size_t k = 0; k < scree_body_array_count(state) && !status; k++) {
        scree_array array = {0}, spread;
        status = scree_body_array(from->model, state, k, &array, error);
        if (!status) status = spread_over_triangles(state, &array, triangles, &spread, error);
        scree_array_destroy(&array);
        if (!status) status = scree_vtp_add(vtp, true, spread, error);
    }
    return status;
}

/// Force on the first body of each contact.
static scree_status add_contact_force(scree_vtp *vtp, const scree_contact_table *table, scree_error *error)
{
    scree_array array = {.name = "force", .rows = table->count, .components = 3, .unit = "N"};
    scree_status status = scree_array_allocate(&array, error);
    if (status) return status;
    double *force = array.data;
    for (size_t k = 0; k < table->count; k++) {
        const scree_contact *contact = &table->contact[k];
        for (size_t i = 0; i < 3; i++)
            force[3 * k + i] =
                contact->normal_force * contact->normal[i] + contact->tangential_force * contact->tangent[i];
    }
    return scree_vtp_add(vtp, true, array, error);
}

static scree_status build_contacts(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    const scree_contact_table *table = from->table;
    scree_status status = scree_vtp_create(vtp, 2 * table->count, SCREE_VTP_LINES, table->count, error);
    if (status) return status;
    for (size_t k = 0; k < table->count; k++) {
        const scree_contact *contact = &table->contact[k];
        scree_vector first, second;
        scree_body_position(state, contact->first, first);
        if (!contact->wall) scree_body_position(state, contact->second, second);
        for (int i = 0; i < 3 && contact->ghost; i++) second[i] = first[i] - contact->branch[i];
        scree_vtp_place(vtp, 2 * k, first);
        scree_vtp_place(vtp, 2 * k + 1, contact->wall ? contact->point : second);
    }
    for (size_t k = 0; k < scree_contact_array_count() && !status; k++) {
        scree_array array;
        status = scree_contact_array(state, table, k, &array, error);
        if (!status) status = scree_vtp_add(vtp, true, array, error);
    }
    return status ? status : add_contact_force(vtp, table, error);
}

/// Adds every field of a group, whose rows are points, or of another, whose rows are cells.
static scree_status add_groups(scree_vtp *vtp, const scree_state *state, const scree_group *points,
                               const scree_group *cells, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < scree_field_total() && !status; k++) {
        const scree_field *field = scree_field_at(k);
        if (!field->group || (field->group != points && field->group != cells)) continue;
        if (field->role == SCREE_FIELD_DERIVED) continue;
        // `loaded` belongs to the edge that begins at the body, the rest to the body.
        bool of_cells = points == cells ? strcmp(field->name, "boundary/loaded") == 0 : field->group == cells;
        scree_array array;
        status = scree_array_from_field(state, field, false, &array, error);
        if (!status) status = scree_vtp_add(vtp, of_cells, array, error);
    }
    return status;
}

/// The loop as a closed chain of lines.
static scree_status build_boundary(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    const scree_loop *loop = scree_loop_of(state);
    scree_status status = scree_vtp_create(vtp, loop->count, SCREE_VTP_LINES, loop->count, error);
    if (status) return status;
    for (size_t k = 0; k < loop->count; k++) {
        scree_vector place;
        scree_body_position(state, state->row_of_id[loop->id[k]], place);
        scree_vtp_place(vtp, k, place);
        scree_vtp_join(vtp, k, 0, k);
        scree_vtp_join(vtp, k, 1, (k + 1) % loop->count);
    }
    return add_groups(vtp, state, &scree_loop_group, &scree_loop_group, error);
}

static scree_status build_hull(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    const scree_hull *hull = scree_hull_of(state);
    scree_status status = scree_vtp_create(vtp, hull->node_count, SCREE_VTP_TRIANGLES, hull->triangle_count, error);
    if (status) return status;
    for (size_t k = 0; k < hull->node_count; k++) {
        scree_vector place;
        scree_body_position(state, state->row_of_id[hull->id[k]], place);
        scree_vtp_place(vtp, k, place);
    }
    for (size_t k = 0; k < hull->triangle_count; k++)
        for (size_t c = 0; c < 3; c++) scree_vtp_join(vtp, k, c, hull->triangle[k][c]);
    return add_groups(vtp, state, &scree_hull_nodes, &scree_hull_triangles, error);
}

/// The sheet of a membrane.
static scree_status build_membrane(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    const scree_membrane *membrane = scree_membrane_of(state);
    size_t triangles = scree_sheet_triangle_count(membrane->around, membrane->count), corner[3];
    scree_status status = scree_vtp_create(vtp, membrane->count, SCREE_VTP_TRIANGLES, triangles, error);
    if (status) return status;
    for (size_t k = 0; k < membrane->count; k++) {
        scree_vector place;
        scree_body_position(state, scree_membrane_row(state, k), place);
        scree_vtp_place(vtp, k, place);
    }
    for (size_t t = 0; t < triangles; t++) {
        scree_sheet_triangle(membrane->around, membrane->count, t, corner);
        for (size_t c = 0; c < 3; c++) scree_vtp_join(vtp, t, c, corner[c]);
    }
    return add_groups(vtp, state, &scree_membrane_bodies, NULL, error);
}

/// Extent of the bodies along a direction.
static void extent(const scree_state *state, const scree_vector along, double reach[2])
{
    reach[0] = INFINITY;
    reach[1] = -INFINITY;
    for (size_t k = 0; k < state->count; k++) {
        scree_vector place;
        scree_body_position(state, k, place);
        double at = scree_dot(along, place);
        reach[0] = fmin(reach[0], at - state->row[k].radius);
        reach[1] = fmax(reach[1], at + state->row[k].radius);
    }
    if (!(reach[0] <= reach[1])) reach[0] = reach[1] = 0;
}

/// Corners of a wall: as far along its tangents as the bodies reach.
static void place_wall(scree_vtp *vtp, size_t cell, const scree_wall *wall, const scree_state *state)
{
    const double *n = wall->normal;
    const size_t corners = (size_t)vtp->cells;
    // Two tangents; in 2D the second one is not used.
    scree_vector along = {-n[1], n[0], 0};
    if (n[0] == 0 && n[1] == 0) along[0] = 1;
    scree_vector across;
    scree_cross(n, along, across);
    double reach[2], width[2];
    extent(state, along, reach);
    extent(state, across, width);
    for (size_t c = 0; c < corners; c++) {
        double a = reach[c == 1 || c == 2], b = corners == 4 ? width[c >= 2] : 0;
        scree_vector corner;
        for (int i = 0; i < 3; i++) corner[i] = wall->position * n[i] + a * along[i] + b * across[i];
        scree_vtp_place(vtp, corners * cell + c, corner);
    }
}

/// Keeps the rows of the active walls.
static void keep_active(scree_array *array, const scree_state *state)
{
    const size_t size = (size_t)array->components * scree_field_size(array->type);
    unsigned char *data = array->data;
    array->rows = 0;
    for (size_t w = 0; w < SCREE_WALL_COUNT; w++)
        if (scree_plates(state)[w].active) memmove(data + size * array->rows++, data + size * w, size);
}

static scree_status build_plates(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    size_t active = 0, cell = 0;
    for (size_t w = 0; w < SCREE_WALL_COUNT; w++) active += scree_plates(state)[w].active != 0;
    const scree_vtp_cells cells = state->dimension == 3 ? SCREE_VTP_QUADRILATERALS : SCREE_VTP_LINES;
    scree_status status = scree_vtp_create(vtp, (size_t)cells * active, cells, active, error);
    if (status) return status;
    for (size_t w = 0; w < SCREE_WALL_COUNT; w++)
        if (scree_plates(state)[w].active) place_wall(vtp, cell++, &scree_plates(state)[w], state);
    for (size_t k = 0; k < scree_field_total() && !status; k++) {
        if (scree_field_at(k)->owner != &scree_module_plates) continue;
        scree_array array;
        status = scree_array_from_field(state, scree_field_at(k), false, &array, error);
        if (status) break;
        keep_active(&array, state);
        status = scree_vtp_add(vtp, true, array, error);
    }
    return status;
}

static scree_status build_walls(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_wall_triangles *walls = from->walls;
    const size_t corners = from->state->dimension == 3 ? 3 : 2;
    const scree_vtp_cells cells = corners == 3 ? SCREE_VTP_TRIANGLES : SCREE_VTP_LINES;
    scree_status status = scree_vtp_create(vtp, corners * walls->count, cells, walls->count, error);
    if (status) return status;
    for (size_t t = 0; t < walls->count; t++)
        for (size_t c = 0; c < corners; c++) scree_vtp_place(vtp, corners * t + c, &walls->corner[t][3 * c]);
    scree_array array = {.name = "wall", .type = SCREE_FIELD_INT32, .rows = walls->count, .components = 1, .unit = "1"};
    if ((status = scree_array_allocate(&array, error))) return status;
    memcpy(array.data, walls->wall, walls->count * sizeof *walls->wall);
    return scree_vtp_add(vtp, true, array, error);
}

/// The edges of the periodic cell, from the bottom to the top plate where it does not repeat.
static scree_status build_lattice(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    scree_vector low, high, ends[2];
    scree_periodic_box(state->dimension, scree_plates(state), low, high);
    size_t line = 0, edges = state->dimension == 2 ? 4 : 12;
    scree_status status = scree_vtp_create(vtp, 2 * edges, SCREE_VTP_LINES, edges, error);
    for (int edge = 0; edge < SCREE_PERIODIC_EDGES && !status; edge++) {
        if (!scree_periodic_edge(scree_cell(state), state->dimension, low, high, edge, ends)) continue;
        scree_vtp_place(vtp, 2 * line, ends[0]);
        scree_vtp_place(vtp, 2 * line++ + 1, ends[1]);
    }
    return status;
}

/// A tensor with all nine components, as ParaView wants it.
static scree_status add_tensor(scree_vtp *vtp, const char *name, const char *unit, double (*value)[9], size_t count,
                               scree_error *error)
{
    scree_array array = {.name = name, .rows = count, .components = 9, .unit = unit};
    scree_status status = scree_array_allocate(&array, error);
    if (status) return status;
    memcpy(array.data, value, count * sizeof *value);
    return scree_vtp_add(vtp, true, array, error);
}

static scree_status build_cells(scree_vtp *vtp, const scene *from, scree_error *error)
{
    const scree_state *state = from->state;
    const scree_cells *cells = from->cells;
    scree_status status = scree_vtu_create(vtp, cells->bodies, cells->dimension, cells->count, error);
    if (status) return status;
    for (size_t k = 0; k < cells->bodies; k++) {
        scree_vector place;
        scree_body_position(state, scree_state_row_of(state, cells->id ? cells->id[k] : k), place);
        scree_vtp_place(vtp, k, place);
    }
    for (size_t k = 0; k < cells->count; k++)
        for (int n = 0; n <= cells->dimension; n++) scree_vtp_join(vtp, k, (size_t)n, cells->node[k][n]);
    for (size_t k = 0; k < scree_cell_array_count() && !status; k++) {
        scree_array array;
        status = scree_cell_array(cells, k, &array, error);
        if (!status && array.components == 1)
            status = scree_vtp_add(vtp, true, array, error);
        else
            scree_array_destroy(&array);
    }
    if (!status) status = add_tensor(vtp, "velocity_gradient", "1/s", cells->gradient, cells->count, error);
    if (!status) status = add_tensor(vtp, "stress", "Pa", cells->stress, cells->count, error);
    return status;
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
static scree_status renew_collection(const char *folder, const char *kind, const char *extension, int64_t index,
                                     double time, scree_error *error)
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
    fprintf(file, "    <DataSet timestep=\"%.17g\" part=\"0\" file=\"%s-%06" PRId64 ".%s\"/>\n", time, kind, index,
            extension);
    fputs("  </Collection>\n</VTKFile>\n", file);
    return scree_replace_finish(path, file, true, error);
}

/// All files of a snapshot as the blocks of one, KIND-INDEX.vtm.
typedef struct blocks {
    char line[1024];
    size_t length, count;
} blocks;

static void add_block(blocks *all, const char *kind, const char *file)
{
    const int length = snprintf(all->line + all->length, sizeof all->line - all->length,
                                "    <DataSet index=\"%zu\" name=\"%s\" file=\"%s\"/>\n", all->count++, kind, file);
    all->length += (size_t)length;
    assert(all->length < sizeof all->line);
}

static scree_status write_blocks(const blocks *all, const char *folder, const scree_snapshot_info *info,
                                 scree_error *error)
{
    char path[PATH_MAX], name[64];
    FILE *file;
    (void)snprintf(name, sizeof name, "all-%06" PRId64 ".vtm", info->index);
    scree_status status = scree_path_join(path, sizeof path, folder, name, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    fprintf(file,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">\n"
            "  <vtkMultiBlockDataSet>\n%s  </vtkMultiBlockDataSet>\n</VTKFile>\n",
            all->line);
    status = scree_replace_finish(path, file, true, error);
    return status ? status : renew_collection(folder, "all", "vtm", info->index, info->time, error);
}

static scree_status write_scene(const scree_vtp *vtp, const char *folder, const char *kind,
                                const scree_snapshot_info *info, blocks *all, scree_error *error)
{
    char path[PATH_MAX], name[64];
    const char *extension = vtp->types.data ? "vtu" : "vtp";
    (void)snprintf(name, sizeof name, "%s-%06" PRId64 ".%s", kind, info->index, extension);
    scree_status status = scree_path_join(path, sizeof path, folder, name, error);
    if (!status) status = scree_vtp_write(vtp, path, info->time, error);
    add_block(all, kind, name);
    if (!status) status = renew_collection(folder, kind, extension, info->index, info->time, error);
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
        int only_dimension; ///< 0: both
    } scenes[] = {{"discs", build_bodies, 2},      {"spheres", build_bodies, 3},   {"contacts", build_contacts, 0},
                  {"boundary", build_boundary, 2}, {"hull", build_hull, 3},        {"membrane", build_membrane, 3},
                  {"plates", build_plates, 0},     {"lattice", build_lattice, 0},  {"walls", build_walls, 0},
                  {"cells", build_cells, 0},       {"polygons", build_polygons, 2}};
    const scene from = {model, state, table, info->cells, info->walls};
    blocks all = {0};
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes && !status; k++) {
        if (scenes[k].only_dimension && scenes[k].only_dimension != state->dimension) continue;
        if (scenes[k].build == build_cells && (!info->cells || info->cells->count == 0)) continue;
        if (scenes[k].build == build_polygons && !scree_polygons_of(state)->of) continue;
        if (scenes[k].build == build_membrane && scree_membrane_of(state)->count == 0) continue;
        if (scenes[k].build == build_walls && (!info->walls || info->walls->count == 0)) continue;
        scree_vtp vtp;
        // A cell has no boundary, and only a periodic sample has a cell.
        bool around = scenes[k].build == build_boundary || scenes[k].build == build_hull;
        if (scree_cell(state)->directions ? around : scenes[k].build == build_lattice) continue;
        status = scenes[k].build(&vtp, &from, error);
        if (!status) status = write_scene(&vtp, folder, scenes[k].kind, info, &all, error);
        scree_vtp_destroy(&vtp);
    }
    return status ? status : write_blocks(&all, folder, info, error);
}
