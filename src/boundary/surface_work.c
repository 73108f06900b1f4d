/// Work of loads over surfaces, a sum in integers; cost O(bodies).
#include "boundary/surface_work.h"

#include "base/integer_sum.h"
#include "comm/comm.h"
#include "contact/stretch.h"

double scree_surface_half_work(const scree_state *state, const double (*surface)[6])
{
    const int d = state->dimension;
    scree_integer_sum sum = {0};
    while (scree_comm_sum_next(state, &sum, 1))
        for (size_t row = 0; row < state->count; row++) {
            double change[6];
            scree_tensor_get(d, scree_stretch_row(state, row) + scree_stretch_size(d) / 2, change);
            scree_integer_sum_add(&sum, scree_tensor_product(d, surface[row], change));
        }
    return 0.5 * scree_integer_sum_total(&sum);
}

void scree_surface_add(int dimension, const double direction[3], const double force[3], double surface[6])
{
    const scree_tensor_place *place = scree_tensor_places(dimension);
    for (int n = 0; n < scree_tensor_size(dimension); n++) {
        const int i = place[n].i, j = place[n].j;
        surface[n] += 0.5 * (direction[i] * force[j] + direction[j] * force[i]);
    }
}
