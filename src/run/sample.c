/// The columns of series.csv and how each comes from the measures. Of a part all processes take the sample together,
/// each with its bodies and the contacts that it evaluates; all have the same row, to the bit that of one process.
#include "run/sample.h"
#include "measure/delaunay_boundary.h"

#include "measure/facets.h"
#include "measure/measure.h"
#include "run/columns.h"
#include "run/guard.h"
#include "run/loading.h"
#include "run/quasistatic.h"
#include "run/step.h"
#include "state/periodic.h"

#include <math.h>

static void sample_strain(const scree_simulation *s, double *value)
{
    const double *begin = scree_loading_of(&s->state)->strain;
    double gradient[9];
    scree_strain_measure(&s->state, gradient);
    bool loading = s->stage->loading;
    value[SCREE_SAMPLE_AXIAL_STRAIN] = scree_loading_strain(s);
    int axial = s->state.dimension - 1;
    double strain[3] = {0}, volumetric = 0;
    double shear = gradient[axial] + gradient[3 * axial] - begin[axial] - begin[3 * axial];
    for (int k = 0; k <= axial; k++) volumetric += strain[k] = loading ? begin[4 * k] - gradient[4 * k] : NAN;
    value[SCREE_SAMPLE_SHEAR_STRAIN] = loading ? shear : NAN;
    value[SCREE_SAMPLE_BOUNDARY_AXIAL] = strain[axial];
    value[SCREE_SAMPLE_BOUNDARY_LATERAL] = (volumetric - strain[axial]) / axial;
    value[SCREE_SAMPLE_BOUNDARY_LATERAL_Y] = axial == 2 ? strain[1] : NAN;
    value[SCREE_SAMPLE_VOLUMETRIC_STRAIN] = volumetric;
}

/// Volumetric strains that do not depend on the path of the boundary; the first sample of the stage is their zero.
static void sample_volume(scree_simulation *s, double *value)
{
    scree_loading *begin = scree_loading_of(&s->state);
    double enclosed = scree_enclosed_logarithm(&s->state);
    double redetected = scree_strain_of(&s->state)->redetected, solid = value[SCREE_SAMPLE_SOLID_FRACTION];
    value[SCREE_SAMPLE_VOLUMETRIC_REDETECTED] = value[SCREE_SAMPLE_VOLUMETRIC_ENCLOSED] =
        value[SCREE_SAMPLE_VOLUMETRIC_SOLID] = NAN;
    if (!s->stage->loading) return;
    if (s->state.step == s->state.stage.first_step) {
        begin->enclosed = enclosed;
        begin->redetected = redetected;
        begin->solid = solid;
    }
    value[SCREE_SAMPLE_VOLUMETRIC_REDETECTED] = begin->redetected - redetected;
    value[SCREE_SAMPLE_VOLUMETRIC_ENCLOSED] = begin->enclosed - enclosed;
    value[SCREE_SAMPLE_VOLUMETRIC_SOLID] = log(solid / begin->solid);
}

/// Normal stress across the sides: in 3D the mean of both directions.
static double lateral_of(const scree_simulation *s, const double stress[9])
{
    return s->state.dimension == 3 ? 0.5 * (stress[0] + stress[4]) : stress[0];
}

static void sample_stress(const scree_simulation *s, double *value)
{
    const scree_model *model = &s->stage_model;
    double volume = scree_sample_volume(model, &s->state), plates[9], contacts[9];
    int axial = 4 * (s->state.dimension - 1), shear = s->state.dimension - 1;
    scree_stress_from_plates(model, &s->state, plates);
    scree_stress_from_contacts(&s->state, &s->table, volume, contacts);
    value[SCREE_SAMPLE_VOLUME] = volume;
    value[SCREE_SAMPLE_AREA] = s->state.dimension == 3 ? volume / scree_sample_height(s) : scree_sample_area(&s->state);
    value[SCREE_SAMPLE_AXIAL_PLATES] = -plates[axial];
    value[SCREE_SAMPLE_LATERAL_APPLIED] = -lateral_of(s, plates);
    value[SCREE_SAMPLE_STRESS_RATIO] = plates[axial] / lateral_of(s, plates);
    value[SCREE_SAMPLE_AXIAL_CONTACTS] = -contacts[axial];
    value[SCREE_SAMPLE_LATERAL_CONTACTS] = -lateral_of(s, contacts);
    value[SCREE_SAMPLE_SHEAR_CONTACTS] = 0.5 * (contacts[shear] + contacts[3 * shear]);
    value[SCREE_SAMPLE_STRESS_RATIO_CONTACTS] = contacts[axial] / lateral_of(s, contacts);
    if (scree_periodic_is_whole(&s->state))
        value[SCREE_SAMPLE_SHEAR_RATIO] = value[SCREE_SAMPLE_SHEAR_CONTACTS] / value[SCREE_SAMPLE_AXIAL_CONTACTS];
}

static scree_status sample_structure(const scree_simulation *s, double *value, scree_error *error)
{
    double slip, sliding;
    scree_slip_measure(&s->state, &s->table, &slip, &sliding);
    scree_coordination coordination;
    scree_status status =
        scree_coordination_measure(&s->stage_model, &s->state, &s->work, &s->table, &coordination, error);
    if (status) return status;
    value[SCREE_SAMPLE_SLIP_RATIO] = slip / s->model.reference_velocity;
    value[SCREE_SAMPLE_SLIDING_FRACTION] = sliding;
    value[SCREE_SAMPLE_COORDINATION] = coordination.mean;
    value[SCREE_SAMPLE_COORDINATION_WITHOUT_RATTLERS] = coordination.mean_without_rattlers;
    value[SCREE_SAMPLE_RATTLER_FRACTION] = coordination.rattler_fraction;
    if ((status = scree_solid_fraction(&s->state, &value[SCREE_SAMPLE_SOLID_FRACTION], error))) return status;
    value[SCREE_SAMPLE_UNBALANCED_RATIO] = scree_mean_unbalanced_ratio(&s->stage_model, &s->state, &s->table);
    value[SCREE_SAMPLE_HEIGHT] = scree_sample_height(s);
    return SCREE_OK;
}

static void sample_energy(const scree_simulation *s, double *value)
{
    const scree_ledger *ledger = &s->state.ledger;
    scree_energy energy;
    scree_energy_measure(&s->stage_model, &s->state, &s->table, &energy);
    value[SCREE_SAMPLE_KINETIC] = energy.kinetic + energy.kinetic_rotation;
    value[SCREE_SAMPLE_ELASTIC_NORMAL] = energy.elastic_normal;
    value[SCREE_SAMPLE_ELASTIC_TANGENTIAL] = energy.elastic_tangential;
    value[SCREE_SAMPLE_DISSIPATED_DAMPING] = ledger->damping;
    value[SCREE_SAMPLE_DISSIPATED_FRICTION] = ledger->friction;
    value[SCREE_SAMPLE_STIFFNESS_WORK] = ledger->stiffness;
    value[SCREE_SAMPLE_WORK_PLATES] = ledger->plates;
    value[SCREE_SAMPLE_WORK_PRESSURE] = ledger->pressure;
    value[SCREE_SAMPLE_WORK_PERIODIC] = ledger->periodic;
    value[SCREE_SAMPLE_WORK_BOUNDARY] = ledger->boundary;
    value[SCREE_SAMPLE_WORK_GRAVITY] = energy.gravity;
    value[SCREE_SAMPLE_SCHEME_WORK] = ledger->scheme;
    value[SCREE_SAMPLE_ENERGY_RESIDUAL] = energy.residual;
    value[SCREE_SAMPLE_ENERGY_RESIDUAL_RELATIVE] = energy.relative;
}

/// Numbers of a quasistatic loading (theory/quasistatic.c).
static void sample_quasistatic(const scree_simulation *s, double *value)
{
    double lateral = value[SCREE_SAMPLE_LATERAL_CONTACTS], axial = value[SCREE_SAMPLE_AXIAL_CONTACTS];
    double sides = (double)(s->state.dimension - 1);
    double elastic = value[SCREE_SAMPLE_ELASTIC_NORMAL] + value[SCREE_SAMPLE_ELASTIC_TANGENTIAL];
    value[SCREE_SAMPLE_INERTIAL_NUMBER] = scree_quasistatic_inertial_now(s, (sides * lateral + axial) / (sides + 1));
    value[SCREE_SAMPLE_KINETIC_OVER_ELASTIC] = elastic > 0 ? value[SCREE_SAMPLE_KINETIC] / elastic : NAN;
}

/// From here on the mean unbalanced force of the next sample counts.
static void remember_velocities(scree_simulation *s)
{
    scree_state *state = &s->state;
    scree_vector spin;
    for (size_t row = 0; row < state->count; row++)
        scree_body_velocity(&s->stage_model, state, row, state->sampled_velocity[row], spin);
    state->sampled_step = state->step;
}

scree_status scree_sample_take(scree_simulation *s, scree_error *error)
{
    scree_status status = scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, error);
    if (status) return status;
    double *value = s->sample;
    const scree_context context = scree_step_context(s);
    value[SCREE_SAMPLE_STEP] = (double)s->state.step;
    value[SCREE_SAMPLE_TIME] = scree_state_time(&s->state);
    value[SCREE_SAMPLE_STAGE] = (double)s->state.stage.index;
    sample_strain(s, value);
    sample_stress(s, value);
    if ((status = sample_structure(s, value, error))) return status;
    sample_volume(s, value);
    sample_energy(s, value);
    sample_quasistatic(s, value);
    status = scree_columns_measure(&s->columns, &context, true, value, error);
    // Those of a part that need the whole have been measured before.
    if (!status && !s->state.part) status = scree_columns_measure(&s->columns, &context, false, value, error);
    if (status) return status;
    remember_velocities(s);
    s->has_sample = true;
    return scree_guard_sample(s, value[SCREE_SAMPLE_ENERGY_RESIDUAL_RELATIVE], error);
}

double scree_sample_get(const scree_simulation *s, const char *name)
{
    size_t column = scree_columns_find(&s->columns, name);
    return column < s->columns.count ? s->sample[column] : NAN;
}
