/// Smooth fields: each grain and each branch of a contact spread by a kernel (I. Goldhirsch, Granular Matter 12, 239,
/// 2010), with what walls do as a field of its own (T. Weinhart, A. R. Thornton, S. Luding, O. Bokhove, Granular Matter
/// 14, 289, 2012).
///
/// Kernel, of compact support and two continuous derivatives:
///     phi(x) = C (1 - |x|^2 / w^2)^3 within |x| < w, else 0;   C = 4 / (pi w^2) in 2D, 315 / (64 pi w^3) in 3D
/// whose integral is 1. With f the force on the first of a contact, l the branch from the second to the first:
///     density       sum_i m_i phi(r - x_i)                                                          kg/m3
///     fraction      sum_i V_i phi(r - x_i)                                                          1
///     momentum      sum_i m_i v_i phi(r - x_i)                                                      kg/(m2 s)
///     stress        - sum_c f (x) l  integral_0^1 phi(r - x_second - s l) ds      tension positive  Pa
///                   of a contact with what is no grain the branch begins at the point of contact
///     boundary      sum_c f phi(r - point) over these contacts: the force of the outside            N/m3
///     resultant     sum_i F_i phi(r - x_i), F_i the sum of contact forces and weight of grain i     N/m3
/// Exactly, in every place, at rest or not:
///     div stress + boundary + density g = resultant
/// since l . grad of the line integral is phi(r - x_second) - phi(r - x_first). Divergences are found from the gradient
/// of the kernel along the branch, not from that identity, so the balance is a check. The stress of the motion about
/// the mean velocity V = momentum / density is no part of it (scree_average_kernel_kinetic):
///     motion        sum_i m_i v_i (x) v_i phi(r - x_i)                                              Pa
///     kinetic       - sum_i m_i (v_i - V) (x) (v_i - V) phi = momentum (x) momentum / density - motion
///
/// Along a branch phi is a polynomial of degree 6 between the places where it enters and leaves the support: 4 points
/// of Gauss integrate it, and 4 its derivative, exactly. Threads take slabs of points, each all contacts that reach it
/// in their order: the same bits for any number of threads. Cost: contacts x points within w of a branch.
#ifndef SCREE_AVERAGE_KERNEL_H
#define SCREE_AVERAGE_KERNEL_H

#include "average/sample.h"

typedef struct scree_average_points {
    size_t number[3];        ///< 1 along z in 2D
    double first[3], gap[3]; ///< m, place of the first point, and from one to the next
} scree_average_points;

/// Fields at points, x fastest; vectors and tensors have `dimension` and its square as components.
typedef struct scree_average_kernel {
    int dimension;
    double width; ///< m, w
    scree_average_points points;
    size_t count;
    double *density, *fraction, *momentum, *motion, *stress, *boundary, *resultant, *divergence;
} scree_average_kernel;

/// Measures them of a finished sample (with images within w of the points, where it repeats itself). Without `check`
/// resultants and divergences are left out (NULL). Errors: memory.
scree_status scree_average_kernel_find(const scree_average_sample *sample, double width,
                                       const scree_average_points *points, bool check, int threads,
                                       scree_average_kernel *kernel, scree_error *error) SCREE_MUST_USE;
void scree_average_kernel_destroy(scree_average_kernel *kernel);

/// Stress of the motion at a point [Pa], dimension x dimension; zero where there is no grain.
void scree_average_kernel_kinetic(const scree_average_kernel *kernel, size_t point, double stress[9]);

/// The kernel itself [1/m2, 1/m3].
double scree_average_kernel_value(int dimension, double width, const double away[3]);

typedef struct scree_average_balance {
    double residual; ///< largest |div stress + boundary + density g - resultant|
    double rest;     ///< root of the mean square of |div stress + boundary + density g|
    double scale;    ///< largest density g; without gravity the largest of all terms. N/m3
} scree_average_balance;

/// |div stress + boundary + density g - resultant| at a point [N/m3] of fields that were found with `check`.
double scree_average_kernel_residual(const scree_average_sample *sample, const scree_average_kernel *kernel,
                                     size_t point);

/// How well the balance holds, and how far the sample is from rest, in N/m3.
scree_average_balance scree_average_kernel_balance(const scree_average_sample *sample,
                                                   const scree_average_kernel *kernel);

#endif
