/// Coordination number, with and without rattlers.
///
/// A contact of two bodies counts once for each of them, a contact with a wall or a membrane once. A rattler is a body
/// that cannot be in equilibrium with the contacts it has: too few, or all on one side. With friction two can hold it
/// (the line between them in both friction cones), without friction it needs three in 2D and four in 3D. In 3D the
/// forces of the contacts lie in cones of the friction angle phi about their normals, and can add up to nothing only if
/// no direction makes less than 90 degrees - phi with all normals: that is, if the convex hull of the unit normals
/// comes within sin(phi) of the origin. Its nearest point is approached by Gilbert's algorithm (1966), which bounds the
/// distance from both sides. The pressure on the boundary is one more support, along its force, of the bodies that
/// carry it; in 3D gravity acts on all. A contact with a rattler bears no load, so rattlers are taken away and the rest
/// is counted again, until nothing changes. Cost: O(contacts) a pass, a few passes.
#include "measure/delaunay_boundary.h"
#include "measure/measure.h"

#include <math.h>

/// Steps of Gilbert's algorithm; a body that is not decided after them counts as supported.
#define GILBERT_STEPS 64
/// Distance to which the hull of the normals is known to come near enough.
#define GILBERT_TOLERANCE 1e-3

static double largest_friction(const scree_model *model)
{
    double friction = 0;
    for (int a = 0; a < model->material_count; a++)
        for (int b = 0; b < model->material_count; b++)
            friction = fmax(friction, model->pairs[a][b].value[SCREE_FRICTION]);
    return friction;
}

/// Working arrays, by row.
typedef struct supports {
    uint32_t *contacts; ///< with bodies that are no rattlers
    uint8_t *rattler, *pressed;
    uint32_t *begin;      ///< 3D: of each row in `normal`, count + 1
    scree_vector *normal; ///< 3D: of the contacts, towards the body, and the direction of the pressure
    uint32_t *other;      ///< 3D: the other body; UINT32_MAX: a wall or the pressure
    uint32_t needed;      ///< number of supports
    double sine;          ///< of the friction angle
} supports;

/// Contacts between bodies that are not rattlers, by row.
static void count_contacts(const scree_contact_table *table, const supports *s, size_t count)
{
    for (size_t row = 0; row < count; row++) s->contacts[row] = 0;
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        bool outer = scree_contact_is_outer(contact);
        if (s->rattler[contact->first] || (!outer && s->rattler[contact->second])) continue;
        s->contacts[contact->first]++;
        if (!outer) s->contacts[contact->second]++;
    }
}

static double mean_contacts(const supports *s, size_t count, size_t *bodies)
{
    double sum = 0;
    *bodies = 0;
    for (size_t row = 0; row < count; row++) {
        if (s->rattler[row]) continue;
        sum += s->contacts[row];
        (*bodies)++;
    }
    return *bodies > 0 ? sum / (double)*bodies : 0;
}

/// Whether the normals of a row that count leave a direction which makes less than 90 degrees - phi with all of them.
static bool on_one_side(const supports *s, size_t row)
{
    scree_vector point = {0};
    for (int step = 0; step < GILBERT_STEPS; step++) {
        const double *farthest = NULL;
        double least = INFINITY;
        for (uint32_t k = s->begin[row]; k < s->begin[row + 1]; k++) {
            if (s->other[k] != UINT32_MAX && s->rattler[s->other[k]]) continue;
            double along = scree_dot(s->normal[k], point);
            if (along < least) {
                least = along;
                farthest = s->normal[k];
            }
        }
        if (!farthest) return true;
        if (step == 0) {
            for (int k = 0; k < 3; k++) point[k] = farthest[k];
            continue;
        }
        // The hull lies beyond the plane at `least / length` from the origin; its nearest point is no farther than
        // this.
        double length = scree_length(point);
        if (length <= s->sine + GILBERT_TOLERANCE) return false;
        if (least > s->sine * length) return true;
        // The nearest point of the way to the farthest normal.
        scree_vector way = {farthest[0] - point[0], farthest[1] - point[1], farthest[2] - point[2]};
        double part = fmin(1, -scree_dot(point, way) / scree_dot(way, way));
        for (int k = 0; k < 3; k++) point[k] += part * way[k];
    }
    return false;
}

/// Marks the bodies without support; true when there were any.
static bool mark_rattlers(const supports *s, size_t count)
{
    bool found = false;
    for (size_t row = 0; row < count; row++) {
        if (s->rattler[row]) continue;
        if (s->contacts[row] + s->pressed[row] >= s->needed && !(s->begin && on_one_side(s, row))) continue;
        s->rattler[row] = 1;
        found = true;
    }
    return found;
}

static void mark_pressed(const scree_state *state, const supports *s)
{
    const scree_loop *loop = scree_loop_of(state);
    for (size_t k = 0; k < loop->count; k++)
        if (scree_direct_pressure(state) > 0 && (loop->loaded[k] || loop->loaded[k > 0 ? k - 1 : loop->count - 1]))
            s->pressed[state->row_of_id[loop->id[k]]] = 1;
    for (size_t k = 0; k < scree_hull_of(state)->node_count; k++)
        if (scree_length(scree_hull_of(state)->force[k]) > 0)
            s->pressed[state->row_of_id[scree_hull_of(state)->id[k]]] = 1;
}

/// Puts a support behind those that the row has already; begin[row + 1] is where.
static void add_normal(const supports *s, size_t row, const scree_vector normal, double sign, uint32_t other)
{
    uint32_t position = s->begin[row + 1]++;
    for (int k = 0; k < 3; k++) s->normal[position][k] = sign * normal[k];
    s->other[position] = other;
}

/// 3D: the directions of the supports of every row.
static scree_status collect_normals(const scree_model *model, const scree_state *state,
                                    const scree_contact_table *table, supports *s, scree_error *error)
{
    double weight = scree_length(model->gravity);
    size_t room = 2 * table->count + scree_hull_of(state)->node_count + state->count;
    scree_status status = scree_allocate(&s->begin, state->count + 2, sizeof *s->begin, error);
    if (!status) status = scree_allocate(&s->normal, room, sizeof *s->normal, error);
    if (!status) status = scree_allocate(&s->other, room, sizeof *s->other, error);
    if (status) return status;
    // After this begin[row + 1] is the start of the row; filling advances it to the end.
    for (size_t c = 0; c < table->count; c++) {
        s->begin[table->contact[c].first + 2]++;
        if (!scree_contact_is_outer(&table->contact[c])) s->begin[table->contact[c].second + 2]++;
    }
    for (size_t row = 0; row < state->count; row++)
        s->begin[row + 2] += s->begin[row + 1] + s->pressed[row] + (weight > 0);
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        add_normal(s, contact->first, contact->normal, 1,
                   scree_contact_is_outer(contact) ? UINT32_MAX : contact->second);
        if (!scree_contact_is_outer(contact)) add_normal(s, contact->second, contact->normal, -1, contact->first);
    }
    for (size_t k = 0; k < scree_hull_of(state)->node_count; k++) {
        const double *force = scree_hull_of(state)->force[k], length = scree_length(force);
        if (length > 0) add_normal(s, state->row_of_id[scree_hull_of(state)->id[k]], force, 1 / length, UINT32_MAX);
    }
    for (size_t row = 0; row < state->count && weight > 0; row++)
        add_normal(s, row, model->gravity, 1 / weight, UINT32_MAX);
    return SCREE_OK;
}

scree_status scree_coordination_measure(const scree_model *model, const scree_state *state,
                                        const scree_contact_table *table, scree_coordination *out, scree_error *error)
{
    double friction = largest_friction(model);
    supports s = {.needed = friction > 0 ? 2 : (uint32_t)state->dimension + 1,
                  .sine = friction / sqrt(1 + friction * friction)};
    scree_status status = scree_allocate(&s.contacts, state->count, sizeof *s.contacts, error);
    if (!status) status = scree_allocate(&s.rattler, state->count, sizeof *s.rattler, error);
    if (!status) status = scree_allocate(&s.pressed, state->count, sizeof *s.pressed, error);
    if (!status) mark_pressed(state, &s);
    if (!status && state->dimension == 3) status = collect_normals(model, state, table, &s, error);
    if (!status) {
        size_t bodies;
        // Bodies of a membrane are no part of the assembly.
        for (size_t row = 0; row < state->count; row++) s.rattler[row] = !scree_body_is_grain(state, row);
        count_contacts(table, &s, state->count);
        out->mean = mean_contacts(&s, state->count, &bodies);
        while (mark_rattlers(&s, state->count)) count_contacts(table, &s, state->count);
        out->mean_without_rattlers = mean_contacts(&s, state->count, &bodies);
        size_t grains = scree_grain_count(state);
        out->rattler_fraction = grains > 0 ? 1 - (double)bodies / (double)grains : 0;
    }
    scree_release(&s.contacts);
    scree_release(&s.rattler);
    scree_release(&s.pressed);
    scree_release(&s.begin);
    scree_release(&s.normal);
    scree_release(&s.other);
    return status;
}
