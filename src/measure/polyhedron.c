/// Volume and displacement gradient of a closed polyhedron: see polyhedron.h for the formula and what is exact about
/// it. Cost: O(1) a triangle.
#include "measure/polyhedron.h"

static void half_cross(const double a[3], const double b[3], double product[3])
{
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        product[k] = 0.5 * (a[l] * b[m] - a[m] * b[l]);
    }
}

void scree_polyhedron_add(scree_polyhedron_sum *sum, double x[3][3], double u[3][3])
{
    double corner[3], side[2][3], turn[2][3], middle[3], bend[3], volume = 0;
    for (int k = 0; k < 3; k++) {
        corner[k] = x[0][k] + u[0][k] / 2;
        for (int i = 0; i < 2; i++) {
            turn[i][k] = u[i + 1][k] - u[0][k];
            side[i][k] = x[i + 1][k] - x[0][k] + turn[i][k] / 2;
        }
    }
    // The mean of a quadratic function exceeds its middle by a twelfth of the square's coefficient.
    half_cross(side[0], side[1], middle);
    half_cross(turn[0], turn[1], bend);
    for (int k = 0; k < 3; k++) {
        volume += corner[k] * middle[k] / 3;
        for (int i = 0; i < 3; i++)
            scree_integer_sum_add(&sum->gradient[3 * i + k],
                                  (u[0][i] + u[1][i] + u[2][i]) / 3 * (middle[k] + bend[k] / 12));
    }
    scree_integer_sum_add(&sum->volume, volume);
}

void scree_polyhedron_finish(const scree_polyhedron_sum *sum, double gradient[9])
{
    double volume = scree_integer_sum_total(&sum->volume);
    for (int i = 0; i < 9; i++)
        gradient[i] = volume > 0 || volume < 0 ? scree_integer_sum_total(&sum->gradient[i]) / volume : 0;
}
