/// What people read: errors, and numbers with human units.
#ifndef SCREE_CLI_TERMINAL_H
#define SCREE_CLI_TERMINAL_H

#include <scree/scree.h>

/// A terminal that can colour and rewrite a line (and no NO_COLOR in the environment).
bool scree_terminal_is_rich(FILE *stream);

/// Columns of the terminal that standard error is, 80 when it does not say.
size_t scree_terminal_width(void);

/// Prints `error` to standard error: "file:line:column: field: message (accepted: ...)", or when it has no file
/// "scree VERB: field: ..." (`verb` may be NULL). Returns error->status, as something that is certainly a failure.
scree_status scree_terminal_error(const char *verb, const scree_error *error);

/// "20 us", "0.75 mm": a value with a decimal prefix on its SI unit.
void scree_human_quantity(char *text, size_t size, double value, const char *unit);
/// "3.2 s", "1 min 20 s", "2 h 5 min", "3 d 4 h".
void scree_human_duration(char *text, size_t size, double seconds);
/// "18.3 million".
void scree_human_count(char *text, size_t size, double count);

#endif
