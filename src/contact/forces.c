/// The force evaluation: choice of the kernel, threads, ledger and flags.
///
/// The sums are clear from the last kick on (integrate/kick.h), or are cleared here.
/// Each thread runs the kernels of the sections on its part of the pair list (contact/partition.h), then, after a
/// barrier, merges a range of rows and evaluates the wall contacts of these rows. Without memory for the partition, or
/// when asked to (work->reference_kernel), the scalar reference does all the work: same bits, slower. It takes the
/// place of the kernels of round bodies, in threads, where the motion at n is known (state->lead), of which they know
/// nothing.
#include "base/processor.h"
#include "comm/comm.h"
#include "contact/bounds.h"
#include "contact/contact.h"
#include "contact/diagnostics.h"
#include "contact/ghost_forces.h"
#include "contact/laws.h"
#include "contact/partition.h"
#include "contact/reference.h"
#include "contact/resting.h"
#include "contact/surfaces.h"
#include "state/periodic.h"
#include "state/persistent.h"
#include "state/plates.h"
#include "state/sleep.h"

#include <math.h>

int scree_contact_instruction_set(int wanted)
{
    int best = scree_processor_level();
    return wanted > 0 && wanted < best ? wanted : best;
}

static contact_kernels choose_kernels(int dimension, int wanted)
{
#if defined(__x86_64__)
    static contact_kernel *const plane[] = {[2] = scree_pairs_2d_v2, [3] = scree_pairs_2d_v3, [4] = scree_pairs_2d_v4};
    static contact_kernel *const solid[] = {[2] = scree_pairs_3d_v2, [3] = scree_pairs_3d_v3, [4] = scree_pairs_3d_v4};
    static contact_kernel *const outlines[] = {
        [2] = scree_outlines_v2, [3] = scree_outlines_v3, [4] = scree_outlines_v4};
#else
    static contact_kernel *const plane[] = {scree_pairs_2d_v0}, *const solid[] = {scree_pairs_3d_v0};
    static contact_kernel *const outlines[] = {scree_outlines_v0};
#endif
    const int set = scree_contact_instruction_set(wanted);
    return (contact_kernels){.in_lanes = (dimension == 3 ? solid : plane)[set], .outlines = outlines[set]};
}

/// That of the section which the job has entered.
static contact_kernel *kernel_of(const contact_kernels *kernels, const contact_job *job)
{
    if (!geometry_is_one_by_one(job->variant)) return kernels->in_lanes;
    return geometry_has_areas(job->variant) ? kernels->outlines : contact_pairs_reference;
}

/// What all parts of an evaluation share.
static contact_job describe_job(const scree_model *model, const scree_state *state, const scree_work *work)
{
    scree_law_bounds bounds = contact_bounds_get(model, state);
    const size_t held = scree_persistent_total(state);
    double room =
        ldexp(1.0, SCREE_FIXED_RANGE_BITS - contact_energy_bits(state->dimension, scree_state_total(state), held));
    return (contact_job){
        .model = model,
        .state = state,
        .variant = {.dimension = state->dimension,
                    .many_materials = model->material_count + model->added_materials > 1,
                    .moments = state->moment != NULL},
        .row = state->row,
        .turn = state->turn,
        .predicted = state->predicted,
        .lead = state->lead,
        .stretch = state->moment ? state->stretch : NULL,
        .sum = state->sum,
        .torque = state->torque,
        .moment = state->moment,
        .first = work->pairs.first,
        .second = work->pairs.second,
        .hint = work->pairs.hint,
        .history = work->pairs.history,
        .last_force = work->pairs.last_force,
        .rolling = work->pairs.rolling,
        .own = work->pairs.own,
        .settings = {.step = state->step_size},
        .scale = {.inverse_force = 1 / state->force_quantum,
                  .inverse_torque = 1 / state->torque_quantum,
                  .inverse_damping = 1 / (scree_fixed_quantum(bounds.damping) * room),
                  .inverse_friction = 1 / (scree_fixed_quantum(bounds.friction) * room),
                  .force_limit = ldexp(state->force_quantum, SCREE_FIXED_RANGE_BITS),
                  .inverse_surface_torque = 1 / contact_surface_torque_quantum(model, state, work->wall_set)},
    };
}

/// The contacts with walls of a range of rows, law by law.
static void add_walls(contact_job *job, const scree_state *state, const scree_work *work, size_t begin, size_t end)
{
    for (int law = 0; law < scree_model_law_count(job->model); law++) {
        job->variant.geometry = work->wall_pairs.geometry;
        contact_job_use_number(job, law);
        contact_walls(job, scree_plates(state), &work->wall_pairs, begin, end);
        contact_surfaces(job, state, work, begin, end);
    }
}

/// The pairs of all sections, of each those in its range.
static void evaluate_sections(const contact_kernels *kernels, contact_job *job, const scree_pair_list *pairs,
                              const contact_range *range, uint8_t *near_touched, const size_t *near_byte)
{
    contact_totals before;
    bool first = true;
    for (int k = 0; k < pairs->section_count; k++) {
        if (pairs->section[k].asleep || contact_range_is_empty(&range[k])) continue;
        if (!first) before = job->totals;
        contact_job_enter(job, &pairs->section[k], &range[k], near_touched ? near_touched + near_byte[k] : NULL);
        kernel_of(kernels, job)(job);
        if (!first) contact_totals_add(&job->totals, &before);
        first = false;
    }
    if (first) job->totals = contact_totals_none();
}

static contact_totals evaluate_serially(contact_job *job, scree_state *state, const scree_work *work)
{
    static const contact_kernels reference = {contact_pairs_reference, contact_pairs_reference};
    contact_range range[SCREE_PAIR_SECTIONS];
    for (int k = 0; k < work->pairs.section_count; k++) range[k] = contact_range_of(&work->pairs.section[k]);
    evaluate_sections(&reference, job, &work->pairs, range, NULL, NULL);
    add_walls(job, state, work, 0, state->count);
    return job->totals;
}

/// What the members of the thread pool share.
typedef struct parts_task {
    const contact_kernels *kernels;
    contact_scratch *scratch;
    const contact_job *common;
    scree_state *state;
    const scree_work *work;
} parts_task;

static void evaluate_share(void *argument, int index, int count)
{
    const parts_task *task = argument;
    contact_scratch *scratch = task->scratch;
    contact_part *part = &scratch->part[index];
    (void)count;
    part->job = *task->common;
    contact_part_clear(part, task->state, &part->job);
    evaluate_sections(task->kernels, &part->job, &task->work->pairs, part->range, scratch->near_touched,
                      scratch->near_byte);
}

/// Makes a range of rows whole, and adds the wall contacts of its bodies.
static void finish_share(void *argument, int index, int count)
{
    const parts_task *task = argument;
    scree_state *state = task->state;
    contact_job *job = &task->scratch->part[index].job;
    size_t begin, end;
    (void)count;
    contact_merge_range(task->scratch, task->scratch->rows, index, &begin, &end);
    contact_merge(task->scratch, state, begin, end);
    job->sum = state->sum;
    job->torque = state->torque;
    job->moment = state->moment;
    add_walls(job, state, task->work, begin, end);
}

static contact_totals evaluate_parts(const contact_kernels *kernels, contact_scratch *scratch,
                                     const contact_job *common, scree_state *state, scree_work *work)
{
    parts_task task = {kernels, scratch, common, state, work};
    int parts = scratch->part_count;
    scree_thread_pool_run(&work->pool, parts, evaluate_share, &task);
    scree_thread_pool_run(&work->pool, parts, finish_share, &task);
    contact_totals totals = contact_totals_none();
    for (int k = 0; k < parts; k++) contact_totals_add(&totals, &scratch->part[k].job.totals);
    return totals;
}

/// What is joined of the totals of all processes, of which each has found those of its own contacts, beside what they
/// hold as numbers: whether there is a pair that settles, a force out of range, a flag.
typedef struct joined_totals {
    scree_reduction together;
    double any[3];
} joined_totals;

static void list_integers(scree_reduction *together, uint64_t *first, size_t count)
{
    scree_reduction_add(together, (int64_t *)first, count);
}

/// The totals as they are to be joined. What has been counted is an integer.
static void list_totals(const scree_work *work, contact_totals *totals, joined_totals *joined)
{
    scree_reduction *together = &joined->together;
    joined->any[0] = totals->settle;
    joined->any[1] = !totals->in_range;
    joined->any[2] = work->flags != 0;
    scree_reduction_maximum(together, joined->any, 3);
    scree_reduction_maximum(together, &totals->largest_overlap, 1);
    scree_reduction_maximum(together, &totals->largest_deformation, 1);
    scree_reduction_maximum(together, &totals->largest_gap, 1);
    list_integers(together, &totals->damping, 1);
    list_integers(together, &totals->friction, 1);
    list_integers(together, &totals->stiffness, 1);
    list_integers(together, totals->wall_force, SCREE_WALL_COUNT);
    list_integers(together, totals->wall_shear[0], 3 * SCREE_WALL_COUNT);
    // Of the walls of the case nothing is sent where there are none.
    if (!work->wall_set) return;
    list_integers(together, totals->surface_force[0], 3 * SCREE_SURFACES);
    list_integers(together, totals->surface_torque[0], 3 * SCREE_SURFACES);
}

/// Joins the totals in one message, and adds what ghosts have collected to their bodies. The message goes beside those
/// of the ghosts, but where a virial goes with it: that needs what comes back.
static void join_totals(scree_state *state, scree_work *work, contact_totals *totals)
{
    joined_totals joined = {.together = {.parts = 0}};
    const bool waits = scree_periodic_is_whole(state);
    scree_virial virial;
    list_totals(work, totals, &joined);
    if (!waits) scree_comm_join_begin(state, &joined.together);
    scree_ghosts_add_back(state, work, &virial, &joined.together);
    if (waits)
        scree_comm_join_numbers(state, &joined.together);
    else
        scree_comm_join_end(state, &joined.together);
    scree_ghosts_settle_virial(state, work, &virial);
    totals->settle = joined.any[0] > 0;
    totals->in_range = !(joined.any[1] > 0);
    work->alarm = joined.any[2] > 0;
}

/// Tangential force on wall `w` [N].
static void shear_of(const scree_state *state, const contact_totals *totals, int w, scree_vector shear)
{
    const double *normal = scree_plates(state)[w].normal;
    for (int k = 0; k < 3; k++) shear[k] = scree_fixed_to((int64_t)totals->wall_shear[w][k], state->force_quantum);
    if (state->dimension == 3) return;
    double along = shear[0];
    shear[0] = along * -normal[1];
    shear[1] = along * normal[0];
}

/// Forces on the walls, and the work they did on the bodies in this step (see kinematics.h for the trapezoid).
static double settle_walls(scree_state *state, const contact_totals *totals)
{
    double work = 0;
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        scree_wall *wall = &scree_plates(state)[w];
        double force = scree_fixed_to((int64_t)totals->wall_force[w], state->force_quantum);
        scree_vector shear;
        shear_of(state, totals, w, shear);
        work += 0.5 * state->step_size * (force + wall->force) * wall->velocity;
        for (int k = 0; k < state->dimension; k++) {
            work -= 0.5 * state->step_size * (shear[k] + wall->shear[k]) * wall->tangential_velocity[k];
            wall->shear[k] = shear[k];
        }
        wall->force = force;
    }
    return work;
}

static void settle_ledger(scree_ledger *ledger, const contact_totals *totals, const contact_scale *scale, double plates)
{
    double damping = (double)(int64_t)totals->damping / scale->inverse_damping;
    double friction = (double)(int64_t)totals->friction / scale->inverse_friction;
    ledger->damping += damping;
    ledger->friction += friction;
    ledger->stiffness += (double)(int64_t)totals->stiffness / scale->inverse_friction;
    ledger->plates += plates;
    ledger->turnover += fabs(damping) + fabs(friction) + fabs(plates);
}

/// Sums and memory, by the job; forces on walls and the ledger are not touched.
static contact_totals evaluate(contact_job *job, scree_state *state, scree_work *work)
{
    contact_clear_rows(state, work->clear_rows, scree_row_count(state, work));
    work->clear_rows = 0;
    contact_clear_moments(state, scree_row_count(state, work));
    contact_kernels kernels = choose_kernels(state->dimension, work->instruction_set);
    if (state->lead) kernels.in_lanes = contact_pairs_reference;
    contact_scratch *scratch = work->reference_kernel ? NULL : contact_scratch_refresh(work, state);
    contact_totals totals =
        scratch ? evaluate_parts(&kernels, scratch, job, state, work) : evaluate_serially(job, state, work);
    join_totals(state, work, &totals);
    contact_resting_loads(state, &job->scale, &totals);
    return totals;
}

bool scree_contact_sums(const scree_model *model, scree_state *state, scree_work *work)
{
    contact_job job = describe_job(model, state, work);
    return evaluate(&job, state, work).in_range;
}

void scree_contact_forces(const scree_model *model, scree_state *state, scree_work *work)
{
    contact_job job = describe_job(model, state, work);
    const contact_totals totals = evaluate(&job, state, work);
    double plates = settle_walls(state, &totals) + contact_surfaces_settle(state, work, &totals, &job.scale);
    settle_ledger(&state->ledger, &totals, &job.scale, plates);
    work->settle = totals.settle;
    state->largest_overlap = fmax(totals.largest_overlap, scree_sleep_of(state)->overlap);
    scree_persistent(state)->largest_deformation = totals.largest_deformation;
    scree_persistent(state)->largest_gap = totals.largest_gap;
    if (totals.in_range && !(totals.largest_overlap > contact_overlap_limit(model) * model->radius_min)) return;
    contact_diagnose(model, state, work, job.scale.force_limit);
    work->alarm = true;
}
