/// Elastic constants of an axial test, from the series of a run: two gauges, and a load of which the force is known.
///
///     E = d(stress) / d(axial strain)      M 4.19, 4.20      stress = |force of the load along the gauge| / area [Pa]
///     nu = -d(lateral strain) / d(axial strain)              M 4.22
///
/// both as differences between the instants at which the force has come to two fractions of its largest magnitude (M:
/// 0.4 and 0.8), linear between two samples. Rows are those of the stage with the largest force, up to it. Besides half
/// the force times the shortening of the gauge at the end of the stage: where the gauge is between the centres of the
/// loaded particles that is M's W_ext (4.29). What the force does on the way from the centre to the surface of a
/// particle that deforms is missing there (docs/theory/ddem.md).
///
/// Results are left out where the test has no such range. Cost: a pass over the series.
#include "run/elastic_test.h"

#include "case/check.h"
#include "contact/deformation.h"
#include "load/prescribed.h"
#include "measure/gauges.h"
#include "model/critical_step.h"
#include "module/key_rows.h"
#include "theory/lattice.h"

#include <math.h>
#include <string.h>

typedef struct config {
    char *axial, *lateral; ///< names of gauges
    char *load;            ///< name of a load
    double area;           ///< m2
    double from, to;       ///< 1, of the largest force
    int theory;            ///< scree_lattice, or NO_LATTICE
} config;

enum { NO_LATTICE = -1 };
static const scree_choice lattices[] = {
    {"none", NO_LATTICE, "no closed form"},
    {"square", SCREE_LATTICE_SQUARE, "the unbounded square lattice of the mean disc, along its axis (M 4.26, 4.27)"},
    {"hexagonal", SCREE_LATTICE_HEXAGONAL, "the unbounded hexagonal lattice of the mean disc"},
    {"simple_cubic", SCREE_LATTICE_SIMPLE_CUBIC, "the simple cubic lattice of the mean sphere, along its axis"},
    {0},
};

#define OWN(member, kind, called, ...)                                                                                 \
    {                                                                                                                  \
        .name = called, .type = kind, .offset = offsetof(config, member), __VA_ARGS__                                  \
    }
static const scree_key keys[] = {
    OWN(axial, SCREE_KEY_WORD, "elastic_axial", .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Gauge along the load of an elastic test; auto: there is none."),
    OWN(lateral, SCREE_KEY_WORD, "elastic_lateral", .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Gauge across it, for Poisson's ratio; auto: none."),
    OWN(load, SCREE_KEY_WORD, "elastic_load", .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of the load `prescribed` whose force it is."),
    OWN(area, SCREE_KEY_NUMBER, "elastic_area", .unit = "m2", .standard = "auto", ABOVE("0 m2"), TO("1e9 m2"),
        .meaning = "Cross-section that bears the force."),
    OWN(from, SCREE_KEY_NUMBER, "elastic_from", .unit = "1", .standard = "40 %", FROM("0 %"), BELOW("100 %"),
        .meaning = "Share of the largest force at which the linear range begins."),
    OWN(to, SCREE_KEY_NUMBER, "elastic_to", .unit = "1", .standard = "80 %", ABOVE("0 %"), TO("100 %"),
        .meaning = "Share of the largest force at which it ends."),
    OWN(theory, SCREE_KEY_CHOICE, "elastic_theory", .choices = lattices, .standard = "none",
        .meaning = "Lattice whose closed form is told beside the results of the elastic test."),
};

static const config *own_config(const scree_config *whole)
{
    return whole->measure.own ? scree_config_own(&scree_module_elastic_test, "measure", whole->measure.own) : NULL;
}

// ---- rules -------------------------------------------------------------------------------------------------------

static void check_gauge(scree_reader *reader, const scree_config *whole, const char *path, const char *name)
{
    const char *names[SCREE_GAUGES];
    int64_t count;
    const scree_gauge *list = scree_gauges_of(whole, &count);
    if (!name || scree_gauge_find(whole, name) >= 0) return;
    for (int64_t k = 0; k < count; k++) names[k] = list[k].name ? list[k].name : "";
    scree_rule_refuse_name(reader, path, "gauge", name, names, (size_t)count);
}

static void check_load(scree_reader *reader, const scree_config *whole, const char *name)
{
    const char *names[SCREE_LOADS];
    size_t count = 0;
    for (int64_t k = 0; k < whole->load_count && count < SCREE_LOADS; k++) {
        const scree_prescribed_config *load = scree_prescribed_config_of(whole->loads, k);
        if (!load || !scree_prescribed_name(load)) continue;
        names[count] = scree_prescribed_name(load);
        if (strcmp(names[count++], name) == 0) return;
    }
    scree_rule_refuse_name(reader, "measure.elastic_load", "load", name, names, count);
}

/// Keys that would have no effect, and those that are missing.
static void rules(scree_reader *reader, const scree_config *whole)
{
    const config *own = own_config(whole);
    // Of a section that could not be read more has been said.
    if (!own || !(own->to > 0)) return;
    check_gauge(reader, whole, "measure.elastic_axial", own->axial);
    check_gauge(reader, whole, "measure.elastic_lateral", own->lateral);
    if (own->load) check_load(reader, whole, own->load);
    if (!own->axial && (own->lateral || own->load || !isnan(own->area)))
        scree_rule_refuse(reader,
                          own->lateral ? "measure.elastic_lateral"
                          : own->load  ? "measure.elastic_load"
                                       : "measure.elastic_area",
                          "auto", "not used without elastic_axial, the gauge along the load");
    if (own->theory != NO_LATTICE && !own->axial)
        scree_rule_refuse(reader, "measure.elastic_theory", "none", "not used without elastic_axial");
    if (own->theory > NO_LATTICE && whole->dimension != scree_lattice_dimension((scree_lattice)own->theory))
        scree_rule_refuse(reader, "measure.elastic_theory", NULL, "this lattice has %d dimensions",
                          scree_lattice_dimension((scree_lattice)own->theory));
    if (own->axial && !own->load)
        scree_rule_refuse(reader, "measure.elastic_load", NULL,
                          "elastic_axial needs the load whose force it goes with");
    if (own->axial && isnan(own->area))
        scree_rule_refuse(reader, "measure.elastic_area", NULL, "elastic_axial needs the area that bears the force");
    if (own->from >= own->to)
        scree_rule_refuse(reader, "measure.elastic_to", NULL, "the linear range ends before it begins, at %g %%",
                          100 * own->from);
}

// ---- numbers -----------------------------------------------------------------------------------------------------

typedef struct numbers {
    config said;
    int along;             ///< axis of the gauge along the load
    double young, poisson; ///< Pa, 1: of the lattice
    double rigid;          ///< Pa, Young's modulus of the lattice of rigid particles
    double ratio;          ///< m, k_n / E of the particles
} numbers;

/// The mean particle, and its contact with another one at rest.
static void find_theory(const scree_model *model, numbers *n)
{
    const double radius = model->mean_radius;
    const scree_contact_tangent t = scree_contact_linearise(&model->laws[0], &model->pairs[0][0], 0.5 * radius,
                                                            0.5 * scree_model_mass(model, 0, radius), 0);
    const scree_compliance by = scree_deformation_compliance(model, 0);
    scree_lattice_material m = {.radius = radius,
                                .length = model->thickness,
                                .normal = t.normal_stiffness,
                                .tangential = t.tangential_stiffness,
                                .corrected = model->laws[0].number[SCREE_LAW_CORRECTED] > 0};
    double none;
    scree_lattice_axial((scree_lattice)n->said.theory, &m, &n->rigid, &none);
    m.shear = by.shear;
    m.trace = by.trace;
    scree_lattice_axial((scree_lattice)n->said.theory, &m, &n->young, &n->poisson);
    n->ratio = t.normal_stiffness / scree_compliance_modulus(scree_deformation_condition(model), by);
}

static scree_status resolve(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_elastic_test, "measure", model->config->measure.own);
    (void)error;
    if (!own || !own->axial) return SCREE_OK;
    numbers *n = scree_model_reserve_numbers(model, SCREE_SLOT_elastic_test);
    n->said = *own;
    n->along = scree_gauge_axis(model, own->axial);
    if (own->theory != NO_LATTICE) find_theory(model, n);
    return SCREE_OK;
}

// ---- results -----------------------------------------------------------------------------------------------------

static const double *column(const scree_series *all, const char *name, const char *ending)
{
    char text[SCREE_RESULT_NAME];
    (void)snprintf(text, sizeof text, "%s%s", name, ending);
    return scree_series_get(all, text);
}

/// Row, and part of the way to the next one, at which the force comes to `value` the last time before its peak; NAN: it
/// begins above.
static double place_of(const scree_elastic_curves *s, double value)
{
    for (size_t k = s->peak; k > s->first; k--) {
        const double before = fabs(s->force[k - 1]), after = fabs(s->force[k]);
        if (before <= value && value <= after && after > before)
            return (double)(k - 1) + (value - before) / (after - before);
    }
    return NAN;
}

static double at(const double *value, double place)
{
    const size_t row = (size_t)place;
    const double part = place - (double)row;
    return part > 0 ? value[row] + part * (value[row + 1] - value[row]) : value[row];
}

static void find_constants(const numbers *n, scree_elastic_curves *s)
{
    const config *own = &n->said;
    const double most = fabs(s->force[s->peak]), from = place_of(s, own->from * most), to = place_of(s, own->to * most);
    s->young = s->poisson = NAN;
    if (isnan(from) || isnan(to)) return;
    const double axial = at(s->axial, to) - at(s->axial, from), stress = (own->to - own->from) * most / own->area;
    s->young = stress / axial;
    if (s->lateral) s->poisson = -(at(s->lateral, to) - at(s->lateral, from)) / axial;
}

/// Length of a gauge when the stage began.
static double length_of(const scree_series *all, const char *gauge, size_t row)
{
    const double *length = gauge ? column(all, gauge, "_length") : NULL,
                 *shortening = gauge ? column(all, gauge, "_shortening") : NULL;
    return length && shortening ? length[row] + shortening[row] : NAN;
}

bool scree_elastic_find(const scree_conclusion *run, scree_elastic_curves *s)
{
    static const char *const forces[] = {"_exerted_force_x", "_exerted_force_y", "_exerted_force_z"};
    const numbers *n = scree_model_numbers(&run->s->model, SCREE_SLOT_elastic_test);
    if (!n) return false;
    const config *own = &n->said;
    const double *stage = scree_series_get(run->series, "stage");
    *s = (scree_elastic_curves){.time = scree_series_get(run->series, "time"),
                                .force = column(run->series, own->load, forces[n->along]),
                                .axial = column(run->series, own->axial, "_strain"),
                                .lateral = own->lateral ? column(run->series, own->lateral, "_strain") : NULL,
                                .shortening = column(run->series, own->axial, "_shortening"),
                                .area = own->area,
                                .along = n->along};
    if (!stage || !s->time || !s->force || !s->axial || !s->shortening) return false;
    for (size_t k = 0; k < run->series->row_count; k++)
        if (fabs(s->force[k]) > fabs(s->force[s->peak])) s->peak = k;
    for (s->first = s->peak; s->first > 0 && stage[s->first - 1] == stage[s->peak];) s->first--;
    for (s->last = s->peak; s->last + 1 < run->series->row_count && stage[s->last + 1] == stage[s->peak];) s->last++;
    if (s->peak == s->first || !(fabs(s->force[s->peak]) > 0)) return false;
    s->length = length_of(run->series, own->axial, s->last);
    s->width = length_of(run->series, own->lateral, s->last);
    find_constants(n, s);
    return true;
}

bool scree_elastic_is_asked(const scree_config *whole)
{
    const config *own = own_config(whole);
    return own && own->axial;
}

static const scree_result results[] = {
    {"axial_young_modulus", "Pa", "of the elastic test, between two shares of the largest force"},
    {"axial_poisson_ratio", "1", "of the elastic test, between two shares of the largest force"},
    {"axial_young_modulus_theory", "Pa", "closed form of the lattice that the elastic test names"},
    {"axial_poisson_ratio_theory", "1", "closed form of the lattice that the elastic test names"},
    {"axial_modulus_ratio", "1", "axial_young_modulus over that of the lattice of rigid particles"},
    {"axial_modulus_ratio_theory", "1", "axial_young_modulus_theory over that of the lattice of rigid particles"},
    {"stiffness_ratio", "m", "k_n / E of the particles, of the elastic test"},
    {"centre_work", "J", "half the force of the elastic test times the shortening of its gauge, at the end"},
};

static void tell_theory(const numbers *n, double young, scree_summary *summary)
{
    scree_summary_set_number(summary, "axial_young_modulus_theory", n->young);
    scree_summary_set_number(summary, "axial_poisson_ratio_theory", n->poisson);
    scree_summary_set_number(summary, "axial_modulus_ratio", young / n->rigid);
    scree_summary_set_number(summary, "axial_modulus_ratio_theory", n->young / n->rigid);
    scree_summary_set_number(summary, "stiffness_ratio", n->ratio);
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const numbers *n = scree_model_numbers(&run->s->model, SCREE_SLOT_elastic_test);
    scree_elastic_curves s;
    (void)error;
    if (!scree_elastic_find(run, &s)) return SCREE_OK;
    scree_summary_set_number(run->summary, "centre_work", 0.5 * fabs(s.force[s.last]) * s.shortening[s.last]);
    if (isnan(s.young)) return SCREE_OK;
    scree_summary_set_number(run->summary, "axial_young_modulus", s.young);
    if (n->said.theory != NO_LATTICE) tell_theory(n, s.young, run->summary);
    if (s.lateral) scree_summary_set_number(run->summary, "axial_poisson_ratio", s.poisson);
    return SCREE_OK;
}

const scree_module scree_module_elastic_test = {
    .name = "elastic_test",
    .meaning = "Young's modulus and Poisson's ratio from an axial test",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(numbers),
    .resolve = resolve,
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
