/// cmocka with the headers it needs before it.
#ifndef SCREE_TESTING_H
#define SCREE_TESTING_H

// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on

#endif
