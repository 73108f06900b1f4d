/// The instruction set from the features that tell the levels apart; processors from the affinity of the process.
#include "base/processor.h"

#include "base/error.h"

#include <scree/scree.h>

#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>

static atomic_int chosen; ///< 0: the best one

int scree_processor_best(void)
{
#if defined __x86_64__
    __builtin_cpu_init();
    bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
              __builtin_cpu_supports("bmi2");
    bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
              __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
              __builtin_cpu_supports("avx512vl");
    return v4 ? 4 : v3 ? 3 : 2;
#else
    return 0;
#endif
}

int scree_processor_level(void)
{
    int best = scree_processor_best(), level = atomic_load_explicit(&chosen, memory_order_relaxed);
    return level > 0 && level < best ? level : best;
}

scree_status scree_instruction_set_choose(const char *name, scree_error *error)
{
    static const char *const names[] = {[2] = "v2", [3] = "v3", [4] = "v4"};
    int best = scree_processor_best(), level = best > 0 ? 4 : 0;
    if (name && strcmp(name, "auto") == 0) name = NULL;
    while (name && level >= 2 && strcmp(name, names[level]) != 0) level--;
    if (name && best == 0)
        return scree_error_set(error, SCREE_ERROR_INPUT, "instruction set '%s': there is only one on this machine",
                               name);
    if (name && level < 2)
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "instruction set '%s': unknown; say auto, v2, v3 or v4 (x86-64-v2, -v3, -v4)", name);
    if (name && level > best)
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "instruction set '%s': this processor does not have it; its best is %s", name,
                               names[best]);
    atomic_store(&chosen, name ? level : 0);
    return SCREE_OK;
}

int scree_processor_count(void)
{
    cpu_set_t allowed;
    return sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : 1;
}
