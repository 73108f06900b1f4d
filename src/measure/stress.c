/// Average stress of the sample, from its contacts and from what its boundary applies. Tension positive,
/// sigma_ij = (1/V) sum f_i x_j over the external forces f on the sample at points x.
///
/// Equality. Multiply the resultant F_k of each body k by its centre x_k and add up. Contacts between bodies give
/// f (x) (x_first - x_second), f the force on `first`; wall contacts f (x) x_k = f (x) (x_k - x_c) + f (x) x_c with the
/// point x_c on the wall; the pressure acts at the centres of its bodies. Hence, with l the branch of the contact
/// table,
///     -(1/V) sum_contacts f (x) l = (1/V) [sum_walls f (x) x_c + sum_pressure f (x) x_k] - (1/V) sum_k F_k (x) (x_k -
///     x_0):
/// contact stress = boundary stress - residual. In equilibrium (F_k = 0) the two are equal to round-off, with walls and
/// with pressure, for any V, so no boundary term is missing on the left; in motion they differ by the average m a (x)
/// (x - x_0), of the order of the unbalanced force ratio. The left side does not depend on the origin x_0; the right
/// side is taken about the centre of the sample. Moments: sigma is symmetric as far as the bodies are in rotational
/// equilibrium.
///
/// V = scree_sample_volume is the volume to divide by: its outline runs along the plates, where their forces
/// act, and through the centres of the pressed bodies, where theirs do. So a sample under pressure p on all sides has
/// sigma = -p exactly (integral of n (x) x over a closed outline = area), and the lateral stress of the boundary is -p
/// for any shape of the sides. Sources: Christoffersen, Mehrabadi, Nemat-Nasser 1981 (contact stress); Bagi 1996
/// (boundary). Cost: O(contacts), O(loop). Contacts are those of this process, summed in integers; loop and hull are
/// the same in all processes.
#include "base/integer_sum.h"
#include "comm/comm.h"
#include "measure/delaunay_boundary.h"
#include "measure/imposed_gradient.h"
#include "measure/measure.h"
#include "state/plates.h"

#include "measure/facets.h"
#include "measure/hull.h"
#include "measure/outline.h"
#include "state/periodic.h"
#include "state/pressure.h"

#include <math.h>

/// sum_ij += f_i x_j
static void add_product(double sum[9], const scree_vector f, const scree_vector x)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) sum[3 * i + j] += f[i] * x[j];
}

/// Force on `first` [N].
static void contact_force(const scree_contact *contact, scree_vector force)
{
    for (int i = 0; i < 3; i++)
        force[i] = contact->normal_force * contact->normal[i] + contact->tangential_force * contact->tangent[i];
}

/// Adds f_i x_j, the components that there are.
static void add_terms(int dimension, scree_integer_sum sum[9], const scree_vector f, const scree_vector x)
{
    for (int i = 0; i < dimension; i++)
        for (int j = 0; j < dimension; j++) scree_integer_sum_add(&sum[3 * i + j], f[i] * x[j]);
}

/// No term is larger than this, which takes less time than to look at all of them.
static void bound_terms(const scree_contact_table *table, scree_integer_sum sum[9])
{
    double largest = 0;
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        if (contact->membrane) continue;
        const double *x = contact->branch, way = fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
        largest = fmax(largest, (fabs(contact->normal_force) + fabs(contact->tangential_force)) * way);
    }
    // Unit vectors are longer than 1 by round-off.
    for (int k = 0; k < 9; k++) sum[k].largest = 1.0625 * largest;
}

void scree_stress_from_contacts(const scree_state *state, const scree_contact_table *table, double volume,
                                double stress[9])
{
    scree_integer_sum sum[9] = {0};
    scree_vector force;
    while (scree_comm_sum_next(state, sum, 9)) {
        if (sum[0].pass == SCREE_INTEGER_SUM_LOOKS) {
            bound_terms(table, sum);
            continue;
        }
        for (size_t c = 0; c < table->count; c++) {
            // A membrane's force counts as one on the centre of its grain.
            if (table->contact[c].membrane) continue;
            contact_force(&table->contact[c], force);
            add_terms(state->dimension, sum, force, table->contact[c].branch);
        }
    }
    for (int i = 0; i < 9; i++) stress[i] = -scree_integer_sum_total(&sum[i]) / volume;
}

typedef struct pressure_sum {
    const scree_state *state;
    double traction; ///< N/m, pressure times thickness
    scree_vector centre;
    double sum[9];
} pressure_sum;

/// Pressure on a segment: half at each end of an edge is the same as all of it in the middle.
static void add_pressure(void *user, const scree_outline_segment *segment)
{
    pressure_sum *pressure = user;
    if (segment->kind == SCREE_OUTLINE_BARE) return;
    scree_vector force = {-pressure->traction * (segment->to[1] - segment->from[1]),
                          pressure->traction * (segment->to[0] - segment->from[0])};
    double a[2], b[2];
    scree_loop_position(pressure->state, segment->first, a);
    scree_loop_position(pressure->state, segment->second, b);
    scree_vector middle = {(a[0] + b[0]) / 2 - pressure->centre[0], (a[1] + b[1]) / 2 - pressure->centre[1]};
    add_product(pressure->sum, force, middle);
}

/// The same of the hull, whose forces at its bodies are kept; a membrane has taken a part of the pressure from them.
static void add_hull_pressure(const scree_state *state, pressure_sum *pressure, double applied)
{
    (void)scree_hull_sample_volume(state, pressure->centre);
    double carried = applied - scree_direct_pressure(state), moment[9];
    if (carried > 0) {
        scree_hull_pressure_moment(state, pressure->centre, moment);
        for (int i = 0; i < 9; i++) pressure->sum[i] += carried * moment[i];
    }
    for (size_t k = 0; k < scree_hull_of(state)->node_count; k++) {
        scree_vector position;
        scree_hull_position(state, k, position);
        for (int i = 0; i < 3; i++) position[i] -= pressure->centre[i];
        add_product(pressure->sum, scree_hull_of(state)->force[k], position);
    }
}

/// Forces of imposed rates on the bodies of the boundary.
static void add_drive(const scree_state *state, const scree_vector centre, double sum[9])
{
    scree_vector point;
    for (size_t k = 0; k < scree_imposed(state)->count; k++) {
        scree_boundary_position(state, k, point);
        for (int i = 0; i < 3; i++) point[i] -= centre[i];
        add_product(sum, scree_imposed(state)->force[k], point);
    }
}

/// Centre of the sample, and the sum over the forces of `pressure` about it.
static pressure_sum sum_pressure(const scree_model *model, const scree_state *state, double applied)
{
    pressure_sum pressure = {.state = state, .traction = applied * model->thickness};
    if (state->dimension == 3) {
        add_hull_pressure(state, &pressure, applied);
        return pressure;
    }
    scree_outline_area(state, pressure.centre);
    if (pressure.traction > 0) scree_outline_visit(state, add_pressure, &pressure);
    return pressure;
}

void scree_stress_from_boundary(const scree_model *model, const scree_state *state, const scree_contact_table *table,
                                double stress[9])
{
    pressure_sum pressure = sum_pressure(model, state, scree_direct_pressure(state));
    double volume = scree_sample_volume(model, state);
    scree_vector force;
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        if (!scree_contact_is_outer(contact) || !scree_body_is_grain(state, contact->first)) continue;
        contact_force(contact, force);
        scree_vector point;
        scree_body_position(state, contact->first, point);
        for (int i = 0; i < 3; i++) point[i] = (contact->wall ? contact->point[i] : point[i]) - pressure.centre[i];
        add_product(pressure.sum, force, point);
    }
    add_drive(state, pressure.centre, pressure.sum);
    for (int i = 0; i < 9; i++) stress[i] = pressure.sum[i] / volume;
}

/// Forces of a wall on the bodies, as far as their place is known: all of them at the distance of the wall.
static void add_wall(const scree_wall *wall, const scree_vector centre, double sum[9])
{
    const double *n = wall->normal;
    double distance = wall->position - (n[0] * centre[0] + n[1] * centre[1] + n[2] * centre[2]);
    scree_vector force, point;
    for (int i = 0; i < 3; i++) {
        force[i] = wall->force * n[i] - wall->shear[i];
        point[i] = distance * n[i];
    }
    add_product(sum, force, point);
}

/// Whether a plate across this axis is active.
static bool has_plates(const scree_state *state, int axis)
{
    int low = axis == state->dimension - 1 ? SCREE_WALL_BOTTOM : axis == 0 ? SCREE_WALL_LEFT : SCREE_WALL_FRONT;
    return scree_plates(state)[low].active || scree_plates(state)[low + 1].active;
}

void scree_stress_from_plates(const scree_model *model, const scree_state *state, double stress[9])
{
    if (scree_periodic_is_whole(state)) {
        scree_periodic_stress(model, state, stress);
        return;
    }
    pressure_sum pressure = sum_pressure(model, state, scree_pressure_now(state));
    const scree_wall *wall = scree_plates(state);
    for (int w = 0; w < SCREE_WALL_COUNT; w++)
        if (wall[w].active) add_wall(&wall[w], pressure.centre, pressure.sum);
    add_drive(state, pressure.centre, pressure.sum);
    double volume = scree_sample_volume(model, state);
    for (int i = 0; i < 9; i++) stress[i] = pressure.sum[i] / volume;

    // What cannot be known from the resultants of the walls: see measure.h.
    int dimension = state->dimension, active = 0;
    bool pressed =
             scree_pressure_now(state) > 0 && (scree_loop_of(state)->count > 0 || scree_hull_of(state)->node_count > 0),
         plates[3];
    for (int k = 0; k < dimension; k++) active += plates[k] = has_plates(state, k);
    double known[9];
    for (int i = 0; i < 9; i++) known[i] = stress[i];
    for (int i = 0; i < dimension; i++)
        for (int j = 0; j < dimension; j++) {
            // Plates across another axis than j apply forces at unknown places along j.
            bool here = active == plates[j], mirrored = active == plates[i];
            if (i != j && !here) stress[3 * i + j] = mirrored ? known[3 * j + i] : NAN;
            if (i == j && !pressed && !plates[i]) stress[4 * i] = NAN;
        }
}
