/// Names of functions in files named *_batch.c, which are compiled once for each instruction set (CMakeLists.txt):
/// name_v2, name_v3, name_v4, or name_v0 where there is one set only.
#ifndef SCREE_BASE_KERNEL_NAME_H
#define SCREE_BASE_KERNEL_NAME_H

#define SCREE_KERNEL_PASTE(name, isa) name##_v##isa
#define SCREE_KERNEL_JOIN(name, isa)  SCREE_KERNEL_PASTE(name, isa)
#define SCREE_KERNEL_NAME(name)       SCREE_KERNEL_JOIN(name, SCREE_ISA)

#endif
