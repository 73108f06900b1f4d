/// scree report DIR...
#include "cli/report.h"
#include "cli/command.h"
#include "cli/terminal.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

/// Prints what is wrong: all problems of a table of statements, or `error`.
static void tell(const char *verb, const scree_problems *problems, const scree_error *error)
{
    size_t count = scree_problems_count(problems);
    for (size_t i = 0; i < count; i++) (void)scree_terminal_error(verb, scree_problems_get(problems, i));
    if (count == 0) (void)scree_terminal_error(verb, error);
}

/// Nothing is replaced before the page is there.
static bool put_file(const char *path, const char *text, size_t length)
{
    FILE *file = path ? fopen(path, "we") : stdout;
    bool written = file && fwrite(text, 1, length, file) == length;
    if (file && path) written &= fclose(file) == 0;
    return written;
}

/// Figures of NAME.md lie beside it in NAME-figures.
static void find_figures(const char *path, char folder[PATH_MAX], scree_report_options *options)
{
    const size_t length = path ? strlen(path) : 0;
    const size_t stem = length > 3 && strcmp(path + length - 3, ".md") == 0 ? length - 3 : length;
    if (!path || stem + 16 > PATH_MAX) return;
    (void)snprintf(folder, PATH_MAX, "%.*s-figures", (int)stem, path);
    const char *slash = strrchr(folder, '/');
    options->figures = folder;
    options->figures_link = slash ? slash + 1 : folder;
}

/// The page as it stands, to be freed; NULL if there is none.
static char *read_page(const char *path)
{
    FILE *file = path ? fopen(path, "re") : NULL;
    if (!file) return NULL;
    char *text = NULL;
    size_t space = 0;
    // A page has no character 0: one line.
    if (getdelim(&text, &space, '\0', file) < 0) {
        free(text);
        text = NULL;
    }
    (void)fclose(file);
    return text;
}

scree_status scree_report_to_file(const char *verb, const scree_report_options *given, const char *path)
{
    scree_report_options with_figures = *given;
    const scree_report_options *options = &with_figures;
    char *text = NULL, folder[PATH_MAX];
    size_t length;
    scree_error error = {.status = SCREE_ERROR_IO, .message = "out of memory"};
    scree_problems *problems = NULL;
    find_figures(path, folder, &with_figures);
    size_t kept = 0;
    char *former = read_page(path);
    with_figures.former = former;
    with_figures.kept = &kept;
    FILE *memory = open_memstream(&text, &length);
    if (!memory) return scree_terminal_error(verb, &error);
    scree_status status = scree_report_write(options, memory, &problems, &error);
    bool whole = fclose(memory) == 0;
    if (!status && (!whole || !put_file(path, text, length))) {
        error = (scree_error){.status = status = SCREE_ERROR_IO};
        (void)snprintf(error.message, sizeof error.message, "cannot write '%s': %s", path ? path : "standard output",
                       strerror(errno));
    }
    if (status) tell(verb, problems, &error);
    if (!status && kept > 0)
        (void)fprintf(stderr, "%s: %zu cases stay as %s had them, from more realisations than the folders hold\n", verb,
                      kept, path);
    free(former);
    scree_problems_free(problems);
    free(text);
    return status;
}

scree_status scree_verb_report(const scree_command *command)
{
    scree_error error = {.status = SCREE_ERROR_IO, .message = "out of memory"};
    const char **statements = calloc(command->option_count + 1, sizeof *statements);
    if (!statements) return scree_terminal_error("report", &error);
    scree_report_options options = {.directory = command->argument,
                                    .directory_count = command->argument_count,
                                    .statements = statements,
                                    .statement_count = scree_command_values(command, "statements", statements)};
    scree_status status = scree_report_to_file("report", &options, scree_command_value(command, "output"));
    free(statements);
    return status;
}
