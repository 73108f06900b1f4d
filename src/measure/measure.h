/// From contacts to continuum: everything here reads a state and a contact table and changes nothing.
/// Tensors are row-major 2 x 2 (xx, xy, yx, yy), tension POSITIVE; what a user sees of loading tests is compression
/// positive and is converted where it is written (run/sample.c).
#ifndef SCREE_MEASURE_MEASURE_H
#define SCREE_MEASURE_MEASURE_H

#include "contact/contact.h"

/// Area of the Delaunay boundary polygon through the centres [m2] (shoelace).
double scree_loop_area(const scree_state *state);

/// Area of the sample [m2]: bounded by the active plates where there are any (where their forces act) and by the loaded
/// edges of the Delaunay boundary elsewhere (through the centres, where the pressure acts). Without a loop: the box of
/// the plates.
double scree_sample_area(const scree_state *state);

/// Average stress from contacts (Christoffersen, Mehrabadi and Nemat-Nasser 1981):
/// sigma = -(1/(V)) sum_c f (x) l over contacts between bodies, V = area * thickness, plus the boundary term: bodies
/// that carry boundary forces (walls, pressure) add f_ext (x) (x - x_body_ref), see stress.c for why and with which V.
/// stress [Pa] out 4.
void scree_stress_from_contacts(const scree_model *model, const scree_state *state, const scree_work *work,
                                const scree_contact_table *table, double volume, double stress[4]);

/// Stress from what the boundary applies: plates along their normals, lateral pressure. [Pa], tension positive; NAN
/// where nothing is applied in that direction.
void scree_stress_from_plates(const scree_model *model, const scree_state *state, double stress[4]);

/// Displacement gradient of the interior of a loop from the displacements of its vertices (Bagi 1996; P 3.1-3.3):
/// (1/A) sum_edges (u_a + u_b)/2 (x) n L with the mid-configuration. x, y, ux, uy: count values around the loop.
void scree_loop_gradient(const double *x, const double *y, const double *ux, const double *uy, size_t count,
                         double gradient[4]);

/// Displacement gradient accumulated up to now (sum of increments over the current configuration, so its trace is the
/// logarithmic volume change): the closed increments in state->strain plus that of the present loop. Tension positive.
void scree_strain_measure(const scree_state *state, double gradient[4]);

typedef struct scree_coordination {
    double mean;                  ///< contacts per body, all bodies, walls counted
    double mean_without_rattlers; ///< over bodies with at least 2 contacts (3 with friction < infinity: see
                                  ///< coordination.c)
    double rattler_fraction;
} scree_coordination;
void scree_coordination_measure(const scree_state *state, const scree_contact_table *table, scree_coordination *out);

/// Mean |slip| over touching body-body contacts [m/s] (P fig. 2.4), and the fraction of sliding ones.
void scree_slip_measure(const scree_contact_table *table, double *mean_slip, double *sliding_fraction);

/// Largest and mean unbalanced force over the mean contact force.
double scree_unbalanced_ratio(const scree_model *model, const scree_state *state, const scree_contact_table *table);

/// Solid fraction inside the Delaunay boundary: disc areas (partial ones at the boundary by angle) over loop area.
double scree_solid_fraction(const scree_state *state);

typedef struct scree_energy {
    double kinetic, kinetic_rotation; ///< J
    double elastic_normal, elastic_tangential;
    double gravity;  ///< J, work of gravity since the ledger was opened: sum of m g . x minus ledger.gravity
    double residual; ///< J, of the balance
    double relative; ///< |residual| / turnover of work
} scree_energy;
/// Energies at step n by the scheme's own discrete definition (kinetic = 1/2 m v(n-1/2).v(n+1/2)), and the residual.
void scree_energy_measure(const scree_model *model, const scree_state *state, const scree_contact_table *table,
                          scree_energy *energy);

/// Displacement of each body relative to an affine field fitted by least squares to all displacements (P
/// figs. 2.6, 3.7). x0, y0, x1, y1: count [m]; fx, fy out: count [m]; gradient out: 2 x 2 of the affine part; returns
/// rms fluctuation [m].
double scree_fluctuations(const double *x0, const double *y0, const double *x1, const double *y1, size_t count,
                          double *fx, double *fy, double gradient[4]);

#endif
