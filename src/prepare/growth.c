/// Growth packing: bodies begin as points at random places of the box and grow to their radii, while those that overlap
/// push each other (and are pushed by the walls) apart. Dense and isotropic, without gravity and without contacts.
///
/// Method. After the overlap relaxation of Clarke & Wiley (1987) and the compression protocol of O'Hern, Silbert, Liu
/// and Nagel (2003): the solid fraction rises in GROWTH_STEPS equal steps from a third of the target to the target; in
/// each the energy sum (R_i + R_j - |x_i - x_j|)^2 / 2 over overlapping pairs, and over bodies and walls, is lowered
/// until no overlap is above a tolerance. In the last step the radii count EXCESS times larger, and the step ends when
/// no two bodies of their true radii overlap. The energy is lowered by FIRE (Bitzek, Koskinen, Gaehler, Moseler and
/// Gumbsch 2006) with unit masses, pairs from the neighbour list. All lengths are in mean radii.
///
/// In directions in which the box repeats itself there are no walls: bodies push the ghosts of others.
///
/// Limits. Random packings jam: equal spheres at 0.64, discs of several sizes at 0.84 (O'Hern et al. 2003), somewhat
/// less near walls. Beyond what the relaxation reaches is an error that says how far it came.
///
/// Determinism: sums run in the order of the neighbour list, which depends on places and ids alone; one thread.
/// Cost: a few hundred force evaluations of about 30 ns a pair; more near jamming.
#include "prepare/growth.h"
#include "module/key_rows.h"
#include "prepare/methods.h"
#include "prepare/prepare.h"
#include "state/periodic.h"
#include "state/plates.h"

#include "base/random.h"
#include "search/neighbours.h"

#include <math.h>
#include <string.h>

enum { GROWTH_STEPS = 12, MOST_ITERATIONS = 20000, ITERATIONS_BETWEEN = 200 };
static const double EXCESS = 1e-4;  // of the radius
static const double ROUGHLY = 0.02; // overlap, in mean radii, left to the steps on the way
static const double SKIN = 0.4;     // mean radii
static const double WALL = 0.2;     // mean diameters: 1000 spheres of 1:2 in a cube reach 0.57 instead of 0.64

// FIRE, as published but for the largest step: two over the highest frequency of a body between twelve others is 0.4.
static const double FIRST_STEP = 0.05, LARGEST_STEP = 0.3, FASTER = 1.1, SLOWER = 0.5, MIXING = 0.1,
                    MIXING_DECAY = 0.99;
enum { PATIENCE = 5 };

/// The bodies on their way, in mean radii.
typedef struct growth {
    const scree_model *model;
    const scree_packing *packing;
    scree_state state;
    scree_work work;
    scree_vector *force;
    double unit;    ///< m, mean radius
    double overlap; ///< largest, at the last evaluation
} growth;

static void set_place(scree_row *row, bool in_3d, const double place[3])
{
    row->x = place[0];
    row->y = place[1];
    if (in_3d) row->z = place[2];
}

static scree_status begin_growth(growth *g, scree_error *error)
{
    const scree_packing *packing = g->packing;
    const bool in_3d = packing->dimension == 3;
    const double side[3] = {packing->box.width / g->unit, (in_3d ? packing->box.depth : packing->box.height) / g->unit,
                            packing->box.height / g->unit};
    scree_status status = scree_state_create(&g->state, packing->dimension, packing->count, error);
    if (!status) status = scree_work_create(&g->work, g->model, 1, error);
    if (!status) status = scree_allocate(&g->force, packing->count, sizeof *g->force, error);
    if (status) return status;
    g->work.skin = SKIN;
    uint64_t seed = g->model->seed, axes = (uint64_t)packing->dimension;
    const unsigned periodic = packing->box.periodic;
    for (size_t i = 0; i < packing->count; i++) {
        double place[3];
        for (uint64_t c = 0; c < axes; c++) {
            double radius = periodic >> c & 1 ? 0 : packing->radius[i] / g->unit;
            place[c] =
                radius + scree_random_uniform(seed, SCREE_RANDOM_POSITION, axes * i + c) * (side[c] - 2 * radius);
        }
        set_place(&g->state.row[i], in_3d, place);
    }
    for (int axis = 0; axis < packing->dimension; axis++)
        for (int w = 2 * axis; w < 2 * axis + 2; w++) {
            scree_plates(&g->state)[w] =
                (scree_wall){.position = w % 2 ? -side[axis] : 0, .active = !(periodic >> axis & 1)};
            scree_plates(&g->state)[w].normal[axis] = w % 2 ? -1 : 1;
        }
    if (periodic) scree_periodic_set(scree_cell(&g->state), periodic, side);
    return SCREE_OK;
}

static void end_growth(growth *g)
{
    scree_release(&g->force);
    scree_work_destroy(&g->work);
    scree_state_destroy(&g->state);
}

/// Gives every body `scale` times its radius.
static void set_radii(growth *g, double scale)
{
    for (size_t i = 0; i < g->packing->count; i++)
        g->state.row[g->state.row_of_id[i]].radius = scale * g->packing->radius[i] / g->unit;
    scree_neighbours_invalidate(&g->work);
}

/// Adds the push of an overlap along the unit vector n.
static void push(double force[3], double overlap, const double n[3])
{
    for (int c = 0; c < 3; c++) force[c] += overlap * n[c];
}

/// Forces and largest overlap.
static scree_status evaluate(growth *g, scree_error *error)
{
    scree_status status = scree_neighbours_refresh(g->model, &g->state, &g->work, error);
    if (status) return status;
    const scree_pair_list *pairs = &g->work.pairs;
    const scree_wall_pair_list *walls = &g->work.wall_pairs;
    const bool in_3d = g->state.dimension == 3;
    memset(g->force, 0, g->state.count * sizeof *g->force);
    g->overlap = 0;
    for (size_t k = 0; k < pairs->count; k++) {
        const scree_row *a = &g->state.row[pairs->first[k]], *b = &g->state.row[pairs->second[k]];
        double dx = a->x - b->x, dy = a->y - b->y, dz = in_3d ? a->z - b->z : 0, reach = a->radius + b->radius;
        double square = dx * dx + dy * dy + dz * dz;
        if (square >= reach * reach) continue;
        // Bodies at one point push each other along x.
        double distance = sqrt(square), overlap = reach - distance;
        double n[3] = {distance > 0 ? dx / distance : 1, distance > 0 ? dy / distance : 0,
                       distance > 0 ? dz / distance : 0};
        push(g->force[scree_parent_row(&g->state, &g->work, pairs->first[k])], overlap, n);
        push(g->force[scree_parent_row(&g->state, &g->work, pairs->second[k])], -overlap, n);
        g->overlap = fmax(g->overlap, overlap);
    }
    for (size_t k = 0; k < walls->count; k++) {
        const scree_wall *wall = &scree_plates(&g->state)[walls->wall[k]];
        scree_vector place;
        scree_body_position(&g->state, walls->body[k], place);
        double away = wall->normal[0] * place[0] + wall->normal[1] * place[1] + wall->normal[2] * place[2];
        double overlap = g->state.row[walls->body[k]].radius - (away - wall->position);
        if (overlap <= 0) continue;
        push(g->force[walls->body[k]], overlap, wall->normal);
        g->overlap = fmax(g->overlap, overlap);
    }
    return SCREE_OK;
}

/// State of FIRE.
typedef struct fire {
    double step, mixing;
    int downhill;
} fire;

/// Turns velocities towards the forces, and adapts the step to whether they still go downhill.
static void steer(growth *g, fire *f)
{
    const bool in_3d = g->state.dimension == 3;
    double power = 0, speed = 0, strength = 0;
    for (size_t k = 0; k < g->state.count; k++) {
        const scree_row *row = &g->state.row[k];
        const double *force = g->force[k], vz = in_3d ? row->vz : 0;
        power += row->vx * force[0] + row->vy * force[1] + vz * force[2];
        speed += row->vx * row->vx + row->vy * row->vy + vz * vz;
        strength += force[0] * force[0] + force[1] * force[1] + force[2] * force[2];
    }
    double keep = 0, take = 0;
    if (power > 0) {
        keep = 1 - f->mixing;
        take = strength > 0 ? f->mixing * sqrt(speed / strength) : 0;
        if (++f->downhill > PATIENCE) {
            f->step = fmin(f->step * FASTER, LARGEST_STEP);
            f->mixing *= MIXING_DECAY;
        }
    } else {
        f->downhill = 0;
        f->step *= SLOWER;
        f->mixing = MIXING;
    }
    for (size_t k = 0; k < g->state.count; k++) {
        scree_row *row = &g->state.row[k];
        row->vx = keep * row->vx + take * g->force[k][0];
        row->vy = keep * row->vy + take * g->force[k][1];
        if (in_3d) row->vz = keep * row->vz + take * g->force[k][2];
    }
}

/// A step of the motion with unit masses.
static void move(growth *g, const fire *f)
{
    const bool in_3d = g->state.dimension == 3;
    double fastest = 0;
    for (size_t k = 0; k < g->state.count; k++) {
        scree_row *row = &g->state.row[k];
        row->vx += f->step * g->force[k][0];
        row->vy += f->step * g->force[k][1];
        row->x += f->step * row->vx;
        row->y += f->step * row->vy;
        double square = row->vx * row->vx + row->vy * row->vy;
        if (in_3d) {
            row->vz += f->step * g->force[k][2];
            row->z += f->step * row->vz;
            square += row->vz * row->vz;
        }
        fastest = fmax(fastest, square);
    }
    g->work.budget -= sqrt(fastest) * f->step;
}

/// Lowers the energy until no overlap is above `tolerance`, or for `most` iterations.
static scree_status relax(growth *g, double tolerance, int most, scree_error *error)
{
    fire f = {.step = FIRST_STEP, .mixing = MIXING};
    for (size_t k = 0; k < g->state.count; k++) {
        g->state.row[k].vx = g->state.row[k].vy = 0;
        if (g->state.dimension == 3) g->state.row[k].vz = 0;
    }
    scree_status status = evaluate(g, error);
    for (int iteration = 0; iteration < most && !status && g->overlap > tolerance; iteration++) {
        steer(g, &f);
        move(g, &f);
        status = evaluate(g, error);
    }
    return status;
}

static void take_places(const growth *g, scree_packing *packing)
{
    const scree_periodic_cell *cell = scree_cell(&g->state);
    for (size_t i = 0; i < packing->count; i++) {
        scree_vector place;
        scree_body_position(&g->state, g->state.row_of_id[i], place);
        for (int c = 0; c < packing->dimension; c++) {
            double side = cell->lattice[4 * c];
            if (scree_periodic_repeats(cell, c)) place[c] -= side * floor(place[c] / side);
            packing->place[c][i] = place[c] * g->unit;
        }
    }
}

/// Somewhat short of jamming. A flat wall takes room: as if the packing began WALL mean diameters behind it.
static double standard_fraction(const scree_model *model, const scree_packing *packing)
{
    double fraction = packing->dimension == 3 ? 0.6 : 0.8, share = 1;
    scree_packing guess = *packing;
    scree_packing_fit_box(&guess, scree_packing_solid(packing), fraction, 2 * scree_packing_largest(packing));
    const bool in_3d = packing->dimension == 3;
    const double side[3] = {guess.box.width, in_3d ? guess.box.depth : guess.box.height, guess.box.height};
    for (int c = 0; c < packing->dimension; c++)
        if (!(packing->box.periodic >> c & 1)) share *= 1 - 2 * WALL * 2 * model->mean_radius / side[c];
    return fraction * fmax(share, 0.5);
}

typedef scree_growth_config config;
static const scree_key keys[] = {
    NUMBER(config, solid_fraction, "1", .standard = "auto", ABOVE("0"), TO("99.9 %"), .when = "method=growth",
           .meaning = SCREE_SOLID_FRACTION_MEANING),
};

/// A sample that repeats itself is wide enough for the search for ghosts.
static scree_status check_sides(const scree_model *model, const scree_config_stage *stage, const scree_packing *packing,
                                scree_error *error)
{
    const scree_box *box = &packing->box;
    const double side[3] = {box->width, packing->dimension == 3 ? box->depth : box->height, box->height};
    double needed = (4 * scree_packing_largest(packing) + 2 * SKIN * model->mean_radius) * (1 + 2 * EXCESS);
    for (int c = 0; c < packing->dimension; c++)
        if (box->periodic >> c & 1 && !(side[c] > needed))
            return scree_prepare_refuse_side(model, stage, c, false, side[c], needed, error);
    return SCREE_OK;
}

static scree_status check_box(const scree_model *model, const scree_config_stage *stage, const scree_packing *packing,
                              scree_error *error)
{
    const scree_box *box = &packing->box;
    const double largest = scree_packing_largest(packing);
    const bool in_3d = packing->dimension == 3;
    if (fmin(fmin(box->width, box->height), in_3d ? box->depth : INFINITY) < 2 * largest)
        return scree_prepare_refuse_box(model, stage, largest, (const double[]){box->width, box->depth, box->height},
                                        error);
    return check_sides(model, stage, packing, error);
}

/// Overlaps of the enlarged radii below this are gaps between the true ones, and between them and walls.
static double tolerance_of(const scree_model *model)
{
    return EXCESS * model->radius_min / model->mean_radius;
}

scree_status scree_packing_grow(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                                double *overlap, scree_error *error)
{
    scree_status status = check_box(model, stage, packing, error);
    if (status) return status;
    growth g = {.model = model, .packing = packing, .unit = model->mean_radius};
    status = begin_growth(&g, error);
    for (int k = 0; k < GROWTH_STEPS && !status; k++) {
        set_radii(&g, pow((1 + 2 * (double)k / GROWTH_STEPS) / 3, 1.0 / packing->dimension));
        status = relax(&g, ROUGHLY, ITERATIONS_BETWEEN, error);
    }
    if (!status) set_radii(&g, 1 + EXCESS);
    if (!status) status = relax(&g, tolerance_of(model), MOST_ITERATIONS, error);
    if (!status) take_places(&g, packing);
    *overlap = g.overlap;
    end_growth(&g);
    return status;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    const config *own = scree_config_own(&scree_module_growth, "stages.prepare", stage->own);
    double fraction = own->solid_fraction, overlap;
    if (isnan(fraction)) fraction = standard_fraction(model, packing);
    scree_packing_fit_box(packing, scree_packing_solid(packing), fraction, 2 * scree_packing_largest(packing));
    scree_status status = scree_packing_grow(model, stage, packing, &overlap, error);
    if (status || !(overlap > tolerance_of(model))) return status;
    // Places scaled up by the deepest overlap are a packing of the true radii.
    double reached = fraction * pow(1 - overlap / (2 * model->radius_min / model->mean_radius), packing->dimension);
    return scree_prepare_error(error, model, stage, "solid_fraction",
                               "%zu particles do not grow to a solid fraction of %.3g: there was room up to about "
                               "%.3g; ask for less",
                               packing->count, fraction, reached);
}

static const scree_preparation preparation = {.periodic = true, .loose = true, .place = place};

const scree_module scree_module_growth = {
    .name = "growth",
    .meaning = "particles grow at random positions and push each other away: dense and isotropic, without contacts",
    .choice_of = CHOICE_OF(IS("stages.prepare.method")),
    .keys = (const scree_keys[]){KEYS_OF("stages.prepare", keys, config)},
    .keys_count = 1,
    .preparation = &preparation,
};
