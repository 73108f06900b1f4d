/// Arrays of VTK files as they lie behind the head: real numbers in single precision, whole ones of 64 bits in 32 where
/// all fit (pictures need no more; restarts use snapshots), cut into blocks that LZ4 packs. An array is
///     number of blocks | bytes of a block | bytes of the last one, 0: it is full | packed bytes of each block | blocks
/// all but the blocks as UInt64. Source: the VTK file formats,
/// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html; LZ4: Y. Collet. Cost: 2 ns a byte; vectors in
/// the plane, whose third components are zero, and tensors there pack best.
#ifndef SCREE_IO_VTK_DATA_H
#define SCREE_IO_VTK_DATA_H

#include "io/array.h"

/// What the head of a file names its packing.
#define SCREE_VTK_PACKING "vtkLZ4DataCompressor"

enum { SCREE_VTK_BLOCK = 262144 }; ///< bytes before packing

typedef struct scree_vtk_data {
    uint8_t *byte;
    size_t count, room;
} scree_vtk_data;

/// Type of an array in the file: the name that VTK has for it.
const char *scree_vtk_type(const scree_array *array);

/// Appends an array. Errors: memory.
scree_status scree_vtk_pack(scree_vtk_data *data, const scree_array *array, scree_error *error) SCREE_MUST_USE;
void scree_vtk_data_destroy(scree_vtk_data *data);

#endif
