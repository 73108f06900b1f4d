/// What a membrane's keys become. It is made of the material of the particles (of the first species) without friction,
/// as one more material. Its springs must not swing faster than the step can follow, and in 3D no grain may slip
/// through.
#include "boundary/membrane.h"

#include <math.h>
#include <stdio.h>

static const scree_membrane_config *own_config(const scree_model *model)
{
    return scree_config_own(&scree_module_membrane, "boundary", model->config->boundary.own);
}

/// Stiffness of the springs of a membrane and the step that follows them: 2 / omega of the fastest oscillation. A chain
/// has omega^2 = 4 k / m; a triangular sheet 6 k / m when it is regular, and less than 8 k / m as long as no direction
/// has more than four thirds of its springs. membrane.c has the stiffness of the sheet.
static double resolve_springs(const scree_model *model, scree_membrane_numbers *own)
{
    bool in_3d = model->dimension == 3;
    own->stiffness = (in_3d ? sqrt(0.75) : 1) * own_config(model)->membrane_stiffness;
    double mass = scree_model_mass(model, own->material, own->radius);
    return sqrt(mass / own->stiffness / (in_3d ? 2 : 1));
}

/// A sheet needs no large bodies to be tight; a finer one lies closer to the grains and bears more stretch. But bodies
/// smaller than every grain would need a smaller step.
static double resolve_radius(const scree_model *model)
{
    double radius = own_config(model)->membrane_radius;
    double usual =
        model->dimension == 3 ? fmax(0.75 * model->mean_radius, model->radius_min) : 1.25 * model->mean_radius;
    return isnan(radius) ? usual : radius;
}

/// Two spheres of the sheet that touch each other and their plate leave a hole of a quarter of their radius (sheet.c).
static scree_status check_radius(const scree_model *model, double radius, scree_error *error)
{
    double hole = 0.25 * radius;
    if (model->dimension == 2 || hole < model->radius_min) return SCREE_OK;
    return scree_error_refuse(
        error, "boundary.membrane_radius", NULL,
        "between spheres of a membrane of radius %.3g m a sphere of %.3g m slips through, and the "
        "smallest has %.3g m: give a smaller radius",
        radius, hole, model->radius_min);
}

static void copy_material(scree_model *model, int from, int to)
{
    for (int i = 0; i < to; i++) {
        model->pairs[to][i] = model->pairs[i][to] = model->pairs[from][i];
        model->law_of_pairs[to][i] = model->law_of_pairs[i][to] = model->law_of_pairs[from][i];
    }
    model->pairs[to][to] = model->pairs[from][from];
    model->law_of_pairs[to][to] = model->law_of_pairs[from][from];
    model->walls[to] = model->walls[from];
    model->law_of_walls[to] = model->law_of_walls[from];
    for (int w = 0; w < SCREE_SURFACES; w++) {
        model->surfaces[w][to] = model->surfaces[w][from];
        model->law_of_surfaces[w][to] = model->law_of_surfaces[w][from];
    }
    model->density[to] = model->density[from];
}

scree_status scree_membrane_resolve(scree_model *model, scree_error *error)
{
    scree_membrane_numbers *own = scree_model_reserve_numbers(model, SCREE_SLOT_membrane);
    if (model->material_count == SCREE_MAX_MATERIALS)
        return scree_error_refuse(error, "materials", NULL, "a case with a membrane has at most %d materials",
                                  SCREE_MAX_MATERIALS - 1);
    own->material = model->material_count;
    copy_material(model, model->species[0].material, own->material);
    scree_model_make_frictionless(model, own->material);
    model->added_materials = 1;
    model->added_radius = own->radius = resolve_radius(model);
    double limit = resolve_springs(model, own), step = (double)model->large_multiple * model->step;
    if (step <= limit) return check_radius(model, own->radius, error);
    return scree_error_refuse(
        error, "boundary.membrane_stiffness", NULL,
        "the springs of the membrane need a step of at most %.2g s, this case has %.2g s: give a smaller "
        "stiffness or step",
        limit, step);
}
