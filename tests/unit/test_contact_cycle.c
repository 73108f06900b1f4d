/// Closed cycles of overlap and tangential motion of a contact of law hertz_mindlin without damping and without
/// sliding: what they cost or deliver, for springs that keep their displacement and for rescaled ones (Thornton,
/// Cummins and Cleary 2013). The normal force gives back all work, so with k_1 and k_2 > k_1 the stiffness at both ends
/// and h the displacement the cycle costs X = (k_2 - k_1) h^2 / 2, or delivers it:
///                                          displacement kept    rescaled
///   stretch, indent, stretch back, part           -X                X
///   indent, stretch, part, stretch back            X                X
/// Pairs and bodies on a plate, in 2D and 3D; slip, rolling and twisting.
#include "sphere_fixture.h"
#include "state/plates.h"

enum { PHASE = 2000 }; // steps of a quarter of a cycle
static const double STEP = 1e-7, R1 = 1e-3, R2 = 1.5e-3, SHALLOW = 2e-6, DEEP = 20e-6;

typedef enum mode { SLIP, ROLL, TWIST } mode;

typedef struct setting {
    int dimension;
    bool plate, rescaled;
    mode moved;
} setting;

static void create(fixture *f, const setting *s)
{
    const int count = s->plate ? 1 : 2;
    fixture_create_in(f, s->dimension, HERTZ_MINDLIN, (size_t)count, STEP);
    law_rescale(&f->model, s->rescaled);
    if (s->moved != SLIP) sphere_resist_turning(f);
    scree_pair_constants *constants = s->plate ? &f->model.walls[0] : &f->model.pairs[0][0];
    constants->value[HERTZ_DAMPING] = 0;
    constants->value[SCREE_FRICTION] = constants->value[HERTZ_ROLLING] = constants->value[HERTZ_TWISTING] =
        1; // nothing slides
    f->state.row[0].radius = R1;
    if (!s->plate) f->state.row[1].radius = R2;
    for (int k = 0; k < count; k++) f->state.row[k].mass = fixture_mass(&f->model, 0, f->state.row[k].radius);
    f->state.row[0].x = R1 + (s->plate ? 0 : R2) - SHALLOW;
    scree_plates(&f->state)[SCREE_WALL_LEFT] = (scree_wall){.normal = {1, 0, 0}, .active = s->plate};
    if (s->plate)
        fixture_find_walls(f);
    else
        fixture_find_pairs(f, 1e-4);
    f->state.largest_overlap = DEEP;
}

/// Spins that move the contact by `rate` in the chosen mode alone: slip or rolling along y [m/s], twist [rad/s].
static void spin_of(const setting *s, double d, double rate, double spin[2][3])
{
    const double arms[2] = {R1 - d / 2, s->plate ? INFINITY : R2 - d / 2};
    memset(spin, 0, 6 * sizeof spin[0][0]);
    if (s->moved == SLIP) spin[0][2] = spin[1][2] = -rate / (s->plate ? arms[0] : arms[0] + arms[1]);
    if (s->moved == ROLL) spin[0][2] = rate / arms[0], spin[1][2] = -rate / arms[1];
    if (s->moved == TWIST) spin[0][0] = rate, spin[1][0] = s->plate ? 0 : -rate;
    if (s->plate) spin[1][2] = 0;
}

/// Torque on a body about all axes.
static void torque_on(const fixture *f, size_t k, double torque[3])
{
    double force[3];
    if (f->state.dimension == 3) {
        sphere_force(f, k, force, torque);
        return;
    }
    fixture_force(f, k, force);
    torque[0] = torque[1] = 0;
    torque[2] = force[2];
}

typedef struct course {
    fixture f;
    setting s;
    double d, work; ///< m, J: done on the bodies from outside
    double force, torque[2][3];
} course;

/// One step: the first body closes by `closing` m/s, or spins do what spin_of says. The work is the trapezoid of the
/// schemes.
static void go(course *c, double closing, double rate)
{
    fixture *f = &c->f;
    const int solid = f->state.dimension == 3;
    double spin[2][3], force[3], torque[3];
    spin_of(&c->s, c->d, rate, spin);
    c->d += STEP * closing;
    f->state.row[0].x -= STEP * closing;
    f->state.row[0].vx = -closing;
    // Rolling on a plate without slip.
    f->state.row[0].vy = c->s.plate && c->s.moved == ROLL ? rate : 0;
    for (int k = 0; k < (c->s.plate ? 1 : 2); k++) {
        if (solid) f->state.turn[k] = (scree_turn_row){spin[k][0], spin[k][1], spin[k][2], 0};
        if (!solid) f->state.row[k].spin = spin[k][2];
    }
    fixture_measure_speed(f);
    fixture_forces(f);
    for (size_t k = 0; k < (c->s.plate ? 1 : 2); k++) {
        torque_on(f, k, torque);
        for (int i = 0; i < 3; i++) {
            c->work -= 0.5 * (torque[i] + c->torque[k][i]) * spin[k][i] * STEP;
            c->torque[k][i] = torque[i];
        }
    }
    fixture_force(f, 0, force);
    c->work += 0.5 * (force[0] + c->force) * closing * STEP;
    c->force = force[0];
}

static double elastic(const fixture *f)
{
    scree_contact_table table = {0};
    scree_error error;
    assert_int_equal(scree_contact_table_build(&f->model, &f->state, &f->work, &table, &error), SCREE_OK);
    assert_int_equal(table.count, 1);
    double energy = table.contact[0].elastic_normal + table.contact[0].elastic_tangential;
    scree_contact_table_destroy(&table);
    return energy;
}

/// Stiffness of the spring at overlap d, per square of the rate's integral.
static double stiffness_at(const setting *s, double d)
{
    double reduced = s->plate ? R1 : R1 * R2 / (R1 + R2), radius = sqrt(reduced * d), stiffness = 5e9 * radius;
    return s->moved == TWIST ? stiffness * reduced * d / 2 : stiffness;
}

/// A cycle; returns what it cost over X, having checked the ledger: work = what is stored + dissipated - put in.
static double cycle(const setting *s, bool displacement_first)
{
    const double rate[] = {[SLIP] = 1e-3, [ROLL] = 1e-3, [TWIST] = 0.5}, closing = (DEEP - SHALLOW) / PHASE / STEP;
    course c = {.s = *s, .d = SHALLOW};
    create(&c.f, s);
    go(&c, 0, 0);
    c.work = 0;
    c.f.state.ledger = (scree_ledger){0};
    const double begin = elastic(&c.f);
    for (int phase = 0; phase < 4; phase++) {
        const bool stretches = (phase % 2 == 0) == displacement_first;
        const double sign = phase < 2 ? 1 : -1;
        for (int n = 0; n < PHASE; n++) go(&c, stretches ? 0 : sign * closing, stretches ? sign * rate[s->moved] : 0);
    }
    // Springs of relative motion: rolling moves by R_eff (1/a1 + 1/a2) of the rate, twisting by both spins.
    const scree_ledger *l = &c.f.state.ledger;
    double way = rate[s->moved] * PHASE * STEP, depth = displacement_first ? SHALLOW : DEEP;
    if (s->moved == ROLL && !s->plate) way *= R1 * R2 / (R1 + R2) * (1 / (R1 - depth / 2) + 1 / (R2 - depth / 2));
    if (s->moved == ROLL && s->plate) way *= R1 / (R1 - depth / 2);
    if (s->moved == TWIST && !s->plate) way *= 2;
    const double unit = 0.5 * (stiffness_at(s, DEEP) - stiffness_at(s, SHALLOW)) * way * way;
    const double stored = elastic(&c.f) - begin, balance = stored + l->damping + l->friction - l->stiffness;
    // Trapezoids along the force law: second order, over the work of the normal force, which is much larger.
    if (!(fabs(c.work - balance) < 1e-6 * begin + 1e-3 * unit))
        fail_msg("%dD, mode %d: the work is %g J, the ledger says %g J, of %g J", s->dimension, s->moved, c.work,
                 balance, unit);
    assert_true(l->damping == 0 && fabs(l->friction) < 1e-9 * unit && c.f.work.flags == 0);
    fixture_destroy(&c.f);
    return c.work / unit;
}

static void a_cycle_costs_or_delivers(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int plate = 0; plate < 2; plate++)
            for (int moved = SLIP; moved <= (dimension == 3 ? TWIST : ROLL); moved++)
                for (int rescaled = 0; rescaled < 2; rescaled++)
                    for (int first = 0; first < 2; first++) {
                        const setting s = {dimension, plate != 0, rescaled != 0, (mode)moved};
                        double cost = cycle(&s, first != 0), expected = first && !rescaled ? -1 : 1;
                        // Lever arms, and with them the way of the rolling or slipping back, differ by 1 % at the two
                        // ends; thousandths from the trapezoids.
                        if (!(fabs(cost - expected) < 0.05))
                            fail_msg("%dD%s, mode %d, %s, %s first: %g X, expected %g", dimension,
                                     plate ? " plate" : "", moved, rescaled ? "rescaled" : "kept",
                                     first ? "stretched" : "indented", cost, expected);
                    }
}

/// What rescaling costs where the overlap swings at a constant displacement: (k_min / k_max) a swing.
static void rescaled_springs_relax_in_swings(void **unused)
{
    (void)unused;
    for (int rescaled = 0; rescaled < 2; rescaled++) {
        const setting s = {2, false, rescaled != 0, SLIP};
        course c = {.s = s, .d = SHALLOW};
        create(&c.f, &s);
        for (int n = 0; n < PHASE; n++) go(&c, 0, 1e-3);
        const double *h = c.f.work.pairs.history[0].value, before = h[0];
        for (int n = 0; n < 4 * PHASE; n++) go(&c, (n / PHASE % 2 ? -1 : 1) * (DEEP - SHALLOW) / PHASE / STEP, 0);
        const double ratio = sqrt(SHALLOW / DEEP), expected = before * (rescaled ? ratio * ratio : 1);
        // Overlaps are differences of lengths 1000 times as large.
        assert_true(fabs(h[0] - expected) < 1e-9 * before);
        fixture_destroy(&c.f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cycle_costs_or_delivers),
        cmocka_unit_test(rescaled_springs_relax_in_swings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
