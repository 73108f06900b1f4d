/// The order of stiffness, uniform displacement >= periodic >= minimal >= uniform traction, on one sample.
///
/// What makes it one sample. The grains of a periodic cell and the ghosts that they touch, with every contact once, are
/// a body with a boundary: ghosts and the grains that they are ghosts of. All conditions are put on this body; they
/// are linear in its displacements u and rotations w, and each allows what the one before allows:
///     uniform displacement   u = G x, w = 0 for all of the boundary, pairs of grain and ghost above all
///     periodic               u_image - u_grain = G H s, w_image = w_grain, for every pair on its own
///     minimal                the same for the mean of the pairs (least squares), and the symmetric part of G alone
///     uniform traction       forces S H s on ghosts and the opposite on grains, S a symmetric stress
/// The least of the elastic energy over a larger set is no larger (Huet 1990), so 2 E / V = G : C : G is ordered for
/// any packing and any G, to round-off, and no tolerance hides anything. The dual of the minimal conditions on all
/// components is the uniform traction, so these two are equal. For the comparison no grain turns: a ghost on a single
/// contact could roll about it, and satisfy a mean for nothing. The energy is that of the contacts of the sample,
/// linearised as model/critical_step.h says. Two runs that compare boundaries on different cuts of a packing
/// (test_boundary_order.c) order them only within the scatter of cuts.
///
/// What ties it to the code. The same small strains as a deform stage of the periodic cell must give the stress that
/// the periodic conditions give: ghost shifts, velocity jumps, virial and servo all enter.
#include "run_fixture.h"

#include "model/critical_step.h"
#include "state/periodic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char text_2d[] =
    "scree: 1\n"
    "name: plane\n"
    "dimension: 2\n"
    "materials: [{name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 10, restitution: 0.05}]\n"
    "particles: {shape: disc, material: quartz, count: 30, radius_min: 0.5 mm, radius_max: 0.8 mm}\n"
    "boundary: {periodic: xy}\n"
    "contact: {law: hertz_mindlin}\n"
    "integrator: {step_fraction: 0.5}\n"
    "stages:\n"
    "  - {stage: prepare, method: gas, aspect_ratio: 1, solid_fraction: 55 %, velocity: 20 mm/s}\n"
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 1e-5, friction: 0.02}\n"
    "  - {stage: deform, velocity_gradient: {yy: -1e-4 1/s}, strain: 0.001 %, rise_time: 10 ms}\n";

static const char text_3d[] =
    "scree: 1\n"
    "name: solid\n"
    "dimension: 3\n"
    "materials: [{name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 10, restitution: 0.05}]\n"
    "particles: {shape: sphere, material: quartz, count: 30, radius_min: 0.6 mm, radius_max: 0.8 mm}\n"
    "boundary: {periodic: xyz}\n"
    "contact: {law: hertz_mindlin}\n"
    "integrator: {step_fraction: 0.5}\n"
    "stages:\n"
    "  - {stage: prepare, method: gas, aspect_ratio: 1, solid_fraction: 38 %, velocity: 20 mm/s}\n"
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 5e-2, friction: 0.02}\n"
    "  - {stage: deform, velocity_gradient: {zz: -1e-5 1/s}, strain: 0.0001 %, rise_time: 10 ms}\n";

// ---- the network ---------------------------------------------------------------------------------------------------

/// A ghost that a contact needs.
typedef struct ghost {
    size_t parent;
    double away[3]; ///< m, H s
} ghost;

typedef struct network {
    int dimension, turns; ///< rotations: 1 or 3
    size_t grains, nodes; ///< ghosts behind the grains
    size_t ghost_count;
    ghost *ghost;
    double *place;     ///< nodes x 3
    double *stiffness; ///< size x size, size = nodes (dimension + turns)
    size_t size;
    double volume, scale; ///< m3; N/m
} network;

static size_t freedom(const network *n, size_t node, int k)
{
    return node * (size_t)(n->dimension + n->turns) + (size_t)k;
}

static bool is_boundary(const network *n, size_t node)
{
    if (node >= n->grains) return true;
    for (size_t k = 0; k < n->ghost_count; k++)
        if (n->ghost[k].parent == node) return true;
    return false;
}

/// Node of the ghost of `parent` at `away`, a new one if there is none.
static size_t ghost_node(network *n, size_t parent, const double away[3])
{
    for (size_t k = 0; k < n->ghost_count; k++) {
        const ghost *known = &n->ghost[k];
        double apart = 0;
        for (int i = 0; i < 3; i++) apart += fabs(known->away[i] - away[i]);
        if (known->parent == parent && apart < 1e-6) return n->grains + k;
    }
    n->ghost[n->ghost_count].parent = parent;
    memcpy(n->ghost[n->ghost_count].away, away, sizeof n->ghost->away);
    return n->grains + n->ghost_count++;
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++) c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/// Adds a spring between the surfaces of two nodes in a direction.
static void add_spring(network *n, size_t one, size_t other, const double normal[3], const double radius[2],
                       const double direction[3], double stiffness)
{
    const size_t node[2] = {one, other};
    size_t index[12];
    double row[12];
    int count = 0;
    for (int side = 0; side < 2; side++) {
        double arm[3], turn[3], sign = side == 0 ? 1 : -1;
        for (int k = 0; k < 3; k++) arm[k] = -sign * radius[side] * normal[k];
        cross(arm, direction, turn);
        for (int k = 0; k < n->dimension; k++, count++) {
            index[count] = freedom(n, node[side], k);
            row[count] = sign * direction[k];
        }
        for (int k = 0; k < n->turns; k++, count++) {
            index[count] = freedom(n, node[side], n->dimension + k);
            row[count] = sign * turn[n->turns == 1 ? 2 : k];
        }
    }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) n->stiffness[index[i] * n->size + index[j]] += stiffness * row[i] * row[j];
}

/// Two directions across the normal.
static void tangents(int dimension, const double normal[3], double t[2][3])
{
    const double flat[3] = {-normal[1], normal[0], 0}, helper[3] = {fabs(normal[0]) < 0.8, fabs(normal[0]) >= 0.8, 0};
    if (dimension == 2) {
        memcpy(t[0], flat, sizeof flat);
        return;
    }
    cross(normal, helper, t[0]);
    double length = scree_length(t[0]);
    for (int k = 0; k < 3; k++) t[0][k] /= length;
    cross(normal, t[0], t[1]);
}

static void add_contact(network *n, const scree_simulation *s, const scree_contact *c, size_t one, size_t other)
{
    const scree_row *row = s->state.row;
    const double radius[2] = {row[c->first].radius - 0.5 * c->overlap, row[c->second].radius - 0.5 * c->overlap};
    double a = row[c->first].radius, b = row[c->second].radius, m = row[c->first].mass;
    scree_contact_tangent k = scree_contact_linearise(&s->stage_model.laws[0], &s->model.pairs[0][0], a * b / (a + b),
                                                      m / 2, c->normal_force);
    double t[2][3];
    tangents(n->dimension, c->normal, t);
    add_spring(n, one, other, c->normal, radius, c->normal, k.normal_stiffness);
    for (int i = 0; i + 1 < n->dimension; i++)
        add_spring(n, one, other, c->normal, radius, t[i], k.tangential_stiffness);
    n->scale = fmax(n->scale, k.normal_stiffness);
}

static void *room(size_t count, size_t size)
{
    void *memory = calloc(count + 1, size);
    assert_non_null(memory);
    return memory;
}

/// Places of the grains of the cell, each moved by lattice vectors to where contacts lead from one grain to the next:
/// the body holds together without its ghosts.
static void make_connected(const scree_simulation *s, const scree_contact_table *table, double (*whole)[3])
{
    bool *reached = room(s->state.count, sizeof *reached), more = true;
    for (size_t k = 0; k < s->state.count; k++) scree_body_position(&s->state, k, whole[k]);
    if (table->count > 0) reached[table->contact[0].first] = true;
    while (more) {
        more = false;
        for (size_t k = 0; k < table->count; k++) {
            const scree_contact *c = &table->contact[k];
            if (reached[c->first] == reached[c->second]) continue;
            size_t from = reached[c->first] ? c->first : c->second, to = reached[c->first] ? c->second : c->first;
            for (int i = 0; i < 3; i++) whole[to][i] = whole[from][i] + (from == c->first ? -1 : 1) * c->branch[i];
            reached[to] = more = true;
        }
    }
    free(reached);
}

static void build(network *n, const scree_simulation *s)
{
    scree_contact_table table = {0};
    scree_error error;
    check(scree_contact_table_build(&s->stage_model, &s->state, &s->work, &table, &error), &error);
    *n = (network){.dimension = s->state.dimension, .turns = s->state.dimension == 3 ? 3 : 1, .grains = s->state.count};
    n->ghost = room(table.count, sizeof *n->ghost);
    n->volume = scree_periodic_extent(&s->state) * (n->dimension == 2 ? s->model.thickness : 1);
    size_t *second = room(table.count, sizeof *second);
    double(*whole)[3] = room(n->grains, sizeof *whole);
    make_connected(s, &table, whole);
    for (size_t k = 0; k < table.count; k++) {
        const scree_contact *c = &table.contact[k];
        double away[3], size = 0;
        for (int i = 0; i < 3; i++) size += fabs(away[i] = whole[c->first][i] - c->branch[i] - whole[c->second][i]);
        second[k] = size < 1e-6 ? c->second : ghost_node(n, c->second, away);
    }
    n->nodes = n->grains + n->ghost_count;
    n->size = freedom(n, n->nodes, 0);
    n->stiffness = room(n->size * n->size, sizeof(double));
    n->place = room(3 * n->nodes, sizeof(double));
    for (size_t k = 0; k < n->nodes; k++) {
        const ghost *of = k < n->grains ? NULL : &n->ghost[k - n->grains];
        for (size_t i = 0; i < 3; i++) n->place[3 * k + i] = whole[of ? of->parent : k][i] + (of ? of->away[i] : 0);
    }
    for (size_t k = 0; k < table.count; k++) add_contact(n, s, &table.contact[k], table.contact[k].first, second[k]);
    // Bodies without contacts, and motions of the whole: the same little energy for all conditions.
    for (size_t k = 0; k < n->size; k++)
        n->stiffness[k * n->size + k] +=
            1e-10 * n->scale * (k % (size_t)(n->dimension + n->turns) < (size_t)n->dimension ? 1 : 1e-6);
    free(second), free(whole);
    scree_contact_table_destroy(&table);
}

static void release(network *n)
{
    free(n->ghost);
    free(n->stiffness);
    free(n->place);
}

// ---- conditions ----------------------------------------------------------------------------------------------------

/// Solves the n x n system by elimination with row pivots; both are overwritten.
static void solve(size_t n, double *matrix, double *vector)
{
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; i++)
            if (fabs(matrix[i * n + k]) > fabs(matrix[pivot * n + k])) pivot = i;
        for (size_t j = k; j < n && pivot != k; j++) {
            double swap = matrix[k * n + j];
            matrix[k * n + j] = matrix[pivot * n + j];
            matrix[pivot * n + j] = swap;
        }
        double swap = vector[k];
        vector[k] = vector[pivot];
        vector[pivot] = swap;
        for (size_t i = k + 1; i < n; i++) {
            double factor = matrix[i * n + k] / matrix[k * n + k];
            if (factor == 0) continue;
            for (size_t j = k; j < n; j++) matrix[i * n + j] -= factor * matrix[k * n + j];
            vector[i] -= factor * vector[k];
        }
    }
    for (size_t k = n; k-- > 0;) {
        for (size_t j = k + 1; j < n; j++) vector[k] -= matrix[k * n + j] * vector[j];
        vector[k] /= matrix[k * n + k];
    }
}

static double apply(const double gradient[9], const double x[3], int k)
{
    return gradient[3 * k] * x[0] + gradient[3 * k + 1] * x[1] + gradient[3 * k + 2] * x[2];
}

typedef enum condition { DISPLACEMENT, PERIODIC, TIED } condition;

/// Which freedom a freedom follows (itself: free), and by what it is ahead; SIZE_MAX: it is prescribed.
static void tie(const network *n, condition kind, bool turning, const double gradient[9], size_t *leader, double *ahead)
{
    for (size_t node = 0; node < n->nodes; node++) {
        const ghost *of = node < n->grains ? NULL : &n->ghost[node - n->grains];
        for (int k = 0; k < n->dimension + n->turns; k++) {
            size_t f = freedom(n, node, k);
            bool turn = k >= n->dimension;
            leader[f] = f;
            ahead[f] = 0;
            if (turn ? !turning : kind == DISPLACEMENT && is_boundary(n, node)) {
                leader[f] = SIZE_MAX;
                ahead[f] = turn ? 0 : apply(gradient, &n->place[3 * node], k);
            } else if (of && kind == PERIODIC) {
                leader[f] = freedom(n, of->parent, k);
                ahead[f] = turn ? 0 : apply(gradient, of->away, k);
            }
        }
    }
}

/// The energy in terms of the free freedoms: 1/2 q A q + b q + c. Returns their number; number [size] out.
static size_t reduce(const network *n, const size_t *leader, const double *ahead, size_t *number, double *a, double *b,
                     double *c)
{
    size_t free_count = 0;
    for (size_t f = 0; f < n->size; f++)
        if (leader[f] == f) number[f] = free_count++;
    *c = 0;
    for (size_t i = 0; i < n->size; i++)
        for (size_t j = 0; j < n->size; j++) {
            double k = n->stiffness[i * n->size + j];
            if (k == 0) continue;
            *c += 0.5 * ahead[i] * k * ahead[j];
            if (leader[i] == SIZE_MAX) continue;
            b[number[leader[i]]] += k * ahead[j];
            if (leader[j] != SIZE_MAX) a[number[leader[i]] * free_count + number[leader[j]]] += k;
        }
    return free_count;
}

/// G : C : G under uniform displacement or periodic conditions [Pa].
static double strict_modulus(const network *n, condition kind, bool turning, const double gradient[9])
{
    size_t *leader = room(n->size, sizeof *leader), *number = room(n->size, sizeof *number);
    double *ahead = room(n->size, sizeof *ahead), *a = room(n->size * n->size, sizeof *a);
    double *b = room(n->size, sizeof *b), *q = room(n->size, sizeof *q), energy;
    tie(n, kind, turning, gradient, leader, ahead);
    size_t count = reduce(n, leader, ahead, number, a, b, &energy);
    for (size_t k = 0; k < count; k++) q[k] = -b[k];
    solve(count, a, q);
    // At the minimum b q / 2 is left.
    for (size_t k = 0; k < count; k++) energy += 0.5 * b[k] * q[k];
    free(leader), free(number), free(ahead), free(a), free(b), free(q);
    return 2 * energy / n->volume;
}

/// Components of symmetric tensors: 3 or 6.
static int components(const network *n, int pair[6][2])
{
    int count = 0;
    for (int i = 0; i < n->dimension; i++)
        for (int j = i; j < n->dimension; j++, count++) pair[count][0] = i, pair[count][1] = j;
    return count;
}

/// Rows [components x count] that give the mean symmetric gradient of the pairs from the free freedoms. Mean: of a
/// least squares fit of u_image - u_grain = G H s.
static void mean_rows(const network *n, const size_t *number, size_t count, double *rows)
{
    double moment[9] = {0}, inverse[9];
    int pair[6][2], total = components(n, pair);
    for (size_t k = 0; k < n->ghost_count; k++)
        for (int i = 0; i < 9; i++) moment[i] += n->ghost[k].away[i / 3] * n->ghost[k].away[i % 3];
    if (n->dimension == 2) moment[8] = 1;
    for (int k = 0; k < 3; k++) {
        double copy[9], unit[3] = {k == 0, k == 1, k == 2};
        memcpy(copy, moment, sizeof copy);
        solve(3, copy, unit);
        for (int i = 0; i < 3; i++) inverse[3 * i + k] = unit[i];
    }
    for (size_t k = 0; k < n->ghost_count; k++)
        for (int c = 0; c < total; c++)
            for (int order = 0; order < 2; order++) {
                int i = pair[c][order], j = pair[c][1 - order];
                double weight = 0.5 * apply(inverse, n->ghost[k].away, j);
                rows[(size_t)c * count + number[freedom(n, n->grains + k, i)]] += weight;
                rows[(size_t)c * count + number[freedom(n, n->ghost[k].parent, i)]] -= weight;
            }
}

/// G : C : G with the mean gradient prescribed (minimal), or from the compliance under uniform traction [Pa].
static double mean_modulus(const network *n, bool traction, const double gradient[9])
{
    size_t *leader = room(n->size, sizeof *leader), *number = room(n->size, sizeof *number);
    double *ahead = room(n->size, sizeof *ahead), *a = room(n->size * n->size, sizeof *a),
           *b = room(n->size, sizeof *b);
    double energy, result = 0;
    int pair[6][2], total = components(n, pair);
    tie(n, TIED, false, gradient, leader, ahead);
    size_t count = reduce(n, leader, ahead, number, a, b, &energy), whole = count + (size_t)total;
    double *rows = room((size_t)total * count, sizeof *rows), wanted[6] = {0};
    mean_rows(n, number, count, rows);
    for (int c = 0; c < total; c++)
        wanted[c] = 0.5 * (gradient[3 * pair[c][0] + pair[c][1]] + gradient[3 * pair[c][1] + pair[c][0]]);
    if (!traction) {
        // Stationary: A q + rows^T m = 0, rows q = wanted.
        double *matrix = room(whole * whole, sizeof *matrix), *vector = room(whole, sizeof *vector);
        for (size_t i = 0; i < count; i++)
            for (size_t j = 0; j < count; j++) matrix[i * whole + j] = a[i * count + j];
        for (size_t c = 0; c < (size_t)total; c++) {
            vector[count + c] = wanted[c];
            for (size_t j = 0; j < count; j++)
                matrix[j * whole + count + c] = matrix[(count + c) * whole + j] = rows[c * count + j];
        }
        solve(whole, matrix, vector);
        for (size_t c = 0; c < (size_t)total; c++) result -= vector[count + c] * wanted[c];
        free(matrix), free(vector);
    } else {
        // Forces rows^T S of a stress S V; mean strains of unit stresses are the compliance.
        double compliance[36], stress[6];
        for (int c = 0; c < total; c++) {
            double *copy = room(count * count, sizeof *copy), *q = room(count, sizeof *q);
            memcpy(copy, a, count * count * sizeof *copy);
            memcpy(q, &rows[(size_t)c * count], count * sizeof *q);
            solve(count, copy, q);
            for (int d = 0; d < total; d++) {
                compliance[d * total + c] = 0;
                for (size_t k = 0; k < count; k++) compliance[d * total + c] += rows[(size_t)d * count + k] * q[k];
            }
            free(copy), free(q);
        }
        memcpy(stress, wanted, sizeof stress);
        solve((size_t)total, compliance, stress);
        for (int c = 0; c < total; c++) result += stress[c] * wanted[c];
    }
    free(leader), free(number), free(ahead), free(a), free(b), free(rows);
    return result / n->volume;
}

// ---- the sample ----------------------------------------------------------------------------------------------------

static void order_of(const network *n, const double gradient[9])
{
    double displacement = strict_modulus(n, DISPLACEMENT, false, gradient);
    double periodic = strict_modulus(n, PERIODIC, false, gradient);
    double minimal = mean_modulus(n, false, gradient), traction = mean_modulus(n, true, gradient);
    print_message("%dD: displacement %.5g, periodic %.5g, minimal %.5g, traction %.5g Pa\n", n->dimension, displacement,
                  periodic, minimal, traction);
    assert_true(displacement > periodic && periodic > minimal && minimal > 0);
    // Equal but for round-off, 2^-53 times the condition of the system (1e10, the stiffness given to bodies alone).
    assert_true(fabs(minimal / traction - 1) < 1e-4);
}

/// Runs the stage that strains the cell along its axis; expected: its modulus [Pa].
static void compare_with_stage(scree_simulation *s, double expected)
{
    double before[9], after[9];
    const int axial = 4 * (s->state.dimension - 1);
    double strained = scree_cell(&s->state)->strain[axial];
    scree_periodic_stress(&s->stage_model, &s->state, before);
    while (simulation_goes_on(s)) simulation_step(s);
    scree_periodic_stress(&s->stage_model, &s->state, after);
    double found = (after[axial] - before[axial]) / (scree_cell(&s->state)->strain[axial] - strained);
    print_message("%dD: as a stage %.5g, as a network %.5g Pa\n", s->state.dimension, found, expected);
    // The network leaves out that contacts turn the forces that they have: f / (k R) = 5 % at overlaps of 8 % of R.
    assert_true(fabs(found / expected - 1) < 0.06);
}

static void the_order_holds(const char *text, bool as_stage)
{
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_load(&s);
    network n;
    build(&n, &s);
    int axial = 4 * (n.dimension - 1);
    double gradient[9] = {0}, shear[9] = {0};
    gradient[axial] = 1;
    shear[1] = shear[3] = 0.5;
    order_of(&n, gradient);
    order_of(&n, shear);
    double expected = strict_modulus(&n, PERIODIC, true, gradient);
    release(&n);

    if (as_stage) compare_with_stage(&s, expected);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void discs_are_ordered(void **unused)
{
    (void)unused;
    the_order_holds(text_2d, true);
}

static void spheres_are_ordered(void **unused)
{
    (void)unused;
    the_order_holds(text_3d, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discs_are_ordered),
        cmocka_unit_test(spheres_are_ordered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
