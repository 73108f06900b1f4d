/// Selections by place: bodies whose centres lie in a region, its boundary included. In a periodic cell the places are
/// those within the cell.
#include "base/vectors.h"
#include "case/check.h"
#include "module/key_rows.h"
#include "selection/selection.h"
#include "state/body.h"

#define PLACE(owner, member, ...)                                                                                      \
    KEY(owner, member, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"), __VA_ARGS__)
/// A module with one group of keys, `NAME_keys`, into the struct `NAME`.
#define REGION(slot, name_, meaning_, ...)                                                                             \
    const scree_module scree_module_##slot = {.name = name_,                                                           \
                                              .meaning = meaning_,                                                     \
                                              .choice_of = CHOICE_OF(IS("selections")),                                \
                                              .keys = (const scree_keys[]){KEYS_OF(NULL, slot##_keys, slot)},          \
                                              .keys_count = 1,                                                         \
                                              .selection = &slot##_kind,                                               \
                                              __VA_ARGS__}

// ---- box ---------------------------------------------------------------------------------------------------------

typedef struct select_box {
    double lower[3], upper[3]; ///< m
} select_box;

static scree_status choose_box(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                               scree_error *error)
{
    const select_box *box = own;
    (void)model, (void)error;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        scree_body_position(state, row, place);
        chosen[row] = 1;
        for (int k = 0; k < state->dimension; k++)
            if (!(place[k] >= box->lower[k] && place[k] <= box->upper[k])) chosen[row] = 0;
    }
    return SCREE_OK;
}

static void check_box(scree_reader *reader, const scree_config *config)
{
    for (int64_t i = 0; i < config->selection_count; i++) {
        const select_box *box = config->selections[i].own;
        char path[SCREE_PATH_BYTES];
        (void)snprintf(path, sizeof path, "selections.%lld.upper", (long long)i);
        if (config->selections[i].kind != SCREE_SLOT_select_box || !box) continue;
        for (int k = 0; k < config->dimension; k++) {
            if (!(box->upper[k] < box->lower[k])) continue;
            scree_rule_refuse(reader, path, NULL, "%c of `upper` is smaller than that of `lower`: the box is empty",
                              "xyz"[k]);
            break;
        }
    }
}

static const scree_key select_box_keys[] = {
    PLACE(select_box, lower, .meaning = "Corner with the smallest coordinates."),
    PLACE(select_box, upper, .meaning = "Corner with the largest coordinates."),
};
static const scree_selection_kind select_box_kind = {.choose = choose_box};
REGION(select_box, "box", "Particles whose centres lie in a box along the axes.", .rules = check_box);

// ---- circle, sphere ----------------------------------------------------------------------------------------------

typedef struct select_circle {
    double centre[3]; ///< m
    double radius;    ///< m
} select_circle;
typedef select_circle select_sphere;

static scree_status choose_circle(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                                  scree_error *error)
{
    const select_circle *circle = own;
    (void)model, (void)error;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place, way;
        scree_body_position(state, row, place);
        scree_subtract(place, circle->centre, way);
        if (state->dimension == 2) way[2] = 0;
        chosen[row] = scree_length(way) <= circle->radius;
    }
    return SCREE_OK;
}

/// Each exists in one dimension.
static void check_round(scree_reader *reader, const scree_config *config)
{
    const bool in_3d = config->dimension == 3;
    const int wrong = in_3d ? SCREE_SLOT_select_circle : SCREE_SLOT_select_sphere;
    const char *other = in_3d ? "sphere" : "circle";
    for (int64_t i = 0; i < config->selection_count; i++) {
        char path[SCREE_PATH_BYTES];
        (void)snprintf(path, sizeof path, "selections.%lld.select", (long long)i);
        if (config->selections[i].kind == wrong)
            scree_rule_refuse(reader, path, other, "in %s dimensions choose '%s'", in_3d ? "three" : "two", other);
    }
}

static const scree_key select_circle_keys[] = {
    PLACE(select_circle, centre, .meaning = "Its centre."),
    NUMBER(select_circle, radius, "m", ABOVE("0 m"), TO("1e6 m"), .meaning = "Its radius."),
};
#define select_sphere_keys select_circle_keys
static const scree_selection_kind select_circle_kind = {.choose = choose_circle};
#define select_sphere_kind select_circle_kind
REGION(select_circle, "circle", "Particles whose centres lie in a circle, in two dimensions.", .rules = check_round);
REGION(select_sphere, "sphere", "Particles whose centres lie in a sphere, in three dimensions.", .rules = check_round);

// ---- band --------------------------------------------------------------------------------------------------------

typedef enum measured { FROM_ORIGIN, FROM_LOW, FROM_HIGH } measured;

typedef struct select_band {
    int axis;        ///< 0 to 2
    int measured;    ///< measured
    double from, to; ///< m
} select_band;

/// Lowest and highest coordinate of the surfaces of the grains along an axis [m].
static void find_extent(const scree_state *state, int axis, double extent[2])
{
    extent[0] = INFINITY;
    extent[1] = -INFINITY;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        if (!scree_body_is_grain(state, row)) continue;
        scree_body_position(state, row, place);
        extent[0] = fmin(extent[0], place[axis] - scree_body_bounding_radius(state, row));
        extent[1] = fmax(extent[1], place[axis] + scree_body_bounding_radius(state, row));
    }
}

static scree_status choose_band(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                                scree_error *error)
{
    const select_band *band = own;
    double extent[2];
    (void)model, (void)error;
    find_extent(state, band->axis, extent);
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        scree_body_position(state, row, place);
        double depth = band->measured == FROM_LOW    ? place[band->axis] - extent[0]
                       : band->measured == FROM_HIGH ? extent[1] - place[band->axis]
                                                     : place[band->axis];
        chosen[row] = depth >= band->from && depth <= band->to;
    }
    return SCREE_OK;
}

static void check_band(scree_reader *reader, const scree_config *config)
{
    for (int64_t i = 0; i < config->selection_count; i++) {
        const select_band *band = config->selections[i].own;
        char path[SCREE_PATH_BYTES];
        (void)snprintf(path, sizeof path, "selections.%lld.to", (long long)i);
        if (config->selections[i].kind != SCREE_SLOT_select_band || !band) continue;
        if (band->to < band->from) scree_rule_refuse(reader, path, NULL, "a band must begin before it ends");
        (void)snprintf(path, sizeof path, "selections.%lld.axis", (long long)i);
        if (band->axis >= config->dimension) scree_rule_refuse(reader, path, "x, y", "there is no z in two dimensions");
    }
}

static const scree_choice axes[] = {
    {"x", 0, "a band across x"}, {"y", 1, "a band across y"}, {"z", 2, "a band across z"}, {0}};
static const scree_choice measures[] = {
    {"origin", FROM_ORIGIN, "coordinates themselves"},
    {"low", FROM_LOW, "from the lowest surface of a particle upwards"},
    {"high", FROM_HIGH, "from the highest surface of a particle downwards"},
    {0},
};
static const scree_key select_band_keys[] = {
    CHOICE(select_band, axis, axes, .meaning = "Coordinate."),
    CHOICE(select_band, measured, measures, .standard = "origin", .meaning = "What `from` and `to` are measured from."),
    NUMBER(select_band, from, "m", FROM("-1e6 m"), TO("1e6 m"), .meaning = "Where it begins."),
    NUMBER(select_band, to, "m", FROM("-1e6 m"), TO("1e6 m"), .meaning = "Where it ends."),
};
static const scree_selection_kind select_band_kind = {.choose = choose_band};
REGION(select_band, "band",
       "Particles whose centres lie between two coordinates, or depths below an end of the sample.",
       .rules = check_band);
