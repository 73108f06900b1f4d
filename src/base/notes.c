/// Lines in a buffer of fixed size: what finds no room is counted.
#include "base/notes.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void scree_notes_add(scree_notes *notes, const char *format, ...)
{
    if (!notes) return;
    va_list values;
    size_t room = sizeof notes->text - notes->length;
    va_start(values, format);
    int length = vsnprintf(notes->text + notes->length, room, format, values);
    va_end(values);
    // One byte for the newline, one for the end.
    if (length < 0 || (size_t)length + 2 > room) {
        notes->text[notes->length] = 0;
        notes->lost++;
        return;
    }
    notes->length += (size_t)length;
    notes->text[notes->length++] = '\n';
    notes->text[notes->length] = 0;
}

void scree_notes_visit(const scree_notes *notes, void (*tell)(void *user, const char *line), void *user)
{
    char line[1024];
    for (const char *at = notes->text; *at;) {
        size_t length = strcspn(at, "\n"), most = length < sizeof line - 1 ? length : sizeof line - 1;
        memcpy(line, at, most);
        line[most] = 0;
        tell(user, line);
        at += length + 1;
    }
    if (notes->lost == 0) return;
    (void)snprintf(line, sizeof line, "... and %zu more", notes->lost);
    tell(user, line);
}
