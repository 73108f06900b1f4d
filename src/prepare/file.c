/// The particles of a file, each where it says, with its radius, velocity, spin and material (src/grains/).
///
/// Numbers of the file are in its units: `length_unit`, `time_unit`, unless its columns say theirs. The box begins at
/// the origin; sides that are not given are those of the file's box, else reach as far as the bodies do. Where the file
/// has a box, `at` is its lower corner, else its origin. Nothing is drawn at random. Cost: that of reading the file
/// twice, once for the checks.
#include "base/memory.h"
#include "base/units.h"
#include "case/check.h"
#include "case/own_file.h"
#include "grains/grains.h"
#include "module/key_rows.h"
#include "prepare/given.h"
#include "prepare/given_outline.h"
#include "prepare/methods.h"
#include "prepare/prepare.h"
#include "state/body.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct config {
    double height;
    char *file, *checksum;
    int format;
    double length_unit, time_unit, frame, radius_factor;
    double at[3];
    bool velocities;
    // when the file has been looked at
    size_t count;
    const char *material[SCREE_GRAIN_KINDS]; ///< of the case, of each kind of the file
    char remark[150];                        ///< what it does not read
} config;

static const scree_choice formats[] = {
    {"auto", 0, "found out by how the file begins"},
    {"csv", 1,
     "table with named columns: x, y, z, radius or diameter, vx, vy, vz, wx, wy, wz, spin, angle, material, id"},
    {"lammps_dump", 2, "frame of a LAMMPS dump"},
    {"lammps_data", 3, "LAMMPS data file of atom_style sphere"},
    {"yade", 4, "YADE's export.text"},
    {"run", 5, "snapshot in the run.h5 of a run of Scree: its round grains, without their contacts"},
    {0},
};
#define WITH_FILE .when = "method=file"
static const scree_key keys[] = {
    NUMBER(config, height, "m", .standard = "auto", FROM("1 nm"), TO("100 km"), WITH_FILE,
           .meaning = "Height of the box, which begins at the origin; auto: as far as the bodies reach."),
    KEY(config, file, SCREE_KEY_TEXT, FROM("1"), TO("4000"), WITH_FILE,
        .meaning = "File of the particles, relative to the case file. What `particles` leaves out is as there: count, "
                   "radius_min and radius_max, the material where there is but one."),
    SCREE_OWN_FILE_CHECKSUM(config, checksum, WITH_FILE),
    CHOICE(config, format, formats, .standard = "auto", WITH_FILE, .meaning = "Of the file."),
    NUMBER(config, length_unit, "m", .standard = "1 m", ABOVE("0 m"), TO("1e6 m"), WITH_FILE,
           .meaning = "Length of one unit of the file, where its columns do not say theirs."),
    NUMBER(config, time_unit, "s", .standard = "1 s", ABOVE("0 s"), TO("1e9 s"), WITH_FILE,
           .meaning = "Time of one unit of the file, the same."),
    NUMBER(config, frame, "1", .standard = "auto", FROM("0"), TO("1e18"), WITH_FILE,
           .meaning = "Time step of the frame of a dump, number of the snapshot of a run; auto: the last one."),
    KEY(config, at, SCREE_KEY_VECTOR, .unit = "m", .standard = "[0, 0]", FROM("-1e6 m"), TO("1e6 m"), WITH_FILE,
        .meaning = "Where the origin of the file lies; of one with a box, its lower corner."),
    NUMBER(config, radius_factor, "1", .standard = "1", FROM("0.1"), TO("10"), WITH_FILE,
           .meaning = "Radii are those of the file times this, so that what overlaps can come apart."),
    FLAG(config, velocities, .standard = "yes", WITH_FILE,
         .meaning = "Velocities and spins are those of the file; no: all are at rest."),
};

static const config *own_config(const scree_config_stage *stage)
{
    return scree_config_own(&scree_module_file, "stages.prepare", stage->own);
}

/// The grains of the file where they stand in the box; radii of all are there.
static scree_status load(const config *own, double common_radius, scree_grains *g, scree_error *error)
{
    const scree_grains_options options = {.format = own->format > 0 ? formats[own->format].name : NULL,
                                          .length = own->length_unit,
                                          .time = own->time_unit,
                                          .frame = own->frame};
    scree_status status = scree_grains_read(own->file, &options, g, error);
    g->sized = g->column[SCREE_GRAIN_RADIUS] != NULL;
    if (!status && !g->column[SCREE_GRAIN_RADIUS]) {
        status = scree_allocate(&g->column[SCREE_GRAIN_RADIUS], g->count, sizeof **g->column, error);
        for (size_t i = 0; i < g->count && !status; i++) g->column[SCREE_GRAIN_RADIUS][i] = common_radius;
    } else if (!status)
        for (size_t i = 0; i < g->count; i++) g->column[SCREE_GRAIN_RADIUS][i] *= own->radius_factor;
    for (int c = 0; c < 3 && !status; c++) {
        const double shift = own->at[c] - (g->bounded ? g->bounds[c][0] : 0);
        for (size_t i = 0; i < g->count && g->column[c]; i++) g->column[c][i] += shift;
    }
    if (status) scree_grains_destroy(g);
    return status;
}

// ---- what a case may leave out -------------------------------------------------------------------------------------

static const char *text_of(const scree_node *mapping, const char *key)
{
    const scree_node *child = mapping ? scree_node_find(mapping, key) : NULL;
    return child && child->kind == SCREE_NODE_SCALAR ? child->text : NULL;
}

/// A number of the stage; NAN: it is wrong, or `auto`.
static double number_of(const scree_node *stage, const char *key, const char *unit, double otherwise)
{
    const char *text = text_of(stage, key);
    double value = NAN;
    scree_error ignored;
    if (!text) return otherwise;
    return scree_units_parse(text, unit, &value, &ignored) ? NAN : value;
}

/// In as few digits as say it.
static void supply_length(scree_reader *reader, const char *path, double length)
{
    char text[40];
    int digits = 6;
    do (void)snprintf(text, sizeof text, "%.*g m", digits, length);
    while (strtod(text, NULL) != length && ++digits <= 17);
    scree_case_supply(reader, path, text);
}

static void supply_limits(scree_reader *reader, double least, double most)
{
    supply_length(reader, "particles.radius_min", least);
    supply_length(reader, "particles.radius_max", most);
}

static void supply_radii(scree_reader *reader, const scree_grains *g, double factor)
{
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < g->count; i++) {
        least = fmin(least, factor * g->column[SCREE_GRAIN_RADIUS][i]);
        most = fmax(most, factor * g->column[SCREE_GRAIN_RADIUS][i]);
    }
    if (least > 0)
        supply_limits(reader, least, most);
    else
        supply_limits(reader, 1, 2); // the rules say what is wrong
}

/// Of a file that cannot be read, which the rules refuse: nobody is asked for what stands in it.
static void supply_stand_ins(scree_reader *reader, bool count, bool radii)
{
    if (count) scree_case_supply(reader, "particles.count", "1");
    if (radii) supply_limits(reader, 1, 1);
}

/// Number, limits of the radii and, where there is but one, the material of the particles are those of the file.
static void supply(scree_reader *reader, const scree_node *stage)
{
    const scree_node *particles = scree_node_find(reader->root, "particles");
    const scree_node *materials = scree_node_find(reader->root, "materials");
    const char *format = text_of(stage, "format"), *file = text_of(stage, "file");
    const double length = number_of(stage, "length_unit", "m", 1), factor = number_of(stage, "radius_factor", "1", 1);
    const bool count = !text_of(particles, "count"), sized = text_of(particles, "distribution") ||
                                                             text_of(particles, "radius_min") ||
                                                             text_of(particles, "radius_max");
    char path[2 * PATH_MAX], text[40];
    scree_grains g;
    scree_error ignored;
    if (!file || !(length > 0) || !(factor > 0) || (particles && particles->kind == SCREE_NODE_LIST)) return;
    if (!text_of(particles, "material") && materials && materials->kind == SCREE_NODE_LIST && materials->count == 1 &&
        text_of(scree_node_at(materials, 0), "name"))
        scree_case_supply(reader, "particles.material", text_of(scree_node_at(materials, 0), "name"));
    if (!count && sized) return;
    const scree_grains_options options = {.format = format && strcmp(format, "auto") != 0 ? format : NULL,
                                          .length = length,
                                          .time = 1,
                                          .frame = number_of(stage, "frame", "1", NAN)};
    scree_file_beside(reader, file, path, sizeof path);
    if (scree_grains_read(path, &options, &g, &ignored)) {
        supply_stand_ins(reader, count, !sized);
        return;
    }
    (void)snprintf(text, sizeof text, "%zu", g.count);
    if (count) scree_case_supply(reader, "particles.count", text);
    if (!sized && g.column[SCREE_GRAIN_RADIUS]) supply_radii(reader, &g, factor);
    if (!sized && !g.column[SCREE_GRAIN_RADIUS]) supply_limits(reader, 1, 2); // the rules say what is missing
    scree_grains_destroy(&g);
}

// ---- rules ---------------------------------------------------------------------------------------------------------

/// The file under judgement.
typedef struct judged {
    scree_reader *reader;
    const scree_config *config;
    const config *own;
    const scree_grains *g;
} judged;

static void check_dimension(const judged *j)
{
    double lower, upper;
    if (j->config->dimension == 3 && !j->g->column[SCREE_GRAIN_Z])
        scree_rule_refuse(j->reader, "stages.0.file", NULL,
                          "the file has no column z: its grains lie in a plane, and dimension is 3");
    else if (j->config->dimension == 3 && scree_grains_are_flat(j->g))
        scree_rule_refuse(j->reader, "stages.0.file", NULL,
                          "z of all grains is 0: they lie in a plane, and dimension is 3 (give a layer of spheres "
                          "another z)");
    else if (j->config->dimension == 2 && !scree_grains_are_2d(j->g, &lower, &upper))
        scree_rule_refuse(j->reader, "stages.0.file", NULL,
                          "z of the grains goes from %.6g to %.6g m: they lie in space, and dimension is 2", lower,
                          upper);
}

/// A box with right angles is needed.
static void check_box(const judged *j)
{
    const double *tilt = j->g->tilt;
    if (tilt[0] != 0 || tilt[1] != 0 || tilt[2] != 0)
        scree_rule_refuse(
            j->reader, "stages.0.file", NULL,
            "its box is tilted; a box with right angles is needed (scree measure takes tilted ones, too)");
}

/// The material of the case that each kind of the file means.
static void find_materials(const judged *j, config *own)
{
    const char *names[SCREE_MAX_MATERIALS];
    size_t count = 0;
    for (; (int64_t)count < j->config->material_count && count < SCREE_MAX_MATERIALS; count++)
        names[count] = j->config->materials[count].name;
    for (size_t kind = 0; kind < j->g->kinds; kind++) {
        const int64_t found = scree_grains_find_material(j->g, kind, names, count);
        own->material[kind] = found < 0 ? NULL : names[found];
        if (!own->material[kind])
            scree_rule_refuse(j->reader, "stages.0.file", NULL,
                              "there is no material '%s': `materials` must have those of the file, by name, or in the "
                              "order of its numbers",
                              scree_show(j->g->kind_name[kind]).text);
    }
}

static bool check_radii(const judged *j)
{
    const scree_size_moments sizes = scree_listed_sizes(j->config);
    const double *radius = j->g->column[SCREE_GRAIN_RADIUS];
    if (!(sizes.least > 0)) return false; // missing or wrong, and noted
    if (!j->g->sized && !scree_listed_equal(j->config)) {
        scree_rule_refuse(
            j->reader, "stages.0.file", NULL,
            "the file has no radii: give it a column radius or diameter, or `particles` distribution: equal "
            "with the radius that all have");
        return false;
    }
    double least = INFINITY, most = 0;
    size_t smallest = 0;
    for (size_t i = 0; i < j->g->count; i++) {
        if (radius[i] < radius[smallest]) smallest = i;
        least = fmin(least, radius[i]);
        most = fmax(most, radius[i]);
    }
    if (!(least > 0))
        scree_rule_refuse(j->reader, "stages.0.file", NULL,
                          "the radius of grain %zu (from 0) is %.6g m: all must be above 0", smallest, least);
    else if (least < sizes.least || most > sizes.most)
        scree_rule_refuse(j->reader, "particles.distribution", NULL,
                          "radii of the file go from %.15g to %.15g m, those of the particles from %.15g to %.15g m: "
                          "give distribution: uniform with radius_min and radius_max around those of the file",
                          least, most, sizes.least, sizes.most);
    return least > 0;
}

/// What a grain reaches from its centre towards both walls across direction c [m].
static void find_reach(const judged *j, bool outlines, size_t i, int c, double reach[2])
{
    double *const *column = j->g->column;
    reach[0] = reach[1] = column[SCREE_GRAIN_RADIUS][i];
    if (!outlines) return;
    const double angle = column[SCREE_GRAIN_ANGLE] ? column[SCREE_GRAIN_ANGLE][i] : 0;
    scree_given_outline_reach(j->config, i, reach[0], angle, c, reach);
}

/// No deeper in a wall of the box than the guard allows; in a periodic cell the centre lies within it.
static void check_inside(const judged *j)
{
    const scree_prepare_config *stage = scree_config_prepared(scree_config_prepare(j->config));
    const bool in_3d = j->config->dimension == 3;
    const double side[3] = {stage->width, in_3d ? stage->depth : j->own->height, j->own->height};
    const bool outlines = scree_given_has_outlines(j->config);
    size_t outside = 0, first = 0;
    for (size_t i = 0; i < j->g->count && scree_given_has_box(j->config); i++)
        for (int c = 0; c < j->config->dimension && j->g->column[c]; c++) {
            const bool periodic = j->config->boundary.periodic >> c & 1;
            const double allowed = j->config->guard.overlap * j->g->column[SCREE_GRAIN_RADIUS][i];
            const double at = j->g->column[c][i];
            double reach[2];
            find_reach(j, outlines, i, c, reach);
            const double end = !isnan(side[c]) ? side[c]
                               : j->g->bounded ? j->g->bounds[c][1] - j->g->bounds[c][0]
                                               : INFINITY;
            if (!(at < (periodic ? 0 : reach[0] - allowed) || at > end - (periodic ? 0 : reach[1] - allowed))) continue;
            first = outside++ ? first : i;
            break;
        }
    if (outside > 0)
        scree_rule_refuse(
            j->reader, "stages.0.file", NULL,
            "%zu of %zu grains lie outside of the box, or deep in its sides, grain %zu (from 0) first, at "
            "[%.6g, %.6g%s%.6g] m: the box begins at the origin; move them by `at`, or give width and "
            "height",
            outside, j->g->count, first, j->g->column[0][first], j->g->column[1][first], in_3d ? ", " : "; radius ",
            j->g->column[in_3d && j->g->column[2] ? SCREE_GRAIN_Z : SCREE_GRAIN_RADIUS][first]);
}

static void refuse_overlaps(const judged *j, const scree_given_overlap *found)
{
    const char *remedy = "let them come apart by a smaller radius_factor, or by a larger guard.overlap and a first "
                         "stage relax with a load of background damping";
    const char *plural = found->count > 1 ? "s overlap" : " overlaps";
    if (isinf(found->overlap))
        scree_rule_refuse(
            j->reader, "stages.0.file", NULL,
            "%zu pair%s by more than guard.overlap allows, grains %zu and %zu (from 0) so deep that no law "
            "has a force: let them come apart by a smaller radius_factor",
            found->count, plural, found->first, found->second);
    else
        scree_rule_refuse(j->reader, "stages.0.file", NULL,
                          "%zu pair%s by more than guard.overlap allows (%.3g of the smaller radius), most of all "
                          "grains %zu and %zu (from 0), by %.3g of it: %s",
                          found->count, plural, j->config->guard.overlap, found->first, found->second, found->share,
                          remedy);
}

static void check_overlaps(const judged *j)
{
    double *const *column = j->g->column;
    const bool in_3d = j->config->dimension == 3;
    const scree_given_bodies bodies = {.count = j->g->count,
                                       .place = {column[0], column[1], in_3d ? column[2] : NULL},
                                       .radius = column[SCREE_GRAIN_RADIUS],
                                       .angle = column[SCREE_GRAIN_ANGLE],
                                       .outlines = scree_given_has_outlines(j->config) ? j->config : NULL};
    scree_given_overlap found;
    scree_error error;
    double lower, upper;
    if (in_3d ? !column[2] : !scree_grains_are_2d(j->g, &lower, &upper)) return; // noted
    if (scree_given_find_overlap(&bodies, j->config->guard.overlap, &found, &error))
        scree_reader_fail(j->reader, j->g->count);
    else if (found.count > 0)
        refuse_overlaps(j, &found);
}

static void refuse_file(scree_reader *reader, const scree_error *why)
{
    scree_place place = {.source = scree_arena_copy(reader->arena, why->file, strlen(why->file)),
                         .line = why->line,
                         .column = why->column};
    if (!place.source || !place.source[0] || why->line == 0)
        scree_rule_refuse(reader, "stages.0.file", NULL, "%s", why->message);
    else
        scree_problem_add(reader, place, "stages.0.file", why->value, NULL, "%s", why->message);
}

static void rules(scree_reader *reader, const scree_config *of)
{
    const scree_config_stage *stage = scree_config_prepare(of);
    if (!stage || scree_config_prepared(stage)->method != SCREE_SLOT_file) return;
    config *own = (config *)(uintptr_t)own_config(stage);
    scree_grains g;
    scree_error error = {0};
    if (own->format < 0 || !scree_own_file_find(reader, "stages.0", &own->file, &own->checksum)) return;
    if (load(own, scree_listed_sizes(of).least, &g, &error)) {
        refuse_file(reader, &error);
        return;
    }
    const judged j = {reader, of, own, &g};
    own->count = g.count;
    if (g.left_out[0]) (void)snprintf(own->remark, sizeof own->remark, "columns left out: %s", g.left_out);
    if (scree_given_rules(reader, of, g.count)) {
        check_dimension(&j);
        check_box(&j);
        find_materials(&j, own);
        if (check_radii(&j)) {
            check_inside(&j);
            check_overlaps(&j);
        }
    }
    scree_grains_destroy(&g);
}

// ---- what it places ------------------------------------------------------------------------------------------------

static size_t count_of(const scree_model *model, const scree_config_stage *stage)
{
    return own_config(stage)->count > 0 ? own_config(stage)->count : model->count;
}

static scree_status read(const scree_model *model, const scree_config_stage *stage, scree_grains *g, scree_error *error)
{
    scree_status status = load(own_config(stage), model->species[0].radius.least, g, error);
    if (!status && g->count != count_of(model, stage)) {
        scree_grains_destroy(g);
        status = scree_prepare_error(error, model, stage, "file", "the file has changed since the case was read");
    }
    return status;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    scree_grains g;
    double reach[3] = {0};
    scree_status status = read(model, stage, &g, error);
    if (status) return status;
    for (size_t i = 0; i < packing->count; i++) {
        packing->radius[i] =
            g.column[SCREE_GRAIN_RADIUS][i] * scree_model_drawn_bound(model, i) / scree_model_drawn_radius(model, i);
        for (int c = 0; c < packing->dimension; c++) {
            packing->place[c][i] = g.column[c][i];
            reach[c] = fmax(reach[c], g.column[c][i] + packing->radius[i]);
        }
    }
    for (int c = 0; c < 3 && g.bounded; c++) reach[c] = own_config(stage)->at[c] + g.bounds[c][1] - g.bounds[c][0];
    scree_box *box = &packing->box;
    if (isnan(box->width)) box->width = reach[0];
    if (packing->dimension == 3 && isnan(box->depth)) box->depth = reach[1];
    box->height = isnan(own_config(stage)->height) ? reach[packing->dimension - 1] : own_config(stage)->height;
    scree_grains_destroy(&g);
    return SCREE_OK;
}

static double value(const scree_grains *g, int column, size_t i)
{
    return g->column[column] ? g->column[column][i] : 0;
}

static void set_motion(const scree_grains *g, scree_state *state, size_t i)
{
    scree_row *row = &state->row[i];
    row->vx = value(g, SCREE_GRAIN_VX, i);
    row->vy = value(g, SCREE_GRAIN_VY, i);
    if (state->dimension == 2) {
        row->spin = value(g, SCREE_GRAIN_WZ, i);
        return;
    }
    row->vz = value(g, SCREE_GRAIN_VZ, i);
    state->turn[i].wx = value(g, SCREE_GRAIN_WX, i);
    state->turn[i].wy = value(g, SCREE_GRAIN_WY, i);
    state->turn[i].wz = value(g, SCREE_GRAIN_WZ, i);
}

/// Gives a body another material than that of the particles.
static void make_of(const scree_model *model, scree_state *state, size_t i, int material)
{
    scree_row *row = &state->row[i];
    if (material < 0 || material == scree_body_material(state, i)) return;
    row->mass *= model->density[material] / model->density[scree_body_material(state, i)];
    if (state->dimension == 3)
        state->turn[i].material = material;
    else
        row->material = material;
}

static scree_status remember(const scree_model *model, const scree_config_stage *stage, const scree_packing *packing,
                             scree_state *state, scree_error *error)
{
    scree_grains g;
    scree_status status = read(model, stage, &g, error);
    (void)packing;
    for (size_t i = 0; i < state->count && !status; i++) {
        if (own_config(stage)->velocities) set_motion(&g, state, i);
        if (state->dimension == 2) state->angle[i] = value(&g, SCREE_GRAIN_ANGLE, i);
        if (g.kind) make_of(model, state, i, scree_model_material(model, own_config(stage)->material[g.kind[i]]));
    }
    if (!status) scree_grains_destroy(&g);
    return status;
}

static bool uses(const scree_config_stage *stage, const char *material)
{
    for (size_t kind = 0; kind < SCREE_GRAIN_KINDS; kind++)
        if (own_config(stage)->material[kind] && strcmp(own_config(stage)->material[kind], material) == 0) return true;
    return false;
}

static double height_of(const scree_model *model, const scree_config_stage *stage)
{
    scree_grains g;
    scree_error error;
    const int axis = model->dimension - 1;
    double height = 0;
    if (!isnan(own_config(stage)->height)) return own_config(stage)->height;
    if (read(model, stage, &g, &error)) return 0;
    for (size_t i = 0; i < g.count; i++) height = fmax(height, g.column[axis][i] + g.column[SCREE_GRAIN_RADIUS][i]);
    if (g.bounded) height = g.bounds[axis][1] - g.bounds[axis][0];
    scree_grains_destroy(&g);
    return height;
}

/// Largest relative velocity.
static double impact_speed(const scree_model *model, const scree_config_stage *stage, double fall)
{
    scree_grains g;
    scree_error error;
    double speed = 0;
    if (!own_config(stage)->velocities || read(model, stage, &g, &error)) return fall;
    for (size_t i = 0; i < g.count; i++)
        speed = fmax(speed, sqrt(pow(value(&g, SCREE_GRAIN_VX, i), 2) + pow(value(&g, SCREE_GRAIN_VY, i), 2) +
                                 pow(value(&g, SCREE_GRAIN_VZ, i), 2)));
    scree_grains_destroy(&g);
    return fmax(2 * speed, fall);
}

static const char *remark(const scree_config_stage *stage)
{
    return own_config(stage)->remark;
}

static const scree_preparation preparation = {
    .periodic = true,
    .given = true,
    .approaching = true,
    .sizes_box = true,
    .supply = supply,
    .count = count_of,
    .uses = uses,
    .height = height_of,
    .impact_speed = impact_speed,
    .place = place,
    .remember = remember,
    .remark = remark,
};

const scree_module scree_module_file = {
    .name = "file",
    .meaning = "the particles of a file: a table, a LAMMPS dump or data file, an export of YADE",
    .choice_of = CHOICE_OF(IS("stages.prepare.method")),
    .keys = (const scree_keys[]){KEYS_OF("stages.prepare", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .preparation = &preparation,
};
