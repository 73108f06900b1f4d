/// Keys that follow time. Private to src/case/.
#ifndef SCREE_CASE_SCHEDULE_H
#define SCREE_CASE_SCHEDULE_H

#include "base/schedule.h"
#include "case/check.h"

/// Stores what a key of type SCREE_KEY_SCHEDULE says into its `components` schedules, or notes why not. `node` NULL:
/// the default of the key.
void scree_schedule_store(scree_reader *reader, const scree_key *key, const scree_node *node, const char *path,
                          scree_schedule *out);

/// Values of `key` as of one that has another unit and other limits; NAN where they are wrong, which is noted.
double scree_value_number(scree_reader *reader, const scree_key *key, scree_place place, const char *path,
                          const char *text);

#endif
