/// How the rows of schema tables are written: a macro a type of key, named designators for the rest.
#ifndef SCREE_CASE_SCHEMA_KEYS_H
#define SCREE_CASE_SCHEMA_KEYS_H

#include "case/schema.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))
#define FROM(limit)  .least = {limit, false}
#define ABOVE(limit) .least = {limit, true}
#define TO(limit)    .most = {limit, false}
#define BELOW(limit) .most = {limit, true}

/// A key called like the member that it fills.
#define KEY(owner, member, kind, ...)                                                                                  \
    {                                                                                                                  \
        .name = #member, .type = kind, .offset = offsetof(owner, member), __VA_ARGS__                                  \
    }
#define NUMBER(owner, member, si, ...)   KEY(owner, member, SCREE_KEY_NUMBER, .unit = si, __VA_ARGS__)
#define INTEGER(owner, member, ...)      KEY(owner, member, SCREE_KEY_INTEGER, __VA_ARGS__)
#define CHOICE(owner, member, list, ...) KEY(owner, member, SCREE_KEY_CHOICE, .choices = list, __VA_ARGS__)
#define FLAG(owner, member, ...)         KEY(owner, member, SCREE_KEY_FLAG, __VA_ARGS__)
#define SECTION(member, table, ...)                                                                                    \
    KEY(scree_config, member, SCREE_KEY_SECTION, .sections = table, .section_count = 1, __VA_ARGS__)

#define TABLE(title, text, keys)                                                                                       \
    {                                                                                                                  \
        title, text, keys, COUNT(keys)                                                                                 \
    }

/// Sections of `walls`, one a shape (schema_walls.c).
enum { SCREE_WALL_SECTIONS = 5 };
extern const scree_section scree_wall_sections[SCREE_WALL_SECTIONS];

#endif
