/// Spheres in files and figures: a snapshot, ParaView files and a checkpoint of a state in three dimensions, read back;
/// the view from outside and the section of it.
#include "boundary/membrane.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"
#include "view_testing.h"

#include "base/random.h"
#include "boundary/sheet.h"
#include "io/paraview.h"
#include "io/snapshot.h"
#include "io_sample.h"
#include "state_bits.h"
#include "view/projection.h"
#include "view/scene.h"

#include <sys/stat.h>

enum { SIDE = 5, HEIGHT = 10, COUNT = SIDE * SIDE * HEIGHT, CORNERS = 4 };
#define RADIUS 1e-3

static double uniform(uint64_t index)
{
    return scree_random_uniform(7, SCREE_RANDOM_TEST, index);
}

static void create_bodies(scree_state *state)
{
    assert_int_equal(scree_state_create(state, 3, COUNT, NULL), SCREE_OK);
    for (uint32_t row = 0; row < COUNT; row++) {
        uint32_t id = COUNT - 1 - row;
        state->id[row] = id;
        state->row_of_id[id] = row;
        state->row[row] = (scree_row){.x = RADIUS * (1 + 2 * (id % SIDE) + 0.3 * uniform(4 * id)),
                                      .y = RADIUS * (1 + 2 * (id / SIDE % SIDE) + 0.3 * uniform(4 * id + 1)),
                                      .z = RADIUS * (1 + 2 * (double)(id / (SIDE * SIDE))),
                                      .radius = RADIUS * (0.7 + 0.3 * uniform(4 * id + 2)),
                                      .vx = 0.1 * id,
                                      .vy = -0.2 * id,
                                      .vz = 0.3 + id,
                                      .mass = 1};
        state->turn[row] = (scree_turn_row){.wx = 3, .wy = 4 * uniform(4 * id + 3), .wz = 12, .material = id % 2};
        state->torque[row] = (scree_torque_row){.x = id, .y = -(int64_t)id, .z = 2 * (int64_t)id};
        scree_body_position(state, row, state->reference[row]);
    }
    state->step_size = 1e-6;
    scree_plates(state)[SCREE_WALL_BOTTOM] = (scree_wall){.normal = {0, 0, 1}, .active = 1};
    scree_plates(state)[SCREE_WALL_TOP] =
        (scree_wall){.normal = {0, 0, -1}, .position = -2.05e-3 * HEIGHT, .active = 1};
}

/// A tetrahedron is enough of a hull for a file.
static void create_hull(scree_hull *hull)
{
    static const uint32_t triangle[CORNERS][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    assert_int_equal(scree_allocate(&hull->id, CORNERS, sizeof *hull->id, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&hull->position, CORNERS, sizeof *hull->position, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&hull->force, CORNERS, sizeof *hull->force, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&hull->triangle, CORNERS, sizeof *hull->triangle, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&hull->loaded, CORNERS, sizeof *hull->loaded, NULL), SCREE_OK);
    hull->node_count = hull->node_capacity = hull->triangle_count = hull->triangle_capacity = CORNERS;
    hull->updated = 17;
    for (uint32_t k = 0; k < CORNERS; k++) {
        hull->id[k] = 5 * k;
        hull->position[k][2] = uniform(5000 + k);
        hull->force[k][1] = uniform(6000 + k);
        hull->loaded[k] = k % 2;
    }
    memcpy(hull->triangle, triangle, sizeof triangle);
}

/// Bodies above each other touch.
static void create_table(const scree_state *state, scree_contact_table *table)
{
    *table = (scree_contact_table){.count = COUNT - SIDE * SIDE};
    assert_int_equal(scree_allocate(&table->contact, table->count, sizeof *table->contact, NULL), SCREE_OK);
    for (uint32_t k = 0; k < table->count; k++) {
        scree_contact *contact = &table->contact[k];
        *contact = (scree_contact){.first = state->row_of_id[k],
                                   .second = state->row_of_id[k + SIDE * SIDE],
                                   .normal = {0, 0, -1},
                                   .tangent = {1, 0, 0},
                                   .normal_force = 4 * uniform(8000 + k) * uniform(9000 + k),
                                   .tangential_force = 0.5};
        scree_body_position(state, contact->first, contact->point);
    }
}

typedef struct solid {
    scree_state state;
    scree_contact_table table;
    scree_config config;
    scree_model model;
} solid;

static char name_3d[] = "solid";

static void create(solid *s)
{
    create_bodies(&s->state);
    create_hull(scree_hull_of(&s->state));
    create_table(&s->state, &s->table);
    s->config = (scree_config){.name = name_3d};
    s->model = sample_model(&s->config);
    s->model.dimension = 3;
}

static void destroy(solid *s)
{
    scree_state_destroy(&s->state);
    scree_release(&s->table.contact);
}

static void write_snapshot(solid *s)
{
    scree_error error;
    const scree_snapshot_info info = {.index = 0, .time = 1, .axial_strain = 0.05, .stage = "compress"};
    if (scree_snapshot_write(scratch, &s->model, &s->state, &s->table, &info, &error)) fail_msg("%s", error.message);
    if (scree_paraview_write(scratch, &s->model, &s->state, &s->table, &info, &error)) fail_msg("%s", error.message);
}

static void a_snapshot_of_spheres_comes_back(void **unused)
{
    (void)unused;
    solid s = {0};
    scree_snapshot snapshot;
    scree_error error;
    create(&s);
    write_snapshot(&s);
    if (scree_snapshot_read(scratch, 0, &snapshot, &error)) fail_msg("%s", error.message);
    assert_int_equal(snapshot.dimension, 3);
    assert_int_equal(snapshot.count, COUNT);
    assert_null(snapshot.angle);
    for (uint32_t id = 0; id < COUNT; id++) {
        uint32_t row = s.state.row_of_id[id];
        scree_vector velocity, spin;
        scree_body_velocity(&s.model, &s.state, row, velocity, spin);
        assert_true(snapshot.z[id] == s.state.row[row].z && snapshot.vz[id] == velocity[2]);
        assert_true(snapshot.spin[id] == scree_length(spin));
    }
    for (uint32_t k = 0; k < snapshot.contact_count; k++)
        assert_true(snapshot.contact_z[k] == s.table.contact[k].point[2]);
    assert_true(snapshot.wall[SCREE_WALL_TOP].normal[2] == -1);
    scree_snapshot_destroy(&snapshot);
    destroy(&s);
}

static void paraview_files_of_spheres_are_written(void **unused)
{
    (void)unused;
    solid s = {0};
    create(&s);
    write_snapshot(&s);
    static const char *const kinds[] = {"spheres", "contacts", "hull", "plates"};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        char path[256];
        struct stat found;
        (void)snprintf(path, sizeof path, "%s/paraview/%s-000000.vtp", scratch, kinds[k]);
        assert_int_equal(stat(path, &found), 0);
        assert_true(found.st_size > 1000);
    }
    assert_true(access("paraview/discs-000000.vtp", F_OK) != 0 && access("paraview/boundary-000000.vtp", F_OK) != 0);
    char *hull = read_whole("paraview/hull-000000.vtp");
    assert_non_null(strstr(hull, "NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"0\""));
    assert_non_null(strstr(hull, "NumberOfPolys=\"4\""));
    free(hull);
    destroy(&s);
}

static void a_checkpoint_of_spheres_comes_back(void **unused)
{
    (void)unused;
    solid s = {0};
    scree_state copy;
    create(&s);
    assert_int_equal(scree_checkpoint_write(scratch, &s.state, 1, NULL), SCREE_OK);
    assert_int_equal(scree_checkpoint_read(scratch, 2, &copy, 1, NULL), SCREE_ERROR_INPUT); // of discs
    assert_int_equal(scree_checkpoint_read(scratch, 3, &copy, 1, NULL), SCREE_OK);
    assert_true(state_bits(&copy) == state_bits(&s.state));
    scree_hull_of(&s.state)->force[2][1] += 1;
    assert_true(state_bits(&copy) != state_bits(&s.state));
    scree_state_destroy(&copy);
    destroy(&s);
}

static void draw(const char *name, const scree_snapshot *plane, const scree_scene *scene)
{
    scree_error error;
    char path[80];
    if (scree_scene_draw(name, plane, scene, &error)) fail_msg("%s", error.message);
    (void)snprintf(path, sizeof path, "%s.png", name);
    picture p = picture_read(path);
    assert_true(p.width > 100 && p.height > 100);
    cairo_surface_destroy(p.surface);
}

static void spheres_are_drawn(void **unused)
{
    (void)unused;
    solid s = {0};
    scree_snapshot snapshot, plane;
    scree_projection projection;
    create(&s);
    write_snapshot(&s);
    assert_int_equal(scree_snapshot_read(scratch, 0, &snapshot, NULL), SCREE_OK);
    assert_int_equal(scree_projection_create(&snapshot, &projection, NULL), SCREE_OK);
    // A view keeps lengths: the squares of the three coordinates add up as before.
    for (size_t k = 1; k < COUNT; k++) {
        double dx = snapshot.x[k] - snapshot.x[0], dy = snapshot.y[k] - snapshot.y[0],
               dz = snapshot.z[k] - snapshot.z[0];
        double px = projection.plane.x[k] - projection.plane.x[0], py = projection.plane.y[k] - projection.plane.y[0];
        double pz = projection.depth[k] - projection.depth[0], square = dx * dx + dy * dy + dz * dz;
        assert_true(fabs(px * px + py * py + pz * pz - square) < 1e-14 * square + 1e-20); // round-off
    }
    assert_true(projection.has_plate[0] && projection.has_plate[1]);
    scree_scene scene = {.title = "Spheres", .depth = projection.depth, .projection = &projection, .plates = true};
    draw("outside", &projection.plane, &scene);
    scene.field = snapshot.z;
    scene.field_name = "height (m)";
    draw("coloured", &projection.plane, &scene);
    scene.force_network = true;
    draw("forces", &projection.plane, &scene);
    assert_int_equal(scree_section_create(&snapshot, &plane, NULL), SCREE_OK);
    size_t cut = 0;
    for (size_t k = 0; k < COUNT; k++) cut += plane.radius[k] > 0;
    assert_true(cut > HEIGHT * SIDE / 2 && cut < 3 * HEIGHT * SIDE);
    draw(
        "section", &plane,
        &(scree_scene){
            .title = "Section", .section = true, .plates = true, .field = snapshot.spin, .field_name = "spin (rad/s)"});
    scree_snapshot_destroy(&plane);
    scree_projection_destroy(&projection);
    scree_snapshot_destroy(&snapshot);
    destroy(&s);
}

/// The last 30 spheres as a sheet of three rings.
static void wrap(solid *s)
{
    scree_membrane *membrane = scree_membrane_of(&s->state);
    for (uint32_t id = COUNT - 30; id < COUNT; id++) s->state.mark[s->state.row_of_id[id]] = SCREE_MARK_MEMBRANE;
    assert_int_equal(scree_state_find_rows(&s->state, NULL), SCREE_OK);
    membrane->first_id = COUNT - 30;
    membrane->around = 10;
    membrane->count = membrane->capacity = 30;
    assert_int_equal(scree_allocate(&membrane->rest, 30, sizeof *membrane->rest, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&membrane->press, 30, sizeof *membrane->press, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&membrane->force, 30, sizeof *membrane->force, NULL), SCREE_OK);
    for (size_t k = 0; k < 30; k++) membrane->rest[k][2] = uniform(300 + k);
}

static void a_sheet_is_written_and_drawn(void **unused)
{
    (void)unused;
    solid s = {0};
    scree_snapshot snapshot, plane;
    scree_projection projection;
    scree_state copy;
    create(&s);
    wrap(&s);
    write_snapshot(&s);
    assert_int_equal(scree_snapshot_read(scratch, 0, &snapshot, NULL), SCREE_OK);
    assert_int_equal(snapshot.grains, COUNT - 30);
    assert_int_equal(snapshot.triangle_count, 40);
    for (size_t t = 0; t < 40; t++)
        for (int c = 0; c < 3; c++) {
            size_t corner[3];
            scree_sheet_triangle(10, 30, t, corner);
            assert_int_equal(snapshot.triangle[t][c], COUNT - 30 + corner[c]);
        }
    char *file = read_whole("paraview/membrane-000000.vtp");
    assert_non_null(strstr(file, "NumberOfPoints=\"30\""));
    assert_non_null(strstr(file, "NumberOfPolys=\"40\""));
    free(file);
    // As a net, not as spheres: the grains alone are counted and seen.
    assert_int_equal(scree_projection_create(&snapshot, &projection, NULL), SCREE_OK);
    assert_int_equal(projection.plane.triangle_count, 40);
    scree_scene scene = {.title = "Sheet", .depth = projection.depth, .projection = &projection, .plates = true};
    draw("net", &projection.plane, &scene);
    picture net = picture_read("net.png");
    projection.plane.triangle_count = 0;
    draw("spheres", &projection.plane, &scene);
    picture spheres = picture_read("spheres.png");
    projection.plane.triangle_count = 40;
    assert_true(net.width == spheres.width && net.height == spheres.height);
    size_t stride = (size_t)cairo_image_surface_get_stride(net.surface) * (size_t)net.height;
    assert_true(
        memcmp(cairo_image_surface_get_data(net.surface), cairo_image_surface_get_data(spheres.surface), stride) != 0);
    cairo_surface_destroy(net.surface);
    cairo_surface_destroy(spheres.surface);
    assert_int_equal(scree_section_create(&snapshot, &plane, NULL), SCREE_OK);
    assert_int_equal(plane.grains, COUNT - 30);
    draw("cut", &plane, &(scree_scene){.title = "Section", .section = true, .plates = true});
    scree_snapshot_destroy(&plane);
    scree_projection_destroy(&projection);
    scree_snapshot_destroy(&snapshot);
    // And it is part of a checkpoint.
    assert_int_equal(scree_checkpoint_write(scratch, &s.state, 1, NULL), SCREE_OK);
    assert_int_equal(scree_checkpoint_read(scratch, 3, &copy, 1, NULL), SCREE_OK);
    assert_true(state_bits(&copy) == state_bits(&s.state) && scree_membrane_of(&copy)->around == 10);
    scree_membrane_of(&s.state)->rest[7][2] += 1;
    assert_true(state_bits(&copy) != state_bits(&s.state));
    scree_state_destroy(&copy);
    destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_snapshot_of_spheres_comes_back, enter_scratch, leave_scratch),
        cmocka_unit_test_setup_teardown(paraview_files_of_spheres_are_written, enter_scratch, leave_scratch),
        cmocka_unit_test_setup_teardown(a_checkpoint_of_spheres_comes_back, enter_scratch, leave_scratch),
        cmocka_unit_test_setup_teardown(spheres_are_drawn, enter_scratch, leave_scratch),
        cmocka_unit_test_setup_teardown(a_sheet_is_written_and_drawn, enter_scratch, leave_scratch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
