/// Lines and cells.
#include "grains/format.h"

#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char *grain_text_raw(grain_text *text)
{
    char *line = text->next;
    if (!line || !*line) return NULL;
    char *end = strchr(line, '\n');
    text->next = end ? end + 1 : NULL;
    if (end) *end = 0;
    text->line++;
    return line;
}

static bool is_between(const grain_text *text, char c)
{
    return text->commas[0] ? c == ',' || c == ';' : c == ' ' || c == '\t' || c == '\r';
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

void grain_text_cut(grain_text *text, char *line)
{
    char *at = line;
    text->cells = 0;
    while (text->cells < GRAIN_CELLS) {
        while (is_space(*at)) at++;
        if (!*at && !(text->commas[0] && text->cells > 0)) return;
        char *end = at;
        while (*end && !is_between(text, *end)) end++;
        const bool more = *end != 0;
        char *last = end;
        while (last > at && is_space(last[-1])) last--;
        text->cell[text->cells] = at;
        text->column[text->cells++] = (int)(at - line) + 1;
        *last = *end = 0;
        if (!more) return;
        at = end + 1;
    }
}

bool grain_text_line(grain_text *text)
{
    for (char *line; (line = grain_text_raw(text));) {
        line[strcspn(line, "#")] = 0;
        grain_text_cut(text, line);
        if (text->cells > 0) return true;
    }
    return false;
}

scree_status grain_text_refuse(const grain_text *text, size_t k, scree_error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    scree_status status = scree_error_set_list(error, SCREE_ERROR_INPUT, format, arguments);
    va_end(arguments);
    if (!error) return status;
    (void)snprintf(error->file, sizeof error->file, "%s", text->path);
    error->line = text->line;
    error->column = k < text->cells ? text->column[k] : 1;
    if (k < text->cells) (void)snprintf(error->value, sizeof error->value, "%.100s", text->cell[k]);
    return status;
}

scree_status grain_text_number(const grain_text *text, size_t k, double *value, scree_error *error)
{
    static locale_t plain;
    if (!plain) plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    char *end;
    *value = strtod_l(text->cell[k], &end, plain);
    if (end == text->cell[k] || *end || !isfinite(*value))
        return grain_text_refuse(text, k, error, "'%.40s' is not a finite number", text->cell[k]);
    return SCREE_OK;
}

// ---- dumps of LAMMPS -----------------------------------------------------------------------------------------------

char *grain_text_item(char *line, const char *name)
{
    const size_t length = strlen(name);
    if (strncmp(line, "ITEM: ", 6) != 0 || strncmp(line + 6, name, length) != 0) return NULL;
    return line + 6 + length;
}

scree_status grain_text_find_frame(grain_text *text, double wanted, scree_error *error)
{
    double first = NAN, last = NAN;
    char *found = NULL;
    int at = 0, number = text->line;
    for (char *line = text->next; line; number++) {
        char *end = strchr(line, '\n');
        if (strncmp(line, "ITEM: TIMESTEP", 14) == 0 && end) {
            last = strtod(end + 1, NULL);
            if (isnan(first)) first = last;
            if (isnan(wanted) || last == wanted) found = line, at = number;
        }
        line = end ? end + 1 : NULL;
    }
    if (isnan(last)) return grain_text_refuse(text, SIZE_MAX, error, "the dump has no frame");
    if (!found)
        return grain_text_refuse(text, SIZE_MAX, error,
                                 "the dump has no frame of time step %.15g; its frames go from %.15g to %.15g", wanted,
                                 first, last);
    text->next = found;
    text->line = at;
    return SCREE_OK;
}
