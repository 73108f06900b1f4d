#include "theory/fit.h"

#include "base/memory.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ITERATIONS = 200 };
#define TOLERANCE 1e-10 ///< of parameters and of the gradient
#define STEP      1e-6  ///< of differences, over the parameter; their error goes with its square
#define FAR       1e10  ///< residual where a theory has no solution, so that the search turns back
#define ALIKE     1e-12 ///< least eigenvalue of the scaled normal matrix over the largest, below which parameters act alike

/// What a search sees.
typedef struct search {
    scree_fit *fit;
    size_t count;
    const scree_fit_point *points;
    scree_stress_2d *stress; ///< of the theory at the points
    double scale[SCREE_FIT_PARAMETERS];
} search;

// ---- parameters --------------------------------------------------------------------------------------------------

const char *scree_fit_theory_name(size_t number)
{
    size_t k = 0;
    while (k < number && scree_fit_theories[k].name) k++;
    return scree_fit_theories[k].name;
}

bool scree_fit_is_layer(const char *theory)
{
    return strcmp(theory, "flamant") == 0 || strncmp(theory, "layer", 5) == 0;
}

scree_status scree_fit_begin(const char *theory, scree_fit *fit, scree_error *error)
{
    *fit = (scree_fit){0};
    for (const scree_fit_theory *t = scree_fit_theories; t->name; t++) {
        if (strcmp(t->name, theory) != 0) continue;
        fit->theory = t;
        memcpy(fit->parameter, t->parameter, sizeof fit->parameter);
        while (fit->parameters < SCREE_FIT_PARAMETERS && fit->parameter[fit->parameters].name) fit->parameters++;
        return SCREE_OK;
    }
    return scree_error_refuse(error, "theory", NULL, "there is no such theory to fit");
}

const scree_fit_parameter *scree_fit_find(const scree_fit *fit, const char *name)
{
    for (size_t k = 0; k < fit->parameters; k++)
        if (strcmp(fit->parameter[k].name, name) == 0) return &fit->parameter[k];
    return NULL;
}

scree_status scree_fit_set(scree_fit *fit, const char *name, double value, bool free, scree_error *error)
{
    for (size_t k = 0; k < fit->parameters; k++) {
        if (strcmp(fit->parameter[k].name, name) != 0) continue;
        fit->parameter[k].value = value;
        fit->parameter[k].free = free;
        return SCREE_OK;
    }
    return scree_error_refuse(error, name, NULL, "this theory has no such parameter");
}

scree_status scree_fit_stress(const scree_fit *fit, size_t count, const scree_fit_point *points,
                              scree_stress_2d *stress, scree_error *error)
{
    return fit->theory->stress(fit->theory, fit->parameter, count, points, stress, error);
}

// ---- residuals ---------------------------------------------------------------------------------------------------

static size_t count_values(size_t count, const scree_fit_point *points)
{
    size_t values = 0;
    for (size_t k = 0; k < count; k++)
        values += (size_t)(points[k].error.xx > 0) + (points[k].error.yy > 0) + (points[k].error.xy > 0);
    return values;
}

static void take(const search *s, const gsl_vector *scaled)
{
    size_t k = 0;
    for (size_t i = 0; i < s->fit->parameters; i++)
        if (s->fit->parameter[i].free) {
            s->fit->parameter[i].value = gsl_vector_get(scaled, k) * s->scale[i];
            k++;
        }
}

static scree_status find_residuals(const search *s, gsl_vector *residual, scree_error *error)
{
    scree_status status = scree_fit_stress(s->fit, s->count, s->points, s->stress, error);
    size_t row = 0;
    for (size_t k = 0; k < s->count && !status; k++) {
        const scree_fit_point *p = &s->points[k];
        const double measured[] = {p->stress.xx, p->stress.yy, p->stress.xy};
        const double theory[] = {s->stress[k].xx, s->stress[k].yy, s->stress[k].xy};
        const double deviation[] = {p->error.xx, p->error.yy, p->error.xy};
        for (int i = 0; i < 3; i++)
            if (deviation[i] > 0) gsl_vector_set(residual, row++, (theory[i] - measured[i]) / deviation[i]);
    }
    return status;
}

static int residuals(const gsl_vector *scaled, void *data, gsl_vector *residual)
{
    const search *s = data;
    take(s, scaled);
    if (find_residuals(s, residual, NULL)) gsl_vector_set_all(residual, FAR);
    return GSL_SUCCESS;
}

// ---- the search --------------------------------------------------------------------------------------------------

/// Covariances from the derivatives. Refuses parameters that act alike.
static scree_status find_errors(const search *s, const gsl_matrix *derivatives, scree_error *error)
{
    enum { N = SCREE_FIT_PARAMETERS };
    double normal[N * N], inverse[N * N], length[N];
    const size_t n = s->fit->free;
    gsl_matrix_view square = gsl_matrix_view_array(normal, n, n), result = gsl_matrix_view_array(inverse, n, n);
    (void)gsl_blas_dgemm(CblasTrans, CblasNoTrans, 1, derivatives, derivatives, 0, &square.matrix);
    for (size_t i = 0; i < n; i++) length[i] = sqrt(normal[i * n + i]);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) normal[i * n + j] /= length[i] * length[j];
    // In units of their own errors the pivots of alike parameters vanish.
    memcpy(inverse, normal, sizeof inverse);
    bool apart = gsl_linalg_cholesky_decomp1(&result.matrix) == GSL_SUCCESS;
    for (size_t i = 0; i < n && apart; i++) apart = inverse[i * n + i] * inverse[i * n + i] > ALIKE;
    if (!apart)
        return scree_error_refuse(
            error, s->fit->theory->name, NULL,
            "these points cannot tell the free parameters apart: hold one of them, or add components or depths");
    (void)gsl_linalg_cholesky_invert(&result.matrix);
    for (size_t i = 0, a = 0; i < s->fit->parameters; i++) {
        if (!s->fit->parameter[i].free) continue;
        for (size_t j = 0, b = 0; j < s->fit->parameters; j++) {
            if (!s->fit->parameter[j].free) continue;
            s->fit->covariance[i][j] = inverse[a * n + b] / (length[a] * length[b]) * s->scale[i] * s->scale[j];
            b++;
        }
        s->fit->parameter[i].error = sqrt(s->fit->covariance[i][i]);
        a++;
    }
    return SCREE_OK;
}

static scree_status run_search(search *s, gsl_multifit_nlinear_workspace *work, const gsl_vector *first,
                               scree_error *error)
{
    gsl_multifit_nlinear_fdf function = {.f = residuals, .n = s->fit->values, .p = s->fit->free, .params = s};
    int why = 0;
    if (gsl_multifit_nlinear_init(first, &function, work) != GSL_SUCCESS)
        return scree_error_set(error, SCREE_ERROR_GUARD, "the fit did not begin");
    const int result = gsl_multifit_nlinear_driver(ITERATIONS, TOLERANCE, TOLERANCE, 0, NULL, NULL, &why, work);
    // No progress means that the last bits are reached.
    if (result != GSL_SUCCESS && result != GSL_ENOPROG)
        return scree_error_set(error, SCREE_ERROR_GUARD, "the fit did not end: %s", gsl_strerror(result));
    take(s, gsl_multifit_nlinear_position(work));
    s->fit->iterations = gsl_multifit_nlinear_niter(work);
    return find_errors(s, gsl_multifit_nlinear_jac(work), error);
}

static scree_status search_free(search *s, scree_error *error)
{
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    how.h_df = STEP;
    how.fdtype = GSL_MULTIFIT_NLINEAR_CTRDIFF;
    gsl_vector *first = gsl_vector_alloc(s->fit->free);
    gsl_multifit_nlinear_workspace *work =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, s->fit->values, s->fit->free);
    scree_status status = first && work ? SCREE_OK : scree_error_set_memory(error, s->fit->values * sizeof(double));
    for (size_t i = 0, k = 0; i < s->fit->parameters && !status; i++) {
        const double value = s->fit->parameter[i].value;
        s->scale[i] = value != 0 ? fabs(value) : 1;
        if (s->fit->parameter[i].free) gsl_vector_set(first, k++, value / s->scale[i]);
    }
    if (!status) status = run_search(s, work, first, error);
    if (work) gsl_multifit_nlinear_free(work);
    if (first) gsl_vector_free(first);
    return status;
}

/// chi^2 and what follows from it, with the parameters as they are.
static scree_status judge(const search *s, scree_error *error)
{
    scree_fit *fit = s->fit;
    gsl_vector *residual = gsl_vector_alloc(fit->values);
    if (!residual) return scree_error_set_memory(error, fit->values * sizeof(double));
    scree_status status = find_residuals(s, residual, error);
    const double norm = status ? NAN : gsl_blas_dnrm2(residual), freedom = (double)(fit->values - fit->free);
    gsl_vector_free(residual);
    fit->chi_square = norm * norm;
    fit->reduced = freedom > 0 ? fit->chi_square / freedom : NAN;
    fit->probability = freedom > 0 ? gsl_cdf_chisq_Q(fit->chi_square, freedom) : NAN;
    fit->information = fit->chi_square + 2 * (double)fit->free;
    return status;
}

scree_status scree_fit_solve(scree_fit *fit, size_t count, const scree_fit_point *points, scree_error *error)
{
    search s = {.fit = fit, .count = count, .points = points};
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    fit->values = count_values(count, points);
    fit->free = 0;
    memset(fit->covariance, 0, sizeof fit->covariance);
    for (size_t k = 0; k < fit->parameters; k++) {
        fit->free += fit->parameter[k].free;
        fit->parameter[k].error = 0;
    }
    scree_status status = fit->values > 0 && fit->values >= fit->free
                              ? scree_allocate(&s.stress, count, sizeof *s.stress, error)
                              : scree_error_refuse(error, "points", NULL,
                                                   "there are fewer measured values with an error than parameters");
    // A beginning without a solution has its own message.
    if (!status) status = scree_fit_stress(fit, count, points, s.stress, error);
    if (!status && fit->free > 0) status = search_free(&s, error);
    if (!status) status = judge(&s, error);
    scree_release(&s.stress);
    gsl_set_error_handler(handler);
    return status;
}
