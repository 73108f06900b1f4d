/// Periodic directions in any choice, with plates, walls of the case or nothing in the others, in 2D and 3D: the motion
/// does not know where the faces are, momentum is exact, threads and lost work do not show, energy is kept; what cannot
/// be is refused by name.
#include "run_fixture.h"

#include "io_scratch.h"
#include "simulation_cases.h"
#include "state/periodic.h"
#include "state/plates.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define HEAD                                                                                                           \
    "scree: 1\n"                                                                                                       \
    "name: small\n"                                                                                                    \
    "seed: 3\n"                                                                                                        \
    "materials:\n"                                                                                                     \
    "  - {name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.4, wall_friction: 0, restitution: "     \
    "0.5}\n"                                                                                                           \
    "contact: {law: hertz_mindlin}\n"                                                                                  \
    "integrator: {scheme: velocity_verlet, step_fraction: 0.1}\n"                                                      \
    "measure: {samples: 20, cells: no}\n"                                                                              \
    "output: {snapshots: 2, paraview: no, figures: no}\n"
#define STAGES(fraction)                                                                                               \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: gas, aspect_ratio: 1, solid_fraction: " fraction ", velocity: 0.5 m/s}\n"            \
    "  - {stage: relax, duration: 30 ms}\n"
static const char *const texts[] = {
    HEAD "dimension: 2\n"
         "particles: {shape: disc, material: glass, count: 60, radius_min: 0.5 mm, radius_max: 1 mm}\n" STAGES("45 %"),
    HEAD
    "dimension: 3\n"
    "particles: {shape: sphere, material: glass, count: 90, radius_min: 0.7 mm, radius_max: 1 mm}\n" STAGES("25 %"),
};

/// A cell of all directions: relax needs something that stands.
static const char grown_text[] =
    HEAD "particles: {shape: disc, material: glass, count: 60, radius_min: 0.5 mm, radius_max: 1 mm}\n"
         "stages:\n"
         "  - {stage: prepare, method: gas, aspect_ratio: 1, solid_fraction: 45 %}\n"
         "  - {stage: confine, pressure: 1 kPa}\n";

typedef struct combination {
    int dimension;
    const char *periodic, *boundary;
} combination;

static const combination combinations_of[] = {
    {2, "x", "plates"}, {2, "x", "walls"},  {2, "x", "none"},  {2, "y", "plates"},  {2, "y", "walls"},
    {2, "y", "none"},   {3, "x", "plates"}, {3, "x", "walls"}, {3, "y", "none"},    {3, "z", "plates"},
    {3, "z", "walls"},  {3, "xy", "walls"}, {3, "xy", "none"}, {3, "xz", "plates"}, {3, "yz", "plates"},
    {3, "yz", "none"},  {3, "xy", "plates"}};
enum { ALL = sizeof combinations_of / sizeof *combinations_of };

/// Sides of the box [m], as its plates say.
static void sides_of(const scree_state *state, double side[3])
{
    scree_vector low, high;
    scree_periodic_box(state->dimension, scree_plates(state), low, high);
    for (int k = 0; k < 3; k++) side[k] = high[k] - low[k];
}

/// Two planes across every direction that does not repeat, where the plates of the box would stand.
static void write_walls(const combination *of, const double side[3], char *text, size_t size)
{
    size_t length = (size_t)snprintf(text, size, "walls=[");
    for (int k = 0; k < of->dimension; k++) {
        if (strchr(of->periodic, "xyz"[k])) continue;
        for (int end = 0; end < 2; end++)
            length +=
                (size_t)snprintf(text + length, size - length,
                                 "%s{shape: plane, name: %c%d, point: [%.17g, %.17g, %.17g], normal: [%d, %d, %d]}",
                                 length > 7 ? ", " : "", "xyz"[k], end, k == 0 && end ? side[0] : 0.0,
                                 k == 1 && end ? side[1] : 0.0, k == 2 && end ? side[2] : 0.0, k == 0 ? 1 - 2 * end : 0,
                                 k == 1 ? 1 - 2 * end : 0, k == 2 ? 1 - 2 * end : 0);
    }
    (void)snprintf(text + length, size - length, "]");
}

/// The case of a combination, with up to two more overrides.
static scree_case *case_of(const combination *of, const char *more, const char *yet)
{
    char periodic[64], boundary[64], walls[1024];
    const char *overrides[5] = {periodic, boundary, more, yet};
    const char *text = texts[of->dimension - 2];
    double side[3];
    size_t count = yet ? 4 : more ? 3 : 2;
    scree_simulation box;
    (void)snprintf(periodic, sizeof periodic, "boundary.periodic=%s", of->periodic);
    (void)snprintf(boundary, sizeof boundary, "stages.relax.boundary=%s", of->boundary);
    if (strcmp(of->boundary, "walls") != 0) return case_read(text, overrides, count);
    scree_case *c = case_read(text, overrides, 1);
    simulation_open(c, 1, &box);
    simulation_step(&box);
    sides_of(&box.state, side);
    scree_simulation_close(&box);
    scree_case_free(c);
    write_walls(of, side, walls, sizeof walls);
    overrides[count] = walls;
    return case_read(text, overrides, count + 1);
}

/// To the begin of the loading; then all bodies half a period along the directions that repeat, and back into the cell.
static void begin(const scree_case *c, bool shifted, scree_simulation *s)
{
    simulation_open(c, 1, s);
    simulation_load(s);
    scree_state *state = &s->state;
    assert_int_equal(scree_cell(state)->directions, c->config.boundary.periodic);
    for (size_t row = 0; row < state->count && shifted; row++) {
        double *const at[3] = {&state->row[row].x, &state->row[row].y, &state->row[row].z};
        for (int k = 0; k < state->dimension; k++) {
            if (!scree_periodic_repeats(scree_cell(state), k)) continue;
            double side = scree_cell(state)->lattice[4 * k];
            *at[k] += *at[k] < side / 2 ? side / 2 : -side / 2;
        }
    }
    scree_neighbours_invalidate(&s->work);
}

/// A sum of all forces along directions in which nothing stands is zero to the last quantum: plates and walls have no
/// friction here. Returns whether what stands in the others pushes.
static bool assert_balanced(const scree_simulation *s, const combination *of)
{
    bool pushed = false;
    int64_t sum[3] = {0};
    for (size_t row = 0; row < s->state.count; row++) {
        const scree_sum_row *of_row = &s->state.sum[row];
        sum[0] += of_row->fx;
        sum[1] += of_row->fy;
        if (of->dimension == 3) sum[2] += of_row->fz;
    }
    for (int k = 0; k < of->dimension; k++) {
        if (strchr(of->periodic, "xyz"[k]) || strcmp(of->boundary, "none") == 0) assert_int_equal(sum[k], 0);
        pushed = pushed || sum[k] != 0;
    }
    return pushed;
}

/// Bodies that touch a ghost, counted by those whose list of neighbours has one that touches.
static size_t touching_ghosts(const scree_simulation *s)
{
    size_t found = 0;
    const scree_pair_list *pairs = &s->work.pairs;
    for (size_t k = 0; k < pairs->count; k++) {
        const scree_row *a = &s->state.row[pairs->first[k]], *b = &s->state.row[pairs->second[k]];
        double x = a->x - b->x, y = a->y - b->y, z = s->state.dimension == 3 ? a->z - b->z : 0;
        bool ghost = pairs->first[k] >= s->state.count || pairs->second[k] >= s->state.count;
        found += ghost && x * x + y * y + z * z < (a->radius + b->radius) * (a->radius + b->radius);
    }
    return found;
}

/// Largest difference of positions [m], apart from the shift.
static double difference(const scree_simulation *one, const scree_simulation *other)
{
    double largest = 0;
    for (size_t id = 0; id < one->state.count; id++) {
        scree_vector a, b;
        scree_body_position(&one->state, scree_state_row_of(&one->state, id), a);
        scree_body_position(&other->state, scree_state_row_of(&other->state, id), b);
        for (int k = 0; k < one->state.dimension; k++) {
            double away = b[k] - a[k], side = scree_cell(&one->state)->lattice[4 * k] / 2;
            if (scree_periodic_repeats(scree_cell(&one->state), k)) away -= side * rint(away / side);
            largest = fmax(largest, fabs(away));
        }
    }
    return largest;
}

/// Round-off of positions, 1e-18 m, grows some ten times with each impact; each body has about four.
static void faces_may_lie_anywhere(void **unused)
{
    (void)unused;
    for (int k = 0; k < ALL; k++) {
        const combination *of = &combinations_of[k];
        scree_case *c = case_of(of, NULL, NULL);
        scree_simulation s[2];
        size_t across = 0, pushed = 0;
        for (int n = 0; n < 2; n++) begin(c, n == 1, &s[n]);
        for (int step = 0; step < 2500; step++) {
            for (int n = 0; n < 2; n++) simulation_step(&s[n]);
            for (int n = 0; n < 2 && step % 20 == 0; n++) pushed += assert_balanced(&s[n], of);
            if (step % 10 == 0) across += touching_ghosts(&s[0]);
        }
        double apart = difference(&s[0], &s[1]);
        print_message("%dD, periodic in %s, %s: apart by %.2g m, %zu touches across faces\n", of->dimension,
                      of->periodic, of->boundary, apart, across);
        assert_true(across > 0 && (pushed > 0) == (strcmp(of->boundary, "none") != 0));
        assert_true(apart < 1e-11);
        uint32_t standing = 0, wanted = strcmp(of->boundary, "plates") == 0 ? scree_periodic_plates(&s[0].state) : 0;
        for (int w = 0; w < 2 * of->dimension; w++)
            standing |= (uint32_t)(scree_plates(&s[0].state)[w].active != 0) << w;
        assert_int_equal(standing, wanted);
        for (int n = 0; n < 2; n++) scree_simulation_close(&s[n]);
        scree_case_free(c);
    }
}

static uint64_t bits_of(const scree_case *c, int threads, uint64_t discard)
{
    scree_simulation s;
    scree_error error;
    simulation_open(c, threads, &s);
    s.work.keep_threads = true;
    simulation_load(&s);
    for (uint64_t step = 1; step <= 200; step++) {
        simulation_step(&s);
        if (discard == 0 || step % discard != 0) continue;
        simulation_lose_work(&s, threads);
        check(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), &error);
    }
    return simulation_close(&s);
}

static void threads_and_lost_work_do_not_show(void **unused)
{
    (void)unused;
    for (int k = 0; k < ALL; k += 2) {
        scree_case *c = case_of(&combinations_of[k], NULL, NULL);
        uint64_t bits = bits_of(c, 1, 0);
        assert_true(bits_of(c, 3, 0) == bits);
        assert_true(bits_of(c, 1, 47) == bits);
        scree_case_free(c);
    }
}

static void restart_gives_the_same_bits(void **unused)
{
    (void)unused;
    char folder[64], whole[96], part[96];
    assert_true(scratch_create(folder));
    (void)snprintf(whole, sizeof whole, "%s/whole", folder);
    (void)snprintf(part, sizeof part, "%s/part", folder);
    for (int k = 0; k < ALL; k += 5) {
        scree_case *c = case_of(&combinations_of[k], "output.checkpoint_steps=3000", NULL);
        run_restart(c, whole, part, 2, "stage prepare ended");
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

/// Elastic spheres without friction between walls that stand: all energy is that of the motion and the contacts.
static void a_dilute_gas_keeps_its_energy(void **unused)
{
    (void)unused;
    static const combination kinds[] = {{3, "x", "walls"}, {3, "z", "plates"}, {3, "yz", "walls"}};
    for (int k = 0; k < 3; k++) {
        scree_case *c = case_of(&kinds[k], "materials.glass.friction=0", "materials.glass.restitution=1");
        scree_simulation s;
        double first = 0;
        simulation_open(c, 1, &s);
        simulation_load(&s);
        for (size_t row = 0; row < s.state.count; row++) {
            const scree_row *r = &s.state.row[row];
            first += r->mass * (r->vx * r->vx + r->vy * r->vy + r->vz * r->vz) / 2;
        }
        double worst = simulation_finish(&s), last = 0;
        for (size_t row = 0; row < s.state.count; row++) {
            const scree_row *r = &s.state.row[row];
            last += r->mass * (r->vx * r->vx + r->vy * r->vy + r->vz * r->vz) / 2;
        }
        print_message("periodic in %s: kinetic energy %.9g J, %.9g J; residual %.2g\n", kinds[k].periodic, first, last,
                      worst);
        // Trapezoids along Hertz springs, a hundred steps an impact. Some of the energy is in contacts at the end.
        assert_true(worst < 1e-4);
        assert_true(last < first * (1 + 1e-3) && last > 0.8 * first);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// Grown samples have no overlaps, across faces neither, and their bodies lie in the cell.
static void samples_grow(void **unused)
{
    (void)unused;
    static const combination kinds[] = {{2, "y", "plates"}, {2, "xy", "periodic"}, {3, "xz", "plates"}};
    for (int kind = 0; kind < 3; kind++) {
        const combination *of = &kinds[kind];
        char periodic[64];
        const char *overrides[] = {periodic, "stages.prepare.method=growth",
                                   of->dimension == 2 ? "stages.prepare.solid_fraction=78 %"
                                                      : "stages.prepare.solid_fraction=54 %"};
        (void)snprintf(periodic, sizeof periodic, "boundary.periodic=%s", of->periodic);
        scree_case *c =
            case_read(strcmp(of->periodic, "xy") == 0 ? grown_text : texts[of->dimension - 2], overrides, 3);
        scree_simulation s;
        simulation_open(c, 1, &s);
        simulation_step(&s);
        double side[3];
        sides_of(&s.state, side);
        for (size_t i = 0; i < s.state.count; i++)
            for (size_t j = 0; j <= i; j++) {
                scree_vector a, b, away;
                scree_body_position(&s.state, i, a);
                scree_body_position(&s.state, j, b);
                scree_subtract(a, b, away);
                double reach = s.state.row[i].radius + s.state.row[j].radius;
                for (int k = 0; k < of->dimension; k++) {
                    bool repeats = scree_periodic_repeats(scree_cell(&s.state), k);
                    double margin = repeats ? 0 : s.state.row[i].radius * (1 - 1e-12);
                    assert_true(a[k] >= margin && a[k] <= side[k] - margin);
                    if (repeats) away[k] -= side[k] * rint(away[k] / side[k]);
                }
                assert_true(i == j || scree_length(away) >= reach * (1 - 1e-12));
            }
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

static void refuse(const char *text, const char *const overrides[], size_t count, const char *key, const char *message)
{
    scree_case *c = NULL;
    scree_problems *problems = NULL;
    assert_int_equal(case_parse(text, overrides, count, &c, &problems), SCREE_ERROR_INPUT);
    for (size_t k = 0; k < scree_problems_count(problems); k++) {
        const scree_error *problem = scree_problems_get(problems, k);
        if (strstr(problem->message, message) && strcmp(problem->field, key) == 0) {
            scree_problems_free(problems);
            return;
        }
    }
    fail_msg("expected \"%s\", got %s: \"%s\"", message, scree_problems_get(problems, 0)->field,
             scree_problems_get(problems, 0)->message);
}
#define REFUSE_IN(text, key, message, ...)                                                                             \
    refuse(text, (const char *const[]){__VA_ARGS__}, sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *), key, \
           message)

#define REFUSE(dimension, ...) REFUSE_IN(texts[dimension - 2], __VA_ARGS__)
#define CONFINED(shape)                                                                                                \
    HEAD "particles: {shape: " shape ", material: glass, count: 60, radius_min: 0.5 mm, radius_max: 1 mm}\n"           \
         "stages:\n"                                                                                                   \
         "  - {stage: prepare, method: gas}\n"                                                                         \
         "  - {stage: confine, pressure: 1 kPa}\n"

static void what_cannot_be_is_refused(void **unused)
{
    (void)unused;
    REFUSE(2, "boundary.periodic", "there is no z in two dimensions", "boundary.periodic=z");
    REFUSE(2, "boundary.periodic", "there is no z in two dimensions", "boundary.periodic=xz");
    REFUSE(2, "stages.1.boundary", "the Delaunay boundary goes around", "boundary.periodic=x",
           "stages.relax.boundary=pressure");
    REFUSE(3, "stages.1.boundary", "a membrane goes around", "boundary.periodic=x", "stages.relax.boundary=membrane");
    REFUSE(2, "stages.1.boundary", "its forces act on the Delaunay boundary", "boundary.periodic=y",
           "stages.relax.boundary=minimal");
    REFUSE(2, "stages.1.boundary", "its forces act on the Delaunay boundary", "boundary.periodic=y",
           "stages.relax.boundary=affine");
    REFUSE_IN(CONFINED("sphere"), "stages.1.stage", "the sample has no plates below and above", "dimension=3",
              "boundary.periodic=yz");
    REFUSE_IN(CONFINED("disc"), "stages.1.boundary", "could press it: only relax or pour can follow", "stages.confine.boundary=none");
    REFUSE(2, "stages.1.boundary", "nothing holds the sample against gravity", "boundary.periodic=x",
           "stages.relax.boundary=none", "gravity=[0, -9.81]");
    REFUSE(2, "stages.0.method", "this method needs walls on all sides", "boundary.periodic=x",
           "stages.prepare.method=drop_and_roll");
    REFUSE(2, "stages.0.outline", "a round sample cannot repeat itself", "boundary.periodic=y",
           "stages.prepare.outline=circle");
    REFUSE(2, "walls.0.normal", "the plane lies across", "boundary.periodic=x", "stages.relax.boundary=walls",
           "walls=[{shape: plane, point: [0, 0], normal: [1, 0]}]");
    REFUSE(2, "walls.0.shape", "only planes go on", "boundary.periodic=x", "stages.relax.boundary=walls",
           "walls=[{shape: box, lower: [0, 0], upper: [1 m, 1 m], side: inside}]");
    REFUSE(2, "walls.0.shape", "periodic in all directions has no walls", "boundary.periodic=xy",
           "walls=[{shape: plane, point: [0, 0], normal: [0, 1]}]");
    REFUSE(2, "stages.1.boundary", "periodic in all directions", "boundary.periodic=xy", "stages.relax.boundary=none");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_may_lie_anywhere),
        cmocka_unit_test(threads_and_lost_work_do_not_show),
        cmocka_unit_test(restart_gives_the_same_bits),
        cmocka_unit_test(a_dilute_gas_keeps_its_energy),
        cmocka_unit_test(samples_grow),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
