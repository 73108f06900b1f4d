/// The section of `walls`; modules add the keys of each shape.
#ifndef SCREE_CASE_SCHEMA_WALLS_H
#define SCREE_CASE_SCHEMA_WALLS_H

#include "module/key.h"

enum { SCREE_WALL_SECTIONS = 1 };
extern const scree_section scree_wall_sections[SCREE_WALL_SECTIONS];

#endif
