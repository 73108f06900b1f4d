/// From what the user said to the constants that kernels use.
///
/// The constants of two materials are the affair of the law (contact/laws.h). All here is O(materials^2 + stages).
#include "case/check.h"
#include "model/model.h"

#include "model/critical_step.h"
#include "module/integrator.h"
#include "theory/quasistatic.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static scree_status indexed_error(scree_error *error, const char *list, int64_t index, const char *key,
                                  const char *text)
{
    char path[64];
    (void)snprintf(path, sizeof path, "%s.%lld.%s", list, (long long)index, key);
    return scree_error_refuse(error, path, NULL, "%s", text);
}

// ---- laws --------------------------------------------------------------------------------------------------------

/// Number of the law of a material of the list and something called `other`; NULL: its like.
static int law_number(const scree_config *config, int64_t material, const char *other)
{
    const char *one = config->materials[material].name;
    return scree_config_law_between(&config->contact, one, other ? other : one);
}

/// Whether a material of the list meets others of it, which are in use or `all`, plates or walls under the law.
static bool takes_part(const scree_model *model, int law, int64_t material, bool all)
{
    const scree_config *config = model->config;
    const char *wall = config->materials[material].wall_material;
    bool part = law_number(config, material, wall) == law;
    for (int64_t i = 0; i < config->material_count && all; i++)
        part = part || law_number(config, material, config->materials[i].name) == law;
    for (int i = 0; i < model->material_count && !all; i++)
        part = part || law_number(config, material, config->materials[model->listed[i]].name) == law;
    for (int64_t w = 0; w < config->wall_count; w++)
        part =
            part || law_number(config, material, config->walls[w].material ? config->walls[w].material : wall) == law;
    return part;
}

/// What each law wants of a material under it.
static scree_status check_laws(const scree_model *model, int64_t material, scree_error *error)
{
    for (int k = 0; k < scree_model_law_count(model); k++) {
        const scree_law *law = scree_law_get(model->laws[k].law);
        if (!law->material_problem || !takes_part(model, k, material, true)) continue;
        const char *key, *problem = law->material_problem(&model->config->materials[material], &key);
        if (problem) return indexed_error(error, "materials", material, key, problem);
    }
    return SCREE_OK;
}

static scree_status check_materials(const scree_model *model, scree_error *error)
{
    const scree_config *config = model->config;
    if (config->material_count < 1 || config->material_count > SCREE_MAX_MATERIALS)
        return scree_error_refuse(error, "materials", NULL, "a case has 1 to %d materials, this one has %lld",
                                  SCREE_MAX_MATERIALS, (long long)config->material_count);
    for (int i = 0; i < config->material_count; i++) {
        for (int j = 0; j < i; j++)
            if (strcmp(config->materials[i].name, config->materials[j].name) == 0)
                return indexed_error(error, "materials", i, "name", "two materials have the same name");
        scree_status status = check_laws(model, i, error);
        if (status) return status;
    }
    return SCREE_OK;
}

/// Materials in the order of their use: that of the particles (of the first species), others that something is made of,
/// and the rest, which has constants but counts in nothing.
static int rank_of(const scree_config *config, const scree_config_material *material)
{
    const scree_config_particles *particles = &config->particles;
    for (int64_t s = 0; s < scree_config_species_count(particles); s++)
        if (strcmp(material->name, scree_config_species_at(particles, s).material) == 0) return s > 0;
    const scree_preparation *method = scree_config_preparation(config);
    return method && method->uses && method->uses(scree_config_prepare(config), material->name) ? 1 : 2;
}

/// Numbers the materials; none is in use when there is none of the particles.
static void number_materials(scree_model *model)
{
    const scree_config *config = model->config;
    int count = 0;
    for (int rank = 0; rank < 3; rank++) {
        for (int i = 0; i < config->material_count; i++)
            if (rank_of(config, &config->materials[i]) == rank) model->listed[count++] = i;
        if (rank == 0 && count == 0) return;
        if (rank < 2) model->material_count = count;
    }
}

/// Place of a material in the list of the case; -1: there is none of this name.
static int find_material(const scree_config *config, const char *name)
{
    for (int i = 0; i < config->material_count; i++)
        if (strcmp(config->materials[i].name, name) == 0) return i;
    return -1;
}

static scree_contact_space space_of(const scree_model *model)
{
    return (scree_contact_space){.dimension = model->dimension, .thickness = model->thickness};
}

/// Constants of two materials (NULL: something rigid) under law number `k`, as the case amends them.
static scree_pair_constants constants_of(const scree_model *model, int k, const scree_config_material *one,
                                         const scree_config_material *other)
{
    const scree_contact_space space = space_of(model);
    const scree_law *law = scree_law_get(model->laws[k].law);
    scree_pair_constants pair = law->constants(&space, one, other);
    if (law->amend) law->amend(scree_config_law_keys(&model->config->contact, k), &pair);
    return pair;
}

/// Material `grain` of the list on a wall of `material` (NULL: like the grain), and the number of their law; at
/// LIST.INDEX.KEY the user said so.
static scree_status wall_constants(const scree_model *model, int64_t grain, const char *material, const char *list,
                                   int64_t index, const char *key, scree_pair_constants *constants, uint8_t *law,
                                   scree_error *error)
{
    const scree_config_material *body = &model->config->materials[grain], *wall = body;
    bool rigid = material && strcmp(material, SCREE_RIGID) == 0;
    int found = material && !rigid ? find_material(model->config, material) : (int)grain;
    if (found < 0) return indexed_error(error, list, index, key, "there is no material of this name");
    wall = rigid ? NULL : &model->config->materials[found];
    *law = (uint8_t)law_number(model->config, grain, material);
    *constants = constants_of(model, *law, body, wall);
    if (!isnan(body->wall_friction)) constants->value[SCREE_FRICTION] = body->wall_friction;
    return SCREE_OK;
}

/// Grains of every material on plates and on each wall of the case.
static scree_status resolve_walls(scree_model *model, scree_error *error)
{
    const scree_config *config = model->config;
    scree_status status = SCREE_OK;
    for (int i = 0; i < model->config->material_count && !status; i++) {
        const int64_t place = model->listed[i];
        const scree_config_material *grain = &config->materials[place];
        status = wall_constants(model, place, grain->wall_material, "materials", place, "wall_material",
                                &model->walls[i], &model->law_of_walls[i], error);
        for (int64_t w = 0; w < config->wall_count && !status; w++) {
            scree_pair_constants *pair = &model->surfaces[w][i];
            uint8_t *law = &model->law_of_surfaces[w][i];
            *pair = model->walls[i];
            *law = model->law_of_walls[i];
            if (config->walls[w].material)
                status =
                    wall_constants(model, place, config->walls[w].material, "walls", w, "material", pair, law, error);
            if (!isnan(config->walls[w].friction)) pair->value[SCREE_FRICTION] = config->walls[w].friction;
        }
    }
    return status;
}

static scree_status resolve_materials(scree_model *model, scree_error *error)
{
    const scree_config *config = model->config;
    scree_status status = check_materials(model, error);
    if (status) return status;
    model->material_count = 0;
    number_materials(model);
    for (int i = 0; model->material_count > 0 && i < config->material_count; i++)
        model->density[i] = config->materials[model->listed[i]].density;
    return SCREE_OK;
}

/// Options of the laws, which the materials in use under them ask for.
static void resolve_options(scree_model *model)
{
    const scree_config *config = model->config;
    for (int k = 0; k < scree_model_law_count(model); k++) {
        const scree_law *law = scree_law_get(model->laws[k].law);
        for (int i = 0; i < model->material_count; i++)
            if (takes_part(model, k, model->listed[i], false))
                model->laws[k].option |=
                    law->options(scree_config_law_keys(&config->contact, k), &config->materials[model->listed[i]]);
    }
}

/// Law and constants of all pairs, which may depend on sizes.
static scree_status resolve_pairs(scree_model *model, scree_error *error)
{
    const scree_config *config = model->config;
    const scree_config_material *listed = config->materials;
    for (int i = 0; i < config->material_count; i++) {
        const scree_config_material *material = &listed[model->listed[i]];
        for (int j = 0; j <= i; j++) {
            const scree_config_material *other = &listed[model->listed[j]];
            const int law = law_number(config, model->listed[i], other->name);
            model->law_of_pairs[i][j] = model->law_of_pairs[j][i] = (uint8_t)law;
            model->pairs[i][j] = model->pairs[j][i] = constants_of(model, law, material, other);
        }
    }
    resolve_options(model);
    return resolve_walls(model, error);
}

/// Every species is made of something.
static scree_status check_species(const scree_model *model, scree_error *error)
{
    const scree_config *config = model->config;
    const scree_config_particles *particles = &config->particles;
    for (int64_t s = 0; s < scree_config_species_count(particles); s++) {
        const char *material = scree_config_species_at(particles, s).material;
        if (find_material(config, material) >= 0) continue;
        if (particles->species_count > 0)
            return indexed_error(error, "particles.species", s, "material", "there is no such material in this case");
        scree_status status =
            scree_error_refuse(error, "particles.material", NULL, "there is no material '%s' in this case", material);
        for (int i = 0; error && i < config->material_count; i++) {
            size_t used = strlen(error->accepted);
            (void)snprintf(error->accepted + used, sizeof error->accepted - used, "%s%s", i ? ", " : "",
                           config->materials[i].name);
        }
        return status;
    }
    return SCREE_OK;
}

static scree_status resolve_particles(scree_model *model, scree_error *error)
{
    scree_status status = check_species(model, error);
    if (!status) status = scree_model_resolve_species(model, error);
    if (status) return status;
    double thickness = model->config->particles.thickness;
    model->thickness = isnan(thickness) ? 2 * model->mean_radius : thickness;
    if (model->dimension == 3) model->thickness = 1;
    return SCREE_OK;
}

/// Numbers of the boundaries that the stages have.
static scree_status resolve_boundaries(scree_model *model, scree_error *error)
{
    const scree_config *config = model->config;
    bool used[SCREE_MODULE_COUNT] = {0};
    for (int64_t i = 0; i < config->stage_count; i++)
        if (!scree_modules[config->stages[i].kind]->numbers->places) used[scree_config_boundary_of(config, i)] = true;
    scree_status status = SCREE_OK;
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (used[m] && scree_modules[m]->boundary->resolve) status = scree_modules[m]->boundary->resolve(model, error);
    return status;
}

/// Does the packing of a prepare stage exist?
static scree_status check_prepare(const scree_model *model, int64_t index, scree_error *error)
{
    const scree_config_stage *stage = &model->config->stages[index];
    const scree_prepare_config *prepare = scree_config_prepared(stage);
    const scree_preparation *method = scree_modules[prepare->method]->preparation;
    bool in_3d = model->dimension == 3;
    scree_status status = method->check ? method->check(model, stage, error) : SCREE_OK;
    // A round sample's sides are not the user's; and a method that makes its box has judged it.
    if (status || prepare->outline != SCREE_SAMPLE_BOX || method->sizes_box) return status;
    bool shallow = in_3d && !isnan(prepare->depth) && prepare->depth < 2 * model->radius_max;
    if (shallow || (!isnan(prepare->width) && prepare->width < 2 * model->radius_max)) {
        char text[160];
        (void)snprintf(text, sizeof text, "a particle of radius %g m does not fit into a box %g m %s",
                       model->radius_max, shallow ? prepare->depth : prepare->width, shallow ? "deep" : "wide");
        return indexed_error(error, "stages", index, shallow ? "depth" : "width", text);
    }
    return SCREE_OK;
}

/// Reference velocity, phi and psi: those of the first loading stage under the pressure that it holds or that of the
/// last confine stage before it.
static scree_status resolve_loading(scree_model *model, scree_error *error)
{
    const scree_config *config = model->config;
    double pressure = NAN, rate = NAN;
    for (int64_t i = 0; i < config->stage_count && isnan(rate); i++) {
        const scree_config_stage *stage = &config->stages[i];
        if (scree_modules[stage->kind]->numbers->places) {
            scree_status status = check_prepare(model, i, error);
            if (status) return status;
        }
        if (scree_held_pressure(stage) > 0) pressure = scree_held_pressure(stage);
        rate = scree_model_loading_rate(model, stage);
    }
    model->reference_velocity = config->contact.reference_velocity;
    if (isnan(model->reference_velocity) && !isnan(rate)) model->reference_velocity = 2 * rate * model->mean_radius;
    for (int k = 0; k < scree_model_law_count(model); k++) {
        const scree_law *law = scree_law_get(model->laws[k].law);
        if (law->needs_slip_scale && !(model->reference_velocity > 0))
            return scree_error_refuse(error, "contact.reference_velocity", NULL,
                                      "%s needs a reference slip velocity: without a loading stage (2 rate <R>) "
                                      "give contact.reference_velocity",
                                      scree_modules[model->laws[k].law]->name);
        if (law->resolve)
            law->resolve(scree_config_law_keys(&config->contact, k), model->reference_velocity, &model->laws[k]);
    }
    model->phi = model->psi = NAN;
    if (isnan(rate) || isnan(pressure)) return SCREE_OK;
    double mass = scree_model_mean_mass(model);
    scree_quasistatic_numbers(model->dimension, (double)config->particles.count, mass, model->mean_radius,
                              model->thickness, rate, pressure, &model->phi, &model->psi);
    return SCREE_OK;
}

/// Whether a geometry serves all pairs of shapes of a case.
static bool serves_all(const scree_geometry *geometry, const scree_config_particles *particles)
{
    bool all = true;
    for (int64_t s = 0; s < scree_config_species_count(particles); s++)
        for (int64_t t = 0; t <= s; t++)
            all = all && geometry->serves(scree_modules[scree_config_shape(particles, s)]->shape,
                                          scree_modules[scree_config_shape(particles, t)]->shape);
    return all;
}

/// Geometry of all contacts, under laws of areas or not: its number among the geometries, in their order; -1: none.
static int geometry_of(const scree_config_particles *particles, bool areas, const scree_geometry **chosen)
{
    int number = 0;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        *chosen = scree_modules[m]->geometry;
        if (!*chosen) continue;
        if ((*chosen)->traits->areas == areas && serves_all(*chosen, particles)) return number;
        number++;
    }
    return -1;
}

/// Names of the laws that are of areas, or of those that are not.
static void list_laws(bool areas, char list[256])
{
    list[0] = 0;
    for (int m = 0, length = 0; m < SCREE_MODULE_COUNT; m++)
        if (scree_modules[m]->law && scree_modules[m]->law->traits[0].areas == areas)
            length +=
                snprintf(list + length, 256 - (size_t)length, "%s%s", length > 0 ? ", " : "", scree_modules[m]->name);
}

static scree_status resolve_geometry(scree_model *model, scree_error *error)
{
    const bool areas = scree_model_traits(model)->areas;
    const scree_geometry *chosen;
    for (int k = 1; k < scree_model_law_count(model); k++)
        if (scree_law_use_traits(&model->laws[k])->areas != areas)
            return scree_error_refuse(error, "contact.pairs", NULL,
                                      "laws of areas and others do not go together in one case");
    model->geometry = geometry_of(&model->config->particles, areas, &chosen);
    model->largest_gain = model->geometry >= 0 && chosen->traits->gains ? SCREE_LARGEST_GAIN : 1;
    if (model->geometry >= 0) return SCREE_OK;
    char others[256];
    list_laws(!areas, others);
    return scree_error_refuse(error, "contact.law", NULL,
                              "law %s has no meaning for particles of these shapes; those that may are: %s",
                              scree_modules[model->laws[0].law]->name, others);
}

/// What geometries with gains do not know beside laws that stick, which the rules of their shapes refuse: bonds, bodies
/// whose surfaces move, friction that asks for the coming step.
static scree_status check_gains(const scree_model *model, scree_error *error)
{
    if (!(model->largest_gain > 1)) return SCREE_OK;
    for (int64_t i = 0; i < model->config->stage_count; i++) {
        const scree_model of_stage = scree_model_of_stage(model, &model->config->stages[i]);
        if (scree_modules[model->config->stages[i].kind]->numbers->bonds)
            return scree_error_refuse(error, "stages", NULL,
                                      "bonds hold discs and spheres together: rounded polygons have none");
        if (scree_model_predicts(&of_stage))
            return scree_error_refuse(error, "contact.friction_update", NULL,
                                      "rounded polygons know the explicit update only");
    }
    for (int k = 0; k < scree_model_law_count(model); k++) {
        const scree_law_traits *traits = scree_law_use_traits(&model->laws[k]);
        if (traits->deforms)
            return scree_error_refuse(error, "particles.rounding", NULL,
                                      "polygons are rigid: particles that deform are discs");
    }
    return SCREE_OK;
}

static scree_status resolve_law(scree_model *model, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->resolve_law) status = scree_modules[m]->resolve_law(model, error);
    return status;
}

/// The law of `contact` holds pairs together, too, where it can: of all materials.
static void resolve_persistent(scree_model *model)
{
    const scree_law *law = scree_model_law(model);
    const scree_config_material *listed = model->config->materials;
    const scree_contact_space space = space_of(model);
    if (!law->holding) return;
    model->persistent.law = model->laws[0];
    model->persistent.law.option = model->laws[0].option | law->holding;
    memcpy(model->persistent.pairs, model->pairs, sizeof model->pairs);
    for (int i = 0; i < model->config->material_count; i++)
        for (int j = 0; j <= i; j++)
            if (model->law_of_pairs[i][j] != 0)
                model->persistent.pairs[i][j] = model->persistent.pairs[j][i] =
                    law->constants(&space, &listed[model->listed[i]], &listed[model->listed[j]]);
}

/// Rounds down to two significant digits.
static double two_digits_below(double value)
{
    double unit = pow(10, floor(log10(value)) - 1);
    return floor(value / unit) * unit;
}

/// What needs no more than a unit or the mean radius.
static void take_numbers(const scree_config *config, scree_model *model)
{
    const scree_config_boundary *boundary = &config->boundary;
    bool bounded = !isnan(boundary->servo_velocity);
    model->upkeep = (scree_upkeep){.every = (uint64_t)boundary->every * model->largest_step,
                                   .gap_limit = boundary->gap_limit,
                                   .hysteresis = boundary->gap_hysteresis};
    // Auto: a plate or a face may not cross a hundredth of the smallest radius in a step.
    model->servo = (scree_servo_limits){.gain = boundary->servo_gain,
                                        .velocity = bounded ? boundary->servo_velocity : INFINITY,
                                        .travel = bounded ? INFINITY : 0.01 * model->radius_min};
    model->overlap_limit = config->guard.overlap;
    model->energy_growth = config->guard.energy_growth;
    model->stability_warns = config->guard.stability == SCREE_STABILITY_WARNS;
    model->measure = config->measure;
    model->output = config->output;
}

/// Overlap over the smaller radius at which two grains of materials stick without a load; 0: they do not.
static double sunk(const scree_model *model, int one, int other)
{
    const scree_law_use *law = scree_model_law_between(model, one, other);
    const double least = model->radius_min;
    return scree_law_get(law->law)->elastic->overlap(&model->pairs[one][other], 0.5 * least, 0) / least;
}

/// Cohesion may pull small grains into each other deeper than the guard lets anything be.
static scree_status check_cohesion(const scree_model *model, scree_error *error)
{
    const double limit = model->config->guard.overlap;
    for (int i = 0; i < model->material_count; i++)
        for (int j = 0; j <= i; j++) {
            const double deep = sunk(model, i, j);
            if (!(deep > limit)) continue;
            char text[SCREE_PATH_BYTES + 256];
            (void)snprintf(text, sizeof text,
                           "cohesion too strong: two grains of %.3g m sink into each other by %.2g of their radius "
                           "without a load, and guard.overlap is %g; lower surface_energy or work_of_adhesion, or "
                           "raise young_modulus or guard.overlap",
                           model->radius_min, deep, limit);
            return indexed_error(error, "materials", model->listed[i], "surface_energy", text);
        }
    return SCREE_OK;
}

/// Whether adhesion holds some pairs, which makes them stiffer than their load would.
static const char *for_cohesion(const scree_model *model)
{
    int sticks = 0;
    for (int i = 0; i < model->material_count; i++)
        for (int j = 0; j <= i; j++) sticks += sunk(model, i, j) > 0;
    return sticks ? " (the cohesion of this case counts in it: less surface_energy allows a larger one)" : "";
}

static scree_status resolve_step(scree_model *model, scree_error *error)
{
    const scree_config_integrator *integrator = &model->config->integrator;
    model->critical_step = scree_critical_step_estimate(model);
    scree_steps (*lengths)(const void *own) = scree_integrator_get(model->scheme)->steps;
    scree_steps steps = lengths ? lengths(integrator->own) : (scree_steps){1, 1, 0};
    model->largest_step = steps.largest;
    model->large_multiple = steps.multiple;
    model->small_steps = steps.small;
    double ticks = (double)model->largest_step;
    model->step = isnan(integrator->step) ? integrator->step_fraction * model->critical_step / ticks : integrator->step;
    const bool warns = model->config->guard.stability == SCREE_STABILITY_WARNS;
    if (warns || ticks * model->step <= model->critical_step) return SCREE_OK;
    if (model->largest_step > 1)
        return scree_error_refuse(
            error, "integrator.step", NULL,
            "the large step, %g steps of %.3g s, is above the critical step of this case, %.3g s, and may "
            "be unstable; give %.2g s, or auto, or guard.stability: warn to see",
            ticks, model->step, model->critical_step, two_digits_below(0.5 * model->critical_step / ticks));
    scree_status status = scree_error_refuse(
        error, "integrator.step", NULL,
        "a step of %.3g s is above the critical step of this case, %.3g s%s, and may be unstable; "
        "give %.2g s, or auto%s, or guard.stability: warn to see",
        model->step, model->critical_step, for_cohesion(model), two_digits_below(0.5 * model->critical_step),
        scree_critical_step_advice(model, (char[96]){0}));
    if (error) {
        (void)snprintf(error->value, sizeof error->value, "%.6g s", model->step);
        (void)snprintf(error->accepted, sizeof error->accepted, "up to %.3g s", two_digits_below(model->critical_step));
    }
    return status;
}

static void extend_reach(scree_model *model, int law, const scree_pair_constants *pair)
{
    const scree_law *face = scree_law_get(model->laws[law].law);
    double *reach = &model->laws[law].number[SCREE_LAW_REACH];
    if (scree_law_use_traits(&model->laws[law])->necks)
        *reach = fmax(*reach, (1 + 1e-9) * face->neck(pair, scree_model_largest_radius(model)));
}

/// How far necks reach: those of the largest bodies on walls, where R_eff is largest.
static void resolve_reach(scree_model *model)
{
    for (int i = 0; i < model->material_count + model->added_materials; i++) {
        extend_reach(model, model->law_of_walls[i], &model->walls[i]);
        for (int j = 0; j <= i; j++) extend_reach(model, model->law_of_pairs[i][j], &model->pairs[i][j]);
        for (int64_t w = 0; w < model->wall_count; w++)
            extend_reach(model, model->law_of_surfaces[w][i], &model->surfaces[w][i]);
    }
}

scree_status scree_model_build(const scree_config *config, scree_model *model, scree_error *error)
{
    *model = (scree_model){
        .name = config->name,
        .seed = (uint64_t)config->seed,
        .count = (uint64_t)config->particles.count,
        .periodic = (unsigned)config->boundary.periodic,
        .dimension = (int)config->dimension,
        .shape = scree_modules[config->particles.shape]->shape,
        .laws = {{.law = config->contact.law}},
        .pair_laws = (int)config->contact.pair_count,
        .scheme = config->integrator.scheme,
        .gravity_of_case = config->gravity,
        .walls_of_case = config->walls,
        .wall_count = config->wall_count,
        .loads = config->loads,
        .load_count = config->load_count,
        .sources = config->sources,
        .source_count = config->source_count,
        .selections = config->selections,
        .selection_count = config->selection_count,
        .stages = config->stages,
        .stage_count = config->stage_count,
        .config = config,
    };
    for (int k = 0; k < 3; k++) model->gravity[k] = scree_schedule_at(&config->gravity[k], 0);
    for (int k = 1; k <= model->pair_laws; k++) model->laws[k].law = scree_config_law(&config->contact, k);
    scree_status status = resolve_geometry(model, error);
    if (!status) status = resolve_materials(model, error);
    if (!status) status = resolve_particles(model, error);
    if (!status) status = resolve_pairs(model, error);
    if (!status) status = resolve_law(model, error);
    if (!status) status = resolve_loading(model, error);
    if (!status) status = check_gains(model, error);
    if (!status) resolve_persistent(model);
    if (!status) status = check_cohesion(model, error);
    if (!status) status = resolve_step(model, error);
    if (!status) take_numbers(config, model);
    if (!status) status = resolve_boundaries(model, error);
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->resolve) status = scree_modules[m]->resolve(model, error);
    if (!status) resolve_reach(model);
    return status;
}
