/// What methods share whose bodies are given, one by one: listed in the case (bodies.c) or in a file (file.c).
#ifndef SCREE_PREPARE_GIVEN_H
#define SCREE_PREPARE_GIVEN_H

#include "prepare/bodies.h"

/// Whether the first stage of motion has plates, or a cell, where the box is.
bool scree_given_has_box(const scree_config *config);

/// Notes an outline that is no box, species, and another number of particles than `count`, unless a stage pours the
/// others. False: bodies need not be looked at one by one.
bool scree_given_rules(scree_reader *reader, const scree_config *config, size_t count);

/// Where bodies lie. Lengths in m, angles in rad.
typedef struct scree_given_bodies {
    size_t count;
    const double *place[3];       ///< z NULL: in the plane
    const double *radius;         ///< of the disc of equal area
    const double *angle;          ///< NULL: 0
    const scree_config *outlines; ///< whose particles have corners (prepare/given_outline.h); NULL: they are round
} scree_given_bodies;

/// The two that overlap most, over the smaller reach of both; count: pairs that overlap by more than `allowed` of it.
typedef struct scree_given_overlap {
    size_t count, first, second;
    double overlap; ///< m, what the guard of a run sees; INFINITY: so deep that no law has a force
    double share;   ///< of the smaller reach
} scree_given_overlap;

/// Errors: memory. Cost: linear for radii of one size; with broad ones the largest sets the cells.
scree_status scree_given_find_overlap(const scree_given_bodies *bodies, double allowed, scree_given_overlap *found,
                                      scree_error *error) SCREE_MUST_USE;

#endif
