/// The model: constants against closed forms, resolved defaults, errors with their fields, and the critical step
/// against the largest eigenvalue of assembled lattices and packings.
#include "biaxial_config.h"
#include "boundary/membrane.h"
#include "integrate/two_timescales.h"
#include "law_choice.h"
#include "own_config.h"
#include "testing.h"

#include "model/critical_step.h"
#include "prepare/prepare.h"
#include "theory/restitution.h"

#include <stdlib.h>
#include <string.h>

/// Round-off of a few operations.
#define assert_close(a, b) assert_true(fabs((a) / (b)-1) < 1e-13)

static void test_pair_constants(void **unused)
{
    (void)unused;
    biaxial_config c;
    scree_model model;
    biaxial_config_set(&c, 983);
    c.config.contact.law = SCREE_SLOT_hertz_mindlin;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    // Like bodies: P's plane strain modulus E / (2 (1 - nu^2)) is 16.4835 GPa; 8 Gbar = 4 G / (2 - nu).
    double shear = 30e9 / 2.6;
    assert_true(fabs(model.pairs[0][0].value[HERTZ_NORMAL] * 0.75 / 16.4835e9 - 1) < 1e-5);
    assert_close(model.pairs[0][0].value[HERTZ_TANGENTIAL], 4 * shear / 1.7);
    assert_close(model.pairs[0][0].value[HERTZ_DAMPING], scree_damping_from_restitution(0.2));
    // Unlike bodies: compliances add; the smaller friction and restitution; symmetric.
    double steel_shear = 200e9 / 2.5;
    assert_close(1 / model.pairs[0][1].value[HERTZ_NORMAL], 0.75 * (0.91 / 30e9 + 0.9375 / 200e9));
    assert_close(1 / model.pairs[0][1].value[HERTZ_TANGENTIAL], (1.7 / shear + 1.75 / steel_shear) / 8);
    assert_true(model.pairs[0][1].value[SCREE_FRICTION] == 0.3);
    assert_true(model.pairs[0][1].value[HERTZ_DAMPING] == model.pairs[0][0].value[HERTZ_DAMPING]);
    assert_memory_equal(&model.pairs[0][1], &model.pairs[1][0], sizeof model.pairs[0][1]);
    // Plates: the grain's friction unless the material has another one for them.
    assert_true(model.walls[0].value[SCREE_FRICTION] == 0.45 && model.walls[1].value[SCREE_FRICTION] == 0.1);
    assert_true(model.walls[0].value[HERTZ_NORMAL] == model.pairs[0][0].value[HERTZ_NORMAL]);
}

/// Plates and walls of another material, and rigid ones: the closed forms of the pair, and of the grain's compliance
/// alone.
static void test_walls_have_materials(void **unused)
{
    (void)unused;
    biaxial_config c;
    scree_model model;
    scree_error error;
    char rigid[] = "rigid", steel[] = "steel", unknown[] = "stel";
    biaxial_config_set(&c, 983);
    c.config.contact.law = SCREE_SLOT_hertz_mindlin;
    scree_config_wall walls[3] = {{.material = steel, .friction = NAN},
                                  {.material = rigid, .friction = NAN},
                                  {.material = NULL, .friction = 0.07}};
    c.config.walls = walls;
    c.config.wall_count = 3;
    c.config.materials[0].wall_material = rigid;
    assert_int_equal(scree_model_build(&c.config, &model, &error), SCREE_OK);
    const double shear = 30e9 / 2.6;
    const scree_pair_constants *like = &model.pairs[0][0], *on_steel = &model.surfaces[0][0], *plate = &model.walls[0];
    assert_close(plate->value[HERTZ_NORMAL], 2 * like->value[HERTZ_NORMAL]);
    assert_close(plate->value[HERTZ_TANGENTIAL], 8 * shear / 1.7);
    assert_true(plate->value[HERTZ_DAMPING] == like->value[HERTZ_DAMPING] && plate->value[SCREE_FRICTION] == 0.45);
    assert_memory_equal(plate, &model.surfaces[1][0], sizeof *plate);
    // A wall's own friction holds, and the rest is that of plates.
    assert_true(model.surfaces[2][0].value[SCREE_FRICTION] == 0.07 &&
                model.surfaces[2][0].value[HERTZ_NORMAL] == plate->value[HERTZ_NORMAL]);
    assert_true(on_steel->value[HERTZ_NORMAL] == model.pairs[0][1].value[HERTZ_NORMAL] &&
                on_steel->value[SCREE_FRICTION] == 0.3);
    // What is said of the friction on plates holds on walls of any material.
    c.config.materials[0].wall_friction = 0.2;
    assert_int_equal(scree_model_build(&c.config, &model, &error), SCREE_OK);
    assert_true(plate->value[SCREE_FRICTION] == 0.2 && on_steel->value[SCREE_FRICTION] == 0.2);
    scree_model slippery = scree_model_with_friction(&model, 0.01);
    assert_true(slippery.walls[0].value[SCREE_FRICTION] == 0.01 &&
                slippery.surfaces[0][0].value[SCREE_FRICTION] == 0.01 &&
                slippery.surfaces[2][0].value[SCREE_FRICTION] == 0.01);
    walls[0].material = unknown;
    assert_int_equal(scree_model_build(&c.config, &model, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, "walls.0.material");
}

static void test_resolved_defaults(void **unused)
{
    (void)unused;
    biaxial_config c;
    scree_model model;
    biaxial_config_set(&c, 983);
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    assert_close(model.mean_radius, 0.75e-3);
    assert_close(model.thickness, 1.5e-3);
    assert_close(model.reference_velocity, 7.5e-6);
    assert_close(model.step, 0.5 * model.critical_step);
    // P 2.B3; see test_theory.c for the tolerance.
    assert_true(fabs(model.phi / 1.1748e-4 - 1) < 0.03);
    assert_true(fabs(model.psi - 0.02255) < 1e-5);

    // Two sizes are equally frequent: <R^2> = (0.25 + 1) / 2 mm^2 instead of 7/12; equal discs have the mean radius.
    double phi = model.phi;
    c.config.particles.distribution = SCREE_SLOT_two_sizes;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    assert_close(model.phi / phi, 0.625 / (7.0 / 12.0));
    c.config.particles.distribution = SCREE_SLOT_equal;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    assert_close(model.phi / phi, 0.5625 / (7.0 / 12.0));
    assert_true(model.radius_min == model.radius_max && model.radius_min == model.mean_radius);

    c.config.stage_count = 2;
    c.config.contact.reference_velocity = 1e-5;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    assert_true(isnan(model.phi) && isnan(model.psi) && model.reference_velocity == 1e-5);
}

static void test_model_with_friction(void **unused)
{
    (void)unused;
    biaxial_config c;
    scree_model model;
    biaxial_config_set(&c, 983);
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    scree_model slippery = scree_model_with_friction(&model, 0.01), same = scree_model_with_friction(&model, NAN);
    assert_true(slippery.pairs[0][1].value[SCREE_FRICTION] == 0.01 && slippery.walls[1].value[SCREE_FRICTION] == 0.01);
    assert_true(slippery.pairs[0][1].value[HERTZ_NORMAL] == model.pairs[0][1].value[HERTZ_NORMAL]);
    assert_true(same.pairs[0][1].value[SCREE_FRICTION] == 0.3 && same.walls[1].value[SCREE_FRICTION] == 0.1);
}

static void expect_input_error(const biaxial_config *c, const char *field, const char *part)
{
    scree_model model;
    scree_error error;
    assert_int_equal(scree_model_build(&c->config, &model, &error), SCREE_ERROR_INPUT);
    assert_int_equal(error.status, SCREE_ERROR_INPUT);
    assert_string_equal(error.field, field);
    if (!strstr(error.message, part)) fail_msg("'%s' is not in '%s'", part, error.message);
    assert_int_equal(scree_model_build(&c->config, &model, NULL), SCREE_ERROR_INPUT);
}

static void test_errors_name_their_field(void **unused)
{
    (void)unused;
    biaxial_config c;
    biaxial_config_set(&c, 983);
    char granite[] = "granite";
    c.config.particles.material = granite;
    expect_input_error(&c, "particles.material", "granite");
    biaxial_config_set(&c, 983);
    c.material[1].name = c.quartz;
    expect_input_error(&c, "materials.1.name", "same name");
    biaxial_config_set(&c, 983);
    c.config.material_count = 17;
    expect_input_error(&c, "materials", "17");
    biaxial_config_set(&c, 983);
    c.config.contact.law = SCREE_SLOT_hertz_mindlin;
    biaxial_material(&c, 1)->restitution = 0;
    expect_input_error(&c, "materials.1.restitution", "above 0");
    biaxial_config_set(&c, 983);
    biaxial_sizes(&c, SCREE_SLOT_uniform, 2e-3, 1e-3);
    expect_input_error(&c, "particles.radius_min", "above radius_max");
    biaxial_config_set(&c, 983);
    c.config.stage_count = 2;
    expect_input_error(&c, "contact.reference_velocity", "loading stage");
    biaxial_config_set(&c, 983);
    biaxial_prepare(&c)->method = SCREE_SLOT_hexagonal;
    expect_input_error(&c, "stages.0.method", "equal");
    biaxial_config_set(&c, 983);
    biaxial_prepare(&c)->width = 1.9e-3;
    expect_input_error(&c, "stages.0.width", "does not fit");
}

/// P runs at 1e-5 s. A step above the critical one is refused, and the value offered is accepted.
static void test_step_against_the_critical_one(void **unused)
{
    (void)unused;
    biaxial_config c;
    scree_model model;
    scree_error error;
    for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_MINDLIN; law++) {
        biaxial_config_set(&c, 983);
        c.config.contact.law = law_slot((law_choice)law);
        c.config.integrator.step = 1e-5;
        c.config.integrator.step_fraction = NAN; // as the case language leaves it when a step is given
        assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
        assert_true(model.step == 1e-5);
        c.config.integrator.step = 1.001 * model.critical_step;
        expect_input_error(&c, "integrator.step", "critical step");
        (void)!scree_model_build(&c.config, &model, &error);
        const char *offer = strstr(error.message, "give ");
        assert_non_null(offer);
        c.config.integrator.step = strtod(offer + strlen("give "), NULL);
        assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
        // Two significant digits, rounded down from half the critical step: at most 10 % below it.
        assert_true(model.step <= 0.5 * model.critical_step && model.step > 0.45 * model.critical_step);
    }
}

/// Every kind of load gives a finite step, and more load a smaller one.
static void test_critical_step_of_other_loads(void **unused)
{
    (void)unused;
    biaxial_config c;
    scree_model model;
    biaxial_config_set(&c, 983);
    c.config.contact.law = SCREE_SLOT_hertz_mindlin;
    c.config.stage_count = 1;
    c.material[0].density = 2675;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    double by_guard = model.critical_step;
    c.config.gravity[1].value = -9.81;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    double by_weight = model.critical_step;
    c.config.gravity[1].value *= 8;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    // k ~ f^(1/3) and c ~ sqrt(k): the step goes as f^(-1/6), exactly.
    assert_close(by_weight / model.critical_step, sqrt(2));
    assert_true(by_guard > 0 && by_guard < by_weight);

    c.config.gravity[1].value = 0;
    biaxial_prepare(&c)->method = SCREE_SLOT_gas;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    double slow = model.critical_step;
    biaxial_gas(&c)->velocity *= 32;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    // k ~ d^0.5 ~ v^0.4 and c ~ sqrt(k): the step goes as v^(-1/5), exactly.
    assert_close(slow / model.critical_step, 2);
}

// ---- the critical step against assembled systems -----------------------------------------------------------------

typedef struct link {
    size_t i, j;
    double normal[2];
} link;

/// Discs with links of one tangent between those that touch, free of walls.
typedef struct assembly {
    size_t count, links;
    double *mass; ///< per degree of freedom: x, y, R angle
    link *link;
    scree_contact_tangent tangent;
} assembly;

/// Links between discs of a prepared state that are closer than `gap` times the sum of their radii; the lightest has
/// mass 1.
static assembly assemble(const scree_state *state, scree_contact_tangent tangent)
{
    assembly a = {.count = state->count, .tangent = tangent};
    a.mass = calloc(3 * a.count, sizeof *a.mass);
    a.link = calloc(4 * a.count, sizeof *a.link);
    double least = INFINITY;
    for (size_t i = 0; i < a.count; i++) least = fmin(least, state->row[i].mass);
    for (size_t i = 0; i < a.count; i++) {
        const scree_row *p = &state->row[i];
        a.mass[3 * i] = a.mass[3 * i + 1] = p->mass / least;
        a.mass[3 * i + 2] = p->mass / least / 2;
        for (size_t j = 0; j < i; j++) {
            const scree_row *q = &state->row[j];
            double dx = p->x - q->x, dy = p->y - q->y, distance = sqrt(dx * dx + dy * dy);
            if (distance < (p->radius + q->radius) * (1 + 1e-9))
                a.link[a.links++] = (link){i, j, {dx / distance, dy / distance}};
        }
    }
    return a;
}

static void disassemble(assembly *a)
{
    free(a->mass);
    free(a->link);
}

/// force += (normal n n + tangential t t) of all links applied to u.
static void apply(const assembly *a, double normal, double tangential, const double *u, double *force)
{
    for (size_t k = 0; k < a->links; k++) {
        const link *l = &a->link[k];
        const double *p = u + 3 * l->i, *q = u + 3 * l->j, nx = l->normal[0], ny = l->normal[1];
        double fn = normal * (nx * (p[0] - q[0]) + ny * (p[1] - q[1]));
        double ft = tangential * (-ny * (p[0] - q[0]) + nx * (p[1] - q[1]) - p[2] - q[2]);
        double f[3] = {fn * nx - ft * ny, fn * ny + ft * nx, -ft};
        for (int c = 0; c < 2; c++) {
            force[3 * l->i + (size_t)c] += f[c];
            force[3 * l->j + (size_t)c] -= f[c];
        }
        force[3 * l->i + 2] += f[2];
        force[3 * l->j + 2] += f[2];
    }
}

/// Largest eigenvalue of M^-1 (dt^2/4 K + dt/2 C) by power iteration: 1 at the critical step. From below, within 1e-3.
static double stability(const assembly *a, double dt)
{
    size_t n = 3 * a->count;
    double *u = calloc(n, sizeof *u), *f = calloc(n, sizeof *f), eigenvalue = 0;
    const scree_contact_tangent *t = &a->tangent;
    for (size_t i = 0; i < n; i++) u[i] = sin(1.0 + 7.0 * (double)(i * i % 1009));
    for (int iteration = 0; iteration < 1000; iteration++) {
        memset(f, 0, n * sizeof *f);
        apply(a, dt * dt / 4 * t->normal_stiffness + dt / 2 * t->normal_damping,
              dt * dt / 4 * t->tangential_stiffness + dt / 2 * t->tangential_damping, u, f);
        double product = 0, norm = 0;
        for (size_t i = 0; i < n; i++) {
            product += u[i] * f[i];
            norm += u[i] * u[i] * a->mass[i];
        }
        eigenvalue = product / norm;
        for (size_t i = 0; i < n; i++) u[i] = f[i] / a->mass[i] / sqrt(norm);
    }
    free(u);
    free(f);
    return eigenvalue;
}

static double true_critical_step(const assembly *a)
{
    double low = 0, high = 10;
    for (int halving = 0; halving < 14; halving++) {
        double middle = (low + high) / 2;
        if (stability(a, middle) < 1)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/// Growth of a random motion over many steps of the scheme itself.
static double march(const assembly *a, double dt)
{
    size_t n = 3 * a->count;
    double *x = calloc(n, sizeof *x), *v = calloc(n, sizeof *v), *f = calloc(n, sizeof *f), largest = 0;
    const scree_contact_tangent *t = &a->tangent;
    for (size_t i = 0; i < n; i++) v[i] = sin(1.0 + 7.0 * (double)(i * i % 1009));
    for (int step = 0; step < 2000; step++) {
        memset(f, 0, n * sizeof *f);
        apply(a, -t->normal_stiffness, -t->tangential_stiffness, x, f);
        apply(a, -t->normal_damping, -t->tangential_damping, v, f);
        for (size_t i = 0; i < n; i++) {
            v[i] += dt * f[i] / a->mass[i];
            x[i] += dt * v[i];
        }
    }
    for (size_t i = 0; i < n; i++) largest = fmax(largest, fabs(v[i]));
    free(x);
    free(v);
    free(f);
    return largest;
}

static void prepare_assembly(int method, int64_t count, scree_state *state)
{
    biaxial_config c;
    scree_model model;
    biaxial_config_set(&c, count);
    biaxial_prepare(&c)->method = method;
    biaxial_prepare(&c)->aspect_ratio = 1;
    if (method != SCREE_SLOT_drop_and_roll) c.config.particles.distribution = SCREE_SLOT_equal;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    assert_int_equal(scree_prepare(&model, &c.stage[0], state, NULL), SCREE_OK);
}

/// k_n = 1, k_t as for nu = 0.3, and damping from none to that of restitution 0.2; or P's damping without tangential
/// spring.
static const scree_contact_tangent TANGENTS[] = {
    {.normal_stiffness = 1},
    {.normal_stiffness = 1, .tangential_stiffness = 0.82},
    {.normal_stiffness = 1, .normal_damping = 0.1, .tangential_stiffness = 0.82, .tangential_damping = 0.1},
    {.normal_stiffness = 1, .normal_damping = 0.95, .tangential_stiffness = 0.82, .tangential_damping = 1.06},
    {.normal_stiffness = 1, .normal_damping = 3},
};

/// The closed form is the lattice's. The finite one is slower because
/// of its free edges, over 14 rows by about (pi/14)^2 / 4 = 1.3 % in the eigenvalue, which is half of that in the step
/// without damping and all of it in strong damping.
static void test_critical_step_of_the_lattice(void **unused)
{
    (void)unused;
    scree_state state;
    prepare_assembly(SCREE_SLOT_hexagonal, 200, &state);
    for (size_t k = 0; k < sizeof TANGENTS / sizeof *TANGENTS; k++) {
        assembly a = assemble(&state, TANGENTS[k]);
        double ratio = true_critical_step(&a) / scree_critical_step_lattice(2, &TANGENTS[k], 1, NULL);
        assert_true(ratio > 0.999 && ratio < 1.015);
        disassemble(&a);
    }
    scree_state_destroy(&state);
}

/// A random packing of 1:2 discs with contacts as stiff as those of the lattice of its smallest discs stands a larger
/// step. The upper limit says that the estimate is no idle one; it is what this packing shows, rounded up.
static void test_lattice_is_faster_than_a_random_packing(void **unused)
{
    (void)unused;
    scree_state state;
    prepare_assembly(SCREE_SLOT_drop_and_roll, 300, &state);
    for (size_t k = 0; k < sizeof TANGENTS / sizeof *TANGENTS; k++) {
        assembly a = assemble(&state, TANGENTS[k]);
        double ratio = true_critical_step(&a) / scree_critical_step_lattice(2, &TANGENTS[k], 1, NULL);
        assert_true(ratio > 1 && ratio < 2.5);
        disassemble(&a);
    }
    scree_state_destroy(&state);
}

/// M - dt/2 C - dt^2/4 K positive definite is the stability limit of the scheme: it calms 2 % below and explodes 2 %
/// above.
static void test_stability_limit_of_the_scheme(void **unused)
{
    (void)unused;
    scree_state state;
    prepare_assembly(SCREE_SLOT_hexagonal, 60, &state);
    for (size_t k = 2; k < 5; k++) {
        assembly a = assemble(&state, TANGENTS[k]);
        double exact = true_critical_step(&a);
        assert_true(march(&a, 0.98 * exact) < 10);
        assert_true(march(&a, 1.02 * exact) > 1e6);
        disassemble(&a);
    }
    scree_state_destroy(&state);
}

/// Radius, stiffness of the springs and the largest step of a membrane.
static void test_membrane(void **unused)
{
    (void)unused;
    biaxial_config c;
    scree_model model;
    scree_error error;
    biaxial_config_set(&c, 983);
    c.stage[2].boundary = SCREE_SLOT_membrane;
    own_block of_boundary = {0};
    c.config.boundary.own = &of_boundary;
    scree_membrane_config *membrane = OWN(&of_boundary, scree_membrane_config, membrane, "boundary");
    *membrane = (scree_membrane_config){.membrane_radius = NAN, .membrane_stiffness = 1e4};
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    assert_close(scree_membrane_numbers_of(&model)->radius, 1.25 * 0.75e-3);
    assert_close(scree_membrane_numbers_of(&model)->stiffness, 1e4);
    c.config.dimension = 3;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    // A triangular net of springs k is a sheet of 2 k / sqrt(3).
    assert_close(scree_membrane_numbers_of(&model)->radius, 0.75 * 0.75e-3);
    assert_close(2 / sqrt(3) * scree_membrane_numbers_of(&model)->stiffness, 1e4);
    // Not smaller than every grain.
    biaxial_sizes(&c, SCREE_SLOT_uniform, 0.9e-3, 1e-3);
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    assert_close(scree_membrane_numbers_of(&model)->radius, 0.9e-3);
    biaxial_sizes(&c, SCREE_SLOT_uniform, 0.5e-3, 1e-3);
    // A quarter of the radius of spheres that touch each other and a plate passes between them.
    membrane->membrane_radius = 1.99e-3;
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    membrane->membrane_radius = 2.01e-3;
    assert_int_equal(scree_model_build(&c.config, &model, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, "boundary.membrane_radius");
    // The fastest oscillation; the large step of two timescales counts.
    membrane->membrane_radius = NAN;
    c.config.integrator.step = 1e-6;
    double mass = model.density[0] * 4 / 3 * M_PI * pow(0.5625e-3, 3), limit = mass / 2 / (1e-6 * 1e-6);
    membrane->membrane_stiffness = 0.99 * limit * 2 / sqrt(3);
    assert_int_equal(scree_model_build(&c.config, &model, NULL), SCREE_OK);
    membrane->membrane_stiffness *= 1.02;
    assert_int_equal(scree_model_build(&c.config, &model, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, "boundary.membrane_stiffness");
    membrane->membrane_stiffness /= 1.02;
    c.config.integrator.scheme = SCREE_SLOT_two_timescales;
    own_block block = {0};
    c.config.integrator.own = &block;
    *OWN(&block, scree_two_timescales_config, two_timescales, "integrator") =
        (scree_two_timescales_config){.repeats = 1, .large_multiple = 2, .small_steps = 1};
    assert_int_equal(scree_model_build(&c.config, &model, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, "boundary.membrane_stiffness");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_membrane),
        cmocka_unit_test(test_pair_constants),
        cmocka_unit_test(test_walls_have_materials),
        cmocka_unit_test(test_resolved_defaults),
        cmocka_unit_test(test_model_with_friction),
        cmocka_unit_test(test_errors_name_their_field),
        cmocka_unit_test(test_step_against_the_critical_one),
        cmocka_unit_test(test_critical_step_of_other_loads),
        cmocka_unit_test(test_critical_step_of_the_lattice),
        cmocka_unit_test(test_lattice_is_faster_than_a_random_packing),
        cmocka_unit_test(test_stability_limit_of_the_scheme),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
