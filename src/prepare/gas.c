/// Random loose gas: discs or spheres at random places without overlap, with random velocities.
///
/// Places by random sequential addition, largest body first: random points in the box until one is free. Random
/// addition of equal discs jams at a solid fraction of 0.547 (Feder 1980), of equal spheres at 0.384 (Talbot, Schaaf
/// and Tarjus 1991), and needs ever more trials towards it; MOST_TRIALS for one disc carry 100,000 equal discs to 0.51,
/// and discs of 1:2, the small between the large, to 0.62. Above that is an error.
///
/// In directions in which the box repeats itself there are no walls, and ghosts are kept clear of too.
///
/// Velocities: normal components of equal variance (Maxwell; the same temperature for all only if masses are equal),
/// without the drift of the centre of mass, scaled so that the root mean square of a component is exactly the one asked
/// for. They go through log and cos, whose last bit may differ between mathematical libraries; places do not.
///
/// Cost: a cell grid; 0.3 s for 100,000 equal discs at 0.45, 1 s at 0.5.
#include "prepare/gas.h"
#include "model/critical_step.h"
#include "module/key_rows.h"
#include "prepare/methods.h"
#include "prepare/prepare.h"

#include "base/random.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_TRIALS = 20000 };

typedef struct gas_grid {
    const scree_packing *packing;
    double cell;
    size_t columns, rows, layers; ///< along x, y, z; one layer in 2D
    uint32_t *head, *next;        ///< 1 + body, 0 for none
} gas_grid;

static int larger_first(const void *a, const void *b, void *radii)
{
    const double *radius = radii;
    uint32_t i = *(const uint32_t *)a, j = *(const uint32_t *)b;
    if (radius[i] != radius[j]) return radius[i] > radius[j] ? -1 : 1;
    return i < j ? -1 : i > j;
}

static size_t cell_of(const gas_grid *grid, const double at[3])
{
    size_t layer = (size_t)(at[2] / grid->cell), row = (size_t)(at[1] / grid->cell);
    return (layer * grid->rows + row) * grid->columns + (size_t)(at[0] / grid->cell);
}

static bool is_clear(const gas_grid *grid, uint32_t first, const double at[3], double radius)
{
    const scree_packing *packing = grid->packing;
    for (uint32_t k = first; k > 0; k = grid->next[k - 1]) {
        double square = 0, reach = packing->radius[k - 1] + radius;
        for (int c = 0; c < packing->dimension; c++) {
            double away = packing->place[c][k - 1] - at[c];
            square += away * away;
        }
        if (square < reach * reach) return false;
    }
    return true;
}

/// No body of the box is within reach of one at a place that may lie outside.
static bool is_free_at(const gas_grid *grid, const double at[3], double radius)
{
    size_t first[3];
    double last[3];
    for (int c = 0; c < 3; c++) {
        double index = floor(at[c] / grid->cell);
        first[c] = index > 1 ? (size_t)index - 1 : 0;
        last[c] = index + 1;
    }
    for (size_t l = first[2]; (double)l <= last[2] && l < grid->layers; l++)
        for (size_t r = first[1]; (double)r <= last[1] && r < grid->rows; r++)
            for (size_t c = first[0]; (double)c <= last[0] && c < grid->columns; c++)
                if (!is_clear(grid, grid->head[(l * grid->rows + r) * grid->columns + c], at, radius)) return false;
    return true;
}

/// Sides of the box along the axes.
static void sides_of(const scree_packing *packing, double side[3])
{
    const scree_box *box = &packing->box;
    side[0] = box->width;
    side[1] = packing->dimension == 3 ? box->depth : box->height;
    side[2] = box->height;
}

/// Nor is a ghost.
static bool is_free(const gas_grid *grid, const double at[3], double radius)
{
    const unsigned periodic = grid->packing->box.periodic;
    const int reach[3] = {periodic & 1 ? 1 : 0, periodic & 2 ? 1 : 0, periodic & 4 ? 1 : 0};
    double side[3];
    sides_of(grid->packing, side);
    for (int i = -reach[0]; i <= reach[0]; i++)
        for (int j = -reach[1]; j <= reach[1]; j++)
            for (int k = -reach[2]; k <= reach[2]; k++) {
                const double ghost[3] = {at[0] + i * side[0], at[1] + j * side[1], at[2] + k * side[2]};
                if (!is_free_at(grid, ghost, radius)) return false;
            }
    return true;
}

/// Coordinate of a centre: anywhere in a direction that repeats itself, else a radius from both walls.
static double random_coordinate(uint64_t seed, uint64_t counter, double side, bool periodic, double radius)
{
    double u = scree_random_uniform(seed, SCREE_RANDOM_POSITION, counter);
    return periodic ? u * side : radius + u * (side - 2 * radius);
}

/// Places bodies in `order` until one finds no room; returns how many found one.
static size_t add_bodies(gas_grid *grid, uint64_t seed, const uint32_t *order, scree_packing *packing)
{
    const unsigned periodic = packing->box.periodic;
    double side[3];
    uint64_t trials = 0;
    sides_of(packing, side);
    for (size_t placed = 0; placed < packing->count; placed++) {
        uint32_t i = order[placed];
        double radius = packing->radius[i], at[3] = {0};
        int trial = 0;
        do {
            if (trial++ == MOST_TRIALS) return placed;
            for (int c = 0; c < packing->dimension; c++)
                at[c] = random_coordinate(seed, trials++, side[c], periodic >> c & 1, radius);
        } while (!is_free(grid, at, radius));
        for (int c = 0; c < packing->dimension; c++) packing->place[c][i] = at[c];
        uint32_t *head = &grid->head[cell_of(grid, at)];
        grid->next[i] = *head;
        *head = i + 1;
    }
    return packing->count;
}

typedef scree_gas_config config;
static const scree_key keys[] = {
    NUMBER(config, solid_fraction, "1", .standard = "auto", ABOVE("0"), TO("99.9 %"), .when = "method=gas",
           .meaning = SCREE_SOLID_FRACTION_MEANING),
    NUMBER(config, velocity, "m/s", .standard = "0 m/s", FROM("0 m/s"), TO("1000 m/s"), .when = "method=gas",
           .meaning = "Root-mean-square velocity component."),
};

static const config *own_config(const scree_config_stage *stage)
{
    return scree_config_own(&scree_module_gas, "stages.prepare", stage->own);
}

static double solid_fraction_of(const scree_model *model, const scree_config_stage *stage)
{
    double given = own_config(stage)->solid_fraction;
    if (!isnan(given)) return given;
    return model->dimension == 3 ? 0.15 : 0.3;
}

/// Sides [m] of the box of a gas; in 2D the third is infinite.
static void gas_sides(const scree_model *model, const scree_config_stage *stage, double side[3])
{
    const scree_prepare_config *prepare = scree_config_prepared(stage);
    double in_3d = (double)model->count * scree_model_mean_solid(model);
    double room = in_3d / solid_fraction_of(model, stage);
    side[0] = prepare->width;
    side[1] = prepare->depth;
    side[2] = INFINITY;
    if (model->dimension == 2) {
        if (isnan(side[0])) side[0] = sqrt(room / prepare->aspect_ratio);
        side[1] = room / side[0];
        return;
    }
    double face = room / prepare->aspect_ratio;
    if (isnan(side[0])) side[0] = isnan(side[1]) ? cbrt(face) : sqrt(face / side[1]);
    if (isnan(side[1])) side[1] = side[0];
    side[2] = room / (side[0] * side[1]);
}

/// A periodic gas must be wide enough when it is prepared, and when its cell has shrunk to the loosest packing that
/// bears a pressure (solid fraction about 0.76 of discs, 0.55 of spheres). What happens later is not known here: the
/// search for ghosts says it then.
static scree_status check(const scree_model *model, const scree_config_stage *stage, scree_error *error)
{
    bool last = stage + 1 == model->stages + model->stage_count;
    bool confined = !last && scree_modules[stage[1].kind]->numbers->settles;
    const unsigned periodic = model->periodic;
    if (!periodic) return SCREE_OK;
    double side[3], loosest = model->dimension == 3 ? 0.55 : 0.76, needed = 4 * model->radius_max;
    double shrunk = fmin(1, pow(solid_fraction_of(model, stage) / loosest, 1.0 / model->dimension));
    if (!confined || !scree_model_is_wholly_periodic(model)) shrunk = 1;
    gas_sides(model, stage, side);
    for (int k = 0; k < model->dimension; k++) {
        if (!(periodic >> k & 1) || shrunk * side[k] > needed) continue;
        return scree_prepare_refuse_side(model, stage, k, shrunk < 1, shrunk * side[k], needed, error);
    }
    return SCREE_OK;
}

static scree_status does_not_fit(const scree_model *model, const scree_config_stage *stage,
                                 const scree_packing *packing, double wanted, double reached, scree_error *error)
{
    const bool in_3d = packing->dimension == 3;
    return scree_prepare_error(
        error, model, stage, "solid_fraction",
        "%zu %s do not fit at random at a solid fraction of %.3g: there was room up to %.2g; "
        "ask for %.2g or less, or prepare with a method that lays particles on each other (about %s) or %s",
        packing->count, in_3d ? "spheres" : "discs", wanted, reached, 0.95 * reached, in_3d ? "0.58" : "0.8",
        in_3d ? "lets them grow (0.6)" : "has a lattice (0.9)");
}

/// Random addition of all bodies into the box of the packing.
static scree_status fill(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                         double largest, double solid_fraction, scree_error *error)
{
    gas_grid grid = {.packing = packing, .cell = 2 * largest, .layers = 1};
    const bool in_3d = packing->dimension == 3;
    grid.columns = (size_t)(packing->box.width / grid.cell) + 1;
    grid.rows = (size_t)((in_3d ? packing->box.depth : packing->box.height) / grid.cell) + 1;
    if (in_3d) grid.layers = (size_t)(packing->box.height / grid.cell) + 1;
    uint32_t *order = NULL;
    size_t count = packing->count;
    scree_status status = scree_allocate(&grid.head, grid.columns * grid.rows * grid.layers, sizeof *grid.head, error);
    if (!status) status = scree_allocate(&grid.next, count, sizeof *grid.next, error);
    if (!status) status = scree_allocate(&order, count, sizeof *order, error);
    if (!status) {
        for (size_t i = 0; i < count; i++) order[i] = (uint32_t)i;
        qsort_r(order, count, sizeof *order, larger_first, packing->radius);
        size_t placed = add_bodies(&grid, model->seed, order, packing);
        double room = 0;
        for (size_t k = 0; k < placed; k++) {
            double r = packing->radius[order[k]];
            room += in_3d ? 4 * M_PI / 3 * r * r * r : M_PI * r * r;
        }
        double box = packing->box.width * packing->box.height * (in_3d ? packing->box.depth : 1);
        if (placed < count) status = does_not_fit(model, stage, packing, solid_fraction, room / box, error);
    }
    scree_release(&order);
    scree_release(&grid.next);
    scree_release(&grid.head);
    return status;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    scree_box *box = &packing->box;
    double largest = scree_packing_largest(packing), fraction = solid_fraction_of(model, stage);
    scree_packing_fit_box(packing, scree_packing_solid(packing), fraction, 0);
    const double depth = packing->dimension == 3 ? box->depth : INFINITY;
    if (fmin(fmin(box->width, depth), box->height) < 2 * largest)
        return scree_prepare_refuse_box(model, stage, largest, (const double[]){box->width, box->depth, box->height},
                                        error);
    return fill(model, stage, packing, largest, fraction, error);
}

static void set_moving(const scree_model *model, const scree_config_stage *stage, scree_state *state)
{
    uint64_t seed = model->seed, dimension = (uint64_t)state->dimension;
    double mass = 0, momentum[3] = {0}, square = 0;
    for (size_t i = 0; i < state->count; i++) {
        scree_row *row = &state->row[i];
        double *const velocity[3] = {&row->vx, &row->vy, &row->vz};
        mass += row->mass;
        for (size_t c = 0; c < dimension; c++) {
            *velocity[c] = scree_random_normal(seed, SCREE_RANDOM_VELOCITY, dimension * i + c);
            momentum[c] += row->mass * *velocity[c];
        }
    }
    for (size_t i = 0; i < state->count; i++) {
        scree_row *row = &state->row[i];
        double *const velocity[3] = {&row->vx, &row->vy, &row->vz};
        double own = 0;
        for (size_t c = 0; c < dimension; c++) {
            *velocity[c] -= momentum[c] / mass;
            own += *velocity[c] * *velocity[c];
        }
        square += own;
    }
    double scale =
        square > 0 ? own_config(stage)->velocity / sqrt(square / ((double)dimension * (double)state->count)) : 0;
    for (size_t i = 0; i < state->count; i++) {
        scree_row *row = &state->row[i];
        row->vx *= scale;
        row->vy *= scale;
        if (dimension == 3) row->vz *= scale;
    }
}

static double impact_speed(const scree_model *model, const scree_config_stage *stage, double fall)
{
    return fmax(scree_expected_fast_speed(model, own_config(stage)->velocity), fall);
}

static const scree_preparation preparation = {
    .periodic = true,
    .loose = true,
    .check = check,
    .solid_fraction = solid_fraction_of,
    .impact_speed = impact_speed,
    .place = place,
    .set_moving = set_moving,
};

const scree_module scree_module_gas = {
    .name = "gas",
    .meaning = "loose random positions without contacts",
    .choice_of = CHOICE_OF(IS("stages.prepare.method")),
    .keys = (const scree_keys[]){KEYS_OF("stages.prepare", keys, config)},
    .keys_count = 1,
    .preparation = &preparation,
};
