/// Scree: a discrete-element laboratory for granular matter. Public C interface: opaque handles, read-only views.
/// The command line uses nothing else. All values are SI. Thread safety: different handles may be used by different
/// threads at the same time; one handle by one thread at a time.
///
///     scree_case *c; scree_problems *problems; scree_error error;
///     if (scree_case_read("biaxial.yaml", NULL, &c, &problems)) { ... scree_problems_get(problems, 0) ... }
///     scree_run_options options = {.output = "out", .threads = 2};
///     if (scree_run(c, &options, &error)) ...
#ifndef SCREE_H
#define SCREE_H

#include <scree/error.h>

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SCREE_VERSION "0.1.0"

/// Version text, with the compiler and the instruction set that the kernels use on this machine.
const char *scree_version(void);

/// The commit that was built, with a "+" where tracked files differed from it; "" when the sources were no checkout.
const char *scree_commit(void);

/// Chooses the instruction set of the kernels, "v2", "v3" or "v4" (x86-64-v2 and so on), for everything that this
/// process computes from now on; NULL or "auto": the best that this processor has, as without a call. Results have the
/// same bits with each. The library reads no environment variable; the program `scree` calls this with SCREE_ISA.
/// Errors: SCREE_ERROR_INPUT: no such word, or this processor does not have it; nothing is changed then.
scree_status scree_instruction_set_choose(const char *name, scree_error *error);

/// Nearest of `names` to `text` (Damerau-Levenshtein, at most a third of the letters wrong), or NULL.
const char *scree_nearest(const char *text, const char *const *names, size_t count);

// ---- cases -------------------------------------------------------------------------------------------------------

typedef struct scree_case scree_case;         ///< a checked case
typedef struct scree_problems scree_problems; ///< everything that is wrong with a case

size_t scree_problems_count(const scree_problems *problems);
const scree_error *scree_problems_get(const scree_problems *problems, size_t index);
void scree_problems_free(scree_problems *problems);

typedef struct scree_case_options {
    const char *const *overrides; ///< "key.path=value" texts (--set), applied after the file; may be NULL
    size_t override_count;
    bool quick; ///< apply the file's `quick` section
} scree_case_options;

/// Reads, checks and completes a case file. On failure *problems holds every error found (free it); *out is NULL.
/// Errors: SCREE_ERROR_INPUT, also when there is no such file; SCREE_ERROR_IO when it cannot be read.
scree_status scree_case_read(const char *path, const scree_case_options *options, scree_case **out,
                             scree_problems **problems);
/// The same from text; `name` stands for the file in messages.
scree_status scree_case_parse(const char *text, size_t length, const char *name, const scree_case_options *options,
                              scree_case **out, scree_problems **problems);
void scree_case_free(scree_case *c);

/// Writes the resolved case: every default written out, units kept, without its `quick` section. Reading it gives the
/// same case.
scree_status scree_case_write(const scree_case *c, FILE *file, scree_error *error);

/// What a case amounts to before it is run (`scree check`).
typedef struct scree_case_summary {
    char name[64];
    uint64_t particles;
    double step, critical_step;    ///< s; step: the small one of two_timescales
    uint64_t largest_step;         ///< in steps: N_S of two_timescales, else 1
    double phi, psi;               ///< quasistatic and size coefficients, NAN without a loading stage
    double inertial_number;        ///< of the first loading stage at its full rate, NAN without one
    double mean_radius, thickness; ///< m
    double reference_velocity;     ///< m/s
    double steps;                  ///< expected number of steps (force evaluations) of all stages
    double seconds;                ///< expected processor time on one thread: the sum of the next three
    double stepping;               ///< s, of it steps and the preparation
    double output;                 ///< s, samples, snapshots, ParaView files, gathering of run.h5, results
    double figures;                ///< s
    double rate;                   ///< particle-steps per second of the stepping, measured on this machine
    double memory;                 ///< bytes, peak
} scree_case_summary;
/// Takes some tenths of a second: the case is set going for a moment. Times that cannot be found so are NAN. Errors:
/// SCREE_ERROR_INPUT, memory.
scree_status scree_case_summarise(const scree_case *c, scree_case_summary *summary, scree_error *error);

/// Calls `visit` with a sentence for each stage that means to be quasistatic and will not be: what, its limit, and what
/// to change. A run writes the same into its log.
scree_status scree_case_warn(const scree_case *c, void (*visit)(void *user, const char *line), void *user,
                             scree_error *error);

/// Built-in cases: template texts with comments. NULL when the index or name does not exist.
size_t scree_template_count(void);
const char *scree_template_name(size_t index);
const char *scree_template_meaning(size_t index);
const char *scree_template_text(const char *name);

/// The case reference, generated from the schema table, as Markdown.
scree_status scree_schema_write_manual(FILE *file, scree_error *error);

// ---- runs --------------------------------------------------------------------------------------------------------

typedef struct scree_progress {
    const char *stage; ///< name of the stage
    double fraction;   ///< of the stage, 0 to 1; NAN when not known in advance
    double time;       ///< s, simulated
    double strain;     ///< axial, NAN outside loading stages
    double particle_steps_per_second;
    double seconds_left; ///< wall, of the whole run; NAN when not known
} scree_progress;

typedef struct scree_run_options {
    const char *output;       ///< run directory
    int threads;              ///< at most; 0: one for every 4000 bodies, at most all cores. Fewer work while other
                              ///< programs hold the cores and fewer are faster
    bool force;               ///< write into a directory that holds another run (replaces it)
    const char *from;         ///< scree_restart: number of the snapshot to go on from, or "latest"; NULL: a checkpoint
    bool figures;             ///< draw figures at the end
    const volatile int *stop; ///< becomes non-zero (signal number) to ask for a checkpoint and an orderly end
    void (*progress)(void *user, const scree_progress *progress); ///< about twice a second; may be NULL
    void (*message)(void *user, int level, const char *line);     ///< lines of log.txt (level 0 information, 1 warning,
                                                                  ///< 2 error) as they are written; may be NULL
    void *user;
} scree_run_options;

/// Runs a case into a new run directory. Errors: SCREE_ERROR_INPUT (directory in use), _GUARD, _IO, SCREE_INTERRUPTED.
scree_status scree_run(const scree_case *c, const scree_run_options *options, scree_error *error);

/// Continues the run in `directory` from its newest checkpoint, or from a snapshot, bit for bit. What came after it is
/// dropped; what is damaged and not needed is set aside, with a line in log.txt. Errors: as scree_run; SCREE_ERROR_INPUT
/// while another process writes there.
scree_status scree_restart(const char *directory, const scree_run_options *options, scree_error *error);

/// One thing in the folder of a run (`scree check DIR`).
typedef struct scree_folder_item {
    const char *name;  ///< "series.csv", "checkpoint 5", "snapshot 12"
    const char *state; ///< "whole", "damaged", or "left over": something that nothing needs
    const char *text;  ///< what it holds, or what is wrong with it
    bool restart;      ///< the run can go on from it
    bool snapshot;     ///< it is one, and `index` is its number
    int64_t index;
} scree_folder_item;

/// Looks at everything in the folder of a run and tells `visit` of it, without changing anything. Errors:
/// SCREE_ERROR_INPUT when it is none of a run, SCREE_ERROR_IO when something is damaged (the message says how much) or
/// cannot be read; memory.
scree_status scree_folder_check(const char *directory, void (*visit)(void *user, const scree_folder_item *item),
                                void *user, scree_error *error);

/// A simulation in memory, without files (tests, bindings). Stages are run one after the other by `advance`.
typedef struct scree_simulation scree_simulation;
scree_status scree_simulation_create(const scree_case *c, int threads, scree_simulation **out, scree_error *error);
/// At most `steps` steps (force evaluations); *done tells whether the case has ended.
scree_status scree_simulation_advance(scree_simulation *s, uint64_t steps, bool *done, scree_error *error);
uint64_t scree_simulation_checksum(scree_simulation *s);
void scree_simulation_free(scree_simulation *s);

// ---- results -----------------------------------------------------------------------------------------------------

/// Value of `name` in summary.json as text into `value` (cut to `size`). Numbers have the fewest digits that read back
/// as the same double; a value that does not exist is `nan`. Errors: SCREE_ERROR_IO (no run there), SCREE_ERROR_INPUT
/// (no such name; `accepted` holds the nearest).
scree_status scree_result_get(const char *directory, const char *name, char *value, size_t size, scree_error *error);

/// Calls `visit` for every name in summary.json.
scree_status scree_result_visit(const char *directory, void (*visit)(void *user, const char *name, const char *value),
                                void *user, scree_error *error);

/// Draws all figures of a run into `directory`/figures. `message` tells which; may be NULL. Errors: SCREE_ERROR_IO,
/// SCREE_ERROR_INPUT while a run goes on there.
scree_status scree_plot(const char *directory, void (*message)(void *user, const char *path), void *user,
                        scree_error *error);

// ---- sweeps ------------------------------------------------------------------------------------------------------

typedef struct scree_sweep scree_sweep; ///< a checked sweep: a grid of parameters and realisations of one case

typedef struct scree_sweep_read_options {
    const char *const *overrides; ///< "key.path=value" texts that all members get, after everything else
    size_t override_count;
    bool quick;          ///< as `quick: yes` in the file
    size_t realisations; ///< 0: as the file says
} scree_sweep_read_options;

/// Reads and checks a sweep file, or the built-in sweep of that name, and the case of every point of its grid. On
/// failure *problems holds every error found (free it). Errors: SCREE_ERROR_INPUT, SCREE_ERROR_IO.
scree_status scree_sweep_read(const char *name, const scree_sweep_read_options *options, scree_sweep **out,
                              scree_problems **problems);
void scree_sweep_free(scree_sweep *sweep);

/// The sweeps that repeat the published experiments. NULL when the index does not exist.
size_t scree_sweep_builtin_count(void);
const char *scree_sweep_builtin_name(size_t index);
const char *scree_sweep_builtin_meaning(size_t index);

/// Members are numbered from 0. Folder of a member below OUTPUT/members, and what it sets as a command line of `scree
/// run` (cut to `size`).
size_t scree_sweep_member_count(const scree_sweep *sweep);
const char *scree_sweep_member_folder(const scree_sweep *sweep, size_t member);
void scree_sweep_member_command(const scree_sweep *sweep, size_t member, char *text, size_t size);

typedef struct scree_sweep_progress {
    size_t members, done, failed, running;
    double seconds_left; ///< wall; NAN when not known
} scree_sweep_progress;

typedef struct scree_sweep_options {
    const char *program; ///< that runs a member: `PROGRAM run CASE -o DIR`
    const char *output;  ///< sweep directory
    int jobs;            ///< members at the same time; 0: as many as there are cores for their threads
    int threads;         ///< of each member; 0: one
    bool retry;          ///< run members anew that failed
    bool force;          ///< run members anew whose directory holds another case
    bool figures;        ///< of the members, and comparison figures of the sweep
    const volatile int *stop; ///< becomes non-zero (signal number): members stop after a checkpoint
    void (*progress)(void *user, const scree_sweep_progress *progress); ///< when something changes; may be NULL
    void (*message)(void *user, int level, const char *line); ///< what became of each member; levels as in runs
    void *user;
} scree_sweep_options;

/// Runs what is missing of a sweep, each member as a process of its own, then collects. A finished member whose case is
/// the same is left as it is; an interrupted one is continued; a failed one stays so unless `retry`. The processes are
/// asked to stop when the thread that called this ends. Errors:
/// SCREE_ERROR_GUARD when members failed (the others are there), SCREE_ERROR_INPUT (another case in a directory),
/// SCREE_ERROR_IO, SCREE_INTERRUPTED.
scree_status scree_sweep_run(const scree_sweep *sweep, const scree_sweep_options *options, scree_error *error);

/// The same for one member, without collecting: for job arrays. Errors: as above.
scree_status scree_sweep_run_member(const scree_sweep *sweep, size_t member, const scree_sweep_options *options,
                                    scree_error *error);

/// Tables, averaged curves and figures from the members that are there. Errors: SCREE_ERROR_GUARD when some failed.
scree_status scree_sweep_collect(const scree_sweep *sweep, const scree_sweep_options *options, scree_error *error);

/// Writes a SLURM script: a job array with a task for each member. `name` and the read options are what `sweep` was
/// read from. Errors: SCREE_ERROR_IO.
scree_status scree_sweep_write_slurm(const scree_sweep *sweep, const scree_sweep_read_options *read,
                                     const scree_sweep_options *options, const char *path, scree_error *error);

// ---- the reproduction report -------------------------------------------------------------------------------------

typedef struct scree_report_options {
    const char *const *directory; ///< of runs and sweeps, or folders with such, up to two levels deep
    size_t directory_count;
    const char *const *statements; ///< files, or names of built-in tables
    size_t statement_count;        ///< 0: all built-in tables
} scree_report_options;

/// Compares what sources state with the results of runs and sweeps, and writes the page as Markdown. Statements whose
/// runs are not there are `not run`, those whose results a run does not have `not measured`. Errors:
/// SCREE_ERROR_INPUT with everything that is wrong with the statements in *problems (may be NULL; to be freed);
/// SCREE_ERROR_IO.
scree_status scree_report_write(const scree_report_options *options, FILE *file, scree_problems **problems,
                                scree_error *error);

#ifdef __cplusplus
}
#endif
#endif
