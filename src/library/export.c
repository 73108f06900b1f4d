/// Snapshots of a run as a dump of LAMMPS (docs.lammps.org: dump custom), for OVITO and whatever else reads one: a
/// frame a snapshot, whose time step is the number of the snapshot; ids and materials from 1.
///
/// A periodic cell is the box, tilted where it is sheared; its first vector must lie along x and its second in the
/// plane of x and y, as LAMMPS has it. In other directions the box ends where the bodies do. In the plane z is 0 and
/// the box as high as the largest body. Cost: linear in bodies.
#include "io/archive.h"
#include "io/sample_file.h"
#include "io/snapshot.h"

#include "base/memory.h"
#include "io/run_directory.h"

#include <scree/scree.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

/// What a frame has beside its snapshot.
typedef struct extra {
    scree_view spin, material; ///< components 0: not there
    scree_keeper *keeper[2];
} extra;

static double component(const scree_view *view, size_t i, int k)
{
    if (view->components <= k) return 0;
    const char *at = (const char *)view->data + i * view->stride;
    if (view->type == SCREE_FIELD_DOUBLE) return ((const double *)(const void *)at)[k];
    return view->type == SCREE_FIELD_INT32 ? ((const int32_t *)(const void *)at)[k] : 0;
}

/// A dataset of the snapshot; older runs lack some.
static scree_status read_view(const char *directory, int64_t index, const char *name, scree_view *view,
                              scree_keeper **keeper, scree_error *error)
{
    char path[80];
    (void)snprintf(path, sizeof path, "snapshots/%06lld/%s", (long long)index, name);
    scree_status status = scree_run_data_read(directory, path, view, keeper, error);
    if (status != SCREE_ERROR_INPUT) return status;
    *view = (scree_view){.components = 0};
    return SCREE_OK;
}

// ---- the box -----------------------------------------------------------------------------------------------------

typedef struct box {
    double low[3], high[3];
    double xy, xz, yz;
    bool periodic[3], tilted;
} box;

/// Where the bodies end, along an axis.
static void enclose(const scree_snapshot *s, int axis, double *low, double *high)
{
    const double *const place[] = {s->x, s->y, s->z};
    double largest = 0;
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t k = 0; k < s->count; k++) {
        largest = fmax(largest, s->radius[k]);
        if (!place[axis]) continue;
        *low = fmin(*low, place[axis][k] - s->radius[k]);
        *high = fmax(*high, place[axis][k] + s->radius[k]);
    }
    if (*low <= *high) return;
    *low = -largest;
    *high = largest;
}

static scree_status find_box(const scree_snapshot *s, box *b, scree_error *error)
{
    const double *h = s->periodic.lattice; // vectors as columns
    *b = (box){.tilted = false};
    for (int axis = 0; axis < 3; axis++) {
        b->periodic[axis] = s->periodic.directions >> axis & 1;
        if (b->periodic[axis])
            b->high[axis] = h[4 * axis];
        else
            enclose(s, axis, &b->low[axis], &b->high[axis]);
    }
    if (s->periodic.directions == 0) return SCREE_OK;
    if (h[3] != 0 || h[6] != 0 || h[7] != 0)
        return scree_error_set(
            error, SCREE_ERROR_INPUT,
            "snapshot %lld: a dump of LAMMPS has no cell whose first vector leaves x, or whose second "
            "leaves the plane of x and y",
            (long long)s->index);
    b->xy = h[1];
    b->xz = s->dimension == 3 ? h[2] : 0;
    b->yz = s->dimension == 3 ? h[5] : 0;
    b->tilted = b->xy != 0 || b->xz != 0 || b->yz != 0;
    return SCREE_OK;
}

/// Of a tilted box the sides are those of the box with right angles around it.
static void write_box(FILE *file, const box *b)
{
    static const char *const name[] = {"xy", "xz", "yz"};
    const double tilt[] = {b->xy, b->xz, b->yz};
    const double below[] = {fmin(fmin(0, b->xy), fmin(b->xz, b->xy + b->xz)), fmin(0, b->yz), 0};
    const double above[] = {fmax(fmax(0, b->xy), fmax(b->xz, b->xy + b->xz)), fmax(0, b->yz), 0};
    fputs("ITEM: BOX BOUNDS", file);
    for (int k = 0; k < 3 && b->tilted; k++) fprintf(file, " %s", name[k]);
    for (int k = 0; k < 3; k++) fputs(b->periodic[k] ? " pp" : " ff", file);
    fputc('\n', file);
    for (int k = 0; k < 3; k++) {
        fprintf(file, "%.17g %.17g", b->low[k] + below[k], b->high[k] + above[k]);
        if (b->tilted) fprintf(file, " %.17g", tilt[k]);
        fputc('\n', file);
    }
}

// ---- frames ------------------------------------------------------------------------------------------------------

static void write_bodies(FILE *file, const scree_snapshot *s, const extra *e)
{
    const bool plane = s->dimension == 2;
    fprintf(file, "ITEM: ATOMS id type x y z radius vx vy vz omegax omegay omegaz mark%s\n", plane ? " angle" : "");
    for (size_t k = 0; k < s->count; k++) {
        fprintf(file, "%u %d %.17g %.17g %.17g %.17g %.9g %.9g %.9g", s->id[k] + 1,
                1 + (int)component(&e->material, k, 0), s->x[k], s->y[k], plane ? 0 : s->z[k], s->radius[k], s->vx[k],
                s->vy[k], plane ? 0 : s->vz[k]);
        fprintf(file, " %.9g %.9g %.9g %d", plane ? 0 : component(&e->spin, k, 0),
                plane ? 0 : component(&e->spin, k, 1), component(&e->spin, k, plane ? 0 : 2), s->mark ? s->mark[k] : 0);
        if (plane) fprintf(file, " %.9g", s->angle[k]);
        fputc('\n', file);
    }
}

/// The contacts of a snapshot as a local dump; a second of -1 is a wall or a body of a membrane.
static scree_status write_contacts(FILE *file, const char *directory, const scree_snapshot_mark *mark, size_t which,
                                   scree_error *error)
{
    scree_average_sample s;
    (void)which;
    scree_status status = scree_sample_read(directory, mark->index, &s, error);
    if (status) return status;
    fprintf(file, "ITEM: TIMESTEP\n%lld\nITEM: TIME\n%.17g\nITEM: NUMBER OF ENTRIES\n%zu\n", (long long)mark->index,
            s.time, s.contacts);
    fputs("ITEM: BOX BOUNDS ff ff ff\n0 0\n0 0\n0 0\nITEM: ENTRIES first second fx fy fz x y z\n", file);
    for (size_t k = 0; k < s.contacts; k++) {
        const scree_average_contact *c = &s.contact[k];
        fprintf(file, "%u %lld", s.grain[c->first].id + 1,
                c->second == SCREE_AVERAGE_OUTSIDE ? -1 : (long long)s.grain[c->second].id + 1);
        for (int i = 0; i < 3; i++) fprintf(file, " %.17g", c->force[i]);
        for (int i = 0; i < 3; i++) fprintf(file, " %.17g", c->point[i]);
        fputc('\n', file);
    }
    scree_average_sample_destroy(&s);
    return SCREE_OK;
}

static scree_status write_frame(FILE *file, const char *directory, const scree_snapshot_mark *mark, size_t which,
                                scree_error *error)
{
    scree_snapshot s = {0};
    (void)mark;
    extra e = {.keeper = {NULL}};
    box b;
    scree_status status = scree_snapshot_read(directory, which, &s, error);
    if (!status) status = find_box(&s, &b, error);
    if (!status) status = read_view(directory, s.index, "spin", &e.spin, &e.keeper[0], error);
    if (!status) status = read_view(directory, s.index, "material", &e.material, &e.keeper[1], error);
    if (!status) {
        fprintf(file, "ITEM: TIMESTEP\n%lld\nITEM: TIME\n%.17g\nITEM: NUMBER OF ATOMS\n%zu\n", (long long)s.index,
                s.time, s.count);
        write_box(file, &b);
        write_bodies(file, &s, &e);
    }
    for (int k = 0; k < 2; k++) scree_keeper_free(e.keeper[k]);
    scree_snapshot_destroy(&s);
    return status;
}

/// The stages that there are, where one that is not was asked for.
static scree_status refuse_stage(const char *stage, const scree_snapshot_mark *mark, size_t count, scree_error *error)
{
    scree_status status = scree_error_refuse(error, "--stage", NULL, "the run has no snapshot of a stage '%s'", stage);
    size_t used = 0;
    for (size_t k = 0; k < count && used < sizeof error->accepted; k++)
        if (k == 0 || strcmp(mark[k].stage_name, mark[k - 1].stage_name) != 0)
            used += (size_t)snprintf(error->accepted + used, sizeof error->accepted - used, "%s%s",
                                     used > 0 ? ", " : "", mark[k].stage_name);
    return status;
}

typedef scree_status frame_writer(FILE *file, const char *directory, const scree_snapshot_mark *mark, size_t which,
                                  scree_error *error);

static scree_status write_frames(const char *directory, const char *stage, const char *path, frame_writer *write,
                                 size_t *frames, scree_error *error)
{
    scree_snapshot_mark *mark = NULL;
    size_t count = 0;
    FILE *file = NULL;
    *frames = 0;
    scree_status status = scree_snapshot_marks(directory, &mark, &count, error);
    for (size_t k = 0; k < count && !status; k++) *frames += !stage || scree_snapshot_mark_is_of(&mark[k], stage);
    if (!status && *frames == 0) status = refuse_stage(stage, mark, count, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    for (size_t k = 0; k < count && !status; k++)
        if (!stage || scree_snapshot_mark_is_of(&mark[k], stage)) status = write(file, directory, &mark[k], k, error);
    if (file) {
        scree_error later = {0};
        const scree_status closed = scree_replace_finish(path, file, !status, status ? &later : error);
        if (!status) status = closed;
    }
    scree_release(&mark);
    return status;
}

scree_status scree_export_lammps(const char *directory, const char *stage, const char *path, size_t *frames,
                                 scree_error *error)
{
    return write_frames(directory, stage, path, write_frame, frames, error);
}

scree_status scree_export_contacts(const char *directory, const char *stage, const char *path, size_t *frames,
                                   scree_error *error)
{
    return write_frames(directory, stage, path, write_contacts, frames, error);
}

scree_status scree_export_archive(const char *directory, const char *stage, const char *target, scree_error *error)
{
    scree_snapshot_mark *mark = NULL;
    size_t count = 0, kept = 0, of_stage = SIZE_MAX;
    int64_t index[2];
    scree_status status = scree_snapshot_marks(directory, &mark, &count, error);
    if (!status && count == 0)
        status = scree_error_set(error, SCREE_ERROR_INPUT, "there is no snapshot in '%s'", directory);
    for (size_t k = 0; k < count && stage; k++)
        if (scree_snapshot_mark_is_of(&mark[k], stage)) of_stage = k;
    if (!status && stage && of_stage == SIZE_MAX) status = refuse_stage(stage, mark, count, error);
    if (!status && of_stage < count - 1) index[kept++] = mark[of_stage].index;
    if (!status) index[kept++] = mark[count - 1].index;
    scree_release(&mark);
    return status ? status : scree_run_archive(directory, target, index, kept, error);
}
