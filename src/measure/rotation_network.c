/// The force network around a forced body: T, W, and what rotations have to do with it. See rotation.h. Cost:
/// O(contacts + bodies).
#include "base/memory.h"
#include "measure/rotation.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

static double dot(const scree_vector a, const scree_vector b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double force_of(const scree_contact *contact)
{
    return hypot(contact->normal_force, contact->tangential_force);
}

static double mean_force(const scree_contact_table *table)
{
    double sum = 0;
    size_t count = 0;
    for (size_t c = 0; c < table->count; c++) {
        if (table->contact[c].wall) continue;
        sum += force_of(&table->contact[c]);
        count++;
    }
    return count > 0 ? sum / (double)count : NAN;
}

/// Unit vector along `a`; its length is returned.
static double normalise(scree_vector a)
{
    double length = scree_length(a);
    for (int i = 0; i < 3; i++) a[i] /= length;
    return length;
}

/// One segment of the network seen from the forced body.
typedef struct segment {
    scree_vector outward; ///< s^
    scree_vector branch;  ///< b^, away from the forced body
    double distance;      ///< m, |s|
    double force;         ///< f / <f>
} segment;

/// False: a wall, or beyond the cut-off [m].
static bool see_segment(const scree_state *state, const scree_contact *contact, size_t forced, double cutoff,
                        double mean, segment *out)
{
    if (contact->wall) return false;
    scree_vector centre, end;
    scree_body_place(state, forced, centre);
    scree_body_place(state, contact->first, end);
    for (int i = 0; i < 3; i++) {
        out->outward[i] = end[i] - 0.5 * contact->branch[i] - centre[i];
        out->branch[i] = contact->branch[i];
    }
    out->distance = normalise(out->outward);
    (void)normalise(out->branch);
    out->force = force_of(contact) / mean;
    if (dot(out->outward, out->branch) < 0)
        for (int i = 0; i < 3; i++) out->branch[i] = -out->branch[i];
    return out->distance <= cutoff;
}

/// Eigenvalues, falling, and unit eigenvectors of the symmetric part, in the first `dimension` directions.
static void find_axes(int dimension, scree_rotation_network *network)
{
    const size_t size = (size_t)dimension;
    double data[9], vectors[9], values[3], room[12];
    for (size_t i = 0; i < size; i++)
        for (size_t j = 0; j < size; j++)
            data[size * i + j] = 0.5 * (network->tensor[3 * i + j] + network->tensor[3 * j + i]);
    gsl_matrix_view matrix = gsl_matrix_view_array(data, size, size);
    gsl_matrix_view columns = gsl_matrix_view_array(vectors, size, size);
    gsl_vector_view value = gsl_vector_view_array(values, size);
    // The workspace is GSL's own struct on a stack of ours: three rows of `size`.
    gsl_eigen_symmv_workspace workspace = {size, room, room + 3, room + 6, room + 9};
    (void)gsl_eigen_symmv(&matrix.matrix, &value.vector, &columns.matrix, &workspace);
    (void)gsl_eigen_symmv_sort(&value.vector, &columns.matrix, GSL_EIGEN_SORT_VAL_DESC);
    for (size_t k = 0; k < size; k++) {
        network->value[k] = values[k];
        for (size_t i = 0; i < size; i++) network->axis[k][i] = vectors[size * i + k];
        // Of the two directions the one with a positive last component, so that the answer is unique.
        if (network->axis[k][size - 1] < 0)
            for (size_t i = 0; i < size; i++) network->axis[k][i] = -network->axis[k][i];
    }
}

static size_t sector_of(int dimension, const scree_rotation_network *network, const scree_vector outward)
{
    double part;
    if (dimension == 2) {
        double angle = atan2(outward[1], outward[0]);
        part = (angle < 0 ? angle + 2 * M_PI : angle) / (2 * M_PI);
    } else {
        part = 0.5 * (1 - dot(outward, network->axis[0])); // area of the sphere's cap
    }
    size_t sector = (size_t)(part * SCREE_ROTATION_SECTORS);
    return sector < SCREE_ROTATION_SECTORS ? sector : SCREE_ROTATION_SECTORS - 1;
}

void scree_rotation_network_measure(const scree_model *model, const scree_state *state,
                                    const scree_contact_table *table, size_t forced, double cutoff,
                                    scree_rotation_network *network)
{
    *network = (scree_rotation_network){0};
    double mean = mean_force(table), limit = cutoff * 2 * model->mean_radius;
    segment s;
    for (size_t c = 0; c < table->count; c++) {
        if (!see_segment(state, &table->contact[c], forced, limit, mean, &s)) continue;
        network->contacts++;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) network->tensor[3 * i + j] += s.outward[i] * s.branch[j] * s.force / s.distance;
    }
    find_axes(state->dimension, network);
    for (size_t c = 0; c < table->count; c++)
        if (see_segment(state, &table->contact[c], forced, limit, mean, &s))
            network->rose[sector_of(state->dimension, network, s.outward)] +=
                dot(s.outward, s.branch) * s.force / s.distance;
    for (size_t k = 0; k < SCREE_ROTATION_SECTORS; k++) network->followed[k] = NAN;
}

// ---- alignment ---------------------------------------------------------------------------------------------------

static scree_rank_correlation correlate(const double *x, const double *y, size_t count, double *work)
{
    scree_rank_correlation r = {NAN, NAN, NAN, count};
    if (count < 4) return r;
    r.value = gsl_stats_spearman(x, 1, y, 1, count, work);
    double z = atanh(r.value), half = sqrt((1 + 0.5 * r.value * r.value) / ((double)count - 3));
    half *= gsl_cdf_ugaussian_Pinv(0.975);
    r.low = tanh(z - half);
    r.high = tanh(z + half);
    return r;
}

/// Sums of f and of f times the alignment of the contact, over the contacts of each body.
static void add_alignment(const scree_state *state, const scree_contact_table *table, size_t forced, double *weight,
                          double *aligned)
{
    scree_vector centre;
    scree_body_place(state, forced, centre);
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        if (contact->wall) continue;
        for (int side = 0; side < 2; side++) {
            size_t row = side ? contact->second : contact->first;
            scree_vector outward, branch;
            scree_body_place(state, row, outward);
            for (int i = 0; i < 3; i++) {
                outward[i] -= centre[i];
                branch[i] = contact->branch[i];
            }
            if (row == forced) continue;
            (void)normalise(outward);
            (void)normalise(branch);
            double cosine = dot(outward, branch), square = cosine * cosine, force = force_of(contact);
            weight[row] += force;
            aligned[row] += force * (state->dimension == 2 ? 2 * square - 1 : 1.5 * square - 0.5);
        }
    }
}

typedef struct columns {
    double *weight, *aligned;   ///< per row
    double *alignment, *excess; ///< per body that counts
    double *work;               ///< of the ranks
    double sum[SCREE_ROTATION_SECTORS];
    size_t in_sector[SCREE_ROTATION_SECTORS];
} columns;

/// The bodies that count: with contacts, within the cut-off and the reach of the decay.
static size_t gather(const scree_model *model, const scree_state *state, size_t forced, double cutoff,
                     const scree_rotation_decay *decay, const scree_rotation_network *network, columns *c)
{
    scree_vector centre, outward, velocity, spin, driving;
    scree_body_place(state, forced, centre);
    scree_body_motion(state, forced, velocity, driving);
    double driven = scree_length(driving), limit = fmin(cutoff, decay->reach);
    size_t count = 0;
    for (size_t id = 0; id < state->count; id++) {
        size_t row = state->row_of_id[id];
        if (row == forced || !(c->weight[row] > 0)) continue;
        scree_body_place(state, row, outward);
        for (int i = 0; i < 3; i++) outward[i] -= centre[i];
        double distance = normalise(outward) / (2 * model->mean_radius);
        if (!(distance < limit)) continue;
        scree_body_motion(state, row, velocity, spin);
        double typical = decay->bin[(size_t)(distance / decay->bin_width)].mean, own = scree_length(spin) / driven;
        if (!(own > 0)) continue;
        c->alignment[count] = c->aligned[row] / c->weight[row];
        c->excess[count] = log(own / typical);
        size_t sector = sector_of(state->dimension, network, outward);
        c->sum[sector] += c->excess[count];
        c->in_sector[sector]++;
        count++;
    }
    return count;
}

scree_status scree_rotation_alignment_measure(const scree_model *model, const scree_state *state,
                                              const scree_contact_table *table, size_t forced, double cutoff,
                                              const scree_rotation_decay *decay, scree_rotation_network *network,
                                              scree_rotation_alignment *alignment, scree_error *error)
{
    columns c = {0};
    double **const arrays[] = {&c.weight, &c.aligned, &c.alignment, &c.excess};
    scree_status status = scree_allocate(&c.work, 2 * state->count + 2 * SCREE_ROTATION_SECTORS, sizeof *c.work, error);
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays && !status; k++)
        status = scree_allocate(arrays[k], state->count, sizeof **arrays[k], error);
    if (!status) {
        add_alignment(state, table, forced, c.weight, c.aligned);
        size_t count = gather(model, state, forced, cutoff, decay, network, &c), sectors = 0;
        alignment->along = correlate(c.alignment, c.excess, count, c.work);
        double rose[SCREE_ROTATION_SECTORS], followed[SCREE_ROTATION_SECTORS];
        for (size_t k = 0; k < SCREE_ROTATION_SECTORS; k++) {
            if (c.in_sector[k] == 0) continue;
            network->followed[k] = c.sum[k] / (double)c.in_sector[k];
            rose[sectors] = network->rose[k];
            followed[sectors++] = network->followed[k];
        }
        alignment->sectors = correlate(rose, followed, sectors, c.work);
    }
    scree_release(&c.work);
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    return status;
}
