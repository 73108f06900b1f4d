/// The list of problems. The last slot is kept for "and n more" and for "out of memory".
#include "case/problems.h"

#include "base/handle.h"
#include "base/memory.h"

#include <stdio.h>
#include <string.h>

enum { MOST_PROBLEMS = 200, FIRST_CAPACITY = 4, SHOWN_BYTES = 60 };

struct scree_problems {
    scree_error *items;
    size_t count, capacity;
    size_t omitted;
};

size_t scree_problems_count(const scree_problems *problems)
{
    if (!problems) return 0;
    scree_handle_check(problems, "a list of problems");
    return problems->count;
}

const scree_error *scree_problems_get(const scree_problems *problems, size_t index)
{
    return index < scree_problems_count(problems) ? &problems->items[index] : NULL;
}

void scree_problems_free(scree_problems *problems)
{
    if (!problems) return;
    scree_handle_freed(problems, "a list of problems");
    scree_release(&problems->items);
    scree_release(&problems);
}

scree_status scree_problems_create(scree_problems **out)
{
    scree_problems *problems;
    *out = NULL;
    scree_status status = scree_allocate(&problems, 1, sizeof *problems, NULL);
    if (status) return status;
    status = scree_allocate(&problems->items, FIRST_CAPACITY, sizeof *problems->items, NULL);
    if (status) {
        scree_release(&problems);
        return status;
    }
    problems->capacity = FIRST_CAPACITY;
    scree_handle_made(problems);
    *out = problems;
    return SCREE_OK;
}

/// Length of the longest prefix of at most `limit` bytes that does not cut a UTF-8 character.
static size_t whole_characters(const char *text, size_t limit)
{
    size_t length = strnlen(text, limit + 1);
    if (length <= limit) return length;
    length = limit;
    while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80) length--;
    return length;
}

scree_shown scree_show(const char *text)
{
    scree_shown shown;
    if (!text) text = "..."; // of a list or a mapping
    size_t length = whole_characters(text, SHOWN_BYTES);
    (void)snprintf(shown.text, sizeof shown.text, "%.*s%s", (int)length, text, text[length] ? "..." : "");
    return shown;
}

static void put(char *field, size_t size, const char *text)
{
    size_t length = text ? whole_characters(text, size - 1) : 0;
    if (length > 0) memcpy(field, text, length);
    field[length] = 0;
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)field[i] < 0x20 || field[i] == 0x7F) field[i] = ' ';
}

static scree_error *next_slot(scree_reader *reader)
{
    scree_problems *list = reader->problems;
    // One slot more than is used stays free for the closing line.
    if (list->count + 1 >= list->capacity) {
        size_t larger = 2 * list->capacity;
        if (scree_reallocate(&list->items, list->capacity, larger, sizeof *list->items, NULL)) {
            scree_reader_fail(reader, larger * sizeof *list->items);
            return NULL;
        }
        list->capacity = larger;
    }
    return &list->items[list->count++];
}

bool scree_problem_omit(scree_reader *reader, scree_place place)
{
    if (reader->only_quick && place.origin != SCREE_ORIGIN_QUICK) return true;
    if (reader->problems->count < MOST_PROBLEMS) return false;
    reader->problems->omitted++;
    return true;
}

void scree_problem_add(scree_reader *reader, scree_place place, const char *field, const char *value,
                       const char *accepted, const char *format, ...)
{
    if (scree_problem_omit(reader, place)) return;
    scree_error *slot = next_slot(reader);
    if (!slot) return;
    char message[1200];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    slot->status = SCREE_ERROR_INPUT;
    slot->line = place.line;
    slot->column = place.column;
    put(slot->file, sizeof slot->file, place.source);
    put(slot->field, sizeof slot->field, field);
    put(slot->value, sizeof slot->value, value);
    put(slot->accepted, sizeof slot->accepted, accepted);
    put(slot->message, sizeof slot->message, message);
}

/// Position in the file, then --set (which has no line).
static bool comes_before(const scree_error *a, const scree_error *b)
{
    if ((a->line == 0) != (b->line == 0)) return a->line != 0;
    if (a->line != b->line) return a->line < b->line;
    return a->column < b->column;
}

void scree_problems_finish(scree_problems *problems)
{
    // Insertion keeps the order of equals; there are at most 200.
    for (size_t i = 1; i < problems->count; i++) {
        scree_error moved = problems->items[i];
        size_t to = i;
        for (; to > 0 && comes_before(&moved, &problems->items[to - 1]); to--)
            problems->items[to] = problems->items[to - 1];
        problems->items[to] = moved;
    }
    if (problems->omitted > 0) {
        scree_error *last = &problems->items[problems->count++];
        scree_error_set(last, SCREE_ERROR_INPUT, "and %zu more problems", problems->omitted);
    }
}

void scree_problems_replace(scree_problems *problems, const scree_error *failure)
{
    problems->items[0] = *failure;
    problems->count = 1;
    problems->omitted = 0;
}

void scree_reader_fail(scree_reader *reader, size_t bytes)
{
    if (!reader->failure.status) scree_error_set_memory(&reader->failure, bytes);
}

void scree_file_beside(const scree_reader *reader, const char *name, char *path, size_t size)
{
    const char *source = reader->root->place.source, *slash = source ? strrchr(source, '/') : NULL;
    size_t folder = name[0] == '/' || !slash ? 0 : (size_t)(slash - source) + 1;
    (void)snprintf(path, size, "%.*s%s", (int)(folder < size ? folder : 0), folder ? source : "", name);
}
