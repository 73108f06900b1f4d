/// What modules say of the begin of a stage that work on parts in it as in a step.
#include "module/module.h"

bool scree_begins_in_parts(const scree_context *context)
{
    (void)context;
    return false;
}
