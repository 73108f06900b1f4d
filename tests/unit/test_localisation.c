/// Localisation: planted bands are recovered, noise has none, and bands that move are told from those that stay.
#include "testing.h"

#include "base/random.h"
#include "measure/localisation.h"

#include <math.h>
#include <string.h>

#define DIAMETER 1.4e-3
#define assert_near(value, expected, tolerance)                                                                        \
    do {                                                                                                               \
        double value_ = (value), expected_ = (expected), tolerance_ = (tolerance);                                     \
        if (!(fabs(value_ - expected_) <= tolerance_))                                                                 \
            fail_msg("%s: %.6g is not %.6g within %.3g", #value, value_, expected_, tolerance_);                       \
    } while (0)

typedef struct sample {
    scree_assembly assembly;
    scree_cells cells;
    double *field, *body[2];
    uint8_t *inside[2];
} sample;

static double uniform(uint64_t seed, uint64_t k)
{
    return scree_random_uniform(seed, SCREE_RANDOM_TEST, k);
}

/// Bodies on a noisy lattice, twice as high as wide.
static void sample_create(sample *s, int dimension, size_t side)
{
    memset(s, 0, sizeof *s);
    size_t count = side * 2 * side * (dimension == 3 ? side : 1);
    s->assembly = (scree_assembly){.dimension = dimension, .thickness = 1, .count = count};
    assert_int_equal(scree_allocate(&s->assembly.position, 3 * count, sizeof(double), NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s->assembly.radius, count, sizeof(double), NULL), SCREE_OK);
    for (size_t i = 0; i < count; i++) {
        const size_t at[3] = {i % side, dimension == 3 ? i / side % side : i / side, i / side / side};
        for (size_t d = 0; d < (size_t)dimension; d++)
            s->assembly.position[3 * i + d] = DIAMETER * ((double)at[d] + 0.6 * (uniform(1, 3 * i + d) - 0.5));
        s->assembly.radius[i] = DIAMETER / 2;
    }
    assert_int_equal(scree_cells_build(&s->assembly, SCREE_PEEL_RULE(DIAMETER), &s->cells, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s->field, s->cells.count, sizeof(double), NULL), SCREE_OK);
    for (int k = 0; k < 2; k++) {
        assert_int_equal(scree_allocate(&s->body[k], count, sizeof(double), NULL), SCREE_OK);
        assert_int_equal(scree_allocate(&s->inside[k], count, 1, NULL), SCREE_OK);
    }
}

static void sample_destroy(sample *s)
{
    scree_cells_destroy(&s->cells);
    scree_assembly_destroy(&s->assembly);
    scree_release(&s->field);
    for (int k = 0; k < 2; k++) {
        scree_release(&s->body[k]);
        scree_release(&s->inside[k]);
    }
}

/// Exponentially distributed cells (their standard deviation is their mean) with `contrast` times as much in a slab.
static void plant(sample *s, const scree_vector normal, double offset, double thickness, double contrast, uint64_t seed)
{
    scree_vector middle = {0}, at;
    double volume = 0;
    for (size_t k = 0; k < s->cells.count; k++) {
        scree_cell_centre(&s->cells, k, s->assembly.position, at);
        volume += s->cells.volume[k];
        for (int i = 0; i < 3; i++) middle[i] += s->cells.volume[k] * at[i];
    }
    for (size_t k = 0; k < s->cells.count; k++) {
        scree_cell_centre(&s->cells, k, s->assembly.position, at);
        double along = -offset;
        for (int i = 0; i < 3; i++) along += normal[i] * (at[i] - middle[i] / volume);
        s->field[k] = -0.01 * log(1 - uniform(seed, k)) * (fabs(along) <= thickness / 2 ? contrast : 1);
    }
}

static void measure(sample *s, scree_localisation *out, int which)
{
    assert_int_equal(scree_localisation_measure(&s->cells, s->assembly.position, s->field, DIAMETER, out,
                                                s->body[which], s->inside[which], NULL),
                     SCREE_OK);
}

static void test_index_has_its_limits(void **unused)
{
    (void)unused;
    sample s;
    sample_create(&s, 2, 20);
    double all = 0, part = 0;
    for (size_t k = 0; k < s.cells.count; k++) s.field[k] = 3;
    assert_near(scree_localisation_index(&s.cells, s.field), 0, 1e-12);
    for (size_t k = 0; k < s.cells.count; k++) {
        bool inside = k < s.cells.count / 4;
        all += s.cells.volume[k];
        part += inside ? s.cells.volume[k] : 0;
        s.field[k] = inside;
    }
    assert_near(scree_localisation_index(&s.cells, s.field), 1 - part / all, 1e-12);
    for (size_t k = 0; k < s.cells.count; k++) s.field[k] = 0;
    assert_near(scree_localisation_index(&s.cells, s.field), 0, 0);
    sample_destroy(&s);
}

static void test_smoothing_keeps_the_sum(void **unused)
{
    (void)unused;
    sample s;
    scree_node_cells list;
    sample_create(&s, 2, 20);
    assert_int_equal(scree_node_cells_build(&s.cells, &list, NULL), SCREE_OK);
    plant(&s, (const scree_vector){0, 1, 0}, 0, 1, 1, 3);
    double before = scree_cells_mean(&s.cells, s.field), index = scree_localisation_index(&s.cells, s.field);
    assert_int_equal(scree_cells_smooth(&s.cells, &list, 4, s.field, s.body[0], NULL), SCREE_OK);
    assert_near(scree_cells_mean(&s.cells, s.field), before, 1e-12 * before);
    assert_true(scree_localisation_index(&s.cells, s.field) < index / 4);
    for (size_t k = 0; k < s.cells.count; k++) s.field[k] = 2;
    assert_int_equal(scree_cells_smooth(&s.cells, &list, 4, s.field, s.body[0], NULL), SCREE_OK);
    for (size_t k = 0; k < s.cells.count; k++) assert_near(s.field[k], 2, 1e-12);
    scree_node_cells_destroy(&list);
    sample_destroy(&s);
}

/// 3200 discs with a band of 8 diameters and four times the distortion: the angle within 2 degrees, thickness within 2
/// diameters (four bins), the place within 1, the contrast (lowered by the smoothing of the edges) within a third.
static void test_planted_bands_are_recovered(void **unused)
{
    (void)unused;
    sample s;
    sample_create(&s, 2, 40);
    const double angles[4] = {30, 45, 60, 90};
    for (int k = 0; k < 4; k++) {
        scree_localisation found;
        double normal_angle = (90 - angles[k]) * M_PI / 180, offset = DIAMETER * 3 * (k - 1);
        const scree_vector normal = {(k == 2 ? -1 : 1) * sin(normal_angle), cos(normal_angle), 0};
        // Angle between band and axis: 90 degrees less that between its normal and the axis.
        plant(&s, normal, offset, 8 * DIAMETER, 4, 10 + (uint64_t)k);
        measure(&s, &found, 0);
        const scree_band *band = &found.band;
        assert_true(found.localised);
        assert_true(band->found);
        assert_near(band->angle, angles[k], 2);
        double along = band->normal[0] * normal[0] + band->normal[1] * normal[1];
        assert_near(along, 1, 1 - cos(2 * M_PI / 180));
        assert_near(band->thickness / DIAMETER, 8, 2);
        assert_near(band->offset / DIAMETER, offset / DIAMETER, 1);
        assert_near(band->contrast, 4, 1.4);
        assert_near(band->share, 4 * band->volume_fraction / (1 + 3 * band->volume_fraction), 0.1);
        assert_true(band->percolation > 0.9);
    }
    sample_destroy(&s);
}

static void test_half_a_band_does_not_percolate(void **unused)
{
    (void)unused;
    sample s;
    scree_localisation found;
    sample_create(&s, 2, 40);
    plant(&s, (const scree_vector){M_SQRT1_2, M_SQRT1_2, 0}, 0, 8 * DIAMETER, 6, 4);
    for (size_t k = 0; k < s.cells.count; k++) {
        scree_vector at;
        scree_cell_centre(&s.cells, k, s.assembly.position, at);
        if (at[0] > DIAMETER * 24) s.field[k] = 0.01;
    }
    measure(&s, &found, 0);
    assert_true(found.localised);
    assert_true(found.band.percolation < 0.8);
    sample_destroy(&s);
}

static void test_noise_has_no_band(void **unused)
{
    (void)unused;
    sample s;
    sample_create(&s, 2, 40);
    for (uint64_t seed = 20; seed < 25; seed++) {
        scree_localisation found;
        plant(&s, (const scree_vector){0, 1, 0}, 0, DIAMETER, 1, seed);
        measure(&s, &found, 0);
        assert_false(found.localised);
        assert_false(found.band.found);
        assert_true(fabs(found.significance) < 4);
    }
    sample_destroy(&s);
}

static void test_a_field_turned_with_the_sample_gives_the_same(void **unused)
{
    (void)unused;
    sample s;
    scree_localisation before, after;
    sample_create(&s, 2, 40);
    plant(&s, (const scree_vector){0.6, 0.8, 0}, 0, 8 * DIAMETER, 4, 6);
    measure(&s, &before, 0);
    for (size_t i = 0; i < s.assembly.count; i++) {
        double *x = s.assembly.position + 3 * i, old = x[0];
        x[0] = 0.28 * old - 0.96 * x[1];
        x[1] = 0.96 * old + 0.28 * x[1];
    }
    measure(&s, &after, 1);
    // The scan steps by 4 degrees from another direction: within a step of the refinement and a bin.
    assert_near(after.index, before.index, 1e-12);
    assert_near(after.band.thickness, before.band.thickness, 1.01 * 0.5 * DIAMETER);
    const double *n = before.band.normal, turned[2] = {0.28 * n[0] - 0.96 * n[1], 0.96 * n[0] + 0.28 * n[1]};
    assert_near(fabs(turned[0] * after.band.normal[0] + turned[1] * after.band.normal[1]), 1, 1e-3);
    sample_destroy(&s);
}

static void test_planted_band_in_space(void **unused)
{
    (void)unused;
    sample s;
    scree_localisation found;
    sample_create(&s, 3, 14);
    const scree_vector normal = {0.48, 0.36, 0.8};
    plant(&s, normal, DIAMETER, 6 * DIAMETER, 5, 7);
    measure(&s, &found, 0);
    const scree_band *band = &found.band;
    assert_true(found.localised && band->found);
    double along = band->normal[0] * normal[0] + band->normal[1] * normal[1] + band->normal[2] * normal[2];
    assert_true(along > cos(4 * M_PI / 180));
    assert_near(band->thickness / DIAMETER, 6, 2);
    assert_near(band->angle, asin(0.8) * 180 / M_PI, 4);
    assert_true(band->percolation > 0.9);
    plant(&s, normal, 0, DIAMETER, 1, 8);
    measure(&s, &found, 0);
    assert_false(found.localised || found.band.found);
    sample_destroy(&s);
}

/// Windows of a band that moves by `step` diameters from one to the next.
static scree_band_kind run_windows(double step, double contrast, double *persistence, scree_band_window window[6])
{
    sample s;
    sample_create(&s, 2, 40);
    for (int k = 0; k < 6; k++) {
        const scree_vector normal = {M_SQRT1_2, M_SQRT1_2, 0};
        plant(&s, normal, step * DIAMETER * (k - 2.5), 8 * DIAMETER, contrast, 30 + (uint64_t)k);
        measure(&s, &window[k].localisation, k % 2);
        size_t count = s.assembly.count;
        window[k].correlation = k > 0 ? scree_field_correlation(s.body[0], s.body[1], count) : NAN;
        window[k].overlap = k > 0 ? scree_band_overlap(s.inside[0], s.inside[1], count) : NAN;
    }
    sample_destroy(&s);
    return scree_bands_classify(window, 6, persistence);
}

static void test_persistent_intermittent_none(void **unused)
{
    (void)unused;
    scree_band_window window[6];
    double persistence;
    assert_int_equal(run_windows(0, 4, &persistence, window), SCREE_BANDS_PERSISTENT);
    assert_true(persistence > 0.7 && window[5].correlation > 0.6);
    assert_int_equal(run_windows(9, 4, &persistence, window), SCREE_BANDS_INTERMITTENT);
    assert_true(persistence < 0.3 && window[5].correlation < 0.3);
    assert_int_equal(run_windows(0, 1, &persistence, window), SCREE_BANDS_NONE);
    assert_near(persistence, 0, 0);
    assert_int_equal(scree_bands_classify(window, 0, &persistence), SCREE_BANDS_NONE);
    assert_int_equal(scree_bands_classify(window, 1, &persistence), SCREE_BANDS_NONE);
    assert_true(isnan(persistence));
}

static void test_correlation_and_overlap(void **unused)
{
    (void)unused;
    const double a[4] = {1, 2, 3, NAN}, b[4] = {2, 4, 6, 1}, c[4] = {3, 2, 1, 7}, flat[4] = {1, 1, 1, 1};
    assert_near(scree_field_correlation(a, b, 4), 1, 1e-15);
    assert_near(scree_field_correlation(a, c, 4), -1, 1e-15);
    assert_true(isnan(scree_field_correlation(a, flat, 4)));
    const uint8_t one[4] = {1, 1, 0, 0}, other[4] = {0, 1, 1, 0}, none[4] = {0};
    assert_near(scree_band_overlap(one, other, 4), 1.0 / 3, 1e-15);
    assert_near(scree_band_overlap(none, none, 4), 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_index_has_its_limits),
        cmocka_unit_test(test_smoothing_keeps_the_sum),
        cmocka_unit_test(test_planted_bands_are_recovered),
        cmocka_unit_test(test_half_a_band_does_not_percolate),
        cmocka_unit_test(test_noise_has_no_band),
        cmocka_unit_test(test_a_field_turned_with_the_sample_gives_the_same),
        cmocka_unit_test(test_planted_band_in_space),
        cmocka_unit_test(test_persistent_intermittent_none),
        cmocka_unit_test(test_correlation_and_overlap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
