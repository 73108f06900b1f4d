/// The periodic cell as a module: what is stored of it, and when it moves.
#include "boundary/periodic.h"

#include "base/checksum.h"
#include "base/matrix.h"
#include "state/periodic.h"

#include <float.h>

typedef scree_periodic_cell own;

#define CELL(member, type, components, unit, meaning, ...)                                                             \
    SCREE_FIELD_ONE(periodic_cell, own, member, "periodic/" #member, type, components, unit, meaning,                  \
                    .snapshot = true, __VA_ARGS__)
#define SERVO(member, components, unit, meaning, ...)                                                                  \
    SCREE_FIELD_ONE(periodic_cell, own, member, "periodic/" #member, SCREE_FIELD_DOUBLE, components, unit, meaning,    \
                    __VA_ARGS__)
static const scree_field fields[] = {
    CELL(lattice, SCREE_FIELD_DOUBLE, 9, "m",
         "lattice vectors of the periodic cell as columns, 3 x 3 by rows; unit vectors where it is not periodic"),
    CELL(reference, SCREE_FIELD_DOUBLE, 9, "m", "the same lattice vectors at the start of the loading stage"),
    CELL(gradient, SCREE_FIELD_DOUBLE, 9, "1/s",
         "velocity gradient of the last step, 3 x 3 by rows, extension positive"),
    CELL(drift, SCREE_FIELD_DOUBLE, 9, "1/s", "running mean of the velocity gradient, for the servo"),
    CELL(strain, SCREE_FIELD_DOUBLE, 9, "1", "integral of the velocity gradient over time"),
    CELL(virial, SCREE_FIELD_DOUBLE, 9, "J", "sum over contacts of force on the first (x) branch"),
    CELL(motion, SCREE_FIELD_DOUBLE, 9, "J",
         "sum over bodies of mass velocity (x) velocity, relative to the affine field"),
    CELL(directions, SCREE_FIELD_UINT64, 1, "1", "periodic directions: 1 x, 2 y, 4 z, added up", SCREE_RANGE(0, 7)),
    SERVO(inertia, 1, "Pa s2", "inertia of the rate of a component under stress", SCREE_RANGE(0, DBL_MAX)),
    SERVO(damping, 1, "1/s", "its dashpot over its inertia", SCREE_RANGE(0, DBL_MAX)),
    SERVO(limit, 1, "1/s", "largest magnitude of such a rate", SCREE_RANGE(0, DBL_MAX)),
    SERVO(stress_sum, 3, "Pa s", "sums of the normal stresses times the step since the last sample of a confine stage"),
    SERVO(stress_time, 1, "s", "sum of these steps", SCREE_RANGE(0, DBL_MAX)),
};

/// The lattice encloses a volume, and the bodies are in it or a little outside: less than a cell.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    double inverse[9], fraction[3];
    const scree_periodic_cell *cell = scree_cell(state);
    (void)model;
    if (!cell->directions) return SCREE_OK;
    if (!(scree_matrix_determinant(cell->lattice) > 0))
        return scree_error_set(error, SCREE_ERROR_IO, "dataset 'periodic/lattice': its vectors enclose no volume");
    scree_matrix_invert(cell->lattice, inverse);
    for (size_t row = 0; row < state->count; row++) {
        scree_vector position;
        scree_body_position(state, row, position);
        scree_matrix_apply(inverse, position, fraction);
        for (int k = 0; k < state->dimension; k++)
            if (scree_periodic_repeats(cell, k) && !(fraction[k] > -1 && fraction[k] < 2))
                return scree_error_set(error, SCREE_ERROR_IO,
                                       "dataset 'position', body %u: %.9g of the periodic cell along lattice vector %d "
                                       "(accepted: more than -1, less than 2)",
                                       state->id[row], fraction[k], k + 1);
    }
    return SCREE_OK;
}

static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    (void)model;
    const scree_periodic_cell *cell = scree_cell(state);
    if (!cell->directions) return c;
    c = scree_checksum_word(c, cell->directions);
    c = scree_checksum_numbers(c, cell->lattice, 9);
    c = scree_checksum_numbers(c, cell->gradient, 9);
    return scree_checksum_numbers(c, cell->strain, 9);
}

static bool in_use(const scree_context *c)
{
    return scree_cell(c->state)->directions != 0;
}

static scree_status move(const scree_context *c, scree_error *error)
{
    return scree_periodic_move(c->model, c->state, c->work, error);
}

static scree_status settle(const scree_context *c, scree_error *error)
{
    (void)error;
    scree_periodic_settle(c->state, c->work);
    return SCREE_OK;
}

static const scree_pass passes[] = {{SCREE_PHASE_FOLLOW, .run = move}, {SCREE_PHASE_BODIES, .run = settle}};

const scree_module scree_module_periodic_cell = {
    .name = "periodic_cell",
    .meaning = "the lattice in which the sample repeats itself",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .checksum = checksum,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .spreads = true,
};
