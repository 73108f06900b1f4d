/// A small model, state and contact table with values that nothing else has, for the tests of files.
#ifndef SCREE_TESTS_IO_SAMPLE_H
#define SCREE_TESTS_IO_SAMPLE_H

#include "base/random.h"
#include "contact/contact.h"
#include "measure/delaunay_boundary.h"
#include "state/fields.h"
#include "state/plates.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

enum { SAMPLE_COLUMNS = 8 };

/// Discs of radius 1 mm and more on a square lattice, rows in the reverse order of ids, four walls, a loop around them.
static inline scree_status sample_state(scree_state *state, size_t count, uint64_t seed, scree_error *error)
{
    scree_status status = scree_state_create(state, 2, count, error);
    if (status) return status;
    for (size_t row = 0; row < count; row++) {
        size_t id = count - 1 - row;
        double u = scree_random_uniform(seed, SCREE_RANDOM_TEST, id);
        state->id[row] = (uint32_t)id;
        state->row_of_id[id] = (uint32_t)row;
        state->row[row] = (scree_row){.x = 2e-3 * (double)(id % SAMPLE_COLUMNS) + 1e-4 * u,
                                      .y = 2e-3 * (double)(id / SAMPLE_COLUMNS),
                                      .material = (double)(id % 2),
                                      .radius = 1e-3 * (1 + 0.2 * u),
                                      .vx = u - 0.5,
                                      .vy = 0.25 - u,
                                      .spin = 10 * u,
                                      .mass = 1e-2 * (1 + u)};
        state->sum[row] = (scree_sum_row){
            .fx = (int64_t)id + 1, .fy = -(int64_t)id - 2, .torque = (int64_t)(5 * id), .contacts = (int64_t)(id % 5)};
        state->angle[row] = 0.1 * u;
        state->reference[row][0] = state->row[row].x - 1e-4;
        state->reference[row][1] = state->row[row].y + 2e-4 * u;
        state->sampled_velocity[row][0] = 1e-3 * u;
        state->sampled_velocity[row][1] = -2e-3 * u;
    }
    state->step = 1234 + seed;
    state->step_size = 1e-6;
    state->force_quantum = ldexp(1, -30);
    state->torque_quantum = ldexp(1, -40);
    scree_pressure_set(state, 1e5);
    const double normals[][2] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
    const double positions[] = {-1e-3, -17e-3, -1e-3, -17e-3};
    for (int w = 0; w <= SCREE_WALL_RIGHT; w++)
        scree_plates(state)[w] = (scree_wall){.position = positions[w],
                                              .normal = {normals[w][0], normals[w][1]},
                                              .velocity = 0.1 * w,
                                              .force = 10.0 + w,
                                              .shear = {-1.0 * w, 0.5 * w},
                                              .active = w != SCREE_WALL_RIGHT,
                                              .material = 1};
    return status;
}

/// A loop of `count` bodies 0, 1, ... with every array set.
static inline scree_status sample_loop(scree_state *state, size_t count, scree_error *error)
{
    scree_loop *loop = scree_loop_of(state);
    scree_status status = scree_group_reserve(state, &scree_module_delaunay_boundary, &scree_loop_group, count, error);
    if (status) return status;
    loop->count = count;
    loop->updated = 1200;
    for (size_t k = 0; k < count; k++) {
        loop->id[k] = (uint32_t)k;
        loop->loaded[k] = k % 3 == 0;
        loop->x[k] = 1e-3 * (double)k;
        loop->y[k] = -1e-3 * (double)k;
        loop->fx[k] = 0.5 + (double)k;
        loop->fy[k] = 0.25 - (double)k;
    }
    return SCREE_OK;
}

/// Contact memories of neighbours in the id order, of law hertz_mindlin, which fills whole rows.
static inline scree_status sample_contacts(scree_state *state, size_t count, scree_error *error)
{
    scree_status status = scree_state_reserve_contacts(state, count, error);
    if (status) return status;
    state->contact_count = count;
    state->law[SCREE_LIST_CONTACTS] = (scree_remembered_law){&scree_module_hertz_mindlin, 0};
    for (size_t k = 0; k < count; k++) {
        state->contact[k] = (scree_contact_memory){.first = (uint32_t)k, .second = (uint32_t)k + 1};
        for (int h = 0; h < SCREE_HISTORY; h++) state->contact[k].history.value[h] = 1e-6 * (double)k + h;
    }
    return SCREE_OK;
}

/// One contact between each body and the next by id, and one of body 0 with the bottom wall.
static inline scree_status sample_table(const scree_state *state, scree_contact_table *table, scree_error *error)
{
    *table = (scree_contact_table){.count = state->count, .capacity = state->count};
    scree_status status = scree_allocate(&table->contact, table->count, sizeof *table->contact, error);
    for (size_t k = 0; k < table->count && !status; k++) {
        bool wall = k + 1 == table->count;
        table->contact[k] = (scree_contact){.first = state->row_of_id[wall ? 0 : k],
                                            .second = wall ? SCREE_WALL_BOTTOM : state->row_of_id[k + 1],
                                            .wall = wall,
                                            .sliding = k % 2 == 1,
                                            .normal = {0.6, 0.8},
                                            .tangent = {-0.8, 0.6},
                                            .point = {1e-3 * (double)k, 2e-3},
                                            .branch = {1.2e-3, 1.6e-3},
                                            .overlap = 1e-7 * (double)(k + 1),
                                            .normal_force = 3.0 + (double)k,
                                            .tangential_force = -1.0 - (double)k,
                                            .slip = 1e-3 * (double)k,
                                            .elastic_normal = 1e-6 * (double)k,
                                            .elastic_tangential = 1e-7 * (double)k};
    }
    return status;
}

static inline scree_model sample_model(const scree_config *config)
{
    return (scree_model){.name = config->name,
                         .dimension = 2,
                         .thickness = 2e-3,
                         .scheme = SCREE_SLOT_position_verlet,
                         .step = 1e-6,
                         .gravity = {0, -9.81, 0},
                         .config = config};
}

#endif
