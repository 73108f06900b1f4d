/// Parts of small cases: a material, discs that are confined and compressed, and discs that fall onto a plane.
#ifndef SCREE_TESTS_SMALL_CASES_H
#define SCREE_TESTS_SMALL_CASES_H

#define SMALL_QUARTZ                                                                                                   \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}\n"

/// `limit` of the unbalanced force ends the confinement.
#define SMALL_DISCS(count, limit)                                                                                      \
    "particles: {material: quartz, count: " count ", radius_min: 0.5 mm, radius_max: 1 mm}\n"                          \
    "measure: {samples: 20}\n"                                                                                         \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "boundary: {every: 100}\n"                                                                                         \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, aspect_ratio: 1}\n"                                                                          \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: " limit "}\n"                                           \
    "  - {stage: compress, strain: 0.2 %, rate: 0.2 1/s}\n"

/// Onto a wall of the case, under gravity.
#define SMALL_POUR                                                                                                     \
    "gravity: [0, -9.81]\n"                                                                                            \
    "particles: {material: quartz, count: 30, radius_min: 0.5 mm, radius_max: 1 mm}\n"                                 \
    "measure: {samples: 20, cells: no}\n"                                                                              \
    "walls:\n"                                                                                                         \
    "  - {shape: plane, point: [0, -1 mm], normal: [0, 1]}\n"                                                          \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: gas, velocity: 20 mm/s}\n"                                                           \
    "  - {stage: relax, duration: 30 ms}\n"

#endif
