/// Passes over bodies that deform: what the moments of the forces on each make of its strain, and the work in it.
///
/// Stretch is radius times strain [m]. With m the moments of a body in force quanta q times the radius, V the volume,
///     strain = D : stress,  V stress = q R m      =>      stretch = q R^2/V D : m,
///     work   = V stress : change of strain = q m : change of stretch;
/// V / R^2 of a disc is pi t, the same for all: neither radii nor divisions are left. Each body is by itself, so
/// threads share them; energies are sums in integers. Cost: some 30 and 20 instructions a disc (v3).
#ifndef SCREE_CONTACT_STRETCH_H
#define SCREE_CONTACT_STRETCH_H

#include "model/compliance.h"
#include "module/pass.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

/// Places of the components of a tensor in a row of state->stretch, and in the moments: xx, yy, xy; xx, yy, zz, yz, xz,
/// xy.
typedef struct scree_tensor_place {
    int row, i, j;
} scree_tensor_place;
static const scree_tensor_place scree_plane_places[] = {{0, 0, 0}, {1, 1, 1}, {2, 0, 1}};
static const scree_tensor_place scree_space_places[] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2},
                                                        {4, 1, 2}, {5, 0, 2}, {6, 0, 1}};

/// Functions of one body are compiled for each dimension `d`, as a constant.
#define SCREE_OF_BODY static inline __attribute__((always_inline))
#define SCREE_UNROLL  _Pragma("GCC unroll 6")

SCREE_OF_BODY int scree_tensor_size(int d)
{
    return d == 3 ? 6 : 3;
}

SCREE_OF_BODY const scree_tensor_place *scree_tensor_places(int d)
{
    return d == 3 ? scree_space_places : scree_plane_places;
}

SCREE_OF_BODY void scree_tensor_get(int d, const double *row, double tensor[6])
{
    SCREE_UNROLL
    for (int k = 0; k < 6; k++) tensor[k] = k < scree_tensor_size(d) ? row[scree_tensor_places(d)[k].row] : 0;
}

/// a : b
SCREE_OF_BODY double scree_tensor_product(int d, const double a[6], const double b[6])
{
    double sum = 0;
    SCREE_UNROLL
    for (int k = 0; k < scree_tensor_size(d); k++) sum += (k < d ? 1 : 2) * a[k] * b[k];
    return sum;
}

/// Symmetric part of the moments, in their units (over R: in force quanta).
SCREE_OF_BODY void scree_stretch_forces(int d, const int64_t *moment, double forces[6])
{
    const scree_tensor_place *place = scree_tensor_places(d);
    SCREE_UNROLL
    for (int k = 0; k < scree_tensor_size(d); k++) {
        const int i = place[k].i, j = place[k].j;
        forces[k] = i == j ? (double)moment[d * i + j] : 0.5 * ((double)moment[d * i + j] + (double)moment[d * j + i]);
    }
}

/// Largest eigenvalue of a tensor, or more: the mean of its diagonal and what it deviates by.
SCREE_OF_BODY double scree_tensor_largest(int d, const double tensor[6])
{
    double mean = 0, square = 0;
    SCREE_UNROLL
    for (int k = 0; k < d; k++) mean += tensor[k];
    mean *= 1.0 / d;
    SCREE_UNROLL
    for (int k = 0; k < scree_tensor_size(d); k++) {
        const double part = k < d ? tensor[k] - mean : tensor[k];
        square += (k < d ? 1 : 2) * part * part;
    }
    return mean + sqrt(square * (1 - 1.0 / d));
}

/// V / R^2 of a body of this radius [m].
SCREE_OF_BODY double scree_stretch_volume(int d, double thickness, double radius)
{
    return d == 3 ? 4 * M_PI / 3 * radius : M_PI * thickness;
}

/// What bodies do in a step.
typedef struct scree_stretch_change {
    double reach;  ///< m, largest
    double growth; ///< m, largest change of a stretch
} scree_stretch_change;

/// From the moments at n to the stretches that the forces at n + 1 are made with: `theta` of the way. Puts the half of
/// the work in it that goes with the forces at n into `term`, one a body. compliance: by material.
scree_stretch_change scree_stretch_bodies(const scree_context *context, const scree_compliance *compliance,
                                          double theta, double *term);

/// Adds the half that goes with the forces at n + 1, and all of it up.
double scree_stretch_settle(const scree_context *context, double *term);

#endif
