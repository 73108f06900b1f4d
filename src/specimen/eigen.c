/// ARPACK keeps what it is doing in variables of its own between two calls, so one search goes on at a time.
#include "specimen/eigen.h"

#include "base/memory.h"
#include "base/random.h"

#include <arpack.h>
#include <lapacke.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

/// Vectors of a Krylov space: more make it converge in fewer products, and cost memory and their orthogonalisation.
enum { SPACE = 36, MOST_RESTARTS = 1000 };

static pthread_mutex_t arpack = PTHREAD_MUTEX_INITIALIZER;

// ---- small ones --------------------------------------------------------------------------------------------------

scree_status scree_eigen_dense(size_t size, double *matrix, double *values, scree_error *error)
{
    // By rows or by columns is the same for a symmetric matrix, and its columns of vectors are rows for us.
    const lapack_int n = (lapack_int)size;
    scree_status status = scree_memory_check(size * (size + 64) * sizeof *matrix, error);
    if (status || size == 0) return status;
    if (LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'U', n, matrix, n, values) == 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_GUARD, "the eigenvalues of a matrix of %zu rows were not found", size);
}

static scree_status symmetric_dense(size_t size, double *matrix, scree_eigenvalue *out, double *vector,
                                    scree_error *error)
{
    double values[SCREE_EIGEN_DENSE];
    // What rounding leaves of a symmetric map is taken from one triangle.
    scree_status status = scree_eigen_dense(size, matrix, values, error);
    if (status) return status;
    out->value = values[size - 1];
    if (vector) memcpy(vector, matrix + size * (size - 1), size * sizeof *vector);
    return SCREE_OK;
}

static scree_status general_dense(size_t size, double *matrix, scree_eigenvalue *out, double *vector,
                                  scree_error *error)
{
    double real[SCREE_EIGEN_DENSE], imaginary[SCREE_EIGEN_DENSE];
    double vectors[SCREE_EIGEN_DENSE * SCREE_EIGEN_DENSE], none[1];
    const lapack_int n = (lapack_int)size;
    if (LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'V', n, matrix, n, real, imaginary, none, 1, vectors, n) != 0)
        return scree_error_set(error, SCREE_ERROR_GUARD, "the eigenvalues of a matrix of %zu rows were not found",
                               size);
    size_t most = 0;
    for (size_t k = 1; k < size; k++)
        if (real[k] > real[most]) most = k;
    out->value = real[most];
    out->imaginary = fabs(imaginary[most]);
    if (vector) memcpy(vector, vectors + size * most, size * sizeof *vector);
    return SCREE_OK;
}

/// Column by column.
static scree_status solve_dense(const scree_linear_map *map, scree_eigenvalue *out, double *vector, scree_error *error)
{
    double matrix[SCREE_EIGEN_DENSE * SCREE_EIGEN_DENSE], unit[SCREE_EIGEN_DENSE];
    for (size_t column = 0; column < map->size; column++) {
        memset(unit, 0, sizeof unit);
        unit[column] = 1;
        map->apply(map->context, unit, matrix + column * map->size);
    }
    out->products = map->size;
    return map->symmetric ? symmetric_dense(map->size, matrix, out, vector, error)
                          : general_dense(map->size, matrix, out, vector, error);
}

// ---- Krylov spaces -----------------------------------------------------------------------------------------------

typedef struct krylov {
    const scree_linear_map *map;
    int size, space;
    double accuracy;
    double *residual, *basis, *work, *small, *pair;
    a_int parameters[11], pointers[14], information;
    size_t products;
} krylov;

static void destroy(krylov *k)
{
    scree_release(&k->residual);
    scree_release(&k->basis);
    scree_release(&k->work);
    scree_release(&k->small);
    scree_release(&k->pair);
}

static scree_status create(krylov *k, scree_error *error)
{
    const size_t n = (size_t)k->size, space = (size_t)k->space;
    scree_status status = scree_allocate(&k->residual, n, sizeof(double), error);
    if (!status) status = scree_allocate(&k->basis, n * space, sizeof(double), error);
    if (!status) status = scree_allocate(&k->work, 3 * n, sizeof(double), error);
    if (!status) status = scree_allocate(&k->small, 3 * space * (space + 8), sizeof(double), error);
    return status ? status : scree_allocate(&k->pair, 3 * n, sizeof(double), error);
}

/// A random vector, made one of the image of the map. False: the map is zero.
static bool begin(krylov *k)
{
    bool any = false;
    for (int i = 0; i < k->size; i++) k->work[i] = scree_random_uniform(1, SCREE_RANDOM_EIGENVECTOR, (uint64_t)i) - 0.5;
    k->map->apply(k->map->context, k->work, k->residual);
    k->products++;
    for (int i = 0; i < k->size && !any; i++) any = k->residual[i] != 0;
    return any;
}

static scree_status iterate(krylov *k, scree_error *error)
{
    const a_int n = k->size, space = k->space, length = 3 * space * (space + 8);
    const char *which = k->map->symmetric ? "LA" : "LR";
    a_int stage = 0;
    k->parameters[0] = 1;
    k->parameters[2] = MOST_RESTARTS;
    k->parameters[3] = 1;
    k->parameters[6] = 1;
    k->information = 1; // begin with the residual as it is
    for (;;) {
        if (k->map->symmetric)
            dsaupd_c(&stage, "I", n, which, 1, k->accuracy, k->residual, space, k->basis, n, k->parameters, k->pointers,
                     k->work, k->small, length, &k->information);
        else
            dnaupd_c(&stage, "I", n, which, 1, k->accuracy, k->residual, space, k->basis, n, k->parameters, k->pointers,
                     k->work, k->small, length, &k->information);
        if (stage != 1 && stage != -1) break;
        k->map->apply(k->map->context, k->work + k->pointers[0] - 1, k->work + k->pointers[1] - 1);
        k->products++;
    }
    if (k->information == 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "the largest eigenvalue of a map of %d numbers was not found in %d restarts (ARPACK: %d)",
                           k->size, MOST_RESTARTS, (int)k->information);
}

static scree_status extract(krylov *k, scree_eigenvalue *out, double *vector, scree_error *error)
{
    const a_int n = k->size, space = k->space, length = 3 * space * (space + 8);
    a_int select[SPACE] = {0}, information = 0;
    double real[3] = {0}, imaginary[3] = {0}, scratch[3 * SPACE];
    if (k->map->symmetric)
        dseupd_c(1, "A", select, real, k->pair, n, 0, "I", n, "LA", 1, k->accuracy, k->residual, space, k->basis, n,
                 k->parameters, k->pointers, k->work, k->small, length, &information);
    else
        dneupd_c(1, "A", select, real, imaginary, k->pair, n, 0, 0, scratch, "I", n, "LR", 1, k->accuracy, k->residual,
                 space, k->basis, n, k->parameters, k->pointers, k->work, k->small, length, &information);
    if (information != 0)
        return scree_error_set(error, SCREE_ERROR_GUARD, "the eigenvector was not found (ARPACK: %d)",
                               (int)information);
    out->value = real[0];
    out->imaginary = fabs(imaginary[0]);
    if (vector) memcpy(vector, k->pair, (size_t)n * sizeof *vector);
    return SCREE_OK;
}

static scree_status search(krylov *k, scree_eigenvalue *out, double *vector, scree_error *error)
{
    scree_status status = create(k, error);
    if (status) return status;
    if (!begin(k)) {
        if (vector) memset(vector, 0, k->map->size * sizeof *vector);
        return SCREE_OK;
    }
    pthread_mutex_lock(&arpack);
    status = iterate(k, error);
    if (!status) status = extract(k, out, vector, error);
    pthread_mutex_unlock(&arpack);
    out->products = k->products;
    return status;
}

scree_status scree_eigen_largest(const scree_linear_map *map, double accuracy, scree_eigenvalue *out, double *vector,
                                 scree_error *error)
{
    *out = (scree_eigenvalue){0};
    if (map->size == 0) return SCREE_OK;
    if (map->size <= SCREE_EIGEN_DENSE) return solve_dense(map, out, vector, error);
    if (map->size > INT32_MAX / (3 * SPACE))
        return scree_error_set(error, SCREE_ERROR_INPUT, "%zu numbers are too many for an eigenvalue", map->size);
    krylov k = {.map = map, .size = (int)map->size, .space = SPACE, .accuracy = accuracy};
    scree_status status = search(&k, out, vector, error);
    destroy(&k);
    return status;
}
