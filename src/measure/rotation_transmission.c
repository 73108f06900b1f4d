/// What one contact hands on of a rotation: the amount of the body that is further from the forced one over that of the
/// nearer one, against the force of the contact and its direction. See rotation.h. Cost: O(contacts).
#include "measure/rotation_parts.h"

#include <math.h>

/// Inclined by less than 45 degrees.
#define OUTWARD M_SQRT1_2

/// Place from the forced body, and amount of rotation.
typedef struct end {
    scree_vector place;
    double distance, amount;
} end;

static end end_of(const scree_state *state, size_t row, const scree_vector centre)
{
    end e = {.amount = scree_rotation_amount(state, row)};
    scree_body_position(state, row, e.place);
    for (int i = 0; i < 3; i++) e.place[i] -= centre[i];
    e.distance = scree_length(e.place);
    return e;
}

static void add(scree_rotation_handed *handed, double logarithm)
{
    handed->value += logarithm;
    handed->count++;
}

static void finish(scree_rotation_handed *handed)
{
    handed->value = handed->count > 0 ? exp(handed->value / (double)handed->count) : NAN;
}

void scree_rotation_transmission_measure(const scree_model *model, const scree_state *state,
                                         const scree_contact_table *table, size_t forced, double cutoff, double limit,
                                         scree_rotation_transmission *out)
{
    double mean = scree_rotation_mean_force(table), reach = cutoff * 2 * model->mean_radius;
    double felt = limit * scree_rotation_amount(state, forced);
    scree_vector centre;
    scree_body_position(state, forced, centre);
    *out = (scree_rotation_transmission){0};
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        if (contact->wall || contact->first == forced || contact->second == forced) continue;
        if (!scree_rotation_counts(state, contact->first) || !scree_rotation_counts(state, contact->second)) continue;
        end inner = end_of(state, contact->first, centre), outer = end_of(state, contact->second, centre);
        if (inner.distance > outer.distance) {
            end other = inner;
            inner = outer;
            outer = other;
        }
        if (!(inner.amount >= felt) || !(outer.amount > 0) || inner.distance > reach) continue;
        scree_vector branch, middle;
        for (int i = 0; i < 3; i++) {
            branch[i] = outer.place[i] - inner.place[i];
            middle[i] = outer.place[i] + inner.place[i];
        }
        (void)scree_rotation_normalise(branch);
        (void)scree_rotation_normalise(middle);
        double logarithm = log(outer.amount / inner.amount);
        if (scree_rotation_dot(branch, middle) < OUTWARD)
            add(&out->aside, logarithm);
        else
            add(scree_rotation_force(contact) > mean ? &out->strong : &out->weak, logarithm);
    }
    finish(&out->strong);
    finish(&out->weak);
    finish(&out->aside);
}
