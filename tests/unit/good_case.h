/// The text of tests/cases/good.yaml, for the tests of the case language.
#ifndef SCREE_TESTS_GOOD_CASE_H
#define SCREE_TESTS_GOOD_CASE_H

#include <stdio.h>

static inline const char *good_case(void)
{
    static char text[8192];
    FILE *file = fopen(SCREE_SOURCE_DIR "/tests/cases/good.yaml", "r");
    if (!file) return "tests/cases/good.yaml is missing";
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    (void)fclose(file);
    return text;
}

#endif
