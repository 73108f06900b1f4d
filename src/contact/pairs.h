/// The kernels: contact forces of a share of the pair list, several contacts at once.
///
/// Method. Bodies are 64-byte rows; the rows of a group of pairs are loaded whole and transposed in registers, the law
/// is evaluated in lanes, and the integer contributions are transposed back and added row by row (contact/group.h).
/// Touching pairs, which come first in the list, go through whole groups. Near pairs get the distance test alone; those
/// that touch, or did in the last step, are queued until a group is full, as are the ends of both ranges. Sums are
/// integers, so the order does not matter.
///
/// Compiled once for each dimension (pairs_2d_batch.c, pairs_3d_batch.c) and instruction set (SCREE_ISA, two,
/// four or eight lanes); inside, once for each variant, by always-inline functions that are called with constants.
/// Cost: two cache lines of bodies, two sum rows and one history row a contact; in 3D two rows of spins, two of torques
/// and a last_force row more.
#ifndef SCREE_CONTACT_PAIRS_H
#define SCREE_CONTACT_PAIRS_H

#include "base/kernel_name.h"
#include "contact/group.h"

#define PREFETCH_AHEAD 32 // pairs

/// Pairs that wait for a whole group.
enum { QUEUE_SIZE = 256 };
typedef struct queue {
    uint32_t pair[QUEUE_SIZE];
    size_t count;
} queue;

/// Row of the pair that lies farther ahead; the other one, which the list follows, is in the cache already.
SCREE_INLINE size_t row_ahead(const contact_job *job, size_t p)
{
    uint32_t first = job->first[p], second = job->second[p];
    return first > second ? first : second;
}

/// Brings the places of the pairs from p on into the cache; whole: all rows that a contact reads or adds to.
SCREE_INLINE void prefetch_bodies(int dimension, const contact_job *job, size_t p, bool whole)
{
    LANE_LOOP
    {
        size_t offset = row_ahead(job, p + (size_t)k) * 32;
        __builtin_prefetch((const char *)job->row + 2 * offset);
        if (!whole) continue;
        __builtin_prefetch((const char *)job->sum + offset, 1);
        if (dimension == 2) continue;
        __builtin_prefetch((const char *)job->turn + offset);
        __builtin_prefetch((const char *)job->torque + offset, 1);
    }
}

/// Bits of the near pairs p .. p + lanes - 1 that touch.
/// Of bodies that deform those that may touch; of laws with necks those that may have one.
SCREE_INLINE unsigned near_contacts(variant v, const contact_job *job, size_t p)
{
    const int dimension = v.dimension;
    group g;
    LANE_LOOP g.pair[k] = p + (size_t)k;
    find_bodies(job, &g);
    bodies first = load_places(dimension, job, g.first), second = load_places(dimension, job, g.second);
    // A little more: whether they do is seen later, from sums that do not depend on which is the first.
    if (law_deforms(v) || law_necks(v)) first.radius += 0x1p-40 * first.radius;
    if (law_deforms(v)) first.radius += load_reach(dimension, job, &g);
    if (law_necks(v)) first.radius += lanes_all(job->settings.number[SCREE_LAW_REACH]);
    return lanes_ones(geometry_touches(v, &first, &second));
}

/// Renews the bits of the near pairs p .. p + lanes - 1; returns those of pairs that touch or did so in the last step.
SCREE_INLINE unsigned near_renew(variant v, const contact_job *job, size_t p)
{
    unsigned now = near_contacts(v, job, p);
    uint8_t *byte = &job->near_touched[(p - job->near) / 8];
    unsigned shift = (unsigned)((p - job->near) % 8), all = (1U << SCREE_LANES) - 1;
    unsigned before = (unsigned)*byte >> shift & all;
    if (now != before) *byte = (uint8_t)((*byte & ~(all << shift)) | now << shift);
    return now | before;
}

/// Queues near pairs from p on, until the queue is full or the job's near pairs have ended; returns the next p.
SCREE_INLINE size_t queue_near(variant v, queue *q, const contact_job *job, size_t p)
{
    for (; p + SCREE_LANES <= job->range.near_end && q->count + SCREE_LANES <= QUEUE_SIZE; p += SCREE_LANES) {
        if (p + PREFETCH_AHEAD + SCREE_LANES <= job->range.near_end)
            prefetch_bodies(v.dimension, job, p + PREFETCH_AHEAD, false);
        for (unsigned bits = near_renew(v, job, p); bits; bits &= bits - 1)
            q->pair[q->count++] = (uint32_t)(p + (size_t)__builtin_ctz(bits));
    }
    if (p + SCREE_LANES > job->range.near_end)
        while (p < job->range.near_end && q->count < QUEUE_SIZE) q->pair[q->count++] = (uint32_t)p++;
    return p;
}

/// Evaluates the queued pairs; a last group that is not full repeats its first pair.
SCREE_INLINE void queue_evaluate(const queue *q, const contact_job *job, variant v, totals *t)
{
    lanes_bits number;
    LANE_LOOP number[k] = (uint64_t)k;
    for (size_t begin = 0; begin < q->count; begin += SCREE_LANES) {
        size_t left = q->count - begin;
        group g = {.present = (lanes_bits)(number < (uint64_t)left)};
        LANE_LOOP g.pair[k] = q->pair[begin + ((size_t)k < left ? (size_t)k : 0)];
        evaluate_group(job, v, &g, t);
    }
}

/// Whole groups of touching pairs; returns the first pair that is left.
SCREE_INLINE size_t evaluate_touching(const contact_job *job, variant v, totals *t)
{
    size_t p = job->range.touching_begin;
    for (; p + SCREE_LANES <= job->range.touching_end; p += SCREE_LANES) {
        if (p + PREFETCH_AHEAD + SCREE_LANES <= job->range.touching_end)
            prefetch_bodies(v.dimension, job, p + PREFETCH_AHEAD, true);
        group g = {.present = ~(lanes_bits){0}};
        LANE_LOOP g.pair[k] = p + (size_t)k;
        evaluate_group(job, v, &g, t);
    }
    return p;
}

static void totals_reduce(const totals *t, contact_totals *out)
{
    unsigned all = (1U << SCREE_LANES) - 1;
    *out = (contact_totals){.in_range = lanes_ones(t->in_range) == all, .settle = lanes_ones(t->settle) != 0};
    LANE_LOOP
    {
        out->damping += t->damping[k];
        out->friction += t->friction[k];
        out->stiffness += t->stiffness[k];
        if (t->largest_overlap[k] > out->largest_overlap) out->largest_overlap = t->largest_overlap[k];
        out->largest_deformation = fmax(out->largest_deformation, t->largest_deformation[k]);
        out->largest_gap = fmax(out->largest_gap, t->largest_gap[k]);
    }
}

/// The job is copied, so that the compiler knows that sums and histories do not overlap it.
SCREE_INLINE void run(contact_job *given, variant v)
{
    const contact_job copy = *given, *job = &copy;
    totals t = {.in_range = ~(lanes_bits){0}};
    queue q = {.count = 0};
    for (size_t p = evaluate_touching(job, v, &t); p < job->range.touching_end; p++) q.pair[q.count++] = (uint32_t)p;
    size_t p = job->range.near_begin;
    do {
        p = queue_near(v, &q, job, p);
        queue_evaluate(&q, job, v, &t);
        q.count = 0;
    } while (p < job->range.near_end);
    totals_reduce(&t, &given->totals);
}

#define DEFORMS(law, option) law##_traits[option].deforms

/// `run` with a variant as a constant, as a function of its own: one that held them all would be too large for some
/// of the compiler's optimisations. Moments are summed by the kernels for many materials alone; always where bodies
/// deform. Of geometries in lanes there is one, the first of the table; one by one none is here.
#define VARIANT(name, dimension, law, option, many_materials)                                                          \
    static __attribute__((noinline)) void name(contact_job *job)                                                       \
    {                                                                                                                  \
        if (DEFORMS(law, option) || (many_materials && job->variant.moments))                                          \
            run(job, (variant){dimension, SCREE_SLOT_##law, option, many_materials, true, IN_LANES});                  \
        else                                                                                                           \
            run(job, (variant){dimension, SCREE_SLOT_##law, option, many_materials, false, IN_LANES});                 \
    }

/// The geometry that kernels in lanes are for.
enum { IN_LANES = 0 };

/// How many materials a kernel is for, as the rows of laws say it.
enum { OF_one = 0, OF_many = 1 };
enum { MOST_OPTIONS = 6 };

#define PAIRS_2D_KERNEL(law, option, materials)                                                                        \
    VARIANT(pairs_2d_##law##_##option##_##materials, 2, law, option, OF_##materials)
#define PAIRS_3D_KERNEL(law, option, materials)                                                                        \
    VARIANT(pairs_3d_##law##_##option##_##materials, 3, law, option, OF_##materials)
#define PAIRS_2D_ENTRY(law, option, materials)                                                                         \
    [SCREE_SLOT_##law][option][OF_##materials] = pairs_2d_##law##_##option##_##materials,
#define PAIRS_3D_ENTRY(law, option, materials)                                                                         \
    [SCREE_SLOT_##law][option][OF_##materials] = pairs_3d_##law##_##option##_##materials,
#define PAIRS_2D_KERNELS(law) law##_KERNELS(PAIRS_2D_KERNEL)
#define PAIRS_3D_KERNELS(law) law##_KERNELS(PAIRS_3D_KERNEL)
#define PAIRS_2D_ENTRIES(law) law##_KERNELS(PAIRS_2D_ENTRY)
#define PAIRS_3D_ENTRIES(law) law##_KERNELS(PAIRS_3D_ENTRY)

/// The kernel of a dimension. One for many materials serves a single one, too.
#define PAIRS_KERNEL(name, NAME)                                                                                       \
    SCREE_LAWS(NAME##_KERNELS)                                                                                         \
    void SCREE_KERNEL_NAME(scree_##name)(contact_job * job)                                                            \
    {                                                                                                                  \
        static contact_kernel *const kernels[SCREE_MODULE_COUNT][MOST_OPTIONS][2] = {SCREE_LAWS(NAME##_ENTRIES)};      \
        const variant *v = &job->variant;                                                                              \
        contact_kernel *const *kernel = kernels[v->law][v->option];                                                    \
        const bool many = v->many_materials || (v->moments && !law_deforms(*v)) || !kernel[OF_one];                    \
        kernel[many ? OF_many : OF_one](job);                                                                          \
    }

#endif
