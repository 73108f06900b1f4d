/// The run's log: plain lines with a time stamp and a level, to a file and (through a sink) to the terminal.
#ifndef SCREE_BASE_LOG_H
#define SCREE_BASE_LOG_H

#include "base/error.h"

#include <stdio.h>

typedef enum scree_log_level { SCREE_LOG_INFO, SCREE_LOG_WARNING, SCREE_LOG_ERROR } scree_log_level;

typedef struct scree_log {
    FILE *file;                                                        ///< may be NULL
    void (*sink)(void *user, scree_log_level level, const char *line); ///< may be NULL; the library itself never prints
    void *user;
} scree_log;

/// One line, flushed. `log` may be NULL.
void scree_log_write(scree_log *log, scree_log_level level, const char *format, ...) SCREE_PRINTF(3, 4);

#endif
