/// Static solutions and moduli: lattices against closed forms, dense solutions, loads that nothing holds.
#include "lattice_fixture.h"

#include "base/memory.h"
#include "base/vectors.h"
#include "specimen/box.h"
#include "specimen/moduli.h"
#include "specimen/stability.h"
#include "specimen/static.h"

#define assert_within(value, expected, tolerance)                                                                      \
    do {                                                                                                               \
        const double value_ = (value), expected_ = (expected);                                                         \
        if (!(fabs(value_ - expected_) <= (tolerance)*fabs(expected_)))                                                \
            fail_msg("%.12g, not %.12g", value_, expected_);                                                           \
    } while (0)

static scree_specimen_moduli moduli_of(const scree_specimen *s)
{
    scree_specimen_moduli m;
    scree_error error;
    check(scree_specimen_find_moduli(s, &m, &error), &error);
    return m;
}

/// All lattices, rigid and deformed in both forms, against theory/lattice.c. Bodies of a lattice stay where the strain
/// puts them, so only rounding and the residual of 1e-11 are between the two: 1e-9.
static void lattices_against_closed_forms(void **unused)
{
    (void)unused;
    for (int kind = 0; kind < SCREE_LATTICES; kind++)
        for (int form = 0; form < 3; form++) {
            const int d = scree_lattice_dimension((scree_lattice)kind);
            discs places = discs_lattice((scree_lattice)kind, 4);
            const double normal = d == 2 ? 7e10 : 7e7, tangential = 0.4 * normal;
            scree_specimen s = specimen_of(&places, d, 1e-6, (discs_bond){.stiffness = {normal, tangential}});
            if (form)
                specimen_set_compliance(&s, scree_compliance_of(d == 2 ? SCREE_PLANE_STRAIN : SCREE_SOLID, 1e11, 0.3));
            s.tangential = form == 2 ? SCREE_TANGENTIAL_CORRECTED : SCREE_TANGENTIAL_AS_PUBLISHED;
            const scree_lattice_material m = {.radius = 1e-3,
                                              .length = 1,
                                              .normal = normal,
                                              .tangential = tangential,
                                              .shear = s.compliance[0].shear,
                                              .trace = s.compliance[0].trace,
                                              .corrected = form == 2};
            const scree_specimen_moduli found = moduli_of(&s);
            const int n = s.strain_components;
            double all_round = 0;
            for (int i = 0; i < d; i++)
                for (int j = 0; j < d; j++) all_round += found.stiffness[i * n + j] / d;
            // The hexagonal lattice has its diagonal and shear alike, in any axes.
            assert_within(all_round, scree_lattice_modulus((scree_lattice)kind, SCREE_LATTICE_ALL_ROUND, &m), 1e-9);
            assert_within(found.stiffness[0] - found.stiffness[1],
                          scree_lattice_modulus((scree_lattice)kind, SCREE_LATTICE_DIAGONAL, &m), 1e-9);
            assert_within(found.stiffness[n * n - 1],
                          scree_lattice_modulus((scree_lattice)kind, SCREE_LATTICE_SHEAR, &m), 1e-9);
            assert_true(found.asymmetry < 1e-9);
            if (kind == SCREE_LATTICE_HEXAGONAL) assert_true(found.anisotropy < 1e-9);
            if (kind == SCREE_LATTICE_SQUARE) assert_true(found.anisotropy > 0.01);
            // Rigid particles of a lattice follow the mean strain.
            if (form == 0) assert_within(found.isotropic.young, found.voigt.young, 1e-9);
            scree_specimen_destroy(&s);
            discs_destroy(&places);
        }
}

/// M 4.15-4.18 in his words, and nu = 0 where k_t = k_n.
static void estimates_of_the_source(void **unused)
{
    (void)unused;
    const double count = 14435, square = 1.49e-7, volume = 0.0025, kn = 7e10, kt = 3e10;
    scree_voigt_moduli m = scree_voigt_estimate(2, count, square, volume, kn, kt);
    assert_within(m.young, 4 * count * square * kn / volume * (kn + kt) / (3 * kn + kt), 1e-13);
    assert_within(m.poisson, (kn - kt) / (3 * kn + kt), 1e-13);
    assert_within(m.bulk, count * square / volume * kn, 1e-13);
    assert_within(m.shear, count * square * (kn + kt) / (2 * volume), 1e-13);
    m = scree_voigt_estimate(3, count, square, volume, kn, 0);
    assert_within(m.poisson, 0.25, 1e-13);
    // Face-centred spheres have 6 contacts in a volume of 4 sqrt 2 R^3; their mean shear is that of all directions.
    const scree_lattice_material fcc = {.radius = 1, .normal = kn, .tangential = kt};
    m = scree_voigt_estimate(3, 6, 1, 4 * sqrt(2), kn, kt);
    const double e = scree_lattice_modulus(SCREE_LATTICE_FACE_CENTRED, SCREE_LATTICE_DIAGONAL, &fcc),
                 t = scree_lattice_modulus(SCREE_LATTICE_FACE_CENTRED, SCREE_LATTICE_SHEAR, &fcc);
    assert_within(3 * m.bulk, scree_lattice_modulus(SCREE_LATTICE_FACE_CENTRED, SCREE_LATTICE_ALL_ROUND, &fcc), 1e-9);
    assert_within(2 * m.shear, (2 * e + 3 * t) / 5, 1e-9);
}

/// An irregular net in a periodic cell.
static scree_specimen irregular(int dimension, double tangential, double poisson)
{
    const size_t side = dimension == 2 ? 6 : 4;
    discs d = discs_irregular(dimension, side);
    d.lattice[0] = 2e-3 * (double)side;
    d.lattice[1] = (dimension == 2 ? 1e-3 * sqrt(3) : 2e-3) * (double)side;
    d.lattice[2] = dimension == 3 ? 2e-3 * (double)side : 0;
    const double normal = dimension == 2 ? 7e10 : 7e7;
    scree_specimen s =
        specimen_of(&d, dimension, 0.25, (discs_bond){.stiffness = {normal, tangential * normal}, .scatter = 0.5});
    specimen_set_compliance(&s, scree_compliance_of(dimension == 2 ? SCREE_PLANE_STRAIN : SCREE_SOLID, 1e11, poisson));
    discs_destroy(&d);
    return s;
}

static double motion_unit(const scree_specimen *s, size_t k)
{
    return (int)(k % (size_t)s->components) < s->dimension ? 1 : 1e3;
}

/// Contact forces under a strain, from all equations at once by least squares: f = -D (G x + offset) + B f, G^T f = 0.
static void dense_forces(const scree_specimen *s, const double *offset, double *force)
{
    const size_t m = scree_specimen_motions(s), n = scree_specimen_contact_forces(s), width = (size_t)s->dimension;
    dense b = dense_of(s, scree_specimen_force_iteration, n, n), a = dense_of(s, scree_specimen_forces, n, m),
          g = dense_of(s, scree_specimen_gather, m, n);
    // All rows and columns of one magnitude: forces over k, torques over k R, angles times R.
    const double k = s->contact[0].stiffness.normal;
    dense whole = dense_create(n + m, n + m);
    double *right = calloc(n + m, sizeof *right), *singular = calloc(n + m, sizeof *singular);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < n; i++) *dense_at(&whole, i, j) = (i == j) - *dense_at(&b, i, j);
        for (size_t i = 0; i < m; i++) *dense_at(&whole, n + i, j) = *dense_at(&g, i, j) * motion_unit(s, i);
    }
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i < n; i++) *dense_at(&whole, i, n + j) = -*dense_at(&a, i, j) / k * motion_unit(s, j);
    for (size_t c = 0; c < s->contact_count; c++)
        scree_specimen_along(s->dimension, &s->contact[c], -s->contact[c].stiffness.normal / k,
                             -s->contact[c].stiffness.tangential / k, offset + c * width, right + c * width);
    lapack_int rank, size = (lapack_int)(n + m);
    assert_int_equal(
        LAPACKE_dgelsd(LAPACK_COL_MAJOR, size, size, 1, whole.value, size, right, size, singular, 1e-12, &rank), 0);
    for (size_t i = 0; i < n; i++) force[i] = right[i] * k;
    free(right);
    free(singular);
    free(whole.value);
    free(b.value);
    free(a.value);
    free(g.value);
}

/// Both forms, far past the limit of explicit schemes too. 1e-7: the condition of the matrix, some 1e3, times residual
/// and rounding, with room.
static void forces_against_dense_solutions(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int form = 0; form < 4; form++) {
            scree_specimen s = irregular(dimension, form == 3 ? 0 : 0.5, 0.3);
            s.tangential = form == 1 ? SCREE_TANGENTIAL_CORRECTED : SCREE_TANGENTIAL_AS_PUBLISHED;
            for (size_t k = 0; k < s.body_count && form == 2; k++)
                s.compliance[k].shear *= 5, s.compliance[k].trace *= 5;
            const size_t n = scree_specimen_contact_forces(&s);
            double *offset = calloc(n, sizeof *offset), *force = calloc(n, sizeof *force),
                   *expected = calloc(n, sizeof *expected),
                   *motion = calloc(scree_specimen_motions(&s), sizeof *motion);
            for (size_t c = 0; c < s.contact_count; c++) {
                offset[c * (size_t)dimension] = s.contact[c].branch[0] + 0.3 * s.contact[c].branch[1];
                offset[c * (size_t)dimension + 1] = 0.3 * s.contact[c].branch[0];
            }
            size_t iterations;
            scree_error error;
            const scree_static_load load = {.offset = offset};
            check(scree_static_solve(&s, &load, motion, force, &iterations, &error), &error);
            dense_forces(&s, offset, expected);
            double most = 0, away = 0;
            for (size_t k = 0; k < n; k++) {
                most = fmax(most, s.contact[0].stiffness.normal * fabs(offset[k]));
                away = fmax(away, fabs(expected[k] - force[k]));
            }
            print_message("%dD form %d: %zu iterations, off by %.3g\n", dimension, form, iterations, away / most);
            assert_true(away <= 1e-7 * most);
            free(offset);
            free(force);
            free(expected);
            free(motion);
            scree_specimen_destroy(&s);
        }
}

/// Elasticity of an irregular specimen: symmetric where there is a potential, softer than Voigt, softer the softer its
/// particles are.
static void irregular_moduli(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_specimen s = irregular(dimension, 0.5, 0.3);
        const scree_specimen_moduli published = moduli_of(&s);
        s.tangential = SCREE_TANGENTIAL_CORRECTED;
        const scree_specimen_moduli corrected = moduli_of(&s);
        specimen_set_compliance(&s, (scree_compliance){0});
        const scree_specimen_moduli rigid = moduli_of(&s);
        print_message("%dD: asymmetry %.3g published, %.3g corrected; E %.4g, %.4g, rigid %.4g, Voigt %.4g\n",
                      dimension, published.asymmetry, corrected.asymmetry, published.isotropic.young,
                      corrected.isotropic.young, rigid.isotropic.young, rigid.voigt.young);
        assert_true(published.asymmetry > 1e-5 && corrected.asymmetry < 1e-9 && rigid.asymmetry < 1e-9);
        assert_true(corrected.isotropic.young < rigid.isotropic.young);
        assert_true(rigid.isotropic.young < rigid.voigt.young);
        assert_within(rigid.voigt.young, corrected.voigt.young, 1e-12);
        double trace = 0;
        for (int k = 0; k < 3; k++) trace += rigid.fabric[4 * k];
        assert_within(trace, 1, 1e-12);
        scree_specimen_destroy(&s);
    }
}

/// A bar between a held end and a pulled one stretches by f / k a contact; the same pull on a free one is refused, and
/// on a balanced free one not; so is a force that turns it.
static void loads_on_the_whole(void **unused)
{
    (void)unused;
    discs d = discs_square(1, 5);
    scree_specimen s = specimen_of(&d, 2, 1e-6, (discs_bond){.stiffness = {7e10, 3e10}});
    double motion[15], force[8], load[15] = {0};
    scree_error error;
    const scree_static_load pull = {.force = load};
    load[12] = 7e4;
    s.held[0] = 1 | 2 | 32;
    check(scree_static_solve(&s, &pull, motion, force, NULL, &error), &error);
    for (int k = 0; k < 5; k++) assert_within(motion[3 * k], 1e-6 * k, 1e-9);
    s.held[0] = 0;
    assert_int_equal(scree_static_solve(&s, &pull, motion, force, NULL, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "as a whole"));
    load[0] = -7e4;
    check(scree_static_solve(&s, &pull, motion, force, NULL, &error), &error);
    assert_within(motion[12] - motion[0], 4e-6, 1e-9);
    // Held in one place, but free to turn about it.
    s.held[0] = 1 | 2;
    load[13] = 1;
    assert_int_equal(scree_static_solve(&s, &pull, motion, force, NULL, &error), SCREE_ERROR_INPUT);
    s.held[0] = 1 | 2 | 32;
    // Held there, but a row of discs that roll on each other bears nothing across.
    assert_int_equal(scree_static_solve(&s, &pull, motion, force, NULL, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "nothing resists"));
    scree_specimen_moduli m;
    assert_int_equal(scree_specimen_find_moduli(&s, &m, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "volume"));
    scree_specimen_destroy(&s);
    discs_destroy(&d);
}

static scree_specimen cut(const scree_specimen *s)
{
    const scree_box_faces ends = {{{NAN, NAN, NAN}, {NAN, NAN, NAN}}};
    scree_specimen piece;
    scree_box box;
    scree_error error;
    check(scree_specimen_find_box(s, &ends, &box, &error), &error);
    check(scree_specimen_cut_box(s, &box, &piece, &error), &error);
    return piece;
}

/// A box of a square or simple cubic lattice of rigid particles is the lattice, edges and corners included: 1e-9.
static void boxes_are_their_lattice(void **unused)
{
    (void)unused;
    for (int d = 2; d <= 3; d++) {
        discs places = discs_lattice(d == 2 ? SCREE_LATTICE_SQUARE : SCREE_LATTICE_SIMPLE_CUBIC, 5);
        memset(places.lattice, 0, sizeof places.lattice);
        scree_specimen s = specimen_of(&places, d, 1e-6, (discs_bond){.stiffness = {7e10, 3e10}}), piece = cut(&s);
        const scree_lattice_material m = {.radius = 1e-3, .length = 1, .normal = 7e10, .tangential = 3e10};
        const scree_lattice kind = d == 2 ? SCREE_LATTICE_SQUARE : SCREE_LATTICE_SIMPLE_CUBIC;
        const scree_specimen_moduli found = moduli_of(&piece);
        const int n = s.strain_components;
        assert_within(found.stiffness[0], scree_lattice_modulus(kind, SCREE_LATTICE_ALL_ROUND, &m), 1e-9);
        assert_true(fabs(found.stiffness[1]) < 1e-9 * found.stiffness[0]);
        assert_within(found.stiffness[n * n - 1], scree_lattice_modulus(kind, SCREE_LATTICE_SHEAR, &m), 1e-9);
        scree_specimen_destroy(&piece);
        scree_specimen_destroy(&s);
        discs_destroy(&places);
    }
}

/// The same net as a periodic cell and as a box of 40 x 40 discs: faces that move with the strain change little, 4 %
/// at the most, elastic particles or rigid ones. A disc of discs is no box.
static void boxes_are_near_their_periodic_cells(void **unused)
{
    (void)unused;
    const size_t side = 40;
    discs d = discs_irregular(2, side);
    for (int elastic = 0; elastic < 2; elastic++) {
        scree_specimen box = specimen_of(&d, 2, 0.25, (discs_bond){.stiffness = {7e10, 2e10}});
        discs cell = d;
        cell.lattice[0] = 2e-3 * (double)side;
        cell.lattice[1] = 1e-3 * sqrt(3) * (double)side;
        scree_specimen periodic = specimen_of(&cell, 2, 0.25, (discs_bond){.stiffness = {7e10, 2e10}});
        const scree_compliance c = scree_compliance_of(SCREE_PLANE_STRAIN, 2e11, 0.3);
        if (elastic) specimen_set_compliance(&box, c), specimen_set_compliance(&periodic, c);
        scree_specimen piece = cut(&box);
        const scree_specimen_moduli one = moduli_of(&piece), other = moduli_of(&periodic);
        print_message("box: E %.5g, nu %.4f; periodic: E %.5g, nu %.4f\n", one.isotropic.young, one.isotropic.poisson,
                      other.isotropic.young, other.isotropic.poisson);
        assert_within(one.isotropic.bulk, other.isotropic.bulk, 0.04);
        assert_within(one.isotropic.shear, other.isotropic.shear, 0.04);
        scree_specimen_destroy(&piece);
        scree_specimen_destroy(&box);
        scree_specimen_destroy(&periodic);
    }
    discs_destroy(&d);
    discs round = discs_create(400);
    for (int k = 0; k < 400; k++) {
        const double x = 2e-3 * (k % 20) - 19e-3, y = 2e-3 * (k / 20) - 19e-3;
        if (hypot(x, y) < 20e-3) discs_add(&round, x, y, 0, 1e-3);
    }
    scree_specimen s = specimen_of(&round, 2, 1e-6, (discs_bond){.stiffness = {1, 1}});
    scree_box filled;
    scree_error error;
    const scree_box_faces ends = {{{NAN, NAN, NAN}, {NAN, NAN, NAN}}};
    assert_int_equal(scree_specimen_find_box(&s, &ends, &filled, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "fills a box"));
    scree_specimen_destroy(&s);
    discs_destroy(&round);
}

/// Every allocation fails once: status 4, nothing kept, and the same numbers when there is memory again.
static void memory_that_runs_out(void **unused)
{
    (void)unused;
    scree_specimen s = irregular(2, 0.5, 0.3);
    const scree_specimen_moduli expected = moduli_of(&s);
    double rigid, lagged, radius;
    size_t before, after;
    scree_error error;
    check(scree_spectral_radius(&s, &radius, NULL, &error), &error);
    scree_allocation_statistics(&before, NULL);
    for (int what = 0; what < 2; what++) {
        scree_status status = SCREE_ERROR_IO;
        uint64_t failed = 0;
        while (status) {
            scree_specimen_moduli m = {0};
            (void)scree_allocation_fail_after(++failed);
            status = what == 0 ? scree_specimen_find_moduli(&s, &m, &error)
                               : scree_critical_step(&s, scree_strain_rigid(), &rigid, NULL, &error);
            if (!status && what == 1)
                status = scree_critical_step(&s, scree_strain_explicit(radius), &lagged, NULL, &error);
            assert_true(!status || status == SCREE_ERROR_IO);
            scree_allocation_statistics(&after, NULL);
            assert_int_equal(before, after);
            if (!status && what == 0) assert_memory_equal(&m, &expected, sizeof m);
        }
        (void)scree_allocation_fail_after(0);
        assert_true(failed > 10);
    }
    scree_specimen_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattices_against_closed_forms),
        cmocka_unit_test(estimates_of_the_source),
        cmocka_unit_test(forces_against_dense_solutions),
        cmocka_unit_test(irregular_moduli),
        cmocka_unit_test(loads_on_the_whole),
        cmocka_unit_test(boxes_are_their_lattice),
        cmocka_unit_test(boxes_are_near_their_periodic_cells),
        cmocka_unit_test(memory_that_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
