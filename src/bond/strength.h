/// How strong a bond is made.
#ifndef SCREE_BOND_STRENGTH_H
#define SCREE_BOND_STRENGTH_H

#include "model/model.h"
#include "state/state.h"

/// By what the strengths of a bond differ from their means.
typedef enum scree_scatter { SCREE_SCATTER_NONE, SCREE_SCATTER_NORMAL, SCREE_SCATTER_WEIBULL } scree_scatter;

/// Of each strength the force or the stress, the other NAN; both NAN: there is no limit.
typedef struct scree_strength {
    double tensile, shear;               ///< N
    double tensile_stress, shear_stress; ///< Pa
    double internal_friction;            ///< 1, slope of the strength in shear over the compressive normal force
    int scatter;                         ///< scree_scatter
    double deviation;                    ///< 1, normal: standard deviation of the factor
    double modulus;                      ///< 1, Weibull: shape of its distribution
    uint64_t seed;
} scree_strength;

/// Area [m2] of the bond of two radii [m], the one of law linear's E A / L: discs of thickness t, t (R_1 + R_2);
/// spheres, pi R_1 R_2.
double scree_bond_area(const scree_model *model, double radius_a, double radius_b);

/// Factor of both strengths of the bond of two ids, in any order: mean 1, a pure function of seed and ids.
double scree_bond_factor(const scree_strength *strength, uint32_t id_a, uint32_t id_b);

/// Sets the strengths among the constants of a member of the persistent list.
void scree_bond_strengths(const scree_strength *strength, uint32_t id_a, uint32_t id_b, double area,
                          double constant[SCREE_MEMBER_CONSTANTS]);

#endif
