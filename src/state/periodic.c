/// Geometry of the periodic cell; formulas in boundary/periodic.c.
#include "state/periodic.h"
#include "state/plates.h"

#include "base/matrix.h"

#include <string.h>

void scree_periodic_set(scree_periodic_cell *cell, uint32_t periodic, const double sides[3])
{
    memset(cell, 0, sizeof *cell);
    cell->directions = periodic;
    scree_matrix_unit(cell->lattice);
    for (int k = 0; k < 3; k++)
        if (scree_periodic_repeats(cell, k)) cell->lattice[4 * k] = sides[k];
    memcpy(cell->reference, cell->lattice, sizeof cell->reference);
}

void scree_periodic_widths(const double inverse[9], double width[3])
{
    for (int k = 0; k < 3; k++) width[k] = 1 / scree_length(&inverse[3 * k]);
}

double scree_periodic_extent(const scree_state *state)
{
    double extent = fabs(scree_matrix_determinant(scree_cell(state)->lattice));
    scree_vector low, high;
    scree_periodic_box(state->dimension, scree_plates(state), low, high);
    for (int k = 0; k < state->dimension; k++)
        if (!scree_periodic_repeats(scree_cell(state), k)) extent *= high[k] - low[k];
    return extent;
}

uint32_t scree_periodic_plates(const scree_state *state)
{
    uint32_t plates = 0;
    for (int w = 0; w < 2 * state->dimension; w++) {
        int axis = w / 2 == 0 ? state->dimension - 1 : w / 2 - 1;
        if (!scree_periodic_repeats(scree_cell(state), axis)) plates |= UINT32_C(1) << w;
    }
    return plates;
}

bool scree_periodic_is_closed(const scree_state *state)
{
    const uint32_t room = scree_periodic_plates(state);
    for (int w = 0; w < 2 * state->dimension; w++)
        if (room >> w & 1 && !scree_plates(state)[w].active) return false;
    return true;
}

void scree_periodic_box(int dimension, const scree_wall *plates, scree_vector low, scree_vector high)
{
    static const int below[] = {SCREE_WALL_LEFT, SCREE_WALL_FRONT}, above[] = {SCREE_WALL_RIGHT, SCREE_WALL_BACK};
    for (int k = 0; k < 3; k++) {
        bool axial = k == dimension - 1, none = k >= dimension;
        low[k] = none ? 0 : plates[axial ? SCREE_WALL_BOTTOM : below[k]].position;
        high[k] = none ? 0 : -plates[axial ? SCREE_WALL_TOP : above[k]].position;
    }
}

bool scree_periodic_edge(const scree_periodic_cell *cell, int dimension, const scree_vector low,
                         const scree_vector high, int edge, scree_vector ends[2])
{
    // Edges are numbered by their direction and the corner, a bit a direction, that they begin at.
    int direction = edge / 8, corner = edge % 8;
    if (direction >= dimension || corner >= 1 << dimension || corner >> direction & 1) return false;
    for (int end = 0; end < 2; end++) {
        int bits = corner | end << direction;
        for (int i = 0; i < 3; i++) {
            ends[end][i] = 0;
            for (int k = 0; k < dimension; k++)
                if (scree_periodic_repeats(cell, k) && bits >> k & 1) ends[end][i] += cell->lattice[3 * i + k];
            if (i < dimension && !scree_periodic_repeats(cell, i)) ends[end][i] = bits >> i & 1 ? high[i] : low[i];
        }
    }
    return true;
}

/// (unit + sign dt/2 L)^-1
static void half_step_inverse(const scree_state *state, double sign, double inverse[9])
{
    double matrix[9];
    scree_matrix_unit_plus(sign * 0.5 * state->step_size, scree_cell(state)->gradient, matrix);
    scree_matrix_invert(matrix, inverse);
}

void scree_periodic_lattice_velocity(const scree_state *state, double velocity[9])
{
    double back[9], middle[9];
    half_step_inverse(state, 1, back);
    scree_matrix_multiply(back, scree_cell(state)->lattice, middle);
    scree_matrix_multiply(scree_cell(state)->gradient, middle, velocity);
}

void scree_periodic_stress(const scree_model *model, const scree_state *state, double stress[9])
{
    const scree_periodic_cell *cell = scree_cell(state);
    double volume = scree_periodic_extent(state) * (state->dimension == 2 ? model->thickness : 1);
    for (int k = 0; k < 9; k++) stress[k] = -(cell->virial[k] + cell->motion[k]) / volume;
}

void scree_periodic_full_velocity(const scree_state *state, const scree_vector position, const scree_vector relative,
                                  scree_vector velocity)
{
    // c+ = (1 - h L) c, v = c + L (x - h v), h = dt / 2.
    double forward[9], back[9];
    scree_vector middle, affine, sum;
    half_step_inverse(state, -1, forward);
    half_step_inverse(state, 1, back);
    scree_matrix_apply(forward, relative, middle);
    scree_matrix_apply(scree_cell(state)->gradient, position, affine);
    for (int k = 0; k < 3; k++) sum[k] = middle[k] + affine[k];
    scree_matrix_apply(back, sum, velocity);
}
