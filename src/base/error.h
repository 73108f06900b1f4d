/// Errors: every fallible function returns a `scree_status` and fills a caller-owned `scree_error`.
/// The library never prints, exits or aborts. Assertions are for programmer errors only.
#ifndef SCREE_BASE_ERROR_H
#define SCREE_BASE_ERROR_H

#include <scree/error.h>

#include <stdarg.h>

#define SCREE_MUST_USE            __attribute__((warn_unused_result))
#define SCREE_PRINTF(text, first) __attribute__((format(printf, text, first)))

/// Fills `error` (which may be NULL) with a formatted message and returns `status`, so that a caller can write
/// `return scree_error_set(error, SCREE_ERROR_IO, "cannot write '%s'", path);`. Position and field fields are cleared.
scree_status scree_error_set(scree_error *error, scree_status status, const char *format, ...) SCREE_PRINTF(3, 4);

/// The same of values that are a list already: for functions that set errors of their own kind.
scree_status scree_error_set_list(scree_error *error, scree_status status, const char *format, va_list values)
    SCREE_PRINTF(3, 0);

/// The same for a failed system call: appends ": " and strerror(errno).
scree_status scree_error_set_errno(scree_error *error, scree_status status, const char *format, ...) SCREE_PRINTF(3, 4);

/// Wrong input: what is wrong with `key` (of the case, or an option; NULL: with none), and what is accepted in its
/// place (NULL: nothing is listed).
scree_status scree_error_refuse(scree_error *error, const char *key, const char *accepted, const char *format, ...)
    SCREE_PRINTF(4, 5);

/// The key that an error which has been set is of, e.g. "walls.3.file". Returns the status; nothing happens where it is
/// SCREE_OK or `error` is NULL.
scree_status scree_error_key(scree_error *error, scree_status status, const char *format, ...) SCREE_PRINTF(3, 4);

/// Out of memory, with the number of bytes that were asked for.
scree_status scree_error_set_memory(scree_error *error, size_t bytes);

#endif
