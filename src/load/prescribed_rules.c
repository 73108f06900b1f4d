/// What prescriptions must fulfil before a run: names that are there, components that exist, nothing said twice.
/// Whether two that act on different selections meet in a body shows when a stage begins (prescribed_begin.c).
#include "base/vectors.h"
#include "case/check.h"
#include "load/prescribed.h"
#include "module/integrator.h"

#include <stdio.h>
#include <string.h>

static const char *const motion_keys[] = {"velocity_x", "velocity_y", "velocity_z", "spin_x", "spin_y", "spin_z"};
static const char *const push_keys[] = {"force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z"};

/// One load under judgement.
typedef struct judged {
    scree_reader *reader;
    const scree_config *config;
    const scree_prescribed_config *own;
    int64_t index;
    char path[SCREE_PATH_BYTES]; ///< that of the key which was asked for last
} judged;

static bool gives(const judged *j, const char *key)
{
    return scree_node_find(scree_node_at(scree_node_find(j->reader->root, "loads"), (size_t)j->index), key) != NULL;
}

/// Components that the dimension has, and each said once.
static void check_components(judged *j)
{
    bool says = gives(j, "gradient");
    for (int d = 0; d < SCREE_COMPONENTS; d++) {
        bool drives = scree_prescribed_drives(j->own, d), pushes = scree_prescribed_pushes(j->own, d);
        const char *key = gives(j, motion_keys[d]) ? motion_keys[d] : pushes ? push_keys[d] : "gradient";
        says = says || drives || pushes || gives(j, motion_keys[d]) || gives(j, push_keys[d]);
        if ((drives || pushes) && !scree_component_exists((int)j->config->dimension, d))
            scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, key), NULL,
                              "two dimensions have velocities and forces along x and y, spin and torque about z");
        else if (drives && pushes)
            scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, push_keys[d]), NULL,
                              "%s is prescribed: a force on it would change nothing; leave one of them out",
                              d < 3 ? "the velocity in this direction" : "the spin about this axis");
    }
    for (int k = 0; k < 9 && j->config->dimension == 2; k++)
        if (!isnan(j->own->gradient[k]) && k % 3 == 2 && k < 6)
            scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "gradient"), "xx, xy, yx, yy",
                              "there is no z in two dimensions");
    if (!says)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "selection"), NULL,
                          "nothing is prescribed: give a velocity, a spin, a gradient, a force or a torque");
}

static void check_profile(judged *j, bool gradient, bool moves)
{
    const bool uniform = scree_load_profile_is_uniform(&j->own->profile);
    if (!gradient && uniform && scree_length(j->own->origin) > 0)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "origin"), "[0, 0]",
                          "not used without gradient or profile");
    if (!uniform && !moves)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "profile"), "uniform",
                          "not used without a velocity or a spin, which it multiplies");
    if (!uniform && j->own->profile.axis == 2 && j->config->dimension == 2)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "axis"), "x, y",
                          "there is no z in two dimensions");
}

/// Keys that would have no effect.
static void check_use(judged *j)
{
    bool gradient = false, force = false, push = false, moves = false;
    for (int k = 0; k < 9; k++) gradient = gradient || !isnan(j->own->gradient[k]);
    for (int d = 0; d < SCREE_COMPONENTS; d++) {
        moves = moves || !isnan(scree_schedule_at(&j->own->motion[d], 0));
        push = push || scree_prescribed_pushes(j->own, d);
        force = force || (d < 3 && scree_prescribed_pushes(j->own, d));
    }
    // A resolved case gives the defaults, too.
    bool scaled = !scree_schedule_is_constant(&j->own->factor) || scree_schedule_at(&j->own->factor, 0) != 1;
    if (!gradient && scaled)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "gradient_factor"), "1",
                          "not used without gradient");
    check_profile(j, gradient, moves);
    if (!force && j->own->attack == SCREE_ATTACK_SURFACE)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "attack"), "centre",
                          "there is no force that acts on the surface");
    if (!push && j->own->per == SCREE_PER_SELECTION)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "per"), "body",
                          "not used without a force or a torque");
}

/// What a piston is told: how fast, one velocity for all.
static void check_until(judged *j)
{
    bool linear = false, moves = false;
    if (!(j->own->until_force > 0)) return;
    for (int k = 0; k < 9; k++) linear = linear || !isnan(j->own->gradient[k]);
    for (int d = 0; d < 3; d++) {
        const double velocity = scree_schedule_at(&j->own->motion[d], 0);
        moves = moves || (!isnan(velocity) && (velocity != 0 || !scree_schedule_is_constant(&j->own->motion[d])));
    }
    if (!moves)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "until_force"), NULL,
                          "there is no velocity that could end with it: give velocity_x, velocity_y or velocity_z");
    else if (linear || !scree_load_profile_is_uniform(&j->own->profile))
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "until_force"), "auto",
                          "all particles of a selection that moves until a force have one velocity: leave out gradient "
                          "and profile");
}

/// Names of columns and results are told apart.
static void check_name(judged *j)
{
    const char *name = scree_prescribed_name(j->own);
    for (int64_t i = 0; name && i < j->index; i++) {
        const scree_prescribed_config *other = scree_prescribed_config_of(j->config->loads, i);
        if (other && scree_prescribed_name(other) && strcmp(scree_prescribed_name(other), name) == 0) {
            scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "name"), NULL,
                              "loads.%lld is called '%s' too: give this one a name of its own", (long long)i, name);
            return;
        }
    }
    for (int64_t i = 0; name && i < j->config->wall_count; i++)
        if (j->config->walls[i].name && strcmp(j->config->walls[i].name, name) == 0)
            scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "name"), NULL,
                              "a wall is called '%s' too", name);
}

/// Another load before this one that says the same component of the same selection in the same stage.
static void check_others(judged *j)
{
    int64_t mine[2], others[2];
    scree_load_stages(j->config->stages, j->config->stage_count, j->own->from, j->own->until, mine);
    for (int64_t i = 0; i < j->index; i++) {
        const scree_prescribed_config *other = scree_prescribed_config_of(j->config->loads, i);
        if (!other || !other->selection || !j->own->selection || strcmp(other->selection, j->own->selection) != 0)
            continue;
        scree_load_stages(j->config->stages, j->config->stage_count, other->from, other->until, others);
        if (mine[0] > others[1] || others[0] > mine[1]) continue;
        for (int d = 0; d < SCREE_COMPONENTS; d++) {
            bool held = scree_prescribed_drives(other, d), drives = scree_prescribed_drives(j->own, d);
            bool pushed = scree_prescribed_pushes(other, d), pushes = scree_prescribed_pushes(j->own, d);
            if (!(held || pushed) || !(drives || pushes)) continue;
            const char *key = !drives ? push_keys[d] : gives(j, motion_keys[d]) ? motion_keys[d] : "gradient";
            scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, key), NULL,
                              "loads.%lld prescribes %s of the same particles", (long long)i,
                              held ? motion_keys[d] : push_keys[d]);
        }
    }
}

/// A boundary that imposes velocities on bodies of its own choice.
static void check_boundaries(judged *j)
{
    int64_t range[2];
    bool drives = false;
    for (int d = 0; d < SCREE_COMPONENTS; d++) drives = drives || scree_prescribed_drives(j->own, d);
    scree_load_stages(j->config->stages, j->config->stage_count, j->own->from, j->own->until, range);
    for (int64_t i = range[0] < 0 ? 0 : range[0]; drives && i <= range[1]; i++) {
        const scree_boundary *boundary = scree_config_held_by(j->config, i);
        if (!boundary || !boundary->equal_steps) continue;
        scree_rule_refuse(j->reader, scree_element_path(j->path, "loads", j->index, "selection"), NULL,
                          "the boundary of stages.%lld imposes velocities itself: end before it with `until`, or "
                          "prescribe forces",
                          (long long)i);
        return;
    }
}

/// Whether it is refused: what drives a body finds its force from the next kick of a leapfrog.
static bool refuse_scheme(scree_reader *reader, const scree_config *config)
{
    const int scheme = config->integrator.scheme;
    if (scheme < 0 || !scree_integrator_get(scheme)->velocity) return false;
    scree_rule_refuse(
        reader, "integrator.scheme", scree_rule_choices(reader, "integrator.scheme", ", ", scree_scheme_is_leapfrog),
        "a load prescribes motions by forces that a leapfrog turns into velocities: choose such a scheme, "
        "or leave the load out");
    return true;
}

void scree_prescribed_rules(scree_reader *reader, const scree_config *config)
{
    bool refused = false;
    for (int64_t i = 0; i < config->load_count; i++) {
        judged j = {
            .reader = reader, .config = config, .index = i, .own = scree_prescribed_config_of(config->loads, i)};
        if (!j.own) continue;
        refused = refused || refuse_scheme(reader, config);
        scree_element_path(j.path, "loads", i, "selection");
        (void)scree_rule_is_selection(reader, config, j.path, j.own->selection);
        scree_load_check_stages(j.reader, j.config, j.index, j.own->from, j.own->until);
        check_components(&j);
        check_use(&j);
        check_until(&j);
        check_name(&j);
        check_others(&j);
        check_boundaries(&j);
    }
}
