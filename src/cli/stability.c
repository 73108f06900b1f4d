/// scree stability CASE|DIR: what explicit steps and stiffnesses the specimen bears.
#include "cli/case_argument.h"
#include "cli/specimen_argument.h"
#include "cli/terminal.h"

#include <math.h>
#include <string.h>

static void print_row(const char *name, double value, const char *unit, const char *meaning)
{
    if (!isnan(value)) printf("%-24s %-12.6g %-4s %s\n", name, value, unit, meaning);
}

static void print_count(const char *name, size_t value)
{
    printf("%-24s %zu\n", name, value);
}

static void print_steps(const scree_stability *s)
{
    print_row("step", s->step, "s", "of the case");
    print_row("critical_step", s->critical_step, "s", "rigid particles, dashpots counted");
    print_row("critical_step_undamped", s->critical_step_undamped, "s", "the same without dashpots");
    print_row("step_of_bodies", s->step_of_bodies, "s", "least 2 sqrt(m / k) of a body among standing ones");
    print_row("step_of_extremes", s->step_of_extremes, "s", "sqrt(m_min / k_max)");
}

static void print_deformation(const scree_stability *s)
{
    if (isnan(s->spectral_radius)) return;
    print_row("spectral_radius", s->spectral_radius, "1", "of the iteration of forces; explicit below 1");
    print_row("stiffness_ratio", s->stiffness_ratio, "m", "mean k_n / E_p");
    print_row("largest_ratio", s->largest_ratio, "m", "k_n / E_p at which the radius is 1");
    print_row("ratio_at_step", s->ratio_at_step, "m", "k_n / E_p that explicit strains bear at the step of the case");
    print_row("row_ratio", s->row_ratio, "m", "the same of an unbounded row");
    print_row("square_ratio", s->square_ratio, "m", "of a square (simple cubic) lattice");
    print_row("hexagonal_ratio", s->hexagonal_ratio, "m", "of a hexagonal (face-centred cubic) lattice");
    print_row("explicit_step", s->explicit_step, "s",
              s->explicit_step > 0 ? "critical step, strain of the last forces"
                                   : "none is stable: lower k_n / E_p, or relax the strain, or solve for it");
    print_row("relaxed_step", s->relaxed_step, "s", "critical step, strain relaxed by `relaxation`");
    print_row("relaxation", s->relaxation, "1", "");
    print_row("implicit_step", s->implicit_step, "s", "critical step, strain solved for");
    print_row("has_potential", s->has_potential, "1",
              s->has_potential ? "" : "strains do not act on slips: vibrations may grow at any step without damping");
}

/// Both files of a figure, whichever of their names is given.
static scree_status draw(scree_simulation *s, const scree_particle_elasticity *elasticity, const char *name,
                         scree_error *error)
{
    char path[4096];
    size_t length = strlen(name);
    if (length > 4 && (strcmp(name + length - 4, ".svg") == 0 || strcmp(name + length - 4, ".png") == 0)) length -= 4;
    if (length >= sizeof path) length = sizeof path - 1;
    memcpy(path, name, length);
    path[length] = '\0';
    return scree_simulation_draw_mode(s, elasticity, path, error);
}

scree_status scree_verb_stability(const scree_command *command)
{
    scree_specimen_argument argument;
    scree_stability stability;
    scree_error error = {0};
    scree_status status = scree_specimen_argument_read(command, &argument);
    if (status) return status;
    status = scree_simulation_stability(argument.simulation, argument.elasticity, &stability, &error);
    if (status) {
        status = scree_terminal_error("stability", &error);
    } else {
        print_count("bodies", stability.bodies);
        print_count("contacts", stability.contacts);
        print_row("normal_stiffness", stability.normal_stiffness, "N/m", "mean over the contacts");
        print_steps(&stability);
        print_deformation(&stability);
    }
    const char *figure = scree_command_value(command, "output");
    if (!status && figure) {
        status = draw(argument.simulation, argument.elasticity, figure, &error);
        if (status) status = scree_terminal_error("stability", &error);
    }
    scree_specimen_argument_free(&argument);
    return status;
}
