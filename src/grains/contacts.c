/// Contacts of a file. A local dump (docs.lammps.org: dump local) has frames as a dump of grains has them, and columns
/// that are called as the compute was ("c_pair[1]"), with the parts of a force along and across the normal apart: those
/// of one name are added. A table names its columns in its first row.
#include "grains/contacts.h"

#include "base/file_bytes.h"
#include "base/memory.h"
#include "grains/format.h"

#include <scree/scree.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef enum contact_column { FIRST, SECOND, FX, FY, FZ, PX, PY, PZ, COLUMNS, LEFT_OUT } contact_column;
static const char *const names[COLUMNS] = {"first", "second", "fx", "fy", "fz", "x", "y", "z"};
#define KNOWN "first, second, fx, fy, fz, x, y, z"

/// Where each cell of a row goes.
typedef struct plan {
    int to[GRAIN_CELLS];
    size_t cells;
    bool has[COLUMNS];
    const scree_grain_contacts_options *options;
} plan;

void scree_grain_contacts_destroy(scree_grain_contacts *contacts)
{
    scree_release(&contacts->first);
    scree_release(&contacts->second);
    scree_release(&contacts->force);
    scree_release(&contacts->point);
    *contacts = (scree_grain_contacts){0};
}

// ---- columns -------------------------------------------------------------------------------------------------------

/// strict: a name that is not known is an error.
static scree_status name_column(const grain_text *text, size_t k, bool strict, plan *p, scree_error *error)
{
    const char *name = text->cell[k];
    p->to[k] = LEFT_OUT;
    if (strcmp(name, "-") == 0) return SCREE_OK;
    for (int c = 0; c < COLUMNS; c++) {
        if (strcmp(name, names[c]) != 0) continue;
        if (p->has[c] && !(c >= FX && c <= FZ))
            return grain_text_refuse(text, k, error, "the column %s is there twice", name);
        p->has[c] = true;
        p->to[k] = c;
    }
    if (p->to[k] != LEFT_OUT || !strict) return SCREE_OK;
    const char *nearest = scree_nearest(name, names, COLUMNS);
    return grain_text_refuse(text, k, error, "contacts have no column '%.40s'%s%s%s; known are " KNOWN, name,
                             nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'" : "");
}

static scree_status name_columns(const grain_text *text, bool strict, plan *p, scree_error *error)
{
    scree_status status = SCREE_OK;
    p->cells = text->cells;
    for (size_t k = 0; k < text->cells && !status; k++) status = name_column(text, k, strict, p, error);
    for (int c = 0; c <= FY && !status; c++)
        if (!p->has[c])
            status = grain_text_refuse(text, SIZE_MAX, error,
                                       "no column is called %s: name them, --contact-columns first,second,fx,fy,fz "
                                       "(- where one is left out; known are " KNOWN ")",
                                       names[c]);
    if (!status && p->has[PX] != p->has[PY])
        status = grain_text_refuse(text, SIZE_MAX, error, "points of contact need both x and y");
    return status;
}

/// The columns as the caller names them.
static scree_status name_given(plan *p, scree_error *error)
{
    char given[512];
    if (strlen(p->options->columns) >= sizeof given)
        return scree_error_set(error, SCREE_ERROR_INPUT, "these are too many columns");
    grain_text text = {.path = "", .commas = ","};
    memcpy(given, p->options->columns, strlen(p->options->columns) + 1);
    grain_text_cut(&text, given);
    scree_status status = name_columns(&text, true, p, error);
    if (status && error) {
        error->file[0] = 0;
        (void)snprintf(error->field, sizeof error->field, "--contact-columns");
    }
    return status;
}

// ---- rows ----------------------------------------------------------------------------------------------------------

static scree_status grow(scree_grain_contacts *c, const plan *p, size_t capacity, scree_error *error)
{
    scree_status status = scree_reallocate(&c->first, c->count, capacity, sizeof *c->first, error);
    if (!status) status = scree_reallocate(&c->second, c->count, capacity, sizeof *c->second, error);
    if (!status) status = scree_reallocate(&c->force, c->count, capacity, sizeof *c->force, error);
    if (!status && p->has[PX]) status = scree_reallocate(&c->point, c->count, capacity, sizeof *c->point, error);
    return status;
}

/// Takes the line of `text`; there is room.
static scree_status take_row(const grain_text *text, const plan *p, scree_grain_contacts *c, scree_error *error)
{
    if (text->cells < p->cells)
        return grain_text_refuse(text, SIZE_MAX, error, "this row has %zu values; %zu columns are named", text->cells,
                                 p->cells);
    const size_t i = c->count;
    memset(c->force[i], 0, sizeof c->force[i]);
    if (c->point) c->point[i][2] = 0;
    for (size_t k = 0; k < p->cells; k++) {
        const int to = p->to[k];
        double value;
        if (to == LEFT_OUT) continue;
        scree_status status = grain_text_number(text, k, &value, error);
        if (status) return status;
        if (to == FIRST || to == SECOND)
            (to == FIRST ? c->first : c->second)[i] = (int64_t)value;
        else if (to <= FZ)
            c->force[i][to - FX] += value * p->options->force;
        else
            c->point[i][to - PX] = value * p->options->length;
    }
    c->count++;
    return SCREE_OK;
}

/// Rows up to the end of the file, or `most`.
static scree_status take_rows(grain_text *text, const plan *p, size_t most, scree_grain_contacts *c, scree_error *error)
{
    enum { BEGIN = 1024 };
    size_t capacity = 0;
    scree_status status = SCREE_OK;
    while (!status && c->count < most && grain_text_line(text)) {
        if (c->count == capacity) status = grow(c, p, capacity = capacity ? 2 * capacity : BEGIN, error);
        if (!status) status = take_row(text, p, c, error);
    }
    if (!status && most != SIZE_MAX && c->count < most)
        status = grain_text_refuse(text, SIZE_MAX, error, "the file ends after %zu of %zu contacts", c->count, most);
    return status;
}

// ---- files ---------------------------------------------------------------------------------------------------------

static scree_status read_table(grain_text *text, plan *p, scree_grain_contacts *c, scree_error *error)
{
    text->commas = ",;";
    if (!grain_text_line(text)) return grain_text_refuse(text, SIZE_MAX, error, "the file has no contacts");
    char *end;
    (void)strtod(text->cell[0], &end);
    if (end != text->cell[0])
        return grain_text_refuse(text, 0, error, "the first row of a table names its columns: " KNOWN);
    scree_status status = p->options->columns ? name_given(p, error) : name_columns(text, true, p, error);
    return status ? status : take_rows(text, p, SIZE_MAX, c, error);
}

static scree_status read_local_dump(grain_text *text, plan *p, scree_grain_contacts *c, scree_error *error)
{
    double count = 0;
    scree_status status = grain_text_find_frame(text, p->options->frame, error);
    for (char *line, *columns; !status && (line = grain_text_raw(text));) {
        if (grain_text_item(line, "NUMBER OF ENTRIES")) {
            status = grain_text_line(text) ? grain_text_number(text, 0, &count, error)
                                           : grain_text_refuse(text, SIZE_MAX, error, "the file ends here");
        } else if ((columns = grain_text_item(line, "ENTRIES"))) {
            grain_text_cut(text, columns);
            status = p->options->columns ? name_given(p, error) : name_columns(text, false, p, error);
            return status ? status : take_rows(text, p, (size_t)fmax(0, count), c, error);
        }
    }
    return status ? status : grain_text_refuse(text, SIZE_MAX, error, "the frame has no ITEM: ENTRIES");
}

scree_status scree_grain_contacts_read(const char *path, const scree_grain_contacts_options *options,
                                       scree_grain_contacts *contacts, scree_error *error)
{
    char *bytes = NULL;
    size_t length;
    plan p = {.options = options};
    *contacts = (scree_grain_contacts){0};
    scree_status status = scree_file_load(path, &bytes, &length, error);
    grain_text text = {.path = path, .next = bytes, .commas = ""};
    if (!status && memchr(bytes, 0, length))
        status = grain_text_refuse(&text, SIZE_MAX, error, "this is not a text file: it has a NUL character");
    if (!status) status = (strncmp(bytes, "ITEM: ", 6) == 0 ? read_local_dump : read_table)(&text, &p, contacts, error);
    if (!status && contacts->count == 0) status = grain_text_refuse(&text, SIZE_MAX, error, "the file has no contacts");
    scree_release(&bytes);
    if (status) scree_grain_contacts_destroy(contacts);
    return status;
}
