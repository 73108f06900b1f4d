/// Triangles of an STL file as a wall: where the file lies, what is in it, the mesh (shape/mesh.h).
#include "shape/wall_keys.h"

#include "base/file_bytes.h"
#include "base/memory.h"
#include "case/own_file.h"
#include "shape/stl.h"

#include <math.h>
#include <stdio.h>

typedef scree_mesh_keys config;
static const scree_key keys[] = {
    KEY(config, file, SCREE_KEY_TEXT, FROM("1"), TO("4000"),
        .meaning = "STL file, binary or ASCII, relative to the case file."),
    SCREE_OWN_FILE_CHECKSUM(config, checksum),
    NUMBER(config, scale, "m", .standard = "1 m", ABOVE("0 m"), TO("1e6 m"),
           .meaning = "Length of one unit of the file, e.g. 1 mm."),
    PLACE(config, at, .standard = "[0, 0]", .meaning = "Where the origin of the file lies."),
    NUMBER(config, smooth, "rad", .standard = "15 degrees", FROM("0.1 degrees"), TO("60 degrees"),
           .meaning = "Triangles that meet at less than this angle are one smooth surface."),
};

static void find(scree_reader *reader, int64_t index, void *own)
{
    config *c = own;
    char path[SCREE_PATH_BYTES];
    (void)snprintf(path, sizeof path, "walls.%lld", (long long)index);
    (void)scree_own_file_find(reader, path, &c->file, &c->checksum);
}

static const char *wrong(const void *own, int dimension, const char **key)
{
    (void)own;
    (void)dimension;
    (void)key;
    return NULL;
}

static scree_status make(const void *own, int dimension, scree_surface *surface, scree_error *error)
{
    const config *c = own;
    char *bytes;
    size_t length, count;
    double(*corner)[3] = NULL;
    char reason[sizeof error->message];
    scree_error failure = {0};
    (void)dimension;
    scree_status status = scree_file_load(c->file, &bytes, &length, &failure);
    if (!status) status = scree_stl_parse(bytes, length, &corner, &count, &failure);
    for (size_t v = 0; !status && v < 3 * count; v++)
        for (int k = 0; k < 3; k++) corner[v][k] = c->at[k] + c->scale * corner[v][k];
    if (!status) status = scree_mesh_build(&surface->mesh, count, (const double(*)[3])corner, &failure);
    scree_release(&bytes);
    scree_release(&corner);
    surface->kind = SCREE_SURFACE_MESH;
    surface->count = scree_mesh_primitives(&surface->mesh);
    surface->smooth = cos(c->smooth);
    if (!status) return SCREE_OK;
    (void)snprintf(reason, sizeof reason, "%s", failure.message);
    return scree_error_set(error, status, "%s: %s", c->file, reason);
}

const scree_module scree_module_mesh = {
    .name = "mesh",
    .meaning = "Triangles of an STL file; contacts on both sides.",
    .choice_of = CHOICE_OF(IS("walls", .meaning = "triangles of an STL file, both sides of them (3D)")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .wall = &(const scree_wall_shape){.only_3d = true, .wrong = wrong, .find = find, .make = make},
};
