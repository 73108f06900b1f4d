/// Cases for the tests of the library, and what may not fail.
#ifndef SCREE_TESTS_LIBRARY_FIXTURE_H
#define SCREE_TESTS_LIBRARY_FIXTURE_H

#include "run_fixture.h"

#include "simulation_cases.h"

/// Two equal discs or spheres at rest, far apart in a wide box: they move by what a program does to them alone.
#define LIBRARY_PAIR                                                                                                   \
    "materials: [{name: quartz, young_modulus: 100 kPa, density: 2650 kg/m3, friction: 0.4}]\n"                        \
    "particles: {material: quartz, count: 2, distribution: equal, radius: 1 mm}\n"                                     \
    "integrator: {step: 1e-5 s}\n"                                                                                     \
    "measure: {cells: no}\n"                                                                                           \
    "walls: [{shape: plane, point: [0, -1 m], normal: [0, 1]}]\n"                                                      \
    "stages:\n"                                                                                                        \
    "  - stage: prepare\n"                                                                                             \
    "    method: bodies\n"                                                                                             \
    "    width: 40 mm\n"                                                                                               \
    "    height: 40 mm\n"                                                                                              \
    "    bodies: [{position: [15 mm, 20 mm]}, {position: [25 mm, 20 mm]}]\n"                                           \
    "  - {stage: relax, duration: 1 s, boundary: walls}\n"

#define LIBRARY_PAIR_3D                                                                                                \
    "dimension: 3\n"                                                                                                   \
    "materials: [{name: quartz, young_modulus: 100 kPa, density: 2650 kg/m3, friction: 0.4}]\n"                        \
    "particles: {shape: sphere, material: quartz, count: 2, distribution: equal, radius: 1 mm}\n"                      \
    "integrator: {step: 1e-5 s}\n"                                                                                     \
    "measure: {cells: no}\n"                                                                                           \
    "walls: [{shape: plane, point: [0, 0, -1 m], normal: [0, 0, 1]}]\n"                                                \
    "stages:\n"                                                                                                        \
    "  - stage: prepare\n"                                                                                             \
    "    method: bodies\n"                                                                                             \
    "    width: 40 mm\n"                                                                                               \
    "    depth: 40 mm\n"                                                                                               \
    "    height: 40 mm\n"                                                                                              \
    "    bodies: [{position: [15 mm, 20 mm, 20 mm]}, {position: [25 mm, 20 mm, 20 mm]}]\n"                             \
    "  - {stage: relax, duration: 1 s, boundary: walls}\n"

static inline scree_simulation *library_create(const scree_case *c)
{
    scree_error error;
    scree_simulation *s;
    check(scree_simulation_create(c, 1, &s, &error), &error);
    return s;
}

static inline bool library_advance(scree_simulation *s, uint64_t steps)
{
    scree_error error;
    bool done;
    check(scree_simulation_advance(s, steps, &done, &error), &error);
    return done;
}

static inline bool library_advance_stage(scree_simulation *s)
{
    scree_error error;
    bool done;
    check(scree_simulation_advance_stage(s, &done, &error), &error);
    return done;
}

static inline scree_view library_view(scree_simulation *s, const char *name)
{
    scree_error error;
    scree_view view;
    check(scree_simulation_view(s, name, &view, &error), &error);
    return view;
}

static inline scree_energies library_energies(scree_simulation *s)
{
    scree_error error;
    scree_energies energies;
    check(scree_simulation_energies(s, &energies, &error), &error);
    return energies;
}

#endif
