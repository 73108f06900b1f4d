/// What averages are taken of: grains and contacts of one instant, discs, spheres and polygons alike.
///
/// A sample is filled from a state (scree_average_sample_of_state) or from a file (io/sample_file.h), and then finished
/// (scree_average_sample_finish), which finds what belongs to each grain alone:
///     moment         sum over its contacts of force (x) lever, from its centre to the point       N m    R 2.49
///                    (row the force, column the lever; minus the pressure of a grain under pressure, times its volume)
///     branches       sum over its contacts of n (x) n, n the unit vector of the lever              1     R 2.93, 2.94
///     normals        the same with the unit normals of the contacts                                1
///     inertia        integral of |x|^2 1 - x (x) x about its centre; in 2D of y^2, x^2, -x y        m4, 3D m5  R 2.77
///     axis           e (x) e, e the unit vector of the long axis; zero of what is round            1
/// Tensors are row-major 3 x 3; in 2D all but xx, xy, yx, yy are zero. Levers of a contact with a body across a face of
/// a periodic cell are those to its image.
///
/// Grains are what is averaged over. Bodies of a membrane and bodies whose whole motion is prescribed are none: what
/// they do to a grain comes from outside, as what a wall does.
///
/// Source: R = P. Roul, PhD thesis, Magdeburg 2009, 2.6. Units: SI. Cost: linear in grains and contacts; 540 bytes a
/// grain once it is finished, 32 more for its orientation and 32 for its turn where these are known.
#ifndef SCREE_AVERAGE_SAMPLE_H
#define SCREE_AVERAGE_SAMPLE_H

#include "contact/contact.h"

typedef struct scree_average_grain {
    scree_vector position, velocity; ///< m, m/s; z = 0 in 2D
    scree_vector resultant;          ///< N, of all that acts on it, gravity too
    scree_vector displacement;       ///< m, since an earlier instant (average/strain.h)
    bool moved;                      ///< it is known
    double radius;                   ///< m, no point of it is farther from its centre
    double volume;                   ///< m2 in 2D, m3
    double mass;                     ///< kg
    double angle;                    ///< rad, by which its outline lies turned, 2D
    uint32_t id;
    uint32_t body;                       ///< its own place; of an image that of its body
    uint32_t first_corner, corner_count; ///< of its outline in the pool; 0: round
    double rounding;                     ///< m, by which its outline lies outside of these corners
    bool counted;                        ///< a grain
} scree_average_grain;                   // images of a periodic sample stand behind the bodies

/// `second` of a contact with what is no body.
#define SCREE_AVERAGE_OUTSIDE UINT32_MAX

typedef struct scree_average_contact {
    uint32_t first, second; ///< places in `grain`
    bool sliding;
    scree_vector normal; ///< from second to first
    scree_vector point;  ///< m
    scree_vector branch; ///< m, from the centre of the second (its image; of a wall: the point) to that of the first
    scree_vector force;  ///< N, on the first
    double normal_force, tangential_force; ///< N
} scree_average_contact;

/// What belongs to one grain.
typedef struct scree_average_own {
    double moment[9], branches[9], normals[9], inertia[9], axis[9];
    uint32_t contacts;
} scree_average_own;

typedef struct scree_average_sample {
    int dimension;
    double thickness;     ///< m, of discs and prisms; 1 in 3D
    scree_vector gravity; ///< m/s2
    double time;          ///< s
    char stage[32];
    uint64_t directions; ///< in which it repeats itself: bits 0, 1, 2
    double lattice[9];   ///< m, lattice vectors as columns
    double reference[9]; ///< m, the same vectors when the loading began; zero: unknown
    scree_average_grain *grain;
    size_t count;
    size_t bodies; ///< of them; those behind are images
    scree_average_contact *contact;
    size_t contact_count, contacts; ///< in the same way
    double (*corner)[2];            ///< m, in the frames of the bodies
    size_t corner_count;
    double (*orientation)[4]; ///< 3D: quaternion of each body (integrate/orientation.h); NULL: none are kept
    double turned_since;      ///< s, time from which orientations and angles of round bodies count; NAN: unknown

    // ---- found by scree_average_sample_finish ----
    scree_average_own *own;   ///< a grain
    double margin;            ///< m, about the box within which there are images
    double lattice_change[9]; ///< m, of the lattice since an earlier instant
    double (*earlier)[9];     ///< N m, moments of the grains at an earlier instant (average/strain.h); NULL: unknown
    double (*turn)[4];        ///< quaternion of what each body has turned by since then; NULL: unknown
    size_t counted;           ///< so many grains are counted
    double mean_radius;       ///< m, of these
    double mean_volume;       ///< m2, m3
    double solid;             ///< m2, m3, of all of them
    double mass;              ///< kg
    double low[3], high[3];   ///< m, box that holds them; along directions in which it repeats itself the cell
    double mean_force;        ///< N, mean magnitude of a contact force
    double unbalanced_ratio;  ///< mean resultant on a grain that touches something over it
} scree_average_sample;

static inline bool scree_average_repeats(const scree_average_sample *sample, int direction)
{
    return sample->directions >> direction & 1;
}

/// Grains and contacts of a state. model: that of the stage, with the gravity that acts. Errors: memory.
scree_status scree_average_sample_of_state(const scree_model *model, const scree_state *state,
                                           const scree_contact_table *table, scree_average_sample *sample,
                                           scree_error *error) SCREE_MUST_USE;

/// Errors: SCREE_ERROR_INPUT without a grain, without a contact, or not a number; memory.
scree_status scree_average_sample_finish(scree_average_sample *sample, scree_error *error) SCREE_MUST_USE;

/// The same of a sample whose grains need not touch, for fields that contacts have no part in.
scree_status scree_average_sample_finish_loose(scree_average_sample *sample, scree_error *error) SCREE_MUST_USE;

/// Adds the images of a finished sample that repeats itself: of all bodies within `margin` [m] of the box from `low` to
/// `high` in which elements and points have their centres, which a cell that leans does not fill, and of their contacts.
/// Where there are images within less, they are found anew. Nothing happens to others. Errors: memory.
scree_status scree_average_sample_repeat(scree_average_sample *sample, double margin,
                                         scree_error *error) SCREE_MUST_USE;
void scree_average_sample_destroy(scree_average_sample *sample);

/// The corners of a polygon as it lies [m], relative to its centre, of its core where they are rounded; `placed` holds
/// corner_count.
void scree_average_outline(const scree_average_sample *sample, const scree_average_grain *grain, double (*placed)[2]);

/// Whether a body bounds the sample: it touches something, unless nothing does.
static inline bool scree_average_bounds(const scree_average_sample *sample, size_t body)
{
    return sample->own[body].contacts > 0 || sample->contacts == 0;
}

/// Lever of one end of a contact (0: of the first) [m]: from the centre to the point.
static inline void scree_average_lever(const scree_average_sample *sample, const scree_average_contact *contact,
                                       int end, scree_vector lever)
{
    for (int k = 0; k < 3; k++) {
        lever[k] = contact->point[k] - sample->grain[contact->first].position[k];
        if (end == 1) lever[k] += contact->branch[k];
    }
}

#endif
