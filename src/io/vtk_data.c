/// Arrays of VTK files, packed by LZ4.
#include "io/vtk_data.h"

#include "base/memory.h"

#include <lz4.h>
#include <string.h>

enum { HEAD = 3 }; ///< numbers in front of the packed sizes

/// Whether all numbers fit into 32 bits with a sign.
static bool is_short(const scree_array *array)
{
    const int64_t *value = array->data;
    const size_t count = array->rows * (size_t)array->components;
    for (size_t k = 0; k < count; k++)
        if (value[k] < INT32_MIN || value[k] > INT32_MAX) return false;
    return true;
}

/// What an array becomes in the file.
static scree_field_type type_in_file(const scree_array *array)
{
    if (array->type == SCREE_FIELD_DOUBLE) return SCREE_FIELD_FLOAT;
    return array->type == SCREE_FIELD_INT64 && is_short(array) ? SCREE_FIELD_INT32 : array->type;
}

const char *scree_vtk_type(const scree_array *array)
{
    static const char *const name[] = {
        [SCREE_FIELD_DOUBLE] = "Float64", [SCREE_FIELD_INT64] = "Int64", [SCREE_FIELD_UINT64] = "UInt64",
        [SCREE_FIELD_FLOAT] = "Float32",  [SCREE_FIELD_INT32] = "Int32", [SCREE_FIELD_UINT32] = "UInt32",
        [SCREE_FIELD_UINT8] = "UInt8",
    };
    return name[type_in_file(array)];
}

static scree_status make_room(scree_vtk_data *data, size_t more, scree_error *error)
{
    if (data->room - data->count >= more) return SCREE_OK;
    const size_t room = data->count + more + data->count / 2;
    scree_status status = scree_reallocate(&data->byte, data->room, room, sizeof *data->byte, error);
    if (!status) data->room = room;
    return status;
}

/// Elements `first` to `first + count` as they are in the file.
static const void *narrow(const scree_array *array, size_t first, size_t count, void *room)
{
    const scree_field_type type = type_in_file(array);
    if (type == array->type) return (const uint8_t *)array->data + first * scree_field_size(type);
    for (size_t k = 0; k < count; k++) {
        if (type == SCREE_FIELD_FLOAT)
            ((float *)room)[k] = (float)((const double *)array->data)[first + k];
        else
            ((int32_t *)room)[k] = (int32_t)((const int64_t *)array->data)[first + k];
    }
    return room;
}

static void put(scree_vtk_data *data, size_t at, uint64_t value)
{
    memcpy(data->byte + at, &value, sizeof value);
}

scree_status scree_vtk_pack(scree_vtk_data *data, const scree_array *array, scree_error *error)
{
    const size_t size = scree_field_size(type_in_file(array)), a_block = SCREE_VTK_BLOCK / size;
    const size_t count = array->rows * (size_t)array->components, blocks = (count + a_block - 1) / a_block;
    const size_t head = data->count;
    uint8_t *room;
    scree_status status = scree_allocate(&room, SCREE_VTK_BLOCK, 1, error);
    if (status) return status;
    status = make_room(data, (HEAD + blocks) * sizeof(uint64_t), error);
    if (!status) {
        put(data, head, blocks);
        put(data, head + sizeof(uint64_t), SCREE_VTK_BLOCK);
        put(data, head + 2 * sizeof(uint64_t), count % a_block * size);
        data->count += (HEAD + blocks) * sizeof(uint64_t);
    }
    for (size_t k = 0; k < blocks && !status; k++) {
        const size_t first = k * a_block, number = count - first < a_block ? count - first : a_block;
        const int bound = LZ4_compressBound((int)(number * size));
        if ((status = make_room(data, (size_t)bound, error))) break;
        const int packed = LZ4_compress_default(narrow(array, first, number, room), (char *)data->byte + data->count,
                                                (int)(number * size), bound);
        put(data, head + (HEAD + k) * sizeof(uint64_t), (uint64_t)packed);
        data->count += (size_t)packed;
    }
    scree_release(&room);
    return status;
}

void scree_vtk_data_destroy(scree_vtk_data *data)
{
    scree_release(&data->byte);
    *data = (scree_vtk_data){0};
}
