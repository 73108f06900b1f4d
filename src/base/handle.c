#include "base/handle.h"

#ifndef NDEBUG
#include <pthread.h>
#include <search.h>
#include <stdint.h>

/// Places of handles that were freed.
static void *freed;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static int compare(const void *a, const void *b)
{
    return ((uintptr_t)a > (uintptr_t)b) - ((uintptr_t)a < (uintptr_t)b);
}

void scree_handle_made(const void *handle)
{
    (void)pthread_mutex_lock(&lock);
    (void)tdelete(handle, &freed, compare);
    (void)pthread_mutex_unlock(&lock);
}

bool scree_handle_stands(const void *handle)
{
    (void)pthread_mutex_lock(&lock);
    const bool gone = handle && tfind(handle, &freed, compare);
    (void)pthread_mutex_unlock(&lock);
    return handle && !gone;
}

void scree_handle_forget(const void *handle)
{
    (void)pthread_mutex_lock(&lock);
    // Out of memory, one handle is not watched.
    (void)tsearch(handle, &freed, compare);
    (void)pthread_mutex_unlock(&lock);
}
#else
typedef int scree_handle_nothing; // a translation unit declares something
#endif
