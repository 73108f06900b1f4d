/// series.csv: written row by row, cut at a restart, read back for figures.
///
/// A row is one write(2) to a file opened for appending, so a kill leaves whole rows, or at worst a torn last one,
/// which the reader and the restart ignore. A row that the disk takes only in part is cut off again. Numbers have 17
/// significant digits: reading gives the same double. Decimal points are those of the C locale.
#include "io/series.h"

#include "base/memory.h"
#include "io/manifest.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NUMBER_SIZE = 26 }; ///< "-1.2345678901234567e-308" and a comma

/// The header line, with its newline, into an allocated text.
static scree_status header_text(const scree_series_column *columns, size_t count, char **text, scree_error *error)
{
    size_t size = 1;
    for (size_t i = 0; i < count; i++) size += strlen(columns[i].name) + strlen(columns[i].unit) + sizeof " [],";
    scree_status status = scree_allocate(text, size, 1, error);
    if (status) return status;
    char *end = *text;
    for (size_t i = 0; i < count; i++)
        end += sprintf(end, "%s [%s]%c", columns[i].name, columns[i].unit, i + 1 < count ? ',' : '\n');
    return SCREE_OK;
}

/// Reads a whole file into an allocated, NUL-terminated text.
static scree_status read_text(const char *path, char **text, size_t *length, scree_error *error)
{
    *text = NULL;
    int file = open(path, O_RDONLY | O_CLOEXEC);
    struct stat information;
    if (file < 0 || fstat(file, &information) != 0) {
        scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '%s'", path);
        if (file >= 0) close(file);
        return SCREE_ERROR_IO;
    }
    size_t size = information.st_size > 0 ? (size_t)information.st_size : 0, done = 0;
    scree_status status = scree_allocate(text, size + 1, 1, error);
    while (!status && done < size) {
        ssize_t got = read(file, *text + done, size - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '%s'", path);
        if (got <= 0) break;
        done += (size_t)got;
    }
    close(file);
    if (status) scree_release(text);
    *length = done;
    return status;
}

/// Writes the whole text, or takes back what was written of it.
static scree_status write_whole(FILE *stream, const char *text, size_t length, scree_error *error)
{
    int file = fileno(stream);
    off_t before = lseek(file, 0, SEEK_END);
    ssize_t done;
    do done = write(file, text, length);
    while (done < 0 && errno == EINTR);
    if (done == (ssize_t)length) return SCREE_OK;
    if (done >= 0) errno = ENOSPC;
    scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write a row of the time series");
    if (done > 0 && before >= 0 && ftruncate(file, before) != 0)
        scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write a row of the time series, nor take half of it back");
    return SCREE_ERROR_IO;
}

/// Length of the header and the first `rows` rows of the file, after checking that they are there.
static scree_status find_cut(const char *path, const char *header, int64_t rows, off_t *cut, scree_error *error)
{
    char *text;
    size_t length;
    scree_status status = read_text(path, &text, &length, error);
    if (status) return status;
    const char *end = text + strlen(header);
    if (strncmp(text, header, strlen(header)) != 0)
        status =
            scree_error_set(error, SCREE_ERROR_IO, "'%s' has other columns than this version of Scree writes", path);
    for (int64_t row = 0; !status && row < rows; row++) {
        const char *newline = strchr(end, '\n');
        if (newline)
            end = newline + 1;
        else
            status = scree_error_set(error, SCREE_ERROR_IO, "'%s' holds %lld rows, the checkpoint was taken after %lld",
                                     path, (long long)row, (long long)rows);
    }
    *cut = end - text;
    scree_release(&text);
    return status;
}

scree_status scree_series_open(scree_series_writer *writer, const char *path, const scree_series_column *columns,
                               size_t count, int64_t append_rows, scree_error *error)
{
    *writer = (scree_series_writer){.column_count = count};
    char *header;
    off_t cut = 0;
    scree_status status = header_text(columns, count, &header, error);
    if (status) return status;
    if (append_rows >= 0) status = find_cut(path, header, append_rows, &cut, error);
    if (!status && append_rows < 0) status = scree_manifest_add(path, &(const char *){""}, 1, error);
    if (!status) {
        writer->file = fopen(path, append_rows < 0 ? "we" : "ae");
        if (!writer->file)
            status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", path);
        else if (append_rows < 0)
            status = write_whole(writer->file, header, strlen(header), error);
        else if (ftruncate(fileno(writer->file), cut) != 0)
            status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot cut '%s'", path);
    }
    if (status && writer->file) {
        fclose(writer->file);
        writer->file = NULL;
    }
    scree_release(&header);
    return status;
}

scree_status scree_series_append(scree_series_writer *writer, const double *values, scree_error *error)
{
    char *row;
    scree_status status = scree_allocate(&row, writer->column_count + 1, NUMBER_SIZE, error);
    if (status) return status;
    char *end = row;
    for (size_t i = 0; i < writer->column_count; i++) {
        // The sign of a NaN says nothing, and printf would show it.
        end += values[i] != values[i] ? sprintf(end, "nan") : sprintf(end, "%.17g", values[i]);
        *end++ = i + 1 < writer->column_count ? ',' : '\n';
    }
    status = write_whole(writer->file, row, (size_t)(end - row), error);
    scree_release(&row);
    return status;
}

static size_t count_character(const char *text, const char *end, char wanted)
{
    size_t count = 0;
    while (text < end) count += *text++ == wanted;
    return count;
}

scree_status scree_series_sync(scree_series_writer *writer, scree_error *error)
{
    if (!writer->file || fsync(fileno(writer->file)) == 0) return SCREE_OK;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write the time series");
}

scree_status scree_series_holds(const char *path, int64_t rows, scree_error *error)
{
    char *text;
    size_t length;
    scree_status status = read_text(path, &text, &length, error);
    if (status) return status;
    // A power cut may leave zeros where a row was: the text ends there.
    int64_t found = (int64_t)count_character(text, text + strlen(text), '\n') - 1;
    scree_release(&text);
    if (found >= rows) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_IO, "'%s' holds %lld rows, the checkpoint was taken after %lld", path,
                           (long long)(found < 0 ? 0 : found), (long long)rows);
}

scree_status scree_series_close(scree_series_writer *writer, scree_error *error)
{
    if (!writer->file) return SCREE_OK;
    int synced = fsync(fileno(writer->file));
    int number = errno;
    int closed = fclose(writer->file);
    writer->file = NULL;
    if (synced == 0 && closed == 0) return SCREE_OK;
    if (synced != 0) errno = number;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write the time series");
}

static scree_status copy_text(char **out, const char *text, size_t length, scree_error *error)
{
    scree_status status = scree_allocate(out, length + 1, 1, error);
    if (!status) memcpy(*out, text, length);
    return status;
}

/// Splits "name [unit],name [unit],..." (without its newline) into series->name and series->unit.
static scree_status read_header(scree_series *series, const char *text, const char *end, scree_error *error)
{
    size_t count = count_character(text, end, ',') + 1;
    scree_status status = scree_allocate(&series->name, count, sizeof(char *), error);
    if (!status) status = scree_allocate(&series->unit, count, sizeof(char *), error);
    if (!status) status = scree_allocate(&series->value, count, sizeof(double *), error);
    if (status) return status;
    series->column_count = count;
    for (size_t i = 0; i < count && !status; i++) {
        const char *comma = memchr(text, ',', (size_t)(end - text));
        const char *stop = comma ? comma : end;
        const char *open = memchr(text, '[', (size_t)(stop - text));
        if (!open || open == text || stop[-1] != ']')
            return scree_error_set(error, SCREE_ERROR_IO, "its column %zu is not headed by `name [unit]`", i + 1);
        status = copy_text(&series->name[i], text, (size_t)(open - 1 - text), error);
        if (!status) status = copy_text(&series->unit[i], open + 1, (size_t)(stop - 1 - open - 1), error);
        text = stop + 1;
    }
    return status;
}

/// Reads the rows from `text`; each ends with a newline.
static scree_status read_rows(scree_series *series, const char *text, scree_error *error)
{
    for (size_t row = 0; row < series->row_count; row++)
        for (size_t column = 0; column < series->column_count; column++) {
            char *end;
            series->value[column][row] = strtod(text, &end);
            if (end == text || *end != (column + 1 < series->column_count ? ',' : '\n'))
                return scree_error_set(error, SCREE_ERROR_IO, "its line %zu does not hold %zu numbers", row + 2,
                                       series->column_count);
            text = end + 1;
        }
    return SCREE_OK;
}

static scree_status parse_series(scree_series *series, const char *text, size_t length, scree_error *error)
{
    const char *newline = memchr(text, '\n', length);
    if (!newline || strlen(text) != length) return scree_error_set(error, SCREE_ERROR_IO, "it is not a time series");
    scree_status status = read_header(series, text, newline, error);
    series->row_count = count_character(newline + 1, text + length, '\n');
    for (size_t i = 0; i < series->column_count && !status; i++)
        status = scree_allocate(&series->value[i], series->row_count, sizeof(double), error);
    return status ? status : read_rows(series, newline + 1, error);
}

scree_status scree_series_read(scree_series *series, const char *path, scree_error *error)
{
    *series = (scree_series){0};
    char *text;
    size_t length;
    scree_error detail;
    scree_status status = read_text(path, &text, &length, error);
    if (status) return status;
    status = parse_series(series, text, length, &detail);
    if (status) {
        scree_error_set(error, status, "cannot read '%s': %s", path, detail.message);
        scree_series_destroy(series);
    }
    scree_release(&text);
    return status;
}

const double *scree_series_get(const scree_series *series, const char *name)
{
    for (size_t i = 0; i < series->column_count; i++)
        if (strcmp(series->name[i], name) == 0) return series->value[i];
    return NULL;
}

void scree_series_destroy(scree_series *series)
{
    for (size_t i = 0; i < series->column_count; i++) {
        scree_release(&series->name[i]);
        scree_release(&series->unit[i]);
        scree_release(&series->value[i]);
    }
    scree_release(&series->name);
    scree_release(&series->unit);
    scree_release(&series->value);
    *series = (scree_series){0};
}
