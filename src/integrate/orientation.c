/// Orientation of bodies in 3D: a unit quaternion a body, with `measure.orientation`. In 2D the angle is a part of the
/// drift (kick.h).
///
/// Method. Behind the drift rows hold the spin w of the middle of the step, in every scheme, and
///     q(n+1) = exp(h w(n+1/2) / 2) q(n) = (cos a, sin a w/|w|) q(n),   a = h |w| / 2,
/// which is exact for a spin that does not change, and of second order for one that does: rotations do not commute,
/// which shows in the third order of a step. After it q is given the length 1 again. Sine and cosine are SLEEF's, which
/// has the same bits on every processor; each body is by itself, so threads share them.
///
/// Contacts of spheres do not see it: it is kept for those who look, and no step is longer without it. Ghosts have
/// none. Cost: 32 bytes and some 60 ns a body and step.
#include "integrate/orientation.h"

#include "base/checksum.h"
#include "base/vectors.h"
#include "case/check.h"
#include "module/key_rows.h"
#include "state/work.h"

#include <sleef.h>
#include <string.h>

// ---- the case ----------------------------------------------------------------------------------------------------

typedef struct config {
    bool orientation;
} config;

static const scree_key keys[] = {
    FLAG(config, orientation, .standard = "no",
         .meaning = "Keep how every particle lies turned, as a quaternion, in 3D; the strain of Liao needs it. In 2D "
                    "`angle` is always kept."),
};

static const config *own_config(const scree_config *whole)
{
    return whole->measure.own ? scree_config_own(&scree_module_orientation, "measure", whole->measure.own) : NULL;
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    const config *own = own_config(whole);
    if (own && own->orientation && whole->dimension == 2)
        scree_rule_refuse(reader, "measure.orientation", "no",
                          "quaternions are of spheres: in two dimensions `angle` says how a particle lies");
}

typedef struct numbers {
    bool kept;
} numbers;

static scree_status resolve(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_orientation, "measure", model->config->measure.own);
    numbers *n = scree_model_reserve_numbers(model, SCREE_SLOT_orientation);
    (void)error;
    n->kept = own && own->orientation;
    return SCREE_OK;
}

static bool is_kept(const scree_model *model)
{
    const numbers *n = scree_model_numbers(model, SCREE_SLOT_orientation);
    return n && n->kept;
}

// ---- state -------------------------------------------------------------------------------------------------------

typedef struct memory {
    scree_quaternion *of; ///< a body; NULL: none are kept
} memory;

static memory *memory_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_orientation];
}

static const scree_field fields[] = {
    SCREE_FIELD_BODY(orientation, memory, of, scree_quaternion, "orientation", SCREE_FIELD_DOUBLE, 4, "1",
                     "quaternion of the rotation since the start of the loading: cosine of half the angle, then sine "
                     "of it times the axis",
                     .only_dimension = 3, .optional = true, .snapshot = true),
};

/// Of a body that has come since the last step.
static bool is_unset(const scree_quaternion q)
{
    return q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0;
}

const scree_quaternion *scree_orientations(const scree_state *state)
{
    return (const scree_quaternion *)memory_of(state)->of;
}

void scree_orientation_forget(scree_state *state)
{
    scree_quaternion *q = memory_of(state)->of;
    for (size_t row = 0; row < state->count && q; row++) memcpy(q[row], (scree_quaternion){1}, sizeof q[row]);
}

/// Bodies that are there get no rotation, unless they have one.
static scree_status begin(const scree_context *c, scree_error *error)
{
    memory *all = memory_of(c->state);
    if (!is_kept(c->model) || all->of) return SCREE_OK;
    scree_status status = scree_state_begin_field(c->state, &fields[0], error);
    if (!status) scree_orientation_forget(c->state);
    return status;
}

/// Lengths that a file was given by somebody else.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    const scree_quaternion *q = scree_orientations(state);
    (void)model;
    for (size_t row = 0; row < state->count && q; row++) {
        double square = 0;
        for (int k = 0; k < 4; k++) square += q[row][k] * q[row][k];
        if (!is_unset(q[row]) && !(fabs(square - 1) < 1e-9))
            return scree_error_set(error, SCREE_ERROR_INPUT, "orientation: that of body %u has the length %g, not 1",
                                   state->id[row], sqrt(square));
    }
    return SCREE_OK;
}

static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const scree_quaternion *q = scree_orientations(state);
    size_t next = 0;
    (void)model;
    for (uint32_t row; q && (row = scree_next_by_id(state, &next)) != SCREE_NO_ROW;)
        c = scree_checksum_numbers(c, q[row], 4);
    return c;
}

// ---- a step ------------------------------------------------------------------------------------------------------

void scree_quaternion_turn(scree_quaternion q, const double w[3], double h)
{
    const double speed = scree_length(w);
    if (is_unset(q)) q[0] = 1;
    if (!(speed > 0)) return;
    const Sleef_double_2 half = Sleef_cinz_sincosd1_u10purec(0.5 * h * speed);
    const double c = half.y, s = half.x / speed, x = s * w[0], y = s * w[1], z = s * w[2];
    const double turned[4] = {c * q[0] - x * q[1] - y * q[2] - z * q[3], c * q[1] + x * q[0] + y * q[3] - z * q[2],
                              c * q[2] + y * q[0] + z * q[1] - x * q[3], c * q[3] + z * q[0] + x * q[2] - y * q[1]};
    double square = 0;
    for (int k = 0; k < 4; k++) square += turned[k] * turned[k];
    const double inverse = 1 / sqrt(square);
    for (int k = 0; k < 4; k++) q[k] = turned[k] * inverse;
}

static void turn_share(void *argument, int index, int count)
{
    const scree_state *state = argument;
    const size_t end = scree_thread_pool_begin(state->count, index + 1, count);
    for (size_t row = scree_thread_pool_begin(state->count, index, count); row < end; row++) {
        const scree_turn_row *turn = &state->turn[row];
        scree_quaternion_turn(memory_of(state)->of[row], (const double[3]){turn->wx, turn->wy, turn->wz},
                              state->step_size);
    }
}

static scree_status turn(const scree_context *c, scree_error *error)
{
    (void)error;
    if (memory_of(c->state)->of)
        scree_thread_pool_run(&c->work->pool, scree_work_shares(c->work), turn_share, c->state);
    return SCREE_OK;
}

static bool in_use(const scree_context *c)
{
    return is_kept(c->model);
}

static const scree_pass passes[] = {{SCREE_PHASE_FOLLOW, .run = turn}};

const scree_module scree_module_orientation = {
    .name = "orientation",
    .meaning = "how bodies lie turned in 3D",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(numbers),
    .resolve = resolve,
    .state_size = sizeof(memory),
    .fields = fields,
    .field_count = COUNT(fields),
    .check = check,
    .checksum = checksum,
    .begin = begin,
    .passes = passes,
    .pass_count = COUNT(passes),
    .in_use = in_use,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
};
