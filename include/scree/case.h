/// Cases: what is computed, read from a file or a text or made key by key, checked as a whole.
#ifndef SCREE_CASE_H
#define SCREE_CASE_H

#include <scree/error.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scree_case scree_case;         ///< a checked case
typedef struct scree_problems scree_problems; ///< everything that is wrong with a case

SCREE_API size_t scree_problems_count(const scree_problems *problems);
SCREE_API const scree_error *scree_problems_get(const scree_problems *problems, size_t index);
SCREE_API void scree_problems_free(scree_problems *problems);

typedef struct scree_case_options {
    const char *const *overrides; ///< "key.path=value" texts (--set), applied after the file; may be NULL
    size_t override_count;
    bool quick; ///< apply the file's `quick` section
} scree_case_options;

/// Reads, checks and completes a case file. On failure *problems holds every error found (free it); *out is NULL.
/// Errors: SCREE_ERROR_INPUT, also when there is no such file; SCREE_ERROR_IO when it cannot be read.
SCREE_API scree_status scree_case_read(const char *path, const scree_case_options *options, scree_case **out,
                                       scree_problems **problems);
/// The same from text; `name` stands for the file in messages.
SCREE_API scree_status scree_case_parse(const char *text, size_t length, const char *name,
                                        const scree_case_options *options, scree_case **out, scree_problems **problems);
SCREE_API void scree_case_free(scree_case *c);

/// A case that is being made: a text, and keys that overrule it one by one. Everything is checked at the end, together.
typedef struct scree_draft scree_draft;

/// Begins with a built-in case (`scree list`), a file or a text; the text is copied. Errors: SCREE_ERROR_INPUT (there
/// is none such; `accepted` holds the nearest), SCREE_ERROR_IO; memory.
SCREE_API scree_status scree_draft_builtin(const char *name, scree_draft **out, scree_error *error);
SCREE_API scree_status scree_draft_read(const char *path, scree_draft **out, scree_error *error);
SCREE_API scree_status scree_draft_parse(const char *text, size_t length, const char *name, scree_draft **out,
                                         scree_error *error);
SCREE_API void scree_draft_free(scree_draft *draft);

/// Sets a key, "stages.compress.rate", as in a case file, "1e-2 1/s"; the last value counts. Errors: memory.
SCREE_API scree_status scree_draft_set(scree_draft *draft, const char *key, const char *value, scree_error *error);
/// The same with a number in SI units.
SCREE_API scree_status scree_draft_set_number(scree_draft *draft, const char *key, double value, scree_error *error);
/// Whether the case's own `quick` section is applied, before the keys.
SCREE_API void scree_draft_set_quick(scree_draft *draft, bool quick);

/// Makes the case of what the draft is now; the draft stays as it is and may make others. Errors: as scree_case_read.
SCREE_API scree_status scree_draft_check(const scree_draft *draft, scree_case **out, scree_problems **problems);

/// Writes the resolved case: every default written out, units kept, without its `quick` section. Reading it gives the
/// same case.
SCREE_API scree_status scree_case_write(const scree_case *c, FILE *file, scree_error *error);

/// What a case amounts to before it is run (`scree check`).
typedef struct scree_case_summary {
    char name[64];
    uint64_t particles;
    double step, critical_step;    ///< s; step: the small one of a scheme that has two
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
    double tabor;                  ///< largest Tabor parameter of contacts of mean grains; NAN where none sticks
    double preparation;            ///< s, of the stepping
    double lists; ///< s, beside it of several processes: pairs of the whole, where process 0 looks at it
    bool sleeps;  ///< particles that are quiet may be left out of steps: the times are those with all of them awake
} scree_case_summary;
/// Takes some tenths of a second: the case is set going for a moment. Times that cannot be found so are NAN. Errors:
/// SCREE_ERROR_INPUT, memory.
SCREE_API scree_status scree_case_summarise(const scree_case *c, scree_case_summary *summary, scree_error *error);

/// What one of several processes takes that compute a run together (`scree check --ranks`).
typedef struct scree_case_rank {
    double bodies, ghosts;        ///< its own, and those of others near them that it is told of, mean
    double sent;                  ///< bytes a step, mean; lists and whole states not counted
    double memory[2];             ///< bytes, peak: of process 0, which has the whole at times; of the fullest other
    double seconds;               ///< of process 0 on a core of its own: the sum of the next four, without messages
    double preparation, stepping; ///< s: of the whole sample, by process 0; of its part
    double lists, output;         ///< s: pairs of the whole, where it is looked at; samples, files and figures
} scree_case_rank;

enum { SCREE_MOST_PROCESSES = 4096 }; ///< that can compute a run together

/// Whether the case can be spread over several processes. Errors: SCREE_ERROR_INPUT: what cannot, by name; memory.
SCREE_API scree_status scree_case_can_spread(const scree_case *c, scree_error *error);

/// `summary`: that of the case; `processes`: from 1. Of surface to volume: ghosts as of a packing in a periodic cell
/// (docs/performance.md). Errors: SCREE_ERROR_INPUT: something in the case cannot be spread over processes, or no such
/// number of them; memory.
SCREE_API scree_status scree_case_divide(const scree_case *c, const scree_case_summary *summary, int processes,
                                         scree_case_rank *rank, scree_error *error);

/// Calls `visit` with a sentence for each stage that means to be quasistatic and will not be: what, its limit, and what
/// to change. A run writes the same into its log.
SCREE_API scree_status scree_case_warn(const scree_case *c, void (*visit)(void *user, const char *line), void *user,
                                       scree_error *error);

/// Built-in cases: template texts with comments. NULL when the index or name does not exist.
SCREE_API size_t scree_template_count(void);
SCREE_API const char *scree_template_name(size_t index);
SCREE_API const char *scree_template_meaning(size_t index);
SCREE_API const char *scree_template_text(const char *name);

/// The case reference, generated from the schema table, as Markdown.
SCREE_API scree_status scree_schema_write_manual(FILE *file, scree_error *error);

#ifdef __cplusplus
}
#endif
#endif
