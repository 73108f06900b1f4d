/// The machinery around the laws in three dimensions: every kernel, thread count and order of the list gives the same
/// bits; momentum is exact; the table says what the sums hold; rows of the memory are saved.
#include "sphere_fixture.h"
#include "state/plates.h"

enum { EDGE = 7, STEPS = 150 }; // 343 bodies: no multiple of any number of lanes or threads

static void assert_same(const fixture *a, const fixture *b)
{
    const scree_state *s = &a->state, *t = &b->state;
    assert_memory_equal(s->row, t->row, s->count * sizeof *s->row);
    assert_memory_equal(s->turn, t->turn, s->count * sizeof *s->turn);
    assert_memory_equal(s->sum, t->sum, s->count * sizeof *s->sum);
    assert_memory_equal(s->torque, t->torque, s->count * sizeof *s->torque);
    assert_memory_equal(&s->ledger, &t->ledger, sizeof s->ledger);
    assert_memory_equal(&s->largest_overlap, &t->largest_overlap, sizeof(double));
    assert_memory_equal(scree_plates(s), scree_plates(t), SCREE_WALL_COUNT * sizeof(scree_wall));
    assert_int_equal(a->work.flags, b->work.flags);
}

/// Walls on two sides, so that wall contacts are part of every comparison.
static void create(fixture *f, law_choice law, int materials, bool rolling)
{
    sphere_create_assembly(f, law, EDGE, materials, rolling);
    scree_plates(&f->state)[SCREE_WALL_BOTTOM] = (scree_wall){
        .position = -0.95e-3, .normal = {0, 0, 1}, .velocity = 0.3, .tangential_velocity = {0.2, -0.1}, .active = 1};
    scree_plates(&f->state)[SCREE_WALL_LEFT] =
        (scree_wall){.position = -0.96e-3, .normal = {1}, .velocity = -0.1, .active = 1};
    fixture_find_walls(f);
}

static void compare_with_reference(law_choice law, int materials, bool rolling, bool rescaled)
{
    fixture reference, kernel;
    create(&reference, law, materials, rolling);
    law_rescale(&reference.model, rescaled);
    reference.work.reference_kernel = true;
    sphere_run(&reference, STEPS);
    assert_true(reference.state.largest_overlap > 0);
    assert_int_equal(reference.work.flags, 0);
    for (int isa = 2; isa <= scree_contact_instruction_set(0); isa++) {
        create(&kernel, law, materials, rolling);
        law_rescale(&kernel.model, rescaled);
        kernel.work.instruction_set = isa;
        sphere_run(&kernel, STEPS);
        assert_same(&reference, &kernel);
        fixture_destroy(&kernel);
    }
    fixture_destroy(&reference);
}

static void kernels_give_the_bits_of_the_reference(void **unused)
{
    (void)unused;
    for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_BRILLIANTOV_IMPLICIT; law++)
        for (int materials = 1; materials <= 2; materials++)
            compare_with_reference((law_choice)law, materials, false, false);
    compare_with_reference(HERTZ_MINDLIN, 2, true, false);
    compare_with_reference(HERTZ_MINDLIN, 2, true, true);
    compare_with_reference(HERTZ_MINDLIN, 1, false, true);
}

static void threads_do_not_change_a_bit(void **unused)
{
    (void)unused;
    fixture one, many;
    create(&one, HERTZ_MINDLIN, 2, true);
    sphere_run(&one, STEPS);
    for (int threads = 2; threads <= 3; threads++) {
        create(&many, HERTZ_MINDLIN, 2, true);
        many.work.threads = threads;
        sphere_run(&many, STEPS);
        assert_same(&one, &many);
        fixture_destroy(&many);
    }
    fixture_destroy(&one);
}

#define SWAP(array, k, l)                                                                                              \
    do {                                                                                                               \
        __typeof__(*(array)) kept = (array)[k];                                                                        \
        (array)[k] = (array)[l];                                                                                       \
        (array)[l] = kept;                                                                                             \
    } while (0)

static void order_of_the_list_does_not_change_a_bit(void **unused)
{
    (void)unused;
    fixture ordered, shuffled;
    create(&ordered, HERTZ_MINDLIN, 1, true);
    create(&shuffled, HERTZ_MINDLIN, 1, true);
    scree_pair_list *list = &shuffled.work.pairs;
    for (size_t k = list->count - 1; k > 0; k--) {
        size_t l = (size_t)(fixture_random(1000000 + k) * (double)(k + 1));
        SWAP(list->first, k, l);
        SWAP(list->second, k, l);
    }
    fixture_cut(list, list->count / 3); // says nothing about touching any more
    shuffled.work.threads = 3;
    sphere_run(&ordered, STEPS);
    sphere_run(&shuffled, STEPS);
    assert_same(&ordered, &shuffled);
    fixture_destroy(&shuffled);
    fixture_destroy(&ordered);
}

/// The sum of all forces is what the walls give, to the last quantum: their normals are axes, which round nothing.
static void momentum_is_conserved_exactly(void **unused)
{
    (void)unused;
    fixture f;
    create(&f, HERTZ_MINDLIN, 2, true);
    sphere_run(&f, 10);
    int64_t sum[3] = {0}, contacts = 0;
    for (size_t k = 0; k < f.state.count; k++) {
        const scree_sum_row *s = &f.state.sum[k];
        sum[0] += s->fx, sum[1] += s->fy, sum[2] += s->fz;
        contacts += s->contacts;
    }
    const scree_wall *bottom = &scree_plates(&f.state)[SCREE_WALL_BOTTOM],
                     *left = &scree_plates(&f.state)[SCREE_WALL_LEFT];
    assert_true(bottom->force > 0 && left->force > 0 && bottom->shear[0] != 0 && bottom->shear[1] != 0);
    const double given[3] = {left->force - bottom->shear[0], -left->shear[1] - bottom->shear[1],
                             bottom->force - left->shear[2]};
    for (int k = 0; k < 3; k++) assert_int_equal(sum[k], scree_fixed_from(given[k], 1 / f.state.force_quantum));
    assert_true(contacts > 0);
    fixture_destroy(&f);
}

/// Half a quantum a contact, and the round-off of computing a force in double again (2^-2 quanta); as in two
/// dimensions.
static void table_says_what_the_sums_hold(void **unused)
{
    (void)unused;
    fixture f;
    scree_error error;
    scree_contact_table table = {0};
    sphere_create_assembly(&f, HERTZ_MINDLIN, EDGE, 2, false);
    sphere_run(&f, 50);
    assert_int_equal(scree_contact_table_build(&f.model, &f.state, &f.work, &table, &error), SCREE_OK);
    assert_true(table.count > f.state.count);
    double *sum = test_calloc(f.state.count * 6, sizeof *sum);
    size_t sliding = 0;
    for (size_t k = 0; k < table.count; k++) {
        const scree_contact *c = &table.contact[k];
        const double *n = c->normal, *t = c->tangent;
        const double moment[3] = {n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]};
        const uint32_t body[2] = {c->first, c->second};
        assert_true(c->tangential_force >= 0 && c->slip >= 0);
        sliding += c->sliding;
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < 3; i++) {
                double arm = f.state.row[body[side]].radius - 0.5 * c->overlap;
                double force = c->normal_force * n[i] + c->tangential_force * t[i];
                sum[6 * body[side] + (size_t)i] += side ? -force : force;
                sum[6 * body[side] + 3 + (size_t)i] -= c->tangential_force * moment[i] * arm;
            }
    }
    assert_true(sliding > 10 && sliding < table.count);
    for (size_t k = 0; k < f.state.count; k++) {
        double force[3], torque[3], most = 2 + 2 * (double)f.state.sum[k].contacts;
        sphere_force(&f, k, force, torque);
        for (int i = 0; i < 3; i++) {
            assert_true(fabs(force[i] - sum[6 * k + (size_t)i]) <= most * f.state.force_quantum);
            assert_true(fabs(torque[i] - sum[6 * k + 3 + (size_t)i]) <= most * f.state.torque_quantum);
        }
    }
    test_free(sum);
    scree_contact_table_destroy(&table);
    fixture_destroy(&f);
}

static void all_rows_of_the_memory_are_saved(void **unused)
{
    (void)unused;
    fixture f;
    scree_error error;
    create(&f, HERTZ_MINDLIN, 1, true);
    sphere_run(&f, 20);
    assert_int_equal(scree_contacts_save(&f.state, &f.work, &error), SCREE_OK);
    assert_true(f.state.contact_count > f.state.count && f.state.last_force && f.state.rolling);
    size_t found = 0, last = 0;
    for (size_t p = 0; p < f.work.pairs.count; p++)
        for (size_t k = 0; k < f.state.contact_count; k++) {
            const scree_contact_memory *m = &f.state.contact[k];
            if (m->first != f.work.pairs.first[p] || m->second != f.work.pairs.second[p]) continue;
            assert_memory_equal(&m->history, &f.work.pairs.history[p], sizeof m->history);
            assert_memory_equal(&f.state.last_force[k], &f.work.pairs.last_force[p], sizeof *f.state.last_force);
            assert_memory_equal(&f.state.rolling[k], &f.work.pairs.rolling[p], sizeof *f.state.rolling);
            last += f.state.last_force[k].value[0] != 0 && f.state.rolling[k].value[3] != 0;
            found++;
        }
    assert_true(2 * last > found);
    size_t walls = 0;
    for (size_t k = 0; k < f.state.contact_count; k++) walls += f.state.contact[k].second >= SCREE_WALL_ID;
    assert_int_equal(found + walls, f.state.contact_count);
    fixture_destroy(&f);
}

/// The smallest id is blamed, by every kernel, also for what only the third component shows.
static void faults_are_flagged(void **unused)
{
    (void)unused;
    for (int reference = 0; reference <= 1; reference++) {
        fixture f;
        create(&f, HERTZ_MINDLIN, 1, false);
        f.work.reference_kernel = reference;
        sphere_run(&f, 3);
        assert_int_equal(f.work.flags, 0);
        f.state.row[200].z = NAN;
        fixture_forces(&f);
        assert_int_equal(f.work.flags & SCREE_FLAG_NAN, SCREE_FLAG_NAN);
        assert_int_equal(f.work.flagged_id, 200);
        fixture_destroy(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_give_the_bits_of_the_reference),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(order_of_the_list_does_not_change_a_bit),
        cmocka_unit_test(momentum_is_conserved_exactly),
        cmocka_unit_test(table_says_what_the_sums_hold),
        cmocka_unit_test(all_rows_of_the_memory_are_saved),
        cmocka_unit_test(faults_are_flagged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
