/// Displacement fluctuations relative to the affine field u = a + G (x - mean x) that fits all displacements best
/// (least squares; P figs. 2.6, 3.7-3.9 show them). G solves the normal equations G M = C with the centred moments
/// M = sum dx (x) dx and C = sum du (x) dx, by Cholesky's factors of M. Bodies on a line (in a plane) have no gradient
/// across it: then G = 0. Cost: O(count).
#include "measure/measure.h"

#include "base/matrix.h"
#include "state/periodic.h"

#include <math.h>

/// Square of a diagonal Cholesky factor over the trace of M below which all points count as lying on one line or plane.
#define DEGENERATE 1e-12

static double mean_difference(const double *from, const double *to, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += to[i] - (from ? from[i] : 0);
    return sum / (double)count;
}

/// Turns the lower half of the moments into their Cholesky factor; false when they are degenerate.
static bool factorise(int n, double m[3][3])
{
    double trace = 0;
    for (int i = 0; i < n; i++) trace += m[i][i];
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            for (int k = 0; k < j; k++) m[i][j] -= m[i][k] * m[j][k];
            if (i == j && !(m[i][i] > DEGENERATE * trace)) return false;
            m[i][j] = i == j ? sqrt(m[i][i]) : m[i][j] / m[j][j];
        }
    return true;
}

/// Row of G from its row of C.
static void solve_row(int n, double factor[3][3], const double *mixed, double *row)
{
    for (int i = 0; i < n; i++) {
        row[i] = mixed[i];
        for (int k = 0; k < i; k++) row[i] -= factor[i][k] * row[k];
        row[i] /= factor[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) row[i] -= factor[k][i] * row[k];
        row[i] /= factor[i][i];
    }
}

double scree_fluctuations(int dimension, const double *const *from, const double *const *to, size_t count,
                          double *const *fluctuation, double *gradient)
{
    double centre[3] = {0}, shift[3] = {0}, moment[3][3] = {{0}}, mixed[3][3] = {{0}}, square = 0;
    for (int i = 0; i < dimension * dimension; i++) gradient[i] = 0;
    if (count == 0) return 0;
    for (int k = 0; k < dimension; k++) {
        centre[k] = mean_difference(NULL, from[k], count);
        shift[k] = mean_difference(from[k], to[k], count);
    }
    for (size_t n = 0; n < count; n++)
        for (int j = 0; j < dimension; j++) {
            double away = from[j][n] - centre[j];
            for (int i = 0; i < dimension; i++) {
                moment[i][j] += (from[i][n] - centre[i]) * away;
                mixed[i][j] += (to[i][n] - from[i][n] - shift[i]) * away;
            }
        }
    if (factorise(dimension, moment))
        for (int i = 0; i < dimension; i++) solve_row(dimension, moment, mixed[i], gradient + dimension * i);
    for (size_t n = 0; n < count; n++)
        for (int i = 0; i < dimension; i++) {
            double rest = to[i][n] - from[i][n] - shift[i];
            for (int j = 0; j < dimension; j++) rest -= gradient[dimension * i + j] * (from[j][n] - centre[j]);
            fluctuation[i][n] = rest;
            square += rest * rest;
        }
    return sqrt(square / (double)count);
}

/// H H_0^-1, H_0 at the start of the loading stage.
static void deformation_of(const scree_periodic_cell *cell, double deformation[9])
{
    double inverse[9];
    scree_matrix_invert(cell->reference, inverse);
    scree_matrix_multiply(cell->lattice, inverse, deformation);
}

double scree_periodic_fluctuations(const scree_periodic_cell *from_cell, const scree_periodic_cell *to_cell,
                                   int dimension, const double *const *from, const double *const *to, size_t count,
                                   double *const *fluctuation)
{
    double before[9], back[9], after[9], deformation[9], inverse[9], mean[3] = {0}, square = 0;
    deformation_of(from_cell, before);
    deformation_of(to_cell, after);
    scree_matrix_invert(before, back);
    scree_matrix_multiply(after, back, deformation);
    scree_matrix_invert(to_cell->lattice, inverse);
    for (size_t n = 0; n < count; n++) {
        double begin[3] = {0}, carried[3], u[3] = {0}, whole[3], fraction[3];
        for (int k = 0; k < dimension; k++) begin[k] = from[k][n];
        scree_matrix_apply(deformation, begin, carried);
        for (int k = 0; k < dimension; k++) u[k] = to[k][n] - carried[k];
        scree_matrix_apply(inverse, u, fraction);
        for (int k = 0; k < 3; k++) fraction[k] = rint(fraction[k]);
        scree_matrix_apply(to_cell->lattice, fraction, whole);
        for (int k = 0; k < dimension; k++) {
            fluctuation[k][n] = u[k] - whole[k];
            mean[k] += fluctuation[k][n] / (double)count;
        }
    }
    for (size_t n = 0; n < count; n++)
        for (int k = 0; k < dimension; k++) {
            fluctuation[k][n] -= mean[k];
            square += fluctuation[k][n] * fluctuation[k][n];
        }
    return count > 0 ? sqrt(square / (double)count) : 0;
}
