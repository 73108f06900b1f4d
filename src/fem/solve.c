/// CalculiX 2.20 as a program: fem.inp -> ccx fem -> fem.dat. What else it writes is removed, its log is kept.
#include "fem/solve.h"

#include "base/program.h"
#include "fem/solid.h"
#include "io/manifest.h"
#include "io/run_directory.h"

#include <limits.h>
#include <string.h>
#include <unistd.h>

#define STEM "fem"
#define LOG  STEM ".log"

static const char *const passing[] = {STEM ".frd", STEM ".12d", STEM ".cvg", STEM ".sta", STEM ".cel", "spooles.out"};
enum { PASSING = sizeof passing / sizeof *passing };

bool scree_fem_is_there(void)
{
    return scree_program_is_there("ccx");
}

scree_status scree_fem_deck_open(const char *directory, FILE **deck, scree_error *error)
{
    static const char *const endings[] = {".dat", ".log"};
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, directory, STEM, error);
    if (!status) status = scree_manifest_add(path, endings, sizeof endings / sizeof *endings, error);
    for (size_t k = 0; k < PASSING && !status; k++) {
        status = scree_path_join(path, sizeof path, directory, passing[k], error);
        if (!status) status = scree_manifest_add(path, (const char *const[]){""}, 1, error);
    }
    if (!status) status = scree_path_join(path, sizeof path, directory, STEM ".inp", error);
    return status ? status : scree_replace_begin(path, deck, error);
}

void scree_fem_deck_set(FILE *deck, const char *name, const int64_t *node, size_t count, int64_t shift)
{
    fprintf(deck, "*NSET, NSET=%s\n", name);
    for (size_t k = 0; k < count; k++)
        fprintf(deck, "%lld,%s", (long long)(node[k] + shift), (k + 1) % 8 == 0 || k + 1 == count ? "\n" : " ");
}

// ---- running -----------------------------------------------------------------------------------------------------

/// What ccx says behind "*ERROR", which may go on in the next line.
static void find_complaint(const char *directory, char *text, size_t size)
{
    char path[PATH_MAX], line[300];
    (void)snprintf(text, size, "it did not say why");
    FILE *file = scree_path_join(path, sizeof path, directory, LOG, NULL) ? NULL : fopen(path, "r");
    while (file && fgets(line, sizeof line, file)) {
        if (!strstr(line, "*ERROR")) continue;
        (void)snprintf(text, size, "%s", strstr(line, "*ERROR") + 1);
        const size_t used = strlen(text);
        if (used + 1 < size && fgets(line, sizeof line, file)) (void)snprintf(text + used, size - used, "%s", line);
        break;
    }
    if (file) fclose(file);
    for (char *c = text; *c; c++)
        if (*c == '\n') *c = ' ';
}

static void remove_passing(const char *directory)
{
    char path[PATH_MAX];
    for (size_t k = 0; k < PASSING; k++)
        if (!scree_path_join(path, sizeof path, directory, passing[k], NULL)) (void)unlink(path);
}

/// ccx ends with status 0 after some of its errors, so the last line of its log decides.
static bool has_finished(const char *directory)
{
    char path[PATH_MAX], line[300];
    bool finished = false;
    FILE *file = scree_path_join(path, sizeof path, directory, LOG, NULL) ? NULL : fopen(path, "r");
    while (file && fgets(line, sizeof line, file)) finished |= strstr(line, "Job finished") != NULL;
    if (file) fclose(file);
    return finished;
}

scree_status scree_fem_deck_solve(const char *directory, FILE *deck, scree_error *error)
{
    static const char *const arguments[] = {"ccx", STEM, NULL};
    const scree_program program = {.folder = directory, .arguments = arguments, .log = LOG};
    char path[PATH_MAX], said[400];
    scree_program_end end;
    scree_status status = scree_path_join(path, sizeof path, directory, STEM ".inp", error);
    if (!status) status = scree_replace_finish(path, deck, true, error);
    if (!status) status = scree_path_join(path, sizeof path, directory, STEM ".dat", error);
    if (status) return status;
    // Results of an older solve must not be taken for those of this one.
    (void)unlink(path);
    status = scree_program_run(&program, &end, error);
    if (status) return status;
    remove_passing(directory);
    if (end.done && has_finished(directory)) return SCREE_OK;
    find_complaint(directory, said, sizeof said);
    return scree_error_set(error, SCREE_ERROR_IO, "CalculiX (ccx) failed on '%s/" STEM ".inp': %s (see " LOG ")",
                           directory, said);
}

// ---- reading -----------------------------------------------------------------------------------------------------

/// " displacements (vx,vy,vz) for set NAME and time  0.5E-01": whether the line begins a table.
static bool read_head(const char *line, char set[64], scree_fem_row *row)
{
    const char *name = strstr(line, " for set ");
    if (!name || sscanf(name, " for set %63s and time %lf", set, &row->time) != 2) return false;
    row->set = set;
    row->total = strstr(line, "total force") != NULL;
    return true;
}

static bool read_row(const char *line, scree_fem_row *row)
{
    long long node = 0;
    double *v = row->value;
    const int got = row->total ? sscanf(line, "%lf %lf %lf", &v[0], &v[1], &v[2])
                               : sscanf(line, "%lld %lf %lf %lf", &node, &v[0], &v[1], &v[2]);
    row->node = node;
    return got == (row->total ? 3 : 4);
}

scree_status scree_fem_read(const char *directory, void (*visit)(void *user, const scree_fem_row *row), void *user,
                            scree_error *error)
{
    char path[PATH_MAX], line[300], set[64] = "";
    scree_fem_row row = {.set = set};
    scree_status status = scree_path_join(path, sizeof path, directory, STEM ".dat", error);
    if (status) return status;
    FILE *file = fopen(path, "r");
    if (!file) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read the results '%s'", path);
    while (fgets(line, sizeof line, file))
        if (!read_head(line, set, &row) && set[0] && read_row(line, &row)) visit(user, &row);
    const bool broken = ferror(file) != 0;
    fclose(file);
    return broken ? scree_error_set(error, SCREE_ERROR_IO, "cannot read the results '%s'", path) : SCREE_OK;
}
