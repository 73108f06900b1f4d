/// Responses of layers: lists of contacts against a brute check, fields and rows of elements against a closed form,
/// peaks, the lattice, the grain at the top, the piston, and reciprocity.
#include "average_fixture.h"
#include "library_fixture.h"

#include "average/response.h"
#include "load/prescribed.h"
#include "run/step.h"
#include "selection/top.h"

enum { ROWS = 6 };

// ---- contacts ----------------------------------------------------------------------------------------------------

static bool same_ends(const scree_average_contact *a, const scree_average_contact *b)
{
    return (a->first == b->first && a->second == b->second) || (a->first == b->second && a->second == b->first);
}

/// Of each contact of `of` the one of `in` with the same ends, by looking at all; NULL: there is none.
static const scree_average_contact *brute(const scree_average_sample *in, const scree_average_contact *of)
{
    for (size_t k = 0; k < in->contacts; k++)
        if (same_ends(&in->contact[k], of)) return &in->contact[k];
    return NULL;
}

/// Discs in a box of random places, all near pairs in contact, some turned round, some left out, some sliding.
static scree_average_sample cloud(uint64_t draw)
{
    scree_average_sample s = average_begin(2);
    for (uint64_t k = 0; k < 60; k++) (void)average_add(&s, average_random(2 * k), average_random(2 * k + 1), 0, 0.05);
    for (uint32_t p = 0; p < 60; p++)
        for (uint32_t q = 0; q < p; q++) {
            const uint64_t at = 1000 * (draw + 1) + 60 * p + q;
            const double f[3] = {average_random(at) - 0.5, average_random(7 * at) - 0.5, 0};
            const double *a = s.grain[p].position, *b = s.grain[q].position;
            if (hypot(a[0] - b[0], a[1] - b[1]) > 0.15 || average_random(3 * at) < 0.2) continue;
            average_touch(&s, average_random(5 * at) < 0.5 ? p : q, average_random(5 * at) < 0.5 ? q : p, f);
            for (int k = 0; k < 2; k++) s.contact[s.contacts - 1].point[k] = 0.5 * (a[k] + b[k]);
            s.contact[s.contacts - 1].sliding = average_random(11 * at) < 0.3;
        }
    return s;
}

static void changes_are_those_of_a_brute_check(void **unused)
{
    (void)unused;
    scree_average_sample before = cloud(1), after = cloud(2);
    scree_response_changes changes;
    scree_error error;
    size_t made = 0, lost = 0, sliding = 0;
    for (size_t k = 0; k < after.contacts; k++) {
        const scree_average_contact *then = brute(&before, &after.contact[k]);
        made += !then;
        sliding += then && after.contact[k].sliding && !then->sliding;
    }
    for (size_t k = 0; k < before.contacts; k++) lost += !brute(&after, &before.contact[k]);
    check(scree_response_compare(&before, &after, &changes, &error), &error);
    assert_true(made > 5 && lost > 5 && sliding > 5);
    assert_int_equal(changes.made, made);
    assert_int_equal(changes.lost, lost);
    assert_int_equal(changes.sliding, sliding);
    assert_int_equal(changes.count, made + lost + sliding);
    for (size_t k = 0; k < changes.count; k++) {
        const scree_response_change *c = &changes.list[k];
        const scree_average_contact of = {.first = c->first, .second = c->second};
        assert_true((brute(&after, &of) != NULL) == (c->kind != SCREE_RESPONSE_LOST));
        assert_true((brute(&before, &of) != NULL) == (c->kind != SCREE_RESPONSE_MADE));
    }
    scree_release(&changes.list);
    scree_average_sample_destroy(&before);
    scree_average_sample_destroy(&after);
}

/// Two walls that one grain touches are told apart.
static void walls_are_told_apart(void **unused)
{
    (void)unused;
    scree_average_sample before = average_begin(2), after = average_begin(2);
    scree_response_changes changes;
    scree_error error;
    (void)average_add(&before, 1, 1, 0, 1);
    (void)average_add(&after, 1, 1, 0, 1);
    average_stand(&before, 0, (double[3]){0, 1, 0}, (double[3]){2, 0, 0});
    average_stand(&before, 0, (double[3]){1, 0, 0}, (double[3]){0, 1, 0});
    average_stand(&after, 0, (double[3]){1, 0, 0}, (double[3]){0, 1, 0});
    check(scree_response_compare(&before, &after, &changes, &error), &error);
    assert_int_equal(changes.count, 1);
    assert_int_equal(changes.list[0].kind, SCREE_RESPONSE_LOST);
    near(changes.list[0].before, 2, 0);
    scree_release(&changes.list);
    scree_average_sample_destroy(&before);
    scree_average_sample_destroy(&after);
}

// ---- stress ------------------------------------------------------------------------------------------------------

static double binomial(int n, int k)
{
    double value = 1;
    for (int i = 1; i <= k; i++) value *= (double)(n - k + i) / i;
    return value;
}

/// A triangle of discs of radius 1, ROWS rows, row n of n + 1 discs, without weight: a force on the topmost halves in
/// every disc, along contacts 60 degrees steep. Row n bears shares binomial(n, k) / 2^n of it.
static scree_average_sample pyramid(double force)
{
    scree_average_sample s = average_begin(2);
    const double rise = sqrt(3);
    for (int n = 0; n < ROWS; n++)
        for (int k = 0; k <= n; k++) (void)average_add(&s, 2 * k - n, 1 + rise * (ROWS - 1 - n), 0, 1);
    for (int n = 0; n < ROWS; n++)
        for (int k = 0; k <= n; k++) {
            const uint32_t at = (uint32_t)(n * (n + 1) / 2 + k), below = at + (uint32_t)n + 1;
            const double share = force * binomial(n, k) * pow(0.5, n), up = 0.5 * share, across = up / rise;
            if (n + 1 < ROWS) {
                average_touch(&s, at, below, (double[3]){across, up, 0});
                average_touch(&s, below + 1, at, (double[3]){across, -up, 0});
                continue;
            }
            const double *x = s.grain[at].position;
            average_stand(&s, at, (double[3]){x[0], x[1] - 1, 0}, (double[3]){0, share, 0});
        }
    return s;
}

static void rows_bear_the_load(void **unused)
{
    (void)unused;
    scree_average_sample before = pyramid(1), after = pyramid(8);
    scree_response r;
    scree_error error;
    average_finish(&before);
    average_finish(&after);
    check(scree_response_open(&before, &after, 0, 1.3, &r, &error), &error);
    r.force = 7;
    near(r.top, 2 + sqrt(3) * (ROWS - 1), 1e-14);
    near(r.base, 0, 1e-14);
    near(scree_response_order(&after, true), 1, 1e-14);
    near(scree_response_order(&after, false), 1, 1e-14);
    // Any depth, also where the load acts within the element, and at the base.
    for (double depth = 0.1; depth < r.top - r.base; depth += 0.37) near(scree_response_missing(&r, depth), 0, 1e-14);
    r.force = 8;
    assert_true(fabs(scree_response_missing(&r, 4)) > 0.1);
    // Elements side by side, as boxes and as hats, add up to the load.
    for (int hat = 0; hat < 2; hat++) {
        double sum = 0, p[3];
        for (int k = -20; k <= 20; k++) {
            const scree_average_element e = scree_response_element(&r, 5, k * r.side);
            scree_response_pressure(&after, &e, hat, p);
            sum += p[1] * r.side * after.thickness;
        }
        near(sum, 8, 1e-13);
    }
    scree_average_sample_destroy(&before);
    scree_average_sample_destroy(&after);
}

/// Between two rows: the forces along 60 degrees have sigma_xx = sigma_yy / 3 over the whole width.
static void directions_give_the_ratio_of_pressures(void **unused)
{
    (void)unused;
    scree_average_sample s = pyramid(8);
    const scree_average_element e = {.low = {-20, 4, 0}, .high = {20, 5, 0}};
    double p[3];
    average_finish(&s);
    scree_response_pressure(&s, &e, false, p);
    near(p[1], 8 / (40 * s.thickness), 1e-15);
    near(p[0], p[1] / 3, 1e-15);
    near(p[2], 0, 1e-15);
    scree_average_sample_destroy(&s);
}

static void peaks_are_found(void **unused)
{
    (void)unused;
    double one[101], two[101];
    for (int k = 0; k <= 100; k++) {
        const double x = 0.1 * k;
        one[k] = fmax(0, 4 - x);
        two[k] = fmax(0, 3 - fabs(x - 4));
    }
    two[0] = 0.75;
    scree_response_peak peak = scree_response_find_peak(one, 101, 0.1);
    near(peak.dip, 0, 0);
    near(peak.place, 0, 0);
    near(peak.width, 2, 1e-12);
    peak = scree_response_find_peak(two, 101, 0.1);
    near(peak.dip, 0.75, 1e-12);
    near(peak.place, 4, 1e-12);
    near(peak.width, 5.5, 1e-12);
    for (int k = 0; k <= 100; k++) one[k] = -1;
    assert_true(isnan(scree_response_find_peak(one, 101, 0.1).width));
}

// ---- the layer ---------------------------------------------------------------------------------------------------

#define LAYER(more)                                                                                                    \
    "scree: 1\nname: layer\ngravity: [0, -10]\n"                                                                       \
    "materials: [{name: stone, young_modulus: 10 MPa, stiffness_ratio: 0.3, damping_ratio: 0.3, density: 5000 "        \
    "kg/m3, friction: 0}]\n"                                                                                           \
    "particles: {material: stone, thickness: 1 m, count: 32, distribution: equal, radius: 5 mm}\n"                     \
    "contact: {law: linear}\nintegrator: {step: 1e-5 s}\n"                                                             \
    "walls:\n"                                                                                                         \
    "  - {shape: plane, name: plate, point: [0, 0], normal: [0, 1]}\n"                                                 \
    "  - {shape: plane, name: left, point: [0, 0], normal: [1, 0]}\n"                                                  \
    "  - {shape: plane, name: right, point: [8.713372815 cm, 0], normal: [-1, 0]}\n"                                   \
    "selections:\n  - {select: top, name: one, x: 4 cm}\n  - {select: top, name: other, x: 1.2 cm}\n"                  \
    "measure: {samples: 400, cells: no}\noutput: {figures: no, paraview: no}\n"                                        \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: centred_rectangular, angle: 50 degrees, width: 8.714 cm}\n"                          \
    "  - {stage: relax, name: settle, boundary: walls, duration: 2 s, unbalanced_limit: 1e-9}\n"                       \
    "  - {stage: relax, name: press, boundary: walls, duration: 2 s, unbalanced_limit: 1e-9}\n"                        \
    "loads:\n  - {load: background_damping, translation: 0.5, rotation: 0.5}\n" more

/// Neighbours in rows above touch at the angle, and nothing else does.
static void the_lattice_is_as_said(void **unused)
{
    (void)unused;
    scree_case *c = case_read(LAYER(""), NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    const double steep = 50 * M_PI / 180, across = 4 * 5e-3 * cos(steep);
    size_t touching = 0;
    while (s.state.count == 0) simulation_step(&s);
    assert_int_equal(s.state.count, 32);
    for (size_t p = 0; p < 32; p++)
        for (size_t q = 0; q < p; q++) {
            const double x = s.state.row[p].x - s.state.row[q].x, y = s.state.row[p].y - s.state.row[q].y;
            const double distance = hypot(x, y);
            assert_true(distance > 10e-3 * (1 - 1e-12));
            if (distance > 10e-3 * (1 + 1e-12)) continue;
            touching++;
            near(fabs(atan2(fabs(y), fabs(x)) - steep), 0, 1e-12);
            near(fabs(x), 0.5 * across, 1e-15);
        }
    // Rows of 7, 6, 7, 6, 6, the last one not full: discs stand on two, at the ends of longer rows on one.
    assert_int_equal(touching, 12 + (5 * 2 + 2) + 12 + (1 + 5 * 2));
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Vertical displacement of the second grain under a small force on the first one, frictionless.
static double displacement(const char *pressed, const char *looked_at)
{
    char text[4000];
    (void)snprintf(text, sizeof text,
                   "%s  - {load: prescribed, selection: %s, from: press, force_y: -1 mN}\n"
                   "  - {load: prescribed, selection: %s, name: idle, from: press, torque_z: 0}\n",
                   LAYER(""), pressed, looked_at);
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    double before = NAN;
    uint32_t row = 0;
    simulation_open(c, 1, &s);
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        if (s.state.stage.index != 2 || !isnan(before) || !scree_prescribed_of(&s.state)->owner) continue;
        for (row = 0; row < s.state.count; row++)
            if (scree_prescribed_of(&s.state)->owner[row][5] == 3) break;
        assert_true(row < s.state.count);
        row = s.state.id[row];
        before = s.state.row[scree_state_row_of(&s.state, row)].y;
    }
    const double moved = s.state.row[scree_state_row_of(&s.state, row)].y - before;
    scree_simulation_close(&s);
    scree_case_free(c);
    return moved;
}

static void displacements_are_reciprocal(void **unused)
{
    (void)unused;
    const double one = displacement("one", "other"), other = displacement("other", "one");
    print_message("displacements %.9g m and %.9g m\n", one, other);
    // 1 mN on grains of 4 N: the change of the stiffness with the load is below 1e-3.
    assert_true(fabs(one) > 1e-13);
    near(one / other, 1, 1e-3);
}

// ---- the piston --------------------------------------------------------------------------------------------------

#define PISTON                                                                                                         \
    LAYER("  - {load: prescribed, name: piston, selection: one, from: press, velocity_y: -10 mm/s, until_force: 50 "   \
          "N}\n")

/// The grain goes at its velocity until the others resist with the force; then the force acts, and the layer bears it.
static void a_piston_ends_with_its_force(void **unused)
{
    (void)unused;
    scree_case *c = case_read(PISTON, NULL, 0);
    scree_simulation s;
    scree_error error;
    double largest = 0, value[8], force[2] = {0};
    size_t driven = 0;
    simulation_open(c, 1, &s);
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        const scree_prescribed *all = scree_prescribed_of(&s.state);
        if (s.state.stage.index != 2 || !all->owner) continue;
        for (size_t row = 0; row < s.state.count; row++) {
            if (!s.state.held[row]) continue;
            driven++;
            if (driven > 2) largest = fmax(largest, fabs(s.state.row[row].vy + 10e-3)); // from rest at first
            // Constant velocity: what drives the grain is what resists.
            const scree_context now = scree_step_context(&s);
            check(scree_module_prescribed.columns.measure(&now, 0, value, &error), &error);
            force[0] = force[1], force[1] = -value[1];
        }
    }
    const scree_context context = scree_step_context(&s);
    check(scree_module_prescribed.columns.measure(&context, 0, value, &error), &error);
    print_message("driven for %zu steps, velocity off by %.2g m/s\n", driven, largest);
    assert_true(driven > 10 && largest < 1e-12); // a force quantum over a step
    // The last step before the end is the first that meets the force.
    print_message("ended with %.6g N, a step before %.6g N\n", force[1], force[0]);
    assert_true(force[1] >= 50 - 1e-9 && force[0] < 50);
    near(value[1], -50, 1e-6); // quanta
    near(scree_prescribed_of(&s.state)->given[1][1], -50, 0);
    for (size_t row = 0; row < s.state.count; row++) assert_int_equal(s.state.held[row], 0);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// A checkpoint while the piston moves and one behind its end lead to the same bits.
static void a_piston_goes_on_from_a_checkpoint(void **unused)
{
    (void)unused;
    scree_case *c = case_read(PISTON, NULL, 0);
    scree_simulation *whole = library_create(c), *again = library_create(c);
    scree_error error;
    const char *path = "piston-checkpoint.h5";
    const char *name;
    while (scree_simulation_stage(whole, &name) < 2) (void)library_advance(whole, 100);
    for (int k = 0; k < 2; k++) {
        (void)library_advance(whole, k ? 3000 : 20);
        check(scree_simulation_save(whole, path, &error), &error);
        check(scree_simulation_restore(again, path, &error), &error);
        (void)library_advance(again, 2000);
        (void)library_advance(whole, 2000);
        assert_true(scree_simulation_checksum(again) == scree_simulation_checksum(whole));
    }
    (void)remove(path);
    scree_simulation_free(whole);
    scree_simulation_free(again);
    scree_case_free(c);
}

// ---- the grain at the top ----------------------------------------------------------------------------------------

static void the_top_is_found(void **unused)
{
    (void)unused;
    scree_case *c = case_read(LAYER(""), NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    while (s.state.count == 0) simulation_step(&s);
    size_t open = 0;
    for (size_t p = 0; p < 32; p++) {
        bool covered = false;
        for (size_t q = 0; q < 32; q++)
            covered = covered ||
                      (s.state.row[q].y > s.state.row[p].y && fabs(s.state.row[q].x - s.state.row[p].x) < 1.5 * 5e-3);
        open += !covered;
        assert_true((scree_row_above(&s.state, p) != SCREE_NO_ROW) == covered);
    }
    assert_true(open >= 6 && open <= 7);
    scree_simulation_close(&s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changes_are_those_of_a_brute_check),

        cmocka_unit_test(walls_are_told_apart),
        cmocka_unit_test(rows_bear_the_load),
        cmocka_unit_test(directions_give_the_ratio_of_pressures),
        cmocka_unit_test(peaks_are_found),
        cmocka_unit_test(the_lattice_is_as_said),
        cmocka_unit_test(displacements_are_reciprocal),
        cmocka_unit_test(a_piston_ends_with_its_force),
        cmocka_unit_test(a_piston_goes_on_from_a_checkpoint),
        cmocka_unit_test(the_top_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
