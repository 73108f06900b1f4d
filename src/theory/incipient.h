/// Incipient failure everywhere (IFE): a pile that yields at every point, its slopes at the angle of internal friction.
///
/// With the mean stress p and the angle psi of the major axis from the vertical, sigma_xx = p (1 - sin phi cos 2 psi),
/// sigma_yy = p (1 + sin phi cos 2 psi), sigma_xy = p sin phi sin 2 psi, and p = rho g y P(u), psi(u), u = x / y, the
/// balance of forces (R 4.1) is a system of two ordinary equations from psi = 0 on the axis to P = 0 at the surface u =
/// c = cot phi. With d = c - u it goes there as
///     P = d tan phi (1 + 2 tan phi q d) + ..,    psi = (90 degrees - phi)/2 + q d + ..,    q = -(2/3) sin^2 phi
/// The surface is a characteristic, and in ln d a saddle: of the solutions from the axis one arrives, those with more
/// stress on the axis miss it, those with less reach P = 0 before. That one is found by halving. The state on the axis
/// is active (sigma_yy is the larger); from a passive one a ray becomes a characteristic on the way, and no continuous
/// solution was found.
/// Source: the closure is R 4.2 everywhere; Sokolovskii 1965 has the equations. Cost: some 20 ms.
#ifndef SCREE_THEORY_INCIPIENT_H
#define SCREE_THEORY_INCIPIENT_H

#include "base/error.h"
#include "theory/pile.h"

/// slope  [rad]   also the angle of internal friction, 0.5 to 85.5 degrees
/// weight [N/m3]  rho g
/// Errors: memory; SCREE_ERROR_INPUT with the field `slope` if no solution is found, which is so above 85.7 degrees.
scree_status scree_incipient_pile(double slope, double weight, scree_ideal_pile *pile,
                                  scree_error *error) SCREE_MUST_USE;

#endif
