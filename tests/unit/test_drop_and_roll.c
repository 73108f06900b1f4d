/// Property of every deposit, over many seeds, distributions of radii and boxes, in 2D and 3D: each body is inside of
/// the box, overlaps nothing, and rests on the floor or on supports that carry its weight without friction.
///
/// Equal bodies and two sizes are the hard ones: beside a wall the centres of equal spheres lie in one plane, and in a
/// box as wide as a few radii gaps are as wide as what has to pass, all to the last bit.
#include "biaxial_config.h"
#include "state/plates.h"
#include "testing.h"

#include "base/vectors.h"
#include "prepare/prepare.h"
#include "state/body.h"

#include <string.h>

/// Coordinates are at most a few hundred radii, whose unit in the last place is 6e-14 R, and places of rest come out of
/// a chain of a few dozen rounded points.
static const double ROUND_OFF = 1e-12;
/// Radii within which bodies count as touching: far above the round-off, far below the gaps of chance.
static const double TOUCHING = 1e-9;
/// Multiplier of a support at the edge of stability, whose normals have an error of TOUCHING.
static const double EDGE = 1e-8;

enum { SEEDS = 24, COUNT = 120, MOST_CONTACTS = 32 };

typedef struct sizes {
    const char *name;
    int distribution;
    double smallest; ///< m; the largest is 1 mm
} sizes;

typedef struct box {
    double aspect_ratio, width, depth; ///< 1, m, m
} box;

static const sizes all_sizes[] = {
    {"uniform", SCREE_SLOT_uniform, 0.5e-3},
    {"narrow", SCREE_SLOT_uniform, 0.999999e-3},
    {"equal", SCREE_SLOT_equal, 1e-3},
    {"two sizes 1:2", SCREE_SLOT_two_sizes, 0.5e-3},
    {"two sizes 1:5", SCREE_SLOT_two_sizes, 0.2e-3},
};
/// By aspect ratio; a few radii wide; as wide as the largest body; so wide that all find a place on the floor.
static const box boxes[] = {{1, NAN, NAN},   {3, NAN, NAN},   {1, 8e-3, 4e-3}, {1, 10.2e-3, 7e-3},
                            {1, 2e-3, 9e-3}, {1, 2e-3, 2e-3}, {1, 3e-3, 3e-3}, {1, 32e-3, 32e-3}};

/// Unit normals, towards a body, of what it touches.
typedef struct contacts {
    double normal[MOST_CONTACTS][3];
    int count;
} contacts;

static void add_contact(contacts *of, const double normal[3])
{
    assert_true(of->count < MOST_CONTACTS);
    memcpy(of->normal[of->count++], normal, sizeof *of->normal);
}

static double determinant(const double a[3], const double b[3], const double c[3])
{
    double across[3];
    scree_cross(b, c, across);
    return scree_dot(a, across);
}

/// Can pushes along three of the normals carry the weight? On the floor one is enough.
static bool is_stable(const contacts *of)
{
    static const double up[3] = {0, 0, 1};
    for (int a = 0; a < of->count; a++) {
        const double *x = of->normal[a];
        if (x[2] == 1) return true;
        for (int b = 0; b < a; b++)
            for (int c = 0; c < b; c++) {
                const double *y = of->normal[b], *z = of->normal[c];
                double whole = determinant(x, y, z);
                if (whole != 0 && determinant(up, y, z) / whole > -EDGE && determinant(x, up, z) / whole > -EDGE &&
                    determinant(x, y, up) / whole > -EDGE)
                    return true;
            }
    }
    return false;
}

/// Centre with the height as its third coordinate, in 2D too.
static void centre_of(const scree_state *state, size_t i, double out[3])
{
    scree_vector at = {0};
    scree_body_position(state, i, at);
    memcpy(out, (const double[3]){at[0], state->dimension == 3 ? at[1] : 0, at[state->dimension - 1]},
           sizeof(double[3]));
}

/// Walls; in 2D nothing moves along y.
static void touch_walls(const scree_state *state, const double at[3], double radius, double unit, contacts *of)
{
    const int walls[3][2] = {
        {SCREE_WALL_LEFT, SCREE_WALL_RIGHT}, {SCREE_WALL_FRONT, SCREE_WALL_BACK}, {SCREE_WALL_BOTTOM, SCREE_WALL_TOP}};
    for (int axis = 0; axis < 3; axis++)
        for (int far = 0; far < 2; far++) {
            double normal[3] = {0};
            normal[axis] = far ? -1 : 1;
            bool plane = state->dimension == 2 && axis == 1;
            double gap =
                plane ? 0 : (normal[axis] * at[axis] - scree_plates(state)[walls[axis][far]].position - radius) / unit;
            if (gap < -ROUND_OFF) fail_msg("outside of wall %d by %g radii", walls[axis][far], -gap);
            if (gap < TOUCHING && (axis < 2 || !far)) add_contact(of, normal);
        }
}

static void check_body(const scree_state *state, size_t i, double unit)
{
    contacts of = {.count = 0};
    double at[3], radius = state->row[i].radius;
    centre_of(state, i, at);
    touch_walls(state, at, radius, unit, &of);
    // A body rests on those that were placed before it.
    for (size_t j = 0; j < i; j++) {
        double other[3], reach = radius + state->row[j].radius;
        centre_of(state, j, other);
        double way[3] = {at[0] - other[0], at[1] - other[1], at[2] - other[2]};
        if (scree_dot(way, way) > 1.001 * reach * reach) continue;
        double distance = sqrt(scree_dot(way, way)), gap = (distance - reach) / unit;
        if (gap < -ROUND_OFF) fail_msg("bodies %zu and %zu overlap by %g radii", i, j, -gap);
        for (int c = 0; c < 3; c++) way[c] /= distance;
        if (gap < TOUCHING) add_contact(&of, way);
    }
    if (!is_stable(&of)) fail_msg("body %zu is not stable", i);
}

static void check_deposits(int dimension)
{
    for (size_t s = 0; s < sizeof all_sizes / sizeof *all_sizes; s++)
        for (size_t b = 0; b < sizeof boxes / sizeof *boxes; b++)
            for (int64_t seed = 1; seed <= SEEDS; seed++) {
                biaxial_config c;
                scree_model model;
                scree_state state;
                scree_error error = {0};
                biaxial_config_set(&c, COUNT);
                c.config.seed = seed;
                c.config.dimension = dimension;
                if (dimension == 3) c.config.particles.shape = SCREE_SLOT_sphere;
                biaxial_sizes(&c, all_sizes[s].distribution, all_sizes[s].smallest, 1e-3);
                biaxial_prepare(&c)->aspect_ratio = boxes[b].aspect_ratio;
                biaxial_prepare(&c)->width = boxes[b].width;
                biaxial_prepare(&c)->depth = boxes[b].depth;
                check(scree_model_build(&c.config, &model, &error), &error);
                check(scree_prepare(&model, &c.stage[0], &state, &error), &error);
                assert_int_equal(state.count, COUNT);
                for (size_t i = 0; i < state.count; i++) check_body(&state, i, model.mean_radius);
                scree_state_destroy(&state);
            }
}

static void spheres_rest_inside_of_the_box(void **unused)
{
    (void)unused;
    check_deposits(3);
}

static void discs_rest_inside_of_the_box(void **unused)
{
    (void)unused;
    check_deposits(2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_rest_inside_of_the_box),
        cmocka_unit_test(discs_rest_inside_of_the_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
