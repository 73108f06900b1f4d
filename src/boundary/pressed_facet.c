/// Integers of the pressure on triangles and walls: see pressed_facet.h.
#include "boundary/pressed_facet.h"

#include "base/fixed.h"

/// E(a, b).
static void edge_quanta(double scale, const scree_vector a, const scree_vector b, int64_t quanta[3])
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        quanta[k] = scree_fixed_round(scale * (a[i] * b[j] - a[j] * b[i]));
    }
}

void scree_triangle_press(double scale, scree_vector corner[3], int64_t force[3])
{
    int64_t edge[3][3];
    for (int c = 0; c < 3; c++) edge_quanta(scale, corner[c], corner[(c + 1) % 3], edge[c]);
    for (int k = 0; k < 3; k++) force[k] = -(edge[0][k] + edge[1][k] + edge[2][k]);
}

void scree_wall_press(double scale, double plate, const scree_vector a, const scree_vector b, bool a_first,
                      int64_t at_a[3], int64_t at_b[3])
{
    int64_t edge[3], share, rest;
    edge_quanta(scale, a, b, edge);
    const double *first = a_first ? a : b, *second = a_first ? b : a;
    double height = 2 * (first[2] - plate) + (second[2] - plate);
    at_a[2] = at_b[2] = 0;
    for (int k = 0; k < 2; k++) {
        int across = 1 - k, sign = k == 0 ? 1 : -1;
        int64_t u_a = scree_fixed_round(3 * scale * (a[2] - 2 * plate) * a[across]);
        int64_t u_b = scree_fixed_round(3 * scale * (b[2] - 2 * plate) * b[across]);
        share = -sign * scree_fixed_round(scale * height * (a[across] - b[across]));
        rest = -(3 * edge[k] + sign * (u_a - u_b)) - share;
        at_a[k] = a_first ? share : rest;
        at_b[k] = a_first ? rest : share;
    }
}
