/// Closed forms of two discs that are pressed together. With P the force for each metre, R the radius, z the depth and
/// E', nu' the constants of the plane (E/(1-nu^2) and nu/(1-nu) in plane strain, E and nu in plane stress):
///
///     a^2 = 4 P R / (pi E')                                        equal discs: R* = R/2, E* = E'/2
///     sigma_z = P/pi { 1/R - 2/(2R - z) - 2/sqrt(a^2 + z^2) }      Hertz, the far force, and the tension that frees
///     sigma_x = P/pi { 1/R - 2/a^2 [(a^2 + 2z^2)/sqrt(a^2 + z^2) - 2z] }                          the rim of the disc
///     approach = -2 int_0^R (sigma_z - nu' sigma_x)/E' dz  ~  4P/(pi E') { ln(4R/a) - 1/2 }
///     widening = P/(pi E') (4 - pi + pi nu')                       along the diameter across, by concentrated forces
#include "theory/line_contact.h"

#include <math.h>

/// Constants of the plane.
static double plane_modulus(const scree_line_contact *c)
{
    return c->plane_stress ? c->young_modulus : c->young_modulus / (1 - c->poisson_ratio * c->poisson_ratio);
}

static double plane_ratio(const scree_line_contact *c)
{
    return c->plane_stress ? c->poisson_ratio : c->poisson_ratio / (1 - c->poisson_ratio);
}

double scree_line_contact_half_width(const scree_line_contact *c)
{
    return sqrt(4 * c->force * c->radius / (M_PI * plane_modulus(c)));
}

double scree_line_contact_approach(const scree_line_contact *c)
{
    const double a = scree_line_contact_half_width(c), r = c->radius;
    if (!(c->force > 0)) return 0;
    // The integrals of the two stresses, over P/pi.
    const double along = 1 - 2 * M_LN2 - 2 * asinh(r / a), across = 1 - 2 * r / (sqrt(a * a + r * r) + r);
    return -2 * c->force / (M_PI * plane_modulus(c)) * (along - plane_ratio(c) * across);
}

double scree_line_contact_strain(const scree_line_contact *c, double z)
{
    const double a = scree_line_contact_half_width(c), r = c->radius;
    if (!(c->force > 0)) return 0;
    const double root = sqrt(a * a + z * z), below = root + z;
    const double along = 1 / r - 2 / (2 * r - z) - 2 / root;
    // (a^2 + 2 z^2)/root - 2 z without the difference of large numbers.
    const double across = 1 / r - 2 * a * a / (root * below * below);
    return c->force / (M_PI * plane_modulus(c)) * (along - plane_ratio(c) * across);
}

double scree_line_contact_widening(const scree_line_contact *c)
{
    return c->force / (M_PI * plane_modulus(c)) * (4 - M_PI + M_PI * plane_ratio(c));
}
