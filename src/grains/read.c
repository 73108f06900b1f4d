/// The table of formats. A format is found out by how a file begins; what begins as none is a table.
#include "grains/format.h"

#include "base/file_bytes.h"
#include "base/memory.h"

#include <string.h>

static const grain_format *const formats[] = {&grain_format_yade, &grain_format_lammps_dump, &grain_format_lammps_data,
                                              &grain_format_csv, NULL};
const char *const scree_grains_formats[] = {"csv", "lammps_dump", "lammps_data", "yade", "run", NULL};

static const grain_format *find(const char *name, const char *bytes)
{
    for (const grain_format *const *f = formats; *f; f++)
        if (name ? strcmp((*f)->name, name) == 0 : (*f)->is(bytes)) return *f;
    return name ? NULL : &grain_format_csv;
}

static scree_status check(const grain_text *text, const scree_grains *g, scree_error *error)
{
    static const char *const needed[] = {"x", "y"};
    if (g->count == 0) return grain_text_refuse(text, SIZE_MAX, error, "the file has no grains");
    for (int c = 0; c < 2; c++)
        if (!g->column[c]) return grain_text_refuse(text, SIZE_MAX, error, "the column %s is missing", needed[c]);
    return SCREE_OK;
}

static scree_status read_text(const char *path, const scree_grains_options *options, scree_grains *grains,
                              scree_error *error)
{
    char *bytes = NULL;
    size_t length;
    scree_status status = scree_file_load(path, &bytes, &length, error);
    grain_text text = {.path = path, .next = bytes, .commas = ""};
    if (!status && memchr(bytes, 0, length))
        status = grain_text_refuse(&text, SIZE_MAX, error, "this is not a text file: it has a NUL character");
    const grain_format *format = status ? NULL : find(options->format, bytes);
    if (format) {
        grains->format = format->name;
        status = format->read(&text, options, grains, error);
        if (!status) status = check(&text, grains, error);
    }
    scree_release(&bytes);
    return status;
}

scree_status scree_grains_read(const char *path, const scree_grains_options *options, scree_grains *grains,
                               scree_error *error)
{
    *grains = (scree_grains){0};
    const bool run = options->format ? strcmp(options->format, "run") == 0 : grain_run_is(path);
    const scree_status status = (run ? grain_run_read : read_text)(path, options, grains, error);
    if (status) scree_grains_destroy(grains);
    return status;
}

void scree_grains_destroy(scree_grains *grains)
{
    for (int c = 0; c < SCREE_GRAIN_COLUMNS; c++) scree_release(&grains->column[c]);
    scree_release(&grains->kind);
    scree_release(&grains->id);
    *grains = (scree_grains){0};
}
