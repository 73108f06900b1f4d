/// Dense packings: gaps, walls, sizes and solid fraction measured pair by pair, against what the preparation reports;
/// the weighted triangulation that they rest on; errors and memory.
#include "run_fixture.h"

#include "prepare/dense.h"
#include "prepare/gap_net.h"
#include "prepare/prepare.h"
#include "state/periodic.h"
#include "state/plates.h"

#include "base/memory.h"

#include <stdlib.h>

#define HEAD(dimension, shape, count, sizes)                                                                           \
    "scree: 1\nname: dense\nseed: 1\ndimension: " dimension "\n"                                                       \
    "materials: [{name: rock, normal_stiffness: 1e8 N/m, stiffness_ratio: 0.5, damping_ratio: 0, density: 2000 "       \
    "kg/m3, "                                                                                                          \
    "young_modulus: 1 GPa, friction: 0.5}]\n"                                                                          \
    "contact: {law: linear}\nmeasure: {cells: no}\n"                                                                   \
    "particles: {shape: " shape ", count: " count ", " sizes "}\n"
#define STAGES(keys)                                                                                                   \
    "stages:\n  - {stage: prepare, method: dense, aspect_ratio: 1, " keys "}\n"                                        \
    "  - {stage: bond, gap_tolerance: 5 um, overlap_tolerance: 1 mm}\n"
/// The     sizes of Madan 2019, 4.5.
#define MADAN                                                                                                          \
    "material: rock, distribution: log_normal, radius_min: 0.218 mm, radius_max: 0.652 mm, median: 0.312289 mm, "      \
    "geometric_deviation: 1.6676"
#define PLANE(keys) HEAD("2", "disc", "150", MADAN) STAGES(keys)
#define SPACE(keys) HEAD("3", "sphere", "70", "material: rock, radius_min: 0.5 mm, radius_max: 1 mm") STAGES(keys)

typedef struct sample {
    scree_case *c;
    scree_model model;
    scree_state state;
    double side[3];
} sample;

static void prepare_with(const char *text, const char *const *keys, size_t count, sample *s)
{
    scree_error error;
    s->c = case_read(text, keys, count);
    check(scree_model_build(&s->c->config, &s->model, &error), &error);
    check(scree_prepare(&s->model, &s->model.stages[0], &s->state, &error), &error);
    const bool in_3d = s->state.dimension == 3;
    const scree_wall *plate = scree_plates(&s->state);
    s->side[0] = -plate[SCREE_WALL_RIGHT].position;
    s->side[in_3d ? 2 : 1] = -plate[SCREE_WALL_TOP].position;
    if (in_3d) s->side[1] = -plate[SCREE_WALL_BACK].position;
}

static void prepare(const char *text, sample *s)
{
    prepare_with(text, NULL, 0, s);
}

static void destroy(sample *s)
{
    scree_state_destroy(&s->state);
    scree_case_free(s->c);
}

/// What all pairs of bodies, and bodies and walls, say [mean radii].
typedef struct found {
    size_t bonds, touches;
    double mean, scatter, deepest, beyond;
} found;

static double gap_of(const sample *s, size_t a, size_t b)
{
    scree_vector p, q;
    double square = 0;
    scree_body_position(&s->state, a, p);
    scree_body_position(&s->state, b, q);
    for (int k = 0; k < s->state.dimension; k++) {
        double away = p[k] - q[k];
        if (s->model.periodic >> k & 1) away -= s->side[k] * rint(away / s->side[k]);
        square += away * away;
    }
    return (sqrt(square) - s->state.row[a].radius - s->state.row[b].radius) / s->model.mean_radius;
}

/// Pairs whose gap is not wider than the mean that was reported and `farthest`.
static void look(const sample *s, double mean, double farthest, found *f)
{
    double sum = 0, square = 0;
    *f = (found){.deepest = -INFINITY, .beyond = -INFINITY};
    for (size_t a = 0; a < s->state.count; a++) {
        for (size_t b = 0; b < a; b++) {
            const double gap = gap_of(s, a, b);
            if (gap > mean + farthest) continue;
            f->bonds++;
            sum += gap;
            square += (gap - mean) * (gap - mean);
            f->deepest = fmax(f->deepest, mean - gap);
        }
        scree_vector place;
        scree_body_position(&s->state, a, place);
        for (int w = 0; w < 2 * s->state.dimension; w++) {
            const int axis = w / 2;
            if (s->model.periodic >> axis & 1) continue;
            const double inside = w % 2 ? s->side[axis] - place[axis] : place[axis];
            const double gap = (inside - s->state.row[a].radius) / s->model.mean_radius;
            f->beyond = fmax(f->beyond, -gap);
            f->touches += gap < 1e-12;
        }
    }
    f->mean = sum / (double)f->bonds;
    f->scatter = sqrt(square / (double)f->bonds);
}

static const double *record_of(const sample *s)
{
    return ((const scree_dense_record *)s->state.own[SCREE_SLOT_dense])->value;
}

/// Reported numbers are those that pairs say: the net has every pair that is near, and no other.
static void expect_report(const sample *s, double tolerance, found *f)
{
    const double *r = record_of(s);
    look(s, -r[4], 5 * tolerance, f);
    assert_int_equal((size_t)r[1], f->bonds);
    assert_true(fabs(r[2] - 2.0 * (double)f->bonds / (double)s->state.count) < 1e-12);
    assert_int_equal((size_t)r[3], f->touches);
    assert_true(fabs(r[4] + f->mean) < 1e-6);
    assert_true(fabs(r[5] - f->scatter) < 1e-6 && f->scatter <= tolerance);
    assert_true(fabs(r[6] - f->deepest) < 1e-6 && f->deepest <= 5 * tolerance);
    assert_true(r[7] <= 5 * tolerance);
    // Rounding of a place in the box.
    assert_true(f->beyond < 1e-12);
}

static int compare(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return p < q ? -1 : p > q;
}

/// The sorted radii against the quantiles of the distribution, within `tolerance` mean radii rms; limits kept, and the
/// box as full as it shall be.
static void expect_sizes(const sample *s, double fraction, double tolerance)
{
    const scree_species *species = &s->model.species[0];
    const size_t count = s->state.count;
    double radius[400], solid = 0, square = 0, room = 1;
    for (size_t i = 0; i < count; i++) {
        const double r = radius[i] = s->state.row[i].radius;
        assert_true(r >= species->radius.least && r <= species->radius.most);
        solid += s->state.dimension == 3 ? 4 * M_PI / 3 * r * r * r : M_PI * r * r;
    }
    for (int k = 0; k < s->state.dimension; k++) room *= s->side[k];
    // Radii at their limits may leave the last factor short.
    assert_true(fabs(solid / room / fraction - 1) < 1e-6);
    qsort(radius, count, sizeof *radius, compare);
    for (size_t k = 0; k < count; k++) {
        const double share = ((double)k + 0.5) / (double)count;
        const double off = radius[k] - species->distribution->radius(species->sizes, s->state.dimension, share);
        square += off * off;
    }
    const double departure = sqrt(square / (double)count) / s->model.mean_radius;
    if (!(departure < tolerance)) fail_msg("radii depart by %g mean radii", departure);
    assert_true(fabs(record_of(s)[9] / record_of(s)[10] - 1) < tolerance);
    assert_true(fabs(record_of(s)[11] / record_of(s)[12] - 1) < 2 * tolerance);
}

/// 150 discs with the sizes of the source, 93 % of a square. An edge of the triangulation is a bond but for a few
/// percent; walls take edges away: of 3 n - 3 less those of the hull, some 4 sqrt(n).
static void discs_fill_a_square(void **unused)
{
    (void)unused;
    sample s;
    found f;
    prepare(PLANE("solid_fraction: 93 %"), &s);
    expect_report(&s, 0.01, &f);
    expect_sizes(&s, 0.93, 0.03);
    const double edges = record_of(&s)[0];
    assert_true((double)f.bonds > 0.95 * edges && edges > 3 * 150 - 3 - 5 * sqrt(150));
    assert_true((double)f.touches > 3 * sqrt(150));
    destroy(&s);
}

/// Without walls an edge of the triangulation is one of three a disc (Euler).
static void discs_fill_a_cell(void **unused)
{
    (void)unused;
    sample s;
    found f;
    prepare("boundary: {periodic: xy}\n" PLANE("solid_fraction: 93 %"), &s);
    expect_report(&s, 0.01, &f);
    expect_sizes(&s, 0.93, 0.03);
    assert_true(record_of(&s)[0] == 3 * 150);
    assert_true((double)f.bonds > 2.85 * 150 && f.touches == 0);
    destroy(&s);
}

/// Spheres: neighbours and walls are more than the six of jamming.
static void spheres_fill_a_cube(void **unused)
{
    (void)unused;
    sample s;
    found f;
    prepare(SPACE("solid_fraction: 64 %"), &s);
    expect_report(&s, 0.01, &f);
    expect_sizes(&s, 0.64, 0.03);
    assert_true((2.0 * (double)f.bonds + (double)f.touches) / 70 > 6);
    destroy(&s);
}

/// Packings in which one sphere was left pressed into another by 0.75 and 0.8 mean radii, and one also into a wall that
/// others hid from it.
static void crowded_spheres_find_room(void **unused)
{
    (void)unused;
    static const char *const solid[] = {"stages.prepare.solid_fraction=60 %", "stages.prepare.solid_fraction=64 %"};
    static const char *const seed[] = {"seed=1", "seed=3"};
    for (int k = 0; k < 2; k++) {
        sample s;
        found f;
        const char *keys[] = {solid[k], seed[k], "particles.count=400"};
        prepare_with(SPACE("solid_fraction: 64 %"), keys, 3, &s);
        expect_report(&s, 0.01, &f);
        destroy(&s);
    }
}

static void same_seed_same_sample(void **unused)
{
    (void)unused;
    sample s[3];
    const char *seed = "seed=2";
    for (int k = 0; k < 2; k++) prepare(PLANE("solid_fraction: 92 %"), &s[k]);
    assert_memory_equal(s[0].state.row, s[1].state.row, s[0].state.count * sizeof *s[0].state.row);
    scree_error error;
    s[2].c = case_read(PLANE("solid_fraction: 92 %"), &seed, 1);
    check(scree_model_build(&s[2].c->config, &s[2].model, &error), &error);
    check(scree_prepare(&s[2].model, &s[2].model.stages[0], &s[2].state, &error), &error);
    assert_true(s[2].state.row[0].x != s[0].state.row[0].x);
    // The sizes asked for, and with them the box, are those of the distribution.
    assert_true(scree_plates(&s[2].state)[SCREE_WALL_TOP].position ==
                scree_plates(&s[0].state)[SCREE_WALL_TOP].position);
    for (int k = 0; k < 3; k++) destroy(&s[k]);
}

/// Large and small discs of two materials keep their own sizes.
static void species_keep_their_sizes(void **unused)
{
    (void)unused;
    sample s;
    found f;
    prepare(HEAD("2", "disc", "120",
                 "species: [{name: large, material: rock, count: 40, radius_min: 0.9 mm, radius_max: 1.1 mm}, {name: "
                 "small, material: rock, count: 80, radius_min: 0.5 mm, radius_max: 0.7 mm}], share_by: count")
                STAGES("solid_fraction: 86 %, size_penalty: 0.1"),
            &s);
    size_t large = 0;
    expect_report(&s, 0.01, &f);
    for (size_t i = 0; i < s.state.count; i++) {
        const double r = s.state.row[i].radius;
        const scree_size_moments *limits = &s.model.species[s.state.species[i]].radius;
        assert_true(r >= limits->least && r <= limits->most);
        large += r > 0.8e-3;
    }
    assert_int_equal(large, 40);
    destroy(&s);
}

/// Two large discs that touch and two small ones in their hollows: the large are neighbours, but of the centres alone
/// the small ones would be, as the angles at these are more than right.
static void large_neighbours_share_an_edge(void **unused)
{
    (void)unused;
    const double small = 1.0 / 3, rise = sqrt((1 + small) * (1 + small) - 1);
    double at[] = {9, 10, 1, 11, 10, 1, 10, 10 + rise, small, 10, 10 - rise, small};
    const scree_gap_bodies b = {.dimension = 2, .count = 4, .side = {20, 20}, .at = at};
    scree_gap_net net;
    scree_error error;
    check(scree_gap_net_build(&b, &net, &error), &error);
    bool large = false;
    for (size_t e = 0; e < net.edge_count; e++) {
        double normal[3];
        assert_false(net.edge[e].first == 2 && net.edge[e].second == 3);
        large = large || (net.edge[e].first == 0 && net.edge[e].second == 1);
        assert_true(fabs(scree_gap_of_edge(&b, &net.edge[e], normal)) < 1e-12);
    }
    assert_true(large);
    assert_int_equal(net.edge_count, 5);
    scree_gap_net_destroy(&net);
}

/// A square lattice that lacks a disc.
static void the_widest_hole_is_found(void **unused)
{
    (void)unused;
    double at[3 * 24];
    size_t count = 0;
    for (int i = 0; i < 25; i++) {
        if (i == 8) continue;
        at[3 * count] = 1 + 2 * (i % 5);
        at[3 * count + 1] = 1 + 2 * (i / 5);
        at[3 * count++ + 2] = 1;
    }
    const scree_gap_bodies b = {.dimension = 2, .count = count, .side = {10, 10}, .at = at};
    scree_gap_net net;
    scree_error error;
    check(scree_gap_net_build(&b, &net, &error), &error);
    assert_true(fabs(net.hole.centre[0] - 7) < 1e-9 && fabs(net.hole.centre[1] - 3) < 1e-9);
    assert_true(fabs(net.hole.power - 3) < 1e-9);
    scree_gap_net_destroy(&net);
}

static void expect_error(const char *text, const char *field, const char *part)
{
    sample s = {.c = case_read(text, NULL, 0)};
    scree_error error = {0};
    check(scree_model_build(&s.c->config, &s.model, &error), &error);
    assert_int_equal(scree_prepare(&s.model, &s.model.stages[0], &s.state, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, field);
    if (!strstr(error.message, part)) fail_msg("'%s' is not in '%s'", part, error.message);
    assert_null(s.state.row);
    scree_case_free(s.c);
}

static void what_cannot_be_is_refused(void **unused)
{
    (void)unused;
    expect_error(SPACE("solid_fraction: 80 %, gap_scatter: 2 %, rounds: 25"), "stages.0.solid_fraction",
                 "ask for at most");
    expect_error(PLANE("solid_fraction: 93 %, rounds: 2"), "stages.0.gap_scatter", "more rounds");
    scree_case *c = NULL;
    scree_problems *problems = NULL;
    const char text[] = HEAD("2", "disc", "150", MADAN) "stages:\n  - {stage: prepare, method: dense}\n"
                                                        "  - {stage: relax, boundary: none, duration: 1 us}\n";
    assert_int_equal(scree_case_parse(text, strlen(text), "dense", NULL, &c, &problems), SCREE_ERROR_INPUT);
    assert_int_equal(scree_problems_count(problems), 1);
    assert_non_null(strstr(scree_problems_get(problems, 0)->message, "bonds"));
    scree_problems_free(problems);
}

/// A few discs, for one allocation after the other.
static void memory_that_runs_out(void **unused)
{
    (void)unused;
    enum { STRIDE = 23 };
    sample s;
    size_t before, after;
    s.c = case_read(HEAD("2", "disc", "30", MADAN) STAGES("solid_fraction: 86 %, gap_scatter: 2 %"), NULL, 0);
    scree_error error;
    check(scree_model_build(&s.c->config, &s.model, &error), &error);
    scree_allocation_statistics(&before, NULL);
    scree_status status = SCREE_ERROR_IO;
    uint64_t failing = 1;
    for (; status != SCREE_OK; failing += STRIDE) {
        (void)scree_allocation_fail_after(failing);
        status = scree_prepare(&s.model, &s.model.stages[0], &s.state, &error);
        if (status) {
            if (status != SCREE_ERROR_IO) fail_msg("%s", error.message);
            assert_null(s.state.row);
            scree_allocation_statistics(&after, NULL);
            assert_int_equal(before, after);
        }
    }
    (void)scree_allocation_fail_after(0);
    assert_true(failing > 20 * STRIDE);
    destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discs_fill_a_square),       cmocka_unit_test(discs_fill_a_cell),
        cmocka_unit_test(spheres_fill_a_cube),       cmocka_unit_test(crowded_spheres_find_room),
        cmocka_unit_test(same_seed_same_sample),     cmocka_unit_test(the_widest_hole_is_found),
        cmocka_unit_test(species_keep_their_sizes),  cmocka_unit_test(large_neighbours_share_an_edge),
        cmocka_unit_test(what_cannot_be_is_refused), cmocka_unit_test(memory_that_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
