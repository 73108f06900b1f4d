/// Limits of explicit schemes for the specimen of a simulation, for programs.
#include "specimen/stability.h"
#include "contact/deformation.h"
#include "library/handle.h"
#include "library/specimen.h"
#include "model/critical_step.h"
#include "theory/lattice.h"

#include <string.h>

static double mean_normal_stiffness(const scree_specimen *s)
{
    double sum = 0;
    for (size_t c = 0; c < s->contact_count; c++) sum += s->contact[c].stiffness.normal;
    return s->contact_count > 0 ? sum / (double)s->contact_count : (double)NAN;
}

/// Young's modulus of the particles that deform [Pa], mean by number.
static double mean_modulus(const scree_specimen *s)
{
    double sum = 0, count = 0;
    for (size_t body = 0; body < s->body_count; body++) {
        if (!(s->compliance[body].shear > 0)) continue;
        sum += scree_compliance_modulus(s->condition, s->compliance[body]);
        count++;
    }
    return sum / count;
}

/// Without dashpots, which are put aside for it.
static scree_status undamped_step(scree_specimen *s, double damped, double *step, scree_error *error)
{
    scree_specimen bare = *s;
    bare.contact = NULL;
    *step = damped;
    if (!scree_specimen_is_damped(s)) return SCREE_OK;
    scree_status status = scree_allocate(&bare.contact, s->contact_count, sizeof *bare.contact, error);
    if (status) return status;
    memcpy(bare.contact, s->contact, s->contact_count * sizeof *bare.contact);
    for (size_t c = 0; c < s->contact_count; c++) bare.contact[c].damping = (scree_springs){0, 0};
    status = scree_critical_step(&bare, scree_strain_rigid(), step, NULL, error);
    scree_release(&bare.contact);
    return status;
}

/// Limits of unbounded lattices of the mean particle, of this modulus and compliance.
static void compare_lattices(const scree_model *model, double young, scree_compliance by, scree_stability *out)
{
    const bool solid = model->dimension == 3;
    const scree_lattice_material unit = {.radius = model->mean_radius,
                                         .length = model->thickness,
                                         .normal = 1,
                                         .shear = young * by.shear,
                                         .trace = young * by.trace};
    out->row_ratio = 1 / scree_row_radius(model->dimension, &unit);
    out->square_ratio = 1 / scree_lattice_radius(solid ? SCREE_LATTICE_SIMPLE_CUBIC : SCREE_LATTICE_SQUARE, &unit);
    out->hexagonal_ratio =
        1 / scree_lattice_radius(solid ? SCREE_LATTICE_FACE_CENTRED : SCREE_LATTICE_HEXAGONAL, &unit);
}

static scree_status deformable_limits(const scree_specimen *s, scree_stability *out, scree_error *error)
{
    scree_status status = scree_spectral_radius(s, &out->spectral_radius, NULL, error);
    out->relaxation = scree_relaxation(out->spectral_radius);
    if (!status)
        status = scree_critical_step(s, scree_strain_explicit(out->spectral_radius), &out->explicit_step, NULL, error);
    if (!status)
        status = scree_critical_step(s, scree_strain_relaxed(out->relaxation, out->spectral_radius), &out->relaxed_step,
                                     NULL, error);
    if (!status)
        status = scree_critical_step(s, scree_strain_implicit(out->spectral_radius), &out->implicit_step, NULL, error);
    return status;
}

static scree_status find_limits(const scree_simulation *simulation, scree_specimen *s, scree_stability *out,
                                scree_error *error)
{
    scree_status status = scree_critical_step(s, scree_strain_rigid(), &out->critical_step, NULL, error);
    if (!status) status = undamped_step(s, out->critical_step, &out->critical_step_undamped, error);
    if (!status) status = scree_step_of_bodies(s, &out->step_of_bodies, error);
    out->step_of_extremes = scree_step_of_extremes(s);
    if (status || !scree_specimen_is_deformable(s)) return status;
    status = deformable_limits(s, out, error);
    const double young = mean_modulus(s);
    out->stiffness_ratio = scree_stiffness_ratio(s);
    out->largest_ratio = out->stiffness_ratio / out->spectral_radius;
    double softness = NAN;
    if (!status)
        status = scree_stability_softness(s, scree_strain_explicit(out->spectral_radius), out->step, &softness, error);
    out->ratio_at_step = out->stiffness_ratio * softness;
    compare_lattices(&simulation->model, young, s->compliance[0], out);
    return status;
}

static scree_stability nothing_known(const scree_simulation *s)
{
    return (scree_stability){.has_potential = true,
                             .step = s->model.step * (double)s->model.largest_step,
                             .spectral_radius = NAN,
                             .stiffness_ratio = NAN,
                             .largest_ratio = NAN,
                             .ratio_at_step = NAN,
                             .row_ratio = NAN,
                             .square_ratio = NAN,
                             .hexagonal_ratio = NAN,
                             .explicit_step = NAN,
                             .relaxed_step = NAN,
                             .implicit_step = NAN,
                             .relaxation = NAN};
}

scree_status scree_simulation_stability(scree_simulation *s, const scree_particle_elasticity *elasticity,
                                        scree_stability *out, scree_error *error)
{
    scree_specimen specimen;
    scree_status status = library_specimen(s, elasticity, &specimen, error);
    *out = nothing_known(s);
    out->bodies = specimen.body_count;
    out->contacts = specimen.contact_count;
    if (status) return status;
    out->normal_stiffness = mean_normal_stiffness(&specimen);
    out->has_potential = scree_specimen_has_potential(&specimen);
    status = find_limits(s, &specimen, out, error);
    scree_specimen_destroy(&specimen);
    return status;
}

// ---- before a run ------------------------------------------------------------------------------------------------

/// Whether the specimen stands before the first step.
static scree_limits_known what_is_known(const scree_simulation *s)
{
    int64_t first = s->model.stage_count, bonds = -1;
    for (int64_t k = s->model.stage_count - 1; k >= 0; k--) {
        const scree_module *kind = scree_modules[s->model.stages[k].kind];
        if (!kind->stage->instant) first = k;
        if (kind->numbers->bonds && bonds < 0) bonds = k;
    }
    if (bonds < 0 && !scree_model_traits(&s->model)->deforms) return SCREE_LIMITS_NONE;
    return bonds > first ? SCREE_LIMITS_LATER : SCREE_LIMITS_EXACT;
}

/// What lattices of the mean particle bear.
static void expect(const scree_simulation *s, scree_stability *out)
{
    const scree_model *model = &s->model;
    const double radius = model->mean_radius;
    const scree_compliance by = scree_deformation_compliance(model, 0);
    const scree_contact_tangent t = scree_contact_linearise(&model->laws[0], &model->pairs[0][0], 0.5 * radius,
                                                            0.5 * scree_model_mass(model, 0, radius), 0);
    *out = nothing_known(s);
    out->normal_stiffness = t.normal_stiffness;
    if (!(by.shear > 0)) return;
    const double young = scree_compliance_modulus(scree_deformation_condition(model), by);
    out->stiffness_ratio = t.normal_stiffness / young;
    compare_lattices(model, young, by, out);
}

scree_status scree_case_limits(const scree_case *c, scree_limits_known *known, scree_stability *out, scree_error *error)
{
    scree_simulation *s;
    *known = SCREE_LIMITS_NONE;
    scree_status status = scree_simulation_create(c, 1, &s, error);
    if (status) return status;
    *known = what_is_known(s);
    *out = nothing_known(s);
    if (*known == SCREE_LIMITS_EXACT) {
        status = scree_simulation_begin_stage(s, NULL, error);
        if (!status) status = scree_simulation_stability(s, NULL, out, error);
        // Bodies that do not touch yet are no specimen.
        if (!status && out->contacts == 0) *known = SCREE_LIMITS_LATER;
    }
    if (!status && *known == SCREE_LIMITS_LATER) expect(s, out);
    scree_simulation_free(s);
    return status;
}
