/// Samples from files of grains, those of other programs too (src/grains/): with the contacts of a file, or with those
/// that the overlaps make under the law and the materials of a case.
///
/// Of overlaps only what does not remember is known: the law starts without a history, so that springs along the
/// contact bear nothing (dashpots do where the file says velocities). Walls are not known either, and never what
/// presses on a free boundary. Resultants are the sums of the forces of the contacts that are known and of the weight.
/// A box that repeats itself begins at the origin of the sample. Cost: linear in grains and contacts.
#include "library/measure.h"

#include "base/matrix.h"
#include "case/case.h"
#include "contact/contact.h"
#include "grains/contacts.h"
#include "grains/grains.h"
#include "search/neighbours.h"
#include "state/body.h"
#include "state/periodic.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define SLIDES 0.999 /* of the Coulomb limit; of forces that are written with some digits */

bool measure_is_file(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 && S_ISREG(about.st_mode);
}

// ---- options -----------------------------------------------------------------------------------------------------

/// The frame of `--at`: the last one, or the one of a time step.
static scree_status read_frame(const measure_plan *plan, double *frame, scree_error *error)
{
    char *end;
    *frame = NAN;
    if (plan->mean)
        return scree_error_refuse(error, "--at", "end, #TIMESTEP", "means over snapshots are those of a run");
    if (plan->from)
        return scree_error_refuse(error, "--from", NULL, "a file of grains is of one instant: --from is of runs");
    if (strcmp(plan->at, "end") == 0) return SCREE_OK;
    *frame = strtod(plan->at + (*plan->at == '#'), &end);
    if (*plan->at == '#' && end != plan->at + 1 && *end == 0) return SCREE_OK;
    return scree_error_refuse(error, "--at", "end, #TIMESTEP", "'%s' is no frame of a file", plan->at);
}

/// In which the sample repeats itself: what the file says, else the case.
static unsigned directions_of(const measure_plan *plan, const scree_model *model, const scree_grains *g)
{
    const unsigned all = (1U << model->dimension) - 1;
    return all & (g->sided ? g->periodic : (unsigned)plan->options->sample_case->config.boundary.periodic);
}

static scree_status check(const measure_plan *plan, const scree_model *model, const scree_grains *g, scree_error *error)
{
    double lower, upper;
    if (!g->column[SCREE_GRAIN_RADIUS])
        return scree_error_set(error, SCREE_ERROR_INPUT, "the file has no radii: write a column radius or diameter");
    if (model->dimension == 3 && !g->column[SCREE_GRAIN_Z])
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "the file has no column z: its grains lie in a plane, the case in space");
    if (model->dimension == 3 && scree_grains_are_flat(g))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "z of all grains is 0: they lie in a plane, the case in space");
    if (model->dimension == 2 && !scree_grains_are_2d(g, &lower, &upper))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "z of the grains goes from %.6g to %.6g m: they lie in space, and the case in a plane",
                               lower, upper);
    if (directions_of(plan, model, g) && !g->bounded)
        return scree_error_set(error, SCREE_ERROR_INPUT, "the case repeats itself, and the file says no box");
    for (size_t i = 0; i < g->count; i++)
        if (!(g->column[SCREE_GRAIN_RADIUS][i] > 0))
            return scree_error_set(error, SCREE_ERROR_INPUT, "the radius of a grain is %.6g m: all must be above 0",
                                   g->column[SCREE_GRAIN_RADIUS][i]);
    return SCREE_OK;
}

// ---- the state ---------------------------------------------------------------------------------------------------

/// Numbers of the model of the materials that the kinds of the file mean.
static scree_status find_materials(const measure_plan *plan, const scree_model *model, const scree_grains *g,
                                   int *material, scree_error *error)
{
    const scree_config *config = &plan->options->sample_case->config;
    const char *names[SCREE_MAX_MATERIALS];
    size_t count = 0;
    for (; (int64_t)count < config->material_count && count < SCREE_MAX_MATERIALS; count++)
        names[count] = config->materials[count].name;
    for (size_t kind = 0; kind < g->kinds; kind++) {
        const int64_t found = scree_grains_find_material(g, kind, names, count);
        material[kind] = -1;
        for (int m = 0; m < model->material_count && found >= 0; m++)
            if (model->listed[m] == found) material[kind] = m;
        if (material[kind] < 0)
            return scree_error_refuse(
                error, "--case", NULL,
                "no particles of the case are of a material '%s': it must have those of the file, by name, "
                "or in the order of its numbers",
                g->kind_name[kind]);
    }
    return SCREE_OK;
}

/// The cell in which the file's box repeats itself, and the bodies in it.
static void set_cell(unsigned directions, const scree_grains *g, scree_state *state)
{
    scree_periodic_cell *cell = scree_cell(state);
    double side[3], inverse[9];
    if (!directions) return;
    for (int c = 0; c < 3; c++) side[c] = g->bounds[c][1] - g->bounds[c][0];
    scree_periodic_set(cell, directions, side);
    if (directions & 2) cell->lattice[1] = g->tilt[0];
    if (directions & 4) cell->lattice[2] = g->tilt[1], cell->lattice[5] = g->tilt[2];
    memcpy(cell->reference, cell->lattice, sizeof cell->reference);
    scree_matrix_invert(cell->lattice, inverse);
    for (size_t i = 0; i < state->count; i++) {
        scree_vector at, fraction;
        scree_body_position(state, i, at);
        for (int c = 0; c < 3; c++)
            if (scree_periodic_repeats(cell, c)) at[c] -= g->bounds[c][0];
        scree_matrix_apply(inverse, at, fraction);
        for (int c = 0; c < 3; c++) {
            const double turns = scree_periodic_repeats(cell, c) ? floor(fraction[c]) : 0;
            for (int k = 0; k < 3; k++) at[k] -= turns * cell->lattice[3 * k + c];
        }
        scree_row *row = &state->row[i];
        row->x = at[0];
        row->y = at[1];
        if (state->dimension == 3) row->z = at[2];
    }
}

static double value(const scree_grains *g, int column, size_t i)
{
    return g->column[column] ? g->column[column][i] : 0;
}

/// One body, ids are places in the file's order.
static void set_body(const scree_model *model, const scree_grains *g, const int *material, scree_state *state, size_t i)
{
    const double radius = g->column[SCREE_GRAIN_RADIUS][i];
    const int of = g->kind ? material[g->kind[i]] : 0;
    scree_row *row = &state->row[i];
    *row = (scree_row){.x = g->column[SCREE_GRAIN_X][i],
                       .y = g->column[SCREE_GRAIN_Y][i],
                       .radius = radius,
                       .mass = scree_model_mass(model, of, radius),
                       .vx = value(g, SCREE_GRAIN_VX, i),
                       .vy = value(g, SCREE_GRAIN_VY, i)};
    if (state->dimension == 2) {
        row->material = of;
        row->spin = value(g, SCREE_GRAIN_WZ, i);
        return;
    }
    row->z = g->column[SCREE_GRAIN_Z][i];
    row->vz = value(g, SCREE_GRAIN_VZ, i);
    state->turn[i].material = of;
    state->turn[i].wx = value(g, SCREE_GRAIN_WX, i);
    state->turn[i].wy = value(g, SCREE_GRAIN_WY, i);
    state->turn[i].wz = value(g, SCREE_GRAIN_WZ, i);
}

/// The sample of the state, with the contacts of its overlaps unless those of a file come.
static scree_status take_state(const scree_model *model, scree_state *state, bool touching, int threads,
                               scree_average_sample *sample, scree_error *error)
{
    scree_work work = {0};
    scree_contact_table table = {0};
    scree_status status = SCREE_OK;
    if (touching) {
        status = scree_work_create(&work, model, threads, error);
        if (!status) status = scree_neighbours_refresh(model, state, &work, error);
        if (!status) status = scree_contact_table_build(model, state, &work, &table, error);
    }
    if (!status) status = scree_average_sample_of_state(model, state, &table, sample, error);
    scree_contact_table_destroy(&table);
    if (touching) {
        scree_contact_scratch_destroy(&work);
        scree_work_destroy(&work);
    }
    return status;
}

static scree_status fill(const measure_plan *plan, const scree_model *model, const scree_grains *g,
                         scree_average_sample *sample, scree_error *error)
{
    scree_state state;
    int material[SCREE_GRAIN_KINDS];
    scree_status status = find_materials(plan, model, g, material, error);
    if (!status) status = scree_state_create(&state, model->dimension, g->count, error);
    if (status) return status;
    scree_state_set_laws(&state, model);
    for (size_t i = 0; i < g->count; i++) set_body(model, g, material, &state, i);
    set_cell(directions_of(plan, model, g), g, &state);
    status = take_state(model, &state, !plan->options->contacts, plan->threads, sample, error);
    scree_state_destroy(&state);
    return status;
}

// ---- contacts of a file --------------------------------------------------------------------------------------------

typedef struct grain_place {
    int64_t id;
    uint32_t place;
} grain_place;

static int by_id(const void *one, const void *other)
{
    const int64_t a = ((const grain_place *)one)->id, b = ((const grain_place *)other)->id;
    return a < b ? -1 : a > b;
}

/// Where each id of the file stands in the sample, in the order of the ids.
static scree_status list_places(const scree_grains *g, const scree_average_sample *sample, grain_place **places,
                                scree_error *error)
{
    scree_status status = scree_allocate(places, sample->bodies, sizeof **places, error);
    for (size_t p = 0; p < sample->bodies && !status; p++) {
        const uint32_t id = sample->grain[p].id;
        (*places)[p] = (grain_place){g->id ? g->id[id] : (int64_t)id, (uint32_t)p};
    }
    if (!status) qsort(*places, sample->bodies, sizeof **places, by_id);
    return status;
}

static scree_status find_place(const grain_place *places, size_t count, int64_t id, uint32_t *place, scree_error *error)
{
    const grain_place wanted = {.id = id}, *found = bsearch(&wanted, places, count, sizeof *places, by_id);
    *place = found ? found->place : SCREE_AVERAGE_OUTSIDE;
    return found ? SCREE_OK
                 : scree_error_refuse(error, "--contacts", NULL,
                                      "a contact is of grain %lld, and there is none of this id", (long long)id);
}

/// The shortest way between two places of a sample that repeats itself.
static void shorten(const scree_average_sample *sample, const double *inverse, scree_vector way)
{
    scree_vector fraction;
    scree_matrix_apply(inverse, way, fraction);
    for (int c = 0; c < 3; c++) {
        const double turns = sample->directions >> c & 1 ? round(fraction[c]) : 0;
        for (int k = 0; k < 3; k++) way[k] -= turns * sample->lattice[3 * k + c];
    }
}

/// Branch, normal and point of a contact: between grains along the line of their centres, in the middle of the overlap
/// where the file says no point; with a wall through that point, else straight against the force.
static void place_contact(const scree_average_sample *sample, const double *inverse, const double *point,
                          scree_average_contact *contact)
{
    const scree_average_grain *first = &sample->grain[contact->first];
    double reach = first->radius;
    for (int k = 0; k < 3; k++) contact->branch[k] = contact->normal[k] = contact->force[k];
    if (contact->second != SCREE_AVERAGE_OUTSIDE) {
        const scree_average_grain *second = &sample->grain[contact->second];
        for (int k = 0; k < 3; k++) contact->branch[k] = first->position[k] - second->position[k];
        shorten(sample, inverse, contact->branch);
        const double distance = scree_length(contact->branch);
        reach -= 0.5 * (first->radius + second->radius - distance);
        for (int k = 0; k < 3; k++) contact->normal[k] = contact->branch[k];
    } else if (point) {
        for (int k = 0; k < 3; k++) contact->branch[k] = first->position[k] - point[k];
        shorten(sample, inverse, contact->branch);
        for (int k = 0; k < 3; k++) contact->normal[k] = contact->branch[k];
    }
    (void)scree_normalise(contact->normal);
    scree_vector lever;
    for (int k = 0; k < 3; k++) lever[k] = point ? point[k] - first->position[k] : -reach * contact->normal[k];
    if (point) shorten(sample, inverse, lever);
    for (int k = 0; k < 3; k++) contact->point[k] = first->position[k] + lever[k];
    if (contact->second == SCREE_AVERAGE_OUTSIDE)
        for (int k = 0; k < 3; k++) contact->branch[k] = -lever[k];
}

/// Parts of the force along and across the normal.
static void split_force(double friction, scree_average_contact *contact)
{
    double across = 0;
    contact->normal_force = scree_dot(contact->force, contact->normal);
    for (int k = 0; k < 3; k++) {
        const double part = contact->force[k] - contact->normal_force * contact->normal[k];
        across += part * part;
    }
    contact->tangential_force = sqrt(across);
    contact->sliding =
        contact->normal_force > 0 && contact->tangential_force >= SLIDES * friction * contact->normal_force;
}

/// Friction of all materials of the case; NAN: they differ.
static double common_friction(const measure_plan *plan)
{
    const scree_config *config = &plan->options->sample_case->config;
    for (int64_t k = 1; k < config->material_count; k++)
        if (config->materials[k].friction != config->materials[0].friction) return NAN;
    return config->materials[0].friction;
}

static scree_status take_contacts(const measure_plan *plan, const scree_grain_contacts *c, const grain_place *places,
                                  scree_average_sample *sample, scree_error *error)
{
    double inverse[9];
    const double friction = common_friction(plan);
    scree_matrix_unit(inverse);
    if (sample->directions) scree_matrix_invert(sample->lattice, inverse);
    scree_status status =
        scree_reallocate(&sample->contact, sample->contacts, c->count, sizeof *sample->contact, error);
    for (size_t k = 0; k < c->count && !status; k++) {
        scree_average_contact *contact = &sample->contact[k];
        *contact = (scree_average_contact){.second = SCREE_AVERAGE_OUTSIDE};
        status = find_place(places, sample->bodies, c->first[k], &contact->first, error);
        if (!status && c->second[k] >= 0)
            status = find_place(places, sample->bodies, c->second[k], &contact->second, error);
        if (!status && contact->first == contact->second)
            status = scree_error_refuse(error, "--contacts", NULL, "grain %lld touches itself", (long long)c->first[k]);
        if (status) break;
        memcpy(contact->force, c->force[k], sizeof contact->force);
        place_contact(sample, inverse, c->point ? c->point[k] : NULL, contact);
        split_force(friction, contact);
    }
    sample->contacts = sample->contact_count = status ? 0 : c->count;
    return status;
}

static scree_status read_contacts(const measure_plan *plan, const scree_grains *g, double frame,
                                  scree_average_sample *sample, scree_error *error)
{
    const measure_file_units *units = &plan->units;
    const scree_grain_contacts_options options = {
        .columns = plan->options->contact_columns, .length = units->length, .force = units->force, .frame = frame};
    scree_grain_contacts c = {0};
    grain_place *places = NULL;
    if (!plan->options->contacts) return SCREE_OK;
    scree_status status = scree_grain_contacts_read(plan->options->contacts, &options, &c, error);
    if (!status) status = list_places(g, sample, &places, error);
    if (!status) status = take_contacts(plan, &c, places, sample, error);
    if (status && error && !error->file[0])
        (void)snprintf(error->file, sizeof error->file, "%s", plan->options->contacts);
    scree_release(&places);
    scree_grain_contacts_destroy(&c);
    return status;
}

// ---- the whole -----------------------------------------------------------------------------------------------------

/// What all contacts and the weight do to each grain.
static void sum_resultants(scree_average_sample *sample)
{
    for (size_t p = 0; p < sample->bodies; p++)
        for (int k = 0; k < 3; k++) {
            scree_average_grain *grain = &sample->grain[p];
            grain->resultant[k] = k < sample->dimension ? grain->mass * sample->gravity[k] : 0;
        }
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        for (int k = 0; k < 3; k++) {
            sample->grain[contact->first].resultant[k] += contact->force[k];
            if (contact->second != SCREE_AVERAGE_OUTSIDE)
                sample->grain[contact->second].resultant[k] -= contact->force[k];
        }
    }
}

static scree_status read_with(const char *path, const measure_plan *plan, double frame, const scree_model *model,
                              scree_average_sample *sample, scree_error *error)
{
    const scree_grains_options options = {.length = plan->units.length, .time = plan->units.time, .frame = frame};
    scree_grains g;
    scree_status status = scree_grains_read(path, &options, &g, error);
    if (status) return status;
    status = check(plan, model, &g, error);
    if (!status) status = fill(plan, model, &g, sample, error);
    if (!status) {
        status = read_contacts(plan, &g, frame, sample, error);
        if (!status) sum_resultants(sample);
        sample->time = g.time;
        if (g.left_out[0]) measure_say(plan, "%s: columns left out: %s", path, g.left_out);
        if (status) scree_average_sample_destroy(sample);
    }
    scree_grains_destroy(&g);
    return status;
}

/// The sample under the model of the case.
static scree_status take_sample(const char *path, const measure_plan *plan, const scree_model *model,
                                scree_average_sample *sample, scree_error *error)
{
    double frame;
    if (scree_model_traits(model)->areas)
        return scree_error_refuse(error, "--case", "a law of round grains",
                                  "the law of the case is of polygons, and the grains of a file are round");
    scree_status status = read_frame(plan, &frame, error);
    if (!status) status = read_with(path, plan, frame, model, sample, error);
    if (!status && plan->options->contacts && isnan(common_friction(plan)))
        measure_say(plan, "%s: materials of the case differ in friction: contacts that slide are not told", path);
    if (!status && !plan->options->contacts)
        measure_say(plan,
                    "%s: %zu contacts by the overlaps of its grains, under the law of the case; what springs along "
                    "contacts bear, and walls, are not known",
                    path, sample->contacts);
    return status;
}

scree_status measure_file_sample(const char *path, const measure_plan *plan, scree_average_sample *sample,
                                 scree_error *error)
{
    scree_model model;
    scree_status status;
    *sample = (scree_average_sample){0};
    if (plan->options->sample_case) {
        status = scree_model_build(&plan->options->sample_case->config, &model, error);
        if (status) return status;
        status = take_sample(path, plan, &model, sample, error);
    } else {
        status = scree_error_refuse(error, "--case", "a case file, or the name of a built-in case",
                                    "a file of grains says neither material nor law: give a case that does");
    }
    if (status == SCREE_ERROR_INPUT && error && !error->file[0])
        (void)snprintf(error->file, sizeof error->file, "%s", path);
    return status;
}
