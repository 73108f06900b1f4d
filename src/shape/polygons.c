/// The shape `polygon`: its keys, its fields, outlines as they are drawn.
#include "shape/polygons.h"

#include "base/checksum.h"
#include "base/processor.h"
#include "case/check.h"
#include "module/key_rows.h"
#include "module/shape.h"
#include "shape/polygon_make.h"
#include "shape/polygon_rules.h"
#include "shape/rounding.h"
#include "state/fields.h"
#include "state/sleep.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

typedef scree_polygons own;

// ---- keys --------------------------------------------------------------------------------------------------------

typedef enum outline_kind { ON_ELLIPSE, REGULAR, GIVEN } outline_kind;

typedef struct config {
    int outline; ///< outline_kind
    int64_t corners_min;
    int64_t corners_max;
    double axis_ratio;
    int corner_angles;    ///< scree_polygon_scatter
    double (*corners)[2]; ///< of `given`, in any unit of length; NULL: not said
    int64_t corner_count;
    double rounding; ///< 1, over the radius; 0: sharp
} config;

static const scree_choice outlines[] = {
    {"ellipse", ON_ELLIPSE, "corners at random on an ellipse"},
    {"regular", REGULAR, "all sides and angles alike"},
    {"given", GIVEN, "`corners`, scaled to the radius; for several outlines give several species"},
    {0},
};
static const scree_choice scatters[] = {
    {"sectors", SCREE_POLYGON_SECTORS, "one corner in each of as many equal sectors of the eccentric angle"},
    {"free", SCREE_POLYGON_FREE, "all corners anywhere on the ellipse: slivers among them"},
    {0},
};
#define WITH_POLYGON .when = "shape=polygon"
static const scree_key keys[] = {
    CHOICE(config, outline, outlines, .standard = "ellipse", WITH_POLYGON,
           .meaning = "How the corners are drawn. The radius of a polygon is that of the disc of equal area."),
    INTEGER(config, corners_min, .standard = "6", FROM("3"), TO("32"), WITH_POLYGON,
            .meaning = "Fewest corners; each number up to `corners_max` is equally likely."),
    INTEGER(config, corners_max, .standard = "8", FROM("3"), TO("32"), WITH_POLYGON, .meaning = "Most corners."),
    KEY(config, corners, SCREE_KEY_PAIRS, .unit = "1", FROM("-1e12"), TO("1e12"), .when = "outline=given",
        .count_offset = offsetof(config, corner_count), .element_size = sizeof(double[2]), .columns = {"x", "y"},
        .meaning =
            "Its corners, 3 to 32, counter-clockwise, [[x, y], [x, y], [x, y]] or a .csv file; in any unit, since "
            "they are scaled. A file may name its columns x and y, in any order."),
    NUMBER(config, axis_ratio, "1", .standard = "1", FROM("1"), TO("20"), .when = "outline=ellipse",
           .meaning = "Long over short axis of the ellipse."),
    CHOICE(config, corner_angles, scatters, .standard = "sectors", .when = "outline=ellipse",
           .meaning = "Where on the ellipse corners may lie."),
    NUMBER(config, rounding, "1", .standard = "0", FROM("0"), TO("0.9"), WITH_POLYGON,
           .meaning = "Radius of the corners over that of the disc of equal area: the outline is that of a smaller "
                      "polygon with a disc of it swept along its edges. Laws of springs need rounded corners (0.1, "
                      "say), laws of areas sharp ones (0)."),
};

/// What is wrong with the outline that is given.
static const char *wrong_outline(const config *c)
{
    static _Thread_local scree_error why;
    if (!c->corners) return NULL; // missing, and noted
    const int count = c->corner_count > INT_MAX ? INT_MAX : (int)c->corner_count;
    return scree_polygon_check(count, (const double(*)[2])c->corners, &why) ? why.message : NULL;
}

/// Whether there are numbers that could not be read, and are noted.
static bool is_unreadable(const config *c)
{
    bool all = true;
    for (int64_t k = 0; c->corners && k < c->corner_count; k++)
        all = all && isfinite(c->corners[k][0]) && isfinite(c->corners[k][1]);
    return !all;
}

/// Why numbers of corners cannot be drawn from a range; NULL: they can, or an end of it is wrong for itself (0), and
/// noted.
static const char *wrong_range(const config *c)
{
    static _Thread_local char why[120];
    if (c->corners_min == 0 || c->corners_max == 0 || c->corners_max >= c->corners_min) return NULL;
    (void)snprintf(why, sizeof why, "%lld is less than corners_min, %lld", (long long)c->corners_max,
                   (long long)c->corners_min);
    return why;
}

static const char *wrong(const void *said, const char **key)
{
    const config *c = said;
    *key = "corners";
    if (c->outline == GIVEN) return is_unreadable(c) ? NULL : wrong_outline(c);
    *key = "corners_max";
    return wrong_range(c);
}

// ---- drawing -----------------------------------------------------------------------------------------------------

/// The outline that is given, with the area of a disc of radius 1.
static int take(const config *c, double corner[SCREE_POLYGON_CORNERS][2])
{
    const int count = (int)c->corner_count;
    memcpy(corner, c->corners, (size_t)count * sizeof *corner);
    scree_polygon_fit(count, 1, corner);
    return count;
}

/// Rounds an outline that has the area of a disc of radius 1: a core that has it with its rounding.
static int round_off(const config *c, int count, double corner[SCREE_POLYGON_CORNERS][2])
{
    if (!(c->rounding > 0)) return count;
    const double scale = scree_rounding_scale(count, (const double(*)[2])corner, c->rounding);
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) corner[k][i] *= scale;
    return count;
}

static scree_polygon_measures measure(const config *c, int count, double corner[SCREE_POLYGON_CORNERS][2])
{
    if (!(c->rounding > 0)) return scree_polygon_measure(count, (const double(*)[2])corner);
    return scree_rounding_measure(count, (const double(*)[2])corner, c->rounding);
}

/// No body on an ellipse reaches farther, over the radius.
static double reach_on_ellipse(const config *c)
{
    return SCREE_POLYGON_REACH * sqrt(c->axis_ratio);
}

/// Of a regular triangle 1.56.
static double largest_reach(const void *said)
{
    const config *c = said;
    double corner[SCREE_POLYGON_CORNERS][2];
    if (c->outline != GIVEN) return reach_on_ellipse(c);
    if (!c->corners || wrong_outline(c)) return SCREE_POLYGON_REACH; // noted
    const int count = round_off(c, take(c, corner), corner);
    return measure(c, count, corner).bound * (1 + 0x1p-40);
}

/// Corners of body `number`, of its core where they are rounded, with the area of a disc of radius 1.
static int draw(const config *c, uint64_t seed, uint64_t number, double corner[SCREE_POLYGON_CORNERS][2])
{
    if (c->outline == GIVEN) return round_off(c, take(c, corner), corner);
    int count = scree_polygon_draw_count(seed, number, (int)c->corners_min, (int)c->corners_max);
    // A list of 64 draws of one corner in each sector does not fail; where it does, the regular one is a polygon, too.
    if (c->outline == REGULAR ||
        scree_polygon_make_on_ellipse(seed, number, count, c->axis_ratio, (scree_polygon_scatter)c->corner_angles, 1,
                                      corner, NULL))
        scree_polygon_make_regular(count, 1, corner);
    count = round_off(c, count, corner);
    // Rounding moves the centre a little: the one sliver in many that reaches too far then is a regular one, too.
    if (!(c->rounding > 0) || measure(c, count, corner).bound <= reach_on_ellipse(c)) return count;
    scree_polygon_make_regular(count, 1, corner);
    return round_off(c, count, corner);
}

static double reach(const void *said, uint64_t seed, uint64_t number)
{
    double corner[SCREE_POLYGON_CORNERS][2];
    const int count = draw(said, seed, number, corner);
    return measure(said, count, corner).bound;
}

static double narrowest(const void *said, uint64_t seed, uint64_t number)
{
    double corner[SCREE_POLYGON_CORNERS][2];
    const int count = draw(said, seed, number, corner);
    return scree_polygon_width(count, (const double(*)[2])corner) + 2 * ((const config *)said)->rounding;
}

static double rounding(const void *said)
{
    return ((const config *)said)->rounding;
}

static int corners_of(const void *said, uint64_t seed, uint64_t number, double (*corner)[2])
{
    const config *c = said;
    const char *key;
    const bool given = c->outline == GIVEN, ranged = c->corners_min > 0 && c->corners_max > 0;
    if (wrong(said, &key) || (given ? !c->corners || is_unreadable(c) : !ranged)) return 0;
    if (c->outline == ON_ELLIPSE && !(c->axis_ratio >= 1 && c->corner_angles >= 0)) return 0;
    const int count = draw(c, seed, number, corner);
    const scree_polygon_measures m = measure(c, count, corner);
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) corner[k][i] -= m.centroid[i];
    return count;
}

static scree_status dress(const scree_model *model, const void *said, uint64_t number, scree_state *state, size_t row,
                          scree_error *error)
{
    double corner[SCREE_POLYGON_CORNERS][2];
    const int count = draw(said, model->seed, number, corner);
    const double bound = measure(said, count, corner).bound;
    const double scale = state->row[row].radius / bound;
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) corner[k][i] *= scale;
    return scree_polygons_set(model, state, row, count, (const double(*)[2])corner, scale * rounding(said), error);
}

// ---- fields ------------------------------------------------------------------------------------------------------

static const scree_group pool = {
    .row = "corner",
    .symbol = "k",
    .count_offset = offsetof(own, count),
    .capacity_offset = offsetof(own, capacity),
};

enum { FIRST, CORNERS, ROUNDING, HEADING };
static const scree_field fields[] = {
    [FIRST] = SCREE_FIELD_BODY(polygon, own, of, scree_corners, "first_corner", SCREE_FIELD_UINT32, 1, "1",
                               "place of its first corner in polygons/corner, where there are polygons",
                               .offset = offsetof(scree_corners, first), .only_dimension = 2, .optional = true,
                               .ghosts = SCREE_GHOSTS_KEEP, .snapshot = true, SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    [CORNERS] = SCREE_FIELD_BODY(polygon, own, of, scree_corners, "corner_count", SCREE_FIELD_UINT32, 1, "1",
                                 "number of its corners; 0 of a disc", .offset = offsetof(scree_corners, count),
                                 .only_dimension = 2, .optional = true, .ghosts = SCREE_GHOSTS_KEEP, .snapshot = true,
                                 SCREE_RANGE(0, SCREE_POLYGON_CORNERS)),
    [ROUNDING] = SCREE_FIELD_BODY(
        polygon, own, rounding, double, "rounding", SCREE_FIELD_DOUBLE, 1, "m",
        "radius of its corners, where some are rounded: its outline lies so far outside of its corners",
        .only_dimension = 2, .optional = true, .ghosts = SCREE_GHOSTS_KEEP, .snapshot = true,
        SCREE_RANGE_TO(SCREE_LIMIT_LARGEST_RADIUS)),
    [HEADING] = SCREE_FIELD_BODY(polygon, own, heading, double, "heading", SCREE_FIELD_DOUBLE, 1, "rad",
                                 "angle that ghosts in other processes are turned by", .role = SCREE_FIELD_DERIVED,
                                 .only_dimension = 2, .optional = true, .ghosts = SCREE_GHOSTS_FOLLOW),
    SCREE_FIELD_GROUP(polygon, own, pool, corner, double[2], "polygons/corner", SCREE_FIELD_DOUBLE, 2, "m",
                      "corners in the frames of their bodies, counter-clockwise, from the centroid", .snapshot = true,
                      .optional = true),
    SCREE_FIELD_GROUP(polygon, own, pool, posed, double[2], "polygons/posed", SCREE_FIELD_DOUBLE, 2, "m",
                      "corners as they lie, from the centroid", .role = SCREE_FIELD_DERIVED),
};

/// Leaves out of the pool what no body has.
static void compact(scree_state *state, double (*kept)[2])
{
    own *p = scree_polygons_of(state);
    size_t count = 0;
    for (size_t row = 0; row < state->count; row++) {
        if (p->of[row].count > 0) memcpy(kept + count, p->corner + p->of[row].first, p->of[row].count * sizeof *kept);
        p->of[row].first = (uint32_t)count;
        count += p->of[row].count;
    }
    if (count > 0) memcpy(p->corner, kept, count * sizeof *kept);
    p->count = count;
}

/// Room for `more` corners: where half of a full pool is of bodies that are gone, theirs.
static scree_status reserve(scree_state *state, size_t more, scree_error *error)
{
    own *p = scree_polygons_of(state);
    size_t used = 0;
    if (p->count + more <= p->capacity) return SCREE_OK;
    for (size_t row = 0; row < state->count; row++) used += p->of[row].count;
    if (used > p->count / 2) return scree_group_reserve(state, &scree_module_polygon, &pool, p->count + more, error);
    double(*kept)[2] = NULL;
    scree_status status = scree_allocate(&kept, used + 1, sizeof *kept, error);
    if (!status) compact(state, kept);
    scree_release(&kept);
    if (status || p->count + more <= p->capacity) return status;
    return scree_group_reserve(state, &scree_module_polygon, &pool, p->count + more, error);
}

/// The arrays that are there only with polygons; all that were there before are discs.
static scree_status begin(scree_state *state, scree_error *error)
{
    const bool first = !state->form;
    scree_status status = scree_state_begin_field(state, &fields[FIRST], error);
    if (!status) status = scree_state_begin_form(state, error);
    for (size_t row = 0; row < state->count && first && !status; row++)
        state->form[row] = (scree_form){state->row[row].radius, state->row[row].radius};
    return status;
}

scree_status scree_polygons_set(const scree_model *model, scree_state *state, size_t row, int count,
                                const double (*corner)[2], double rounding, scree_error *error)
{
    own *p = scree_polygons_of(state);
    scree_status status = begin(state, error);
    if (!status && rounding > 0) status = scree_state_begin_field(state, &fields[ROUNDING], error);
    if (status) return status;
    p->of[row].count = 0;
    status = reserve(state, (size_t)count, error);
    if (status) return status;
    if (p->rounding) p->rounding[row] = rounding;
    const scree_polygon_measures m =
        rounding > 0 ? scree_rounding_measure(count, corner, rounding) : scree_polygon_measure(count, corner);
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) p->corner[p->count + (size_t)k][i] = corner[k][i] - m.centroid[i];
    p->of[row] = (scree_corners){(uint32_t)p->count, (uint32_t)count};
    p->count += (size_t)count;
    state->row[row].radius = m.bound * (1 + 0x1p-50);
    // The disc of equal inertia: m R^2 / 2 = m (integral of x^2 + y^2) / A.
    state->form[row] = (scree_form){m.radius, sqrt(2 * (m.moment[0] + m.moment[1]) / m.area)};
    state->row[row].mass = scree_model_mass(model, scree_body_material(state, row), m.radius);
    return SCREE_OK;
}

double scree_body_inner_radius(const scree_state *state, size_t row)
{
    const own *p = scree_polygons_of(state);
    const double bound = state->row[row].radius;
    if (!p->of) return state->form ? 0 : bound;
    if (p->of[row].count == 0) return bound;
    const scree_corners of = p->of[row];
    const double(*corner)[2] = (const double(*)[2])p->corner + of.first;
    double least = bound;
    for (uint32_t k = 0; k < of.count; k++) {
        const double *a = corner[k], *b = corner[k + 1 < of.count ? k + 1 : 0];
        least = fmin(least, (a[0] * b[1] - a[1] * b[0]) / hypot(b[0] - a[0], b[1] - a[1]));
    }
    return fmin(least + scree_rounding_of_row(p, row), bound);
}

void scree_polygons_turn(const scree_pose *pose)
{
#if defined(__x86_64__)
    static scree_pose_kernel *const kernels[] = {[2] = scree_pose_v2, [3] = scree_pose_v3, [4] = scree_pose_v4};
    kernels[scree_processor_level()](pose);
#else
    scree_pose_v0(pose);
#endif
}

static scree_pose pose_of(const own *p, const double *angle)
{
    return (scree_pose){.angle = angle, .of = p->of, .corner = (const double(*)[2])p->corner, .posed = p->posed};
}

/// Of all, or of those that are awake.
static void pose_them(scree_state *state, bool all)
{
    scree_pose pose = pose_of(scree_polygons_of(state), state->angle);
    if (!pose.of) return;
    pose.count = state->count;
    if (!all) pose.row = scree_moving_rows(state, &pose.count);
    scree_polygons_turn(&pose);
}

void scree_polygons_pose(scree_state *state)
{
    pose_them(state, true);
}

/// In a part, before ghosts are told.
static scree_status take_heading(scree_state *state, scree_error *error)
{
    if (!state->part || !scree_polygons_of(state)->of) return SCREE_OK;
    scree_status status = scree_state_begin_field(state, &fields[HEADING], error);
    if (!status) memcpy(scree_polygons_of(state)->heading, state->angle, state->count * sizeof *state->angle);
    return status;
}

static scree_status derive(scree_state *state, scree_error *error)
{
    scree_polygons_pose(state);
    return take_heading(state, error);
}

static void derive_ghosts(scree_state *state, const scree_work *work)
{
    const own *p = scree_polygons_of(state);
    scree_pose pose = pose_of(p, p->heading);
    pose.count = work->ghosts.away;
    pose.begin = scree_row_count(state, work) - pose.count;
    if (pose.of && pose.count > 0) scree_polygons_turn(&pose);
}

// ---- the module --------------------------------------------------------------------------------------------------

/// There may be some later in the stage.
static bool in_use(const scree_context *c)
{
    bool some = scree_polygons_of(c->state)->of != NULL;
    for (int s = 0; s < c->model->species_count; s++)
        some = some || c->model->species[s].shape == scree_module_polygon.shape;
    return some;
}

static scree_status tell_heading(const scree_context *c, scree_error *error)
{
    return take_heading(c->state, error);
}

static scree_status pose(const scree_context *c, scree_error *error)
{
    (void)error;
    pose_them(c->state, false);
    derive_ghosts(c->state, c->work);
    return SCREE_OK;
}

static const scree_pass passes[] = {{SCREE_PHASE_FOLLOW, .run = tell_heading}, {SCREE_PHASE_SEARCH, .run = pose}};

/// Outlines that are stored.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    const own *p = scree_polygons_of(state);
    (void)model;
    for (size_t row = 0; row < state->count && p->of; row++) {
        const scree_corners of = p->of[row];
        if (of.count == 0) continue;
        if (!state->form || (size_t)of.first + of.count > p->count)
            return scree_error_set(error, SCREE_ERROR_INPUT, "first_corner: body %u has corners that are not there",
                                   state->id[row]);
        scree_error why;
        if (scree_polygon_check((int)of.count, (const double(*)[2])p->corner + of.first, &why))
            return scree_error_set(error, SCREE_ERROR_INPUT, "polygons/corner: body %u: %s", state->id[row],
                                   why.message);
        const double edge = scree_rounding_of_row(p, row);
        double(*corner)[2] = p->corner + of.first;
        double bound = edge;
        for (size_t k = 0; k < of.count; k++) bound = fmax(bound, edge + hypot(corner[k][0], corner[k][1]));
        if (!(bound <= state->row[row].radius))
            return scree_error_set(error, SCREE_ERROR_INPUT, "radius: body %u reaches farther than its radius",
                                   state->id[row]);
    }
    return SCREE_OK;
}

/// Of each polygon, in the order of ids: its id, its angle, the number of its corners and they themselves, in its
/// frame, and before them where some are rounded its rounding; radii of the discs of equal area and inertia follow from
/// them.
static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const own *p = scree_polygons_of(state);
    (void)model;
    size_t id = 0;
    for (uint32_t row; p->of && (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) {
        const scree_corners of = p->of[row];
        if (of.count == 0) continue;
        c = scree_checksum_word(c, state->id[row]);
        c = scree_checksum_number(c, state->angle[row]);
        c = scree_checksum_word(c, of.count);
        if (p->rounding) c = scree_checksum_number(c, p->rounding[row]);
        for (size_t k = 0; k < of.count; k++)
            for (int i = 0; i < 2; i++) c = scree_checksum_number(c, p->corner[of.first + k][i]);
    }
    return c;
}

static double area(double square)
{
    return M_PI * square;
}

const scree_module scree_module_polygon = {
    .name = "polygon",
    .meaning = "a convex polygon, the section of a prism, in two dimensions",
    .choice_of = CHOICE_OF(IS("particles.shape"), IS("particles.species.shape")),
    .keys = (const scree_keys[]){KEYS_OF("particles", keys, config), KEYS_OF("particles.species", keys, config)},
    .keys_count = 2,
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .checksum = checksum,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .rules = scree_polygon_rules,
    .spreads = true,
    .derive = derive,
    .derive_ghosts = derive_ghosts,
    .shape = &(const scree_shape){.dimension = 2,
                                  .elsewhere = "sphere",
                                  .only_here = "polygons are bodies in the plane: dimension: 2",
                                  .volume = area,
                                  .wrong = wrong,
                                  .largest_reach = largest_reach,
                                  .reach = reach,
                                  .narrowest = narrowest,
                                  .rounding = rounding,
                                  .corners = corners_of,
                                  .dress = dress},
};
