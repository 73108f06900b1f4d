/// Finite elements beside a run: the closed form of two discs against its own integral, the mesh of a disc, tables of
/// CalculiX, and, where ccx is installed, a bar and two discs against closed forms.
#include "fem/disc_mesh.h"
#include "fem/solid.h"
#include "fem/solve.h"
#include "theory/line_contact.h"

#include "io_scratch.h"
#include "testing.h"

#include <math.h>
#include <string.h>

// ---- closed forms ------------------------------------------------------------------------------------------------

static const scree_line_contact source = {1e-3, 2e11, 0.35, true, 1e4};

/// Twice the integral of the strain over a radius, in steps that follow the contact: Simpson's rule on ln(z + a).
static double integrated_approach(const scree_line_contact *c)
{
    enum { STEPS = 4000 };
    const double a = scree_line_contact_half_width(c), from = log(a), to = log(a + c->radius);
    double sum = 0;
    for (int k = 0; k <= STEPS; k++) {
        const double at = exp(from + (to - from) * k / STEPS);
        sum += (k == 0 || k == STEPS ? 1 : k % 2 ? 4 : 2) * at * scree_line_contact_strain(c, at - a);
    }
    return -2 * sum * (to - from) / STEPS / 3;
}

static void the_approach_is_the_integral_of_the_strain(void **state)
{
    (void)state;
    for (int stress = 0; stress < 2; stress++)
        for (double poisson = 0; poisson < 0.5; poisson += 0.35) {
            scree_line_contact c = source;
            c.plane_stress = stress;
            c.poisson_ratio = poisson;
            // The rule's own error at 4000 steps.
            assert_true(fabs(integrated_approach(&c) / scree_line_contact_approach(&c) - 1) < 1e-10);
        }
}

static void discs_agree_with_known_numbers(void **state)
{
    (void)state;
    scree_line_contact c = source;
    const double a = scree_line_contact_half_width(&c);
    // Johnson 4.45: a^2 = 4 P R* / (pi E*) with R* = R/2 and 1/E* = 2/E; 5.6: 2 x P/(pi E) (2 ln(4R/a) - 1), up to
    // (a/R)^2.
    assert_true(fabs(a * a / (4e4 * 5e-4 / (M_PI * 1e11)) - 1) < 1e-14);
    const double johnson = 2e4 / (M_PI * 2e11) * (2 * log(4e-3 / a) - 1);
    assert_true(fabs(scree_line_contact_approach(&c) / johnson - 1) < 1e-4);
    // Plane strain is plane stress with other constants.
    scree_line_contact strain = source, other = source;
    strain.plane_stress = false;
    other.young_modulus = 2e11 / (1 - 0.35 * 0.35);
    other.poisson_ratio = 0.35 / 0.65;
    assert_true(fabs(scree_line_contact_approach(&strain) / scree_line_contact_approach(&other) - 1) < 1e-13);
    assert_true(fabs(scree_line_contact_widening(&strain) / scree_line_contact_widening(&other) - 1) < 1e-13);
    c.force = 0;
    assert_true(scree_line_contact_approach(&c) == 0 && scree_line_contact_strain(&c, 1e-6) == 0);
}

// ---- the mesh ----------------------------------------------------------------------------------------------------

/// Twice the area of an element from its eight nodes, the sides of which bend.
static double area_of(const scree_fem_disc_mesh *m, const int64_t *element)
{
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const double *a = m->place[element[k] - 1], *b = m->place[element[4 + k] - 1],
                     *c = m->place[element[(k + 1) % 4] - 1];
        // Under a parabola through three points: the chord's triangle and two thirds of what the middle adds.
        sum += a[0] * c[1] - c[0] * a[1];
        sum += 4.0 / 3 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    }
    return 0.5 * sum;
}

/// Sides are parabolas where the rim is a circle: the error falls with the fourth power of their length.
static void check_elements(const scree_fem_disc_mesh *m, double radius, int64_t elements)
{
    double area = 0;
    for (size_t e = 0; e < m->element_count; e++) {
        for (size_t k = 0; k < SCREE_FEM_NODES; k++) assert_true(!isnan(m->place[m->element[e][k] - 1][0]));
        // Corners turn to the left, none too sharp or too flat: the sine of their angles.
        for (size_t k = 0; k < 4; k++) {
            const double *a = m->place[m->element[e][(k + 3) % 4] - 1], *b = m->place[m->element[e][k] - 1],
                         *c = m->place[m->element[e][(k + 1) % 4] - 1];
            const double one[2] = {b[0] - a[0], b[1] - a[1]}, two[2] = {c[0] - b[0], c[1] - b[1]};
            const double sine = (one[0] * two[1] - one[1] * two[0]) / (hypot(one[0], one[1]) * hypot(two[0], two[1]));
            assert_true(sine > 0.4);
        }
        assert_true(area_of(m, m->element[e]) > 0);
        area += area_of(m, m->element[e]);
    }
    assert_true(fabs(area / (0.25 * M_PI * radius * radius) - 1) < 0.1 / pow((double)elements, 4));
}

static void check_lines(const scree_fem_disc_mesh *m, double radius)
{
    for (size_t k = 0; k < m->axis_count; k++) {
        const double *place = m->place[m->axis[k] - 1];
        assert_true(place[0] == 0 && (k == 0 || place[1] > m->place[m->axis[k - 1] - 1][1]));
    }
    assert_true(m->place[m->axis[0] - 1][1] == 0);
    for (size_t k = 0; k < m->flat_count; k++) {
        const double *place = m->place[m->flat[k] - 1];
        assert_true(fabs(place[1] - radius) < 1e-14 * radius && (k == 0 || place[0] > m->place[m->flat[k - 1] - 1][0]));
    }
    for (size_t k = 0; k < m->rim_count; k++) {
        const int64_t *element = m->element[m->rim[k].element - 1];
        const int side = m->rim[k].side - 1;
        const int64_t node[3] = {element[side], element[4 + side], element[(side + 1) % 4]};
        for (int n = 0; n < 3; n++) {
            const double *place = m->place[node[n] - 1];
            assert_true(fabs(hypot(place[0], place[1] - radius) / radius - 1) < 1e-14);
        }
    }
}

static void the_mesh_fills_a_quarter_of_the_disc(void **state)
{
    (void)state;
    const double radius = 2e-3;
    for (int64_t elements = 2; elements <= 12; elements += 5)
        for (double fine = 1e-5; fine < 2e-4; fine *= 10) {
            scree_fem_disc_mesh mesh;
            scree_error error;
            assert_int_equal(scree_fem_disc_mesh_make(radius, fine, elements, &mesh, &error), SCREE_OK);
            check_elements(&mesh, radius, elements);
            check_lines(&mesh, radius);
            // The first side of the rim is one of the square's.
            assert_true(fabs(mesh.place[mesh.element[0][1] - 1][0] - fine / (double)elements) < 1e-12 * fine);
            scree_fem_disc_mesh_destroy(&mesh);
        }
    scree_fem_disc_mesh mesh;
    scree_error error;
    assert_int_equal(scree_fem_disc_mesh_make(radius, 0.2 * radius, 4, &mesh, &error), SCREE_ERROR_INPUT);
}

// ---- tables ------------------------------------------------------------------------------------------------------

typedef struct seen {
    int rows;
    double total, moved, time;
    int64_t node;
} seen;

static void note(void *user, const scree_fem_row *row)
{
    seen *s = user;
    s->rows++;
    s->time = row->time;
    if (row->total && strcmp(row->set, "TOP") == 0) s->total = row->value[1];
    if (!row->total && strcmp(row->set, "SIDE") == 0) {
        s->moved = row->value[0];
        s->node = row->node;
    }
}

static void tables_of_calculix_are_read(void **state)
{
    (void)state;
    seen s = {0};
    scree_error error;
    FILE *file = fopen("fem.dat", "w");
    assert_non_null(file);
    fputs("\n                        S T E P       1\n\n"
          " total force (fx,fy,fz) for set TOP and time  0.1000000E+00\n\n"
          "       -4.798194E+00 -4.590739E+02 -1.306829E-12\n\n"
          " displacements (vx,vy,vz) for set SIDE and time  0.2000000E+00\n\n"
          "      2173  1.276635E-09 -1.825000E-08 -7.570357E-21\n",
          file);
    fclose(file);
    assert_int_equal(scree_fem_read(".", note, &s, &error), SCREE_OK);
    assert_int_equal(s.rows, 2);
    assert_true(s.total == -459.0739 && s.moved == 1.276635e-9 && s.node == 2173 && s.time == 0.2);
    assert_int_equal(remove("fem.dat"), 0);
    assert_int_equal(scree_fem_read(".", note, &s, &error), SCREE_ERROR_IO);
}

// ---- CalculiX ----------------------------------------------------------------------------------------------------

/// Ends of an elastic bar that is pressed by a ramp and then held: the wave that runs to the middle, which by symmetry
/// stands, and comes back. length: half of the bar.
static double strain_by_waves(double time, double rise, double pressure, double young, double speed, double length)
{
    double sum = 0;
    for (int k = 0; 2 * k * length / speed < time; k++) {
        const double since = time - 2 * k * length / speed;
        // Integral of the pressure.
        const double impulse = since < rise ? 0.5 * since * since / rise : since - 0.5 * rise;
        sum += (k == 0 ? 1 : k % 2 ? -2 : 2) * impulse;
    }
    return speed * pressure * sum / (young * length);
}

static void a_bar_moves_as_its_waves_say(void **state)
{
    (void)state;
    static const double time[] = {0, 2e-5, 4e-5}, pressure[] = {0, 5e6, 5e6};
    const double young = 69.995e9, density = 1570.8, speed = sqrt(young / density);
    const scree_fem_bar bar = {.width = 0.018,
                               .height = 0.04,
                               .young_modulus = young,
                               .poisson_ratio = 0,
                               .density = density,
                               .time = time,
                               .pressure = pressure,
                               .points = 3,
                               .across = 9,
                               .steps = 200};
    scree_fem_bar_result result;
    scree_error error = {0};
    double worst = 0;
    if (!scree_fem_is_there()) skip();
    const scree_status status = scree_fem_bar_solve(".", &bar, &result, &error);
    if (status) fail_msg("%s", error.message);
    assert_int_equal(result.count, 201);
    for (size_t k = 0; k < result.count; k++) {
        const double expected = strain_by_waves(result.time[k], 2e-5, 5e6, young, speed, 0.02);
        worst = fmax(worst, fabs(result.axial[k] - expected) * young / 5e6);
        assert_true(fabs(result.lateral[k]) < 1e-12);
    }
    // Steps of a sixtieth of the period, 20 elements: the kinks of the wave are rounded. Half of the mass makes it 0.2.
    assert_true(worst < 1e-2);
    print_message("%g of the pressure\n", worst);
    scree_fem_bar_result_destroy(&result);
}

static void a_damped_bar_comes_to_rest(void **state)
{
    (void)state;
    static const double time[] = {0, 1e-4, 1.5e-4}, pressure[] = {0, 5e6, 5e6};
    const scree_fem_bar bar = {.width = 0.018,
                               .height = 0.04,
                               .young_modulus = 50.32e9,
                               .poisson_ratio = 0.151,
                               .density = 1570.8,
                               .damping = 2e-6,
                               .time = time,
                               .pressure = pressure,
                               .points = 3,
                               .across = 4,
                               .steps = 100};
    scree_fem_bar_result result;
    scree_error error = {0};
    if (!scree_fem_is_there()) skip();
    assert_int_equal(scree_fem_bar_solve(".", &bar, &result, &error), SCREE_OK);
    // Uniform stress is in the space of the elements; what is left of vibrations after 0.05 ms.
    const double strain = 5e6 / 50.32e9;
    assert_true(fabs(result.axial[result.count - 1] / strain - 1) < 1e-4);
    assert_true(fabs(result.lateral[result.count - 1] / (-0.151 * strain) - 1) < 1e-3);
    scree_fem_bar_result_destroy(&result);
}

static void press_discs(bool stress, double poisson)
{
    scree_line_contact form = source;
    form.plane_stress = stress;
    form.poisson_ratio = poisson;
    const scree_fem_discs discs = {form.radius, form.young_modulus, poisson, stress, form.force, 2, 4};
    scree_fem_discs_result result;
    scree_error error = {0};
    const scree_status status = scree_fem_discs_solve(".", &discs, &result, &error);
    if (status) fail_msg("%s", error.message);
    assert_int_equal(result.count, 5);
    // Four increments: 0.1 %; the mesh with two elements over half the contact: 0.1 %.
    assert_true(fabs(result.at_force / scree_line_contact_approach(&form) - 1) < 3e-3);
    assert_true(fabs(result.widening / scree_line_contact_widening(&form) - 1) < 5e-3);
    for (size_t k = 0; k < result.axis_count; k++) {
        const double expected = scree_line_contact_strain(&form, result.depth[k]);
        // Strains of elements, over the largest.
        assert_true(fabs(result.strain[k] - expected) <
                    0.05 * fabs(scree_line_contact_strain(&form, 0)) + 0.02 * fabs(expected));
    }
    scree_fem_discs_result_destroy(&result);
}

static void discs_are_those_of_the_closed_form(void **state)
{
    (void)state;
    if (!scree_fem_is_there()) skip();
    press_discs(true, 0.35);
    press_discs(false, 0.35);
}

static void what_fails_says_so(void **state)
{
    (void)state;
    scree_error error = {0};
    FILE *deck;
    if (!scree_fem_is_there()) skip();
    assert_int_equal(scree_fem_deck_open(".", &deck, &error), SCREE_OK);
    fputs("*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D8, ELSET=NONE\n1, 1, 2, 3\n*STEP\n*STATIC\n*END STEP\n", deck);
    assert_int_equal(scree_fem_deck_solve(".", deck, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "CalculiX"));
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_scratch)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_approach_is_the_integral_of_the_strain),
        cmocka_unit_test(discs_agree_with_known_numbers),
        cmocka_unit_test(the_mesh_fills_a_quarter_of_the_disc),
        WITH_SCRATCH(tables_of_calculix_are_read),
        WITH_SCRATCH(a_bar_moves_as_its_waves_say),
        WITH_SCRATCH(a_damped_bar_comes_to_rest),
        WITH_SCRATCH(discs_are_those_of_the_closed_form),
        WITH_SCRATCH(what_fails_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
