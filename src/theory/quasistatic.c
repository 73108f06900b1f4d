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
#include "theory/quasistatic.h"

#include <math.h>

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
