/// Limits of schemes against dense eigenvalues, closed forms of lattices, and schemes that are marched step by step.
#include "lattice_fixture.h"

#include "specimen/eigen.h"
#include "specimen/stability.h"

static const double NORMAL = 7e10, YOUNG = 1e11;

static double relative(double value, double expected)
{
    return fabs(value / expected - 1);
}

#define assert_within(value, expected, tolerance)                                                                      \
    do {                                                                                                               \
        const double value_ = (value), expected_ = (expected);                                                         \
        if (!(relative(value_, expected_) <= (tolerance))) fail_msg("%.10g, not %.10g", value_, expected_);            \
    } while (0)

static scree_specimen bonded(const discs *d, int dimension, double gap, double tangential, double poisson)
{
    const double normal = dimension == 2 ? NORMAL : NORMAL * 1e-3;
    scree_specimen s = specimen_of(d, dimension, gap, (discs_bond){.stiffness = {normal, tangential * normal}});
    specimen_set_compliance(&s, scree_compliance_of(dimension == 2 ? SCREE_PLANE_STRAIN : SCREE_SOLID, YOUNG, poisson));
    return s;
}

static double radius_of(const scree_specimen *s)
{
    double radius;
    scree_error error;
    check(scree_spectral_radius(s, &radius, NULL, &error), &error);
    return radius;
}

// ---- spectral radius ---------------------------------------------------------------------------------------------

/// The two specimens of the source, 1/rho k_n / E_p, against LAPACK on the matrix from the source's steps. 1e-7:
/// ARPACK stops at a residual of 1e-8.
static void largest_stiffness_of_the_specimens(void **unused)
{
    (void)unused;
    static const double ratios[] = {0.05, 0.15, 0.20, 0.22, 0.25, 0.30, 0.35, 0.40, 0.45};
    for (int hexagonal = 0; hexagonal < 2; hexagonal++) {
        discs d = hexagonal ? discs_hexagonal(17, 6, 1) : discs_square(20, 9);
        assert_int_equal(d.count, hexagonal ? 110 : 180);
        for (size_t k = 0; k < sizeof ratios / sizeof *ratios; k++) {
            scree_specimen s = bonded(&d, 2, 1e-6, 0, ratios[k]);
            dense b = dense_force_iteration(&s);
            const double exact = dense_radius(&b), found = radius_of(&s);
            assert_within(found, exact, 1e-7);
            print_message("%s nu_p %.2f: largest k_n/E_p %.4f\n", hexagonal ? "hexagonal 17 x 6, 7" : "square 9 x 20",
                          ratios[k], NORMAL / YOUNG / found);
            free(b.value);
            scree_specimen_destroy(&s);
        }
        discs_destroy(&d);
    }
}

static void lattices_have_their_closed_form(void **unused)
{
    (void)unused;
    for (int kind = 0; kind < SCREE_LATTICES; kind++)
        for (int k = 0; k < 5; k++) {
            const int dimension = scree_lattice_dimension((scree_lattice)kind);
            discs d = discs_lattice((scree_lattice)kind, 4);
            scree_specimen s = bonded(&d, dimension, 1e-6, 0, -0.2 + 0.15 * k);
            const scree_lattice_material m = {.radius = 1e-3,
                                              .length = 1,
                                              .normal = s.contact[0].stiffness.normal,
                                              .shear = s.compliance[0].shear,
                                              .trace = s.compliance[0].trace};
            assert_within(radius_of(&s), scree_lattice_radius((scree_lattice)kind, &m), 1e-7);
            scree_specimen_destroy(&s);
            discs_destroy(&d);
        }
    // M 3.43 and 3.78 in his words.
    scree_compliance c = scree_compliance_of(SCREE_PLANE_STRAIN, 1, 0.35);
    scree_lattice_material m = {.radius = 1e-3, .length = 1, .normal = 1, .shear = c.shear, .trace = c.trace};
    assert_within(1 / scree_lattice_radius(SCREE_LATTICE_SQUARE, &m), M_PI / 4 / 1.35, 1e-12);
    assert_within(1 / scree_lattice_radius(SCREE_LATTICE_HEXAGONAL, &m), M_PI / 3 / 1.35, 1e-12);
    c = scree_compliance_of(SCREE_PLANE_STRAIN, 1, 0.1);
    m.shear = c.shear, m.trace = c.trace;
    assert_within(1 / scree_lattice_radius(SCREE_LATTICE_HEXAGONAL, &m), M_PI / 6 / 1.1 / 0.8, 1e-12);
    // M 3.27, k_p = pi E_p l / (2 (1 - nu_p^2)).
    assert_within(1 / scree_row_radius(2, &m), M_PI / 4 / (1 - 0.01), 1e-12);
}

/// As published no tangential spring changes the eigenvalues, although B itself does change; corrected it does.
static void tangential_springs_in_the_iteration(void **unused)
{
    (void)unused;
    discs d = discs_irregular(2, 6);
    scree_specimen without = bonded(&d, 2, 0.25, 0, 0.35), with = bonded(&d, 2, 0.25, 0.8, 0.35);
    const size_t size = scree_specimen_contact_forces(&with);
    for (int corrected = 0; corrected < 2; corrected++) {
        with.tangential = corrected ? SCREE_TANGENTIAL_CORRECTED : SCREE_TANGENTIAL_AS_PUBLISHED;
        dense b = dense_of(&with, scree_specimen_force_iteration, size, size);
        assert_within(radius_of(&with), dense_radius(&b), 1e-7);
        free(b.value);
        if (corrected)
            assert_true(radius_of(&with) > 1.01 * radius_of(&without));
        else
            assert_within(radius_of(&with), radius_of(&without), 1e-7);
    }
    scree_specimen_destroy(&with);
    scree_specimen_destroy(&without);
    discs_destroy(&d);
}

// ---- critical steps ----------------------------------------------------------------------------------------------

typedef enum marched { RIGID, EXPLICIT, RELAXED, IMPLICIT, SCHEMES } marched;
static const char *const names[SCHEMES] = {"rigid", "explicit", "relaxed", "implicit"};

/// What a scheme carries from step to step: x, v(n - 1/2), the forces f(n - 1) that strain, and what the strain then
/// added to forces.
typedef struct march {
    const scree_specimen *s;
    marched scheme;
    double theta, step;
    size_t motions, forces;
    double *q, *f, *strains, *b; ///< scratch
    dense inverse;               ///< of 1 - B, implicit
} march;

static size_t march_size(const march *m)
{
    return 2 * m->motions + 2 * m->forces;
}

static march march_create(const scree_specimen *s, marched scheme, double theta, double step)
{
    march m = {.s = s,
               .scheme = scheme,
               .theta = theta,
               .step = step,
               .motions = scree_specimen_motions(s),
               .forces = scree_specimen_contact_forces(s)};
    m.q = calloc(m.forces, sizeof *m.q);
    m.f = calloc(m.forces, sizeof *m.f);
    m.strains = calloc(m.forces, sizeof *m.strains);
    m.b = calloc(m.motions, sizeof *m.b);
    m.inverse = dense_of(s, scree_specimen_force_iteration, m.forces, m.forces);
    for (size_t k = 0; k < m.forces * m.forces; k++) m.inverse.value[k] *= -1;
    for (size_t k = 0; k < m.forces; k++) m.inverse.value[k * (m.forces + 1)] += 1;
    lapack_int *pivot = calloc(m.forces, sizeof *pivot), n = (lapack_int)m.forces;
    assert_int_equal(LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, m.inverse.value, n, pivot), 0);
    assert_int_equal(LAPACKE_dgetri(LAPACK_COL_MAJOR, n, m.inverse.value, n, pivot), 0);
    free(pivot);
    return m;
}

static void march_destroy(march *m)
{
    free(m->q);
    free(m->f);
    free(m->strains);
    free(m->b);
    free(m->inverse.value);
}

/// q becomes the forces that springs (dashpots) have under it.
static void answer(const scree_specimen *s, bool dashpots, double *q)
{
    const size_t width = (size_t)s->dimension;
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_springs *k = dashpots ? &s->contact[c].damping : &s->contact[c].stiffness;
        scree_specimen_along(s->dimension, &s->contact[c], -k->normal, -k->tangential, q + c * width, q + c * width);
    }
}

/// Forces at n into m->f; those that strain the particles, into m->strains.
static void forces_now(march *m, const double *x, const double *v, const double *last, double *added)
{
    // Damping first: it is part of what the implicit scheme solves for, if it strains.
    double *dashpots = calloc(m->forces, sizeof *dashpots), *change = calloc(m->forces, sizeof *change);
    scree_specimen_relative(m->s, v, dashpots);
    answer(m->s, true, dashpots);
    scree_specimen_relative(m->s, x, m->q);
    answer(m->s, false, m->q);
    const double theta = m->scheme == RELAXED ? m->theta : 1;
    scree_specimen_force_iteration(m->s, last, change);
    for (size_t k = 0; k < m->forces; k++) {
        added[k] = m->scheme == RIGID || m->scheme == IMPLICIT ? 0 : (1 - theta) * added[k] + theta * change[k];
        m->strains[k] = m->q[k] + added[k] + (m->s->dashpots_strain ? dashpots[k] : 0);
    }
    if (m->scheme == IMPLICIT) {
        memcpy(change, m->strains, m->forces * sizeof *change);
        for (size_t i = 0; i < m->forces; i++) {
            m->strains[i] = 0;
            for (size_t j = 0; j < m->forces; j++) m->strains[i] += *dense_at(&m->inverse, i, j) * change[j];
        }
    }
    for (size_t k = 0; k < m->forces; k++) m->f[k] = m->strains[k] + (m->s->dashpots_strain ? 0 : dashpots[k]);
    free(dashpots);
    free(change);
}

static void march_on(march *m, double *state)
{
    double *x = state, *v = x + m->motions, *last = v + m->motions, *added = last + m->forces;
    forces_now(m, x, v, last, added);
    memcpy(last, m->strains, m->forces * sizeof *last);
    scree_specimen_gather(m->s, m->f, m->b);
    double *kick = calloc(m->motions, sizeof *kick);
    scree_specimen_accelerate(m->s, m->b, kick);
    for (size_t k = 0; k < m->motions; k++) {
        v[k] += m->step * kick[k];
        x[k] += m->step * v[k];
    }
    free(kick);
}

/// Spectral radius of the map of one step, all eigenvalues: how much anything can grow. The units are those in which
/// numbers have one magnitude, since rigid motions leave a Jordan block of eigenvalue 1. alternating: largest magnitude
/// of those that are real and negative.
static double growth(const scree_specimen *s, marched scheme, double theta, double step, double *alternating)
{
    march m = march_create(s, scheme, theta, step);
    const size_t size = march_size(&m);
    dense map = dense_create(size, size);
    for (size_t k = 0; k < size; k++) {
        const double unit = k < m.motions ? 1 : k < 2 * m.motions ? 1 / step : NORMAL;
        double *column = map.value + k * size;
        column[k] = unit;
        march_on(&m, column);
        for (size_t i = 0; i < size; i++) column[i] /= i < m.motions ? 1 : i < 2 * m.motions ? 1 / step : NORMAL;
    }
    double *real = calloc(size, sizeof *real), *imaginary = calloc(size, sizeof *imaginary), most = 0;
    dense_eigenvalues(&map, real, imaginary);
    *alternating = 0;
    for (size_t k = 0; k < size; k++) {
        most = fmax(most, hypot(real[k], imaginary[k]));
        if (real[k] < 0 && fabs(imaginary[k]) < 1e-6) *alternating = fmax(*alternating, -real[k]);
    }
    free(real);
    free(imaginary);
    free(map.value);
    march_destroy(&m);
    return most;
}

static double critical_step(const scree_specimen *s, marched scheme, double theta)
{
    const double radius = radius_of(s);
    const scree_strain_scheme schemes[SCHEMES] = {scree_strain_rigid(), scree_strain_explicit(radius),
                                                  scree_strain_relaxed(theta, radius), scree_strain_implicit(radius)};
    double step;
    scree_error error;
    check(scree_critical_step(s, schemes[scheme], &step, NULL, &error), &error);
    return step;
}

typedef struct kind {
    const char *name;
    double tangential, damping;
    scree_tangential_form form;
    bool dashpots_strain;
    bool potential;
} kind;

/// All eigenvalues of the scheme: below the step none grows, above it one that changes its sign in every step does.
/// Rigid motions have a double eigenvalue 1, which rounding spreads by its root, 1e-7. As published with k_t > 0 the
/// operator is not symmetric, and pairs of modes may feed each other at any step: what they do is printed.
static void steps_are_those_at_which_schemes_break(void **unused)
{
    (void)unused;
    static const kind kinds[] = {
        {"normal springs", 0, 0, SCREE_TANGENTIAL_AS_PUBLISHED, true, true},
        {"corrected", 0.6, 0, SCREE_TANGENTIAL_CORRECTED, true, true},
        {"as published", 0.6, 0, SCREE_TANGENTIAL_AS_PUBLISHED, true, false},
        {"damped, in the stress", 0.6, 0.3, SCREE_TANGENTIAL_CORRECTED, true, true},
        {"damped, not in the stress", 0.6, 0.3, SCREE_TANGENTIAL_CORRECTED, false, true},
        {"strongly damped, in the stress", 0, 5, SCREE_TANGENTIAL_AS_PUBLISHED, true, true},
        {"strongly damped, not in the stress", 0, 5, SCREE_TANGENTIAL_AS_PUBLISHED, false, true},
    };
    discs d = discs_irregular(2, 4);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        scree_specimen s = bonded(&d, 2, 0.25, kinds[k].tangential, 0.3);
        s.tangential = kinds[k].form;
        s.dashpots_strain = kinds[k].dashpots_strain;
        const double viscous = 2 * kinds[k].damping * sqrt(0.5 * s.mass[0] * NORMAL);
        for (size_t c = 0; c < s.contact_count; c++)
            s.contact[c].damping = (scree_springs){viscous, 0.5 * kinds[k].tangential * viscous};
        const double radius = radius_of(&s), theta = scree_relaxation(radius);
        for (int scheme_ = 0; scheme_ < SCHEMES; scheme_++) {
            const marched which = (marched)scheme_;
            const double step = critical_step(&s, which, theta);
            if (radius >= 1 && which == EXPLICIT) {
                assert_true(step == 0);
                continue;
            }
            double sign_below, sign_above;
            const double below = growth(&s, which, theta, 0.999 * step, &sign_below);
            const double above = growth(&s, which, theta, 1.001 * step, &sign_above);
            print_message("%-34s %-8s rho %.3f: %.5g s, growth below %.9f (%.6f), above %.6f\n", kinds[k].name,
                          names[which], radius, step, below, sign_below, above);
            // The eigenvalue leaves the circle at -1 at the step itself.
            assert_true(sign_below < 1 && sign_above > 1 + 1e-5);
            if (kinds[k].potential) assert_true(below < 1 + 1e-6 && above == sign_above);
        }
        scree_specimen_destroy(&s);
    }
    discs_destroy(&d);
}

/// Several times past the limit of the explicit scheme, and in space.
static void schemes_past_the_limit(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        discs d = discs_irregular(dimension, dimension == 2 ? 4 : 2);
        scree_specimen s = bonded(&d, dimension, 0.25, 0, 0.3);
        const double one = radius_of(&s);
        for (size_t c = 0; c < s.body_count; c++) s.compliance[c].shear *= 5 / one, s.compliance[c].trace *= 5 / one;
        assert_within(radius_of(&s), 5, 1e-6);
        const double theta = scree_relaxation(5), rigid = critical_step(&s, RIGID, theta);
        assert_true(theta <= 1.0 / 6 && theta > 1.0 / 6 - 1e-3);
        assert_true(critical_step(&s, EXPLICIT, theta) == 0);
        for (int which = RELAXED; which <= IMPLICIT; which++) {
            double sign;
            const double step = critical_step(&s, (marched)which, theta);
            assert_true(growth(&s, (marched)which, theta, 0.999 * step, &sign) < 1 + 1e-6);
            assert_true(growth(&s, (marched)which, theta, 1.001 * step, &sign) > 1 + 1e-5 && sign > 1);
            assert_true(which == RELAXED ? step > 0.7 * rigid && step < rigid : step > rigid);
        }
        scree_specimen_destroy(&s);
        discs_destroy(&d);
    }
}

/// A march of the explicit scheme in time: what was at rest but for a small push calms, or explodes, 0.2 % around the
/// step that was predicted.
static void marches_around_the_step(void **unused)
{
    (void)unused;
    discs d = discs_hexagonal(5, 4, 1);
    scree_specimen s = bonded(&d, 2, 1e-6, 0, 0.35);
    const double step = critical_step(&s, EXPLICIT, 1), rigid = critical_step(&s, RIGID, 1);
    print_message("hexagonal: explicit %.6g s, rigid %.6g s\n", step, rigid);
    assert_true(step < 0.999 * rigid);
    for (int above = 0; above < 2; above++) {
        march m = march_create(&s, EXPLICIT, 1, step * (above ? 1.002 : 0.998));
        double *state = calloc(march_size(&m), sizeof *state), most = 0;
        for (size_t k = 0; k < m.motions; k++)
            state[m.motions + k] = scree_random_uniform(1, SCREE_RANDOM_TEST, k) - 0.5;
        for (int n = 0; n < 4000; n++) march_on(&m, state);
        for (size_t k = 0; k < m.motions; k++) most = fmax(most, fabs(state[m.motions + k]));
        assert_true(above ? most > 1e6 : most < 10);
        free(state);
        march_destroy(&m);
    }
    scree_specimen_destroy(&s);
    discs_destroy(&d);
}

/// Two bodies of mass m and a spring with a dashpot: (2 / w) (sqrt(1 + z^2) - z), w^2 = 2 k / m.
static void critical_step_of_a_pair(void **unused)
{
    (void)unused;
    discs d = discs_square(1, 2);
    for (int damping = 0; damping < 6; damping++) {
        scree_specimen s = bonded(&d, 2, 1e-6, 0, 0.3);
        const double w = sqrt(2 * NORMAL / s.mass[0]), z = damping;
        s.contact[0].damping.normal = 2 * z * sqrt(0.5 * s.mass[0] * NORMAL);
        assert_within(critical_step(&s, RIGID, 1), 2 / w / (sqrt(1 + z * z) + z), 1e-8);
        double bodies;
        assert_int_equal(scree_step_of_bodies(&s, &bodies, NULL), SCREE_OK);
        assert_within(bodies, 2 * sqrt(s.mass[0] / NORMAL), 1e-12);
        assert_within(scree_step_of_extremes(&s), sqrt(s.mass[0] / NORMAL), 1e-12);
        // Without a spring: the dashpot alone, 2 / dt m > c.
        s.contact[0].stiffness.normal = 0;
        if (damping)
            assert_within(critical_step(&s, RIGID, 1), s.mass[0] / s.contact[0].damping.normal, 1e-8);
        else
            assert_true(isinf(critical_step(&s, RIGID, 1)));
        // One of them held: half the stiffness of the mode.
        s.contact[0].stiffness.normal = NORMAL;
        s.contact[0].damping.normal = 0;
        s.held[1] = 1 | 2 | 32;
        assert_within(critical_step(&s, RIGID, 1), 2 * sqrt(s.mass[0] / NORMAL), 1e-8);
        scree_specimen_destroy(&s);
    }
    discs_destroy(&d);
}

/// 400 discs, too many for the dense way: the same limits as LAPACK on the whole matrix.
static void large_maps_agree_with_dense_ones(void **unused)
{
    (void)unused;
    discs d = discs_irregular(2, 9);
    scree_specimen s = bonded(&d, 2, 0.25, 0.4, 0.3);
    const size_t size = scree_specimen_motions(&s);
    dense k = dense_of(&s, scree_specimen_stiffness, size, size);
    for (size_t column = 0; column < size; column++) {
        double *x = dense_at(&k, 0, column), *y = calloc(size, sizeof *y);
        scree_specimen_accelerate(&s, x, y);
        memcpy(x, y, size * sizeof *x);
        free(y);
    }
    assert_within(critical_step(&s, RIGID, 1), 2 / sqrt(dense_radius(&k)), 1e-8);
    free(k.value);
    scree_specimen_destroy(&s);
    discs_destroy(&d);
}

/// As published with k_t > 0 the lagged strain feeds some modes at any step, without dashpots: growth a step goes as
/// its square. Corrected, or without k_t, or k_t without deformation, nothing grows.
static void published_form_feeds_itself(void **unused)
{
    (void)unused;
    discs d = discs_irregular(2, 4);
    for (int k = 0; k < 3; k++) {
        scree_specimen s = bonded(&d, 2, 0.25, k == 0 ? 0 : 0.5, 0.35);
        // k_n / E_p = 0.35.
        for (size_t c = 0; c < s.body_count; c++) s.compliance[c].shear *= 0.5, s.compliance[c].trace *= 0.5;
        s.tangential = k == 2 ? SCREE_TANGENTIAL_CORRECTED : SCREE_TANGENTIAL_AS_PUBLISHED;
        const double step = critical_step(&s, EXPLICIT, 1);
        double sign;
        const double half = growth(&s, EXPLICIT, 1, 0.5 * step, &sign) - 1,
                     whole = growth(&s, EXPLICIT, 1, 0.99 * step, &sign) - 1;
        print_message("%s: growth a step %.3g at half the step, %.3g near it\n",
                      k == 0   ? "k_t = 0"
                      : k == 1 ? "as published"
                               : "corrected",
                      half, whole);
        if (k == 1)
            assert_true(half > 1e-4 && whole > 3 * half);
        else
            assert_true(half < 1e-6 && whole < 1e-6);
        scree_specimen_destroy(&s);
    }
    discs_destroy(&d);
}

// ---- at a given step, and bounds ---------------------------------------------------------------------------------

static double use_of(const scree_specimen *s, scree_strain_scheme scheme, double step)
{
    double use;
    scree_error error;
    check(scree_stability_use(s, scheme, step, &use, &error), &error);
    return use;
}

static double bound_of(const scree_specimen *s, double share, double step)
{
    double bound;
    scree_error error;
    check(scree_stability_bound(s, share, step, &bound, &error), &error);
    return bound;
}

/// At the critical step all is used, and with particles as much softer as the softness says a step is the critical one.
/// 1e-5: steps are found to 1e-6 of themselves, and their squares count.
static void use_and_softness_belong_to_the_step(void **unused)
{
    (void)unused;
    for (int k = 0; k < 4; k++) {
        discs d = discs_irregular(2 + k / 2, (size_t)(4 - k / 2));
        scree_specimen s = bonded(&d, 2 + k / 2, 0.25, k % 2 ? 0.4 : 0, 0.3);
        s.tangential = SCREE_TANGENTIAL_CORRECTED;
        const double radius = radius_of(&s);
        // k_n / E_p at half of its limit.
        for (size_t body = 0; body < s.body_count; body++) {
            s.compliance[body].shear *= 0.5 / radius;
            s.compliance[body].trace *= 0.5 / radius;
        }
        const scree_strain_scheme lagged = scree_strain_explicit(0.5), relaxed = scree_strain_relaxed(0.6, 0.5);
        const double rigid = critical_step(&s, RIGID, 1), step = critical_step(&s, EXPLICIT, 1);
        assert_within(use_of(&s, scree_strain_rigid(), rigid), 1, 1e-5);
        assert_within(use_of(&s, lagged, step), 1, 1e-5);
        assert_within(use_of(&s, scree_strain_rigid(), 0.5 * rigid), 0.25, 1e-6);
        // The last two with dashpots, whose maps are not symmetric.
        for (int which = 0; which < 4; which++) {
            const scree_strain_scheme scheme = which % 2 ? relaxed : lagged;
            for (size_t c = 0; c < s.contact_count && which == 2; c++)
                s.contact[c].damping = (scree_springs){0.2 * rigid * NORMAL * (k < 2 ? 1 : 1e-3), 0};
            double softness;
            scree_error error;
            check(scree_stability_softness(&s, scheme, 0.5 * step, &softness, &error), &error);
            assert_true(softness > 1);
            scree_specimen soft = s;
            soft.compliance = calloc(s.body_count, sizeof *soft.compliance);
            for (size_t body = 0; body < s.body_count; body++)
                soft.compliance[body] =
                    (scree_compliance){softness * s.compliance[body].shear, softness * s.compliance[body].trace};
            assert_within(use_of(&soft, scheme, 0.5 * step), 1, 1e-5);
            free(soft.compliance);
            check(scree_stability_softness(&s, scheme, 1.01 * rigid, &softness, &error), &error);
            assert_true(softness == 0);
        }
        scree_specimen_destroy(&s);
        discs_destroy(&d);
    }
}

/// No bound is below what it bounds, whatever is held or touches a wall; unbounded lattices with normal springs reach
/// it. 1e-7: as eigenvalues.
static void bounds_hold_and_lattices_reach_them(void **unused)
{
    (void)unused;
    for (int lattice = 0; lattice < SCREE_LATTICES; lattice++) {
        const int dimension = scree_lattice_dimension((scree_lattice)lattice);
        discs d = discs_lattice((scree_lattice)lattice, 4);
        scree_specimen s = bonded(&d, dimension, 1e-6, 0, 0.3);
        const double step = critical_step(&s, RIGID, 1);
        double radius;
        scree_error error;
        check(scree_radius_bound(&s, &radius, &error), &error);
        assert_within(radius, radius_of(&s), 1e-7);
        // All contacts of a square or simple cubic lattice lie along the axes, so each direction has its own chain.
        assert_within(bound_of(&s, 0, step), 1, 1e-6);
        scree_specimen_destroy(&s);
        discs_destroy(&d);
    }
    for (int k = 0; k < 6; k++) {
        const int dimension = 2 + k % 2;
        discs d = discs_irregular(dimension, dimension == 2 ? 6 : 3);
        scree_specimen s = bonded(&d, dimension, 0.25, k < 2 ? 0 : 0.5, 0.2);
        s.tangential = SCREE_TANGENTIAL_CORRECTED;
        if (k > 3) {
            s.held[0] = 63;
            s.held[3] = 1;
            s.contact[2].second = SCREE_SPECIMEN_WALL;
            s.contact[2].arm_second = s.contact[2].reach_second = 0;
        }
        const double rigid = critical_step(&s, RIGID, 1), radius = radius_of(&s);
        for (int share = 0; share < 3; share++) {
            const scree_strain_scheme scheme = {share == 2 ? -1 : share, radius};
            const double use = use_of(&s, scheme, 0.6 * rigid), bound = bound_of(&s, scheme.share, 0.6 * rigid);
            print_message("%dD, share %2d: use %.4f, bound %.4f\n", dimension, (int)scheme.share, use, bound);
            assert_true(bound >= use * (1 - 1e-9) && bound < 4 * use + 1);
        }
        // Where the map is not symmetric there is none.
        s.tangential = SCREE_TANGENTIAL_AS_PUBLISHED;
        assert_true((k < 2) == isfinite(bound_of(&s, 1, rigid)));
        scree_specimen_destroy(&s);
        discs_destroy(&d);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(largest_stiffness_of_the_specimens),
        cmocka_unit_test(lattices_have_their_closed_form),
        cmocka_unit_test(tangential_springs_in_the_iteration),
        cmocka_unit_test(critical_step_of_a_pair),
        cmocka_unit_test(large_maps_agree_with_dense_ones),
        cmocka_unit_test(steps_are_those_at_which_schemes_break),
        cmocka_unit_test(schemes_past_the_limit),
        cmocka_unit_test(marches_around_the_step),
        cmocka_unit_test(published_form_feeds_itself),
        cmocka_unit_test(use_and_softness_belong_to_the_step),
        cmocka_unit_test(bounds_hold_and_lattices_reach_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
