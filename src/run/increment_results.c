/// The end of a run against an earlier stage of it: what two states say together (average/increment.h), as results.
///
/// Both states are read from the snapshots of the run, so that a restarted run gives the same; a stage has one at its
/// end.
#include "average/increment.h"
#include "case/check.h"
#include "io/sample_file.h"
#include "module/key_rows.h"
#include "run/conclusion.h"

#include <string.h>

typedef struct config {
    char *compare_with; ///< name of a stage
} config;

static const scree_key keys[] = {
    KEY(config, compare_with, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning =
            "Name of a stage: the end of the run is compared with its last snapshot (strains, changes of stress, "
            "elastic constants); auto: with none."),
};

static const config *own_config(const scree_config *whole)
{
    return whole->measure.own ? scree_config_own(&scree_module_increments, "measure", whole->measure.own) : NULL;
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    enum { MOST = 100 };
    const config *own = own_config(whole);
    const char *names[MOST];
    size_t count = 0;
    if (!own || !own->compare_with) return;
    for (int64_t k = 0; k < whole->stage_count && k < MOST; k++) {
        if (!whole->stages[k].name) continue;
        if (strcmp(whole->stages[k].name, own->compare_with) == 0) return;
        names[count++] = whole->stages[k].name;
    }
    scree_rule_refuse_name(reader, "measure.compare_with", "stage", own->compare_with, names, count);
}

typedef struct numbers {
    int64_t stage; ///< number of the stage; -1: none
} numbers;

static scree_status resolve(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_increments, "measure", model->config->measure.own);
    numbers *n = scree_model_reserve_numbers(model, SCREE_SLOT_increments);
    (void)error;
    n->stage = -1;
    for (int64_t k = 0; own && own->compare_with && k < model->stage_count; k++)
        if (model->stages[k].name && strcmp(model->stages[k].name, own->compare_with) == 0) n->stage = k;
    return SCREE_OK;
}

/// The last snapshot of the stage, and that of the end.
static scree_status find_states(const scree_conclusion *run, const char *stage, int64_t *before, int64_t *after,
                                scree_error *error)
{
    scree_snapshot_mark *mark;
    size_t count;
    scree_status status = scree_snapshot_marks(run->directory, &mark, &count, error);
    if (status) return status;
    *before = -1;
    for (size_t k = 0; k < count; k++)
        if (strcmp(mark[k].stage_name, stage) == 0) *before = mark[k].index;
    *after = mark[count - 1].index;
    scree_release(&mark);
    return *before >= 0 ? SCREE_OK
                        : scree_error_set(error, SCREE_ERROR_INPUT, "there is no snapshot of stage '%s'", stage);
}

static scree_status compare(const scree_conclusion *run, const char *stage, double value[SCREE_INCREMENT_ROWS],
                            scree_error *error)
{
    scree_average_sample before = {0}, after = {0};
    int64_t from, to;
    scree_status status = find_states(run, stage, &from, &to, error);
    if (!status) status = scree_sample_read(run->directory, from, &before, error);
    if (!status) status = scree_average_sample_finish(&before, error);
    if (!status) status = scree_sample_read(run->directory, to, &after, error);
    if (!status) status = scree_average_move(&after, &before, error);
    if (!status) status = scree_average_sample_finish(&after, error);
    if (!status) status = scree_average_increment_find(&before, &after, 0, value, error);
    scree_average_sample_destroy(&before);
    scree_average_sample_destroy(&after);
    return status;
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const scree_model *model = &run->s->model;
    const numbers *n = scree_model_numbers(model, SCREE_SLOT_increments);
    double value[SCREE_INCREMENT_ROWS];
    scree_error problem = {0};
    if (!n || n->stage < 0) return SCREE_OK;
    scree_status status = compare(run, model->stages[n->stage].name, value, &problem);
    // What cannot be compared is no reason to lose the other results.
    if (status == SCREE_ERROR_INPUT) {
        scree_log_write(run->log, SCREE_LOG_WARNING, "no comparison with stage '%s': %s", model->stages[n->stage].name,
                        problem.message);
        return SCREE_OK;
    }
    if (status && error) *error = problem;
    if (!status) scree_summary_set_text(run->summary, "compared_with", model->stages[n->stage].name);
    for (size_t k = 0; k < SCREE_INCREMENT_ROWS && !status; k++)
        scree_summary_set_number(run->summary, scree_increment_rows[k].name, value[k]);
    return status;
}

const scree_module scree_module_increments = {
    .name = "increments",
    .meaning = "the end of the run against an earlier stage: strains, changes of stress, elastic constants",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(numbers),
    .resolve = resolve,
    .results = {.row = scree_increment_rows, .count = SCREE_INCREMENT_ROWS + 1},
    .conclude = conclude,
};
