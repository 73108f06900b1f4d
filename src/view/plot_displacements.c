/// Displacements of the grains since the stage that the end of a run is compared with.
#include "view/displacements.h"
#include "view/plot_parts.h"

#include "average/strain.h"
#include "base/memory.h"
#include "io/sample_file.h"

#include <scree/scree.h>

#include <string.h>

/// The stage, as the results tell it. False: the run was compared with none.
static bool find_stage(const scree_plot_run *run, char *stage, size_t size)
{
    scree_error ignored;
    return !scree_result_get(run->directory, "compared_with", stage, size, &ignored);
}

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    char stage[64];
    (void)figure;
    return run->dimension == 2 && run->snapshot_count > 1 && find_stage(run, stage, sizeof stage);
}

/// The last snapshot of the stage, and that of the end.
static scree_status find_states(const scree_plot_run *run, scree_snapshot_mark state[2], scree_error *error)
{
    bool found = false;
    char stage[64] = "";
    scree_snapshot_mark *mark;
    size_t count;
    scree_status status = scree_snapshot_marks(run->directory, &mark, &count, error);
    if (status) return status;
    state[1] = mark[count - 1];
    (void)find_stage(run, stage, sizeof stage);
    for (size_t k = 0; k + 1 < count; k++)
        if (strcmp(mark[k].stage_name, stage) == 0) {
            state[0] = mark[k];
            found = true;
        }
    scree_release(&mark);
    return found ? SCREE_OK : scree_error_set(error, SCREE_ERROR_INPUT, "there is no snapshot of stage '%s'", stage);
}

static scree_status has_states(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    scree_snapshot_mark state[2];
    (void)job;
    return find_states(run, state, error);
}

static scree_status draw_displacements(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    scree_snapshot_mark state[2];
    double heap[2];
    scree_average_sample before = {0}, after = {0};
    scree_snapshot from = {0};
    scree_status status = find_states(run, state, error);
    if (!status) status = scree_sample_read(run->directory, state[0].index, &before, error);
    if (!status) status = scree_sample_read(run->directory, state[1].index, &after, error);
    if (!status) status = scree_average_move(&after, &before, error);
    if (!status) status = scree_snapshot_read(run->directory, state[0].place, &from, error);
    if (!status)
        status = scree_displacements_draw(job->path, &from, &after, scree_plot_heap(run, heap) ? heap : NULL, error);
    scree_snapshot_destroy(&from);
    scree_average_sample_destroy(&before);
    scree_average_sample_destroy(&after);
    return status;
}

static const scree_figure rows[] = {
    {"displacements", "displacements of the grains since the stage that the end is compared with", SCREE_USUAL},
};

const scree_figure_family scree_figures_displacements = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = has_states,
    .draw = draw_displacements,
};
