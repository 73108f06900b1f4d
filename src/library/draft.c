/// Drafts: a text of a case and the keys that overrule it, kept until they are checked together.
#include "base/handle.h"
#include "base/memory.h"
#include "case/case.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct scree_draft {
    char *text, *name;
    size_t length;
    char **override; ///< "key=value"
    size_t count, capacity;
    bool quick;
};

void scree_draft_free(scree_draft *draft)
{
    if (!draft) return;
    scree_handle_freed(draft, "a draft");
    for (size_t k = 0; k < draft->count; k++) free(draft->override[k]);
    scree_release(&draft->override);
    scree_release(&draft->text);
    free(draft->name);
    scree_release(&draft);
}

scree_status scree_draft_parse(const char *text, size_t length, const char *name, scree_draft **out, scree_error *error)
{
    scree_draft *draft;
    *out = NULL;
    scree_status status = scree_allocate(&draft, 1, sizeof *draft, error);
    if (status) return status;
    scree_handle_made(draft);
    status = scree_allocate(&draft->text, length + 1, 1, error);
    draft->name = strdup(name);
    if (!status && !draft->name) status = scree_error_set_memory(error, strlen(name) + 1);
    if (status) {
        scree_draft_free(draft);
        return status;
    }
    memcpy(draft->text, text, length);
    draft->length = length;
    *out = draft;
    return SCREE_OK;
}

scree_status scree_draft_builtin(const char *name, scree_draft **out, scree_error *error)
{
    enum { MOST = 256 };
    const char *text = scree_template_text(name), *names[MOST];
    *out = NULL;
    if (text) return scree_draft_parse(text, strlen(text), name, out, error);
    size_t count = scree_template_count() < MOST ? scree_template_count() : MOST;
    for (size_t k = 0; k < count; k++) names[k] = scree_template_name(k);
    const char *nearest = scree_nearest(name, names, count);
    scree_status status =
        scree_error_set(error, SCREE_ERROR_INPUT, "there is no built-in case '%s'%s%s%s", name,
                        nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    if (error && nearest) (void)snprintf(error->accepted, sizeof error->accepted, "%s", nearest);
    return status;
}

scree_status scree_draft_read(const char *path, scree_draft **out, scree_error *error)
{
    char *text;
    size_t length;
    scree_problems *problems = NULL;
    *out = NULL;
    scree_status status = scree_case_text(path, &text, &length, &problems);
    if (status) {
        if (error && scree_problems_count(problems) > 0) *error = *scree_problems_get(problems, 0);
        scree_problems_free(problems);
        return status;
    }
    status = scree_draft_parse(text, length, path, out, error);
    scree_release(&text);
    return status;
}

scree_status scree_draft_set(scree_draft *draft, const char *key, const char *value, scree_error *error)
{
    scree_handle_check(draft, "a draft");
    if (draft->count == draft->capacity) {
        size_t capacity = 2 * draft->capacity + 8;
        scree_status status =
            scree_reallocate(&draft->override, draft->count, capacity, sizeof *draft->override, error);
        if (status) return status;
        draft->capacity = capacity;
    }
    size_t size = strlen(key) + strlen(value) + 2;
    char *text = malloc(size);
    if (!text) return scree_error_set_memory(error, size);
    (void)snprintf(text, size, "%s=%s", key, value);
    draft->override[draft->count++] = text;
    return SCREE_OK;
}

scree_status scree_draft_set_number(scree_draft *draft, const char *key, double value, scree_error *error)
{
    char text[40];
    // Case files are read with a point whatever the locale of the program is.
    (void)snprintf(text, sizeof text, "%.17g", value);
    char *comma = strchr(text, ',');
    if (comma) *comma = '.';
    return scree_draft_set(draft, key, text, error);
}

void scree_draft_set_quick(scree_draft *draft, bool quick)
{
    scree_handle_check(draft, "a draft");
    draft->quick = quick;
}

scree_status scree_draft_check(const scree_draft *draft, scree_case **out, scree_problems **problems)
{
    scree_handle_check(draft, "a draft");
    const scree_case_options options = {
        .overrides = (const char *const *)draft->override, .override_count = draft->count, .quick = draft->quick};
    return scree_case_parse(draft->text, draft->length, draft->name, &options, out, problems);
}
