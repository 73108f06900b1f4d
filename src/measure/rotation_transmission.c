/// What one contact hands on of a rotation: the amount of the body that is further from the forced one over that of the
/// nearer one, against the force of the contact and its direction, and against the chains that cross the body further
/// out. See rotation.h. Cost: O(contacts), and for each contact within the cut-off that hands on one more look at all.
#include "measure/measure.h"
#include "measure/rotation_parts.h"

#include <math.h>

/// Inclined by less than 45 degrees.
#define OUTWARD M_SQRT1_2
/// Of a normal distribution 95 % lie within so many standard deviations.
#define NORMAL_95 1.959964

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

const double scree_rotation_force_edges[] = {0, 0.5, 1, 1.5, 2, INFINITY};

/// One contact that hands on: what it hands on, and by what it is told from others.
typedef struct handing {
    double logarithm;
    double force; ///< over the mean force
    double angle; ///< rad, of the branch to the major direction
    bool outward;
    size_t outer;        ///< row of the body that is further out
    scree_vector branch; ///< unit vector to it
} handing;

/// Sums until `finish`: `low` and `high` hold the sum of squares and nothing.
static void add(scree_rotation_handed *handed, const handing *h)
{
    handed->value += h->logarithm;
    handed->low += h->logarithm * h->logarithm;
    handed->force += h->force;
    handed->angle += h->angle;
    handed->count++;
}

static void finish(scree_rotation_handed *handed)
{
    const double n = (double)handed->count, mean = handed->value / n, square = handed->low / n;
    const double error = sqrt(fmax(0, square - mean * mean) / (n - 1));
    const bool alone = handed->count < 2;
    handed->value = exp(mean); // of nothing NAN: 0 / 0
    handed->low = alone ? NAN : exp(mean - NORMAL_95 * error);
    handed->high = alone ? NAN : exp(mean + NORMAL_95 * error);
    handed->force /= n;
    handed->angle /= n;
}

/// Direction of the largest compression of the sample.
static void find_major(const scree_state *state, const scree_contact_table *table, scree_vector major)
{
    double stress[9], value[3];
    scree_vector axis[3] = {{0}};
    scree_stress_from_contacts(state, table, 1, stress); // a volume does not turn its axes
    for (int c = 0; c < 9; c++) stress[c] = -stress[c];
    scree_rotation_axes(state->dimension, stress, value, axis);
    for (int i = 0; i < 3; i++) major[i] = axis[0][i];
}

/// What limits the contacts that count.
typedef struct limits {
    size_t forced;
    scree_vector centre;
    double reach; ///< m
    double felt;  ///< least amount of the nearer body
} limits;

/// False where the contact hands on nothing that counts.
static bool look_at(const scree_state *state, const scree_contact *contact, const limits *l, const scree_vector major,
                    handing *h)
{
    if (contact->wall || contact->first == l->forced || contact->second == l->forced) return false;
    if (!scree_rotation_counts(state, contact->first) || !scree_rotation_counts(state, contact->second)) return false;
    end inner = end_of(state, contact->first, l->centre), outer = end_of(state, contact->second, l->centre);
    h->outer = contact->second;
    if (inner.distance > outer.distance) {
        end other = inner;
        inner = outer;
        outer = other;
        h->outer = contact->first;
    }
    if (!(inner.amount >= l->felt) || !(outer.amount > 0) || inner.distance > l->reach) return false;
    scree_vector middle;
    for (int i = 0; i < 3; i++) {
        h->branch[i] = outer.place[i] - inner.place[i];
        middle[i] = outer.place[i] + inner.place[i];
    }
    (void)scree_rotation_normalise(h->branch);
    (void)scree_rotation_normalise(middle);
    h->logarithm = log(outer.amount / inner.amount);
    h->angle = acos(fmin(1, fabs(scree_rotation_dot(h->branch, major))));
    h->outward = scree_rotation_dot(h->branch, middle) >= OUTWARD;
    return true;
}

/// Whether the body further out bears a strong contact across the branch.
static bool is_crossed(const scree_contact_table *table, const handing *h, double mean)
{
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *other = &table->contact[c];
        if (other->wall || (other->first != h->outer && other->second != h->outer)) continue;
        if (!(scree_rotation_force(other) > mean)) continue;
        const double along = fabs(scree_rotation_dot(other->branch, h->branch));
        if (along < OUTWARD * scree_length(other->branch)) return true;
    }
    return false;
}

static void sort_in(scree_rotation_transmission *out, const handing *h)
{
    size_t force = 0, angle = (size_t)(h->angle / (M_PI / 2 / SCREE_ROTATION_ANGLES));
    while (force + 1 < SCREE_ROTATION_FORCES && h->force >= scree_rotation_force_edges[force + 1]) force++;
    add(&out->by_force[force], h);
    add(&out->by_angle[angle < SCREE_ROTATION_ANGLES ? angle : SCREE_ROTATION_ANGLES - 1], h);
    if (h->outward)
        add(h->force > 1 ? &out->strong : &out->weak, h);
    else
        add(&out->aside, h);
}

void scree_rotation_transmission_measure(const scree_model *model, const scree_state *state,
                                         const scree_contact_table *table, size_t forced, double cutoff, double limit,
                                         scree_rotation_transmission *out)
{
    const double mean = scree_rotation_mean_force(table);
    limits l = {.forced = forced,
                .reach = cutoff * 2 * model->mean_radius,
                .felt = limit * scree_rotation_amount(state, forced)};
    scree_body_position(state, forced, l.centre);
    *out = (scree_rotation_transmission){0};
    find_major(state, table, out->major);
    for (size_t c = 0; c < table->count; c++) {
        handing h;
        if (!look_at(state, &table->contact[c], &l, out->major, &h)) continue;
        h.force = scree_rotation_force(&table->contact[c]) / mean;
        sort_in(out, &h);
        if (h.outward) add(is_crossed(table, &h, mean) ? &out->crossed : &out->open, &h);
    }
    finish(&out->strong);
    finish(&out->weak);
    finish(&out->aside);
    finish(&out->crossed);
    finish(&out->open);
    for (int k = 0; k < SCREE_ROTATION_FORCES; k++) finish(&out->by_force[k]);
    for (int k = 0; k < SCREE_ROTATION_ANGLES; k++) finish(&out->by_angle[k]);
}
