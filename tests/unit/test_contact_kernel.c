/// The machinery around the laws: every kernel, partition and order of the list gives the same bits; sums are exact.
#include "contact_fixture.h"
#include "state/plates.h"

#include <stdlib.h>

enum { SIDE = 21, STEPS = 300 }; // 441 bodies: no multiple of any number of lanes or threads

/// Everything an evaluation writes, as bits.
static void assert_same(const fixture *a, const fixture *b)
{
    const scree_state *s = &a->state, *t = &b->state;
    assert_memory_equal(s->row, t->row, s->count * sizeof *s->row);
    assert_memory_equal(s->sum, t->sum, s->count * sizeof *s->sum);
    assert_memory_equal(&s->ledger, &t->ledger, sizeof s->ledger);
    assert_memory_equal(&s->largest_overlap, &t->largest_overlap, sizeof(double));
    assert_memory_equal(&s->force_quantum, &t->force_quantum, sizeof(double));
    assert_memory_equal(scree_plates(s), scree_plates(t), SCREE_WALL_COUNT * sizeof(scree_wall));
    assert_int_equal(a->work.flags, b->work.flags);
}

/// Walls on two sides, so that wall contacts are part of every comparison.
static void create(fixture *f, law_choice law, int materials)
{
    fixture_create_assembly(f, law, SIDE, materials);
    scree_plates(&f->state)[SCREE_WALL_BOTTOM] = (scree_wall){
        .position = -0.95e-3, .normal = {0, 1}, .velocity = 0.3, .tangential_velocity = {-0.2}, .active = 1};
    scree_plates(&f->state)[SCREE_WALL_LEFT] =
        (scree_wall){.position = -0.96e-3, .normal = {1, 0}, .velocity = -0.1, .active = 1};
    fixture_find_walls(f);
}

static void run(fixture *f, int steps)
{
    fixture_forces(f);
    for (int k = 0; k < steps; k++) fixture_step(f);
}

/// Runs the same assembly with the reference and with kernels of every instruction set of this machine.
static void compare_with_reference(law_choice law, int materials, bool rescaled)
{
    fixture reference, kernel;
    create(&reference, law, materials);
    law_rescale(&reference.model, rescaled);
    reference.work.reference_kernel = true;
    run(&reference, STEPS);
    assert_true(reference.state.largest_overlap > 0);
    assert_int_equal(reference.work.flags, 0);
    for (int isa = 2; isa <= scree_contact_instruction_set(0); isa++) {
        create(&kernel, law, materials);
        law_rescale(&kernel.model, rescaled);
        kernel.work.instruction_set = isa;
        run(&kernel, STEPS);
        assert_same(&reference, &kernel);
        const scree_pair_list *pairs = &kernel.work.pairs;
        for (size_t p = 0; p < pairs->count; p++)
            for (int v = 0; v < SCREE_HISTORY; v++) // 0 and -0 are the same history
                assert_true(pairs->history[p].value[v] == reference.work.pairs.history[p].value[v]);
        fixture_destroy(&kernel);
    }
    fixture_destroy(&reference);
}

static void kernels_give_the_bits_of_the_reference(void **unused)
{
    (void)unused;
    for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_BRILLIANTOV_IMPLICIT; law++)
        for (int materials = 1; materials <= 2; materials++) compare_with_reference((law_choice)law, materials, false);
    compare_with_reference(HERTZ_MINDLIN, 2, true);
}

static void threads_do_not_change_a_bit(void **unused)
{
    (void)unused;
    for (int law = HERTZ_MINDLIN; law <= HERTZ_BRILLIANTOV_IMPLICIT; law++) {
        fixture one, many;
        create(&one, (law_choice)law, 2);
        run(&one, STEPS);
        for (int threads = 2; threads <= 4; threads++) {
            create(&many, (law_choice)law, 2);
            many.work.threads = threads;
            run(&many, STEPS);
            assert_same(&one, &many);
            fixture_destroy(&many);
        }
        fixture_destroy(&one);
    }
}

/// Exchanges pairs k and l.
static void exchange(scree_pair_list *list, size_t k, size_t l)
{
    uint32_t first = list->first[k], second = list->second[k];
    scree_history history = list->history[k];
    list->first[k] = list->first[l], list->second[k] = list->second[l], list->history[k] = list->history[l];
    list->first[l] = first, list->second[l] = second, list->history[l] = history;
}

static void order_of_the_list_does_not_change_a_bit(void **unused)
{
    (void)unused;
    fixture ordered, shuffled;
    create(&ordered, HERTZ_MINDLIN, 1);
    create(&shuffled, HERTZ_MINDLIN, 1);
    scree_pair_list *list = &shuffled.work.pairs;
    for (size_t k = list->count - 1; k > 0; k--)
        exchange(list, k, (size_t)(fixture_random(1000000 + k) * (double)(k + 1)));
    fixture_cut(list, list->count / 3); // says nothing about touching any more
    shuffled.work.threads = 3;
    run(&ordered, STEPS);
    run(&shuffled, STEPS);
    assert_same(&ordered, &shuffled);
    fixture_destroy(&shuffled);
    fixture_destroy(&ordered);
}

/// A rebuild in mid-run: pairs that touch now come first, histories move with them.
static void rebuild_does_not_change_a_bit(void **unused)
{
    (void)unused;
    fixture kept, rebuilt;
    create(&kept, HERTZ_MINDLIN, 1);
    create(&rebuilt, HERTZ_MINDLIN, 1);
    run(&kept, STEPS);
    run(&rebuilt, STEPS / 2);
    scree_pair_list *list = &rebuilt.work.pairs;
    size_t touching = 0;
    for (size_t k = 0; k < list->count; k++) {
        const scree_row *a = &rebuilt.state.row[list->first[k]], *b = &rebuilt.state.row[list->second[k]];
        if (fixture_distance(a, b) < a->radius + b->radius) exchange(list, k, touching++);
    }
    assert_int_not_equal(touching, fixture_touching(list));
    fixture_cut(list, touching);
    rebuilt.work.rebuilds++;
    for (int k = STEPS / 2; k < STEPS; k++) fixture_step(&rebuilt);
    assert_same(&kept, &rebuilt);
    fixture_destroy(&rebuilt);
    fixture_destroy(&kept);
}

/// A list made anew between drift and forces, in which no pair counts as touching: pairs that open in that very step
/// still settle their accounts.
static void rebuild_in_every_step_does_not_change_a_bit(void **unused)
{
    (void)unused;
    fixture kept, rebuilt;
    create(&kept, HERTZ_MINDLIN, 1);
    create(&rebuilt, HERTZ_MINDLIN, 1);
    fixture_cut(&rebuilt.work.pairs, 0);
    fixture_forces(&kept);
    fixture_forces(&rebuilt);
    for (int k = 0; k < STEPS; k++) {
        rebuilt.work.rebuilds++;
        fixture_step(&kept);
        fixture_step(&rebuilt);
    }
    assert_same(&kept, &rebuilt);
    fixture_destroy(&rebuilt);
    fixture_destroy(&kept);
}

static void momentum_is_conserved_exactly(void **unused)
{
    (void)unused;
    fixture f;
    create(&f, HERTZ_MINDLIN, 2);
    run(&f, 10);
    int64_t fx = 0, fy = 0, contacts = 0;
    for (size_t k = 0; k < f.state.count; k++) {
        fx += f.state.sum[k].fx;
        fy += f.state.sum[k].fy;
        contacts += f.state.sum[k].contacts;
    }
    // What the walls give is on their accumulates, in the same quanta: normals along the axes round nothing.
    const scree_wall *bottom = &scree_plates(&f.state)[SCREE_WALL_BOTTOM],
                     *left = &scree_plates(&f.state)[SCREE_WALL_LEFT];
    assert_true(bottom->force > 0 && left->force > 0 && bottom->shear[0] != 0);
    int64_t x = scree_fixed_from(left->force - bottom->shear[0], 1 / f.state.force_quantum);
    int64_t y = scree_fixed_from(bottom->force - left->shear[1], 1 / f.state.force_quantum);
    assert_int_equal(fx, x);
    assert_int_equal(fy, y);
    assert_true(contacts > 0);
    fixture_destroy(&f);
}

static void sums_are_exact_to_half_a_quantum_a_contact(void **unused)
{
    (void)unused;
    fixture f;
    scree_error error;
    scree_contact_table table = {0};
    fixture_create_assembly(&f, HERTZ_MINDLIN, SIDE, 2);
    run(&f, 50);
    assert_int_equal(scree_contact_table_build(&f.model, &f.state, &f.work, &table, &error), SCREE_OK);
    assert_true(table.count > f.state.count);
    long double *sum = test_calloc(f.state.count * 3, sizeof *sum);
    for (size_t k = 0; k < table.count; k++) {
        const scree_contact *c = &table.contact[k];
        long double fx = (long double)c->normal_force * c->normal[0] - (long double)c->tangential_force * c->normal[1];
        long double fy = (long double)c->normal_force * c->normal[1] + (long double)c->tangential_force * c->normal[0];
        const uint32_t body[2] = {c->first, c->second};
        for (int side = 0; side < 2; side++) {
            const scree_row *row = &f.state.row[body[side]];
            sum[3 * body[side]] += side ? -fx : fx;
            sum[3 * body[side] + 1] += side ? -fy : fy;
            sum[3 * body[side] + 2] -= (long double)c->tangential_force * (row->radius - 0.5 * c->overlap);
        }
    }
    // Half a quantum a contact, and the round-off of computing a force in double: three roundings of 2^-53 of at most
    // 2^50 quanta, 2^-2 quanta; sliding forces are found again to the round-off of the spring they left, which is no
    // more.
    for (size_t k = 0; k < f.state.count; k++) {
        const scree_sum_row *s = &f.state.sum[k];
        double contacts = (double)s->contacts;
        assert_true(fabsl((long double)s->fx - sum[3 * k] / f.state.force_quantum) <= contacts);
        assert_true(fabsl((long double)s->fy - sum[3 * k + 1] / f.state.force_quantum) <= contacts);
        assert_true(fabsl((long double)s->torque - sum[3 * k + 2] / f.state.torque_quantum) <= contacts);
    }
    test_free(sum);
    scree_contact_table_destroy(&table);
    fixture_destroy(&f);
}

/// velocity_verlet stores v(n): the table goes back to v(n - 1/2), to round-off of the velocities.
static void table_finds_the_forces_of_the_last_evaluation(void **unused)
{
    (void)unused;
    fixture f;
    scree_error error;
    scree_contact_table leapfrog = {0}, verlet = {0};
    create(&f, HERTZ_MINDLIN, 2);
    run(&f, 50);
    assert_int_equal(scree_contact_table_build(&f.model, &f.state, &f.work, &leapfrog, &error), SCREE_OK);
    for (size_t k = 0; k < f.state.count; k++) {
        scree_row *row = &f.state.row[k];
        double force[3], half = 0.5 * f.state.step_size;
        fixture_force(&f, k, force);
        row->vx += half * force[0] / row->mass;
        row->vy += half * force[1] / row->mass;
        row->spin += half * force[2] / (0.5 * row->mass * row->radius * row->radius);
    }
    f.model.scheme = SCREE_SLOT_velocity_verlet;
    assert_int_equal(scree_contact_table_build(&f.model, &f.state, &f.work, &verlet, &error), SCREE_OK);
    assert_int_equal(verlet.count, leapfrog.count);
    for (size_t k = 0; k < verlet.count; k++) {
        const scree_contact *a = &leapfrog.contact[k], *b = &verlet.contact[k];
        assert_true(a->first == b->first && a->second == b->second && a->wall == b->wall);
        // velocities of 1 m/s lose 1e-16 of it; damping forces here are below 1e3 N s/m
        assert_true(fabs(a->normal_force - b->normal_force) < 1e-12 && fabs(a->slip - b->slip) < 1e-14);
        assert_true(fabs(a->tangential_force - b->tangential_force) < 1e-12);
    }
    scree_contact_table_destroy(&verlet);
    scree_contact_table_destroy(&leapfrog);
    fixture_destroy(&f);
}

/// Order, geometry and kinds of the entries, with ids that are not rows.
static void table_is_ordered_by_ids(void **unused)
{
    (void)unused;
    fixture f;
    scree_error error;
    scree_contact_table table = {0};
    create(&f, HERTZ_MINDLIN, 1);
    for (size_t k = 0; k < f.state.count; k++) f.state.id[k] = (uint32_t)((k * 100) % f.state.count);
    for (size_t k = 0; k < f.state.count; k++) f.state.row_of_id[f.state.id[k]] = (uint32_t)k;
    f.work.pairs.count = 0;
    fixture_find_pairs(&f, 3e-4);
    run(&f, 20);
    assert_int_equal(scree_contact_table_build(&f.model, &f.state, &f.work, &table, &error), SCREE_OK);
    int64_t touching = 0;
    size_t walls = 0, sliding = 0;
    for (size_t k = 0; k < f.state.count; k++) touching += f.state.sum[k].contacts;
    uint64_t previous = 0;
    for (size_t k = 0; k < table.count; k++) {
        const scree_contact *c = &table.contact[k];
        const scree_row *first = &f.state.row[c->first];
        uint64_t second = c->wall ? SCREE_WALL_ID + c->second : f.state.id[c->second];
        uint64_t key = (uint64_t)f.state.id[c->first] << 32 | second;
        assert_true(k == 0 || key > previous);
        assert_true(f.state.id[c->first] < second);
        previous = key;
        walls += c->wall;
        sliding += c->sliding;
        // the contact point lies R - d/2 from the centre, against the normal
        double arm = first->radius - c->overlap / 2;
        assert_true(fabs(first->x - c->point[0] - arm * c->normal[0]) < 1e-17);
        assert_true(fabs(first->y - c->point[1] - arm * c->normal[1]) < 1e-17);
        double length = hypot(c->branch[0], c->branch[1]);
        double expected = c->wall ? arm : arm + f.state.row[c->second].radius - c->overlap / 2;
        assert_true(fabs(length - expected) < 1e-15);
        assert_true(fabs(c->tangential_force) <= 0.5 * c->normal_force * (1 + 1e-12));
    }
    assert_int_equal(touching, 2 * table.count - walls);
    assert_true(walls > 10 && sliding > 10 && sliding < table.count);
    scree_contact_table_destroy(&table);
    fixture_destroy(&f);
}

static bool holds_anything(const scree_history *history)
{
    bool any = false;
    for (int k = 0; k < SCREE_HISTORY; k++) any = any || history->value[k] != 0;
    return any;
}

static void saved_contacts_are_the_histories_in_order(void **unused)
{
    (void)unused;
    fixture f;
    scree_error error;
    create(&f, HERTZ_MINDLIN, 1);
    run(&f, 20);
    assert_int_equal(scree_contacts_save(&f.state, &f.work, &error), SCREE_OK);
    size_t remembered = 0;
    for (size_t p = 0; p < f.work.pairs.count; p++) remembered += holds_anything(&f.work.pairs.history[p]);
    for (size_t p = 0; p < f.work.wall_pairs.count; p++) remembered += holds_anything(&f.work.wall_pairs.history[p]);
    assert_int_equal(f.state.contact_count, remembered);
    for (size_t k = 1; k < f.state.contact_count; k++) {
        const scree_contact_memory *a = &f.state.contact[k - 1], *b = &f.state.contact[k];
        assert_true(a->first < b->first || (a->first == b->first && a->second < b->second));
    }
    for (size_t p = 0; p < f.work.pairs.count; p++)
        for (size_t k = 0; k < f.state.contact_count; k++) {
            const scree_contact_memory *m = &f.state.contact[k];
            if (m->first != f.work.pairs.first[p] || m->second != f.work.pairs.second[p]) continue;
            assert_memory_equal(&m->history, &f.work.pairs.history[p], sizeof m->history);
            remembered--;
        }
    for (size_t k = 0; k < f.state.contact_count; k++) remembered -= f.state.contact[k].second >= SCREE_WALL_ID;
    assert_int_equal(remembered, 0);
    fixture_destroy(&f);
}

/// The smallest id is blamed, by every kernel.
static void faults_are_flagged(void **unused)
{
    (void)unused;
    for (int reference = 0; reference <= 1; reference++) {
        fixture f;
        create(&f, HERTZ_MINDLIN, 1);
        f.work.reference_kernel = reference;
        run(&f, 3);
        assert_int_equal(f.work.flags, 0);

        // bodies 200 and 201 pressed into each other
        scree_row kept = f.state.row[201];
        f.state.row[201].x = f.state.row[200].x + 0.2e-3;
        f.state.row[201].y = f.state.row[200].y;
        f.state.largest_overlap = 2e-3;
        fixture_forces(&f);
        assert_int_equal(f.work.flags, SCREE_FLAG_OVERLAP);
        assert_int_equal(f.work.flagged_id, 200);

        // quanta for much smaller forces
        f.state.row[201] = kept;
        f.work.flags = 0;
        scree_contact_set_quanta(&f.model, &f.state, 0);
        f.state.force_quantum = ldexp(f.state.force_quantum, -30);
        scree_contact_forces(&f.model, &f.state, &f.work);
        assert_int_equal(f.work.flags, SCREE_FLAG_FORCE_RANGE);
        assert_int_equal(f.work.flagged_id, 0);

        f.work.flags = 0;
        f.state.row[300].x = NAN;
        f.state.row[301].vy = NAN;
        fixture_forces(&f);
        assert_true(f.work.flags & SCREE_FLAG_NAN);
        assert_int_equal(f.work.flagged_id, 300);
        fixture_destroy(&f);
    }
}

/// Whatever the sums held: all of it is cleared, but for the rows that are known to be clear.
static void sums_are_made_anew(void **unused)
{
    (void)unused;
    for (int threads = 0; threads <= 3; threads++) { // 0: the reference
        fixture f;
        create(&f, HERTZ_BRILLIANTOV, 1);
        f.work.threads = threads > 0 ? threads : 1;
        f.work.reference_kernel = threads == 0;
        f.state.step_size = 0; // histories stay as they are
        const size_t count = f.state.count, clear[] = {0, 100, count};
        for (int k = 0; k < 2; k++) fixture_forces(&f); // the quanta follow from the overlaps of the first one
        scree_sum_row *first = NULL;
        assert_int_equal(scree_allocate(&first, count, sizeof *first, NULL), SCREE_OK);
        memcpy(first, f.state.sum, count * sizeof *first);
        for (size_t k = 0; k < sizeof clear / sizeof *clear; k++) {
            memset(f.state.sum, 0, clear[k] * sizeof *f.state.sum);
            f.work.clear_rows = clear[k];
            fixture_forces(&f);
            assert_memory_equal(first, f.state.sum, count * sizeof *first);
            assert_int_equal(f.work.clear_rows, 0);
        }
        scree_release(&first);
        fixture_destroy(&f);
    }
}

/// Without memory for the partition the reference does the work.
static void no_memory_changes_no_bit(void **unused)
{
    (void)unused;
    fixture plenty, short_of;
    create(&plenty, HERTZ_MINDLIN, 1);
    create(&short_of, HERTZ_MINDLIN, 1);
    short_of.work.threads = 2;
    run(&plenty, 10);
    fixture_forces(&short_of);
    for (int k = 0; k < 10; k++) {
        short_of.work.rebuilds++; // each evaluation cuts the list anew, and fails at another allocation
        (void)scree_allocation_fail_after(1 + (uint64_t)k % 4);
        if (k % 2) scree_contact_scratch_destroy(&short_of.work);
        fixture_step(&short_of);
        (void)scree_allocation_fail_after(0);
    }
    assert_same(&plenty, &short_of);
    fixture_destroy(&short_of);
    fixture_destroy(&plenty);
}

/// The bound of the quanta holds from the first evaluation on, whatever the overlap: no force leaves the range, and the
/// quantum is not needlessly coarse.
static void quanta_fit_the_forces(void **unused)
{
    (void)unused;
    fixture f;
    create(&f, HERTZ_BRILLIANTOV, 2);
    f.state.largest_overlap = 0; // as at the start of a run
    fixture_forces(&f);
    assert_int_equal(f.work.flags, 0);
    for (int k = 0; k < 20; k++) fixture_step(&f);
    int64_t largest = 0;
    for (size_t k = 0; k < f.state.count; k++)
        largest = llabs(f.state.sum[k].fx) > largest ? llabs(f.state.sum[k].fx) : largest;
    assert_true(largest > INT64_C(1) << 42);
    scree_contact_set_quanta(&f.model, &f.state, 1e12);
    assert_true(f.state.force_quantum >= 1e12 / 0x1p50);
    assert_true(f.state.torque_quantum >= f.state.force_quantum * f.model.radius_max);
    fixture_destroy(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_give_the_bits_of_the_reference),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(order_of_the_list_does_not_change_a_bit),
        cmocka_unit_test(rebuild_does_not_change_a_bit),
        cmocka_unit_test(rebuild_in_every_step_does_not_change_a_bit),
        cmocka_unit_test(momentum_is_conserved_exactly),
        cmocka_unit_test(sums_are_exact_to_half_a_quantum_a_contact),
        cmocka_unit_test(table_finds_the_forces_of_the_last_evaluation),
        cmocka_unit_test(table_is_ordered_by_ids),
        cmocka_unit_test(saved_contacts_are_the_histories_in_order),
        cmocka_unit_test(faults_are_flagged),
        cmocka_unit_test(sums_are_made_anew),
        cmocka_unit_test(no_memory_changes_no_bit),
        cmocka_unit_test(quanta_fit_the_forces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
