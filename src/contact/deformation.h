/// What a case says of bodies that deform (deformation.c), for those who look at a specimen before a run.
#ifndef SCREE_CONTACT_DEFORMATION_H
#define SCREE_CONTACT_DEFORMATION_H

#include "model/compliance.h"
#include "model/model.h"

/// Whether strains follow the forces of the step before, as the case says.
bool scree_deformation_iterates(const scree_config *config);

/// Of bodies of this material; zero where they are rigid.
scree_compliance scree_deformation_compliance(const scree_model *model, int material);

/// Of what these are, plane strain or stress, or a solid.
scree_plane_condition scree_deformation_condition(const scree_model *model);

/// How the strain of the next step answers a mode of forces that changes its sign in every step, where a body has up to
/// `contacts` of them (specimen/stability.h, scree_strain_scheme): 1 explicit, theta / (2 - theta) relaxed, -1
/// implicit, 0 rigid.
double scree_deformation_share(const scree_model *model, double contacts);

#endif
