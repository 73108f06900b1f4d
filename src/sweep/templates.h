/// The built-in sweeps (cases/sweeps) and tables of statements (cases/reproduction), embedded when the library is
/// built, as the cases are. The first comment line of a file is its one-line meaning.
#ifndef SCREE_SWEEP_TEMPLATES_H
#define SCREE_SWEEP_TEMPLATES_H

#include "case/templates.h"

extern const scree_template scree_sweep_templates[];
extern const size_t scree_sweep_templates_count;
extern const scree_template scree_statement_templates[];
extern const size_t scree_statement_templates_count;

/// NULL when there is no built-in sweep of this name.
const scree_template *scree_sweep_template(const char *name);

#endif
