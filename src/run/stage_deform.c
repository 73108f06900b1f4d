/// Stage `deform`: imposes any components of the velocity gradient of the sample, reached smoothly within `rise_time`,
/// under the pressure of the stage before; the others are free, in a periodic cell zero or left to a stress (boundary
/// minimal; affine takes all). Components of `velocity_gradient` are prescribed themselves, those of `strain_rate` for
/// the mean of xy and yx.
///
/// Stop rule: the largest prescribed component, as the boundary or the cell has been strained since the begin
/// (logarithmic, sum of increments; of a shear the engineering one), has reached `strain`.
#include "run/stage_deform.h"
#include "measure/imposed_gradient.h"
#include "measure/measure.h"
#include "module/key_rows.h"
#include "run/loading.h"
#include "run/step.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

typedef scree_deform_config config;
static const scree_choice symmetric_components[] = {
    {"xx", 0, "strain rate along x"},
    {"yy", 4, "strain rate along y"},
    {"zz", 8, "strain rate along z"},
    {"xy", 1, "shear rate, mean of xy and yx"},
    {"xz", 2, "shear rate, mean of xz and zx"},
    {"yz", 5, "shear rate, mean of yz and zy"},
    {0},
};
static const scree_choice symmetric_stresses[] = {
    {"xx", 0, "normal stress on x"},
    {"yy", 4, "normal stress on y"},
    {"zz", 8, "normal stress on z"},
    {"xy", 1, "shear stress xy"},
    {"xz", 2, "shear stress xz"},
    {"yz", 5, "shear stress yz"},
    {0},
};
static const scree_key keys[] = {
    TENSOR(config, velocity_gradient, scree_gradient_components, "1/s", FROM("-1e6 1/s"), TO("1e6 1/s"),
           .meaning = "Prescribed components of the velocity gradient, e.g. {xy: 5e-3 1/s, yx: 0}; extension positive; "
                      "the others are free, in a periodic cell zero."),
    TENSOR(config, strain_rate, symmetric_components, "1/s", FROM("-1e6 1/s"), TO("1e6 1/s"),
           .meaning = "Prescribed components of its symmetric part, e.g. {xy: 5e-3 1/s}; rotations stay free."),
    TENSOR(config, stress, symmetric_stresses, "Pa", FROM("-1000 GPa"), TO("1000 GPa"),
           .meaning =
               "Stresses that a periodic cell holds by the same component of its velocity gradient, e.g. {yy: 100 "
               "kPa}; compression positive, shear stress in the sense of the rate."),
    NUMBER(config, strain, "1", ABOVE("0 %"), TO("1000000 %"),
           .meaning = "The stage ends when the largest prescribed component has reached this, measured on the boundary "
                      "or the cell."),
    NUMBER(config, rise_time, "s", .standard = "auto", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time in which the rates are reached; auto: four wave times of the sample."),
};

static const config *own_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

/// What is demanded at full rate. Returns the largest component.
static int find_demand(const config *stage, scree_demand *demand)
{
    int largest = 0;
    *demand = (scree_demand){.scale = 0};
    for (int c = 0; c < 9; c++) {
        bool full = !isnan(stage->velocity_gradient[c]), symmetric = !isnan(stage->strain_rate[c]);
        demand->how[c] = full ? SCREE_FULL : symmetric ? SCREE_SYMMETRIC : SCREE_FREE;
        demand->rate[c] = full ? stage->velocity_gradient[c] : symmetric ? stage->strain_rate[c] : 0;
        demand->stress[c] = c % 4 == 0 ? -stage->stress[c] : stage->stress[c];
        if (fabs(demand->rate[c]) > fabs(demand->rate[largest])) largest = c;
    }
    return largest;
}

static double pressure_of(const void *own)
{
    double largest = NAN;
    for (int k = 0; k < 9; k += 4) largest = fmax(largest, ((const config *)own)->stress[k]);
    return largest;
}

static double rate_of(const scree_model *model, const void *own)
{
    scree_demand demand;
    (void)model;
    return fabs(demand.rate[find_demand(own, &demand)]);
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    (void)error;
    double held = pressure_of(own_config(s));
    scree_loading_begin(s, held > 0 ? held : scree_pressure_now(&s->state));
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    const config *stage = own_config(s);
    s->plan = scree_loading_plan(s, stage->strain / rate_of(&s->model, stage), stage->rise_time);
}

static void control(scree_simulation *s)
{
    const scree_context context = scree_step_context(s);
    scree_demand demand;
    double loaded, rise = scree_loading_rise(s, &loaded);
    (void)find_demand(own_config(s), &demand);
    s->boundary->deform(&context, &demand, rise);
}

/// The component of the stop rule as measured, in the sense of its rate.
static double strain(const scree_simulation *s)
{
    double gradient[9];
    scree_demand demand;
    int c = find_demand(own_config(s), &demand), mirror = 3 * (c % 3) + c / 3;
    scree_strain_measure(&s->state, gradient);
    for (int i = 0; i < 9; i++) gradient[i] -= scree_loading_of(&s->state)->strain[i];
    double reached = demand.how[c] == SCREE_FULL ? gradient[c] : 0.5 * (gradient[c] + gradient[mirror]);
    return copysign(1, demand.rate[c]) * reached;
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    const config *stage = own_config(s);
    return scree_loading_finished(s, "strain", strain(s), stage->strain, rate_of(&s->model, stage), done, error);
}

static double fraction(const scree_simulation *s)
{
    return strain(s) / own_config(s)->strain;
}

/// The largest prescribed component.
static double strain_of(const void *own)
{
    return ((const config *)own)->strain;
}

static double duration(const scree_model *model, const void *own)
{
    return strain_of(own) / rate_of(model, own);
}

static double planned(const scree_model *model, const void *own, double wave)
{
    return scree_loading_planned(duration(model, own), ((const config *)own)->rise_time, wave);
}

static bool is_given(const double tensor[9], int component)
{
    return !isnan(tensor[component]);
}

/// What is wrong with the prescribed components, and under which key; NULL: nothing.
static const char *wrong(const scree_config *whole, int64_t index, const char **key)
{
    const config *stage = whole->stages[index].own;
    const int dimension = (int)whole->dimension;
    const scree_boundary *boundary = scree_config_held_by(whole, index);
    const double *full = stage->velocity_gradient, *symmetric = stage->strain_rate;
    double largest = 0;
    *key = "stage";
    if (!boundary->deform || boundary->walls) // between plates: stage load_path
        return "only a cell that is periodic in all directions can be deformed: set boundary.periodic";
    for (int c = 0; c < 9; c++) {
        int mirror = 3 * (c % 3) + c / 3;
        bool outside = c / 3 >= dimension || c % 3 >= dimension;
        *key = is_given(full, c) ? "velocity_gradient" : "strain_rate";
        if (outside && (is_given(full, c) || is_given(symmetric, c))) return "there is no z in two dimensions";
        if (is_given(symmetric, c) && (is_given(full, c) || is_given(full, mirror)))
            return "a component is prescribed twice, by velocity_gradient and by strain_rate";
        if (boundary->full_mirrors && c != mirror && is_given(full, c) && !is_given(full, mirror))
            return "a rigid rotation would satisfy one component beside the diagonal without any strain: give its "
                   "mirror too (0 for simple shear), or the strain_rate";
        *key = "stress";
        if (is_given(stage->stress, c)) {
            if (!boundary->periodic) return "only a periodic cell can hold stresses: set boundary.periodic";
            if (outside) return "there is no z in two dimensions";
            if (is_given(full, c) || is_given(symmetric, c))
                return "the same component has a rate: give one of the two";
        }
        *key = "velocity_gradient";
        if (boundary->needs_all && !outside && !is_given(full, c)) return boundary->needs_all;
        if (is_given(full, c)) largest = fmax(largest, fabs(full[c]));
        if (is_given(symmetric, c)) largest = fmax(largest, fabs(symmetric[c]));
    }
    *key = "strain";
    return largest > 0 ? NULL : "no component of velocity_gradient or strain_rate moves, so it is never reached";
}

static const scree_stage stage_face = {.name = "deform",
                                       .loading = true,
                                       .strain = strain,
                                       .begin = begin,
                                       .plan = plan,
                                       .control = control,
                                       .finished = finished,
                                       .fraction = fraction,
                                       .quasistatic = true,
                                       .duration = duration,
                                       .planned = planned};

static const scree_stage_numbers numbers = {
    .held = true,
    .needs_pressure = "a confine stage must come before: deform keeps its pressure",
    .pressure = pressure_of,
    .rate = rate_of,
    .strain = strain_of,
    .needs_free = "deform imposes a velocity gradient on the boundary: make the sample periodic, or give boundary: ",
    .wrong = wrong};

const scree_module scree_module_deform = {
    .name = "deform",
    .meaning = "Imposes components of the velocity gradient on the boundary; needs `minimal`, `affine` or a "
               "periodic cell.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "imposes any components of the velocity gradient, to a strain")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .numbers = &numbers,
    .stage = &stage_face,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
};
