/// Outlets: regions whose particles are counted, or taken out.
#ifndef SCREE_LOAD_OUTLET_H
#define SCREE_LOAD_OUTLET_H

#include "load/load.h"

/// What the case says of one.
typedef struct scree_outlet {
    char *name;                ///< NULL: none (scree_outlet_name)
    double lower[3], upper[3]; ///< m, corners of the region
    bool removes;
    int64_t every;       ///< steps between two looks
    double orifice;      ///< m, through which particles come; NAN: not said
    double bulk_density; ///< kg/m3, of what flows; NAN: not said
} scree_outlet;

/// The outlet with this number, from 0; NULL: there is none.
const scree_outlet *scree_outlet_of(const scree_config_load *loads, int64_t count, size_t index);

/// What it is called: as the case says, else "outlet", with its number from 1 where it is not the first.
void scree_outlet_name(const scree_outlet *outlet, size_t index, char name[SCREE_RESULT_NAME]);

/// Number and mass [kg] of what has come into its region: what is there now, and what was taken out. Cost: a pass over
/// the bodies.
void scree_outlet_sample(const scree_model *model, const scree_state *state, size_t index, double value[2]);

#endif
