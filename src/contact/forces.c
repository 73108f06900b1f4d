/// The force evaluation: choice of the kernel, threads, ledger and flags.
///
/// Each thread runs the kernel on its part of the pair list (contact/partition.h), then, after a barrier, merges a
/// range of rows and evaluates the wall contacts of these rows. Without memory for the partition, or when asked to
/// (work->reference_kernel), the scalar reference does all the work: same bits, slower.
#include "base/processor.h"
#include "contact/bounds.h"
#include "contact/contact.h"
#include "contact/faults.h"
#include "contact/images.h"
#include "contact/laws.h"
#include "contact/partition.h"
#include "contact/reference.h"

int scree_contact_instruction_set(int wanted)
{
    int best = scree_processor_level();
    return wanted > 0 && wanted < best ? wanted : best;
}

static contact_kernel *choose_kernel(int wanted)
{
#if defined(__x86_64__)
    static contact_kernel *const table[] = {
        [2] = scree_pairs_batch_v2, [3] = scree_pairs_batch_v3, [4] = scree_pairs_batch_v4};
#else
    static contact_kernel *const table[] = {scree_pairs_batch_v0};
#endif
    return table[scree_contact_instruction_set(wanted)];
}

/// What all parts of an evaluation share.
static contact_job describe_job(const scree_model *model, const scree_state *state, const scree_work *work)
{
    contact_bounds bounds = contact_bounds_get(model, state);
    double room = ldexp(1.0, SCREE_FIXED_RANGE_BITS - contact_energy_bits(state->count));
    return (contact_job){
        .model = model,
        .row = state->row,
        .sum = state->sum,
        .first = work->pairs.first,
        .second = work->pairs.second,
        .history = work->pairs.history,
        .near = work->pairs.touching_count,
        .touching_end = work->pairs.touching_count,
        .near_begin = work->pairs.touching_count,
        .near_end = work->pairs.count,
        .settings = law_settings_get(model, state->step_size),
        .scale = {.inverse_force = 1 / state->force_quantum,
                  .inverse_torque = 1 / state->torque_quantum,
                  .inverse_damping = 1 / (scree_fixed_quantum(bounds.damping) * room),
                  .inverse_friction = 1 / (scree_fixed_quantum(bounds.friction) * room),
                  .force_limit = ldexp(state->force_quantum, SCREE_FIXED_RANGE_BITS)},
        .ledger = work->ledger,
    };
}

static contact_totals evaluate_serially(contact_job *job, scree_state *state, const scree_work *work)
{
    if (state->count > 0) memset(state->sum, 0, scree_row_count(state, work) * sizeof *state->sum);
    contact_pairs_reference(job);
    contact_walls(job, state->sum, state->wall, &work->wall_pairs, 0, state->count);
    return job->totals;
}

/// The ranges of a part of the list, and everything else from `common`.
static void prepare_part(contact_part *part, const contact_job *common, uint8_t *near_touched, scree_state *state)
{
    contact_job job = *common;
    job.touching_begin = part->job.touching_begin;
    job.touching_end = part->job.touching_end;
    job.near_begin = part->job.near_begin;
    job.near_end = part->job.near_end;
    job.near_touched = near_touched;
    job.sum = contact_part_clear(part, state);
    part->job = job;
}

static contact_totals evaluate_parts(contact_kernel *kernel, const contact_scratch *scratch, const contact_job *common,
                                     scree_state *state, const scree_work *work)
{
    int parts = scratch->part_count;
#pragma omp parallel num_threads(parts) if (parts > 1)
    {
#pragma omp for schedule(static, 1)
        for (int k = 0; k < parts; k++) {
            prepare_part(&scratch->part[k], common, scratch->near_touched, state);
            kernel(&scratch->part[k].job);
        }
#pragma omp for schedule(static, 1)
        for (int k = 0; k < parts; k++) {
            size_t begin, end;
            contact_merge_range(scratch, scree_row_count(state, work), k, &begin, &end);
            contact_merge(scratch, state, begin, end);
            contact_walls(&scratch->part[k].job, state->sum, state->wall, &work->wall_pairs, begin, end);
        }
    }
    contact_totals totals = contact_totals_none();
    for (int k = 0; k < parts; k++) contact_totals_add(&totals, &scratch->part[k].job.totals);
    return totals;
}

/// Forces on the walls, and the work they did on the bodies in this step (see motion.h for the trapezoid).
static double settle_walls(scree_state *state, const contact_totals *totals)
{
    double work = 0;
    for (int k = 0; k < SCREE_WALL_COUNT; k++) {
        scree_wall *wall = &state->wall[k];
        double force = scree_fixed_to((int64_t)totals->wall_force[k], state->force_quantum);
        double shear = scree_fixed_to((int64_t)totals->wall_shear[k], state->force_quantum);
        const double tangent[2] = {-wall->normal[1], wall->normal[0]};
        work += 0.5 * state->step_size * (force + wall->force) * wall->velocity;
        for (int i = 0; i < 2; i++) {
            double now = shear * tangent[i];
            work -= 0.5 * state->step_size * (now + wall->shear[i]) * wall->tangential_velocity[i];
            wall->shear[i] = now;
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

void scree_contact_forces(const scree_model *model, scree_state *state, scree_work *work)
{
    contact_job job = describe_job(model, state, work);
    contact_kernel *kernel = work->reference_kernel ? NULL : choose_kernel(work->instruction_set);
    contact_scratch *scratch = kernel ? contact_scratch_refresh(work, scree_row_count(state, work)) : NULL;
    contact_totals totals =
        scratch ? evaluate_parts(kernel, scratch, &job, state, work) : evaluate_serially(&job, state, work);

    scree_images_fold(state, work);
    double plates = settle_walls(state, &totals);
    if (work->ledger) settle_ledger(&state->ledger, &totals, &job.scale, plates);
    state->largest_overlap = totals.largest_overlap;
    if (!totals.in_range || totals.largest_overlap > contact_overlap_limit(model) * model->radius_min)
        contact_find_faults(model, state, work, job.scale.force_limit);
}
