/// Bonds that break: at which step, by which force, what is left of them, and that neither momentum nor energy nor an
/// event is lost, whatever the order, the threads, the lists and the restarts.
#include "io_scratch.h"
#include "net_variations.h"
#include "periodic_fixture.h"

#include "bond/make.h"
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
    s->model.pairs[0][0] = s->model.walls[0] = linear_pair(STIFFNESS, 0, 0.7, 0.5, 0.05, 0.05);
    s->model.persistent.law = (scree_law_use){.law = SCREE_SLOT_linear, .option = LINEAR_HELD};
    memcpy(s->model.persistent.pairs, s->model.pairs, sizeof s->model.pairs);
    s->model.seed = 3;
    const double none[3] = {0};
    for (size_t k = 0; k < count; k++) periodic_place(s, k, none, none, 1e-3);
}

static void damp(periodic_sample *s, double ratio)
{
    s->model.pairs[0][0] = linear_pair(STIFFNESS, 0, 0.7, 0.5, ratio, ratio);
    memcpy(s->model.persistent.pairs, s->model.pairs, sizeof s->model.pairs);
}

static void hold(periodic_sample *s, uint32_t a, uint32_t b, double rest, double tension, double shear, double slope)
{
    scree_error error;
    check(scree_persistent_add(&s->state, a, b, (double[SCREE_MEMBER_CONSTANTS]){rest, tension, shear, slope}, &error),
          &error);
}

static scree_contact_table table_of(periodic_sample *s)
{
    scree_contact_table table = {0};
    scree_error error;
    check(scree_contact_table_build(&s->model, &s->state, &s->work, &table, &error), &error);
    return table;
}

static scree_energy energy_of(periodic_sample *s)
{
    scree_contact_table table = table_of(s);
    scree_energy energy;
    scree_energy_measure(&s->model, &s->state, &table, &energy);
    scree_contact_table_destroy(&table);
    return energy;
}

static double stored(const scree_energy *e)
{
    return e->kinetic + e->kinetic_rotation + e->elastic_normal + e->elastic_tangential;
}

/// First forces, and the energy that the balance begins with [J].
static double open_ledger(periodic_sample *s)
{
    periodic_forces(s);
    const scree_energy first = energy_of(s);
    s->state.ledger.initial = stored(&first);
    return stored(&first);
}

static double distance(const periodic_sample *s)
{
    scree_persistent_member pair = {.first = 0, .second = 1};
    scree_vector branch;
    scree_persistent_branch(&s->state, &pair, branch);
    return scree_length(branch);
}

/// Sum of forces and of torques about the origin [quanta of force; N m].
static void assert_balanced(const periodic_sample *s)
{
    int64_t force[3] = {0};
    for (size_t k = 0; k < s->state.count; k++) {
        force[0] += s->state.sum[k].fx;
        force[1] += s->state.sum[k].fy;
        force[2] += s->state.dimension == 3 ? s->state.sum[k].fz : 0;
    }
    for (int k = 0; k < 3; k++) assert_int_equal(force[k], 0);
}

// ---- a pair ------------------------------------------------------------------------------------------------------

/// Unit vectors along and across a generic axis.
static void axes(int dimension, double along[3], double across[3])
{
    const double angle = 0.6, rise = dimension == 3 ? 0.5 : 0;
    const double n[3] = {cos(angle) * cos(rise), sin(angle) * cos(rise), sin(rise)}, t[3] = {-sin(angle), cos(angle)};
    memcpy(along, n, sizeof n);
    memcpy(across, t, sizeof t);
}

/// Two bodies with the centres `length` apart that move against each other with `along` and `across` [m/s] each, the
/// first one forward, and both turn with `spin` about the axis that is normal to both directions.
static void place_pair(periodic_sample *s, double centre, double length, double along, double across, double spin)
{
    const int dimension = s->state.dimension;
    const double side = scree_cell(&s->state)->directions ? scree_cell(&s->state)->lattice[0] : INFINITY;
    double n[3], t[3];
    axes(dimension, n, t);
    for (size_t b = 0; b < 2; b++) {
        const double sign = b ? -1 : 1;
        double place[3] = {0}, velocity[3] = {0};
        for (int k = 0; k < dimension; k++) {
            place[k] = centre + sign * 0.5 * length * n[k];
            if (isfinite(side)) place[k] -= side * floor(place[k] / side);
            velocity[k] = sign * (along * n[k] + across * t[k]);
        }
        periodic_place(s, b, place, velocity, 1e-3);
        if (dimension == 2) s->state.row[b].spin = spin;
        if (dimension == 3)
            s->state.turn[b] = (scree_turn_row){.wx = spin * (n[1] * t[2] - n[2] * t[1]),
                                                .wy = spin * (n[2] * t[0] - n[0] * t[2]),
                                                .wz = spin * (n[0] * t[1] - n[1] * t[0])};
    }
}

/// Pulled apart without a dashpot, the gap of a central difference scheme is v dt sin(n a) / sin(a) with sin(a / 2) =
/// w dt / 2: the step at which k times it reaches the strength is known. Afterwards nothing acts.
static void break_in_tension(int dimension, double gap, double centre)
{
    const double speed = 0.4, length = 2e-3 + gap;
    const int at = 23; // a quarter of the period has some 40 steps
    periodic_sample s;
    create(&s, dimension, 2, 20e-3, centre > 0 ? (dimension == 3 ? 7 : 3) : 0);
    damp(&s, 0);
    place_pair(&s, centre, length, speed, 0, 0);
    const double mass = s.state.row[0].mass / 2, step = s.model.step,
                 turn = 2 * asin(0.5 * sqrt(STIFFNESS / mass) * step);
    double elongation[2];
    for (int k = 0; k < 2; k++) elongation[k] = 2 * speed * step * sin(turn * (at - 1 + k)) / sin(turn);
    hold(&s, 0, 1, -gap, STIFFNESS * 0.5 * (elongation[0] + elongation[1]), INFINITY, 0);
    const double scale = open_ledger(&s);
    const scree_bonds *bonds = scree_bonds_of(&s.state);
    for (int k = 1; k <= 200; k++) {
        periodic_step(&s);
        s.state.evaluations++;
        assert_int_equal(bonds->count, k >= at);
        assert_balanced(&s);
        const scree_energy now = energy_of(&s);
        assert_true(fabs(now.residual) < 1e-9 * scale); // round-off of positions
    }
    const scree_break *event = &bonds->event[0];
    assert_int_equal(event->step, at);
    assert_int_equal(event->mode, SCREE_BREAK_TENSION);
    assert_true(fabs(event->normal_force / (-STIFFNESS * elongation[1]) - 1) < 1e-9);
    assert_true(event->first == 0 && event->second == 1);
    double n[3], t[3];
    axes(dimension, n, t);
    for (int k = 0; k < dimension; k++) assert_true(fabs(event->normal[k] - n[k]) < 1e-9);
    // What the spring held, but for what its force did to the velocities of the ledger.
    const double lost = 0.5 * STIFFNESS * elongation[1] * elongation[0];
    assert_true(fabs(bonds->fracture / lost - 1) < 1e-9);
    assert_int_equal(scree_persistent(&s.state)->count, 0);
    assert_true(s.state.sum[0].fx == 0 && s.state.sum[0].contacts == 0);
    periodic_destroy(&s);
}

static void a_pair_breaks_at_its_strength(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        break_in_tension(dimension, -1e-5, 0);
        break_in_tension(dimension, 0.5e-3, 0);
        break_in_tension(dimension, 0.5e-3, 20e-3 - 1e-4); // across a corner of a periodic cell
        break_in_tension(dimension, -1e-5, 20e-3 - 1e-4);
    }
}

/// Forces of the only contact; all zero when there is none.
static scree_contact only_contact(periodic_sample *s)
{
    scree_contact_table table = table_of(s);
    assert_true(table.count <= 1);
    scree_contact contact = table.count == 1 ? table.contact[0] : (scree_contact){0};
    scree_contact_table_destroy(&table);
    return contact;
}

/// Spins load the tangential spring while the two approach or part: the bond breaks in the first step in which the
/// tangential force has reached cohesion + slope f_n, and in no other. Under compression the normal force goes on and
/// the contact slides. Returns the normal force at that step.
static double break_in_shear(int dimension, double approach, double slope, double cohesion, double centre)
{
    periodic_sample s;
    create(&s, dimension, 2, 20e-3, centre > 0 ? (dimension == 3 ? 7 : 3) : 0);
    damp(&s, 0.01);
    place_pair(&s, centre, 1.99e-3, -approach, 0.02, 900);
    hold(&s, 0, 1, 1e-5, 1e6, cohesion, slope);
    const double scale = open_ledger(&s);
    const scree_bonds *bonds = scree_bonds_of(&s.state);
    int k = 0;
    while (bonds->count == 0 && k++ < 2000) {
        const scree_contact before = only_contact(&s);
        const double limit = fmax(cohesion + slope * before.normal_force, 0);
        assert_true(before.bonded && before.held && !before.sliding);
        assert_true(k == 1 || fabs(before.tangential_force) < limit);
        periodic_step(&s);
    }
    assert_int_equal(bonds->count, 1);
    const scree_break *event = &bonds->event[0];
    const scree_contact left = only_contact(&s);
    assert_int_equal(event->mode, SCREE_BREAK_SHEAR);
    assert_true(event->tangential_force >= fmax(cohesion + slope * event->normal_force, 0));
    assert_true(event->tangential_force < 1.1 * fmax(cohesion + slope * event->normal_force, 0) + 0.2);
    assert_balanced(&s);
    if (event->normal_force > 0) {
        assert_true(left.held && !left.bonded && left.sliding);
        assert_true(fabs(left.normal_force / event->normal_force - 1) < 1e-9);
        assert_true(fabs(fabs(left.tangential_force) / (0.5 * event->normal_force) - 1) < 1e-9);
    } else {
        assert_true(left.normal_force == 0 && left.tangential_force == 0 && !left.held);
    }
    double worst = 0;
    for (int more = 0; only_contact(&s).normal_force > 0 && more < 200; more++) {
        const scree_energy now = energy_of(&s);
        worst = fmax(worst, fabs(now.residual));
        periodic_step(&s);
    }
    print_message("%dD, approach %g: broke at step %d, f_n %.4g N, f_t %.4g N, fracture %.3g, residual %.2g\n",
                  dimension, approach, k, event->normal_force, event->tangential_force, event->energy / scale,
                  worst / scale);
    // Until they part, which is of second order in the step as that of any contact.
    assert_true(worst < 1e-6 * scale && event->energy > 0);
    const double force = event->normal_force;
    periodic_destroy(&s);
    return force;
}

static void shear_breaks_by_mohr_and_coulomb(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int across = 0; across < 2; across++) {
            const double centre = across ? 20e-3 - 1e-4 : 0, cohesion = dimension == 2 ? 0.7 : 0.3;
            assert_true(break_in_shear(dimension, 0.3, 0.4, cohesion, centre) > 0.1);
            assert_true(break_in_shear(dimension, 0.3, 0, cohesion, centre) > 0.1);
            assert_true(break_in_shear(dimension, -0.1, 0.4, cohesion, centre) < -0.02);
        }
}

/// Broken under compression at a rest overlap (or gap): the force does not jump, the two part at the rest, stay
/// members until they no longer overlap, and touch anew like any other two.
static void a_broken_bond_keeps_its_rest(int dimension, double rest)
{
    periodic_sample s;
    create(&s, dimension, 2, 20e-3, 0);
    place_pair(&s, 0, 2e-3 - rest, -0.2, 0, 600);
    hold(&s, 0, 1, rest, 1e6, 0.4, 0);
    const double scale = open_ledger(&s);
    const scree_bonds *bonds = scree_bonds_of(&s.state);
    double force = 0, largest_jump = 0, worst = 0;
    bool parted = false, left = false;
    for (int k = 0; k < 4000 && !left; k++) {
        periodic_step(&s);
        const scree_contact now = only_contact(&s);
        largest_jump = fmax(largest_jump, fabs(now.normal_force - force));
        force = now.normal_force;
        const double overlap = 2e-3 - distance(&s);
        left = scree_persistent(&s.state)->count == 0;
        if (bonds->count > 0) {
            assert_true(now.normal_force >= 0);
            assert_true(fabs(now.tangential_force) <= 0.5 * now.normal_force * (1 + 1e-9) + 1e-9);
            parted = parted || overlap < rest;
            if (overlap < rest) assert_true(!now.held && now.normal_force == 0);
            assert_true(left == (overlap <= fmin(0, rest)));
        }
        const scree_energy energy = energy_of(&s);
        worst = fmax(worst, fabs(energy.residual));
    }
    assert_true(bonds->count == 1 && parted && left);
    // Back again: they touch where any two do.
    for (int b = 0; b < 2; b++) {
        s.state.row[b].vx *= -1;
        s.state.row[b].vy *= -1;
        s.state.row[b].vz *= dimension == 3 ? -1 : 1;
    }
    bool touched = false;
    for (int k = 0; k < 4000 && !(touched && force == 0); k++) {
        periodic_step(&s);
        const scree_contact now = only_contact(&s);
        largest_jump = fmax(largest_jump, fabs(now.normal_force - force));
        force = now.normal_force;
        touched = touched || force > 0;
        assert_true(!now.held);
        const scree_energy energy = energy_of(&s);
        worst = fmax(worst, fabs(energy.residual));
    }
    print_message("%dD, rest %g: jump of the force %.3g N, residual %.2g\n", dimension, rest, largest_jump,
                  worst / scale);
    assert_true(touched);
    // A step at 0.4 m/s changes k d by 0.024 N, and the dashpot begins with c_n v, 0.07 N.
    assert_true(largest_jump < 0.1);
    assert_true(worst < 1e-4 * scale); // a dashpot that begins with a jump: first order in the step
    periodic_destroy(&s);
}

static void broken_bonds_keep_their_rest(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        a_broken_bond_keeps_its_rest(dimension, 2e-5);
        a_broken_bond_keeps_its_rest(dimension, -2e-5);
    }
}

// ---- a net -------------------------------------------------------------------------------------------------------

/// A shaken net, periodic or not, whose near pairs are bonded with strengths that scatter.
static void create_net(periodic_sample *s, int dimension, unsigned directions)
{
    const int n = dimension == 2 ? 8 : 4;
    const double spacing = 1.995e-3;
    create(s, dimension, (size_t)n * (size_t)n * (dimension == 3 ? (size_t)n : 1), n * spacing, directions);
    for (size_t k = 0; k < s->state.count; k++) {
        const size_t index[3] = {k % (size_t)n, k / (size_t)n % (size_t)n, k / (size_t)(n * n)};
        double place[3] = {0}, velocity[3] = {0};
        for (int i = 0; i < dimension; i++) {
            place[i] = ((double)index[i] + 0.5 + 0.01 * periodic_random(8 * k + (uint64_t)i)) * spacing;
            velocity[i] = 4 * periodic_random(8 * k + 3 + (uint64_t)i);
        }
        periodic_place(s, k, place, velocity, 1e-3 * (1 + 0.01 * periodic_random(8 * k + 6)));
    }
    const scree_bond_order order = {.gap_tolerance = 0.1e-3,
                                    .overlap_tolerance = 0.1e-3,
                                    .between = -1,
                                    .other = -1,
                                    .strength = {.tensile = 1.5,
                                                 .shear = dimension == 2 ? 0.8 : 1.5,
                                                 .tensile_stress = NAN,
                                                 .shear_stress = NAN,
                                                 .internal_friction = 0.3,
                                                 .scatter = SCREE_SCATTER_WEIBULL,
                                                 .modulus = 4,
                                                 .seed = 5}};
    size_t made;
    scree_error error;
    check(scree_bonds_make(&s->model, &s->state, &s->work, &order, &made, &error), &error);
    assert_true(made > 90 && made == scree_bonds_standing(&s->state));
}

static uint64_t bits_of(periodic_sample *s)
{
    assert_int_equal(scree_contacts_save(&s->state, &s->work, NULL), SCREE_OK);
    uint64_t bits = scree_state_checksum(&s->model, &s->state);
    const scree_bonds *bonds = scree_bonds_of(&s->state);
    for (size_t k = 0; k < bonds->count; k++) {
        const scree_break *e = &bonds->event[k];
        const double numbers[] = {e->time, e->place[0], e->place[1], e->normal_force, e->tangential_force, e->energy};
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
            uint64_t word;
            memcpy(&word, &numbers[i], sizeof word);
            bits = (bits ^ word) * UINT64_C(0x9e3779b97f4a7c15);
        }
        bits = (bits ^ e->step ^ (uint64_t)e->first << 40 ^ (uint64_t)e->second << 20 ^ e->mode) *
               UINT64_C(0xbf58476d1ce4e5b9);
    }
    return bits;
}

/// Both modes happen, in the order of steps and ids, as often as they are counted; the balance stays closed.
static void a_net_falls_to_pieces(int dimension, unsigned directions)
{
    periodic_sample s;
    create_net(&s, dimension, directions);
    const size_t made = scree_bonds_standing(&s.state);
    s.model.step = s.state.tick = s.state.step_size = s.state.kick_size = 0.5e-7;
    // A cell that is stretched and sheared does work by the virial of the contacts.
    const double gradient[9] = {60, 40, 0, 0, 30, 0, 0, 0, dimension == 3 ? 20 : 0};
    if (directions) memcpy(scree_cell(&s.state)->gradient, gradient, sizeof gradient);
    const double scale = open_ledger(&s);
    double worst = 0;
    for (int k = 0; k < 4800; k++) {
        periodic_step(&s);
        assert_balanced(&s);
        if (k % 80) continue;
        const scree_energy now = energy_of(&s);
        worst = fmax(worst, fabs(now.residual));
    }
    const scree_bonds *bonds = scree_bonds_of(&s.state);
    size_t shear = 0, at_once = 0;
    double fracture = 0;
    for (size_t k = 0; k < bonds->count; k++) {
        const scree_break *e = &bonds->event[k], *before = e - 1;
        shear += e->mode == SCREE_BREAK_SHEAR;
        fracture += e->energy;
        if (k == 0) continue;
        assert_true(e->step >= before->step);
        if (e->step > before->step) continue;
        at_once++;
        assert_true(e->first > before->first || (e->first == before->first && e->second > before->second));
    }
    print_message("%dD, directions %u: %zu of %zu broke, %zu in shear, %zu beside another; fracture %.3g, residual "
                  "%.2g, left in the list %zu\n",
                  dimension, directions, bonds->count, made, shear, at_once, fracture / scale, worst / scale,
                  scree_persistent(&s.state)->count);
    assert_int_equal(scree_bonds_standing(&s.state), made - bonds->count);
    assert_true(shear > 10 && bonds->count - shear > 10 && at_once > 0);
    assert_true(fabs(fracture - bonds->fracture) < 1e-12 * fracture && fracture > 0.01 * scale);
    assert_true(scree_persistent(&s.state)->count < made - bonds->count / 2);
    // Dashpots of those that touch anew begin with a jump: first order in the step (linear.h).
    assert_true(worst < 1e-4 * scale);
    periodic_destroy(&s);
}

static void nets_fall_to_pieces(void **unused)
{
    (void)unused;
    a_net_falls_to_pieces(2, 0);
    a_net_falls_to_pieces(2, 3);
    a_net_falls_to_pieces(3, 0);
    a_net_falls_to_pieces(3, 7);
}

static uint64_t run_net(int dimension, unsigned directions, int threads, int set, bool reference, int disturbance)
{
    periodic_sample s;
    create_net(&s, dimension, directions);
    scree_work_destroy(&s.work);
    assert_int_equal(scree_work_create(&s.work, &s.model, threads, NULL), SCREE_OK);
    s.work.keep_threads = true;
    s.work.instruction_set = set;
    s.work.reference_kernel = reference;
    s.work.skin *= disturbance == 2 ? 1 : 0.3;
    periodic_forces(&s);
    for (int k = 0; k < 400; k++) {
        periodic_step(&s);
        if (disturbance == 1 && k % 3 == 0) scree_neighbours_invalidate(&s.work);
    }
    const uint64_t bits = bits_of(&s);
    assert_true(scree_bonds_of(&s.state)->count > 20);
    periodic_destroy(&s);
    return bits;
}

static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    assert_nothing_but_the_state_decides(run_net, 2);
}

/// Taken up again from a checkpoint at each step around the first breaks.
static void every_step_is_a_place_to_go_on_from(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        periodic_sample whole;
        create_net(&whole, dimension, dimension == 3 ? 7 : 3);
        periodic_forces(&whole);
        int first = 0;
        while (scree_bonds_of(&whole.state)->count < 3 && first < 400) periodic_step(&whole), first++;
        for (int k = 0; k < 60; k++) periodic_step(&whole);
        const uint64_t expected = bits_of(&whole);
        const size_t count = scree_bonds_of(&whole.state)->count;
        periodic_destroy(&whole);
        for (int at = first > 4 ? first - 4 : 0; at <= first + 24; at++) {
            char folder[64];
            periodic_sample s;
            scree_error error;
            assert_true(scratch_create(folder));
            create_net(&s, dimension, dimension == 3 ? 7 : 3);
            periodic_forces(&s);
            for (int k = 0; k < at; k++) periodic_step(&s);
            assert_int_equal(scree_contacts_save(&s.state, &s.work, NULL), SCREE_OK);
            check(scree_checkpoint_write(folder, &s.state, 1, &error), &error);
            scree_contact_scratch_destroy(&s.work);
            scree_work_destroy(&s.work);
            scree_state_destroy(&s.state);
            check(scree_checkpoint_read(folder, dimension, &s.state, 1, &error), &error);
            check(scree_work_create(&s.work, &s.model, 2, &error), &error);
            check(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), &error);
            for (int k = at; k < first + 60; k++) periodic_step(&s);
            assert_int_equal(scree_bonds_of(&s.state)->count, count);
            assert_true(bits_of(&s) == expected);
            periodic_destroy(&s);
            scratch_destroy(folder);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pair_breaks_at_its_strength), cmocka_unit_test(shear_breaks_by_mohr_and_coulomb),
        cmocka_unit_test(broken_bonds_keep_their_rest),  cmocka_unit_test(nets_fall_to_pieces),
        cmocka_unit_test(nothing_but_the_state_decides), cmocka_unit_test(every_step_is_a_place_to_go_on_from),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
