/// Contacts and measures of a simulation: what measure/ finds, for programs that use the library.
#include "library/handle.h"

#include "measure/measure.h"
#include "run/sample.h"

#include <string.h>

// ---- contacts ----------------------------------------------------------------------------------------------------

static void fill_partner(const scree_state *state, const scree_contact *contact, scree_contact_point *point)
{
    bool element = contact->wall && contact->second >= SCREE_PRIMITIVE_ID;
    point->partner = element ? SCREE_PARTNER_WALL : contact->wall ? SCREE_PARTNER_PLATE : SCREE_PARTNER_BODY;
    point->second = element         ? contact->second - SCREE_PRIMITIVE_ID
                    : contact->wall ? contact->second
                                    : state->id[contact->second];
}

static void fill(const scree_state *state, const scree_contact *contact, scree_contact_point *point)
{
    *point = (scree_contact_point){.first = state->id[contact->first],
                                   .sliding = contact->sliding,
                                   .overlap = contact->overlap,
                                   .normal_force = contact->normal_force,
                                   .slip = contact->slip,
                                   .elastic_energy = contact->elastic_normal + contact->elastic_tangential};
    fill_partner(state, contact, point);
    for (int k = 0; k < 3; k++) {
        point->normal[k] = contact->normal[k];
        point->point[k] = contact->point[k];
        point->branch[k] = contact->branch[k];
        point->force[k] = contact->normal_force * contact->normal[k] + contact->tangential_force * contact->tangent[k];
    }
}

scree_status scree_simulation_contacts(scree_simulation *s, const scree_contact_point **contact, size_t *count,
                                       scree_error *error)
{
    *contact = NULL;
    *count = 0;
    scree_status status = handle_find_contacts(s, error);
    if (!status && s->table.count > s->point_capacity) {
        size_t capacity = s->table.count + s->table.count / 4;
        status = scree_reallocate(&s->points, 0, capacity, sizeof *s->points, error);
        s->point_capacity = status ? 0 : capacity;
    }
    if (status) return status;
    for (size_t k = 0; k < s->table.count; k++) fill(&s->state, &s->table.contact[k], &s->points[k]);
    *contact = s->points;
    *count = s->table.count;
    return SCREE_OK;
}

// ---- measures ----------------------------------------------------------------------------------------------------

scree_status scree_simulation_stress(scree_simulation *s, double stress[9], scree_error *error)
{
    scree_status status = handle_find_contacts(s, error);
    if (!status)
        scree_stress_from_contacts(&s->state, &s->table, scree_sample_volume(&s->stage_model, &s->state), stress);
    return status;
}

scree_status scree_simulation_boundary_stress(scree_simulation *s, double stress[9], scree_error *error)
{
    scree_status status = handle_find_contacts(s, error);
    if (!status) scree_stress_from_boundary(&s->stage_model, &s->state, &s->table, stress);
    return status;
}

void scree_simulation_strain(const scree_simulation *s, double gradient[9])
{
    handle_assert(s);
    memset(gradient, 0, 9 * sizeof *gradient);
    if (s->state.count > 0) scree_strain_measure(&s->state, gradient);
}

double scree_simulation_volume(const scree_simulation *s)
{
    handle_assert(s);
    return s->state.count > 0 ? scree_sample_volume(&s->stage_model, &s->state) : NAN;
}

static void measure_fabric(const scree_contact_table *table, double fabric[9])
{
    for (int k = 0; k < 9; k++) fabric[k] = table->count > 0 ? 0 : NAN;
    for (size_t c = 0; c < table->count; c++)
        for (int k = 0; k < 9; k++)
            fabric[k] += table->contact[c].normal[k / 3] * table->contact[c].normal[k % 3] / (double)table->count;
}

scree_status scree_simulation_structure(scree_simulation *s, scree_structure *structure, scree_error *error)
{
    scree_coordination coordination;
    *structure = (scree_structure){0};
    scree_status status = handle_find_contacts(s, error);
    if (!status)
        status = scree_coordination_measure(&s->stage_model, &s->state, &s->work, &s->table, &coordination, error);
    if (!status) status = scree_solid_fraction(&s->state, &structure->solid_fraction, error);
    if (status) return status;
    structure->contacts = s->table.count;
    structure->coordination = coordination.mean;
    structure->coordination_without_rattlers = coordination.mean_without_rattlers;
    structure->rattler_fraction = coordination.rattler_fraction;
    measure_fabric(&s->table, structure->fabric);
    scree_slip_measure(&s->state, &s->table, &structure->mean_slip, &structure->sliding_fraction);
    structure->unbalanced_ratio = scree_unbalanced_ratio(&s->stage_model, &s->state, &s->table);
    return SCREE_OK;
}

scree_status scree_simulation_energies(scree_simulation *s, scree_energies *energies, scree_error *error)
{
    scree_energy energy;
    scree_status status = handle_find_contacts(s, error);
    if (status) return status;
    scree_energy_measure(&s->stage_model, &s->state, &s->table, &energy);
    *energies = (scree_energies){.kinetic = energy.kinetic,
                                 .kinetic_rotation = energy.kinetic_rotation,
                                 .elastic_normal = energy.elastic_normal,
                                 .elastic_tangential = energy.elastic_tangential,
                                 .gravity = energy.gravity,
                                 .outside = s->state.ledger.outside,
                                 .residual = energy.residual,
                                 .relative_residual = energy.relative};
    return SCREE_OK;
}

scree_status scree_simulation_sample(const scree_simulation *s, const char *name, double *value, scree_error *error)
{
    const char *nearest = NULL;
    handle_assert(s);
    *value = NAN;
    if (!s->has_sample) return scree_error_set(error, SCREE_ERROR_INPUT, "no sample was taken yet");
    size_t column = scree_columns_find(&s->columns, name);
    if (column < s->columns.count) {
        *value = s->sample[column];
        return SCREE_OK;
    }
    (void)scree_column_is_known(name, &nearest);
    scree_status status =
        scree_error_set(error, SCREE_ERROR_INPUT, "there is no column '%s'%s%s%s", name,
                        nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    if (error && nearest) (void)snprintf(error->accepted, sizeof error->accepted, "%s", nearest);
    return status;
}
