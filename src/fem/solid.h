/// Finite elements beside a run: solids that a case is compared with, solved by CalculiX (ccx) as a program of its own.
///
///     bar     the solid in the place of a specimen: a rectangle in plane stress, pressed on its two ends by a pressure
///             that follows a table, its motion integrated in time (bar.c)
///     discs   two equal discs without friction, one half of each, pressed by planes through their centres (discs.c)
///
/// A solve writes DIRECTORY/fem.inp, runs ccx there, and reads DIRECTORY/fem.dat; fem.log is what ccx said. Nothing is
/// kept from one solve to the next. Strains and displacements are those of CalculiX, pressure and shortening positive
/// where it says so. SI units. Cost: bar some 10 s for 180 elements and 300 steps; discs 1 s to 4 s an increment.
#ifndef SCREE_FEM_SOLID_H
#define SCREE_FEM_SOLID_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct scree_fem_bar {
    double width, height; ///< m
    double young_modulus, poisson_ratio;
    double density;         ///< kg/m3
    double damping;         ///< s, Rayleigh's beta: viscosity over stiffness
    const double *time;     ///< s, from 0, increasing
    const double *pressure; ///< Pa, on both ends at these times
    size_t points;
    int64_t across; ///< elements over the width; they are as long as that many make them nearly square
    int64_t steps;  ///< of time, to the last of the table
} scree_fem_bar;

/// Strains over time, shortening positive: from the mean displacements of the four sides.
typedef struct scree_fem_bar_result {
    size_t count;
    double *time, *axial, *lateral;
} scree_fem_bar_result;

typedef struct scree_fem_discs {
    double radius; ///< m
    double young_modulus, poisson_ratio;
    bool plane_stress; ///< false: plane strain
    double force;      ///< N for each metre of depth, up to which they are pressed
    int64_t elements;  ///< over half the width of the contact under this force
    int64_t steps;     ///< increments of the approach
} scree_fem_discs;

typedef struct scree_fem_discs_result {
    size_t count;             ///< increments, from one without force on
    double *approach, *force; ///< m, N/m
    double at_force;          ///< m, approach of the centres at the force asked for
    double widening;          ///< m, of the diameter across, there
    size_t axis_count;
    double *depth, *strain; ///< m, 1: along the line of the centres from the contact on, there; compression negative
} scree_fem_discs_result;

/// Whether ccx is installed.
bool scree_fem_is_there(void);

/// Debian's package that has it, for messages.
#define SCREE_FEM_PACKAGE "calculix-ccx"

/// Errors (SCREE_ERROR_IO): ccx is not installed or failed, with what it said; its results cannot be read; memory;
/// disk.
scree_status scree_fem_bar_solve(const char *directory, const scree_fem_bar *bar, scree_fem_bar_result *result,
                                 scree_error *error) SCREE_MUST_USE;
scree_status scree_fem_discs_solve(const char *directory, const scree_fem_discs *discs, scree_fem_discs_result *result,
                                   scree_error *error) SCREE_MUST_USE;
void scree_fem_bar_result_destroy(scree_fem_bar_result *result);
void scree_fem_discs_result_destroy(scree_fem_discs_result *result);

#endif
