/// Figures of averages (placeholder while building).
#include "library/measure.h"
scree_status measure_draw(const char *folder, const measure_plan *plan, const measure_found *found, scree_error *error)
{
    (void)folder, (void)plan, (void)found, (void)error;
    return SCREE_OK;
}
