/// The force network around a forced body: T and W. See rotation.h. Cost: O(contacts).
#include "measure/rotation_parts.h"

#include <gsl/gsl_eigen.h>
#include <math.h>

double scree_rotation_mean_force(const scree_contact_table *table)
{
    double sum = 0;
    size_t count = 0;
    for (size_t c = 0; c < table->count; c++) {
        if (table->contact[c].wall) continue;
        sum += scree_rotation_force(&table->contact[c]);
        count++;
    }
    return count > 0 ? sum / (double)count : NAN;
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
    scree_body_position(state, forced, centre);
    scree_body_position(state, contact->first, end);
    for (int i = 0; i < 3; i++) {
        out->outward[i] = end[i] - 0.5 * contact->branch[i] - centre[i];
        out->branch[i] = contact->branch[i];
    }
    out->distance = scree_rotation_normalise(out->outward);
    (void)scree_rotation_normalise(out->branch);
    out->force = scree_rotation_force(contact) / mean;
    if (scree_rotation_dot(out->outward, out->branch) < 0)
        for (int i = 0; i < 3; i++) out->branch[i] = -out->branch[i];
    return out->distance <= cutoff;
}

void scree_rotation_axes(int dimension, const double tensor[9], double value[3], scree_vector axis[3])
{
    const size_t size = (size_t)dimension;
    double data[9], vectors[9], values[3], room[12];
    for (size_t i = 0; i < size; i++)
        for (size_t j = 0; j < size; j++) data[size * i + j] = 0.5 * (tensor[3 * i + j] + tensor[3 * j + i]);
    gsl_matrix_view matrix = gsl_matrix_view_array(data, size, size);
    gsl_matrix_view columns = gsl_matrix_view_array(vectors, size, size);
    gsl_vector_view falling = gsl_vector_view_array(values, size);
    // The workspace is GSL's own struct on a stack of ours: three rows of `size`.
    gsl_eigen_symmv_workspace workspace = {size, room, room + 3, room + 6, room + 9};
    (void)gsl_eigen_symmv(&matrix.matrix, &falling.vector, &columns.matrix, &workspace);
    (void)gsl_eigen_symmv_sort(&falling.vector, &columns.matrix, GSL_EIGEN_SORT_VAL_DESC);
    for (size_t k = 0; k < size; k++) {
        value[k] = values[k];
        for (size_t i = 0; i < size; i++) axis[k][i] = vectors[size * i + k];
        // Of the two directions the one with a positive last component, so that the answer is unique.
        if (axis[k][size - 1] < 0)
            for (size_t i = 0; i < size; i++) axis[k][i] = -axis[k][i];
    }
}

size_t scree_rotation_sector(int dimension, const scree_rotation_network *network, const scree_vector outward)
{
    double part;
    if (dimension == 2) {
        double angle = atan2(outward[1], outward[0]);
        part = (angle < 0 ? angle + 2 * M_PI : angle) / (2 * M_PI);
    } else {
        part = 0.5 * (1 - scree_rotation_dot(outward, network->axis[0])); // area of the sphere's cap
    }
    size_t sector = (size_t)(part * SCREE_ROTATION_SECTORS);
    return sector < SCREE_ROTATION_SECTORS ? sector : SCREE_ROTATION_SECTORS - 1;
}

/// Direction of the peak of the rose, an axis.
static double find_peak(const double rose[SCREE_ROTATION_SECTORS])
{
    enum { HALF = SCREE_ROTATION_SECTORS / 2 };
    int peak = 0;
    double highest = -INFINITY;
    for (int k = 0; k < HALF; k++) {
        double sum = 0;
        for (int side = -1; side <= 1; side++) {
            int one = (k + side + SCREE_ROTATION_SECTORS) % SCREE_ROTATION_SECTORS;
            sum += (side == 0 ? 2 : 1) * (rose[one] + rose[(one + HALF) % SCREE_ROTATION_SECTORS]);
        }
        if (!(sum > highest)) continue;
        highest = sum;
        peak = k;
    }
    double angle = (peak + 0.5) * M_PI / HALF;
    return angle > M_PI / 2 ? angle - M_PI : angle;
}

void scree_rotation_network_measure(const scree_model *model, const scree_state *state,
                                    const scree_contact_table *table, size_t forced, double cutoff,
                                    scree_rotation_network *network)
{
    *network = (scree_rotation_network){0};
    double mean = scree_rotation_mean_force(table), limit = cutoff * 2 * model->mean_radius;
    segment s;
    for (size_t c = 0; c < table->count; c++) {
        if (!see_segment(state, &table->contact[c], forced, limit, mean, &s)) continue;
        network->contacts++;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) network->tensor[3 * i + j] += s.outward[i] * s.branch[j] * s.force / s.distance;
    }
    scree_rotation_axes(state->dimension, network->tensor, network->value, network->axis);
    for (size_t c = 0; c < table->count; c++)
        if (see_segment(state, &table->contact[c], forced, limit, mean, &s))
            network->rose[scree_rotation_sector(state->dimension, network, s.outward)] +=
                scree_rotation_dot(s.outward, s.branch) * s.force / s.distance;
    for (size_t k = 0; k < SCREE_ROTATION_SECTORS; k++) network->followed[k] = NAN;
    network->peak = state->dimension == 2 ? find_peak(network->rose) : NAN;
}
