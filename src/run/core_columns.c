#include "run/core_columns.h"

const scree_result scree_sample_columns[SCREE_SAMPLE_COUNT] = {
    [SCREE_SAMPLE_STEP] = {"step", "1", "simulated time in ticks: steps, the small ones of a scheme that has two"},
    [SCREE_SAMPLE_TIME] = {"time", "s", "simulated time"},
    [SCREE_SAMPLE_STAGE] = {"stage", "1", "index of the stage in the case, from 0"},
    [SCREE_SAMPLE_AXIAL_STRAIN] = {"axial_strain", "1",
                                   "strain that the stage imposes: axial, engineering, compression positive, from the "
                                   "plates or the Delaunay boundary; of a deform stage its largest component"},
    [SCREE_SAMPLE_VOLUMETRIC_STRAIN] = {"volumetric_strain", "1",
                                        "sum of the increments of the Delaunay boundary (Bagi), logarithmic, "
                                        "compression positive; without what re-detections of the boundary change"},
    [SCREE_SAMPLE_VOLUMETRIC_REDETECTED] =
        {"volumetric_strain_redetected", "1",
         "change of the enclosed volume by re-detections of the Delaunay boundary, logarithmic, compression positive"},
    [SCREE_SAMPLE_VOLUMETRIC_ENCLOSED] =
        {"volumetric_strain_enclosed", "1",
         "from the volume inside the Delaunay boundary, logarithmic, compression positive: the sum of both"},
    [SCREE_SAMPLE_VOLUMETRIC_SOLID] = {"volumetric_strain_solid", "1",
                                       "from the solid fraction inside the Delaunay boundary, logarithmic, compression "
                                       "positive: does not depend on which bodies the boundary runs through"},
    [SCREE_SAMPLE_BOUNDARY_AXIAL] = {"boundary_axial_strain", "1",
                                     "axial strain from the Delaunay boundary, compression positive"},
    [SCREE_SAMPLE_BOUNDARY_LATERAL] = {"boundary_lateral_strain", "1",
                                       "lateral strain from the Delaunay boundary, compression positive; in 3D the "
                                       "mean of both"},
    [SCREE_SAMPLE_BOUNDARY_LATERAL_Y] = {"boundary_lateral_strain_y", "1", "its y component in 3D, not a number in 2D"},
    [SCREE_SAMPLE_SHEAR_STRAIN] =
        {"boundary_shear_strain", "1",
         "engineering shear strain of the first and the last axis from the Delaunay boundary"},
    [SCREE_SAMPLE_STRESS_RATIO] = {"stress_ratio", "1", "axial stress that the boundary applies over the lateral one"},
    [SCREE_SAMPLE_STRESS_RATIO_CONTACTS] = {"stress_ratio_contacts", "1", "the same from contact forces"},
    [SCREE_SAMPLE_AXIAL_PLATES] =
        {"stress_axial_plates", "Pa",
         "axial stress of the boundary: of bottom and top plate, or of pressure and imposed rates"},
    [SCREE_SAMPLE_LATERAL_APPLIED] = {"stress_lateral_applied", "Pa",
                                      "pressure on the Delaunay boundary or mean of the side plates"},
    [SCREE_SAMPLE_AXIAL_CONTACTS] = {"stress_axial_contacts", "Pa",
                                     "average stress from contacts, compression positive"},
    [SCREE_SAMPLE_LATERAL_CONTACTS] = {"stress_lateral_contacts", "Pa",
                                       "average stress from contacts, compression positive"},
    [SCREE_SAMPLE_SHEAR_CONTACTS] = {"stress_shear_contacts", "Pa",
                                     "symmetric part of the average stress from contacts, of the first and the "
                                     "last axis, tension positive"},
    [SCREE_SAMPLE_SLIP_RATIO] = {"slip_ratio", "1", "mean slip speed of contacts over the characteristic velocity v_R"},
    [SCREE_SAMPLE_SLIDING_FRACTION] = {"sliding_fraction", "1", "fraction of contacts at the Coulomb limit"},
    [SCREE_SAMPLE_COORDINATION] = {"coordination", "1", "contacts a particle"},
    [SCREE_SAMPLE_COORDINATION_WITHOUT_RATTLERS] = {"coordination_without_rattlers", "1",
                                                    "contacts a load-bearing particle"},
    [SCREE_SAMPLE_RATTLER_FRACTION] = {"rattler_fraction", "1", "fraction of particles that bear no load"},
    [SCREE_SAMPLE_SOLID_FRACTION] = {"solid_fraction", "1", "particles over sample, inside the Delaunay boundary"},
    [SCREE_SAMPLE_UNBALANCED_RATIO] = {"unbalanced_ratio", "1",
                                       "mean unbalanced force since the last sample over mean contact force"},
    [SCREE_SAMPLE_KINETIC] = {"kinetic", "J", "kinetic energy, translation and rotation"},
    [SCREE_SAMPLE_ELASTIC_NORMAL] = {"elastic_normal", "J", "stored in normal contact springs"},
    [SCREE_SAMPLE_ELASTIC_TANGENTIAL] = {"elastic_tangential", "J", "stored in tangential contact springs"},
    [SCREE_SAMPLE_DISSIPATED_DAMPING] = {"dissipated_damping", "J",
                                         "dissipated by contact damping since the ledger was opened"},
    [SCREE_SAMPLE_DISSIPATED_FRICTION] = {"dissipated_friction", "J", "dissipated by sliding"},
    [SCREE_SAMPLE_STIFFNESS_WORK] = {"stiffness_work", "J", "put into tangential springs by their change of stiffness"},
    [SCREE_SAMPLE_WORK_PLATES] = {"work_plates", "J", "work of the plates on the particles"},
    [SCREE_SAMPLE_WORK_PRESSURE] = {"work_pressure", "J",
                                    "work of the pressure on the Delaunay boundary or the membrane"},
    [SCREE_SAMPLE_WORK_BOUNDARY] = {"work_boundary", "J",
                                    "work of imposed rates, or of the springs of a membrane and its ends"},
    [SCREE_SAMPLE_WORK_GRAVITY] = {"work_gravity", "J", "work of gravity"},
    [SCREE_SAMPLE_SCHEME_WORK] =
        {"scheme_work", "J", "put into the kinetic energy by the scheme: changes of the step, errors of a corrector"},
    [SCREE_SAMPLE_ENERGY_RESIDUAL] = {"energy_residual", "J", "what the energy balance leaves open"},
    [SCREE_SAMPLE_ENERGY_RESIDUAL_RELATIVE] = {"energy_residual_relative", "1",
                                               "its magnitude over all energy: at the begin, turned over, stored now"},
    [SCREE_SAMPLE_HEIGHT] = {"height", "m",
                             "distance of bottom and top plate or of the faces of the periodic cell, or height as the "
                             "Delaunay boundary is strained"},
    [SCREE_SAMPLE_AREA] = {"area", "m2",
                           "area of the sample between plates and Delaunay boundary, or of the periodic cell; in 3D "
                           "its mean section"},
    [SCREE_SAMPLE_VOLUME] = {"volume", "m3",
                             "volume of the sample between plates and Delaunay boundary, or of the periodic cell"},
    [SCREE_SAMPLE_WORK_PERIODIC] = {"work_periodic", "J", "work of the deforming periodic cell"},
    [SCREE_SAMPLE_SHEAR_RATIO] = {"shear_ratio", "1",
                                  "shear stress over axial normal stress from contacts, in a periodic cell"},
    [SCREE_SAMPLE_INERTIAL_NUMBER] = {"inertial_number", "1",
                                      "of the strain rate imposed now, under the confining pressure or the mean stress "
                                      "of the contacts, whichever is less"},
    [SCREE_SAMPLE_KINETIC_OVER_ELASTIC] = {"kinetic_over_elastic", "1", "kinetic over elastic energy of the contacts"},
};
