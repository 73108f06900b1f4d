/// The module of bonds: state, the pass in which they break, columns and results. The energy of fracture is work that
/// the bonds have taken from the bodies and their springs, so the balance of energies stays closed.
///
/// Cost: a flag in a step in which nothing breaks, else a pass over the bonds.
#include "bond/bond.h"

#include "base/checksum.h"
#include "case/config.h"
#include "comm/comm.h"
#include "contact/settle.h"
#include "module/stage.h"
#include "state/fields.h"
#include "state/persistent.h"

#include <math.h>

typedef scree_bonds own;

static const scree_group breaks = {
    .row = "broken bond",
    .symbol = "z",
    .count_offset = offsetof(own, count),
    .capacity_offset = offsetof(own, capacity),
};

#define BREAK(name, member, type, components, unit, meaning, ...)                                                      \
    SCREE_FIELD_GROUP(bonds, own, breaks, event, scree_break, "bonds/" name, type, components, unit, meaning,          \
                      .offset = offsetof(scree_break, member), __VA_ARGS__)
static const scree_field fields[] = {
    BREAK("time", time, SCREE_FIELD_DOUBLE, 1, "s", "when the bond broke"),
    BREAK("step", step, SCREE_FIELD_UINT64, 1, "1", "and at which step", SCREE_RANGE_TO(SCREE_LIMIT_STEP)),
    BREAK("first", first, SCREE_FIELD_UINT32, 1, "1", "id of its first body", SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    BREAK("second", second, SCREE_FIELD_UINT32, 1, "1", "id of its second body, larger than the first",
          SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    BREAK("mode", mode, SCREE_FIELD_UINT32, 1, "1", "how it broke: 0 in tension, 1 in shear",
          SCREE_RANGE(0, SCREE_BREAK_SHEAR)),
    BREAK("place", place, SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m", "of its contact on the first body"),
    BREAK("normal", normal, SCREE_FIELD_DOUBLE, SCREE_VECTOR, "1", "unit vector from its second to its first body"),
    BREAK("normal_force", normal_force, SCREE_FIELD_DOUBLE, 1, "N", "that broke it, negative in tension"),
    BREAK("tangential_force", tangential_force, SCREE_FIELD_DOUBLE, 1, "N", "that broke it, magnitude"),
    BREAK("energy", energy, SCREE_FIELD_DOUBLE, 1, "J", "that went as fracture"),
    SCREE_FIELD_ONE(bonds, own, made, "bonds/made", SCREE_FIELD_UINT64, 1, "1", "bonds that have been made",
                    SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    SCREE_FIELD_ONE(bonds, own, fracture, "bonds/fracture", SCREE_FIELD_DOUBLE, 1, "J",
                    "energy that went with bonds that broke"),
    SCREE_FIELD_ONE(bonds, own, bonding, "bonds/bonding", SCREE_FIELD_DOUBLE, 1, "J",
                    "energy that contacts had where bonds took their place"),
};

size_t scree_bonds_standing(const scree_state *state)
{
    const scree_persistent_list *list = scree_persistent(state);
    int64_t count = 0;
    for (size_t k = 0; k < list->count; k++) count += list->member[k].constant[SCREE_MEMBER_TENSION] >= 0;
    scree_comm_add(state, &count, 1);
    return (size_t)count;
}

// ---- breaking ----------------------------------------------------------------------------------------------------

static void note(scree_state *state, const contact_settled *settled)
{
    own *bonds = scree_bonds_of(state);
    scree_break *event = &bonds->event[bonds->count++];
    *event = (scree_break){.time = scree_state_time(state),
                           .step = state->step,
                           .first = settled->first,
                           .second = settled->second,
                           .mode = settled->in_tension ? SCREE_BREAK_TENSION : SCREE_BREAK_SHEAR,
                           .normal_force = settled->normal_force,
                           .tangential_force = settled->tangential_force,
                           .energy = settled->energy};
    for (int i = 0; i < 3; i++) {
        event->place[i] = settled->place[i];
        event->normal[i] = settled->normal[i];
    }
    bonds->fracture += settled->energy;
    state->ledger.turnover += fabs(settled->energy);
}

static scree_status settle(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    contact_settled *settled;
    size_t count, parted = 0, dropped = 0, *number = NULL;
    if (!c->work->settle) return SCREE_OK;
    scree_status status = contact_settle(c->model, state, c->work, &settled, &count, error);
    if (!status) status = scree_allocate(&number, count, sizeof *number, error);
    if (!status)
        status = scree_group_reserve(state, &scree_module_bonds, &breaks, scree_bonds_of(state)->count + count, error);
    for (size_t k = 0; k < count && !status; k++) {
        if (!settled[k].parted) {
            note(state, &settled[k]);
            continue;
        }
        parted++;
        number[dropped] = scree_persistent_find(state, settled[k].first, settled[k].second);
        dropped += number[dropped] != SIZE_MAX; // else with another process
    }
    if (!status) scree_persistent_drop(state, number, dropped);
    if (!status) scree_persistent(state)->total -= parted;
    scree_release(&number);
    scree_release(&settled);
    return status;
}

static bool in_use(const scree_context *c)
{
    return scree_persistent_total(c->state) > 0;
}

static const scree_pass passes[] = {{SCREE_PHASE_CONTACTS, .run = settle}};

static double work(const scree_state *state)
{
    return -(scree_bonds_of(state)->fracture + scree_bonds_of(state)->bonding);
}

/// Where bonds have been made: how many, how many broke, and the energies.
static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const own *bonds = scree_bonds_of(state);
    (void)model;
    if (bonds->made == 0) return c;
    c = scree_checksum_word(scree_checksum_word(c, bonds->made), bonds->count);
    return scree_checksum_number(scree_checksum_number(c, bonds->fracture), bonds->bonding);
}

static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    const own *bonds = scree_bonds_of(state);
    (void)model;
    for (size_t k = 1; k < bonds->count; k++)
        if (bonds->event[k].step < bonds->event[k - 1].step)
            return scree_error_set(error, SCREE_ERROR_IO, "dataset 'bonds/step', row %zu: %llu after %llu", k,
                                   (unsigned long long)bonds->event[k].step,
                                   (unsigned long long)bonds->event[k - 1].step);
    return SCREE_OK;
}

// ---- what is told ------------------------------------------------------------------------------------------------

static size_t broken(const scree_state *state, uint32_t mode)
{
    const own *bonds = scree_bonds_of(state);
    size_t count = 0;
    for (size_t k = 0; k < bonds->count; k++) count += bonds->event[k].mode == mode;
    return count;
}

static const scree_result columns[] = {
    {"bonds", "1", "bonds that stand"},
    {"broken_tension", "1", "bonds that have broken in tension"},
    {"broken_shear", "1", "bonds that have broken in shear"},
    {"energy_fracture", "J", "energy that went with bonds that broke"},
    {"energy_bonding", "J", "energy that contacts had where bonds took their place"},
};

static const scree_result results[] = {
    {"bonds_made", "1", "bonds that were made"},
    {"bonds_left", "1", "bonds that stand at the end"},
    {"bonds_broken_tension", "1", "bonds that broke in tension"},
    {"bonds_broken_shear", "1", "bonds that broke in shear"},
    {"fracture_energy", "J", "energy that went with bonds that broke"},
    {"first_break_time", "s", "when the first bond broke"},
};

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    (void)index, (void)error;
    const scree_state *state = c->state;
    value[0] = (double)scree_bonds_standing(state);
    value[1] = (double)broken(state, SCREE_BREAK_TENSION);
    value[2] = (double)broken(state, SCREE_BREAK_SHEAR);
    value[3] = scree_bonds_of(state)->fracture;
    value[4] = scree_bonds_of(state)->bonding;
    return SCREE_OK;
}

static scree_status summarise(const scree_context *c, size_t index, double *value, scree_error *error)
{
    (void)index, (void)error;
    const scree_state *state = c->state;
    const own *bonds = scree_bonds_of(state);
    value[0] = (double)bonds->made;
    value[1] = (double)scree_bonds_standing(state);
    value[2] = (double)broken(state, SCREE_BREAK_TENSION);
    value[3] = (double)broken(state, SCREE_BREAK_SHEAR);
    value[4] = bonds->fracture;
    value[5] = bonds->count > 0 ? bonds->event[0].time : NAN;
    return SCREE_OK;
}

/// In cases that make bonds.
static bool told(const scree_config *config, size_t index, char name[SCREE_RESULT_NAME])
{
    name[0] = 0;
    for (int64_t i = 0; i < config->stage_count && index == 0; i++)
        if (config->stages[i].kind >= 0 && scree_modules[config->stages[i].kind]->numbers->bonds) return true;
    return false;
}

const scree_module scree_module_bonds = {
    .name = "bonds",
    .meaning = "bonds, and those that broke",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .checksum = checksum,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .spreads = true,
    .work = work,
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
    .results = SCREE_RESULTS(results, summarise),
    .told = told,
};
