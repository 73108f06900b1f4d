/// Files of points, lines and polygons. See the header.
#include "io/vtp.h"

#include "io/run_directory.h"
#include "io/vtk_data.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define BYTE_ORDER_NAME "LittleEndian"
#else
#define BYTE_ORDER_NAME "BigEndian"
#endif

/// VTK's numbers of the kinds of cells of a grid.
enum { VTK_TRIANGLE = 5, VTK_TETRA = 10 };

// ---- building ----------------------------------------------------------------------------------------------------

scree_status scree_vtp_create(scree_vtp *vtp, size_t points, scree_vtp_cells cells, size_t count, scree_error *error)
{
    const size_t corners = (size_t)cells;
    *vtp = (scree_vtp){.cells = cells};
    vtp->points = (scree_array){.name = "Points", .components = 3, .rows = points, .unit = "m"};
    vtp->connectivity =
        (scree_array){.name = "connectivity", .type = SCREE_FIELD_INT64, .components = 1, .rows = corners * count};
    vtp->ends = (scree_array){.name = "offsets", .type = SCREE_FIELD_INT64, .components = 1, .rows = count};
    scree_status status = scree_array_allocate(&vtp->points, error);
    if (!status) status = scree_array_allocate(&vtp->connectivity, error);
    if (!status) status = scree_array_allocate(&vtp->ends, error);
    if (status) {
        scree_vtp_destroy(vtp);
        return status;
    }
    int64_t *ends = vtp->ends.data;
    for (size_t k = 0; k < count; k++) {
        ends[k] = (int64_t)(corners * (k + 1));
        for (size_t c = 0; c < corners; c++) scree_vtp_join(vtp, k, c, corners * k + c);
    }
    return SCREE_OK;
}

scree_status scree_vtu_create(scree_vtp *vtp, size_t points, int dimension, size_t count, scree_error *error)
{
    scree_vtp_cells cells = dimension == 3 ? SCREE_VTP_QUADRILATERALS : SCREE_VTP_TRIANGLES;
    scree_status status = scree_vtp_create(vtp, points, cells, count, error);
    if (status) return status;
    vtp->types = (scree_array){.name = "types", .type = SCREE_FIELD_UINT8, .components = 1, .rows = count};
    status = scree_array_allocate(&vtp->types, error);
    if (status)
        scree_vtp_destroy(vtp);
    else if (count > 0)
        memset(vtp->types.data, dimension == 3 ? VTK_TETRA : VTK_TRIANGLE, count);
    return status;
}

void scree_vtp_join(scree_vtp *vtp, size_t cell, size_t corner, size_t point)
{
    int64_t *connectivity = vtp->connectivity.data;
    connectivity[(size_t)vtp->cells * cell + corner] = (int64_t)point;
}

void scree_vtp_destroy(scree_vtp *vtp)
{
    scree_array_destroy(&vtp->points);
    scree_array_destroy(&vtp->connectivity);
    scree_array_destroy(&vtp->ends);
    scree_array_destroy(&vtp->types);
    for (size_t k = 0; k < vtp->point_data_count; k++) scree_array_destroy(&vtp->point_data[k]);
    for (size_t k = 0; k < vtp->cell_data_count; k++) scree_array_destroy(&vtp->cell_data[k]);
    vtp->point_data_count = vtp->cell_data_count = 0;
}

void scree_vtp_place(scree_vtp *vtp, size_t k, const scree_vector place)
{
    memcpy((double *)vtp->points.data + 3 * k, place, sizeof(scree_vector));
}

/// (x, y) becomes (x, y, 0).
static scree_status widen(scree_array *array, scree_error *error)
{
    scree_array wide = *array;
    wide.components = 3;
    scree_status status = scree_array_allocate(&wide, error);
    if (status) return status;
    const double *from = array->data;
    double *to = wide.data;
    for (size_t k = 0; k < array->rows; k++) memcpy(to + 3 * k, from + 2 * k, 2 * sizeof *to);
    scree_array_destroy(array);
    *array = wide;
    return SCREE_OK;
}

scree_status scree_vtp_add(scree_vtp *vtp, bool of_cells, scree_array array, scree_error *error)
{
    size_t *count = of_cells ? &vtp->cell_data_count : &vtp->point_data_count;
    assert(*count < SCREE_VTP_ARRAYS);
    assert(array.rows == (of_cells ? vtp->ends.rows : vtp->points.rows));
    const char *group = strchr(array.name, '/');
    if (group) array.name = group + 1;
    scree_status status = array.components == 2 ? widen(&array, error) : SCREE_OK;
    if (status)
        scree_array_destroy(&array);
    else
        (of_cells ? vtp->cell_data : vtp->point_data)[(*count)++] = array;
    return status;
}

// ---- writing -----------------------------------------------------------------------------------------------------

/// A file on its way: the head is written while the arrays are packed, whose places it tells.
typedef struct writing {
    FILE *file;
    scree_vtk_data data;
    scree_status status;
    scree_error *error;
} writing;

/// The element that announces an array.
static void announce(writing *w, const scree_array *array)
{
    fprintf(w->file,
            "        <DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%zu\"",
            scree_vtk_type(array), array->name, array->components, w->data.count);
    if (array->unit && strcmp(array->unit, "1") != 0)
        fprintf(w->file,
                "><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">%s</InformationKey></DataArray>\n",
                array->unit);
    else
        fputs("/>\n", w->file);
    if (!w->status) w->status = scree_vtk_pack(&w->data, array, w->error);
}

static void announce_section(writing *w, const char *section, const scree_array *arrays, size_t count)
{
    fprintf(w->file, "      <%s>\n", section);
    for (size_t k = 0; k < count; k++) announce(w, &arrays[k]);
    fprintf(w->file, "      </%s>\n", section);
}

static void write_head(writing *w, const scree_vtp *vtp, double time)
{
    static const char *const sections[] = {
        [SCREE_VTP_POINTS] = "Verts",
        [SCREE_VTP_LINES] = "Lines",
        [SCREE_VTP_TRIANGLES] = "Polys",
        [SCREE_VTP_QUADRILATERALS] = "Polys",
    };
    const size_t count = vtp->ends.rows;
    const bool points = vtp->cells == SCREE_VTP_POINTS, lines = vtp->cells == SCREE_VTP_LINES;
    const bool grid = vtp->types.data != NULL;
    const char *kind = grid ? "UnstructuredGrid" : "PolyData";
    const scree_array cells[] = {vtp->connectivity, vtp->ends, vtp->types};
    FILE *file = w->file;
    fprintf(
        file,
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"%s\" version=\"1.0\" byte_order=\"" BYTE_ORDER_NAME
        "\" header_type=\"UInt64\" compressor=\"" SCREE_VTK_PACKING "\">\n"
        "  <%s>\n"
        "    <FieldData>\n"
        "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">%.17g</DataArray>\n"
        "    </FieldData>\n"
        "    <Piece NumberOfPoints=\"%zu\"",
        kind, kind, time, vtp->points.rows);
    if (grid)
        fprintf(file, " NumberOfCells=\"%zu\">\n", count);
    else
        fprintf(file, " NumberOfVerts=\"%zu\" NumberOfLines=\"%zu\" NumberOfStrips=\"0\" NumberOfPolys=\"%zu\">\n",
                points ? count : 0, lines ? count : 0, points || lines ? 0 : count);
    announce_section(w, "Points", &vtp->points, 1);
    announce_section(w, grid ? "Cells" : sections[vtp->cells], cells, grid ? 3 : 2);
    announce_section(w, "PointData", vtp->point_data, vtp->point_data_count);
    announce_section(w, "CellData", vtp->cell_data, vtp->cell_data_count);
    fprintf(file, "    </Piece>\n  </%s>\n  <AppendedData encoding=\"raw\">\n_", kind);
}

scree_status scree_vtp_write(const scree_vtp *vtp, const char *path, double time, scree_error *error)
{
    writing w = {.error = error};
    scree_status status = scree_replace_begin(path, &w.file, error);
    if (status) return status;
    write_head(&w, vtp, time);
    if (!w.status && fwrite(w.data.byte, 1, w.data.count, w.file) != w.data.count)
        w.status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", path);
    fputs("\n  </AppendedData>\n</VTKFile>\n", w.file);
    scree_vtk_data_destroy(&w.data);
    const scree_status finished = scree_replace_finish(path, w.file, !w.status, w.status ? NULL : error);
    return w.status ? w.status : finished;
}
