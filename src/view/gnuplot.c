/// gnuplot as a program.
#include "view/gnuplot.h"

#include "base/program.h"

#include <errno.h>
#include <stdio.h>

scree_status scree_gnuplot_run(const char *folder, const char *script, scree_error *error)
{
    char name[300];
    (void)snprintf(name, sizeof name, "./%s", script);
    const char *const arguments[] = {"gnuplot", "--default-settings", name, NULL};
    const scree_program program = {.folder = folder, .arguments = arguments};
    scree_program_end end;
    if (scree_program_run(&program, &end, error))
        return scree_error_set_errno(error, SCREE_ERROR_IO,
                                     "no chart was drawn: cannot run gnuplot (Debian package gnuplot-nox) in '%s'",
                                     folder);
    if (end.done) return SCREE_OK;
    if (end.missing)
        return scree_error_set(error, SCREE_ERROR_IO, "no chart was drawn: gnuplot could not be started in '%s'",
                               folder);
    return scree_error_set(error, SCREE_ERROR_IO, "gnuplot failed on '%s/%s': %s", folder, script, end.said);
}
