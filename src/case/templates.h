/// The built-in cases, embedded from cases/*.yaml when the library is built. The first comment line of a case file is
/// its one-line meaning.
#ifndef SCREE_CASE_TEMPLATES_H
#define SCREE_CASE_TEMPLATES_H

#include <stddef.h>

typedef struct scree_template {
    const char *name;
    const char *meaning; ///< the first line of the file without its "# "
    const char *text;
    size_t length;
} scree_template;

extern const scree_template scree_templates[];
extern const size_t scree_templates_count;

#endif
