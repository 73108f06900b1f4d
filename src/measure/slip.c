/// Slip between bodies (P fig. 2.4): walls and membranes are left out, as their slip says how the plates are made.
/// Cost: O(contacts). Each process sums over the contacts that it has, in integers.
#include "measure/measure.h"

#include "base/integer_sum.h"
#include "comm/comm.h"

#include <math.h>

void scree_slip_measure(const scree_state *state, const scree_contact_table *table, double *mean_slip,
                        double *sliding_fraction)
{
    scree_integer_sum slip = {0};
    int64_t number[2]; // contacts, those that slide
    while (scree_comm_sum_next(state, &slip, 1)) {
        number[0] = number[1] = 0;
        for (size_t c = 0; c < table->count; c++) {
            const scree_contact *contact = &table->contact[c];
            if (scree_contact_is_outer(contact)) continue;
            scree_integer_sum_add(&slip, fabs(contact->slip));
            number[0]++;
            number[1] += contact->sliding;
        }
    }
    scree_comm_add(state, number, 2);
    *mean_slip = number[0] > 0 ? scree_integer_sum_total(&slip) / (double)number[0] : 0;
    *sliding_fraction = number[0] > 0 ? (double)number[1] / (double)number[0] : 0;
}
