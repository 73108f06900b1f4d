/// placeholder
#include "module/module.h"
const scree_module scree_module_stress_path = {.name = "stress_path", .meaning = "p, q"};
