/// Handles of the library in builds with assertions: the use of one that was freed, or its second freeing, fails an
/// assertion that stands in the function which was given it. Where a freed handle lay is remembered until another is
/// made there; the memory itself is not looked at. Without assertions nothing is kept and nothing is asked.
#ifndef SCREE_BASE_HANDLE_H
#define SCREE_BASE_HANDLE_H

#ifdef NDEBUG
#define scree_handle_made(handle) ((void)(handle))
#define scree_handle_check(handle, kind) ((void)(handle))
#define scree_handle_freed(handle, kind) ((void)(handle))
#else
#include <assert.h>
#include <stdbool.h>

/// kind: "a case"
#define scree_handle_check(handle, kind) assert(scree_handle_stands(handle) && kind " that is NULL or was freed")
#define scree_handle_freed(handle, kind) (scree_handle_check(handle, kind), scree_handle_forget(handle))

void scree_handle_made(const void *handle);
bool scree_handle_stands(const void *handle);
void scree_handle_forget(const void *handle);
#endif

#endif
