/// Aligned allocation with a count of live bytes and a hook that makes the n-th allocation fail.
/// Each block is preceded by one alignment unit that holds its size, and by how many it is held (base/memory_hold.h).
#include "base/memory.h"

#include "base/memory_hold.h"

#include <malloc.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

typedef struct block_head {
    size_t bytes;
    _Atomic size_t holders; ///< the last one frees the block
} block_head;
_Static_assert(sizeof(block_head) <= SCREE_ALIGNMENT, "the head of a block fits into one alignment unit");

static _Atomic uint64_t calls;
static _Atomic uint64_t failing_call;
static _Atomic size_t live, highest;

uint64_t scree_allocation_fail_after(uint64_t n)
{
    uint64_t made = atomic_exchange(&calls, 0);
    atomic_store(&failing_call, n);
    return made;
}

void scree_allocation_statistics(size_t *current, size_t *peak)
{
    if (current) *current = atomic_load(&live);
    if (peak) *peak = atomic_load(&highest);
}

static bool next_call_fails(void)
{
    return atomic_fetch_add(&calls, 1) + 1 == atomic_load(&failing_call);
}

static void *allocate_bytes(size_t bytes)
{
    if (next_call_fails()) return NULL;
    size_t whole = (bytes + 2 * SCREE_ALIGNMENT - 1) / SCREE_ALIGNMENT * SCREE_ALIGNMENT;
    unsigned char *block = whole < bytes ? NULL : aligned_alloc(SCREE_ALIGNMENT, whole);
    if (!block) return NULL;
    block_head *head = (block_head *)(void *)block;
    head->bytes = bytes;
    atomic_init(&head->holders, 1);
    memset(block + SCREE_ALIGNMENT, 0, whole - SCREE_ALIGNMENT);
    size_t now = atomic_fetch_add(&live, bytes) + bytes;
    size_t before = atomic_load(&highest);
    while (now > before && !atomic_compare_exchange_weak(&highest, &before, now)) continue;
    return block + SCREE_ALIGNMENT;
}

scree_status scree_allocate(void *pointer, size_t count, size_t size, scree_error *error)
{
    void *block = NULL;
    size_t bytes;
    bool fits = !__builtin_mul_overflow(count, size, &bytes);
    if (fits && bytes > 0) block = allocate_bytes(bytes);
    memcpy(pointer, &block, sizeof block);
    return fits && (block || bytes == 0) ? SCREE_OK : scree_error_set_memory(error, fits ? bytes : SIZE_MAX);
}

/// Address space is asked of the system, not a block of malloc: glibc takes the release of a large block as a sign that
/// such blocks come often, and from then on keeps freed memory of up to twice that size.
scree_status scree_memory_check(size_t bytes, scree_error *error)
{
    if (next_call_fails()) return scree_error_set_memory(error, bytes);
    void *room = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) return scree_error_set_memory(error, bytes);
    (void)munmap(room, bytes);
    return SCREE_OK;
}

void scree_memory_trim(void)
{
#ifdef __GLIBC__
    (void)malloc_trim(0);
#endif
}

scree_status scree_reallocate(void *pointer, size_t old_count, size_t new_count, size_t size, scree_error *error)
{
    void *old_block, *new_block;
    memcpy(&old_block, pointer, sizeof old_block);
    scree_status status = scree_allocate(&new_block, new_count, size, error);
    if (status) return status;
    size_t kept = old_count < new_count ? old_count : new_count;
    if (old_block && kept > 0) memcpy(new_block, old_block, kept * size);
    scree_release(pointer);
    memcpy(pointer, &new_block, sizeof new_block);
    return SCREE_OK;
}

static block_head *head_of(void *block)
{
    return (block_head *)(void *)((unsigned char *)block - SCREE_ALIGNMENT);
}

void scree_memory_hold(void *block)
{
    atomic_fetch_add(&head_of(block)->holders, 1);
}

void scree_release(void *pointer)
{
    unsigned char *block, *none = NULL;
    memcpy(&block, pointer, sizeof block);
    memcpy(pointer, &none, sizeof none);
    if (!block || atomic_fetch_sub(&head_of(block)->holders, 1) > 1) return;
    atomic_fetch_sub(&live, head_of(block)->bytes);
    free(head_of(block));
}
