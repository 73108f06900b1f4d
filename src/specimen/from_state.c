/// From the contact table to a specimen. Each contact has its own effective radius and mass; a wall is a body of
/// infinite radius and mass.
#include "specimen/from_state.h"

#include "contact/deformation.h"
#include "contact/surfaces.h"
#include "model/critical_step.h"
#include "state/periodic.h"
#include "state/plates.h"

/// Number of each body in the order of ids, by row.
static void number_bodies(const scree_state *state, uint32_t *number)
{
    size_t id = 0;
    uint32_t next = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) number[row] = next++;
}

static void set_bodies(const scree_model *model, const scree_state *state, const uint32_t *number, scree_specimen *s)
{
    const double length = state->dimension == 2 ? model->thickness : 1;
    for (size_t row = 0; row < state->count; row++) {
        const size_t body = number[row];
        s->mass[body] = scree_body_mass(state, row);
        s->inertia[body] = scree_body_inertia(state, row);
        s->radius[body] = scree_body_bounding_radius(state, row);
        scree_body_position(state, row, s->position[body]);
        s->volume[body] = scree_body_volume(state, row) * length;
        s->held[body] = (uint8_t)scree_body_held(state, row);
        s->compliance[body] = scree_deformation_compliance(model, scree_body_material(state, row));
    }
}

static scree_pair_constants constants_of(const scree_model *model, const scree_state *state, const scree_work *work,
                                         const scree_contact *contact)
{
    const int material = scree_body_material(state, contact->first);
    if (contact->wall && contact->second < SCREE_PRIMITIVE_ID) return model->walls[material];
    if (contact->wall)
        return contact_surface_constants(
            model, contact_surface_of(work->wall_set, contact->second - SCREE_PRIMITIVE_ID), material);
    const int other = scree_body_material(state, contact->second);
    return contact->held ? model->persistent.pairs[material][other] : model->pairs[material][other];
}

static const scree_law_use *law_of(const scree_model *model, const scree_state *state, const scree_work *work,
                                   const scree_contact *contact)
{
    const int material = scree_body_material(state, contact->first);
    if (contact->wall && contact->second < SCREE_PRIMITIVE_ID) return scree_model_law_on_plate(model, material);
    if (contact->wall)
        return contact_surface_law(model, contact_surface_of(work->wall_set, contact->second - SCREE_PRIMITIVE_ID),
                                   material);
    if (contact->held) return &model->persistent.law;
    return scree_model_law_between(model, material, scree_body_material(state, contact->second));
}

static double in_parallel(double a, double b)
{
    return a * (b / (a + b));
}

static scree_contact_tangent tangent_of(const scree_model *model, const scree_state *state, const scree_work *work,
                                        const scree_contact *contact)
{
    const scree_pair_constants pair = constants_of(model, state, work, contact);
    double radius = scree_body_bounding_radius(state, contact->first), mass = scree_body_mass(state, contact->first);
    if (!contact->wall) {
        radius = in_parallel(radius, scree_body_bounding_radius(state, contact->second));
        mass = in_parallel(mass, scree_body_mass(state, contact->second));
    }
    return scree_contact_linearise(law_of(model, state, work, contact), &pair, radius, mass, contact->normal_force);
}

static void set_contact(const scree_model *model, const scree_state *state, const scree_work *work,
                        const uint32_t *number, const scree_contact *contact, size_t c, scree_specimen *s)
{
    const scree_contact_tangent t = tangent_of(model, state, work, contact);
    const uint32_t second = contact->wall ? SCREE_SPECIMEN_WALL : number[contact->second];
    scree_specimen_set_contact(s, c, number[contact->first], second, contact->branch,
                               (scree_springs){t.normal_stiffness, t.tangential_stiffness},
                               (scree_springs){t.normal_damping, t.tangential_damping});
}

static scree_status fill(const scree_model *model, const scree_state *state, const scree_work *work,
                         const scree_contact_table *table, scree_specimen *s, scree_error *error)
{
    uint32_t *number;
    scree_status status = scree_allocate(&number, state->count, sizeof *number, error);
    if (status) return status;
    number_bodies(state, number);
    set_bodies(model, state, number, s);
    for (size_t c = 0; c < table->count; c++) set_contact(model, state, work, number, &table->contact[c], c, s);
    scree_release(&number);
    return SCREE_OK;
}

scree_status scree_specimen_of_state(const scree_model *model, const scree_state *state, const scree_work *work,
                                     scree_specimen *s, scree_error *error)
{
    scree_contact_table table = {0};
    *s = (scree_specimen){0};
    scree_status status = scree_contact_table_build(model, state, work, &table, error);
    if (!status) status = scree_specimen_create(state->dimension, state->count, table.count, s, error);
    if (!status) status = fill(model, state, work, &table, s, error);
    scree_contact_table_destroy(&table);
    const scree_periodic_cell *cell = scree_cell(state);
    s->condition = scree_deformation_condition(model);
    const bool corrected = model->laws[0].number[SCREE_LAW_CORRECTED] > 0;
    s->tangential = corrected ? SCREE_TANGENTIAL_CORRECTED : SCREE_TANGENTIAL_AS_PUBLISHED;
    s->dashpots_strain = !(model->laws[0].number[SCREE_LAW_LOOSE] > 0);
    s->periodic = (unsigned)cell->directions;
    // Area in 2D.
    if (cell->directions && scree_periodic_is_whole(state))
        s->extent = scree_periodic_extent(state) * (state->dimension == 2 ? model->thickness : 1);
    if (status) scree_specimen_destroy(s);
    return status;
}

void scree_specimen_deform(scree_specimen *s, scree_compliance compliance)
{
    for (size_t body = 0; body < s->body_count; body++) s->compliance[body] = compliance;
}
