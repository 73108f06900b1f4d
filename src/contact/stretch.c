/// Passes over the bodies that deform: shares of threads, and what all have found (stretch.h).
#include "contact/stretch.h"

#include "base/integer_sum.h"
#include "comm/comm.h"
#include "contact/contact.h"
#include "contact/stretch_batch.h"

typedef struct stretch_task {
    stretch_job job;
    stretch_kernel *kernel;
    stretch_extremes found[SCREE_THREAD_POOL_MOST];
    scree_integer_sum sum, part[SCREE_THREAD_POOL_MOST];
} stretch_task;

/// The part of a task's bodies that is a share.
static stretch_job job_of_share(const stretch_task *task, int index, int count)
{
    stretch_job job = task->job;
    job.begin = scree_thread_pool_begin(job.state->count, index, count);
    job.end = scree_thread_pool_begin(job.state->count, index + 1, count);
    return job;
}

static void run_share(void *argument, int index, int count)
{
    stretch_task *task = argument;
    const stretch_job job = job_of_share(task, index, count);
    task->found[index] = job.begin < job.end ? task->kernel(&job) : (stretch_extremes){0};
}

static void add_share(void *argument, int index, int count)
{
    stretch_task *task = argument;
    const stretch_job job = job_of_share(task, index, count);
    scree_integer_sum sum = task->sum;
    scree_integer_sum_add_all(&sum, job.term + job.begin, job.end - job.begin);
    task->part[index] = sum;
}

/// Chooses the kernels of an instruction set.
static void choose(stretch_task *task, const scree_work *work, bool settles)
{
#if defined(__x86_64__)
    static stretch_kernel *const kernels[2][5] = {
        {[2] = stretch_bodies_v2, [3] = stretch_bodies_v3, [4] = stretch_bodies_v4},
        {[2] = stretch_settle_v2, [3] = stretch_settle_v3, [4] = stretch_settle_v4}};
#else
    static stretch_kernel *const kernels[2][5] = {{stretch_bodies_v0}, {stretch_settle_v0}};
#endif
    task->kernel = kernels[settles][scree_contact_instruction_set(work->instruction_set)];
}

scree_stretch_change scree_stretch_bodies(const scree_context *c, const scree_compliance *compliance, double theta,
                                          double *term)
{
    stretch_task task; // large, and filled by the shares
    scree_compliance by[SCREE_MAX_MATERIALS];
    const int shares = scree_work_shares(c->work);
    const double volume = c->state->dimension == 3 ? 1 : scree_stretch_volume(2, c->model->thickness, 0);
    const double scale = c->state->force_quantum / volume;
    double most[2] = {0, 0};
    for (int k = 0; k < SCREE_MAX_MATERIALS; k++)
        by[k] = (scree_compliance){scale * compliance[k].shear, scale * compliance[k].trace};
    choose(&task, c->work, false);
    task.job = (stretch_job){.state = c->state,
                             .by = by,
                             .alike = c->model->material_count == 1 && c->model->added_materials == 0,
                             .theta = theta,
                             .term = term};
    scree_thread_pool_run(&c->work->pool, shares, run_share, &task);
    for (int k = 0; k < shares; k++) {
        most[0] = fmax(most[0], task.found[k].reach);
        most[1] = fmax(most[1], task.found[k].square);
    }
    scree_comm_maximum(c->state, most, 2);
    return (scree_stretch_change){.reach = most[0], .growth = sqrt(most[1])};
}

double scree_stretch_settle(const scree_context *c, double *term)
{
    stretch_task task; // large, and filled by the shares
    const int shares = scree_work_shares(c->work);
    choose(&task, c->work, true);
    task.job = (stretch_job){.state = c->state, .term = term};
    task.sum = (scree_integer_sum){0};
    while (scree_comm_sum_next(c->state, &task.sum, 1)) {
        const bool adds = task.sum.pass == SCREE_INTEGER_SUM_ADDS;
        scree_thread_pool_run(&c->work->pool, shares, adds ? add_share : run_share, &task);
        for (int k = 0; k < shares; k++)
            if (adds)
                scree_integer_sum_join(&task.sum, &task.part[k]);
            else
                task.sum.largest = fmax(task.sum.largest, task.found[k].term);
    }
    return scree_integer_sum_total(&task.sum);
}
