/// Membrane (P 3.2; Iwashita and Oda 2000): on either side of a plane sample a chain of frictionless discs between the
/// bottom and the top plate, larger than the mean grain so that no grain escapes between them. The law of all contacts
/// holds them and the grains apart; their own contacts are left out, the chain holds them together.
///
/// Chain. Two neighbours at the distance l with the unstressed length l0 pull with k (l - l0) when l > l0; a slack
/// chain bears nothing, as rubber wrinkles. Equal integers of opposite sign: momentum is exact.
///
/// Pressure. Every segment between two centres carries p t rot(b - a) along the inward normal of the deformed chain,
/// shared equally; the gap between an end and its plate is loaded too, all of it on the end. The integers telescope as
/// in pressure.c, so the two sides press against each other with equal forces p t (distance of the plates).
///
/// Ends. Each moves vertically with its plate and is free horizontally: a force along the normal of the plate gives it
/// the plate's velocity after the kick. It acts from the plate, but does not count as a force on the sample.
///
/// Hand-over. The pressure passes from the grains of the Delaunay boundary to the chain smoothly within RAMP_WAVES wave
/// times (scree_direct_pressure), so that a sample confined directly can be wrapped at any time.
///
/// Books. Pressure in ledger.pressure; chain and ends, which are the boundary's own, as work in ledger.boundary. The
/// energy that the chain stores is the negative of the chain's part of it, up to the third order in the step.
/// Cost: O(bodies of the membrane) a step.
#include "boundary/membrane.h"

#include "base/fixed.h"
#include "boundary/boundary.h"
#include "boundary/plates.h"

#include <math.h>
#include <string.h>

#define RAMP_WAVES 4.0

static scree_status begin(const scree_model *model, scree_state *state, scree_error *error)
{
    if (state->membrane.count > 0) return SCREE_OK;
    // Without a pressure there is nothing to hand over.
    double wave = state->pressure > 0 ? scree_sample_wave_time(model, state, state->pressure) : 0;
    state->membrane.ramp_time = RAMP_WAVES * wave;
    state->membrane.share = wave > 0 ? 0 : 1;
    return scree_membrane_place(model, state, error);
}

static scree_status refresh(const scree_model *model, scree_state *state, scree_error *error)
{
    (void)model, (void)error;
    scree_membrane *membrane = &state->membrane;
    if (membrane->share < 1) membrane->share = fmin(1, membrane->share + state->step_size / membrane->ramp_time);
    return SCREE_OK;
}

static const scree_row *row_of(const scree_state *state, size_t k)
{
    return &state->row[scree_membrane_row(state, k)];
}

/// Force of the chain from body k to the next [N], and its direction; zero when slack.
static double chain_force(const scree_model *model, const scree_state *state, size_t k, double direction[2])
{
    double rest = state->membrane.rest[k];
    if (!(rest > 0)) return 0;
    const scree_row *a = row_of(state, k), *b = row_of(state, k + 1);
    double dx = b->x - a->x, dy = b->y - a->y, length = sqrt(dx * dx + dy * dy);
    direction[0] = dx / length;
    direction[1] = dy / length;
    return length > rest ? model->membrane_stiffness * (length - rest) : 0;
}

double scree_membrane_energy(const scree_model *model, const scree_state *state)
{
    double energy = 0, direction[2];
    for (size_t k = 0; k < state->membrane.count; k++) {
        double force = chain_force(model, state, k, direction);
        if (force > 0) energy += 0.5 * force * force / model->membrane_stiffness;
    }
    return energy;
}

static void add_force(scree_state *state, scree_vector *kept, size_t k, int64_t fx, int64_t fy)
{
    scree_sum_row *sum = &state->sum[scree_membrane_row(state, k)];
    sum->fx += fx;
    sum->fy += fy;
    kept[k][0] += (double)fx * state->force_quantum;
    kept[k][1] += (double)fy * state->force_quantum;
}

static void add_chain(const scree_model *model, scree_state *state)
{
    double direction[2];
    for (size_t k = 0; k < state->membrane.count; k++) {
        double force = chain_force(model, state, k, direction) / state->force_quantum;
        if (!(force > 0)) continue;
        int64_t fx = llrint(force * direction[0]), fy = llrint(force * direction[1]);
        add_force(state, state->membrane.force, k, fx, fy);
        add_force(state, state->membrane.force, k + 1, -fx, -fy);
    }
}

/// The plate of an end; -1 for the bodies between.
static int plate_of(const scree_membrane *membrane, size_t k)
{
    if (k == 0 || k + 1 == membrane->count) return SCREE_WALL_BOTTOM;
    return k + 1 == membrane->right || k == membrane->right ? SCREE_WALL_TOP : -1;
}

/// Pressure on one side: bodies [first, last], the sample on the left.
static void press_side(scree_state *state, size_t first, size_t last, double scale)
{
    const scree_row *begin = row_of(state, first), *end = row_of(state, last);
    int from = plate_of(&state->membrane, first), to = plate_of(&state->membrane, last);
    const double start[2] = {begin->x, state->wall[from].position * state->wall[from].normal[1]};
    const double finish[2] = {end->x, state->wall[to].position * state->wall[to].normal[1]};
    const double origin[2] = {row_of(state, 0)->x, row_of(state, 0)->y};
    int64_t before[2];
    for (int i = 0; i < 2; i++) before[i] = llrint((start[i] - origin[i]) * scale);
    for (size_t k = first; k <= last + 1; k++) {
        const double place[2] = {k > last ? finish[0] : row_of(state, k)->x,
                                 k > last ? finish[1] : row_of(state, k)->y};
        int64_t half[2];
        for (int i = 0; i < 2; i++) {
            int64_t now = llrint((place[i] - origin[i]) * scale);
            half[i] = now - before[i];
            before[i] = now;
        }
        add_force(state, state->membrane.press, k > first ? k - 1 : first, -half[1], half[0]);
        add_force(state, state->membrane.press, k > last ? last : k, -half[1], half[0]);
    }
}

/// Gives every end the velocity of its plate along the plate's normal.
static void hold_ends(scree_state *state)
{
    for (size_t k = 0; k < state->membrane.count; k++) {
        int plate = plate_of(&state->membrane, k);
        if (plate < 0) continue;
        const scree_wall *wall = &state->wall[plate];
        const scree_row *row = row_of(state, k);
        double force = row->mass * (wall->velocity * wall->normal[1] - row->vy) / state->step_size;
        int64_t others = state->sum[scree_membrane_row(state, k)].fy;
        add_force(state, state->membrane.force, k, 0, llrint(force / state->force_quantum) - others);
    }
}

static double half_work(const scree_state *state, scree_vector *force)
{
    double work = 0;
    for (size_t k = 0; k < state->membrane.count; k++) {
        const scree_row *row = row_of(state, k);
        work += 0.5 * state->step_size * (force[k][0] * row->vx + force[k][1] * row->vy);
    }
    return work;
}

static void book_half_work(scree_state *state)
{
    double pressure = half_work(state, state->membrane.press), chain = half_work(state, state->membrane.force);
    state->ledger.pressure += pressure;
    state->ledger.boundary += chain;
    state->ledger.turnover += fabs(pressure) + fabs(chain);
}

/// Pressure that the chain carries [Pa].
static double carried_pressure(const scree_state *state)
{
    return state->pressure - scree_direct_pressure(state);
}

static void forces(const scree_model *model, scree_state *state, scree_work *work)
{
    (void)work;
    scree_membrane *membrane = &state->membrane;
    memset(membrane->press, 0, membrane->count * sizeof *membrane->press);
    memset(membrane->force, 0, membrane->count * sizeof *membrane->force);
    double scale = 0.5 * carried_pressure(state) * model->thickness / state->force_quantum;
    press_side(state, 0, membrane->right - 1, scale);
    press_side(state, membrane->right, membrane->count - 1, scale);
    add_chain(model, state);
    hold_ends(state);
    book_half_work(state);
}

static double bound(const scree_model *model, const scree_state *state)
{
    double largest = 0, direction[2];
    for (size_t k = 0; k < state->membrane.count; k++) {
        int plate = plate_of(&state->membrane, k);
        double length = state->membrane.rest[k] + 2 * state->membrane.radius;
        double force = chain_force(model, state, k, direction);
        largest = fmax(largest, 2 * (force + state->pressure * model->thickness * length));
        if (plate < 0) continue;
        double change = fabs(state->wall[plate].velocity) + fabs(row_of(state, k)->vy);
        largest = fmax(largest, row_of(state, k)->mass * change / state->step_size);
    }
    return largest;
}

const scree_boundary scree_boundary_membrane = {.name = "membrane",
                                                .walls = 1U << SCREE_WALL_BOTTOM | 1U << SCREE_WALL_TOP,
                                                .begin = begin,
                                                .refresh = refresh,
                                                .bound = bound,
                                                .forces = forces,
                                                .work = book_half_work};
