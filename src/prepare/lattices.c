/// Lattices of equal discs or spheres that touch each other, floor and side walls.
///
/// In 2D rows of discs. hexagonal: n and n - 1 discs in turn, sqrt(3) R apart, in a box 2 n R wide; or it begins with
/// n - 1. centred_rectangular: rows likewise, such that grains of neighbouring rows touch at an angle a from the
/// horizontal: 4 R cos(a) apart in a row, rows 2 R sin(a) apart; 60 degrees is the triangular lattice, 45 the square
/// one turned, and above 30 degrees no grain touches any but its four neighbours. 2 R may be another distance, for
/// polygons that touch with their sides. square: n discs, 2 R apart. In 3D square layers of spheres. face_centred: n x
/// m and (n - 1) x (m - 1) spheres in turn, sqrt(2) R apart. body_centred: the same numbers, 4 / sqrt(3) R apart, in
/// layers of half that distance: neighbours in a layer do not touch. cubic: n x m spheres, 2 R apart. The last row or
/// layer may be incomplete; it fills from the left (and the front). Width auto: the number n whose height over width
/// comes nearest to the aspect ratio (m = n where the depth is auto too); a given width or depth is lowered to the next
/// that the lattice fills. The model has checked that radii are equal, but for centred_rectangular with a distance of
/// the centres, where they may differ: a lattice with disorder.
///
/// Periodic in a horizontal direction, no layer is shorter along it. Periodic in the last direction, the layers have to
/// be whole, and even in number where they alternate: then width (or aspect ratio) and number of bodies have to suit
/// each other.
#include "module/key_rows.h"
#include "prepare/methods.h"
#include "prepare/prepare.h"
#include "theory/lattice.h"

#include <math.h>

typedef struct lattice {
    size_t missing[2]; ///< by how many bodies every second layer is shorter, along x and y
    double spacing;    ///< distance of neighbours in a layer, in radii
    double rise;       ///< distance of layers, in radii
    bool staggered;    ///< every second layer is shifted by half the spacing along each side
    bool later;        ///< the first layer is left out: it begins with a shorter one
    double distance;   ///< m, of the centres of bodies that touch; 0: two radii
} lattice;

/// Of `hexagonal`.
typedef struct config {
    int first_row; ///< 1: a shorter one
} config;
static const scree_choice first_rows[] = {
    {"long", 0, "n discs, then n - 1"},
    {"short", 1, "n - 1 discs, then n"},
    {0},
};
static const scree_key keys[] = {
    CHOICE(config, first_row, first_rows, .standard = "long", .when = "method=hexagonal",
           .meaning = "With which of its two kinds of rows the lattice begins."),
};

/// Of `centred_rectangular`.
typedef struct angled {
    double angle;    ///< rad
    double distance; ///< m; NAN: two radii
} angled;
static const scree_key angled_keys[] = {
    NUMBER(angled, angle, "rad", .standard = "60 degrees", ABOVE("30 degrees"), TO("60 degrees"),
           .when = "method=centred_rectangular",
           .meaning = "Of the contacts of neighbouring rows from the horizontal; 60 degrees: the triangular lattice, "
                      "where grains of a row touch, too."),
    NUMBER(angled, distance, "m", .standard = "auto", ABOVE("0 m"), TO("200 m"), .when = "method=centred_rectangular",
           .meaning = "Of the centres of grains that touch; auto: two radii. Of polygons that touch with their sides "
                      "twice the radius of the circle inside. Where it is given radii may differ."),
};

/// Layers (rows in 2D) of a lattice that is n bodies wide and m deep.
typedef struct layers {
    size_t n, m;
    size_t full, shorter; ///< bodies in the one and the other
} layers;

static layers layers_of(const lattice *kind, int dimension, size_t n, size_t m)
{
    if (dimension == 2) m = 1;
    size_t deep = dimension == 3 ? m - kind->missing[1] : 1;
    return (layers){n, m, n * m, (n - kind->missing[0]) * deep};
}

/// Layers that `count` bodies need.
static size_t layers_needed(const layers *of, size_t count)
{
    size_t pair = of->full + of->shorter, rest = count % pair;
    return 2 * (count / pair) + (rest > 0) + (rest > of->full);
}

/// Side of the box, in radii, for n bodies along it.
static double side_of(const lattice *kind, size_t n, bool periodic)
{
    return kind->spacing * (double)n + (periodic ? 0 : 2 - kind->spacing);
}

/// Number of bodies across. Height over width falls with it: the first below the aspect ratio, or the one before.
/// `deep`: number of bodies from front to back, 0 for as many as across.
static size_t columns_for(const lattice *kind, const scree_packing *packing, size_t deep)
{
    double before = INFINITY;
    const size_t least = 1 + (kind->missing[0] > kind->missing[1] ? kind->missing[0] : kind->missing[1]);
    for (size_t n = least;; n++) {
        layers of = layers_of(kind, packing->dimension, n, deep > 0 ? deep : n);
        double height = 2 + kind->rise * (double)(layers_needed(&of, packing->count) - 1);
        double ratio = height / side_of(kind, n, false);
        if (ratio <= packing->aspect_ratio || n >= packing->count)
            return before - packing->aspect_ratio < packing->aspect_ratio - ratio ? n - 1 : n;
        before = ratio;
    }
}

/// Number of bodies that fit beside each other into a given side of the box.
static size_t fitting(const lattice *kind, double side, double r, bool periodic)
{
    double beyond = periodic ? 0 : 2 - kind->spacing;
    return (size_t)fmax(floor((side / r * (1 + 1e-12) - beyond) / kind->spacing), 0);
}

/// What a lattice is made of [m].
static double half_distance(const lattice *kind, const scree_packing *packing)
{
    return kind->distance > 0 ? 0.5 * kind->distance : packing->radius[0];
}

static void place_body(scree_packing *packing, size_t i, const lattice *kind, const layers *of)
{
    const double r = half_distance(kind, packing);
    const size_t skipped = kind->later ? of->full : 0, place = i + skipped;
    size_t pair = of->full + of->shorter, within = place % pair, layer = 2 * (place / pair) + (within >= of->full);
    bool shorter = within >= of->full;
    size_t number = shorter ? within - of->full : within, across = shorter ? of->n - kind->missing[0] : of->n;
    double a = kind->spacing, shift = shorter && kind->staggered ? a / 2 : 0;
    packing->place[0][i] = r * (1 + a * (double)(packing->dimension == 3 ? number % across : number) + shift);
    if (packing->dimension == 3) packing->place[1][i] = r * (1 + a * (double)(number / across) + shift);
    packing->place[packing->dimension - 1][i] = r * (1 + kind->rise * (double)(layer - (kind->later ? 1 : 0)));
}

/// Layers of a lattice that repeats itself upwards must be whole and close with the first.
static scree_status check_layers(const scree_model *model, const scree_config_stage *stage, size_t count,
                                 const lattice *kind, const layers *of, scree_error *error)
{
    size_t whole = kind->staggered ? of->full + of->shorter : of->full, fewer = count / whole * whole;
    if (count % whole == 0) return SCREE_OK;
    return scree_prepare_error(error, model, stage, "method",
                               "%zu particles do not fill a periodic lattice of %slayers with %zu particles: set "
                               "particles.count to %zu or %zu, or another width",
                               count, kind->staggered ? "pairs of " : "", of->full, fewer > 0 ? fewer : whole,
                               fewer + whole);
}

static scree_status place_lattice(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                                  lattice alone, scree_error *error)
{
    size_t count = packing->count;
    scree_box *box = &packing->box;
    const bool upwards = box->periodic >> (packing->dimension - 1) & 1;
    lattice *kind = &alone;
    for (int k = 0; k < packing->dimension - 1; k++)
        if (box->periodic >> k & 1) kind->missing[k] = 0;
    if (count == 0) return SCREE_OK;
    const double r = half_distance(kind, packing);
    const bool in_3d = packing->dimension == 3, deep = in_3d && !isnan(box->depth);
    const bool again[2] = {box->periodic & 1, box->periodic >> 1 & 1};
    size_t m = deep ? fitting(kind, box->depth, r, again[1]) : 0;
    if (deep && m < 1 + kind->missing[1] && count > 1)
        return scree_prepare_error(error, model, stage, "depth", "a layer of the lattice needs at least %g m",
                                   side_of(kind, 1 + kind->missing[1], again[1]) * r);
    size_t n = isnan(box->width) ? columns_for(kind, packing, m) : fitting(kind, box->width, r, again[0]);
    if (n < 1 + kind->missing[0] && count > 1)
        return scree_prepare_error(error, model, stage, "width", "a row of the lattice needs at least %g m",
                                   side_of(kind, 1 + kind->missing[0], again[0]) * r);
    layers of = layers_of(kind, packing->dimension, n, deep ? m : n);
    scree_status status = upwards ? check_layers(model, stage, count, kind, &of, error) : SCREE_OK;
    if (status) return status;
    for (size_t i = 0; i < count; i++) place_body(packing, i, kind, &of);
    box->width = side_of(kind, of.n, again[0]) * r;
    box->depth = side_of(kind, of.m, again[1]) * r;
    double needed = (double)layers_needed(&of, count + (kind->later ? of.full : 0)) - (kind->later ? 1 : 0);
    box->height = r * (upwards ? kind->rise * needed : 2 + kind->rise * (needed - 1));
    return SCREE_OK;
}

static scree_status place_hexagonal(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                                    scree_error *error)
{
    const config *own = scree_config_own(&scree_module_hexagonal, "stages.prepare", stage->own);
    const lattice rows = {{1, 1}, 2, sqrt(3.0), true, own && own->first_row == 1, 0};
    return place_lattice(model, stage, packing, rows, error);
}

static scree_status place_centred(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                                  scree_error *error)
{
    const angled *own = scree_config_own(&scree_module_centred_rectangular, "stages.prepare", stage->own);
    const double angle = own && own->angle > 0 ? own->angle : M_PI / 3;
    const double distance = own && own->distance > 0 ? own->distance : 0;
    const lattice rows = {{1, 1}, 4 * cos(angle), 2 * sin(angle), true, false, distance};
    return place_lattice(model, stage, packing, rows, error);
}

static scree_status place_upright(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                                  scree_error *error)
{
    return place_lattice(model, stage, packing, (lattice){{0, 0}, 2, 2, false, false, 0}, error);
}

static scree_status place_face_centred(const scree_model *model, const scree_config_stage *stage,
                                       scree_packing *packing, scree_error *error)
{
    return place_lattice(model, stage, packing, (lattice){{1, 1}, 2, sqrt(2.0), true, false, 0}, error);
}

static scree_status place_body_centred(const scree_model *model, const scree_config_stage *stage,
                                       scree_packing *packing, scree_error *error)
{
    return place_lattice(model, stage, packing, (lattice){{1, 1}, 4 / sqrt(3.0), 2 / sqrt(3.0), true, false, 0}, error);
}

static scree_status check(const scree_model *model, const scree_config_stage *stage, scree_error *error)
{
    if (!(model->radius_min < model->radius_max)) return SCREE_OK;
    return scree_prepare_error(
        error, model, stage, "method",
        "a lattice needs particles of one radius, and the case has radii from %g m to %g m: set the "
        "distribution of %s to equal",
        model->radius_min, model->radius_max, model->species_count > 1 ? "all species, with one radius," : "particles");
}

/// With a distance the lattice is that of the centres, and grains may differ: a lattice with a little disorder.
static scree_status check_centred(const scree_model *model, const scree_config_stage *stage, scree_error *error)
{
    const angled *own = scree_config_own(&scree_module_centred_rectangular, "stages.prepare", stage->own);
    return own && own->distance > 0 ? SCREE_OK : check(model, stage, error);
}

static const scree_keys first_row_keys[] = {KEYS_OF("stages.prepare", keys, config)};
static const scree_keys centred_keys[] = {KEYS_OF("stages.prepare", angled_keys, angled)};

#define LATTICE(title, text, dimension, other, function, checks, keys_, count_, ...)                                   \
    const scree_module scree_module_##title = {                                                                        \
        .name = #title,                                                                                                \
        .meaning = text,                                                                                               \
        .choice_of = CHOICE_OF(IS("stages.prepare.method")),                                                           \
        .preparation = &(const scree_preparation){.periodic = true,                                                    \
                                                  .only_dimension = dimension,                                         \
                                                  .elsewhere = other,                                                  \
                                                  .check = checks,                                                     \
                                                  .place = function,                                                   \
                                                  __VA_ARGS__},                                                        \
        .keys = keys_,                                                                                                 \
        .keys_count = count_,                                                                                          \
    }
LATTICE(hexagonal, "triangular lattice of equal discs that touch", 2, "face_centred", place_hexagonal, check,
        first_row_keys, 1, .lattice = SCREE_LATTICE_HEXAGONAL + 1);
LATTICE(square, "square lattice of equal discs that touch", 2, "cubic", place_upright, check, NULL, 0,
        .lattice = SCREE_LATTICE_SQUARE + 1);
LATTICE(centred_rectangular, "centred rectangular lattice of equal discs that touch those of the rows above and below",
        2, "body_centred", place_centred, check_centred, centred_keys, 1);
LATTICE(face_centred, "face-centred cubic lattice of equal spheres that touch, square layers horizontal", 3,
        "hexagonal", place_face_centred, check, NULL, 0, .lattice = SCREE_LATTICE_FACE_CENTRED + 1, .turned = true);
LATTICE(body_centred, "body-centred cubic lattice of equal spheres that touch along the diagonals of its cells", 3,
        "hexagonal", place_body_centred, check, NULL, 0, .lattice = SCREE_LATTICE_BODY_CENTRED + 1);
LATTICE(cubic, "simple cubic lattice of equal spheres that touch", 3, "square", place_upright, check, NULL, 0,
        .lattice = SCREE_LATTICE_SIMPLE_CUBIC + 1);
