/// Contacts that stick, hertz_jkr and hertz_dmt: pairs that are moved, in 2D and 3D, and a body on a plate. Forces
/// against the closed forms of theory/adhesion.c (bisection, where the law has Newton steps), the neck that outlasts
/// the touch, work of separation, loss of a cycle, friction, exchange of the bodies, and Hertz without adhesion.
#include "sphere_fixture.h"

#include "theory/adhesion.h"

#define assert_near(value, expected, tolerance)                                                                        \
    do {                                                                                                               \
        const double value_ = (value), expected_ = (expected);                                                         \
        if (!(fabs(value_ - expected_) <= (tolerance)))                                                                \
            fail_msg("%s is %.17g, not %.17g within %g", #value, value_, expected_, (double)(tolerance));              \
    } while (0)

static const double R1 = 1e-3, R2 = 1.5e-3, ROOT = 2.7e-4, STIFFNESS = 4e6, STEP = 1e-7;

typedef struct setting {
    int dimension;
    bool plate, exchanged;
    law_choice law;
} setting;

static const setting settings[] = {
    {2, false, false, HERTZ_JKR}, {3, false, false, HERTZ_JKR}, {2, true, false, HERTZ_JKR},
    {3, true, false, HERTZ_JKR},  {2, false, false, HERTZ_DMT}, {3, false, false, HERTZ_DMT},
    {2, true, false, HERTZ_DMT},  {3, true, false, HERTZ_DMT},
};
enum { SETTINGS = sizeof settings / sizeof *settings };

static double radius_of(const setting *s)
{
    return s->plate ? R1 : R1 * R2 / (R1 + R2);
}

static scree_adhesion theory_of(const setting *s)
{
    return (scree_adhesion){.jkr = s->law == HERTZ_JKR, .stiffness = STIFFNESS, .root = ROOT, .radius = radius_of(s)};
}

/// W = 2 pi w a_0^2, the unit of energies.
static double unit_energy(const scree_adhesion *of)
{
    return 2 * M_PI * scree_adhesion_work(of->stiffness, of->root) * pow(of->root * of->radius, 4.0 / 3);
}

static void place(fixture *f, const setting *s, double overlap)
{
    f->state.row[s->exchanged ? 1 : 0].x = R1 + (s->plate ? 0 : R2) - overlap;
}

/// Apart by a tenth of a radius; no dashpots.
static void create(fixture *f, const setting *s)
{
    const int count = s->plate ? 1 : 2, first = s->exchanged ? 1 : 0;
    fixture_create_in(f, s->dimension, s->law, (size_t)count, STEP);
    f->model.pairs[0][0] = f->model.walls[0] = hertz_pair(STIFFNESS, 1.25 * STIFFNESS, 0.5, 0);
    law_stick(&f->model, ROOT, R2);
    f->state.row[first].radius = R1;
    if (!s->plate) f->state.row[1 - first].radius = R2;
    for (int k = 0; k < count; k++) f->state.row[k].mass = fixture_mass(&f->model, 0, f->state.row[k].radius);
    scree_plates(&f->state)[SCREE_WALL_LEFT] = (scree_wall){.normal = {1, 0, 0}, .active = s->plate};
    place(f, s, -1e-4);
    if (s->plate)
        fixture_find_walls(f);
    else
        fixture_find_pairs(f, 1e-3);
    f->work.pairs.reach = f->work.wall_pairs.reach = f->model.laws[0].number[SCREE_LAW_REACH];
}

/// Moves to an overlap in one step, at the rate that this needs; the force on the body of R1, away from the other.
static double go(fixture *f, const setting *s, double from, double to)
{
    const int first = s->exchanged ? 1 : 0;
    double force[3];
    f->state.row[first].vx = -(to - from) / STEP;
    place(f, s, to);
    fixture_measure_speed(f);
    f->state.largest_overlap = fmax(from, to) > 0 ? fmax(from, to) : 1e-5;
    fixture_forces(f);
    fixture_force(f, (size_t)first, force);
    return force[0];
}

static size_t contact_count(const fixture *f)
{
    scree_contact_table table = {0};
    scree_error error;
    check(scree_contact_table_build(&f->model, &f->state, &f->work, &table, &error), &error);
    const size_t count = table.count;
    scree_contact_table_destroy(&table);
    return count;
}

static void forces_follow_the_closed_form(void **unused)
{
    (void)unused;
    for (int k = 0; k < SETTINGS; k++) {
        const setting *s = &settings[k];
        const scree_adhesion of = theory_of(s);
        const double pull = scree_adhesion_pull_off(&of), neck = scree_adhesion_neck(&of), deep = 2e-5;
        fixture f;
        create(&f, s);
        // On the way in there is nothing before the touch, and the whole pull of a radius behind it.
        assert_true(go(&f, s, -1e-4, -0.5 * neck - 1e-9) == 0 && contact_count(&f) == 0);
        double d = -0.5 * neck - 1e-9, lowest = 0, last = 0;
        assert_near(go(&f, s, d, 1e-12), (of.jkr ? -8.0 / 9 : -1) * pull, 1e-4 * pull);
        d = 1e-12;
        for (int n = 1; n <= 1000; n++) {
            const double next = deep * n / 1000, force = go(&f, s, d, next);
            d = next;
            const double wanted = scree_adhesion_force(&of, scree_adhesion_area_of_overlap(&of, d));
            assert_near(force, wanted, 1e-11 * (fabs(wanted) + pull));
        }
        // On the way out it holds to the end of the neck.
        const double end = -neck * (1 - 1e-12);
        for (int n = 1; n <= 4000; n++) {
            const double next = deep + (end - deep) * n / 4000, force = go(&f, s, d, next);
            d = next;
            if (!of.jkr && d <= 0) break;
            // Where the neck breaks the radius is a root of the overlap, so round-off is, too.
            assert_near(force, scree_adhesion_force(&of, scree_adhesion_area_of_overlap(&of, d)), 2e-6 * pull);
            assert_true(contact_count(&f) == 1);
            lowest = fmin(lowest, force), last = force;
        }
        // Between two of the places the force is lower by the square of their distance.
        assert_near(lowest, -pull, 5e-4 * pull);
        assert_true(lowest >= -pull * (1 + 1e-9));
        assert_near(last, (of.jkr ? -5.0 / 9 : -1) * pull, 2e-2 * pull);
        assert_true(go(&f, s, d, -neck * (1 + 1e-9)) == 0 && contact_count(&f) == 0);
        // It does not come back without a touch.
        assert_true(go(&f, s, d, -0.5 * neck - 1e-9) == 0 && contact_count(&f) == 0);
        fixture_destroy(&f);
    }
}

/// The pull-off force is the closed form, which knows no modulus: 3/2 pi w R_eff, and 2 pi w R_eff.
static void pull_off_is_that_of_the_work_of_adhesion(void **unused)
{
    (void)unused;
    for (int k = 0; k < SETTINGS; k++) {
        const scree_adhesion of = theory_of(&settings[k]);
        const double work = scree_adhesion_work(STIFFNESS, ROOT), factor = of.jkr ? 1.5 : 2;
        assert_near(scree_adhesion_pull_off(&of) / (factor * M_PI * work * of.radius), 1, 1e-14);
        assert_near(scree_adhesion_root(STIFFNESS, work) / ROOT, 1, 1e-14);
    }
}

/// Slowly to `deep` and back until nothing is left, in n steps each way: work done from outside.
static double cycle(fixture *f, const setting *s, double from, double to, int n, double *force)
{
    double work = 0, d = from;
    for (int k = 1; k <= n; k++) {
        const double next = from + (to - from) * k / n, now = go(f, s, d, next);
        work += 0.5 * (*force + now) * (next - d);
        *force = now, d = next;
    }
    return work;
}

static void a_cycle_loses_what_the_neck_takes(void **unused)
{
    (void)unused;
    for (int k = 0; k < SETTINGS; k++) {
        const setting *s = &settings[k];
        const scree_adhesion of = theory_of(s);
        const double unit = unit_energy(&of), deep = 1e-5, out = -1.5 * scree_adhesion_neck(&of) - 1e-7;
        fixture f;
        create(&f, s);
        double force = go(&f, s, -1e-4, out);
        double work = cycle(&f, s, out, deep, 20000, &force);
        work += cycle(&f, s, deep, out, 20000, &force);
        const double loss = scree_adhesion_loss(&of), ebar = 0.75 * STIFFNESS;
        const double w = scree_adhesion_work(STIFFNESS, ROOT);
        // Steps of a 20,000th of the way: F_c times half a step at the jumps.
        assert_near(work / unit, loss / unit, 2e-4);
        assert_near(f.state.ledger.damping / unit, work / unit, 2e-6);
        // Thornton and Ning 1998: 7.09 (w^5 R^4 / Ebar^2)^(1/3).
        if (of.jkr) assert_near(loss / cbrt(pow(w, 5) * pow(of.radius, 4) / (ebar * ebar)), 7.09, 0.005);
        if (of.jkr) assert_near(loss / unit, 0.3 + 0.05 * cbrt(0.25), 1e-13);
        fixture_destroy(&f);
    }
}

/// From no force to the break: 0.45 * 1.5^(1/3) + 0.05 * 4^(-1/3) of W (DMT: 0.6 F_c d_0).
static void work_of_separation_is_the_closed_form(void **unused)
{
    (void)unused;
    for (int k = 0; k < SETTINGS; k++) {
        const setting *s = &settings[k];
        const scree_adhesion of = theory_of(s);
        const double rest = scree_adhesion_overlap(&of, scree_adhesion_area_of_force(&of, 0));
        const double wanted = of.jkr ? unit_energy(&of) * (0.45 * cbrt(1.5) + 0.05 * cbrt(0.25))
                                     : 0.6 * scree_adhesion_pull_off(&of) * rest;
        fixture f;
        create(&f, s);
        double force = go(&f, s, -1e-4, 0.5 * rest);
        (void)cycle(&f, s, 0.5 * rest, rest, 10, &force);
        assert_near(force / scree_adhesion_pull_off(&of), 0, 1e-9);
        const double work = cycle(&f, s, rest, -1.001 * scree_adhesion_neck(&of) - 1e-12, 20000, &force);
        assert_near(work / wanted, 1, 1e-4);
        fixture_destroy(&f);
    }
}

/// Friction holds mu (f + 2 F_c), DMT mu (f + F_c): also a contact that nothing presses. The bodies turn alike.
static void friction_counts_the_adhesion(void **unused)
{
    (void)unused;
    for (int k = 0; k < SETTINGS; k++) {
        const setting *s = &settings[k];
        const scree_adhesion of = theory_of(s);
        const double pull = scree_adhesion_pull_off(&of),
                     rest = scree_adhesion_overlap(&of, scree_adhesion_area_of_force(&of, 0));
        fixture f;
        double force[3];
        create(&f, s);
        (void)go(&f, s, -1e-4, rest);
        f.state.row[0].vx = 0;
        f.state.row[0].vy = 10;
        fixture_measure_speed(&f);
        for (int n = 0; n < 1000; n++) fixture_forces(&f);
        fixture_force(&f, 0, force);
        assert_near(force[1], -0.5 * (of.jkr ? 2 : 1) * pull, 1e-9 * pull);
        scree_contact_table table = {0};
        scree_error error;
        check(scree_contact_table_build(&f.model, &f.state, &f.work, &table, &error), &error);
        assert_true(table.count == 1 && table.contact[0].sliding);
        assert_near(table.contact[0].normal_force / pull, 0, 1e-9);
        scree_contact_table_destroy(&table);
        fixture_destroy(&f);
    }
}

static void exchange_changes_nothing(void **unused)
{
    (void)unused;
    for (int k = 0; k < SETTINGS; k++) {
        if (settings[k].plate) continue;
        setting other = settings[k];
        other.exchanged = true;
        fixture a, b;
        create(&a, &settings[k]);
        create(&b, &other);
        static const double way[] = {-1e-4, 3e-6, 1e-5, 2e-6, -1e-6, -1.5e-6, -3e-5, -1e-6, 1e-6};
        for (size_t n = 1; n < sizeof way / sizeof *way; n++)
            assert_true(go(&a, &settings[k], way[n - 1], way[n]) == go(&b, &other, way[n - 1], way[n]));
        assert_true(a.state.ledger.damping == b.state.ledger.damping);
        fixture_destroy(&b);
        fixture_destroy(&a);
    }
}

/// Without adhesion all three are one law, but for the way to the radius.
static void without_adhesion_it_is_hertz(void **unused)
{
    (void)unused;
    static const double way[] = {-1e-4, 3e-6, 1e-5, 1.2e-5, 2e-6, -1e-6};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 2; k++) {
            const setting s = {dimension, false, false, k ? HERTZ_JKR : HERTZ_DMT},
                          hertz = {dimension, false, false, HERTZ_MINDLIN};
            fixture a, b;
            create(&a, &s);
            create(&b, &hertz);
            law_stick(&a.model, 0, R2);
            law_rescale(&b.model, true);
            a.model.pairs[0][0].value[HERTZ_DAMPING] = b.model.pairs[0][0].value[HERTZ_DAMPING] = 0.3;
            a.state.row[0].vy = b.state.row[0].vy = 3;
            for (size_t n = 1; n < sizeof way / sizeof *way; n++) {
                double f[3], g[3];
                const double wanted = go(&b, &hertz, way[n - 1], way[n]);
                assert_near(go(&a, &s, way[n - 1], way[n]), wanted, 1e-12 * fabs(wanted));
                fixture_force(&a, 0, f);
                fixture_force(&b, 0, g);
                assert_near(f[1], g[1], 1e-12 * fabs(g[1]));
            }
            // In the steps of touch and parting, of which there are six, they take the error of the trapezoid along.
            assert_near(a.state.ledger.damping / b.state.ledger.damping, 1, 1e-3);
            assert_near(a.state.ledger.friction / b.state.ledger.friction, 1, 1e-10);
            fixture_destroy(&b);
            fixture_destroy(&a);
        }
}

/// The root of a quartic, for bodies of all sizes, stickiness and depths.
static void radii_are_found_to_round_off(void **unused)
{
    (void)unused;
    for (int n = 0; n < 20000; n++) {
        const uint64_t c = 10 * (uint64_t)n;
        const double radius = pow(10, -9 + 10 * fixture_random(c)),
                     root = sqrt(radius) * pow(10, -6 + 6 * fixture_random(c + 1));
        const scree_adhesion of = {true, 1, root, radius};
        const double neck = scree_adhesion_neck(&of), sign = fixture_random(c + 2) < 0.5 ? -1 : 1;
        const double d = sign < 0 ? -neck * (1 - pow(10, -6 * fixture_random(c + 3)))
                                  : neck * pow(10, -6 + 12 * fixture_random(c + 3));
        lanes_bits holds;
        const double a = jkr_radius(radius, d, root, ~UINT64_C(0), &holds);
        assert_true(holds != 0);
        assert_near(a / scree_adhesion_area_of_overlap(&of, d), 1, 1e-9);
        (void)jkr_radius(radius, -neck * (1 + 1e-9), root, ~UINT64_C(0), &holds);
        assert_true(holds == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_follow_the_closed_form),     cmocka_unit_test(pull_off_is_that_of_the_work_of_adhesion),
        cmocka_unit_test(a_cycle_loses_what_the_neck_takes), cmocka_unit_test(work_of_separation_is_the_closed_form),
        cmocka_unit_test(friction_counts_the_adhesion),      cmocka_unit_test(exchange_changes_nothing),
        cmocka_unit_test(without_adhesion_it_is_hertz),      cmocka_unit_test(radii_are_found_to_round_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
