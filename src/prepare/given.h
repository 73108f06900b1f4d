/// What methods share whose bodies are given, one by one: listed in the case (bodies.c) or in a file (file.c).
#ifndef SCREE_PREPARE_GIVEN_H
#define SCREE_PREPARE_GIVEN_H

#include "prepare/bodies.h"

/// Whether the first stage of motion has plates, or a cell, where the box is.
bool scree_given_has_box(const scree_config *config);

/// Notes an outline that is no box, species, and another number of particles than `count`, unless a stage pours the
/// others. False: bodies need not be looked at one by one.
bool scree_given_rules(scree_reader *reader, const scree_config *config, size_t count);

/// The two that overlap most, over the smaller radius of both; count: pairs that overlap by more than `allowed` of it.
typedef struct scree_given_overlap {
    size_t count, first, second;
    double overlap; ///< m
} scree_given_overlap;

/// Round bodies in space (z NULL: in the plane). Errors: memory. Cost: linear for radii of one size; with broad ones
/// the largest sets the cells.
scree_status scree_given_find_overlap(size_t count, const double *const place[3], const double *radius, double allowed,
                                      scree_given_overlap *found, scree_error *error) SCREE_MUST_USE;

#endif
