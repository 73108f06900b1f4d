/// Module of law hertz_dmt (hertz_dmt.h; constants and bounds: adhesive_law.c).
#include "contact/hertz_dmt.h"

#include "contact/adhesive_module.h"

ADHESIVE(hertz_dmt, "Hertz with the adhesion of Derjaguin, Muller and Toporov: stiff grains, a constant pull", false,
         scree_elastic_dmt, .neck = NULL);
