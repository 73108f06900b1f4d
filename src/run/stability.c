/// Whether a run is within its limits of stability: checked before the first step of each stage, and when the number of
/// bonds (looked at after every step) or contacts (at every sample) has changed by a hundredth since the last check.
/// Only where bonds hold or particles deform, and something moves; another run has the estimate of its case
/// (model/critical_step.c).
///
/// Method. The step of the scheme, the largest one where it has several, uses a part of what the specimen bears: the
/// largest eigenvalue of (1) in specimen/stability.c with the strain as the run treats it. A bound from single bodies
/// (specimen/bound.c) settles most cases; where it does not, the operator does. Above 1 the run stops between two
/// steps, with a checkpoint; what has been asked for is part of the state, so going on from there stops again.
///
/// `measure.stability` tells the limits themselves as results: the critical step and the largest k_n/E_p at this step
/// as they were when the last stage began. Those are found by the operator alone, whatever the run then does.
///
/// Limits: those of the operator: nothing slides, opens or closes; without dashpots modes of the published form with
/// k_t > 0 may grow below its limit (docs/theory/ddem.md). Cost: some ms a check of 5000 bodies where the bound is
/// enough; else some 0.1 to 1 s.
#include "run/stability.h"

#include "bond/bond.h"
#include "comm/comm.h"
#include "contact/deformation.h"
#include "module/key_rows.h"
#include "run/ranks.h"
#include "run/stage.h"
#include "search/neighbours.h"
#include "specimen/from_state.h"
#include "specimen/stability.h"
#include "state/persistent.h"

#include <float.h>
#include <math.h>

/// Change of a number of bonds or contacts that asks for a check.
#define CHANGE 0.01

typedef struct config {
    bool told;
} config;

static const scree_key keys[] = {
    {.name = "stability",
     .type = SCREE_KEY_FLAG,
     .offset = offsetof(config, told),
     .standard = "no",
     .meaning = "Tell the critical step and the largest k_n/E_p of the specimen when the last stage begins."},
};

typedef struct numbers {
    bool warns, told;
} numbers;

static scree_status resolve(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_stability, "measure", model->config->measure.own);
    (void)error;
    numbers *n = scree_model_reserve_numbers(model, SCREE_SLOT_stability);
    n->warns = model->stability_warns;
    n->told = own && own->told;
    return SCREE_OK;
}

// ---- state -------------------------------------------------------------------------------------------------------

typedef struct memory {
    uint64_t asked;           ///< 1: before the next step
    uint64_t bonds, contacts; ///< at the last check
    double step;              ///< s, critical one
    uint64_t looked;          ///< 1, breaks and held pairs when bonds were counted last, in one number (derived)
    double softness;          ///< 1, largest k_n/E_p at the step of the run over the present one
} memory;

#define ONE(member, kind, unit, meaning, ...)                                                                          \
    SCREE_FIELD_ONE(stability, memory, member, "stability/" #member, kind, 1, unit, meaning, __VA_ARGS__)
static const scree_field fields[] = {
    ONE(asked, SCREE_FIELD_UINT64, "1", "1: limits are checked before the next step", SCREE_RANGE(0, 1)),
    ONE(bonds, SCREE_FIELD_UINT64, "1", "bonds at the last check of the limits", SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    ONE(contacts, SCREE_FIELD_UINT64, "1", "contacts of two bodies or a wall then", SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    ONE(looked, SCREE_FIELD_UINT64, "1", "breaks and held pairs when bonds were counted last",
        .role = SCREE_FIELD_DERIVED),
    ONE(step, SCREE_FIELD_DOUBLE, "s", "critical step of the specimen when a stage began, where it is told",
        .range = {.least = 0, .limit = SCREE_LIMIT_NUMBER, .most = INFINITY, .undefined = true}),
    ONE(softness, SCREE_FIELD_DOUBLE, "1", "largest k_n/E_p at the step of the run over that of the run",
        .range = {.least = 0, .limit = SCREE_LIMIT_NUMBER, .most = INFINITY, .undefined = true}),
};

static memory *memory_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_stability];
}

static const numbers *own_numbers(const scree_simulation *s)
{
    return scree_model_numbers(&s->model, SCREE_SLOT_stability);
}

// ---- when --------------------------------------------------------------------------------------------------------

/// Found by all processes together.
static bool matters(const scree_simulation *s)
{
    if (scree_modules[scree_stage_config(s)->kind]->numbers->still) return false;
    return scree_state_total(&s->state) > 0 &&
           (scree_model_traits(&s->model)->deforms || scree_bonds_standing(&s->state) > 0);
}

static bool has_changed(uint64_t before, uint64_t now)
{
    return fabs((double)now - (double)before) > CHANGE * (double)before;
}

/// Bonds are counted when some have broken, or pairs have come or gone.
static bool bonds_have_changed(const scree_state *state, memory *all)
{
    if (scree_bonds_of(state)->made == 0) return false;
    const uint64_t now = (uint64_t)scree_bonds_of(state)->count << 32 | scree_persistent_total(state);
    if (now == all->looked) return false;
    all->looked = now;
    return has_changed(all->bonds, scree_bonds_standing(state));
}

void scree_stability_ask(scree_simulation *s, bool stage_begins)
{
    memory *all = memory_of(&s->state);
    const bool bonds = bonds_have_changed(&s->state, all);
    int64_t count = (int64_t)s->table.count;
    if (s->sampled) scree_comm_add(&s->state, &count, 1);
    const bool contacts = s->sampled && has_changed(all->contacts, (uint64_t)count);
    if (stage_begins || bonds || contacts) all->asked = 1;
}

// ---- the check ---------------------------------------------------------------------------------------------------

/// What a check is about.
typedef struct checked {
    scree_specimen specimen;
    scree_strain_scheme scheme;
    double step; ///< s, of the run
} checked;

/// Largest number of contacts of a body.
static scree_status count_contacts(const scree_specimen *s, double *most, scree_error *error)
{
    uint32_t *count;
    scree_status status = scree_allocate(&count, s->body_count, sizeof *count, error);
    *most = 0;
    if (status) return status;
    for (size_t k = 0; k < s->contact_count; k++) {
        count[s->contact[k].first]++;
        if (s->contact[k].second != SCREE_SPECIMEN_WALL) count[s->contact[k].second]++;
    }
    for (size_t k = 0; k < s->body_count; k++) *most = fmax(*most, count[k]);
    scree_release(&count);
    return SCREE_OK;
}

static scree_status open_check(scree_simulation *s, checked *c, scree_error *error)
{
    double contacts = 0;
    c->step = s->state.tick * (double)s->model.largest_step;
    scree_status status = scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
    if (!status) status = scree_specimen_of_state(&s->stage_model, &s->state, &s->work, &c->specimen, error);
    if (!status) status = count_contacts(&c->specimen, &contacts, error);
    c->scheme = (scree_strain_scheme){scree_deformation_share(&s->stage_model, contacts), NAN};
    return status;
}

/// The limits themselves. radius: that of B, 0 of rigid particles.
static scree_status find_limits(checked *c, double *step, double *softness, scree_error *error)
{
    scree_status status = scree_spectral_radius(&c->specimen, &c->scheme.radius, NULL, error);
    if (!status) status = scree_critical_step(&c->specimen, c->scheme, step, NULL, error);
    if (!status) status = scree_stability_softness(&c->specimen, c->scheme, c->step, softness, error);
    return status;
}

/// What is above its limit, and what helps.
static void explain(const checked *c, double step, double softness, char *text, size_t size)
{
    const bool deforms = c->scheme.share > 0 && c->scheme.radius > 0;
    const bool lagged = deforms && c->scheme.share == 1, stiff = deforms && softness > 0 && softness < 1;
    const double present = scree_stiffness_ratio(&c->specimen);
    char what[160], ratio[96] = "";
    if (step > 0)
        (void)snprintf(what, sizeof what, "the step of %.5g s is above the critical one of the specimen, %.5g s",
                       c->step, step);
    else
        (void)snprintf(what, sizeof what, "no step is stable, as the spectral radius of the strains is %.4g",
                       c->scheme.radius);
    if (stiff)
        (void)snprintf(ratio, sizeof ratio, "; k_n/E is %.4g m, and may be %.4g m with this step", present,
                       softness * present);
    (void)snprintf(
        text, size, "%s%s: take %s%s%s", what, ratio, step > 0 ? "a smaller integrator.step" : "",
        stiff ? (step > 0 ? ", stiffer particles or softer contacts" : "stiffer particles or softer contacts") : "",
        lagged ? ", or contact.deformation: relaxed or implicit" : "");
}

static scree_status complain(scree_simulation *s, checked *c, scree_error *error)
{
    double step = NAN, softness = NAN;
    char text[400];
    scree_status status = find_limits(c, &step, &softness, error);
    if (status) return status;
    explain(c, step, softness, text, sizeof text);
    if (own_numbers(s)->warns) {
        (void)snprintf(s->warning, sizeof s->warning, "step %llu, stage %s: %s", (unsigned long long)s->state.step,
                       scree_stage_config(s)->name, text);
        return SCREE_OK;
    }
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu, stage %s: %s; guard.stability: warn lets it run nevertheless",
                           (unsigned long long)s->state.step, scree_stage_config(s)->name, text);
}

static scree_status judge(scree_simulation *s, checked *c, scree_error *error)
{
    double use;
    scree_status status = scree_stability_bound(&c->specimen, c->scheme.share, c->step, &use, error);
    if (!status && !(use < 1)) status = scree_stability_use(&c->specimen, c->scheme, c->step, &use, error);
    if (!status && !(use < 1)) status = complain(s, c, error);
    return status;
}

/// Of a whole sample.
static scree_status check(scree_simulation *s, memory *all, scree_error *error)
{
    checked c = {.step = 0};
    const bool told = own_numbers(s)->told && s->state.step == s->state.stage.first_step;
    scree_status status = open_check(s, &c, error);
    if (!status && told) status = find_limits(&c, &all->step, &all->softness, error);
    if (!status) status = judge(s, &c, error);
    all->contacts = c.specimen.contact_count;
    all->bonds = scree_bonds_standing(&s->state);
    scree_specimen_destroy(&c.specimen);
    return status;
}

/// By process 0, for all.
static scree_status check_whole(scree_simulation *s, memory *all, scree_error *error)
{
    scree_error second;
    scree_status status = scree_ranks_gather(s, "limits of stability", error);
    if (!status && scree_ranks_acts(s)) status = check(s, all, error);
    status = scree_comm_agree(status, error);
    scree_comm_share(all, sizeof *all);
    const scree_status back = scree_ranks_return(s, status ? &second : error);
    return status ? status : back;
}

scree_status scree_stability_check(scree_simulation *s, scree_error *error)
{
    memory *all = memory_of(&s->state);
    scree_status status = SCREE_OK;
    if (!all->asked) return SCREE_OK;
    if (matters(s)) status = check_whole(s, all, error);
    // What stops the run stays asked for: it stops again.
    if (!status) all->asked = 0;
    return status;
}

// ---- results -----------------------------------------------------------------------------------------------------

static const scree_result results[] = {
    {"limit_step", "s", "critical step of the specimen when the last stage began, in the scheme of the run"},
    {"limit_softness", "1", "largest k_n/E at the step of the run over that of the run, then"},
};

static scree_status measure(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const memory *all = memory_of(c->state);
    (void)index, (void)error;
    value[0] = all->step;
    value[1] = all->softness;
    return SCREE_OK;
}

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    const config *own =
        whole->measure.own ? scree_config_own(&scree_module_stability, "measure", whole->measure.own) : NULL;
    name[0] = 0;
    return index == 0 && own && own->told;
}

const scree_module scree_module_stability = {
    .name = "stability",
    .meaning = "limits of stability of the specimen",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .numbers_size = sizeof(numbers),
    .resolve = resolve,
    .state_size = sizeof(memory),
    .fields = fields,
    .field_count = COUNT(fields),
    .results = SCREE_RESULTS(results, measure),
    .told = told,
};
