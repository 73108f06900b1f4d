/// The kernel with eight lanes on any machine: compiled here for the basic instruction set, where the compiler makes
/// the wide vectors out of narrow ones. The machinery of AVX-512 kernels is tested by this also where they cannot run.
#pragma GCC diagnostic ignored "-Wpsabi"
#define SCREE_ISA   9 /* no machine has it: only a name */
#define SCREE_LANES 8
#include "contact/pairs_batch.c"

#include "contact_fixture.h"

#include "contact/partition.h"
#include "contact/reference.h"

enum { SIDE = 13, EVALUATIONS = 20 }; // 169 bodies: no multiple of eight

/// One evaluation of the pairs by `kernel`, as contact/forces.c would do it.
static contact_totals evaluate(fixture *f, bool ledger, contact_kernel *kernel)
{
    contact_scratch *scratch = contact_scratch_refresh(&f->work, f->state.count);
    scree_contact_set_quanta(&f->model, &f->state, 0);
    contact_job job = scratch->part[0].job;
    job.model = &f->model;
    job.row = f->state.row;
    job.foreseen = f->state.foreseen;
    job.sum = contact_part_clear(&scratch->part[0], &f->state);
    job.first = f->work.pairs.first;
    job.second = f->work.pairs.second;
    job.history = f->work.pairs.history;
    job.near_touched = scratch->near_touched;
    job.settings = law_settings_get(&f->model, f->state.step_size);
    job.scale = (contact_scale){.inverse_force = 1 / f->state.force_quantum,
                                .inverse_torque = 1 / f->state.torque_quantum,
                                .inverse_damping = 0x1p60,
                                .inverse_friction = 0x1p60,
                                .force_limit = ldexp(f->state.force_quantum, 50)};
    job.ledger = ledger;
    kernel(&job);
    f->state.largest_overlap = job.totals.largest_overlap;
    return job.totals;
}

static void compare(scree_law law, int materials, bool ledger)
{
    fixture one, wide;
    fixture_create_assembly(&one, law, SIDE, materials);
    fixture_create_assembly(&wide, law, SIDE, materials);
    for (int n = 0; n < EVALUATIONS; n++) {
        contact_totals a = evaluate(&one, ledger, contact_pairs_reference);
        contact_totals b = evaluate(&wide, ledger, scree_pairs_batch_v9);
        assert_memory_equal(one.state.sum, wide.state.sum, one.state.count * sizeof *one.state.sum);
        assert_true(a.damping == b.damping && a.friction == b.friction && a.stiffness == b.stiffness);
        assert_true(a.largest_overlap == b.largest_overlap && a.in_range && b.in_range);
        assert_true(!ledger || a.damping != 0);
        for (size_t k = 0; k < one.state.count; k++) {
            one.state.row[k].x += 1e-6 * one.state.row[k].vx;
            wide.state.row[k].x += 1e-6 * wide.state.row[k].vx;
        }
    }
    for (size_t p = 0; p < one.work.pairs.count; p++)
        for (int v = 0; v < SCREE_HISTORY; v++)
            assert_true(one.work.pairs.history[p].value[v] == wide.work.pairs.history[p].value[v]);
    fixture_destroy(&wide);
    fixture_destroy(&one);
}

static void eight_lanes_give_the_bits_of_one(void **unused)
{
    (void)unused;
    for (int law = SCREE_LAW_HERTZ_BRILLIANTOV; law <= SCREE_LAW_HERTZ_BRILLIANTOV_IMPLICIT; law++)
        for (int materials = 1; materials <= 2; materials++)
            for (int ledger = 0; ledger <= 1; ledger++) compare((scree_law)law, materials, ledger);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_lanes_give_the_bits_of_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
