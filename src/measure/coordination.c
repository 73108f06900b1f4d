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
///
/// Of a part each process finds its own rattlers, with the contacts that others evaluate for it
/// (measure/contacts_elsewhere.h), and tells the others after each pass. Gilbert's algorithm begins at the first normal
/// and takes the first of several that are equally far: normals lie in the order of the other ids, as in the table of a
/// whole state, so all find what one process finds.
#include "measure/contacts_elsewhere.h"
#include "measure/delaunay_boundary.h"
#include "measure/measure.h"

#include "comm/comm.h"

#include <math.h>
#include <string.h>

/// What a body is; FOUND in this pass, it still supports others.
enum { SUPPORTED, RATTLER, FOUND };

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
    uint8_t *rattler;   ///< behind the rows: of the other bodies of contacts elsewhere
    uint8_t *pressed;
    uint32_t *begin;      ///< 3D: of each row in `normal`, count + 1
    scree_vector *normal; ///< 3D: of the contacts, towards the body, and the direction of the pressure
    uint32_t *other;      ///< 3D: the other body, in `rattler`; UINT32_MAX: a wall or the pressure
    uint32_t *order;      ///< 3D, of a part: its id, or that of a wall; behind all others the pressure, then gravity
    uint32_t needed;      ///< number of supports
    double sine;          ///< of the friction angle
    scree_contacts_elsewhere elsewhere;
} supports;

/// Contacts between bodies that are not rattlers, by row.
static void count_contacts(const scree_contact_table *table, const supports *s)
{
    const scree_ghost_notes *elsewhere = &s->elsewhere.notes;
    for (size_t row = 0; row < s->elsewhere.rows; row++) s->contacts[row] = 0; // there may be none
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        bool outer = scree_contact_is_outer(contact);
        if (s->rattler[contact->first] || (!outer && s->rattler[contact->second])) continue;
        s->contacts[contact->first]++;
        if (!outer) s->contacts[contact->second]++;
    }
    for (size_t k = 0; k < elsewhere->arriving; k++)
        s->contacts[elsewhere->row[k]] += !s->rattler[s->elsewhere.rows + k];
}

static double mean_contacts(const scree_state *state, const supports *s, int64_t *bodies)
{
    int64_t number[2] = {0}; // contacts, bodies
    for (size_t row = 0; row < state->count; row++) {
        if (s->rattler[row]) continue;
        number[0] += s->contacts[row];
        number[1]++;
    }
    scree_comm_add(state, number, 2);
    *bodies = number[1];
    return number[1] > 0 ? (double)number[0] / (double)number[1] : 0;
}

/// Whether the normals of a row that count leave a direction which makes less than 90 degrees - phi with all of them.
static bool on_one_side(const supports *s, size_t row)
{
    scree_vector point = {0};
    for (int step = 0; step < GILBERT_STEPS; step++) {
        const double *farthest = NULL;
        double least = INFINITY;
        for (uint32_t k = s->begin[row]; k < s->begin[row + 1]; k++) {
            if (s->other[k] != UINT32_MAX && s->rattler[s->other[k]] == RATTLER) continue;
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

/// Marks the bodies without support; true when there were any. All are judged by those of the pass before, so the order
/// of rows does not show.
static bool mark_rattlers(const scree_state *state, const supports *s)
{
    double found = 0;
    for (size_t row = 0; row < state->count; row++) {
        if (s->rattler[row]) continue;
        if (s->contacts[row] + s->pressed[row] >= s->needed && !(s->begin && on_one_side(s, row))) continue;
        s->rattler[row] = FOUND;
        found = 1;
    }
    for (size_t row = 0; row < state->count; row++)
        if (s->rattler[row] == FOUND) s->rattler[row] = RATTLER;
    scree_comm_maximum(state, &found, 1);
    return found > 0;
}

static void mark(const scree_state *state, const supports *s, uint32_t id)
{
    const uint32_t row = scree_state_row_of(state, id);
    if (row != SCREE_NO_ROW) s->pressed[row] = 1;
}

static void mark_pressed(const scree_state *state, const supports *s)
{
    const scree_loop *loop = scree_loop_of(state);
    const scree_hull *hull = scree_hull_of(state);
    for (size_t k = 0; k < loop->count; k++)
        if (scree_direct_pressure(state) > 0 && (loop->loaded[k] || loop->loaded[k > 0 ? k - 1 : loop->count - 1]))
            mark(state, s, loop->id[k]);
    for (size_t k = 0; k < hull->node_count; k++)
        if (scree_length(hull->force[k]) > 0) mark(state, s, hull->id[k]);
}

/// Puts a support behind those that the row has already, or in its place of the order of a part; begin[row + 1] is
/// where.
static void add_normal(const supports *s, size_t row, const scree_vector normal, double sign, uint32_t other,
                       uint32_t order)
{
    uint32_t position = s->begin[row + 1]++;
    for (; s->order && position > s->begin[row] && s->order[position - 1] > order; position--) {
        memcpy(s->normal[position], s->normal[position - 1], sizeof s->normal[position]);
        s->other[position] = s->other[position - 1];
        s->order[position] = s->order[position - 1];
    }
    for (int k = 0; k < 3; k++) s->normal[position][k] = sign * normal[k];
    s->other[position] = other;
    if (s->order) s->order[position] = order;
}

static void add_contact(const scree_state *state, const supports *s, const scree_contact *contact)
{
    const bool outer = scree_contact_is_outer(contact);
    if (contact->first < state->count)
        add_normal(s, contact->first, contact->normal, 1, outer ? UINT32_MAX : contact->second,
                   scree_contact_second_id(state, contact));
    if (!outer && contact->second < state->count)
        add_normal(s, contact->second, contact->normal, -1, contact->first, state->id[contact->first]);
}

static scree_status allocate_normals(const scree_state *state, const scree_contact_table *table, supports *s,
                                     scree_error *error)
{
    const size_t room =
        2 * table->count + scree_hull_of(state)->node_count + state->count + s->elsewhere.notes.arriving;
    scree_status status = scree_allocate(&s->begin, state->count + 2, sizeof *s->begin, error);
    if (!status) status = scree_allocate(&s->normal, room, sizeof *s->normal, error);
    if (!status) status = scree_allocate(&s->other, room, sizeof *s->other, error);
    if (!status && state->part) status = scree_allocate(&s->order, room, sizeof *s->order, error);
    return status;
}

/// How many supports each row has: begin[row + 1] is the start of the row then; filling advances it to the end.
static void make_room(const scree_state *state, const scree_contact_table *table, const supports *s, bool weight)
{
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        if (contact->first < state->count) s->begin[contact->first + 2]++;
        if (!scree_contact_is_outer(contact) && contact->second < state->count) s->begin[contact->second + 2]++;
    }
    for (size_t k = 0; k < s->elsewhere.notes.arriving; k++) s->begin[s->elsewhere.notes.row[k] + 2]++;
    for (size_t row = 0; row < state->count; row++) s->begin[row + 2] += s->begin[row + 1] + s->pressed[row] + weight;
}

/// 3D: the directions of the supports of every row.
static scree_status collect_normals(const scree_model *model, const scree_state *state,
                                    const scree_contact_table *table, supports *s, scree_error *error)
{
    const double weight = scree_length(model->gravity);
    const scree_hull *hull = scree_hull_of(state);
    const scree_contacts_elsewhere *elsewhere = &s->elsewhere;
    scree_status status = allocate_normals(state, table, s, error);
    if (status) return status;
    make_room(state, table, s, weight > 0);
    for (size_t c = 0; c < table->count; c++) add_contact(state, s, &table->contact[c]);
    for (size_t k = 0; k < elsewhere->notes.arriving; k++)
        add_normal(s, elsewhere->notes.row[k], elsewhere->contact[k].normal, 1, (uint32_t)(elsewhere->rows + k),
                   elsewhere->contact[k].id);
    for (size_t k = 0; k < hull->node_count; k++) {
        const double *force = hull->force[k], length = scree_length(force);
        const uint32_t row = scree_state_row_of(state, hull->id[k]);
        if (length > 0 && row != SCREE_NO_ROW) add_normal(s, row, force, 1 / length, UINT32_MAX, UINT32_MAX - 1);
    }
    for (size_t row = 0; row < state->count && weight > 0; row++)
        add_normal(s, row, model->gravity, 1 / weight, UINT32_MAX, UINT32_MAX);
    return SCREE_OK;
}

static scree_status open_supports(const scree_model *model, const scree_state *state, const scree_work *work,
                                  const scree_contact_table *table, supports *s, scree_error *error)
{
    const double friction = largest_friction(model);
    *s = (supports){.needed = friction > 0 ? 2 : (uint32_t)state->dimension + 1,
                    .sine = friction / sqrt(1 + friction * friction)};
    scree_status status = scree_contacts_elsewhere_open(state, work, table, &s->elsewhere, error);
    if (!status) status = scree_allocate(&s->contacts, s->elsewhere.rows, sizeof *s->contacts, error);
    if (!status) status = scree_allocate(&s->rattler, s->elsewhere.flags, sizeof *s->rattler, error);
    if (!status) status = scree_allocate(&s->pressed, state->count, sizeof *s->pressed, error);
    if (!status) mark_pressed(state, s);
    if (!status && state->dimension == 3) status = collect_normals(model, state, table, s, error);
    return status;
}

static void close_supports(supports *s)
{
    void *const arrays[] = {&s->contacts, &s->rattler, &s->pressed, &s->begin, &s->normal, &s->other, &s->order};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    scree_contacts_elsewhere_close(&s->elsewhere);
}

scree_status scree_coordination_measure(const scree_model *model, const scree_state *state, const scree_work *work,
                                        const scree_contact_table *table, scree_coordination *out, scree_error *error)
{
    supports s;
    int64_t bodies = 0, grains = 0;
    scree_status status = open_supports(model, state, work, table, &s, error);
    // Bodies of a membrane are no part of the assembly.
    for (size_t row = 0; row < state->count && !status; row++) {
        s.rattler[row] = scree_body_is_grain(state, row) ? SUPPORTED : RATTLER;
        grains += s.rattler[row] == SUPPORTED;
    }
    bool changes = !status;
    for (int pass = 0; changes && !status; pass++) {
        status = scree_contacts_elsewhere_tell(state, work, &s.elsewhere, s.rattler, error);
        if (status) break;
        count_contacts(table, &s);
        if (pass == 0) out->mean = mean_contacts(state, &s, &bodies);
        changes = mark_rattlers(state, &s);
    }
    if (!status) {
        out->mean_without_rattlers = mean_contacts(state, &s, &bodies);
        scree_comm_add(state, &grains, 1);
        out->rattler_fraction = grains > 0 ? 1 - (double)bodies / (double)grains : 0;
    }
    close_supports(&s);
    return status;
}
