/// How far two names are apart; private to src/case/ (`scree_nearest` is for everyone).
#ifndef SCREE_CASE_NEAREST_H
#define SCREE_CASE_NEAREST_H

#include <stdbool.h>
#include <stddef.h>

/// Whether at most a third of the letters are wrong; *wrong counts insertions, deletions, substitutions and swaps of
/// neighbours that turn one into the other. False for texts above 80 letters.
bool scree_letters_near(const char *text, const char *name, size_t *wrong);

#endif
