/// Turns the corners of polygons into the pose of their bodies, eight bodies at a time: their sines and cosines in
/// lanes. The functions of SLEEF that are taken give the same bits in all instruction sets. Cost: some 20 ns a body of
/// seven corners.
#ifndef SCREE_SHAPE_POSE_H
#define SCREE_SHAPE_POSE_H

#include "shape/polygons.h"

/// Bodies that are turned.
typedef struct scree_pose_rows {
    const uint32_t *row; ///< `count` rows; NULL: those from `begin` on
    size_t begin, count;
} scree_pose_rows;

/// angle: rad, one a row.
typedef void scree_pose_kernel(const scree_polygons *polygons, const double *angle, scree_pose_rows rows);
scree_pose_kernel scree_pose_v0, scree_pose_v2, scree_pose_v3, scree_pose_v4;

#endif
