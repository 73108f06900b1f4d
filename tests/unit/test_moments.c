/// Moments of contact forces: what kernels sum as integers against a plain sum over the contact table; with plates,
/// walls of the case, faces of a periodic cell and pairs that are held; threads, instruction sets, the scalar
/// reference.
#include "periodic_fixture.h"
#include "run_fixture.h"

#include "run/step.h"
#include "state/persistent.h"

/// Sum over the contact table of branch (x) force of every row; largest: of a single term.
static void sum_table(const scree_state *state, const scree_contact_table *table, double (*moment)[9], double *largest)
{
    const int d = state->dimension;
    memset(moment, 0, state->count * sizeof *moment);
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        scree_vector centre;
        scree_body_position(state, contact->first, centre);
        for (int i = 0; i < d; i++)
            for (int j = 0; j < d; j++) {
                double force =
                    contact->normal_force * contact->normal[j] + contact->tangential_force * contact->tangent[j];
                double branch = contact->point[i] - centre[i];
                moment[contact->first][d * i + j] += branch * force;
                if (!contact->wall) moment[contact->second][d * i + j] -= (branch + contact->branch[i]) * force;
                *largest = fmax(*largest, fabs(branch * force));
            }
    }
}

/// Forces of the table are those of the step to round-off: 1e-9 of the largest term. False: there are none.
static bool assert_moments(const scree_model *model, const scree_state *state, const scree_work *work)
{
    scree_contact_table table = {0};
    double(*expected)[9] = calloc(state->count, sizeof *expected), largest = 0;
    assert_int_equal(scree_contact_table_build(model, state, work, &table, NULL), SCREE_OK);
    sum_table(state, &table, expected, &largest);
    for (size_t row = 0; row < state->count; row++) {
        double moment[9];
        scree_body_contact_moment(state, row, moment);
        for (int k = 0; k < state->dimension * state->dimension; k++)
            if (!(fabs(moment[k] - expected[row][k]) <= 1e-9 * largest))
                fail_msg("body %u, component %d: %.15g, not %.15g", state->id[row], k, moment[k], expected[row][k]);
    }
    scree_contact_table_destroy(&table);
    free(expected);
    return largest > 0;
}

/// A shaken net in a periodic cell, or between plates, a pair in it that is held at a distance.
static void create_net(periodic_sample *s, int dimension, bool periodic, int threads, int set, bool reference)
{
    periodic_fill(s, dimension, dimension == 2 ? 6 : 4, LINEAR, 1);
    const double side = scree_cell(&s->state)->lattice[0];
    s->model.pairs[0][0] = s->model.walls[0] = linear_pair(3e5, 0, 0.7, 0.5, 0.1, 0.1);
    s->model.persistent.law = (scree_law_use){.law = SCREE_SLOT_linear, .option = LINEAR_HELD};
    memcpy(s->model.persistent.pairs, s->model.pairs, sizeof s->model.pairs);
    if (!periodic) {
        scree_cell(&s->state)->directions = 0;
        scree_plates(&s->state)[SCREE_WALL_LEFT] = (scree_wall){.normal = {1, 0, 0}, .position = 2e-5, .active = 1};
        scree_plates(&s->state)[SCREE_WALL_RIGHT] =
            (scree_wall){.normal = {-1, 0, 0}, .position = 2e-5 - side, .active = 1};
    }
    scree_work_destroy(&s->work);
    assert_int_equal(scree_work_create(&s->work, &s->model, threads, NULL), SCREE_OK);
    s->work.keep_threads = true;
    s->work.instruction_set = set;
    s->work.reference_kernel = reference;
    // Along the diagonal, across the corner of the cell or from the first to the next inner one.
    const uint32_t n = dimension == 2 ? 6 : 4, inner = dimension == 2 ? n + 1 : n * n + n + 1;
    const double rest[SCREE_MEMBER_CONSTANTS] = {2e-3 - 1.97e-3 * sqrt(dimension), INFINITY, INFINITY};
    const uint32_t other = periodic ? (uint32_t)s->state.count - 1 : inner;
    assert_int_equal(scree_persistent_add(&s->state, 0, other, rest, NULL), SCREE_OK);
    assert_int_equal(scree_state_ask_for_moments(&s->state, true, NULL), SCREE_OK);
    periodic_forces(s);
    for (int k = 0; k < 60; k++) periodic_step(s);
}

static void kernels_sum_moments(void **unused)
{
    (void)unused;
    for (int number = 0; number < 4; number++) {
        const int dimension = 2 + number % 2;
        periodic_sample one, other;
        create_net(&one, dimension, number / 2, 1, 0, true);
        assert_true(assert_moments(&one.model, &one.state, &one.work));
        const int sets = scree_contact_instruction_set(0);
        for (int k = 2; k <= sets + 3; k++) {
            create_net(&other, dimension, number / 2, k > sets ? k - sets + 1 : 1, k <= sets ? k : 0, false);
            const size_t bytes = scree_moment_size(dimension) * sizeof(int64_t);
            for (uint32_t id = 0; id < one.state.count; id++)
                assert_memory_equal((char *)one.state.moment + scree_state_row_of(&one.state, id) * bytes,
                                    (char *)other.state.moment + scree_state_row_of(&other.state, id) * bytes, bytes);
            periodic_destroy(&other);
        }
        periodic_destroy(&one);
    }
}

/// Whole cases, with walls that turn; a stage in which nobody asks has none.
static void simulations_sum_moments(void **unused)
{
    (void)unused;
    static const char *const names[] = {"drum_3d", "walls_2d"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char path[256];
        scree_case *c;
        scree_problems *problems;
        scree_simulation s;
        (void)snprintf(path, sizeof path, SCREE_SOURCE_DIR "/tests/reference/cases/%s.yaml", names[k]);
        assert_int_equal(scree_case_read(path, NULL, &c, &problems), SCREE_OK);
        simulation_open(c, 2, &s);
        size_t walls = 0;
        while (simulation_goes_on(&s) && walls < 20) {
            s.moments = true;
            simulation_step(&s);
            if (s.state.step % 200 != 0 || !s.state.moment || !(s.state.largest_overlap > 0)) continue;
            if (s.state.stage.counter < 0) continue;
            walls += assert_moments(&s.stage_model, &s.state, &s.work);
        }
        assert_true(walls >= 10);
        scree_step_compile(&s);
        simulation_step(&s);
        assert_null(s.state.moment);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_sum_moments),
        cmocka_unit_test(simulations_sum_moments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
