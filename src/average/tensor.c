/// Principal axes of small tensors.
#include "average/tensor.h"

#include <math.h>
#include <string.h>

/// One rotation of Jacobi in the plane of axes p, q, which makes the component pq zero.
static void rotate(double a[3][3], double axes[3][3], int p, int q)
{
    if (a[p][q] == 0) return;
    const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    const double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    const double c = 1 / sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; k++) {
        const double x = a[k][p], y = a[k][q];
        a[k][p] = c * x - s * y;
        a[k][q] = s * x + c * y;
    }
    for (int k = 0; k < 3; k++) {
        const double x = a[p][k], y = a[q][k];
        a[p][k] = c * x - s * y;
        a[q][k] = s * x + c * y;
    }
    for (int k = 0; k < 3; k++) {
        const double x = axes[p][k], y = axes[q][k];
        axes[p][k] = c * x - s * y;
        axes[q][k] = s * x + c * y;
    }
}

void scree_tensor_principal(const double tensor[9], int dimension, double value[3], double direction[9])
{
    double a[3][3], axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) a[i][j] = 0.5 * (tensor[3 * i + j] + tensor[3 * j + i]);
    for (int sweep = 0; sweep < 30; sweep++) {
        const double off = fabs(a[0][1]) + fabs(a[0][2]) + fabs(a[1][2]);
        if (off == 0) break;
        rotate(a, axes, 0, 1);
        if (dimension == 2) continue;
        rotate(a, axes, 0, 2);
        rotate(a, axes, 1, 2);
    }
    for (int i = 1; i < dimension; i++)
        for (int j = i; j > 0 && a[order[j]][order[j]] > a[order[j - 1]][order[j - 1]]; j--) {
            const int other = order[j];
            order[j] = order[j - 1];
            order[j - 1] = other;
        }
    for (int i = 0; i < 3; i++) {
        value[i] = a[order[i]][order[i]];
        memcpy(direction + 3 * i, axes[order[i]], sizeof axes[0]);
    }
}

#define ALIKE 1e-12 /* over the largest: sums of some thousand terms differ by as much that should not */

scree_tensor_form scree_tensor_form_of(const double tensor[9], int dimension)
{
    double value[3], direction[9];
    scree_tensor_principal(tensor, dimension, value, direction);
    const double *e = direction;
    double angle = dimension == 2 ? atan2(e[1], e[0]) : asin(fmin(1, fabs(e[2])));
    if (angle > M_PI / 2) angle -= M_PI;
    if (angle <= -M_PI / 2) angle += M_PI;
    double trace = 0, largest = 0;
    for (int k = 0; k < dimension; k++) {
        trace += value[k];
        largest = fmax(largest, fabs(value[k]));
    }
    // Between two that are alike there is no largest direction: that of round-off is none.
    if (!(value[0] - value[1] > ALIKE * largest)) angle = NAN;
    return (scree_tensor_form){trace, value[0] - value[dimension - 1], angle};
}

int scree_tensor_invert(const double tensor[9], int dimension, double inverse[9])
{
    double value[3], direction[9];
    scree_tensor_principal(tensor, dimension, value, direction);
    memset(inverse, 0, 9 * sizeof *inverse);
    // Singular to round-off: what is fitted lies on a line or in a plane.
    if (!(value[dimension - 1] > 1e-13 * value[0])) return 0;
    for (int k = 0; k < dimension; k++) scree_tensor_add(inverse, 1 / value[k], direction + 3 * k, direction + 3 * k);
    return 1;
}
