/// Waves and critical steps of lattices against the operator on periodic cells, and long waves against moduli.
#include "lattice_fixture.h"

#include "specimen/stability.h"
#include "theory/lattice_waves.h"

#define assert_within(value, expected, tolerance)                                                                      \
    do {                                                                                                               \
        const double value_ = (value), expected_ = (expected);                                                         \
        if (!(fabs(value_ - expected_) <= (tolerance)*fabs(expected_)))                                                \
            fail_msg("%.12g, not %.12g", value_, expected_);                                                           \
    } while (0)

/// Cells a side. The corners of the zones are waves of cells of 6 (hexagonal) and 2 (in space).
enum { SIDE_2D = 6, SIDE_3D = 4, SHORT_3D = 2, MOST = 2 * SCREE_LATTICE_BRANCHES };

typedef enum particle_form { FORM_RIGID, FORM_PUBLISHED, FORM_CORRECTED, FORMS } particle_form;

static scree_specimen lattice_specimen(scree_lattice kind, int side, particle_form form, double tangential,
                                       double poisson, scree_lattice_material *m, discs *places)
{
    const int d = scree_lattice_dimension(kind);
    const double normal = d == 2 ? 7e10 : 7e7;
    *places = discs_lattice(kind, d == 2 ? SIDE_2D : side);
    scree_specimen s = specimen_of(places, d, 1e-6, (discs_bond){.stiffness = {normal, tangential * normal}});
    if (form)
        specimen_set_compliance(&s, scree_compliance_of(d == 2 ? SCREE_PLANE_STRAIN : SCREE_SOLID, 3e11, poisson));
    s.tangential = form == FORM_CORRECTED ? SCREE_TANGENTIAL_CORRECTED : SCREE_TANGENTIAL_AS_PUBLISHED;
    *m = (scree_lattice_material){.radius = 1e-3,
                                  .length = 1,
                                  .density = 2000,
                                  .normal = normal,
                                  .tangential = tangential * normal,
                                  .shear = s.compliance[0].shear,
                                  .trace = s.compliance[0].trace,
                                  .corrected = form == FORM_CORRECTED};
    return s;
}

/// y = what bodies get under x when the strain has followed: f = -D G x - share B f, by iteration.
static void strained_forces(const scree_specimen *s, double share, const double *x, double *y)
{
    const size_t n = scree_specimen_contact_forces(s);
    double *rigid = calloc(n, sizeof *rigid), *force = calloc(n, sizeof *force), *change = calloc(n, sizeof *change);
    scree_specimen_forces(s, x, rigid);
    memcpy(force, rigid, n * sizeof *force);
    for (int k = 0; k < 300 && scree_specimen_is_deformable(s); k++) {
        scree_specimen_force_iteration(s, force, change);
        for (size_t i = 0; i < n; i++) force[i] = rigid[i] - share * change[i];
    }
    scree_specimen_gather(s, force, y);
    free(rigid);
    free(force);
    free(change);
}

/// Cosine and sine of a wave, of one component of the motions.
static void make_wave(const scree_specimen *s, const double k[3], int which, double *x)
{
    const size_t c = (size_t)s->components;
    memset(x, 0, scree_specimen_motions(s) * sizeof *x);
    for (size_t body = 0; body < s->body_count; body++) {
        double phase = 0;
        for (int i = 0; i < s->dimension; i++) phase += k[i] * s->position[body][i];
        x[c * body + (size_t)which / 2] = which % 2 ? sin(phase) : cos(phase);
    }
}

/// Squares of the frequencies of the waves of this wave vector, twice each, from the operator.
static void squares_of_operator(const scree_specimen *s, double share, const double k[3], double square[MOST])
{
    const size_t n = scree_specimen_motions(s);
    const int size = 2 * s->components;
    double *x = calloc(n, sizeof *x), *y = calloc(n, sizeof *y), *z = calloc(n, sizeof *z), imaginary[MOST], none[1];
    double matrix[MOST * MOST];
    for (int j = 0; j < size; j++) {
        make_wave(s, k, j, x);
        strained_forces(s, share, x, y);
        scree_specimen_accelerate(s, y, z);
        for (int i = 0; i < size; i++) {
            double product = 0, length = 0;
            make_wave(s, k, i, x);
            for (size_t a = 0; a < n; a++) product += x[a] * z[a], length += x[a] * x[a];
            matrix[i * size + j] = -product / length;
        }
    }
    assert_int_equal(LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'N', size, matrix, size, square, imaginary, none, 1, none, 1),
                     0);
    free(x);
    free(y);
    free(z);
}

static int compare(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return p < q ? -1 : p > q;
}

/// A wave that the cell holds, in no direction of symmetry. Two ways to the same small matrix: only rounding and what
/// the iteration leaves are between them, so 1e-9 of the fastest wave.
static void frequencies_against_the_operator(void **unused)
{
    (void)unused;
    for (int n = 0; n < 2 * SCREE_LATTICES; n++)
        for (particle_form form = 0; form < FORMS; form++) {
            const int kind = n / 2;
            const double share = n % 2 ? SCREE_STRAIN_AT_ONCE : SCREE_STRAIN_EXPLICIT;
            scree_lattice_material m;
            discs places;
            scree_specimen s = lattice_specimen((scree_lattice)kind, SIDE_3D, form, 0.6, 0.3, &m, &places);
            const double k[3] = {2 * M_PI / places.lattice[0], 4 * M_PI / places.lattice[1],
                                 s.dimension == 3 ? 2 * M_PI / places.lattice[2] : 0};
            double square[MOST], frequency[SCREE_LATTICE_BRANCHES];
            const int count = scree_lattice_frequencies((scree_lattice)kind, &m, k, share, frequency);
            assert_int_equal(count, s.components);
            squares_of_operator(&s, share, k, square);
            qsort(square, (size_t)(2 * count), sizeof *square, compare);
            for (int b = 0; b < 2 * count; b++)
                if (!(fabs(pow(frequency[b / 2], 2) - square[b]) <= 1e-9 * square[2 * count - 1]))
                    fail_msg("%s, form %d, wave %d: %.12g, not %.12g", scree_lattice_name((scree_lattice)kind), form,
                             b / 2, pow(frequency[b / 2], 2), square[b]);
            scree_specimen_destroy(&s);
            discs_destroy(&places);
        }
}

/// The wave of the critical step repeats itself in the cell.
static bool is_held(const discs *places, const double k[3])
{
    bool held = true;
    for (int i = 0; i < 3; i++) {
        const double turns = k[i] * places->lattice[i] / (2 * M_PI);
        held = held && fabs(turns - rint(turns)) < 1e-4;
    }
    return held;
}

/// All schemes; where the fastest wave repeats itself in the cell they agree to 1e-6 (ARPACK stops at 1e-8), elsewhere
/// the cell bears a little more than the unbounded lattice.
static void critical_steps_against_the_operator(void **unused)
{
    (void)unused;
    int compared = 0;
    for (int kind = 0; kind < SCREE_LATTICES; kind++)
        for (particle_form form = 0; form < FORMS; form++)
            for (int scheme = 0; scheme < (form ? 3 : 1); scheme++)
                for (int ratio = 0; ratio < 3; ratio++) {
                    scree_lattice_material m;
                    discs places;
                    scree_error error;
                    scree_specimen s =
                        lattice_specimen((scree_lattice)kind, SHORT_3D, form, 0.5 * ratio, 0.3, &m, &places);
                    double radius, found, wave[3];
                    check(scree_spectral_radius(&s, &radius, NULL, &error), &error);
                    const scree_strain_scheme schemes[] = {form ? scree_strain_explicit(radius) : scree_strain_rigid(),
                                                           scree_strain_implicit(radius),
                                                           scree_strain_relaxed(1 / (1 + radius), radius)};
                    const double shares[] = {form ? SCREE_STRAIN_EXPLICIT : SCREE_STRAIN_NONE, SCREE_STRAIN_AT_ONCE,
                                             1 / (1 + 2 * radius)};
                    check(scree_critical_step(&s, schemes[scheme], &found, NULL, &error), &error);
                    const double expected = scree_lattice_critical_step((scree_lattice)kind, &m, shares[scheme], wave);
                    assert_true(found >= expected * (1 - 1e-6));
                    assert_true(found <= expected * 1.05);
                    if (is_held(&places, wave)) {
                        assert_within(found, expected, 1e-6);
                        compared++;
                    }
                    scree_specimen_destroy(&s);
                    discs_destroy(&places);
                }
    print_message("%d critical steps compared to 1e-6\n", compared);
    assert_int_equal(compared, 105);
}

/// Waves 1e4 particles long have the speeds of the moduli: they differ by (k R)^2, some 1e-7.
static void long_waves_have_the_speeds_of_the_moduli(void **unused)
{
    (void)unused;
    for (int kind = 0; kind < SCREE_LATTICES; kind++)
        for (particle_form form = 0; form < FORMS; form++) {
            scree_lattice_material m;
            discs places;
            scree_specimen s = lattice_specimen((scree_lattice)kind, SIDE_3D, form, 0.6, 0.2, &m, &places);
            const int d = s.dimension;
            const double density = 2000 * scree_particle_volume(d, &m) / scree_lattice_cell((scree_lattice)kind, &m);
            const double round = scree_lattice_modulus((scree_lattice)kind, SCREE_LATTICE_ALL_ROUND, &m),
                         diagonal = scree_lattice_modulus((scree_lattice)kind, SCREE_LATTICE_DIAGONAL, &m),
                         off = 0.5 * scree_lattice_modulus((scree_lattice)kind, SCREE_LATTICE_SHEAR, &m);
            double frequency[SCREE_LATTICE_BRANCHES];
            const double k = 0.3, wave[3] = {k};
            (void)scree_lattice_frequencies((scree_lattice)kind, &m, wave, SCREE_STRAIN_AT_ONCE, frequency);
            assert_within(frequency[d - 1] / k, sqrt((round - diagonal) / d / density + diagonal / density), 1e-6);
            assert_within(frequency[0] / k, sqrt(off / density), 1e-6);
            scree_specimen_destroy(&s);
            discs_destroy(&places);
        }
}

/// M 3.46, and by hand: hexagonal 6 k / m in the middle M of a side of the zone; a row of springs; face-centred along
/// the edge of the cube, 4 k / m sum of (n_x)^2 over the 8 contacts with a phase of pi: 8 k / m.
static void textbook_forms(void **unused)
{
    (void)unused;
    scree_lattice_material m = {.radius = 1, .length = 1, .density = 1, .normal = 1};
    double wave[3], frequency[SCREE_LATTICE_BRANCHES];
    const double disc = M_PI, ball = 4 * M_PI / 3;
    assert_within(scree_lattice_critical_step(SCREE_LATTICE_ROW, &m, 0, NULL), sqrt(disc), 1e-9);
    assert_within(scree_lattice_critical_step(SCREE_LATTICE_SQUARE, &m, 0, NULL), sqrt(disc), 1e-9);
    assert_within(scree_lattice_critical_step(SCREE_LATTICE_HEXAGONAL, &m, 0, wave), sqrt(2 * disc / 3), 1e-9);
    assert_within(scree_lattice_critical_step(SCREE_LATTICE_SIMPLE_CUBIC, &m, 0, NULL), sqrt(ball), 1e-9);
    assert_within(scree_lattice_critical_step(SCREE_LATTICE_FACE_CENTRED, &m, 0, NULL), 2 / sqrt(8 / ball), 1e-9);
    (void)scree_lattice_frequencies(SCREE_LATTICE_ROW, &m, (const double[]){0.4, 0, 0}, 0, frequency);
    assert_within(frequency[2], 2 / sqrt(disc) * sin(0.4), 1e-12);
    // A deformable row is a row of softer springs only for long waves; at the end of the zone no disc is strained.
    const scree_lattice_material soft = {
        .radius = 1, .length = 1, .density = 1, .normal = 1, .shear = 1.3 * 0.2, .trace = -0.3 * 1.3 * 0.2};
    (void)scree_lattice_frequencies(SCREE_LATTICE_ROW, &soft, (const double[]){M_PI / 2, 0, 0}, -1, frequency);
    assert_within(frequency[2], 2 / sqrt(disc), 1e-9);
    (void)scree_lattice_frequencies(SCREE_LATTICE_ROW, &soft, (const double[]){1e-4, 0, 0}, -1, frequency);
    assert_within(frequency[2], 2e-4 * sqrt(scree_row_stiffness(2, &soft) / disc), 1e-6);
    // Past the limit of explicit strains no step is stable.
    assert_true(scree_row_radius(2, &soft) < 1);
    const scree_lattice_material softer = {
        .radius = 1, .length = 1, .density = 1, .normal = 1, .shear = 1.3, .trace = -0.3 * 1.3};
    assert_true(scree_lattice_critical_step(SCREE_LATTICE_ROW, &softer, SCREE_STRAIN_EXPLICIT, NULL) == 0);
    assert_true(scree_lattice_critical_step(SCREE_LATTICE_ROW, &softer, SCREE_STRAIN_AT_ONCE, NULL) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frequencies_against_the_operator),
        cmocka_unit_test(critical_steps_against_the_operator),
        cmocka_unit_test(long_waves_have_the_speeds_of_the_moduli),
        cmocka_unit_test(textbook_forms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
