/// Texts made from the table of verbs.
#ifndef SCREE_CLI_HELP_H
#define SCREE_CLI_HELP_H

#include "cli/verbs.h"

/// `scree --help`.
void scree_help_write(FILE *file);
/// `scree VERB --help`.
void scree_help_write_verb(FILE *file, const scree_verb *verb);
/// `scree GROUP --help` (second), `scree help GROUP` (its words are GROUP alone): the verbs of a group of two words.
/// Returns whether `words` asked for that.
bool scree_help_write_group(FILE *file, size_t count, const char *const *words, bool second);
/// The man page, in roff.
void scree_help_write_manual(FILE *file);
/// Completion for bash.
void scree_help_write_completion(FILE *file);

/// "run [OPTION]... [CASE]": how a verb is called.
void scree_help_usage(const scree_verb *verb, char *text, size_t size);

#endif
