/// Version text. The instruction set is the one that the kernels are chosen for at run time: x86-64-v2, v3 or v4
/// (the microarchitecture levels of the x86-64 psABI), of which the features below are what the kernels use.
#include <scree/scree.h>

#if defined __clang__
#define COMPILER "clang " __clang_version__
#else
#define COMPILER "gcc " __VERSION__
#endif
#define TEXT(set) SCREE_VERSION " (" COMPILER ", kernels for " set ")"

const char *scree_version(void)
{
#if defined __x86_64__
    __builtin_cpu_init();
    bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
    bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
              __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
              __builtin_cpu_supports("avx512vl");
    return v4 ? TEXT("x86-64-v4") : v3 ? TEXT("x86-64-v3") : TEXT("x86-64-v2");
#else
    return TEXT("any processor");
#endif
}
