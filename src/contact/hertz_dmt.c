/// Module of law hertz_dmt (hertz_dmt.h; constants and bounds: adhesive_law.c).
#include "contact/hertz_dmt.h"

#include "contact/adhesive_module.h"

ADHESIVE_MODULE(hertz_dmt, false, scree_elastic_dmt,
                "Hertz with the adhesion of Derjaguin, Muller and Toporov: stiff grains that pull with a constant "
                "force while they touch; springs, friction and damping as hertz_mindlin",
                .neck = NULL);
