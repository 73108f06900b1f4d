/// Named results of a run, read from its summary.json.
///
/// A number is given with the fewest digits (15 at least, 17 at most) that read back as the same double: 0.1 comes out
/// as 0.1 and nothing is lost. null (a value that does not exist, such as a peak that was not reached) is `nan`.
#include "case/case.h"
#include "io/result_names.h"
#include "io/run_directory.h"
#include "io/summary.h"

#include <jansson.h>

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { VALUE_SIZE = 4096, MOST_NAMES = 1024 };

static scree_status read_summary(const char *directory, json_t **root, scree_error *error)
{
    char path[PATH_MAX], log[PATH_MAX];
    json_error_t problem;
    *root = NULL;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_SUMMARY, error);
    if (!status) status = scree_path_join(log, sizeof log, directory, SCREE_FILE_LOG, error);
    if (status) return status;
    if (access(path, F_OK) != 0 && access(log, F_OK) == 0)
        return scree_error_set(error, SCREE_ERROR_IO,
                               "the run in '%s' has no results yet: it goes on, or it was stopped", directory);
    FILE *file = fopen(path, "re");
    if (!file)
        return scree_error_set_errno(error, SCREE_ERROR_IO, "there is no run in '%s': cannot read '%s'", directory,
                                     path);
    *root = json_loadf(file, 0, &problem);
    fclose(file);
    if (json_is_object(*root)) return SCREE_OK;
    scree_error_set(error, SCREE_ERROR_IO, "the results of this run are damaged: %s",
                    *root ? "not an object" : problem.text);
    if (error) {
        (void)snprintf(error->file, sizeof error->file, "%.255s", path);
        error->line = *root ? 1 : problem.line;
        error->column = *root ? 1 : problem.column;
    }
    json_decref(*root);
    *root = NULL;
    return SCREE_ERROR_IO;
}

static void format_number(double number, char *text, size_t size)
{
    for (int digits = 15; digits <= 17; digits++) {
        (void)snprintf(text, size, "%.*g", digits, number);
        if (strtod(text, NULL) == number) return;
    }
}

static void format_value(const json_t *value, char *text, size_t size)
{
    if (json_is_string(value))
        (void)snprintf(text, size, "%s", json_string_value(value));
    else if (json_is_integer(value))
        (void)snprintf(text, size, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    else if (json_is_real(value))
        format_number(json_real_value(value), text, size);
    else if (json_is_boolean(value))
        (void)snprintf(text, size, "%s", json_is_true(value) ? "true" : "false");
    else
        (void)snprintf(text, size, "nan");
}

/// The value under its name, or under one that it had in an earlier version.
static const json_t *find_value(const json_t *root, const char *name, const scree_former_result *former)
{
    const json_t *found = json_object_get(root, name);
    for (const scree_former_result *row = former; !found && row->was; row++)
        if (strcmp(row->name, name) == 0) found = json_object_get(root, row->was);
    return found;
}

scree_status scree_result_get(const char *directory, const char *name, char *value, size_t size, scree_error *error)
{
    return scree_result_find(directory, name, scree_former_results, value, size, error);
}

/// Whether it is what `scree measure` tells of several runs beside a result that there is: its interval, a test of it.
static bool is_of_several(const json_t *root, const char *name)
{
    static const char *const told[] = {"_checked_low", "_checked_high", "_checked", "_low",
                                       "_high",        "_height",       "_p",       "_place"};
    char whole[128];
    for (size_t k = 0; k < sizeof told / sizeof *told; k++) {
        if (!scree_result_ends(name, told[k])) continue;
        (void)snprintf(whole, sizeof whole, "%.*s", (int)(strlen(name) - strlen(told[k])), name);
        return json_is_number(json_object_get(root, whole)) && !scree_result_name_find(name, NULL);
    }
    return false;
}

scree_status scree_result_find(const char *directory, const char *name, const scree_former_result *former, char *value,
                               size_t size, scree_error *error)
{
    json_t *root;
    scree_status status = read_summary(directory, &root, error);
    if (status) return status;
    const json_t *found = find_value(root, name, former);
    if (found) {
        format_value(found, value, size);
    } else if (is_of_several(root, name)) {
        status = scree_error_set(error, SCREE_ERROR_INPUT,
                                 "there is no result '%s' in '%s': it is one of several runs, of which `scree measure "
                                 "RUN RUN RUN -o DIR` tells it; then `scree get DIR %s`",
                                 name, directory, name);
    } else {
        const char *names[MOST_NAMES];
        size_t count = 0;
        const char *key;
        json_t *each;
        json_object_foreach(root, key, each) if (count < MOST_NAMES) names[count++] = key;
        const char *nearest = scree_nearest(name, names, count);
        status = scree_error_set(error, SCREE_ERROR_INPUT, "there is no result '%s' in '%s'", name, directory);
        if (error && nearest) (void)snprintf(error->accepted, sizeof error->accepted, "%s", nearest);
    }
    json_decref(root);
    return status;
}

scree_status scree_result_visit(const char *directory, void (*visit)(void *user, const char *name, const char *value),
                                void *user, scree_error *error)
{
    json_t *root;
    scree_status status = read_summary(directory, &root, error);
    if (status) return status;
    const char *name;
    json_t *value;
    char text[VALUE_SIZE];
    json_object_foreach(root, name, value)
    {
        format_value(value, text, sizeof text);
        visit(user, name, text);
    }
    json_decref(root);
    return SCREE_OK;
}
