/// The elasto-plastic pile of Cantelaube, Didwania and Goddard (R 4.3): it yields near its slopes and is elastic
/// inside, linear in x and y in each part, all stresses continuous. Between the two elastic halves of the core there
/// may be a ray through the apex on which it yields, and across which derivatives jump.
///
/// The two core halves are linear between the ray and the boundary of their side, so the stress on the ray (three
/// numbers) and the two boundaries decide everything, and the balance of forces in both halves gives four equations. A
/// fifth makes the core smooth (no jump) or the ray yield. The direction of the ray is free but for a pile with equal
/// slopes, where symmetry puts it upright; there it carries no shear, and that is asked of every pile unless the ray is
/// given. Source: R 4.5-4.13; Didwania, Cantelaube and Goddard 2000 have piles with two slopes. Cost: microseconds,
/// with a sloping ray milliseconds.
#ifndef SCREE_THEORY_WEDGE_H
#define SCREE_THEORY_WEDGE_H

#include "base/error.h"
#include "theory/pile.h"

typedef enum scree_wedge_kind {
    SCREE_WEDGE_DIP,    ///< the ray yields, the vertical stress is smallest there (R 4.13, -)
    SCREE_WEDGE_SMOOTH, ///< one elastic core (R 4.13, o)
    SCREE_WEDGE_PEAK,   ///< the ray yields, the vertical stress is largest there (R 4.13, +)
    SCREE_WEDGES
} scree_wedge_kind;

typedef struct scree_wedge_of {
    double slope[2]; ///< rad, left and right
    double friction; ///< rad, of internal friction; 0: that of a side is its slope, and the ray yields with the smaller
                     ///< one
    bool passive;    ///< the state of sides whose friction is above their slope
    double weight;   ///< N/m3, rho g
} scree_wedge_of;

typedef struct scree_wedge {
    double core[2];         ///< rad, left and right angle between the boundary of the core and the vertical
    double axis;            ///< rad, angle of the ray from the vertical, positive to the right
    scree_stress_2d inside; ///< on the ray, over rho g y
    double jump;            ///< of d sigma_yy / dx across the ray from left to right, over rho g
    scree_ideal_pile pile;
} scree_wedge;

/// The solution of one kind; with `axis` NULL the ray carries no shear. *found says whether there is one.
/// Errors: SCREE_ERROR_INPUT for slopes and friction out of their range, with `slope`, `friction` as field.
scree_status scree_wedge_solve(const scree_wedge_of *of, scree_wedge_kind kind, const double *axis, bool *found,
                               scree_wedge *wedge, scree_error *error) SCREE_MUST_USE;

/// The core given by its right boundary [rad from the vertical], the ray upright or given, no yield demanded (R fits
/// this angle to the pile from a point source). *found is false where no left boundary belongs to it.
scree_status scree_wedge_of_core(const scree_wedge_of *of, double core, double axis, bool *found, scree_wedge *wedge,
                                 scree_error *error) SCREE_MUST_USE;

/// Largest mobilised friction in a half of the core less the friction of its side [rad]: above zero the core is not
/// elastic.
double scree_wedge_excess(const scree_wedge *wedge);

/// Coefficients of R 4.11, 4.12 (tension positive, over rho g): sigma_xx = (a2 - 1) y, sigma_yy = (a1 - 1) y + b1 |x|,
/// sigma_xy = -a1 x. Of piles with equal slopes and an upright ray.
void scree_wedge_coefficients(const scree_wedge *wedge, double *a1, double *a2, double *b1);

#endif
