/// Cells in run.h5 and back, and what is made of them at the end of a run.
#include "testing.h"

#include "base/random.h"
#include "io/cell_file.h"
#include "io/run_directory.h"
#include "io/series.h"
#include "io/snapshot.h"
#include "io_scratch.h"
#include "run/cell_results.h"

#include <scree/scree.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define SPACING 1.5e-3

static const scree_config config = {.measure = {.cells = true}};

static scree_model model_of(int dimension)
{
    return (scree_model){.upkeep = {.gap_limit = 1},
                         .dimension = dimension,
                         .scheme = SCREE_SLOT_position_verlet,
                         .thickness = 1e-3,
                         .mean_radius = SPACING / 2,
                         .density = {1}};
}

/// A noisy lattice; rows in the reverse order of ids.
static void create_state(scree_state *state, int dimension, size_t side)
{
    size_t count = 2 * side * side * (dimension == 3 ? side : 1);
    assert_int_equal(scree_state_create(state, dimension, count, NULL), SCREE_OK);
    state->force_quantum = state->torque_quantum = 1;
    for (size_t row = 0; row < count; row++) {
        size_t id = count - 1 - row;
        const size_t at[3] = {id % side, dimension == 3 ? id / side % side : id / side, id / side / side};
        double x[3];
        for (size_t d = 0; d < 3; d++)
            x[d] = SPACING * ((double)at[d] + 0.4 * scree_random_uniform(5, SCREE_RANDOM_TEST, 3 * id + d));
        state->id[row] = (uint32_t)id;
        state->row_of_id[id] = (uint32_t)row;
        state->row[row] = (scree_row){.x = x[0], .y = x[1], .radius = SPACING / 2, .vx = x[1], .mass = 1};
        if (dimension == 3) {
            state->row[row].z = x[2];
            state->row[row].vz = -x[0];
        }
    }
}

static void write_snapshot(const char *directory, const scree_state *state, int64_t index, double strain,
                           bool with_cells)
{
    scree_model model = model_of(state->dimension);
    scree_contact contact = {.first = 5, .second = 6, .normal = {1}, .normal_force = 3, .branch = {SPACING}};
    scree_contact_table table = {.contact = &contact, .count = 1};
    scree_cells cells;
    assert_int_equal(scree_cells_measure(&model, state, &table, &cells, NULL), SCREE_OK);
    const scree_snapshot_info info = {.index = index,
                                      .time = (double)index,
                                      .axial_strain = strain,
                                      .stage = "compress",
                                      .cells = with_cells ? &cells : NULL};
    scree_error error = {0};
    if (scree_snapshot_write(directory, &model, state, &table, &info, &error)) fail_msg("%s", error.message);
    scree_cells_destroy(&cells);
}

static void test_cells_come_back(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        char directory[64];
        assert_true(scratch_create(directory));
        scree_state state;
        scree_cells cells;
        scree_cell_snapshot read;
        scree_contact_table empty = {0};
        scree_model model = model_of(dimension);
        create_state(&state, dimension, 6);
        write_snapshot(directory, &state, 0, 0.25, true);
        assert_int_equal(scree_cell_snapshot_read(directory, 0, &read, NULL), SCREE_OK);
        assert_int_equal(scree_cells_measure(&model, &state, &empty, &cells, NULL), SCREE_OK);
        assert_int_equal(read.cells.dimension, dimension);
        assert_int_equal(read.cells.count, cells.count);
        assert_int_equal(read.assembly.count, state.count);
        assert_true(read.axial_strain == 0.25 && strcmp(read.stage, "compress") == 0);
        assert_memory_equal(read.cells.node, cells.node, cells.count * sizeof *cells.node);
        assert_memory_equal(read.cells.neighbour, cells.neighbour, cells.count * sizeof *cells.neighbour);
        assert_memory_equal(read.cells.volume, cells.volume, cells.count * sizeof *cells.volume);
        assert_memory_equal(read.cells.distortion, cells.distortion, cells.count * sizeof *cells.distortion);
        // v_x = y everywhere, and in space v_z = -x: to round-off of the places over the size of a cell.
        for (size_t k = 0; k < cells.count; k++) {
            assert_true(fabs(read.cells.gradient[k][1] - 1) < 1e-9);
            assert_true(fabs(read.cells.gradient[k][6] + (dimension == 3)) < 1e-9);
            assert_memory_equal(read.cells.gradient[k], cells.gradient[k], sizeof cells.gradient[k]);
        }
        // The one contact: - f (x) l over the volume of all cells.
        double sum = 0;
        for (size_t k = 0; k < cells.count; k++) sum += read.cells.volume[k] * read.cells.stress[k][0];
        assert_true(fabs(sum + 3 * SPACING) < 1e-12);
        for (size_t i = 0; i < 3 * state.count; i++) {
            scree_vector place;
            scree_body_position(&state, state.row_of_id[i / 3], place);
            assert_true(!(fabs(read.assembly.position[i] - place[i % 3]) > 0));
        }
        scree_cell_snapshot_destroy(&read);
        scree_cells_destroy(&cells);
        scree_state_destroy(&state);
        scratch_destroy(directory);
    }
}

static void test_snapshots_without_cells(void **unused)
{
    (void)unused;
    char directory[64];
    assert_true(scratch_create(directory));
    scree_state state;
    scree_cell_snapshot read;
    scree_error error = {0};
    create_state(&state, 2, 6);
    write_snapshot(directory, &state, 0, 0, false);
    assert_int_equal(scree_cell_snapshot_read(directory, 0, &read, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "no cells"));
    assert_int_equal(scree_cell_snapshot_read(directory, 1, &read, &error), SCREE_ERROR_INPUT);
    scree_state_destroy(&state);
    scratch_destroy(directory);
}

/// Bodies beyond a band move along it, those inside in proportion: simple shear of the band alone.
static void shear(scree_state *state, double thickness, double slip)
{
    const double normal[2] = {M_SQRT1_2, M_SQRT1_2}, middle[2] = {SPACING * 16, SPACING * 32};
    for (size_t row = 0; row < state->count; row++) {
        scree_row *body = &state->row[row];
        double along = normal[0] * (body->x - middle[0]) + normal[1] * (body->y - middle[1]);
        double part = fmin(0.5, fmax(-0.5, along / thickness));
        body->x += slip * part * normal[1];
        body->y -= slip * part * normal[0];
    }
}

static void test_bands_of_a_run(void **unused)
{
    (void)unused;
    char directory[64], path[4096], value[64];
    assert_true(scratch_create(directory));
    scree_state state;
    scree_summary *summary;
    scree_series bands, circles;
    create_state(&state, 2, 32);
    // Strains of 0, 0.5 %, ...: windows of 1 % hold two snapshots. The first does not belong to the loading.
    write_snapshot(directory, &state, 0, NAN, true);
    for (int k = 0; k < 9; k++) {
        write_snapshot(directory, &state, k + 1, 0.005 * k, true);
        shear(&state, 8 * SPACING, 0.1 * SPACING);
    }
    assert_int_equal(scree_summary_create(&summary, NULL), SCREE_OK);
    assert_int_equal(scree_cell_results_write(directory, &config.measure, 0.01, NULL, summary, NULL), SCREE_OK);
    assert_int_equal(scree_path_join(path, sizeof path, directory, SCREE_FILE_SUMMARY, NULL), SCREE_OK);
    assert_int_equal(scree_summary_write(summary, path, NULL), SCREE_OK);
    assert_int_equal(scree_result_get(directory, "bands", value, sizeof value, NULL), SCREE_OK);
    assert_string_equal(value, "persistent");
    assert_int_equal(scree_path_join(path, sizeof path, directory, SCREE_FILE_BANDS, NULL), SCREE_OK);
    assert_int_equal(scree_series_read(&bands, path, NULL), SCREE_OK);
    assert_int_equal(bands.row_count, 4);
    for (size_t k = 0; k < 4; k++) {
        assert_true(scree_series_get(&bands, "band")[k] > 0.5);
        // Bins of half a diameter and edges inside of cells: a diameter and a half; the angle to the last refinement.
        assert_true(fabs(scree_series_get(&bands, "angle")[k] - 45) < 1.5);
        assert_true(fabs(scree_series_get(&bands, "thickness_diameters")[k] - 8) < 1.5);
        assert_true(scree_series_get(&bands, "share")[k] > 0.8);
        assert_true(scree_series_get(&bands, "percolation")[k] > 0.9);
        assert_true(k == 0 || scree_series_get(&bands, "correlation")[k] > 0.9);
        assert_true(k == 0 || scree_series_get(&bands, "overlap")[k] > 0.8);
        // Slip 0.2 spacings over 8 of them is a shear of 0.025: half of that, in the volume of the band.
        double expected = 0.0125 * scree_series_get(&bands, "volume_fraction")[k];
        assert_true(fabs(scree_series_get(&bands, "mean_distortion")[k] / expected - 1) < 0.25);
    }
    assert_int_equal(scree_path_join(path, sizeof path, directory, SCREE_FILE_CELLS, NULL), SCREE_OK);
    assert_int_equal(scree_series_read(&circles, path, NULL), SCREE_OK);
    assert_int_equal(circles.row_count % 27, 0);
    assert_true(circles.row_count > 27 * 20);
    scree_series_destroy(&bands);
    scree_series_destroy(&circles);
    scree_summary_destroy(summary);
    scree_state_destroy(&state);
    scratch_destroy(directory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cells_come_back),
        cmocka_unit_test(test_snapshots_without_cells),
        cmocka_unit_test(test_bands_of_a_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
