/// The run's log.
#include "base/log.h"

#include <time.h>

void scree_log_write(scree_log *log, scree_log_level level, const char *format, ...)
{
    static const char *const names[] = {"info", "warning", "error"};
    if (!log) return;
    char text[2048];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (log->file) {
        char stamp[32];
        struct tm now;
        time_t seconds = time(NULL);
        strftime(stamp, sizeof stamp, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&seconds, &now));
        fprintf(log->file, "%s %-7s %s\n", stamp, names[level], text);
        fflush(log->file);
    }
    if (log->sink) log->sink(log->user, level, text);
}
