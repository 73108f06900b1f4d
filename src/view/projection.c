/// Projection and section of a snapshot of spheres. Cost: linear.
#include "view/projection.h"
#include "state/plates.h"

#include "base/memory.h"
#include "state/periodic.h"
#include "view/wall_lines.h"

#include <math.h>
#include <string.h>

#define AZIMUTH   (0.5 * M_PI / 3) /* of the viewer, from -y towards x */
#define ELEVATION (0.35 * M_PI / 3)

/// Rows: right, up, towards the viewer.
typedef struct axes {
    scree_vector row[3];
} axes;

static axes axes_of_view(void)
{
    double ca = cos(AZIMUTH), sa = sin(AZIMUTH), ce = cos(ELEVATION), se = sin(ELEVATION);
    return (axes){{{ca, sa, 0}, {-sa * se, ca * se, ce}, {sa * ce, -ca * ce, se}}};
}

static double along(const scree_vector axis, double x, double y, double z)
{
    return axis[0] * x + axis[1] * y + axis[2] * z;
}

/// Extent of the bodies in x and y, with their radii.
static void find_extent(const scree_snapshot *solid, double low[2], double high[2])
{
    const double *const place[2] = {solid->x, solid->y};
    for (int i = 0; i < 2; i++) {
        low[i] = INFINITY;
        high[i] = -INFINITY;
        for (size_t k = 0; k < solid->count; k++) {
            low[i] = fmin(low[i], place[i][k] - solid->radius[k]);
            high[i] = fmax(high[i], place[i][k] + solid->radius[k]);
        }
    }
}

static void place_plates(const scree_snapshot *solid, const axes *view, scree_projection *projection)
{
    double low[2], high[2];
    find_extent(solid, low, high);
    for (int w = SCREE_WALL_BOTTOM; w <= SCREE_WALL_TOP; w++) {
        const scree_wall *wall = &solid->wall[w];
        double height = wall->position * wall->normal[2];
        projection->has_plate[w] = wall->active && low[0] <= high[0];
        for (int c = 0; c < 4; c++) {
            double x = c == 1 || c == 2 ? high[0] : low[0], y = c >= 2 ? high[1] : low[1];
            for (int i = 0; i < 2; i++) projection->plate[w][c][i] = along(view->row[i], x, y, height);
        }
    }
}

/// Edges of the cell along two axes of the page.
static scree_periodic_edges place_edges(const scree_snapshot *snapshot, const scree_vector right, const scree_vector up)
{
    scree_periodic_edges lines = {.count = 0};
    scree_vector low, high, ends[2];
    scree_periodic_box(snapshot->dimension, snapshot->wall, low, high);
    for (int edge = 0; edge < SCREE_PERIODIC_EDGES && snapshot->periodic.directions; edge++) {
        if (!scree_periodic_edge(&snapshot->periodic, snapshot->dimension, low, high, edge, ends)) continue;
        for (int end = 0; end < 2; end++) {
            lines.end[lines.count][end][0] = along(right, ends[end][0], ends[end][1], ends[end][2]);
            lines.end[lines.count][end][1] = along(up, ends[end][0], ends[end][1], ends[end][2]);
        }
        lines.count++;
    }
    return lines;
}

scree_periodic_edges scree_periodic_edges_of(const scree_snapshot *snapshot)
{
    const scree_vector x = {1, 0, 0}, y = {0, 1, 0};
    return place_edges(snapshot, x, y);
}

/// A plane snapshot with the same bodies, without positions.
static scree_status start_plane(const scree_snapshot *solid, scree_snapshot *plane, scree_error *error)
{
    *plane = (scree_snapshot){.index = solid->index,
                              .dimension = 2,
                              .time = solid->time,
                              .axial_strain = solid->axial_strain,
                              .count = solid->count,
                              .grains = solid->grains};
    memcpy(plane->stage, solid->stage, sizeof plane->stage);
    scree_status status = scree_allocate(&plane->x, solid->count, sizeof *plane->x, error);
    if (!status) status = scree_allocate(&plane->y, solid->count, sizeof *plane->y, error);
    if (!status) status = scree_allocate(&plane->radius, solid->count, sizeof *plane->radius, error);
    if (!status && solid->mark) status = scree_allocate(&plane->mark, solid->count, sizeof *plane->mark, error);
    if (!status && solid->mark) memcpy(plane->mark, solid->mark, solid->count * sizeof *plane->mark);
    return status;
}

static scree_status project_contacts(const scree_snapshot *solid, const axes *view, scree_snapshot *plane,
                                     scree_error *error)
{
    const size_t count = solid->contact_count;
    scree_status status = scree_allocate(&plane->first, count, sizeof *plane->first, error);
    if (!status) status = scree_allocate(&plane->second, count, sizeof *plane->second, error);
    if (!status) status = scree_allocate(&plane->normal_force, count, sizeof *plane->normal_force, error);
    if (!status) status = scree_allocate(&plane->contact_x, count, sizeof *plane->contact_x, error);
    if (!status) status = scree_allocate(&plane->contact_y, count, sizeof *plane->contact_y, error);
    if (!status) status = scree_allocate(&plane->branch_x, count, sizeof *plane->branch_x, error);
    if (!status) status = scree_allocate(&plane->branch_y, count, sizeof *plane->branch_y, error);
    if (status || count == 0) return status;
    plane->contact_count = count;
    memcpy(plane->first, solid->first, count * sizeof *plane->first);
    memcpy(plane->second, solid->second, count * sizeof *plane->second);
    memcpy(plane->normal_force, solid->normal_force, count * sizeof *plane->normal_force);
    for (size_t k = 0; k < count; k++) {
        double x = solid->contact_x[k], y = solid->contact_y[k], z = solid->contact_z[k];
        plane->contact_x[k] = along(view->row[0], x, y, z);
        plane->contact_y[k] = along(view->row[1], x, y, z);
        plane->branch_x[k] = along(view->row[0], solid->branch_x[k], solid->branch_y[k], solid->branch_z[k]);
        plane->branch_y[k] = along(view->row[1], solid->branch_x[k], solid->branch_y[k], solid->branch_z[k]);
    }
    return SCREE_OK;
}

/// The sheet of a membrane, whose corners are bodies.
static scree_status copy_sheet(const scree_snapshot *solid, scree_snapshot *plane, scree_error *error)
{
    size_t count = solid->triangle_count;
    scree_status status = scree_allocate(&plane->triangle, count, sizeof *plane->triangle, error);
    if (status || count == 0) return status;
    plane->triangle_count = count;
    memcpy(plane->triangle, solid->triangle, count * sizeof *plane->triangle);
    return SCREE_OK;
}

scree_status scree_projection_create(const scree_snapshot *solid, scree_projection *projection, scree_error *error)
{
    const axes view = axes_of_view();
    *projection = (scree_projection){0};
    scree_snapshot *plane = &projection->plane;
    scree_status status = start_plane(solid, plane, error);
    if (!status) status = scree_allocate(&projection->depth, solid->count, sizeof *projection->depth, error);
    if (!status) status = project_contacts(solid, &view, plane, error);
    if (!status) status = scree_wall_edges(solid, view.row[0], view.row[1], plane, error);
    if (!status) status = copy_sheet(solid, plane, error);
    if (status) {
        scree_projection_destroy(projection);
        return status;
    }
    for (size_t k = 0; k < solid->count; k++) {
        double x = solid->x[k], y = solid->y[k], z = solid->z[k];
        plane->x[k] = along(view.row[0], x, y, z);
        plane->y[k] = along(view.row[1], x, y, z);
        plane->radius[k] = solid->radius[k];
        projection->depth[k] = along(view.row[2], x, y, z);
    }
    place_plates(solid, &view, projection);
    projection->periodic = place_edges(solid, view.row[0], view.row[1]);
    return SCREE_OK;
}

void scree_projection_destroy(scree_projection *projection)
{
    scree_snapshot_destroy(&projection->plane);
    scree_release(&projection->depth);
}

double scree_section_place(const scree_snapshot *solid)
{
    // The mean: bodies that have flown off do not drag the plane away from the others.
    double place = 0;
    for (size_t k = 0; k < solid->count; k++) place += solid->y[k] / (double)solid->count;
    return place;
}

scree_status scree_section_create(const scree_snapshot *solid, scree_snapshot *plane, scree_error *error)
{
    const double cut = scree_section_place(solid);
    scree_status status = start_plane(solid, plane, error);
    if (!status) status = scree_wall_cuts(solid, cut, plane, error);
    if (status) {
        scree_snapshot_destroy(plane);
        return status;
    }
    for (size_t k = 0; k < solid->count; k++) {
        double off = solid->y[k] - cut, square = solid->radius[k] * solid->radius[k] - off * off;
        plane->x[k] = solid->x[k];
        plane->y[k] = solid->z[k];
        plane->radius[k] = square > 0 ? sqrt(square) : 0;
    }
    // Walls keep what of them lies in the plane of the cut.
    for (int w = SCREE_WALL_BOTTOM; w <= SCREE_WALL_RIGHT; w++) {
        plane->wall[w] = solid->wall[w];
        plane->wall[w].normal[1] = solid->wall[w].normal[2];
        plane->wall[w].normal[2] = 0;
    }
    return SCREE_OK;
}
