/// Spheres among walls of a case, with the real search, contacts and schemes, without stages.
#ifndef SCREE_TESTS_WALL_FIXTURE_H
#define SCREE_TESTS_WALL_FIXTURE_H

#include "sphere_fixture.h"
#include "state/case_walls.h"

#include "measure/measure.h"
#include "search/neighbours.h"
#include "shape/stl.h"
#include "shape/wall_keys.h"
#include "shape/wall_set.h"

#include <stdio.h>
#include <unistd.h>

#define assert_near(value, expected, tolerance)                                                                        \
    do {                                                                                                               \
        double near_a = (value), near_b = (expected), near_t = (tolerance);                                            \
        if (!(fabs(near_a - near_b) <= near_t))                                                                        \
            fail_msg("line %d: %.17g is not %.17g within %.3g", __LINE__, near_a, near_b, near_t);                     \
    } while (0)

/// What a wall says, whatever its shape: until the world starts.
typedef struct world_keys {
    int shape;
    char *name;
    double point[3], normal[3];
    double lower[3], upper[3];
    double start[3], end[3];
    double radius, radius_start, radius_end;
    int side, ends;
    char *file;
    double scale, at[3], smooth;
    char *material;
    double friction;
    scree_schedule velocity[3];
    double spin[3], centre[3];
} world_keys;

/// The struct of a shape.
typedef union world_shape {
    scree_plane_keys plane;
    scree_box_keys box;
    scree_round_keys round;
    scree_mesh_keys mesh;
} world_shape;

typedef struct world {
    scree_config config;
    world_keys wall[4];
    world_shape shape[4];
    scree_config_wall config_wall[4];
    fixture f; ///< its config is not used
} world;

/// A quiet wall of a shape, bodies inside, friction of the material.
static inline world_keys *world_wall(world *w, int shape)
{
    world_keys *wall = &w->wall[w->config.wall_count++];
    *wall = (world_keys){.shape = shape,
                         .name = "wall",
                         .side = SCREE_SIDE_INSIDE,
                         .ends = SCREE_ENDS_CLOSED,
                         .scale = 1,
                         .smooth = M_PI / 12,
                         .friction = NAN};
    return wall;
}

static inline void world_copy(double to[3], const double from[3])
{
    memcpy(to, from, 3 * sizeof *to);
}

/// Puts what the walls say into the config.
static inline void world_say(world *w)
{
    for (int64_t k = 0; k < w->config.wall_count; k++) {
        const world_keys *from = &w->wall[k];
        world_shape *shape = &w->shape[k];
        if (from->shape == SCREE_SLOT_plane) {
            world_copy(shape->plane.point, from->point);
            world_copy(shape->plane.normal, from->normal);
        } else if (from->shape == SCREE_SLOT_box) {
            world_copy(shape->box.lower, from->lower);
            world_copy(shape->box.upper, from->upper);
            shape->box.side = from->side;
        } else if (from->shape == SCREE_SLOT_mesh) {
            shape->mesh = (scree_mesh_keys){.file = from->file, .scale = from->scale, .smooth = from->smooth};
            world_copy(shape->mesh.at, from->at);
        } else {
            bool cone = from->shape == SCREE_SLOT_cone;
            shape->round = (scree_round_keys){.radius_start = cone ? from->radius_start : from->radius,
                                              .radius_end = from->radius_end,
                                              .side = from->side,
                                              .ends = from->ends};
            world_copy(shape->round.start, from->start);
            world_copy(shape->round.end, from->end);
        }
        scree_config_wall *to = &w->config_wall[k];
        *to = (scree_config_wall){.shape = from->shape,
                                  .name = from->name,
                                  .material = from->material,
                                  .friction = from->friction,
                                  .own = shape};
        memcpy(to->velocity, from->velocity, sizeof to->velocity);
        world_copy(to->spin, from->spin);
        world_copy(to->centre, from->centre);
    }
    w->config.walls = w->config_wall;
}

static inline void world_start(world *w, int dimension, law_choice law, int scheme, size_t count, double step)
{
    scree_error error = {0};
    world_say(w);
    w->config.dimension = dimension;
    w->f.model = fixture_model(law);
    w->f.model.dimension = dimension;
    w->f.model.scheme = scheme;
    w->f.model.largest_step = w->f.model.large_multiple = 1;
    w->f.model.overlap_limit = 0.2;
    w->f.model.walls_of_case = w->config_wall;
    w->f.model.wall_count = w->config.wall_count;
    assert_int_equal(scree_state_create(&w->f.state, dimension, count, &error), SCREE_OK);
    if (scree_model_predicts(&w->f.model)) check(scree_state_predict(&w->f.state, &error), &error);
    w->f.state.tick = w->f.state.step_size = w->f.state.kick_size = step;
    assert_int_equal(scree_work_create(&w->f.work, &w->f.model, 1, &error), SCREE_OK);
    scree_status status = scree_wall_set_create(&w->config, &w->f.work.wall_set, &error);
    if (status) fail_msg("%s", error.message);
}

static inline void world_close(world *w)
{
    scree_contact_scratch_destroy(&w->f.work);
    scree_work_destroy(&w->f.work);
    scree_state_destroy(&w->f.state);
    *w = (world){0};
}

/// Constants on the walls, as a model resolves them; a test gives those of walls with a material.
static inline void world_resolve(world *w)
{
    scree_model *model = &w->f.model;
    for (int k = 0; k < w->config.wall_count; k++)
        for (int m = 0; m < SCREE_MAX_MATERIALS && !w->wall[k].material; m++) {
            model->surfaces[k][m] = model->walls[m];
            if (!isnan(w->wall[k].friction)) model->surfaces[k][m].value[SCREE_FRICTION] = w->wall[k].friction;
        }
}

/// Forces at the present positions.
static inline void world_forces(world *w)
{
    scree_error error;
    fixture *f = &w->f;
    world_resolve(w);
    assert_int_equal(scree_neighbours_refresh(&f->model, &f->state, &f->work, &error), SCREE_OK);
    scree_contact_set_quanta(&f->model, &f->state, 0);
    scree_contact_forces(&f->model, &f->state, &f->work);
    assert_int_equal(f->work.flags, 0);
}

/// Evaluates the first forces and opens the ledger with what there is then.
static inline void world_begin(world *w)
{
    scree_error error;
    scree_energy energy;
    scree_contact_table table = {0};
    world_forces(w);
    w->f.state.ledger = (scree_ledger){0};
    scree_case_walls(&w->f.state)->load[0].work = 0;
    assert_int_equal(scree_contact_table_build(&w->f.model, &w->f.state, &w->f.work, &table, &error), SCREE_OK);
    scree_energy_measure(&w->f.model, &w->f.state, &table, &energy);
    scree_contact_table_destroy(&table);
    w->f.state.ledger.initial =
        energy.kinetic + energy.kinetic_rotation + energy.elastic_normal + energy.elastic_tangential;
    w->f.state.ledger.gravity = energy.gravity;
}

static inline void world_step(world *w)
{
    fixture *f = &w->f;
    const scree_integrator *scheme = scree_integrator_get(f->model.scheme);
    scheme->first(&f->model, &f->state, &f->work);
    f->state.step++;
    if (scree_case_walls(&f->state)->moving) scree_case_walls(&f->state)->ticks++;
    world_forces(w);
    if (scheme->second) scheme->second(&f->model, &f->state, &f->work);
}

static inline void world_run(world *w, int steps)
{
    for (int k = 0; k < steps; k++) world_step(w);
}

static inline scree_energy world_energy(world *w, size_t *contacts)
{
    scree_error error;
    scree_energy energy;
    scree_contact_table table = {0};
    assert_int_equal(scree_contact_table_build(&w->f.model, &w->f.state, &w->f.work, &table, &error), SCREE_OK);
    scree_energy_measure(&w->f.model, &w->f.state, &table, &energy);
    if (contacts) *contacts = table.count;
    scree_contact_table_destroy(&table);
    return energy;
}

/// Overlap of a sphere that rests with its weight on one contact: w = K sqrt(R) d^1.5.
static inline double world_rest(const world *w, double radius, double gravity)
{
    double weight = fixture_mass(&w->f.model, 0, radius) * gravity;
    double root = cbrt(weight / (w->f.model.walls[0].value[HERTZ_NORMAL] * sqrt(radius)));
    return root * root;
}

typedef double triangle_corners[3][3];

/// Writes triangles to a file, as text or binary.
static inline void write_stl(const char *path, const triangle_corners *triangle, size_t count, int binary)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    uint32_t number = (uint32_t)count;
    char header[80] = "solid but binary";
    const uint16_t attribute = 0;
    if (binary) {
        (void)fwrite(header, 1, sizeof header, file);
        (void)fwrite(&number, sizeof number, 1, file);
    } else {
        (void)fprintf(file, "solid test of walls\n");
    }
    for (size_t t = 0; t < count; t++) {
        float value[12] = {0};
        for (int k = 0; k < 9; k++) value[3 + k] = (float)triangle[t][k / 3][k % 3];
        if (binary) {
            (void)fwrite(value, sizeof *value, 12, file);
            (void)fwrite(&attribute, sizeof attribute, 1, file);
            continue;
        }
        (void)fprintf(file, "  facet normal 0 0 0\n    outer loop\n");
        for (int c = 0; c < 3; c++)
            (void)fprintf(file, "      vertex %.9g %.9g %.9g\n", (double)value[3 * c + 3], (double)value[3 * c + 4],
                          (double)value[3 * c + 5]);
        (void)fprintf(file, "    endloop\n  endfacet\n");
    }
    if (!binary) (void)fprintf(file, "endsolid test of walls\n");
    (void)fclose(file);
}

/// A wall from triangles, through a file.
static inline world_keys *world_mesh(world *w, const triangle_corners *triangle, size_t count)
{
    static char path[4][80];
    char *name = path[w->config.wall_count];
    (void)snprintf(name, sizeof path[0], "/tmp/scree_wall_%d_%d.stl", (int)getpid(), (int)w->config.wall_count);
    write_stl(name, triangle, count, count % 2);
    world_keys *wall = world_wall(w, SCREE_SLOT_mesh);
    wall->file = name;
    return wall;
}

#endif
