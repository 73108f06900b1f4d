/// Response of a layer to a load along cuts at several depths, beside elastic theories (average/response.h,
/// theory/layer.h).
#ifndef SCREE_RUN_RESPONSE_CURVES_H
#define SCREE_RUN_RESPONSE_CURVES_H

#include "average/response.h"
#include "theory/layer.h"

enum { SCREE_RESPONSE_LEVELS = 8, SCREE_RESPONSE_POINTS = 161 };

typedef enum scree_response_curve {
    SCREE_RESPONSE_VERTICAL,   ///< Pa
    SCREE_RESPONSE_HORIZONTAL, ///< Pa
    SCREE_RESPONSE_STRAIN,     ///< 1, vertical, compression positive, by Delaunay cells
    SCREE_RESPONSE_HALF_SPACE, ///< Pa, vertical; means over the same elements, as all theories
    SCREE_RESPONSE_SMOOTH,
    SCREE_RESPONSE_BONDED,
    SCREE_RESPONSE_HALF_SPACE_HORIZONTAL,
    SCREE_RESPONSE_SMOOTH_HORIZONTAL,
    SCREE_RESPONSE_BONDED_HORIZONTAL,
    SCREE_RESPONSE_CURVES
} scree_response_curve;

/// A cut: values at x = k gap, the mean of both sides of the load.
typedef struct scree_response_level {
    double depth;   ///< m, of the middle of its elements
    double missing; ///< 1, scree_response_missing
    double value[SCREE_RESPONSE_CURVES][SCREE_RESPONSE_POINTS];
    double left[SCREE_RESPONSE_POINTS], right[SCREE_RESPONSE_POINTS]; ///< Pa, vertical, at -x and x
    scree_response_peak peak[SCREE_RESPONSE_CURVES];
    double centre[SCREE_RESPONSE_CURVES]; ///< mean within a fifth of the depth of the load
    double beside;                        ///< Pa, mean vertical response from 2/5 to 4/5 of the depth beside it
    double reach;                         ///< m, distance from the load within which half of the vertical response lies
} scree_response_level;

typedef struct scree_response_curves {
    double thickness;                                  ///< m, of the layer, from its top
    double gap;                                        ///< m
    size_t count;                                      ///< of points
    scree_response_level level[SCREE_RESPONSE_LEVELS]; ///< at (k + 1) / LEVELS of the thickness
} scree_response_curves;

/// r: opened; the loaded sample with displacements (scree_average_move) and finished. poisson: of the bonded layer.
/// Errors: memory.
scree_status scree_response_curves_find(const scree_response *r, double poisson, scree_response_curves *curves,
                                        scree_error *error) SCREE_MUST_USE;

/// p in reach ~ depth^p, by least squares of the logarithms; NAN with fewer than three.
double scree_response_widening(const scree_response_curves *curves);

/// Root of the mean square difference of the vertical response at the base and a theory within a thickness of the load,
/// over its peak; of the horizontal response where the curve of the theory is.
double scree_response_misfit(const scree_response_curves *curves, scree_response_curve theory);

#endif
