/// Version text, with the compiler and the instruction set in use.
#include "base/processor.h"

#include <scree/scree.h>

#if defined __clang__
#define QUOTE(number)   #number
#define DOTTED(a, b, c) QUOTE(a) "." QUOTE(b) "." QUOTE(c)
#define COMPILER        "clang " DOTTED(__clang_major__, __clang_minor__, __clang_patchlevel__)
#else
#define COMPILER "gcc " __VERSION__
#endif
#define TEXT(set) SCREE_VERSION " (" COMPILER ", kernels for " set ")"

const char *scree_version(void)
{
    switch (scree_processor_level()) {
    case 4:
        return TEXT("x86-64-v4");
    case 3:
        return TEXT("x86-64-v3");
    case 2:
        return TEXT("x86-64-v2");
    default:
        return TEXT("any processor");
    }
}
