/// What this machine can do: the instruction set that kernels are chosen for at run time, and processors.
#ifndef SCREE_BASE_PROCESSOR_H
#define SCREE_BASE_PROCESSOR_H

/// Highest level that both this processor and the kernels know: 2, 3 or 4 for x86-64-v2, v3, v4 (the microarchitecture
/// levels of the x86-64 psABI), 0 elsewhere: the numbers that SCREE_ISA has in the *_batch.c files.
int scree_processor_best(void);

/// The same, or the lower one that scree_instruction_set_choose has set.
int scree_processor_level(void);

/// Processors that this process may run on, at least 1.
int scree_processor_count(void);

#endif
