/// What the files of the rotation measures share. Private to src/measure/.
#ifndef SCREE_MEASURE_ROTATION_PARTS_H
#define SCREE_MEASURE_ROTATION_PARTS_H

#include "measure/rotation.h"

static inline double scree_rotation_dot(const scree_vector a, const scree_vector b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Makes a unit vector of `a`; its length is returned.
static inline double scree_rotation_normalise(scree_vector a)
{
    double length = scree_length(a);
    for (int i = 0; i < 3; i++) a[i] /= length;
    return length;
}

static inline double scree_rotation_force(const scree_contact *contact)
{
    return hypot(contact->normal_force, contact->tangential_force);
}

/// Over the contacts between bodies [N]; NAN without any.
double scree_rotation_mean_force(const scree_contact_table *table);

/// Eigenvalues, falling, and unit eigenvectors of the symmetric part of `tensor`, in the first `dimension` directions;
/// the others stay as they are.
void scree_rotation_axes(int dimension, const double tensor[9], double value[3], scree_vector axis[3]);

/// The sector of the rose that the unit vector `outward` points into.
size_t scree_rotation_sector(int dimension, const scree_rotation_network *network, const scree_vector outward);

#endif
