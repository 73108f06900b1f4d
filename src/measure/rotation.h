/// How the rotation of one forced body travels through the contact network (P chapter 4): decay of the spins with
/// distance, the weighted directional tensor T and the rose of W around the forced body, and whether rotations follow
/// the force chains. Reads a state and its contact table and changes nothing.
#ifndef SCREE_MEASURE_ROTATION_H
#define SCREE_MEASURE_ROTATION_H

#include "contact/contact.h"

enum {
    SCREE_ROTATION_BINS = 64,   ///< of the distance
    SCREE_ROTATION_SECTORS = 36 ///< of the rose
};

/// Bodies whose distance from the forced one lies in [lower, lower + width).
typedef struct scree_rotation_bin {
    double lower;          ///< mean diameters
    double mean;           ///< 1, of |w| / |w_forced|
    double standard_error; ///< 1, of the mean; NAN with fewer than two bodies
    size_t count;
} scree_rotation_bin;

/// |w|/|w_forced| = amplitude exp(-r / length), with a confidence interval of 95 % (Student's t).
typedef struct scree_rotation_decay {
    scree_rotation_bin bin[SCREE_ROTATION_BINS];
    size_t bin_count;
    double bin_width;               ///< mean diameters
    double amplitude;               ///< 1; NAN when there is nothing to fit
    double length;                  ///< mean diameters
    double length_low, length_high; ///< mean diameters, ends of the interval; NAN with fewer than three bins
    double reach;                   ///< mean diameters, see scree_rotation_decay_measure
    size_t fitted;                  ///< bins that the fit has used
} scree_rotation_decay;

/// Bins of half a mean diameter from the nearest neighbours to the boundary of the assembly. The fit is least squares
/// of the logarithms of the bins' means, weighted by their counts, over the bins whose mean stands above FLOOR_FACTOR
/// times the median of the outer half (the spins that are there anyway), the first gap ends it. Reach: the outer
/// edge of the last bin of that run. forced: row. Errors: none. Source: P figure 4.5.
#define SCREE_ROTATION_FLOOR_FACTOR 2.0
void scree_rotation_decay_measure(const scree_model *model, const scree_state *state, size_t forced,
                                  scree_rotation_decay *decay);

/// The force network around the forced body, within `cutoff` mean diameters (P uses 10).
typedef struct scree_rotation_network {
    double tensor[9];                        ///< 1/m, T of P 4.1, row-major; rows: direction of s, columns: of b
    double value[3];                         ///< 1/m, eigenvalues of Sym(T), falling; the third is 0 in 2D
    scree_vector axis[3];                    ///< their unit eigenvectors
    double rose[SCREE_ROTATION_SECTORS];     ///< 1/m, sum of W (P 4.2) in each sector
    double followed[SCREE_ROTATION_SECTORS]; ///< 1, mean of the rotation excess of the bodies in each sector; NAN: none
    size_t contacts;                         ///< in T and W
} scree_rotation_network;

/// T = sum_c s^ (x) b^ f / (|s| <f>) over the contacts between bodies whose branch has its middle within the cut-off,
/// s from the forced body to that middle, b the branch, f the magnitude of the contact force, <f> its mean over all
/// contacts between bodies. b is taken pointing away from the forced body (b . s >= 0): P leaves its sign open, and
/// with an arbitrary one the sum would depend on the numbering. W(b, theta) = s^ . b^ f / (|s| <f>).
/// Sectors: 2D: [0, 2 pi) of the angle of s against x in SCREE_ROTATION_SECTORS parts. 3D: the angle in [0, pi) between
/// s and the first axis, in parts of equal solid angle. `followed` is left NAN. Errors: none.
void scree_rotation_network_measure(const scree_model *model, const scree_state *state,
                                    const scree_contact_table *table, size_t forced, double cutoff,
                                    scree_rotation_network *network);

/// A rank correlation (Spearman) and its interval of 95 % (Fisher's z with the variance of Bonett and Wright 2000).
typedef struct scree_rank_correlation {
    double value, low, high; ///< NAN with fewer than four pairs
    size_t count;
} scree_rank_correlation;

/// Whether rotations follow the force chains: over the bodies within `cutoff` that stand above the floor of the decay,
/// `along` correlates the rotation excess log(|w| / mean |w| at that distance) with the alignment of the body's chains
/// sum f (2 (s^ . b^)^2 - 1) / sum f (+1: all forces radial, a chain that leads away from the forced body; -1: all
/// tangential, a chain across); in 3D with (3 (s^ . b^)^2 - 1) / 2. `sectors` correlates the rose of W with the mean
/// excess of the sectors, which it writes into network->followed. Errors: memory.
typedef struct scree_rotation_alignment {
    scree_rank_correlation along, sectors;
} scree_rotation_alignment;
scree_status scree_rotation_alignment_measure(const scree_model *model, const scree_state *state,
                                              const scree_contact_table *table, size_t forced, double cutoff,
                                              const scree_rotation_decay *decay, scree_rotation_network *network,
                                              scree_rotation_alignment *alignment, scree_error *error) SCREE_MUST_USE;

#endif
