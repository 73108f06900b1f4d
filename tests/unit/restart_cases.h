/// Small samples whose states have all that a state can have, between them.
#ifndef SCREE_TESTS_RESTART_CASES_H
#define SCREE_TESTS_RESTART_CASES_H

#define RESTART_COMMON(dimension, shape, count)                                                                        \
    "scree: 1\n"                                                                                                       \
    "name: small\n"                                                                                                    \
    "dimension: " dimension "\n"                                                                                       \
    "seed: 3\n"                                                                                                        \
    "gravity: [0, 0, 0]\n"                                                                                             \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}\n"            \
    "particles: {material: quartz, shape: " shape ", count: " count ", radius_min: 0.6 mm, radius_max: 0.9 mm}\n"      \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "integrator: {scheme: velocity_verlet, step: 2e-5 s}\n"                                                            \
    "measure: {samples: 20, cells: no}\n"                                                                              \
    "output: {snapshots: 0, paraview: no, figures: no}\n"
#define RESTART_CONFINED                                                                                               \
    "boundary: {every: 100}\n"                                                                                         \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, aspect_ratio: 1.5}\n"                                                                        \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 0.9, ramp_time: 1 ms}\n"

static const char *const restart_cases[] = {
    RESTART_COMMON("2", "disc", "30") RESTART_CONFINED
    "  - {stage: deform, strain: 0.3 %, boundary: minimal, strain_rate: {xy: 3e-2 1/s, yy: 0}}\n",
    RESTART_COMMON("3", "sphere", "30") RESTART_CONFINED
    "  - {stage: deform, strain: 0.3 %, boundary: minimal, strain_rate: {xz: 3e-2 1/s, zz: 0}}\n",
    RESTART_COMMON("2", "disc", "30") RESTART_CONFINED
    "  - {stage: compress, strain: 0.5 %, rate: 0.2 1/s, boundary: membrane}\n",
    RESTART_COMMON("2", "disc",
                   "30") "boundary: {periodic: xy}\n"
                         "stages:\n"
                         "  - {stage: prepare, method: gas, solid_fraction: 45 %, velocity: 20 mm/s}\n"
                         "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 0.9, ramp_time: 1 ms}\n"
                         "  - {stage: deform, strain: 70 %, velocity_gradient: {xy: 0.8 1/s, yx: 0}}\n",
};
enum { RESTART_CASES = sizeof restart_cases / sizeof *restart_cases };

#endif
