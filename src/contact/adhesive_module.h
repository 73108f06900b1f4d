/// The module of a law that sticks, as one macro, since two laws differ in their names and a constant only. For the
/// files of these laws, and no headers.
#ifndef SCREE_CONTACT_ADHESIVE_MODULE_H
#define SCREE_CONTACT_ADHESIVE_MODULE_H

#include "contact/adhesive_law.h"

#include "case/check.h"
#include "module/key_rows.h"
#include "state/memory_fields.h"

static const scree_choice rolling_resistances[] = {
    {"springs", SCREE_ROLLING_SPRINGS, "springs with sliders, of the stiffness of the tangential one"},
    {"constant", SCREE_ROLLING_CONSTANT,
     "a torque of constant size against the motion, however slow (Zhou et al. 1999); it holds nothing at rest"},
    {0},
};

#define ADHESIVE_CONTACT_KEYS(law)                                                                                     \
    NUMBER(scree_adhesive_config, work_of_adhesion, "J/m2", .standard = "auto", ABOVE("0 J/m2"), TO("1e6 J/m2"),       \
           .when = "law=" #law,                                                                                        \
           .meaning = "Work that parts a unit of the area of contact; auto: 2 sqrt(g1 g2) of the `surface_energy` of " \
                      "both materials, and on what is rigid 2 g1."),                                                   \
        CHOICE(scree_adhesive_config, rolling_resistance, rolling_resistances, .standard = "springs",                  \
               .when = "law=" #law, .meaning = "How contacts resist rolling and twisting, where materials do.")

#define ADHESIVE_MATERIAL_KEYS(law)                                                                                    \
    NUMBER(scree_adhesive_material, surface_energy, "J/m2", .standard = "0.05 J/m2", FROM("0 J/m2"), TO("1e6 J/m2"),   \
           .when = "contact.law=" #law,                                                                                \
           .meaning = "Surface energy: half of the work of adhesion of two such grains; 0: they do not stick."),       \
        NUMBER(scree_adhesive_material, restitution, "1", .standard = "0.2", ABOVE("0"), TO("1"),                      \
               .when = "contact.law=" #law,                                                                            \
               .meaning = "Coefficient of restitution of a fast normal impact, without adhesion; sets the damping."),  \
        NUMBER(scree_adhesive_material, rolling_friction, "1", .standard = "0", FROM("0"), TO("10"),                   \
               .when = "contact.law=" #law,                                                                            \
               .meaning = "Limit of the rolling resistance over the load of friction; its torque is that times "       \
                          "R_eff."),                                                                                   \
        NUMBER(scree_adhesive_material, twisting_friction, "1", .standard = "0", FROM("0"), TO("10"),                  \
               .when = "contact.law=" #law,                                                                            \
               .meaning = "Limit of the torque about the normal over R_eff times the load of friction; spheres only.")

#define ADHESIVE_SPRINGS         .options = 1U << ADHESIVE_ROLLING
#define ADHESIVE_TORQUES         .options = 1U << ADHESIVE_CONSTANT
#define ADHESIVE_FIELD(law, ...) SCREE_REMEMBERS(law, __VA_ARGS__)
#define ADHESIVE_FIELDS(law)                                                                                           \
    ADHESIVE_FIELD(law, history, 0, SCREE_AXIAL_VECTOR, SCREE_TANGENTIAL_DISPLACEMENT_FIELD, .in_checksum = true),     \
        ADHESIVE_FIELD(law, history, 1, 1, SCREE_TANGENTIAL_STIFFNESS_FIELD, .only_dimension = 2,                      \
                       .in_checksum = true),                                                                           \
        ADHESIVE_FIELD(law, history, 2, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 2),                           \
        ADHESIVE_FIELD(law, history, 3, 1, SCREE_TANGENTIAL_DAMPING_FIELD, .only_dimension = 2),                       \
        ADHESIVE_FIELD(law, history, 3, 1, SCREE_TANGENTIAL_STIFFNESS_FIELD, .only_dimension = 3,                      \
                       .in_checksum = true),                                                                           \
        ADHESIVE_FIELD(law, last_force, 0, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 3),                        \
        ADHESIVE_FIELD(law, last_force, 1, 3, SCREE_TANGENTIAL_DAMPING_FIELD, .only_dimension = 3),                    \
        ADHESIVE_FIELD(law, rolling, 0, SCREE_AXIAL_VECTOR, SCREE_ROLLED_FIELD, ADHESIVE_SPRINGS,                      \
                       .in_checksum = true),                                                                           \
        ADHESIVE_FIELD(law, rolling, 3, 1, SCREE_TWISTED_FIELD, ADHESIVE_SPRINGS, .only_dimension = 3,                 \
                       .in_checksum = true),                                                                           \
        ADHESIVE_FIELD(law, rolling_last, 0, SCREE_AXIAL_VECTOR, SCREE_ROLLING_DAMPING_FIELD, ADHESIVE_SPRINGS),       \
        ADHESIVE_FIELD(law, rolling_last, 3, 1, SCREE_TWISTING_DAMPING_FIELD, ADHESIVE_SPRINGS, .only_dimension = 3),  \
        ADHESIVE_FIELD(law, rolling, 0, SCREE_AXIAL_VECTOR, SCREE_ROLLING_FORCE_FIELD, ADHESIVE_TORQUES),              \
        ADHESIVE_FIELD(law, rolling, 3, 1, SCREE_TWISTING_TORQUE_FIELD, ADHESIVE_TORQUES, .only_dimension = 3)

/// Everything of the file of a law; `...`: what its descriptor has beside.
#define ADHESIVE(lawname, meaning_, jkr, elastic_, ...)                                                                \
    static const scree_key contact_keys[] = {ADHESIVE_CONTACT_KEYS(lawname)};                                          \
    static const scree_key material_keys[] = {ADHESIVE_MATERIAL_KEYS(lawname)};                                        \
    static const scree_field fields[] = {ADHESIVE_FIELDS(lawname)};                                                    \
    static const scree_adhesive_material *own_material(const scree_config_material *section)                           \
    {                                                                                                                  \
        return scree_config_own(&scree_module_##lawname, "materials", section->own);                                   \
    }                                                                                                                  \
    static void rules(scree_reader *reader, const scree_config *config)                                                \
    {                                                                                                                  \
        for (int64_t i = 0; i < config->material_count && config->dimension == 2; i++) {                               \
            char path[SCREE_PATH_BYTES];                                                                               \
            (void)snprintf(path, sizeof path, "materials.%lld.twisting_friction", (long long)i);                       \
            if (own_material(&config->materials[i])->twisting_friction > 0)                                            \
                scree_rule_refuse(reader, path, "0", "discs do not twist: twisting_friction is for spheres");          \
        }                                                                                                              \
    }                                                                                                                  \
    static const char *material_problem(const scree_config_material *section, const char **key)                        \
    {                                                                                                                  \
        return scree_adhesive_problem(own_material(section), key);                                                     \
    }                                                                                                                  \
    static unsigned options(const void *own, const scree_config_material *of)                                          \
    {                                                                                                                  \
        return scree_adhesive_options(own, own_material(of));                                                          \
    }                                                                                                                  \
    static scree_pair_constants constants(const scree_contact_space *space, const scree_config_material *a,            \
                                          const scree_config_material *b)                                              \
    {                                                                                                                  \
        (void)space;                                                                                                   \
        return scree_adhesive_constants(a, b, own_material(a), b ? own_material(b) : NULL);                            \
    }                                                                                                                  \
    static scree_law_bounds bound(const scree_law_use *use, const scree_pair_constants *most,                          \
                                  const scree_law_extent *extent)                                                      \
    {                                                                                                                  \
        return scree_adhesive_bound(jkr, use, most, extent);                                                           \
    }                                                                                                                  \
    static scree_contact_tangent tangent(const scree_law_use *use, const scree_pair_constants *pair, double radius,    \
                                         double mass, double force)                                                    \
    {                                                                                                                  \
        (void)use;                                                                                                     \
        return scree_adhesive_tangent(jkr, pair, radius, mass, force);                                                 \
    }                                                                                                                  \
    static scree_status impact(const scree_law_use *use, const scree_pair_constants *pair, double radius, double mass, \
                               double speed, scree_impact *result, scree_error *error)                                 \
    {                                                                                                                  \
        (void)use;                                                                                                     \
        return scree_adhesive_impact(jkr, pair, radius, mass, speed, result, error);                                   \
    }                                                                                                                  \
    static const scree_law law = {.traits = lawname##_traits,                                                          \
                                  .option_count = sizeof lawname##_traits / sizeof *lawname##_traits,                  \
                                  .elastic = &(elastic_),                                                              \
                                  .constant_count = ADHESIVE_ROOT + 1,                                                 \
                                  .resistances = 1U << SCREE_FRICTION | 1U << HERTZ_ROLLING | 1U << HERTZ_TWISTING,    \
                                  .material_problem = material_problem,                                                \
                                  .options = options,                                                                  \
                                  .constants = constants,                                                              \
                                  .amend = scree_adhesive_amend,                                                       \
                                  .bound = bound,                                                                      \
                                  .tangent = tangent,                                                                  \
                                  .impact = impact,                                                                    \
                                  .tabor = scree_adhesive_tabor,                                                       \
                                  .impact_duration = true,                                                             \
                                  .confine_grains = 700,                                                               \
                                  __VA_ARGS__};                                                                        \
    const scree_module scree_module_##lawname = {                                                                      \
        .name = #lawname,                                                                                              \
        .meaning = meaning_,                                                                                           \
        .choice_of = CHOICE_OF(IS("contact.law"), IS("contact.pairs.law")),                                            \
        .keys = (const scree_keys[]){KEYS_OF("contact", contact_keys, scree_adhesive_config, .after = "law"),          \
                                     KEYS_OF("contact.pairs", contact_keys, scree_adhesive_config, .after = "law"),    \
                                     KEYS_OF("materials", material_keys, scree_adhesive_material)},                    \
        .keys_count = 3,                                                                                               \
        .rules = rules,                                                                                                \
        .law = &law,                                                                                                   \
        .spreads = true,                                                                                               \
        .fields = fields,                                                                                              \
        .field_count = sizeof fields / sizeof *fields,                                                                 \
    }

#endif
