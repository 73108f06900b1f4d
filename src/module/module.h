/// What varies is a module: one file (or folder) with one descriptor, and one row in one table (module/table.h). The
/// core knows none by name; it loops over the table. Descriptors are plain structs with arrays and functions; a member
/// that a module does not need is zero. Nothing registers itself.
#ifndef SCREE_MODULE_MODULE_H
#define SCREE_MODULE_MODULE_H

#include "base/error.h"
#include "module/field.h"
#include "module/key.h"
#include "module/pass.h"
#include "module/result.h"
#include "module/table.h"

#include <stdint.h>

typedef struct scree_config scree_config;
typedef struct scree_reader scree_reader;
struct scree_conclusion;

struct scree_module {
    const char *name;
    const char *meaning; ///< one line

    // ---- the case ----
    const scree_choice_of *choice_of; ///< the keys whose choice it is; NULL: none
    const scree_keys *keys;           ///< those that it adds to sections of the case
    size_t keys_count;                ///< sections
    /// Notes what it cannot be combined with, once for a case that has chosen it, or for every case where no key
    /// chooses it. Values that are missing or wrong have been noted: of such nothing is said. NULL: nothing.
    void (*rules)(scree_reader *reader, const scree_config *config);

    // ---- numbers: what its keys become, once, with the model at hand (scree_model_numbers); no `auto` is left ----
    size_t numbers_size;
    /// For one that asks the law of the contacts for something: changes model->laws[0], when materials and pairs stand,
    /// and nothing else of the model does. NULL: it asks for nothing.
    scree_status (*resolve_law)(scree_model *model, scree_error *error);
    /// Takes its keys from the config and fills its numbers (scree_model_reserve_numbers), when all else of the
    /// model is there. For modules without a face that does so. NULL: nothing to take.
    scree_status (*resolve)(scree_model *model, scree_error *error);

    // ---- faces: what only modules of one kind have ----
    const struct scree_law *law;                  ///< model/law.h
    const struct scree_integrator *integrator;    ///< module/integrator.h
    const struct scree_preparation *preparation;  ///< module/preparation.h
    const struct scree_size_distribution *sizes;  ///< module/size_distribution.h
    const struct scree_wall_shape *wall;          ///< module/wall_shape.h
    const struct scree_shape *shape;              ///< module/shape.h
    const struct scree_geometry *geometry;        ///< module/geometry.h
    const struct scree_stage_numbers *numbers;    ///< module/stage.h
    const struct scree_stage *stage;              ///< run/stage.h
    const struct scree_boundary *boundary;        ///< module/boundary.h
    const struct scree_selection_kind *selection; ///< selection/selection.h
    const struct scree_source_kind *source;       ///< module/source.h

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

    /// Renews what it derives from places and angles for contacts, or from rows: when a neighbour list is made, and in
    /// a part when it is taken, by all processes together. In a step its pass does so. Errors: memory. NULL: nothing.
    scree_status (*derive)(scree_state *state, scree_error *error);
    /// The same of the ghosts of bodies of other processes, when their list has been made. NULL: nothing.
    void (*derive_ghosts)(scree_state *state, const scree_work *work);

    /// A stage begins that takes steps (not: is taken up again), and its boundary stands. An error of the user's input
    /// has its field. NULL: nothing to do.
    scree_status (*begin)(const scree_context *context, scree_error *error);
    /// Whether it looks at the whole sample where a stage begins, which is put together in process 0 then, and only
    /// there: a kind of stage or a boundary where it is chosen, others where they have this or a begin. NULL: always.
    bool (*begins_whole)(const scree_context *context);

    // ---- passes: what it does in a step ----
    const scree_pass *passes;
    size_t pass_count;
    /// Whether it has something to do in the stage that begins. NULL: always.
    bool (*in_use)(const scree_context *context);
    /// Its passes, its begin and what it remembers are right where each process has a part of the bodies
    /// (comm/parts.h): it loops over those that are here, and what it finds out of all goes through comm/comm.h. Of a
    /// choice: so is all that follows from it. Without this a case is refused on several processes (run/ranks.h).
    bool spreads;
    /// Of one that spreads: the choice in this case that does not; NULL: none.
    const char *(*alone)(const scree_model *model);
    bool reads_moments; ///< needs the moments of contact forces (scree_body_contact_moment) while it is in use
    /// Largest force that its loads may put on one body in this step [N], for the quanta; up to 2^10 times more is
    /// safe. NULL: none.
    double (*bound)(const scree_context *context);
    bool bound_differs; ///< the bound looks at the bodies that are here: processes find different ones
    /// A pass behind the contact forces raises flags of bodies that are here: the guard asks all processes in each
    /// step.
    bool flags_late;
    /// Work [J] that it has done on the bodies since the begin of the run. NULL: it does none, or has a row of the
    /// ledger.
    double (*work)(const scree_state *state);

    /// Whether it prescribes the rotation of the body in this row: its energy is no part of the balance then. NULL: of
    /// none.
    bool (*turns)(const scree_state *state, size_t row);

    // ---- results: what it tells ----
    scree_results columns; ///< of series.csv, at every sample
    scree_results results; ///< of summary.json, at the end of a run or when it is stopped
    /// Whether there is something with this index that the rows are about, and its name: each then has all rows, and
    /// with a name in front. NULL: they are about the run, once.
    bool (*told)(const scree_config *config, size_t index, char name[SCREE_RESULT_NAME]);
    /// Results that come from the whole series, that are texts, or with files of their own (run/conclusion.h). Those
    /// that do not apply are left out. NULL: none.
    scree_status (*conclude)(const struct scree_conclusion *run, scree_error *error);
};

/// For begins_whole of those that begin with the bodies that are here, as they work in a step.
bool scree_begins_in_parts(const scree_context *context);

#define SCREE_MODULE_DECLARE(name) extern const scree_module scree_module_##name;
#define SCREE_MODULE_SLOT(name)    SCREE_SLOT_##name,
SCREE_MODULES(SCREE_MODULE_DECLARE)
enum { SCREE_MODULES(SCREE_MODULE_SLOT) SCREE_MODULE_COUNT };

/// All modules, by slot.
extern const scree_module *const scree_modules[SCREE_MODULE_COUNT];

#endif
