/// What a run was made of is its case.yaml; what the sweep has now is the case of the same point, with the seed of the
/// run. Cost: one case a point and one a run are read.
#include "sweep/origin.h"
#include "sweep/templates.h"

#include "case/case.h"
#include "io/run_directory.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

scree_sweep *scree_origin_sweep(const char *name, scree_finding_form form)
{
    const scree_sweep_read_options options = {.quick = form == SCREE_FINDING_QUICK};
    scree_sweep *sweep = NULL;
    if (form == SCREE_FINDING_RUN || !scree_sweep_template(name)) return NULL;
    return scree_sweep_read(name, &options, &sweep, NULL) ? NULL : sweep;
}

bool scree_origin_has_seed(const scree_sweep *sweep, long long seed, size_t planned)
{
    const size_t count = planned > sweep->realisations ? planned : sweep->realisations;
    return seed >= sweep->config.seed && seed < sweep->config.seed + (long long)count;
}

/// What differs between the case of a run and `now`, which gets its seed.
static void compare_case(scree_finding *run, scree_case *now)
{
    char path[PATH_MAX + 32], where[SCREE_CASE_PATH];
    scree_case *then;
    (void)snprintf(path, sizeof path, "%s/" SCREE_FILE_CASE, run->directory);
    if (access(path, R_OK) != 0) return;
    if (scree_case_reread(path, scree_former_keys, &then, NULL)) {
        (void)snprintf(run->other_case, sizeof run->other_case, "keys that there are no more");
        return;
    }
    now->config.seed = then->config.seed;
    const int64_t stage = scree_case_stage_apart(then, now, where);
    run->other_sample = stage >= 0 && stage < now->config.stage_count - 1;
    if (run->other_sample || scree_case_is_apart(then, now, where))
        (void)snprintf(run->other_case, sizeof run->other_case, "%s", where[0] ? where : "stages");
    scree_case_free(then);
}

/// Runs of one point of a sweep.
static void compare_point(scree_findings *findings, const scree_finding *like, const scree_sweep *sweep, size_t point)
{
    scree_case *now = NULL;
    size_t planned = 0;
    scree_finding *const end = findings->item + findings->count;
    for (int pass = 0; pass < 2; pass++)
        for (scree_finding *f = findings->item; f < end; f++) {
            if (f->form != like->form || strcmp(f->name, like->name) != 0) continue;
            if (strcmp(f->label, sweep->point[point]) != 0) continue;
            planned += pass == 0;
            if (pass == 0 || f->state != SCREE_FINDING_DONE) continue;
            f->other_seed = !scree_origin_has_seed(sweep, f->seed, planned);
            if (!now && scree_member_resolve(sweep, point, &now, NULL)) return;
            compare_case(f, now);
        }
    scree_case_free(now);
}

void scree_origin_compare(scree_findings *findings)
{
    for (size_t i = 0; i < findings->count; i++) {
        const scree_finding *like = &findings->item[i];
        size_t first = 0;
        while (findings->item[first].form != like->form || strcmp(findings->item[first].name, like->name) != 0) first++;
        scree_sweep *sweep = first == i ? scree_origin_sweep(like->name, like->form) : NULL;
        for (size_t point = 0; sweep && point < sweep->point_count; point++)
            compare_point(findings, like, sweep, point);
        scree_sweep_free(sweep);
    }
}
