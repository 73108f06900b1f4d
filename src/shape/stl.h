/// STL files, binary and ASCII.
#ifndef SCREE_SHAPE_STL_H
#define SCREE_SHAPE_STL_H

#include "base/error.h"

#include <stddef.h>

/// Reads the triangles of `bytes`: *corner holds three corners of each of *count triangles, in single precision as the
/// format has it, so that the two forms of a file give the same bits. The stored normals are not read: normals follow
/// from the corners. The caller releases *corner. Errors: SCREE_ERROR_INPUT with the byte (binary) or the line (ASCII)
/// and what was expected there; memory. Cost: linear.
scree_status scree_stl_parse(const char *bytes, size_t length, double (**corner)[3], size_t *count,
                             scree_error *error) SCREE_MUST_USE;

#endif
