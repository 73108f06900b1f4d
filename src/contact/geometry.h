/// The code of the geometries of the table (module/table.h). A geometry is a header of its own, NAME.h, with its traits
/// NAME_traits and always-inline functions:
///   lanes_bits NAME_touches(dimension, first, second)            the distance test
///   kinematics NAME_kinematics(dimension, first, second, step)   normal, overlap, levers, and the rates from them
///   kinematics NAME_beside(body, normal, distance, step)         the same beside a wall, without rates; the body moves
///                                                                as it does in the frame of the wall
///   kinematics NAME_against(body, wall, apart, step)             the same beside the outline of a solid wall, of
///                                                                those with `solids`
///   lanes NAME_reach(body)                                       from the centre towards a wall
/// With a constant geometry the compiler keeps one branch. In lanes bodies have what their rows say; of one by one a
/// geometry finds the rest by `state` and `row` of the bodies (fields of its shape's module, which ghosts follow).
/// Forces along normals that do not pass through the centres have the trait `levers`: kinematics_from_levers.
#ifndef SCREE_CONTACT_GEOMETRY_H
#define SCREE_CONTACT_GEOMETRY_H

#include "contact/law.h"
#include "contact/round.h"

/// Kernels know those in lanes alone, but for those of outlines (outlines_batch.c). A test may have one of its own
/// behind all others, with code that it compiles itself.
#ifdef SCREE_MORE_GEOMETRIES
#include "contact/outlines.h"
#else
#define SCREE_MORE_GEOMETRIES(row)
#endif
#if SCREE_LANES == 1
#include "contact/outlines.h"
#include "contact/rounded.h"
#define ALL_GEOMETRIES(row) SCREE_GEOMETRIES(row) SCREE_MORE_GEOMETRIES(row)
#else
#define ALL_GEOMETRIES(row) SCREE_GEOMETRIES_IN_LANES(row) SCREE_MORE_GEOMETRIES(row)
#endif

/// Their numbers, by which sections and variants call them: the model finds them in the same order.
#define GEOMETRY_NUMBER(name) GEOMETRY_##name,
#define GEOMETRY_COUNT(name)  +1
enum { ALL_GEOMETRIES(GEOMETRY_NUMBER) GEOMETRIES, GEOMETRIES_IN_LANES = 0 SCREE_GEOMETRIES_IN_LANES(GEOMETRY_COUNT) };

#define GEOMETRY_TRAITS(name) [GEOMETRY_##name] = &name##_traits,
static const scree_geometry_traits *const all_geometry_traits[GEOMETRIES] = {ALL_GEOMETRIES(GEOMETRY_TRAITS)};

/// Whether forces act at points anywhere.
SCREE_INLINE bool geometry_has_levers(variant v)
{
    return all_geometry_traits[v.geometry]->levers;
}

/// Whether its kinematics alone tell who touches.
SCREE_INLINE bool geometry_is_coarse(variant v)
{
    return all_geometry_traits[v.geometry]->coarse;
}

SCREE_INLINE bool geometry_is_one_by_one(variant v)
{
    return v.geometry >= GEOMETRIES_IN_LANES;
}

#define GEOMETRY_CALL(name, function, ...)                                                                             \
    if (v.geometry == GEOMETRY_##name) return name##_##function(__VA_ARGS__);

#define GEOMETRY_TOUCHES(name) GEOMETRY_CALL(name, touches, v.dimension, first, second)
SCREE_INLINE lanes_bits geometry_touches(variant v, const bodies *first, const bodies *second)
{
    ALL_GEOMETRIES(GEOMETRY_TOUCHES)
    return lanes_as_bits(lanes_all(0));
}

#define GEOMETRY_KINEMATICS(name) GEOMETRY_CALL(name, kinematics, v.dimension, first, second, step)
SCREE_INLINE kinematics geometry_kinematics(variant v, const bodies *first, const bodies *second, double step)
{
    ALL_GEOMETRIES(GEOMETRY_KINEMATICS)
    return (kinematics){.overlap = lanes_all(0)};
}

#if SCREE_LANES == 1
#define GEOMETRY_BESIDE(name) GEOMETRY_CALL(name, beside, body, normal, distance, step)
SCREE_INLINE kinematics geometry_beside(variant v, const bodies *body, const double normal[3], double distance,
                                        double step)
{
    ALL_GEOMETRIES(GEOMETRY_BESIDE)
    return (kinematics){.overlap = lanes_all(0)};
}
#endif

/// Whether laws of areas take it.
SCREE_INLINE bool geometry_has_areas(variant v)
{
    return all_geometry_traits[v.geometry]->areas;
}

/// Whether rates and forces are those of an overlap with a gain.
SCREE_INLINE bool geometry_has_gains(variant v)
{
    return all_geometry_traits[v.geometry]->gains;
}

/// Whether it takes the outline of a solid wall.
SCREE_INLINE bool geometry_takes_solids(variant v)
{
    return all_geometry_traits[v.geometry]->solids;
}

#if SCREE_LANES == 1
/// Beside the outline of a solid wall: of laws of areas, or of others.
SCREE_INLINE kinematics geometry_against(variant v, const bodies *body, const scree_polygon *wall,
                                         const double apart[2], double step)
{
    return geometry_has_areas(v) ? outlines_against(body, wall, apart, step) : rounded_against(body, wall, apart, step);
}
#endif

#define GEOMETRY_REACH(name) GEOMETRY_CALL(name, reach, body)
SCREE_INLINE lanes geometry_reach(variant v, const bodies *body)
{
    ALL_GEOMETRIES(GEOMETRY_REACH)
    return body->radius;
}

#endif
