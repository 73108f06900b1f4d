/// From contacts to continuum: everything here reads a state and a contact table and changes nothing. Of a part of a
/// sample (comm/parts.h) all processes call these functions, each with its bodies and its table, and have the numbers
/// of the whole, to the bit, unless a function says that it takes whole states alone. Tensors are row-major 3 x 3 (in
/// 2D all but xx = 0, xy = 1, yx = 3, yy = 4 are zero), tension POSITIVE; what a user sees of loading tests is
/// compression positive and is converted where it is written (run/sample.c).
#ifndef SCREE_MEASURE_MEASURE_H
#define SCREE_MEASURE_MEASURE_H

#include "contact/contact.h"
#include "measure/delaunay_boundary.h"
#include "state/periodic.h"

/// Area of the Delaunay boundary polygon through the centres [m2] (shoelace).
double scree_loop_area(const scree_state *state);

/// Area of the sample [m2]: bounded by the active plates where there are any (where their forces act) and by the loaded
/// edges of the Delaunay boundary elsewhere (through the centres, where the pressure acts). Without a loop: the box of
/// the plates. Of a periodic cell: its own. Outline in outline.h. With all four plates active: their box.
double scree_sample_area(const scree_state *state);

/// Volume of the sample [m3]: in 2D scree_sample_area * thickness; in 3D the same between plates and hull (hull.h).
double scree_sample_volume(const scree_model *model, const scree_state *state);

/// Average stress from contacts (Christoffersen, Mehrabadi and Nemat-Nasser 1981), walls included:
/// sigma = -(1/V) sum_c f (x) branch, f the force on `first`; volume V [m3] = scree_sample_volume. In
/// equilibrium equal to the stress that the boundary applies; in motion less by (1/V) sum m a (x) x: see stress.c.
/// stress [Pa] out 9: row the direction of the force, column that of the branch.
void scree_stress_from_contacts(const scree_state *state, const scree_contact_table *table, double volume,
                                double stress[9]);

/// Average stress from the boundary alone: wall contacts at their points, pressure at the bodies that carry it. The
/// exact counterpart of scree_stress_from_contacts. Of a whole state. stress [Pa] out 9.
void scree_stress_from_boundary(const scree_model *model, const scree_state *state, const scree_contact_table *table,
                                double stress[9]);

/// The same as far as an experimenter knows it, from the resultant forces on the plates and the pressure. Along the
/// normal of a plate it is exact (the vertical part of the pressure on inclined edges included); what needs to know
/// WHERE on a plate its forces act is missing: the plates' friction in the lateral stress, which so is exactly -p with
/// pressed sides. [Pa], tension positive; normal components NAN where nothing is applied in that direction, shear
/// components NAN with plates on all sides and otherwise taken to be symmetric. A whole periodic cell applies the
/// stress of contacts and motion together (state/periodic.h).
void scree_stress_from_plates(const scree_model *model, const scree_state *state, double stress[9]);

/// Displacement gradient of the interior of a loop from the displacements of its vertices (Bagi 1996; P 3.1-3.3):
/// (1/A) sum_edges (u_a + u_b)/2 (x) n L on the mid configuration x + u/2. Exact: trace = (A_new - A_old) / A_mid for
/// any motion; 2 (F - 1)(F + 1)^-1 for an affine map F; no symmetric part for a rigid rotation (polygon.h). x, y, ux,
/// uy: count values around the loop [m]; gradient out: xx, xy, yx, yy (d u_row / d x_column).
void scree_loop_gradient(const double *x, const double *y, const double *ux, const double *uy, size_t count,
                         double gradient[4]);

/// Displacement gradient accumulated up to now: the closed increments in *scree_strain_of(state) plus that of the
/// present loop. A sum of increments over the current configuration, so its trace is the logarithmic volume change of
/// the regions, without what re-detections change in what is enclosed (strain.c). Of a whole periodic cell the integral
/// of its velocity gradient. Tension positive.
void scree_strain_measure(const scree_state *state, double gradient[9]);

/// Re-detection of the boundary: the first call closes the increment of the present one and returns what it encloses
/// [m2, in 3D m3], the second accumulates in scree_strain_of(state)->redetected by how much the new one, at the same
/// positions, encloses more.
double scree_strain_close(scree_state *state);
void scree_strain_redetected(scree_state *state, double enclosed);

/// Logarithm of what the boundary encloses (2D: m2, 3D: m3), the polygon or polyhedron through the centres of its
/// bodies. Its change is that of the trace of scree_strain_measure plus that of
/// scree_strain_of(state)->redetected, to third order in the increments. NAN without a boundary.
double scree_enclosed_logarithm(const scree_state *state);

typedef struct scree_coordination {
    double mean;                  ///< contacts per body, all bodies, walls counted
    double mean_without_rattlers; ///< the same over bodies that are no rattlers and their contacts with such bodies
    double rattler_fraction;      ///< bodies that cannot be in equilibrium with the contacts they have: coordination.c
} scree_coordination;
/// work: of a part; of a whole state it may be NULL. Errors: memory.
scree_status scree_coordination_measure(const scree_model *model, const scree_state *state, const scree_work *work,
                                        const scree_contact_table *table, scree_coordination *out,
                                        scree_error *error) SCREE_MUST_USE;

/// Mean |slip| over touching body-body contacts [m/s] (P fig. 2.4), and the fraction of sliding ones; 0 without
/// contacts.
void scree_slip_measure(const scree_state *state, const scree_contact_table *table, double *mean_slip,
                        double *sliding_fraction);

/// Mean resultant force on the bodies that touch something, over the mean contact force. NAN without contact forces.
double scree_unbalanced_ratio(const scree_model *model, const scree_state *state, const scree_contact_table *table);

/// The same with the mean resultants since state->sampled_step; the instantaneous ratio at that step itself.
double scree_mean_unbalanced_ratio(const scree_model *model, const scree_state *state,
                                   const scree_contact_table *table);

/// Solid fraction inside the Delaunay boundary: disc areas (partial ones at the boundary by angle) over loop area,
/// sphere volumes over hull volume; of a periodic cell, all bodies over the cell. NAN without either. Errors: memory.
scree_status scree_solid_fraction(const scree_state *state, double *fraction, scree_error *error) SCREE_MUST_USE;

/// How far the corners of the sample leave the affine motion of all grains, since the begin of the loading stage
/// (state->reference): 1, relative to the width of the sample at the begin (corner_distortion.c). NAN in 3D.
typedef struct scree_corner_motion {
    double largest;          ///< over the four
    double root_mean_square; ///< of the four
    double rolling;          ///< 1, mean rotation of the grains there over that of all; NAN of those that are not round
} scree_corner_motion;

/// Errors: memory.
scree_status scree_corner_distortion(const scree_model *model, const scree_state *state,
                                     scree_corner_motion *distortion, scree_error *error) SCREE_MUST_USE;

/// How far the boundary of a round sample leaves the affine ghost of what it was at the begin of the loading stage
/// (state->reference): root mean square in mean diameters (boundary_roughness.c). NAN in 3D. Errors: memory.
scree_status scree_boundary_roughness(const scree_model *model, const scree_state *state, double *roughness,
                                      scree_error *error) SCREE_MUST_USE;

typedef struct scree_energy {
    double kinetic, kinetic_rotation; ///< J
    double elastic_normal, elastic_tangential;
    double gravity;  ///< J, work of gravity since the ledger was opened: sum of m g . x minus ledger.gravity
    double residual; ///< J, of the balance
    double scale;    ///< J, all energy that there is and was, and what round-off may make of none (energy.c)
    double relative; ///< |residual| / scale
} scree_energy;

/// Adds to ledger.scheme what a change of the step from `before` to `after` [s] does to the kinetic energy of the
/// scheme; between two steps.
void scree_energy_change_step(const scree_model *model, scree_state *state, double before, double after);

/// Energies at step n by the scheme's own discrete definition (kinetic = 1/2 m v(n-1/2).v(n+1/2)), and the residual.
void scree_energy_measure(const scree_model *model, const scree_state *state, const scree_contact_table *table,
                          scree_energy *energy);

/// Displacement of each body relative to an affine field fitted by least squares to all displacements (P
/// figs. 2.6, 3.7). from, to: dimension arrays of count [m], one a component; fluctuation out: the same [m]; gradient
/// out: dimension x dimension of the affine part; returns rms fluctuation [m].
double scree_fluctuations(int dimension, const double *const *from, const double *const *to, size_t count,
                          double *const *fluctuation, double *gradient);

/// The same in a whole periodic cell, between two states of one loading stage: relative to the affine field of the cell
/// itself and to the mean, between the ghosts that are nearest after it. Fluctuations must be less than half the cell.
double scree_periodic_fluctuations(const scree_periodic_cell *from_cell, const scree_periodic_cell *to_cell,
                                   int dimension, const double *const *from, const double *const *to, size_t count,
                                   double *const *fluctuation);

#endif
