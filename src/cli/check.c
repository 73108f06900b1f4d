/// scree check CASE: the resolved case, and what it amounts to as comments below it. scree check DIR: what is whole in
/// the folder of a run, and from where it can go on.
#include "cli/case_argument.h"
#include "cli/specimen_argument.h"
#include "cli/terminal.h"

#include <math.h>
#include <string.h>

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
    print_duration("time needed", summary->seconds,
                   summary->sleeps ? "on one thread, if no particle sleeps" : "on one thread");
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
    print_coefficient("Tabor parameter", summary->tabor, "of two mean grains: JKR above 5, DMT below 0.1");
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

/// Of one of several processes.
static void print_rank(const scree_case_rank *rank, long processes)
{
    char text[TEXT], more[4 * TEXT], part[TEXT];
    (void)snprintf(text, sizeof text, "%ld", processes);
    (void)snprintf(more, sizeof more, "mpirun -n %ld; of one of them, in the mean:", processes);
    print_line("processes", text, more);
    (void)snprintf(text, sizeof text, "%.4g", rank->bodies);
    (void)snprintf(more, sizeof more, "and about %.3g of others near them", rank->ghosts);
    print_line("  particles", text, more);
    scree_human_quantity(text, sizeof text, rank->sent, "B");
    print_line("  sends", text, "a step, without what lists and whole samples take");
    print_duration("  time needed", rank->seconds, "with a core of its own, without messages");
    if (!isnan(rank->seconds)) {
        print_duration("    preparation", rank->preparation, "of the whole sample, by process 0: the others wait");
        print_duration("    stepping", rank->stepping, "its part");
        print_duration("    lists", rank->lists, "of the whole sample, where process 0 looks at it");
        print_duration("    output", rank->output, "samples, files, figures: process 0, the others wait");
    }
    scree_human_quantity(text, sizeof text, rank->memory[1], "B");
    scree_human_quantity(part, sizeof part, rank->memory[0], "B");
    (void)snprintf(more, sizeof more, "of the fullest part; process 0, which has the whole sample at times, %s", part);
    print_line("  memory", text, more);
}

static void print_warning(void *user, const char *line)
{
    (void)user;
    print_line("warning", line, "");
}

/// Limits of bonded or deformable particles, beside the estimate of the step.
static void print_limits(scree_limits_known known, const scree_stability *s)
{
    char text[TEXT], more[2 * TEXT];
    const bool deforms = !isnan(s->stiffness_ratio);
    if (known == SCREE_LIMITS_LATER)
        print_line("limits", "not known yet",
                   "the specimen comes from stages that take steps: `scree stability --at STAGE`");
    if (known == SCREE_LIMITS_EXACT) {
        scree_human_quantity(text, sizeof text, s->critical_step, "s");
        print_line("critical step", text, "of the specimen, rigid particles");
    }
    if (known == SCREE_LIMITS_EXACT && deforms) {
        scree_human_quantity(text, sizeof text, s->explicit_step, "s");
        print_line("", text, "with explicit strains");
        scree_human_quantity(text, sizeof text, s->relaxed_step, "s");
        print_line("", text, "with relaxed strains");
    }
    if (!deforms) return;
    (void)snprintf(text, sizeof text, "%.4g m", s->stiffness_ratio);
    if (known == SCREE_LIMITS_EXACT)
        (void)snprintf(more, sizeof more, "explicit strains bear %.4g m at this step, %.4g m at a small one",
                       s->ratio_at_step, s->largest_ratio);
    else
        (void)snprintf(more, sizeof more,
                       "explicit strains bear about %.3g m in a hexagonal lattice, %.3g m in a square one",
                       s->hexagonal_ratio, s->square_ratio);
    print_line("k_n / E", text, more);
}

/// What only shows when the first stage begins: grains behind walls, a source or an outlet within one. Large samples
/// are left to the run, which stops as early.
static scree_status try_begin(const scree_case *c, const scree_case_summary *summary, scree_error *error)
{
    enum { MOST = 20000 };
    scree_simulation *s;
    if (summary->particles > MOST) return SCREE_OK;
    scree_status status = scree_simulation_create(c, 1, &s, error);
    if (!status) status = scree_simulation_begin_stage(s, NULL, error);
    scree_simulation_free(s);
    return status == SCREE_ERROR_INPUT ? status : SCREE_OK;
}

/// What can be gone on from, for the last lines of a folder's report.
typedef struct folder_report {
    char checkpoint[TEXT], snapshots[8 * TEXT];
    size_t more; ///< snapshots that found no room
} folder_report;

static void print_item(void *user, const scree_folder_item *item)
{
    folder_report *report = user;
    printf("%-22s %-10s %s\n", item->name, item->state, item->text);
    if (!item->restart) return;
    // The newest checkpoint comes last.
    if (!item->snapshot) {
        (void)snprintf(report->checkpoint, sizeof report->checkpoint, "%s", item->name);
        return;
    }
    size_t length = strlen(report->snapshots), room = sizeof report->snapshots - length;
    if (room < 24)
        report->more++;
    else
        (void)snprintf(report->snapshots + length, room, " %lld", (long long)item->index);
}

static scree_status check_folder(const char *folder)
{
    scree_error error = {0};
    folder_report report = {0};
    scree_status status = scree_folder_check(folder, print_item, &report, &error);
    if (report.checkpoint[0]) printf("\n%s: scree run --restart %s\n", report.checkpoint, folder);
    if (report.snapshots[0]) {
        printf("%ssnapshots%s", report.checkpoint[0] ? "" : "\n", report.snapshots);
        if (report.more > 0) printf(" and %zu more", report.more);
        printf(": scree run --restart %s --from NUMBER\n", folder);
    }
    return status ? scree_terminal_error("check", &error) : SCREE_OK;
}

/// Says what one of the processes takes, if the call asks for several.
static scree_status divide(const scree_case *c, const scree_case_summary *summary, long processes, scree_error *error)
{
    scree_case_rank rank;
    if (processes == 0) return SCREE_OK;
    scree_status status = scree_case_divide(c, summary, (int)processes, &rank, error);
    if (!status) print_rank(&rank, processes);
    return status;
}

static scree_status check_case(const scree_command *command, long processes)
{
    scree_case *c;
    scree_status status = scree_case_argument_read(command, command->argument[0], &c);
    if (status) return status;
    scree_case_summary summary;
    scree_stability limits;
    scree_limits_known known;
    scree_error error = {0};
    status = scree_case_summarise(c, &summary, &error);
    if (!status) status = scree_case_write(c, stdout, &error);
    if (!status) {
        print_summary(&summary);
        status = divide(c, &summary, processes, &error);
    }
    if (!status) status = scree_case_warn(c, print_warning, NULL, &error);
    if (!status && !(status = scree_case_limits(c, &known, &limits, &error)) && known != SCREE_LIMITS_NONE)
        print_limits(known, &limits);
    if (!status && known != SCREE_LIMITS_EXACT) status = try_begin(c, &summary, &error);
    if (status) status = scree_terminal_error("check", &error);
    scree_case_free(c);
    return status;
}

scree_status scree_verb_check(const scree_command *command)
{
    scree_error error = {0};
    long processes = 0;
    scree_status status = scree_command_number(command, "ranks", 1, SCREE_MOST_PROCESSES, &processes, &error);
    if (!status && processes > 0 && scree_argument_is_run(command->argument[0]))
        status = scree_command_refuse(&error, "--ranks", "a case", "is not asked of the folder of a run");
    if (status) return scree_terminal_error("check", &error);
    if (scree_argument_is_run(command->argument[0])) return check_folder(command->argument[0]);
    return check_case(command, processes);
}
