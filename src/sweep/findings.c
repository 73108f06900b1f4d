/// Finding runs: by summary.json (a run) and sweep.json (a sweep, which lists its members). Whether a member is done is
/// what its own summary.json says: sweep.json may be older.
#include "sweep/findings.h"
#include "sweep/member.h"

#include "base/memory.h"
#include "io/run_directory.h"

#include <scree/scree.h>

#include <dirent.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *const scree_finding_form_names[] = {"full", "quick", "run"};

enum { DEEPEST = 2 };

/// A run that is there already, with the same seed of the same point.
static scree_finding *find_twin(const scree_findings *findings, const scree_finding *finding)
{
    for (size_t i = 0; i < findings->count; i++) {
        scree_finding *f = &findings->item[i];
        bool same = f->form == finding->form && f->seed == finding->seed && strcmp(f->name, finding->name) == 0;
        if (same && strcmp(f->label, finding->label) == 0) return f;
    }
    return NULL;
}

static scree_status add(scree_findings *findings, const scree_finding *finding, scree_error *error)
{
    scree_finding *twin = find_twin(findings, finding);
    if (twin) {
        if (twin->state != SCREE_FINDING_DONE && finding->state == SCREE_FINDING_DONE) *twin = *finding;
        return SCREE_OK;
    }
    if (findings->count == findings->capacity) {
        size_t larger = findings->capacity ? 2 * findings->capacity : 64;
        scree_status status =
            scree_reallocate(&findings->item, findings->capacity, larger, sizeof *findings->item, error);
        if (status) return status;
        findings->capacity = larger;
    }
    findings->item[findings->count++] = *finding;
    return SCREE_OK;
}

static double number_of(json_t *summary, const char *name)
{
    json_t *value = json_object_get(summary, name);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

/// Fills in what the run's own summary says; false when it has none.
static bool read_summary(scree_finding *finding)
{
    char path[PATH_MAX + 32];
    (void)snprintf(path, sizeof path, "%s/" SCREE_FILE_SUMMARY, finding->directory);
    json_t *summary = json_load_file(path, 0, NULL);
    if (!summary) return false;
    const char *status = json_string_value(json_object_get(summary, "status"));
    const char *commit = json_string_value(json_object_get(summary, "commit"));
    const char *version = json_string_value(json_object_get(summary, "version"));
    if (status && strcmp(status, "done") == 0) finding->state = SCREE_FINDING_DONE;
    if (status && strcmp(status, "stopped") == 0) finding->state = SCREE_FINDING_FAILED;
    if (finding->form == SCREE_FINDING_RUN) {
        const char *name = json_string_value(json_object_get(summary, "case"));
        (void)snprintf(finding->name, sizeof finding->name, "%s", name ? name : "");
        finding->seed = (long long)json_integer_value(json_object_get(summary, "seed"));
    }
    finding->particles = number_of(summary, "particles");
    finding->friction = number_of(summary, "confine_friction");
    finding->solid_fraction = number_of(summary, "solid_fraction_at_start");
    finding->gap_scatter = number_of(summary, "packing_gap_scatter");
    finding->unbalanced = number_of(summary, "earlier_unbalanced");
    finding->coordination = number_of(summary, "coordination_at_start");
    (void)snprintf(finding->build, sizeof finding->build, "%s", commit && commit[0] ? commit : version ? version : "");
    const char *quasistatic = json_string_value(json_object_get(summary, "quasistatic"));
    const char *account = json_string_value(json_object_get(summary, "quasistatic_reason"));
    finding->hasty = quasistatic && strcmp(quasistatic, "no") == 0;
    finding->kinetic_over_elastic = number_of(summary, "kinetic_over_elastic");
    (void)snprintf(finding->account, sizeof finding->account, "%s", account ? account : "");
    json_decref(summary);
    return true;
}

static const scree_finding nothing = {.state = SCREE_FINDING_MISSING,
                                      .particles = NAN,
                                      .friction = NAN,
                                      .solid_fraction = NAN,
                                      .gap_scatter = NAN,
                                      .unbalanced = NAN,
                                      .coordination = NAN,
                                      .kinetic_over_elastic = NAN};

/// A run by itself, when it has ended.
static scree_status add_run(scree_findings *findings, const char *directory, scree_error *error)
{
    scree_finding finding = nothing;
    finding.form = SCREE_FINDING_RUN;
    const char *end = directory + strlen(directory);
    while (end > directory + 1 && end[-1] == '/') end--;
    const char *begin = end;
    while (begin > directory && begin[-1] != '/') begin--;
    (void)snprintf(finding.label, sizeof finding.label, "%.*s", (int)(end - begin), begin);
    (void)snprintf(finding.directory, sizeof finding.directory, "%s", directory);
    bool there = read_summary(&finding) && finding.name[0] && finding.state != SCREE_FINDING_MISSING;
    return there ? add(findings, &finding, error) : SCREE_OK;
}

scree_status scree_ensemble_folder(char *path, size_t size, const char *directory, const char *point,
                                   scree_error *error)
{
    char name[220];
    (void)snprintf(name, sizeof name, "ensemble/%s", point[0] ? point : "all");
    return scree_path_join(path, size, directory, name, error);
}

/// What a member that failed printed last, up to the end of its first sentence, without the name of the program.
static void read_cause(scree_finding *finding)
{
    char log[PATH_MAX + 8], said[1024];
    (void)snprintf(log, sizeof log, "%s.txt", finding->directory);
    scree_member_last_words(log, said, sizeof said);
    const char *begin = strncmp(said, "scree ", 6) == 0 ? strstr(said, ": ") : NULL;
    begin = begin ? begin + 2 : said;
    size_t length = strlen(begin);
    static const char *const ends[] = {"; ", ". "};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
        const char *end = strstr(begin, ends[k]);
        if (end && (size_t)(end - begin) < length) length = (size_t)(end - begin);
    }
    (void)snprintf(finding->cause, sizeof finding->cause, "%.*s", (int)length, begin);
}

static scree_status add_member(scree_findings *findings, const char *directory, json_t *sweep, json_t *member,
                               scree_error *error)
{
    scree_finding finding = nothing;
    char path[500];
    json_t *point =
        json_array_get(json_object_get(sweep, "points"), (size_t)json_integer_value(json_object_get(member, "point")));
    const char *name = json_string_value(json_object_get(sweep, "sweep"));
    const char *label = json_string_value(json_object_get(point, "name"));
    const char *folder = json_string_value(json_object_get(member, "folder"));
    const char *status = json_string_value(json_object_get(member, "status"));
    if (!name || !label || !folder) return SCREE_OK;
    finding.form = json_is_true(json_object_get(sweep, "quick")) ? SCREE_FINDING_QUICK : SCREE_FINDING_FULL;
    finding.seed = (long long)json_integer_value(json_object_get(member, "seed"));
    if (status && strcmp(status, "failed") == 0) finding.state = SCREE_FINDING_FAILED;
    (void)snprintf(finding.name, sizeof finding.name, "%s", name);
    (void)snprintf(finding.label, sizeof finding.label, "%s", label);
    (void)snprintf(path, sizeof path, "members/%s", folder);
    scree_status joined = scree_path_join(finding.directory, sizeof finding.directory, directory, path, error);
    if (!joined) joined = scree_ensemble_folder(finding.ensemble, sizeof finding.ensemble, directory, label, error);
    if (joined) return joined;
    (void)read_summary(&finding);
    if (finding.state == SCREE_FINDING_FAILED) read_cause(&finding);
    return add(findings, &finding, error);
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

bool scree_reference_read(const char *text, scree_reference *reference)
{
    const char *dot = strrchr(text, '.'), *slash = strchr(text, '/');
    if (!dot || dot == text || !dot[1]) return false;
    if (slash > dot) slash = NULL;
    size_t name = (size_t)((slash ? slash : dot) - text), label = slash ? (size_t)(dot - slash - 1) : 0;
    *reference = (scree_reference){.labelled = slash != NULL};
    if (name == 0 || name >= sizeof reference->name || label >= sizeof reference->label ||
        strlen(dot + 1) >= sizeof reference->result)
        return false;
    memcpy(reference->name, text, name);
    if (slash) memcpy(reference->label, slash + 1, label);
    (void)snprintf(reference->result, sizeof reference->result, "%s", dot + 1);
    return true;
}

bool scree_finding_is(const scree_finding *f, const scree_reference *reference, scree_finding_form form)
{
    if (f->form != form || strcmp(f->name, reference->name) != 0) return false;
    if (!reference->labelled) return !f->label[0] || form == SCREE_FINDING_RUN;
    return strcmp(f->label, reference->label) == 0;
}

bool scree_finding_same_sample(const scree_finding *a, const scree_finding *b)
{
    const bool unmeasured = isnan(a->solid_fraction) && isnan(b->solid_fraction);
    const bool alike = unmeasured ? a->gap_scatter == b->gap_scatter || a->unbalanced == b->unbalanced
                                  : a->solid_fraction == b->solid_fraction;
    return a == b || (a->seed == b->seed && a->particles == b->particles && alike);
}
