/// VTK's XML format for points, lines, triangles and quadrilaterals in space (.vtp), and for grids of triangles or
/// tetrahedra (.vtu), written without VTK: an XML head that says which arrays there are and at which byte they begin,
/// and the arrays behind it as packed bytes (io/vtk_data.h). Source: the VTK file formats,
/// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#ifndef SCREE_IO_VTP_H
#define SCREE_IO_VTP_H

#include "io/array.h"

enum { SCREE_VTP_ARRAYS = 24 };

/// The value is the number of points of a cell.
typedef enum scree_vtp_cells {
    SCREE_VTP_POINTS = 1,
    SCREE_VTP_LINES = 2,
    SCREE_VTP_TRIANGLES = 3,
    SCREE_VTP_QUADRILATERALS = 4 ///< in a grid: tetrahedra
} scree_vtp_cells;

typedef struct scree_vtp {
    scree_array points;             ///< x, y, z [m]
    scree_vtp_cells cells;          ///< what a cell is
    scree_array connectivity, ends; ///< points of all cells; index behind the last point of each cell
    scree_array types;              ///< of grids: VTK's number of the kind of each cell; else no data
    scree_array point_data[SCREE_VTP_ARRAYS], cell_data[SCREE_VTP_ARRAYS];
    size_t point_data_count, cell_data_count;
} scree_vtp;

/// Points at the origin and `count` cells, the k-th of the c points from c k on. Errors: memory.
scree_status scree_vtp_create(scree_vtp *vtp, size_t points, scree_vtp_cells cells, size_t count,
                              scree_error *error) SCREE_MUST_USE;
/// A grid of `count` triangles (dimension 2) or tetrahedra. Errors: memory.
scree_status scree_vtu_create(scree_vtp *vtp, size_t points, int dimension, size_t count,
                              scree_error *error) SCREE_MUST_USE;
void scree_vtp_destroy(scree_vtp *vtp);

/// Sets point k.
void scree_vtp_place(scree_vtp *vtp, size_t k, const scree_vector place);

/// Makes `point` a corner of a cell.
void scree_vtp_join(scree_vtp *vtp, size_t cell, size_t corner, size_t point);

/// Takes over `array` (also when it fails) as data of points or of cells. Vectors in the plane get a third component,
/// as ParaView wants them; a group in front of the name is cut off. Errors: memory.
scree_status scree_vtp_add(scree_vtp *vtp, bool of_cells, scree_array array, scree_error *error) SCREE_MUST_USE;

/// Writes the file as a whole. time [s] becomes the field TimeValue.
scree_status scree_vtp_write(const scree_vtp *vtp, const char *path, double time, scree_error *error) SCREE_MUST_USE;

#endif
