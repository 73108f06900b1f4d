/// What varies is a module: one file (or folder) with one descriptor, and one row in one table (module/table.h). The
/// core knows none by name; it loops over the table. Descriptors are plain structs with arrays and functions; a member
/// that a module does not need is zero. Nothing registers itself.
#ifndef SCREE_MODULE_MODULE_H
#define SCREE_MODULE_MODULE_H

#include "base/error.h"
#include "module/field.h"
#include "module/key.h"
#include "module/pass.h"
#include "module/table.h"

#include <stdint.h>

typedef struct scree_config scree_config;
typedef struct scree_reader scree_reader;

/// What a module adds to series.csv, and its last value to summary.json.
typedef struct scree_column {
    const char *name; ///< "_work": behind the name of what has it
    const char *unit; ///< SI unit
    const char *meaning;
} scree_column;

enum { SCREE_COLUMN_OWNERS = 16 }; ///< most of a module

typedef struct scree_columns {
    const scree_column *column; ///< those of each owner
    size_t count;
    /// Name of owner `index`, below SCREE_COLUMN_OWNERS, unique among all that have columns of these names; NULL: there
    /// is none.
    const char *(*owner)(const scree_model *model, int64_t index);
    /// Its present values.
    void (*values)(const scree_state *state, int64_t index, double *value);
} scree_columns;

struct scree_module {
    const char *name;
    const char *meaning; ///< one line

    // ---- the case ----
    const scree_choice_of *choice_of; ///< the keys whose choice it is; NULL: none
    const scree_keys *keys;           ///< those that it adds to sections of the case
    size_t keys_count;                ///< sections
    /// Notes what it cannot be combined with, once for a case that has chosen it. Values that are missing or wrong have
    /// been noted: of such nothing is said. NULL: nothing.
    void (*rules)(scree_reader *reader, const scree_config *config);

    // ---- faces: what only modules of one kind have ----
    const struct scree_law *law;                  ///< model/law.h
    const struct scree_integrator *integrator;    ///< module/integrator.h
    const struct scree_preparation *preparation;  ///< module/preparation.h
    const struct scree_size_distribution *sizes;  ///< module/size_distribution.h
    const struct scree_stage_numbers *numbers;    ///< module/stage.h
    const struct scree_stage *stage;              ///< run/stage.h
    const struct scree_boundary *boundary;        ///< module/boundary.h
    const struct scree_selection_kind *selection; ///< selection/selection.h

    // ---- state: what it remembers ----
    size_t state_size;         ///< bytes of its struct in the store of the state, zero at first; 0: none
    const scree_field *fields; ///< of this struct and the arrays that it points to
    size_t field_count;
    /// What a stored state must fulfil besides the ranges of the fields. `error` names the dataset. NULL: nothing.
    scree_status (*check)(const scree_state *state, const scree_model *model, scree_error *error);
    /// Continues the state checksum with what physics depends on (docs/architecture.md). NULL: nothing.
    uint64_t (*checksum)(const scree_model *model, const scree_state *state, uint64_t checksum);
    /// Why this body may not be taken out; NULL: it may. NULL: all may.
    const char *(*keeps)(const scree_state *state, uint32_t id);
    /// A body is about to be taken out: what refers to it by its id ends. Its row is still there. NULL: nothing does.
    void (*forget)(scree_state *state, uint32_t id);

    /// A stage begins that takes steps (not: is taken up again), and its boundary stands. An error of the user's input
    /// has its field. NULL: nothing to do.
    scree_status (*begin)(const scree_context *context, scree_error *error);

    // ---- passes: what it does in a step ----
    const scree_pass *passes;
    size_t pass_count;
    /// Whether it has something to do in the stage that begins. NULL: always.
    bool (*in_use)(const scree_context *context);
    /// Largest force that its loads may put on one body in this step [N], for the quanta; up to 2^10 times more is
    /// safe. NULL: none.
    double (*bound)(const scree_context *context);
    /// Work [J] that it has done on the bodies since the begin of the run. NULL: it does none, or has a row of the
    /// ledger.
    double (*work)(const scree_state *state);

    // ---- results ----
    const scree_columns *columns; ///< NULL: none
};

#define SCREE_MODULE_DECLARE(name) extern const scree_module scree_module_##name;
#define SCREE_MODULE_SLOT(name)    SCREE_SLOT_##name,
SCREE_MODULES(SCREE_MODULE_DECLARE)
enum { SCREE_MODULES(SCREE_MODULE_SLOT) SCREE_MODULE_COUNT };

/// All modules, by slot.
extern const scree_module *const scree_modules[SCREE_MODULE_COUNT];

#endif
