/// scree run CASE, scree run --restart DIR
#include "cli/case_argument.h"
#include "cli/launch.h"
#include "cli/progress.h"
#include "cli/stop.h"
#include "cli/terminal.h"

#include <stdlib.h>

enum { MOST_THREADS = 4096 };

/// A restart continues the run as it was.
static scree_status check_combination(const scree_command *command, scree_error *error)
{
    static const char *const changes[] = {"set", "quick", "output", "force", "after"};
    bool restart = scree_command_has(command, "restart");
    if (!restart && command->argument_count == 0)
        return scree_command_refuse(error, "CASE", "a case file, the name of a built-in case, or --restart DIR",
                                    "this argument is missing");
    if (restart && command->argument_count > 0)
        return scree_command_refuse(error, "--restart", "", "continues the run of a folder and takes no case: '%s'",
                                    command->argument[0]);
    if (!restart && scree_command_has(command, "from"))
        return scree_command_refuse(error, "--from", "", "goes with --restart DIR only");
    for (size_t i = 0; restart && i < sizeof changes / sizeof changes[0]; i++)
        if (scree_command_has(command, changes[i]))
            return scree_command_refuse(error, "--restart", "", "continues a run as it was: --%s does not go with it",
                                        changes[i]);
    return SCREE_OK;
}

/// Says on standard error how the run ended and what can be done with it.
static scree_status report(scree_status status, const char *folder, bool quiet, const scree_error *error)
{
    if (scree_processes_number() > 0) return status;
    if (status == SCREE_OK && !quiet) fprintf(stderr, "results in %s; `scree get %s` prints them\n", folder, folder);
    if (status == SCREE_OK) return SCREE_OK;
    return scree_terminal_error("run", error);
}

/// Reads the case; one process says what is wrong with it.
static scree_status read_case(const scree_command *command, scree_case **c)
{
    scree_error error = {0};
    const int kept = scree_launch_hush();
    scree_status status = scree_case_argument_read(command, command->argument[0], c);
    scree_launch_speak(kept);
    if (status)
        (void)snprintf(error.message, sizeof error.message, "process %d cannot read the case: is it where all find it?",
                       scree_processes_number());
    error.status = status;
    const bool fine = status == SCREE_OK;
    status = scree_processes_agree(status, &error);
    if (status && fine && scree_processes_number() == 0) (void)scree_terminal_error("run", &error);
    return status;
}

scree_status scree_verb_run(const scree_command *command)
{
    scree_error error = {0};
    scree_progress_display display;
    static const char *const balances[] = {"counts", "time", NULL};
    long threads = 0;
    size_t balance = 0;
    scree_run_options options = {
        .figures = !scree_command_has(command, "no-figures"),
        .force = scree_command_has(command, "force"),
        .stop = scree_stop_signal(),
        .progress = scree_progress_show,
        .message = scree_progress_message,
        .user = &display,
    };
    const int kept = scree_launch_hush();
    scree_status status = check_combination(command, &error);
    if (!status) status = scree_command_number(command, "threads", 1, MOST_THREADS, &threads, &error);
    if (!status) status = scree_command_choice(command, "balance", balances, &balance, &error);
    if (status) status = scree_terminal_error("run", &error);
    scree_launch_speak(kept);
    if (status) return status;
    options.threads = (int)threads;
    options.balance_by_time = balance == 1;
    if (scree_processes_number() > 0) options.progress = NULL;
    const char *restart = scree_command_value(command, "restart"), *output = scree_command_value(command, "output");
    options.from = scree_command_value(command, "from");
    options.after = scree_command_value(command, "after");
    options.output = restart ? restart : output ? output : "out";
    scree_case *c = NULL;
    if (!restart) status = read_case(command, &c);
    if (status) return status;
    scree_stop_catch();
    scree_progress_begin(&display, scree_command_has(command, "quiet"));
    status = restart ? scree_restart(restart, &options, &error) : scree_run(c, &options, &error);
    scree_progress_end(&display);
    scree_case_free(c);
    return report(status, options.output, display.quiet, &error);
}
