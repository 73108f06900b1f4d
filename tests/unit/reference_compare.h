/// Comparison of the small reference cases with their stored checksums.
#ifndef SCREE_TESTS_REFERENCE_COMPARE_H
#define SCREE_TESTS_REFERENCE_COMPARE_H

#include "testing.h"

#include "base/processor.h"
#include "reference_cases.h"

/// Names of the instruction sets by level.
static const char *const reference_sets[] = {[2] = "v2", [3] = "v3", [4] = "v4"};

/// Calls `compare` for every case with its stored checksum.
static inline void reference_each(void (*compare)(const char *path, const char *name, uint64_t stored))
{
    glob_t cases;
    assert_int_equal(glob(REFERENCE_CASES, 0, NULL, &cases), 0);
    for (size_t k = 0; k < cases.gl_pathc; k++) {
        char name[64];
        uint64_t stored = 0;
        reference_name(cases.gl_pathv[k], name);
        if (!reference_stored(name, &stored)) fail_msg("no checksum of '%s' is stored; `make reference`", name);
        compare(cases.gl_pathv[k], name, stored);
    }
    globfree(&cases);
}

static inline void reference_expect(const char *path, const char *override, int threads, uint64_t most, uint64_t stored,
                                    const char *what)
{
    uint64_t checksum = 0;
    assert_int_equal(reference_run(path, override, threads, most, &checksum), SCREE_OK);
    if (checksum != stored)
        fail_msg("%s, %s: checksum %016" PRIx64 ", expected %016" PRIx64, path, what, checksum, stored);
}

#endif
