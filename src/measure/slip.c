/// Slip between bodies (P fig. 2.4): walls and membranes are left out, as their slip says how the plates are made.
/// Cost: O(contacts).
#include "measure/measure.h"

#include <math.h>

void scree_slip_measure(const scree_contact_table *table, double *mean_slip, double *sliding_fraction)
{
    double slip = 0;
    size_t contacts = 0, sliding = 0;
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        if (scree_contact_is_outer(contact)) continue;
        contacts++;
        slip += fabs(contact->slip);
        sliding += contact->sliding;
    }
    *mean_slip = contacts > 0 ? slip / (double)contacts : 0;
    *sliding_fraction = contacts > 0 ? (double)sliding / (double)contacts : 0;
}
