/// The boundary `periodic`: a cell that repeats itself in all directions, without walls and without forces of its own.
///
/// Under pressure all normal stresses are held, and the cell keeps its angles. In compression the last direction is
/// shortened, the normal stresses of the others stay at the pressure, angles stay. Otherwise every component of the
/// velocity gradient is what is demanded: a rate, a stress, or zero. Stresses that must be near to the pressure are
/// means over the steps since they were last asked for: friction that depends on velocity may change its sign in every
/// step, and the stress with it.
#include "base/matrix.h"
#include "boundary/boundary.h"
#include "boundary/periodic.h"
#include "case/config.h"
#include "state/periodic.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

static double wave_time(const scree_context *c, double pressure)
{
    return scree_periodic_wave_time(c->model, c->state, pressure);
}

static double height(const scree_context *c)
{
    double inverse[9], width[3];
    scree_matrix_invert(scree_cell(c->state)->lattice, inverse);
    scree_periodic_widths(inverse, width);
    return width[c->state->dimension - 1];
}

static void forget_stresses(scree_periodic_cell *cell)
{
    cell->stress_sum[0] = cell->stress_sum[1] = cell->stress_sum[2] = cell->stress_time = 0;
}

static void fit(const scree_context *c, double pressure)
{
    scree_periodic_fit(c->model, c->state, pressure);
    forget_stresses(scree_cell(c->state));
}

static void mark(const scree_context *c)
{
    scree_periodic_cell *cell = scree_cell(c->state);
    memcpy(cell->reference, cell->lattice, sizeof cell->reference);
}

/// A cell that keeps its shape, with the normal components of the first `count` directions left to a pressure.
static scree_periodic_demand drive_under(double pressure, int count)
{
    scree_periodic_demand wanted = {.rate = {0}};
    for (int k = 0; k < 9; k++) wanted.stress[k] = NAN;
    for (int k = 0; k < count; k++) wanted.stress[4 * k] = -pressure;
    return wanted;
}

static void hold(const scree_context *c, double pressure)
{
    scree_state *state = c->state;
    scree_periodic_cell *cell = scree_cell(state);
    const scree_periodic_demand wanted = drive_under(pressure, state->dimension);
    double stress[9];
    scree_periodic_control(c->model, state, &wanted, 1);
    scree_periodic_stress(c->model, state, stress);
    for (int k = 0; k < state->dimension; k++) cell->stress_sum[k] += state->step_size * stress[4 * k];
    cell->stress_time += state->step_size;
}

static void compress(const scree_context *c, const scree_compression *compression)
{
    const int last = c->state->dimension - 1;
    scree_periodic_demand wanted = drive_under(scree_pressure_now(c->state), last);
    wanted.rate[4 * last] = -compression->rate * compression->height / height(c);
    scree_periodic_control(c->model, c->state, &wanted, compression->rise);
}

static void deform(const scree_context *c, const scree_demand *demand, double rise)
{
    scree_periodic_demand wanted;
    memcpy(wanted.stress, demand->stress, sizeof wanted.stress);
    for (int k = 0; k < 9; k++) {
        int mirror = 3 * (k % 3) + k / 3;
        wanted.rate[k] = demand->rate[demand->how[mirror] == SCREE_SYMMETRIC ? mirror : k];
    }
    scree_periodic_control(c->model, c->state, &wanted, rise);
}

static void stress(const scree_context *c, double tensor[9])
{
    scree_periodic_stress(c->model, c->state, tensor);
}

static double stress_error(const scree_context *c, double pressure, const char **what)
{
    scree_periodic_cell *cell = scree_cell(c->state);
    double off = 0;
    *what = "every normal stress";
    for (int k = 0; k < c->state->dimension; k++)
        off = fmax(off, fabs(cell->stress_sum[k] / cell->stress_time / pressure + 1));
    forget_stresses(cell);
    return off;
}

static bool forced(const scree_config *config, int64_t index)
{
    (void)index;
    return scree_config_is_wholly_periodic(config);
}

static const scree_boundary face = {
    .periodic = true,
    .forced = forced,
    .wave_time = wave_time,
    .height = height,
    .fit = fit,
    .mark = mark,
    .hold = hold,
    .compress = compress,
    .deform = deform,
    .stress = stress,
    .stress_error = stress_error,
    .stress_tolerance = 0.002,
    .patience = 1000,
};

const scree_module scree_module_periodic = {
    .name = "periodic",
    .meaning = "a cell that repeats itself in all directions",
    .boundary = &face,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
};
