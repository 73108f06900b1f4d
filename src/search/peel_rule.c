/// Lookup of the facets of the boundary before, at O(log facets) a question, and gaps of edges.
#include "search/peel_rule.h"

#include <stdlib.h>
#include <string.h>

static int compare(const uint32_t *a, const uint32_t *b, int dimension)
{
    for (int k = 0; k < dimension; k++)
        if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
    return 0;
}

static int compare_edges(const void *a, const void *b)
{
    return compare(a, b, 2);
}

static int compare_triangles(const void *a, const void *b)
{
    return compare(a, b, 3);
}

/// An edge runs one way round the loop; a triangle may begin at any of its corners.
static void turn_to_lowest(uint32_t *facet, int dimension)
{
    if (dimension == 2) return;
    int lowest = 0;
    for (int k = 1; k < 3; k++)
        if (facet[k] < facet[lowest]) lowest = k;
    const uint32_t corner[3] = {facet[0], facet[1], facet[2]};
    for (int k = 0; k < 3; k++) facet[k] = corner[(lowest + k) % 3];
}

void scree_peel_rule_sort(uint32_t *facet, size_t count, int dimension)
{
    for (size_t k = 0; k < count; k++) turn_to_lowest(facet + k * (size_t)dimension, dimension);
    size_t size = (size_t)dimension * sizeof *facet;
    if (count > 0) qsort(facet, count, size, dimension == 2 ? compare_edges : compare_triangles);
}

double scree_peel_rule_share(const scree_peel_rule *rule, int dimension, const uint32_t *corner)
{
    if (!rule->facet) return 1;
    uint32_t facet[3] = {0};
    for (int k = 0; k < dimension; k++) facet[k] = rule->index ? rule->index[corner[k]] : corner[k];
    turn_to_lowest(facet, dimension);
    const size_t size = (size_t)dimension * sizeof *facet;
    const void *found =
        bsearch(facet, rule->facet, rule->facet_count, size, dimension == 2 ? compare_edges : compare_triangles);
    return found ? 1 + rule->hysteresis : 1 - rule->hysteresis;
}

double scree_peel_rule_gap(const scree_peel_rule *rule, const uint32_t corner[2], const double apart[2],
                           const double *radius)
{
    scree_core core[2];
    for (int k = 0; k < 2; k++)
        core[k] = rule->outline ? rule->outline[rule->index ? rule->index[corner[k]] : corner[k]]
                                : (scree_core){.rounding = radius[corner[k]]};
    return scree_core_gap(&core[0], &core[1], apart);
}
