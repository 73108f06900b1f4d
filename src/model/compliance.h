/// Elastic compliance of a particle whose strain is uniform (M 2.46 - 2.49): isotropic, so two numbers for every
/// condition,
///     strain = shear * stress + trace * tr(stress) I,
/// with stress, strain and I as wide as the dimension (2 x 2 for discs, 3 x 3 for spheres), tension positive.
/// Plane strain keeps the strain along the axis of a disc at zero, plane stress the stress.
#ifndef SCREE_MODEL_COMPLIANCE_H
#define SCREE_MODEL_COMPLIANCE_H

#include <stdbool.h>

typedef struct scree_compliance {
    double shear; ///< 1/Pa; 1 / (2 G)
    double trace; ///< 1/Pa
} scree_compliance;

/// What holds a particle in the directions that are not computed.
typedef enum scree_plane_condition {
    SCREE_PLANE_STRAIN, ///< discs
    SCREE_PLANE_STRESS, ///< discs
    SCREE_SOLID,        ///< spheres: nothing, all three directions are computed
} scree_plane_condition;

/// Compliance of a material of Young's modulus E [Pa] and Poisson's ratio nu: (1 + nu)/E and -nu (1 + nu)/E in plane
/// strain, -nu/E otherwise. The material has to be stable (scree_elasticity_is_stable).
static inline scree_compliance scree_compliance_of(scree_plane_condition condition, double young_modulus,
                                                   double poisson_ratio)
{
    double shear = (1 + poisson_ratio) / young_modulus;
    double width = condition == SCREE_PLANE_STRAIN ? 1 + poisson_ratio : 1;
    return (scree_compliance){.shear = shear, .trace = -poisson_ratio * width / young_modulus};
}

/// The Poisson's ratio that a compliance comes from; NAN of a rigid particle.
static inline double scree_compliance_ratio(scree_plane_condition condition, scree_compliance compliance)
{
    const double share = -compliance.trace / compliance.shear;
    return condition == SCREE_PLANE_STRAIN ? share : share / (1 - share);
}

/// The Young's modulus [Pa] that it comes from; INFINITY of a rigid particle.
static inline double scree_compliance_modulus(scree_plane_condition condition, scree_compliance compliance)
{
    if (!(compliance.shear > 0)) return 1 / compliance.shear;
    return (1 + scree_compliance_ratio(condition, compliance)) / compliance.shear;
}

/// Whether an isotropic solid of these constants resists every strain: 0 < E < infinity, -1 < nu < 1/2. At nu = 1/2 a
/// volume does not change, and in plane strain a disc under all-round pressure carries no bound; at -1 shear costs
/// nothing.
static inline bool scree_elasticity_is_stable(double young_modulus, double poisson_ratio)
{
    return young_modulus > 0 && young_modulus <= 1.7976931348623157e308 && poisson_ratio > -1 && poisson_ratio < 0.5;
}

/// Strain of a particle under `stress` [Pa], both dimension x dimension by rows and symmetric; they may be the same
/// array.
static inline void scree_compliance_strain(const scree_compliance *compliance, int dimension, const double *stress,
                                           double *strain)
{
    double trace = 0;
    for (int i = 0; i < dimension; i++) trace += stress[i * (dimension + 1)];
    for (int k = 0; k < dimension * dimension; k++) strain[k] = compliance->shear * stress[k];
    for (int i = 0; i < dimension; i++) strain[i * (dimension + 1)] += compliance->trace * trace;
}

#endif
