/// Turns the corners of polygons into the pose of their bodies, eight bodies at a time: their sines and cosines in
/// lanes. The functions of SLEEF that are taken give the same bits in all instruction sets. Cost: some 20 ns a body of
/// seven corners.
#ifndef SCREE_SHAPE_POSE_H
#define SCREE_SHAPE_POSE_H

#include <stddef.h>
#include <stdint.h>

/// Where the corners of a body are in the pool.
typedef struct scree_corners {
    uint32_t first, count;
} scree_corners;

/// Bodies that are turned: `count` rows `row`, or where that is NULL those from `begin` on.
typedef struct scree_pose {
    const uint32_t *row;
    size_t begin, count;
    const double *angle;       ///< rad, one a row
    const scree_corners *of;   ///< one a row
    const double (*corner)[2]; ///< m, the pool, in the frames of the bodies
    double (*posed)[2];        ///< m, out
} scree_pose;

typedef void scree_pose_kernel(const scree_pose *pose);
scree_pose_kernel scree_pose_v0, scree_pose_v2, scree_pose_v3, scree_pose_v4;

#endif
