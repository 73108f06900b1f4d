/// Spheres on the fixture of contact tests: bodies with three components, and steps of the real schemes.
#ifndef SCREE_TESTS_SPHERE_FIXTURE_H
#define SCREE_TESTS_SPHERE_FIXTURE_H

#include "contact_fixture.h"
#include "state/plates.h"

#include "integrate/integrate.h"

typedef struct sphere {
    double place[3], velocity[3], spin[3], radius;
    int material;
} sphere;

/// Writes a sphere into row `k`, its mass from its material.
static inline void sphere_set(fixture *f, size_t k, const sphere *s)
{
    scree_row *row = &f->state.row[k];
    *row = (scree_row){.x = s->place[0], .y = s->place[1], .radius = s->radius};
    row->z = s->place[2];
    row->vx = s->velocity[0], row->vy = s->velocity[1], row->vz = s->velocity[2];
    row->mass = fixture_mass(&f->model, s->material, s->radius);
    f->state.turn[k] = (scree_turn_row){s->spin[0], s->spin[1], s->spin[2], s->material};
}

/// Force and torque on a sphere [N, N m].
static inline void sphere_force(const fixture *f, size_t k, double force[3], double torque[3])
{
    const scree_sum_row *sum = &f->state.sum[k];
    const scree_torque_row *turning = &f->state.torque[k];
    const int64_t forces[3] = {sum->fx, sum->fy, sum->fz}, torques[3] = {turning->x, turning->y, turning->z};
    for (int i = 0; i < 3; i++) {
        force[i] = scree_fixed_to(forces[i], f->state.force_quantum);
        torque[i] = scree_fixed_to(torques[i], f->state.torque_quantum);
    }
}

/// A step of the model's scheme; walls move with it.
static inline void sphere_step(fixture *f)
{
    const scree_integrator *scheme = scree_integrator_get(f->model.scheme);
    scheme->first(&f->model, &f->state, &f->work);
    for (int w = 0; w < SCREE_WALL_COUNT; w++)
        scree_plates(&f->state)[w].position += f->state.step_size * scree_plates(&f->state)[w].velocity;
    f->state.step++;
    fixture_forces(f);
    if (scheme->second) scheme->second(&f->model, &f->state, &f->work);
}

static inline void sphere_run(fixture *f, int steps)
{
    fixture_forces(f);
    for (int k = 0; k < steps; k++) sphere_step(f);
}

/// Materials that resist rolling and twisting, under a law that can.
static inline void sphere_resist_turning(fixture *f)
{
    if (f->model.laws[0].law == SCREE_SLOT_hertz_mindlin) f->model.laws[0].option |= MINDLIN_ROLLING;
    if (law_slot(HERTZ_JKR) == f->model.laws[0].law || law_slot(HERTZ_DMT) == f->model.laws[0].law)
        f->model.laws[0].option |= ADHESIVE_ROLLING;
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++) {
            f->model.pairs[a][b].value[HERTZ_ROLLING] = 0.1 + 0.05 * (a + b);
            f->model.pairs[a][b].value[HERTZ_TWISTING] = 0.2 - 0.05 * (a + b);
        }
    for (int a = 0; a < 2; a++) f->model.walls[a] = f->model.pairs[a][a];
}

/// A pressed, jostling assembly of side^3 spheres of random radii on disturbed, shifted layers.
static inline void sphere_create_assembly(fixture *f, law_choice law, size_t side, int materials, bool rolling)
{
    fixture_create_in(f, 3, law, side * side * side, 1e-7);
    f->model.material_count = materials;
    if (rolling) sphere_resist_turning(f);
    for (size_t k = 0; k < f->state.count; k++) {
        double i = (double)(k % side), j = (double)(k / side % side), l = (double)(k / side / side);
        uint64_t c = 20 * k;
        sphere s = {.radius = 1e-3 * (0.9 + 0.2 * fixture_random(c)),
                    .material = materials > 1 && fixture_random(c + 1) < 0.4 ? 1 : 0};
        s.place[0] = 1.98e-3 * (i + 0.5 * fmod(l, 2)) + 4e-5 * fixture_random(c + 2);
        s.place[1] = 1.98e-3 * (j + 0.5 * fmod(l, 2)) + 4e-5 * fixture_random(c + 3);
        s.place[2] = 1.98e-3 * sqrt(0.5) * l + 4e-5 * fixture_random(c + 4);
        for (uint64_t q = 0; q < 3; q++) s.velocity[q] = 2 * fixture_random(c + 5 + q) - 1;
        for (uint64_t q = 0; q < 3; q++) s.spin[q] = 2e3 * (fixture_random(c + 8 + q) - 0.5);
        sphere_set(f, k, &s);
    }
    fixture_measure_speed(f);
    fixture_find_pairs(f, 3e-4);
}

/// J, with velocities at n.
static inline double fixture_kinetic(const fixture *f)
{
    double energy = 0, dt = f->state.step_size;
    for (size_t k = 0; k < f->state.count; k++) {
        scree_vector velocity, spin, force, torque;
        double mass = f->state.row[k].mass, inertia = scree_body_inertia(&f->state, k);
        scree_body_half_velocity(&f->model, &f->state, k, velocity, spin);
        scree_body_force(&f->model, &f->state, k, force, torque);
        for (int i = 0; i < 3; i++) {
            energy += 0.5 * velocity[i] * (mass * velocity[i] + dt * force[i]);
            energy += 0.5 * spin[i] * (inertia * spin[i] + dt * torque[i]);
        }
    }
    return energy;
}

#endif
