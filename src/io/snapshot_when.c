#include "io/snapshot_when.h"

#include "base/units.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

scree_status scree_snapshot_refuse_when(const scree_snapshot_mark *mark, size_t count, const char *when,
                                        const char *option, scree_error *error)
{
    char text[sizeof error->accepted];
    size_t used = (size_t)snprintf(text, sizeof text, "start, end, #N, an axial strain, a time with its unit");
    for (size_t k = 0; k < count && used < sizeof text; k++)
        if (k == 0 || strcmp(mark[k].stage_name, mark[k - 1].stage_name) != 0)
            used += (size_t)snprintf(text + used, sizeof text - used, ", %s", mark[k].stage_name);
    return scree_error_refuse(error, option, text, "the run has no snapshot of '%s'", when);
}

/// The snapshot nearest to a strain or a time; of several, the last. SIZE_MAX: none has one.
static scree_status find_nearest(const scree_snapshot_mark *mark, size_t count, double wanted, bool is_time,
                                 const char *option, size_t *which, scree_error *error)
{
    double least = INFINITY, low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < count; k++) {
        const double at = is_time ? mark[k].time : mark[k].axial_strain, off = fabs(at - wanted);
        low = fmin(low, at);
        high = fmax(high, at);
        if (!(off <= least)) continue;
        least = off;
        *which = k;
    }
    if (*which == SIZE_MAX || !(least > 0.05 * (high - low)) || (wanted >= low && wanted <= high)) return SCREE_OK;
    const double unit = is_time ? 1 : 100;
    const char *name = is_time ? "s" : "%";
    char range[80];
    (void)snprintf(range, sizeof range, "%.4g %s to %.4g %s", unit * low, name, unit * high, name);
    return scree_error_refuse(error, option, range, "the run does not reach '%.4g %s'", unit * wanted, name);
}

scree_status scree_snapshot_find_when(const scree_snapshot_mark *mark, size_t count, const char *when,
                                      const char *option, size_t *which, scree_error *error)
{
    scree_error ignored = {0};
    scree_status status = SCREE_OK;
    double value;
    char *end;
    *which = strcmp(when, "start") == 0 ? 0 : count - 1;
    if (strcmp(when, "start") == 0 || strcmp(when, "end") == 0) return SCREE_OK;
    *which = SIZE_MAX;
    for (size_t k = 0; k < count; k++)
        if (scree_snapshot_mark_is_of(&mark[k], when)) *which = k;
    for (size_t k = 0; k < count && *when == '#'; k++)
        if (isdigit((unsigned char)when[1]) && strtoll(when + 1, &end, 10) == mark[k].index && !*end) *which = k;
    if (*which == SIZE_MAX && !scree_units_parse(when, "1", &value, &ignored))
        status = find_nearest(mark, count, value, false, option, which, error);
    else if (*which == SIZE_MAX && !scree_units_parse(when, "s", &value, &ignored))
        status = find_nearest(mark, count, value, true, option, which, error);
    if (status || *which != SIZE_MAX) return status;
    return scree_snapshot_refuse_when(mark, count, when, option, error);
}
