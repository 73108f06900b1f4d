/// Progress of a run.
#include "cli/progress.h"

#include "cli/terminal.h"

#include <math.h>
#include <string.h>
#include <time.h>

static const double plain_interval = 10; ///< s between two plain lines

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

void scree_progress_begin(scree_progress_display *display, bool quiet)
{
    *display = (scree_progress_display){.quiet = quiet, .rewrite = scree_terminal_is_rich(stderr), .last = now()};
}

/// "compress  strain 3.42 %  23 % done  18.3 million particle-steps/s  1 min 20 s left"
static void describe(const scree_progress *progress, char *text, size_t size)
{
    char part[64];
    size_t used = (size_t)snprintf(text, size, "%.40s", progress->stage);
    if (isnan(progress->strain))
        scree_human_quantity(part, sizeof part, progress->time, "s");
    else
        (void)snprintf(part, sizeof part, "strain %.2f %%", 100 * progress->strain);
    used += (size_t)snprintf(text + used, size - used, "  %s", part);
    if (!isnan(progress->fraction))
        used += (size_t)snprintf(text + used, size - used, "  %.0f %% done", 100 * progress->fraction);
    scree_human_count(part, sizeof part, progress->particle_steps_per_second);
    used += (size_t)snprintf(text + used, size - used, "  %s particle-steps/s", part);
    scree_human_duration(part, sizeof part, progress->seconds_left);
    if (!isnan(progress->seconds_left)) (void)snprintf(text + used, size - used, "  %s left", part);
}

void scree_progress_line(scree_progress_display *display, const char *text)
{
    if (display->quiet || (!display->rewrite && now() - display->last < plain_interval)) return;
    if (display->rewrite) {
        // A line that wraps could not be rewritten.
        fprintf(stderr, "\r\033[K%.*s", (int)scree_terminal_width() - 1, text);
        fflush(stderr);
        display->line_open = true;
    } else {
        fprintf(stderr, "%s\n", text);
        display->last = now();
    }
}

void scree_progress_show(void *user, const scree_progress *progress)
{
    char text[512];
    describe(progress, text, sizeof text);
    scree_progress_line(user, text);
}

void scree_progress_message(void *user, int level, const char *line)
{
    static const char *const heads[] = {"", "warning: "};
    scree_progress_display *display = user;
    // What ends the run comes back as its error and is printed then.
    if (level > 1 || (level == 0 && display->quiet)) return;
    scree_progress_end(display);
    fprintf(stderr, "%s%s\n", heads[level], line);
}

void scree_progress_end(scree_progress_display *display)
{
    if (display->line_open) fprintf(stderr, "\r\033[K");
    display->line_open = false;
}
