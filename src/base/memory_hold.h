/// Blocks of memory that somebody else looks at: they are freed when their owner and all that hold them have released
/// them, in any order and in any thread.
#ifndef SCREE_BASE_MEMORY_HOLD_H
#define SCREE_BASE_MEMORY_HOLD_H

/// Holds a block from scree_allocate or scree_reallocate: as many scree_release as holders, and one, free it.
void scree_memory_hold(void *block);

#endif
