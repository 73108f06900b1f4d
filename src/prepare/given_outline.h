/// Outlines of bodies that are given, before there is a sample: how far they reach, and how deep two of them lie in
/// each other, by their outlines and not by the discs of equal area.
#ifndef SCREE_PREPARE_GIVEN_OUTLINE_H
#define SCREE_PREPARE_GIVEN_OUTLINE_H

#include "case/config.h"
#include "shape/polygon.h"

/// A polygon as it will lie.
typedef struct scree_given_outline {
    int count;                               ///< of corners; 0: the body is round, or its keys are wrong, and noted
    double corner[SCREE_POLYGON_CORNERS][2]; ///< m, from its centre, of its core where it is rounded
    double rounding;                         ///< m
    double radius;                           ///< m, of the disc of equal area
    double bound;                            ///< m, no point of it is farther from the centre
} scree_given_outline;

/// Whether the particles of a case that has no species are bodies in the plane that are not round, and their keys can
/// be read.
bool scree_given_has_outlines(const scree_config *config);

/// That of body `number` with this equivalent radius [m], turned by `angle` [rad].
scree_given_outline scree_given_outline_of(const scree_config *config, uint64_t number, double radius, double angle);

/// No body of this equivalent radius reaches farther from its centre [m].
double scree_given_reach(const scree_config *config, double radius);

/// What a body as that of scree_given_outline_of reaches from its centre towards both walls across direction `axis`
/// [m].
void scree_given_outline_reach(const scree_config *config, uint64_t number, double radius, double angle, int axis,
                               double reach[2]);

typedef struct scree_given_depth {
    double depth; ///< m, the shortest way that parts them (shape/core_gap.h); negative where they are apart
    double
        overlap; ///< m, what the guard of a run sees: A / l of sharp outlines (contact/outlines.h), the root of the
                 ///< sum over features of rounded ones (shape/core_pair.h). INFINITY: so deep that no law has a force
} scree_given_depth;

/// The centre of the second is `apart` [m] from that of the first.
scree_given_depth scree_given_outline_depth(const scree_given_outline *first, const scree_given_outline *second,
                                            const double apart[2]);

#endif
