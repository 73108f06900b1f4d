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

static scree_status act(const scree_command *command, const scree_sweep *sweep, scree_sweep_command *call,
                        scree_error *error)
{
    const char *script = scree_command_value(command, "slurm");
    long member = -1, most = (long)scree_sweep_member_count(sweep) - 1;
    if (scree_command_has(command, "dry-run")) {
        list_members(sweep);
        return SCREE_OK;
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
