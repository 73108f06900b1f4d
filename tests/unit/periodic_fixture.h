/// Samples in a periodic cell, in 2D and 3D, stepped without a case.
#ifndef SCREE_TESTS_PERIODIC_FIXTURE_H
#define SCREE_TESTS_PERIODIC_FIXTURE_H

#include "law_choice.h"
#include "testing.h"

#include "base/fixed.h"
#include "base/matrix.h"
#include "base/random.h"
#include "bond/bond.h"
#include "boundary/periodic.h"
#include "contact/contact.h"
#include "integrate/integrate.h"
#include "measure/measure.h"
#include "search/neighbours.h"
#include "state/periodic.h"

#include <math.h>
#include <string.h>

typedef struct periodic_sample {
    scree_model model;
    scree_state state;
    scree_work work;
} periodic_sample;

/// Grains of about 1 mm at the origin, at rest, in a cell of the given lattice (columns; unit vector: not periodic).
static inline void periodic_create(periodic_sample *s, int dimension, size_t count, const double lattice[9],
                                   law_choice law)
{
    scree_error error;
    memset(s, 0, sizeof *s);
    s->model = (scree_model){.dimension = dimension,
                             .thickness = dimension == 2 ? 2e-3 : 1,
                             .reference_velocity = 1e-2,
                             .scheme = SCREE_SLOT_velocity_verlet,
                             .step = 2e-7,
                             .mean_radius = 1e-3,
                             .radius_min = 0.8e-3,
                             .radius_max = 1.2e-3,
                             .material_count = 1,
                             .density = {2650},
                             .servo = {.gain = 1, .velocity = INFINITY, .travel = 0.8e-5},
                             .overlap_limit = 0.5};
    s->model.pairs[0][0] = s->model.walls[0] = hertz_pair(4e9, 5e9, 0.5, 0.3);
    law_choose(&s->model, law);
    check(scree_state_create(&s->state, dimension, count, &error), &error);
    if (scree_model_predicts(&s->model)) check(scree_state_predict(&s->state, &error), &error);
    s->model.largest_step = s->model.large_multiple = 1;
    s->state.tick = s->state.step_size = s->state.kick_size = s->model.step;
    const double none[3] = {1, 1, 1};
    scree_periodic_set(scree_cell(&s->state), dimension == 2 ? 3 : 7, none);
    memcpy(scree_cell(&s->state)->lattice, lattice, sizeof scree_cell(&s->state)->lattice);
    memcpy(scree_cell(&s->state)->reference, lattice, sizeof scree_cell(&s->state)->reference);
    check(scree_work_create(&s->work, &s->model, 1, &error), &error);
}

static inline void periodic_destroy(periodic_sample *s)
{
    scree_contact_scratch_destroy(&s->work);
    scree_work_destroy(&s->work);
    scree_state_destroy(&s->state);
}

static inline void periodic_place(periodic_sample *s, size_t row, const double place[3], const double velocity[3],
                                  double radius)
{
    scree_row *body = &s->state.row[row];
    bool in_3d = s->state.dimension == 3;
    double volume = in_3d ? 4 * M_PI / 3 * radius : M_PI * s->model.thickness;
    *body = (scree_row){.x = place[0],
                        .y = place[1],
                        .radius = radius,
                        .vx = velocity[0],
                        .vy = velocity[1],
                        .mass = s->model.density[0] * volume * radius * radius};
    if (in_3d) {
        body->z = place[2];
        body->vz = velocity[2];
    }
    scree_body_position(&s->state, row, s->state.reference[row]);
}

/// Forces at the present positions; bonds break.
static inline void periodic_forces(periodic_sample *s)
{
    const scree_context context = {.model = &s->model, .state = &s->state, .work = &s->work};
    scree_error error;
    check(scree_neighbours_refresh(&s->model, &s->state, &s->work, &error), &error);
    scree_contact_set_quanta(&s->model, &s->state, 0);
    scree_contact_forces(&s->model, &s->state, &s->work);
    check(scree_module_bonds.passes[0].run(&context, &error), &error);
}

/// A step as run/step.c makes it, with the gradient that the cell has.
static inline void periodic_step(periodic_sample *s)
{
    const scree_integrator *scheme = scree_integrator_get(s->model.scheme);
    scree_error error;
    scheme->first(&s->model, &s->state, &s->work);
    check(scree_periodic_move(&s->model, &s->state, &s->work, &error), &error);
    s->state.step++;
    periodic_forces(s);
    scree_periodic_settle(&s->state, &s->work);
    if (scheme->second) scheme->second(&s->model, &s->state, &s->work);
    assert_int_equal(s->work.flags, 0);
}

static inline void periodic_run(periodic_sample *s, const double gradient[9], int steps)
{
    memcpy(scree_cell(&s->state)->gradient, gradient, sizeof scree_cell(&s->state)->gradient);
    for (int k = 0; k < steps; k++) periodic_step(s);
}

static inline double periodic_random(uint64_t counter)
{
    return scree_random_uniform(11, SCREE_RANDOM_TEST, counter) - 0.5;
}

/// Grains in contact on a cubic or square net of n places a side, shaken a little, with random velocities and sizes.
static inline void periodic_fill(periodic_sample *s, int dimension, int n, law_choice law, double speed)
{
    const double spacing = 1.97e-3, side = n * spacing;
    const double lattice[9] = {side, 0, 0, 0, side, 0, 0, 0, dimension == 3 ? side : 1};
    size_t count = (size_t)n * (size_t)n * (dimension == 3 ? (size_t)n : 1);
    periodic_create(s, dimension, count, lattice, law);
    for (size_t k = 0; k < count; k++) {
        const size_t index[3] = {k % (size_t)n, k / (size_t)n % (size_t)n, k / (size_t)(n * n)};
        double place[3] = {0}, velocity[3] = {0};
        for (int i = 0; i < dimension; i++) {
            place[i] = ((double)index[i] + 0.5 + 0.02 * periodic_random(8 * k + (uint64_t)i)) * spacing;
            velocity[i] = 2 * speed * periodic_random(8 * k + 3 + (uint64_t)i);
        }
        periodic_place(s, k, place, velocity, 1e-3 * (1 + 0.02 * periodic_random(8 * k + 6)));
    }
}

#endif
