/// What the formats share: a text that is read line by line, and columns that are filled. Private to src/grains/.
#ifndef SCREE_GRAINS_FORMAT_H
#define SCREE_GRAINS_FORMAT_H

#include "grains/grains.h"

enum { GRAIN_CELLS = 64 };

/// A text and the line of it that was read last.
typedef struct grain_text {
    const char *path;
    char *next;         ///< the line behind it; NULL: there is none
    const char *commas; ///< what stands between cells: ",;" in tables, "": white space
    char *cell[GRAIN_CELLS];
    int column[GRAIN_CELLS]; ///< 1-based place of each in its line
    size_t cells;
    int line;
} grain_text;

/// The next line that is not empty, cut into cells; what follows a '#' is left out. False: there is none.
bool grain_text_line(grain_text *text);
/// The next line as it stands; NULL: there is none.
char *grain_text_raw(grain_text *text);
/// Cuts a line into the cells of `text`. More than GRAIN_CELLS are left out.
void grain_text_cut(grain_text *text, char *line);

/// An error at cell `k` of the line; SIZE_MAX: at the line.
scree_status grain_text_refuse(const grain_text *text, size_t k, scree_error *error, const char *format, ...)
    SCREE_PRINTF(4, 5);
/// Cell `k` as a finite number. Errors: it is none.
scree_status grain_text_number(const grain_text *text, size_t k, double *value, scree_error *error) SCREE_MUST_USE;

/// Of the dumps of LAMMPS: whether a line is an item of this name, then what stands behind the name.
char *grain_text_item(char *line, const char *name);
/// Goes to the frame of this time step; NAN: to the last one. Errors: there is none.
scree_status grain_text_find_frame(grain_text *text, double wanted, scree_error *error) SCREE_MUST_USE;

/// What a column of a file holds.
typedef struct grain_meaning {
    const char *name;
    int to;        ///< scree_grain_column, or one of the below
    double factor; ///< over what it is stored in
} grain_meaning;
enum { GRAIN_KIND = SCREE_GRAIN_COLUMNS, GRAIN_ID, GRAIN_IGNORED };

/// The rows of a file: where each of its cells goes.
typedef struct grain_rows {
    scree_grains *grains;
    int64_t *id; ///< NULL: rows have none
    size_t capacity, cells;
    int to[GRAIN_CELLS];
    double factor[GRAIN_CELLS]; ///< SI over what is written
    double shift[GRAIN_CELLS];  ///< SI, added
} grain_rows;

/// A column that means nothing here: it is left out, and named in what is told of the file.
void grain_rows_leave_out(grain_rows *rows, size_t k, const char *name);
/// Makes room for what the cells hold, `expected` rows to begin with. Errors: memory.
scree_status grain_rows_begin(grain_rows *rows, size_t expected, scree_error *error) SCREE_MUST_USE;
/// Takes the line of `text`. Errors: cells missing, no numbers, too many kinds; memory.
scree_status grain_rows_add(grain_rows *rows, const grain_text *text, scree_error *error) SCREE_MUST_USE;
/// Puts them in the order of their ids. Errors: an id twice; memory.
scree_status grain_rows_finish(grain_rows *rows, const grain_text *text, scree_error *error) SCREE_MUST_USE;
void grain_rows_release(grain_rows *rows);

/// Unit of a column in SI, of what a file without units says.
double grain_unit(int column, const scree_grains_options *options);

typedef struct grain_format {
    const char *name;
    /// Whether a text begins as one of this format.
    bool (*is)(const char *bytes);
    scree_status (*read)(grain_text *text, const scree_grains_options *options, scree_grains *grains,
                         scree_error *error);
} grain_format;

/// Snapshots of runs of Scree, which are no texts.
bool grain_run_is(const char *path);
scree_status grain_run_read(const char *path, const scree_grains_options *options, scree_grains *grains,
                            scree_error *error);

extern const grain_format grain_format_csv, grain_format_lammps_dump, grain_format_lammps_data, grain_format_yade;

#endif
