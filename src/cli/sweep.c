/// scree sweep SWEEP
#include "cli/stop.h"
#include "cli/sweep_command.h"
#include "cli/terminal.h"

#include <string.h>

enum { COMMAND_SIZE = 8192 };

/// What the call is about: one of these at a time.
static scree_status check_combination(const scree_command *command, scree_error *error)
{
    static const char *const ways[] = {"dry-run", "slurm", "member", "collect"};
    const char *first = NULL;
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        if (!scree_command_has(command, ways[i])) continue;
        if (first) return scree_command_refuse(error, ways[i], "", "does not go with --%s", first);
        first = ways[i];
    }
    if (scree_command_has(command, "dry-run") && scree_command_has(command, "ranks"))
        return scree_command_refuse(error, "ranks", "",
                                    "does not go with --dry-run, which tells the cost of one process; `scree check "
                                    "CASE --ranks N` tells that of several");
    return SCREE_OK;
}

static void list_members(const scree_sweep *sweep)
{
    char line[COMMAND_SIZE];
    for (size_t i = 0; i < scree_sweep_member_count(sweep); i++) {
        scree_sweep_member_command(sweep, i, line, sizeof line);
        printf("%s: %s\n", scree_sweep_member_folder(sweep, i), line);
    }
}

/// A time in the unit that suits it.
static void print_time(FILE *file, double seconds)
{
    if (seconds < 120)
        fprintf(file, "%.2g s", seconds);
    else if (seconds < 7200)
        fprintf(file, "%.3g min", seconds / 60);
    else
        fprintf(file, "%.3g h", seconds / 3600);
}

/// On standard error, so that the list can be run by a shell.
static scree_status say_cost(const scree_command *command, const scree_sweep *sweep, scree_error *error)
{
    scree_sweep_cost cost;
    scree_status status = scree_sweep_estimate_cost(sweep, !scree_command_has(command, "no-figures"), &cost, error);
    if (status) return status;
    fprintf(stderr, "%zu members%s: ", cost.members,
            cost.searches ? ", each a search of some ten runs; one run of each" : "");
    print_time(stderr, cost.seconds);
    fputs(" of processor time, each on one thread; the longest ", stderr);
    print_time(stderr, cost.longest);
    fprintf(stderr, ", at most %.3g MB each", cost.memory / 1e6);
    if (cost.unknown > 0) fprintf(stderr, "; %zu have a time that is not known before", cost.unknown);
    fputc('\n', stderr);
    return SCREE_OK;
}

static scree_status act(const scree_command *command, const scree_sweep *sweep, scree_sweep_command *call,
                        scree_error *error)
{
    const char *script = scree_command_value(command, "slurm");
    long member = -1, most = (long)scree_sweep_member_count(sweep) - 1;
    if (scree_command_has(command, "dry-run")) {
        list_members(sweep);
        return say_cost(command, sweep, error);
    }
    if (script) return scree_sweep_write_slurm(sweep, &call->read, &call->options, script, error);
    scree_status status = scree_command_number(command, "member", 0, most, &member, error);
    if (status) return status;
    scree_stop_catch();
    if (member >= 0) return scree_sweep_run_member(sweep, (size_t)member, &call->options, error);
    if (scree_command_has(command, "collect")) return scree_sweep_collect(sweep, &call->options, error);
    return scree_sweep_run(sweep, &call->options, error);
}

static void say_what_there_is(const scree_command *command, const char *output)
{
    const char *script = scree_command_value(command, "slurm");
    if (scree_command_has(command, "dry-run") || scree_command_has(command, "member")) return;
    if (script)
        fprintf(stderr, "submit it with `sbatch %s`\n", script);
    else
        fprintf(stderr, "means in %s/table.csv, members in %s/members.csv, figures in %s/figures\n", output, output,
                output);
}

scree_status scree_verb_sweep(const scree_command *command)
{
    scree_error error = {0};
    scree_sweep_command call;
    scree_sweep *sweep = NULL;
    scree_status status = check_combination(command, &error);
    if (status) return scree_terminal_error("sweep", &error);
    status = scree_sweep_command_open(command, &call);
    if (!status) status = scree_sweep_command_read(command, &call, command->argument[0], &sweep);
    if (!status) {
        status = act(command, sweep, &call, &error);
        scree_progress_end(&call.display);
        if (status) (void)scree_terminal_error("sweep", &error);
        if ((!status || status == SCREE_ERROR_GUARD) && !call.display.quiet)
            say_what_there_is(command, call.options.output);
    }
    scree_sweep_free(sweep);
    scree_sweep_command_close(&call);
    return status;
}
