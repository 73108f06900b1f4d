/// A specimen that fills a box and does not repeat itself: which bodies make its faces.
#ifndef SCREE_SPECIMEN_BOX_H
#define SCREE_SPECIMEN_BOX_H

#include "specimen/specimen.h"

/// Where a sample ends along each axis [m]; NAN: where its bodies do.
typedef struct scree_box_faces {
    double end[2][3]; ///< low and high
} scree_box_faces;

typedef struct scree_box {
    int dimension;
    double face[2][3];  ///< m, low and high, along each axis
    double plane[2][3]; ///< m, mean of the centres of its bodies
    size_t count[2][3];
    double radius; ///< m, mean
} scree_box;

/// Errors: SCREE_ERROR_INPUT when the specimen is periodic in some direction, or no box.
scree_status scree_specimen_find_box(const scree_specimen *specimen, const scree_box_faces *faces, scree_box *box,
                                     scree_error *error) __attribute__((warn_unused_result));

/// Whether a body is of face `end` (0 low, 1 high) across an axis.
bool scree_box_has(const scree_specimen *specimen, const scree_box *box, size_t body, int end, int axis);

/// The same bodies and contacts, nothing held, not periodic, extent not known: to be destroyed. Errors: memory.
scree_status scree_specimen_copy(const scree_specimen *specimen, scree_specimen *out, scree_error *error)
    __attribute__((warn_unused_result));

/// The piece within the centres of the outermost bodies, to be strained by moving these: a copy, to be destroyed.
/// They are held but for their spins; contacts within a face count half, within an edge a quarter, as they belong to
/// what lies outside as well; walls do not touch it. Its extent is that between the mean planes of these bodies.
/// box: that it fills. Errors: memory.
scree_status scree_specimen_cut_box(const scree_specimen *specimen, const scree_box *box, scree_specimen *out,
                                    scree_error *error) __attribute__((warn_unused_result));

/// Mass over volume [kg/m3] of the same piece: bodies of a face count half, of an edge a quarter. NAN: it is no box.
double scree_specimen_box_density(const scree_specimen *specimen, const scree_box_faces *faces);

#endif
