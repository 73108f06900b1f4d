/// Memory: 64-byte aligned allocation that can be made to fail in tests, and an arena for per-rebuild scratch.
#ifndef SCREE_BASE_MEMORY_H
#define SCREE_BASE_MEMORY_H

#include "base/error.h"

#include <stdint.h>

#define SCREE_ALIGNMENT 64

/// Sets *pointer to `count * size` zeroed bytes, 64-byte aligned (NULL when the product is zero, and on failure).
/// Checks overflow.
scree_status scree_allocate(void *pointer, size_t count, size_t size, scree_error *error) SCREE_MUST_USE;

/// Grows *pointer (holding `old_count` elements) to `new_count`, keeping contents, zeroing the rest. On failure
/// *pointer is unchanged.
scree_status scree_reallocate(void *pointer, size_t old_count, size_t new_count, size_t size,
                              scree_error *error) SCREE_MUST_USE;

/// Frees *pointer (from the two functions above) and sets it to NULL.
void scree_release(void *pointer);

/// Whether `bytes` could be allocated now; holds none. For what is done next by a library that cannot say that memory
/// has run out. Errors: memory.
scree_status scree_memory_check(size_t bytes, scree_error *error) SCREE_MUST_USE;

/// Gives what was freed back to the system, as far as the C library can: between a phase that took much and one that
/// will, since pieces of other sizes are not filled again. Costs as many microseconds as there are freed pages.
void scree_memory_trim(void);

/// Test hook: the n-th allocation from now fails (0: never). Returns the number of allocations made since the last
/// call.
uint64_t scree_allocation_fail_after(uint64_t n);

/// Bytes now allocated through these functions, and the peak.
void scree_allocation_statistics(size_t *current, size_t *peak);

#endif
