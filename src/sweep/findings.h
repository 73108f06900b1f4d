/// The runs that a report can speak of, found in directories.
#ifndef SCREE_SWEEP_FINDINGS_H
#define SCREE_SWEEP_FINDINGS_H

#include "base/error.h"

#include <limits.h>
#include <stdbool.h>

typedef enum scree_finding_form { SCREE_FINDING_FULL, SCREE_FINDING_QUICK, SCREE_FINDING_RUN } scree_finding_form;
enum { SCREE_FINDING_FORMS = 3 };
extern const char *const scree_finding_form_names[SCREE_FINDING_FORMS]; ///< as pages say them

typedef enum scree_finding_state {
    SCREE_FINDING_DONE,
    SCREE_FINDING_FAILED,
    SCREE_FINDING_MISSING
} scree_finding_state;

/// A run, or a member of a sweep that has not been run, or not to its end.
typedef struct scree_finding {
    char name[64];   ///< of the sweep; of the case for a run by itself
    char label[200]; ///< of the point of the grid; of the directory for a run by itself
    scree_finding_form form;
    scree_finding_state state;
    long long seed;
    char directory[PATH_MAX];
    char ensemble[PATH_MAX]; ///< folder of the averages over the members of its point; "" for a run by itself
    // What the sample and the program were, of one that is done; NAN and "" where the run does not say.
    double particles, friction, solid_fraction, coordination;
    // Where no boundary has measured a solid fraction: of a dense packing, and of the state that a change begins with.
    double gap_scatter, unbalanced;
    char build[128];
    // Whether it keeps the limits of quasistatic loading by its own account, and what it says of that; NAN and "".
    bool hasty;
    double kinetic_over_elastic;
    char account[200];
    char cause[200]; ///< of one that failed: what it said first; "" where nothing is known
    // Of one that is done, beside the built-in sweep of this name as it is now (origin.h).
    bool other_seed;      ///< its seed is not one of the sweep
    bool other_sample;    ///< its case differs before the last stage
    char other_case[160]; ///< path of the first key in which its case differs; "" where it does not, or is not known
} scree_finding;

typedef struct scree_findings {
    scree_finding *item;
    size_t count, capacity;
} scree_findings;

/// Adds the runs of `directory`: a run directory, a sweep directory, or a folder with such, up to two levels deep, in
/// alphabetical order. Of several of the same name, label, form and seed one that is done stays, the first of them.
/// Errors: SCREE_ERROR_IO.
scree_status scree_findings_add(scree_findings *findings, const char *directory, scree_error *error) SCREE_MUST_USE;
void scree_findings_destroy(scree_findings *findings);

/// Folder of the averages over a point of the sweep in `directory`.
scree_status scree_ensemble_folder(char *path, size_t size, const char *directory, const char *point,
                                   scree_error *error) SCREE_MUST_USE;

/// Whether any run of that name and form was found.
bool scree_findings_have(const scree_findings *findings, const char *name, scree_finding_form form);

/// What an expression calls a run by: "NAME/LABEL.RESULT" or "NAME.RESULT".
typedef struct scree_reference {
    char name[64], label[200], result[128];
    bool labelled;
} scree_reference;

/// Takes such a name apart; false when it is not one.
bool scree_reference_read(const char *text, scree_reference *reference);

/// Whether a run is one of those that `reference` means. A run by itself needs no label.
bool scree_finding_is(const scree_finding *finding, const scree_reference *reference, scree_finding_form form);

/// Whether two runs had the same sample: seed, number of particles, and solid fraction at the begin of loading to all
/// digits (the same deposition, confined alike); where neither has one, the scatter of the gaps of its packing, or the
/// unbalanced ratio of the state that they were compared with (increments: the same pile, changed in other ways).
bool scree_finding_same_sample(const scree_finding *a, const scree_finding *b);

#endif
