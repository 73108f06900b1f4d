/// Progress of a run on standard error: one line that is rewritten on a terminal, plain lines now and then elsewhere.
#ifndef SCREE_CLI_PROGRESS_H
#define SCREE_CLI_PROGRESS_H

#include <scree/scree.h>

typedef struct scree_progress_display {
    bool quiet;     ///< warnings only
    bool rewrite;   ///< a terminal that can rewrite a line
    bool line_open; ///< the cursor stands behind a progress line
    double last;    ///< s, when the last plain line was printed
} scree_progress_display;

void scree_progress_begin(scree_progress_display *display, bool quiet);
/// Shows one line, which the next one replaces on a terminal; elsewhere at most one every ten seconds is printed.
void scree_progress_line(scree_progress_display *display, const char *text);
/// The two callbacks of scree_run_options; `user` is the display.
void scree_progress_show(void *user, const scree_progress *progress);
void scree_progress_message(void *user, int level, const char *line);
/// Clears the line, so that other text can be printed.
void scree_progress_end(scree_progress_display *display);

#endif
