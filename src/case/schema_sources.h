/// The schema table of sources (schema_sources.c).
#ifndef SCREE_CASE_SCHEMA_SOURCES_H
#define SCREE_CASE_SCHEMA_SOURCES_H

#include "case/config.h"
#include "module/key.h"

enum { SCREE_SOURCE_SECTIONS = 1 };
extern const scree_section scree_source_sections[SCREE_SOURCE_SECTIONS];

/// A source before its keys are read: some kinds do not have all.
extern const scree_config_source scree_source_before_reading;

#endif
