/// An uneven block of grains between plates, in 2D and 3D, with or without a membrane, for tests of what presses on its
/// sides.
#ifndef SCREE_TESTS_BOUNDARY_FIXTURE_H
#define SCREE_TESTS_BOUNDARY_FIXTURE_H

#include "law_choice.h"
#include "state/plates.h"
#include "testing.h"

#include "boundary_passes.h"

#include "base/random.h"
#include "boundary/boundary.h"
#include "boundary/membrane.h"
#include "boundary/pressure.h"
#include "measure/delaunay_boundary.h"
#include "measure/measure.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

#define THICKNESS 1.5e-3
#define RADIUS    0.75e-3 /* m, of the largest grain */
#define PRESSURE  1e5
#define STIFFNESS 1e4 /* N/m, of the springs of a membrane */
#define QUANTUM   0x1p-50

typedef struct bench {
    scree_model model;
    scree_state state;
    scree_work work;
} bench;

static inline double uniform(uint64_t counter)
{
    return scree_random_uniform(5, SCREE_RANDOM_TEST, counter);
}

/// A state of `count` grains, all zero, between plates at the origin, in steps of `step`.
static inline void bench_begin(bench *b, int dimension, size_t count, double step)
{
    memset(b, 0, sizeof *b);
    b->model = (scree_model){.dimension = dimension,
                             .thickness = dimension == 3 ? 1 : THICKNESS,
                             .laws = {{.law = SCREE_SLOT_hertz_mindlin}},
                             .scheme = SCREE_SLOT_position_verlet,
                             .largest_step = 1,
                             .mean_radius = RADIUS,
                             .radius_min = 0.7 * RADIUS,
                             .radius_max = RADIUS,
                             .material_count = 1,
                             .density = {2.675e8, 2.675e8},
                             .upkeep = {.every = 250, .gap_limit = 0.5},
                             .servo = {.gain = 1},
                             .overlap_limit = 0.2};
    for (int k = 0; k < 4; k++) b->model.pairs[k / 2][k % 2] = hertz_pair(2e10, 2e10, k == 0 ? 0.45 : 0, 1);
    b->model.walls[0] = b->model.pairs[0][0];
    b->model.walls[1] = b->model.pairs[1][1];
    assert_int_equal(scree_state_create(&b->state, dimension, count, NULL), SCREE_OK);
    scree_state *state = &b->state;
    scree_pressure_set(state, PRESSURE);
    state->force_quantum = QUANTUM;
    state->tick = state->step_size = state->kick_size = b->work.next_kick = step;
    const int axis[SCREE_WALL_COUNT] = {dimension - 1, dimension - 1, 0, 0, 1, 1};
    for (int w = 0; w < (dimension == 3 ? SCREE_WALL_COUNT : SCREE_WALL_FRONT); w++)
        scree_plates(state)[w].normal[axis[w]] = w % 2 ? -1 : 1;
}

/// Puts all grains on a disturbed lattice, `side` of them along each horizontal direction, layers shifted; the plates
/// touch the outermost ones, and stand if asked for.
static inline void bench_fill(bench *b, size_t side, bool plates)
{
    scree_state *state = &b->state;
    const bool in_3d = state->dimension == 3;
    const size_t layer = in_3d ? side * side : side;
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < state->count; i++) {
        scree_row *row = &state->row[i];
        size_t level = i / layer;
        double shift = level % 2 ? 0.5 : 0, across = (double)(i / side % side) + shift + 0.2 * uniform(8 * i + 2);
        double height = (in_3d ? 0.75 : 1) * (double)level + 0.15 * uniform(8 * i + 3);
        row->radius = RADIUS * (0.7 + 0.3 * uniform(8 * i));
        row->mass = scree_model_mass(&b->model, 0, row->radius);
        row->x = 2 * RADIUS * ((double)(i % side) + shift + 0.2 * uniform(8 * i + 1));
        row->y = 2 * RADIUS * (in_3d ? across : height);
        if (in_3d) row->z = 2 * RADIUS * height;
        low = fmin(low, 2 * RADIUS * height - row->radius);
        high = fmax(high, 2 * RADIUS * height + row->radius);
    }
    scree_plates(state)[SCREE_WALL_BOTTOM].position = low;
    scree_plates(state)[SCREE_WALL_TOP].position = -high;
    scree_plates(state)[SCREE_WALL_BOTTOM].active = scree_plates(state)[SCREE_WALL_TOP].active = plates;
}

/// Foresees a membrane of bodies of this radius, which has taken the pressure over.
static inline void bench_predict_membrane(bench *b, double radius)
{
    *(scree_membrane_numbers *)scree_model_reserve_numbers(&b->model, SCREE_SLOT_membrane) =
        (scree_membrane_numbers){.material = 1, .radius = radius, .stiffness = STIFFNESS};
    b->model.added_materials = 1;
    b->model.added_radius = radius;
    scree_delaunay_boundary_of(&b->state)->taken_over = 1;
}

/// A body of the membrane.
static inline scree_row *member(bench *b, size_t k)
{
    return &b->state.row[scree_membrane_row(&b->state, k)];
}

/// Forces of the membrane alone.
static inline void membrane_forces(bench *b)
{
    memset(b->state.sum, 0, b->state.count * sizeof *b->state.sum);
    boundary_load(scree_module_membrane.boundary, &b->model, &b->state, &b->work);
}

#endif
