/// How the rotation of one forced body travels through the contact network (P chapter 4): decay of the spins with
/// distance, the weighted directional tensor T and the rose of W around the forced body, and whether rotations follow
/// the force chains. Reads a state and its contact table and changes nothing.
#ifndef SCREE_MEASURE_ROTATION_H
#define SCREE_MEASURE_ROTATION_H

#include "contact/contact.h"

#include <stdbool.h>

enum {
    SCREE_ROTATION_BINS = 64,    ///< of the distance
    SCREE_ROTATION_SECTORS = 36, ///< of the rose
    SCREE_ROTATION_FORCES = 5,   ///< bins of the transmission per contact by its force
    SCREE_ROTATION_ANGLES = 6    ///< by its direction, of 15 degrees
};

/// How far the body in `row` has turned: 2D: |angle| [rad], over the time it was counted a mean spin, in which waves
/// and the to and fro of regularised friction cancel; 3D: |spin| now [rad/s].
double scree_rotation_amount(const scree_state *state, size_t row);

/// Whether the body in `row` can be turned by others and hold them: it touches two or more. One that touches none
/// keeps the spin that it once got and says nothing about transmission.
bool scree_rotation_counts(const scree_state *state, size_t row);

/// Mean amount of the bodies that count, the forced one left out: what turns without forcing, when nothing is forced.
double scree_rotation_mean_amount(const scree_state *state, size_t forced);

/// What there is without forcing, over the forced rotation; NAN: not known.
typedef struct scree_rotation_background {
    double mean;                       ///< 1, of all bodies that count
    double shell[SCREE_ROTATION_BINS]; ///< 1, of those in the shells of scree_rotation_decay
} scree_rotation_background;

/// The same of a state in which nothing is forced, over `scale`, which has the unit of an amount.
void scree_rotation_background_measure(const scree_model *model, const scree_state *state, size_t forced, double scale,
                                       scree_rotation_background *background);

/// Bodies whose distance from the forced one lies in [lower, lower + width).
typedef struct scree_rotation_bin {
    double lower;          ///< mean diameters
    double distance;       ///< mean diameters, mean of the bodies'
    double mean;           ///< 1, of the amount of rotation over that of the forced body
    double standard_error; ///< 1, of the mean; NAN with fewer than two bodies
    double felt;           ///< 1, the least mean that is felt
    size_t count;
} scree_rotation_bin;

/// Rotation over that of the forced body = amplitude exp(-r / length), with a confidence interval of 95 % (Student's
/// t).
typedef struct scree_rotation_decay {
    scree_rotation_bin bin[SCREE_ROTATION_BINS];
    size_t bin_count;
    double bin_width, first;        ///< mean diameters: of all bins; where the first one begins
    double limit;                   ///< 1, rotation over that of the forced body that a body feels
    double amplitude;               ///< 1; NAN when there is nothing to fit
    double length;                  ///< mean diameters
    double length_low, length_high; ///< mean diameters, ends of the interval; NAN with fewer than three bins
    double reach;                   ///< mean diameters, see scree_rotation_decay_measure
    size_t fitted;                  ///< bins that the fit has used
} scree_rotation_decay;

/// Shells of one mean diameter around the forced body, the first from half a diameter on (its neighbours), of the
/// bodies that count. A shell feels the forced body where its mean is at least FLOOR_FACTOR times both the background
/// (what there is in this shell without forcing, over the forced one; NULL or NAN: not known) and the median over the
/// outer half of the shells (what the sample does as a whole). `limit` is the same with the mean background of all
/// bodies. Reach: the outer edge of the last shell of the unbroken run that feels it. The fit over this run is
/// least squares of the logarithms of the means, weighted by the counts. forced: row. Errors: none. Source: P figure
/// 4.5.
#define SCREE_ROTATION_FLOOR_FACTOR 2.0
void scree_rotation_decay_measure(const scree_model *model, const scree_state *state, size_t forced,
                                  const scree_rotation_background *background, scree_rotation_decay *decay);

/// The shell at `distance` [mean diameters]; SCREE_ROTATION_BINS: none.
size_t scree_rotation_bin_at(double distance);

/// The force network around the forced body, within `cutoff` mean diameters (P uses 10).
typedef struct scree_rotation_network {
    double tensor[9];                        ///< 1/m, T of P 4.1, row-major; rows: direction of s, columns: of b
    double value[3];                         ///< 1/m, eigenvalues of Sym(T), falling; the third is 0 in 2D
    scree_vector axis[3];                    ///< their unit eigenvectors
    double rose[SCREE_ROTATION_SECTORS];     ///< 1/m, sum of W (P 4.2) in each sector
    double followed[SCREE_ROTATION_SECTORS]; ///< 1, mean of the rotation excess of the bodies in each sector; NAN: none
    double peak;                             ///< rad in (-pi/2, pi/2], direction of the peak of the rose; NAN in 3D
    size_t contacts;                         ///< in T and W
} scree_rotation_network;

/// T = sum_c s^ (x) b^ f / (|s| <f>) over the contacts between bodies whose branch has its middle within the cut-off,
/// s from the forced body to that middle, b the branch, f the magnitude of the contact force, <f> its mean over all
/// contacts between bodies. b is taken pointing away from the forced body (b . s >= 0): P leaves its sign open, and
/// with an arbitrary one the sum would depend on the numbering. W(b, theta) = s^ . b^ f / (|s| <f>).
/// Sectors: 2D: [0, 2 pi) of the angle of s against x in SCREE_ROTATION_SECTORS parts. 3D: the angle in [0, pi) between
/// s and the first axis, in parts of equal solid angle. `followed` is left NAN. The peak is that of the rose with
/// opposite sectors added, since an axis has no sense, and smoothed with the
/// weights 1, 2, 1. Errors: none.
void scree_rotation_network_measure(const scree_model *model, const scree_state *state,
                                    const scree_contact_table *table, size_t forced, double cutoff,
                                    scree_rotation_network *network);

/// A rank correlation (Spearman) and its interval of 95 % (Fisher's z with the variance of Bonett and Wright 2000).
typedef struct scree_rank_correlation {
    double value, low, high; ///< NAN with fewer than four pairs
    size_t count;
} scree_rank_correlation;

/// A ratio of geometric means and its interval of 95 % (normal).
typedef struct scree_rotation_ratio {
    double value, low, high; ///< NAN where one of the groups is empty
    size_t behind, elsewhere;
} scree_rotation_ratio;

/// Whether rotations follow the force chains: over the bodies that count within `cutoff` and the reach of the decay,
/// the rotation excess is log(amount) less its mean in the same shell.
/// `chains`: its mean in each sector, which goes into network->followed, against the rose of W.
/// `alignment`: that of each body against sum f (2 (s^ . b^)^2 - 1) / sum f over its contacts (+1: all forces radial, a
/// chain that leads away from the forced body; -1: all tangential, a chain across); in 3D with (3 (s^ . b^)^2 - 1) / 2.
/// `across`, 2D only: amount behind a strong chain over that elsewhere in the same shell. Behind: the straight line
/// from the forced body crosses a contact of other bodies that bears more than the mean force and is inclined to the
/// line by more than 45 degrees. Shells with both kinds are put together with the weights n n' / (n + n').
/// Errors: memory.
typedef struct scree_rotation_alignment {
    scree_rank_correlation chains, alignment;
    scree_rotation_ratio across;
} scree_rotation_alignment;
scree_status scree_rotation_alignment_measure(const scree_model *model, const scree_state *state,
                                              const scree_contact_table *table, size_t forced, double cutoff,
                                              const scree_rotation_decay *decay, scree_rotation_network *network,
                                              scree_rotation_alignment *alignment, scree_error *error) SCREE_MUST_USE;

/// A geometric mean over contacts; NAN without any.
typedef struct scree_rotation_handed {
    double value;
    double low, high; ///< its interval of 95 % (normal, of the logarithms); NAN with fewer than two
    double force;     ///< 1, mean of the forces over the mean force
    double angle;     ///< rad, mean of the angles to the major direction of the stress
    size_t count;
} scree_rotation_handed;

/// Transmission per contact: amount of the body further from the forced one over that of the nearer one, over the
/// contacts of bodies that count, whose nearer one lies within `cutoff` mean diameters and turns by at least `limit` of
/// the forced one (what is felt: the decay's); contacts of the forced body, whose spin is prescribed, are left out.
/// The major direction is that of the largest compression of the sample, from the forces of all its contacts. A strong
/// chain crosses a body where another contact of it bears more than the mean force and is inclined to the branch by
/// more than 45 degrees (P 4.4: rotations are not propagated across strong force chains).
typedef struct scree_rotation_transmission {
    scree_rotation_handed strong, weak; ///< contacts that lead outward within 45 degrees: above the mean force, others
    scree_rotation_handed aside;        ///< the rest
    scree_rotation_handed crossed;      ///< of those that lead outward: to a body that a strong chain crosses
    scree_rotation_handed open;         ///< the others of them
    scree_rotation_handed by_force[SCREE_ROTATION_FORCES]; ///< all of them, between scree_rotation_force_edges
    scree_rotation_handed by_angle[SCREE_ROTATION_ANGLES]; ///< all, by the angle of the branch to the major direction
    double major[3];                                       ///< unit vector
} scree_rotation_transmission;

/// Ends of the bins of by_force, in mean forces; the last is infinite.
extern const double scree_rotation_force_edges[SCREE_ROTATION_FORCES + 1];

/// Errors: none.
void scree_rotation_transmission_measure(const scree_model *model, const scree_state *state,
                                         const scree_contact_table *table, size_t forced, double cutoff, double limit,
                                         scree_rotation_transmission *out);

#endif
