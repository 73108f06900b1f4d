/// Results of modules.
#include "run/conclusion.h"

#include "io/result_names.h"
#include "run/step.h"

#include <math.h>

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

scree_status scree_conclude(const scree_conclusion *run, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->results.measure) status = measure(run, scree_modules[m], error);
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->conclude) status = scree_modules[m]->conclude(run, error);
    return status;
}
