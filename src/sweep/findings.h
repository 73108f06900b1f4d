/// The runs that a report can speak of, found in directories.
#ifndef SCREE_SWEEP_FINDINGS_H
#define SCREE_SWEEP_FINDINGS_H

#include "base/error.h"

#include <limits.h>
#include <stdbool.h>

typedef enum scree_finding_form { SCREE_FINDING_FULL, SCREE_FINDING_QUICK, SCREE_FINDING_RUN } scree_finding_form;
enum { SCREE_FINDING_FORMS = 3 };

/// A finished run.
typedef struct scree_finding {
    char name[64];   ///< of the sweep; of the case for a run by itself
    char label[200]; ///< of the point of the grid; of the directory for a run by itself
    scree_finding_form form;
    size_t realisation;
    double confidence;
    char directory[PATH_MAX];
} scree_finding;

typedef struct scree_findings {
    scree_finding *item;
    size_t count, capacity;
    size_t realisations; ///< most of a sweep
} scree_findings;

/// Adds the runs of `directory`: a run directory, a sweep directory, or a folder with such, up to two levels deep, in
/// alphabetical order. Errors: SCREE_ERROR_IO.
scree_status scree_findings_add(scree_findings *findings, const char *directory, scree_error *error) SCREE_MUST_USE;
void scree_findings_destroy(scree_findings *findings);

/// Whether any run of that name and form was found.
bool scree_findings_have(const scree_findings *findings, const char *name, scree_finding_form form);

/// A run by what expressions call it, "NAME/LABEL.RESULT" or "NAME.RESULT"; *result is set to its last part. NULL when
/// there is none.
const scree_finding *scree_findings_get(const scree_findings *findings, const char *expression_name,
                                        scree_finding_form form, size_t realisation, const char **result);

#endif
