/// Strains between two instants.
#include "average/strain.h"

#include "average/tensor.h"
#include "base/matrix.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- displacements -----------------------------------------------------------------------------------------------

/// Whole lattice vectors nearest to a way, along the directions in which the sample repeats itself.
static void whole_steps(uint64_t directions, const double inverse[9], const double way[3], double steps[3])
{
    scree_matrix_apply(inverse, way, steps);
    for (int k = 0; k < 3; k++) steps[k] = directions >> k & 1 ? round(steps[k]) : 0;
}

/// Whole numbers `steps` with a = b steps, to round-off; false: there are none.
static bool find_whole(const double a[9], const double b[9], double steps[9])
{
    double inverse[9];
    scree_matrix_invert(b, inverse);
    scree_matrix_multiply(inverse, a, steps);
    for (int k = 0; k < 9; k++) {
        const double whole = rint(steps[k]);
        if (!(fabs(steps[k] - whole) < 1e-6)) return false;
        steps[k] = whole;
    }
    return fabs(fabs(scree_matrix_determinant(steps)) - 1) < 0.5;
}

/// Whole numbers with which b steps leans over its own vectors as a does, whatever their lengths are.
static void find_nearest(const double a[9], const double b[9], double steps[9])
{
    double inverse[9], change[9];
    scree_matrix_invert(b, inverse);
    scree_matrix_multiply(inverse, a, change);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) steps[3 * i + j] = i == j ? 1 : rint(change[3 * i + j] / change[4 * i]);
    if (fabs(scree_matrix_determinant(steps) - 1) > 0.5) scree_matrix_unit(steps);
}

/// The earlier lattice by the vectors that the lattice has now: whole multiples of a vector may have been taken from
/// another in between (boundary/periodic.c), from the reference as well. Of both in one loading, and of an earlier
/// lattice with which it began, that says by how many. Else the vectors count that lean least from where they were.
static void find_earlier_lattice(const scree_average_sample *sample, const scree_average_sample *before,
                                 double lattice[9])
{
    double steps[9];
    const bool known = scree_matrix_norm(sample->reference) > 0;
    const bool both = known && scree_matrix_norm(before->reference) > 0;
    if (!(both && find_whole(sample->reference, before->reference, steps)))
        find_nearest(known ? sample->reference : sample->lattice, before->lattice, steps);
    scree_matrix_multiply(before->lattice, steps, lattice);
}

/// What a grain has moved by. Where the sample repeats itself its image then is taken from which it came with the least
/// way relative to the lattice: bodies leave a cell on one side and come back on the other. earlier: lattice then, by
/// the vectors of now.
static void find_displacement(const scree_average_sample *sample, const double earlier[9], double inverse[2][9],
                              const scree_average_grain *was, scree_average_grain *grain)
{
    double then[3], now[3], steps[3], shift[3];
    scree_subtract(grain->position, was->position, grain->displacement);
    if (!sample->directions) return;
    scree_matrix_apply(inverse[0], was->position, then);
    scree_matrix_apply(inverse[1], grain->position, now);
    for (int k = 0; k < 3; k++) steps[k] = sample->directions >> k & 1 ? round(then[k] - now[k]) : 0;
    scree_matrix_apply(earlier, steps, shift);
    scree_along(grain->displacement, 1, shift, grain->displacement);
}

/// The instant from which turns of the grains count in both samples, which is in the first one zero: whether there is
/// one. Of samples with polygons angles are how bodies lie, and always count.
static bool count_alike(const scree_average_sample *sample, const scree_average_sample *before, bool *anew)
{
    *anew = false;
    if (sample->corner_count > 0) return true;
    if (sample->dimension == 3 && !(sample->orientation && before->orientation)) return false;
    // Older snapshots do not say: within one stage they count alike.
    if (isnan(sample->turned_since)) return strcmp(sample->stage, before->stage) == 0;
    *anew = sample->turned_since == before->time && sample->time > before->time;
    return *anew || sample->turned_since == before->turned_since;
}

/// Quaternion from the one orientation to the other, b a*; zeros stand for no rotation.
static void quaternion_between(const double a[4], const double b[4], double turn[4])
{
    static const double none[4] = {1};
    if (a[0] == 0 && scree_length(a + 1) == 0) a = none;
    if (b[0] == 0 && scree_length(b + 1) == 0) b = none;
    double across[3];
    scree_cross(a + 1, b + 1, across);
    turn[0] = b[0] * a[0] + scree_dot(b + 1, a + 1);
    for (int k = 0; k < 3; k++) turn[k + 1] = a[0] * b[k + 1] - b[0] * a[k + 1] + across[k];
}

/// What a grain has turned by. anew: orientations were set to zero at the earlier instant.
static void find_turn(const scree_average_sample *sample, const scree_average_sample *before, bool anew, size_t at,
                      size_t p)
{
    static const double none[4] = {1};
    double *turn = sample->turn[p];
    if (sample->dimension == 3) {
        quaternion_between(anew ? none : before->orientation[at], sample->orientation[p], turn);
        return;
    }
    const double half = 0.5 * (sample->grain[p].angle - (anew ? 0 : before->grain[at].angle));
    turn[0] = cos(half);
    turn[1] = turn[2] = 0;
    turn[3] = sin(half);
}

scree_status scree_average_move(scree_average_sample *sample, const scree_average_sample *before, scree_error *error)
{
    size_t at = 0, moved = 0;
    bool anew;
    double inverse[2][9], earlier[9];
    if (sample->directions != before->directions)
        return scree_error_set(error, SCREE_ERROR_INPUT, "one of both snapshots repeats itself in other directions");
    if (sample->directions) {
        find_earlier_lattice(sample, before, earlier);
        scree_matrix_invert(earlier, inverse[0]);
        scree_matrix_invert(sample->lattice, inverse[1]);
        for (int k = 0; k < 9; k++) sample->lattice_change[k] = sample->lattice[k] - earlier[k];
    }
    if (before->own) {
        scree_status status = scree_allocate(&sample->earlier, sample->bodies, sizeof *sample->earlier, error);
        if (status) return status;
    }
    if (count_alike(sample, before, &anew)) {
        scree_status status = scree_allocate(&sample->turn, sample->bodies, sizeof *sample->turn, error);
        if (status) return status;
    }
    // Bodies of both are in the order of their ids.
    for (size_t p = 0; p < sample->bodies; p++) {
        scree_average_grain *grain = &sample->grain[p];
        while (at < before->bodies && before->grain[at].id < grain->id) at++;
        if (at == before->bodies || before->grain[at].id != grain->id) continue;
        find_displacement(sample, earlier, inverse, &before->grain[at], grain);
        if (sample->turn) find_turn(sample, before, anew, at, p);
        grain->moved = true;
        if (before->own) memcpy(sample->earlier[p], before->own[at].moment, sizeof before->own[at].moment);
        moved += grain->counted;
    }
    if (moved > 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "no grain is in both snapshots");
}

// ---- what is needed ----------------------------------------------------------------------------------------------

static scree_status list_contacts(scree_average_strain *strain, scree_error *error)
{
    const scree_average_sample *sample = strain->sample;
    scree_status status = scree_allocate(&strain->begin, sample->count + 2, sizeof *strain->begin, error);
    if (!status) status = scree_allocate(&strain->contact, sample->contact_count, sizeof *strain->contact, error);
    if (status) return status;
    for (size_t c = 0; c < sample->contact_count; c++) strain->begin[sample->contact[c].first + 2]++;
    for (size_t p = 2; p < sample->count + 2; p++) strain->begin[p] += strain->begin[p - 1];
    for (size_t c = 0; c < sample->contact_count; c++)
        strain->contact[strain->begin[sample->contact[c].first + 1]++] = (uint32_t)c;
    return SCREE_OK;
}

/// Outline of a grain as it lay at first; `turned`: room for its corners.
static scree_core initial_core(const scree_average_sample *sample, const scree_average_grain *grain,
                               double (*turned)[2])
{
    if (grain->corner_count == 0) return (scree_core){.rounding = grain->radius};
    const double *turn = sample->turn[grain->body], angle = grain->angle - 2 * atan2(turn[3], turn[0]);
    scree_polygon_turn((int)grain->corner_count, (const double(*)[2])sample->corner + grain->first_corner, cos(angle),
                       sin(angle), turned);
    return (scree_core){.corner = (const double(*)[2])turned,
                        .count = (int)grain->corner_count,
                        .bound = grain->radius - grain->rounding,
                        .rounding = grain->rounding};
}

/// Cells of the initial centres with their gradients; none where the centres have no triangulation.
static scree_status make_cells(scree_average_strain *strain, scree_error *error)
{
    const scree_average_sample *sample = strain->sample;
    scree_assembly assembly = {.dimension = sample->dimension, .thickness = sample->thickness};
    scree_outlines *outlines = &assembly.outlines;
    double *moved = NULL;
    scree_error problem;
    scree_status status = scree_allocate(&strain->place, 3 * sample->count, sizeof *strain->place, error);
    if (!status) status = scree_allocate(&assembly.radius, sample->count, sizeof *assembly.radius, error);
    if (!status) status = scree_allocate(&moved, 3 * sample->count, sizeof *moved, error);
    if (!status && sample->corner_count > 0) {
        status = scree_allocate(&outlines->core, sample->count, sizeof *outlines->core, error);
        if (!status) status = scree_allocate(&outlines->corner, sample->corner_count, sizeof *outlines->corner, error);
    }
    for (size_t p = 0; p < sample->count && !status; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        if (!grain->counted || !grain->moved || !scree_average_bounds(sample, p)) continue;
        scree_subtract(grain->position, grain->displacement, strain->place + 3 * assembly.count);
        memcpy(moved + 3 * assembly.count, grain->displacement, sizeof grain->displacement);
        if (outlines->core)
            outlines->core[assembly.count] = initial_core(sample, grain, outlines->corner + grain->first_corner);
        assembly.radius[assembly.count++] = grain->radius;
    }
    assembly.position = strain->place;
    if (!status && !scree_cells_build(&assembly, SCREE_PEEL_RULE(sample->mean_radius), &strain->cells, &problem)) {
        status = scree_allocate(&strain->gradient, strain->cells.count, sizeof *strain->gradient, error);
        if (!status) scree_cells_gradient(&strain->cells, strain->place, moved, strain->gradient);
    }
    scree_outlines_destroy(outlines);
    scree_release(&assembly.radius);
    scree_release(&moved);
    return status;
}

scree_status scree_average_strain_open(const scree_average_sample *sample, const scree_average_bins *bins,
                                       scree_average_strain *strain, scree_error *error)
{
    *strain = (scree_average_strain){.sample = sample, .bins = bins};
    if (sample->directions) scree_matrix_invert(sample->lattice, strain->inverse);
    scree_status status = list_contacts(strain, error);
    if (!status) status = make_cells(strain, error);
    if (status) scree_average_strain_close(strain);
    return status;
}

void scree_average_strain_close(scree_average_strain *strain)
{
    scree_release(&strain->begin);
    scree_release(&strain->contact);
    scree_release(&strain->gradient);
    scree_release(&strain->place);
    scree_cells_destroy(&strain->cells);
}

// ---- fits --------------------------------------------------------------------------------------------------------

/// Sums of a fit of y against G x.
typedef struct fit {
    double products[9], squares[9], count;
} fit;

static void fit_add(fit *f, const double y[3], const double x[3])
{
    scree_tensor_add(f->products, 1, y, x);
    scree_tensor_add(f->squares, 1, x, x);
    f->count++;
}

/// G = (sum y (x) x) (sum x (x) x)^-1; NAN where it is not determined.
static void fit_solve(const fit *f, int dimension, double gradient[9])
{
    double inverse[9];
    const int good = f->count >= dimension && scree_tensor_invert(f->squares, dimension, inverse);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < dimension && good; k++) sum += f->products[3 * i + k] * inverse[3 * k + j];
            gradient[3 * i + j] = good ? sum : i < dimension && j < dimension ? NAN : 0;
        }
}

/// Grains and contacts of one element. Sums about a fixed place, which keeps their digits.
typedef struct gathering {
    const scree_average_strain *strain;
    const scree_average_element *element;
    scree_vector origin;
    fit cundall, cambou, liao;
    double place[3], moved[3]; ///< sums over the grains
} gathering;

/// Way of the surface of a grain at its lever because it turns: (Q - 1) times the initial lever = (1 - Q^T) r =
/// 2 v x (w r - v x r) of the turn (w, v), which keeps its digits where that is small.
static void add_turn(const double turn[4], const double lever[3], double sign, double sum[3])
{
    double across[3], way[3];
    scree_cross(turn + 1, lever, across);
    for (int k = 0; k < 3; k++) across[k] = turn[0] * lever[k] - across[k];
    scree_cross(turn + 1, across, way);
    scree_along(sum, 2 * sign, way, sum);
}

/// The second body of a contact may be an image that is not in the list: what its lattice vector has changed by.
static void add_image(const scree_average_strain *strain, const scree_average_contact *contact, double apart[3])
{
    const scree_average_sample *sample = strain->sample;
    double way[3], steps[3], change[3];
    scree_subtract(sample->grain[contact->first].position, contact->branch, way);
    scree_subtract(way, sample->grain[contact->second].position, way);
    whole_steps(sample->directions, strain->inverse, way, steps);
    scree_matrix_apply(sample->lattice_change, steps, change);
    scree_along(apart, -1, change, apart);
}

static void take_contact(gathering *g, const scree_average_contact *contact)
{
    const scree_average_sample *sample = g->strain->sample;
    if (contact->second == SCREE_AVERAGE_OUTSIDE) return;
    const scree_average_grain *first = &sample->grain[contact->first], *second = &sample->grain[contact->second];
    if (!first->counted || !second->counted || !first->moved || !second->moved) return;
    if (!scree_average_element_holds(g->element, sample->dimension, contact->point)) return;
    double apart[3], branch[3], lever[3];
    scree_subtract(first->displacement, second->displacement, apart);
    if (sample->directions) add_image(g->strain, contact, apart);
    scree_subtract(contact->branch, apart, branch);
    fit_add(&g->cambou, apart, branch);
    if (!sample->turn) return;
    for (int end = 0; end < 2; end++) {
        scree_average_lever(sample, contact, end, lever);
        add_turn(sample->turn[(end ? second : first)->body], lever, end ? -1 : 1, apart);
    }
    fit_add(&g->liao, apart, branch);
}

static void gather(void *user, uint32_t p)
{
    gathering *g = user;
    const scree_average_strain *strain = g->strain;
    const scree_average_grain *grain = &strain->sample->grain[p];
    for (size_t k = strain->begin[p]; k < strain->begin[p + 1]; k++)
        take_contact(g, &strain->sample->contact[strain->contact[k]]);
    if (!grain->moved || !scree_average_element_holds(g->element, strain->sample->dimension, grain->position)) return;
    double initial[3];
    for (int k = 0; k < 3; k++) initial[k] = grain->position[k] - grain->displacement[k] - g->origin[k];
    fit_add(&g->cundall, grain->displacement, initial);
    scree_along(g->place, 1, initial, g->place);
    scree_along(g->moved, 1, grain->displacement, g->moved);
}

static gathering gather_all(const scree_average_strain *strain, const scree_average_element *element)
{
    gathering g = {.strain = strain, .element = element};
    for (int k = 0; k < 3; k++) g.origin[k] = 0.5 * (element->low[k] + element->high[k]);
    scree_average_bins_visit(strain->bins, element, gather, &g);
    return g;
}

/// Sums about the means.
static void centre(gathering *g)
{
    const double n = g->cundall.count;
    if (n == 0) return;
    scree_tensor_add(g->cundall.products, -1 / n, g->moved, g->place);
    scree_tensor_add(g->cundall.squares, -1 / n, g->place, g->place);
}

/// The one gradient that agrees with the mean displacements of the element and of its neighbours.
static void find_difference(const scree_average_strain *strain, const scree_average_element *element,
                            const gathering *here, double gradient[9])
{
    const int d = strain->sample->dimension;
    fit f = {0};
    for (int axis = 0; axis < d; axis++) {
        scree_average_element there = *element;
        const double side = element->high[axis] - element->low[axis];
        there.low[axis] += side;
        there.high[axis] += side;
        const gathering g = gather_all(strain, &there);
        double apart[3], moved[3];
        if (g.cundall.count == 0 || here->cundall.count == 0) break;
        for (int k = 0; k < 3; k++) {
            apart[k] =
                g.place[k] / g.cundall.count + g.origin[k] - here->place[k] / here->cundall.count - here->origin[k];
            moved[k] = g.moved[k] / g.cundall.count - here->moved[k] / here->cundall.count;
        }
        fit_add(&f, moved, apart);
    }
    fit_solve(&f, d, gradient);
}

/// The part of a cell that counts for the element [m2, m3].
static double cell_part(const scree_average_strain *strain, const scree_average_element *element, size_t k)
{
    const scree_cells *cells = &strain->cells;
    if (cells->dimension == 3) {
        scree_vector middle;
        scree_cell_centre(cells, k, strain->place, middle);
        return scree_average_element_holds(element, 3, middle) ? cells->volume[k] : 0;
    }
    double corner[3][2], low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int n = 0; n < 3; n++)
        for (int i = 0; i < 2; i++) {
            corner[n][i] = strain->place[3 * cells->node[k][n] + (size_t)i];
            low[i] = fmin(low[i], corner[n][i]);
            high[i] = fmax(high[i], corner[n][i]);
        }
    for (int i = 0; i < 2; i++)
        if (low[i] >= element->high[i] || high[i] <= element->low[i]) return 0;
    return scree_average_polygon_part(3, (const double(*)[2])corner, element->low[0], element->high[0], element->low[1],
                                      element->high[1]);
}

static void find_bagi(const scree_average_strain *strain, const scree_average_element *element, double gradient[9])
{
    double sum[9] = {0}, volume = 0;
    for (size_t k = 0; k < strain->cells.count; k++) {
        const double part = cell_part(strain, element, k);
        if (!(part > 0)) continue;
        scree_tensor_add_scaled(sum, part, strain->gradient[k]);
        volume += part;
    }
    for (int i = 0; i < 9; i++) gradient[i] = sum[i] / volume;
}

void scree_average_strain_find(const scree_average_strain *strain, const scree_average_element *element,
                               scree_vector displacement, double gradient[SCREE_AVERAGE_STRAINS][9])
{
    const int d = strain->sample->dimension;
    gathering g = gather_all(strain, element);
    for (int k = 0; k < 3; k++) displacement[k] = g.moved[k] / g.cundall.count;
    find_difference(strain, element, &g, gradient[SCREE_AVERAGE_DIFFERENCE]);
    centre(&g);
    fit_solve(&g.cundall, d, gradient[SCREE_AVERAGE_CUNDALL]);
    fit_solve(&g.cambou, d, gradient[SCREE_AVERAGE_CAMBOU]);
    fit_solve(&g.liao, d, gradient[SCREE_AVERAGE_LIAO]);
    find_bagi(strain, element, gradient[SCREE_AVERAGE_BAGI]);
}

const char *const scree_average_strain_names[SCREE_AVERAGE_STRAINS] = {"cundall", "cambou", "liao", "difference",
                                                                       "bagi"};

void scree_average_strain_tell(int dimension, const scree_vector displacement,
                               double gradient[SCREE_AVERAGE_STRAINS][9], scree_average_sink *sink, void *user)
{
    char text[32];
    for (int i = 0; i < dimension; i++) {
        (void)snprintf(text, sizeof text, "displacement_%c", "xyz"[i]);
        sink(user, text, "m", displacement[i]);
    }
    for (int s = 0; s < SCREE_AVERAGE_STRAINS; s++)
        for (int i = 0; i < dimension; i++)
            for (int j = 0; j < dimension; j++) {
                (void)snprintf(text, sizeof text, "%s_%c%c", scree_average_strain_names[s], "xyz"[i], "xyz"[j]);
                sink(user, text, "1", gradient[s][3 * i + j]);
            }
}
