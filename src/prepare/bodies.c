/// The particles that the case lists, each at its position with its velocity, spin, radius and material.
///
/// The box begins at the origin; sides that are not given reach as far as the bodies do. Nothing is drawn at random.
#include "prepare/bodies.h"
#include "base/vectors.h"
#include "module/key_rows.h"
#include "prepare/methods.h"
#include "prepare/prepare.h"

#include <math.h>
#include <string.h>

typedef scree_listed_body listed;
static const scree_key body_keys[] = {
    KEY(listed, position, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"), .meaning = "Of its centre."),
    KEY(listed, velocity, SCREE_KEY_VECTOR, .unit = "m/s", .standard = "[0, 0]", FROM("-1e5 m/s"), TO("1e5 m/s"),
        .meaning = "At the begin."),
    KEY(listed, spin, SCREE_KEY_VECTOR, .unit = "rad/s", .standard = "[0, 0]", FROM("-1e6 rad/s"), TO("1e6 rad/s"),
        .meaning = "Angular velocity at the begin; in two dimensions [0, 0, about z]."),
    NUMBER(listed, angle, "rad", .standard = "0 degrees", FROM("-1e3 rad"), TO("1e3 rad"),
           .meaning = "By which it lies turned, counter-clockwise; in two dimensions."),
    NUMBER(listed, radius, "m", .standard = "auto", FROM("1 nm"), TO("100 m"),
           .meaning = "Radius, within the limits of `particles`; auto: the one that all particles have."),
    KEY(listed, material, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of one of the materials; auto: particles.material."),
};
static const scree_section body_table[] = {TABLE("bodies", "A particle at a given position.", body_keys)};
typedef scree_bodies_config config;
static const scree_key keys[] = {
    NUMBER(config, height, "m", .standard = "auto", FROM("1 nm"), TO("100 km"), .when = "method=bodies",
           .meaning = "Height of the box, which begins at the origin; auto: as far as the bodies reach."),
    KEY(config, bodies, SCREE_KEY_LIST, FROM("1"), TO("1000"), .sections = body_table, .section_count = 1,
        .count_offset = offsetof(config, body_count), .element_size = sizeof(listed), .when = "method=bodies",
        .meaning = "The particles, numbered from 0; as many as particles.count says, unless a stage pours "
                   "the others."),
};

/// Radius [m] of a listed body; left out: that of all particles.
static double radius_of(const scree_model *model, const scree_listed_body *body)
{
    return isnan(body->radius) ? model->species[0].radius.least : body->radius;
}

/// The others are poured.
static size_t count_of(const scree_model *model, const scree_config_stage *stage)
{
    (void)model;
    return (size_t)scree_bodies_of(stage)->body_count;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    const config *own = scree_bodies_of(stage);
    double reach[3] = {0};
    (void)error;
    for (size_t i = 0; i < packing->count; i++) {
        const scree_listed_body *body = &own->bodies[i];
        // What is drawn of it beside its radius is its shape.
        packing->radius[i] =
            radius_of(model, body) * scree_model_drawn_bound(model, i) / scree_model_drawn_radius(model, i);
        for (int c = 0; c < packing->dimension; c++) {
            packing->place[c][i] = body->position[c];
            reach[c] = fmax(reach[c], body->position[c] + packing->radius[i]);
        }
    }
    scree_box *box = &packing->box;
    if (isnan(box->width)) box->width = reach[0];
    if (packing->dimension == 3 && isnan(box->depth)) box->depth = reach[1];
    box->height = isnan(own->height) ? reach[packing->dimension - 1] : own->height;
    return SCREE_OK;
}

static int material_of(const scree_model *model, const scree_config_stage *stage, size_t index)
{
    return scree_model_material(model, scree_bodies_of(stage)->bodies[index].material);
}

static void set_moving(const scree_model *model, const scree_config_stage *stage, scree_state *state)
{
    (void)model;
    for (size_t i = 0; i < state->count; i++) {
        const scree_listed_body *body = &scree_bodies_of(stage)->bodies[i];
        scree_row *row = &state->row[i];
        row->vx = body->velocity[0];
        row->vy = body->velocity[1];
        if (state->dimension == 2) {
            row->spin = body->spin[2];
            state->angle[i] = body->angle;
            continue;
        }
        row->vz = body->velocity[2];
        state->turn[i].wx = body->spin[0];
        state->turn[i].wy = body->spin[1];
        state->turn[i].wz = body->spin[2];
    }
}

static scree_status check(const scree_model *model, const scree_config_stage *stage, scree_error *error)
{
    const config *own = scree_bodies_of(stage);
    for (int64_t i = 0; i < own->body_count; i++)
        if (scree_model_material(model, own->bodies[i].material) < 0)
            return scree_prepare_error(error, model, stage, "bodies",
                                       "a body is of a material that this case does not have");
    return SCREE_OK;
}

static bool uses(const scree_config_stage *stage, const char *material)
{
    const config *own = scree_bodies_of(stage);
    for (int64_t i = 0; i < own->body_count; i++)
        if (own->bodies[i].material && strcmp(own->bodies[i].material, material) == 0) return true;
    return false;
}

/// Top of the highest of them.
static double height_of(const scree_model *model, const scree_config_stage *stage)
{
    const config *own = scree_bodies_of(stage);
    double height = 0;
    for (int64_t i = 0; i < own->body_count; i++) {
        const scree_listed_body *body = &own->bodies[i];
        height = fmax(height, body->position[model->dimension - 1] + radius_of(model, body));
    }
    return height;
}

/// Largest relative velocity, of each with what stands too.
static double impact_speed(const scree_model *model, const scree_config_stage *stage, double fall)
{
    (void)model;
    const config *own = scree_bodies_of(stage);
    double fastest = 0;
    for (int64_t i = 0; i < own->body_count; i++)
        for (int64_t k = 0; k <= i; k++) {
            const double *a = own->bodies[i].velocity, *b = own->bodies[k].velocity;
            double way[3] = {a[0], a[1], a[2]};
            for (int c = 0; k < i && c < 3; c++) way[c] -= b[c];
            fastest = fmax(fastest, scree_length(way));
        }
    return hypot(fastest, fall);
}

static const scree_preparation preparation = {
    .periodic = true,
    .given = true,
    .sizes_box = true,
    .approaching = true,
    .check = check,
    .count = count_of,
    .uses = uses,
    .height = height_of,
    .impact_speed = impact_speed,
    .place = place,
    .material_of = material_of,
    .set_moving = set_moving,
};

const scree_module scree_module_bodies = {
    .name = "bodies",
    .meaning = "the particles that `bodies` lists, each where it says and as fast",
    .choice_of = CHOICE_OF(IS("stages.prepare.method")),
    .keys = (const scree_keys[]){KEYS_OF("stages.prepare", keys, config)},
    .keys_count = 1,
    .rules = scree_bodies_rules,
    .preparation = &preparation,
};
