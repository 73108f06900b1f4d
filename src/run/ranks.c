/// What can be spread over processes says so in its module (`spreads`). All modules that a case chooses are looked at
/// before the run, and those that are in use in the stages as far as the case alone tells; what is in use in a stage
/// that has begun is looked at again before its first step. So a new module is refused until somebody has thought about
/// it.
#include "run/ranks.h"

#include "base/checksum.h"
#include "base/memory.h"
#include "comm/comm.h"
#include "comm/parts.h"
#include "comm/ranges.h"
#include "io/folder_lock.h"
#include "io/snapshot.h"
#include "search/neighbours.h"
#include "state/periodic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

bool scree_ranks_write(void)
{
    return scree_comm_rank() == 0;
}

// ---- what cannot be spread ---------------------------------------------------------------------------------------

static scree_status refuse(const char *what, const char *name, scree_error *error)
{
    return scree_error_set(error, SCREE_ERROR_INPUT,
                           "%s '%s' cannot be spread over several processes yet: start one process, with --threads N "
                           "for N cores",
                           what, name);
}

static scree_status check_module(int slot, const char *what, scree_error *error)
{
    return scree_modules[slot]->spreads ? SCREE_OK : refuse(what, scree_modules[slot]->name, error);
}

/// Of the stage that the state is in: modules with something to do, and the boundary.
static scree_status check_stage(scree_simulation *s, scree_error *error)
{
    const scree_config_stage *stage = &s->model.stages[s->state.stage.index];
    const scree_context context = scree_step_context(s);
    scree_status status = check_module(stage->kind, "stage", error);
    if (scree_modules[stage->kind]->numbers->instant || scree_modules[stage->kind]->numbers->places) return status;
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++) {
        const scree_module *module = scree_modules[m];
        if (module->boundary == s->boundary) status = check_module(m, "boundary", error);
        const bool acts = module->pass_count > 0 || module->bound;
        if (!status && acts && !module->spreads && (!module->in_use || module->in_use(&context)))
            status = check_module(m, "what acts in a stage:", error);
    }
    return status;
}

static scree_status check_stages(scree_simulation *s, scree_error *error)
{
    const scree_boundary *boundary = s->boundary;
    const int64_t index = s->state.stage.index;
    scree_status status = SCREE_OK;
    for (int64_t k = 0; k < s->model.stage_count && !status; k++) {
        s->state.stage.index = k;
        s->boundary = scree_model_boundary_of(&s->model, k);
        status = check_stage(s, error);
    }
    s->state.stage.index = index;
    s->boundary = boundary;
    return status;
}

scree_status scree_ranks_check(scree_simulation *s, scree_error *error)
{
    return scree_comm_size() == 1 ? SCREE_OK : scree_ranks_can_spread(s, error);
}

scree_status scree_ranks_can_spread(scree_simulation *s, scree_error *error)
{
    const scree_model *model = &s->model;
    scree_status status = check_module(model->scheme, "scheme", error);
    for (int k = 0; k < scree_model_law_count(model) && !status; k++)
        status = check_module(model->laws[k].law, "contact law", error);
    if (!status && scree_model_holds(model)) status = check_module(model->persistent.law.law, "bonds by", error);
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        for (int k = 0; k < model->species_count && !status; k++)
            if (scree_modules[m]->shape && scree_modules[m]->shape == model->species[k].shape)
                status = check_module(m, "particles of shape", error);
    for (int64_t k = 0; k < model->load_count && !status; k++)
        status = check_module(model->loads[k].kind, "load", error);
    for (int64_t k = 0; k < model->source_count && !status; k++)
        status = check_module(model->sources[k].kind, "source", error);
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++) {
        const char *alone = scree_modules[m]->alone ? scree_modules[m]->alone(model) : NULL;
        if (alone) status = refuse(scree_modules[m]->name, alone, error);
    }
    return status ? status : check_stages(s, error);
}

// ---- all processes do the same -----------------------------------------------------------------------------------

/// Whether all processes have the same number.
static bool all_have(uint64_t number)
{
    double half[4] = {(double)(number >> 32), (double)(uint32_t)number};
    half[2] = -half[0];
    half[3] = -half[1];
    scree_comm_maximum(NULL, half, 4);
    return half[0] == -half[2] && half[1] == -half[3];
}

scree_status scree_ranks_open(uint64_t case_checksum, scree_status status, scree_error *error)
{
    status = scree_comm_agree(status, error);
    if (status) return status;
    if (!all_have(scree_checksum_bytes(0, scree_version(), strlen(scree_version()))))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "the processes are of different versions of Scree: this one is %s", scree_version());
    if (!all_have(case_checksum))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "the processes have read different cases: see to it that all find the same files");
    return SCREE_OK;
}

scree_status scree_ranks_check_folder(const char *directory, scree_error *error)
{
    enum { LONGEST_TEXT = 512, MOST_TRIES = 20, MOMENT = 100 * 1000 * 1000 };
    char first[LONGEST_TEXT], own[LONGEST_TEXT] = "";
    if (scree_comm_size() == 1) return SCREE_OK;
    scree_folder_lock_text(directory, first, sizeof first);
    scree_comm_share(first, sizeof first);
    // What another machine has written may take a moment to be seen.
    for (int k = 0; k < MOST_TRIES && strcmp(own, first) != 0; k++) {
        if (k > 0) (void)nanosleep(&(struct timespec){.tv_nsec = MOMENT}, NULL);
        scree_folder_lock_text(directory, own, sizeof own);
    }
    scree_status status = SCREE_OK;
    if (strcmp(own, first) != 0)
        status =
            scree_error_set(error, SCREE_ERROR_INPUT,
                            "process %d does not see the folder '%s' that process 0 has locked: all processes write "
                            "into it, so give them one that all machines share",
                            scree_comm_rank(), directory);
    return scree_comm_agree(status, error);
}

double scree_ranks_most(double own)
{
    scree_comm_maximum(NULL, &own, 1);
    return own;
}

void scree_ranks_fail(const scree_run_options *options, const scree_error *error)
{
    char line[sizeof error->message + 64];
    if (scree_comm_size() == 1) return;
    (void)snprintf(line, sizeof line, "process %d: %s; all processes end", scree_comm_rank(), error->message);
    if (options->message) options->message(options->user, SCREE_LOG_WARNING, line);
    scree_comm_stop(error->status);
}

// ---- whole and part ----------------------------------------------------------------------------------------------

/// Nothing here stays as long as the whole was. Some of what was freed lies between what is still there.
static void release_scratch(scree_simulation *s)
{
    scree_neighbours_release(&s->work);
    scree_contact_scratch_destroy(&s->work);
    scree_contact_table_destroy(&s->table);
    scree_memory_trim();
}

static bool is_whole_elsewhere(const scree_simulation *s)
{
    return scree_comm_size() > 1 && scree_parts_are_whole(&s->work);
}

bool scree_ranks_acts(const scree_simulation *s)
{
    return !is_whole_elsewhere(s) || scree_comm_rank() == 0;
}

/// Once in a run, unless particles are still to come.
static void warn_of_empty(scree_simulation *s)
{
    int64_t empty = s->state.count == 0;
    if (s->work.parts->told_empty || s->model.source_count > 0) return;
    scree_comm_add(&s->state, &empty, 1);
    s->work.parts->told_empty = empty > 0;
    if (empty > 0 && !s->warning[0])
        (void)snprintf(s->warning, sizeof s->warning, "%lld of %d processes have no particle: fewer do as well",
                       (long long)empty, scree_comm_size());
}

scree_status scree_ranks_place(scree_simulation *s, scree_error *error)
{
    scree_status status = scree_parts_spread(&s->state, &s->work, error);
    if (!status) warn_of_empty(s);
    release_scratch(s);
    return status ? status : scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
}

scree_status scree_ranks_spread(scree_simulation *s, scree_error *error)
{
    if (!is_whole_elsewhere(s)) return SCREE_OK;
    scree_status status = s->work.valid ? scree_contacts_save(&s->state, &s->work, error) : SCREE_OK;
    if (!status) status = scree_parts_share(&s->state, error);
    if (!status) status = check_stage(s, error);
    return status ? status : scree_ranks_place(s, error);
}

scree_status scree_ranks_return(scree_simulation *s, scree_error *error)
{
    if (!is_whole_elsewhere(s)) return SCREE_OK;
    const bool root = scree_comm_rank() == 0;
    scree_status status = root && s->work.valid ? scree_contacts_save(&s->state, &s->work, error) : SCREE_OK;
    if (!status) status = scree_parts_return(&s->state, &s->work, error);
    if (root) release_scratch(s);
    return status ? status : scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
}

scree_status scree_ranks_gather(scree_simulation *s, const char *what, scree_error *error)
{
    if (scree_comm_size() == 1 || is_whole_elsewhere(s)) return SCREE_OK;
    scree_status status = scree_ranks_save_contacts(s, error);
    s->table.count = 0;
    if (!status) status = scree_parts_gather(&s->state, &s->work, what, error);
    if (status || scree_comm_rank() > 0) return status;
    return scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
}

scree_status scree_ranks_gather_contacts(scree_simulation *s, const char *what, scree_error *error)
{
    if (scree_comm_size() == 1 || is_whole_elsewhere(s)) return SCREE_OK;
    scree_status status = scree_ranks_gather(s, what, error);
    if (status || scree_comm_rank() > 0) return status;
    return scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, error);
}

/// Whether a module has something to do where the stage begins, and looks at the whole sample then.
static bool looks_at_whole(const scree_simulation *s, const scree_module *module, const scree_context *context)
{
    const bool steps = !s->stage->instant;
    if (module->stage && module->stage != s->stage) return false;
    if (module->boundary && (module->boundary != s->boundary || !steps)) return false;
    if (!module->begins_whole) return module->stage || module->boundary || (module->begin && steps);
    return module->begins_whole(context);
}

scree_status scree_ranks_gather_for_begin(scree_simulation *s, scree_error *error)
{
    const scree_context context = scree_step_context(s);
    char what[80];
    for (int m = 0; m < SCREE_MODULE_COUNT && s->state.part; m++) {
        if (!looks_at_whole(s, scree_modules[m], &context)) continue;
        (void)snprintf(what, sizeof what, "begins of stages by %s", scree_modules[m]->name);
        return scree_ranks_gather(s, what, error);
    }
    return SCREE_OK;
}

scree_status scree_ranks_begun(scree_simulation *s, scree_error *error)
{
    if (scree_comm_size() == 1) return SCREE_OK;
    if (is_whole_elsewhere(s)) return scree_ranks_spread(s, error);
    scree_status status = check_stage(s, error);
    // Ghosts have room for the arrays that there were when their list was made.
    if (!status && s->work.valid) status = scree_contacts_save(&s->state, &s->work, error);
    scree_neighbours_invalidate(&s->work);
    s->table.count = 0;
    return status ? status : scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
}

scree_status scree_ranks_save_contacts(scree_simulation *s, scree_error *error)
{
    return s->state.part && !s->work.valid ? SCREE_OK : scree_contacts_save(&s->state, &s->work, error);
}

scree_status scree_ranks_checkpoint(scree_simulation *s, const char *directory, uint64_t case_checksum,
                                    scree_error *error)
{
    scree_ranges ranges = {0};
    scree_status status = scree_ranks_save_contacts(s, error);
    if (!status) status = scree_ranges_open(&s->state, &s->work, &ranges, error);
    if (!status) status = scree_checkpoint_write_ranges(directory, &s->state, &ranges, case_checksum, error);
    scree_ranges_close(&ranges);
    return status;
}

/// Samples, and for whom whole states were put together.
static void log_gathers(const scree_simulation *s, const scree_parts *parts, scree_log *log)
{
    char text[1024] = "";
    size_t used = 0;
    for (size_t k = 0; k < parts->reasons && used < sizeof text; k++) {
        const int more = snprintf(text + used, sizeof text - used, "%s%s (%llu)", k > 0 ? ", " : "",
                                  parts->reason[k].what, (unsigned long long)parts->reason[k].count);
        used += more > 0 ? (size_t)more : 0;
    }
    scree_log_write(log, SCREE_LOG_INFO,
                    "samples: %llu taken in parts, %llu of whole states; whole states were put together, in process 0 "
                    "alone, for: %s",
                    (unsigned long long)s->samples_in_parts, (unsigned long long)s->samples_of_wholes,
                    used > 0 ? text : "nothing");
}

void scree_ranks_log(const scree_simulation *s, scree_log *log)
{
    const scree_parts *parts = s->work.parts;
    if (!parts) return;
    const double lists = fmax(1, (double)parts->lists), messages = fmax(1, (double)parts->steps);
    scree_log_write(log, SCREE_LOG_INFO,
                    "process 0 of %d: %.0f bodies of others near its own, %.0f bytes sent in an exchange; %llu lists, "
                    "%llu cuts of space, %llu bodies sent to others; the whole state put together %llu times, %.3g MB "
                    "in all",
                    scree_comm_size(), (double)parts->ghosts / lists, (double)parts->bytes / messages,
                    (unsigned long long)parts->lists, (unsigned long long)parts->cuts, (unsigned long long)parts->moved,
                    (unsigned long long)parts->gathers, 1e-6 * (double)parts->gathered);
    log_gathers(s, parts, log);
}
