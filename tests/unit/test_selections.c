/// Selections: which bodies each kind finds, that membership is state, and what is said of bad ones.
#include "run_fixture.h"

#include "io_scratch.h"
#include "selection/selection.h"

/// Square lattice of 6 x 5 discs of 1 mm radius whose lowest left centre is at (1, 1) mm; id 6 row + column.
#define LATTICE                                                                                                        \
    "scree: 1\nname: lattice\n"                                                                                        \
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.3}]\n"                          \
    "particles: {shape: disc, material: glass, count: 30, distribution: equal, radius: 1 mm}\n"                        \
    "measure: {samples: 5, cells: no}\noutput: {figures: no, paraview: no}\n"                                          \
    "stages:\n  - {stage: prepare, method: square, aspect_ratio: 0.8333}\n"                                            \
    "  - {stage: relax, boundary: plates, duration: 20 us}\n"                                                          \
    "selections:\n"                                                                                                    \
    "  - {select: not, name: core, of: [rim]}\n"                                                                       \
    "  - {select: or, name: rim, of: [left, right, low, high]}\n"                                                      \
    "  - {select: side, name: left, side: left}\n  - {select: side, name: right, side: right}\n"                       \
    "  - {select: side, name: low, side: bottom}\n  - {select: side, name: high, side: top}\n"                         \
    "  - {select: box, name: corner, lower: [0, 0], upper: [3.5 mm, 3 mm]}\n"                                          \
    "  - {select: circle, name: round, centre: [3 mm, 3 mm], radius: 2.1 mm}\n"                                        \
    "  - {select: layer, name: second, axis: y, end: high, first: 2, last: 2}\n"                                       \
    "  - {select: band, name: band, axis: x, measured: high, from: 0 mm, to: 1.5 mm}\n"                                \
    "  - {select: ids, name: some, ids: [3, [10, 12], 29]}\n"                                                          \
    "  - {select: and, name: both, of: [second, band]}\n"                                                              \
    "  - {select: all, name: everything}\n"

static int64_t find(const scree_simulation *s, const char *name)
{
    int64_t index = scree_config_selection_find(s->model.selections, s->model.selection_count, name);
    assert_true(index >= 0);
    return index;
}

static size_t resolve(scree_simulation *s, const char *name)
{
    scree_error error;
    size_t count = 0;
    int64_t index = find(s, name);
    check(scree_selection_resolve(&s->model, &s->state, index, &error), &error);
    for (size_t row = 0; row < s->state.count; row++) count += scree_selection_has(&s->state, index, row);
    return count;
}

static bool has(const scree_simulation *s, const char *name, size_t id)
{
    return scree_selection_has(&s->state, find(s, name), scree_state_row_of(&s->state, id));
}

static void each_kind_finds_its_bodies(void **unused)
{
    (void)unused;
    scree_case *c = case_read(LATTICE, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    while (!s.stage || s.state.stage.index < 1) simulation_step(&s);
    const struct {
        const char *name;
        size_t count;
    } counts[] = {{"everything", 30}, {"core", 12}, {"rim", 18},   {"left", 5}, {"right", 5}, {"low", 6}, {"high", 6},
                  {"corner", 4},      {"round", 5}, {"second", 6}, {"band", 5}, {"some", 5},  {"both", 1}};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        size_t found = resolve(&s, counts[k].name);
        if (found != counts[k].count) fail_msg("%s: %zu bodies, not %zu", counts[k].name, found, counts[k].count);
    }
    for (size_t row = 0; row < s.state.count; row++) {
        size_t id = s.state.id[row];
        double x = s.state.row[row].x, y = s.state.row[row].y;
        double left = 1e-3, right = 11e-3, low = 1e-3, high = 9e-3;
        assert_true(has(&s, "left", id) == (x < left + 1e-4) && has(&s, "right", id) == (x > right - 1e-4));
        assert_true(has(&s, "low", id) == (y < low + 1e-4) && has(&s, "high", id) == (y > high - 1e-4));
        assert_true(has(&s, "second", id) == (fabs(y - 7e-3) < 1e-4));
        assert_true(has(&s, "both", id) == (fabs(y - 7e-3) < 1e-4 && x > right - 1e-4));
        assert_true(has(&s, "some", id) == (id == 3 || (id >= 10 && id <= 12) || id == 29));
    }
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Members stay what they are when rows change their order, bodies go and come, and in a checkpoint.
static void membership_is_state(void **unused)
{
    (void)unused;
    scree_case *c = case_read(LATTICE, NULL, 0);
    scree_simulation s, other;
    scree_error error;
    simulation_open(c, 1, &s);
    while (!s.stage || s.state.stage.index < 1) simulation_step(&s);
    (void)resolve(&s, "core");
    (void)resolve(&s, "some");
    uint32_t order[30], gone[] = {3, 7};
    bool core[30];
    for (uint32_t k = 0; k < 30; k++) {
        core[k] = has(&s, "core", k);
        order[k] = (7 * k + 3) % 30;
    }
    check(scree_state_permute(&s.state, order, &error), &error);
    check(scree_state_remove(&s.state, gone, 2, &error), &error);
    check(scree_state_append(&s.state, SCREE_MARK_GRAIN, 40, &error), &error);
    for (size_t id = 0; id < 70; id++) {
        if (id == 3 || id == 7) continue;
        assert_true(has(&s, "core", id) == (id < 30 && core[id]));
        assert_true(has(&s, "some", id) == ((id >= 10 && id <= 12) || id == 29));
    }
    // They are found once: what comes later does not belong.
    assert_int_equal(resolve(&s, "some"), 4);
    for (size_t row = 0; row < s.state.count; row++) // bodies that a checkpoint can hold
        if (s.state.id[row] >= 30) s.state.row[row].radius = s.state.row[row].mass = 1e-3;
    check(scree_checkpoint_write(scratch, &s.state, 7, &error), &error);
    simulation_open(c, 1, &other);
    scree_state_destroy(&other.state);
    check(scree_checkpoint_read(scratch, 2, &other.state, 7, &error), &error);
    for (size_t id = 0; id < 70; id++)
        if (id != 3 && id != 7) assert_true(has(&other, "core", id) == has(&s, "core", id));
    scree_simulation_close(&other);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// In three dimensions: spheres on a cubic lattice of 3 x 3 x 3, by side and sphere.
static void sides_in_three_dimensions(void **unused)
{
    (void)unused;
    const char *text = "scree: 1\nname: cube\ndimension: 3\n"
                       "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.3}]\n"
                       "particles: {shape: sphere, material: glass, count: 64, distribution: equal, radius: 1 mm}\n"
                       "measure: {samples: 5, cells: no}\noutput: {figures: no, paraview: no}\n"
                       "stages:\n  - {stage: prepare, method: cubic, aspect_ratio: 1}\n  - {stage: relax, boundary: "
                       "plates, duration: 20 us}\n"
                       "selections:\n"
                       "  - {select: side, name: front, side: front}\n  - {select: side, name: top, side: top}\n"
                       "  - {select: sphere, name: ball, centre: [1 mm, 1 mm, 1 mm], radius: 2.1 mm}\n"
                       "  - {select: and, name: edge, of: [front, top]}\n";
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    while (!s.stage || s.state.stage.index < 1) simulation_step(&s);
    assert_int_equal(resolve(&s, "front"), 16);
    assert_int_equal(resolve(&s, "top"), 16);
    assert_int_equal(resolve(&s, "edge"), 4);
    assert_int_equal(resolve(&s, "ball"), 4);
    for (size_t row = 0; row < s.state.count; row++) {
        assert_true(has(&s, "front", s.state.id[row]) == (s.state.row[row].y < 1.1e-3));
        assert_true(has(&s, "top", s.state.id[row]) == (s.state.row[row].z > 6.9e-3));
    }
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void expect_problem(const char *override, const char *message)
{
    scree_case *c;
    scree_problems *problems;
    bool found = false;
    assert_int_equal(case_parse(LATTICE, &override, 1, &c, &problems), SCREE_ERROR_INPUT);
    for (size_t k = 0; k < scree_problems_count(problems); k++)
        found = found || strstr(scree_problems_get(problems, k)->message, message);
    if (!found) fail_msg("%s: '%s' is not said, but: %s", override, message, scree_problems_get(problems, 0)->message);
    scree_problems_free(problems);
}

static void bad_ones_are_refused(void **unused)
{
    (void)unused;
    expect_problem("selections.rim.of=[left, rigth]", "did you mean 'right'");
    expect_problem("selections.rim.of=[left, core]", "is made of itself");
    expect_problem("selections.rim.of=[rim]", "is made of itself");
    expect_problem("selections.left.name=right", "has the name 'right' too");
    expect_problem("selections.some.ids=[-3]", "number of a particle");
    expect_problem("selections.some.ids=[[5, 2]]", "number of a particle");
    expect_problem("selections.corner.upper=[-1 mm, 3 mm]", "is smaller than that of `lower`");
    expect_problem("selections.left.side=front", "exists in three dimensions only");
    expect_problem("selections.second.axis=z", "there is no z");
    expect_problem("selections.second.first=3", "is before the first one");
    expect_problem("selections.band.to=-1 mm", "must begin before it ends");
}

static void expect_refusal(const char *override, const char *name, const char *message)
{
    scree_case *c = case_read(LATTICE, &override, 1);
    scree_simulation s;
    scree_error error;
    simulation_open(c, 1, &s);
    while (!s.stage || s.state.stage.index < 1) simulation_step(&s);
    assert_int_equal(scree_selection_resolve(&s.model, &s.state, find(&s, name), &error), SCREE_ERROR_INPUT);
    if (!strstr(error.message, message)) fail_msg("%s", error.message);
    assert_true(strncmp(error.field, "selections.", 11) == 0);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void empty_ones_are_refused(void **unused)
{
    (void)unused;
    expect_refusal("selections.corner.upper=[0.5 mm, 3 mm]", "corner", "selection 'corner' (box) has no particle");
    expect_refusal("selections.some.ids=[3, 30]", "some", "names particle 30, which is not there");
    expect_refusal("selections.both.of=[left, right]", "both", "selection 'both' (and) has no particle");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_finds_its_bodies),
        cmocka_unit_test_setup_teardown(membership_is_state, make_scratch, remove_scratch),
        cmocka_unit_test(sides_in_three_dimensions),
        cmocka_unit_test(bad_ones_are_refused),
        cmocka_unit_test(empty_ones_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
