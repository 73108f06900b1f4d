/// Contacts with the walls of a case against closed forms.
#include "state/case_walls.h"
#include "wall_fixture.h"

static const double R = 1e-3, G = 10;

/// One sphere at rest at a place.
static void put(world *w, double x, double y, double z)
{
    sphere s = {.radius = R, .place = {x, y, z}};
    sphere_set(&w->f, 0, &s);
}

static void set_gravity(world *w, double x, double y, double z)
{
    w->f.model.gravity[0] = x;
    w->f.model.gravity[1] = y;
    w->f.model.gravity[2] = z;
}

/// Two triangles a cell of a grid in the plane z = height, cells of different widths.
static size_t make_floor(triangle_corners *triangle, int cells, double width, double height)
{
    size_t count = 0;
    for (int i = 0; i < cells; i++)
        for (int j = 0; j < cells; j++) {
            double x[2], y[2];
            for (int e = 0; e < 2; e++) {
                x[e] = width * (i + e - 0.5 * cells + 0.3 * sin(3.0 * (i + e)));
                y[e] = width * (j + e - 0.5 * cells + 0.3 * sin(5.0 * (j + e)));
            }
            const double corner[4][3] = {
                {x[0], y[0], height}, {x[1], y[0], height}, {x[1], y[1], height}, {x[0], y[1], height}};
            const int order[2][3] = {{0, 1, 2}, {0, 2, 3}};
            for (int t = 0; t < 2; t++, count++)
                for (int c = 0; c < 3; c++) memcpy(triangle[count][c], corner[order[t][c]], sizeof corner[0]);
        }
    return count;
}

/// The twelve triangles of a box.
static size_t make_box(triangle_corners *triangle, const double low[3], const double high[3])
{
    size_t count = 0;
    for (int axis = 0; axis < 3; axis++)
        for (int end = 0; end < 2; end++)
            for (int t = 0; t < 2; t++, count++)
                for (int c = 0; c < 3; c++) {
                    static const int square[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
                    int a = (axis + 1) % 3, b = (axis + 2) % 3;
                    triangle[count][c][axis] = end ? high[axis] : low[axis];
                    triangle[count][c][a] = square[t][c][0] ? high[a] : low[a];
                    triangle[count][c][b] = square[t][c][1] ? high[b] : low[b];
                }
    return count;
}

/// A sphere settles on `wall` from the given place; the wall then bears its weight, and nothing else.
static void check_rest(world *w, double x, double y, double z, double above)
{
    world_start(w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 2e-6);
    double weight = fixture_mass(&w->f.model, 0, R) * G, d = world_rest(w, R, G);
    set_gravity(w, 0, 0, -G);
    put(w, x, y, z + above - 0.5 * d);
    world_begin(w);
    world_run(w, 20000);
    const scree_surface_load *load = &scree_case_walls(&w->f.state)->load[0];
    // Oscillations have died out to exp(-damping rate x time); what is left is round-off of positions over d, 1e-9.
    assert_near(load->force[2], -weight, 1e-7 * weight);
    assert_near(load->force[0], 0, 1e-7 * weight);
    assert_near(load->force[1], 0, 1e-7 * weight);
    assert_near(w->f.state.row[0].z, z + above - d, 1e-6 * d);
    size_t contacts;
    scree_energy energy = world_energy(w, &contacts);
    assert_int_equal(contacts, 1);
    assert_true(energy.relative < 1e-3);
    world_close(w);
}

static void test_rest_on_each_shape(void **state)
{
    (void)state;
    world w = {0};
    world_keys *wall = world_wall(&w, SCREE_SLOT_plane);
    wall->normal[2] = 3;
    wall->point[2] = 0.25;
    check_rest(&w, 0.1, 0.2, 0.25, R);

    wall = world_wall(&w, SCREE_SLOT_box);
    for (int k = 0; k < 3; k++) wall->lower[k] = -0.01, wall->upper[k] = 0.01;
    check_rest(&w, 0.001, 0.002, -0.01, R);

    wall = world_wall(&w, SCREE_SLOT_box);
    wall->side = SCREE_SIDE_OUTSIDE;
    for (int k = 0; k < 3; k++) wall->lower[k] = -0.01, wall->upper[k] = 0.01;
    check_rest(&w, 0.001, 0.002, 0.01, R);

    wall = world_wall(&w, SCREE_SLOT_cylinder); // lies, bodies inside
    wall->start[1] = -0.02, wall->end[1] = 0.02, wall->radius = 0.01;
    check_rest(&w, 0, 0.003, -0.01, R);

    wall = world_wall(&w, SCREE_SLOT_cylinder); // stands, on its end
    wall->start[2] = -0.02, wall->end[2] = 0.02, wall->radius = 0.01;
    check_rest(&w, 0.001, 0.003, -0.02, R);

    wall = world_wall(&w, SCREE_SLOT_cylinder); // stands, bodies on top
    wall->side = SCREE_SIDE_OUTSIDE;
    wall->start[2] = -0.02, wall->end[2] = 0.02, wall->radius = 0.01;
    check_rest(&w, 0.001, 0.003, 0.02, R);

    wall = world_wall(&w, SCREE_SLOT_cone); // cut off, stands on the small end
    wall->start[2] = 0, wall->end[2] = 0.02, wall->radius_start = 0.004, wall->radius_end = 0.01;
    check_rest(&w, 0.001, 0.001, 0, R);

    static triangle_corners triangle[64];
    (void)world_mesh(&w, (const triangle_corners *)triangle, make_floor(triangle, 3, 0.004, 0.0078125));
    check_rest(&w, 0.0001, 0.0002, 0.0078125, R);
    (void)unlink(w.wall[0].file ? w.wall[0].file : "");
}

/// Force on a sphere at (x, y, z) near one wall, its direction and its magnitude in units of the law.
static void check_direction(world *w, const double place[3], const double from[3])
{
    double direction[3], distance = 0, force[3], torque[3];
    for (int k = 0; k < 3; k++) direction[k] = place[k] - from[k];
    for (int k = 0; k < 3; k++) distance += direction[k] * direction[k];
    distance = sqrt(distance);
    w->f.work.valid = false;
    put(w, place[0], place[1], place[2]);
    world_forces(w);
    sphere_force(&w->f, 0, force, torque);
    double expected = w->f.model.walls[0].value[HERTZ_NORMAL] * sqrt(R) * pow(R - distance, 1.5);
    assert_int_equal(w->f.state.sum[0].contacts, 1);
    // Overlaps are differences of numbers of the size of a centimetre: 1e-16 x 1e-2 / 1e-5, and quanta.
    for (int k = 0; k < 3; k++) assert_near(force[k], expected * direction[k] / distance, 1e-9 * expected);
}

/// On a face, an edge and a vertex of a cube: one contact each, with the force from the closest point.
static void check_cube(world *w)
{
    world_start(w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 1e-6);
    const double h = 0.01, d = 0.99 * R;
    const double on_face[3] = {0.003, 0.001, h + d}, face[3] = {0.003, 0.001, h};
    check_direction(w, on_face, face);
    const double on_diagonal[3] = {0, 0, h + d}, middle[3] = {0, 0, h};
    check_direction(w, on_diagonal, middle);
    const double on_edge[3] = {h + 0.6 * d, 0.002, h + 0.8 * d}, edge[3] = {h, 0.002, h};
    check_direction(w, on_edge, edge);
    const double on_vertex[3] = {h + 0.6 * d, h + 0.48 * d, h + 0.64 * d}, vertex[3] = {h, h, h};
    check_direction(w, on_vertex, vertex);
    // Just beside the edge, over the face: still one contact.
    const double beside[3] = {h - 1e-9, 0.002, h + d}, foot[3] = {h - 1e-9, 0.002, h};
    check_direction(w, beside, foot);
    world_close(w);
}

static void test_edges_and_vertices(void **state)
{
    (void)state;
    world w = {0};
    static triangle_corners triangle[12];
    const double low[3] = {-0.01, -0.01, -0.01}, high[3] = {0.01, 0.01, 0.01};
    world_keys *wall = world_wall(&w, SCREE_SLOT_box);
    wall->side = SCREE_SIDE_OUTSIDE;
    memcpy(wall->lower, low, sizeof low);
    memcpy(wall->upper, high, sizeof high);
    check_cube(&w);
    wall = world_mesh(&w, (const triangle_corners *)triangle, make_box(triangle, low, high));
    // Single precision of the file moves the corners by 1e-9: scaled powers of two do not.
    for (int t = 0; t < 12; t++)
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++) triangle[t][c][k] = triangle[t][c][k] > 0 ? 1 : -1;
    write_stl(wall->file, (const triangle_corners *)triangle, 12, 1);
    wall->scale = 0.01;
    check_cube(&w);
}

/// Deep in a flat mesh, where edges and vertices around are within reach and seen under angles well above `smooth`:
/// still one contact, the face's.
static void test_deep_contact(void **state)
{
    (void)state;
    world w = {0};
    static triangle_corners triangle[64];
    world_keys *wall = world_mesh(&w, (const triangle_corners *)triangle, make_floor(triangle, 4, 1.2e-3, 0.0078125));
    char *file = wall->file;
    world_start(&w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 1e-6);
    for (uint64_t k = 0; k < 500; k++) {
        double x = 2e-3 * (fixture_random(2 * k) - 0.5), y = 2e-3 * (fixture_random(2 * k + 1) - 0.5), depth = 0.15 * R;
        double force[3], torque[3], expected = w.f.model.walls[0].value[HERTZ_NORMAL] * sqrt(R) * pow(depth, 1.5);
        w.f.work.valid = false;
        put(&w, x, y, 0.0078125 + R - depth);
        world_forces(&w);
        sphere_force(&w.f, 0, force, torque);
        assert_int_equal(w.f.state.sum[0].contacts, 1);
        // Overlaps are differences of numbers of the size of a centimetre: 1e-16 x 1e-2 / 1e-4.
        assert_near(force[2], expected, 1e-12 * expected);
        assert_near(hypot(force[0], force[1]), 0, 1e-12 * expected);
    }
    (void)unlink(file);
    world_close(&w);
}

/// A sphere in the corner of a mesh touches three faces, and each contact has its own spring.
static void test_concave_corner(void **state)
{
    (void)state;
    world w = {0};
    static triangle_corners triangle[12];
    const double low[3] = {0, 0, 0}, high[3] = {0.0625, 0.0625, 0.0625};
    (void)world_mesh(&w, (const triangle_corners *)triangle, make_box(triangle, low, high));
    world_start(&w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 1e-7);
    double d = 0.99 * R, force[3], torque[3];
    put(&w, d, 0.03, d);
    w.f.state.row[0].vy = 1e-3; // along both faces
    world_begin(&w);
    assert_int_equal(w.f.state.sum[0].contacts, 2);
    sphere_force(&w.f, 0, force, torque);
    double expected = w.f.model.walls[0].value[HERTZ_NORMAL] * sqrt(R) * pow(R - d, 1.5);
    assert_near(force[0], expected, 1e-9 * expected);
    assert_near(force[2], expected, 1e-9 * expected);
    int springs = 0;
    for (size_t p = 0; p < w.f.work.primitive_pairs.count; p++)
        springs += w.f.work.primitive_pairs.history[p].value[1] != 0;
    assert_int_equal(springs, 2);
    // The vertex of three faces.
    put(&w, d, d, d);
    w.f.work.valid = false;
    world_forces(&w);
    assert_int_equal(w.f.state.sum[0].contacts, 3);
    world_close(&w);
}

/// Trajectory of a sphere on an inclined plane, as a plane or as triangles; friction decides whether it rolls or
/// slides.
static void roll(world *w, law_choice law, double friction, int steps, double end[8])
{
    world_start(w, 3, law, SCREE_SLOT_velocity_verlet, 1, 2e-6);
    w->f.model.walls[0].value[SCREE_FRICTION] = friction;
    set_gravity(w, G * sin(0.3) * cos(0.5), G * sin(0.3) * sin(0.5), -G * cos(0.3));
    put(w, -0.0031, -0.0017, R - world_rest(w, R, G * cos(0.3)));
    world_begin(w);
    world_run(w, steps);
    const scree_row *row = &w->f.state.row[0];
    const scree_turn_row *turn = &w->f.state.turn[0];
    scree_energy energy = world_energy(w, NULL);
    const double values[8] = {row->x, row->y, row->z, row->vx, row->vy, turn->wx, turn->wy, energy.residual};
    memcpy(end, values, sizeof values);
    // The trapezoid along the force law: third order in the step.
    assert_near(energy.residual, 0, 1e-9 * energy.kinetic);
    world_close(w);
}

/// Velocity after a time in which a sphere slid down the plane: friction is mu N (slip / v_R)^(1/c) with
/// hertz_brilliantov, without the power else; slip' = g sin a - 7/2 friction / m.
static double slide(const scree_model *model, law_choice law, double friction, double time)
{
    const int steps = 10000;
    double slip = 0, velocity = 0;
    for (int k = 0; k < steps; k++) {
        double power = law == HERTZ_MINDLIN || slip == 0
                           ? 1
                           : pow(slip / model->reference_velocity, model->laws[0].number[BRILLIANTOV_INVERSE_EXPONENT]);
        double held = friction * G * cos(0.3) * power;
        velocity += time / steps * (G * sin(0.3) - held);
        slip += time / steps * (G * sin(0.3) - 3.5 * held);
    }
    return velocity;
}

/// The same trajectory on triangles as on a plane, rolling (5/7 g sin a) and sliding: over 17 edges there is no kick,
/// and the spring survives each change.
static void test_triangulated_plane(void **state)
{
    (void)state;
    static triangle_corners triangle[800];
    const double friction[2] = {0.5, 0.05};
    const int steps = 40000;
    for (int k = 0; k < 4; k++) {
        law_choice law = k / 2 ? HERTZ_BRILLIANTOV : HERTZ_MINDLIN;
        double plane[8], mesh[8], time = steps * 2e-6;
        world w = {0};
        world_wall(&w, SCREE_SLOT_plane)->normal[2] = 1;
        roll(&w, law, friction[k % 2], steps, plane);
        (void)world_mesh(&w, (const triangle_corners *)triangle, make_floor(triangle, 20, 0.001, 0));
        char *file = w.wall[0].file;
        roll(&w, law, friction[k % 2], steps, mesh);
        (void)unlink(file);
        // Normals of triangles are good to 1e-16, and forces to 1e-15.
        for (int i = 0; i < 7; i++) assert_near(mesh[i], plane[i], 1e-10 * fmax(fabs(plane[i]), 1e-3));
        const scree_model model = fixture_model(law);
        double expected = k % 2 == 0 ? 5.0 / 7 * G * sin(0.3) * time : slide(&model, law, friction[1], time);
        double reached = hypot(plane[3], plane[4]);
        // The begin of rolling takes a few hundred steps; levers are shorter by half the overlap, 1e-3.
        assert_near(reached, expected, 2e-3 * expected);
    }
}

/// Small oscillations at the bottom of a cylinder: sqrt((Rc - R) / g) without friction, times sqrt(7/5) when it rolls.
static void test_oscillation(void **state)
{
    (void)state;
    for (int rolls = 0; rolls < 2; rolls++) {
        world w = {0};
        world_keys *wall = world_wall(&w, SCREE_SLOT_cylinder);
        wall->start[1] = -0.02, wall->end[1] = 0.02, wall->radius = 0.01;
        wall->friction = rolls ? 1 : 0;
        world_start(&w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 2e-6);
        set_gravity(&w, 0, 0, -G);
        double length = 0.01 - R + world_rest(&w, R, G), angle = 0.05;
        put(&w, length * sin(angle), 0, -length * cos(angle));
        world_begin(&w);
        int crossings = 0, last = 0, first = 0;
        for (int k = 0; k < 400000 && crossings < 5; k++) {
            double before = w.f.state.row[0].x;
            world_step(&w);
            if ((before < 0) == (w.f.state.row[0].x < 0)) continue;
            if (crossings++ == 0) first = k;
            last = k;
        }
        assert_int_equal(crossings, 5);
        double period = (last - first) * 2e-6 / 2, expected = 2 * M_PI * sqrt(length / G * (rolls ? 1.4 : 1));
        // Amplitude: 1 + angle^2 / 16 = 1.6e-4; the contact gives way by the tangential spring and the overlap.
        assert_near(period, expected, 2e-3 * expected);
        scree_energy energy = world_energy(&w, NULL);
        // The trapezoid along the force law, third order in the step: see the same on one plane in the tests of planes.
        assert_near(energy.residual, 0, 1e-7 * w.f.state.row[0].mass * G * length * (1 - cos(angle)));
        world_close(&w);
    }
}

/// A plane that moves pushes a sphere: its work is the energy that the sphere has.
static void test_moving_wall(void **state)
{
    (void)state;
    for (int mesh = 0; mesh < 2; mesh++) {
        world w = {0};
        static triangle_corners triangle[64];
        world_keys *wall = mesh ? world_mesh(&w, (const triangle_corners *)triangle, make_floor(triangle, 3, 0.01, 0))
                                : world_wall(&w, SCREE_SLOT_plane);
        wall->normal[2] = 1;
        wall->velocity[2].value = 0.05;
        wall->velocity[0].value = 0.02; // drags, too
        char *file = wall->file;
        world_start(&w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 2e-7);
        scree_case_walls(&w.f.state)->moving = 1;
        put(&w, 0.001, 0.002, R + 1e-6);
        world_begin(&w);
        world_run(&w, 4000);
        // It has left the wall, with a restitution between 0 and 1 of twice the velocity of the wall.
        assert_int_equal(w.f.state.sum[0].contacts, 0);
        assert_true(w.f.state.row[0].vz > 0.05 && w.f.state.row[0].vz < 0.1);
        scree_energy energy = world_energy(&w, NULL);
        double work = scree_case_walls(&w.f.state)->load[0].work;
        assert_near(work, w.f.state.ledger.plates, 1e-15 * work);
        // Momentum that it got times the velocity of the wall; quanta.
        double mass = w.f.state.row[0].mass;
        assert_near(work, mass * (w.f.state.row[0].vz * 0.05 + w.f.state.row[0].vx * 0.02), 1e-9 * work);
        assert_near(energy.residual, 0, 1e-3 * work);
        world_close(&w);
        if (file) (void)unlink(file);
    }
}

/// A drum drags a sphere along: torque times spin is its power, and the angular momentum about its axis changes by the
/// torque of the wall and of gravity.
static void test_spinning_drum(void **state)
{
    (void)state;
    world w = {0};
    world_keys *wall = world_wall(&w, SCREE_SLOT_cylinder);
    wall->start[1] = -0.02, wall->end[1] = 0.02, wall->radius = 0.01;
    wall->spin[1] = 3;
    world_start(&w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 2e-7);
    scree_case_walls(&w.f.state)->moving = 1;
    put(&w, 0, 0, -0.01 + R - 1e-6);
    world_begin(&w);
    double momentum = 0;
    for (int k = 0; k < 5000; k++) {
        double before = scree_case_walls(&w.f.state)->load[0].torque[1];
        world_step(&w);
        momentum -= 0.5 * w.f.state.step_size * (before + scree_case_walls(&w.f.state)->load[0].torque[1]);
    }
    const scree_row *row = &w.f.state.row[0];
    double spin = 0.4 * row->mass * R * R * w.f.state.turn[0].wy;
    double orbit = row->mass * (row->z * row->vx - row->x * row->vz);
    // The trapezoid of the torque over steps of 2e-7 s.
    assert_near(momentum, spin + orbit, 1e-4 * fabs(spin + orbit));
    assert_true(fabs(momentum) > 0);
    assert_near(scree_case_walls(&w.f.state)->load[0].work, 3 * momentum, 1e-9 * fabs(3 * momentum));
    // A drum that turns about its axis is nowhere else: no neighbour list is built for it.
    assert_true(scree_wall_set_way(w.f.work.wall_set, 1, R) == 0);
    scree_energy energy = world_energy(&w, NULL);
    assert_near(energy.residual, 0, 1e-3 * w.f.state.ledger.turnover);
    world_close(&w);
}

/// The same drum as 48 flat pieces: one contact at a time, its spring passes from piece to piece.
static void test_faceted_drum(void **state)
{
    (void)state;
    world w = {0};
    enum { PIECES = 48 };
    static triangle_corners triangle[2 * PIECES];
    for (int k = 0; k < PIECES; k++) {
        const double a = 2 * M_PI * k / PIECES, b = 2 * M_PI * (k + 1) / PIECES;
        const double corner[4][3] = {{0.01 * sin(a), -0.02, 0.01 * cos(a)},
                                     {0.01 * sin(b), -0.02, 0.01 * cos(b)},
                                     {0.01 * sin(b), 0.02, 0.01 * cos(b)},
                                     {0.01 * sin(a), 0.02, 0.01 * cos(a)}};
        const int order[2][3] = {{0, 1, 2}, {0, 2, 3}};
        for (int t = 0; t < 2; t++)
            for (int c = 0; c < 3; c++) memcpy(triangle[2 * k + t][c], corner[order[t][c]], sizeof corner[0]);
    }
    world_keys *wall = world_mesh(&w, (const triangle_corners *)triangle, 2 * PIECES);
    char *file = wall->file;
    wall->spin[1] = -5;
    world_start(&w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 2e-6);
    set_gravity(&w, 0, 0, -G);
    scree_case_walls(&w.f.state)->moving = 1;
    put(&w, 0, 0.001, -0.01 * cos(M_PI / PIECES) + R - world_rest(&w, R, G));
    world_begin(&w);
    size_t most = 0, contacts = 0;
    for (int k = 0; k < 40; k++) {
        world_run(&w, 1000);
        scree_energy energy = world_energy(&w, &contacts);
        most = contacts > most ? contacts : most;
        assert_true(energy.relative < 1e-2);
    }
    assert_int_equal(most, 1);
    assert_true(w.f.work.rebuilds > 3);
    (void)unlink(file);
    world_close(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rest_on_each_shape), cmocka_unit_test(test_edges_and_vertices),
        cmocka_unit_test(test_deep_contact),       cmocka_unit_test(test_concave_corner),
        cmocka_unit_test(test_triangulated_plane), cmocka_unit_test(test_oscillation),
        cmocka_unit_test(test_moving_wall),        cmocka_unit_test(test_spinning_drum),
        cmocka_unit_test(test_faceted_drum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
