/// Is this text at all? Checked byte by byte before the YAML parser sees it, so that everything after is bounded: the
/// parser's time grows with the square of a line's length where it is malformed.
#include "case/yaml.h"

#include <string.h>

enum { LARGEST_FILE = 1 << 20, LONGEST_LINE = 4096 };

/// Bytes of the UTF-8 character at `text`, 0 if it is invalid (RFC 3629: no overlong forms, surrogates, or beyond
/// U+10FFFF).
static size_t character_length(const unsigned char *text, size_t left)
{
    if (text[0] < 0x80) return 1;
    size_t length = text[0] >= 0xF0 ? 4 : text[0] >= 0xE0 ? 3 : 2;
    if (text[0] < 0xC2 || text[0] > 0xF4 || length > left) return 0;
    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xC0) != 0x80) return 0;
    bool overlong = (text[0] == 0xE0 && text[1] < 0xA0) || (text[0] == 0xF0 && text[1] < 0x90);
    bool surrogate = text[0] == 0xED && text[1] >= 0xA0;
    bool beyond = text[0] == 0xF4 && text[1] >= 0x90;
    return overlong || surrogate || beyond ? 0 : length;
}

/// C0 controls but tab and line ends, DEL, and C1 controls (U+0080 to U+009F but NEL).
static bool is_control(const unsigned char *text)
{
    if (text[0] < 0x20) return text[0] != '\t' && text[0] != '\n' && text[0] != '\r';
    return text[0] == 0x7F || (text[0] == 0xC2 && text[1] < 0xA0 && text[1] != 0x85);
}

bool scree_text_check(scree_reader *reader, const char *text, size_t length, scree_place place)
{
    scree_place here = place;
    if (length > LARGEST_FILE) {
        here.line = 0;
        scree_problem_add(reader, here, NULL, NULL, "at most 1 MiB", "too large for a case file: %zu bytes", length);
        return false;
    }
    const unsigned char *bytes = (const unsigned char *)text;
    size_t line_start = 0;
    for (size_t at = 0, step; at < length; at += step, here.column++) {
        step = character_length(bytes + at, length - at);
        const char *wrong = NULL;
        if (bytes[at] == 0)
            wrong = "this is a binary file, not a case: it has a NUL byte here";
        else if (step == 0)
            wrong = "this is not UTF-8 text: an invalid byte is here";
        else if (is_control(bytes + at))
            wrong = "this is not plain text: a control character is here";
        else if (at - line_start > LONGEST_LINE)
            wrong = "this line has more than 4096 bytes: not a case file; a long list may go over several lines, or "
                    "into a .csv file";
        if (wrong) {
            if (place.line == 0) here.line = here.column = 0;
            scree_problem_add(reader, here, NULL, NULL, "YAML text", "%s", wrong);
            return false;
        }
        if (bytes[at] == '\n') {
            here.line++;
            here.column = 0;
            line_start = at + 1;
        }
    }
    return true;
}
