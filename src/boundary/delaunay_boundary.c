/// The Delaunay boundary of the sample as a module: what is stored of it, and when it is found anew.
#include "measure/delaunay_boundary.h"

#include "base/checksum.h"
#include "boundary/boundary.h"
#include "boundary/boundary_forget.h"
#include "boundary/pressure.h"
#include "comm/comm.h"
#include "comm/parts.h"
#include "measure/facets.h"
#include "state/plates.h"

typedef scree_delaunay_boundary own;

const scree_group scree_loop_group = {.row = "vertex",
                                      .symbol = "b",
                                      .count_offset = offsetof(own, loop.count),
                                      .capacity_offset = offsetof(own, loop.capacity)};
const scree_group scree_hull_nodes = {.row = "node",
                                      .symbol = "h",
                                      .count_offset = offsetof(own, hull.node_count),
                                      .capacity_offset = offsetof(own, hull.node_capacity)};
const scree_group scree_hull_triangles = {.row = "triangle",
                                          .symbol = "t",
                                          .count_offset = offsetof(own, hull.triangle_count),
                                          .capacity_offset = offsetof(own, hull.triangle_capacity)};

#define ONE(...) SCREE_FIELD_ONE(delaunay_boundary, own, __VA_ARGS__)
#define LOOP(member, element, name, type, unit, meaning, ...)                                                          \
    SCREE_FIELD_GROUP(delaunay_boundary, own, scree_loop_group, loop.member, element, "boundary/" name, type, 1, unit, \
                      meaning, .snapshot = true, .only_dimension = 2, __VA_ARGS__)
#define HULL(group, member, element, name, type, components, unit, meaning, ...)                                       \
    SCREE_FIELD_GROUP(delaunay_boundary, own, group, hull.member, element, "hull/" name, type, components, unit,       \
                      meaning, .snapshot = true, .only_dimension = 3, __VA_ARGS__)

static const scree_field fields[] = {
    LOOP(id, uint32_t, "id", SCREE_FIELD_UINT32, "1", "bodies along the closed boundary, counter-clockwise, by id",
         SCREE_RANGE_TO(SCREE_LIMIT_BODY)),
    LOOP(loaded, uint8_t, "loaded", SCREE_FIELD_UINT8, "1",
         "1: the edge from this body to the next carries the lateral pressure", SCREE_RANGE(0, 1)),
    LOOP(x, double, "x", SCREE_FIELD_DOUBLE, "m", "x when the boundary was last found",
         SCREE_RANGE_TO(SCREE_LIMIT_FARTHEST)),
    LOOP(y, double, "y", SCREE_FIELD_DOUBLE, "m", "y when the boundary was last found",
         SCREE_RANGE_TO(SCREE_LIMIT_FARTHEST)),
    LOOP(fx, double, "force_x", SCREE_FIELD_DOUBLE, "N", "x component of the force of the pressure on this body"),
    LOOP(fy, double, "force_y", SCREE_FIELD_DOUBLE, "N", "y component of the force of the pressure on this body"),
    SCREE_FIELD_GROUP(delaunay_boundary, own, scree_loop_group, loop.term, double, "boundary/term", SCREE_FIELD_DOUBLE,
                      1, "1", "term of a sum along the boundary", .role = SCREE_FIELD_DERIVED, .only_dimension = 2),
    SCREE_FIELD_GROUP(delaunay_boundary, own, scree_loop_group, loop.body, scree_boundary_body, "boundary/body",
                      SCREE_FIELD_DOUBLE, 7, "1", "the bodies as other processes see them", .role = SCREE_FIELD_DERIVED,
                      .only_dimension = 2),
    SCREE_FIELD_GROUP(delaunay_boundary, own, scree_hull_nodes, hull.body, scree_boundary_body, "hull/body",
                      SCREE_FIELD_DOUBLE, 7, "1", "the bodies as other processes see them", .role = SCREE_FIELD_DERIVED,
                      .only_dimension = 3),

    HULL(scree_hull_nodes, id, uint32_t, "id", SCREE_FIELD_UINT32, 1, "1", "bodies on the hull, by id, ascending",
         SCREE_RANGE_TO(SCREE_LIMIT_BODY)),
    HULL(scree_hull_nodes, position, scree_vector, "position", SCREE_FIELD_DOUBLE, 3, "m",
         "centre when the hull was last found", SCREE_RANGE_TO(SCREE_LIMIT_FARTHEST)),
    HULL(scree_hull_nodes, force, scree_vector, "force", SCREE_FIELD_DOUBLE, 3, "N",
         "force of the boundary on this body"),
    HULL(scree_hull_triangles, triangle, uint32_t[3], "triangle", SCREE_FIELD_UINT32, 3, "1",
         "places in hull/id of the corners, counter-clockwise seen from outside"),
    HULL(scree_hull_triangles, loaded, uint8_t, "loaded", SCREE_FIELD_UINT8, 1, "1",
         "1: the triangle carries the pressure; 2, 3: it faces the bottom, top plate",
         SCREE_RANGE(0, SCREE_HULL_ON_WALL + SCREE_WALL_COUNT - 1)),

    ONE(loop.updated, "scalars/boundary_updated", SCREE_FIELD_UINT64, 1, "1",
        "step at which the boundary was last found", SCREE_RANGE_TO(SCREE_LIMIT_STEP)),
    ONE(hull.updated, "scalars/hull_updated", SCREE_FIELD_UINT64, 1, "1", "step at which the hull was last found",
        SCREE_RANGE_TO(SCREE_LIMIT_STEP)),
    ONE(stale, "scalars/boundary_stale", SCREE_FIELD_UINT64, 1, "1",
        "1: a body of the boundary was taken out; it is found anew at the next search", SCREE_RANGE(0, 1)),
    ONE(strain.gradient, "strain/gradient", SCREE_FIELD_DOUBLE, 9, "1",
        "displacement gradient accumulated from the boundary, 3 x 3 by rows, extension positive"),
    ONE(strain.redetected, "strain/redetected", SCREE_FIELD_DOUBLE, 1, "1",
        "sum of log (enclosed volume after / before) over the re-detections of the boundary"),
    ONE(taken_over, "scalars/boundary_taken_over", SCREE_FIELD_DOUBLE, 1, "1",
        "fraction of the time passed in which a membrane takes the pressure over; 0 without one", SCREE_RANGE(0, 1)),
};

/// Ids of the hull ascend, and its triangles have nodes that there are.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    (void)model;
    const scree_hull *hull = scree_hull_of(state);
    for (size_t k = 1; k < hull->node_count; k++)
        if (hull->id[k] <= hull->id[k - 1])
            return scree_error_set(error, SCREE_ERROR_IO, "dataset 'hull/id', row %zu: %u (accepted: ascending ids)", k,
                                   hull->id[k]);
    for (size_t t = 0; t < hull->triangle_count; t++)
        for (int c = 0; c < 3; c++)
            if (hull->triangle[t][c] >= hull->node_count)
                return scree_error_set(error, SCREE_ERROR_IO,
                                       "dataset 'hull/triangle', row %zu: %u (accepted: at least 0, at most %zu)", t,
                                       hull->triangle[t][c], hull->node_count - 1);
    return SCREE_OK;
}

static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    (void)model;
    return scree_checksum_numbers(c, scree_strain_of(state)->gradient, 9);
}

// ---- in all processes --------------------------------------------------------------------------------------------

/// Fills in those that are here.
static void take(const scree_state *state, const uint32_t *id, scree_boundary_body *body, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        scree_vector spin;
        const uint32_t row = scree_state_row_of(state, id[k]);
        if (row == SCREE_NO_ROW) continue;
        scree_body_position(state, row, body[k].position);
        scree_body_motion(state, row, body[k].velocity, spin);
        body[k].radius = scree_body_bounding_radius(state, row);
    }
}

void scree_boundary_tell(const scree_state *state, const uint32_t *id, scree_boundary_body *body, size_t count)
{
    if (scree_comm_size() == 1 || count == 0) return;
    take(state, id, body, count);
    scree_parts_tell(state, id, count, (double *)body, sizeof *body / sizeof(double));
}

/// Of parts that are new, and of the whole.
static scree_status derive(scree_state *state, scree_error *error)
{
    (void)error;
    const scree_loop *loop = scree_loop_of(state);
    const scree_hull *hull = scree_hull_of(state);
    scree_boundary_tell(state, loop->id, loop->body, loop->count);
    scree_boundary_tell(state, hull->id, hull->body, hull->node_count);
    return SCREE_OK;
}

/// Once a step: velocities are the same until the second half, positions until the next first one.
static scree_status follow(const scree_context *c, scree_error *error)
{
    const scree_loop *loop = scree_loop_of(c->state);
    const scree_hull *hull = scree_hull_of(c->state);
    (void)error;
    scree_boundary_tell(c->state, loop->id, loop->body, loop->count);
    scree_boundary_tell(c->state, hull->id, hull->body, hull->node_count);
    return SCREE_OK;
}

// ---- module ------------------------------------------------------------------------------------------------------

static scree_status refresh(const scree_context *c, scree_error *error)
{
    return c->boundary->open ? SCREE_OK : scree_boundary_refresh(c->model, c->state, error);
}

static const scree_pass passes[] = {{SCREE_PHASE_FOLLOW, .run = follow}, {SCREE_PHASE_SEARCH, .run = refresh}};

static const scree_result columns[] = {{"boundary_count", "1", "particles on the Delaunay boundary"}};

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    (void)index, (void)error;
    *value = (double)scree_boundary_count(c->state);
    return SCREE_OK;
}

const scree_module scree_module_delaunay_boundary = {
    .name = "delaunay_boundary",
    .meaning = "the outermost bodies of the sample, found on its Delaunay triangulation, and its strain",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .checksum = checksum,
    .forget = scree_boundary_forget,
    .derive = derive,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
    .spreads = true,
};
