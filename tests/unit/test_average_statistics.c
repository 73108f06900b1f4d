/// Dips of ensembles, means with bands, distributions of forces of known laws, chains, roses.
#include "average_fixture.h"

#include "average/chains.h"
#include "average/dip.h"
#include "average/force_statistics.h"
#include "average/minimum.h"
#include "average/table.h"

enum { POINTS = 21 };

/// Profiles of `piles`: a dome with a dip of `depth`, noise of `noise`, the mirror image of every second one leaning.
static void make_profiles(double *profile, size_t piles, double depth, double noise, uint64_t seed)
{
    for (size_t i = 0; i < piles; i++)
        for (size_t j = 0; j < POINTS; j++) {
            const double x = ((double)j - 10) / 10, top = 1 - x * x;
            profile[i * POINTS + j] = top - depth * exp(-25 * x * x) + 0.2 * x * (i % 2 ? -1 : 1) +
                                      noise * (average_random(seed + i * POINTS + j) - 0.5);
        }
}

static scree_average_dip dip_of(const double *profile, size_t piles)
{
    scree_average_dip dip;
    scree_error error;
    check(scree_average_dip_find(profile, piles, POINTS, &dip, &error), &error);
    return dip;
}

/// Without noise: the dip by its definition, of the mean of each pile and its mirror image.
static void test_dip_exact(void **state)
{
    (void)state;
    double profile[POINTS], most = 0;
    make_profiles(profile, 1, 0.3, 0, 0);
    for (size_t j = 0; j <= 10; j++) most = fmax(most, 0.5 * (profile[10 - j] + profile[10 + j]));
    const scree_average_dip dip = dip_of(profile, 1);
    near(dip.dip, 1 - profile[10] / most, 1e-15);
    near(dip.centre, 0.7, 1e-15);
    assert_true(dip.place > 0.2 && dip.place < 0.5);
    assert_true(isnan(dip.low) && isnan(dip.p) && isnan(dip.checked)); // one pile
    // The mirror image is the same sample.
    double mirror[POINTS];
    for (size_t j = 0; j < POINTS; j++) mirror[j] = profile[POINTS - 1 - j];
    near(dip_of(mirror, 1).dip, dip.dip, 1e-15);
}

/// A dip that is there is found; the least p of 8 piles is 1/256.
static void test_dip_there(void **state)
{
    (void)state;
    double profile[8 * POINTS];
    make_profiles(profile, 8, 0.3, 0.05, 0);
    const scree_average_dip dip = dip_of(profile, 8);
    near(dip.p, 1.0 / 256, 1e-15);
    assert_true(dip.low > 0.1 && dip.low <= dip.dip && dip.dip <= dip.high);
    near(dip.checked, dip.dip, 0.05);
    assert_true(dip.checked_low > 0.1 && dip.checked_low <= dip.checked && dip.checked <= dip.checked_high);
}

/// Without one p is spread nearly as it should be: below 0.05 in 8 of 100 ensembles of 8 flat profiles (of 2000 with 41
/// places 162). Looking for the largest place fools the test by that much and no more.
static void test_dip_absent(void **state)
{
    (void)state;
    double profile[8 * POINTS];
    int small = 0, covered = 0;
    double naive = 0, checked = 0;
    for (uint64_t trial = 0; trial < 100; trial++) {
        for (size_t k = 0; k < 8 * POINTS; k++)
            profile[k] = 1 + 0.3 * (average_random(90000 + trial * 8 * POINTS + k) - 0.5);
        const scree_average_dip dip = dip_of(profile, 8);
        small += dip.p <= 0.05;
        covered += dip.checked_low < 0 && dip.checked_high > 0;
        naive += dip.dip / 100;
        checked += dip.checked / 100;
    }
    // 100 trials at 8 %: more than 12 of them have a probability of 6 %. p <= 0.05 is 12 of 256 flips.
    assert_true(small <= 12);
    // The definition finds a dip in noise, the check none.
    assert_true(naive > 0.03);
    near(checked, 0, 0.012);
    // In 95 of them or more: of resamples the largest place moves about more than of samples.
    assert_true(covered >= 90);
}

/// What one pile does not know at a place is not 0 there, on its axis least of all: places that all know decide.
static void test_dip_of_some(void **state)
{
    (void)state;
    enum { PILES = 6 };
    double profile[PILES * POINTS], more[(PILES + 1) * POINTS];
    make_profiles(profile, PILES, 0.3, 0.1, 4);
    const scree_average_dip whole = dip_of(profile, PILES);
    // A pile of which nothing is known is none.
    memcpy(more, profile, sizeof profile);
    for (size_t j = 0; j < POINTS; j++) more[PILES * POINTS + j] = NAN;
    const scree_average_dip same = dip_of(more, PILES + 1);
    near(same.dip, whole.dip, 0);
    near(same.p, whole.p, 0);
    near(same.low, whole.low, 0);
    near(same.centre, whole.centre, 0);
    // The largest place is left out where one pile has no left side there.
    const size_t most = POINTS / 2 - (size_t)(whole.place * (POINTS / 2) + 0.5);
    profile[2 * POINTS + most] = NAN;
    const scree_average_dip rest = dip_of(profile, PILES);
    assert_true(rest.place != whole.place && rest.dip < whole.dip && rest.most < whole.most);
    near(rest.centre, whole.centre, 0);
    // Without one of its axes nothing is known.
    profile[2 * POINTS + POINTS / 2] = NAN;
    const scree_average_dip none = dip_of(profile, PILES);
    assert_true(isnan(none.dip) && isnan(none.p) && isnan(none.low) && isnan(none.checked));
}

// ---- tables ------------------------------------------------------------------------------------------------------

static void fill(scree_average_table *table, double a, double angle)
{
    scree_error error;
    check(scree_average_table_begin_row(table, &error), &error);
    scree_average_table_take(table, "a", "1", a);
    scree_average_table_take(table, "some_angle", "degree", angle);
    check(scree_average_table_end_row(table, &error), &error);
}

static void test_means(void **state)
{
    (void)state;
    scree_average_table table[4] = {{0}}, mean, low, high;
    scree_error error;
    const double value[4] = {1, 2, 3, NAN}, angle[4] = {85, -85, 89, -89};
    for (int k = 0; k < 4; k++) {
        fill(&table[k], value[k], angle[k]);
        fill(&table[k], 7, 20);
    }
    check(scree_average_table_mean(table, 4, &mean, &low, &high, &error), &error);
    near(scree_average_table_get(&mean, 0, 0), 2, 1e-15);       // of those that have it
    near(fabs(scree_average_table_get(&mean, 0, 1)), 90, 1e-9); // axes on both sides of the vertical
    assert_true(scree_average_table_get(&low, 0, 0) >= 1 && scree_average_table_get(&high, 0, 0) <= 3);
    assert_true(scree_average_table_get(&high, 0, 1) - scree_average_table_get(&low, 0, 1) < 12);
    near(scree_average_table_get(&low, 1, 0), 7, 0);
    near(scree_average_table_get(&mean, 1, 1), 20, 1e-12);
    assert_int_equal(scree_average_table_find(&mean, "some_angle"), 1);
    assert_true(scree_average_table_find(&mean, "other") == SIZE_MAX);
    // Tables of another form are refused.
    fill(&table[1], 0, 0);
    scree_average_table_destroy(&mean);
    assert_int_equal(scree_average_table_mean(table, 4, &mean, NULL, NULL, &error), SCREE_ERROR_INPUT);
    for (int k = 0; k < 4; k++) scree_average_table_destroy(&table[k]);
    scree_average_table_destroy(&low);
    scree_average_table_destroy(&high);
}

/// Numbers that some samples alone have: bands are those of so many samples, and one has none, not one of no width.
static void test_means_of_few(void **state)
{
    (void)state;
    enum { SAMPLES = 9, WITH = 6 };
    scree_average_table part[SAMPLES] = {{0}}, whole[WITH] = {{0}}, mean, low, high, mean_of, low_of, high_of;
    scree_error error;
    for (int k = 0; k < SAMPLES; k++) {
        fill(&part[k], k < WITH ? (double)k : (double)NAN, k == 0 ? 30 : NAN);
        fill(&part[k], k == 5 ? 2 : NAN, k < 2 ? 30 + 10 * (double)k : (double)NAN);
        if (k < WITH) fill(&whole[k], k, 0);
    }
    check(scree_average_table_mean(part, SAMPLES, &mean, &low, &high, &error), &error);
    check(scree_average_table_mean(whole, WITH, &mean_of, &low_of, &high_of, &error), &error);
    near(mean.value[0], mean_of.value[0], 1e-15);
    // The number of those that are drawn varies here, about 6: means scatter by some 8 % more.
    near(high.value[0] - low.value[0], high_of.value[0] - low_of.value[0], 0.15 * (high_of.value[0] - low_of.value[0]));
    near(mean.value[1], 30, 1e-12);
    near(mean.value[2], 2, 0);
    for (int k = 1; k <= 2; k++) assert_true(isnan(low.value[k]) && isnan(high.value[k]));
    near(low.value[3], 30, 1e-12);
    near(high.value[3], 40, 1e-12);
    scree_average_table *const all[] = {&mean, &low, &high, &mean_of, &low_of, &high_of};
    for (int k = 0; k < SAMPLES; k++) scree_average_table_destroy(&part[k]);
    for (int k = 0; k < WITH; k++) scree_average_table_destroy(&whole[k]);
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) scree_average_table_destroy(all[k]);
}

/// Of a table in space angles are elevations, 0 to 90 degrees, whose mean is that of numbers: two axes that lie and one
/// that stands are 30 degrees, and in the plane 0.
static void test_elevations(void **state)
{
    (void)state;
    const double angle[3] = {0, 0, 90};
    for (int space = 0; space < 2; space++) {
        scree_average_table table[3] = {{0}}, mean;
        scree_error error;
        for (int k = 0; k < 3; k++) {
            check(scree_average_table_begin_row(&table[k], &error), &error);
            scree_average_table_take(&table[k], space ? "z" : "y", "m", 1);
            scree_average_table_take(&table[k], "fabric_angle", "degree", angle[k]);
            check(scree_average_table_end_row(&table[k], &error), &error);
        }
        check(scree_average_table_mean(table, 3, &mean, NULL, NULL, &error), &error);
        near(mean.value[1], space ? 30 : 0, 1e-12);
        for (int k = 0; k < 3; k++) scree_average_table_destroy(&table[k]);
        scree_average_table_destroy(&mean);
    }
}

/// How many of 400 ensembles of normal numbers have the mean in their band.
static int count_covered(size_t samples)
{
    int covered = 0;
    for (uint64_t trial = 0; trial < 400; trial++) {
        scree_average_table table[20] = {{0}}, mean, low, high;
        scree_error error;
        for (uint64_t k = 0; k < samples; k++)
            fill(&table[k], scree_random_normal(3, SCREE_RANDOM_TEST, trial * samples + k), 0);
        check(scree_average_table_mean(table, samples, &mean, &low, &high, &error), &error);
        covered += low.value[0] < 0 && high.value[0] > 0;
        for (size_t k = 0; k < samples; k++) scree_average_table_destroy(&table[k]);
        scree_average_table_destroy(&mean);
        scree_average_table_destroy(&low);
        scree_average_table_destroy(&high);
    }
    return covered;
}

/// The band of a mean of normal numbers covers it in 95 % of ensembles, 380 of 400 with a deviation of 4.4, also of
/// six; quantiles at 2.5 and 97.5 % cover it in 87 % of those of six, 348.
static void test_coverage(void **state)
{
    (void)state;
    const int six = count_covered(6), twenty = count_covered(20);
    assert_true(twenty >= 367 && twenty <= 393);
    assert_true(six >= 363 && six <= 393);
}

// ---- forces ------------------------------------------------------------------------------------------------------

/// Exponential forces: the rate above the mean is 1, and the interval covers it in 98.7 % of sets: the mean that is
/// estimated with it leaves e - 1 of the variance e / N that chi square has, and 1.96 (e / (e - 1))^(1/2) deviations
/// are 98.6 %.
static void test_decay(void **state)
{
    (void)state;
    enum { N = 400 };
    double force[N];
    int covered = 0;
    for (uint64_t trial = 0; trial < 200; trial++) {
        for (uint64_t k = 0; k < N; k++) force[k] = -log(1 - average_random(500000 + trial * N + k)) * 17;
        const scree_average_decay decay = scree_average_decay_fit(force, N);
        covered += decay.low < 1 && decay.high > 1;
        assert_true(decay.count > 100);
        // Many forces: the interval is that of a normal mean, with corrections of order 1 / k.
        const double k = (double)decay.count;
        near(decay.low / decay.rate, 1 - 1.96 / sqrt(k), 2 / k);
        near(decay.high / decay.rate, 1 + 1.96 / sqrt(k), 2 / k);
    }
    assert_true(covered >= 191 && covered <= 200); // 197.3, 4 sigma of 1.6
    const double few[3] = {1, 1, 4};
    assert_true(isnan(scree_average_decay_fit(few, 3).rate));
}

static void pick(void *user, const char *name, const char *unit, double value)
{
    (void)unit;
    if (strcmp(name, "sliding_share") == 0) ((double *)user)[0] = value;
    if (strcmp(name, "mobilised_friction") == 0) ((double *)user)[1] = value;
    if (strcmp(name, "force_mean") == 0) ((double *)user)[2] = value;
    if (strcmp(name, "bottom_force_mean") == 0) ((double *)user)[3] = value;
    if (strcmp(name, "bottom_share_to_half") == 0) ((double *)user)[4] = value;
    if (strcmp(name, "bottom_share_to_one") == 0) ((double *)user)[5] = value;
    if (strcmp(name, "force_strong_share") == 0) ((double *)user)[6] = value;
}

/// Grains side by side on a floor, with forces of 1, 3, 3, 3, 4, 6, 6, 38: mean 8, so n is 1/8, 3/8 (3), 1/2, 3/4 (2)
/// and 19/4.
static void test_shares(void **state)
{
    (void)state;
    const double force[8] = {1, 3, 3, 3, 4, 6, 6, 38};
    double of[7] = {0};
    scree_average_sample s = average_begin(2);
    scree_error error;
    for (uint32_t k = 0; k < 8; k++) {
        (void)average_add(&s, 2.0 * k, 1, 0, 1);
        average_stand(&s, k, (double[3]){2.0 * k, 0, 0}, (double[3]){0, force[k], 0});
    }
    average_finish(&s);
    check(scree_average_forces_tell(&s, pick, of, &error), &error);
    near(of[3], 8, 1e-14);
    near(of[4], 4 / 8.0, 1e-15);
    near(of[5], 3 / 8.0, 1e-15);
    near(of[6], 1 / 8.0, 1e-15);
    scree_average_sample_destroy(&s);
}

/// A lattice: all forces known, densities integrate to one, contacts in four directions.
static void test_lattice_forces(void **state)
{
    (void)state;
    const double fx = 3, fy = 5;
    scree_average_sample s = average_lattice(8, 0.5, fx, fy);
    scree_error error;
    double of[7] = {0}, sum[2] = {0}, contacts = 0;
    for (size_t c = 0; c < s.contacts; c++) s.contact[c].sliding = c % 2 == 0;
    for (size_t c = 0; c < s.contacts; c++) s.contact[c].tangential_force = 0.25 * s.contact[c].normal_force;
    average_finish(&s);
    check(scree_average_forces_tell(&s, pick, of, &error), &error);
    near(of[0], 0.5, 1e-15);
    near(of[1], 0.25, 1e-14);
    near(of[2], 0.5 * (fx + fy), 1e-13);
    near(of[3], fy, 1e-13);
    scree_average_table forces = {0}, rose = {0}, friction = {0};
    check(scree_average_forces_table(&s, &forces, &error), &error);
    check(scree_average_rose_table(&s, &rose, &error), &error);
    check(scree_average_friction_table(&s, &friction, &error), &error);
    for (size_t k = 0; k < forces.rows; k++) {
        const int scale = (int)scree_average_table_get(&forces, k, 0);
        sum[scale] += scree_average_table_get(&forces, k, 3) *
                      (scree_average_table_get(&forces, k, 2) - scree_average_table_get(&forces, k, 1));
        if (k > 0 && scale == (int)scree_average_table_get(&forces, k - 1, 0))
            near(scree_average_table_get(&forces, k, 1), scree_average_table_get(&forces, k - 1, 2), 1e-12);
    }
    near(sum[0], 1, 1e-13);
    near(sum[1], 1, 1e-13);
    for (size_t k = 0; k < rose.rows; k++) {
        const double density = scree_average_table_get(&rose, k, 1);
        contacts += density / (double)rose.rows;
        near(density, k % 9 == 0 ? 9 : 0, 1e-13); // right, up, left, down
        if (k % 9 == 0) near(scree_average_table_get(&rose, k, 2), (k % 18 ? fy : fx) / 4, 1e-13);
    }
    near(contacts, 1, 1e-13);
    for (size_t k = 0; k < friction.rows; k++) near(scree_average_table_get(&friction, k, 2), k == 10 ? 40 : 0, 1e-12);
    scree_average_table_destroy(&forces);
    scree_average_table_destroy(&rose);
    scree_average_table_destroy(&friction);
    scree_average_sample_destroy(&s);
}

// ---- chains ------------------------------------------------------------------------------------------------------

/// A loaded column among grains that bear little is one chain; a bend of more than the angle ends it.
static void test_chains(void **state)
{
    (void)state;
    enum { N = 10 };
    for (int bent = 0; bent < 2; bent++) {
        scree_average_sample s = average_begin(2);
        scree_average_chains chains;
        scree_error error;
        uint8_t linked[ROOM];
        for (uint32_t k = 0; k < N; k++) {
            // Upwards, or from the middle on to the right.
            const double right = bent && k > 4 ? 2.0 * (k - 4) : 0, up = bent && k > 4 ? 8 : 2.0 * k;
            (void)average_add(&s, right, up, 0, 1);
            const double along[3] = {right > 0 ? 12 : 0, right > 0 ? 0 : 10, 0};
            if (k > 0) average_touch(&s, k, k - 1, along);
        }
        average_stand(&s, 0, (double[3]){0, -1, 0}, (double[3]){0, 10, 0});
        const double *end = s.grain[N - 1].position, out = bent ? 1 : 0;
        average_stand(&s, N - 1, (double[3]){end[0] + out, end[1] + 1 - out, 0},
                      (double[3]){-12 * out, -10 + 10 * out, 0});
        for (int k = 0; k < 30; k++) { // bystanders
            const uint32_t one = average_add(&s, 50 + 3 * k, 0, 0, 1);
            average_stand(&s, one, (double[3]){50 + 3 * k, -1, 0}, (double[3]){0, 0.1, 0});
            average_stand(&s, one, (double[3]){50 + 3 * k, 1, 0}, (double[3]){0, -0.1, 0});
        }
        for (int k = 0; k < 3; k++) { // a column that bears less than the mean is none
            const uint32_t one = average_add(&s, 300, 2.0 * k, 0, 1);
            if (k > 0) average_touch(&s, one, one - 1, (double[3]){0, 0.1, 0});
        }
        average_finish(&s);
        check(scree_average_chains_find(&s, M_PI / 6, linked, &chains, &error), &error);
        assert_int_equal(chains.chains, bent ? 2 : 1);
        assert_int_equal(chains.longest, bent ? 6 : N);
        // The grain at the bend, pressed more from the side, belongs to the chain that goes there.
        assert_int_equal(chains.grains, N);
        near(chains.grain_share, N / 43.0, 1e-15);
        assert_true(chains.pressure_share > 0.85);
        size_t links = 0;
        for (size_t c = 0; c < s.contacts; c++) links += linked[c];
        assert_int_equal(links, bent ? N - 2 : N - 1);
        scree_average_sample_destroy(&s);
    }
}

/// Profiles of `heaps` about an axis: highest at two places with a valley between them, and some noise.
static void make_valleys(double *profile, size_t heaps, double valley, double depth, double noise, uint64_t seed)
{
    for (size_t i = 0; i < heaps; i++)
        for (size_t j = 0; j < POINTS; j++) {
            const double x = ((double)j - 10) / 10, off = x - valley;
            profile[i * POINTS + j] =
                1 - off * off - depth * exp(-25 * off * off) + noise * (average_random(seed + i * POINTS + j) - 0.5);
        }
}

static scree_average_minimum minimum_of(const double *profile, const double *apex, size_t heaps)
{
    scree_average_minimum minimum;
    scree_error error;
    check(scree_average_minimum_find(profile, apex, heaps, POINTS, &minimum, &error), &error);
    return minimum;
}

/// Without noise: a valley at 0.3, both of whose shoulders lie to the right of an apex at -0.1; the lower one counts.
static void test_minimum_exact(void **state)
{
    (void)state;
    double profile[POINTS], left = 0, right = 0;
    const double apex = -0.1;
    make_valleys(profile, 1, 0.3, 0.4, 0, 0);
    profile[10] += 0.01; // the left shoulder, 0.3 from the valley, is the higher one
    for (size_t j = 0; j < 13; j++) left = fmax(left, profile[j]);
    for (size_t j = 14; j < POINTS; j++) right = fmax(right, profile[j]);
    assert_true(left > right);
    scree_average_minimum m = minimum_of(profile, &apex, 1);
    near(m.place.value, 0.4, 1e-12);
    near(m.depth.value, 1 - profile[13] / right, 1e-12);
    near(m.highest.value, 0.1, 1e-12);
    assert_true(isnan(m.place.low) && isnan(m.depth.high) && isnan(m.share)); // one heap
    // The mirror image has it as far on the other side.
    double mirror[POINTS];
    const double other = -apex;
    for (size_t j = 0; j < POINTS; j++) mirror[j] = profile[POINTS - 1 - j];
    near(minimum_of(mirror, &other, 1).place.value, -0.4, 1e-12);
    near(minimum_of(mirror, &other, 1).highest.value, -0.1, 1e-12);
    // A dome has none, wherever its apex lies; its top is found.
    make_valleys(profile, 1, 0.3, 0, 0, 0);
    for (int k = -9; k <= 9; k++) {
        const double at = 0.1 * k + 0.03;
        m = minimum_of(profile, &at, 1);
        assert_true(isnan(m.place.value));
        near(m.depth.value, 0, 1e-15);
        near(m.highest.value, 0.3 - at, 1e-12);
    }
}

/// Of an ensemble the place has an interval, also where each heap has another apex; a dome with noise has a minimum in
/// some resamples alone, and one whose heaps say nothing (NAN) none.
static void test_minimum_of_ensembles(void **state)
{
    (void)state;
    double profile[8 * POINTS], apex[8];
    for (size_t i = 0; i < 8; i++) apex[i] = 0.01 * (double)i - 0.035;
    make_valleys(profile, 8, 0.1, 0.4, 0.1, 4000);
    scree_average_minimum m = minimum_of(profile, apex, 8);
    near(m.share, 1, 0);
    near(m.place.value, 0.1, 1e-12);
    assert_true(m.place.low < 0.1 && m.place.high > 0.1 && m.place.high - m.place.low < 0.3);
    assert_true(m.depth.low > 0.1 && m.depth.low <= m.depth.value && m.depth.value <= m.depth.high);
    make_valleys(profile, 8, 0.1, 0, 0.1, 5000);
    m = minimum_of(profile, apex, 8);
    assert_true(m.share > 0 && m.share < 1 && m.depth.low < 0.01);
    for (size_t k = 0; k < 8 * POINTS; k++) profile[k] = NAN;
    m = minimum_of(profile, apex, 8);
    assert_true(isnan(m.depth.value) && isnan(m.place.value));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_minimum_exact), cmocka_unit_test(test_minimum_of_ensembles),
        cmocka_unit_test(test_dip_exact),     cmocka_unit_test(test_dip_there),
        cmocka_unit_test(test_dip_absent),    cmocka_unit_test(test_dip_of_some),
        cmocka_unit_test(test_means_of_few),  cmocka_unit_test(test_elevations),
        cmocka_unit_test(test_means),         cmocka_unit_test(test_coverage),
        cmocka_unit_test(test_decay),         cmocka_unit_test(test_lattice_forces),
        cmocka_unit_test(test_shares),        cmocka_unit_test(test_chains),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
