/// Module of law hertz_jkr (hertz_jkr.h; constants and bounds: adhesive_law.c).
#include "contact/hertz_jkr.h"

#include "contact/adhesive_module.h"

ADHESIVE(hertz_jkr, "Hertz with the adhesion of Johnson, Kendall and Roberts: soft grains, necks that hold", true,
         scree_elastic_jkr, .neck = scree_adhesive_neck);
