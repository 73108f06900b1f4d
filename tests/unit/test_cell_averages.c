/// Averages of cell fields over regions, circles and windows, and the roughness of a round sample: fields whose answers
/// are known in closed form.
#include "testing.h"

#include "base/random.h"
#include "measure/measure.h"
#include "run/cell_averages.h"

#include <scree/scree.h>

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define D 1e-3 ///< spacing of the grains

/// Grains on a noisy lattice, twice as high as wide; sides bulge by `bulge` of the width in the middle of the height.
static void make_assembly(scree_assembly *a, int dimension, size_t side, double bulge)
{
    *a = (scree_assembly){.dimension = dimension, .thickness = 1};
    a->count = 2 * side * side * (dimension == 3 ? side : 1);
    assert_int_equal(scree_allocate(&a->position, 3 * a->count, sizeof(double), NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&a->radius, a->count, sizeof(double), NULL), SCREE_OK);
    for (size_t id = 0; id < a->count; id++) {
        const size_t at[3] = {id % side, dimension == 3 ? id / side % side : id / side, id / side / side};
        double *x = &a->position[3 * id];
        for (int i = 0; i < dimension; i++)
            x[i] = D * ((double)at[i] + 0.3 * scree_random_uniform(5, SCREE_RANDOM_TEST, 3 * id + (size_t)i));
        double u = x[dimension - 1] / (D * (double)side) - 1;
        for (int i = 0; i < dimension - 1; i++) x[i] = (x[i] - 0.5 * D * (double)side) * (1 + bulge * (1 - u * u));
        a->radius[id] = D / 2;
    }
}

static void make_snapshot(scree_cell_snapshot *s, int dimension, size_t side, double bulge)
{
    *s = (scree_cell_snapshot){.stage = "compress"};
    make_assembly(&s->assembly, dimension, side, bulge);
    assert_int_equal(scree_cells_build(&s->assembly, SCREE_PEEL_RULE(3 * D), &s->cells, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s->cells.stress, s->cells.count, sizeof *s->cells.stress, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s->cells.pressure, s->cells.count, sizeof(double), NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s->cells.distortion, s->cells.count, sizeof(double), NULL), SCREE_OK);
}

/// Coordinates of a cell: h from -1 to 1 along the height, u from 0 to 1 from the middle to the side.
static void coordinates(const scree_cell_snapshot *s, size_t k, size_t side, double bulge, double *h, double *u)
{
    scree_vector at;
    int axis = s->cells.dimension - 1;
    scree_cell_centre(&s->cells, k, s->assembly.position, at);
    *h = at[axis] / (D * (double)side) - 1;
    *u = 0;
    for (int i = 0; i < axis; i++) *u = fmax(*u, fabs(2 * at[i] / (D * (double)side * (1 + bulge * (1 - *h * *h)))));
}

/// Means of h^2 and u^2 over the regions are integrals; a layer of cells at an edge is 1/SIDE of the width, and the
/// fields change there by 2/SIDE of their own: that much is left to the tolerance.
static void regions_lie_where_they_should(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (double bulge = 0; bulge < 0.4; bulge += 0.3) {
            size_t side = dimension == 2 ? 40 : 14;
            scree_cell_snapshot s;
            double mean[SCREE_REGION_COUNT], tolerance = 2.0 / (double)side;
            make_snapshot(&s, dimension, side, bulge);
            for (size_t k = 0; k < s.cells.count; k++) {
                double h, u;
                coordinates(&s, k, side, bulge, &h, &u);
                s.cells.pressure[k] = h * h;
                s.cells.distortion[k] = u * u;
            }
            scree_cells_region_means(&s.cells, s.assembly.position, s.cells.pressure, mean);
            // int h^2 over 3/4 < h < 1, over 1/4 of it; and over h < 1/2, over 1/2 of it
            assert_true(fabs(mean[SCREE_REGION_PLATES] - 37.0 / 48) < tolerance);
            assert_true(fabs(mean[SCREE_REGION_CORE] - 1.0 / 12) < tolerance);
            assert_true(mean[SCREE_REGION_SIDES] < 0.75 * 0.75 / 3 + tolerance);
            scree_cells_region_means(&s.cells, s.assembly.position, s.cells.distortion, mean);
            // the same for u, which in space is spread as 2 u du
            assert_true(fabs(mean[SCREE_REGION_SIDES] - (dimension == 2 ? 37.0 / 48 : 25.0 / 32)) < tolerance);
            assert_true(fabs(mean[SCREE_REGION_CORE] - (dimension == 2 ? 1.0 / 12 : 1.0 / 8)) < tolerance);
            scree_cell_snapshot_destroy(&s);
        }
}

// ---- a series by hand --------------------------------------------------------------------------------------------

enum { COLUMNS = 6, ROWS = 3 };
static double columns[COLUMNS][ROWS];

static scree_series make_series(void)
{
    static char name[COLUMNS][32] = {"time",
                                     "boundary_axial_strain",
                                     "boundary_lateral_strain",
                                     "boundary_lateral_strain_y",
                                     "stress_axial_contacts",
                                     "stress_lateral_contacts"};
    static char *names[COLUMNS];
    static double *values[COLUMNS];
    for (int c = 0; c < COLUMNS; c++) {
        names[c] = name[c];
        values[c] = columns[c];
    }
    return (scree_series){.column_count = COLUMNS, .row_count = ROWS, .name = names, .value = values};
}

static double result(scree_summary *summary, const char *name)
{
    char file[] = "/tmp/scree-test-XXXXXX";
    int handle = mkstemp(file);
    assert_true(handle >= 0);
    close(handle);
    assert_int_equal(scree_summary_write(summary, file, NULL), SCREE_OK);
    json_t *root = json_load_file(file, 0, NULL);
    json_t *value = json_object_get(root, name);
    double number = value ? json_number_value(value) : NAN;
    json_decref(root);
    unlink(file);
    return number;
}

/// Two places in one circle are near the mean from 2 diameters on, the third from 3 on, and it comes back out at 5.
static void circles_are_summed_up(void **unused)
{
    (void)unused;
    enum { SIZES = 6 };
    static const double ratio[SCREE_CIRCLES][SIZES] = {
        {1.5, 1.05, 1, 1, 1, 1}, {NAN, 1.05, 1, 1, 1, 1}, {1, 1, 0.8, 1, 1.2, 1}};
    // NAN has no cells; the squares are 0.25, 2 x 0.0025, 0.04 and 0.04 of 17 circles.
    const double spread = sqrt(0.335 / 17);
    const scree_config_window window = {0.07, 0.085};
    const scree_config config = {.measure = {.windows = (scree_config_window *)(uintptr_t)&window, .window_count = 1}};
    scree_cell_averages averages;
    scree_cell_snapshot s;
    scree_summary *summary;
    make_snapshot(&s, 2, 6, 0);
    scree_cell_averages_begin(&averages, &config.measure, NULL);
    const double strains[] = {0.06, 0.07, 0.08, 0.09};
    for (int k = 0; k < 4; k++) {
        s.axial_strain = strains[k];
        assert_int_equal(scree_cell_averages_add(&averages, &s, &ratio[0][0], SIZES, NULL), SCREE_OK);
    }
    assert_true(averages.instants == 2);
    assert_int_equal(scree_summary_create(&summary, NULL), SCREE_OK);
    scree_cell_averages_summarise(&averages, 2, summary);
    assert_true(fabs(result(summary, "circle_pressure_spread") - spread) < 1e-12);
    assert_true(result(summary, "circle_pressure_diameter") == 6);
    // From 4 diameters on there are 9, and one of them is off, by 0.2.
    assert_true(fabs(result(summary, "circle_pressure_spread_wide") - 0.2 / 3) < 1e-12);
    scree_summary_destroy(summary);
    // Without the return: 4. Never near: the largest.
    double other[SCREE_CIRCLES * SIZES];
    memcpy(other, ratio, sizeof other);
    other[2 * SIZES + 4] = 1;
    scree_cell_averages_begin(&averages, &config.measure, NULL);
    assert_int_equal(scree_cell_averages_add(&averages, &s, other, SIZES, NULL), SCREE_OK); // out of the window
    assert_true(averages.instants == 0);
    s.axial_strain = 0.08;
    assert_int_equal(scree_cell_averages_add(&averages, &s, other, SIZES, NULL), SCREE_OK);
    assert_true(averages.diameter == 4);
    other[SIZES - 1] = 2;
    assert_int_equal(scree_cell_averages_add(&averages, &s, other, SIZES, NULL), SCREE_OK);
    assert_true(averages.diameter == 4 + SIZES);
    scree_cell_snapshot_destroy(&s);
}

/// 4.6 in a layer at either end, of a twentieth of the height, 3.5 in the middle three tenths, 1 elsewhere: 2.2
/// and 1.66 of the mean of 2.11.
static void strong_cells_are_counted_where_they_are(void **unused)
{
    (void)unused;
    enum { SIDE = 40 };
    const double ratio[SCREE_CIRCLES] = {1, 1, 1};
    const scree_config config = {0};
    scree_cell_averages averages;
    scree_cell_snapshot s;
    scree_summary *summary;
    double h, u;
    make_snapshot(&s, 2, SIDE, 0);
    for (size_t k = 0; k < s.cells.count; k++) {
        coordinates(&s, k, SIDE, 0, &h, &u);
        s.cells.pressure[k] = fabs(h) > 0.9 ? 4.6 : fabs(h) < 0.3 ? 3.5 : 1;
        // 2.7 and 1.7 of a mean of 1.78.
        s.cells.distortion[k] = fabs(h) < 0.1 ? 4.8 : fabs(h) < 0.3 ? 3 : 1;
    }
    s.axial_strain = 0.08;
    scree_cell_averages_begin(&averages, &config.measure, NULL);
    assert_int_equal(scree_cell_averages_add(&averages, &s, ratio, 1, NULL), SCREE_OK);
    assert_int_equal(scree_summary_create(&summary, NULL), SCREE_OK);
    scree_cell_averages_summarise(&averages, 2, summary);
    // The ends of the regions are an eighth of the height each; a layer of cells is a fortieth.
    assert_true(fabs(result(summary, "plate_strong_share") - 0.4) < 0.1);
    assert_true(result(summary, "side_strong_share") == 0 && result(summary, "core_strong_share") == 0);
    assert_true(result(summary, "plate_deformed_share") == 0);
    assert_true(fabs(result(summary, "core_deformed_share") - 0.2) < 0.05);
    assert_true(isnan(result(summary, "circle_pressure_spread_wide")));
    scree_summary_destroy(summary);
    scree_cell_snapshot_destroy(&s);
}

/// A uniform field of cells against a sample that says one tenth more along one axis.
static void cells_are_compared_with_the_sample(void **unused)
{
    (void)unused;
    const scree_config config = {0};
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double rate[3] = {-0.01, dimension == 3 ? -0.02 : 0.03, dimension == 3 ? 0.04 : 0};
        scree_cell_snapshot first, second;
        scree_cell_averages averages;
        scree_summary *summary;
        make_snapshot(&first, dimension, 6, 0);
        make_snapshot(&second, dimension, 6, 0);
        first.time = 1;
        second.time = 2;
        for (size_t k = 0; k < first.cells.count; k++)
            for (int i = 0; i < 3; i++) first.cells.stress[k][4 * i] = i < dimension ? -(double)(i + 1) : 0;
        for (size_t i = 0; i < 3 * first.assembly.count; i++) second.assembly.position[i] *= 1 - rate[i % 3];
        int axial = dimension - 1;
        for (int k = 0; k < ROWS; k++) {
            // Logarithmic strains, compression positive; row 0 belongs to a stage that ended at the same time.
            double share = k == 2 ? 1 : 0;
            columns[0][k] = k == 2 ? 2 : 1;
            columns[1][k] = k == 0 ? 7 : -share * log(1 - rate[axial]);
            columns[2][k] = k == 0 ? 7 : -share * 0.5 * (log(1 - rate[0]) + log(1 - rate[dimension == 3]));
            columns[3][k] = dimension == 3 ? -share * log(1 - rate[1]) : NAN;
            columns[4][k] = 1.1 * dimension;
            columns[5][k] = dimension == 3 ? 1.5 : 1;
        }
        const scree_series series = make_series();
        scree_cell_averages_begin(&averages, &config.measure, &series);
        const double ratio[SCREE_CIRCLES] = {1, 1, 1};
        assert_int_equal(scree_cell_averages_add(&averages, &first, ratio, 1, NULL), SCREE_OK);
        assert_int_equal(scree_cell_averages_strain(&averages, &first, &second, NULL), SCREE_OK);
        assert_int_equal(scree_summary_create(&summary, NULL), SCREE_OK);
        scree_cell_averages_summarise(&averages, dimension, summary);
        double lateral = dimension == 3 ? 2 * 1.5 * 1.5 : 1;
        double expected = 0.1 * dimension / sqrt(1.21 * dimension * dimension + lateral);
        assert_true(fabs(result(summary, "cell_stress_disagreement") - expected) < 1e-12);
        // The middle configuration leaves strain^2 / 12 of a window open: 0.04^2 / 12.
        assert_true(result(summary, "cell_strain_disagreement") < 1.5e-4);
        scree_summary_destroy(summary);
        // With one component wrong it shows.
        columns[1][2] *= 1.1;
        assert_int_equal(scree_summary_create(&summary, NULL), SCREE_OK);
        scree_cell_averages_summarise(&averages, dimension, summary);
        assert_true(result(summary, "cell_strain_disagreement") > 0.05);
        scree_summary_destroy(summary);
        scree_cell_snapshot_destroy(&first);
        scree_cell_snapshot_destroy(&second);
    }
}

/// Everything shrinks alike from snapshot to snapshot, and each time the cells of more bodies near one side are left
/// out: the first is strain, the second a renewal, and the volumes at the ends hold both.
static void renewals_of_cells_are_no_strain(void **unused)
{
    (void)unused;
    enum { SNAPSHOTS = 4, SIDE = 10 };
    const double scale = 0.99, ratio[SCREE_CIRCLES] = {1, 1, 1};
    const scree_config config = {0};
    for (int d = 2; d <= 3; d++) {
        scree_cell_snapshot s[SNAPSHOTS];
        scree_cell_averages averages;
        scree_summary *summary;
        double volume[SNAPSHOTS] = {0}, size = 1, renewed = 0;
        scree_cell_averages_begin(&averages, &config.measure, NULL);
        for (int n = 0; n < SNAPSHOTS; n++, size *= scale) {
            make_snapshot(&s[n], d, d == 2 ? SIDE : SIDE / 2, 0);
            s[n].time = n;
            size_t kept = 0;
            for (size_t k = 0; k < s[n].cells.count; k++)
                if (s[n].cells.node[k][0] >= 3 * (size_t)n) memcpy(s[n].cells.node[kept++], s[n].cells.node[k], 16);
            assert_true(n == 0 || kept < s[n - 1].cells.count);
            s[n].cells.count = kept;
            for (size_t k = 0; k < kept; k++) volume[n] += scree_cell_volume_at(&s[n].cells, k, s[n].assembly.position);
            for (size_t i = 0; i < 3 * s[n].assembly.count; i++) s[n].assembly.position[i] *= size;
            assert_int_equal(scree_cell_averages_add(&averages, &s[n], ratio, 1, NULL), SCREE_OK);
            if (n == 0) continue;
            assert_int_equal(scree_cell_averages_strain(&averages, &s[n - 1], &s[n], NULL), SCREE_OK);
            renewed += log(volume[n] / volume[n - 1]);
        }
        assert_int_equal(scree_summary_create(&summary, NULL), SCREE_OK);
        scree_cell_averages_summarise(&averages, d, summary);
        const double strain = (SNAPSHOTS - 1) * d * 2 * (1 - scale) / (1 + scale);
        const double whole = -log(pow(scale, d * (SNAPSHOTS - 1)) * volume[SNAPSHOTS - 1] / volume[0]);
        assert_true(renewed < -0.02);
        assert_true(fabs(result(summary, "cell_volumetric_strain") - strain) < 1e-12);
        assert_true(fabs(result(summary, "cell_volumetric_strain_renewed") + renewed) < 1e-12);
        assert_true(fabs(result(summary, "cell_volumetric_strain_enclosed") - whole) < 1e-12);
        // The trace of an increment is its logarithm to third order.
        assert_true(fabs(strain - renewed - whole) < d * (SNAPSHOTS - 1) * pow(1 - scale, 3));
        scree_summary_destroy(summary);
        for (int n = 0; n < SNAPSHOTS; n++) scree_cell_snapshot_destroy(&s[n]);
    }
}

// ---- roughness ---------------------------------------------------------------------------------------------------

/// Grains on circles, moved by an affine map after six waves of height `wave` around the boundary.
static double roughness_of(double wave, double xx, double xy, double yx, double yy)
{
    enum { RINGS = 30 };
    scree_state state;
    double roughness;
    const scree_model model = {.dimension = 2, .mean_radius = D / 2};
    assert_int_equal(scree_state_create(&state, 2, 3 * RINGS * (RINGS + 1), NULL), SCREE_OK);
    size_t row = 0;
    for (int ring = 1; ring <= RINGS; ring++)
        for (int k = 0; k < 6 * ring; k++, row++) {
            double turn = 2 * M_PI * k / (6 * ring), r = D * ring,
                   moved = r + wave * pow(r / (D * RINGS), 6) * cos(6 * turn);
            state.id[row] = state.row_of_id[row] = (uint32_t)row;
            state.reference[row][0] = r * cos(turn) + 1;
            state.reference[row][1] = r * sin(turn) - 2;
            double x = moved * cos(turn), y = moved * sin(turn);
            state.row[row].x = 5 + (1 + xx) * x + xy * y;
            state.row[row].y = yx * x + (1 + yy) * y;
        }
    assert_int_equal(scree_boundary_roughness(&model, &state, &roughness, NULL), SCREE_OK);
    scree_state_destroy(&state);
    return roughness;
}

static void roughness_is_what_is_not_affine(void **unused)
{
    (void)unused;
    assert_true(roughness_of(0, 0, 0, 0, 0) < 1e-9);
    assert_true(roughness_of(0, -0.1, 0.3, 0.05, 0.2) < 1e-9);
    // Waves of height a around the circle: a / sqrt 2. The sample of sectors two diameters wide takes the outermost
    // grain of each, 1/15 of a wave: below 5 %.
    double plain = roughness_of(2 * D, 0, 0, 0, 0);
    assert_true(fabs(plain / M_SQRT2 - 1) < 0.05);
    // The affine motion does not matter: it is pulled back.
    assert_true(fabs(roughness_of(2 * D, -0.1, 0.3, 0.05, 0.2) / plain - 1) < 1e-3);
}

// ---- corners -----------------------------------------------------------------------------------------------------

/// A square lattice whose grains within four diameters of some corners have moved outwards by `way` of the width.
static scree_corner_motion corners_of(const double way[4])
{
    enum { COUNT = 81 };
    scree_state state;
    scree_corner_motion corners;
    const double width = D * (COUNT - 1);
    const scree_model model = {.dimension = 2, .mean_radius = D / 2};
    assert_int_equal(scree_state_create(&state, 2, COUNT * COUNT, NULL), SCREE_OK);
    for (size_t row = 0; row < COUNT * COUNT; row++) {
        double x = D * (double)(row % COUNT), y = D * (double)(row / COUNT);
        state.id[row] = state.row_of_id[row] = (uint32_t)row;
        state.reference[row][0] = x;
        state.reference[row][1] = y;
        state.row[row].x = x;
        state.row[row].y = y;
        for (int k = 0; k < 4; k++)
            if (hypot(x - width * (k % 2), y - width * (k / 2)) <= 4 * D) {
                state.row[row].x += way[k] * width;
                state.angle[row] += k % 2 ? -0.2 : 0.2;
            }
        state.angle[row] += state.angle[row] < 0 ? -0.1 : 0.1;
    }
    assert_int_equal(scree_corner_distortion(&model, &state, &corners, NULL), SCREE_OK);
    scree_state_destroy(&state);
    return corners;
}

static void corners_are_told_from_the_rest(void **unused)
{
    (void)unused;
    // 17 of 6561 grains at a corner: the affine motion takes up 1 % of it at most.
    const scree_corner_motion one = corners_of((const double[]){0.1, 0, 0, 0}),
                              all = corners_of((const double[]){0.1, -0.1, -0.1, 0.1}),
                              none = corners_of((const double[]){0, 0, 0, 0});
    assert_true(fabs(one.largest / 0.1 - 1) < 0.03 && fabs(one.root_mean_square / 0.05 - 1) < 0.03);
    assert_true(fabs(all.largest / 0.1 - 1) < 0.03 && fabs(all.root_mean_square / 0.1 - 1) < 0.03);
    assert_true(none.largest < 1e-12 && none.root_mean_square < 1e-12);
    // 68 of 6561 turn by 0.3, to either side, the others by 0.1 (a few at the edge of a corner count or do not).
    assert_true(fabs(none.rolling / (3 / (1 + 2 * 68.0 / 6561)) - 1) < 0.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regions_lie_where_they_should),           cmocka_unit_test(circles_are_summed_up),
        cmocka_unit_test(strong_cells_are_counted_where_they_are), cmocka_unit_test(cells_are_compared_with_the_sample),
        cmocka_unit_test(renewals_of_cells_are_no_strain),         cmocka_unit_test(roughness_is_what_is_not_affine),
        cmocka_unit_test(corners_are_told_from_the_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
