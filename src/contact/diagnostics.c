/// What the guard found is sought again from positions and velocities, body by body and pair by pair, so the answer
/// does not depend on the kernel, on threads or on the order of the list.
#include "contact/diagnostics.h"
#include "state/plates.h"

#include "contact/bounds.h"
#include "contact/single.h"
#include "contact/surfaces.h"

#include <math.h>

/// Smallest id for each flag; UINT64_MAX for none.
typedef struct diagnostics {
    uint64_t not_finite, overlap, force;
} diagnostics;

static void lower(uint64_t *least, uint64_t id)
{
    if (id < *least) *least = id;
}

static void check_rows(const scree_state *state, diagnostics *f)
{
    for (size_t k = 0; k < state->count; k++) {
        scree_vector position, velocity, spin;
        double sum = 0;
        scree_body_position(state, k, position);
        scree_body_motion(state, k, velocity, spin);
        for (int i = 0; i < 3; i++) sum += position[i] + velocity[i] + spin[i];
        if (!isfinite(sum)) lower(&f->not_finite, state->id[k]);
    }
}

static void check_contact(const scree_contact *c, double overlap_limit, double force_limit, uint64_t id, diagnostics *f)
{
    if (c->overlap > overlap_limit) lower(&f->overlap, id);
    if (!(fabs(c->normal_force) + fabs(c->tangential_force) <= force_limit)) lower(&f->force, id);
}

static void check_elements(const scree_model *model, const scree_state *state, const scree_work *work,
                           double force_limit, diagnostics *f)
{
    const scree_wall_pair_list *pairs = &work->primitive_pairs;
    primitive_touches touches;
    scree_contact c;
    for (size_t begin = 0, end; begin < pairs->count; begin = end) {
        end = contact_group_end(pairs, begin);
        contact_body body = contact_body_get(state, pairs->body[begin]);
        const bodies one = contact_body_lane(state->dimension, &body);
        contact_primitives_touching(work->wall_set, state->dimension, &one, pairs, begin, end, &touches);
        for (int k = 0; k < touches.count; k++) {
            size_t p = touches.touch[k].pair;
            memory_rows memory = contact_memory_of(work, CONTACT_ELEMENT, p);
            contact_of_primitive(model, state, work, &body, pairs->wall[p], &memory, &c);
            check_contact(&c, contact_overlap_limit(model) * body.row.radius, force_limit, state->id[pairs->body[p]],
                          f);
        }
    }
}

void contact_diagnose(const scree_model *model, const scree_state *state, scree_work *work, double force_limit)
{
    diagnostics f = {UINT64_MAX, UINT64_MAX, UINT64_MAX};
    double limit = contact_overlap_limit(model);
    scree_contact c;
    check_rows(state, &f);
    const scree_pair_list *pairs = &work->pairs;
    for (size_t p = 0; p < pairs->count; p++) {
        contact_body first = contact_body_get(state, pairs->first[p]),
                     second = contact_body_get(state, pairs->second[p]);
        memory_rows memory = contact_memory_of(work, CONTACT_PAIR, p);
        double radius = fmin(first.row.radius, second.row.radius);
        // How far a pair that is held overlaps is its own affair.
        const scree_member_row *own = contact_own_of(work, p);
        if (contact_of_pair(model, state, &first, &second, own, &memory, &c))
            check_contact(&c, own ? (double)INFINITY : limit * radius, force_limit, state->id[pairs->first[p]], &f);
    }
    const scree_wall_pair_list *walls = &work->wall_pairs;
    for (size_t p = 0; p < walls->count; p++) {
        contact_body body = contact_body_get(state, walls->body[p]);
        memory_rows memory = contact_memory_of(work, CONTACT_PLATE, p);
        if (contact_of_wall(model, state, &body, &scree_plates(state)[walls->wall[p]], &memory, &c))
            check_contact(&c, limit * body.row.radius, force_limit, state->id[walls->body[p]], &f);
    }
    check_elements(model, state, work, force_limit, &f);

    uint64_t id = f.not_finite < UINT64_MAX ? f.not_finite : f.overlap < UINT64_MAX ? f.overlap : f.force;
    if (id == UINT64_MAX) return;
    if (!work->flags) work->flagged_id = id;
    if (f.not_finite < UINT64_MAX) work->flags |= SCREE_FLAG_NAN;
    if (f.overlap < UINT64_MAX) work->flags |= SCREE_FLAG_OVERLAP;
    if (f.force < UINT64_MAX) work->flags |= SCREE_FLAG_FORCE_RANGE;
}
