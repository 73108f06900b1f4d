/// What people read.
#include "cli/terminal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#define BOLD_RED "\033[1;31m"
#define BOLD     "\033[1m"
#define PLAIN    "\033[0m"

bool scree_terminal_is_rich(FILE *stream)
{
    const char *kind = getenv("TERM"), *plain = getenv("NO_COLOR");
    return isatty(fileno(stream)) && kind && strcmp(kind, "dumb") != 0 && !(plain && plain[0]);
}

size_t scree_terminal_width(void)
{
    struct winsize window;
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0 ? window.ws_col : 80;
}

scree_status scree_terminal_error(const char *verb, const scree_error *error)
{
    char text[2048], place[320];
    scree_error where = {.line = error->line, .column = error->column};
    memcpy(where.file, error->file, sizeof where.file);
    (void)scree_error_format(error, text, sizeof text);
    if (error->file[0])
        (void)scree_error_format(&where, place, sizeof place);
    else
        (void)snprintf(place, sizeof place, "scree%s%s: ", verb ? " " : "", verb ? verb : "");
    const char *rest = error->file[0] ? text + strlen(place) : text;
    if (scree_terminal_is_rich(stderr))
        fprintf(stderr, BOLD "%s" BOLD_RED "%s" PLAIN "%s\n", place,
                error->status == SCREE_INTERRUPTED ? "" : "error: ", rest);
    else
        fprintf(stderr, "%s%s\n", place, rest);
    return error->status ? error->status : SCREE_ERROR_IO;
}

void scree_human_quantity(char *text, size_t size, double value, const char *unit)
{
    static const char *const prefixes[] = {"p", "n", "u", "m", "", "k", "M", "G", "T"};
    int power = value == 0 || !isfinite(value) ? 0 : (int)floor(log10(fabs(value)) / 3);
    if (power < -4) power = -4;
    if (power > 4) power = 4;
    (void)snprintf(text, size, "%.4g %s%s", value / pow(1000, power), prefixes[power + 4], unit);
}

void scree_human_duration(char *text, size_t size, double seconds)
{
    static const struct {
        double length;
        const char *large, *small;
        double part;
    } scale[] = {{86400, "d", "h", 3600}, {3600, "h", "min", 60}, {60, "min", "s", 1}};
    if (seconds < 59.5) {
        (void)snprintf(text, size, "%.2g s", seconds);
        return;
    }
    size_t i = 0;
    while (i < 2 && seconds < scale[i].length - scale[i].part / 2) i++;
    double parts = round(seconds / scale[i].part), each = scale[i].length / scale[i].part;
    (void)snprintf(text, size, "%.0f %s %.0f %s", floor(parts / each), scale[i].large, fmod(parts, each),
                   scale[i].small);
}

void scree_human_count(char *text, size_t size, double count)
{
    if (count >= 1e9)
        (void)snprintf(text, size, "%.3g billion", count / 1e9);
    else if (count >= 1e6)
        (void)snprintf(text, size, "%.3g million", count / 1e6);
    else
        (void)snprintf(text, size, "%.0f", count);
}
