/// scree reproduce: all built-in sweeps, then the page that compares them with the sources.
#include "cli/report.h"
#include "cli/stop.h"
#include "cli/sweep_command.h"
#include "cli/terminal.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// --only names a built-in sweep.
static scree_status check_only(const char *only, scree_error *error)
{
    const char *names[256]; // for the nearest one
    size_t count = 0;
    for (size_t i = 0; i < scree_sweep_builtin_count(); i++) {
        const char *name = scree_sweep_builtin_name(i);
        if (!only || strcmp(only, name) == 0) return SCREE_OK;
        if (count < sizeof names / sizeof *names) names[count++] = name;
    }
    const char *nearest = scree_nearest(only, names, count);
    return scree_command_refuse(error, only, nearest ? nearest : "see scree list --sweeps",
                                "there is no built-in sweep of this name");
}

/// Runs one sweep into OUTPUT/NAME. What goes wrong is printed; only an interrupt ends the whole.
static scree_status run_one(const scree_command *command, scree_sweep_command *call, const char *output,
                            const char *name)
{
    char path[PATH_MAX];
    scree_sweep *sweep;
    scree_error error = {0};
    if (!call->display.quiet) fprintf(stderr, "--- %s\n", name);
    scree_status status = scree_sweep_command_read(command, call, name, &sweep);
    if (status) {
        fprintf(stderr, "%s: not available\n", name);
        return status;
    }
    if (scree_sweep_lacks(sweep)) {
        fprintf(stderr, "%s: not run: it needs the program '%s', which is not installed\n", name,
                scree_sweep_lacks(sweep));
        scree_sweep_free(sweep);
        return SCREE_OK;
    }
    if (snprintf(path, sizeof path, "%s/%s", output, name) >= (int)sizeof path) {
        scree_sweep_free(sweep);
        scree_command_refuse(&error, "--output", "", "this path is too long");
        return scree_terminal_error("reproduce", &error);
    }
    call->options.output = path;
    status = scree_sweep_run(sweep, &call->options, &error);
    scree_progress_end(&call->display);
    if (status) (void)scree_terminal_error("reproduce", &error);
    scree_sweep_free(sweep);
    return status;
}

/// Whether it is a quick form of which the page would say nothing; told, unless it is to be quiet.
static bool is_left_out(const scree_sweep_command *call, const char *name)
{
    if (!call->read.quick || scree_report_judges(name, true)) return false;
    if (!call->display.quiet)
        fprintf(stderr, "%s: left out: it judges nothing in the quick form; --only %s runs it\n", name, name);
    return true;
}

static scree_status run_all(const scree_command *command, scree_sweep_command *call, const char *output)
{
    const char *only = scree_command_value(command, "only");
    scree_status result = SCREE_OK;
    scree_stop_catch();
    for (size_t i = 0; i < scree_sweep_builtin_count(); i++) {
        const char *name = scree_sweep_builtin_name(i);
        if (only ? strcmp(only, name) != 0 : is_left_out(call, name)) continue;
        scree_status status = run_one(command, call, output, name);
        if (status == SCREE_INTERRUPTED) return status;
        if (status) result = SCREE_ERROR_GUARD;
    }
    return result;
}

/// Where no sweep was available there is no folder yet; what cannot be made shows when the page is written.
static void make_folders(const char *path)
{
    char part[PATH_MAX];
    for (const char *end = strchr(path + 1, '/'); end; end = strchr(end + 1, '/')) {
        (void)snprintf(part, sizeof part, "%.*s", (int)(end - path), path);
        (void)mkdir(part, 0777);
    }
    (void)mkdir(path, 0777);
}

/// The page on everything that lies in the folder, also of earlier calls.
static scree_status write_page(const char *output, bool quiet)
{
    char path[PATH_MAX];
    make_folders(output);
    (void)snprintf(path, sizeof path, "%s/reproduction.md", output);
    scree_report_options options = {.directory = &output, .directory_count = 1};
    scree_status status = scree_report_to_file("reproduce", &options, path);
    if (status) return status;
    if (!quiet) fprintf(stderr, "%s\n", path);
    return SCREE_OK;
}

scree_status scree_verb_reproduce(const scree_command *command)
{
    scree_error error = {0};
    scree_sweep_command call;
    scree_status status = check_only(scree_command_value(command, "only"), &error);
    if (status) return scree_terminal_error("reproduce", &error);
    status = scree_sweep_command_open(command, &call);
    bool full = scree_command_has(command, "full");
    const char *output = scree_command_value(command, "output");
    if (!output) output = full ? "out-reproduce/full" : "out-reproduce/quick";
    call.read.quick = !full;
    if (!status) status = run_all(command, &call, output);
    if (status == SCREE_OK || status == SCREE_ERROR_GUARD) {
        scree_status written = write_page(output, call.display.quiet);
        if (written) status = written;
    }
    scree_sweep_command_close(&call);
    return status;
}
