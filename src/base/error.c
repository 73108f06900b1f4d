/// Errors and their text. No allocation.
#include "base/error.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

scree_status scree_error_set_list(scree_error *error, scree_status status, const char *format, va_list values)
{
    if (!error) return status;
    memset(error, 0, sizeof *error);
    error->status = status;
    (void)vsnprintf(error->message, sizeof error->message, format, values);
    return status;
}

scree_status scree_error_set(scree_error *error, scree_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)scree_error_set_list(error, status, format, arguments);
    va_end(arguments);
    return status;
}

scree_status scree_error_set_errno(scree_error *error, scree_status status, const char *format, ...)
{
    int number = errno;
    va_list arguments;
    va_start(arguments, format);
    (void)scree_error_set_list(error, status, format, arguments);
    va_end(arguments);
    if (error) {
        size_t length = strlen(error->message);
        (void)snprintf(error->message + length, sizeof error->message - length, ": %s", strerror(number));
    }
    return status;
}

scree_status scree_error_refuse(scree_error *error, const char *key, const char *accepted, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)scree_error_set_list(error, SCREE_ERROR_INPUT, format, arguments);
    va_end(arguments);
    if (error && accepted) (void)snprintf(error->accepted, sizeof error->accepted, "%s", accepted);
    return key ? scree_error_key(error, SCREE_ERROR_INPUT, "%s", key) : SCREE_ERROR_INPUT;
}

scree_status scree_error_key(scree_error *error, scree_status status, const char *format, ...)
{
    va_list arguments;
    if (!error || !status) return status;
    va_start(arguments, format);
    (void)vsnprintf(error->field, sizeof error->field, format, arguments);
    va_end(arguments);
    return status;
}

scree_status scree_error_set_memory(scree_error *error, size_t bytes)
{
    return scree_error_set(error, SCREE_ERROR_IO, "out of memory: %zu bytes were asked for", bytes);
}

size_t scree_error_format(const scree_error *error, char *text, size_t size)
{
    char place[340] = "";
    if (error->file[0] && error->line > 0)
        (void)snprintf(place, sizeof place, "%s:%d:%d: ", error->file, error->line, error->column);
    else if (error->file[0])
        (void)snprintf(place, sizeof place, "%s: ", error->file);
    // What the message suggests is not said again.
    char quoted[sizeof error->accepted + 2];
    (void)snprintf(quoted, sizeof quoted, "'%s'", error->accepted);
    const char *accepted = strstr(error->message, quoted) ? "" : error->accepted;
    int length = snprintf(text, size, "%s%s%s%s%s%s%s", place, error->field, error->field[0] ? ": " : "",
                          error->message, accepted[0] ? " (accepted: " : "", accepted, accepted[0] ? ")" : "");
    return length < 0 ? 0 : (size_t)length;
}
