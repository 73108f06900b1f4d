/// Largest eigenvalue of a linear map that is known by its products alone, by Krylov spaces with implicit restarts
/// (ARPACK: Lehoucq, Sorensen, Yang 1998); below SCREE_EIGEN_DENSE numbers by LAPACK.
///
/// Always the same bits: the first vector is a pure function of its size (counter-based random numbers), and nothing
/// here runs in several threads. ARPACK's own dot products go over the vector in its order; the order of contacts and
/// bodies in a specimen is that of their ids. Another BLAS may round in another way.
#ifndef SCREE_SPECIMEN_EIGEN_H
#define SCREE_SPECIMEN_EIGEN_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum { SCREE_EIGEN_DENSE = 48 };

/// y = A x.
typedef void scree_operator(void *context, const double *x, double *y);

typedef struct scree_linear_map {
    scree_operator *apply;
    void *context;
    size_t size;
    bool symmetric;
} scree_linear_map;

/// The eigenvalue of the largest real part; of a symmetric map the largest one.
typedef struct scree_eigenvalue {
    double value;     ///< its real part
    double imaginary; ///< 0 of a symmetric map
    size_t products;
} scree_eigenvalue;

/// vector: size numbers, of length 1; NULL: not wanted. Relative error of the value below `accuracy`. A map that is
/// zero has the value 0. Errors: memory; SCREE_ERROR_GUARD when it does not converge.
scree_status scree_eigen_largest(const scree_linear_map *map, double accuracy, scree_eigenvalue *out, double *vector,
                                 scree_error *error) __attribute__((warn_unused_result));

/// All eigenvalues of a symmetric matrix in ascending order, size x size; the matrix becomes its vectors, one a row.
/// Small ones only. Errors: memory; SCREE_ERROR_GUARD.
scree_status scree_eigen_dense(size_t size, double *matrix, double *values, scree_error *error)
    __attribute__((warn_unused_result));

#endif
