/// The columns of walls.csv.
#include "run/wall_series.h"
#include "state/case_walls.h"

#include "io/run_directory.h"
#include "shape/container.h"

#include <stdio.h>
#include <string.h>

/// Columns of one wall, and those before the first.
enum { OF_WALL = 10, BEFORE = 2, MOST = BEFORE + OF_WALL * SCREE_SURFACES, NAME = 96 };

static const struct {
    const char *name, *unit, *meaning;
} of_wall[OF_WALL] = {
    {"force_x", "N", "force of the particles on the wall"},
    {"force_y", "N", "force of the particles on the wall"},
    {"force_z", "N", "force of the particles on the wall"},
    {"torque_x", "N m", "torque of the particles on the wall, about its centre"},
    {"torque_y", "N m", "torque of the particles on the wall, about its centre"},
    {"torque_z", "N m", "torque of the particles on the wall, about its centre"},
    {"work", "J", "work of the wall on the particles since the begin of the run"},
    {"displacement_x", "m", "of the centre of the wall since the begin of the run"},
    {"displacement_y", "m", "of the centre of the wall since the begin of the run"},
    {"displacement_z", "m", "of the centre of the wall since the begin of the run"},
};

scree_status scree_wall_series_open(scree_series_writer *writer, const scree_simulation *s, const char *directory,
                                    bool restart, scree_error *error)
{
    const scree_config *config = s->model.config;
    char path[4096], name[MOST][NAME];
    scree_series_column column[MOST] = {{"step", "1", "simulated time in ticks"}, {"time", "s", "simulated time"}};
    size_t count = BEFORE;
    if (config->wall_count == 0) return SCREE_OK;
    for (int64_t w = 0; w < config->wall_count; w++)
        for (int k = 0; k < OF_WALL; k++, count++) {
            (void)snprintf(name[count], NAME, "%s_%s", config->walls[w].name, of_wall[k].name);
            column[count] = (scree_series_column){name[count], of_wall[k].unit, of_wall[k].meaning};
        }
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_WALLS, error);
    return status ? status
                  : scree_series_open(writer, path, column, count, restart ? s->state.stage.samples : -1, error);
}

scree_status scree_wall_series_append(scree_series_writer *writer, const scree_simulation *s, scree_error *error)
{
    double value[MOST] = {(double)s->state.step, scree_state_time(&s->state)};
    if (!writer->file) return SCREE_OK;
    for (int64_t w = 0; w < s->model.config->wall_count; w++) {
        const scree_surface_load *load = &scree_case_walls(&s->state)->load[w];
        double *of = &value[BEFORE + OF_WALL * w];
        memcpy(of, load->force, sizeof load->force);
        memcpy(of + 3, load->torque, sizeof load->torque);
        of[6] = load->work;
        memcpy(of + 7, s->work.container->surface[w].shift, sizeof(scree_vector));
    }
    return scree_series_append(writer, value, error);
}
