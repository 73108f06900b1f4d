/// The table of modules, from the rows of module/table.h.
#include "module/module.h"

#define ROW(name) [SCREE_SLOT_##name] = &scree_module_##name,
const scree_module *const scree_modules[SCREE_MODULE_COUNT] = {SCREE_MODULES(ROW)};
