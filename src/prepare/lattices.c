/// Hexagonal and square lattices of equal discs that touch each other, floor and side walls.
///
/// hexagonal: rows of n and n - 1 discs in turn, sqrt(3) R apart, in a box 2 n R wide. square: rows of n discs, 2 R
/// apart. The last row may be incomplete; it fills from the left. Width auto: the number n whose height over width
/// comes nearest to the aspect ratio; a given width is lowered to the next that the lattice fills. The model has
/// checked that radii are equal.
///
/// Periodic in x, all rows of the hexagonal lattice have n discs. Periodic in y too, the rows have to be whole, and
/// even in number when hexagonal: then width (or aspect ratio) and number have to suit each other.
#include "prepare/methods.h"

#include <math.h>

/// Rows that `count` discs need when rows of n and of n - missing discs alternate.
static size_t rows_needed(size_t count, size_t n, size_t missing)
{
    size_t pair = 2 * n - missing, rest = count % pair;
    return 2 * (count / pair) + (rest > 0) + (rest > n);
}

/// Number of discs in the first row. Height over width falls with it: the first below the aspect ratio, or the one
/// before.
static size_t columns_for(size_t count, size_t missing, double rise, double aspect_ratio)
{
    double before = INFINITY;
    for (size_t n = 1 + missing;; n++) {
        double ratio = (2 + rise * (double)(rows_needed(count, n, missing) - 1)) / (2 * (double)n);
        if (ratio <= aspect_ratio || n >= count) return before - aspect_ratio < aspect_ratio - ratio ? n - 1 : n;
        before = ratio;
    }
}

/// Of a lattice that repeats itself upwards, the rows must be whole and close with the first.
static scree_status check_rows(const scree_model *model, const scree_config_stage *stage, size_t count, size_t n,
                               bool in_pairs, scree_error *error)
{
    size_t whole = in_pairs ? 2 * n : n, fewer = count / whole * whole;
    if (count % whole == 0) return SCREE_OK;
    return scree_prepare_error(error, model, stage, "method",
                               "%zu discs do not fill a periodic lattice of %srows with %zu discs: set particles.count "
                               "to %zu or %zu, or another width",
                               count, in_pairs ? "pairs of " : "", n, fewer > 0 ? fewer : whole, fewer + whole);
}

/// missing: by how many discs every second row is shorter; rise: distance of rows in radii.
static scree_status place_lattice(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                                  size_t missing, double rise, scree_error *error)
{
    size_t count = packing->count;
    scree_box *box = &packing->box;
    if (count == 0) return SCREE_OK;
    double r = packing->radius[0];
    const bool staggered = missing > 0, around = box->periodic & 1, upwards = box->periodic & 2;
    if (around) missing = 0;
    size_t n = isnan(box->width) ? columns_for(count, missing, rise, stage->aspect_ratio)
                                 : (size_t)floor(box->width / (2 * r) * (1 + 1e-12));
    if (n < 1 + missing && count > 1)
        return scree_prepare_error(error, model, stage, "width", "a row of the lattice needs at least %g m",
                                   2 * (double)(1 + missing) * r);
    if (upwards) {
        scree_status status = check_rows(model, stage, count, n, staggered, error);
        if (status) return status;
    }
    size_t pair = 2 * n - missing;
    for (size_t i = 0; i < count; i++) {
        size_t within = i % pair, row = 2 * (i / pair) + (within >= n);
        bool second = within >= n;
        packing->x[i] = r * (1 + 2 * (double)(second ? within - n : within) + (second && staggered ? 1 : 0));
        packing->y[i] = r * (1 + rise * (double)row);
    }
    box->width = 2 * (double)n * r;
    size_t rows = rows_needed(count, n, missing);
    box->height = upwards ? r * rise * (double)rows : r * (2 + rise * (double)(rows - 1));
    return SCREE_OK;
}

static scree_status place_hexagonal(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                                    scree_error *error)
{
    return place_lattice(model, stage, packing, 1, sqrt(3.0), error);
}

static scree_status place_square(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                                 scree_error *error)
{
    return place_lattice(model, stage, packing, 0, 2, error);
}

const scree_preparation scree_prepare_hexagonal = {.name = "hexagonal",
                                                   .meaning = "equal discs on a triangular lattice, just touching",
                                                   .periodic = true,
                                                   .place = place_hexagonal};
const scree_preparation scree_prepare_square = {.name = "square",
                                                .meaning = "equal discs on a square lattice, just touching",
                                                .periodic = true,
                                                .place = place_square};
