/// The small cases of tests/reference/cases, each run to its end, and the table of their checksums. Used by the test
/// that compares and by the tool that writes the table.
#ifndef SCREE_TESTS_REFERENCE_CASES_H
#define SCREE_TESTS_REFERENCE_CASES_H

#include "run/simulation.h"

#include <glob.h>
#include <inttypes.h>
#include <string.h>

#define REFERENCE_FOLDER SCREE_SOURCE_DIR "/tests/reference/"
#define REFERENCE_CASES  REFERENCE_FOLDER "cases/*.yaml"
#define REFERENCE_END    (UINT64_MAX / 2) /* more steps than any case has */
#define REFERENCE_TABLE  REFERENCE_FOLDER "small.txt"

/// The name of a case: its file without folder and ending.
static inline void reference_name(const char *path, char name[64])
{
    const char *file = strrchr(path, '/');
    (void)snprintf(name, 64, "%s", file ? file + 1 : path);
    char *ending = strrchr(name, '.');
    if (ending) *ending = 0;
}

/// What is wrong with a case goes to standard error.
static inline scree_status reference_read(const char *path, const char *override, scree_case **c)
{
    scree_case_options options = {.overrides = &override, .override_count = override ? 1 : 0};
    scree_problems *problems;
    scree_status status = scree_case_read(path, &options, c, &problems);
    for (size_t k = 0; status && k < scree_problems_count(problems); k++)
        fprintf(stderr, "%s: %s\n", path, scree_problems_get(problems, k)->message);
    if (status) scree_problems_free(problems);
    return status;
}

/// Runs the case in `path`, with one value changed unless override is NULL, to its end or for `most` steps. Returns the
/// checksum of its last state.
static inline scree_status reference_run(const char *path, const char *override, int threads, uint64_t most,
                                         uint64_t *checksum)
{
    scree_case *c = NULL;
    scree_simulation *s = NULL;
    scree_error error;
    bool done = false;
    scree_status status = reference_read(path, override, &c);
    if (status) return status;
    status = scree_simulation_create(c, threads, &s, &error);
    // Also where the machine is busy.
    if (!status) s->work.keep_threads = true;
    if (!status) status = scree_simulation_advance(s, most, &done, &error);
    if (status)
        fprintf(stderr, "%s: %s\n", path, error.message);
    else
        *checksum = scree_simulation_checksum(s);
    scree_simulation_free(s);
    scree_case_free(c);
    return status;
}

/// The stored checksum of `name`; false when the table has none.
static inline bool reference_stored(const char *name, uint64_t *checksum)
{
    char line[160], known[64];
    bool found = false;
    FILE *table = fopen(REFERENCE_TABLE, "r");
    while (table && !found && fgets(line, sizeof line, table))
        found = line[0] != '#' && sscanf(line, "%63s %" SCNx64, known, checksum) == 2 && strcmp(known, name) == 0;
    if (table) fclose(table);
    return found;
}

#endif
