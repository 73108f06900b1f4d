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
    const scree_status status = scree_error_set(error, SCREE_ERROR_INPUT, "%s", text);
    int64_t number = 0;
    while (number < model->stage_count && stage != &model->stages[number]) number++;
    return number < model->stage_count ? scree_error_key(error, status, "stages.%lld.%s", (long long)number, key)
                                       : status;
}
