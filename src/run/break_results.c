/// Table of the bonds that broke, breaks.csv: written at the end from the state, so that a restart neither loses nor
/// repeats one.
#include "bond/bond.h"
#include "io/run_directory.h"
#include "run/conclusion.h"

#include <limits.h>
#include <stdio.h>

static void write_row(FILE *file, int dimension, const scree_break *event)
{
    fprintf(file, "%.9g,%llu,%u,%u,%s", event->time, (unsigned long long)event->step, event->first, event->second,
            event->mode == SCREE_BREAK_TENSION ? "tension" : "shear");
    for (int k = 0; k < dimension; k++) fprintf(file, ",%.9g", event->place[k]);
    for (int k = 0; k < dimension; k++) fprintf(file, ",%.9g", event->normal[k]);
    fprintf(file, ",%.9g,%.9g,%.9g\n", event->normal_force, event->tangential_force, event->energy);
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const scree_state *state = &run->s->state;
    const scree_bonds *bonds = scree_bonds_of(state);
    char path[PATH_MAX];
    FILE *file;
    if (bonds->made == 0) return SCREE_OK;
    scree_status status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_BREAKS, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    fputs("time [s],step [1],first [1],second [1],mode", file);
    fputs(state->dimension == 3 ? ",x [m],y [m],z [m],normal_x [1],normal_y [1],normal_z [1]"
                                : ",x [m],y [m],normal_x [1],normal_y [1]",
          file);
    fputs(",normal_force [N],tangential_force [N],energy [J]\n", file);
    for (size_t k = 0; k < bonds->count; k++) write_row(file, state->dimension, &bonds->event[k]);
    return scree_replace_finish(path, file, true, error);
}

const scree_module scree_module_breaks = {
    .name = "breaks",
    .meaning = "table of the bonds that broke",
    .conclude = conclude,
};
