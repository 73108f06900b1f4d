/// What was found on the way and is no failure: lines for the log, kept until there is one.
#ifndef SCREE_BASE_NOTES_H
#define SCREE_BASE_NOTES_H

#include <stddef.h>

typedef struct scree_notes {
    char text[8192]; ///< lines, each with its newline
    size_t length;
    size_t lost; ///< lines that found no room
} scree_notes;

/// Adds a line; `notes` may be NULL.
__attribute__((format(printf, 2, 3))) void scree_notes_add(scree_notes *notes, const char *format, ...);

/// Calls `tell` for each line.
void scree_notes_visit(const scree_notes *notes, void (*tell)(void *user, const char *line), void *user);

#endif
