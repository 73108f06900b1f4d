/// scree run CASE, scree run --restart DIR
#include "cli/case_argument.h"
#include "cli/progress.h"
#include "cli/terminal.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_THREADS = 4096 };

/// A signal handler can reach nothing else.
static volatile sig_atomic_t stop_signal;

static void ask_to_stop(int signal_number)
{
    static const char note[] = "\nstopping after a checkpoint; a second signal ends at once\n";
    int number = errno;
    stop_signal = signal_number;
    ssize_t ignored = write(STDERR_FILENO, note, sizeof note - 1);
    (void)ignored;
    errno = number;
}

/// The first signal asks; the handler is then gone, so a second one ends the process.
static void catch_signals(void)
{
    struct sigaction action = {.sa_handler = ask_to_stop, .sa_flags = SA_RESTART | (int)SA_RESETHAND};
    (void)sigaction(SIGINT, &action, NULL);
    (void)sigaction(SIGTERM, &action, NULL);
}

static scree_status read_threads(const scree_command *command, int *threads, scree_error *error)
{
    const char *text = scree_command_value(command, "threads");
    *threads = 0;
    if (!text) return SCREE_OK;
    char *end;
    long value = strtol(text, &end, 10);
    if (end == text || *end || value < 1 || value > MOST_THREADS)
        return scree_command_refuse(error, "--threads", "a number from 1 to 4096", "'%s' is not a number of threads",
                                    text);
    *threads = (int)value;
    return SCREE_OK;
}

/// A restart continues the run as it was.
static scree_status check_combination(const scree_command *command, scree_error *error)
{
    static const char *const changes[] = {"set", "quick", "output", "force"};
    bool restart = scree_command_has(command, "restart");
    if (!restart && command->argument_count == 0)
        return scree_command_refuse(error, "CASE", "a case file, the name of a built-in case, or --restart DIR",
                                    "this argument is missing");
    if (restart && command->argument_count > 0)
        return scree_command_refuse(error, "--restart", "", "continues the run of a folder and takes no case: '%s'",
                                    command->argument[0]);
    for (size_t i = 0; restart && i < sizeof changes / sizeof changes[0]; i++)
        if (scree_command_has(command, changes[i]))
            return scree_command_refuse(error, "--restart", "", "continues a run as it was: --%s does not go with it",
                                        changes[i]);
    return SCREE_OK;
}

/// Says on standard error how the run ended and what can be done with it.
static scree_status report(scree_status status, const char *folder, bool quiet, const scree_error *error)
{
    if (status == SCREE_OK && !quiet) fprintf(stderr, "results in %s; `scree get %s` prints them\n", folder, folder);
    if (status == SCREE_OK) return SCREE_OK;
    return scree_terminal_error("run", error);
}

scree_status scree_verb_run(const scree_command *command)
{
    scree_error error = {0};
    scree_progress_display display;
    scree_run_options options = {
        .figures = !scree_command_has(command, "no-figures"),
        .force = scree_command_has(command, "force"),
        .stop = &stop_signal,
        .progress = scree_progress_show,
        .message = scree_progress_message,
        .user = &display,
    };
    scree_status status = check_combination(command, &error);
    if (!status) status = read_threads(command, &options.threads, &error);
    if (status) return scree_terminal_error("run", &error);
    const char *restart = scree_command_value(command, "restart"), *output = scree_command_value(command, "output");
    options.output = restart ? restart : output ? output : "out";
    scree_case *c = NULL;
    if (!restart) status = scree_case_argument_read(command, command->argument[0], &c);
    if (status) return status;
    catch_signals();
    scree_progress_begin(&display, scree_command_has(command, "quiet"));
    status = restart ? scree_restart(restart, &options, &error) : scree_run(c, &options, &error);
    scree_progress_end(&display);
    scree_case_free(c);
    return report(status, options.output, display.quiet, &error);
}
