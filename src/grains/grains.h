/// Grains in files: tables, dumps and data files of LAMMPS, exports of YADE. One file a format (src/grains/), one row
/// of its table (read.c) each.
#ifndef SCREE_GRAINS_GRAINS_H
#define SCREE_GRAINS_GRAINS_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum scree_grain_column {
    SCREE_GRAIN_X,
    SCREE_GRAIN_Y,
    SCREE_GRAIN_Z,
    SCREE_GRAIN_RADIUS,
    SCREE_GRAIN_VX,
    SCREE_GRAIN_VY,
    SCREE_GRAIN_VZ,
    SCREE_GRAIN_WX,
    SCREE_GRAIN_WY,
    SCREE_GRAIN_WZ,
    SCREE_GRAIN_ANGLE,
    SCREE_GRAIN_COLUMNS
} scree_grain_column;

enum { SCREE_GRAIN_KINDS = 16 };

/// What a file says of its grains, in the order of their ids where it has some, else of its rows. SI units.
typedef struct scree_grains {
    size_t count;
    double *column[SCREE_GRAIN_COLUMNS]; ///< m, m/s, rad/s, rad; NULL: the file does not say
    uint8_t *kind;                       ///< place in kind_name; NULL: the file does not say
    char kind_name[SCREE_GRAIN_KINDS][64];
    size_t kinds;
    bool sized;          ///< the file says radii
    int64_t *id;         ///< of each, rising; NULL: the file does not say, they are numbered from 0
    double time;         ///< s, of a dump; 0: the file does not say
    bool bounded;        ///< there is a box
    double bounds[3][2]; ///< m, its lower and upper sides
    double tilt[3];      ///< m, of a box that is sheared: xy, xz, yz as LAMMPS has them
    bool sided;          ///< the file says in which directions the box repeats itself
    unsigned periodic;   ///< these, bits 0, 1, 2
    const char *format;  ///< name of the format
    char left_out[120];  ///< columns of the file that mean nothing here, by name; "": all are read
} scree_grains;

typedef struct scree_grains_options {
    const char *format; ///< NULL: found out
    double length;      ///< m, of one unit of the file where it does not say which
    double time;        ///< s, the same
    double frame;       ///< of a dump, the time step of the frame; NAN: the last one
} scree_grains_options;

/// Names of the formats, NULL at the end.
extern const char *const scree_grains_formats[];

/// Reads the file. Errors: SCREE_ERROR_IO: it cannot be read; SCREE_ERROR_INPUT with file, line and column: it is not
/// of this format, a column is missing or not known, a value is no number; memory. *grains owns nothing on failure.
/// Cost: linear in the bytes, some 0.3 microseconds a number; memory: the file and its numbers.
scree_status scree_grains_read(const char *path, const scree_grains_options *options, scree_grains *grains,
                               scree_error *error) SCREE_MUST_USE;
void scree_grains_destroy(scree_grains *grains);

/// Place among the `count` names of materials of what a kind of the file means: the same name, or where the name is
/// the number k the k-th (YADE counts from 0), or the only one. -1: there is none.
int64_t scree_grains_find_material(const scree_grains *grains, size_t kind, const char *const *names, size_t count);

/// Whether the grains lie in a plane, as those of a file without z do, and from where to where along z [m].
bool scree_grains_are_2d(const scree_grains *grains, double *lower, double *upper);

/// Whether z of all of three or more grains is 0, as dumps of runs in a plane have it.
bool scree_grains_are_flat(const scree_grains *grains);

#endif
