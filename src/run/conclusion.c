/// Results of modules.
#include "run/conclusion.h"

#include "average/cuts.h"
#include "io/result_names.h"
#include "run/step.h"

#include <math.h>
#include <stdio.h>

enum { ROWS = 64 }; ///< results of one module

/// Those of what has the number `index`; `about` is its name, empty for the run itself.
static scree_status set_results(const scree_conclusion *run, const scree_results *results, size_t index,
                                const char *about, scree_error *error)
{
    const scree_context context = scree_step_context(run->s);
    double value[ROWS];
    scree_status status = results->measure(&context, index, value, error);
    for (size_t k = 0; k < results->count && !status; k++) {
        char name[SCREE_RESULT_NAME];
        status = scree_result_call(name, about, &results->row[k], error);
        if (!status) scree_summary_set_number(run->summary, name, value[k]);
    }
    return status;
}

static scree_status measure(const scree_conclusion *run, const scree_module *module, scree_error *error)
{
    char about[SCREE_RESULT_NAME] = "";
    if (module->results.count > ROWS)
        return scree_error_set(error, SCREE_ERROR_IO, "module %s has more than %d results", module->name, ROWS);
    if (!module->told) return set_results(run, &module->results, 0, about, error);
    scree_status status = SCREE_OK;
    for (size_t index = 0; !status && module->told(&run->s->c->config, index, about); index++)
        status = set_results(run, &module->results, index, about, error);
    return status;
}

void scree_conclude_few(const scree_conclusion *run, const char *what, double grains, const char *remedy)
{
    char text[200] = "";
    scree_log quiet = *run->log;
    quiet.sink = NULL;
    if (scree_average_are_few(grains)) {
        (void)snprintf(text, sizeof text, "elements of the %s hold %.3g grains, fewer than %d", what, grains,
                       SCREE_AVERAGE_FEW);
        scree_log_write(&quiet, SCREE_LOG_WARNING, "%s: it is noise; %s", text, remedy);
    }
    scree_summary_add_text(run->summary, "warnings", text);
}

scree_status scree_conclude(const scree_conclusion *run, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->results.measure) status = measure(run, scree_modules[m], error);
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->conclude) status = scree_modules[m]->conclude(run, error);
    return status;
}
