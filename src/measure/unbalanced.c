/// How far the assembly is from equilibrium: the mean resultant force (contacts, boundary and gravity) on the bodies
/// that touch something, over the mean contact force. Bodies without contact are left out: they are not part of the
/// assembly, and many of them at rest would make it look calmer than it is. Cost: O(bodies + contacts).
#include "measure/measure.h"

#include "integrate/integrate.h"

#include <math.h>

double scree_unbalanced_ratio(const scree_model *model, const scree_state *state, const scree_contact_table *table)
{
    double resultant = 0, contact_force = 0, force[3];
    size_t bodies = 0;
    for (size_t id = 0; id < state->count; id++) {
        size_t row = state->row_of_id[id];
        if (state->sum[row].contacts == 0) continue;
        scree_body_force(model, state, row, force);
        resultant += hypot(force[0], force[1]);
        bodies++;
    }
    for (size_t c = 0; c < table->count; c++)
        contact_force += hypot(table->contact[c].normal_force, table->contact[c].tangential_force);
    if (bodies == 0 || !(contact_force > 0)) return NAN;
    return (resultant / (double)bodies) / (contact_force / (double)table->count);
}
