/// Sections of `walls`, one a shape.
#ifndef SCREE_CASE_SCHEMA_WALLS_H
#define SCREE_CASE_SCHEMA_WALLS_H

#include "case/schema.h"

enum { SCREE_WALL_SECTIONS = 5 };
extern const scree_section scree_wall_sections[SCREE_WALL_SECTIONS];

#endif
