/// What a case amounts to before it is run: numbers of the model, and an estimate of steps, wall time and memory.
///
/// Wall time = particles x steps / rate; the rate is measured on this machine by a few dozen steps of a small hexagonal
/// packing under the case's own law and scheme (about 10 ms). Steps of a confinement are not known in advance:
/// CONFINE_WAVES wave times through the sample, the typical duration seen. Memory: rows, cold arrays and about 2.6
/// listed pairs a disc.
#include "case/case.h"
#include "contact/contact.h"
#include "integrate/integrate.h"
#include "run/quasistatic.h"
#include "run/recorder.h"
#include "search/neighbours.h"
#include "shape/container.h"

#include <math.h>
#include <string.h>

#define CONFINE_WAVES 60.0
enum { PROBE_SIDE = 32, PROBE_STEPS = 60, BYTES_A_DISC = 330 };

/// A square of discs of the mean radius on a hexagonal lattice, slightly pressed together.
static scree_status make_probe(const scree_model *model, scree_state *state, scree_error *error)
{
    double radius = model->mean_radius, spacing = 2 * radius * (1 - 1e-4);
    scree_status status = scree_state_create(state, 2, PROBE_SIDE * PROBE_SIDE, error);
    if (!status && scree_model_foresees(model)) status = scree_state_foresee(state, error);
    if (status) return status;
    state->tick = model->step;
    state->step_size = state->kick_size = (double)model->largest_step * model->step;
    for (size_t k = 0; k < state->count; k++) {
        size_t i = k % PROBE_SIDE, j = k / PROBE_SIDE;
        state->row[k] = (scree_row){.x = spacing * ((double)i + 0.5 * (double)(j % 2)),
                                    .y = spacing * sqrt(0.75) * (double)j,
                                    .radius = radius,
                                    .mass = model->density[SCREE_PARTICLE_MATERIAL] * M_PI * radius * radius * model->thickness};
    }
    return SCREE_OK;
}

/// Particle-steps per second of the stepping loop on the probe.
static scree_status measure_rate(const scree_model *model, double *rate, scree_error *error)
{
    scree_state state;
    scree_work work;
    const scree_integrator *integrator = scree_integrator_get(model->scheme);
    scree_status status = make_probe(model, &state, error);
    if (status) return status;
    status = scree_work_create(&work, model, 1, error);
    if (!status) status = scree_neighbours_refresh(model, &state, &work, error);
    double begin = scree_clock();
    for (int k = 0; k < PROBE_STEPS && !status; k++) {
        integrator->first(model, &state, &work);
        status = scree_neighbours_refresh(model, &state, &work, error);
        scree_contact_set_quanta(model, &state, 0);
        scree_contact_forces(model, &state, &work);
        if (integrator->second) integrator->second(model, &state, &work);
    }
    *rate = (double)state.count * PROBE_STEPS / (scree_clock() - begin);
    scree_contact_scratch_destroy(&work);
    scree_work_destroy(&work);
    scree_state_destroy(&state);
    return status;
}

/// Force evaluations a tick while loading.
static double evaluations_a_tick(const scree_model *model)
{
    return (double)(1 + model->small_steps) / (double)(model->large_multiple + model->small_steps);
}

static double expected_steps(const scree_model *model)
{
    const scree_config *config = model->config;
    double steps = 0;
    for (int64_t k = 0; k < config->stage_count; k++) {
        const scree_config_stage *stage = &config->stages[k];
        if (stage->kind == SCREE_STAGE_CONFINE) {
            double wave = scree_expected_wave_time(model, stage->pressure);
            steps += CONFINE_WAVES * wave / model->step / (double)model->largest_step;
        }
        double rate = scree_model_loading_rate(stage);
        if (stage->kind == SCREE_STAGE_RELAX) steps += stage->duration / model->step * evaluations_a_tick(model);
        if (!isnan(rate)) steps += stage->strain / rate / model->step * evaluations_a_tick(model);
    }
    return steps;
}

/// Of the first stage that loads.
static double first_inertial_number(const scree_model *model)
{
    double number = NAN;
    for (int64_t k = 0; k < model->config->stage_count && isnan(number); k++)
        number = scree_quasistatic_expect(model, k).value[SCREE_QUASISTATIC_INERTIAL];
    return number;
}

scree_status scree_case_summarise(const scree_case *c, scree_case_summary *summary, scree_error *error)
{
    scree_model model;
    scree_status status = scree_model_build(&c->config, &model, error);
    if (status) {
        scree_case_locate(c, error);
        return status;
    }
    *summary = (scree_case_summary){.particles = (uint64_t)c->config.particles.count,
                                    .step = model.step,
                                    .largest_step = model.largest_step,
                                    .critical_step = model.critical_step,
                                    .phi = model.phi,
                                    .inertial_number = first_inertial_number(&model),
                                    .psi = model.psi,
                                    .mean_radius = model.mean_radius,
                                    .thickness = model.thickness,
                                    .reference_velocity = model.reference_velocity,
                                    .steps = expected_steps(&model)};
    (void)snprintf(summary->name, sizeof summary->name, "%s", c->config.name);
    // Walls that cannot be made are found here.
    scree_container *container;
    if ((status = scree_container_create(&c->config, &container, error))) {
        scree_case_locate(c, error);
        return status;
    }
    scree_container_destroy(&container);
    status = measure_rate(&model, &summary->rate, error);
    summary->seconds = summary->steps * (double)summary->particles / summary->rate;
    summary->memory = BYTES_A_DISC * (double)summary->particles;
    return status;
}

/// A log that goes nowhere but to the caller.
typedef struct listener {
    void (*visit)(void *user, const char *line);
    void *user;
} listener;

static void forward(void *user, scree_log_level level, const char *line)
{
    const listener *to = user;
    (void)level;
    to->visit(to->user, line);
}

scree_status scree_case_warn(const scree_case *c, void (*visit)(void *user, const char *line), void *user,
                             scree_error *error)
{
    scree_model model;
    scree_status status = scree_model_build(&c->config, &model, error);
    listener to = {visit, user};
    scree_log log = {.sink = forward, .user = &to};
    if (status)
        scree_case_locate(c, error);
    else
        scree_quasistatic_warn(&model, &log);
    return status;
}
