/// The kernel: contact forces of a share of the pair list, several contacts at once.
///
/// Method. Bodies are 64-byte rows; the rows of a group of pairs are loaded whole and transposed in registers, the law
/// is evaluated in lanes, and the integer contributions are transposed back and added row by row. Touching pairs, which
/// come first in the list, go through whole groups. Near pairs get the distance test alone; those that touch, or did in
/// the last step, are queued until a group is full, as are the ends of both ranges. Sums are integers, so the order
/// does not matter.
///
/// Compiled once for each instruction set (SCREE_ISA, two, four or eight lanes); inside, once for each combination of
/// law, one or many materials, and ledger, by always-inline functions that are called with constants. Cost: two cache
/// lines of bodies, two sum rows and one history row a contact.
#include "contact/evaluate.h"
#include "contact/rows.h"

#define LANE_LOOP      _Pragma("GCC unroll 8") for (int k = 0; k < SCREE_LANES; k++)
#define PREFETCH_AHEAD 64 // pairs

/// What a kernel is specialised by: constants wherever it is used.
typedef struct variant {
    scree_law law;
    bool many_materials, ledger;
} variant;

/// Pairs of one group. Where there are fewer than lanes, the first is repeated with `present` clear.
typedef struct group {
    size_t pair[SCREE_LANES];
    lanes_bits present;
} group;

/// Running totals in lanes.
typedef struct totals {
    lanes_bits damping, friction, stiffness, in_range;
    lanes largest_overlap;
} totals;

/// Half of the body rows of a group: position, material, radius, or (half = 4) velocity, spin, mass.
SCREE_INLINE columns load_bodies(const contact_job *job, const uint32_t *body, const group *g, int half)
{
    const double *row[SCREE_LANES];
    LANE_LOOP row[k] = &job->row[body[g->pair[k]]].x + half;
    return columns_load(row);
}

SCREE_INLINE law_constants load_constants(const contact_job *job, bool many_materials, lanes first, lanes second)
{
    const scree_pair_constants *same = &job->model->pairs[0][0];
    if (!many_materials)
        return (law_constants){lanes_all(same->normal_stiffness), lanes_all(same->tangential_stiffness),
                               lanes_all(same->friction), lanes_all(same->damping)};
    const double *row[SCREE_LANES];
    LANE_LOOP row[k] = &job->model->pairs[(int)first[k]][(int)second[k]].normal_stiffness;
    columns c = columns_load(row);
    return (law_constants){c.c0, c.c1, c.c2, c.c3};
}

SCREE_INLINE law_memory load_history(const contact_job *job, const group *g)
{
    const double *row[SCREE_LANES];
    LANE_LOOP row[k] = job->history[g->pair[k]].value;
    columns c = columns_load(row);
    return (law_memory){{lanes_keep(g->present, c.c0), lanes_keep(g->present, c.c1), lanes_keep(g->present, c.c2),
                         lanes_keep(g->present, c.c3)}};
}

/// Last lane first, so that the first pair wins over its repetitions.
SCREE_INLINE void store_history(const contact_job *job, const group *g, const law_memory *m)
{
    row4 row[SCREE_LANES];
    columns_to_rows((columns){m->value[0], m->value[1], m->value[2], m->value[3]}, row);
    LANE_LOOP *(row4 *)job->history[g->pair[SCREE_LANES - 1 - k]].value = row[SCREE_LANES - 1 - k];
}

SCREE_INLINE foresight load_foreseen(const contact_job *job, const uint32_t *body, const group *g)
{
    const double *row[SCREE_LANES];
    LANE_LOOP row[k] = &job->foreseen[body[g->pair[k]]].vx;
    columns c = columns_load(row);
    return (foresight){c.c0, c.c1, c.c2, c.c3};
}

SCREE_INLINE void add_to_sums(const contact_job *job, const uint32_t *body, const group *g, lanes_bits fx,
                              lanes_bits fy, lanes_bits torque, lanes_bits count)
{
    row4 row[SCREE_LANES];
    columns_to_rows(
        (columns){lanes_as_double(fx), lanes_as_double(fy), lanes_as_double(torque), lanes_as_double(count)}, row);
    LANE_LOOP *(row4_bits *)&job->sum[body[g->pair[k]]] += (row4_bits)row[k];
}

SCREE_INLINE void evaluate_group(const contact_job *job, variant v, const group *g, totals *t)
{
    columns place1 = load_bodies(job, job->first, g, 0), place2 = load_bodies(job, job->second, g, 0);
    columns move1 = load_bodies(job, job->first, g, 4), move2 = load_bodies(job, job->second, g, 4);
    bodies first = {place1.c0, place1.c1, place1.c2, place1.c3, move1.c0, move1.c1, move1.c2, move1.c3};
    bodies second = {place2.c0, place2.c1, place2.c2, place2.c3, move2.c0, move2.c1, move2.c2, move2.c3};
    lanes_bits touching =
        g->present & bodies_touch(first.x - second.x, first.y - second.y, first.radius + second.radius);
    motion m = motion_of_pair(&first, &second, job->settings.step);
    if (law_foresees(v.law)) {
        foresight ahead1 = load_foreseen(job, job->first, g), ahead2 = load_foreseen(job, job->second, g);
        motion_foresee(&m, &first, &ahead1, &second, &ahead2);
    }
    law_constants constants = load_constants(job, v.many_materials, first.material, second.material);

    law_memory before = {0}, after;
    if (law_remembers(v.law, v.ledger)) before = load_history(job, g);
    contact_quanta q =
        contact_evaluate(v.law, v.ledger, &constants, &job->settings, &job->scale, &m, touching, &before, &after);
    if (!v.ledger) after.value[1] = after.value[2] = after.value[3] = lanes_all(0);
    if (law_remembers(v.law, v.ledger)) store_history(job, g, &after);

    add_to_sums(job, job->first, g, q.fx, q.fy, q.torque_first, q.count);
    add_to_sums(job, job->second, g, -q.fx, -q.fy, q.torque_second, q.count);
    t->in_range &= q.in_range;
    t->largest_overlap = lanes_at_least(t->largest_overlap, lanes_keep(touching, m.indentation));
    t->damping += q.damping;
    t->friction += q.friction;
    t->stiffness += q.stiffness;
}

/// Pairs that wait for a whole group.
enum { QUEUE_SIZE = 256 };
typedef struct queue {
    uint32_t pair[QUEUE_SIZE];
    size_t count;
} queue;

/// Brings the bodies of the pairs from p on into the cache.
SCREE_INLINE void prefetch_bodies(const contact_job *job, size_t p)
{
    LANE_LOOP
    {
        __builtin_prefetch(&job->row[job->second[p + (size_t)k]]);
        __builtin_prefetch(&job->sum[job->second[p + (size_t)k]], 1);
    }
}

/// Bits of the near pairs p .. p + lanes - 1 that touch.
SCREE_INLINE unsigned near_contacts(const contact_job *job, size_t p)
{
    group g;
    LANE_LOOP g.pair[k] = p + (size_t)k;
    columns first = load_bodies(job, job->first, &g, 0), second = load_bodies(job, job->second, &g, 0);
    return lanes_ones(bodies_touch(first.c0 - second.c0, first.c1 - second.c1, first.c3 + second.c3));
}

/// Renews the bits of the near pairs p .. p + lanes - 1; returns those of pairs that touch or did so in the last step.
SCREE_INLINE unsigned near_renew(const contact_job *job, size_t p)
{
    unsigned now = near_contacts(job, p);
    uint8_t *byte = &job->near_touched[(p - job->near) / 8];
    unsigned shift = (unsigned)((p - job->near) % 8), all = (1U << SCREE_LANES) - 1;
    unsigned before = (unsigned)*byte >> shift & all;
    if (now != before) *byte = (uint8_t)((*byte & ~(all << shift)) | now << shift);
    return now | before;
}

/// Queues near pairs from p on, until the queue is full or the job's near pairs have ended; returns the next p.
SCREE_INLINE size_t queue_near(queue *q, const contact_job *job, size_t p)
{
    for (; p + SCREE_LANES <= job->near_end && q->count + SCREE_LANES <= QUEUE_SIZE; p += SCREE_LANES) {
        if (p + PREFETCH_AHEAD + SCREE_LANES <= job->near_end) prefetch_bodies(job, p + PREFETCH_AHEAD);
        for (unsigned bits = near_renew(job, p); bits; bits &= bits - 1)
            q->pair[q->count++] = (uint32_t)(p + (size_t)__builtin_ctz(bits));
    }
    if (p + SCREE_LANES > job->near_end)
        while (p < job->near_end && q->count < QUEUE_SIZE) q->pair[q->count++] = (uint32_t)p++;
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
    size_t p = job->touching_begin;
    for (; p + SCREE_LANES <= job->touching_end; p += SCREE_LANES) {
        if (p + PREFETCH_AHEAD + SCREE_LANES <= job->touching_end) prefetch_bodies(job, p + PREFETCH_AHEAD);
        group g = {.present = ~(lanes_bits){0}};
        LANE_LOOP g.pair[k] = p + (size_t)k;
        evaluate_group(job, v, &g, t);
    }
    return p;
}

static void totals_reduce(const totals *t, contact_totals *out)
{
    unsigned all = (1U << SCREE_LANES) - 1;
    *out = (contact_totals){.in_range = lanes_ones(t->in_range) == all};
    LANE_LOOP
    {
        out->damping += t->damping[k];
        out->friction += t->friction[k];
        out->stiffness += t->stiffness[k];
        if (t->largest_overlap[k] > out->largest_overlap) out->largest_overlap = t->largest_overlap[k];
    }
}

/// The job is copied, so that the compiler knows that sums and histories do not overlap it.
SCREE_INLINE void run(contact_job *given, variant v)
{
    const contact_job copy = *given, *job = &copy;
    totals t = {.in_range = ~(lanes_bits){0}};
    queue q = {.count = 0};
    for (size_t p = evaluate_touching(job, v, &t); p < job->touching_end; p++) q.pair[q.count++] = (uint32_t)p;
    size_t p = job->near_begin;
    do {
        p = queue_near(&q, job, p);
        queue_evaluate(&q, job, v, &t);
        q.count = 0;
    } while (p < job->near_end);
    totals_reduce(&t, &given->totals);
}

#define PASTE(a, b)      a##b
#define KERNEL_NAME(isa) PASTE(scree_pairs_batch_v, isa)

#define RUN_ONE_OF(law, many, ledger)                                                                                  \
    do {                                                                                                               \
        if ((many) && (ledger))                                                                                        \
            run(job, (variant){law, true, true});                                                                      \
        else if (many)                                                                                                 \
            run(job, (variant){law, true, false});                                                                     \
        else if (ledger)                                                                                               \
            run(job, (variant){law, false, true});                                                                     \
        else                                                                                                           \
            run(job, (variant){law, false, false});                                                                    \
    } while (0)

void KERNEL_NAME(SCREE_ISA)(contact_job *job)
{
    bool many = job->model->material_count > 1;
    switch (job->model->law) {
    case SCREE_LAW_HERTZ_MINDLIN:
        RUN_ONE_OF(SCREE_LAW_HERTZ_MINDLIN, many, job->ledger);
        break;
    case SCREE_LAW_HERTZ_BRILLIANTOV:
        RUN_ONE_OF(SCREE_LAW_HERTZ_BRILLIANTOV, many, job->ledger);
        break;
    case SCREE_LAW_HERTZ_BRILLIANTOV_IMPLICIT:
        RUN_ONE_OF(SCREE_LAW_HERTZ_BRILLIANTOV_IMPLICIT, many, job->ledger);
        break;
    }
}
