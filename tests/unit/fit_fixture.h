/// What tests of fits have in common: a number by its name, closeness, and what is released.
#ifndef SCREE_TEST_FIT_FIXTURE_H
#define SCREE_TEST_FIT_FIXTURE_H

#include "testing.h"

#include "library/measure.h"

#include <math.h>
#include <string.h>

static inline void forget(measure_tables *each, size_t count, measure_found *found)
{
    for (size_t i = 0; i < count; i++) measure_tables_destroy(&each[i]);
    measure_tables_destroy(&found->mean);
    if (found->fits) scree_release(&found->fits->row);
    scree_release(&found->fits);
}

static inline measure_fit_number number_of(const measure_found *found, const char *name)
{
    for (size_t k = 0; k < found->fits->numbers; k++)
        if (strcmp(found->fits->number[k].name, name) == 0) return found->fits->number[k];
    fail_msg("there is no '%s'", name);
    return (measure_fit_number){.value = NAN};
}

static inline void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) fail_msg("%.12g, not %.12g", value, expected);
}

#endif
