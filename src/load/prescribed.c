/// The module of prescribed bodies: keys, fields, columns. Method: prescribed_step.c; who is prescribed what:
/// prescribed_begin.c.
#include "load/prescribed.h"

#include "base/checksum.h"
#include "base/fixed.h"
#include "base/wide_sum.h"
#include "comm/comm.h"
#include "module/key_rows.h"

#include <stdio.h>
#include <string.h>

typedef scree_prescribed own;
typedef scree_prescribed_config config;

// ---- keys --------------------------------------------------------------------------------------------------------

static const scree_choice pers[] = {
    {"body", SCREE_PER_BODY, "forces and torques are on each particle"},
    {"selection", SCREE_PER_SELECTION, "they are on the whole selection, in equal parts on those that are there"},
    {0},
};
static const scree_choice attacks[] = {
    {"centre", SCREE_ATTACK_CENTRE, "at the centre: it turns nothing"},
    {"surface", SCREE_ATTACK_SURFACE, "on the surface, where `direction` points from the centre: its torque acts too"},
    {0},
};
#define COMPONENT(key, member, index, si, limit, text)                                                                 \
    {                                                                                                                  \
        .name = key, .type = SCREE_KEY_SCHEDULE, .unit = si, .standard = "auto", FROM("-" limit), TO(limit),           \
        .offset = offsetof(config, member) + (index) * sizeof(scree_schedule), .meaning = text                         \
    }
#define VELOCITY(axis, index)                                                                                          \
    COMPONENT("velocity_" axis, motion, index, "m/s", "1e6 m/s", "Velocity along " axis "; 0: held; auto: free.")
#define SPIN(axis, index)                                                                                              \
    COMPONENT("spin_" axis, motion, 3 + index, "rad/s", "1e9 rad/s", "Spin about " axis "; 0: held; auto: free.")
#define FORCE(axis, index) COMPONENT("force_" axis, push, index, "N", "1e15 N", "Force along " axis "; auto: none.")
#define TORQUE(axis, index)                                                                                            \
    COMPONENT("torque_" axis, push, 3 + index, "N m", "1e15 N m", "Torque about " axis "; auto: none.")
#define PROFILE(key, member, kind, ...)                                                                                \
    {                                                                                                                  \
        .name = key, .type = kind, .offset = offsetof(config, profile.member), __VA_ARGS__                             \
    }
#define PROFILED .when = "profile=cosine"
#define STAGE(member, text)                                                                                            \
    KEY(config, member, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"), .meaning = text)

static const scree_key keys[] = {
    KEY(config, name, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name in series.csv and summary.json; auto: that of the selection."),
    KEY(config, selection, SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name of one of the `selections`."),
    STAGE(from, "Name of the first stage in which it acts; auto: the first one. Times of schedules begin with it."),
    STAGE(until, "Name of the last stage in which it acts; auto: the last one."),
    VELOCITY("x", 0),
    VELOCITY("y", 1),
    VELOCITY("z", 2),
    SPIN("x", 0),
    SPIN("y", 1),
    SPIN("z", 2),
    PROFILE("profile", shape, SCREE_KEY_CHOICE, .choices = scree_load_profile_shapes, .standard = "uniform",
            .meaning = "What velocities and spins are multiplied by, by the position of a particle when it comes to be "
                       "driven."),
    PROFILE("axis", axis, SCREE_KEY_CHOICE, .choices = scree_load_profile_axes, .standard = "x", PROFILED,
            .meaning = "Direction in which it changes."),
    PROFILE("wavelength", wavelength, SCREE_KEY_NUMBER, .unit = "m", ABOVE("0 m"), TO("1e6 m"), PROFILED,
            .meaning = "Of the cosine."),
    PROFILE("phase", phase, SCREE_KEY_NUMBER, .unit = "rad", .standard = "0 rad", FROM("-1e3 rad"), TO("1e3 rad"),
            PROFILED, .meaning = "Of the cosine at `origin`."),
    PROFILE("offset", offset, SCREE_KEY_NUMBER, .unit = "1", .standard = "0", FROM("-1e6"), TO("1e6"), PROFILED,
            .meaning = "Added to the cosine; 1 beside a phase of 0 makes a bell of half a wavelength to each side."),
    TENSOR(config, gradient, scree_gradient_components, "1/s", FROM("-1e9 1/s"), TO("1e9 1/s"),
           .meaning = "Velocity gradient, added to the velocities: gradient x (position at the begin - `origin`)."),
    {.name = "gradient_factor",
     .type = SCREE_KEY_SCHEDULE,
     .unit = "1",
     .standard = "1",
     FROM("-1e9"),
     TO("1e9"),
     .offset = offsetof(config, factor),
     .meaning = "Factor of the gradient."},
    KEY(config, origin, SCREE_KEY_VECTOR, .unit = "m", .standard = "[0, 0]", FROM("-1e6 m"), TO("1e6 m"),
        .meaning = "Point in which the gradient adds nothing, and from which the profile is counted."),
    FORCE("x", 0),
    FORCE("y", 1),
    FORCE("z", 2),
    TORQUE("x", 0),
    TORQUE("y", 1),
    TORQUE("z", 2),
    NUMBER(config, until_force, "N", .standard = "auto", ABOVE("0 N"), TO("1e15 N"),
           .meaning = "The velocity of the selection ends when all other forces on it together reach this against it; "
                      "from then on this force acts along it instead, on the whole selection: a piston. auto: never."),
    CHOICE(config, per, pers, .standard = "body", .meaning = "What forces and torques are on."),
    CHOICE(config, attack, attacks, .standard = "centre", .meaning = "Where forces act."),
    KEY(config, direction, SCREE_KEY_VECTOR, .unit = "1", .standard = "[0, 0]", FROM("-1e6"), TO("1e6"),
        .when = "attack=surface",
        .meaning = "From the centre to the point on which forces act, any length, fixed in space; [0, 0]: where they "
                   "turn nothing."),
};

// ---- state -------------------------------------------------------------------------------------------------------

#define BODY(member, type, name, kind, count, unit, meaning, ...)                                                      \
    SCREE_FIELD_BODY(prescribed, own, member, type, "prescribed/" name, kind, count, unit, meaning, .optional = true,  \
                     __VA_ARGS__)
#define LOAD(member, type, kind, unit, meaning, ...)                                                                   \
    {                                                                                                                  \
        SCREE_FIELD_OF(prescribed, SCREE_ROWS_FIXED, "prescribed/" #member, kind, 1, unit, meaning),                   \
            .fixed = SCREE_LOADS, .array_offset = offsetof(own, member), .stride = sizeof(type), __VA_ARGS__           \
    }
static const scree_field fields[] = {
    BODY(owner, scree_owners, "owner", SCREE_FIELD_UINT8, 8, "1",
         "load that prescribes each component, counted from 1: velocity, spin, surface; 0: none",
         SCREE_RANGE(0, SCREE_LOADS)),
    BODY(by, scree_owners, "by", SCREE_FIELD_UINT8, 8, "1", "the same of the loads that have made the last forces",
         SCREE_RANGE(0, SCREE_LOADS)),
    BODY(exerted, scree_exerted, "exerted", SCREE_FIELD_INT64, 9, "1",
         "force, torque, torque of forces on the surface, of the loads, in units of scalars/force_quantum and "
         "torque_quantum",
         SCREE_RANGE(-0x1p61, 0x1p61)),
    BODY(exerted, scree_exerted, "spread", SCREE_FIELD_DOUBLE, 6, "J",
         "symmetric part of arm (x) force of a force on the surface of a body that deforms: xx, yy, zz, yz, xz, xy",
         .offset = offsetof(scree_exerted, spread)),
    BODY(reference, scree_vector, "reference", SCREE_FIELD_DOUBLE, 3, "m", "position when it came to be driven"),
    BODY(departure, scree_departure, "departure", SCREE_FIELD_DOUBLE, 10, "1",
         "position and acceleration before a step", .role = SCREE_FIELD_DERIVED),
    BODY(row, uint32_t, "row", SCREE_FIELD_UINT32, 1, "1", "rows of the bodies that loads prescribe",
         .role = SCREE_FIELD_DERIVED),
    SCREE_FIELD_ONE(prescribed, own, listed, "prescribed/listed", SCREE_FIELD_UINT64, 1, "1", "number of these bodies",
                    .role = SCREE_FIELD_DERIVED),
    LOAD(acts, int64_t, SCREE_FIELD_INT64, "1", "1: the load acts in the present stage", SCREE_RANGE(0, 1)),
    LOAD(begun, double, SCREE_FIELD_DOUBLE, "s", "when it began to act"),
    LOAD(work, double, SCREE_FIELD_DOUBLE, "J", "work of the load on the bodies"),
    {SCREE_FIELD_OF(prescribed, SCREE_ROWS_FIXED, "prescribed/given", SCREE_FIELD_DOUBLE, 3, "N",
                    "force on the selection in place of a velocity that has ended; 0: it has not"),
     .fixed = SCREE_LOADS, .array_offset = offsetof(own, given), .stride = sizeof(scree_vector)},
};

/// Loads are those of the case, and there is room for all that they need.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    const own *all = scree_prescribed_of(state);
    bool acts = false;
    for (int64_t k = 0; k < SCREE_LOADS; k++) {
        if (!all->acts[k]) continue;
        acts = true;
        if (k >= model->load_count || !scree_prescribed_config_of(model->loads, k))
            return scree_error_set(error, SCREE_ERROR_IO, "dataset 'prescribed/acts': load %lld is no such load",
                                   (long long)k);
    }
    if (acts && !(all->owner && all->by && all->exerted && all->reference && state->held))
        return scree_error_set(error, SCREE_ERROR_IO, "dataset 'prescribed/owner': missing, although a load acts");
    for (size_t row = 0; row < state->count && all->owner; row++)
        for (int d = 0; d <= SCREE_COMPONENTS; d++) {
            int load = all->owner[row][d];
            if (load && !all->acts[load - 1])
                return scree_error_set(error, SCREE_ERROR_IO, "dataset 'prescribed/owner': load %d does not act", load);
            if (d < SCREE_COMPONENTS && state->held[row] >> d & 1 && !load)
                return scree_error_set(error, SCREE_ERROR_IO, "dataset 'held': no load drives body %u", state->id[row]);
        }
    return SCREE_OK;
}

static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const own *all = scree_prescribed_of(state);
    for (int64_t k = 0; k < model->load_count; k++) {
        const config *said = scree_prescribed_config_of(model->loads, k);
        if (said) c = scree_checksum_number(scree_checksum_number(c, all->begun[k]), all->work[k]);
        for (int d = 0; d < 3 && said && said->until_force > 0; d++) c = scree_checksum_number(c, all->given[k][d]);
    }
    return c;
}

static double work(const scree_state *state)
{
    double sum = 0;
    for (int k = 0; k < SCREE_LOADS; k++) sum += scree_prescribed_of(state)->work[k];
    return sum;
}

/// There may be forces from the stage before.
static bool in_use(const scree_context *c)
{
    return scree_prescribed_of(c->state)->owner != NULL;
}

/// The derived array is not in checkpoints.
static scree_status depart(const scree_context *c, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < sizeof fields / sizeof *fields && !status; k++)
        if (fields[k].role == SCREE_FIELD_DERIVED && fields[k].optional)
            status = scree_state_begin_field(c->state, &fields[k], error);
    return status ? status : scree_prescribed_depart(c, error);
}

static const scree_pass passes[] = {{SCREE_PHASE_DECIDE, .run = depart},
                                    {SCREE_PHASE_FIRST_HALF, .run = scree_prescribed_move},
                                    {SCREE_PHASE_FOLLOW, .run = scree_prescribed_attack},
                                    {SCREE_PHASE_LOADS, .run = scree_prescribed_push},
                                    {SCREE_PHASE_RESULTANTS, .run = scree_prescribed_hold}};

// ---- what each tells ---------------------------------------------------------------------------------------------

/// Number among the loads of the one with this number among those of this kind; -1: there are fewer.
static int64_t load_of(const scree_config_load *loads, int64_t count, size_t index)
{
    for (int64_t i = 0; i < count; i++)
        if (scree_prescribed_config_of(loads, i) && index-- == 0) return i;
    return -1;
}

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    int64_t load = load_of(whole->loads, whole->load_count, index);
    if (load < 0) return false;
    (void)snprintf(name, SCREE_RESULT_NAME, "%s",
                   scree_prescribed_name(scree_prescribed_config_of(whole->loads, load)));
    return true;
}

/// Columns at every sample, and results at the end.
static const scree_result rows[] = {
    {"_exerted_force_x", "N",
     "force of the load of this name on its bodies: applied, or the reaction that drives them"},
    {"_exerted_force_y", "N", "the same along y"},
    {"_exerted_force_z", "N", "the same along z"},
    {"_exerted_torque_x", "N m", "torque of the load of this name on its bodies, about their own centres"},
    {"_exerted_torque_y", "N m", "the same about y"},
    {"_exerted_torque_z", "N m", "the same about z"},
    {"_exerted_work", "J", "work of the load of this name on its bodies since the begin of the run"},
    {"_bodies", "1", "bodies that it acts on now"},
};
enum { WORK = SCREE_COMPONENTS, BODIES };

static void sum_forces(const scree_state *state, int64_t load, double sum[SCREE_COMPONENTS])
{
    const own *all = scree_prescribed_of(state);
    scree_wide_sum part = {{0}};
    double total[9];
    scree_wide_integer *quanta = part.value;
    for (size_t row = 0; row < state->count && all->by; row++)
        for (int d = 0; d < SCREE_COMPONENTS; d++) {
            if (all->by[row][d] == load + 1) quanta[d] += all->exerted[row].quanta[d];
            if (d >= 3 && all->by[row][SCREE_LEVER] == load + 1) quanta[d] += all->exerted[row].lever[d - 3];
        }
    scree_comm_wide_total(state, &part, 1, 1, total);
    for (int d = 0; d < SCREE_COMPONENTS; d++)
        sum[d] = total[d] * (d < 3 ? state->force_quantum : state->torque_quantum);
}

void scree_prescribed_force(const scree_state *state, int64_t load, double force[3])
{
    double sum[SCREE_COMPONENTS];
    sum_forces(state, load, sum);
    memcpy(force, sum, 3 * sizeof *force);
}

static scree_status measure(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const own *all = scree_prescribed_of(c->state);
    int64_t load = load_of(c->model->loads, c->model->load_count, index), bodies = 0;
    (void)error;
    sum_forces(c->state, load, value);
    for (size_t row = 0; row < c->state->count && all->owner; row++) {
        bool belongs = false;
        for (int d = 0; d < SCREE_COMPONENTS; d++) belongs = belongs || all->owner[row][d] == load + 1;
        bodies += belongs;
    }
    scree_comm_add(c->state, &bodies, 1);
    value[WORK] = all->work[load];
    value[BODIES] = (double)bodies;
    return SCREE_OK;
}

const scree_module scree_module_prescribed = {
    .name = "prescribed",
    .meaning = "Particles of a selection that move as prescribed, or bear prescribed forces.",
    .choice_of = CHOICE_OF(IS("loads")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .rules = scree_prescribed_rules,
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .checksum = checksum,
    .begin = scree_prescribed_begin,
    .begins_whole = scree_prescribed_begins_whole,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .spreads = true,
    .bound = scree_prescribed_bound,
    .bound_differs = true,
    .flags_late = true,
    .work = work,
    .columns = SCREE_RESULTS_IN_PARTS(rows, measure),
    .results = SCREE_RESULTS(rows, measure),
    .told = told,
};
