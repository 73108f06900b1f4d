/// Displacement gradients of elements between two instants, by five definitions.
///
/// u = final - initial place (R 2.74 prints the opposite), X the initial place, l the initial vector from the centre of
/// the second body of a contact to that of the first; gradients G are d u_row / d x_column (R's epsilon_ij is its
/// transpose), strain is their symmetric part, extension positive. Each minimises the sum of squares over the grains
/// whose centres, or the contacts whose points, lie in the element:
///     cundall     u - mean u   against   G (X - mean X)              grains                        R 2.66
///     cambou      u_first - u_second   against   G l                 contacts of two grains        R 2.57
///     liao        the same of the two surfaces at the point of contact, u + (Q - 1) r with the turn Q of each grain
///                 and its initial lever r                            contacts of two grains        R 2.73
///     difference  mean u of the element and of those a side to the right, and above (in 3D behind, too): the one G
///     that
///                 agrees with all. R 2.76 divides by the distances of the elements; those of the mean initial places
///                 of the grains, as here, are needed for an affine motion to come out exactly
///     bagi        mean of the Delaunay cells of the initial centres (K. Bagi, Mech. Mater. 22, 165, 1996), each by its
///                 area inside the element, in 3D those whose centres lie inside
/// All are exact for an affine motion u = G X, of any size; a finite rotation Q gives G = Q - 1, whose symmetric part
/// is of second order. liao sees deformations of contacts: where all grains turn by Q it is Q^T (1 + G) - 1, so where
/// they turn with the whole it finds its stretch and nothing at all of a rotation, and where they do not turn it is
/// cambou. R 2.73 has a spin times a lever, which is this to first order in the turn; here turns may have any size, in
/// 2D by angles, in 3D by quaternions. NAN: too few grains or contacts, or all on a line; of liao, where turns are not
/// known: spheres without `measure.orientation`, and round grains whose rotations were set to zero between the two
/// instants, as the begin of a loading does (`turned_since`), but not where it did so at the first of them. A sample
/// that repeats itself takes each grain with the image that it came from: with x = H s, H the lattice, u = x - x_0 +
/// H_0 round(s_0 - s), and images H n away have moved by (H - H_0) n more. H_0 is the earlier lattice by the vectors of
/// H: a cell in shear changes them as it leans (boundary/periodic.c), which the lattices at the begin of the loading
/// tell, over any strain. Between two loadings, and where no such lattice is known, a cell must not lean over by half a
/// vector more. A grain that has moved by half a cell relative to the lattice is taken for its image.
#ifndef SCREE_AVERAGE_STRAIN_H
#define SCREE_AVERAGE_STRAIN_H

#include "average/bins.h"
#include "average/fields.h"
#include "measure/cells.h"

typedef struct scree_average_strain {
    const scree_average_sample *sample;
    const scree_average_bins *bins;
    size_t *begin;         ///< contacts of each body as their first: contact[begin[p]] to contact[begin[p + 1]]
    uint32_t *contact;     ///< numbers of contacts
    scree_cells cells;     ///< of the initial centres; none where there is no triangulation
    double (*gradient)[9]; ///< of each cell
    double inverse[9];     ///< 1/m, of the lattice where the sample repeats itself
    double *place;         ///< m, initial centres of what the cells are made of, x 3
} scree_average_strain;

/// Displacements of the grains of `sample` since `before`, by ids, and their turns, where they are known; where
/// `before` is finished, their moments then, too. Errors: SCREE_ERROR_INPUT: directions in which they repeat themselves
/// differ, or no grain is in both; memory.
scree_status scree_average_move(scree_average_sample *sample, const scree_average_sample *before,
                                scree_error *error) SCREE_MUST_USE;

/// What strains of elements need of a sample whose grains have moved. Errors: memory.
scree_status scree_average_strain_open(const scree_average_sample *sample, const scree_average_bins *bins,
                                       scree_average_strain *strain, scree_error *error) SCREE_MUST_USE;
void scree_average_strain_close(scree_average_strain *strain);

/// Gradients of an element by each definition.
enum {
    SCREE_AVERAGE_CUNDALL,
    SCREE_AVERAGE_CAMBOU,
    SCREE_AVERAGE_LIAO,
    SCREE_AVERAGE_DIFFERENCE,
    SCREE_AVERAGE_BAGI,
    SCREE_AVERAGE_STRAINS
};
void scree_average_strain_find(const scree_average_strain *strain, const scree_average_element *element,
                               scree_vector displacement, double gradient[SCREE_AVERAGE_STRAINS][9]);

/// Names of the definitions.
extern const char *const scree_average_strain_names[SCREE_AVERAGE_STRAINS];

/// Tells the mean displacement and all components of all gradients of an element.
void scree_average_strain_tell(int dimension, const scree_vector displacement,
                               double gradient[SCREE_AVERAGE_STRAINS][9], scree_average_sink *sink, void *user);

#endif
