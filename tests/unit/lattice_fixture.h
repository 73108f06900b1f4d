/// Periodic lattices of discs and spheres that touch.
#ifndef SCREE_TESTS_LATTICE_FIXTURE_H
#define SCREE_TESTS_LATTICE_FIXTURE_H

#include "specimen_fixture.h"

#include "theory/lattice.h"

/// A cubic cell of a lattice of discs or spheres of radius 1 mm that touch, repeated `n` times a side.
static inline discs discs_lattice(scree_lattice kind, int n)
{
    static const double sites[SCREE_LATTICES][4][3] = {
        [SCREE_LATTICE_HEXAGONAL] = {{0, 0, 0}, {0.5, 0.5, 0}},
        [SCREE_LATTICE_BODY_CENTRED] = {{0, 0, 0}, {0.5, 0.5, 0.5}},
        [SCREE_LATTICE_FACE_CENTRED] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}},
    };
    static const double edges[SCREE_LATTICES] = {2, 2, 2, 2.3094010767585034, 2.8284271247461903};
    static const int counts[SCREE_LATTICES] = {1, 2, 1, 2, 4};
    const int layers = scree_lattice_dimension(kind) == 3 ? n : 1;
    const double a = 1e-3 * edges[kind], b = kind == SCREE_LATTICE_HEXAGONAL ? 1e-3 * sqrt(12) : a;
    discs d = discs_create((size_t)(n * n * layers * counts[kind]));
    for (int cell = 0; cell < n * n * layers; cell++)
        for (int k = 0; k < counts[kind]; k++)
            discs_add(&d, a * (cell % n + sites[kind][k][0]), b * (cell / n % n + sites[kind][k][1]),
                      a * (cell / n / n + sites[kind][k][2]), 1e-3);
    d.lattice[0] = n * a;
    d.lattice[1] = n * b;
    d.lattice[2] = layers > 1 ? n * a : 0;
    return d;
}

#endif
