/// Whole simulations of small cases: reading a case, stepping it, losing its work, going on from a checkpoint, and runs
/// that are stopped and restarted.
#ifndef SCREE_TESTS_RUN_FIXTURE_H
#define SCREE_TESTS_RUN_FIXTURE_H

#include "state_bits.h"
#include "testing.h"

#include "io/run_directory.h"
#include "io/snapshot.h"
#include "measure/measure.h"
#include "run/sample.h"
#include "run/simulation.h"
#include "search/neighbours.h"
#include "shape/wall_set.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static inline scree_status case_parse(const char *text, const char *const *overrides, size_t count, scree_case **c,
                                      scree_problems **problems)
{
    scree_case_options options = {.overrides = overrides, .override_count = count};
    *c = NULL;
    *problems = NULL;
    return scree_case_parse(text, strlen(text), "small.yaml", &options, c, problems);
}

/// A case that is not valid: one of its problems says message. Returns their number.
static inline size_t case_refused(const char *text, const char *const *overrides, size_t count, const char *message)
{
    scree_case *c;
    scree_problems *problems;
    char line[2048] = "nothing was refused";
    if (case_parse(text, overrides, count, &c, &problems) == SCREE_OK) fail_msg("not refused: %s", message);
    bool found = false;
    const size_t all = scree_problems_count(problems);
    for (size_t k = 0; k < all && !found; k++) {
        scree_error_format(scree_problems_get(problems, k), line, sizeof line);
        found = strstr(line, message) != NULL;
    }
    if (!found) fail_msg("'%s' is not in: %s", message, line);
    scree_problems_free(problems);
    return all;
}

/// The same, and it says nothing else.
static inline void case_refused_alone(const char *text, const char *const *overrides, size_t count, const char *message)
{
    const size_t all = case_refused(text, overrides, count, message);
    if (all != 1) fail_msg("%zu problems, and not only: %s", all, message);
}

/// A case that must be valid; free it. What is wrong with it is printed.
static inline scree_case *case_read(const char *text, const char *const *overrides, size_t count)
{
    scree_case *c;
    scree_problems *problems;
    if (case_parse(text, overrides, count, &c, &problems)) {
        char line[2048];
        for (size_t k = 0; k < scree_problems_count(problems); k++) {
            scree_error_format(scree_problems_get(problems, k), line, sizeof line);
            print_message("%s\n", line);
        }
        fail_msg("the case of this test is not valid");
    }
    return c;
}

static inline void simulation_open(const scree_case *c, int threads, scree_simulation *s)
{
    scree_error error;
    check(scree_simulation_open(c, threads, s, &error), &error);
}

static inline void simulation_step(scree_simulation *s)
{
    scree_error error;
    check(scree_simulation_step(s, &error), &error);
}

/// Whether a stage is left.
static inline bool simulation_goes_on(const scree_simulation *s)
{
    return s->state.stage.index < s->model.stage_count;
}

/// Steps into the last stage; 0 before it has begun, too.
static inline uint64_t simulation_last_steps(const scree_simulation *s)
{
    bool last = s->state.stage.index + 1 == s->model.stage_count && s->state.stage.counter >= 0;
    return last ? s->state.step - s->state.stage.first_step : 0;
}

/// Goes to the begin of the loading.
static inline void simulation_load(scree_simulation *s)
{
    while (!s->stage || !s->stage->loading) simulation_step(s);
}

/// The largest residual of the energy over the work, of what was known and the last step's sample.
static inline double simulation_residual(const scree_simulation *s, double worst)
{
    return s->sampled ? fmax(worst, s->sample[SCREE_SAMPLE_ENERGY_RESIDUAL_RELATIVE]) : worst;
}

/// Runs to the end of the case. Returns the largest residual of the energy over the work in its samples.
static inline double simulation_finish(scree_simulation *s)
{
    double worst = 0;
    while (simulation_goes_on(s)) {
        simulation_step(s);
        worst = simulation_residual(s, worst);
    }
    return worst;
}

/// The bits of its state.
static inline uint64_t simulation_bits(scree_simulation *s)
{
    scree_error error;
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    return state_bits(&s->state);
}

/// Closes the simulation. Returns the bits of its state.
static inline uint64_t simulation_close(scree_simulation *s)
{
    uint64_t bits = simulation_bits(s);
    scree_simulation_close(s);
    return bits;
}

/// Throws the work away; what contacts remember goes through the state into a new one, as in a restart.
static inline void simulation_lose_work(scree_simulation *s, int threads)
{
    scree_error error;
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    scree_contact_scratch_destroy(&s->work);
    scree_work_destroy(&s->work);
    check(scree_work_create(&s->work, &s->model, threads, &error), &error);
    check(scree_wall_set_create(&s->c->config, &s->work.wall_set, &error), &error);
}

/// Opens in `other` what goes on from a checkpoint of `s`, which goes on itself; the file lies in `folder`.
static inline void simulation_reopen(scree_simulation *s, int threads, const char *folder, scree_simulation *other)
{
    enum { CASE = 7 };
    scree_error error;
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    check(scree_checkpoint_write(folder, &s->state, CASE, &error), &error);
    simulation_open(s->c, threads, other);
    scree_state_destroy(&other->state);
    check(scree_checkpoint_read(folder, s->model.dimension, &other->state, CASE, &error), &error);
    assert_true(state_bits(&s->state) == state_bits(&other->state));
    check(scree_neighbours_refresh(&other->model, &other->state, &other->work, &error), &error);
    check(scree_stage_enter(other, true, &error), &error);
}

/// A run that is stopped when a message holds `at`.
typedef struct run_stop {
    const char *at;
    volatile int stop;
} run_stop;

static inline void run_stop_at(void *user, int level, const char *line)
{
    run_stop *stop = (run_stop *)user;
    (void)level;
    if (strstr(line, stop->at)) stop->stop = 1;
}

static inline void run_checksum(const char *directory, char text[32])
{
    scree_error error;
    check(scree_result_get(directory, "state_checksum", text, 32, &error), &error);
}

/// Both runs ended in the same state.
static inline void run_compare(const char *one, const char *other)
{
    char checksum[2][32];
    run_checksum(one, checksum[0]);
    run_checksum(other, checksum[1]);
    assert_string_equal(checksum[0], checksum[1]);
}

/// An uninterrupted run, in `whole`, against one in `part` by `threads` that is stopped by the message `at` and goes on
/// from its checkpoint: they end in the same state.
static inline void run_restart(const scree_case *c, const char *whole, const char *part, int threads, const char *at)
{
    scree_error error;
    run_stop stopping = {.at = at};
    scree_run_options options = {.output = whole, .threads = 1, .force = true};
    check(scree_run(c, &options, &error), &error);
    options = (scree_run_options){.output = part,
                                  .threads = threads,
                                  .force = true,
                                  .stop = &stopping.stop,
                                  .message = run_stop_at,
                                  .user = &stopping};
    assert_int_equal(scree_run(c, &options, &error), SCREE_INTERRUPTED);
    options = (scree_run_options){.threads = 1};
    check(scree_restart(part, &options, &error), &error);
    run_compare(whole, part);
}

#endif
