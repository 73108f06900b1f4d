/// Outlets. A region is a box; a particle is in it when its centre is. What has come out is what is in the region now,
/// and what was taken out of it; so a region below a hole counts without taking anything out, as long as what it has
/// counted stays there.
///
/// Particles are taken out between two steps, every so many of them, with what they exert and the energy that they have
/// (measure/removal.h): the balance stays closed. Their number and mass are sums free of order. Cost: one pass over the
/// bodies at each look; a rebuild of the neighbour list when something is taken out.
#include "load/outlet.h"

#include "base/checksum.h"
#include "comm/comm.h"
#include "measure/removal.h"
#include "module/key_rows.h"
#include "shape/wall_set.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

enum { MOST_OUTLETS = 16 }; // loads of a case

/// What an outlet has taken out.
typedef struct taken {
    uint64_t count;
    double mass; ///< kg
} taken;

/// State of the module.
typedef struct outlets {
    taken taken[MOST_OUTLETS];
} outlets;

static outlets *own_state(const scree_state *state)
{
    return state->own[SCREE_SLOT_outlet];
}

const scree_outlet *scree_outlet_of(const scree_config_load *loads, int64_t count, size_t index)
{
    for (int64_t i = 0; i < count; i++)
        if (loads[i].kind == SCREE_SLOT_outlet && index-- == 0) return loads[i].own;
    return NULL;
}

void scree_outlet_name(const scree_outlet *outlet, size_t index, char name[SCREE_RESULT_NAME])
{
    if (outlet->name)
        (void)snprintf(name, SCREE_RESULT_NAME, "%.60s", outlet->name);
    else
        (void)snprintf(name, SCREE_RESULT_NAME, index > 0 ? "outlet%zu" : "outlet", index + 1);
}

static const scree_outlet *outlet_of(const scree_model *model, size_t index)
{
    return scree_outlet_of(model->loads, model->load_count, index);
}

/// Whether the particle in this row has come out; bodies of membranes do not.
static bool is_inside(const scree_state *state, const scree_outlet *outlet, size_t row)
{
    scree_vector place;
    if (!scree_body_is_grain(state, row)) return false;
    scree_body_position(state, row, place);
    for (int k = 0; k < state->dimension; k++)
        if (place[k] < outlet->lower[k] || place[k] > outlet->upper[k]) return false;
    return true;
}

/// Number and mass [kg] of what is in the region.
static taken look(const scree_state *state, const scree_outlet *outlet)
{
    taken inside = {0};
    scree_integer_sum mass = {0};
    int64_t count = 0;
    while (scree_comm_sum_next(state, &mass, 1)) {
        count = 0;
        for (size_t row = 0; row < state->count; row++) {
            if (!is_inside(state, outlet, row)) continue;
            count++;
            scree_integer_sum_add(&mass, state->row[row].mass);
        }
    }
    scree_comm_add(state, &count, 1);
    inside.count = (uint64_t)count;
    inside.mass = scree_integer_sum_total(&mass);
    return inside;
}

static scree_status take_out(const scree_context *c, const scree_outlet *outlet, taken *own, scree_error *error)
{
    scree_state *state = c->state;
    const taken inside = look(state, outlet);
    uint32_t *ids;
    size_t count = 0, id = 0;
    if (inside.count == 0) return SCREE_OK;
    scree_status status = scree_allocate(&ids, state->count, sizeof *ids, error);
    for (uint32_t row; !status && (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;)
        if (is_inside(state, outlet, row)) ids[count++] = state->id[row];
    if (!status && count > 0) status = scree_bodies_remove(c->model, state, c->work, ids, count, error);
    scree_release(&ids);
    if (status) return status;
    own->count += inside.count;
    own->mass += inside.mass;
    return SCREE_OK;
}

static scree_status decide(const scree_context *c, scree_error *error)
{
    const scree_outlet *outlet;
    scree_status status = SCREE_OK;
    if (c->state->part) return SCREE_OK; // `takes_out` has found that there is nothing
    for (size_t k = 0; !status && (outlet = outlet_of(c->model, k)); k++)
        if (outlet->removes && c->state->step % (uint64_t)outlet->every == 0)
            status = take_out(c, outlet, &own_state(c->state)->taken[k], error);
    return status;
}

static bool in_use(const scree_context *c)
{
    return outlet_of(c->model, 0) != NULL;
}

/// Whether all corners of the region lie within wall `k`.
static bool is_within(const scree_context *c, const scree_outlet *outlet, int k)
{
    const int dimension = c->state->dimension;
    for (int corner = 0; corner < 1 << dimension; corner++) {
        scree_vector place = {0};
        for (int i = 0; i < dimension; i++) place[i] = corner >> i & 1 ? outlet->upper[i] : outlet->lower[i];
        if (scree_surface_clearance(c->work->wall_set, k, place, c->model->mean_radius) >= 0) return false;
    }
    return true;
}

/// A stage begins, and walls stand: nothing comes into a region that lies within one.
static scree_status begin(const scree_context *c, scree_error *error)
{
    const scree_outlet *outlet;
    for (size_t i = 0; (outlet = outlet_of(c->model, i)); i++)
        for (int k = 0; c->work->wall_set && k < c->work->wall_set->count; k++) {
            if (!is_within(c, outlet, k)) continue;
            scree_error_set(error, SCREE_ERROR_INPUT,
                            "the region of the outlet lies within the wall '%s', where no particle comes: give it "
                            "another `lower` and `upper`",
                            c->work->wall_set->surface[k].config->name);
            int64_t load = 0;
            while (c->model->loads[load].own != (const void *)outlet) load++;
            return scree_error_key(error, SCREE_ERROR_INPUT, "loads.%lld.upper", (long long)load);
        }
    return SCREE_OK;
}

static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const scree_outlet *outlet;
    for (size_t k = 0; (outlet = outlet_of(model, k)); k++) {
        if (!outlet->removes) continue; // what only counts changes nothing
        c = scree_checksum_word(c, own_state(state)->taken[k].count);
        c = scree_checksum_number(c, own_state(state)->taken[k].mass);
    }
    return c;
}

// ---- the case ------------------------------------------------------------------------------------------------------

static void refuse(scree_reader *reader, int64_t load, const char *key, const char *message)
{
    char path[SCREE_PATH_BYTES];
    scree_rule_refuse(reader, scree_element_path(path, "loads", load, key), NULL, "%s", message);
}

static void check_name(scree_reader *reader, const scree_config *whole, int64_t load)
{
    const scree_outlet *own = whole->loads[load].own;
    for (int64_t i = 0; i < load && own->name; i++) {
        const scree_outlet *other = whole->loads[i].kind == SCREE_SLOT_outlet ? whole->loads[i].own : NULL;
        if (other && other->name && strcmp(own->name, other->name) == 0)
            refuse(reader, load, "name", "another outlet has this name");
    }
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    for (int64_t i = 0; i < whole->load_count; i++) {
        if (whole->loads[i].kind != SCREE_SLOT_outlet || !whole->loads[i].own) continue;
        const scree_outlet *own = whole->loads[i].own;
        check_name(reader, whole, i);
        for (int k = 0; k < whole->dimension; k++)
            if (own->lower[k] >= own->upper[k]) {
                refuse(reader, i, "upper",
                       "no coordinate of `upper` may be as small as that of `lower`: the region is empty");
                break;
            }
    }
}

#define PLACE(member, text)                                                                                            \
    KEY(scree_outlet, member, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"), .meaning = text)
static const scree_key keys[] = {
    KEY(scree_outlet, name, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("40"),
        .meaning = "Name in front of its columns and results; auto: outlet, from the second on with its number."),
    PLACE(lower, "Corner of the region with the smallest coordinates."),
    PLACE(upper, "Corner of the region with the largest coordinates."),
    FLAG(scree_outlet, removes, .standard = "yes",
         .meaning = "Particles whose centre is in the region are taken out; no: they are counted."),
    INTEGER(scree_outlet, every, .standard = "100", FROM("1"), TO("1e9"), .when = "removes=yes",
            .meaning = "Steps between two looks."),
    NUMBER(scree_outlet, orifice, "m", .standard = "auto", ABOVE("0 m"), TO("1e4 m"),
           .meaning = "Diameter, in 2D width, of the hole that particles come through, for Beverloo's law; auto: not "
                      "compared."),
    NUMBER(scree_outlet, bulk_density, "kg/m3", .standard = "auto", ABOVE("0 kg/m3"), TO("1e12 kg/m3"),
           .meaning =
               "Density of what flows, with its voids, for Beverloo's law; auto: 0.6 of that of the grains, 0.82 "
               "in 2D."),
};

static const scree_field fields[] = {
    SCREE_FIELD_FIXED(outlet, outlets, taken, MOST_OUTLETS, taken, count, "outlets/count", SCREE_FIELD_UINT64, 1, "1",
                      "particles that the outlet has taken out", SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    SCREE_FIELD_FIXED(outlet, outlets, taken, MOST_OUTLETS, taken, mass, "outlets/mass", SCREE_FIELD_DOUBLE, 1, "kg",
                      "their mass", SCREE_RANGE(0, DBL_MAX)),
};

/// Whether there is something to be taken out.
static scree_status takes_out(const scree_context *c, bool *wanted, scree_error *error)
{
    const scree_outlet *outlet;
    (void)error;
    *wanted = false;
    for (size_t k = 0; (outlet = outlet_of(c->model, k)) && !*wanted; k++)
        *wanted = outlet->removes && c->state->step % (uint64_t)outlet->every == 0 && look(c->state, outlet).count > 0;
    return SCREE_OK;
}

static const scree_pass passes[] = {{SCREE_PHASE_DECIDE, .run = decide, .whole = takes_out}};

static const scree_result columns[] = {
    {"_outflow", "1", "particles that have come into the region of the outlet of this name, or were taken out there"},
    {"_outflow_mass", "kg", "their mass"},
};

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    const scree_outlet *outlet = scree_outlet_of(whole->loads, whole->load_count, index);
    if (!outlet) return false;
    scree_outlet_name(outlet, index, name);
    return true;
}

void scree_outlet_sample(const scree_model *model, const scree_state *state, size_t index, double value[2])
{
    const taken *own = &own_state(state)->taken[index], inside = look(state, outlet_of(model, index));
    value[0] = (double)(own->count + inside.count);
    value[1] = own->mass + inside.mass;
}

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    (void)error;
    scree_outlet_sample(c->model, c->state, index, value);
    return SCREE_OK;
}

const scree_module scree_module_outlet = {
    .name = "outlet",
    .meaning = "A region that takes out the particles that come into it, or counts them.",
    .choice_of = CHOICE_OF(IS("loads")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, scree_outlet)},
    .keys_count = 1,
    .rules = rules,
    .state_size = sizeof(outlets),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .checksum = checksum,
    .begin = begin,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
    .results = SCREE_RESULTS(columns, sample),
    .told = told,
};
