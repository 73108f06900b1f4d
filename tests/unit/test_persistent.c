/// The persistent list: pairs that are held together without a distance test, by a law that pulls. Closed forms of
/// motion, what the neighbour list makes of it, and that nothing but the state decides.
#include "io_scratch.h"
#include "net_variations.h"
#include "periodic_fixture.h"

#include "contact/laws.h"
#include "io/snapshot.h"
#include "state/persistent.h"

static const double STIFFNESS = 3e5; // N/m

/// `count` bodies of radius 1 mm at rest at the origin, in a cell `side` wide that is periodic in these directions.
static void create(periodic_sample *s, int dimension, size_t count, double side, unsigned directions)
{
    const double lattice[9] = {side, 0, 0, 0, side, 0, 0, 0, dimension == 3 ? side : 1};
    periodic_create(s, dimension, count, lattice, LINEAR);
    if (!directions) scree_periodic_set(scree_cell(&s->state), 0, (const double[3]){1, 1, 1});
    scree_cell(&s->state)->directions = directions;
    s->model.pairs[0][0] = s->model.walls[0] = linear_pair(STIFFNESS, 0, 0.7, 0.5, 0, 0);
    s->model.persistent.law = (scree_law_use){.law = SCREE_SLOT_linear, .option = LINEAR_HELD};
    memcpy(s->model.persistent.pairs, s->model.pairs, sizeof s->model.pairs);
    const double none[3] = {0};
    for (size_t k = 0; k < count; k++) periodic_place(s, k, none, none, 1e-3);
}

static void put(periodic_sample *s, size_t row, double x, double y, double z)
{
    periodic_place(s, row, (const double[3]){x, y, z}, (const double[3]){0}, 1e-3);
}

static void hold(periodic_sample *s, uint32_t a, uint32_t b, double rest)
{
    scree_error error;
    const double constant[SCREE_MEMBER_CONSTANTS] = {rest, INFINITY, INFINITY}; // it never breaks
    check(scree_persistent_add(&s->state, a, b, constant, &error), &error);
}

static uint64_t checksum_of(periodic_sample *s)
{
    assert_int_equal(scree_contacts_save(&s->state, &s->work, NULL), SCREE_OK);
    return scree_state_checksum(&s->model, &s->state);
}

/// Energy of the sample and the residual of its balance since the ledger was opened [J].
static scree_energy energy_of(periodic_sample *s, double *largest_pull)
{
    scree_contact_table table = {0};
    scree_energy energy;
    scree_error error;
    check(scree_contact_table_build(&s->model, &s->state, &s->work, &table, &error), &error);
    scree_energy_measure(&s->model, &s->state, &table, &energy);
    for (size_t k = 0; k < table.count && largest_pull; k++)
        *largest_pull = fmax(*largest_pull, -table.contact[k].normal_force);
    scree_contact_table_destroy(&table);
    return energy;
}

static double stored(const scree_energy *e)
{
    return e->kinetic + e->kinetic_rotation + e->elastic_normal + e->elastic_tangential;
}

/// Distance of the bodies with ids 0 and 1 [m].
static double distance(const periodic_sample *s)
{
    scree_persistent_member pair = {.first = 0, .second = 1};
    scree_vector branch;
    scree_persistent_branch(&s->state, &pair, branch);
    return scree_length(branch);
}

// ---- motion ------------------------------------------------------------------------------------------------------

/// Two bodies `gap` apart that are at rest there and are let go `swing` farther apart, at an angle. The central
/// difference of an oscillator of frequency w goes with w' where sin(w' dt / 2) = w dt / 2, so the separation is known
/// at every step; what is left is round-off, that of positions (1e-16 of 10 mm) over some 10^4 steps among it.
static void oscillate(int dimension, double gap, double centre)
{
    const double swing = 2e-6, length = 2e-3 + gap, n[3] = {0.6, 0.8, 0};
    periodic_sample s;
    create(&s, dimension, 2, 20e-3, centre > 0 ? (dimension == 3 ? 7 : 3) : 0);
    for (int b = 0; b < 2; b++) {
        double half = (b ? 0.5 : -0.5) * (length + swing), place[2] = {centre + half * n[0], centre + half * n[1]};
        for (int k = 0; k < 2 && centre > 0; k++) place[k] -= 20e-3 * floor(place[k] / 20e-3);
        put(&s, (size_t)b, place[0], place[1], centre);
    }
    hold(&s, 0, 1, -gap);
    const double mass = s.state.row[0].mass / 2, step = s.model.step, w = sqrt(STIFFNESS / mass);
    const double turn = 2 * asin(0.5 * w * step);
    periodic_forces(&s);
    const scree_energy first = energy_of(&s, NULL);
    double worst = 0, drift = 0, pull = 0;
    for (int k = 1; k <= 20000; k++) {
        periodic_step(&s);
        worst = fmax(worst, fabs(distance(&s) - length - swing * cos(turn * k)));
        if (k % 100) continue;
        scree_energy now = energy_of(&s, &pull);
        drift = fmax(drift, fabs(stored(&now) / stored(&first) - 1));
    }
    print_message("%dD, gap %g: departure %.2g of the swing, energy %.2g, largest pull %.3g of k a\n", dimension, gap,
                  worst / swing, drift, pull / (STIFFNESS * swing));
    assert_true(worst < 1e-9 * swing && drift < 1e-9);
    assert_true(pull > 0.9 * STIFFNESS * swing);
    periodic_destroy(&s);
}

static void a_held_pair_swings_about_its_rest(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        oscillate(dimension, -1e-5, 0); // overlapping
        oscillate(dimension, 1.5e-3, 0);
        oscillate(dimension, 1.5e-3, 20e-3 - 1e-4); // across a corner of a periodic cell
    }
}

/// A bent chain that turns about the origin: no momentum appears, the balance closes, the chain keeps its shape but for
/// what the centrifugal force stretches it by, w^2 m r / k, some 1e-7 of a radius.
static void a_chain_turns_as_a_whole(int dimension)
{
    enum { LINKS = 6 };
    const double rate = 50;
    periodic_sample s;
    create(&s, dimension, LINKS, 100e-3, 0);
    for (size_t k = 0; k < LINKS; k++) {
        const double angle = 0.3 * (double)k, x = 3e-3 * (double)k, y = 1e-3 * sin(angle), z = 2e-3 * cos(angle);
        put(&s, k, x, y, dimension == 3 ? z : 0);
        s.state.row[k].vx = -rate * y;
        s.state.row[k].vy = rate * x;
        if (dimension == 2) s.state.row[k].spin = rate;
        if (dimension == 3) s.state.turn[k].wz = rate;
    }
    for (uint32_t k = 1; k < LINKS; k++) {
        scree_vector apart;
        const scree_row *a = &s.state.row[k - 1], *b = &s.state.row[k];
        apart[0] = a->x - b->x, apart[1] = a->y - b->y, apart[2] = dimension == 3 ? a->z - b->z : 0;
        hold(&s, k - 1, k, 2e-3 - scree_length(apart));
    }
    double length = 0, momentum[2] = {0}, spin = 0, expected = 0;
    for (size_t k = 0; k < LINKS; k++) {
        const scree_row *row = &s.state.row[k];
        momentum[0] += row->mass * row->vx, momentum[1] += row->mass * row->vy;
        expected += row->mass * (row->x * row->vy - row->y * row->vx) + scree_body_inertia(&s.state, k) * rate;
    }
    length = distance(&s);
    periodic_forces(&s);
    const scree_energy first = energy_of(&s, NULL);
    s.state.ledger.initial = stored(&first);
    const int steps = (int)(2 * M_PI / rate / s.model.step);
    for (int k = 0; k < steps / 4; k++) periodic_step(&s); // a quarter of a turn
    const scree_energy now = energy_of(&s, NULL);
    for (size_t k = 0; k < LINKS; k++) {
        const scree_row *row = &s.state.row[k];
        momentum[0] -= row->mass * row->vx, momentum[1] -= row->mass * row->vy;
        spin += row->mass * (row->x * row->vy - row->y * row->vx) +
                scree_body_inertia(&s.state, k) * (dimension == 2 ? row->spin : s.state.turn[k].wz);
    }
    const double scale = LINKS * s.state.row[0].mass * rate * 15e-3;
    print_message("%dD: momentum %.2g, angular momentum %.2g, residual %.2g, length %.2g\n", dimension,
                  hypot(momentum[0], momentum[1]) / scale, spin / expected - 1, now.residual / stored(&first),
                  distance(&s) / length - 1);
    // Integers: momentum is exact but for the rounding of kicks. Angular momentum and energy: second order in the angle
    // of a step, 1e-5.
    assert_true(hypot(momentum[0], momentum[1]) < 1e-11 * scale);
    assert_true(fabs(spin / expected - 1) < 1e-8);
    assert_true(fabs(now.residual) < 1e-8 * stored(&first));
    assert_true(fabs(distance(&s) / length - 1) < 1e-5);
    assert_true(s.state.ledger.friction == 0);
    periodic_destroy(&s);
}

static void chains_turn_as_a_whole(void **unused)
{
    (void)unused;
    a_chain_turns_as_a_whole(2);
    a_chain_turns_as_a_whole(3);
}

// ---- lists -------------------------------------------------------------------------------------------------------

/// A shaken net, periodic or not, in which every third pair that touches or nearly does is held, and some far ones are.
static void create_net(periodic_sample *s, int dimension, unsigned directions)
{
    const int n = dimension == 2 ? 7 : 4;
    const double spacing = 1.99e-3;
    create(s, dimension, (size_t)n * (size_t)n * (dimension == 3 ? (size_t)n : 1), n * spacing, directions);
    for (size_t k = 0; k < s->state.count; k++) {
        const size_t index[3] = {k % (size_t)n, k / (size_t)n % (size_t)n, k / (size_t)(n * n)};
        double place[3] = {0}, velocity[3] = {0};
        for (int i = 0; i < dimension; i++) {
            place[i] = ((double)index[i] + 0.5 + 0.01 * periodic_random(8 * k + (uint64_t)i)) * spacing;
            velocity[i] = 3 * periodic_random(8 * k + 3 + (uint64_t)i);
        }
        periodic_place(s, k, place, velocity, 1e-3 * (1 + 0.02 * periodic_random(8 * k + 6)));
    }
    for (uint32_t a = 0; a < s->state.count; a++)
        for (uint32_t b = a + 1; b < s->state.count; b++) {
            scree_persistent_member pair = {.first = a, .second = b};
            scree_vector branch;
            scree_persistent_branch(&s->state, &pair, branch);
            double gap = scree_length(branch) - s->state.row[a].radius - s->state.row[b].radius;
            if ((gap < 0.1e-3 && (a + b) % 3 == 0) || (gap > 0.5e-3 && gap < 1.5e-3 && (7 * a + b) % 23 == 0))
                hold(s, b, a, -gap + 1e-6);
        }
    assert_true(scree_persistent(&s->state)->count > 20);
}

/// Bytes of all that a run goes on from.
static uint64_t run_net(int dimension, unsigned directions, int threads, int set, bool reference, int disturbance)
{
    periodic_sample s;
    create_net(&s, dimension, directions);
    s.work.threads = 1;
    scree_work_destroy(&s.work);
    assert_int_equal(scree_work_create(&s.work, &s.model, threads, NULL), SCREE_OK);
    s.work.keep_threads = true;
    s.work.instruction_set = set;
    s.work.reference_kernel = reference;
    s.work.skin *= disturbance == 3 ? 1 : 0.2;
    periodic_forces(&s);
    for (int k = 0; k < 1500; k++) {
        periodic_step(&s);
        if (disturbance == 1 && k % 3 == 0) scree_neighbours_invalidate(&s.work);
        if (disturbance == 2 && k % 50 == 7) {
            assert_int_equal(scree_contacts_save(&s.state, &s.work, NULL), SCREE_OK);
            scree_contact_scratch_destroy(&s.work);
            scree_work_destroy(&s.work);
            assert_int_equal(scree_work_create(&s.work, &s.model, threads, NULL), SCREE_OK);
        }
    }
    assert_true(s.work.rebuilds > 1 || disturbance > 1);
    uint64_t checksum = checksum_of(&s);
    periodic_destroy(&s);
    return checksum;
}

/// Neither threads nor instruction sets, nor when lists are made or thrown away, nor how wide they are.
static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    assert_nothing_but_the_state_decides(run_net, 3);
}

/// Members lie in front, each once; no pair of them is among the others, and of the others none is lost.
static void assert_lists(periodic_sample *s)
{
    const scree_pair_list *pairs = &s->work.pairs;
    const scree_persistent_list *list = scree_persistent(&s->state);
    size_t expected = 0, found = 0;
    assert_int_equal(scree_pairs_held(pairs), list->count);
    for (size_t p = 0; p < pairs->count; p++) {
        uint32_t a = s->state.id[pairs->first[p]], b = s->state.id[pairs->second[p]];
        assert_true(a < b);
        assert_true((scree_persistent_find(&s->state, a, b) != SIZE_MAX) == (p < scree_pairs_held(pairs)));
        const scree_row *one = &s->state.row[pairs->first[p]], *other = &s->state.row[pairs->second[p]];
        if (p >= scree_pairs_held(pairs))
            found += hypot(one->x - other->x, one->y - other->y) < one->radius + other->radius;
        else
            assert_true(p == 0 || pairs->first[p] != pairs->first[p - 1] || pairs->second[p] != pairs->second[p - 1]);
    }
    for (uint32_t a = 0; a < s->state.next_id; a++)
        for (uint32_t b = a + 1; b < s->state.next_id; b++) {
            if (scree_state_row_of(&s->state, a) == SCREE_NO_ROW || scree_state_row_of(&s->state, b) == SCREE_NO_ROW)
                continue;
            scree_persistent_member pair = {.first = a, .second = b};
            scree_vector branch;
            scree_persistent_branch(&s->state, &pair, branch);
            double radii = s->state.row[scree_state_row_of(&s->state, a)].radius +
                           s->state.row[scree_state_row_of(&s->state, b)].radius;
            expected += scree_length(branch) < radii && scree_persistent_find(&s->state, a, b) == SIZE_MAX;
        }
    assert_int_equal(found, expected);
}

static void a_pair_is_in_one_list(void **unused)
{
    (void)unused;
    for (unsigned directions = 0; directions <= 3; directions++) {
        periodic_sample s;
        create_net(&s, 2, directions);
        periodic_forces(&s);
        assert_lists(&s);
        for (int k = 0; k < 300; k++) periodic_step(&s);
        scree_neighbours_invalidate(&s.work);
        periodic_forces(&s);
        assert_lists(&s);
        periodic_destroy(&s);
    }
}

/// What a pair remembers goes with it; with a body its pairs go; what is let go is like any other pair from then on.
static void members_come_and_go(void **unused)
{
    (void)unused;
    periodic_sample s;
    create_net(&s, 2, 3);
    periodic_forces(&s);
    for (int k = 0; k < 50; k++) periodic_step(&s);
    assert_int_equal(scree_contacts_save(&s.state, &s.work, NULL), SCREE_OK);
    const scree_persistent_list *list = scree_persistent(&s.state);
    const scree_persistent_member kept = list->member[list->count - 1], gone = list->member[0];
    const size_t before = list->count;
    assert_true(kept.history.value[0] != 0 && kept.first != gone.first && kept.second != gone.first);
    size_t with = 0;
    for (size_t k = 0; k < before; k++)
        with += list->member[k].first == gone.first || list->member[k].second == gone.first;
    assert_int_equal(scree_state_remove(&s.state, &gone.first, 1, NULL), SCREE_OK);
    assert_int_equal(list->count, before - with);
    assert_int_equal(scree_state_append(&s.state, SCREE_MARK_GRAIN, 1, NULL), SCREE_OK);
    s.state.row[s.state.count - 1] = s.state.row[0];
    s.state.row[s.state.count - 1].x += 1.2e-3; // between others, held to one of them only
    hold(&s, (uint32_t)s.state.next_id - 1, kept.first, 0);
    periodic_forces(&s);
    assert_lists(&s);
    size_t number = scree_persistent_find(&s.state, kept.first, kept.second);
    assert_int_equal(scree_contacts_save(&s.state, &s.work, NULL), SCREE_OK);
    assert_memory_equal(&list->member[number].constant, &kept.constant, sizeof kept.constant);
    assert_true(fabs(list->member[number].history.value[0] / kept.history.value[0] - 1) < 0.2); // one step later

    // Let go and held anew within one step: nothing of the old memory comes back.
    assert_int_equal(scree_persistent_remove(&s.state, kept.second, kept.first, NULL), SCREE_OK);
    hold(&s, kept.first, kept.second, kept.constant[0]);
    scree_error error;
    check(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), &error);
    for (size_t p = 0; p < scree_pairs_held(&s.work.pairs); p++)
        if (s.state.id[s.work.pairs.first[p]] == kept.first && s.state.id[s.work.pairs.second[p]] == kept.second)
            assert_true(s.work.pairs.history[p].value[0] == 0);
    assert_int_equal(scree_persistent_remove(&s.state, kept.first, kept.second, NULL), SCREE_OK);
    periodic_forces(&s);
    assert_lists(&s);
    periodic_destroy(&s);
}

/// From a checkpoint, with pairs across the faces of the cell, to the last bit.
static void a_checkpoint_has_all_of_it(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        char folder[64];
        periodic_sample s;
        scree_error error;
        assert_true(scratch_create(folder));
        create_net(&s, dimension, dimension == 3 ? 7 : 3);
        periodic_forces(&s);
        for (int k = 0; k < 100; k++) periodic_step(&s);
        assert_int_equal(scree_contacts_save(&s.state, &s.work, NULL), SCREE_OK);
        check(scree_checkpoint_write(folder, &s.state, 1, &error), &error);
        for (int k = 0; k < 200; k++) periodic_step(&s);
        const uint64_t expected = checksum_of(&s);
        scree_contact_scratch_destroy(&s.work);
        scree_work_destroy(&s.work);
        scree_state_destroy(&s.state);
        check(scree_checkpoint_read(folder, dimension, &s.state, 1, &error), &error);
        check(scree_work_create(&s.work, &s.model, 2, &error), &error);
        check(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), &error);
        for (int k = 0; k < 200; k++) periodic_step(&s);
        assert_true(checksum_of(&s) == expected);
        periodic_destroy(&s);
        scratch_destroy(folder);
    }
}

// ---- what is refused ---------------------------------------------------------------------------------------------

static void bad_pairs_are_refused(void **unused)
{
    (void)unused;
    periodic_sample s;
    scree_error error;
    const double rest[SCREE_MEMBER_CONSTANTS] = {0};
    create(&s, 2, 3, 20e-3, 3);
    put(&s, 1, 2e-3, 0, 0);
    put(&s, 2, 10e-3, 10e-3, 0);
    hold(&s, 1, 0, 0);
    assert_int_equal(scree_persistent_add(&s.state, 0, 1, rest, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "already"));
    assert_int_equal(scree_persistent_add(&s.state, 1, 1, rest, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_persistent_add(&s.state, 0, 3, rest, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_persistent_remove(&s.state, 1, 2, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_persistent(&s.state)->count, 1);

    // Longer than half of the cell.
    assert_int_equal(scree_persistent_add(&s.state, 0, 2, rest, &error), SCREE_OK);
    assert_int_equal(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "half of the periodic cell"));
    assert_int_equal(scree_persistent_remove(&s.state, 0, 2, &error), SCREE_OK);

    // A law that cannot.
    s.model.persistent = (scree_persistent_law){.law = {.law = SCREE_SLOT_hertz_mindlin}};
    assert_int_equal(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "cannot hold"));
    periodic_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_held_pair_swings_about_its_rest),
        cmocka_unit_test(chains_turn_as_a_whole),
        cmocka_unit_test(nothing_but_the_state_decides),
        cmocka_unit_test(a_pair_is_in_one_list),
        cmocka_unit_test(members_come_and_go),
        cmocka_unit_test(a_checkpoint_has_all_of_it),
        cmocka_unit_test(bad_pairs_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
