/// Stage `load_path`: a path in stress and strain. Each component of the sample has a rate, a stress, or a table of
/// either over the time of the stage; the normal components that are left obey one condition (`keep`): no strain (K0),
/// constant volume (undrained), constant mean stress p, constant q / p. The rates of `strain_rate` may change their
/// sign whenever a strain or a deviator stress is reached.
///
/// What is left, of n components with the set F of those left, sigma their stresses, compression positive:
///     volume      L_kk = - sum over the others L_ii / |F|, so the trace is zero and all in F are strained alike
///     p           sigma_k = (n p - sum over the others sigma_i) / |F|
///     q / p       sigma_k = sigma_a (3 - eta) / (3 + 2 eta) in 3D, sigma_a (2 - eta) / (2 + eta) in 2D, a the
///     component
///                 that is driven, q = sigma_a - sigma_k, p the mean of all (Wood 1990, 1.4)
/// with the stresses of the present step, to which the servo of the boundary brings them (boundary/periodic.c,
/// boundary/plates.c). Constant volume in place of an undrained test: pore pressure is then what p has lost (Ng and
/// Dobry 1994).
///
/// Rates rise within `rise_time`, and turn within it: from the share of the rate at the turn to the other sign, as the
/// smooth step. The driven component is that of the largest rate; its strain is the sum of what was imposed,
/// logarithmic.
///
/// Stop rules: that strain has reached `strain` in either sense, `cycles` pairs of reversals are there, `time` is over;
/// whichever is first. Limits: plates have no shear components.
#include "boundary/boundary.h"
#include "measure/imposed_gradient.h"
#include "module/key_rows.h"
#include "run/loading.h"
#include "run/step.h"
#include "state/pressure.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { COMPONENTS = 6 };

/// Places of the components in a tensor by rows, in the order of the keys.
static const int places[COMPONENTS] = {0, 4, 8, 1, 2, 5};

typedef enum keep { KEEP_LATERAL_STRAIN, KEEP_VOLUME, KEEP_P, KEEP_RATIO } keep;

typedef struct config {
    double strain_rate[9];                ///< 1/s, extension positive; NAN: none
    double stress[9];                     ///< Pa, compression positive; NAN: none
    scree_schedule tables[2][COMPONENTS]; ///< strains [1] and stresses [Pa] over the time of the stage; NAN: none
    int keep;
    double p, q_over_p;                    ///< Pa, 1; NAN: as at the begin
    double reverse_strain, reverse_stress; ///< 1, Pa; NAN: none
    int64_t cycles;                        ///< 0: not counted
    double strain, time, rise_time;        ///< 1, s, s; NAN: none
} config;

static const scree_choice rates[] = {
    {"xx", 0, "strain rate along x"},
    {"yy", 4, "strain rate along y"},
    {"zz", 8, "strain rate along z"},
    {"xy", 1, "shear rate dv_x/dy"},
    {"xz", 2, "shear rate dv_x/dz"},
    {"yz", 5, "shear rate dv_y/dz"},
    {0},
};
static const scree_choice stresses[] = {
    {"xx", 0, "normal stress on x"},
    {"yy", 4, "normal stress on y"},
    {"zz", 8, "normal stress on z"},
    {"xy", 1, "shear stress xy"},
    {"xz", 2, "shear stress xz"},
    {"yz", 5, "shear stress yz"},
    {0},
};
static const scree_choice kept[] = {
    {"lateral_strain", KEEP_LATERAL_STRAIN, "they do not move (oedometer, K0)"},
    {"volume", KEEP_VOLUME, "constant volume, all of them strained alike (undrained)"},
    {"p", KEEP_P, "constant mean stress, all of them under one stress"},
    {"q_over_p", KEEP_RATIO, "constant ratio of deviator and mean stress, all of them under one stress"},
    {0},
};

#define TABLE_OF(kind, place, text, si, limit, what)                                                                   \
    {                                                                                                                  \
        .name = text, .type = SCREE_KEY_SCHEDULE, .offset = offsetof(config, tables[kind][place]), .unit = si,         \
        .standard = "auto", FROM("-" limit), TO(limit), .meaning = what                                                \
    }
#define STRAIN_TABLE(place, name)                                                                                      \
    TABLE_OF(0, place, "strain_" name, "1", "100", "Strain " name " over the time of the stage, extension positive.")
#define STRESS_TABLE(place, name)                                                                                      \
    TABLE_OF(1, place, "stress_" name, "Pa", "1000 GPa",                                                               \
             "Stress " name " over the time of the stage, compression positive.")
static const scree_key keys[] = {
    TENSOR(config, strain_rate, rates, "1/s", FROM("-1e6 1/s"), TO("1e6 1/s"),
           .meaning = "Components that are driven, extension positive, e.g. {yy: -1e-2 1/s}; the largest is the one "
                      "whose strain and stress the stage asks for."),
    TENSOR(config, stress, stresses, "Pa", FROM("-1000 GPa"), TO("1000 GPa"),
           .meaning = "Components whose stress is held, compression positive, e.g. {xx: 100 kPa}."),
    STRAIN_TABLE(0, "xx"),
    STRAIN_TABLE(1, "yy"),
    STRAIN_TABLE(2, "zz"),
    STRAIN_TABLE(3, "xy"),
    STRAIN_TABLE(4, "xz"),
    STRAIN_TABLE(5, "yz"),
    STRESS_TABLE(0, "xx"),
    STRESS_TABLE(1, "yy"),
    STRESS_TABLE(2, "zz"),
    STRESS_TABLE(3, "xy"),
    STRESS_TABLE(4, "xz"),
    STRESS_TABLE(5, "yz"),
    CHOICE(config, keep, kept, .standard = "lateral_strain",
           .meaning = "What the normal components obey for which nothing else is said."),
    NUMBER(config, p, "Pa", .standard = "auto", FROM("1e-3 Pa"), TO("1000 GPa"), .when = "keep=p",
           .meaning = "The mean stress that is kept; auto: that of the begin."),
    NUMBER(config, q_over_p, "1", .standard = "auto", FROM("-1.4"), BELOW("3"), .when = "keep=q_over_p",
           .meaning = "The ratio that is kept; auto: that of the begin."),
    NUMBER(config, reverse_strain, "1", .standard = "auto", ABOVE("0 %"), TO("1000 %"),
           .meaning =
               "The rates change their sign when the strain of the driven component has come so far from that of "
               "the begin; auto: never."),
    NUMBER(config, reverse_stress, "Pa", .standard = "auto", ABOVE("0 Pa"), TO("1000 GPa"),
           .meaning = "The same when the deviator stress has: driven normal stress less the mean of the others; of "
                      "shear the shear stress. auto: never."),
    INTEGER(config, cycles, .standard = "0", FROM("0"), TO("1e9"),
            .meaning = "The stage ends with the last reversal of so many cycles, two in each; 0: it does not count."),
    NUMBER(config, strain, "1", .standard = "auto", ABOVE("0 %"), TO("1000000 %"),
           .meaning = "The stage ends when the strain of the driven component has come so far, in either sense."),
    NUMBER(config, time, "s", .standard = "auto", ABOVE("0 s"), TO("1e12 s"),
           .meaning = "The stage ends after this time."),
    NUMBER(config, rise_time, "s", .standard = "auto", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time in which the rates are reached and turned; auto: four wave times of the sample."),
};

// ---- what the case says ------------------------------------------------------------------------------------------

static const config *own_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

static bool has_table(const config *stage, int kind, int component)
{
    return !isnan(stage->tables[kind][component].value);
}

static bool has_rate(const config *stage, int component)
{
    return !isnan(stage->strain_rate[places[component]]);
}

static bool has_stress(const config *stage, int component)
{
    return !isnan(stage->stress[places[component]]) || has_table(stage, 1, component);
}

/// Nothing is said of the normal component `axis` but what `keep` says.
static bool is_left(const config *stage, int axis)
{
    return !has_rate(stage, axis) && !has_stress(stage, axis) && !has_table(stage, 0, axis);
}

static int left(const config *stage, int dimension)
{
    int count = 0;
    for (int axis = 0; axis < dimension; axis++) count += is_left(stage, axis);
    return count;
}

/// The component with the largest rate; -1: none is driven.
static int driven(const config *stage)
{
    int largest = -1;
    for (int c = 0; c < COMPONENTS; c++)
        if (has_rate(stage, c) &&
            (largest < 0 || fabs(stage->strain_rate[places[c]]) > fabs(stage->strain_rate[places[largest]])))
            largest = c;
    return largest >= 0 && stage->strain_rate[places[largest]] != 0 ? largest : -1;
}

/// Rate [1/s] of the driven component, or the largest of the tables of strain; NAN where stresses alone are said.
static double rate_of(const scree_model *model, const void *own)
{
    const config *stage = own;
    double largest = 0;
    (void)model;
    int c = driven(stage);
    if (c >= 0) return fabs(stage->strain_rate[places[c]]);
    for (int k = 0; k < COMPONENTS; k++)
        if (has_table(stage, 0, k)) largest = fmax(largest, scree_schedule_largest_rate(&stage->tables[0][k]));
    return largest > 0 ? largest : NAN;
}

static bool is_cyclic(const config *stage)
{
    return !isnan(stage->reverse_strain) || !isnan(stage->reverse_stress);
}

/// s at the full rate: what is known of it; where stresses turn it, that of the strain that ends it.
static double duration(const scree_model *model, const void *own)
{
    const config *stage = own;
    double rate = rate_of(model, own), time = stage->time;
    if (stage->cycles > 0 && !isnan(stage->reverse_strain))
        time = fmin(time, (4 * (double)stage->cycles - 1) * stage->reverse_strain / rate);
    else if (!isnan(stage->strain))
        time = fmin(time, stage->strain / rate);
    return time;
}

static double strain_of(const void *own)
{
    const config *stage = own;
    return is_cyclic(stage) && !isnan(stage->reverse_strain) ? stage->reverse_strain : stage->strain;
}

/// No normal component hangs on a stress, so none needs a pressure to begin with.
static bool strains_all(const void *own, int dimension)
{
    const config *stage = own;
    for (int axis = 0; axis < dimension; axis++)
        if (has_stress(stage, axis)) return false;
    return left(stage, dimension) == 0 || stage->keep == KEEP_LATERAL_STRAIN || stage->keep == KEEP_VOLUME;
}

static double planned(const scree_model *model, const void *own, double wave)
{
    return scree_loading_planned(duration(model, own), ((const config *)own)->rise_time, wave);
}

// ---- the state ---------------------------------------------------------------------------------------------------

typedef struct progress {
    double p, ratio;    ///< Pa, 1: that are kept
    double strain;      ///< 1, of the driven component since the begin, in the sense of its rate
    double sense;       ///< 1 or -1, of the rates
    double from;        ///< 1, share of the rates when they were last turned
    double turned;      ///< s since the begin of the stage, when that was
    uint64_t reversals; ///< since the begin
} progress;

static progress *own_state(const scree_simulation *s)
{
    return s->state.own[SCREE_SLOT_load_path];
}

static double sign_of(const config *stage)
{
    return copysign(1, stage->strain_rate[places[driven(stage)]]);
}

/// Mean of the normal stresses [Pa, compression positive].
static double mean_stress(const double stress[9], int dimension)
{
    double sum = 0;
    for (int k = 0; k < dimension; k++) sum -= stress[4 * k];
    return sum / dimension;
}

/// Mean of the normal stresses but that along `axis`.
static double other_stress(const double stress[9], int dimension, int axis)
{
    return (dimension * mean_stress(stress, dimension) + stress[4 * axis]) / (dimension - 1);
}

/// Deviator stress [Pa] of the driven component, in the sense of its rate.
static double deviator(const config *stage, const double stress[9], int dimension)
{
    int c = driven(stage);
    double normal = c < 3 ? other_stress(stress, dimension, c) : 0;
    return sign_of(stage) * (stress[places[c]] + normal);
}

static double ratio_of(const config *stage, const double stress[9], int dimension)
{
    int c = driven(stage);
    if (c < 0 || c > 2) return 0;
    return -(stress[4 * c] + other_stress(stress, dimension, c)) / mean_stress(stress, dimension);
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    (void)error;
    const scree_context context = scree_step_context(s);
    const config *stage = own_config(s);
    double stress[9];
    s->boundary->stress(&context, stress);
    const double p = mean_stress(stress, s->state.dimension), ratio = ratio_of(stage, stress, s->state.dimension);
    *own_state(s) = (progress){
        .p = isnan(stage->p) ? p : stage->p, .ratio = isnan(stage->q_over_p) ? ratio : stage->q_over_p, .sense = 1};
    scree_loading_begin(s, p > 0 ? p : scree_pressure_now(&s->state));
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    const config *stage = own_config(s);
    s->plan = scree_loading_plan(s, duration(&s->model, stage), stage->rise_time);
}

// ---- a step ------------------------------------------------------------------------------------------------------

/// Share of the rates in this step.
static double share_now(const scree_simulation *s, const progress *now)
{
    double rise = s->plan.ramp_time, since = scree_stage_elapsed(s) - now->turned;
    double done = rise > 0 ? scree_smooth_ramp(fmin(1, since / rise)) : 1;
    return now->from + (now->sense - now->from) * done;
}

/// Turns the rates where strain or stress have come far enough.
static void turn(const scree_simulation *s, progress *now, const double stress[9])
{
    const config *stage = own_config(s);
    if (!is_cyclic(stage)) return;
    bool strained = now->sense * now->strain >= stage->reverse_strain;
    bool stressed = now->sense * deviator(stage, stress, s->state.dimension) >= stage->reverse_stress;
    if (!strained && !stressed) return;
    now->from = share_now(s, now);
    now->turned = scree_stage_elapsed(s);
    now->sense = -now->sense;
    now->reversals++;
}

/// What is said of the components: rates, of those of strain_rate this share, and stresses.
static void say(const config *stage, double time, double share, scree_demand *demand)
{
    for (int c = 0; c < COMPONENTS; c++) {
        const int at = places[c];
        const double sense = c < 3 ? -1 : 1;
        if (has_rate(stage, c)) demand->rate[at] = share * stage->strain_rate[at];
        if (has_table(stage, 0, c)) demand->rate[at] = scree_schedule_rate(&stage->tables[0][c], time);
        if (has_table(stage, 1, c)) demand->stress[at] = sense * scree_schedule_at(&stage->tables[1][c], time);
        if (!isnan(stage->stress[at])) demand->stress[at] = sense * stage->stress[at];
    }
}

/// Stress [Pa, compression positive] of the components that are left.
static double left_stress(const config *stage, const progress *now, const double stress[9], int dimension)
{
    const int axis = driven(stage);
    double others = 0, eta = now->ratio;
    if (stage->keep == KEEP_RATIO)
        return -stress[4 * axis] * (dimension == 3 ? (3 - eta) / (3 + 2 * eta) : (2 - eta) / (2 + eta));
    for (int k = 0; k < dimension; k++)
        if (!is_left(stage, k)) others -= stress[4 * k];
    return (dimension * now->p - others) / left(stage, dimension);
}

/// What `keep` says of the normal components that are left.
static void keep_condition(const config *stage, const progress *now, const double stress[9], int dimension,
                           scree_demand *demand)
{
    double trace = 0;
    if (stage->keep == KEEP_LATERAL_STRAIN) return;
    for (int k = 0; k < dimension; k++) trace += demand->rate[4 * k];
    for (int k = 0; k < dimension; k++) {
        if (!is_left(stage, k)) continue;
        if (stage->keep == KEEP_VOLUME)
            demand->rate[4 * k] = -trace / left(stage, dimension);
        else
            demand->stress[4 * k] = -left_stress(stage, now, stress, dimension);
    }
}

static void control(scree_simulation *s)
{
    const scree_context context = scree_step_context(s);
    const config *stage = own_config(s);
    progress *now = own_state(s);
    double stress[9];
    s->boundary->stress(&context, stress);
    if (driven(stage) >= 0) turn(s, now, stress);
    scree_demand demand = {.scale = 0};
    for (int k = 0; k < 9; k++) {
        demand.how[k] = SCREE_FULL;
        demand.stress[k] = NAN;
    }
    const double share = share_now(s, now);
    say(stage, scree_stage_elapsed(s), share, &demand);
    keep_condition(stage, now, stress, s->state.dimension, &demand);
    s->boundary->deform(&context, &demand, 1);
    if (driven(stage) >= 0) now->strain += share * rate_of(&s->model, stage) * s->state.step_size;
}

static double strain(const scree_simulation *s)
{
    return own_state(s)->strain;
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    (void)error;
    const config *stage = own_config(s);
    const progress *now = own_state(s);
    double rate = rate_of(&s->model, stage), tick = s->state.tick, elapsed = scree_stage_elapsed(s);
    bool strained = fabs(now->strain) >= stage->strain - SCREE_LOADING_SHORT * rate * tick;
    bool counted = stage->cycles > 0 && now->reversals >= 2 * (uint64_t)stage->cycles;
    bool over = elapsed >= stage->time - 0.5 * tick;
    *done = strained || counted || over;
    if (strained)
        (void)snprintf(s->reason, sizeof s->reason, "strain %.4g reached after %llu reversals", now->strain,
                       (unsigned long long)now->reversals);
    else if (counted)
        (void)snprintf(s->reason, sizeof s->reason, "%lld cycles done", (long long)stage->cycles);
    else if (over)
        (void)snprintf(s->reason, sizeof s->reason, "%.4g s are over", elapsed);
    return SCREE_OK;
}

static double fraction(const scree_simulation *s)
{
    const config *stage = own_config(s);
    double done = NAN, elapsed = scree_stage_elapsed(s);
    if (stage->cycles > 0) done = (double)own_state(s)->reversals / (2 * (double)stage->cycles);
    if (!is_cyclic(stage)) done = fmax(done, fabs(own_state(s)->strain) / stage->strain);
    return fmax(done, elapsed / stage->time);
}

// ---- what is wrong -----------------------------------------------------------------------------------------------

/// Of one component; NULL: nothing.
static const char *wrong_component(const config *stage, const scree_boundary *boundary, int dimension, int c,
                                   const char **key)
{
    const bool rate = has_rate(stage, c), held = !isnan(stage->stress[places[c]]);
    const bool strains = has_table(stage, 0, c), follows = has_table(stage, 1, c),
               any = rate || held || strains || follows;
    const int row = places[c] / 3, column = places[c] % 3;
    *key = rate ? "strain_rate" : held ? "stress" : strains ? keys[2 + c].name : keys[2 + COMPONENTS + c].name;
    if (any && (row >= dimension || column >= dimension)) return "there is no z in two dimensions";
    if (any && c > 2 && !boundary->periodic) return "plates have no shear components: make the sample periodic";
    *key = held ? "stress" : keys[2 + COMPONENTS + c].name;
    if ((held || follows) && rate)
        return "contradicts strain_rate, which drives the same component: it has a rate or a stress, not both";
    if ((held || follows) && strains)
        return "contradicts the table strain_.. of the same component: it has a strain or a stress, not both";
    if (held && follows) return "contradicts the table stress_.. of the same component: give one of the two";
    *key = "strain_rate";
    if (rate && strains) return "contradicts the table strain_.. of the same component: give one of the two";
    return NULL;
}

/// Of `keep`; NULL: nothing.
static const char *wrong_keep(const config *stage, int dimension, const char **key)
{
    *key = "keep";
    if (stage->keep == KEEP_LATERAL_STRAIN) return NULL;
    if (left(stage, dimension) == 0)
        return "contradicts strain_rate and stress, which leave no normal component that could keep it: take one out";
    for (int k = 0; k < dimension; k++)
        if (stage->keep == KEEP_VOLUME && has_stress(stage, k))
            return "constant volume contradicts stress of a normal component, which follows from it: give strain_rate "
                   "to all but one, or keep: p";
    if (stage->keep == KEEP_RATIO &&
        (driven(stage) < 0 || driven(stage) > 2 || left(stage, dimension) != dimension - 1))
        return "q_over_p needs one normal component that strain_rate drives, and nothing said of the others";
    return NULL;
}

/// Of the end and the reversals; NULL: nothing.
static const char *wrong_end(const config *stage, const char **key)
{
    const bool cyclic = is_cyclic(stage);
    *key = isnan(stage->reverse_strain) ? "reverse_stress" : "reverse_strain";
    if (cyclic && driven(stage) < 0) return "no component of strain_rate moves that could be turned";
    *key = "cycles";
    if (stage->cycles > 0 && !cyclic) return "give reverse_strain or reverse_stress, at which the rates are turned";
    *key = "reverse_stress";
    if (!isnan(stage->reverse_stress) && isnan(stage->strain) && isnan(stage->time))
        return "give strain or time, too: a sample that has become too soft never reaches a stress";
    *key = "strain";
    if (!isnan(stage->strain) && driven(stage) < 0) return "no component of strain_rate moves, so it is never reached";
    if (stage->strain > stage->reverse_strain && stage->cycles == 0 && isnan(stage->time))
        return "contradicts reverse_strain, which turns the rates before: give cycles or time";
    *key = "stage";
    if (isnan(stage->strain) && isnan(stage->time) && stage->cycles == 0)
        return "nothing ends it: give strain, cycles or time";
    return NULL;
}

static const char *wrong(const scree_config *whole, int64_t index, const char **key)
{
    const config *stage = whole->stages[index].own;
    const int dimension = (int)whole->dimension;
    const scree_boundary *boundary = scree_config_held_by(whole, index);
    *key = "boundary";
    if (!boundary->deform || !boundary->stress)
        return "load_path needs plates on all sides or a cell that is periodic in all directions: give boundary: "
               "plates, or set boundary.periodic";
    if (!boundary->periodic && whole->boundary.periodic > 0)
        return "load_path needs plates on all sides or a cell that is periodic in all directions";
    for (int c = 0; c < COMPONENTS; c++) {
        const char *message = wrong_component(stage, boundary, dimension, c, key);
        if (message) return message;
    }
    const char *message = wrong_keep(stage, dimension, key);
    return message ? message : wrong_end(stage, key);
}

static const scree_stage stage_face = {.name = "load_path",
                                       .loading = true,
                                       .quasistatic = true,
                                       .strain = strain,
                                       .begin = begin,
                                       .plan = plan,
                                       .control = control,
                                       .finished = finished,
                                       .fraction = fraction,
                                       .duration = duration,
                                       .planned = planned};

static const scree_stage_numbers numbers = {.held = true,
                                            .needs_pressure =
                                                "a confine stage must come before: load_path begins with its pressure",
                                            .strains_all = strains_all,
                                            .rate = rate_of,
                                            .strain = strain_of,
                                            .wrong = wrong};

#define ONE(member, kind, unit, meaning)                                                                               \
    SCREE_FIELD_ONE(load_path, progress, member, "load_path/" #member, kind, 1, unit, meaning,                         \
                    SCREE_RANGE(-DBL_MAX, DBL_MAX))
static const scree_field fields[] = {
    ONE(p, SCREE_FIELD_DOUBLE, "Pa", "mean stress that a load_path stage keeps"),
    ONE(ratio, SCREE_FIELD_DOUBLE, "1", "ratio q / p that it keeps"),
    ONE(strain, SCREE_FIELD_DOUBLE, "1", "strain of its driven component since its begin, in the sense of the rate"),
    ONE(sense, SCREE_FIELD_DOUBLE, "1", "1 or -1: sense of its rates"),
    ONE(from, SCREE_FIELD_DOUBLE, "1", "share of its rates when they were last turned"),
    ONE(turned, SCREE_FIELD_DOUBLE, "s", "time since its begin when that was"),
    SCREE_FIELD_ONE(load_path, progress, reversals, "load_path/reversals", SCREE_FIELD_UINT64, 1, "1",
                    "reversals since its begin"),
};

const scree_module scree_module_load_path = {
    .name = "load_path",
    .meaning =
        "Takes the sample along a path in stress and strain: rates, stresses, tables, cycles; drained, undrained, "
        "K0.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "any path in stress and strain, with cycles")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .numbers = &numbers,
    .stage = &stage_face,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
    .state_size = sizeof(progress),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
};
