/// Module of law hertz_jkr (hertz_jkr.h; constants and bounds: adhesive_law.c).
#include "contact/hertz_jkr.h"

#include "contact/adhesive_module.h"

ADHESIVE_MODULE(hertz_jkr, true, scree_elastic_jkr,
                "Hertz with the adhesion of Johnson, Kendall and Roberts: soft grains that stick, and hold by a neck "
                "until it breaks; springs, friction and damping as hertz_mindlin",
                .neck = scree_adhesive_neck);
