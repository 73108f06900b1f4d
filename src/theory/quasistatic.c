/// Quasistatic coefficient phi and size coefficient psi of an assembly under pressure p, strained at a nominal rate
/// (Padbidri 2010, section 2.2).
///
/// phi is the ratio of the inertial forces of the affine motion to the forces of the confining pressure, over the whole
/// sample: phi << 1 says that the macroscopic equations are those of equilibrium, also after the masses were scaled up.
/// psi is the size of a particle over that of the sample.
///
///     phi = m v0 / (f0 t0) * n,   psi = 1 / n,   v0 = rate L / 2,   L = 2 R n,   t0 = 1 / rate
///
/// (P 2.3, 2.5, 2.12), with n the number of particles across the sample:
///
///     2D:  n = (2N)^(1/2),  f0 = p 2R thickness      P 2.B1: a sample twice as high as wide, L is its height
///     3D:  n = N^(1/3),     f0 = p (2R)^2            P 2.13, 2.14
///
/// Inertial number: the time in which a grain falls into a hole of its size under the pressure, over the time in which
/// the strain rate moves it past a neighbour. Below about 1e-3 friction and solid fraction do not depend on the rate
/// any more (GDR MiDi 2004, section 5; da Cruz et al. 2005, figure 5).
///
///     2D:  I = rate (m / (p t))^(1/2),  m the mass of a disc of length t   da Cruz et al. 2005, eq. 1
///     3D:  I = rate d (density / p)^(1/2)                                  GDR MiDi 2004; Jop et al. 2006, eq. 2
///
/// The limits, and where they come from:
///     inertial number <= 1e-3                       as above
///     kinetic over elastic energy <= 0.1            a tenth: what moves must not matter beside what is stored
///     Young's modulus over pressure >= 1e3          (E / p)^(2/3) = 100 (Roux & Combe 2010): overlaps up to a percent
///     weight of a column over pressure <= 0.1       a tenth: the stress is the same at all heights
///     strain while a wave crosses <= 3e-3           a packing fails at a strain of about 1e-2, and stress is even
///                                                   after pi crossings (Davies & Hunter 1963, for a bar)
#include "theory/quasistatic.h"

#include <math.h>

const scree_quasistatic_limit scree_quasistatic_limits[SCREE_QUASISTATIC_COUNT] = {
    [SCREE_QUASISTATIC_INERTIAL] = {"inertial number", 1e-3, false},
    [SCREE_QUASISTATIC_KINETIC] = {"kinetic over elastic energy", 0.1, false},
    [SCREE_QUASISTATIC_MODULUS] = {"Young's modulus over pressure", 1e3, true},
    [SCREE_QUASISTATIC_WEIGHT] = {"self-weight over pressure", 0.1, false},
    [SCREE_QUASISTATIC_SOUND] = {"strain while a wave crosses the sample", 3e-3, false},
};

bool scree_quasistatic_keeps(scree_quasistatic_criterion criterion, double value)
{
    const scree_quasistatic_limit *limit = &scree_quasistatic_limits[criterion];
    return !(limit->least ? value < limit->limit : value > limit->limit);
}

double scree_inertial_number(int dimension, double mass, double radius, double density, double thickness, double rate,
                             double pressure)
{
    if (!(pressure > 0)) return NAN;
    return dimension == 2 ? rate * sqrt(mass / (pressure * thickness)) : rate * 2 * radius * sqrt(density / pressure);
}

double scree_wave_speed(double modulus, double density, double solid_fraction)
{
    return sqrt(modulus / (density * solid_fraction));
}

void scree_quasistatic_numbers(int dimension, double count, double mass, double radius, double thickness, double rate,
                               double pressure, double *phi, double *psi)
{
    double particles_across = dimension == 2 ? sqrt(2 * count) : cbrt(count);
    double size = 2 * radius * particles_across;
    double force = pressure * 2 * radius * (dimension == 2 ? thickness : 2 * radius);
    double velocity = rate * size / 2;
    *phi = mass * velocity * rate / force * particles_across;
    *psi = 1 / particles_across;
}
