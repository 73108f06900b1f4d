/// A group of pairs, one a lane: loads of the rows that they name, and what is written back. Only for kernels.
#ifndef SCREE_CONTACT_GROUP_H
#define SCREE_CONTACT_GROUP_H

#include "contact/evaluate.h"
#include "contact/rows.h"

/// Pairs of one group. Where there are fewer than lanes, the first is repeated with `present` clear. All rows of a body
/// but its 64-byte row have 32 bytes, so that one offset finds them.
typedef struct group {
    size_t pair[SCREE_LANES];
    size_t first[SCREE_LANES], second[SCREE_LANES]; ///< bytes
    lanes_bits present;
    const struct outlines_found *found; ///< of geometries that find it pair by pair
} group;

SCREE_INLINE void find_bodies(const contact_job *job, group *g)
{
    LANE_LOOP g->first[k] = (size_t)job->first[g->pair[k]] * 32;
    LANE_LOOP g->second[k] = (size_t)job->second[g->pair[k]] * 32;
}

/// Running totals in lanes.
typedef struct totals {
    lanes_bits damping, friction, stiffness, in_range, settle;
    lanes largest_overlap, largest_deformation, largest_gap;
} totals;

/// Half of the body rows of a group, from number `half` on.
SCREE_INLINE columns load_rows(const contact_job *job, const size_t offset[SCREE_LANES], int half)
{
    const double *row[SCREE_LANES];
    LANE_LOOP row[k] = (const double *)(const void *)((const char *)job->row + 2 * offset[k]) + half;
    return columns_load(row);
}

SCREE_INLINE columns load_turns(const contact_job *job, const size_t offset[SCREE_LANES])
{
    const double *row[SCREE_LANES];
    LANE_LOOP row[k] = (const double *)(const void *)((const char *)job->turn + offset[k]);
    return columns_load(row);
}

/// of: rows of all bodies.
SCREE_INLINE prediction load_predicted(int dimension, const scree_predicted *of, const uint32_t *body, const group *g)
{
    const double *row[SCREE_LANES];
    LANE_LOOP row[k] = &of[body[g->pair[k]]].vx;
    columns c = columns_load(row);
    prediction ahead = {.velocity = {c.c0, c.c1, c.c2}, .contacts = c.c3};
    ahead.spin.x = c.c2;
    if (dimension == 2) return ahead;
    LANE_LOOP row[k] += 4;
    c = columns_load(row);
    ahead.spin = (vector){c.c0, c.c1, c.c2};
    return ahead;
}

/// Position and radius.
SCREE_INLINE bodies load_places(int dimension, const contact_job *job, const size_t offset[SCREE_LANES])
{
    columns position = load_rows(job, offset, 0);
    bodies b = {.position = {position.c0, position.c1, position.c2}};
    b.radius = position.c3;
    if (dimension == 2) b.material = position.c2;
    return b;
}

SCREE_INLINE void load_motions(int dimension, const contact_job *job, const size_t offset[SCREE_LANES], bodies *b)
{
    columns move = load_rows(job, offset, 4);
    b->velocity = (vector){move.c0, move.c1, move.c2};
    b->mass = move.c3;
    if (dimension == 2) b->spin.x = move.c2;
}

SCREE_INLINE void load_spins(int dimension, const contact_job *job, const size_t offset[SCREE_LANES], bodies *b)
{
    if (dimension == 2) return;
    columns turn = load_turns(job, offset);
    b->spin = (vector){turn.c0, turn.c1, turn.c2};
    b->material = turn.c3;
}

/// Piece `number`, of four numbers, of the sum of the rows of both bodies' stretches: added before they are
/// transposed, which so is done once.
SCREE_INLINE columns load_stretch_piece(int dimension, const contact_job *job, const group *g, int number)
{
    const size_t times = dimension == 3 ? 4 : 2;
    const char *from = (const char *)job->stretch + 32 * number;
    row4 row[SCREE_LANES];
    LANE_LOOP row[k] = *(const row4 *)(const void *)(from + times * g->first[k]) +
                       *(const row4 *)(const void *)(from + times * g->second[k]);
    return columns_of_rows(row);
}

/// What is in the place of the reach is the sum of both.
SCREE_INLINE lanes load_reach(int dimension, const contact_job *job, const group *g)
{
    return load_stretch_piece(dimension, job, g, 0).c3;
}

/// Pieces 2 `number` and the one behind it: of eight lanes a whole row of the cache at once.
SCREE_INLINE void load_stretch_pieces(int dimension, const contact_job *job, const group *g, int number,
                                      columns piece[2])
{
#if SCREE_LANES == 8
    const size_t times = dimension == 3 ? 4 : 2;
    const char *from = (const char *)job->stretch + 64 * number;
    row8 row[SCREE_LANES];
    LANE_LOOP row[k] = *(const row8 *)(const void *)(from + times * g->first[k]) +
                       *(const row8 *)(const void *)(from + times * g->second[k]);
    columns_of_long_rows(row, piece);
#else
    for (int k = 0; k < 2; k++) piece[k] = load_stretch_piece(dimension, job, g, 2 * number + k);
#endif
}

SCREE_INLINE void put_columns(lanes tensor[3], columns c)
{
    tensor[0] = c.c0, tensor[1] = c.c1, tensor[2] = c.c2;
}

SCREE_INLINE stretch load_stretches(int dimension, const contact_job *job, const group *g)
{
    stretch both;
    columns piece[4];
    for (int k = 0; k < dimension - 1; k++) load_stretch_pieces(dimension, job, g, k, piece + 2 * k);
    const columns *change = piece + dimension - 1;
    put_columns(both.now, piece[0]);
    put_columns(both.change, change[0]);
    if (dimension == 2) return both;
    put_columns(both.now + 3, piece[1]);
    put_columns(both.change + 3, change[1]);
    return both;
}

SCREE_INLINE law_constants load_constants(const contact_job *job, variant v, lanes first, lanes second)
{
    law_constants constants = {0};
    const int count = law_is_wide(v) ? 8 : 4;
    if (!v.many_materials) {
        for (int k = 0; k < count; k++) constants.value[k] = lanes_all(job->pairs[0][0].value[k]);
        return constants;
    }
    const double *row[SCREE_LANES];
    LANE_LOOP row[k] = job->pairs[(int)first[k]][(int)second[k]].value;
    columns c = columns_load(row);
    constants = (law_constants){.value = {c.c0, c.c1, c.c2, c.c3}};
    if (!law_is_wide(v)) return constants;
    LANE_LOOP row[k] += 4;
    columns more = columns_load(row);
    return (law_constants){.value = {c.c0, c.c1, c.c2, c.c3, more.c0, more.c1, more.c2, more.c3}};
}

/// What a pair that is held has of its own.
SCREE_INLINE void load_own(const contact_job *job, const group *g, law_constants *constants)
{
    const double *row[SCREE_LANES];
    LANE_LOOP row[k] = job->own[g->pair[k]].value;
    columns c = columns_load(row);
    constants->own[0] = c.c0, constants->own[1] = c.c1, constants->own[2] = c.c2, constants->own[3] = c.c3;
}

SCREE_INLINE void keep_columns(lanes value[4], lanes_bits present, columns c)
{
    value[0] = lanes_keep(present, c.c0);
    value[1] = lanes_keep(present, c.c1);
    value[2] = lanes_keep(present, c.c2);
    value[3] = lanes_keep(present, c.c3);
}

/// Zero where a pair is not present.
SCREE_INLINE law_memory load_memory(const contact_job *job, variant v, const group *g)
{
    law_memory m = {0};
    const double *row[SCREE_LANES];
    const float *single[SCREE_LANES];
    LANE_LOOP row[k] = job->history[g->pair[k]].value;
    keep_columns(m.value, g->present, columns_load(row));
    if (law_keeps_last_force(v)) {
        LANE_LOOP single[k] = job->last_force[g->pair[k]].value;
        keep_columns(m.last, g->present, columns_load_single(single));
    }
    if (law_rolls(v)) {
        LANE_LOOP row[k] = job->rolling[g->pair[k]].value;
        keep_columns(m.rolling, g->present, columns_load(row));
        LANE_LOOP single[k] = job->rolling[g->pair[k]].last;
        keep_columns(m.rolling_last, g->present, columns_load_single(single));
    }
    return m;
}

/// Last lane first, so that the first pair wins over its repetitions.
SCREE_INLINE void store_memory(const contact_job *job, variant v, const group *g, const law_memory *m)
{
    row4 row[SCREE_LANES];
    columns_to_rows((columns){m->value[0], m->value[1], m->value[2], m->value[3]}, row);
    LANE_LOOP *(row4 *)job->history[g->pair[SCREE_LANES - 1 - k]].value = row[SCREE_LANES - 1 - k];
    if (law_keeps_last_force(v)) {
        columns_to_rows((columns){m->last[0], m->last[1], m->last[2], m->last[3]}, row);
        LANE_LOOP *(row4_single *)job->last_force[g->pair[SCREE_LANES - 1 - k]].value =
            __builtin_convertvector(row[SCREE_LANES - 1 - k], row4_single);
    }
    if (law_rolls(v)) {
        columns_to_rows((columns){m->rolling[0], m->rolling[1], m->rolling[2], m->rolling[3]}, row);
        LANE_LOOP *(row4 *)job->rolling[g->pair[SCREE_LANES - 1 - k]].value = row[SCREE_LANES - 1 - k];
        const lanes *last = m->rolling_last;
        columns_to_rows((columns){last[0], last[1], last[2], last[3]}, row);
        LANE_LOOP *(row4_single *)job->rolling[g->pair[SCREE_LANES - 1 - k]].last =
            __builtin_convertvector(row[SCREE_LANES - 1 - k], row4_single);
    }
}

SCREE_INLINE void rows_of_bits(lanes_bits a, lanes_bits b, lanes_bits c, lanes_bits d, row4 row[SCREE_LANES])
{
    columns_to_rows((columns){lanes_as_double(a), lanes_as_double(b), lanes_as_double(c), lanes_as_double(d)}, row);
}

/// 2D: force, torque and count in one row; 3D: the torque in its own.
SCREE_INLINE void add_to_sums(int dimension, const contact_job *job, const size_t offset[SCREE_LANES], quanta force,
                              quanta torque, lanes_bits count)
{
    row4 row[SCREE_LANES];
    rows_of_bits(force.x, force.y, dimension == 3 ? force.z : torque.x, count, row);
    LANE_LOOP *(row4_bits *)(void *)((char *)job->sum + offset[k]) += (row4_bits)row[k];
    if (dimension == 2) return;
    rows_of_bits(torque.x, torque.y, torque.z, (lanes_bits){0}, row);
    LANE_LOOP *(row4_bits *)(void *)((char *)job->torque + offset[k]) += (row4_bits)row[k];
}

/// To one body of each pair; to `other` as well, unless it is NULL.
SCREE_INLINE void add_moments(int dimension, const contact_job *job, const size_t offset[SCREE_LANES],
                              const size_t other[SCREE_LANES], vector along, lanes factor, vector force)
{
    lanes_bits moment[12] = {{0}};
    row4 row[SCREE_LANES];
    contact_moments(dimension, along, factor, force, moment);
    const int rows = dimension == 3 ? SCREE_MOMENTS_3D / 4 : SCREE_MOMENTS_2D / 4;
    for (int r = 0; r < rows; r++) {
        char *to = (char *)job->moment + 32 * (size_t)r;
        rows_of_bits(moment[4 * r], moment[4 * r + 1], moment[4 * r + 2], moment[4 * r + 3], row);
        LANE_LOOP *(row4_bits *)(void *)(to + (size_t)rows * offset[k]) += (row4_bits)row[k];
        if (!other) continue;
        LANE_LOOP *(row4_bits *)(void *)(to + (size_t)rows * other[k]) += (row4_bits)row[k];
    }
}

SCREE_INLINE void add_moments_of_pair(variant v, const contact_job *job, const group *g, const kinematics *m,
                                      vector force)
{
    const bool deforms = law_deforms(v);
    const contact_branch first = contact_branch_of(v, m, true), second = contact_branch_of(v, m, false);
    const lanes factor = contact_moment_factor(deforms, &job->scale, first.arm);
    add_moments(v.dimension, job, g->first, deforms ? g->second : NULL, first.along, factor, force);
    if (deforms) return;
    add_moments(v.dimension, job, g->second, NULL, second.along, contact_moment_factor(false, &job->scale, second.arm),
                force);
}

/// Rates of dashpots where the motion of the bodies at n is known: of geometries whose kernels know it.
SCREE_INLINE void kinematics_lead(variant v, const contact_job *job, const group *g, const bodies *first,
                                  const bodies *second, kinematics *m)
{
    if (!job->lead) return;
    const motion_at_n one = motion_at_end(v.dimension, first, load_predicted(v.dimension, job->lead, job->first, g));
    const motion_at_n other =
        motion_at_end(v.dimension, second, load_predicted(v.dimension, job->lead, job->second, g));
    kinematics_at_end(v.dimension, geometry_has_levers(v), m, &one, &other);
}

SCREE_INLINE void evaluate_group(const contact_job *job, variant v, group *g, totals *t)
{
    const int dimension = v.dimension;
    find_bodies(job, g);
    bodies first = load_places(dimension, job, g->first), second = load_places(dimension, job, g->second);
    lanes_bits touching = g->present;
    if (!law_holds(v) && !law_deforms(v)) touching &= geometry_touches(v, &first, &second);
    load_motions(dimension, job, g->first, &first);
    load_motions(dimension, job, g->second, &second);
    load_spins(dimension, job, g->first, &first);
    load_spins(dimension, job, g->second, &second);
    first.found = g->found;
    kinematics m = geometry_kinematics(v, &first, &second, job->settings.step);
    if (geometry_is_coarse(v)) {
        kinematics_lead(v, job, g, &first, &second, &m);
        touching &= expanded_touch(&m);
    }
    if (law_deforms(v)) {
        const stretch both = load_stretches(dimension, job, g);
        kinematics_expand(dimension, &m, &both, job->settings.step);
        if (!law_holds(v)) touching &= expanded_touch(&m);
    }
    if (law_predicts(v)) {
        prediction ahead = load_predicted(dimension, job->predicted, job->first, g);
        prediction ahead_second = load_predicted(dimension, job->predicted, job->second, g);
        kinematics_predict(dimension, &m, &first, &ahead, &second, &ahead_second);
    }
    law_constants constants = load_constants(job, v, first.material, second.material);
    if (law_holds(v)) load_own(job, g, &constants);

    law_memory before = load_memory(job, v, g), after;
    contact_quanta q = contact_evaluate(v, &constants, &job->settings, &job->scale, &m, touching, &before, &after);
    store_memory(job, v, g, &after);

    add_to_sums(dimension, job, g->first, q.force, q.torque_first, q.count);
    add_to_sums(dimension, job, g->second, quanta_opposite(q.force), q.torque_second, q.count);
    if (v.moments) add_moments_of_pair(v, job, g, &m, q.straining);
    t->in_range &= q.in_range;
    if (law_holds(v)) {
        t->settle |= q.settle;
        t->largest_deformation = lanes_at_least(t->largest_deformation, lanes_keep(touching, q.deformation));
        t->largest_gap = lanes_at_least(t->largest_gap, lanes_keep(touching, m.expansion - m.overlap));
    } else {
        t->largest_overlap = lanes_at_least(t->largest_overlap, lanes_keep(touching, m.overlap));
    }
    t->damping += q.damping;
    t->friction += q.friction;
    t->stiffness += q.stiffness;
}

#endif
