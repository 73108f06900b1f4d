/// The counters of a process.
#include "comm/traffic.h"

static scree_traffic counted[SCREE_TRAFFIC_PURPOSES];
static scree_traffic_purpose present = SCREE_TRAFFIC_LISTS;

static void count(scree_traffic *traffic, size_t messages, size_t bytes, double seconds)
{
    traffic->calls++;
    traffic->messages += messages;
    traffic->bytes += bytes;
    traffic->seconds += seconds;
}

scree_traffic scree_traffic_of(scree_traffic_purpose purpose)
{
    return counted[purpose];
}

scree_traffic_purpose scree_traffic_for(scree_traffic_purpose purpose)
{
    const scree_traffic_purpose before = present;
    present = purpose;
    return before;
}

void scree_traffic_count_reduction(size_t bytes, double seconds)
{
    count(&counted[SCREE_TRAFFIC_REDUCTIONS], 0, bytes, seconds);
}

void scree_traffic_count(size_t messages, size_t bytes, double seconds)
{
    count(&counted[present], messages, bytes, seconds);
}
