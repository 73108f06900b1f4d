/// scree check CASE: the resolved case, and what it amounts to as comments below it.
#include "cli/case_argument.h"
#include "cli/terminal.h"

#include <math.h>

enum { TEXT = 64 };

static void print_line(const char *name, const char *value, const char *more)
{
    printf("# %-20s %s%s%s\n", name, value, more[0] ? ", " : "", more);
}

static void print_quantity(const char *name, double value, const char *unit)
{
    char text[TEXT];
    scree_human_quantity(text, sizeof text, value, unit);
    print_line(name, text, "");
}

static void print_coefficient(const char *name, double value, const char *meaning)
{
    char text[TEXT];
    (void)snprintf(text, sizeof text, "%.3g", value);
    if (!isnan(value)) print_line(name, text, meaning);
}

static void print_duration(const char *name, double seconds, const char *more)
{
    char text[TEXT];
    scree_human_duration(text, sizeof text, seconds);
    print_line(name, isnan(seconds) ? "not known" : text, more);
}

/// Of one thread, and what it goes to.
static void print_time(const scree_case_summary *summary)
{
    char rate[TEXT], more[2 * TEXT];
    scree_human_count(rate, sizeof rate, summary->rate);
    (void)snprintf(more, sizeof more, "at %s particle-steps/s", rate);
    print_duration("time needed", summary->seconds, "on one thread");
    if (isnan(summary->seconds)) return;
    print_duration("  stepping", summary->stepping, more);
    print_duration("  output", summary->output, "samples, snapshots, results");
    print_duration("  figures", summary->figures, "");
}

static void print_summary(const scree_case_summary *summary)
{
    char text[TEXT], more[2 * TEXT], part[TEXT];
    printf("\n# --- what this case amounts to ---\n");
    (void)snprintf(text, sizeof text, "%llu", (unsigned long long)summary->particles);
    print_line("particles", text, "");
    print_quantity("mean radius", summary->mean_radius, "m");
    print_quantity("thickness", summary->thickness, "m");
    print_coefficient("phi", summary->phi, "quasistatic coefficient (inertia against pressure)");
    print_coefficient("inertial number", summary->inertial_number, "of the grains at the imposed rate");
    print_coefficient("psi", summary->psi, "size coefficient (grain against sample)");
    if (!isnan(summary->reference_velocity)) print_quantity("reference velocity", summary->reference_velocity, "m/s");
    scree_human_quantity(text, sizeof text, summary->step, "s");
    scree_human_quantity(part, sizeof part, summary->critical_step, "s");
    (void)snprintf(more, sizeof more, "%s%.2g of the critical step of %s",
                   summary->largest_step > 1 ? "the large one " : "",
                   summary->step * (double)summary->largest_step / summary->critical_step, part);
    print_line("time step", text, more);
    if (summary->largest_step > 1) {
        (void)snprintf(text, sizeof text, "%llu", (unsigned long long)summary->largest_step);
        scree_human_quantity(part, sizeof part, summary->step * (double)summary->largest_step, "s");
        (void)snprintf(more, sizeof more, "small steps in a large one of %s", part);
        print_line("N_S", text, more);
    }
    scree_human_count(text, sizeof text, summary->steps);
    print_line("steps", text, "");
    print_time(summary);
    print_quantity("memory", summary->memory, "B");
}

static void print_warning(void *user, const char *line)
{
    (void)user;
    print_line("warning", line, "");
}

scree_status scree_verb_check(const scree_command *command)
{
    scree_case *c;
    scree_status status = scree_case_argument_read(command, command->argument[0], &c);
    if (status) return status;
    scree_case_summary summary;
    scree_error error = {0};
    status = scree_case_summarise(c, &summary, &error);
    if (!status) status = scree_case_write(c, stdout, &error);
    if (!status) {
        print_summary(&summary);
        status = scree_case_warn(c, print_warning, NULL, &error);
    }
    if (status) status = scree_terminal_error("check", &error);
    scree_case_free(c);
    return status;
}
