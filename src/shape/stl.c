/// A file is binary when its length is the one that its header announces, 84 + 50 triangles bytes; else it must be text
/// that begins with "solid" (binary files may begin so too). Text is words between white space: line breaks and the
/// case of letters do not count.
#include "shape/stl.h"

#include "base/memory.h"

#include <ctype.h>
#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { HEADER = 80, COUNTED = 84, RECORD = 50, CORNERS = 12 };

// ---- binary ------------------------------------------------------------------------------------------------------

static uint32_t read_word(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double read_single(const char *bytes)
{
    uint32_t word = read_word(bytes);
    float value;
    memcpy(&value, &word, sizeof value);
    return (double)value;
}

static scree_status parse_binary(const char *bytes, double (**corner)[3], size_t *count, scree_error *error)
{
    *count = read_word(bytes + HEADER);
    scree_status status = scree_allocate(corner, 3 * *count, sizeof **corner, error);
    for (size_t t = 0; t < *count && !status; t++)
        for (size_t k = 0; k < 9 && !status; k++) {
            size_t at = COUNTED + RECORD * t + CORNERS + 4 * k;
            double x = read_single(bytes + at);
            if (!isfinite(x))
                status = scree_error_set(error, SCREE_ERROR_INPUT,
                                         "byte %zu: coordinate of triangle %zu of %zu is not a finite number", at,
                                         t + 1, *count);
            (*corner)[3 * t + k / 3][k % 3] = x;
        }
    return status;
}

// ---- text --------------------------------------------------------------------------------------------------------

typedef struct scanner {
    const char *at, *end;
    size_t line;
    char word[64];
    scree_error *error;
} scanner;

/// The next word, cut to the buffer; empty at the end.
static void next_word(scanner *s)
{
    size_t length = 0;
    while (s->at < s->end && (isspace((unsigned char)*s->at) || *s->at == 0)) s->line += *s->at++ == '\n';
    for (; s->at < s->end && !isspace((unsigned char)*s->at) && *s->at; s->at++)
        if (length + 1 < sizeof s->word) s->word[length++] = isprint((unsigned char)*s->at) ? *s->at : '?';
    s->word[length] = 0;
}

static scree_status unexpected(scanner *s, const char *expected)
{
    if (!s->word[0])
        return scree_error_set(s->error, SCREE_ERROR_INPUT, "line %zu: the file ends; expected %s", s->line, expected);
    return scree_error_set(s->error, SCREE_ERROR_INPUT, "line %zu: '%s'; expected %s", s->line, s->word, expected);
}

static bool is_word(const scanner *s, const char *word)
{
    return strcasecmp(s->word, word) == 0;
}

static scree_status expect(scanner *s, const char *word)
{
    char expected[32];
    next_word(s);
    if (is_word(s, word)) return SCREE_OK;
    (void)snprintf(expected, sizeof expected, "'%s'", word);
    return unexpected(s, expected);
}

/// `limited`: must be finite.
static scree_status read_number(scanner *s, bool limited, double *number)
{
    char *end;
    next_word(s);
    *number = (double)strtof(s->word, &end);
    if (end == s->word || *end) return unexpected(s, "a number");
    return limited && !isfinite(*number) ? unexpected(s, "a finite number") : SCREE_OK;
}

/// What follows "facet".
static scree_status read_facet(scanner *s, double (*corner)[3])
{
    double unused;
    scree_status status = expect(s, "normal");
    for (int k = 0; k < 3 && !status; k++) status = read_number(s, false, &unused);
    if (!status) status = expect(s, "outer");
    if (!status) status = expect(s, "loop");
    for (int c = 0; c < 3 && !status; c++) {
        status = expect(s, "vertex");
        for (int k = 0; k < 3 && !status; k++) status = read_number(s, true, &corner[c][k]);
    }
    if (!status) status = expect(s, "endloop");
    return status ? status : expect(s, "endfacet");
}

/// Facets up to "endsolid"; further solids may follow.
static scree_status read_solids(scanner *s, double (**corner)[3], size_t *count, size_t room)
{
    scree_status status = SCREE_OK;
    while (!status) {
        next_word(s);
        if (is_word(s, "facet") && *count < room) {
            status = read_facet(s, &(*corner)[3 * *count]);
            *count += !status;
        } else if (is_word(s, "endsolid")) {
            while (s->at < s->end && *s->at != '\n') s->at++;
            next_word(s);
            if (!s->word[0]) return SCREE_OK;
            if (!is_word(s, "solid")) return unexpected(s, "'solid' or the end of the file");
            while (s->at < s->end && *s->at != '\n') s->at++;
        } else {
            status = unexpected(s, "'facet' or 'endsolid'");
        }
    }
    return status;
}

static scree_status parse_text(const char *bytes, size_t length, double (**corner)[3], size_t *count,
                               scree_error *error)
{
    scanner s = {.at = bytes, .end = bytes + length, .line = 1, .error = error};
    // A facet in its shortest form has more bytes than this.
    const size_t room = length / 60 + 1;
    next_word(&s);
    while (s.at < s.end && *s.at != '\n') s.at++;
    scree_status status = scree_allocate(corner, 3 * room, sizeof **corner, error);
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0), before = uselocale(c_locale);
    if (!status) status = read_solids(&s, corner, count, room);
    uselocale(before);
    freelocale(c_locale);
    return status;
}

// ---- both --------------------------------------------------------------------------------------------------------

static bool begins_with_solid(const char *bytes, size_t length)
{
    size_t k = 0;
    while (k < length && isspace((unsigned char)bytes[k])) k++;
    return length - k >= 5 && strncasecmp(bytes + k, "solid", 5) == 0;
}

scree_status scree_stl_parse(const char *bytes, size_t length, double (**corner)[3], size_t *count, scree_error *error)
{
    *corner = NULL;
    *count = 0;
    size_t announced = length >= COUNTED ? read_word(bytes + HEADER) : 0;
    scree_status status;
    if (length >= COUNTED && length == COUNTED + (size_t)RECORD * announced)
        status = parse_binary(bytes, corner, count, error);
    else if (begins_with_solid(bytes, length))
        status = parse_text(bytes, length, corner, count, error);
    else if (length < COUNTED)
        status = scree_error_set(error, SCREE_ERROR_INPUT,
                                 "byte %zu: the file ends; expected 'solid', or %d bytes of header and count", length,
                                 COUNTED);
    else
        status =
            scree_error_set(error, SCREE_ERROR_INPUT,
                            "byte %zu: the file ends; expected %zu bytes for the %zu triangles that bytes %d to %d "
                            "announce",
                            length, COUNTED + RECORD * announced, announced, HEADER, COUNTED - 1);
    if (!status && *count == 0) status = scree_error_set(error, SCREE_ERROR_INPUT, "the file holds no triangle");
    if (!status) return SCREE_OK;
    scree_release(corner);
    *count = 0;
    return status;
}
