/// scree bisect CASE: the limit of a number of a case, found by runs.
#include "cli/case_argument.h"
#include "cli/stop.h"
#include "cli/sweep_command.h"
#include "cli/terminal.h"

#include <math.h>
#include <stdlib.h>

/// An option that has to be given.
static scree_status take(const scree_command *command, const char *name, const char **value, scree_error *error)
{
    char field[64];
    *value = scree_command_value(command, name);
    (void)snprintf(field, sizeof field, "--%s", name);
    return *value ? SCREE_OK : scree_command_refuse(error, field, "", "this option is missing");
}

static scree_status read_bisection(const scree_command *command, scree_bisection *what, scree_error *error)
{
    *what = (scree_bisection){.tolerance = 0.001, .below = NAN, .above = NAN, .target = NAN};
    scree_status status = take(command, "key", &what->key, error);
    if (!status) status = take(command, "from", &what->between[0], error);
    if (!status) status = take(command, "to", &what->between[1], error);
    if (!status) status = take(command, "measure", &what->measure, error);
    what->curve = scree_command_value(command, "curve");
    if (!status) status = scree_command_real(command, "tolerance", &what->tolerance, error);
    if (!status) status = scree_command_real(command, "below", &what->below, error);
    if (!status) status = scree_command_real(command, "above", &what->above, error);
    if (!status) status = scree_command_real(command, "target", &what->target, error);
    return status;
}

scree_status scree_verb_bisect(const scree_command *command)
{
    scree_error error = {0};
    scree_sweep_command call;
    scree_bisection what;
    scree_bisection_result result;
    scree_case *c = NULL;
    scree_status status = read_bisection(command, &what, &error);
    if (status) return scree_terminal_error("bisect", &error);
    if ((status = scree_sweep_command_open(command, &call))) return status;
    status = scree_case_argument_read(command, command->argument[0], &c);
    if (!status) {
        scree_stop_catch();
        status = scree_bisect(c, &what, &call.options, &result, &error);
        scree_progress_end(&call.display);
        if (status)
            (void)scree_terminal_error("bisect", &error);
        else if (!isnan(what.target))
            printf("%s: %s is %.6g at %.9g, after %d runs; a test begins there by\n"
                   "scree run CASE --set %s=%.17g --after %s/runs/%02d\n",
                   what.key, what.measure, result.measured, result.found, result.runs, what.key, result.found,
                   call.options.output, result.nearest);
        else
            printf("%s: stands at %.9g, not at %.9g, after %d runs: limit %.6g\n", what.key, result.stands,
                   result.fails, result.runs, result.limit);
    }
    scree_case_free(c);
    scree_sweep_command_close(&call);
    return status;
}
