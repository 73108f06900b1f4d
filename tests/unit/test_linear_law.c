/// Law linear: closed forms of force and impact, cycles, energy, critical step; kernels, threads, restart.
#include "sphere_fixture.h"

#include "io_scratch.h"
#include "restart_cases.h"
#include "run_fixture.h"

static const double R1 = 1e-3, R2 = 1.5e-3;

/// Two bodies of unequal radii that overlap by d, the second from the first along -n.
static void create_pair(fixture *f, int dimension, const double n[3], double d, double step,
                        const scree_pair_constants *pair)
{
    fixture_create_in(f, dimension, LINEAR, 2, step);
    f->model.pairs[0][0] = *pair;
    for (int k = 0; k < 2; k++) {
        sphere s = {.radius = k ? R2 : R1};
        for (int i = 0; i < dimension; i++) s.place[i] = k ? 0 : (R1 + R2 - d) * n[i];
        if (dimension == 3) sphere_set(f, (size_t)k, &s);
        f->state.row[k].radius = s.radius;
        f->state.row[k].x = s.place[0], f->state.row[k].y = s.place[1];
        f->state.row[k].mass = fixture_mass(&f->model, 0, s.radius);
    }
    f->state.largest_overlap = 1e-4;
    fixture_find_pairs(f, 1e-4);
}

static double reduced_mass(const fixture *f)
{
    double a = f->state.row[0].mass, b = f->state.row[1].mass;
    return a * b / (a + b);
}

static void direction(uint64_t number, int dimension, double n[3])
{
    for (uint64_t i = 0; i < 3; i++) n[i] = (int)i < dimension ? 2 * fixture_random(1000 * number + i) - 1 : 0;
    double length = scree_length(n);
    for (int i = 0; i < 3; i++) n[i] /= length;
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/// Force on the first body and the torque on both.
static void forces_of(const fixture *f, double force[3], double torque[2][3])
{
    double unused[3];
    for (size_t k = 0; k < 2; k++) {
        double whole[3] = {0};
        if (f->state.dimension == 3)
            sphere_force(f, k, k ? unused : force, torque[k]);
        else {
            fixture_force(f, k, whole);
            torque[k][0] = torque[k][1] = 0, torque[k][2] = whole[2];
            if (k == 0) force[0] = whole[0], force[1] = whole[1], force[2] = 0;
        }
    }
}

static void assert_near(const double a[3], const double b[3], double scale)
{
    for (int i = 0; i < 3; i++)
        if (!(fabs(a[i] - b[i]) < 1e-9 * scale)) fail_msg("component %d is %.15g, not %.15g", i, a[i], b[i]);
}

/// Nothing advances (a step of 0): springs have the stretch that they were left with, rates are those of now.
static void force_is_that_of_springs_and_dashpots(void **unused)
{
    (void)unused;
    for (int number = 0; number < 40; number++) {
        const int dimension = 2 + number % 2;
        const scree_pair_constants pair = linear_pair(3e5, 2e8, 0.7, number < 30 ? 10 : 0.1, 0.2, 0.4);
        double n[3], u[3], w[3], across[3], sheared[3], normal = 0;
        direction((uint64_t)number, dimension, n);
        direction((uint64_t)number + 100, dimension, u);
        for (int i = 0; i < 3; i++)
            w[i] = dimension == 2 && i < 2 ? 0 : 700 * (fixture_random((uint64_t)number * 3 + (uint64_t)i) - 0.5);
        const double d = 1e-5, reduced = R1 * R2 / (R1 + R2), k = 3e5 + 2e8 * reduced;
        fixture f;
        create_pair(&f, dimension, n, d, 0, &pair);
        f.state.row[0].vx = u[0], f.state.row[0].vy = u[1], f.state.row[0].spin = dimension == 2 ? w[2] : u[2];
        if (dimension == 3) f.state.row[0].vz = u[2], f.state.turn[0] = (scree_turn_row){w[0], w[1], w[2], 0};
        // A sheared across n, in 2D along t = (-n_y, n_x).
        const double turned[3] = {-n[1] * 2e-6, n[0] * 2e-6, 0};
        direction((uint64_t)number + 200, 3, across);
        cross(n, across, sheared);
        for (int i = 0; i < 3; i++) sheared[i] = dimension == 2 ? turned[i] : 2e-6 * sheared[i];
        for (int i = 0; i < 3; i++) f.work.pairs.history[0].value[i] = dimension == 2 ? (i ? 0 : 2e-6) : sheared[i];
        fixture_measure_speed(&f);
        fixture_forces(&f);

        const double root = 2 * sqrt(reduced_mass(&f) * k), root_t = 2 * sqrt(reduced_mass(&f) * 0.7 * k);
        double slip[3], expected[3], force[3], torque[2][3], turning[3], resistance[3], size = 0;
        for (int i = 0; i < 3; i++) normal += u[i] * n[i];
        cross(w, n, turning);
        for (int i = 0; i < 3; i++) slip[i] = u[i] - normal * n[i] - (R1 - d / 2) * turning[i];
        const double pressed = fmax(k * d - 0.2 * root * normal, 0), cap = pair.value[SCREE_FRICTION] * pressed;
        for (int i = 0; i < 3; i++) {
            double spring = 0.7 * k * sheared[i], most = 0.7 * k * scree_length(sheared);
            if (most > cap) spring *= cap / most;
            resistance[i] = spring + 0.4 * root_t * slip[i];
        }
        size = scree_length(resistance);
        for (int i = 0; i < 3; i++) {
            if (size > cap) resistance[i] *= cap / size;
            expected[i] = pressed * n[i] - resistance[i];
        }
        forces_of(&f, force, torque);
        assert_near(force, expected, k * d);
        cross(n, resistance, turning);
        const double arms[2] = {R1 - d / 2, R2 - d / 2};
        for (int b = 0; b < 2; b++) {
            double moment[3];
            for (int i = 0; i < 3; i++) moment[i] = arms[b] * turning[i];
            assert_near(torque[b], moment, k * d * R2);
        }
        // The bodies exchanged: the same bits.
        const scree_sum_row sum[2] = {f.state.sum[0], f.state.sum[1]};
        f.work.pairs.first[0] = 1, f.work.pairs.second[0] = 0;
        f.state.largest_overlap = 1e-4; // the quanta that the first evaluation had
        for (int i = 0; i < 3 && dimension == 3; i++) sheared[i] = -sheared[i];
        for (int i = 0; i < 3; i++) f.work.pairs.history[0].value[i] = dimension == 2 ? (i ? 0 : 2e-6) : sheared[i];
        fixture_forces(&f);
        assert_memory_equal(sum, f.state.sum, sizeof sum);
        assert_int_equal(f.work.flags, 0);
        fixture_destroy(&f);
    }
}

// ---- impacts -------------------------------------------------------------------------------------------------------

typedef struct impact {
    double restitution, duration; ///< over those of theory
} impact;

/// Head on, from `apart` steps before the touch.
static impact collide(int dimension, double damping, double parts, double apart)
{
    const double x[3] = {1, 0, 0}, speed = 0.5, k = 3e5;
    const scree_pair_constants pair = linear_pair(k, 0, 0.5, 0.5, damping, 0);
    scree_impact theory;
    scree_error error;
    fixture f;
    create_pair(&f, dimension, x, -1e-9, 1, &pair);
    const double mass = reduced_mass(&f), step = sqrt(mass / k) / parts;
    f.state.tick = f.state.step_size = f.state.kick_size = step;
    check(scree_law_get(SCREE_SLOT_linear)->impact(&f.model.laws[0], &pair, 1e-3, mass, speed, &theory, &error),
          &error);
    f.state.row[0].x = R1 + R2 + apart * speed * step;
    f.state.row[0].vx = -speed;
    f.state.largest_overlap = 0;
    fixture_measure_speed(&f);
    fixture_forces(&f);
    long pushed = 0;
    for (int n = 0; n < 100 * parts && !(pushed > 0 && f.state.sum[0].fx == 0); n++) {
        sphere_step(&f);
        assert_true(f.state.sum[0].fx >= 0);
        pushed += f.state.sum[0].fx > 0;
    }
    impact result = {.restitution = (f.state.row[0].vx - f.state.row[1].vx) / speed / theory.restitution,
                     .duration = ((double)pushed * step) / theory.duration};
    assert_int_equal(f.work.flags, 0);
    fixture_destroy(&f);
    return result;
}

/// Largest error of the restitution over places of touch and parting between steps.
static double worst_restitution(int dimension, double damping, double parts)
{
    double worst = 0;
    for (int k = 0; k < 8; k++) {
        impact i = collide(dimension, damping, parts + 0.37 * k, 0.5 + (k + 0.3) / 8);
        worst = fmax(worst, fabs(i.restitution - 1));
        assert_true(fabs(i.duration - 1) < (1.5 + 2 * damping) / parts);
    }
    return worst;
}

/// A quarter of the step: a sixteenth of the error without damping; a quarter of it with a dashpot, whose force jumps
/// at the touch.
static void impacts_are_those_of_theory(void **unused)
{
    (void)unused;
    const double damping[] = {0, 0.05, 0.4, 1, 2};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 5; k++) {
            double coarse = worst_restitution(dimension, damping[k], 100),
                   fine = worst_restitution(dimension, damping[k], 400);
            const double ratio = coarse / fine;
            print_message("%dD, damping ratio %g: errors %.3g, %.3g\n", dimension, damping[k], coarse, fine);
            assert_true(coarse < (damping[k] > 0 ? 0.05 : 1e-3));
            assert_true(damping[k] > 0 ? ratio > 3 : ratio > 12 && ratio < 20);
        }
    // The closed forms themselves, at damping ratios where they are known.
    scree_impact theory;
    const scree_law *law = scree_law_get(SCREE_SLOT_linear);
    scree_pair_constants pair = linear_pair(4, 0, 1, 0, 0, 0);
    (void)!law->impact(NULL, &pair, 1, 1, 1, &theory, NULL);
    assert_true(theory.restitution == 1 && fabs(theory.duration - M_PI / 2) < 1e-15);
    pair = linear_pair(4, 0, 1, 0, 1, 0);
    (void)!law->impact(NULL, &pair, 1, 1, 1, &theory, NULL);
    assert_true(fabs(theory.restitution - exp(-2)) < 1e-15 && fabs(theory.duration - 1) < 1e-15);
    pair = linear_pair(4, 0, 1, 0, 0.5, 0);
    (void)!law->impact(NULL, &pair, 1, 1, 1, &theory, NULL);
    assert_true(fabs(theory.restitution - exp(-2 * M_PI / 3 / sqrt(3))) < 1e-15);
    assert_true(fabs(theory.duration - 2 * M_PI / 3 / sqrt(3)) < 1e-15);
}

/// Fast and shallow: it slides from the touch to the end, and the impulses are in the ratio of friction.
static void an_oblique_impact_slides(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double x[3] = {1, 0, 0};
        const scree_pair_constants pair = linear_pair(3e11, 0, 0.8, 0.2, 0.1, 0.1);
        fixture f;
        create_pair(&f, dimension, x, -1e-10, 2e-10, &pair);
        f.state.row[0].vx = -0.1, f.state.row[0].vy = dimension == 2 ? 2 : 1.2;
        if (dimension == 3) f.state.row[0].vz = 1.6;
        const scree_row before = f.state.row[0];
        f.state.largest_overlap = 0;
        fixture_measure_speed(&f);
        fixture_forces(&f);
        long sliding = 0, pushed = 0;
        for (int n = 0; n < 100000 && !(pushed > 0 && f.state.sum[0].contacts == 0); n++) {
            sphere_step(&f);
            scree_contact_table table = {0};
            scree_error error;
            check(scree_contact_table_build(&f.model, &f.state, &f.work, &table, &error), &error);
            for (size_t k = 0; k < table.count && table.contact[k].normal_force > 0; k++) {
                assert_true(fabs(table.contact[k].tangential_force) <=
                            0.2 * table.contact[k].normal_force * (1 + 1e-12));
                sliding += table.contact[k].sliding, pushed++;
            }
            scree_contact_table_destroy(&table);
        }
        const scree_row *after = &f.state.row[0];
        double normal = after->vx - before.vx, y = before.vy - after->vy,
               z = dimension == 3 ? before.vz - after->vz : 0;
        assert_true(pushed > 50 && sliding == pushed);
        assert_true(fabs(hypot(y, z) / normal - 0.2) < 5e-4);
        if (dimension == 3) assert_true(fabs(z / y - 1.6 / 1.2) < 1e-3);
        fixture_destroy(&f);
    }
}

// ---- energy --------------------------------------------------------------------------------------------------------

/// Stretched while shallow, pressed together, stretched back, parted, and the other way round: all work comes back,
/// which hertz_mindlin's springs do not do (test_contact_cycle.c).
static void closed_cycles_cost_nothing(void **unused)
{
    (void)unused;
    enum { PHASE = 1000 };
    const double step = 1e-7, shallow = 2e-6, deep = 20e-6, x[3] = {1, 0, 0}, rate = 1e-2;
    for (int number = 0; number < 4; number++) {
        const int dimension = 2 + number % 2;
        const scree_pair_constants pair = linear_pair(3e5, 0, 0.8, 10, 0, 0);
        fixture f;
        create_pair(&f, dimension, x, shallow, step, &pair);
        double work = 0, d = shallow, force_before = pair.value[LINEAR_NORMAL] * d, torque_before[2] = {0};
        for (int n = 0; n < 4 * PHASE; n++) {
            const int phase = n / PHASE;
            const bool stretches = (phase + number / 2) % 2 == 0;
            const double sign = phase < 2 ? 1 : -1, closing = stretches ? 0 : sign * (deep - shallow) / PHASE / step;
            const double spin = stretches ? -sign * rate / (R1 + R2 - d) : 0;
            double force[3], torque[2][3];
            d += closing * step;
            f.state.row[0].x -= closing * step, f.state.row[0].vx = -closing;
            for (int k = 0; k < 2 && dimension == 3; k++) f.state.turn[k].wz = spin;
            for (int k = 0; k < 2 && dimension == 2; k++) f.state.row[k].spin = spin;
            fixture_measure_speed(&f);
            fixture_forces(&f);
            forces_of(&f, force, torque);
            work += 0.5 * (force[0] + force_before) * closing * step;
            force_before = force[0];
            for (int k = 0; k < 2; k++) {
                work -= 0.5 * (torque[k][2] + torque_before[k]) * spin * step;
                torque_before[k] = torque[k][2];
            }
        }
        const double stored = 0.5 * 0.8 * 3e5 * pow(rate * PHASE * step, 2);
        const scree_ledger *l = &f.state.ledger;
        if (!(fabs(work) < 1e-6 * stored)) fail_msg("a cycle of %g J costs %g J", stored, work);
        assert_true(l->damping == 0 && l->stiffness == 0 && fabs(l->friction) < 1e-9 * stored);
        assert_int_equal(f.work.flags, 0);
        fixture_destroy(&f);
    }
}

static void create_assembly(fixture *f, int dimension, int materials)
{
    if (dimension == 3)
        sphere_create_assembly(f, LINEAR, 5, materials, false);
    else
        fixture_create_assembly(f, LINEAR, 13, materials);
}

static double worst_residual(int dimension, double step, int steps)
{
    fixture f;
    create_assembly(&f, dimension, 2);
    f.state.tick = f.state.step_size = f.state.kick_size = step;
    fixture_forces(&f);
    const scree_ledger *l = &f.state.ledger;
    f.state.ledger = (scree_ledger){0};
    const double initial = fixture_kinetic(&f) + fixture_elastic(&f);
    double worst = 0;
    for (int n = 0; n < steps; n++) {
        sphere_step(&f);
        if (n % (steps / 50) == 0)
            worst = fmax(worst, fabs(fixture_kinetic(&f) + fixture_elastic(&f) + l->damping + l->friction - initial));
    }
    assert_true(l->damping > 0.05 * initial && l->friction > 0.01 * initial && l->stiffness == 0);
    assert_int_equal(f.work.flags, 0);
    fixture_destroy(&f);
    return worst / initial;
}

/// Discs and spheres that jostle, slide, part and meet: halving the step divides the residual by four.
static void ledger_closes_with_the_square_of_the_step(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        double coarse = worst_residual(dimension, 4e-8, 2000), fine = worst_residual(dimension, 1e-8, 8000);
        print_message("%dD: residual %.3g, with a quarter of the step %.3g\n", dimension, coarse, fine);
        assert_true(coarse / fine > 10 && fine < 1e-6);
    }
}

// ---- the critical step
// -----------------------------------------------------------------------------------------------

/// How much a swing of a pair grows that forces press together, at a part of the critical step of that oscillator.
static double growth(double damping, double part)
{
    const double x[3] = {1, 0, 0}, k = 3e5, d = 1e-5, swing = 1e-12;
    const scree_pair_constants pair = linear_pair(k, 0, 0, 0, damping, 0);
    fixture f;
    create_pair(&f, 2, x, d, 1, &pair);
    const double mass = reduced_mass(&f);
    const scree_contact_tangent t =
        scree_law_get(SCREE_SLOT_linear)->tangent(&f.model.laws[0], &pair, 1e-3, mass, k * d);
    const double omega = sqrt(t.normal_stiffness / mass), z = t.normal_damping / (2 * sqrt(t.normal_stiffness * mass));
    assert_true(fabs(z - damping) < 1e-12);
    const double step = part * 2 / omega * (sqrt(1 + z * z) - z);
    f.state.tick = f.state.step_size = step;
    scree_row *row = f.state.row;
    row[0].x += swing;
    double largest = 0;
    fixture_forces(&f);
    for (int n = 0; n < 400 && largest < 1e4 * swing; n++) {
        for (int b = 0; b < 2; b++) {
            double force[3];
            fixture_force(&f, (size_t)b, force);
            row[b].vx += step / row[b].mass * (force[0] - (b ? -k * d : k * d));
        }
        for (int b = 0; b < 2; b++) row[b].x += step * row[b].vx;
        fixture_measure_speed(&f);
        fixture_forces(&f);
        if (n > 200 || fabs(row[0].x - row[1].x - (R1 + R2 - d)) > 1e3 * swing)
            largest = fmax(largest, fabs(row[0].x - row[1].x - (R1 + R2 - d)));
    }
    fixture_destroy(&f);
    return largest / swing;
}

/// The first swing of an undamped pair just below the limit is wider than its begin, by 1 / sqrt(1 - 0.95^2) at most.
static void the_critical_step_is_that_of_spring_and_dashpot(void **unused)
{
    (void)unused;
    const double damping[] = {0, 0.3, 5};
    for (int k = 0; k < 3; k++) {
        double below = growth(damping[k], 0.95), above = growth(damping[k], 1.1);
        print_message("damping ratio %g: swings grow by %.3g at 0.95 of the limit, by %.3g at 1.1\n", damping[k], below,
                      above);
        assert_true(below < 4 && above > 1e3);
    }
}

// ---- machinery
// -------------------------------------------------------------------------------------------------------

static void assert_same(const fixture *a, const fixture *b)
{
    const scree_state *s = &a->state, *t = &b->state;
    assert_memory_equal(s->row, t->row, s->count * sizeof *s->row);
    assert_memory_equal(s->sum, t->sum, s->count * sizeof *s->sum);
    if (s->dimension == 3) assert_memory_equal(s->torque, t->torque, s->count * sizeof *s->torque);
    assert_memory_equal(&s->ledger, &t->ledger, sizeof s->ledger);
    for (size_t p = 0; p < a->work.pairs.count; p++)
        for (int v = 0; v < SCREE_HISTORY; v++) // 0 and -0 are the same history
            assert_true(a->work.pairs.history[p].value[v] == b->work.pairs.history[p].value[v]);
}

/// The scalar reference, each instruction set, and 2 to 4 threads.
static void kernels_and_threads_give_the_same_bits(void **unused)
{
    (void)unused;
    for (int number = 0; number < 4; number++) {
        const int dimension = 2 + number % 2, materials = 1 + number / 2;
        fixture one, other;
        create_assembly(&one, dimension, materials);
        one.work.reference_kernel = true;
        sphere_run(&one, 200);
        assert_true(one.state.largest_overlap > 0 && one.work.flags == 0);
        const int sets = scree_contact_instruction_set(0);
        for (int k = 2; k <= sets + 3; k++) {
            create_assembly(&other, dimension, materials);
            if (k <= sets) other.work.instruction_set = k;
            if (k > sets) other.work.threads = k - sets + 1;
            sphere_run(&other, 200);
            assert_same(&one, &other);
            fixture_destroy(&other);
        }
        fixture_destroy(&one);
    }
}

static void a_restart_changes_no_bit(void **unused)
{
    (void)unused;
    static const char *const overrides[] = {"contact.law=linear", "integrator.step=1e-5 s",
                                            "materials.0.young_modulus=3 GPa", "materials.0.stiffness_ratio=0.6"};
    char folder[64], whole[96], part[96];
    assert_true(scratch_create(folder));
    snprintf(whole, sizeof whole, "%s/whole", folder);
    snprintf(part, sizeof part, "%s/part", folder);
    for (int k = 0; k < 2; k++) { // discs, spheres
        scree_case *c = case_read(restart_cases[k], overrides, 4);
        run_restart(c, whole, part, 2, "stage confine ended");
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

// ---- what a case says
// --------------------------------------------------------------------------------------------------

static const char materials_text[] =
    "scree: 1\n"
    "materials:\n"
    "  - {name: a, young_modulus: 30 GPa, density: 2650 kg/m3, friction: 0.4, wall_material: rigid}\n"
    "  - {name: b, young_modulus: 10 GPa, density: 2650 kg/m3, friction: 0.3,\n"
    "     stiffness_ratio: 0.5, restitution: 0.6}\n"
    "particles: {material: a, count: 2, radius_min: 1 mm, radius_max: 2 mm}\n"
    "contact: {law: linear, reference_velocity: 1 m/s}\n"
    "stages:\n"
    "  - {stage: prepare, method: pair}\n"
    "  - {stage: collide}\n";

static scree_model model_of(const char *const *overrides, size_t count)
{
    scree_case *c = case_read(materials_text, overrides, count);
    scree_model model;
    scree_error error;
    check(scree_model_build(&c->config, &model, &error), &error);
    scree_case_free(c);
    return model;
}

static void near_to(double value, double expected)
{
    if (!(fabs(value - expected) <= 1e-12 * fabs(expected))) fail_msg("%.15g, not %.15g", value, expected);
}

static void stiffnesses_of_pairs(void **unused)
{
    (void)unused;
    // Discs, 3 mm thick: k_n = E t.
    scree_model m = model_of(NULL, 0);
    near_to(m.pairs[0][0].value[LINEAR_NORMAL], 30e9 * 3e-3);
    near_to(m.pairs[0][1].value[LINEAR_NORMAL], 15e9 * 3e-3);
    near_to(m.walls[0].value[LINEAR_NORMAL], 60e9 * 3e-3);
    near_to(m.pairs[0][1].value[LINEAR_RATIO], 2 * 30 * 5 / 35.0 / 15);
    near_to(m.pairs[0][1].value[SCREE_FRICTION], 0.3);
    // The larger damping is that of restitution 0.2.
    near_to(scree_restitution_from_damping(m.pairs[0][1].value[LINEAR_DAMPING] / 2 * sqrt(5)), 0.2);
    near_to(scree_restitution_from_damping(m.pairs[1][1].value[LINEAR_DAMPING] / 2 * sqrt(5)), 0.6);
    // Spheres: pi E R_eff.
    const char *const solid[] = {"dimension=3", "particles.shape=sphere", "materials.0.damping_ratio=0.7",
                                 "materials.0.tangential_damping_ratio=0.1"};
    m = model_of(solid, 4);
    const scree_elastic *closed = scree_law_get(SCREE_SLOT_linear)->elastic;
    near_to(closed->force(&m.pairs[0][0], 1e-3, 1e-6), M_PI * 30e9 * 1e-3 * 1e-6);
    near_to(closed->overlap(&m.pairs[0][0], 1e-3, M_PI * 30e9 * 1e-3 * 1e-6), 1e-6);
    near_to(closed->energy(&m.pairs[0][0], 1e-3, 1e-6), M_PI * 30e9 * 1e-3 * 0.5e-12);
    near_to(m.pairs[0][0].value[LINEAR_DAMPING], 1.4);
    near_to(m.pairs[0][0].value[LINEAR_TANGENTIAL_DAMPING], 0.2);
    const char *const given[] = {"materials.0.normal_stiffness=1e6 N/m", "materials.1.normal_stiffness=3e6 N/m",
                                 "materials.0.tangential_stiffness=0 N/m"};
    m = model_of(given, 3);
    near_to(m.pairs[0][0].value[LINEAR_NORMAL], 1e6);
    near_to(m.pairs[0][1].value[LINEAR_NORMAL], 1.5e6);
    near_to(m.walls[0].value[LINEAR_NORMAL], 2e6);
    assert_true(m.pairs[0][1].value[LINEAR_RATIO] == 0 && m.pairs[0][1].value[LINEAR_INVERSE_RATIO] == 0);
}

/// The dashpot is given once: by the restitution or by the ratio. A case that gives both is told where and why.
static void damping_is_given_once(void **unused)
{
    (void)unused;
    for (int k = 0; k < 2; k++) {
        scree_case *c = NULL;
        scree_problems *problems = NULL;
        const char *const overrides[] = {"materials.0.restitution=0.5", "materials.0.damping_ratio=0.7"};
        scree_status status = case_parse(materials_text, overrides, k == 0 ? 1 : 2, &c, &problems);
        assert_int_equal(status, k == 0 ? SCREE_OK : SCREE_ERROR_INPUT);
        if (k == 1) {
            assert_string_equal(scree_problems_get(problems, 0)->field, "materials.0.restitution");
            assert_non_null(strstr(scree_problems_get(problems, 0)->message, "damping_ratio"));
        }
        scree_problems_free(problems);
        scree_case_free(c);
    }
}

/// The modulus that grains of the mean radius would have with the springs that are given: k_n = E t of discs, pi E
/// R_eff of spheres; without stiffnesses their own.
static void stiffnesses_have_a_modulus(void **unused)
{
    (void)unused;
    const char *const given[] = {"materials.0.normal_stiffness=6e6 N/m", "materials.1.normal_stiffness=3e6 N/m",
                                 "dimension=3", "particles.shape=sphere"};
    const size_t counts[] = {0, 2, 4};
    for (int k = 0; k < 3; k++) {
        scree_case *c = case_read(materials_text, given, counts[k]);
        scree_model m;
        scree_error error;
        check(scree_model_build(&c->config, &m, &error), &error);
        const double wanted[] = {30e9, 6e6 / 3e-3, 6e6 / (M_PI * 0.5 * m.mean_radius)};
        near_to(scree_model_mean_modulus(&m), wanted[k]);
        const char *key = scree_model_modulus_key(&m);
        assert_true(k == 0 ? !key : strcmp(key, "normal_stiffness") == 0);
        scree_case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(force_is_that_of_springs_and_dashpots),
        cmocka_unit_test(impacts_are_those_of_theory),
        cmocka_unit_test(an_oblique_impact_slides),
        cmocka_unit_test(closed_cycles_cost_nothing),
        cmocka_unit_test(ledger_closes_with_the_square_of_the_step),
        cmocka_unit_test(the_critical_step_is_that_of_spring_and_dashpot),
        cmocka_unit_test(kernels_and_threads_give_the_same_bits),
        cmocka_unit_test(a_restart_changes_no_bit),
        cmocka_unit_test(stiffnesses_of_pairs),
        cmocka_unit_test(damping_is_given_once),
        cmocka_unit_test(stiffnesses_have_a_modulus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
