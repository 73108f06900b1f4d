/// A pile in the plane whose stress scales with the distance from its apex (radial stress field, R 4.3): sectors
/// between rays through the apex, in each of which the stress is linear in x and y, or one series over the rays.
///
/// x to the right [m], y down from the apex [m]; compression is positive, so that the balance of forces is
///     d_x sigma_xx + d_y sigma_xy = 0,    d_x sigma_xy + d_y sigma_yy = rho g
/// (R 4.1 has tension positive, R 4.25 compression). The slopes are |x| = y cot(slope) (R 4.7 prints y = x tan beta).
#ifndef SCREE_THEORY_PILE_H
#define SCREE_THEORY_PILE_H

#include <stdbool.h>
#include <stddef.h>

enum { SCREE_PILE_SECTORS = 4, SCREE_PILE_TERMS = 64 };

typedef struct scree_stress_2d {
    double xx, yy, xy; ///< Pa, compression positive; over rho g and a length where it is said
} scree_stress_2d;

/// What closes the balance of forces in a sector.
typedef enum scree_pile_closure {
    SCREE_PILE_YIELDS,  ///< Mohr and Coulomb's condition, R 4.2
    SCREE_PILE_ELASTIC, ///< compatible strains, R 4.4: fulfilled by what is linear
    SCREE_PILE_LINEAR,  ///< a linear relation of the stresses, R 4.22
} scree_pile_closure;

typedef struct scree_pile_sector {
    double from, to;      ///< rays x / y
    scree_stress_2d x, y; ///< stress over rho g = x.. x + y.. y
    scree_pile_closure closure;
    double friction;    ///< rad, angle of internal friction, where it yields
    double relation[3]; ///< xx, yy, xy of a linear relation, whose sum is zero
} scree_pile_sector;

/// Plain values: it can be copied.
typedef struct scree_ideal_pile {
    double weight;                                ///< N/m3, rho g
    double slope[2];                              ///< rad, left and right angle of the surface
    scree_pile_sector sector[SCREE_PILE_SECTORS]; ///< from left to right; with a series one, without x and y
    size_t sectors;
    double mean[SCREE_PILE_TERMS]; ///< Chebyshev terms over |x| / y of the mean stress over its distance from the
    double turn[SCREE_PILE_TERMS]; ///< surface, and of the angle of the major axis from the vertical [rad]
    size_t terms;                  ///< of the series; 0: linear sectors
} scree_ideal_pile;

/// Residuals of a solution. Stresses are over rho g and the depth below the apex.
typedef struct scree_pile_check {
    double equilibrium; ///< largest component of div sigma - rho g, over rho g
    double surface;     ///< largest stress on the slopes
    double continuity;  ///< largest jump of a component across a ray
    double closure;     ///< largest residual of yield (difference of circle and line) or of the linear relation
    double weight;      ///< force on a horizontal cut over the weight above it, less 1
    double mobilised;   ///< rad, largest mobilised friction asin((s1 - s2) / (s1 + s2)) where nothing is said to yield
} scree_pile_check;

/// Stress at a point [Pa]; zero outside of the pile and at its apex.
scree_stress_2d scree_pile_stress(const scree_ideal_pile *pile, double x, double y);

/// Its derivatives [Pa/m] inside of a sector, from the solution itself; zero outside of the pile.
void scree_pile_gradient(const scree_ideal_pile *pile, double x, double y, scree_stress_2d *along_x,
                         scree_stress_2d *along_y);

scree_pile_check scree_pile_examine(const scree_ideal_pile *pile);

/// 1 - sigma_yy(0) / largest sigma_yy of a horizontal cut, and the ray x / y of the largest one.
double scree_pile_dip(const scree_ideal_pile *pile, double *largest_ray);

/// sin of the mobilised friction: radius over centre of the circle of stress.
double scree_mobilised_friction(scree_stress_2d stress);

/// s of the solution (s, 1 + s tan^2, s tan) (y - |x| tan(slope)) of a sector at a slope that yields with `friction`,
/// which is not below the slope: the smaller s is the active state. R 4.8, 4.9 corrected has both equal: s =
/// cos^2(slope).
double scree_pile_plastic(double slope, double friction, bool passive);

/// The sector at the surface, of side 0 (left) or 1 (right).
scree_pile_sector scree_pile_surface(double slope, double s, int side);

#endif
