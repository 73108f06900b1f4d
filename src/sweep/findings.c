/// Finding runs: by summary.json (a run) and sweep.json (a sweep, which lists its members).
#include "sweep/findings.h"

#include "base/memory.h"
#include "io/run_directory.h"

#include <scree/scree.h>

#include <dirent.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { DEEPEST = 2 };

static scree_status add(scree_findings *findings, const scree_finding *finding, scree_error *error)
{
    if (findings->count == findings->capacity) {
        size_t larger = findings->capacity ? 2 * findings->capacity : 64;
        scree_status status =
            scree_reallocate(&findings->item, findings->capacity, larger, sizeof *findings->item, error);
        if (status) return status;
        findings->capacity = larger;
    }
    findings->item[findings->count++] = *finding;
    if (finding->realisation >= findings->realisations) findings->realisations = finding->realisation + 1;
    return SCREE_OK;
}

/// A run by itself, when it has ended.
static scree_status add_run(scree_findings *findings, const char *directory, scree_error *error)
{
    scree_finding finding = {.form = SCREE_FINDING_RUN, .confidence = 0.95};
    char status[64];
    if (scree_result_get(directory, "case", finding.name, sizeof finding.name, NULL)) return SCREE_OK;
    if (scree_result_get(directory, "status", status, sizeof status, NULL) || strcmp(status, "done") != 0)
        return SCREE_OK;
    const char *end = directory + strlen(directory);
    while (end > directory + 1 && end[-1] == '/') end--;
    const char *begin = end;
    while (begin > directory && begin[-1] != '/') begin--;
    (void)snprintf(finding.label, sizeof finding.label, "%.*s", (int)(end - begin), begin);
    (void)snprintf(finding.directory, sizeof finding.directory, "%s", directory);
    return add(findings, &finding, error);
}

static scree_status add_member(scree_findings *findings, const char *directory, json_t *sweep, json_t *member,
                               scree_error *error)
{
    scree_finding finding = {.form = json_is_true(json_object_get(sweep, "quick")) ? SCREE_FINDING_QUICK
                                                                                   : SCREE_FINDING_FULL,
                             .confidence = json_number_value(json_object_get(sweep, "confidence")),
                             .realisation = (size_t)json_integer_value(json_object_get(member, "realisation"))};
    char path[500];
    json_t *point =
        json_array_get(json_object_get(sweep, "points"), (size_t)json_integer_value(json_object_get(member, "point")));
    const char *name = json_string_value(json_object_get(sweep, "sweep"));
    const char *label = json_string_value(json_object_get(point, "name"));
    const char *folder = json_string_value(json_object_get(member, "folder"));
    const char *status = json_string_value(json_object_get(member, "status"));
    bool whole = name && label && folder && status && finding.realisation < 100000;
    if (!whole || strcmp(status, "done") != 0) return SCREE_OK;
    (void)snprintf(finding.name, sizeof finding.name, "%s", name);
    (void)snprintf(finding.label, sizeof finding.label, "%s", label);
    (void)snprintf(path, sizeof path, "members/%s", folder);
    scree_status joined = scree_path_join(finding.directory, sizeof finding.directory, directory, path, error);
    return joined ? joined : add(findings, &finding, error);
}

static scree_status add_sweep(scree_findings *findings, const char *directory, const char *path, scree_error *error)
{
    json_error_t problem;
    json_t *sweep = json_load_file(path, 0, &problem), *member;
    size_t index;
    if (!sweep) return scree_error_set(error, SCREE_ERROR_IO, "cannot read '%s': %s", path, problem.text);
    scree_status status = SCREE_OK;
    json_array_foreach(json_object_get(sweep, "members"), index, member) if (!status) status =
        add_member(findings, directory, sweep, member, error);
    json_decref(sweep);
    return status;
}

static scree_status look_into(scree_findings *findings, const char *directory, int depth, scree_error *error);

static scree_status look_below(scree_findings *findings, const char *directory, int depth, scree_error *error)
{
    struct dirent **entry;
    int count = scandir(directory, &entry, NULL, alphasort);
    if (count < 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read the folder '%s'", directory);
    scree_status status = SCREE_OK;
    for (int i = 0; i < count; i++) {
        char path[PATH_MAX];
        bool folder = entry[i]->d_name[0] != '.' && entry[i]->d_type == DT_DIR;
        if (!status && folder) status = scree_path_join(path, sizeof path, directory, entry[i]->d_name, error);
        if (!status && folder) status = look_into(findings, path, depth + 1, error);
        free(entry[i]);
    }
    free(entry);
    return status;
}

static scree_status look_into(scree_findings *findings, const char *directory, int depth, scree_error *error)
{
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, directory, "sweep.json", error);
    if (status) return status;
    if (access(path, F_OK) == 0) return add_sweep(findings, directory, path, error);
    status = scree_path_join(path, sizeof path, directory, SCREE_FILE_SUMMARY, error);
    if (status) return status;
    if (access(path, F_OK) == 0) return add_run(findings, directory, error);
    return depth < DEEPEST ? look_below(findings, directory, depth, error) : SCREE_OK;
}

scree_status scree_findings_add(scree_findings *findings, const char *directory, scree_error *error)
{
    return look_into(findings, directory, 0, error);
}

void scree_findings_destroy(scree_findings *findings)
{
    scree_release(&findings->item);
    *findings = (scree_findings){0};
}

bool scree_findings_have(const scree_findings *findings, const char *name, scree_finding_form form)
{
    for (size_t i = 0; i < findings->count; i++)
        if (findings->item[i].form == form && strcmp(findings->item[i].name, name) == 0) return true;
    return false;
}

const scree_finding *scree_findings_get(const scree_findings *findings, const char *expression_name,
                                        scree_finding_form form, size_t realisation, const char **result)
{
    const char *dot = strrchr(expression_name, '.'), *slash = strchr(expression_name, '/');
    *result = dot ? dot + 1 : "";
    if (!dot) return NULL;
    if (slash > dot) slash = NULL;
    size_t name = (size_t)((slash ? slash : dot) - expression_name), label = slash ? (size_t)(dot - slash - 1) : 0;
    for (size_t i = 0; i < findings->count; i++) {
        const scree_finding *f = &findings->item[i];
        bool named = strlen(f->name) == name && strncmp(f->name, expression_name, name) == 0;
        bool labelled = slash ? strlen(f->label) == label && strncmp(f->label, slash + 1, label) == 0
                              : !f->label[0] || form == SCREE_FINDING_RUN;
        if (named && labelled && f->form == form && f->realisation == realisation) return f;
    }
    return NULL;
}
