/// Which laws of contact polygons may have.
#ifndef SCREE_SHAPE_POLYGON_RULES_H
#define SCREE_SHAPE_POLYGON_RULES_H

#include "case/check.h"

/// Rules of module polygon: rounded corners go with laws of springs, sharp ones with laws of areas, and neither with
/// laws that stick.
void scree_polygon_rules(scree_reader *reader, const scree_config *config);

#endif
