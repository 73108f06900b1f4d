/// How the rows of tables of keys are written: a macro a type of key, named designators for the rest. For the files
/// that declare keys, and no headers: the macros have short names.
#ifndef SCREE_MODULE_KEY_ROWS_H
#define SCREE_MODULE_KEY_ROWS_H

#include "module/key.h"

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
#define SCHEDULE(owner, member, si, ...) KEY(owner, member, SCREE_KEY_SCHEDULE, .unit = si, __VA_ARGS__)
#define INTEGER(owner, member, ...)      KEY(owner, member, SCREE_KEY_INTEGER, __VA_ARGS__)
#define CHOICE(owner, member, list, ...) KEY(owner, member, SCREE_KEY_CHOICE, .choices = list, __VA_ARGS__)
#define FLAG(owner, member, ...)         KEY(owner, member, SCREE_KEY_FLAG, __VA_ARGS__)
#define TENSOR(owner, member, list, si, ...)                                                                           \
    KEY(owner, member, SCREE_KEY_TENSOR, .choices = list, .unit = si, .standard = "{}", __VA_ARGS__)

#define TABLE(title, text, keys_)                                                                                      \
    {                                                                                                                  \
        .name = title, .meaning = text, .keys = keys_, .count = COUNT(keys_)                                           \
    }
/// A section that modules can add keys to; `owner` is its struct.
#define OPEN_TABLE(title, text, keys_, owner)                                                                          \
    {                                                                                                                  \
        .name = title, .meaning = text, .keys = keys_, .count = COUNT(keys_), .open = true,                            \
        .own_offset = offsetof(owner, own)                                                                             \
    }
#define MODULE_KEYS                                                                                                    \
    {                                                                                                                  \
        .type = SCREE_KEY_MODULES                                                                                      \
    }

/// Keys that a module adds to a section, as a row of its `keys`; `owner` is the module's struct for them.
#define KEYS_OF(path, table, owner, ...)                                                                               \
    {                                                                                                                  \
        .section = path, .keys = table, .count = COUNT(table), .size = sizeof(owner), __VA_ARGS__                      \
    }
/// What a module is a choice of: IS("integrator.scheme"), with .meaning where it is not that of the module.
#define IS(path, ...)                                                                                                  \
    {                                                                                                                  \
        .key = path, __VA_ARGS__                                                                                       \
    }
#define CHOICE_OF(...) ((const scree_choice_of[]){__VA_ARGS__, {0}})

#endif
