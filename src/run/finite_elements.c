/// Finite elements beside the elastic test of a run (fem/solid.h): made from the case, solved when the run has ended,
/// and compared with it.
///
///     bar     the solid in the place of the specimen: as wide as the area that bears the force, as high as the gauge
///             and a particle; the mean density of the specimen; E and nu of the elastic test, or given; on both ends
///             the force of the run over the area, sample by sample. fem-strain.csv: strain over time, of both.
///     discs   the two discs of the run, their material, the largest force of the run. fem-force.csv: force over the
///             approach of the centres, of both and of the closed form (theory/line_contact.h); fem-axis.csv: strain
///             along the line of the centres. What the approach is beyond the mean strain of the discs of the run, over
///             which the force, is the stiffness that a contact of deformable discs must have to be as stiff.
///
/// Source: Madan 2019, 2.9 and 4.4. Where CalculiX is not installed or fails, a line of the log says so and the results
/// are left out. Cost: that of the solve, once, at the end.
#include "base/memory.h"
#include "case/check.h"
#include "comm/comm.h"
#include "contact/deformation.h"
#include "fem/solid.h"
#include "io/file_names.h"
#include "io/run_directory.h"
#include "model/measure_keys.h"
#include "module/key_rows.h"
#include "run/elastic_test.h"
#include "state/body.h"
#include "theory/line_contact.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>

enum { NONE, BAR, DISCS };

typedef struct config {
    int finite_elements;   ///< NONE ...
    double young, poisson; ///< Pa, 1; NAN: auto
    double damping;        ///< s
    int64_t elements, steps;
} config;

static const scree_choice solids[] = {
    {"none", NONE, "no finite elements"},
    {"bar", BAR, "the solid in the place of the specimen of the elastic test, in plane stress"},
    {"discs", DISCS, "the two discs of the elastic test, in contact without friction"},
    {0},
};

#define OWN(member, kind, called, ...)                                                                                 \
    {                                                                                                                  \
        .name = called, .type = kind, .offset = offsetof(config, member), __VA_ARGS__                                  \
    }
static const scree_key keys[] = {
    CHOICE(config, finite_elements, solids, .standard = "none",
           .meaning = "What CalculiX (Debian package calculix-ccx) solves beside the elastic test, to compare with."),
    OWN(young, SCREE_KEY_NUMBER, "fem_young_modulus", .unit = "Pa", .standard = "auto", ABOVE("0 Pa"), TO("1e15 Pa"),
        .when = "finite_elements=bar|discs",
        .meaning = "Of the finite elements; auto: of a bar that of the elastic test, of discs that of the particles."),
    OWN(poisson, SCREE_KEY_NUMBER, "fem_poisson_ratio", .unit = "1", .standard = "auto", ABOVE("-1"), BELOW("0.5"),
        .when = "finite_elements=bar|discs", .meaning = "The same of Poisson's ratio."),
    OWN(damping, SCREE_KEY_NUMBER, "fem_damping", .unit = "s", .standard = "0 s", FROM("0 s"), TO("1e3 s"),
        .when = "finite_elements=bar", .meaning = "Rayleigh's beta: viscosity over stiffness of the bar."),
    OWN(elements, SCREE_KEY_INTEGER, "fem_elements", .standard = "4", FROM("1"), TO("64"),
        .when = "finite_elements=bar|discs",
        .meaning = "Elements over the width of the bar; over half the width of the contact of two discs."),
    OWN(steps, SCREE_KEY_INTEGER, "fem_steps", .standard = "20", FROM("2"), TO("100000"),
        .when = "finite_elements=bar|discs",
        .meaning = "Increments: of time over the stage of the elastic test; of the approach of two discs."),
};

static const config *own_config(const scree_config *whole)
{
    return whole->measure.own ? scree_config_own(&scree_module_finite_elements, "measure", whole->measure.own) : NULL;
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    const config *own = own_config(whole);
    // Below it: a choice that could not be read, of which more has been said.
    if (!own || own->finite_elements <= NONE) return;
    if (whole->dimension == 3)
        scree_rule_refuse(reader, "measure.finite_elements", "none", "finite elements are of plane bodies only");
    if (!scree_elastic_is_asked(whole))
        scree_rule_refuse(reader, "measure.finite_elements", "none",
                          "they are compared with an elastic test: name its gauge by measure.elastic_axial");
    if (own->finite_elements == DISCS && whole->particles.count != 2)
        scree_rule_refuse(reader, "measure.finite_elements", "bar, none",
                          "two discs are wanted, and the case has %lld particles", (long long)whole->particles.count);
}

// ---- numbers -----------------------------------------------------------------------------------------------------

typedef struct numbers {
    config said;       ///< of discs with E and nu
    bool plane_stress; ///< of discs
} numbers;

static scree_status resolve(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_finite_elements, "measure", model->config->measure.own);
    if (!own || own->finite_elements == NONE) return SCREE_OK;
    numbers *n = scree_model_reserve_numbers(model, SCREE_SLOT_finite_elements);
    const scree_plane_condition condition = scree_deformation_condition(model);
    const scree_compliance by = scree_deformation_compliance(model, 0);
    *n = (numbers){*own, condition == SCREE_PLANE_STRESS};
    if (own->finite_elements != DISCS) return SCREE_OK;
    if (isnan(own->young)) n->said.young = scree_compliance_modulus(condition, by);
    if (isnan(own->poisson)) n->said.poisson = scree_compliance_ratio(condition, by);
    if (isfinite(n->said.young) && !isnan(n->said.poisson)) return SCREE_OK;
    return scree_error_refuse(
        error, "measure.finite_elements", NULL,
        "the particles are rigid: say fem_young_modulus and fem_poisson_ratio, or let them deform "
        "(contact.deformation)");
}

// ---- results -----------------------------------------------------------------------------------------------------

static const scree_result results[] = {
    {"fem_young_modulus", "Pa", "of the finite elements"},
    {"fem_poisson_ratio", "1", "of the finite elements"},
    {"fem_density", "kg/m3", "of the bar of finite elements: the mean density of the specimen"},
    {"fem_strain", "1", "axial strain of the bar of finite elements at the end, shortening positive"},
    {"fem_lateral_strain", "1", "its lateral strain, shortening positive"},
    {"fem_strain_ratio", "1", "axial strain of the specimen over that of the bar, at the end"},
    {"fem_strain_difference", "1", "largest difference of the two at any time, over the largest of the bar"},
    {"fem_approach", "m", "what the centres of two discs of finite elements come closer by, at the largest force"},
    {"fem_approach_theory", "m", "the same by the closed form of Hertz's line contact"},
    {"fem_approach_ratio", "1", "approach of the discs of the run over that of the finite elements"},
    {"fem_widening", "m", "what their diameter across becomes longer by"},
    {"fem_widening_theory", "m", "the same by the closed form"},
    {"fem_contact_stiffness", "N/m", "the force over fem_approach less average_approach: k_n that makes up for it"},
    {"fem_force_difference", "1",
     "largest difference of the force at any approach, run and finite elements, over the "
     "largest force"},
    {"average_approach", "m",
     "diameter times mean strain of the discs of the run along the force, shortening positive"},
    {"average_widening", "m", "diameter times their mean strain across it"},
};

/// y at x, linear between rows; x increases. Outside: the end.
static double interpolate(const double *x, const double *y, size_t count, double at)
{
    size_t k = 1;
    while (k + 1 < count && x[k] < at) k++;
    const double part = fmin(1, fmax(0, (at - x[k - 1]) / (x[k] - x[k - 1])));
    return (1 - part) * y[k - 1] + part * y[k];
}

static scree_status open_table(const scree_conclusion *run, const char *name, char path[PATH_MAX], FILE **file,
                               scree_error *error)
{
    scree_status status = scree_path_join(path, PATH_MAX, run->directory, name, error);
    return status ? status : scree_replace_begin(path, file, error);
}

static void set(const scree_conclusion *run, const char *name, double value)
{
    scree_summary_set_number(run->summary, name, value);
}

// ---- the bar -----------------------------------------------------------------------------------------------------

/// The curve of the run from the begin of its stage, with a row of zeros in front.
typedef struct loading {
    double *time, *pressure, *strain; ///< s, Pa, 1
    size_t count;
} loading;

static void loading_destroy(loading *l)
{
    scree_release(&l->time);
    scree_release(&l->pressure);
    scree_release(&l->strain);
}

static scree_status loading_make(const scree_elastic_curves *of, loading *l, scree_error *error)
{
    const size_t rows = of->last - of->first + 1;
    const double begin = of->first > 0 ? of->time[of->first - 1] : 0;
    *l = (loading){.count = 1};
    scree_status status = scree_allocate(&l->time, rows + 1, sizeof(double), error);
    if (!status) status = scree_allocate(&l->pressure, rows + 1, sizeof(double), error);
    if (!status) status = scree_allocate(&l->strain, rows + 1, sizeof(double), error);
    for (size_t k = of->first; k <= of->last && !status; k++) {
        // The first row may stand at the begin itself.
        if (of->time[k] <= begin) continue;
        l->time[l->count] = of->time[k] - begin;
        l->pressure[l->count] = fabs(of->force[k]) / of->area;
        l->strain[l->count++] = of->axial[k];
    }
    if (status) loading_destroy(l);
    return status;
}

static double mean_density(const scree_simulation *s, double volume)
{
    scree_integer_sum mass = {0};
    while (scree_comm_sum_next(&s->state, &mass, 1))
        for (size_t row = 0; row < s->state.count; row++) scree_integer_sum_add(&mass, scree_body_mass(&s->state, row));
    return scree_integer_sum_total(&mass) / volume;
}

static scree_status compare_bar(const scree_conclusion *run, const scree_elastic_curves *of, const loading *l,
                                const scree_fem_bar_result *fem, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    double largest = 0, difference = 0;
    const size_t last = fem->count - 1;
    scree_status status = open_table(run, SCREE_FILE_FEM_STRAIN, path, &file, error);
    if (status) return status;
    fputs("time [s],strain [1],lateral_strain [1],run_strain [1]\n", file);
    for (size_t k = 0; k < fem->count; k++) {
        const double here = interpolate(l->time, l->strain, l->count, fem->time[k]);
        fprintf(file, "%.9g,%.9g,%.9g,%.9g\n", fem->time[k], fem->axial[k], fem->lateral[k], here);
        largest = fmax(largest, fabs(fem->axial[k]));
        difference = fmax(difference, fabs(fem->axial[k] - here));
    }
    set(run, "fem_strain", fem->axial[last]);
    set(run, "fem_lateral_strain", fem->lateral[last]);
    set(run, "fem_strain_ratio", of->axial[of->last] / fem->axial[last]);
    set(run, "fem_strain_difference", difference / largest);
    return scree_replace_finish(path, file, true, error);
}

static scree_status solve_bar(const scree_conclusion *run, const config *own, const scree_elastic_curves *of,
                              scree_error *error)
{
    const scree_model *model = &run->s->model;
    loading l;
    scree_fem_bar_result fem;
    scree_fem_bar bar = {.width = of->area / model->thickness,
                         .height = of->length + 2 * model->mean_radius,
                         .young_modulus = isnan(own->young) ? of->young : own->young,
                         .poisson_ratio = isnan(own->poisson) ? of->poisson : own->poisson,
                         .damping = own->damping,
                         .across = own->elements,
                         .steps = own->steps};
    if (!(bar.young_modulus > 0) || !(fabs(bar.poisson_ratio) < 1)) {
        scree_log_write(run->log, SCREE_LOG_WARNING,
                        "no finite elements: the elastic test has come to no Young's modulus and Poisson's ratio; say "
                        "fem_young_modulus and fem_poisson_ratio");
        return SCREE_OK;
    }
    bar.density = mean_density(run->s, bar.width * bar.height * model->thickness);
    scree_status status = loading_make(of, &l, error);
    if (status) return status;
    bar.time = l.time;
    bar.pressure = l.pressure;
    bar.points = l.count;
    set(run, "fem_young_modulus", bar.young_modulus);
    set(run, "fem_poisson_ratio", bar.poisson_ratio);
    set(run, "fem_density", bar.density);
    status = scree_fem_bar_solve(run->directory, &bar, &fem, error);
    if (!status) status = compare_bar(run, of, &l, &fem, error);
    scree_fem_bar_result_destroy(&fem);
    loading_destroy(&l);
    return status;
}

// ---- two discs ---------------------------------------------------------------------------------------------------

/// Mean strain of the bodies along an axis, extension positive; NAN where they are rigid.
static double mean_strain(const scree_state *state, int axis)
{
    double sum = 0;
    for (size_t row = 0; row < state->count; row++) {
        const double *stretch = scree_stretch_row(state, row);
        sum += stretch ? stretch[axis] / scree_body_bounding_radius(state, row) : NAN;
    }
    return sum / (double)state->count;
}

static scree_status write_axis(const scree_conclusion *run, const scree_line_contact *form,
                               const scree_fem_discs_result *fem, double average, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = open_table(run, SCREE_FILE_FEM_AXIS, path, &file, error);
    if (status) return status;
    fputs("depth [m],strain [1],theory_strain [1],average_strain [1]\n", file);
    for (size_t k = 0; k < fem->axis_count; k++)
        fprintf(file, "%.9g,%.9g,%.9g,%.9g\n", fem->depth[k], fem->strain[k],
                scree_line_contact_strain(form, fem->depth[k]), average);
    return scree_replace_finish(path, file, true, error);
}

/// The largest difference of the forces goes to *difference [N].
static scree_status write_forces(const scree_conclusion *run, const scree_elastic_curves *of, scree_line_contact form,
                                 const scree_fem_discs_result *fem, double *difference, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    const double depth = run->s->model.thickness;
    const size_t rows = of->peak - of->first + 1;
    *difference = 0;
    scree_status status = open_table(run, SCREE_FILE_FEM_FORCE, path, &file, error);
    if (status) return status;
    fputs("approach [m],force [N],theory_approach [m],run_force [N]\n", file);
    for (size_t k = 0; k < fem->count; k++) {
        form.force = fem->force[k];
        // Beyond the largest force the run has nothing to compare.
        const bool reached = fem->approach[k] <= of->shortening[of->peak];
        const double here =
            reached ? fabs(interpolate(of->shortening + of->first, of->force + of->first, rows, fem->approach[k]))
                    : NAN;
        fprintf(file, "%.9g,%.9g,%.9g,%.9g\n", fem->approach[k], fem->force[k] * depth,
                scree_line_contact_approach(&form), here);
        if (reached) *difference = fmax(*difference, fabs(here - fem->force[k] * depth));
    }
    return scree_replace_finish(path, file, true, error);
}

static scree_status compare_discs(const scree_conclusion *run, const scree_elastic_curves *of,
                                  const scree_line_contact *form, const scree_fem_discs_result *fem, scree_error *error)
{
    const scree_state *state = &run->s->state;
    const double force = fabs(of->force[of->peak]), along = mean_strain(state, of->along),
                 average = -2 * form->radius * along;
    double difference;
    set(run, "fem_young_modulus", form->young_modulus);
    set(run, "fem_poisson_ratio", form->poisson_ratio);
    set(run, "fem_approach", fem->at_force);
    set(run, "fem_approach_theory", scree_line_contact_approach(form));
    set(run, "fem_approach_ratio", of->shortening[of->peak] / fem->at_force);
    set(run, "fem_widening", fem->widening);
    set(run, "fem_widening_theory", scree_line_contact_widening(form));
    set(run, "average_approach", average);
    set(run, "average_widening", 2 * form->radius * mean_strain(state, 1 - of->along));
    set(run, "fem_contact_stiffness", force / (fem->at_force - average));
    scree_status status = write_forces(run, of, *form, fem, &difference, error);
    if (!status) status = write_axis(run, form, fem, along, error);
    set(run, "fem_force_difference", difference / force);
    return status;
}

static scree_status solve_discs(const scree_conclusion *run, const numbers *n, const scree_elastic_curves *of,
                                scree_error *error)
{
    const scree_state *state = &run->s->state;
    const scree_model *model = &run->s->model;
    scree_fem_discs_result fem;
    const double radius = scree_body_bounding_radius(state, 0);
    const scree_line_contact form = {.radius = radius,
                                     .young_modulus = n->said.young,
                                     .poisson_ratio = n->said.poisson,
                                     .plane_stress = n->plane_stress,
                                     .force = fabs(of->force[of->peak]) / model->thickness};
    const scree_fem_discs discs = {.radius = radius,
                                   .young_modulus = n->said.young,
                                   .poisson_ratio = n->said.poisson,
                                   .plane_stress = n->plane_stress,
                                   .force = form.force,
                                   .elements = n->said.elements,
                                   .steps = n->said.steps};
    if (state->count != 2 || scree_body_bounding_radius(state, 1) != radius) {
        scree_log_write(run->log, SCREE_LOG_WARNING, "no finite elements: they are of two equal discs");
        return SCREE_OK;
    }
    scree_status status = scree_fem_discs_solve(run->directory, &discs, &fem, error);
    if (!status) status = compare_discs(run, of, &form, &fem, error);
    scree_fem_discs_result_destroy(&fem);
    return status;
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const numbers *n = scree_model_numbers(&run->s->model, SCREE_SLOT_finite_elements);
    scree_elastic_curves of;
    scree_error problem = {0};
    (void)error;
    // Of a run that has not come to its end the curves are not whole.
    if (!n || run->s->state.stage.index < run->s->model.stage_count || !scree_elastic_find(run, &of)) return SCREE_OK;
    if (!scree_fem_is_there()) {
        scree_log_write(run->log, SCREE_LOG_WARNING,
                        "no finite elements: ccx is not installed (Debian package " SCREE_FEM_PACKAGE ")");
        return SCREE_OK;
    }
    const scree_status status =
        n->said.finite_elements == BAR ? solve_bar(run, &n->said, &of, &problem) : solve_discs(run, n, &of, &problem);
    if (status) scree_log_write(run->log, SCREE_LOG_WARNING, "no finite elements: %s", problem.message);
    return SCREE_OK;
}

const scree_module scree_module_finite_elements = {
    .name = "finite_elements",
    .meaning = "finite elements beside the elastic test",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(numbers),
    .resolve = resolve,
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
