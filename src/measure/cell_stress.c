/// Stress of the cells: the force (x) branch of each contact shared to cells. See cells.h for the rules and what they
/// keep exact.
///
/// Why shares as volumes: the stress that an edge gives is then the same in all cells around it, f (x) l over their
/// common volume, and a flat cell among them gets a stress no higher than the others. Why lengths for a branch that is
/// no edge (neighbours of very different sizes): the linear interpolation of the velocities changes along the branch by
/// v_second - v_first = sum_k L_k . l_k, l_k its piece in cell k, so that power is kept whatever the share of the other
/// rule. Cells that a branch crosses are found from those of its ends on, through neighbours, by the interval in which
/// all barycentric coordinates of the points of the branch are positive. Cost: O(contacts).
#include "measure/cells.h"

#include <math.h>

/// Pieces of a branch shorter than this part of it are round-off at a corner.
#define PIECE 1e-12
enum { MOST_CELLS = 256 };

scree_status scree_node_cells_build(const scree_cells *cells, scree_node_cells *list, scree_error *error)
{
    int nodes = cells->dimension + 1;
    *list = (scree_node_cells){0};
    scree_status status = scree_allocate(&list->begin, cells->bodies + 2, sizeof *list->begin, error);
    if (!status) status = scree_allocate(&list->cell, (size_t)nodes * cells->count, sizeof *list->cell, error);
    if (status) {
        scree_node_cells_destroy(list);
        return status;
    }
    // begin[i + 1] advances to the end of list i while it is filled.
    for (size_t k = 0; k < cells->count; k++)
        for (int n = 0; n < nodes; n++) list->begin[cells->node[k][n] + 2]++;
    for (size_t i = 0; i < cells->bodies; i++) list->begin[i + 2] += list->begin[i + 1];
    for (size_t k = 0; k < cells->count; k++)
        for (int n = 0; n < nodes; n++) list->cell[list->begin[cells->node[k][n] + 1]++] = (uint32_t)k;
    return SCREE_OK;
}

void scree_node_cells_destroy(scree_node_cells *list)
{
    scree_release(&list->begin);
    scree_release(&list->cell);
}

/// Cells and shares of one contact.
typedef struct sharing {
    uint32_t cell[MOST_CELLS];
    double share[MOST_CELLS];
    size_t count;
    double sum;
} sharing;

static void share_add(sharing *s, uint32_t cell, double share)
{
    if (s->count == MOST_CELLS) return;
    s->cell[s->count] = cell;
    s->share[s->count++] = share;
    s->sum += share;
}

static bool has_node(const scree_cells *cells, uint32_t cell, uint32_t node)
{
    for (int n = 0; n <= cells->dimension; n++)
        if (cells->node[cell][n] == node) return true;
    return false;
}

static void share_edge(const scree_cells *cells, const scree_node_cells *list, uint32_t a, uint32_t b, sharing *s)
{
    for (uint32_t k = list->begin[a]; k < list->begin[a + 1]; k++)
        if (has_node(cells, list->cell[k], b)) share_add(s, list->cell[k], cells->volume[list->cell[k]]);
}

/// Volume of cell k with node n moved to x, over anything constant: the barycentric coordinate n of x.
static double barycentric(const scree_cells *cells, uint32_t k, int n, const double *position, const scree_vector x)
{
    double corner[12];
    scree_cells one = {.dimension = cells->dimension, .count = 1};
    uint32_t node[1][4] = {{0, 1, 2, 3}};
    for (int m = 0; m <= cells->dimension; m++)
        for (int i = 0; i < 3; i++)
            corner[3 * m + i] = m == n ? x[i] : position[3 * (size_t)cells->node[k][m] + (size_t)i];
    one.node = node;
    return scree_cell_volume_at(&one, 0, corner);
}

/// Part of the way from a to b that lies in cell k.
static double piece_inside(const scree_cells *cells, uint32_t k, const double *position, uint32_t a, uint32_t b)
{
    double from = 0, to = 1;
    for (int n = 0; n <= cells->dimension; n++) {
        double start = barycentric(cells, k, n, position, position + 3 * (size_t)a);
        double end = barycentric(cells, k, n, position, position + 3 * (size_t)b);
        if (start <= 0 && end <= 0) return 0;
        if (start < 0) from = fmax(from, start / (start - end));
        if (end < 0) to = fmin(to, start / (start - end));
    }
    return fmax(to - from, 0);
}

static bool seen(const uint32_t *queue, size_t count, uint32_t cell)
{
    for (size_t k = 0; k < count; k++)
        if (queue[k] == cell) return true;
    return false;
}

/// Cells that the branch crosses, from its two ends on.
static void share_crossing(const scree_cells *cells, const scree_node_cells *list, const double *position, uint32_t a,
                           uint32_t b, sharing *s)
{
    uint32_t queue[MOST_CELLS];
    size_t queued = 0;
    const uint32_t ends[2] = {a, b};
    for (int e = 0; e < 2; e++)
        for (uint32_t k = list->begin[ends[e]]; k < list->begin[ends[e] + 1] && queued < MOST_CELLS; k++)
            if (!seen(queue, queued, list->cell[k])) queue[queued++] = list->cell[k];
    for (size_t head = 0; head < queued; head++) {
        uint32_t cell = queue[head];
        double piece = piece_inside(cells, cell, position, a, b);
        if (!(piece > PIECE)) continue;
        share_add(s, cell, piece);
        for (int n = 0; n <= cells->dimension && queued < MOST_CELLS; n++) {
            int32_t behind = cells->neighbour[cell][n];
            if (behind >= 0 && !seen(queue, queued, (uint32_t)behind)) queue[queued++] = (uint32_t)behind;
        }
    }
}

static void share_ends(const scree_cells *cells, const scree_node_cells *list, uint32_t a, uint32_t b, sharing *s)
{
    const uint32_t ends[2] = {a, b};
    for (int e = 0; e < 2; e++)
        for (uint32_t k = list->begin[ends[e]]; k < list->begin[ends[e] + 1]; k++)
            share_add(s, list->cell[k], cells->volume[list->cell[k]]);
}

/// Subtracts share x f (x) l from V stress of the cells.
static void add_contact(const scree_contact *contact, const sharing *s, double (*stress)[9])
{
    scree_vector force;
    for (int i = 0; i < 3; i++)
        force[i] = contact->normal_force * contact->normal[i] + contact->tangential_force * contact->tangent[i];
    for (size_t k = 0; k < s->count; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                stress[s->cell[k]][3 * i + j] -= s->share[k] / s->sum * force[i] * contact->branch[j];
}

/// Where grains are, in the order of their ids, and of each row its place in that order.
typedef struct positions {
    double *position; ///< m, 3 a grain
    uint32_t *of_row;
} positions;

static scree_status places_by_id(const scree_state *state, positions *p, scree_error *error)
{
    uint32_t *row = NULL;
    scree_status status = scree_grains_by_id(state, &row, error);
    if (!status) status = scree_allocate(&p->position, 3 * scree_grain_count(state), sizeof *p->position, error);
    if (!status) status = scree_allocate(&p->of_row, state->count, sizeof *p->of_row, error);
    for (size_t k = 0; k < scree_grain_count(state) && !status; k++) {
        scree_body_position(state, row[k], p->position + 3 * k);
        p->of_row[row[k]] = (uint32_t)k;
    }
    scree_release(&row);
    return status;
}

scree_status scree_cells_stress(scree_cells *cells, const scree_state *state, const scree_contact_table *table,
                                double (*stress)[9], scree_error *error)
{
    scree_node_cells list;
    positions p = {0};
    scree_status status = scree_node_cells_build(cells, &list, error);
    if (status) return status;
    status = places_by_id(state, &p, error);
    cells->crossing = cells->unassigned = 0;
    for (size_t k = 0; k < cells->count && !status; k++)
        for (int i = 0; i < 9; i++) stress[k][i] = 0;
    for (size_t c = 0; c < table->count && !status; c++) {
        const scree_contact *contact = &table->contact[c];
        if (contact->wall || !scree_body_is_grain(state, contact->first) ||
            !scree_body_is_grain(state, contact->second))
            continue;
        uint32_t a = p.of_row[contact->first], b = p.of_row[contact->second];
        sharing s = {.count = 0};
        share_edge(cells, &list, a, b, &s);
        if (s.count == 0) {
            cells->crossing++;
            share_crossing(cells, &list, p.position, a, b, &s);
        }
        if (s.count == 0) {
            cells->unassigned++;
            share_ends(cells, &list, a, b, &s);
        }
        add_contact(contact, &s, stress);
    }
    for (size_t k = 0; k < cells->count && !status; k++)
        for (int i = 0; i < 9; i++) stress[k][i] /= cells->volume[k];
    scree_node_cells_destroy(&list);
    scree_release(&p.position);
    scree_release(&p.of_row);
    return status;
}
