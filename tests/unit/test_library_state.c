/// Changes from outside, save and restore, threads and handles of the library.
#include "library_fixture.h"

#include "io_scratch.h"

#include <pthread.h>
#include <scree/sweep.h>
#include <scree/theory.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

static void set(scree_simulation *s, const scree_body_values *values)
{
    scree_error error;
    check(scree_simulation_set(s, values, &error), &error);
}

// ---- changes -----------------------------------------------------------------------------------------------------

static void changed_bodies_are_what_was_asked_for(void **unused)
{
    (void)unused;
    const char *const texts[] = {LIBRARY_PAIR, LIBRARY_PAIR_3D};
    const char *const schemes[] = {"integrator.scheme=velocity_verlet", "integrator.scheme=position_verlet"};
    for (int k = 0; k < 4; k++) {
        const size_t d = k < 2 ? 2 : 3, turns = d == 3 ? 3 : 1;
        scree_case *c = case_read(texts[k / 2], &schemes[k % 2], 1);
        scree_simulation *s = library_create(c);
        // Once right behind the preparation, before there was a step.
        library_advance_stage(s);
        if (k > 0) library_advance(s, 3);
        const uint32_t id[] = {1};
        const double position[] = {0.01, 0.02, 0.03}, velocity[] = {0.1, -0.2, 0.3}, spin[] = {4, 5, 6};
        set(s, &(scree_body_values){1, id, position, velocity, spin, NULL});
        double place[6], speed[6], turn[6];
        scree_simulation_copy(s, place, speed, turn);
        for (size_t i = 0; i < d; i++) {
            assert_true(place[d + i] == position[i]);
            assert_true(fabs(speed[d + i] - velocity[i]) < 1e-14);
        }
        for (size_t i = 0; i < turns; i++) assert_true(fabs(turn[turns + i] - spin[i]) < 1e-13);
        assert_true(speed[0] == 0 && place[0] == 0.015);
        scree_energies energies = library_energies(s);
        assert_true(energies.outside > 0 && energies.kinetic > 0);
        assert_true(fabs(energies.outside / (energies.kinetic + energies.kinetic_rotation) - 1) < 1e-12);
        double mass = s->state.row[s->state.row_of_id[1]].mass, before = energies.kinetic, radius[] = {0.5e-3};
        set(s, &(scree_body_values){1, id, NULL, NULL, NULL, radius});
        assert_true(fabs(s->state.row[s->state.row_of_id[1]].mass / mass - (d == 3 ? 0.125 : 0.25)) < 1e-14);
        assert_true(library_energies(s).kinetic < before && fabs(library_energies(s).residual) < 1e-14 * before);
        library_advance(s, 10);
        scree_simulation_copy(s, place, NULL, NULL);
        assert_true(fabs(place[d] - 0.01 - 10 * 1e-5 * 0.1) < 1e-14);
        scree_simulation_free(s);
        scree_case_free(c);
    }
}

/// Bodies of a loaded sample are moved, made faster and made smaller: the balance stays as it was, then and later.
static void changes_leave_the_balance_closed(void **unused)
{
    (void)unused;
    const char *const leapfrog[] = {"integrator.step=2e-6 s", "integrator.scheme=position_verlet"};
    for (size_t scheme = 1; scheme <= 2; scheme++) {
        scree_case *c = case_read(SIMULATION_SMALL, leapfrog, scheme);
        scree_simulation *s = library_create(c);
        library_advance(s, 4000);
        double before = library_energies(s).residual, radius[2], velocity[][2] = {{1e-4, 0}, {0, 2e-4}};
        uint32_t id[] = {20, 41};
        double position[2][2];
        for (int k = 0; k < 2; k++) {
            const scree_row *row = &s->state.row[s->state.row_of_id[id[k]]];
            radius[k] = 0.9995 * row->radius;
            position[k][0] = row->x + 1e-7;
            position[k][1] = row->y;
        }
        size_t contacts = s->state.contact_count;
        set(s, &(scree_body_values){2, id, position[0], velocity[0], NULL, radius});
        (void)contacts;
        scree_energies after = library_energies(s);
        assert_true(fabs(after.outside) > 1e-5 * s->state.ledger.turnover);
        assert_true(fabs(after.residual - before) < 1e-12 * s->state.ledger.turnover);
        library_advance(s, 1000);
        double open = fabs(library_energies(s).residual - before) / fabs(after.outside);
        print_message("after a change: %.2g of its work\n", open);
        // The trapezoidal rule along Hertz springs, second order in the step: as in test_simulation_balance.
        assert_true(library_energies(s).relative_residual < 1e-6 && open < 1e-3);
        scree_simulation_free(s);
        scree_case_free(c);
    }
}

/// To set what is there changes no position, and the contacts remember what they did.
static void setting_what_is_there_is_no_work(void **unused)
{
    (void)unused;
    scree_case *c = case_read(SIMULATION_SMALL, NULL, 0);
    scree_simulation *s = library_create(c);
    library_advance(s, 2000);
    scree_error error;
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    size_t count = s->state.contact_count;
    double history = 0, again = 0, position[70][2], turnover = s->state.ledger.turnover;
    for (size_t k = 0; k < count; k++) history += fabs(s->state.contact[k].history.value[0]);
    uint32_t id[70];
    for (uint32_t k = 0; k < 70; k++) id[k] = k;
    scree_simulation_copy(s, position[0], NULL, NULL);
    set(s, &(scree_body_values){70, id, position[0], NULL, NULL, NULL});
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    for (size_t k = 0; k < count; k++) again += fabs(s->state.contact[k].history.value[0]);
    assert_true(s->state.contact_count == count && history > 0);
    // Slip is that of the middle of the step, here of a step of no size: a share of the overlap's change in a step.
    assert_true(fabs(again / history - 1) < 1e-5);
    assert_true(fabs(s->state.ledger.outside) < 1e-6 * turnover);
    scree_simulation_free(s);
    scree_case_free(c);
}

static void wrong_changes_change_nothing(void **unused)
{
    (void)unused;
    scree_error error;
    bool done;
    scree_case *c = case_read(LIBRARY_PAIR, NULL, 0);
    scree_simulation *s = library_create(c);
    const uint32_t first[] = {0, 0}, none[] = {2};
    const double here[] = {0.01, 0.02, 0.01, 0.02}, nowhere[] = {NAN, 0}, wide[] = {2e-3}, thin[] = {0};
    const scree_body_values good = {1, first, here, NULL, NULL, NULL};
    assert_int_equal(scree_simulation_set(s, &good, &error), SCREE_ERROR_INPUT); // no bodies yet
    library_advance(s, 3);
    uint64_t bits = simulation_bits(s);
    const scree_body_values wrong[] = {
        {1, none, here, NULL, NULL, NULL},     {2, first, here, NULL, NULL, NULL},
        {1, first, nowhere, NULL, NULL, NULL}, {1, first, NULL, nowhere, NULL, NULL},
        {1, first, NULL, NULL, nowhere, NULL}, {1, first, NULL, NULL, NULL, wide},
        {1, first, NULL, NULL, NULL, thin},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
        assert_int_equal(scree_simulation_set(s, &wrong[k], &error), SCREE_ERROR_INPUT);
    assert_true(simulation_bits(s) == bits);
    // One into the other, far beyond the limit of the guard.
    const double inside[] = {0.0245, 0.02};
    assert_int_equal(scree_simulation_set(s, &(scree_body_values){1, first, inside, NULL, NULL, NULL}, &error),
                     SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "guard.overlap"));
    assert_int_equal(scree_simulation_advance(s, 1, &done, &error), SCREE_ERROR_GUARD);
    scree_simulation_free(s);
    scree_case_free(c);
}

// ---- save and restore --------------------------------------------------------------------------------------------

static int nudge(void *user, scree_simulation *s, scree_loads *loads)
{
    (void)user;
    double time = scree_simulation_time(s);
    scree_loads_add(loads, 30, (const double[]){5e-4 * sin(1e3 * time), 1e-4, 0}, (const double[]){0, 0, 1e-7});
    return 0;
}

static scree_simulation *create_nudged(const scree_case *c)
{
    scree_error error;
    scree_simulation *s = library_create(c);
    const scree_own_force own = {"nudge", nudge, NULL, 1e-3, 1e-6};
    check(scree_simulation_add_force(s, &own, &error), &error);
    return s;
}

/// In mid-stage, at the end of a stage, with own forces and after a change: the same bits, at once and later.
static void restored_simulations_go_on_with_the_same_bits(void **unused)
{
    (void)unused;
    char path[128];
    scree_error error;
    (void)snprintf(path, sizeof path, "%s/state.h5", scratch);
    for (int k = 0; k < COMBINATIONS; k++) {
        scree_case *c = case_read(SIMULATION_SMALL, combinations[k], OVERRIDES - (combinations[k][3] == NULL));
        scree_simulation *s = create_nudged(c), *other = create_nudged(c);
        if (k % 2)
            library_advance(s, 2000);
        else if (k == 0)
            library_advance_stage(s); // the preparation: no force was called yet
        else
            while (!library_advance_stage(s) && scree_simulation_stage(s, NULL) < 1) continue;
        check(scree_simulation_save(s, path, &error), &error);
        uint64_t saved = simulation_bits(s);
        library_advance(s, 500);
        library_advance(other, 100);
        check(scree_simulation_restore(other, path, &error), &error);
        assert_true(simulation_bits(other) == saved);
        library_advance(other, 500);
        assert_true(simulation_bits(other) == simulation_bits(s));
        assert_true(scree_simulation_checksum(other) == scree_simulation_checksum(s));
        // Back by itself, too.
        check(scree_simulation_restore(s, path, &error), &error);
        assert_true(simulation_bits(s) == saved);
        scree_simulation_free(s);
        scree_simulation_free(other);
        scree_case_free(c);
    }
}

static void what_does_not_fit_is_not_restored(void **unused)
{
    (void)unused;
    char path[128];
    scree_error error;
    (void)snprintf(path, sizeof path, "%s/state.h5", scratch);
    const char *const seed[] = {"seed=2"};
    scree_case *c = case_read(SIMULATION_SMALL, NULL, 0), *another = case_read(SIMULATION_SMALL, seed, 1);
    scree_simulation *s = create_nudged(c), *plain = library_create(c), *foreign = create_nudged(another);
    assert_int_equal(scree_simulation_save(s, path, &error), SCREE_ERROR_INPUT); // no bodies yet
    library_advance(s, 100);
    check(scree_simulation_save(s, path, &error), &error);
    library_advance(plain, 50);
    uint64_t bits = simulation_bits(plain);
    assert_int_equal(scree_simulation_restore(plain, path, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "1 own forces, and 0 are registered"));
    assert_int_equal(scree_simulation_restore(foreign, path, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "another case"));
    assert_int_equal(scree_simulation_restore(plain, "/nowhere/state.h5", &error), SCREE_ERROR_IO);
    assert_int_equal(scree_simulation_save(s, "/nowhere/state.h5", &error), SCREE_ERROR_IO);
    assert_true(simulation_bits(plain) == bits);
    library_advance(plain, 10);
    library_advance(foreign, 10);
    scree_simulation_free(s);
    scree_simulation_free(plain);
    scree_simulation_free(foreign);
    scree_case_free(c);
    scree_case_free(another);
}

/// A stopped simulation goes on from what was saved.
static void restoring_lifts_a_stop(void **unused)
{
    (void)unused;
    char path[128];
    scree_error error;
    bool done;
    (void)snprintf(path, sizeof path, "%s/state.h5", scratch);
    scree_case *c = case_read(LIBRARY_PAIR, NULL, 0);
    scree_simulation *s = library_create(c);
    library_advance(s, 3);
    check(scree_simulation_save(s, path, &error), &error);
    const uint32_t id[] = {0};
    const double inside[] = {0.0245, 0.02};
    assert_int_equal(scree_simulation_set(s, &(scree_body_values){1, id, inside, NULL, NULL, NULL}, &error),
                     SCREE_ERROR_GUARD);
    assert_int_equal(scree_simulation_advance(s, 1, &done, &error), SCREE_ERROR_GUARD);
    check(scree_simulation_restore(s, path, &error), &error);
    library_advance(s, 1);
    assert_true(scree_simulation_steps(s) == 4);
    scree_simulation_free(s);
    scree_case_free(c);
}

// ---- threads and handles -----------------------------------------------------------------------------------------

typedef struct job {
    char path[128];
    int seed;
    uint64_t checksum;
    int failures;
} job;

/// All that a program does with a simulation, from the text of the case on.
static void *work(void *user)
{
    job *j = user;
    char seed[32];
    scree_case *c;
    scree_problems *problems;
    scree_simulation *s = NULL;
    scree_error error;
    bool done;
    (void)snprintf(seed, sizeof seed, "seed=%d", j->seed);
    const char *const overrides[] = {seed};
    j->failures = case_parse(SIMULATION_SMALL, overrides, 1, &c, &problems) != SCREE_OK;
    if (j->failures) return NULL;
    j->failures += scree_simulation_create(c, 1, &s, &error) != SCREE_OK;
    j->failures += scree_simulation_advance(s, 300, &done, &error) != SCREE_OK;
    j->failures += scree_simulation_save(s, j->path, &error) != SCREE_OK;
    j->failures += scree_simulation_advance(s, 200, &done, &error) != SCREE_OK;
    j->failures += scree_simulation_restore(s, j->path, &error) != SCREE_OK;
    j->failures += scree_simulation_advance(s, 300, &done, &error) != SCREE_OK;
    j->checksum = scree_simulation_checksum(s);
    scree_simulation_free(s);
    scree_case_free(c);
    return NULL;
}

static void two_threads_use_two_simulations(void **unused)
{
    (void)unused;
    enum { JOBS = 2 };
    job alone[JOBS], beside[JOBS];
    pthread_t thread[JOBS];
    for (int k = 0; k < JOBS; k++) {
        alone[k] = (job){.seed = k + 1};
        (void)snprintf(alone[k].path, sizeof alone[k].path, "%s/%d.h5", scratch, k);
        beside[k] = alone[k];
        (void)work(&alone[k]);
    }
    for (int k = 0; k < JOBS; k++) assert_int_equal(pthread_create(&thread[k], NULL, work, &beside[k]), 0);
    for (int k = 0; k < JOBS; k++) assert_int_equal(pthread_join(thread[k], NULL), 0);
    for (int k = 0; k < JOBS; k++) {
        assert_true(alone[k].failures == 0 && beside[k].failures == 0);
        assert_true(alone[k].checksum == beside[k].checksum);
    }
    assert_true(alone[0].checksum != alone[1].checksum);
}

#ifndef NDEBUG
/// A program that uses something that it has freed ends there, and names the function and the handle.
static void expect_end(void (*use)(void *handle), void *handle, const char *function, const char *message)
{
    int end[2], status = 0;
    char said[1024] = "";
    assert_int_equal(pipe(end), 0);
    const pid_t child = fork();
    if (child == 0) {
        (void)dup2(end[1], STDERR_FILENO);
        (void)signal(SIGABRT, SIG_DFL);
        use(handle);
        _exit(0);
    }
    (void)close(end[1]);
    (void)!read(end[0], said, sizeof said - 1);
    (void)close(end[0]);
    assert_true(child > 0 && waitpid(child, &status, 0) == child);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
    if (!strstr(said, function) || !strstr(said, message))
        fail_msg("'%s' or '%s' is not in: %s", function, message, said);
}

static void use_simulation(void *handle)
{
    (void)scree_simulation_time(handle);
}

static void free_simulation(void *handle)
{
    scree_simulation_free(handle);
}

static void use_case(void *handle)
{
    (void)scree_case_write(handle, stdout, NULL);
}

static void simulate_case(void *handle)
{
    scree_simulation *s;
    (void)!scree_simulation_create(handle, 1, &s, NULL);
}

static void use_draft(void *handle)
{
    scree_draft_set_quick(handle, true);
}

static void use_theory(void *handle)
{
    const scree_theory_value *values;
    (void)scree_theory_values(handle, &values);
}

static void use_sweep(void *handle)
{
    (void)scree_sweep_member_count(handle);
}

static void use_problems(void *handle)
{
    (void)scree_problems_count(handle);
}
#endif

/// With assertions the use of a handle that was freed ends the program, which says so; without them nothing is
/// promised.
static void a_freed_handle_is_caught(void **unused)
{
    (void)unused;
#ifdef NDEBUG
    skip();
#else
    scree_error error = {0};
    scree_simulation *s;
    scree_case *c = case_read(LIBRARY_PAIR, NULL, 0);
    check(scree_simulation_create(c, 1, &s, &error), &error);
    scree_case_free(c);
    expect_end(use_simulation, s, "scree_simulation_time", "\"a simulation of a case\" ");
    expect_end(use_case, c, "scree_case_write", "\"a case\" ");
    expect_end(simulate_case, c, "scree_simulation_create", "\"a case\" ");
    scree_simulation_free(s);
    c = case_read(LIBRARY_PAIR, NULL, 0);
    check(scree_simulation_create(c, 1, &s, &error), &error);
    scree_simulation_free(s);
    expect_end(use_simulation, s, "scree_simulation_time", "\"a simulation\" ");
    expect_end(free_simulation, s, "scree_simulation_free", "\"a simulation\" ");
    expect_end(use_simulation, NULL, "scree_simulation_time", "\"a simulation\" ");
    scree_case_free(c);
    // A new one where another lay is none that was freed.
    for (int k = 0; k < 3; k++) {
        scree_draft *draft;
        check(scree_draft_builtin("biaxial", &draft, &error), &error);
        scree_draft_set_quick(draft, true);
        scree_draft_free(draft);
        if (k == 2) expect_end(use_draft, draft, "scree_draft_set_quick", "\"a draft\" ");
    }
    scree_theory *theory;
    const scree_theory_layer_of of = {.base = "smooth", .force = 1, .thickness = 1, .poisson_ratio = 0.3};
    check(scree_theory_layer(&of, &theory, &error), &error);
    scree_theory_free(theory);
    expect_end(use_theory, theory, "scree_theory_values", "\"a theory\" ");
    scree_sweep *sweep;
    scree_problems *problems;
    const scree_sweep_read_options options = {.realisations = 1};
    assert_int_equal(scree_sweep_read("restitution", &options, &sweep, &problems), SCREE_OK);
    scree_sweep_free(sweep);
    expect_end(use_sweep, sweep, "scree_sweep_member_count", "\"a sweep\" ");
    assert_int_not_equal(case_parse("scree: 1\n", NULL, 0, &c, &problems), SCREE_OK);
    scree_problems_free(problems);
    expect_end(use_problems, problems, "scree_problems_count", "\"a list of problems\" ");
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changed_bodies_are_what_was_asked_for),
        cmocka_unit_test(changes_leave_the_balance_closed),
        cmocka_unit_test(setting_what_is_there_is_no_work),
        cmocka_unit_test(wrong_changes_change_nothing),
        cmocka_unit_test_setup_teardown(restored_simulations_go_on_with_the_same_bits, make_scratch, remove_scratch),
        cmocka_unit_test_setup_teardown(what_does_not_fit_is_not_restored, make_scratch, remove_scratch),
        cmocka_unit_test_setup_teardown(restoring_lifts_a_stop, make_scratch, remove_scratch),
        cmocka_unit_test_setup_teardown(two_threads_use_two_simulations, make_scratch, remove_scratch),
        cmocka_unit_test(a_freed_handle_is_caught),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
