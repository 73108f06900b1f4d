/// The case behind the public handle, and the pieces of the case language that other layers use.
#ifndef SCREE_CASE_CASE_H
#define SCREE_CASE_CASE_H

#include "case/config.h"

#include <scree/scree.h>

struct scree_case {
    scree_config config;
    /// For the message of an error that shows only later (model_build): position of a key in the file it came from.
    /// Private to src/case/.
    struct scree_case_source *source;
};

/// Fills file, line, column and value of `error` from its `field` (a key path). A key that the case does not give has
/// its default as value and the position of its section.
void scree_case_locate(const scree_case *c, scree_error *error);

#endif
