/// A run on several processes: which cases can be spread over them, and when the state is whole. A step is taken by
/// parts (comm/parts.h); where stages begin, files are written and some samples are taken, the state
/// is whole in all processes, but for samples whose measures all say that they work in parts (scree_results.in_parts).
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

/// Before a step: each process keeps its part. Nothing happens where one is alone, or has it. Errors: as of
/// scree_ranks_check, of what shows in the state alone; memory.
scree_status scree_ranks_spread(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// Behind a step, or within its phase decide: the state is whole in all processes, with its list. Nothing happens where
/// it is. what: for whom, as log.txt tells it ("whole states were put together for WHAT"). Errors: memory.
scree_status scree_ranks_gather(scree_simulation *s, const char *what, scree_error *error) SCREE_MUST_USE;

/// The same, and s->table is that of all contacts, where the last sample was taken in parts.
scree_status scree_ranks_gather_contacts(scree_simulation *s, const char *what, scree_error *error) SCREE_MUST_USE;

/// In all processes the largest number that one of them has.
double scree_ranks_most(double own);

/// An error that the other processes do not know of has happened in this one: says so and ends them all.
void scree_ranks_fail(const scree_run_options *options, const scree_error *error);

/// Counts of messages, in the log.
void scree_ranks_log(const scree_simulation *s, scree_log *log);

#endif
