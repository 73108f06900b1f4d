/// Sweeps: many runs of one case; and the report that compares runs with what sources state.
#ifndef SCREE_SWEEP_H
#define SCREE_SWEEP_H

#include <scree/case.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scree_sweep scree_sweep; ///< a checked sweep: a grid of parameters and realisations of one case

typedef struct scree_sweep_read_options {
    const char *const *overrides; ///< "key.path=value" texts that all members get, after everything else
    size_t override_count;
    bool quick;          ///< as `quick: yes` in the file
    size_t realisations; ///< 0: as the file says
} scree_sweep_read_options;

/// Reads and checks a sweep file, or the built-in sweep of that name, and the case of every point of its grid. On
/// failure *problems holds every error found (free it). Errors: SCREE_ERROR_INPUT, SCREE_ERROR_IO.
SCREE_API scree_status scree_sweep_read(const char *name, const scree_sweep_read_options *options, scree_sweep **out,
                                        scree_problems **problems);
SCREE_API void scree_sweep_free(scree_sweep *sweep);

/// The sweeps that repeat the published experiments. NULL when the index does not exist.
SCREE_API size_t scree_sweep_builtin_count(void);
SCREE_API const char *scree_sweep_builtin_name(size_t index);
SCREE_API const char *scree_sweep_builtin_meaning(size_t index);

/// The program that a sweep needs and that is not installed; NULL: there is none.
SCREE_API const char *scree_sweep_lacks(const scree_sweep *sweep);

/// Members are numbered from 0. Folder of a member below OUTPUT/members, and what it sets as a command line of `scree
/// run`, or of `scree bisect` where it searches for a limit (cut to `size`).
SCREE_API size_t scree_sweep_member_count(const scree_sweep *sweep);
SCREE_API const char *scree_sweep_member_folder(const scree_sweep *sweep, size_t member);
SCREE_API void scree_sweep_member_command(const scree_sweep *sweep, size_t member, char *text, size_t size);

typedef struct scree_sweep_progress {
    size_t members, done, failed, running;
    double seconds_left; ///< wall; NAN when not known
} scree_sweep_progress;

typedef struct scree_sweep_options {
    const char *program;      ///< that runs a member: `PROGRAM run CASE -o DIR`
    const char *output;       ///< sweep directory
    int jobs;                 ///< members at the same time; 0: as many as there are cores for their threads
    int threads;              ///< of each process of a member; 0: one
    int ranks;                ///< processes of each member, which `mpirun` of PATH starts; 0: one, without it
    bool retry;               ///< run members anew that failed
    bool force;               ///< run members anew whose directory holds another case
    bool figures;             ///< of the members, and comparison figures of the sweep
    const volatile int *stop; ///< becomes non-zero (signal number): members stop after a checkpoint
    void (*progress)(void *user, const scree_sweep_progress *progress); ///< when something changes; may be NULL
    void (*message)(void *user, int level, const char *line); ///< what became of each member; levels as in runs
    void *user;
} scree_sweep_options;

/// What a sweep will cost.
typedef struct scree_sweep_cost {
    size_t members, unknown; ///< of them, whose time cannot be found before they run: it is left out
    bool searches;           ///< each member is a search of several runs; times are those of one run of each
    double seconds;          ///< of all members: processor time, each on one thread
    double longest;          ///< s, of one
    double memory;           ///< bytes, peak of one
} scree_sweep_cost;

/// Estimates it, with figures of the members or without, by setting the case of each point going for a moment, which
/// takes some tenths of a second a point. Errors: as scree_case_summarise.
SCREE_API scree_status scree_sweep_estimate_cost(const scree_sweep *sweep, bool figures, scree_sweep_cost *cost,
                                                 scree_error *error);

/// Runs what is missing of a sweep, each member as a process of its own, then collects. A finished member whose case is
/// the same is left as it is; an interrupted one is continued; a failed one stays so unless `retry`. The processes are
/// asked to stop when the thread that called this ends. Errors:
/// SCREE_ERROR_GUARD when members failed (the others are there), SCREE_ERROR_INPUT (another case in a directory; a
/// program that the sweep needs is not installed; members cannot have several processes),
/// SCREE_ERROR_IO, SCREE_INTERRUPTED.
SCREE_API scree_status scree_sweep_run(const scree_sweep *sweep, const scree_sweep_options *options,
                                       scree_error *error);

/// The same for one member, without collecting: for job arrays. Errors: as above.
SCREE_API scree_status scree_sweep_run_member(const scree_sweep *sweep, size_t member,
                                              const scree_sweep_options *options, scree_error *error);

/// Tables, averaged curves and figures from the members that are there. Errors: SCREE_ERROR_GUARD when some failed.
SCREE_API scree_status scree_sweep_collect(const scree_sweep *sweep, const scree_sweep_options *options,
                                           scree_error *error);

/// Writes a SLURM script: a job array with a task for each member. `name` and the read options are what `sweep` was
/// read from. Errors: SCREE_ERROR_IO; SCREE_ERROR_INPUT: members cannot have several processes.
SCREE_API scree_status scree_sweep_write_slurm(const scree_sweep *sweep, const scree_sweep_read_options *read,
                                               const scree_sweep_options *options, const char *path,
                                               scree_error *error);

// ---- a limit by runs ---------------------------------------------------------------------------------------------

/// A number of a case, and what a run must fulfil to stand.
typedef struct scree_bisection {
    const char *key;        ///< path of a number in the case
    const char *between[2]; ///< values with units: at one a run stands, at the other it does not
    double tolerance;       ///< 1, relative: how near the two ends are brought
    const char *measure;    ///< a result of a run, a number
    const char *curve;      ///< column of series.csv that is drawn over time for runs near the limit; NULL: none
    double below, above;    ///< in SI units; NAN: no such bound
    double target;          ///< what the result has to be, in place of bounds; NAN: bounds
} scree_bisection;

typedef struct scree_bisection_result {
    double limit, stands, fails; ///< SI: between the two ends; at which a run stands, at which it does not
    int runs;
    int nearest;            ///< number of the run whose result is nearest to the target
    double found, measured; ///< SI: value of the key in that run, and its result
} scree_bisection_result;

/// Finds the limit by bisection: runs as processes of their own, one after the other, in options->output. A search that
/// was interrupted goes on with the runs that are there. Of the options count program, output, threads, force, stop,
/// message. Errors: SCREE_ERROR_INPUT (`field`: the part of the bisection that is wrong; runs stand at both ends, or at
/// none), SCREE_ERROR_IO, SCREE_INTERRUPTED.
SCREE_API scree_status scree_bisect(const scree_case *c, const scree_bisection *what,
                                    const scree_sweep_options *options, scree_bisection_result *result,
                                    scree_error *error);

// ---- the reproduction report -------------------------------------------------------------------------------------

typedef struct scree_report_options {
    const char *const *directory; ///< of runs and sweeps, or folders with such, up to two levels deep
    size_t directory_count;
    const char *const *statements; ///< files, or names of built-in tables
    size_t statement_count;        ///< 0: all built-in tables
    const char *figures;           ///< folder that figures of ensembles are copied into; NULL: the page has none
    const char *figures_link;      ///< how the page calls that folder
    const char *former;            ///< text of the page as it was; NULL: none. See scree_report_write
    size_t *kept;                  ///< raised by the sections that stay from it; may be NULL
} scree_report_options;

/// Compares what sources state with the results of runs and sweeps, and writes the page as Markdown. Statements whose
/// runs are not there are `not run`, those whose results a run does not have `not measured`. A case whose section on
/// the former page says the same statements word for word, and rests on more (verdicts with an interval; if as many,
/// realisations of the full form; if as many, of the others), keeps that section, with the figures that it names: the
/// page may outlive the runs. Errors: SCREE_ERROR_INPUT with everything that is wrong with the statements in *problems
/// (may be NULL; to be freed); SCREE_ERROR_IO.
SCREE_API scree_status scree_report_write(const scree_report_options *options, FILE *file, scree_problems **problems,
                                          scree_error *error);

/// Whether a statement of the built-in tables is about the sweep of this name in a form.
SCREE_API bool scree_report_judges(const char *sweep, bool quick);

#ifdef __cplusplus
}
#endif
#endif
