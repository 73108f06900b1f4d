/// Is a loading quasistatic? Numbers of a case before it runs, numbers of its samples, warnings, the verdict.
///
/// Before the run: rate and pressure are the case's, the sample has the solid fraction and the height expected of it
/// (model/critical_step.c) and the longitudinal modulus that the servo of the plates assumes (boundary/plates.c).
///
/// In the run: kinetic energy is all of it, rotations and affine motion too (in a periodic cell velocities are relative
/// to the affine field, which so does not count); elastic energy that of all contacts. Of a loading the means over its
/// samples count, one over the other: single grains that snap into a new place are quasistatic too. Of a confinement
/// the last sample counts: it begins with what fell, and ends at rest. The inertial number is that of the rate imposed
/// at the moment, under the confining pressure, or the mean normal stress of the contacts where that is less (a sample
/// at constant volume may lose its pressure); its mean over the loading counts.
/// Cost: O(rows) at the end of a run.
#include "run/quasistatic.h"

#include "model/critical_step.h"
#include "run/core_columns.h"
#include "run/loading.h"

#include <math.h>
#include <string.h>

/// A loading is warned of when 1 / EARLY of its samples are there and CLEARLY times the limit is passed, else at its
/// end.
enum { EARLY = 10, CLEARLY = 2, TEXT = 512 };

// ---- what a case says before it runs -------------------------------------------------------------------------------

static bool means_to_be_quasistatic(const scree_config_stage *stage)
{
    return scree_modules[stage->kind]->stage->quasistatic;
}

double scree_confining_pressure(const scree_model *model, int64_t index)
{
    for (; index >= 0; index--)
        if (scree_held_pressure(&model->stages[index]) > 0) return scree_held_pressure(&model->stages[index]);
    return NAN;
}

double scree_expected_wave_time(const scree_model *model, double pressure)
{
    double fraction = scree_expected_solid_fraction(model), radius = scree_model_filling_radius(model);
    double height = scree_expected_height(model, fraction), count = (double)model->count;
    double section = count * M_PI * radius * radius / (fraction * height);
    double width = model->dimension == 3 ? sqrt(4.0 / 3.0 * radius * section) : section;
    double speed = scree_wave_speed(scree_confined_modulus(model, pressure), scree_model_mean_density(model), fraction);
    return fmax(height, width) / speed;
}

static double inertial_number(const scree_model *model, double rate, double pressure)
{
    return scree_inertial_number(model->dimension, scree_model_mean_mass(model), model->mean_radius,
                                 scree_model_mean_density(model), model->thickness, rate, pressure);
}

scree_quasistatic scree_quasistatic_expect(const scree_model *model, int64_t index)
{
    const scree_config_stage *stage = &model->stages[index];
    scree_quasistatic q = {.stage = index,
                           .rate = scree_model_loading_rate(model, stage),
                           .pressure = scree_confining_pressure(model, index)};
    for (int k = 0; k < SCREE_QUASISTATIC_COUNT; k++) q.value[k] = NAN;
    if (!means_to_be_quasistatic(stage) || isnan(q.pressure)) return q;
    double fraction = scree_expected_solid_fraction(model), height = scree_expected_height(model, fraction);
    double weight = scree_model_gravity(model) * scree_model_mean_density(model) * fraction * height;
    q.value[SCREE_QUASISTATIC_INERTIAL] = inertial_number(model, q.rate, q.pressure);
    q.value[SCREE_QUASISTATIC_MODULUS] = scree_model_mean_modulus(model) / q.pressure;
    q.value[SCREE_QUASISTATIC_WEIGHT] = weight / q.pressure;
    q.value[SCREE_QUASISTATIC_SOUND] = q.rate * scree_expected_wave_time(model, q.pressure);
    return q;
}

// ---- words ---------------------------------------------------------------------------------------------------------

/// Rounds to two significant digits, down or up, so that what is advised keeps the limit.
static double two_digits(double value, bool up)
{
    double unit = pow(10, floor(log10(value)) - 1);
    return (up ? ceil(value / unit - 1e-9) : floor(value / unit + 1e-9)) * unit;
}

/// What to change, so that the number keeps its limit: up to the value that does.
static void advise(const scree_model *model, const scree_quasistatic *q, scree_quasistatic_criterion criterion,
                   char *text, size_t size)
{
    double excess = q->value[criterion] / scree_quasistatic_limits[criterion].limit, pressure = q->pressure;
    switch (criterion) {
    case SCREE_QUASISTATIC_INERTIAL:
        (void)snprintf(text, size, "the grains' inertia shows; a rate of %.2g 1/s keeps it",
                       two_digits(q->rate / excess, false));
        break;
    case SCREE_QUASISTATIC_KINETIC:
        // The energy goes about with the square of the rate.
        if (isnan(q->rate))
            (void)snprintf(text, size, "the sample is not at rest; take longer, or a smaller unbalanced_limit");
        else
            (void)snprintf(text, size, "the sample moves more than it is pressed; a rate of about %.2g 1/s keeps it",
                           two_digits(q->rate / sqrt(excess), false));
        break;
    case SCREE_QUASISTATIC_MODULUS:
        if (scree_model_modulus_key(model))
            (void)snprintf(text, size, "overlaps matter; %.2g times the %s, or a pressure of %.2g Pa, keeps it",
                           two_digits(1 / excess, true), scree_model_modulus_key(model),
                           two_digits(pressure * excess, false));
        else
            (void)snprintf(text, size, "overlaps matter; young_modulus of %.2g Pa, or a pressure of %.2g Pa, keeps it",
                           two_digits(pressure * scree_quasistatic_limits[criterion].limit, true),
                           two_digits(pressure * excess, false));
        break;
    case SCREE_QUASISTATIC_WEIGHT:
        (void)snprintf(text, size, "the stress grows with depth; a pressure of %.2g Pa, or less gravity, keeps it",
                       two_digits(pressure * excess, true));
        break;
    case SCREE_QUASISTATIC_SOUND:
    case SCREE_QUASISTATIC_COUNT:
        (void)snprintf(text, size, "the loading outruns sound; a rate of %.2g 1/s keeps it",
                       two_digits(q->rate / excess, false));
        break;
    }
}

bool scree_quasistatic_explain(const scree_model *model, const scree_quasistatic *q,
                               scree_quasistatic_criterion criterion, bool advice, char *text, size_t size)
{
    const scree_quasistatic_limit *limit = &scree_quasistatic_limits[criterion];
    if (scree_quasistatic_keeps(criterion, q->value[criterion])) return false;
    int used =
        snprintf(text, size, "stage %lld (%s): %s %.3g, %s %g", (long long)q->stage, model->stages[q->stage].name,
                 limit->name, q->value[criterion], limit->least ? "below" : "above", limit->limit);
    if (!advice || used < 0 || (size_t)used + 3 > size) return true;
    memcpy(text + used, ": ", 3);
    advise(model, q, criterion, text + used + 2, size - (size_t)used - 2);
    return true;
}

void scree_quasistatic_warn(const scree_model *model, scree_log *log)
{
    char text[TEXT];
    for (int64_t k = 0; k < model->stage_count; k++) {
        scree_quasistatic q = scree_quasistatic_expect(model, k);
        for (int c = 0; c < SCREE_QUASISTATIC_COUNT; c++)
            if (scree_quasistatic_explain(model, &q, (scree_quasistatic_criterion)c, true, text, sizeof text))
                scree_log_write(log, SCREE_LOG_WARNING, "%s", text);
    }
}

// ---- while it runs -------------------------------------------------------------------------------------------------

double scree_quasistatic_inertial_now(const scree_simulation *s, double mean_stress)
{
    double rate = s->stage->rate ? s->stage->rate(s) : scree_model_loading_rate(&s->model, scree_stage_config(s)),
           loaded;
    if (isnan(rate)) return NAN;
    // fmin passes over a pressure that there is not.
    double pressure = fmin(scree_confining_pressure(&s->model, s->state.stage.index), mean_stress);
    return inertial_number(&s->model, rate * scree_loading_rise(s, &loaded), pressure);
}

/// NAN where grains that stick have gained more from their surfaces than they are deformed by: nothing to compare with.
static double over_stored(double kinetic, double stored)
{
    return stored >= 0 ? kinetic / stored : NAN;
}

void scree_quasistatic_follow(scree_quasistatic_watch *watch, const scree_simulation *s, scree_log *log)
{
    const double *value = s->sample;
    int64_t stage = (int64_t)value[SCREE_SAMPLE_STAGE];
    const scree_config_stage *config = &s->model.stages[stage];
    const bool settles = scree_modules[config->kind]->numbers->settles;
    if (stage != watch->stage || watch->samples == 0 || settles) *watch = (scree_quasistatic_watch){.stage = stage};
    watch->kinetic += value[SCREE_SAMPLE_KINETIC];
    watch->elastic += value[SCREE_SAMPLE_ELASTIC_NORMAL] + value[SCREE_SAMPLE_ELASTIC_TANGENTIAL];
    watch->samples++;
    double ratio = over_stored(watch->kinetic, watch->elastic);
    bool early = watch->samples * EARLY >= (uint64_t)s->model.measure.samples &&
                 ratio > CLEARLY * scree_quasistatic_limits[SCREE_QUASISTATIC_KINETIC].limit;
    bool enough = s->stage_ended || (early && !settles);
    if (!enough || watch->warned || !means_to_be_quasistatic(config)) return;
    char text[TEXT];
    scree_quasistatic q = scree_quasistatic_expect(&s->model, stage);
    q.value[SCREE_QUASISTATIC_KINETIC] = ratio;
    watch->warned = scree_quasistatic_explain(&s->model, &q, SCREE_QUASISTATIC_KINETIC, true, text, sizeof text);
    if (watch->warned) scree_log_write(log, SCREE_LOG_WARNING, "%s", text);
}

// ---- the verdict ---------------------------------------------------------------------------------------------------

/// Adds what the rows [first, last) of the series, those of one stage, show.
static void observe(const scree_series *series, size_t first, size_t last, bool confining, scree_quasistatic *q)
{
    const double *inertial = scree_series_get(series, "inertial_number");
    const double *kinetic = scree_series_get(series, "kinetic");
    const double *normal = scree_series_get(series, "elastic_normal");
    const double *tangential = scree_series_get(series, "elastic_tangential");
    double moving = 0, stored = 0, sum = 0, rows = 0;
    for (size_t k = confining ? last - 1 : first; k < last; k++) {
        moving += kinetic[k];
        stored += normal[k] + tangential[k];
        if (isnan(inertial[k])) continue;
        sum += inertial[k];
        rows++;
    }
    q->value[SCREE_QUASISTATIC_KINETIC] = over_stored(moving, stored);
    q->value[SCREE_QUASISTATIC_INERTIAL] = rows > 0 ? sum / rows : NAN;
}

/// Appends every limit that is not kept; those that the case told before it ran (`expected`) once, with its number.
static void append_findings(const scree_model *model, const scree_quasistatic *expected, const scree_quasistatic *seen,
                            char *text, size_t size)
{
    char finding[TEXT];
    for (int c = 0; c < SCREE_QUASISTATIC_COUNT; c++) {
        scree_quasistatic_criterion criterion = (scree_quasistatic_criterion)c;
        if (!scree_quasistatic_explain(model, expected, criterion, false, finding, sizeof finding) &&
            !scree_quasistatic_explain(model, seen, criterion, false, finding, sizeof finding))
            continue;
        size_t used = strlen(text);
        (void)snprintf(text + used, size - used, "%s%s", used ? "; " : "", finding);
    }
}

void scree_quasistatic_results(const scree_model *model, const scree_series *series, scree_summary *summary)
{
    const double *stage = scree_series_get(series, "stage");
    char reason[4 * TEXT] = "";
    bool found = false;
    for (size_t first = 0, last; first < series->row_count; first = last) {
        for (last = first + 1; last < series->row_count && stage[last] == stage[first]; last++) continue;
        int64_t index = (int64_t)stage[first];
        if (!means_to_be_quasistatic(&model->stages[index])) continue;
        scree_quasistatic expected = scree_quasistatic_expect(model, index), seen = expected;
        observe(series, first, last, scree_modules[model->stages[index].kind]->numbers->settles, &seen);
        append_findings(model, &expected, &seen, reason, sizeof reason);
        scree_summary_set_number(summary, "inertial_number", seen.value[SCREE_QUASISTATIC_INERTIAL]);
        scree_summary_set_number(summary, "kinetic_over_elastic", seen.value[SCREE_QUASISTATIC_KINETIC]);
        found = true;
    }
    if (!found) return;
    scree_summary_set_text(summary, "quasistatic", reason[0] ? "no" : "yes");
    scree_summary_set_text(summary, "quasistatic_reason", reason[0] ? reason : "every stage keeps its limits");
}
