/// What the methods share.
#include "prepare/methods.h"

#include <stdarg.h>
#include <stdio.h>

scree_status scree_prepare_error(scree_error *error, const scree_model *model, const scree_config_stage *stage,
                                 const char *key, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    scree_status status = scree_error_set(error, SCREE_ERROR_INPUT, "%s", text);
    if (!error) return status;
    for (int64_t i = 0; i < model->stage_count; i++)
        if (stage == &model->stages[i])
            (void)snprintf(error->field, sizeof error->field, "stages.%lld.%s", (long long)i, key);
    return status;
}
