/// summary.json: an object of named scalars and texts, in the order in which they were first set.
///
/// Numbers are written with 17 significant digits, so reading gives the same double; what JSON cannot say (NaN and
/// infinity) becomes null. A setter that runs out of memory leaves a mark that the writing reports. Texts are UTF-8;
/// bytes of a text that is not (a path in an old encoding) are replaced by question marks.
#include "io/summary.h"

#include "base/memory.h"
#include "io/result_names.h"
#include "io/run_directory.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

struct scree_summary {
    json_t *root;
    bool incomplete; ///< a setter failed
};

scree_status scree_summary_create(scree_summary **summary, scree_error *error)
{
    scree_status status = scree_allocate(summary, 1, sizeof **summary, error);
    if (status) return status;
    (*summary)->root = json_object();
    if ((*summary)->root) return SCREE_OK;
    scree_release(summary);
    return scree_error_set_memory(error, sizeof(json_t));
}

void scree_summary_destroy(scree_summary *summary)
{
    if (!summary) return;
    json_decref(summary->root);
    scree_release(&summary);
}

static void set_value(scree_summary *summary, const char *name, json_t *value)
{
    if (json_object_set_new(summary->root, name, value) != 0) summary->incomplete = true;
}

void scree_summary_set_number(scree_summary *summary, const char *name, double value)
{
    set_value(summary, name, isfinite(value) ? json_real(value) : json_null());
}

void scree_summary_set_integer(scree_summary *summary, const char *name, int64_t value)
{
    set_value(summary, name, json_integer(value));
}

void scree_summary_set_text(scree_summary *summary, const char *name, const char *value)
{
    json_t *text = json_string(value);
    char *ascii = NULL;
    if (!text && scree_allocate(&ascii, strlen(value) + 1, 1, NULL) == SCREE_OK) {
        for (size_t i = 0; value[i]; i++) ascii[i] = (unsigned char)value[i] < 0x80 ? value[i] : '?';
        text = json_string(ascii);
        scree_release(&ascii);
    }
    set_value(summary, name, text);
}

void scree_summary_add_text(scree_summary *summary, const char *name, const char *value)
{
    char whole[1024];
    const char *held = json_string_value(json_object_get(summary->root, name));
    (void)snprintf(whole, sizeof whole, "%s%s%s", held ? held : "", held && *held && *value ? "; " : "", value);
    scree_summary_set_text(summary, name, whole);
}

double scree_summary_number(const scree_summary *summary, const char *name)
{
    const json_t *value = json_object_get(summary->root, name);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

const char *scree_summary_unknown(const scree_summary *summary)
{
    const char *name;
    json_t *value;
    json_object_foreach(summary->root, name, value) if (!scree_result_name_find(name, NULL)) return name;
    return NULL;
}

scree_status scree_summary_write(const scree_summary *summary, const char *path, scree_error *error)
{
    if (summary->incomplete) return scree_error_set(error, SCREE_ERROR_IO, "cannot write '%s': out of memory", path);
    FILE *file;
    scree_status status = scree_replace_begin(path, &file, error);
    if (status) return status;
    // What json_dumpf cannot write also shows in the stream's error flag, which the finish reports with its cause.
    (void)json_dumpf(summary->root, file, JSON_INDENT(2) | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(17));
    (void)fputc('\n', file);
    return scree_replace_finish(path, file, true, error);
}
