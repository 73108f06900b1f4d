/// A SLURM job array for the members of a sweep, and what a member is as a command line.
#include "sweep/sweep.h"

#include "base/handle.h"
#include "io/run_directory.h"
#include "sweep/several.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

size_t scree_sweep_member_count(const scree_sweep *sweep)
{
    scree_handle_check(sweep, "a sweep");
    return sweep->member_count;
}

const char *scree_sweep_member_folder(const scree_sweep *sweep, size_t member)
{
    scree_handle_check(sweep, "a sweep");
    return member < sweep->member_count ? sweep->folder[member] : NULL;
}

/// A word for the shell: as it is, or in single quotes.
static void put_word(FILE *file, const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=+-,:%@";
    if (text[0] && strspn(text, plain) == strlen(text)) {
        (void)fputs(text, file);
        return;
    }
    (void)fputc('\'', file);
    for (const char *c = text; *c; c++) (void)(*c == '\'' ? fputs("'\\''", file) : fputc(*c, file));
    (void)fputc('\'', file);
}

static void put_settings(FILE *file, const scree_sweep_assignment *list, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        (void)fputs(" --set ", file);
        put_word(file, list[i].text);
    }
}

/// What a search is about, as options of `scree bisect`.
static void put_search(FILE *file, const scree_bisection *what)
{
    fputs(" --key ", file);
    put_word(file, what->key);
    fputs(" --from ", file);
    put_word(file, what->between[0]);
    fputs(" --to ", file);
    put_word(file, what->between[1]);
    fprintf(file, " --tolerance %g --measure %s", what->tolerance, what->measure);
    if (!isnan(what->below)) fprintf(file, " --below=%g", what->below);
    if (!isnan(what->above)) fprintf(file, " --above=%g", what->above);
    if (!isnan(what->target)) fprintf(file, " --target=%g", what->target);
    if (what->curve[0]) fprintf(file, " --curve %s", what->curve);
}

void scree_sweep_member_command(const scree_sweep *sweep, size_t member, char *text, size_t size)
{
    scree_handle_check(sweep, "a sweep");
    size_t point = scree_member_point(sweep, member);
    if (size == 0) return;
    text[0] = 0;
    FILE *file = fmemopen(text, size, "w");
    if (!file) return;
    (void)fputs(sweep->bisects ? "scree bisect " : "scree run ", file);
    put_word(file, sweep->case_name);
    if (sweep->quick) (void)fputs(" --quick", file);
    put_settings(file, sweep->fixed, sweep->fixed_count);
    for (size_t k = 0; k < sweep->dimension_count; k++) {
        const scree_sweep_setting *setting = &sweep->dimension[k].setting[scree_point_setting(sweep, point, k)];
        put_settings(file, setting->assignment, setting->assignment_count);
    }
    (void)fprintf(file, " --set seed=%lld", (long long)scree_member_seed(sweep, member));
    put_settings(file, sweep->last, sweep->last_count);
    if (sweep->bisects) put_search(file, &sweep->bisection);
    (void)fclose(file);
    text[size - 1] = 0;
}

/// The command that all tasks share, up to what a task does.
static void put_command(FILE *file, const scree_sweep *sweep, const scree_sweep_read_options *read,
                        const scree_sweep_options *options)
{
    put_word(file, options->program);
    (void)fputs(" sweep ", file);
    put_word(file, sweep->source);
    (void)fputs(" --output ", file);
    put_word(file, options->output);
    if (read && read->quick) (void)fputs(" --quick", file);
    if (read && read->realisations > 0) (void)fprintf(file, " --realisations %zu", read->realisations);
    for (size_t i = 0; read && i < read->override_count; i++) {
        (void)fputs(" --set ", file);
        put_word(file, read->overrides[i]);
    }
    if (options->threads > 0) (void)fprintf(file, " --threads %d", options->threads);
    if (options->ranks > 1) (void)fprintf(file, " --ranks %d", options->ranks);
    if (options->retry) (void)fputs(" --retry", file);
    if (!options->figures) (void)fputs(" --no-figures", file);
}

scree_status scree_sweep_write_slurm(const scree_sweep *sweep, const scree_sweep_read_options *read,
                                     const scree_sweep_options *options, const char *path, scree_error *error)
{
    scree_handle_check(sweep, "a sweep");
    FILE *file;
    scree_status status = scree_several_check(sweep, options, false, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    (void)fprintf(file,
                  "#!/bin/bash\n"
                  "# A task for each of the %zu members of the sweep '%s'. Submit it, and the collection after it:\n"
                  "#     job=$(sbatch --parsable %s)\n"
                  "#     sbatch --dependency=afterany:$job --wrap \"",
                  sweep->member_count, sweep->config.name, path);
    put_command(file, sweep, read, options);
    (void)fprintf(file,
                  " --collect\"\n"
                  "# A task that is stopped writes a checkpoint; submitting the script again goes on where it stood.\n"
                  "#SBATCH --job-name=%s\n"
                  "#SBATCH --array=0-%zu\n"
                  "#SBATCH --ntasks=%d\n"
                  "#SBATCH --cpus-per-task=%d\n"
                  "#SBATCH --time=24:00:00\n"
                  "#SBATCH --signal=B:TERM@120\n"
                  "exec ",
                  sweep->config.name, sweep->member_count - 1, options->ranks > 0 ? options->ranks : 1,
                  options->threads > 0 ? options->threads : 1);
    put_command(file, sweep, read, options);
    (void)fputs(" --member \"$SLURM_ARRAY_TASK_ID\"\n", file);
    (void)fchmod(fileno(file), 0755);
    return scree_replace_finish(path, file, true, error);
}
