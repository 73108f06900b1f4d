/// How localised a field of distortion is, and the shear band in it, if there is one: numbers instead of looks.
#ifndef SCREE_MEASURE_LOCALISATION_H
#define SCREE_MEASURE_LOCALISATION_H

#include "measure/cells.h"

/// Spreads a value of each cell over the Delaunay graph: `passes` times from cells to bodies (mean over the volume of
/// their cells) and back (mean over the nodes). The sum of volume x value stays, and a uniform field. One pass spreads
/// by about half a diameter, p passes by sqrt(p) times that. value in and out: cells->count; body out: the last means,
/// cells->bodies values (may be NULL; NAN for bodies without cells). passes >= 1. Errors: memory. Cost: O(passes
/// cells).
scree_status scree_cells_smooth(const scree_cells *cells, const scree_node_cells *list, int passes, double *value,
                                double *body, scree_error *error) SCREE_MUST_USE;

/// 1 - (sum V g)^2 / (sum V sum V g^2), g >= 0: one minus the share of the volume that takes part. 0: uniform; 1: all
/// of it in vanishing volume; 1 - f: uniform in a fraction f of the volume and zero elsewhere. 0 for a field of zeros.
double scree_localisation_index(const scree_cells *cells, const double *value);

/// A slab n . x in [offset - thickness/2, offset + thickness/2].
typedef struct scree_band {
    bool found;             ///< meets the limits of localisation.c
    scree_vector normal;    ///< unit; the last non-zero component is positive
    double offset;          ///< m, of the middle, along the normal from the centre of volume of the cells
    double thickness;       ///< m
    double angle;           ///< degrees, between the band and the axial direction, 0 to 90
    double volume_fraction; ///< of the cells
    double share;           ///< of the distortion
    double contrast;        ///< mean distortion inside over outside
    double explained;       ///< share of the variance of the field that the two means explain, 0 to 1
    double percolation;     ///< length of the largest connected active part of the band over that of the band, 0 to 1
} scree_band;

/// Distortion between two instants, what is measured on it.
typedef struct scree_localisation {
    double mean_distortion;  ///< 1, over the volume
    double index;            ///< of the smoothed field
    double index_random;     ///< mean over fields with the same values at random places
    double significance;     ///< (index - index_random) / standard deviation of the random ones
    double explained_random; ///< largest `explained` of a band in these random fields
    bool localised;          ///< index and significance meet the limits of localisation.c
    scree_band band;
} scree_localisation;

/// The smallest band that is looked for and the reach of smoothing follow from the mean diameter [m]. place: m, bodies
/// x 3, at the first instant. distortion: of each cell. body_field out: cells->bodies, smoothed distortion at the
/// bodies; in_band out: cells->bodies, 1 for bodies inside the band when it is found. Errors: memory. Cost:
/// O(directions x cells): 0.1 s for 4000 discs, 1 s for 8000 spheres.
scree_status scree_localisation_measure(const scree_cells *cells, const double *position, const double *distortion,
                                        double diameter, scree_localisation *out, double *body_field, uint8_t *in_band,
                                        scree_error *error) SCREE_MUST_USE;

/// The slab that explains most of the variance of `value`, by least squares over all directions, places and
/// thicknesses from `thinnest` to a third of the extent; fills all of `band` but percolation and found. `step`: m,
/// width of the bins. fine: refine the direction to a quarter of a degree. Errors: memory.
scree_status scree_band_fit(const scree_cells *cells, const double *position, const double *value, double thinnest,
                            double step, bool fine, scree_band *band, scree_error *error) SCREE_MUST_USE;

/// How much two windows have in common at the same material points.
/// Correlation of two fields over the bodies for which both are finite (Pearson); NAN without variance.
double scree_field_correlation(const double *first, const double *second, size_t count);
/// Bodies in both bands over bodies in either; 0 when there is none.
double scree_band_overlap(const uint8_t *first, const uint8_t *second, size_t count);

typedef enum scree_band_kind { SCREE_BANDS_NONE, SCREE_BANDS_INTERMITTENT, SCREE_BANDS_PERSISTENT } scree_band_kind;

/// One strain window of a loading stage.
typedef struct scree_band_window {
    scree_localisation localisation;
    double correlation, overlap; ///< with the window before; NAN for the first
} scree_band_window;

/// Kind of the localisation over the second half of the windows (at least the last two): persistent when in at least
/// two thirds of its pairs of consecutive windows both have bands that percolate and they overlap, or the fields are
/// correlated, by half or more; else intermittent when any of its windows is localised or has a band; else none.
/// *persistence: mean over its pairs of the larger of overlap and correlation, counting 0 where a window has no
/// percolating band; NAN with fewer than two windows.
scree_band_kind scree_bands_classify(const scree_band_window *window, size_t count, double *persistence);

#endif
