/// What a case amounts to before it is run: numbers of the model, and what a run of it will take.
#include "base/handle.h"
#include "case/case.h"
#include "integrate/integrate.h"
#include "run/estimate.h"
#include "run/quasistatic.h"
#include "run/simulation.h"
#include "shape/wall_set.h"
#include "source/room.h"

#include <math.h>
#include <string.h>

/// Of the first stage that loads.
static double first_inertial_number(const scree_model *model)
{
    double number = NAN;
    for (int64_t k = 0; k < model->stage_count && isnan(number); k++)
        number = scree_quasistatic_expect(model, k).value[SCREE_QUASISTATIC_INERTIAL];
    return number;
}

/// The largest of contacts of two mean grains; NAN: nothing sticks.
static double largest_tabor(const scree_model *model)
{
    double largest = 0;
    for (int i = 0; i < model->material_count; i++)
        for (int j = 0; j <= i; j++) {
            const scree_law *law = scree_law_get(scree_model_law_between(model, i, j)->law);
            if (law->tabor) largest = fmax(largest, law->tabor(&model->pairs[i][j], 0.5 * model->mean_radius));
        }
    return largest > 0 ? largest : NAN;
}

/// What cannot be probed leaves times that are not known; a case that is wrong shows when it is run.
static scree_status estimate(const scree_case *c, const scree_model *model, scree_case_summary *summary,
                             scree_error *error)
{
    scree_run_cost cost;
    scree_probe probe;
    scree_error problem = {0};
    scree_status status = scree_probe_measure(c, scree_longest_stage(model), &probe, &problem);
    // Nothing of it touches a file: memory.
    if (status == SCREE_ERROR_IO) {
        *error = problem;
        return status;
    }
    if (status) probe = (scree_probe){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    scree_run_expect(model, &probe, scree_columns_look_at_whole(&c->config), &cost);
    summary->steps = cost.steps;
    summary->stepping = cost.stepping;
    summary->output = cost.output;
    summary->figures = cost.figures;
    summary->seconds = cost.stepping + cost.output + cost.figures;
    summary->rate = cost.rate;
    summary->memory = cost.memory;
    summary->preparation = cost.preparation;
    summary->lists = cost.lists;
    return SCREE_OK;
}

scree_status scree_case_summarise(const scree_case *c, scree_case_summary *summary, scree_error *error)
{
    scree_handle_check(c, "a case");
    scree_model model;
    scree_status status = scree_case_model(c, &model, error);
    if (status) return status;
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
                                    .tabor = largest_tabor(&model),
                                    .sleeps = scree_some_may_sleep(model.stages, model.stage_count)};
    (void)snprintf(summary->name, sizeof summary->name, "%s", c->config.name);
    // Walls that cannot be made are found here.
    scree_wall_set *wall_set;
    if ((status = scree_wall_set_create(&c->config, &wall_set, error))) {
        scree_case_locate(c, error);
        return status;
    }
    for (int64_t k = 0; k < model.source_count && !status; k++)
        status = scree_source_check_opening(&model, wall_set, k, error);
    scree_wall_set_destroy(&wall_set);
    if (status) {
        scree_case_locate(c, error);
        return status;
    }
    status = estimate(c, &model, summary, error);
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
    scree_handle_check(c, "a case");
    scree_model model;
    scree_status status = scree_case_model(c, &model, error);
    listener to = {visit, user};
    scree_log log = {.sink = forward, .user = &to};
    scree_wall_set *wall_set = NULL;
    if (!status) status = scree_wall_set_create(&c->config, &wall_set, error);
    if (status) return status;
    scree_quasistatic_warn(&model, &log);
    scree_source_warn(&model, wall_set, &log);
    scree_wall_set_destroy(&wall_set);
    return SCREE_OK;
}
