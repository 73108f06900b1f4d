/// Delaunay cells of an assembly (triangles; tetrahedra in 3D) as finite elements: velocity gradient and stress of
/// each.
///
/// P 2.5: with the velocities of its nodes, the centres of the particles, a cell has exactly one velocity gradient, and
/// the stress of Christoffersen et al. (1981) is its work conjugate: the assembly is a mesh of constant-strain elements
/// (Bagi 1996, Satake 2004). Cells are those of the Delaunay triangulation of all centres that lie inside the boundary
/// (loop or hull), which is found anew from the same positions, with the memory of the one before where there is one:
/// what is between the boundary and the plates has no cell.
///
/// Tensors are row-major 3 x 3, tension positive; in 2D all but xx, xy, yx, yy are zero.
#ifndef SCREE_MEASURE_CELLS_H
#define SCREE_MEASURE_CELLS_H

#include "contact/contact.h"
#include "search/peel_rule.h"
#include "shape/outlines.h"

/// Grains in the order of their ids (the bodies of a membrane are left out).
typedef struct scree_assembly {
    int dimension;
    double thickness; ///< m, of discs; 1 in 3D
    size_t count;
    uint32_t *id;            ///< ascending; NULL: 0 .. count - 1
    double *position;        ///< m, count x 3; z = 0 in 2D
    double *radius;          ///< m, equivalent
    scree_outlines outlines; ///< of the grains, between which gaps are
} scree_assembly;

/// Positions and radii of the grains of a state; free with scree_assembly_destroy. Errors: memory.
scree_status scree_assembly_of_state(const scree_model *model, const scree_state *state, scree_assembly *assembly,
                                     scree_error *error) SCREE_MUST_USE;
void scree_assembly_destroy(scree_assembly *assembly);

typedef struct scree_cells {
    int dimension;
    size_t count;
    size_t bodies;               ///< of the assembly
    uint32_t *id;                ///< of these bodies; NULL: 0 .. bodies - 1
    uint32_t (*node)[4];         ///< places in the assembly, positively oriented; in 2D the fourth is UINT32_MAX
    int32_t (*neighbour)[4];     ///< cell across the face opposite to each node; -1: none
    double *volume;              ///< m3; in 2D area times thickness
    double (*gradient)[9];       ///< 1/s, velocity gradient d v_row / d x_column; NULL until measured
    double (*stress)[9];         ///< Pa, row the direction of the force; NULL until measured
    double *distortion;          ///< 1/s, L_II of `gradient`
    double *pressure;            ///< Pa, p of `stress`, compression positive
    size_t crossing, unassigned; ///< contacts that are no edge of a cell; of these, those that meet no cell at all
} scree_cells;

/// Cells inside the boundary of the assembly at its positions: the loop of search/delaunay.h, the surface of
/// search/tetrahedra.h. rule: limits of gaps and slivers, in places of the assembly, whose outlines are taken. Errors:
/// memory, no triangulation. Cost: O(n log n): Delaunay is nearly all of it.
scree_status scree_cells_build(const scree_assembly *assembly, const scree_peel_rule *rule, scree_cells *cells,
                               scree_error *error) SCREE_MUST_USE;
void scree_cells_destroy(scree_cells *cells);

/// Gradient of the linear interpolation of `value` in each cell, at the positions `position` (both bodies x 3): the
/// velocity gradient from velocities; the displacement gradient between two instants from displacements and the
/// positions of the first. Exact for affine fields; its mean over the volume is that of the boundary (Bagi) to
/// round-off. gradient out: count. Cost: O(cells).
void scree_cells_gradient(const scree_cells *cells, const double *position, const double *value, double (*gradient)[9]);

/// Volume [m3 or m2 in 2D, without thickness] of cell k at other positions; negative when it has turned over.
double scree_cell_volume_at(const scree_cells *cells, size_t k, const double *position);

/// Distortion of a tensor: the square root of the second invariant of its deviatoric symmetric part,
/// sqrt(1/2 D : D), D = sym(T) - tr(T)/d 1. Of a velocity gradient it is the distortion rate L_II [1/s]: half the rate
/// of shear of a pure shear, zero for rigid rotation and for uniform compression.
double scree_distortion(const double tensor[9], int dimension);

/// Distortion of a finite deformation with displacement gradient G: the same invariant of the stretch U of F = 1 + G =
/// R U, so that rotations of any size before or after do not show. In 2D it is scree_distortion(G), exactly.
double scree_finite_distortion(const double gradient[9], int dimension);

/// Distortion of each cell on the way of its bodies from `first` to `second` (bodies x 3, m); *distortion is allocated.
/// Errors: memory.
scree_status scree_cells_window_distortion(const scree_cells *cells, const double *first, const double *second,
                                           double **distortion, scree_error *error) SCREE_MUST_USE;

/// Stress of each cell from the contacts between grains; those with walls and with a membrane lie outside all cells. A
/// contact contributes
/// force (x) branch: that of an edge spread evenly over the cells around it (shares as their volumes), that of any
/// other contact to the cells that its branch crosses, in proportion to the lengths in them. Then exactly
///     sum_cells V stress = - sum_contacts f (x) branch,
/// and sum_cells V stress : gradient = sum_contacts f . (v_second - v_first) where all branches run inside. A branch
/// that meets no cell gives to the cells of its two ends. stress out: count. Errors: memory.
scree_status scree_cells_stress(scree_cells *cells, const scree_state *state, const scree_contact_table *table,
                                double (*stress)[9], scree_error *error) SCREE_MUST_USE;

/// Builds the cells of a state and measures everything: velocity gradient, stress, distortion rate, pressure.
scree_status scree_cells_measure(const scree_model *model, const scree_state *state, const scree_contact_table *table,
                                 scree_cells *cells, scree_error *error) SCREE_MUST_USE;

/// Mean over the volume of a value of each cell; NAN without cells.
double scree_cells_mean(const scree_cells *cells, const double *value);

/// Centre of volume of cell k [m].
void scree_cell_centre(const scree_cells *cells, size_t k, const double *position, scree_vector centre);

/// Cells of each body as a list: those of body i are cell[begin[i]] .. cell[begin[i + 1] - 1].
typedef struct scree_node_cells {
    uint32_t *begin, *cell;
} scree_node_cells;
scree_status scree_node_cells_build(const scree_cells *cells, scree_node_cells *list,
                                    scree_error *error) SCREE_MUST_USE;
void scree_node_cells_destroy(scree_node_cells *list);

/// Growing circles (spheres in 3D) around `centre`: of diameter step, 2 step, ... count step. pressure out [Pa]: mean
/// of the cells whose centres lie within, NAN without any; volume out [m3]: theirs (P fig. 3.12). Cost: O(cells +
/// count).
void scree_cells_circles(const scree_cells *cells, const double *position, const scree_vector centre, double step,
                         size_t count, double *pressure, double *volume);

/// Parts of a sample: near the plates, near the sides, the core; the rest (cell_regions.c).
typedef enum scree_cell_region {
    SCREE_REGION_ELSEWHERE,
    SCREE_REGION_PLATES,
    SCREE_REGION_SIDES,
    SCREE_REGION_CORE,
    SCREE_REGION_COUNT
} scree_cell_region;

/// Mean over the volume of the cells of each part; NAN for a part without cells. Cost: O(cells).
void scree_cells_region_means(const scree_cells *cells, const double *position, const double *value,
                              double mean[SCREE_REGION_COUNT]);

#endif
