/// Piles whose stresses obey a linear relation in axes fixed by the way in which they were built: oriented stress
/// linearity, and its members BCC (constant ratio of the normal stresses) and FPA (fixed principal axes).
/// Wittmer, Cates, Claudin 1997; R 4.18-4.32.
#ifndef SCREE_THEORY_ORIENTED_H
#define SCREE_THEORY_ORIENTED_H

#include "base/error.h"
#include "theory/pile.h"

/// sigma_xx = eta sigma_yy + mu sign(x) sigma_xy (R 4.22).
typedef struct scree_oriented {
    double eta, mu;
} scree_oriented;

/// The same as sigma_nn = K sigma_mm with n at the angle tau from the horizontal (R 4.18 prints sigma_nm).
typedef struct scree_oriented_axes {
    double ratio; ///< 1, K
    double tau;   ///< rad, from 45 to 135 degrees; K -> 1 / K, tau -> tau - 90 degrees is the same relation
} scree_oriented_axes;

/// sigma_xx / sigma_yy at a surface that yields, 1 / (1 + 2 tan^2 phi) (R 4.21).
double scree_oriented_surface_ratio(double slope);

/// The relations that hold at a surface that yields (R 4.24) for one of eta, mu and tau.
scree_oriented scree_oriented_of_eta(double slope, double eta);
scree_oriented scree_oriented_of_mu(double slope, double mu);
scree_oriented_axes scree_oriented_of_tau(double slope, double tau);
scree_oriented scree_oriented_bcc(double slope);
scree_oriented scree_oriented_fpa(double slope);

/// R 4.23 (which prints tan^2 in mu) and back (R 4.31, 4.32, which fail for FPA). eta and mu become infinite at K tan^2
/// tau = 1.
scree_oriented scree_oriented_of_axes(scree_oriented_axes axes);
scree_oriented_axes scree_oriented_axes_of(scree_oriented oriented);

/// eta - eta_0 (1 - mu tan phi): zero where the surface yields (R 4.24).
double scree_oriented_consistency(double slope, scree_oriented oriented);

/// Slopes dx/dy of the two families of characteristics on the right side (R 4.27): outward > 0 > inward. NAN without
/// real ones.
void scree_oriented_characteristics(scree_oriented oriented, double *outward, double *inward);

/// The pile (R 4.28, which prints mu for eta in sigma_xy, and 4.29). Errors: SCREE_ERROR_INPUT for relations without
/// real characteristics, with both to one side, or with one that does not leave the surface into the pile; field `eta`.
scree_status scree_oriented_pile(double slope, double weight, scree_oriented oriented, scree_ideal_pile *pile,
                                 scree_error *error) SCREE_MUST_USE;

#endif
