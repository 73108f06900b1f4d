/// What is stored of an imposed velocity gradient.
#include "measure/imposed_gradient.h"

#include "measure/facets.h"

#include <math.h>

typedef scree_imposed_gradient own;

const scree_group scree_imposed_nodes = {
    .row = "node", .symbol = "b", .count_offset = offsetof(own, count), .capacity_offset = offsetof(own, capacity)};

#define ONE(...) SCREE_FIELD_ONE(imposed_gradient, own, __VA_ARGS__)
static const scree_field fields[] = {
    SCREE_FIELD_GROUP(imposed_gradient, own, scree_imposed_nodes, force, scree_vector, "imposed_gradient/force",
                      SCREE_FIELD_DOUBLE, 3, "N", "force of the imposed rates on each body of the boundary"),
    SCREE_FIELD_BODY(
        imposed_gradient, own, surface, double[6], "imposed_gradient/surface", SCREE_FIELD_DOUBLE, 6, "N",
        "moments over the radius of the forces of the imposed rates on the surface of a body that deforms: "
        "xx, yy, xy; xx, yy, zz, yz, xz, xy",
        .optional = true),
    ONE(target, "imposed_gradient/target", SCREE_FIELD_DOUBLE, 9, "1/s", "wanted velocity gradient, 3 x 3 by rows"),
    ONE(prescribed, "imposed_gradient/prescribed", SCREE_FIELD_INT64, 9, "1",
        "of each component of target: 0 free, 1 prescribed, 2 prescribed for the mean of it and its mirror",
        SCREE_RANGE(0, SCREE_SYMMETRIC)),
    ONE(viscosity, "imposed_gradient/viscosity", SCREE_FIELD_DOUBLE, 1, "Pa s", "stress over the error of the rate",
        SCREE_RANGE(0, INFINITY)),
    ONE(rate, "imposed_gradient/rate", SCREE_FIELD_DOUBLE, 9, "1/s",
        "velocity gradient of the boundary, 3 x 3 by rows"),
    ONE(stress, "imposed_gradient/stress", SCREE_FIELD_DOUBLE, 9, "Pa",
        "stress that the boundary applies besides the pressure, 3 x 3 by rows, tension positive"),
    ONE(achieved, "imposed_gradient/achieved", SCREE_FIELD_DOUBLE, 1, "1/s",
        "integral of target : rate over time since the last sample"),
    ONE(wanted, "imposed_gradient/wanted", SCREE_FIELD_DOUBLE, 1, "1/s",
        "integral of target : target over time since the last sample"),
};

const scree_field *const scree_imposed_surface = &fields[1];

/// One force a node of the boundary, or none.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    (void)model;
    size_t count = scree_imposed(state)->count, wanted = scree_boundary_count(state);
    if (count == 0 || count == wanted) return SCREE_OK;
    return scree_error_set(
        error, SCREE_ERROR_IO,
        "dataset 'imposed_gradient/force': %zu (accepted: none, or as many rows as the boundary has bodies, %zu)",
        count, wanted);
}

static const scree_result columns[] = {
    {"rate_ratio", "1", "actual over imposed strain rate since the last sample, of minimal conditions"},
};

/// Integral of target : rate since the last sample over that of target : target, both over the prescribed components;
/// NAN when nothing was wanted. The next interval begins.
static scree_status take_ratio(const scree_context *c, size_t index, double *value, scree_error *error)
{
    own *imposed = scree_imposed(c->state);
    (void)index, (void)error;
    *value = imposed->wanted > 0 ? imposed->achieved / imposed->wanted : NAN;
    imposed->achieved = imposed->wanted = 0;
    return SCREE_OK;
}

const scree_module scree_module_imposed_gradient = {
    .name = "imposed_gradient",
    .meaning = "a mean velocity gradient that forces on the Delaunay boundary impose",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .columns = SCREE_RESULTS_IN_PARTS(columns, take_ratio),
    .spreads = true,
};
