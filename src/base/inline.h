/// For what a kernel needs inside of its loop.
#ifndef SCREE_BASE_INLINE_H
#define SCREE_BASE_INLINE_H

#define SCREE_INLINE static inline __attribute__((always_inline))

#endif
