/// A run on several processes: which cases can be spread over them, and when the state is whole. All is done in parts
/// (comm/parts.h), unless somebody looks at the whole: it is put together in process 0 alone then, for a moment.
#ifndef SCREE_RUN_RANKS_H
#define SCREE_RUN_RANKS_H

#include "base/log.h"
#include "run/simulation_data.h"

#include <scree/run.h>

/// Whether this process writes the files of a run: one does.
bool scree_ranks_write(void);

/// Errors: SCREE_ERROR_INPUT when something in the case cannot be spread over several processes, by name.
scree_status scree_ranks_check(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// The same for any number of processes, before there are several.
scree_status scree_ranks_can_spread(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// All processes have opened a case: with the same program, the same case, and without an error (`status` is the own
/// one). Errors: the lowest process's; SCREE_ERROR_INPUT where programs or cases differ.
scree_status scree_ranks_open(uint64_t case_checksum, scree_status status, scree_error *error) SCREE_MUST_USE;

/// All processes see the folder that process 0 has locked, as they write its files together. All call it. Errors:
/// SCREE_ERROR_INPUT.
scree_status scree_ranks_check_folder(const char *directory, scree_error *error) SCREE_MUST_USE;

/// Behind a step, or within its phase decide: the state is whole in process 0, with its list; the others keep their
/// parts and wait. Nothing happens where there is one process, or process 0 has the whole. what: for whom, as log.txt
/// tells it ("whole states were put together for WHAT"). All processes call it. Errors: memory.
scree_status scree_ranks_gather(scree_simulation *s, const char *what, scree_error *error) SCREE_MUST_USE;

/// The same, and s->table of process 0 is that of all contacts.
scree_status scree_ranks_gather_contacts(scree_simulation *s, const char *what, scree_error *error) SCREE_MUST_USE;

/// Before a stage begins, which is chosen: the same for whoever looks at the whole sample then (begins_whole of
/// modules), named; nothing happens where nobody does. All processes call it. Errors: memory.
scree_status scree_ranks_gather_for_begin(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// A stage has begun: where process 0 has the whole all get what it has (scree_ranks_spread); a part has its list.
/// Errors: the same.
scree_status scree_ranks_begun(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// Whether this process does what comes next: where process 0 has the whole that one alone, else all.
bool scree_ranks_acts(const scree_simulation *s);

/// Back to parts, when process 0 has only looked at the whole. All processes call it, without a failure before. Errors:
/// memory.
scree_status scree_ranks_return(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// Back to parts, when process 0 may have changed anything, or has placed the bodies: all get what it has. In the same
/// way. Errors: as of scree_ranks_check, of what shows in the state alone; memory.
scree_status scree_ranks_spread(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// To parts from bodies that are with any process, as ranges of a file are. Errors: scree_parts_spread's.
scree_status scree_ranks_place(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// What contacts remember goes into the state; of a part that has no list yet it is there. Errors: memory.
scree_status scree_ranks_save_contacts(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// A checkpoint, by all processes together, each a range of the rows. Errors: SCREE_ERROR_IO, memory.
scree_status scree_ranks_checkpoint(scree_simulation *s, const char *directory, uint64_t case_checksum,
                                    scree_error *error) SCREE_MUST_USE;

/// In all processes the largest number that one of them has.
double scree_ranks_most(double own);

/// An error that the other processes do not know of has happened in this one: says so and ends them all.
void scree_ranks_fail(const scree_run_options *options, const scree_error *error);

/// Counts of messages, in the log.
void scree_ranks_log(const scree_simulation *s, scree_log *log);

#endif
