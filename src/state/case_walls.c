/// The walls of a case as a module: what is stored of them, and their time.
#include "state/case_walls.h"

#include "base/checksum.h"
#include "case/wall_motion.h"
#include "state/wall_servo.h"
#include "state/work.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

typedef scree_case_wall_set own;

#define WALL(member, components, unit, meaning)                                                                        \
    SCREE_FIELD_FIXED(case_walls, own, load, SCREE_SURFACES, scree_surface_load, member, "case_walls/" #member,        \
                      SCREE_FIELD_DOUBLE, components, unit, meaning, .snapshot = true)
#define ONE(...) SCREE_FIELD_ONE(case_walls, own, __VA_ARGS__)
static const scree_field fields[] = {
    WALL(force, 3, "N", "force of the bodies on each wall of the case"),
    WALL(torque, 3, "N m", "torque of the bodies on each wall of the case, about its centre"),
    WALL(work, 1, "J", "work of each wall of the case on the bodies"),
    WALL(travel, 1, "m", "way of each wall under servo along its direction"),
    WALL(speed, 1, "m/s", "speed of each wall under servo in the last step"),
    ONE(ticks, "scalars/surface_ticks", SCREE_FIELD_UINT64, 1, "1",
        "ticks for which the walls of the case have been moving", SCREE_RANGE_TO(SCREE_LIMIT_STEP)),
    ONE(moving, "scalars/surface_moving", SCREE_FIELD_UINT64, 1, "1", "1: the walls of the case move now",
        SCREE_RANGE(0, 1)),
    ONE(speed, "scalars/surface_speed", SCREE_FIELD_DOUBLE, 1, "m/s", "bound of the velocity of the walls of the case",
        SCREE_RANGE(0, DBL_MAX)),
};

static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const scree_case_wall_set *walls = scree_case_walls(state);
    double time = scree_case_walls_time(walls, state), shift[3], velocity[3];
    for (int64_t w = 0; w < model->wall_count; w++) {
        const scree_config_wall *wall = &model->walls_of_case[w];
        scree_wall_shift(wall, walls->load[w].travel, time, shift);
        scree_wall_velocity(wall, walls->load[w].speed, time, state->step_size, velocity);
        for (int k = 0; k < 3; k++) {
            c = scree_checksum_number(c, wall->centre[k] + shift[k]);
            c = scree_checksum_number(c, wall->spin[k] * time);
            c = scree_checksum_number(c, walls->moving ? velocity[k] : 0);
            c = scree_checksum_number(c, walls->moving ? wall->spin[k] : 0);
        }
    }
    return c;
}

uint64_t scree_case_walls_that_move(const scree_model *model, const scree_state *state)
{
    const scree_case_wall_set *walls = scree_case_walls(state);
    const double time = scree_case_walls_time(walls, state);
    uint64_t moving = 0;
    for (int64_t w = 0; walls->moving && w < model->wall_count; w++) {
        const scree_config_wall *wall = &model->walls_of_case[w];
        scree_vector velocity;
        if (scree_wall_stands(wall)) continue;
        scree_wall_velocity(wall, walls->load[w].speed, time, state->step_size, velocity);
        if (scree_length(velocity) > 0 || scree_length(wall->spin) > 0) moving |= UINT64_C(1) << w;
    }
    return moving;
}

/// Speeds of the walls under servo from the forces at n.
static scree_status decide(const scree_context *c, scree_error *error)
{
    scree_case_wall_set *walls = scree_case_walls(c->state);
    double time = scree_case_walls_time(walls, c->state), unit[3];
    (void)error;
    for (int64_t w = 0; w < c->model->wall_count; w++) {
        const scree_config_wall *wall = &c->model->walls_of_case[w];
        scree_surface_load *load = &walls->load[w];
        if (!scree_wall_motions[wall->motion].servo) continue;
        scree_wall_shift(wall, 1, time, unit);
        load->speed = walls->moving ? scree_wall_servo_speed(c->model, c->state, wall, load->speed,
                                                             -scree_dot(load->force, unit), time)
                                    : 0;
    }
    return SCREE_OK;
}

static scree_status follow(const scree_context *c, scree_error *error)
{
    (void)error;
    scree_case_wall_set *walls = scree_case_walls(c->state);
    if (!walls->moving) return SCREE_OK;
    walls->ticks += c->work->ticks;
    for (int64_t w = 0; w < c->model->wall_count; w++)
        walls->load[w].travel += c->state->step_size * walls->load[w].speed;
    return SCREE_OK;
}

static const scree_pass passes[] = {{SCREE_PHASE_DECIDE, .run = decide}, {SCREE_PHASE_FOLLOW, .run = follow}};

// ---- what each wall tells ----------------------------------------------------------------------------------------

static bool told(const scree_config *config, size_t index, char name[SCREE_RESULT_NAME])
{
    if (index >= (size_t)config->wall_count) return false;
    (void)snprintf(name, SCREE_RESULT_NAME, "%s", config->walls[index].name);
    return true;
}

static const scree_result columns[] = {
    {"_force_x", "N", "force of the bodies on the wall of this name"},
    {"_force_y", "N", "force of the bodies on the wall of this name"},
    {"_force_z", "N", "force of the bodies on the wall of this name"},
    {"_torque_x", "N m", "torque of the bodies on the wall of this name, about its centre"},
    {"_torque_y", "N m", "torque of the bodies on the wall of this name, about its centre"},
    {"_torque_z", "N m", "torque of the bodies on the wall of this name, about its centre"},
    {"_work", "J", "work of the wall of this name on the bodies since the begin of the run"},
    {"_displacement_x", "m", "of the centre of the wall of this name since it began to move"},
    {"_displacement_y", "m", "of the centre of the wall of this name since it began to move"},
    {"_displacement_z", "m", "of the centre of the wall of this name since it began to move"},
};

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const scree_case_wall_set *walls = scree_case_walls(c->state);
    const scree_surface_load *load = &walls->load[index];
    (void)error;
    memcpy(value, load->force, sizeof load->force);
    memcpy(value + 3, load->torque, sizeof load->torque);
    value[6] = load->work;
    scree_wall_shift(&c->model->walls_of_case[index], load->travel, scree_case_walls_time(walls, c->state), value + 7);
    return SCREE_OK;
}

static const scree_result results[] = {
    {"_work", "J", "work of the wall of this name on the bodies"},
    {"_force_x", "N", "last force of the bodies on the wall of this name"},
    {"_force_y", "N", "last force of the bodies on the wall of this name"},
    {"_force_z", "N", "last force of the bodies on the wall of this name"},
    {"_torque_x", "N m", "last torque of the bodies on the wall of this name, about its centre"},
    {"_torque_y", "N m", "last torque of the bodies on the wall of this name, about its centre"},
    {"_torque_z", "N m", "last torque of the bodies on the wall of this name, about its centre"},
};

static scree_status conclude(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const scree_surface_load *load = &scree_case_walls(c->state)->load[index];
    (void)error;
    value[0] = load->work;
    memcpy(value + 1, load->force, sizeof load->force);
    memcpy(value + 4, load->torque, sizeof load->torque);
    return SCREE_OK;
}

const scree_module scree_module_case_walls = {
    .name = "case_walls",
    .meaning = "the walls of the case: how far they have moved, and what the bodies do to them",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .checksum = checksum,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
    .results = SCREE_RESULTS(results, conclude),
    .told = told,
    .spreads = true,
};
