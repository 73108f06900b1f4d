/// A pile: the grains that rest on something that stands, their outline, height and width, and angles of repose.
///
/// Which grains. Those that hang together by contacts with a wall, a plate or a body whose velocity is prescribed, or
/// with such a grain: what falls is left out. Of walls only the plate counts where one is named, so that what slides
/// down a funnel is no pile yet. They are the pile as a whole; its heap is what lies around its highest
/// grain without a gap of more than a mean diameter: single grains that have rolled away have no part in widths and
/// angles.
///
/// Outline. The height of the surface in columns of a mean radius at most, which reach from one outermost grain to the
/// other, seen along y in 3D: the highest point that the outlines of grains have anywhere within the column
/// (shape/outline_extent.h), above the base, which is the lowest point where a grain touches what stands. Up is the
/// last axis.
///
/// Angles of repose [rad], left and right:
///   by the corners (R 3.1.1: "base angles")  the slope of the line from the foot of the heap, where its outermost
///                                            grain ends, to its highest point
///   by a fit                                 of least squares through the surface between a tenth and nine tenths of
///                                            the height; NAN with less than 3 columns
/// Of a pile with a plateau the corners give less than the slopes have, and the fit leaves the plateau out.
///
/// Solid fraction of the heap: area (volume) of its grains over that under its surface; coordination: contacts a grain
/// of the pile, those with what stands among them; share of the middle: of the force on the plate what acts on the
/// middle third of the foot.
///
/// Limits: a column has the height of its highest place, so that the surface lies somewhat outside; beside grains that
/// have rolled away the heap ends where its last column does. Cost: linear in contacts and corners.
#ifndef SCREE_MEASURE_PILE_H
#define SCREE_MEASURE_PILE_H

#include "contact/contact.h"

/// A column of the outline.
typedef struct scree_pile_column {
    double x, height; ///< m, its middle; of its surface above the base, NAN: no grain
} scree_pile_column;

typedef struct scree_pile {
    bool of_circles; ///< lengths, angles and solid fraction are those of bounding circles, not of outlines
    uint8_t *member; ///< a row: 1: it is a grain of the pile that nothing prescribes
    size_t grains;
    size_t hanging;     ///< contacts of other grains with walls that are not the plate
    double weight;      ///< N
    double support;     ///< N, upward force on these grains of what stands, and of the plate alone
    double plate;       ///< N
    double base, top;   ///< m, along the last axis
    double left, right; ///< m, ends of the heap
    double apex;        ///< m, place of the top
    double angle[2], fitted[2];
    double solid_fraction, coordination, middle; ///< 2D, 1, 1
    scree_pile_column *column;
    size_t columns;
} scree_pile;

/// Measures the pile; without a grain in it all lengths and angles are NAN. plate: number of a wall of the case, the
/// force of which is asked for; -1: of all that stands. Errors: memory.
scree_status scree_pile_measure(const scree_model *model, const scree_state *state, const scree_work *work,
                                const scree_contact_table *table, int plate, scree_pile *pile,
                                scree_error *error) SCREE_MUST_USE;

/// The same, of all that stands, with the bounding circles of polygons in place of their outlines: what decides births
/// (source/pour.h), which are in free space of bounding circles; no measure of a pile.
scree_status scree_pile_measure_circles(const scree_model *model, const scree_state *state, const scree_work *work,
                                        const scree_contact_table *table, scree_pile *pile,
                                        scree_error *error) SCREE_MUST_USE;
void scree_pile_destroy(scree_pile *pile);

/// Narrows `left` and `right`, the ends of its plateau [m], to the outermost columns between them that are not more
/// than `depth` [m] below the mean level of the surface there; a column without a grain is as low as the base. Neither
/// the highest grain nor gaps decide, so that a rough or sparse top keeps its width.
void scree_pile_plateau(const scree_pile *pile, double depth, double *left, double *right);

#endif
