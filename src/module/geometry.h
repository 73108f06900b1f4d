/// The face of a geometry of contacts: how two bodies touch. A geometry is a header with always-inline functions
/// (contact/geometry.h), a file with its module and this descriptor, and a row in module/table.h.
#ifndef SCREE_MODULE_GEOMETRY_H
#define SCREE_MODULE_GEOMETRY_H

#include "module/shape.h"

/// What the rest of the program must know of it; constants in the kernels.
typedef struct scree_geometry_traits {
    bool levers; ///< forces act at a point anywhere, along the normal too; else on the normal through both centres
    bool coarse; ///< `touches` may say yes of bodies that do not: kinematics tell, by an overlap above zero
    bool areas;  ///< kinematics have what laws of areas read: area, chord, length, rest_length, reduced_mass_along
    bool solids; ///< beside a solid wall with an outline it takes the outline, not the closest point of the centre
    bool gains;  ///< the overlap is not a length along the normal: its gradient is the gain (contact/kinematics.h)
} scree_geometry_traits;

/// No overlap has a larger gain: it is below the root of the number of its features, corners of two bodies.
#define SCREE_LARGEST_GAIN 8.0
/// Square of that of two faces with all four ends together: by it contacts may be stiffer than the law says.
#define SCREE_FACE_GAIN_SQUARE 4.0

typedef struct scree_geometry {
    const scree_geometry_traits *traits;
    /// Whether contacts of these two shapes may be of it, in either order; those that the law cannot use are passed by.
    bool (*serves)(const scree_shape *one, const scree_shape *other);
} scree_geometry;

#endif
