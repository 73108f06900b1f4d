/// Small samples of discs that are dropped, confined by a pressure from the sides and compressed, and the combinations
/// of law, scheme and update of friction that they are run with.
#ifndef SCREE_TESTS_SIMULATION_CASES_H
#define SCREE_TESTS_SIMULATION_CASES_H

/// `particles`: count and sizes; `limit` ends the confinement; `measure` and `output` end in further keys.
#define SIMULATION_CASE(particles, limit, strain, measure, output)                                                     \
    "scree: 1\n"                                                                                                       \
    "name: small\n"                                                                                                    \
    "dimension: 2\n"                                                                                                   \
    "seed: 1\n"                                                                                                        \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, poisson_ratio: 0.3, density: 2.675e8 kg/m3,\n"                          \
    "     friction: 0.45, restitution: 0.2}\n"                                                                         \
    "particles: {shape: disc, material: quartz, distribution: uniform, " particles "}\n"                               \
    "contact: {law: hertz_mindlin}\n"                                                                                  \
    "integrator: {scheme: velocity_verlet, step: 2e-5 s}\n"                                                            \
    "boundary: {lateral: pressure, every: 100}\n"                                                                      \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1.5}\n"                                                 \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: " limit "}\n"                                           \
    "  - {stage: compress, strain: " strain ", rate: 5e-2 1/s}\n"                                                      \
    "measure: {samples: 20" measure "}\n"                                                                              \
    "output: {snapshots: 2, paraview: no, figures: no" output "}\n"

#define SIMULATION_SMALL                                                                                               \
    SIMULATION_CASE("count: 70, radius_min: 0.5 mm, radius_max: 1 mm", "1e-2", "0.5 %", "", ", checkpoint_steps: 7000")

/// Combinations of law, scheme and update of friction.
#define BRILLIANTOV "contact.law=hertz_brilliantov"
enum { COMBINATIONS = 7, OVERRIDES = 4 };
enum {
    MINDLIN_FIRST = 0,
    MINDLIN_LAST = 1,
    EXPLICIT_FIRST = 2,
    EXPLICIT_LAST = 3,
    IMPLICIT_FIRST = 4,
    IMPLICIT_LAST = 5,
    TIMESCALES = 6,
};
static const char *const combinations[COMBINATIONS][OVERRIDES] = {
    {"contact.law=hertz_mindlin", "integrator.scheme=velocity_verlet", "stages.confine.friction=0.1", "dimension=2"},
    {"contact.law=hertz_mindlin", "integrator.scheme=position_verlet", "stages.confine.friction=0.1", "dimension=2"},
    {BRILLIANTOV, "integrator.scheme=velocity_verlet", "stages.confine.friction=0.1", "dimension=2"},
    {BRILLIANTOV, "integrator.scheme=position_verlet", "stages.confine.friction=0.1", "dimension=2"},
    {BRILLIANTOV, "integrator.scheme=velocity_verlet", "contact.friction_update=implicit",
     "stages.confine.friction=0.1"},
    {BRILLIANTOV, "integrator.scheme=position_verlet", "contact.friction_update=implicit",
     "stages.confine.friction=0.1"},
    {BRILLIANTOV, "integrator.scheme=two_timescales", "integrator.step=1e-6 s", "integrator.repeats=2"},
};

#endif
