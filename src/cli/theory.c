/// Values of a theory on the terminal and in a folder.
#include "cli/theory.h"
#include "cli/terminal.h"

#include <string.h>

/// The options by which theories' own names are given, where they are called otherwise.
static const char *const other_names[][2] = {
    {"slope", "phi"}, {"poisson_ratio", "nu"}, {"stiffness_ratio", "kt"}, {"thickness", "depth"}};

static bool has_option(const scree_command *command, const char *name)
{
    for (const scree_verb_option *o = command->verb->option; o->name; o++)
        if (strcmp(o->name, name) == 0) return true;
    return false;
}

/// A parameter of a theory that is wrong is called by the option that gives it.
static void name_option(const scree_command *command, scree_error *error)
{
    char name[sizeof error->field];
    (void)snprintf(name, sizeof name, "%s", error->field);
    for (char *c = name; *c; c++) *c = *c == '_' ? '-' : *c;
    for (size_t k = 0; k < sizeof other_names / sizeof *other_names && !has_option(command, name); k++)
        if (strcmp(error->field, other_names[k][0]) == 0) (void)snprintf(name, sizeof name, "%s", other_names[k][1]);
    if (name[0] && has_option(command, name)) (void)snprintf(error->field, sizeof error->field, "--%.60s", name);
}

scree_status scree_theory_show(const scree_command *command, scree_theory *theory, scree_status status,
                               scree_error *error)
{
    const char *folder = scree_command_value(command, "output");
    const scree_theory_value *value;
    const size_t count = theory && !status ? scree_theory_values(theory, &value) : 0;
    for (size_t k = 0; k < count; k++)
        printf("%-26s %-13.7g %-5s %s\n", value[k].name, value[k].value, value[k].unit, value[k].meaning);
    if (!status && folder) status = scree_theory_write(theory, folder, error);
    if (status) name_option(command, error);
    if (status) status = scree_terminal_error(command->verb->name, error);
    scree_theory_free(theory);
    return status;
}
