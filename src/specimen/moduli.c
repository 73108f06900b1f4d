/// The elasticity tensor by one static solution for each component of strain.
///
/// A periodic specimen under the mean strain E: bodies move by E x and by a periodic part, so each contact is given
/// offset = E branch (specimen/static.h), and the stress is -1/V sum f branch (tension positive). The sum is made
/// symmetric; torques balance in a static solution, so it is. A box is strained in the same way, where bodies at its
/// faces move by E x and have no other part (box.h).
/// Affine (Voigt): the same forces before bodies and particles have moved. The nearest isotropic tensor is that of the
/// same bulk and mean shear: in d dimensions d K = (1/d) sum C_iijj, and of the d (d + 1) / 2 - 1 other eigenvalues 2 G
/// is the mean.
#include "specimen/moduli.h"

#include "base/memory.h"
#include "specimen/static.h"
#include "theory/lattice.h"

#include <math.h>
#include <string.h>

/// First and second index of component m.
static void indices(int dimension, int m, int *i, int *j)
{
    *i = m < dimension ? m : dimension == 2 ? 0 : (m - dimension + 1) % 3;
    *j = m < dimension ? m : dimension == 2 ? 1 : (m - dimension + 2) % 3;
}

/// offset = E branch of a unit strain.
static void strain_contacts(const scree_specimen *s, int component, double *offset)
{
    const size_t width = (size_t)s->dimension;
    int i, j;
    indices(s->dimension, component, &i, &j);
    memset(offset, 0, scree_specimen_contact_forces(s) * sizeof *offset);
    for (size_t c = 0; c < s->contact_count; c++) {
        const double *branch = s->contact[c].branch;
        if (i == j) {
            offset[c * width + (size_t)i] = branch[i];
            continue;
        }
        offset[c * width + (size_t)i] = M_SQRT1_2 * branch[j];
        offset[c * width + (size_t)j] = M_SQRT1_2 * branch[i];
    }
}

/// Column of a tensor: sign sum f branch over the volume.
static void add_stress(const scree_specimen *s, double sign, const double *f, int column, double *tensor)
{
    const size_t width = (size_t)s->dimension;
    for (int m = 0; m < s->strain_components; m++) {
        double sum = 0;
        int i, j;
        indices(s->dimension, m, &i, &j);
        for (size_t c = 0; c < s->contact_count; c++) {
            const double *branch = s->contact[c].branch, *force = f + c * width;
            sum += i == j ? force[i] * branch[i] : M_SQRT1_2 * (force[i] * branch[j] + force[j] * branch[i]);
        }
        tensor[m * s->strain_components + column] = sign * sum / s->extent;
    }
}

static scree_isotropic nearest_isotropic(const scree_specimen *s, const double *tensor)
{
    const int d = s->dimension, n = s->strain_components;
    double all_round = 0, trace = 0;
    for (int i = 0; i < n; i++) trace += tensor[i * (n + 1)];
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) all_round += tensor[i * n + j] / d;
    scree_isotropic m = {.bulk = all_round / d, .shear = (trace - all_round) / (2 * (n - 1))};
    scree_moduli_of_bulk_and_shear(d, m.bulk, m.shear, &m.young, &m.poisson);
    return m;
}

/// How far the tensor is from `isotropic`, and from its transpose.
static void measure_departure(const scree_specimen *s, scree_specimen_moduli *m)
{
    const int d = s->dimension, n = s->strain_components;
    double whole = 0, away = 0, skew = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const bool normal = i < d && j < d;
            const double isotropic =
                (i == j) * 2 * m->isotropic.shear + normal * (m->isotropic.bulk - 2 * m->isotropic.shear / d);
            const double value = m->stiffness[i * n + j], half = 0.5 * (value - m->stiffness[j * n + i]);
            whole += value * value;
            away += (value - isotropic) * (value - isotropic);
            skew += half * half;
        }
    m->anisotropy = sqrt(away / whole);
    m->asymmetry = sqrt(skew / whole);
}

/// Of contacts that resist: walls do not touch a piece that is cut out of a box.
static void measure_fabric(const scree_specimen *s, double *fabric)
{
    double count = 0;
    for (size_t c = 0; c < s->contact_count; c++) {
        if (!(s->contact[c].stiffness.normal > 0)) continue;
        count++;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) fabric[3 * i + j] += s->contact[c].normal[i] * s->contact[c].normal[j];
    }
    for (int k = 0; k < 9; k++) fabric[k] /= count;
}

static scree_status find_column(const scree_specimen *s, int component, double *offset, double *motion, double *force,
                                scree_specimen_moduli *out, scree_error *error)
{
    const size_t width = (size_t)s->dimension;
    size_t iterations;
    strain_contacts(s, component, offset);
    const scree_static_load load = {.offset = offset};
    scree_status status = scree_static_solve(s, &load, motion, force, &iterations, error);
    if (status) return status;
    out->iterations += iterations;
    add_stress(s, -1, force, component, out->stiffness);
    for (size_t c = 0; c < s->contact_count; c++)
        scree_specimen_along(s->dimension, &s->contact[c], s->contact[c].stiffness.normal,
                             s->contact[c].stiffness.tangential, offset + c * width, offset + c * width);
    add_stress(s, 1, offset, component, out->affine);
    return SCREE_OK;
}

scree_status scree_specimen_find_moduli(const scree_specimen *s, scree_specimen_moduli *out, scree_error *error)
{
    double *offset = NULL, *motion = NULL, *force = NULL;
    *out = (scree_specimen_moduli){0};
    if (!(s->extent > 0))
        return scree_error_set(error, SCREE_ERROR_INPUT, "the volume of the specimen is not known: no moduli");
    if (s->contact_count == 0) return scree_error_set(error, SCREE_ERROR_INPUT, "no particles touch: no moduli");
    scree_status status = scree_allocate(&offset, scree_specimen_contact_forces(s), sizeof *offset, error);
    if (!status) status = scree_allocate(&force, scree_specimen_contact_forces(s), sizeof *force, error);
    if (!status) status = scree_allocate(&motion, scree_specimen_motions(s), sizeof *motion, error);
    for (int k = 0; k < s->strain_components && !status; k++)
        status = find_column(s, k, offset, motion, force, out, error);
    scree_release(&offset);
    scree_release(&motion);
    scree_release(&force);
    if (status) return status;
    out->isotropic = nearest_isotropic(s, out->stiffness);
    out->voigt = nearest_isotropic(s, out->affine);
    measure_departure(s, out);
    measure_fabric(s, out->fabric);
    return SCREE_OK;
}
