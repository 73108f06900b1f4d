/// Response of an elastic plane to a line load on its surface: the half-space (Flamant; R 5.2-5.4) and a layer of
/// finite thickness on a rigid base, smooth (no shear, no vertical displacement) or bonded (no displacement at all).
///
/// x to the right and y down [m] from the point under the load, compression positive, all per unit length across the
/// plane. Stresses of the layer are Fourier integrals. With h = k H, z = h (1 - y/H) the potential of each wave number
/// is
///     g = A cosh z + B sinh z + C z cosh z + D z sinh z,
///     sigma_yy: -g, sigma_xx: g_zz (both times cos k x), sigma_xy: -g_z (times sin k x)
/// with sigma_yy = 1, sigma_xy = 0 on top, and at the base
///     smooth   B = C = 0, D = sinh h / (sinh h cosh h + h), A = -(sinh h + h cosh h) / (sinh h cosh h + h)
///     bonded   A = -2 (1 - nu) D, B = (1 - 2 nu) C, D = (2 (1 - nu) cosh h + h sinh h) / N,
///              C = -(h cosh h - (1 - 2 nu) sinh h) / N, N = h^2 + (3 - 4 nu) cosh^2 h + (1 - 2 nu)^2
/// What is integrated is the difference from the half-space, (1 + k y), (1 - k y), k y times exp(-k y), which falls as
/// exp(-k (2 H - y)); the half-space is added in closed form.
/// Source: own derivation; conditions at the base as in Serero et al. 2001. Cost: some 10 us a point near the load.
#ifndef SCREE_THEORY_LAYER_H
#define SCREE_THEORY_LAYER_H

#include "base/error.h"
#include "theory/pile.h"

typedef enum scree_layer_base {
    SCREE_LAYER_SMOOTH,
    SCREE_LAYER_BONDED,
    SCREE_LAYER_NONE, ///< half-space
} scree_layer_base;

typedef struct scree_layer {
    double force;     ///< N/m
    double thickness; ///< m; of a half-space the depth that is looked at
    double poisson;   ///< 1, of plane strain: nu / (1 + nu) for plane stress; felt by a bonded base alone
    scree_layer_base base;
} scree_layer;

/// Residuals, but for `base` and `force` over the largest stress and the depth at which they are taken.
typedef struct scree_layer_check {
    double equilibrium;   ///< div sigma
    double compatibility; ///< Laplacian of sigma_xx + sigma_yy
    double surface;       ///< sigma_yy, sigma_xy on top beside the load, over F / H
    double base;  ///< shear or strain along the base, and what its vertical displacement would cause, over F / H
    double force; ///< vertical force on the base over the load, less 1
} scree_layer_check;

/// Flamant's stress [Pa]; zero above the surface and under the load itself.
scree_stress_2d scree_flamant_stress(double force, double x, double y);

/// Stress of a layer at 0 <= y <= H [Pa], zero elsewhere; of a half-space at any depth. Errors: memory.
scree_status scree_layer_stress(const scree_layer *layer, double x, double y, scree_stress_2d *stress,
                                scree_error *error) SCREE_MUST_USE;

/// Mean over a square element about a place, with the weights of a hat along x, which fall from 1 in its middle to 0 a
/// side away, as elements of a response have them (average/response.h); no deeper than the base. Waves of the layer
/// keep (sin(k s / 2) / (k s / 2))^2 of their size, s the side; the half-space is taken at 3 points of Gauss in each
/// half along x, and both at 3 along y. Errors: memory.
scree_status scree_layer_mean(const scree_layer *layer, double x, double y, double side, scree_stress_2d *mean,
                              scree_error *error) SCREE_MUST_USE;

/// Half of the width at which sigma_yy of a cut at depth y is half of that under the load [m]. Errors: memory.
scree_status scree_layer_half_width(const scree_layer *layer, double y, double *width,
                                    scree_error *error) SCREE_MUST_USE;

/// Errors: memory.
scree_status scree_layer_examine(const scree_layer *layer, scree_layer_check *check, scree_error *error) SCREE_MUST_USE;

#endif
