/// Ranges of the fields. A field without a row in the table below must be finite; integers of such fields may be any.
/// Cost: one pass over the state, some milliseconds for 10^5 bodies.
#include "state/check.h"

#include "base/matrix.h"
#include "state/fields.h"
#include "state/periodic.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

/// Upper ends that are not numbers but follow from the state or the model.
typedef enum limit {
    AS_GIVEN,
    LAST_BODY,
    LAST_MATERIAL,
    LAST_NODE, ///< of the hull
    BODIES,
    LARGEST_RADIUS,
    FARTHEST, ///< far beyond any sample, on both sides of zero
    STEP,
    EVALUATIONS,
    MEMBRANE,
    STAGES,
    MANY ///< far more than any run has, and far from the end of the integers
} limit;

typedef struct range {
    const char *name;
    double least;
    limit most_is;
    double most;    ///< AS_GIVEN
    bool open;      ///< `least` itself is outside
    bool undefined; ///< not a number is a value, too
} range;

#define ANY_NUMBER (-DBL_MAX)
#define FAR        1e9    /* largest radii */
#define SUM        0x1p62 /* sums of a step stay below (base/fixed.h), with room for the next one */
static const range ranges[] = {
    {"position", .most_is = FARTHEST},
    {"reference", .most_is = FARTHEST},
    {"radius", 0, .most_is = LARGEST_RADIUS, .open = true},
    {"mass", 0, .most = DBL_MAX, .open = true},
    {"material", 0, .most_is = LAST_MATERIAL},
    {"force_sum", -SUM, .most = SUM},
    {"torque_sum", -SUM, .most = SUM},
    {"coordination", 0, .most_is = MANY},
    {"contacts/first", 0, .most_is = LAST_BODY},
    {"boundary/id", 0, .most_is = LAST_BODY},
    {"boundary/loaded", 0, .most = 1},
    {"boundary/x", .most_is = FARTHEST},
    {"boundary/y", .most_is = FARTHEST},
    {"hull/place", .most_is = FARTHEST},
    {"hull/id", 0, .most_is = LAST_BODY},
    {"hull/triangle", 0, .most_is = LAST_NODE},
    {"hull/loaded", 0, .most = SCREE_HULL_ON_WALL + SCREE_WALL_COUNT - 1},
    {"drive/prescribed", 0, .most = SCREE_SYMMETRIC},
    {"drive/viscosity", 0, .most = INFINITY},
    {"membrane/rest", 0, .most = DBL_MAX},
    {"scalars/grains", 0, .most_is = BODIES},
    {"scalars/membrane_right", 0, .most_is = MEMBRANE},
    {"scalars/membrane_around", 0, .most_is = MEMBRANE},
    {"scalars/membrane_radius", 0, .most = DBL_MAX},
    {"scalars/membrane_ramp_time", 0, .most = DBL_MAX},
    {"scalars/membrane_share", 0, .most = 1},
    {"walls/position", .most_is = FARTHEST},
    {"walls/normal", -1, .most = 1},
    {"walls/active", 0, .most = 1},
    {"walls/material", 0, .most_is = LAST_MATERIAL},
    {"scalars/surface_ticks", 0, .most_is = STEP},
    {"scalars/surface_moving", 0, .most = 1},
    {"scalars/surface_speed", 0, .most = DBL_MAX},
    {"scalars/step", 0, .most_is = MANY},
    {"scalars/evaluations", 0, .most_is = MANY},
    {"scalars/sampled_step", 0, .most_is = STEP},
    {"scalars/tick", 0, .most = DBL_MAX, .open = true},
    {"scalars/step_size", 0, .most = DBL_MAX},
    {"scalars/kick_size", 0, .most = DBL_MAX},
    {"scalars/force_quantum", 0, .most = DBL_MAX, .open = true},
    {"scalars/torque_quantum", 0, .most = DBL_MAX, .open = true},
    {"scalars/largest_overlap", 0, .most = DBL_MAX},
    {"scalars/largest_speed", 0, .most = DBL_MAX},
    {"scalars/boundary_updated", 0, .most_is = STEP},
    {"scalars/hull_updated", 0, .most_is = STEP},
    {"periodic/directions", 0, .most = 7},
    {"forced/id", 0, .most_is = LAST_BODY},
    {"forced/active", 0, .most = 1},
    {"ledger/turnover", 0, .most = DBL_MAX},
    {"stage/index", 0, .most_is = STAGES},
    {"stage/first_step", 0, .most_is = STEP},
    {"stage/first_time", 0, .most = DBL_MAX},
    {"stage/first_evaluations", 0, .most_is = EVALUATIONS},
    {"stage/reference", ANY_NUMBER, .most = DBL_MAX, .undefined = true},
    {"stage/samples", 0, .most_is = MANY},
    {"stage/snapshots", 0, .most_is = MANY},
    {"stage/counter", -2, .most_is = MANY},
};

static const range *range_of(const char *name)
{
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; k++)
        if (strcmp(ranges[k].name, name) == 0) return &ranges[k];
    return NULL;
}

static double most_of(const range *r, const scree_state *state, const scree_model *model)
{
    switch (r->most_is) {
    case LAST_BODY:
        return (double)state->count - 1;
    case LAST_MATERIAL:
        return fmax(model->material_count - 1, model->membrane ? model->membrane_material : 0);
    case LAST_NODE:
        return (double)state->hull.node_count - 1;
    case BODIES:
        return (double)state->count;
    case LARGEST_RADIUS:
        return scree_model_largest_radius(model) * (1 + 1e-9); // round-off of a packing that has grown
    case FARTHEST:
        return FAR * scree_model_largest_radius(model);
    case STEP:
        return (double)state->step;
    case EVALUATIONS:
        return (double)state->evaluations;
    case MEMBRANE:
        return (double)state->membrane.count;
    case STAGES:
        return (double)model->config->stage_count;
    case MANY:
        return 0x1p53;
    case AS_GIVEN:
        break;
    }
    return r->most;
}

static double number_of(scree_field_type type, const unsigned char *at)
{
    union {
        double number;
        int64_t integer;
        uint64_t natural;
        float single;
        int32_t small_integer;
        uint32_t small_natural;
        uint8_t byte;
    } value;
    memcpy(&value, at, scree_field_size(type));
    switch (type) {
    case SCREE_FIELD_DOUBLE:
        return value.number;
    case SCREE_FIELD_INT64:
        return (double)value.integer;
    case SCREE_FIELD_UINT64:
        return (double)value.natural;
    case SCREE_FIELD_FLOAT:
        return (double)value.single;
    case SCREE_FIELD_INT32:
        return value.small_integer;
    case SCREE_FIELD_UINT32:
        return value.small_natural;
    case SCREE_FIELD_UINT8:
        break;
    }
    return value.byte;
}

/// What a row of the field is called, and its number.
static const char *row_of(const scree_state *state, const scree_field *field, size_t *row)
{
    switch (field->rows) {
    case SCREE_ROWS_BODIES:
        *row = state->id[*row];
        return "body";
    case SCREE_ROWS_CONTACTS:
    case SCREE_ROWS_BOOKING:
    case SCREE_ROWS_ROLLING:
        return "contact";
    case SCREE_ROWS_WALLS:
    case SCREE_ROWS_SURFACES:
        return "wall";
    default:
        return "row";
    }
}

static scree_status refuse(const scree_state *state, const scree_field *field, size_t row, double value,
                           const char *accepted, scree_error *error)
{
    if (field->rows == SCREE_ROWS_ONE)
        return scree_error_set(error, SCREE_ERROR_IO, "dataset '%s': %.9g (accepted: %s)", field->name, value,
                               accepted);
    const char *kind = row_of(state, field, &row);
    return scree_error_set(error, SCREE_ERROR_IO, "dataset '%s', %s %zu: %.9g (accepted: %s)", field->name, kind, row,
                           value, accepted);
}

/// Whether `value` is inside of the range; without one it must be finite.
static bool is_inside(const range *r, double most, double value)
{
    if (!r) return isfinite(value);
    if (isnan(value)) return r->undefined;
    if (r->most_is == LAST_MATERIAL && value != floor(value)) return false;
    double least = r->most_is == FARTHEST ? -most : r->least;
    return value <= most && (r->open ? value > least : value >= least);
}

static void describe(const range *r, double most, char *text, size_t size)
{
    if (!r || (r->least == ANY_NUMBER && most == DBL_MAX))
        (void)snprintf(text, size, "a finite number");
    else if (most == DBL_MAX)
        (void)snprintf(text, size, "finite, %s %.9g", r->open ? "more than" : "at least", r->least);
    else if (r->most_is == FARTHEST)
        (void)snprintf(text, size, "at least %.9g, at most %.9g", -most, most);
    else
        (void)snprintf(text, size, "%s%s %.9g, at most %.9g", r->most_is == LAST_MATERIAL ? "a whole number, " : "",
                       r->open ? "more than" : "at least", r->least, most);
}

static scree_status check_field(const scree_state *state, const scree_model *model, const scree_field *field,
                                scree_error *error)
{
    const range *r = range_of(field->name);
    bool real = field->type == SCREE_FIELD_DOUBLE || field->type == SCREE_FIELD_FLOAT;
    if (!real && !r) return SCREE_OK;
    double most = r ? most_of(r, state, model) : DBL_MAX;
    int components = scree_components(field->components, state->dimension);
    for (size_t row = 0; row < scree_field_rows_count(state, field); row++) {
        const unsigned char *at = scree_field_get(state, field, row);
        for (int k = 0; k < components; k++, at += scree_field_size(field->type)) {
            double value = number_of(field->type, at);
            if (is_inside(r, most, value)) continue;
            char accepted[96];
            describe(r, most, accepted, sizeof accepted);
            return refuse(state, field, row, value, accepted, error);
        }
    }
    return SCREE_OK;
}

static scree_status refuse_contact(const scree_state *state, size_t k, const char *reason, scree_error *error)
{
    return scree_error_set(error, SCREE_ERROR_IO, "dataset 'contacts/second', contact %zu of body %u: %u %s", k,
                           state->contact[k].first, state->contact[k].second, reason);
}

/// Contacts: pairs of bodies by id, or of a body with a plate or an element of a wall, each once.
static scree_status check_contacts(const scree_state *state, const scree_model *model, scree_error *error)
{
    for (size_t k = 0; k < state->contact_count; k++) {
        const scree_contact_memory *c = &state->contact[k];
        bool plate = c->second >= SCREE_WALL_ID, element = !plate && c->second >= SCREE_ELEMENT_ID;
        if (plate && c->second >= SCREE_WALL_ID + SCREE_WALL_COUNT)
            return refuse_contact(state, k, "is no plate", error);
        if (element && model->config->wall_count == 0)
            return refuse_contact(state, k, "is of a wall that the case does not have", error);
        if (!plate && !element && (c->second >= state->count || c->second < c->first))
            return refuse_contact(state, k, "is no body, or one with a lower id", error);
        if (k == 0) continue;
        const scree_contact_memory *before = c - 1;
        // In a small periodic cell a body may touch several images of another.
        bool again = c->second == before->second && !state->periodic.directions;
        if (before->first > c->first || (before->first == c->first && (before->second > c->second || again)))
            return refuse_contact(state, k, "is there twice, or not in the order of ids", error);
    }
    return SCREE_OK;
}

static scree_status refuse_count(const char *name, size_t value, const char *accepted, size_t wanted,
                                 scree_error *error)
{
    return scree_error_set(error, SCREE_ERROR_IO, "dataset '%s': %zu (accepted: %s %zu)", name, value, accepted,
                           wanted);
}

/// Boundary, membrane and what is imposed: lengths that the code of the present boundary relies on.
static scree_status check_boundary(const scree_state *state, const scree_model *model, scree_error *error)
{
    const scree_stage_state *stage = &state->stage;
    bool began = stage->index < model->config->stage_count && stage->counter >= 0;
    scree_boundary_kind kind = began ? scree_config_boundary_of(model->config, stage->index) : SCREE_BOUNDARY_AUTO;
    const scree_membrane *membrane = &state->membrane;
    const scree_hull *hull = &state->hull;
    size_t nodes = state->dimension == 3 ? hull->node_count : state->loop.count;
    bool driven = kind == SCREE_BOUNDARY_MINIMAL || kind == SCREE_BOUNDARY_AFFINE;
    if (driven && state->drive.count != 0 && state->drive.count != nodes)
        return refuse_count("drive/force", state->drive.count, "none, or as many rows as the boundary has bodies,",
                            nodes, error);
    if (membrane->count != state->count - state->grains)
        return refuse_count("membrane/rest", membrane->count, "as many rows as there are bodies beside the grains,",
                            state->count - state->grains, error);
    if (kind == SCREE_BOUNDARY_MEMBRANE && membrane->count == 0)
        return refuse_count("membrane/rest", 0, "more rows than", 0, error);
    if (membrane->count > 0 && state->dimension == 2 && (membrane->right < 2 || membrane->right + 2 > membrane->count))
        return refuse_count("scalars/membrane_right", membrane->right, "2 to 2 less than", membrane->count, error);
    if (membrane->count > 0 && state->dimension == 3 && (membrane->around < 3 || membrane->count % membrane->around))
        return refuse_count("scalars/membrane_around", membrane->around, "3 or more, a divisor of", membrane->count,
                            error);
    for (size_t k = 1; k < hull->node_count; k++)
        if (hull->id[k] <= hull->id[k - 1])
            return scree_error_set(error, SCREE_ERROR_IO, "dataset 'hull/id', row %zu: %u (accepted: ascending ids)", k,
                                   hull->id[k]);
    return SCREE_OK;
}

/// The lattice encloses a volume, and the bodies are in it or a little outside: less than a cell.
static scree_status check_cell(const scree_state *state, scree_error *error)
{
    double inverse[9], fraction[3];
    if (!state->periodic.directions) return SCREE_OK;
    if (!(scree_matrix_determinant(state->periodic.lattice) > 0))
        return scree_error_set(error, SCREE_ERROR_IO, "dataset 'periodic/lattice': its vectors enclose no volume");
    scree_matrix_invert(state->periodic.lattice, inverse);
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        scree_body_place(state, row, place);
        scree_matrix_apply(inverse, place, fraction);
        for (int k = 0; k < state->dimension; k++)
            if (scree_periodic_repeats(&state->periodic, k) && !(fraction[k] > -1 && fraction[k] < 2))
                return scree_error_set(error, SCREE_ERROR_IO,
                                       "dataset 'position', body %u: %.9g of the periodic cell along lattice vector %d "
                                       "(accepted: more than -1, less than 2)",
                                       state->id[row], fraction[k], k + 1);
    }
    return SCREE_OK;
}

/// What belongs to the case as a whole.
static scree_status check_frame(const scree_state *state, const scree_model *model, scree_error *error)
{
    if (state->tick != model->step)
        return scree_error_set(
            error, SCREE_ERROR_IO,
            "dataset 'scalars/tick': %.17g (the case has the step %.17g s; with integrator.step=auto "
            "it may depend on guard.overlap)",
            state->tick, model->step);
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        const double *n = state->wall[w].normal, length = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        // Normals are exact, or rounded once.
        if (state->wall[w].active && fabs(length - 1) > 1e-12)
            return scree_error_set(error, SCREE_ERROR_IO, "dataset 'walls/normal', wall %d: length %.9g (accepted: 1)",
                                   w, sqrt(length));
    }
    return check_cell(state, error);
}

scree_status scree_state_check(const scree_state *state, const scree_model *model, scree_error *error)
{
    if (state->count == 0) return scree_error_set(error, SCREE_ERROR_IO, "dataset 'position': there is no body");
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < scree_field_count + scree_member_count && !status; k++) {
        const scree_field *field = k < scree_field_count ? &scree_fields[k] : &scree_members[k - scree_field_count];
        if (field->role == SCREE_FIELD_STATE && scree_field_exists(field, state->dimension))
            status = check_field(state, model, field, error);
    }
    if (!status) status = check_contacts(state, model, error);
    if (!status) status = check_boundary(state, model, error);
    return status ? status : check_frame(state, model, error);
}
