/// Products of a specimen against the forces of the kernels, and against matrices from the source's equations.
#include "periodic_fixture.h"
#include "specimen_fixture.h"

#include "specimen/from_state.h"
#include "state/persistent.h"

// ---- against the kernels -----------------------------------------------------------------------------------------

typedef struct bonded {
    int dimension;
    bool periodic;
    double step;
    double damping; ///< ratio
} bonded;

static const double STIFFNESS = 3e5, RATIO = 0.7;

/// A shaken net whose near pairs are held at rest, so that nothing presses but the plates, by 1e-5 of a radius.
static void create_bonded(const bonded *b, periodic_sample *s)
{
    const int n = b->dimension == 2 ? 4 : 3;
    periodic_fill(s, b->dimension, n, LINEAR, 0);
    s->model.pairs[0][0] = s->model.walls[0] = linear_pair(STIFFNESS, 0, RATIO, 1e3, b->damping, 0.6 * b->damping);
    s->model.persistent.law = (scree_law_use){.law = SCREE_SLOT_linear, .option = LINEAR_HELD};
    memcpy(s->model.persistent.pairs, s->model.pairs, sizeof s->model.pairs);
    s->state.step_size = s->state.kick_size = s->state.tick = s->model.step = b->step;
    const double side = scree_cell(&s->state)->lattice[0];
    discs d = discs_create(s->state.count);
    for (size_t row = 0; row < s->state.count; row++)
        discs_add(&d, s->state.row[row].x, s->state.row[row].y, b->dimension == 3 ? s->state.row[row].z : 0,
                  s->state.row[row].radius);
    if (!b->periodic) scree_cell(&s->state)->directions = 0;
    for (uint32_t i = 0; i < d.count; i++)
        for (uint32_t j = i + 1; j < d.count; j++) {
            double square = 0;
            for (int k = 0; k < b->dimension; k++) {
                double apart = d.place[i][k] - d.place[j][k];
                if (b->periodic) apart -= side * round(apart / side);
                square += apart * apart;
            }
            const double rest[SCREE_MEMBER_CONSTANTS] = {d.radius[i] + d.radius[j] - sqrt(square), INFINITY, INFINITY};
            if (square > 2.2e-3 * 2.2e-3) continue;
            assert_int_equal(scree_persistent_add(&s->state, i, j, rest, NULL), SCREE_OK);
        }
    if (!b->periodic)
        scree_plates(&s->state)[SCREE_WALL_LEFT] =
            (scree_wall){.normal = {1, 0, 0}, .position = d.place[0][0] - d.radius[0] * (1 - 1e-5), .active = 1};
    discs_destroy(&d);
}

static double *component_velocity(periodic_sample *s, uint32_t row, int component)
{
    scree_row *body = &s->state.row[row];
    double *const plane[] = {&body->vx, &body->vy, &body->spin};
    if (s->state.dimension == 2) return plane[component];
    double *const space[] = {
        &body->vx, &body->vy, &body->vz, &s->state.turn[row].wx, &s->state.turn[row].wy, &s->state.turn[row].wz};
    return space[component];
}

static void read_forces(const periodic_sample *s, double *forces)
{
    const size_t size = s->state.dimension == 2 ? 3 : 6;
    for (uint32_t id = 0; id < s->state.count; id++) {
        const uint32_t row = scree_state_row_of(&s->state, id);
        const scree_sum_row *sum = &s->state.sum[row];
        const double force = s->state.force_quantum, torque = s->state.torque_quantum;
        double *f = forces + id * size;
        f[0] = (double)sum->fx * force;
        f[1] = (double)sum->fy * force;
        if (size == 3) {
            f[2] = (double)sum->torque * torque;
            continue;
        }
        const scree_torque_row *t = &s->state.torque[row];
        f[2] = (double)sum->fz * force;
        f[3] = (double)t->x * torque, f[4] = (double)t->y * torque, f[5] = (double)t->z * torque;
    }
}

/// Forces after a body has gone the length, or turned by the angle, `way` in one step, with `moves`; else its velocity
/// is that, and its place the old one.
static void forces_after(const bonded *b, uint32_t body, int component, double way, bool moves, double *forces)
{
    periodic_sample s;
    create_bonded(b, &s);
    const uint32_t row = scree_state_row_of(&s.state, body);
    double *const place[] = {&s.state.row[row].x, &s.state.row[row].y, &s.state.row[row].z};
    if (moves && component < b->dimension) *place[component] += way;
    *component_velocity(&s, row, component) = way / b->step;
    periodic_forces(&s);
    read_forces(&s, forces);
    periodic_destroy(&s);
}

/// Column by column, by central differences. Tolerance: kernels carry slip to second order in the way over the
/// distance, and what presses against the plate turns, both below 1e-5 of k.
static void compare_with_kernels(const bonded *b, dense_product *product, bool moves, double way, double scale)
{
    periodic_sample s;
    scree_specimen specimen;
    create_bonded(b, &s);
    periodic_forces(&s);
    assert_int_equal(scree_specimen_of_state(&s.model, &s.state, &s.work, &specimen, NULL), SCREE_OK);
    assert_true(specimen.contact_count >= specimen.body_count);
    const size_t size = scree_specimen_motions(&specimen);
    double *up = calloc(size, sizeof *up), *down = calloc(size, sizeof *down);
    dense m = dense_of(&specimen, product, size, size);
    for (uint32_t body = 0; body < s.state.count; body++)
        for (int k = 0; k < specimen.components; k++) {
            const size_t column = body * (size_t)specimen.components + (size_t)k;
            // Angles are as large as ways over a radius, torques as forces times one.
            const double each = k < b->dimension ? way : way / 1e-3, unit = k < b->dimension ? 1 : 1e-3;
            forces_after(b, body, k, each, moves, up);
            forces_after(b, body, k, -each, moves, down);
            for (size_t i = 0; i < size; i++) {
                const double force = -(up[i] - down[i]) / (2 * (moves ? each : each / b->step));
                const double arm = (int)(i % (size_t)specimen.components) < b->dimension ? 1 : 1e-3;
                if (!(fabs(force - *dense_at(&m, i, column)) <= 1e-5 * scale * unit * arm))
                    fail_msg("%dD %s: row %zu, column %zu: %.9g, kernels %.9g", b->dimension,
                             b->periodic ? "periodic" : "plate", i, column, *dense_at(&m, i, column), force);
            }
        }
    free(up);
    free(down);
    free(m.value);
    scree_specimen_destroy(&specimen);
    periodic_destroy(&s);
}

static void products_are_those_of_the_kernels(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int periodic = 0; periodic < 2; periodic++) {
            const bonded elastic = {dimension, periodic, 1e-6, 0}, viscous = {dimension, periodic, 1e-12, 0.3};
            compare_with_kernels(&elastic, scree_specimen_stiffness, true, 1e-9, STIFFNESS);
            // c of a pair of masses of some 1e-5 kg; the step is so short that springs do not stretch.
            compare_with_kernels(&viscous, scree_specimen_damping, false, 1e-15, 1);
        }
}

// ---- against equations -------------------------------------------------------------------------------------------

static const scree_compliance DISC = {.shear = 1.35 / 2e11, .trace = -0.35 * 1.35 / 2e11};
static const scree_compliance BALL = {.shear = 1.35 / 2e8, .trace = -0.35 / 2e8};

static scree_specimen irregular(int dimension, double tangential)
{
    discs d = discs_irregular(dimension, dimension == 2 ? 5 : 3);
    scree_specimen s = specimen_of(
        &d, dimension, 0.25, (discs_bond){.stiffness = {dimension == 2 ? 7e10 : 7e4, tangential}, .scatter = 0.5});
    specimen_set_compliance(&s, dimension == 2 ? DISC : BALL);
    discs_destroy(&d);
    assert_true(s.contact_count > 30);
    return s;
}

/// Rounding of sums of a few terms.
#define assert_near(value, expected, scale)                                                                            \
    do {                                                                                                               \
        const double value_ = (value), expected_ = (expected);                                                         \
        if (!(fabs(value_ - expected_) <= 1e-13 * (scale))) fail_msg("%.17g, not %.17g", value_, expected_);           \
    } while (0)

static void assert_transposed(const dense *a, const dense *b)
{
    double most = 0;
    for (size_t k = 0; k < a->rows * a->columns; k++) most = fmax(most, fabs(a->value[k]));
    assert_true(most > 0 && a->rows == b->columns && a->columns == b->rows);
    for (size_t i = 0; i < a->rows; i++)
        for (size_t j = 0; j < a->columns; j++) assert_near(*dense_at(a, i, j), *dense_at(b, j, i), most);
}

static void adjoint_products_and_symmetric_stiffness(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_specimen s = irregular(dimension, dimension == 2 ? 3e10 : 3e4);
        const size_t motions = scree_specimen_motions(&s), forces = scree_specimen_contact_forces(&s);
        dense relative = dense_of(&s, scree_specimen_relative, forces, motions);
        dense gather = dense_of(&s, scree_specimen_gather, motions, forces);
        dense moments = dense_of(&s, scree_specimen_moments, s.body_count * (size_t)s.strain_components, forces);
        dense surfaces = dense_of(&s, scree_specimen_surfaces, forces, s.body_count * (size_t)s.strain_components);
        dense stiffness = dense_of(&s, scree_specimen_stiffness, motions, motions);
        assert_transposed(&relative, &gather);
        assert_transposed(&moments, &surfaces);
        assert_transposed(&stiffness, &stiffness);
        dense *all[] = {&relative, &gather, &moments, &surfaces, &stiffness};
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) free(all[k]->value);
        scree_specimen_destroy(&s);
    }
}

/// Translations, and a rotation of the whole about the origin, stretch nothing.
static void rigid_motions_stretch_nothing(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        discs d = discs_irregular(dimension, dimension == 2 ? 5 : 3);
        scree_specimen s = specimen_of(&d, dimension, 0.25, (discs_bond){.stiffness = {1, 0.5}});
        const size_t size = (size_t)s.components;
        double *x = calloc(size * d.count, sizeof *x), *y = calloc(size * d.count, sizeof *y);
        for (size_t k = 0; k < d.count; k++) {
            const double spin[3] = {dimension == 3 ? 0.3 : 0, dimension == 3 ? -0.2 : 0, 0.5};
            double turned[3];
            scree_cross(spin, d.place[k], turned);
            for (int i = 0; i < dimension; i++) x[size * k + (size_t)i] = turned[i] + 1e-3 * (i + 1);
            if (dimension == 2) x[size * k + 2] = spin[2];
            for (int i = 0; i < 3 && dimension == 3; i++) x[size * k + 3 + (size_t)i] = spin[i];
        }
        scree_specimen_stiffness(&s, x, y);
        for (size_t k = 0; k < size * d.count; k++) assert_near(y[k], 0, 1e-2);
        // One body alone stretches something.
        x[0] += 1e-3;
        scree_specimen_stiffness(&s, x, y);
        assert_true(fabs(y[0]) > 1e-4);
        free(x);
        free(y);
        scree_specimen_destroy(&s);
        discs_destroy(&d);
    }
}

/// The normal parts of B f against the source's steps, for a normal force at each contact.
static void iterates_as_the_source_does(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_specimen s = irregular(dimension, dimension == 2 ? 3e10 : 3e4);
        const size_t width = (size_t)dimension, size = scree_specimen_contact_forces(&s);
        dense expected = dense_force_iteration(&s);
        double *f = calloc(size, sizeof *f), *g = calloc(size, sizeof *g), most = 0;
        for (size_t from = 0; from < s.contact_count; from++) {
            memset(f, 0, size * sizeof *f);
            for (size_t i = 0; i < width; i++) f[from * width + i] = s.contact[from].normal[i];
            scree_specimen_force_iteration(&s, f, g);
            for (size_t to = 0; to < s.contact_count; to++) {
                double normal = 0, square = 0;
                for (size_t i = 0; i < width; i++) {
                    normal += g[to * width + i] * s.contact[to].normal[i];
                    square += g[to * width + i] * g[to * width + i];
                }
                most = fmax(most, fabs(normal));
                assert_near(normal, *dense_at(&expected, to, from), 1);
                // As published nothing but overlaps feels the strain.
                assert_near(square, normal * normal, 1);
            }
        }
        assert_true(most > 0.1);
        free(f);
        free(g);
        free(expected.value);
        scree_specimen_destroy(&s);
    }
}

/// Force times change of distance is what the particles take up: D^-1 B is symmetric in the corrected form, and not in
/// the published one.
static void corrected_form_has_a_potential(void **unused)
{
    (void)unused;
    for (int corrected = 0; corrected < 2; corrected++) {
        scree_specimen s = irregular(2, 3e10);
        s.tangential = corrected ? SCREE_TANGENTIAL_CORRECTED : SCREE_TANGENTIAL_AS_PUBLISHED;
        const size_t size = scree_specimen_contact_forces(&s);
        dense b = dense_of(&s, scree_specimen_force_iteration, size, size);
        for (size_t column = 0; column < size; column++)
            for (size_t c = 0; c < s.contact_count; c++) {
                const scree_springs *k = &s.contact[c].stiffness;
                double *g = dense_at(&b, 2 * c, column);
                scree_specimen_along(2, &s.contact[c], 1 / k->normal, 1 / k->tangential, g, g);
            }
        double most = 0, skew = 0;
        for (size_t i = 0; i < size; i++)
            for (size_t j = 0; j < size; j++) {
                most = fmax(most, fabs(*dense_at(&b, i, j)));
                skew = fmax(skew, fabs(*dense_at(&b, i, j) - *dense_at(&b, j, i)));
            }
        if (corrected)
            assert_true(skew <= 1e-13 * most);
        else
            assert_true(skew > 0.1 * most);
        free(b.value);
        scree_specimen_destroy(&s);
    }
}

static void held_components_stay(void **unused)
{
    (void)unused;
    scree_specimen s = irregular(2, 3e10);
    const size_t size = scree_specimen_motions(&s);
    double *x = calloc(size, sizeof *x), *y = calloc(size, sizeof *y), *z = calloc(size, sizeof *z);
    for (size_t k = 0; k < size; k++) x[k] = scree_random_uniform(9, SCREE_RANDOM_TEST, k);
    s.held[3] = 1 | 32; // x and spin
    scree_specimen_stiffness(&s, x, y);
    assert_true(y[9] == 0 && y[10] != 0 && y[11] == 0);
    x[9] = x[11] = 0;
    scree_specimen_stiffness(&s, x, z);
    for (size_t k = 0; k < size; k++) assert_true(y[k] == z[k]);
    scree_specimen_accelerate(&s, y, z);
    scree_specimen_mass(&s, z, x);
    for (size_t k = 0; k < size; k++) assert_near(x[k], y[k], fabs(y[k]));
    free(x);
    free(y);
    free(z);
    scree_specimen_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_are_those_of_the_kernels), cmocka_unit_test(adjoint_products_and_symmetric_stiffness),
        cmocka_unit_test(rigid_motions_stretch_nothing),     cmocka_unit_test(iterates_as_the_source_does),
        cmocka_unit_test(corrected_form_has_a_potential),    cmocka_unit_test(held_components_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
