/// Structs of modules in configs that tests make by hand.
#ifndef SCREE_TEST_OWN_CONFIG_H
#define SCREE_TEST_OWN_CONFIG_H

#include "case/config.h"

/// A block for the structs of modules of one section, or of one element of a list.
typedef struct own_block {
    _Alignas(16) unsigned char bytes[1024];
} own_block;

/// The struct `type` of a module in a block that a section points to: OWN(own, scree_x_config, x, "section").
#define OWN(block, type, module, section) ((type *)(uintptr_t)scree_config_own(&scree_module_##module, section, block))

/// What the stage `index` of a config says, which is of this kind: STAGE(config, 2, compress)->rate.
#define STAGE(config, index, kind) ((scree_##kind##_config *)(config)->stages[index].own)

#endif
