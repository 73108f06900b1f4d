/// How far two names are apart; private to src/case/ (`scree_nearest` is for everyone).
#ifndef SCREE_CASE_NEAREST_H
#define SCREE_CASE_NEAREST_H

#include <stdbool.h>
#include <stddef.h>

/// Insertions, deletions, substitutions and swaps that turn one into the other; huge for texts above 80 letters.
size_t scree_letters_wrong(const char *a, const char *b);

/// Whether at most a third of the letters are wrong.
bool scree_letters_near(const char *text, const char *name, size_t wrong);

#endif
