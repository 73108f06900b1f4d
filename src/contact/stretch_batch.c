/// The kernels of bodies that deform. Rows are loaded whole and transposed in registers, as by those of contacts; the
/// last group repeats the last body and does not store it again. All instruction sets give the same bits. Cost: 30
/// instructions a disc (v3).
#include "contact/stretch_batch.h"

#include "base/kernel_name.h"
#include "contact/rows.h"

/// Tensors have xx, yy, xy; xx, yy, zz, yz, xz, xy.
SCREE_INLINE int tensor_size(int d)
{
    return d == 3 ? 6 : 3;
}

/// a : b
SCREE_INLINE lanes tensor_product(int d, const lanes a[6], const lanes b[6])
{
    lanes diagonal = a[0] * b[0] + a[1] * b[1];
    if (d == 2) return diagonal + 2 * (a[2] * b[2]);
    return diagonal + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// 64-bit integers as doubles, rounded once: by the processor where it can, else halves in the low bits of 2^52 and
/// 2^84.
SCREE_INLINE lanes lanes_of_integers(lanes_bits a)
{
#if SCREE_LANES == 8 && defined(__AVX512DQ__)
    return (lanes)_mm512_cvtepi64_pd((__m512i)a);
#else
    const uint64_t low = UINT64_C(0x4330000000000000), high = UINT64_C(0x4530000080000000);
    lanes upper = lanes_as_double((a >> 32) ^ high);
    return (upper - (0x1p84 + 0x1p63 + 0x1p52)) + lanes_as_double((a & UINT64_C(0xffffffff)) | low);
#endif
}

/// Bodies of a group, one a lane.
typedef struct bodies_of_group {
    size_t row[SCREE_LANES];
    size_t count; ///< that are stored
} bodies_of_group;

/// Piece `number`, of four, of rows with `width` numbers of 8 bytes.
SCREE_INLINE columns load_piece(const void *from, size_t width, const bodies_of_group *g, size_t number)
{
    const double *position[SCREE_LANES];
    LANE_LOOP position[k] = (const double *)from + width * g->row[k] + 4 * number;
    return columns_load(position);
}

SCREE_INLINE void store_piece(double *to, size_t width, const bodies_of_group *g, size_t number, lanes a, lanes b,
                              lanes c, lanes d)
{
    row4 row[SCREE_LANES];
    columns_to_rows((columns){a, b, c, d}, row);
    if (g->count == SCREE_LANES) {
        LANE_LOOP *(row4 *)(to + width * g->row[k] + 4 * number) = row[k];
        return;
    }
    for (size_t k = 0; k < g->count; k++) *(row4 *)(to + width * g->row[k] + 4 * number) = row[k];
}

SCREE_INLINE lanes integers(lanes column)
{
    return lanes_of_integers(lanes_as_bits(column));
}

/// Symmetric part of the moments over the radius, in force quanta.
SCREE_INLINE void load_forces(int d, const scree_state *state, const bodies_of_group *g, lanes force[6])
{
    columns a = load_piece(state->moment, scree_moment_size(d), g, 0);
    force[0] = integers(a.c0);
    if (d == 2) {
        force[1] = integers(a.c3);
        force[2] = 0.5 * (integers(a.c1) + integers(a.c2));
        return;
    }
    columns b = load_piece(state->moment, scree_moment_size(d), g, 1);
    columns c = load_piece(state->moment, scree_moment_size(d), g, 2);
    force[1] = integers(b.c0);
    force[2] = integers(c.c0);
    force[3] = 0.5 * (integers(b.c1) + integers(b.c3));
    force[4] = 0.5 * (integers(a.c2) + integers(b.c2));
    force[5] = 0.5 * (integers(a.c1) + integers(a.c3));
}

/// changes: those of the last step.
SCREE_INLINE void load_stretch(int d, const scree_state *state, const bodies_of_group *g, bool changes, lanes tensor[6])
{
    const size_t pieces = scree_stretch_size(d) / 8, first = changes ? pieces : 0;
    columns a = load_piece(state->stretch, scree_stretch_size(d), g, first);
    tensor[0] = a.c0, tensor[1] = a.c1, tensor[2] = a.c2;
    if (d == 2) return;
    columns b = load_piece(state->stretch, scree_stretch_size(d), g, first + 1);
    tensor[3] = b.c0, tensor[4] = b.c1, tensor[5] = b.c2;
}

SCREE_INLINE void store_stretch(int d, const scree_state *state, const bodies_of_group *g, bool changes,
                                const lanes tensor[6], lanes reach)
{
    const size_t pieces = scree_stretch_size(d) / 8, first = changes ? pieces : 0;
    store_piece(state->stretch, scree_stretch_size(d), g, first, tensor[0], tensor[1], tensor[2], reach);
    if (d == 2) return;
    store_piece(state->stretch, scree_stretch_size(d), g, first + 1, tensor[3], tensor[4], tensor[5], lanes_all(0));
}

/// Compliance of each, times the quantum over V / R^2.
SCREE_INLINE void load_compliance(int d, const stretch_job *job, const bodies_of_group *g, lanes *shear, lanes *trace)
{
    *shear = lanes_all(job->by[0].shear), *trace = lanes_all(job->by[0].trace);
    if (!job->alike) LANE_LOOP
        {
            const size_t row = g->row[k];
            const double of = d == 3 ? job->state->turn[row].material : job->state->row[row].material;
            (*shear)[k] = job->by[(int)of].shear;
            (*trace)[k] = job->by[(int)of].trace;
        }
    if (d == 2) return;
    lanes radius = lanes_all(1);
    LANE_LOOP radius[k] = job->state->row[g->row[k]].radius;
    const lanes inverse = 1.0 / (4 * M_PI / 3 * radius);
    *shear *= inverse;
    *trace *= inverse;
}

/// Largest eigenvalue of a tensor, or more, and at least zero: the mean of its diagonal and what it deviates by; in the
/// plane, where it is exact, with a bound of that root, at most 8.3 % above it, since roots take a quarter of the pass.
SCREE_INLINE lanes largest_eigenvalue(int d, const lanes tensor[6])
{
    if (d == 2) {
        const lanes half = lanes_abs(0.5 * (tensor[0] - tensor[1])), shear = lanes_abs(tensor[2]);
        const lanes most = lanes_at_least(half, shear), least = lanes_at_most(half, shear);
        const lanes root = most + (M_SQRT2 - 1) * least; // at least sqrt(half^2 + shear^2), which is convex
        return lanes_at_least(0.5 * (tensor[0] + tensor[1]) + root, lanes_all(0));
    }
    lanes part[6];
    const lanes mean = (tensor[0] + tensor[1] + tensor[2]) * (1.0 / 3);
    for (int k = 0; k < 6; k++) part[k] = k < 3 ? tensor[k] - mean : tensor[k];
    return lanes_at_least(mean + lanes_root(tensor_product(3, part, part) * (2.0 / 3)), lanes_all(0));
}

/// Bodies from `row` on; whole: as many as there are lanes.
SCREE_INLINE bodies_of_group group_at(const stretch_job *job, size_t row, bool whole)
{
    bodies_of_group g = {.count = whole ? SCREE_LANES : job->end - row};
    LANE_LOOP g.row[k] = whole || (size_t)k < g.count ? row + (size_t)k : job->end - 1;
    return g;
}

SCREE_INLINE lanes load_terms(const stretch_job *job, const bodies_of_group *g)
{
    lanes term = lanes_all(0);
    if (g->count == SCREE_LANES)
        memcpy(&term, job->term + g->row[0], sizeof term);
    else
        for (size_t k = 0; k < g->count; k++) term[k] = job->term[g->row[k]];
    return term;
}

SCREE_INLINE void store_terms(const stretch_job *job, const bodies_of_group *g, lanes term)
{
    if (g->count == SCREE_LANES)
        memcpy(job->term + g->row[0], &term, sizeof term);
    else
        for (size_t k = 0; k < g->count; k++) job->term[g->row[k]] = term[k];
}

static double largest_lane(lanes a)
{
    double largest = 0;
    LANE_LOOP largest = a[k] > largest ? a[k] : largest;
    return largest;
}

/// What groups have found, lane by lane.
typedef struct found {
    lanes reach, square, term;
    lanes_bits numbers; ///< mask: no square that is not a number
} found;

SCREE_INLINE void stretch_group(int d, const stretch_job *job, bodies_of_group g, found *all)
{
    const scree_state *state = job->state;
    const double theta = job->theta, half = 0.5 * state->force_quantum;
    lanes force[6], stretch[6], change[6], shear, trace;
    load_forces(d, state, &g, force);
    load_stretch(d, state, &g, false, stretch);
    load_compliance(d, job, &g, &shear, &trace);
    lanes sum = force[0] + force[1];
    if (d == 3) sum += force[2];
    sum *= trace;
    for (int k = 0; k < tensor_size(d); k++) {
        const lanes wanted = k < d ? shear * force[k] + sum : shear * force[k];
        const lanes next = theta == 1 ? wanted : stretch[k] + theta * (wanted - stretch[k]);
        change[k] = next - stretch[k];
        stretch[k] = next;
    }
    const lanes out = largest_eigenvalue(d, stretch), size = tensor_product(d, change, change);
    store_stretch(d, state, &g, false, stretch, out);
    store_stretch(d, state, &g, true, change, lanes_all(0));
    store_terms(job, &g, half * tensor_product(d, force, change));
    all->reach = lanes_at_least(all->reach, out);
    all->square = lanes_at_least(all->square, size);
    all->numbers &= lanes_at_or_below(size, lanes_all(INFINITY));
}

SCREE_INLINE void settle_group(int d, const stretch_job *job, bodies_of_group g, found *all)
{
    const scree_state *state = job->state;
    lanes force[6], change[6];
    load_forces(d, state, &g, force);
    load_stretch(d, state, &g, true, change);
    const lanes term = load_terms(job, &g) + 0.5 * state->force_quantum * tensor_product(d, force, change);
    store_terms(job, &g, term);
    all->term = lanes_at_least(all->term, lanes_abs(term));
}

SCREE_INLINE stretch_extremes run(int d, bool settles, const stretch_job *given)
{
    // A copy, so that the compiler knows that nothing overlaps it.
    const stretch_job copy = *given, *job = &copy;
    found all = {lanes_all(0), lanes_all(0), lanes_all(0), ~(lanes_bits){0}};
    size_t row = job->begin;
    for (; row + SCREE_LANES <= job->end; row += SCREE_LANES)
        if (settles)
            settle_group(d, job, group_at(job, row, true), &all);
        else
            stretch_group(d, job, group_at(job, row, true), &all);
    if (row < job->end && settles) settle_group(d, job, group_at(job, row, false), &all);
    if (row < job->end && !settles) stretch_group(d, job, group_at(job, row, false), &all);
    const bool numbers = lanes_ones(all.numbers) == (1U << SCREE_LANES) - 1;
    return (stretch_extremes){.reach = largest_lane(all.reach),
                              .square = numbers ? largest_lane(all.square) : INFINITY,
                              .term = largest_lane(all.term)};
}

stretch_extremes SCREE_KERNEL_NAME(stretch_bodies)(const stretch_job *job)
{
    return job->state->dimension == 3 ? run(3, false, job) : run(2, false, job);
}

stretch_extremes SCREE_KERNEL_NAME(stretch_settle)(const stretch_job *job)
{
    return job->state->dimension == 3 ? run(3, true, job) : run(2, true, job);
}
