/// What the modules of hertz_jkr and hertz_dmt have in common: keys, constants, bounds, closed forms.
#ifndef SCREE_CONTACT_ADHESIVE_LAW_H
#define SCREE_CONTACT_ADHESIVE_LAW_H

#include "contact/adhesive.h"

#include "theory/adhesion.h"

/// What a case says of it, under `contact` and of a material.
typedef struct scree_adhesive_config {
    int rolling_resistance;  ///< scree_rolling_resistance
    double work_of_adhesion; ///< J/m2; not above zero: of the materials
} scree_adhesive_config;

typedef struct scree_adhesive_material {
    double surface_energy;    ///< J/m2
    double restitution;       ///< 1
    double rolling_friction;  ///< 1
    double twisting_friction; ///< 1
} scree_adhesive_material;

/// Of two materials: their own structs; b and `other` are NULL for something rigid, whose surface is that of a.
scree_pair_constants scree_adhesive_constants(const scree_config_material *a, const scree_config_material *b,
                                              const scree_adhesive_material *one, const scree_adhesive_material *other);

/// The rest of the descriptor (model/law.h).
unsigned scree_adhesive_options(const scree_adhesive_config *own, const scree_adhesive_material *material);
void scree_adhesive_amend(const void *own, scree_pair_constants *pair);
const char *scree_adhesive_problem(const scree_adhesive_material *material, const char **key);
scree_law_bounds scree_adhesive_bound(bool jkr, const scree_law_use *use, const scree_pair_constants *most,
                                      const scree_law_extent *extent);
scree_contact_tangent scree_adhesive_tangent(bool jkr, const scree_pair_constants *pair, double effective_radius,
                                             double effective_mass, double force);
scree_status scree_adhesive_impact(bool jkr, const scree_pair_constants *pair, double effective_radius,
                                   double effective_mass, double speed, scree_impact *impact, scree_error *error);
double scree_adhesive_tabor(const scree_pair_constants *pair, double effective_radius);
double scree_adhesive_neck(const scree_pair_constants *pair, double effective_radius);

extern const scree_elastic scree_elastic_jkr, scree_elastic_dmt;

#endif
