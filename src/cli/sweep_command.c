/// Options of sweeps, their progress, and their problems.
#include "cli/sweep_command.h"

#include "cli/stop.h"
#include "cli/terminal.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

enum { MOST_THREADS = 4096, MOST_JOBS = 4096, MOST_REALISATIONS = 10000 };

/// "5 of 12 done, 1 failed, 2 running, 1 min 20 s left"
static void show(void *user, const scree_sweep_progress *progress)
{
    char text[256], left[64];
    size_t used = (size_t)snprintf(text, sizeof text, "%zu of %zu done", progress->done, progress->members);
    if (progress->failed > 0)
        used += (size_t)snprintf(text + used, sizeof text - used, ", %zu failed", progress->failed);
    used += (size_t)snprintf(text + used, sizeof text - used, ", %zu running", progress->running);
    scree_human_duration(left, sizeof left, progress->seconds_left);
    if (!isnan(progress->seconds_left)) (void)snprintf(text + used, sizeof text - used, ", about %s left", left);
    scree_progress_line(user, text);
}

scree_status scree_sweep_command_open(const scree_command *command, scree_sweep_command *sweep)
{
    scree_error error = {0};
    long jobs = 0, threads = 0, ranks = 0, realisations = 0;
    *sweep = (scree_sweep_command){0};
    ssize_t length = readlink("/proc/self/exe", sweep->program, sizeof sweep->program - 1);
    if (length <= 0) {
        scree_command_refuse(&error, "/proc/self/exe", "", "does not tell where this program is");
        return scree_terminal_error(command->verb->name, &error);
    }
    sweep->program[length] = 0;
    scree_status status = scree_command_number(command, "jobs", 1, MOST_JOBS, &jobs, &error);
    if (!status) status = scree_command_number(command, "threads", 1, MOST_THREADS, &threads, &error);
    if (!status) status = scree_command_number(command, "ranks", 1, SCREE_MOST_PROCESSES, &ranks, &error);
    if (!status) status = scree_command_number(command, "realisations", 1, MOST_REALISATIONS, &realisations, &error);
    if (status) return scree_terminal_error(command->verb->name, &error);
    sweep->overrides = calloc(command->option_count + 1, sizeof *sweep->overrides);
    if (!sweep->overrides) {
        error = (scree_error){.status = SCREE_ERROR_IO, .message = "out of memory"};
        return scree_terminal_error(command->verb->name, &error);
    }
    sweep->read = (scree_sweep_read_options){.overrides = sweep->overrides,
                                             .override_count = scree_command_values(command, "set", sweep->overrides),
                                             .quick = scree_command_has(command, "quick"),
                                             .realisations = (size_t)realisations};
    const char *output = scree_command_value(command, "output");
    sweep->options = (scree_sweep_options){.program = sweep->program,
                                           .output = output ? output : "out",
                                           .jobs = (int)jobs,
                                           .threads = (int)threads,
                                           .ranks = (int)ranks,
                                           .retry = scree_command_has(command, "retry"),
                                           .force = scree_command_has(command, "force"),
                                           .figures = !scree_command_has(command, "no-figures"),
                                           .stop = scree_stop_signal(),
                                           .progress = show,
                                           .message = scree_progress_message,
                                           .user = &sweep->display};
    scree_progress_begin(&sweep->display, scree_command_has(command, "quiet"));
    return SCREE_OK;
}

void scree_sweep_command_close(scree_sweep_command *sweep)
{
    scree_progress_end(&sweep->display);
    free(sweep->overrides);
    sweep->overrides = NULL;
}

scree_status scree_sweep_command_read(const scree_command *command, const scree_sweep_command *sweep, const char *name,
                                      scree_sweep **out)
{
    scree_problems *problems = NULL;
    scree_status status = scree_sweep_read(name, &sweep->read, out, &problems);
    size_t count = scree_problems_count(problems);
    for (size_t i = 0; status && i < count; i++)
        (void)scree_terminal_error(command->verb->name, scree_problems_get(problems, i));
    if (status && count > 1) fprintf(stderr, "%zu problems in %s\n", count, name);
    if (status && count == 0) {
        scree_error error = {.status = status, .message = "out of memory"};
        (void)scree_terminal_error(command->verb->name, &error);
    }
    scree_problems_free(problems);
    return status;
}
