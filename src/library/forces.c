/// Own forces of a program: registering and removing them. What they do in a step is in run/own_force.c.
#include "library/handle.h"

#include "run/step.h"

#include <stdlib.h>
#include <string.h>

static size_t find(const scree_own_force_list *list, const char *name)
{
    size_t k = 0;
    while (k < list->count && strcmp(list->force[k].name, name) != 0) k++;
    return k;
}

static scree_status check(const scree_simulation *s, const scree_own_force *force, scree_error *error)
{
    scree_status status = handle_refuse_inside(s, error);
    if (status) return status;
    if (!force->name || !force->name[0] || !force->function)
        return scree_error_set(error, SCREE_ERROR_INPUT, "an own force needs a name and a function");
    if (find(&s->forces, force->name) < s->forces.count)
        return scree_error_set(error, SCREE_ERROR_INPUT, "there is an own force '%s' already", force->name);
    bool none = !(force->largest_force > 0) && !(force->largest_torque > 0);
    if (none || !(force->largest_force >= 0 && isfinite(force->largest_force)) ||
        !(force->largest_torque >= 0 && isfinite(force->largest_torque)))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "own force '%s': largest_force %g, largest_torque %g (accepted: finite, at least 0, not "
                               "both 0)",
                               force->name, force->largest_force, force->largest_torque);
    return SCREE_OK;
}

/// A stage that has begun has made its list of passes.
static void use(scree_simulation *s)
{
    if (s->stage) scree_step_compile(s);
}

scree_status scree_simulation_add_force(scree_simulation *s, const scree_own_force *force, scree_error *error)
{
    scree_own_force_list *list = &s->forces;
    scree_status status = check(s, force, error);
    if (status) return status;
    if (list->count == list->capacity) {
        status = scree_reallocate(&list->force, list->count, list->capacity + 4, sizeof *list->force, error);
        if (status) return status;
        list->capacity += 4;
    }
    char *name = strdup(force->name);
    if (!name) return scree_error_set_memory(error, strlen(force->name) + 1);
    list->force[list->count] = *force;
    list->force[list->count++].name = name;
    use(s);
    return SCREE_OK;
}

scree_status scree_simulation_remove_force(scree_simulation *s, const char *name, scree_error *error)
{
    scree_own_force_list *list = &s->forces;
    scree_status status = handle_refuse_inside(s, error);
    if (status) return status;
    size_t k = find(list, name);
    if (k == list->count) return scree_error_set(error, SCREE_ERROR_INPUT, "there is no own force '%s'", name);
    free((char *)(uintptr_t)list->force[k].name);
    list->force[k] = list->force[--list->count];
    use(s);
    return SCREE_OK;
}
