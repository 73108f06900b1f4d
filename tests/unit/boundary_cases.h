/// The same confined sample under each boundary, for whole runs.
#ifndef SCREE_TESTS_BOUNDARY_CASES_H
#define SCREE_TESTS_BOUNDARY_CASES_H

#define BOUNDARY_COMMON                                                                                                \
    "scree: 1\n"                                                                                                       \
    "name: small\n"                                                                                                    \
    "seed: 3\n"                                                                                                        \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}\n"            \
    "particles: {material: quartz, count: 50, radius_min: 0.5 mm, radius_max: 1 mm}\n"                                 \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "integrator: {scheme: velocity_verlet, step: 2e-5 s}\n"                                                            \
    "boundary: {every: 100}\n"                                                                                         \
    "measure: {samples: 20}\n"                                                                                         \
    "output: {snapshots: 2, paraview: no, figures: no, checkpoint_steps: 0}\n"                                         \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, aspect_ratio: 1.5}\n"                                                                        \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 5e-2}\n"

#define BOUNDARY_COMPRESS "  - {stage: compress, strain: 0.5 %, rate: 5e-2 1/s}\n"
#define BOUNDARY_DEFORM   "  - {stage: deform, strain: 0.3 %, boundary: minimal, strain_rate: {xy: 3e-2 1/s, yy: 0}}\n"
#define BOUNDARY_AFFINE                                                                                                \
    "  - {stage: deform, strain: 0.02 %, boundary: affine, velocity_gradient: {xx: 0, xy: 0, yx: 0, yy: -1e-3 1/s}}\n"
#define BOUNDARY_SETTLE "  - {stage: confine, name: settle, pressure: 100 kPa, boundary: minimal}\n"

/// What the comparisons of bits run through.
static const struct {
    const char *text, *override;
} boundary_variants[] = {
    {BOUNDARY_COMMON BOUNDARY_COMPRESS, "stages.compress.boundary=membrane"},
    {BOUNDARY_COMMON BOUNDARY_COMPRESS, "stages.compress.boundary=minimal"},
    {BOUNDARY_COMMON BOUNDARY_DEFORM, "measure.samples=10"},
    {BOUNDARY_COMMON BOUNDARY_AFFINE, "integrator.scheme=position_verlet"},
    {BOUNDARY_COMMON BOUNDARY_COMPRESS, "boundary.lateral=membrane"},
};
enum { BOUNDARY_VARIANTS = sizeof boundary_variants / sizeof *boundary_variants };

#endif
