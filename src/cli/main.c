/// The program `scree`: finds the verb, reads the rest of the command line against its row of the table, calls it.
#include "cli/command.h"
#include "cli/help.h"
#include "cli/launch.h"
#include "cli/terminal.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// A closed standard stream is replaced, so that no file of a run gets its number and receives what is printed. Writing
/// to its replacement fails.
static void keep_standard_streams(void)
{
    for (int stream = 0; stream <= 2; stream++)
        if (fcntl(stream, F_GETFD) < 0) (void)open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
}

/// What the environment chooses (scree_environment).
static scree_status read_environment(void)
{
    static const struct {
        const char *name;
        scree_status (*choose)(const char *text, scree_error *error);
    } choices[] = {{"SCREE_ISA", scree_instruction_set_choose}, {"SCREE_PIXELS", scree_figure_pixels_choose}};
    scree_error error;
    for (size_t k = 0; k < sizeof choices / sizeof *choices; k++) {
        const char *text = getenv(choices[k].name);
        if (!text || !*text || !choices[k].choose(text, &error)) continue;
        (void)snprintf(error.field, sizeof error.field, "%s", choices[k].name);
        return scree_terminal_error(NULL, &error);
    }
    return SCREE_OK;
}

/// What was printed has to arrive. A verb that failed has said why; a reader that has gone away (`scree get out | head
/// -1`) knows that itself.
static scree_status finish_output(scree_status status)
{
    errno = 0;
    if ((fflush(stdout) == 0 && !ferror(stdout)) || status) return status;
    if (errno != EPIPE) fprintf(stderr, "scree: cannot write standard output: %s\n", strerror(errno ? errno : EIO));
    return SCREE_ERROR_IO;
}

static scree_status call_verb(const scree_verb *verb, int count, char *const *words)
{
    scree_command command;
    scree_error error;
    scree_status status = scree_command_parse(verb, (size_t)count, words, &command, &error);
    if (status)
        status = scree_terminal_error(verb->name, &error);
    else if (scree_command_has(&command, "help"))
        scree_help_write_verb(stdout, verb);
    else if (!verb->alone || scree_launch_allows(verb))
        status = verb->function(&command);
    else
        status = SCREE_ERROR_INPUT;
    scree_command_free(&command);
    return status;
}

static scree_status find_verb(int count, char **words)
{
    size_t used;
    if (scree_help_write_group(stdout, (size_t)count, (const char *const *)words, true)) return SCREE_OK;
    const scree_verb *verb = scree_verb_match((size_t)count, (const char *const *)words, &used);
    return verb ? call_verb(verb, count - (int)used, words + used) : SCREE_ERROR_INPUT;
}

int main(int argc, char **argv)
{
    keep_standard_streams();
    // A write that cannot succeed fails, with a message; it does not end the program.
    (void)signal(SIGPIPE, SIG_IGN);
    (void)signal(SIGXFSZ, SIG_IGN);
    if (argc < 2) {
        scree_help_write(stderr);
        return SCREE_ERROR_INPUT;
    }
    scree_status status = read_environment();
    if (status) return (int)status;
    const char *first = argv[1];
    if (strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
        scree_help_write(stdout);
    else if (strcmp(first, "--version") == 0 || strcmp(first, "-V") == 0)
        printf("scree %s\n", scree_version());
    else
        status = find_verb(argc - 1, argv + 1);
    scree_processes_leave();
    return (int)finish_output(status);
}
