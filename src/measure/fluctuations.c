/// Displacement fluctuations relative to the affine field u = a + G (x - mean x) that fits all displacements best
/// (least squares; P figs. 2.6, 3.7-3.9 show them). G solves the 2 x 2 normal equations G M = C with the centred
/// moments M = sum dx (x) dx and C = sum du (x) dx. Bodies on a line have no gradient across it: then G = 0. Cost:
/// O(count).
#include "measure/measure.h"

#include "base/matrix.h"

#include <math.h>

/// Relative determinant of M below which all points count as lying on one line.
#define DEGENERATE 1e-12

static double mean_difference(const double *from, const double *to, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += to[i] - (from ? from[i] : 0);
    return sum / (double)count;
}

static void solve_gradient(const double moment[3], const double mixed[4], double gradient[4])
{
    double determinant = moment[0] * moment[2] - moment[1] * moment[1], trace = moment[0] + moment[2];
    bool solvable = determinant > DEGENERATE * trace * trace;
    for (int i = 0; i < 2; i++) {
        const double *c = mixed + 2 * i;
        gradient[2 * i] = solvable ? (c[0] * moment[2] - c[1] * moment[1]) / determinant : 0;
        gradient[2 * i + 1] = solvable ? (c[1] * moment[0] - c[0] * moment[1]) / determinant : 0;
    }
}

double scree_fluctuations(const double *x0, const double *y0, const double *x1, const double *y1, size_t count,
                          double *fx, double *fy, double gradient[4])
{
    if (count == 0) {
        for (int i = 0; i < 4; i++) gradient[i] = 0;
        return 0;
    }
    double centre[2] = {mean_difference(NULL, x0, count), mean_difference(NULL, y0, count)};
    double shift[2] = {mean_difference(x0, x1, count), mean_difference(y0, y1, count)};
    double moment[3] = {0}, mixed[4] = {0};
    for (size_t i = 0; i < count; i++) {
        double dx = x0[i] - centre[0], dy = y0[i] - centre[1];
        double ux = x1[i] - x0[i] - shift[0], uy = y1[i] - y0[i] - shift[1];
        moment[0] += dx * dx;
        moment[1] += dx * dy;
        moment[2] += dy * dy;
        mixed[0] += ux * dx;
        mixed[1] += ux * dy;
        mixed[2] += uy * dx;
        mixed[3] += uy * dy;
    }
    solve_gradient(moment, mixed, gradient);
    double square = 0;
    for (size_t i = 0; i < count; i++) {
        double dx = x0[i] - centre[0], dy = y0[i] - centre[1];
        fx[i] = x1[i] - x0[i] - shift[0] - gradient[0] * dx - gradient[1] * dy;
        fy[i] = y1[i] - y0[i] - shift[1] - gradient[2] * dx - gradient[3] * dy;
        square += fx[i] * fx[i] + fy[i] * fy[i];
    }
    return sqrt(square / (double)count);
}

/// H H_0^-1, H_0 at the start of the loading stage.
static void deformation_of(const scree_cell *cell, double deformation[9])
{
    double inverse[9];
    scree_matrix_invert(cell->reference, inverse);
    scree_matrix_multiply(cell->lattice, inverse, deformation);
}

double scree_cell_fluctuations(const scree_cell *from, const scree_cell *to, const double *x0, const double *y0,
                               const double *x1, const double *y1, size_t count, double *fx, double *fy)
{
    double before[9], back[9], after[9], deformation[9], inverse[9], mean[2] = {0}, square = 0;
    deformation_of(from, before);
    deformation_of(to, after);
    scree_matrix_invert(before, back);
    scree_matrix_multiply(after, back, deformation);
    scree_matrix_invert(to->lattice, inverse);
    for (size_t i = 0; i < count; i++) {
        const double begin[3] = {x0[i], y0[i], 0};
        double carried[3], u[3], whole[3], fraction[3];
        scree_matrix_apply(deformation, begin, carried);
        u[0] = x1[i] - carried[0], u[1] = y1[i] - carried[1], u[2] = 0;
        scree_matrix_apply(inverse, u, fraction);
        for (int k = 0; k < 3; k++) fraction[k] = rint(fraction[k]);
        scree_matrix_apply(to->lattice, fraction, whole);
        fx[i] = u[0] - whole[0];
        fy[i] = u[1] - whole[1];
        mean[0] += fx[i] / (double)count;
        mean[1] += fy[i] / (double)count;
    }
    for (size_t i = 0; i < count; i++) {
        fx[i] -= mean[0];
        fy[i] -= mean[1];
        square += fx[i] * fx[i] + fy[i] * fy[i];
    }
    return count > 0 ? sqrt(square / (double)count) : 0;
}
