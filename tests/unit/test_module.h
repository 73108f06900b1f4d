/// A module of a test, with fields of bodies, in the slot of the forced spin. Included once, before the fields; behind
/// the module, TEST_MODULES stands in place of src/modules.c.
#ifndef SCREE_TESTS_TEST_MODULE_H
#define SCREE_TESTS_TEST_MODULE_H

#include "module/module.h"

static const scree_module test_module;
#define scree_module_forced_spin test_module

/// A row of its fields; its struct is `own`.
#define BODY_FIELD(array, element, name, type, components, ...)                                                        \
    SCREE_FIELD_BODY(forced_spin, own, array, element, name, type, components, "1", "of the test", __VA_ARGS__)

#define TEST_ROW(name) [SCREE_SLOT_##name] = &scree_module_##name,
#define TEST_MODULES   const scree_module *const scree_modules[SCREE_MODULE_COUNT] = {SCREE_MODULES(TEST_ROW)};

#endif
