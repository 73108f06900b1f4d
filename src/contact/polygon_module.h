/// Rows of the descriptors of the laws of polygons; the functions are those of polygon_module.c.
#ifndef SCREE_CONTACT_POLYGON_MODULE_H
#define SCREE_CONTACT_POLYGON_MODULE_H

#include "case/check.h"
#include "contact/polygon_force.h"
#include "module/key_rows.h"
#include "state/memory_fields.h"

extern const scree_elastic scree_polygon_elastic;

unsigned scree_polygon_options(const void *own, const scree_config_material *of);

/// Of the materials' keys of this law.
scree_pair_constants scree_polygon_constants(const scree_module *law, const scree_contact_space *space,
                                             const scree_config_material *a, const scree_config_material *b);
scree_law_bounds scree_polygon_bound(const scree_law_use *use, const scree_pair_constants *most,
                                     const scree_law_extent *extent);
scree_contact_tangent scree_polygon_tangent(const scree_law_use *use, const scree_pair_constants *pair,
                                            double effective_radius, double effective_mass, double static_force);
scree_status scree_polygon_impact(const scree_law_use *use, const scree_pair_constants *pair, double effective_radius,
                                  double effective_mass, double speed, scree_impact *impact, scree_error *error);

/// Energy [J] that the normal force has taken up without storing it, and its share of all that contacts have.
scree_status scree_polygon_told(const scree_context *context, size_t index, double *value, scree_error *error);

/// Rows of the keys of a material, for the law of this name.
#define POLYGON_KEYS(law)                                                                                              \
    NUMBER(scree_polygon_material, damping_constant, "1", .standard = "0.75", FROM("0"), TO("100"),                    \
           .when = "contact.law=" law,                                                                                 \
           .meaning = "Gamma of the normal dashpot, times sqrt(E m_eff) times the rate of the depth A / l; E is "      \
                      "`young_modulus` times the thickness."),                                                         \
        NUMBER(scree_polygon_material, tangential_share, "1", .standard = "0.2857142857142857", FROM("0"), TO("10"),   \
               .when = "contact.law=" law, .meaning = "Stiffness of the tangential spring over E."),                   \
        NUMBER(scree_polygon_material, tangential_viscosity, "1", .standard = "1", FROM("0"), TO("100"),               \
               .when = "contact.law=" law,                                                                             \
               .meaning = "Tangential dashpot over sqrt(k_t m), m the reduced mass of the motion along the contact.")

#define POLYGON_LAW(traits_)                                                                                           \
    .traits = traits_, .option_count = 1, .elastic = &scree_polygon_elastic, .constant_count = POLYGON_VISCOSITY + 1,  \
    .resistances = 1U << SCREE_FRICTION, .options = scree_polygon_options, .bound = scree_polygon_bound,               \
    .tangent = scree_polygon_tangent, .impact = scree_polygon_impact, .impact_duration = true, .confine_falls = 60

#define POLYGON_FIELDS(law)                                                                                            \
    SCREE_REMEMBERS(law, history, 0, SCREE_AXIAL_VECTOR, SCREE_TANGENTIAL_DISPLACEMENT_FIELD, .in_checksum = true,     \
                    .only_dimension = 2),                                                                              \
        SCREE_REMEMBERS(law, history, 1, 1, "elastic_normal_force", "N",                                               \
                        "elastic part of the normal force of the last step", .only_dimension = 2),                     \
        SCREE_REMEMBERS(law, history, 2, 1, "elastic_normal_energy", "J",                                              \
                        "energy that the contact held in the last step", .only_dimension = 2),                         \
        SCREE_REMEMBERS(law, history, 3, 1, "last_direction", "1",                                                     \
                        "direction of the normal force of the last step, as a way round a square, -2 to 2",            \
                        .only_dimension = 2),                                                                          \
        SCREE_REMEMBERS(law, last_force, 0, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 2),                       \
        SCREE_REMEMBERS(law, last_force, 1, 1, SCREE_TANGENTIAL_DAMPING_FIELD, .only_dimension = 2),                   \
        SCREE_REMEMBERS(law, last_force, 2, 2, "last_lever", "m",                                                      \
                        "from the centre of the first body to where the force of the last step acted",                 \
                        .only_dimension = 2)

#endif
