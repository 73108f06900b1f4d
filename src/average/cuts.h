/// Where averages are taken: elements along horizontal cuts of a sample, and on a grid.
///
/// The element is a square (a cube) that holds so many grains at the mean number density of the sample, or has a given
/// side. Cut k of n lies at the relative height z_k, its elements centred at
///     base + side / 2 + z_k (height - side),    z_k = k / n unless the heights are given,
/// so that the elements of the lowest cut stand on the base. Along a cut centres lie at x = axis + place * half, with
/// places from -1 to 1 and half the half width of the heap: the same places in every sample, so that those of an
/// ensemble can be averaged, and mirror images of each other about the axis. In 3D cuts run along x in the middle of y.
#ifndef SCREE_AVERAGE_CUTS_H
#define SCREE_AVERAGE_CUTS_H

#include "average/fields.h"
#include "average/strain.h"
#include "average/table.h"

enum { SCREE_AVERAGE_CUTS = 64, SCREE_AVERAGE_SIZES = 32 };
enum { SCREE_AVERAGE_FEW = 30 }; ///< grains of an element; averages over fewer are noise

typedef enum scree_average_axis {
    SCREE_AVERAGE_AXIS_MASS, ///< x of the centre of mass
    SCREE_AVERAGE_AXIS_APEX, ///< of the highest grain
    SCREE_AVERAGE_AXIS_GIVEN
} scree_average_axis;

/// Where the places of a sample are; time averages take those of their first instant for all.
typedef struct scree_average_frame {
    double side;            ///< m, of the element
    double axis, half;      ///< m
    double base, height;    ///< m
    double middle;          ///< m, of y in 3D
    scree_vector low, high; ///< m, of the map
} scree_average_frame;

typedef struct scree_average_plan {
    const scree_average_frame *frame;  ///< NULL: the sample's own
    unsigned fields;                   ///< of SCREE_AVERAGE_DENSITY ...
    double grains;                     ///< in an element; 0: `side` says
    double side;                       ///< m
    bool fits;                         ///< no element is larger than the sample: it holds fewer grains
    size_t cuts;                       ///< number
    double height[SCREE_AVERAGE_CUTS]; ///< relative, 0 to 1
    size_t points;                     ///< of a cut, odd
    scree_average_axis axis;
    double axis_given;                ///< m
    size_t sizes;                     ///< elements of so many sizes about one place (average/sizes.h)
    double size[SCREE_AVERAGE_SIZES]; ///< their grains
    int threads;                      ///< that find elements; less than 1: one
    size_t grid[3]; ///< 0: no map; with grid[2] 0 the second number is that of rows upwards, in the middle of y in 3D
} scree_average_plan;

/// What a sample looks like to its averages.
typedef struct scree_average_view {
    const scree_average_sample *sample;
    scree_average_surface surface;
    scree_average_bins bins;
    scree_average_strain strain; ///< where `moved`
    bool moved;
    scree_average_frame frame;
    double grains;        ///< that an element holds at the mean density
    double bulk_density;  ///< kg/m3, of the sample with its voids
    double weight, plate; ///< N, of its grains; upward force of what is no grain on them
} scree_average_view;

/// Looks at a finished sample, which stays with the caller. Errors: SCREE_ERROR_INPUT with field `element` when it is
/// larger than the sample; memory. Strains are told where grains have displacements (scree_average_move).
scree_status scree_average_view_open(scree_average_sample *sample, const scree_average_plan *plan,
                                     scree_average_view *view, scree_error *error) SCREE_MUST_USE;
void scree_average_view_close(scree_average_view *view);

/// Whether an element holds fewer grains than SCREE_AVERAGE_FEW. Its number is a side squared over the room of a grain:
/// round-off of it is no grain less.
bool scree_average_are_few(double grains);

/// Where element `k` of a table lies: its centre and side [m]; with a table it tells what a row begins with, too.
typedef void scree_average_placing(void *user, size_t k, scree_vector centre, double *side, scree_average_table *table);

/// Rows of `count` elements: what `place` tells of each, and the fields. Threads of the plan find elements in blocks,
/// one thread tells them in their order: the same bits for any number of threads. Errors: memory.
scree_status scree_average_elements_table(const scree_average_view *view, const scree_average_plan *plan, size_t count,
                                          scree_average_placing *place, void *user, scree_average_table *table,
                                          scree_error *error) SCREE_MUST_USE;

/// Points of the grid along x, y, z.
void scree_average_grid(const scree_average_plan *plan, int dimension, size_t number[3]);

/// Rows of all cuts: cut, height [1], y (z in 3D) [m], place [1], x [m], and the fields; with stress also
/// `vertical_pressure_scaled`, minus the vertical normal stress over bulk_density g height. Errors: memory.
scree_status scree_average_cuts_table(const scree_average_view *view, const scree_average_plan *plan,
                                      scree_average_table *table, scree_error *error) SCREE_MUST_USE;

/// Rows of the grid, which spans the sample from end to end: x, y (z) [m], and the fields. Errors: memory.
scree_status scree_average_map_table(const scree_average_view *view, const scree_average_plan *plan,
                                     scree_average_table *table, scree_error *error) SCREE_MUST_USE;

/// Sum over a row of elements side by side that stand on the base of the vertical pressure times their width: what the
/// averages say of the force on what the sample stands on [N]; and the same of the weights, from the grains alone: of
/// what lies above, mean over the height of the elements.
void scree_average_plate_force(const scree_average_view *view, double *averages, double *weight);

#endif
