/// Kernels with eight lanes beside the scalar code, on any machine: a test defines LANES_KERNEL and has the kernel
/// compiled for the basic instruction set (test_contact_lanes_2d.c, _3d.c: each takes minutes to compile).
#ifndef SCREE_TESTS_CONTACT_LANES_H
#define SCREE_TESTS_CONTACT_LANES_H

#include "sphere_fixture.h"

#include "contact/partition.h"
#include "contact/reference.h"

enum { SIDE = 13, EDGE = 5, EVALUATIONS = 20 }; // 169 and 125 bodies: no multiple of eight

/// One evaluation of the pairs by `kernel`, as contact/forces.c would do it.
static contact_totals evaluate(fixture *f, const variant *v, contact_kernel *kernel)
{
    contact_scratch *scratch = contact_scratch_refresh(&f->work, &f->state);
    scree_contact_set_quanta(&f->model, &f->state, 0);
    contact_job job = {.range = scratch->part[0].range[0], .near = f->work.pairs.section[0].touching_end};
    contact_part_clear(&scratch->part[0], &f->state, &job);
    job.model = &f->model;
    job.variant = *v;
    job.pairs = (const scree_pair_constants(*)[SCREE_MAX_MATERIALS])f->model.pairs;
    job.row = f->state.row;
    job.turn = f->state.turn;
    job.predicted = f->state.predicted;
    job.first = f->work.pairs.first;
    job.second = f->work.pairs.second;
    job.history = f->work.pairs.history;
    job.last_force = f->work.pairs.last_force;
    job.rolling = f->work.pairs.rolling;
    job.near_touched = scratch->near_touched;
    job.settings = law_settings_get(&f->model.laws[0], f->state.step_size);
    job.scale = (contact_scale){.inverse_force = 1 / f->state.force_quantum,
                                .inverse_torque = 1 / f->state.torque_quantum,
                                .inverse_damping = 0x1p60,
                                .inverse_friction = 0x1p60,
                                .force_limit = ldexp(f->state.force_quantum, 50)};
    kernel(&job);
    f->state.largest_overlap = job.totals.largest_overlap;
    return job.totals;
}

static void create(fixture *f, const variant *v)
{
    const law_choice law = v->law == SCREE_SLOT_hertz_mindlin ? HERTZ_MINDLIN
                           : v->law == SCREE_SLOT_linear      ? LINEAR
                           : v->law == SCREE_SLOT_hertz_jkr   ? HERTZ_JKR
                           : v->law == SCREE_SLOT_hertz_dmt   ? HERTZ_DMT
                           : v->option == 0                   ? HERTZ_BRILLIANTOV
                                                              : HERTZ_BRILLIANTOV_IMPLICIT;
    if (v->dimension == 3)
        sphere_create_assembly(f, law, EDGE, v->many_materials ? 2 : 1, law_rolls(*v));
    else
        fixture_create_assembly(f, law, SIDE, v->many_materials ? 2 : 1);
    // Necks as long as some of the gaps.
    if (law == HERTZ_JKR || law == HERTZ_DMT) law_stick(&f->model, 4e-3, 1e-3);
}

/// Equal numbers; 0 and -0 are the same memory.
static void assert_same_memory(const fixture *a, const fixture *b)
{
    const scree_pair_list *one = &a->work.pairs, *other = &b->work.pairs;
    for (size_t p = 0; p < one->count; p++)
        for (int k = 0; k < 4; k++) {
            assert_true(one->history[p].value[k] == other->history[p].value[k]);
            if (one->last_force) assert_true(one->last_force[p].value[k] == other->last_force[p].value[k]);
            if (one->rolling) assert_true(one->rolling[p].value[k] == other->rolling[p].value[k]);
            if (one->rolling) assert_true(one->rolling[p].last[k] == other->rolling[p].last[k]);
        }
}

static void compare(const variant *v)
{
    fixture one, wide;
    create(&one, v);
    create(&wide, v);
    for (int n = 0; n < EVALUATIONS; n++) {
        contact_totals a = evaluate(&one, v, contact_pairs_reference);
        contact_totals b = evaluate(&wide, v, LANES_KERNEL);
        assert_memory_equal(one.state.sum, wide.state.sum, one.state.count * sizeof *one.state.sum);
        if (v->dimension == 3)
            assert_memory_equal(one.state.torque, wide.state.torque, one.state.count * sizeof *one.state.torque);
        assert_true(a.damping == b.damping && a.friction == b.friction && a.stiffness == b.stiffness);
        assert_true(a.largest_overlap == b.largest_overlap && a.in_range && b.in_range);
        assert_true(a.damping != 0);
        for (size_t k = 0; k < one.state.count; k++) {
            one.state.row[k].x += 1e-6 * one.state.row[k].vx;
            wide.state.row[k].x += 1e-6 * wide.state.row[k].vx;
        }
    }
    assert_same_memory(&one, &wide);
    fixture_destroy(&wide);
    fixture_destroy(&one);
}

/// Both numbers of materials.
static void compare_all(variant v)
{
    for (int materials = 1; materials <= 2; materials++) {
        v.many_materials = materials > 1;
        compare(&v);
    }
}

/// The laws that are there in the plane and in space.
static void compare_laws(int dimension)
{
    compare_all((variant){.dimension = dimension, .law = SCREE_SLOT_hertz_brilliantov});
    compare_all((variant){.dimension = dimension, .law = SCREE_SLOT_hertz_brilliantov, .option = BRILLIANTOV_IMPLICIT});
    compare_all((variant){.dimension = dimension, .law = SCREE_SLOT_hertz_mindlin});
    compare_all((variant){.dimension = dimension, .law = SCREE_SLOT_linear});
}

/// With several materials.
static void compare_many(variant v)
{
    v.many_materials = true;
    compare(&v);
}

#endif
