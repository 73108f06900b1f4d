/// Contacts in files: tables with named columns, and local dumps of LAMMPS or LIGGGHTS, whose columns the caller names.
#ifndef SCREE_GRAINS_CONTACTS_H
#define SCREE_GRAINS_CONTACTS_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// In SI units, in the order of the file.
typedef struct scree_grain_contacts {
    size_t count;
    int64_t *first, *second; ///< ids of the grains; second below 0: no grain, a wall
    double (*force)[3];      ///< N, on the first
    double (*point)[3];      ///< m; NULL: the file does not say
} scree_grain_contacts;

typedef struct scree_grain_contacts_options {
    const char *columns;  ///< names of the columns in their order, "first,second,fx,fy,fz,x,y,z", - one that is left
                          ///< out, forces of one name are added; NULL: those of the file
    double length, force; ///< m, N, of one unit of the file
    double frame;         ///< of a local dump, the time step of the frame; NAN: the last one
} scree_grain_contacts_options;

/// Reads the file. Errors: SCREE_ERROR_IO: it cannot be read; SCREE_ERROR_INPUT with file, line and column: a column is
/// missing, a value is no number; memory. *contacts owns nothing on failure. Cost: linear in the bytes.
scree_status scree_grain_contacts_read(const char *path, const scree_grain_contacts_options *options,
                                       scree_grain_contacts *contacts, scree_error *error) SCREE_MUST_USE;
void scree_grain_contacts_destroy(scree_grain_contacts *contacts);

#endif
