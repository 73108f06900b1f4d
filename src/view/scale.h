/// Numbers for figures: round values, robust limits, ticks, and their text.
#ifndef SCREE_VIEW_SCALE_H
#define SCREE_VIEW_SCALE_H

#include "base/error.h"

#include <stdbool.h>

/// Largest 1, 2 or 5 times a power of ten that is not above `value` (> 0).
double scree_round_below(double value);

typedef struct scree_limits {
    double low, high;               ///< low < high, what the colours span
    double smallest, largest;       ///< of the finite values; NAN when there is none
    size_t undefined;               ///< values that are not finite
    bool clipped_low, clipped_high; ///< values lie outside
} scree_limits;

/// Limits that a few extreme values do not spoil: the 2nd and 98th percentile, or, when `symmetric`, minus and plus the
/// 98th percentile of the magnitude. Values that are all equal get limits around them. Errors: memory.
scree_status scree_limits_find(const double *value, size_t count, bool symmetric, scree_limits *limits,
                               scree_error *error) SCREE_MUST_USE;

/// Quantile (0 to 1) of ascending values, linear between them.
double scree_quantile(const double *ascending, size_t count, double fraction);

void scree_sort(double *value, size_t count);

#define SCREE_TICKS 8
typedef struct scree_ticks {
    int count;
    double value[SCREE_TICKS];
    char text[SCREE_TICKS][24];
    char factor[24]; ///< "" or a power of ten that the texts are to be multiplied with
} scree_ticks;

/// Round tick values within [low, high], low < high.
scree_ticks scree_ticks_make(double low, double high);

/// A number in at most `digits` digits with a true minus sign and, where needed, a power of ten.
void scree_number_text(char *text, size_t size, double value, int digits);

/// A length [m] with its unit: mm, or um below 0.01 mm.
void scree_length_text(char *text, size_t size, double length);

#endif
