/// Writes the table of checksums of the small reference cases to standard output; `make reference` keeps it as
/// tests/reference/small.txt.
#include "reference_cases.h"

int main(void)
{
    glob_t cases;
    if (glob(REFERENCE_CASES, 0, NULL, &cases)) return 1;
    printf("# State checksums of the cases in cases/, written by `make reference`: name checksum\n");
    for (size_t k = 0; k < cases.gl_pathc; k++) {
        char name[64];
        uint64_t checksum;
        reference_name(cases.gl_pathv[k], name);
        if (reference_run(cases.gl_pathv[k], NULL, 1, REFERENCE_END, &checksum)) return 1;
        printf("%s %016" PRIx64 "\n", name, checksum);
    }
    globfree(&cases);
    return 0;
}
