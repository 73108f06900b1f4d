/// Initial assemblies of spheres, growth packings and round samples in both dimensions: geometry to round-off,
/// stability of every sphere, solid fractions, isotropy, reproducibility.
#include "biaxial_config.h"
#include "state/plates.h"
#include "testing.h"

#include "prepare/prepare.h"
#include "state/body.h"

#include <stdlib.h>
#include <string.h>

typedef struct sample {
    biaxial_config c;
    scree_model model;
    scree_state state;
    double side[3]; ///< m, of the box
} sample;

static void sample_set(sample *s, int dimension, int method, int64_t count)
{
    biaxial_config_set(&s->c, count);
    s->c.config.dimension = dimension;
    if (dimension == 3) s->c.config.particles.shape = SCREE_SLOT_sphere;
    biaxial_prepare(&s->c)->method = (int)method;
    biaxial_gas(&s->c)->solid_fraction = biaxial_growth(&s->c)->solid_fraction = NAN;
    biaxial_prepare(&s->c)->aspect_ratio = 1;
    if (method == SCREE_SLOT_face_centred || method == SCREE_SLOT_body_centred || method == SCREE_SLOT_cubic)
        s->c.config.particles.distribution = SCREE_SLOT_equal;
}

static void sample_prepare(sample *s)
{
    scree_error error = {0};
    if (scree_model_build(&s->c.config, &s->model, &error)) fail_msg("%s", error.message);
    if (scree_prepare(&s->model, &s->c.stage[0], &s->state, &error)) fail_msg("%s", error.message);
    s->side[0] = -scree_plates(&s->state)[SCREE_WALL_RIGHT].position;
    s->side[1] = -scree_plates(&s->state)[s->state.dimension == 3 ? SCREE_WALL_BACK : SCREE_WALL_TOP].position;
    s->side[2] = s->state.dimension == 3 ? -scree_plates(&s->state)[SCREE_WALL_TOP].position : 0;
}

/// Contacts of body i: unit normals towards it, from bodies placed before it, and from the walls if wanted.
enum { MOST_NORMALS = 64 };
typedef struct contacts {
    double normal[MOST_NORMALS][3];
    int count;
} contacts;

static void add_contact(contacts *of, double x, double y, double z)
{
    assert_true(of->count < MOST_NORMALS);
    of->normal[of->count][0] = x;
    of->normal[of->count][1] = y;
    of->normal[of->count++][2] = z;
}

/// Coordinates are at most a hundred radii, whose unit in the last place is 1.4e-14 R, and places of rest come out of a
/// chain of a few dozen rounded points.
static const double ROUND_OFF = 1e-12;
/// Radii within which bodies count as touching: far above the round-off, far below the gaps of chance (1e-9 of a pair
/// of neighbours has a gap below 1e-9 R).
static const double TOUCHING = 1e-9;

/// Largest overlap among bodies and with walls in mean radii; with `each` not NULL the contacts of each body.
static double largest_overlap(const sample *s, contacts *each)
{
    double overlap = -1, unit = s->model.mean_radius;
    const int dimension = s->state.dimension;
    for (size_t i = 0; i < s->state.count; i++) {
        scree_vector p, q;
        scree_body_position(&s->state, i, p);
        double radius = s->state.row[i].radius;
        for (int c = 0; c < dimension; c++)
            for (int far = 0; far < 2; far++) {
                double gap = ((far ? s->side[c] - p[c] : p[c]) - radius) / unit, n[3] = {0};
                overlap = fmax(overlap, -gap);
                n[c] = far ? -1 : 1;
                bool top = far && c == dimension - 1;
                if (each && gap < TOUCHING && !top) add_contact(&each[i], n[0], n[1], n[2]);
            }
        for (size_t j = 0; j < i; j++) {
            scree_body_position(&s->state, j, q);
            double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]}, reach = radius + s->state.row[j].radius;
            if (fabs(d[0]) > 1.001 * reach || fabs(d[1]) > 1.001 * reach || fabs(d[2]) > 1.001 * reach) continue;
            double distance = scree_length(d), gap = (distance - reach) / unit;
            overlap = fmax(overlap, -gap);
            if (each && gap < TOUCHING) add_contact(&each[i], d[0] / distance, d[1] / distance, d[2] / distance);
        }
    }
    return overlap;
}

static double determinant(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Can pushes along three of the normals carry the weight? On the floor one is enough.
static bool is_stable(const contacts *of)
{
    static const double up[3] = {0, 0, 1};
    for (int a = 0; a < of->count; a++) {
        if (of->normal[a][2] == 1) return true;
        for (int b = 0; b < a; b++)
            for (int c = 0; c < b; c++) {
                const double *x = of->normal[a], *y = of->normal[b], *z = of->normal[c];
                double whole = determinant(x, y, z);
                // 1e-8: the multiplier of a support at the edge of stability, whose normals have an error of 1e-9.
                if (whole != 0 && determinant(up, y, z) / whole > -1e-8 && determinant(x, up, z) / whole > -1e-8 &&
                    determinant(x, y, up) / whole > -1e-8)
                    return true;
            }
    }
    return false;
}

static double solid_fraction(const sample *s)
{
    double solid = 0, room = 1;
    for (size_t i = 0; i < s->state.count; i++) {
        double r = s->state.row[i].radius;
        solid += s->state.dimension == 3 ? 4 * M_PI / 3 * r * r * r : M_PI * r * r;
    }
    for (int c = 0; c < s->state.dimension; c++) room *= s->side[c];
    return solid / room;
}

static void spheres_drop_and_roll_to_stable_places(void **unused)
{
    (void)unused;
    const double smallest[] = {0.5e-3, 0.2e-3, 0.999999e-3};
    for (int k = 0; k < 3; k++) {
        sample s;
        sample_set(&s, 3, SCREE_SLOT_drop_and_roll, 1500);
        biaxial_sizes(&s.c, SCREE_SLOT_uniform, smallest[k], 1e-3);
        s.c.config.seed = k + 1;
        sample_prepare(&s);
        contacts *each = calloc(s.state.count, sizeof *each);
        assert_non_null(each);
        assert_true(largest_overlap(&s, each) < ROUND_OFF);
        double supports = 0;
        for (size_t i = 0; i < s.state.count; i++) {
            if (!is_stable(&each[i])) fail_msg("sphere %zu is not stable", i);
            supports += each[i].count;
        }
        // Three supports each; those on the floor have one.
        supports /= (double)s.state.count;
        assert_true(supports > 2.7 && supports < 3.01);
        assert_true(fabs(s.side[0] - s.side[1]) == 0 && fabs(s.side[2] / s.side[0] - 1) < 0.05);
        free(each);
        scree_state_destroy(&s.state);
    }
}

/// Solid fraction in the middle: share of a lattice of points, five radii from all walls, that lies within spheres.
static double solid_fraction_inside(const sample *s)
{
    enum { POINTS = 30 };
    double margin = 5 * s->model.mean_radius;
    size_t inside = 0;
    for (int p = 0; p < POINTS * POINTS * POINTS; p++) {
        const int number[3] = {p % POINTS, p / POINTS % POINTS, p / POINTS / POINTS};
        double at[3];
        for (int c = 0; c < 3; c++) at[c] = margin + (s->side[c] - 2 * margin) * (number[c] + 0.5) / POINTS;
        for (size_t i = 0; i < s->state.count; i++) {
            scree_vector q;
            scree_body_position(&s->state, i, q);
            double d[3] = {at[0] - q[0], at[1] - q[1], at[2] - q[2]};
            if (scree_length(d) > s->state.row[i].radius) continue;
            inside++;
            break;
        }
    }
    return (double)inside / (POINTS * POINTS * POINTS);
}

/// Jodrey and Tory (1979) give 0.582 for equal spheres that drop and roll, Visscher and Bolsterli (1972) 0.58 to 0.60,
/// far from the walls.
static void dropped_spheres_are_as_dense_as_published(void **unused)
{
    (void)unused;
    sample s;
    sample_set(&s, 3, SCREE_SLOT_drop_and_roll, 4000);
    s.c.config.particles.distribution = SCREE_SLOT_equal;
    sample_prepare(&s);
    // 500 spheres in the middle: one standard error of the fraction is about 0.005.
    double inside = solid_fraction_inside(&s);
    assert_true(inside > 0.565 && inside < 0.605);
    // Walls, floor and the rough top are looser.
    assert_true(solid_fraction(&s) > 0.5 && solid_fraction(&s) < inside);
    scree_state_destroy(&s.state);
}

/// The two horizontal directions are alike: contact normals have equal second moments.
static void dropped_spheres_know_no_horizontal_direction(void **unused)
{
    (void)unused;
    sample s;
    sample_set(&s, 3, SCREE_SLOT_drop_and_roll, 3000);
    sample_prepare(&s);
    contacts *each = calloc(s.state.count, sizeof *each);
    assert_non_null(each);
    (void)largest_overlap(&s, each);
    double moment[3] = {0}, cross = 0;
    size_t normals = 0;
    for (size_t i = 0; i < s.state.count; i++)
        for (int k = 0; k < each[i].count; k++, normals++) {
            const double *n = each[i].normal[k];
            for (int c = 0; c < 3; c++) moment[c] += n[c] * n[c];
            cross += n[0] * n[1];
        }
    // 9000 normals: the standard deviation of the difference of two mean squares is about 0.005.
    assert_true(fabs(moment[0] - moment[1]) / (double)normals < 0.02);
    assert_true(fabs(cross) / (double)normals < 0.015);
    // Gravity sees to it that the vertical one differs.
    assert_true(moment[2] > 1.05 * moment[0]);
    free(each);
    scree_state_destroy(&s.state);
}

/// Boxes with one particle across, or of a given width and depth, and gravity's heap in them.
static void spheres_fill_boxes_of_given_sides(void **unused)
{
    (void)unused;
    const double sides[][2] = {{20e-3, 8e-3}, {2.01e-3, 9e-3}, {2.0001e-3, 2.0001e-3}, {12e-3, NAN}};
    for (size_t k = 0; k < sizeof sides / sizeof *sides; k++) {
        sample s;
        sample_set(&s, 3, SCREE_SLOT_drop_and_roll, 300);
        biaxial_prepare(&s.c)->width = sides[k][0];
        biaxial_prepare(&s.c)->depth = sides[k][1];
        sample_prepare(&s);
        contacts *each = calloc(s.state.count, sizeof *each);
        assert_non_null(each);
        assert_true(largest_overlap(&s, each) < ROUND_OFF);
        for (size_t i = 0; i < s.state.count; i++)
            if (!is_stable(&each[i])) fail_msg("sphere %zu is not stable", i);
        assert_true(s.side[0] == sides[k][0] && s.side[1] == (isnan(sides[k][1]) ? sides[k][0] : sides[k][1]));
        free(each);
        scree_state_destroy(&s.state);
    }
}

static void lattices_of_spheres(void **unused)
{
    (void)unused;
    const int methods[] = {SCREE_SLOT_cubic, SCREE_SLOT_face_centred, SCREE_SLOT_body_centred};
    const double inner[] = {6, 12, 8}, fraction[] = {M_PI / 6, M_PI / sqrt(18), M_PI * sqrt(3) / 8};
    // One body more across and from front to back: the ratio falls by the cube of (n + 1) / n, with n about 8.
    const double off[] = {0.15, 0.15, 0.25};
    for (int k = 0; k < 3; k++) {
        sample s;
        sample_set(&s, 3, methods[k], 1100);
        biaxial_prepare(&s.c)->aspect_ratio = 1.5;
        if (k == 1) biaxial_prepare(&s.c)->depth = 14.9e-3;
        sample_prepare(&s);
        contacts *each = calloc(s.state.count, sizeof *each);
        assert_non_null(each);
        assert_true(largest_overlap(&s, each) < ROUND_OFF);
        // Each contact counts for one of its two bodies: half the coordination number inside, fewer at the surfaces.
        double count = 0;
        for (size_t i = 0; i < s.state.count; i++) count += each[i].count;
        count /= (double)s.state.count;
        assert_true(count > 0.8 * inner[k] / 2 && count < 1.3 * inner[k] / 2);
        assert_true(fabs(s.side[2] / s.side[0] - 1.5) < off[k]);
        if (k == 1) assert_true(fabs(s.side[1] - 9 * 1.5e-3) < 1e-15); // nine of ten fit
        // Between the centres of the outer ones lie whole cells; outside of them a radius.
        if (k == 2) assert_true(fabs(remainder(s.side[0] - 1.5e-3, 1.5e-3 * 2 / sqrt(3))) < 1e-15);
        assert_true(solid_fraction(&s) > 0.8 * fraction[k] && solid_fraction(&s) < 1.001 * fraction[k]);
        free(each);
        scree_state_destroy(&s.state);
    }
}

static void gas_of_spheres(void **unused)
{
    (void)unused;
    sample s;
    sample_set(&s, 3, SCREE_SLOT_gas, 2000);
    biaxial_gas(&s.c)->solid_fraction = 0.25;
    biaxial_prepare(&s.c)->aspect_ratio = 2;
    sample_prepare(&s);
    assert_true(largest_overlap(&s, NULL) <= 0);
    // The box is made for the fraction; sums of 2000 terms.
    assert_true(fabs(solid_fraction(&s) / 0.25 - 1) < 1e-12 && fabs(s.side[2] / s.side[0] - 2) < 1e-12);
    double square[3] = {0}, cross[3] = {0}, momentum[3] = {0}, mass = 0, top = 0;
    for (size_t i = 0; i < s.state.count; i++) {
        scree_vector v, w, p;
        scree_body_motion(&s.state, i, v, w);
        scree_body_position(&s.state, i, p);
        top = fmax(top, p[2]);
        for (int c = 0; c < 3; c++) {
            square[c] += v[c] * v[c];
            cross[c] += v[c] * v[(c + 1) % 3];
            momentum[c] += s.state.row[i].mass * v[c];
            assert_true(w[c] == 0);
        }
        mass += s.state.row[i].mass;
    }
    assert_true(fabs(sqrt((square[0] + square[1] + square[2]) / 6000) / 0.1 - 1) < 1e-12);
    for (int c = 0; c < 3; c++) {
        assert_true(fabs(momentum[c]) < 1e-12 * mass * 0.1);
        // 2000 normal numbers: standard deviation of their mean square 3 %.
        assert_true(fabs(square[c] / 2000 / 0.01 - 1) < 0.15 && fabs(cross[c] / 2000 / 0.01) < 0.15);
    }
    assert_true(top > 0.95 * s.side[2]);
    scree_state_destroy(&s.state);
}

static void states_of_spheres_are_complete(void **unused)
{
    (void)unused;
    sample s;
    sample_set(&s, 3, SCREE_SLOT_gas, 200);
    s.c.config.particles.material = s.c.steel;
    sample_prepare(&s);
    for (size_t i = 0; i < s.state.count; i++) {
        const scree_row *p = &s.state.row[i];
        assert_true(s.state.turn[i].material == 0 && s.state.id[i] == i);
        assert_true(fabs(p->mass / (8e3 * 4 / 3 * M_PI * p->radius * p->radius * p->radius) - 1) < 1e-14);
        const double *x = s.state.reference[i];
        assert_true(x[0] == p->x && x[1] == p->y && x[2] == p->z);
    }
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        const double *n = scree_plates(&s.state)[w].normal;
        const int axis = w < 2 ? 2 : w < 4 ? 0 : 1;
        for (int c = 0; c < 3; c++) assert_true(n[c] == (c != axis ? 0 : w % 2 ? -1 : 1));
        assert_true(scree_plates(&s.state)[w].active == 1 && scree_plates(&s.state)[w].material == 0);
    }
    scree_state_destroy(&s.state);
}

/// Pairs of bodies that nearly touch (gap below a tenth of a radius): their directions have no preference.
static void check_isotropy(const sample *s, double tolerance)
{
    const int dimension = s->state.dimension;
    double moment[3] = {0}, pairs = 0, unit = s->model.mean_radius;
    for (size_t i = 0; i < s->state.count; i++)
        for (size_t j = 0; j < i; j++) {
            scree_vector p, q;
            scree_body_position(&s->state, i, p);
            scree_body_position(&s->state, j, q);
            double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]}, distance = scree_length(d);
            if (distance > s->state.row[i].radius + s->state.row[j].radius + 0.1 * unit) continue;
            for (int c = 0; c < 3; c++) moment[c] += d[c] * d[c] / (distance * distance);
            pairs++;
        }
    for (int c = 0; c < dimension; c++) assert_true(fabs(moment[c] / pairs - 1.0 / dimension) < tolerance);
    assert_true(pairs > (dimension == 3 ? 2.5 : 1.5) * (double)s->state.count);
}

static void growth_reaches_the_solid_fraction(void **unused)
{
    (void)unused;
    const double fraction[2][3] = {{0.5, NAN, 0.8}, {0.4, NAN, 0.55}};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 3; k++) {
            sample s;
            sample_set(&s, dimension, SCREE_SLOT_growth, 1000);
            double wanted = biaxial_growth(&s.c)->solid_fraction = fraction[dimension - 2][k];
            biaxial_prepare(&s.c)->aspect_ratio = 1.2;
            sample_prepare(&s);
            assert_true(largest_overlap(&s, NULL) <= 0);
            // The box is made for the fraction; sums of 1000 terms. Auto: 80 and 60 % less the share of the walls.
            if (isnan(wanted))
                assert_true(solid_fraction(&s) > (dimension == 3 ? 0.52 : 0.77) &&
                            solid_fraction(&s) < (dimension == 3 ? 0.6 : 0.8));
            else
                assert_true(fabs(solid_fraction(&s) / wanted - 1) < 1e-12);
            assert_true(fabs(s.side[dimension - 1] / s.side[0] - 1.2) < 1e-12);
            // About 2000 pairs in 2D, 4000 in 3D: one standard deviation of a mean square is 0.008 and 0.005; walls
            // add to that, as they line up the bodies beside them.
            if (k > 0) check_isotropy(&s, 0.04);
            scree_state_destroy(&s.state);
        }
}

static void growth_beyond_jamming_is_an_error(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample s;
        scree_error error = {0};
        sample_set(&s, dimension, SCREE_SLOT_growth, 60);
        biaxial_growth(&s.c)->solid_fraction = 0.89;
        assert_int_equal(scree_model_build(&s.c.config, &s.model, &error), SCREE_OK);
        assert_int_equal(scree_prepare(&s.model, &s.c.stage[0], &s.state, &error), SCREE_ERROR_INPUT);
        assert_string_equal(error.field, "stages.0.solid_fraction");
        assert_non_null(strstr(error.message, "ask for less"));
        assert_null(s.state.row);
    }
}

static void round_samples(void **unused)
{
    (void)unused;
    const int methods[] = {SCREE_SLOT_drop_and_roll, SCREE_SLOT_gas, SCREE_SLOT_growth};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 3; k++) {
            sample s;
            sample_set(&s, dimension, methods[k], 400);
            biaxial_prepare(&s.c)->outline = dimension == 3 ? SCREE_SAMPLE_BALL : SCREE_SAMPLE_CIRCLE;
            // As the case language leaves keys that are not used.
            biaxial_prepare(&s.c)->width = biaxial_prepare(&s.c)->aspect_ratio = 0;
            s.c.config.gravity[1].value = -9.81;
            sample_prepare(&s);
            assert_int_equal(s.state.count, 400);
            assert_true(s.model.critical_step > 0);
            // The box holds the sample: overlaps with its sides are those of bodies with each other.
            assert_true(largest_overlap(&s, NULL) < ROUND_OFF);
            double radius = s.side[0] / 2, reach = 0, moment[3] = {0};
            for (size_t i = 0; i < s.state.count; i++) {
                scree_vector p;
                scree_body_position(&s.state, i, p);
                for (int c = 0; c < dimension; c++) {
                    p[c] -= radius;
                    moment[c] += p[c];
                }
                reach = fmax(reach, scree_length(p) + s.state.row[i].radius);
            }
            assert_true(fabs(reach / radius - 1) < 1e-12);
            // No side of the ball is empty: the centre of 400 bodies lies within a few percent of the middle.
            for (int c = 0; c < dimension; c++) assert_true(fabs(moment[c] / 400) < 0.06 * radius);
            // A circle (ball) of 11 (8) mean radii cuts bodies away to half a radius' depth.
            const double dense[2][3] = {{0.7, 0.25, 0.7}, {0.4, 0.1, 0.4}};
            double share = dimension == 3 ? M_PI / 6 : M_PI / 4;
            assert_true(solid_fraction(&s) / share > dense[dimension - 2][k]);
            for (int w = 0; w < SCREE_WALL_COUNT; w++) assert_int_equal(scree_plates(&s.state)[w].active, 0);
            scree_state_destroy(&s.state);
        }
}

/// FNV-1a over positions and radii.
static uint64_t fingerprint(const scree_state *state)
{
    uint64_t hash = UINT64_C(14695981039346656037);
    for (size_t i = 0; i < state->count; i++) {
        double values[4] = {0, 0, 0, state->row[i].radius};
        scree_body_position(state, i, values);
        for (int k = 0; k < 4; k++) {
            uint64_t bits;
            memcpy(&bits, &values[k], sizeof bits);
            hash = (hash ^ bits) * UINT64_C(1099511628211);
        }
    }
    return hash;
}

/// Placing uses only arithmetic that IEEE 754 fixes to the last bit (growth: roots of the radii by pow, too), so these
/// numbers hold for every compiler and machine.
static void same_seed_same_packing_on_any_machine(void **unused)
{
    (void)unused;
    const int methods[] = {SCREE_SLOT_drop_and_roll, SCREE_SLOT_gas};
    const uint64_t expected[] = {UINT64_C(0x67d63861a78731ed), UINT64_C(0x54d585f62ee04494)};
    for (int k = 0; k < 2; k++) {
        sample s, other;
        sample_set(&s, 3, methods[k], 800);
        sample_prepare(&s);
        assert_int_equal(fingerprint(&s.state), expected[k]);
        sample_set(&other, 3, methods[k], 800);
        other.c.config.seed = 2;
        sample_prepare(&other);
        assert_true(fingerprint(&other.state) != expected[k]);
        scree_state_destroy(&s.state);
        scree_state_destroy(&other.state);
    }
    // Growth uses pow, so bits are only compared within this machine.
    sample s, other;
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample_set(&s, dimension, SCREE_SLOT_growth, 500);
        sample_set(&other, dimension, SCREE_SLOT_growth, 500);
        sample_prepare(&s);
        sample_prepare(&other);
        assert_true(fingerprint(&s.state) == fingerprint(&other.state));
        scree_state_destroy(&s.state);
        scree_state_destroy(&other.state);
    }
}

/// Every allocation fails once: an error, and nothing is kept.
static void failed_allocations_are_errors(void **unused)
{
    (void)unused;
    const int methods[] = {SCREE_SLOT_drop_and_roll, SCREE_SLOT_gas, SCREE_SLOT_growth};
    for (int k = 0; k < 6; k++) {
        sample s;
        scree_error error = {0};
        sample_set(&s, 3, methods[k % 3], 20);
        if (k >= 3) biaxial_prepare(&s.c)->outline = SCREE_SAMPLE_BALL;
        if (methods[k % 3] == SCREE_SLOT_growth) biaxial_growth(&s.c)->solid_fraction = 0.3;
        assert_int_equal(scree_model_build(&s.c.config, &s.model, &error), SCREE_OK);
        size_t before, after;
        scree_allocation_statistics(&before, NULL);
        scree_status status = SCREE_ERROR_IO;
        for (uint64_t site = 1; status; site++) {
            (void)scree_allocation_fail_after(site);
            status = scree_prepare(&s.model, &s.c.stage[0], &s.state, &error);
            (void)scree_allocation_fail_after(0);
            if (!status) break;
            assert_int_equal(status, SCREE_ERROR_IO);
            scree_allocation_statistics(&after, NULL);
            assert_int_equal(after, before);
            assert_true(site < 500);
        }
        scree_state_destroy(&s.state);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_drop_and_roll_to_stable_places),
        cmocka_unit_test(dropped_spheres_are_as_dense_as_published),
        cmocka_unit_test(dropped_spheres_know_no_horizontal_direction),
        cmocka_unit_test(spheres_fill_boxes_of_given_sides),
        cmocka_unit_test(lattices_of_spheres),
        cmocka_unit_test(gas_of_spheres),
        cmocka_unit_test(states_of_spheres_are_complete),
        cmocka_unit_test(growth_reaches_the_solid_fraction),
        cmocka_unit_test(growth_beyond_jamming_is_an_error),
        cmocka_unit_test(round_samples),
        cmocka_unit_test(same_seed_same_packing_on_any_machine),
        cmocka_unit_test(failed_allocations_are_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
