/// A few bodies with a brute-force pair list, for tests of contact/ that need no other module.
#ifndef SCREE_TESTS_CONTACT_FIXTURE_H
#define SCREE_TESTS_CONTACT_FIXTURE_H

#include "law_choice.h"
#include "state/plates.h"
#include "testing.h"

#include "base/fixed.h"
#include "base/random.h"
#include "contact/contact.h"

#include <math.h>
#include <string.h>

typedef struct fixture {
    scree_model model;
    scree_state state;
    scree_work work;
} fixture;

/// Quartz-like grains of 1 mm, and a softer second material.
static inline scree_model fixture_model(law_choice law)
{
    scree_model model;
    memset(&model, 0, sizeof model);
    model.dimension = 2;
    model.thickness = 2e-3;
    model.reference_velocity = 1e-2;
    law_choose(&model, law);
    model.scheme = SCREE_SLOT_position_verlet;
    model.mean_radius = 1e-3;
    model.radius_min = 0.5e-3;
    model.radius_max = 1.5e-3;
    model.material_count = 1;
    model.density[0] = 2650;
    model.density[1] = 1200;
    model.pairs[0][0] = model.walls[0] = hertz_pair(4e9, 5e9, 0.5, 0.3);
    model.pairs[1][1] = model.walls[1] = hertz_pair(1e9, 1.2e9, 0.2, 0.6);
    model.pairs[0][1] = model.pairs[1][0] = hertz_pair(1.6e9, 2e9, 0.3, 0.4);
    if (law != LINEAR) return model;
    model.pairs[0][0] = model.walls[0] = linear_pair(4e5, 0, 0.8, 0.5, 0.1, 0.2);
    model.pairs[1][1] = model.walls[1] = linear_pair(0, 3e8, 0.5, 0.2, 0.3, 0.3);
    model.pairs[0][1] = model.pairs[1][0] = linear_pair(1e5, 2e8, 0.6, 0.3, 0.2, 0.1);
    return model;
}

static inline double fixture_mass(const scree_model *model, int material, double radius)
{
    double length = model->dimension == 3 ? 4.0 / 3.0 * radius : model->thickness;
    return model->density[material] * M_PI * radius * radius * length;
}

static inline double fixture_random(uint64_t counter)
{
    return scree_random_uniform(7, SCREE_RANDOM_TEST, counter);
}

static inline void fixture_reserve(fixture *f, size_t pairs)
{
    scree_pair_list *list = &f->work.pairs;
    scree_error error;
    assert_int_equal(scree_allocate(&list->first, pairs, sizeof *list->first, &error), SCREE_OK);
    assert_int_equal(scree_allocate(&list->second, pairs, sizeof *list->second, &error), SCREE_OK);
    assert_int_equal(scree_allocate(&list->history, pairs, sizeof *list->history, &error), SCREE_OK);
    if (f->state.dimension == 3)
        assert_int_equal(scree_allocate(&list->last_force, pairs, sizeof *list->last_force, &error), SCREE_OK);
    if (scree_contacts_roll(&f->model))
        assert_int_equal(scree_allocate(&list->rolling, pairs, sizeof *list->rolling, &error), SCREE_OK);
    list->capacity = pairs;
}

/// `count` bodies at rest at the origin, one thread, ledger on, no pairs.
static inline void fixture_create_in(fixture *f, int dimension, law_choice law, size_t count, double step)
{
    scree_error error;
    memset(f, 0, sizeof *f);
    f->model = fixture_model(law);
    f->model.dimension = dimension;
    f->model.overlap_limit = 0.5;
    assert_int_equal(scree_state_create(&f->state, dimension, count, &error), SCREE_OK);
    f->state.tick = f->state.step_size = f->state.kick_size = step;
    if (scree_model_predicts(&f->model)) assert_int_equal(scree_state_predict(&f->state, &error), SCREE_OK);
    f->model.step = step;
    f->work.threads = 1;
    f->work.valid = true;
    for (size_t k = 0; k < count; k++)
        f->state.row[k] = (scree_row){.radius = 1e-3, .mass = fixture_mass(&f->model, 0, 1e-3)};
}

static inline void fixture_create(fixture *f, law_choice law, size_t count, double step)
{
    fixture_create_in(f, 2, law, count, step);
}

static inline void fixture_destroy(fixture *f)
{
    scree_thread_pool_destroy(&f->work.pool);
    scree_contact_scratch_destroy(&f->work);
    scree_release(&f->work.pairs.first);
    scree_release(&f->work.pairs.second);
    scree_release(&f->work.pairs.history);
    scree_release(&f->work.pairs.last_force);
    scree_release(&f->work.pairs.rolling);
    scree_release(&f->work.wall_pairs.body);
    scree_release(&f->work.wall_pairs.wall);
    scree_release(&f->work.wall_pairs.history);
    scree_release(&f->work.wall_pairs.last_force);
    scree_release(&f->work.wall_pairs.rolling);
    scree_state_destroy(&f->state);
}

static inline double fixture_distance(const scree_row *a, const scree_row *b)
{
    return hypot(a->x - b->x, a->y - b->y);
}

/// Distance of the surfaces of the bodies in two rows [m].
static inline double fixture_gap(const fixture *f, size_t i, size_t j)
{
    scree_vector a, b;
    scree_body_position(&f->state, i, a);
    scree_body_position(&f->state, j, b);
    for (int k = 0; k < 3; k++) a[k] -= b[k];
    return scree_length(a) - f->state.row[i].radius - f->state.row[j].radius;
}

/// The first `touching` pairs of the list count as touching, the others as near: one section, of the first law.
static inline void fixture_cut(scree_pair_list *list, size_t touching)
{
    const size_t near = list->count - touching;
    scree_pairs_clear(list);
    (void)scree_pairs_add_section(list, 0, 0, false, touching, near);
}

static inline size_t fixture_touching(const scree_pair_list *list)
{
    return list->section[0].touching_end;
}

/// All pairs closer than the sum of radii + skin, touching ones first, with clear histories; bodies keep their rows.
static inline void fixture_find_pairs(fixture *f, double skin)
{
    size_t count = f->state.count;
    scree_pair_list *list = &f->work.pairs;
    if (!list->first) fixture_reserve(f, count * 12 + 16);
    size_t touching = 0;
    list->count = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < count; i++)
            for (size_t j = i + 1; j < count; j++) {
                double gap = fixture_gap(f, i, j);
                if (pass == 0 ? gap >= 0 : gap < 0 || gap >= skin) continue;
                assert_true(list->count < list->capacity);
                list->first[list->count] = (uint32_t)(f->state.id[i] < f->state.id[j] ? i : j);
                list->second[list->count] = (uint32_t)(f->state.id[i] < f->state.id[j] ? j : i);
                if (list->last_force) list->last_force[list->count] = (scree_last_force){{0}};
                if (list->rolling) list->rolling[list->count] = (scree_rolling){{0}, {0}};
                list->history[list->count++] = (scree_history){{0}};
            }
        if (pass == 0) touching = list->count;
    }
    fixture_cut(list, touching);
    f->work.rebuilds++;
}

/// Every body paired with every active wall.
static inline void fixture_find_walls(fixture *f)
{
    scree_error error;
    scree_wall_pair_list *list = &f->work.wall_pairs;
    size_t most = f->state.count * SCREE_WALL_COUNT;
    assert_int_equal(scree_allocate(&list->body, most, sizeof *list->body, &error), SCREE_OK);
    assert_int_equal(scree_allocate(&list->wall, most, sizeof *list->wall, &error), SCREE_OK);
    assert_int_equal(scree_allocate(&list->history, most, sizeof *list->history, &error), SCREE_OK);
    if (f->state.dimension == 3)
        assert_int_equal(scree_allocate(&list->last_force, most, sizeof *list->last_force, &error), SCREE_OK);
    if (scree_contacts_roll(&f->model))
        assert_int_equal(scree_allocate(&list->rolling, most, sizeof *list->rolling, &error), SCREE_OK);
    list->capacity = most;
    for (uint32_t w = 0; w < SCREE_WALL_COUNT; w++)
        for (size_t k = 0; k < f->state.count && scree_plates(&f->state)[w].active; k++) {
            list->body[list->count] = (uint32_t)k;
            list->wall[list->count++] = w;
        }
}

/// Largest |v| + R |w|, as integrators keep it.
static inline void fixture_measure_speed(fixture *f)
{
    f->state.largest_speed = 0;
    for (size_t k = 0; k < f->state.count; k++) {
        scree_vector velocity, spin;
        scree_body_motion(&f->state, k, velocity, spin);
        double speed = scree_length(velocity) + f->state.row[k].radius * scree_length(spin);
        f->state.largest_speed = fmax(f->state.largest_speed, speed);
    }
}

static inline void fixture_forces(fixture *f)
{
    scree_contact_set_quanta(&f->model, &f->state, 0);
    scree_contact_forces(&f->model, &f->state, &f->work);
}

/// Force and torque on a body [N, N m].
static inline void fixture_force(const fixture *f, size_t k, double force[3])
{
    force[0] = scree_fixed_to(f->state.sum[k].fx, f->state.force_quantum);
    force[1] = scree_fixed_to(f->state.sum[k].fy, f->state.force_quantum);
    force[2] = scree_fixed_to(f->state.sum[k].torque, f->state.torque_quantum);
}

/// Leapfrog: v(n+1/2) = v(n-1/2) + F(n)/m dt, x(n+1) = x(n) + v(n+1/2) dt, walls with it, forces at n + 1.
static inline void fixture_step(fixture *f)
{
    double dt = f->state.step_size;
    for (size_t k = 0; k < f->state.count; k++) {
        scree_row *row = &f->state.row[k];
        double force[3];
        fixture_force(f, k, force);
        if (f->state.predicted)
            f->state.predicted[k] =
                (scree_predicted){.vx = dt * (force[0] / row->mass + f->model.gravity[0]),
                                  .vy = dt * (force[1] / row->mass + f->model.gravity[1]),
                                  .spin = dt * force[2] / (0.5 * row->mass * row->radius * row->radius),
                                  .contacts = (double)f->state.sum[k].contacts};
        row->vx += dt * (force[0] / row->mass + f->model.gravity[0]);
        row->vy += dt * (force[1] / row->mass + f->model.gravity[1]);
        row->spin += dt * force[2] / (0.5 * row->mass * row->radius * row->radius);
        row->x += dt * row->vx;
        row->y += dt * row->vy;
    }
    for (int w = 0; w < SCREE_WALL_COUNT; w++)
        scree_plates(&f->state)[w].position += dt * scree_plates(&f->state)[w].velocity;
    f->state.step++;
    fixture_measure_speed(f);
    fixture_forces(f);
}

/// A pressed, jostling assembly of `side` x `side` discs of random radii on a disturbed hexagonal lattice.
static inline void fixture_create_assembly(fixture *f, law_choice law, size_t side, int materials)
{
    fixture_create(f, law, side * side, 1e-7);
    f->model.material_count = materials;
    for (size_t k = 0; k < f->state.count; k++) {
        scree_row *row = &f->state.row[k];
        double i = (double)(k % side), j = (double)(k / side);
        uint64_t c = 10 * k;
        row->radius = 1e-3 * (0.9 + 0.2 * fixture_random(c));
        row->material = materials > 1 && fixture_random(c + 1) < 0.4 ? 1 : 0;
        row->mass = fixture_mass(&f->model, (int)row->material, row->radius);
        row->x = 1.98e-3 * (i + 0.5 * fmod(j, 2)) + 4e-5 * fixture_random(c + 2);
        row->y = 1.98e-3 * sqrt(0.75) * j + 4e-5 * fixture_random(c + 3);
        row->vx = 2 * fixture_random(c + 4) - 1;
        row->vy = 2 * fixture_random(c + 5) - 1;
        row->spin = 2e3 * (fixture_random(c + 6) - 0.5);
    }
    fixture_measure_speed(f);
    fixture_find_pairs(f, 3e-4);
}

/// J, of all contacts.
static inline double fixture_elastic(const fixture *f)
{
    scree_contact_table table = {0};
    scree_error error;
    double energy = 0;
    assert_int_equal(scree_contact_table_build(&f->model, &f->state, &f->work, &table, &error), SCREE_OK);
    for (size_t k = 0; k < table.count; k++)
        energy += table.contact[k].elastic_normal + table.contact[k].elastic_tangential;
    scree_contact_table_destroy(&table);
    return energy;
}

#endif
