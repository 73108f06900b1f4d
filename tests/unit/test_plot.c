/// All figures of a run directory, from a hand-made series.csv and hand-made snapshots.
#include "measure/delaunay_boundary.h"
#include "state/plates.h"
#include "view_testing.h"

#include "hand_made_snapshot.h"

#include "io/run_directory.h"
#include "io/series.h"
#include "measure/cells.h"
#include "measure/measure.h"
#include "run/cell_results.h"

#include <scree/scree.h>

#include <math.h>

static const char *const names[] = {"step",
                                    "time",
                                    "stage",
                                    "axial_strain",
                                    "volumetric_strain",
                                    "stress_ratio",
                                    "stress_ratio_contacts",
                                    "stress_axial_plates",
                                    "stress_lateral_applied",
                                    "stress_axial_contacts",
                                    "stress_lateral_contacts",
                                    "slip_ratio",
                                    "coordination",
                                    "coordination_without_rattlers",
                                    "solid_fraction",
                                    "unbalanced_ratio",
                                    "kinetic",
                                    "elastic_normal",
                                    "elastic_tangential",
                                    "dissipated_damping",
                                    "dissipated_friction",
                                    "stiffness_work",
                                    "work_plates",
                                    "work_pressure",
                                    "work_periodic",
                                    "work_gravity",
                                    "energy_residual"};
enum { COLUMNS = sizeof names / sizeof names[0], SNAPSHOTS = 5 };

/// 20 rows of confinement and 200 of loading to 15 %; the stress ratio is highest at 3.75 %.
static void write_row(scree_series_writer *writer, int k)
{
    double e = k < 20 ? 0 : 0.15 * (k - 20) / 199, sigma = 1 + 1.5 * e / 0.0375 * exp(1 - e / 0.0375);
    double value[COLUMNS] = {k, 0.1 * k, k < 20 ? 1 : 2, k < 20 ? NAN : e};
    double loaded[] = {-0.4 * e * e / (0.02 + e) + 0.3 * e * exp(-e / 0.005),
                       sigma,
                       sigma * 1.01 - 0.01 * e,
                       1e5 * sigma,
                       1e5,
                       1.005e5 * sigma,
                       1.002e5,
                       2 + 8 * e,
                       3.6 - e,
                       4.1 - e,
                       0.84 - 0.1 * e,
                       1e-3 * (1 + 0.5 * sin(k)),
                       1e-5,
                       2e-3 * sigma,
                       1e-3,
                       0.05 * e,
                       0.6 * e,
                       1e-3 * e,
                       0.9 * e,
                       -0.2 * e,
                       0,
                       0,
                       1e-9};
    for (size_t c = 4; c < COLUMNS; c++) value[c] = loaded[c - 4];
    assert_int_equal(scree_series_append(writer, value, NULL), SCREE_OK);
}

static void make_series(const char *directory, size_t columns, int rows)
{
    char path[200];
    scree_series_column column[COLUMNS];
    scree_series_writer writer;
    (void)snprintf(path, sizeof path, "%s/%s", directory, SCREE_FILE_SERIES);
    for (size_t c = 0; c < columns; c++) column[c] = (scree_series_column){names[c], "1", ""};
    assert_int_equal(scree_series_open(&writer, path, column, columns, -1, NULL), SCREE_OK);
    for (int k = 0; k < rows; k++) write_row(&writer, k);
    assert_int_equal(scree_series_close(&writer, NULL), SCREE_OK);
}

static const scree_config config = {.boundary = {.gap_limit = 1}, .measure = {.cells = true}};

/// Writes `s` as snapshot `index` of the run.
static void put_snapshot(const char *directory, const scree_snapshot *s, int64_t index)
{
    scree_state state;
    scree_error error = {0};
    scree_contact_table table = {.count = s->contact_count,
                                 .contact = hand_made_array(s->contact_count, sizeof(scree_contact))};
    scree_cells cells;
    scree_model model = {.dimension = 2,
                         .thickness = 1e-3,
                         .mean_radius = 0.75e-3,
                         .config = &config,
                         .scheme = SCREE_SLOT_position_verlet};
    assert_int_equal(scree_state_create(&state, 2, s->count, NULL), SCREE_OK);
    for (size_t k = 0; k < s->count; k++) {
        state.row[k] = (scree_row){.x = s->x[k],
                                   .y = s->y[k],
                                   .radius = s->radius[k],
                                   .vx = s->vx[k],
                                   .vy = s->vy[k],
                                   .spin = s->spin[k],
                                   .mass = 1};
        state.angle[k] = s->angle[k];
    }
    for (size_t k = 0; k < s->contact_count; k++) {
        double dx = s->x[s->first[k]] - s->x[s->second[k]], dy = s->y[s->first[k]] - s->y[s->second[k]];
        table.contact[k] = (scree_contact){.first = s->first[k],
                                           .second = s->second[k],
                                           .normal = {dx / hypot(dx, dy), dy / hypot(dx, dy)},
                                           .branch = {dx, dy},
                                           .point = {s->contact_x[k], s->contact_y[k]},
                                           .normal_force = s->normal_force[k],
                                           .tangential_force = s->tangential_force[k]};
    }
    memcpy(scree_plates(&state), s->wall, SCREE_WALL_COUNT * sizeof(scree_wall));
    scree_loop_of(&state)->count = scree_loop_of(&state)->capacity = s->loop_count;
    scree_loop_of(&state)->id = hand_made_array(s->loop_count, sizeof *scree_loop_of(&state)->id);
    scree_loop_of(&state)->loaded = hand_made_array(s->loop_count, sizeof *scree_loop_of(&state)->loaded);
    double **place[] = {&scree_loop_of(&state)->x, &scree_loop_of(&state)->y, &scree_loop_of(&state)->fx,
                        &scree_loop_of(&state)->fy};
    for (size_t k = 0; k < sizeof place / sizeof place[0]; k++)
        *place[k] = hand_made_array(s->loop_count, sizeof(double));
    memcpy(scree_loop_of(&state)->id, s->loop, s->loop_count * sizeof *s->loop);
    if (scree_cells_measure(&model, &state, &table, &cells, &error)) fail_msg("%s", error.message);
    const scree_snapshot_info info = {
        .index = index, .time = s->time, .axial_strain = s->axial_strain, .stage = s->stage, .cells = &cells};
    scree_status status = scree_snapshot_write(directory, &model, &state, &table, &info, &error);
    if (status) fail_msg("%s", error.message);
    scree_cells_destroy(&cells);
    scree_release(&table.contact);
    scree_state_destroy(&state);
}

/// The first one is of the preparation, with fewer particles, so that nothing can be compared with it.
static void make_snapshots(const char *directory, int count)
{
    for (int k = 0; k < count; k++) {
        scree_snapshot s;
        hand_made_packing(&s, k == 0 ? 5 : 17, k == 0 ? 10 : 35, k == 0 ? 0 : 0.15 * (k - 1) / (SNAPSHOTS - 2));
        if (k == 0) strcpy(s.stage, "prepare");
        put_snapshot(directory, &s, k);
        hand_made_destroy(&s);
    }
}

typedef struct report {
    size_t drawn, left_out, failed;
    char text[8192];
} report;

static void take(void *user, const char *line)
{
    report *r = user;
    r->left_out += strstr(line, " left out: ") != NULL;
    r->failed += strstr(line, " failed: ") != NULL;
    r->drawn += strstr(line, ".svg") != NULL;
    (void)snprintf(r->text + strlen(r->text), sizeof r->text - strlen(r->text), "%s\n", line);
}

static scree_status plot(const char *directory, report *r, scree_error *error)
{
    *r = (report){0};
    *error = (scree_error){0};
    return scree_plot_only(directory, SCREE_ALL_FIGURES, take, r, error);
}

static void new_directory(const char *directory)
{
    assert_int_equal(scree_run_directory_create(directory, true, NULL), SCREE_OK);
}

/// Figures of samples need a case, which hand-made runs have none of: tests/cli/test_verbs.sh draws them.
enum { OF_SAMPLES = 5 };

static void every_figure_of_a_run_is_drawn(void **state)
{
    (void)state;
    static const char *const figures[] = {"volumetric-strain",
                                          "stress-ratio",
                                          "slip",
                                          "stress",
                                          "energy",
                                          "energy-stored",
                                          "coordination",
                                          "solid-fraction",
                                          "unbalanced-force",
                                          "packing-start",
                                          "packing-end",
                                          "forces-peak",
                                          "forces-end",
                                          "speed-end",
                                          "spin-end",
                                          "fluctuations-00-03.8",
                                          "fluctuations-11.2-15",
                                          "distortion-rate-peak",
                                          "distortion-rate-window",
                                          "distortion-rate-end",
                                          "distortion-rate-colour-end",
                                          "pressure-peak",
                                          "pressure-window",
                                          "pressure-end",
                                          "pressure-colour-end",
                                          "distortion-00-03.8",
                                          "distortion-11.2-15",
                                          "pressure-circles"};
    scree_summary *summary;
    report r;
    scree_error error;
    new_directory("run");
    make_series("run", COLUMNS, 220);
    make_snapshots("run", SNAPSHOTS);
    assert_int_equal(scree_summary_create(&summary, NULL), SCREE_OK);
    assert_int_equal(scree_cell_results_write("run", &config.measure, 0.01, NULL, summary, NULL), SCREE_OK);
    scree_summary_destroy(summary);
    scree_status status = plot("run", &r, &error);
    if (status) fail_msg("%s\n%s", error.message, r.text);
    for (size_t k = 0; k < sizeof figures / sizeof figures[0]; k++) {
        char name[200], path[300];
        (void)snprintf(name, sizeof name, "run/figures/%s", figures[k]);
        assert_figure(name);
        (void)snprintf(path, sizeof path, "%s.svg\n", name);
        assert_non_null(strstr(r.text, path));
    }
    assert_int_equal(r.drawn, sizeof figures / sizeof figures[0]);
    assert_int_equal(r.left_out, OF_SAMPLES);
    assert_int_equal(r.failed, 0);
}

typedef struct listed {
    size_t count, usual;
    char text[8192];
} listed;

static void take_listed(void *user, const char *name, const char *meaning, bool usual)
{
    listed *l = user;
    l->count++;
    l->usual += usual;
    assert_true(strlen(meaning) > 10 && !strchr(meaning, '\n'));
    (void)snprintf(l->text + strlen(l->text), sizeof l->text - strlen(l->text), "%s.svg\n", name);
}

static void the_list_names_what_is_drawn(void **state)
{
    (void)state;
    listed l = {0};
    report r;
    scree_error error = {0};
    if (scree_figure_visit("run", take_listed, &l, &error)) fail_msg("%s", error.message);
    assert_int_equal(plot("run", &r, &error), SCREE_OK);
    assert_int_equal(l.count, r.drawn + OF_SAMPLES);
    char *line = r.text, *name = l.text;
    for (; *line && *name; line = strchr(line, '\n') + 1, name = strchr(name, '\n') + 1) {
        const size_t length = (size_t)(strchr(name, '\n') - name), stem = length - strlen(".svg");
        const bool drawn = strncmp(line, "run/figures/", strlen("run/figures/")) == 0;
        assert_memory_equal(line + (drawn ? strlen("run/figures/") : 0), name, drawn ? length : stem);
    }
    assert_true(!*line && !*name);
}

/// A reader wants ten: those with a mark in the list, of strain windows the last one.
static void the_usual_figures_are_few(void **state)
{
    (void)state;
    listed l = {0};
    report r = {0};
    scree_error error = {0};
    if (scree_figure_visit("run", take_listed, &l, &error)) fail_msg("%s", error.message);
    if (scree_plot("run", take, &r, &error)) fail_msg("%s", error.message);
    assert_int_equal(r.drawn, l.usual);
    assert_int_equal(r.left_out + r.failed, 0);
    assert_true(r.drawn >= 8 && r.drawn <= 10);
    assert_non_null(strstr(r.text, "stress-ratio.svg"));
    assert_non_null(strstr(r.text, "distortion-11.2-15.svg"));
    assert_null(strstr(r.text, "distortion-00-03.8.svg"));
    assert_null(strstr(r.text, "speed-end.svg")); // it was loaded
}

static scree_status plot_only(const char *directory, const char *wanted, report *r, scree_error *error)
{
    *r = (report){0};
    *error = (scree_error){0};
    return scree_plot_only(directory, wanted, take, r, error);
}

static void figures_are_drawn_by_name(void **state)
{
    (void)state;
    report r;
    scree_error error;
    assert_int_equal(plot_only("run", "distortion-00-03.8,slip,stress", &r, &error), SCREE_OK);
    assert_string_equal(r.text, "run/figures/slip.svg\nrun/figures/stress.svg\nrun/figures/distortion-00-03.8.svg\n");
}

static void unknown_figures_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *names, *field, *accepted;
    } row[] = {{"slip,stres", "stres", "stress"},
               {"distortion-00-03.7", "distortion-00-03.7", "distortion-00-03.8"},
               {"section-end", "section-end", "scree plot DIR --list"}, // of spheres
               {"slip,", "", "scree plot DIR --list"},
               {"zzzzzzzzzz", "zzzzzzzzzz", "scree plot DIR --list"}};
    report r;
    scree_error error;
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        assert_int_equal(plot_only("run", row[k].names, &r, &error), SCREE_ERROR_INPUT);
        assert_string_equal(error.field, row[k].field);
        assert_string_equal(error.accepted, row[k].accepted);
        assert_string_equal(r.text, "");
        assert_int_equal(scree_plot_only("run", row[k].names, NULL, NULL, NULL), SCREE_ERROR_INPUT);
    }
}

/// Strain in percent, compression positive, confinement left out: the first line of the data is the first row of loading,
/// the last but one line of 200 has 0.15 * 198 / 199 of strain.
static void charts_hold_the_loading_stage_only(void **state)
{
    (void)state;
    char *text = read_whole("run/figures/volumetric-strain.csv"), *line = strchr(text, '\n') + 1;
    double strain, volume, last = -1;
    int rows = 0;
    for (; sscanf(line, "%lf,%lf", &strain, &volume) == 2; line = strchr(line, '\n') + 1, rows++) {
        assert_true(strain > last);
        last = strain;
    }
    assert_int_equal(rows, 200);
    assert_true(fabs(strain - 15) < 1e-7 && volume < -5);
    free(text);
}

/// No gravity, no periodic cell: the legend is silent on their work.
static void curves_of_nothing_are_left_out(void **state)
{
    (void)state;
    char *script = read_whole("run/figures/energy.gp");
    assert_non_null(strstr(script, "work of plates"));
    assert_null(strstr(script, "work of gravity"));
    assert_null(strstr(script, "work of the cell"));
    free(script);
}

static void missing_columns_leave_out_their_charts(void **state)
{
    (void)state;
    report r;
    scree_error error;
    new_directory("short");
    make_series("short", 7, 220);
    assert_int_equal(plot("short", &r, &error), SCREE_ERROR_IO); // no snapshots: run.h5 is not there
    assert_int_equal(r.drawn, 2);
    assert_int_equal(r.left_out, 7);
    assert_non_null(strstr(r.text, "slip left out: series.csv has no column 'slip_ratio'"));
    assert_figure("short/figures/stress-ratio");
    // No snapshots: what the series has is listed.
    listed l = {0};
    assert_int_equal(scree_figure_visit("short", take_listed, &l, &error), SCREE_ERROR_IO);
    assert_string_equal(l.text, "volumetric-strain.svg\nstress-ratio.svg\n");
}

static void empty_series_is_told(void **state)
{
    (void)state;
    report r;
    scree_error error;
    new_directory("empty");
    make_series("empty", COLUMNS, 0);
    assert_int_equal(plot("empty", &r, &error), SCREE_ERROR_IO); // no run.h5
    assert_int_equal(r.left_out, 9);
    assert_int_equal(r.drawn, 0);
    assert_non_null(strstr(r.text, "slip left out: series.csv has no rows of a loading stage"));
}

/// One snapshot, before any loading: nine charts, the three scenes at the peak and the circles are left out, and there
/// are no strain windows; start and end are that snapshot.
static void run_without_loading_has_its_packing_drawn(void **state)
{
    (void)state;
    report r;
    scree_error error;
    new_directory("few");
    make_series("few", COLUMNS, 15);
    make_snapshots("few", 1);
    scree_status status = plot("few", &r, &error);
    if (status) fail_msg("%s\n%s", error.message, r.text);
    assert_int_equal(r.left_out, 13 + OF_SAMPLES);
    assert_null(strstr(r.text, "nan"));
    assert_int_equal(r.drawn, 13); // two of them charts over time
    r = (report){0};
    assert_int_equal(scree_plot("few", take, &r, &error), SCREE_OK);
    assert_int_equal(r.left_out, 0); // nobody has asked for charts of loading
    assert_non_null(strstr(r.text, "energy-time.svg"));
    assert_int_equal(plot_only("few", "slip,packing-end", &r, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, "slip");
    assert_string_equal(error.message, "series.csv has no rows of a loading stage");
    assert_int_equal(r.drawn, 1);
}

/// Two snapshots of loading, at 0 and 5 %: the windows that are the default without a case need more of them.
static void strain_windows_come_from_the_case(void **state)
{
    (void)state;
    report r;
    scree_error error;
    const char *text = scree_template_text("biaxial"), *key = "windows: ", *windows = strstr(text, key);
    assert_non_null(windows);
    new_directory("windows");
    make_snapshots("windows", 3);
    FILE *file = fopen("windows/case.yaml", "w");
    assert_non_null(file);
    fprintf(file, "%.*s%s[[0 %%, 5 %%]]%s", (int)(windows - text), text, key, strchr(windows, '\n'));
    fclose(file);
    assert_int_equal(plot("windows", &r, &error), SCREE_ERROR_IO); // no series.csv
    assert_int_equal(r.drawn, 14 + OF_SAMPLES);
    assert_non_null(strstr(r.text, "fluctuations-00-05.svg"));
    assert_non_null(strstr(r.text, "distortion-00-05.svg"));
    assert_int_equal(unlink("windows/case.yaml"), 0);
    assert_int_equal(plot("windows", &r, &error), SCREE_ERROR_IO);
    assert_int_equal(r.drawn, 11);
}

static void no_run_is_an_error(void **state)
{
    (void)state;
    report r;
    scree_error error;
    assert_int_equal(plot("nowhere", &r, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "no run to draw in 'nowhere'"));
    assert_int_not_equal(access("nowhere", F_OK), 0);
    assert_int_equal(scree_plot("nowhere", NULL, NULL, NULL), SCREE_ERROR_IO);
}

static void scenes_are_drawn_without_gnuplot(void **state)
{
    (void)state;
    report r;
    scree_error error;
    char *path = strdup(getenv("PATH"));
    assert_int_equal(setenv("PATH", scratch, 1), 0);
    make_series("few", COLUMNS, 220);
    assert_int_equal(plot("few", &r, &error), SCREE_ERROR_IO);
    assert_int_equal(setenv("PATH", path, 1), 0);
    free(path);
    assert_non_null(strstr(error.message, "gnuplot"));
    assert_int_equal(r.failed, 9);
    assert_int_equal(r.drawn, 14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_figure_of_a_run_is_drawn),
        cmocka_unit_test(the_usual_figures_are_few),
        cmocka_unit_test(the_list_names_what_is_drawn),
        cmocka_unit_test(figures_are_drawn_by_name),
        cmocka_unit_test(unknown_figures_are_refused),
        cmocka_unit_test(charts_hold_the_loading_stage_only),
        cmocka_unit_test(curves_of_nothing_are_left_out),
        cmocka_unit_test(missing_columns_leave_out_their_charts),
        cmocka_unit_test(empty_series_is_told),
        cmocka_unit_test(run_without_loading_has_its_packing_drawn),
        cmocka_unit_test(strain_windows_come_from_the_case),
        cmocka_unit_test(no_run_is_an_error),
        cmocka_unit_test(scenes_are_drawn_without_gnuplot),
    };
    return cmocka_run_group_tests(tests, enter_scratch, leave_scratch);
}
