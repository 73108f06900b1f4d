/// cmocka with the headers it needs before it, and the failure of what must not fail.
#ifndef SCREE_TESTING_H
#define SCREE_TESTING_H

// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on

#include "base/error.h"

/// Fails with the message of the error.
static inline void check(scree_status status, const scree_error *error)
{
    if (status) fail_msg("status %d: %s", (int)status, error->message);
}

#endif
