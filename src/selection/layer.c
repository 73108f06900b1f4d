/// Selection of layers: rows of bodies across an axis, counted from an end of the sample.
///
/// The grains are taken in the order of their coordinates along the axis, from the end. The first one begins the first
/// row; a row holds all whose coordinates differ from that of its first body by no more than the tolerance, and the
/// next body begins the next row. In a lattice across its rows each is one of the lattice, as long as the tolerance is
/// below their distance and above their roughness; in a disordered sample rows are slices of bodies as thick as the
/// tolerance. Cost: one sort.
#include "case/check.h"
#include "module/key_rows.h"
#include "selection/selection.h"
#include "state/body.h"

#include <stdlib.h>

typedef struct select_layer {
    int axis;            ///< 0 to 2
    int high;            ///< 1: counted from the largest coordinates
    int64_t first, last; ///< from 1
    double tolerance;    ///< m; auto: half the mean radius
} select_layer;

typedef struct depth {
    double value; ///< m
    size_t row;
} depth;

static int compare(const void *one, const void *other)
{
    double a = ((const depth *)one)->value, b = ((const depth *)other)->value;
    return (a > b) - (a < b);
}

static scree_status choose(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                           scree_error *error)
{
    const select_layer *layer = own;
    depth *body;
    size_t count = 0;
    scree_status status = scree_allocate(&body, state->count + 1, sizeof *body, error);
    if (status) return status;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        if (!scree_body_is_grain(state, row)) continue;
        scree_body_position(state, row, place);
        body[count++] = (depth){layer->high ? -place[layer->axis] : place[layer->axis], row};
    }
    qsort(body, count, sizeof *body, compare);
    double tolerance = isnan(layer->tolerance) ? 0.5 * model->mean_radius : layer->tolerance;
    double begin = -INFINITY;
    int64_t number = 0;
    for (size_t k = 0; k < count && number <= layer->last; k++) {
        if (body[k].value > begin + tolerance) {
            begin = body[k].value;
            number++;
        }
        chosen[body[k].row] = number >= layer->first && number <= layer->last;
    }
    scree_release(&body);
    return SCREE_OK;
}

static void rules(scree_reader *reader, const scree_config *config)
{
    for (int64_t i = 0; i < config->selection_count; i++) {
        const select_layer *layer = config->selections[i].own;
        char path[SCREE_PATH_BYTES];
        if (config->selections[i].kind != SCREE_SLOT_select_layer || !layer) continue;
        (void)snprintf(path, sizeof path, "selections.%lld.last", (long long)i);
        if (layer->last < layer->first) scree_rule_refuse(reader, path, NULL, "is before the first one");
        (void)snprintf(path, sizeof path, "selections.%lld.axis", (long long)i);
        if (layer->axis >= config->dimension)
            scree_rule_refuse(reader, path, "x, y", "there is no z in two dimensions");
    }
}

static const scree_choice axes[] = {
    {"x", 0, "rows across x"}, {"y", 1, "rows across y"}, {"z", 2, "rows across z"}, {0}};
static const scree_choice ends[] = {
    {"low", 0, "where the coordinate is least"}, {"high", 1, "where it is largest"}, {0}};
static const scree_key keys[] = {
    CHOICE(select_layer, axis, axes, .meaning = "Coordinate that the particles of a row have in common."),
    {.name = "end",
     .type = SCREE_KEY_CHOICE,
     .choices = ends,
     .offset = offsetof(select_layer, high),
     .meaning = "Where counting begins."},
    INTEGER(select_layer, first, .standard = "1", FROM("1"), TO("1e8"), .meaning = "First row."),
    INTEGER(select_layer, last, .standard = "1", FROM("1"), TO("1e8"), .meaning = "Last row."),
    NUMBER(select_layer, tolerance, "m", .standard = "auto", FROM("0 m"), TO("1e6 m"),
           .meaning = "By how much coordinates in a row may differ; auto: half the mean radius."),
};
static const scree_selection_kind kind = {.choose = choose};

const scree_module scree_module_select_layer = {
    .name = "layer",
    .meaning = "Particles of the first rows across an axis, counted from an end of the sample.",
    .choice_of = CHOICE_OF(IS("selections")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, select_layer)},
    .keys_count = 1,
    .rules = rules,
    .selection = &kind,
};
