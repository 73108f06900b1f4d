/// Bodies behind a straight wall.
#include "shape/half_plane_overlap.h"

#include "shape/disc_overlap.h"

/// The second arm, and what cannot be used: of the wall, nothing.
static void finish(const double normal[2], double height, double radius, double bound, scree_overlap *overlap)
{
    const double foot[2] = {-height * normal[0], -height * normal[1]};
    const double radii[2] = {radius, 0}, bounds[2] = {bound, INFINITY};
    scree_overlap_finish(overlap, foot, radii, bounds);
}

bool scree_polygon_half_plane_overlap(const scree_polygon *polygon, const double normal[2], double height,
                                      scree_overlap *overlap)
{
    const double(*p)[2] = polygon->corner;
    const double tangent[2] = {-normal[1], normal[0]};
    double depth[SCREE_POLYGON_CORNERS], place[2] = {0, 0}, way = 0, twice = 0;
    int count = polygon->count, behind = 0, crossings = 0;
    if (height > polygon->bound * (1 + 0x1p-40)) return false;
    for (int k = 0; k < count; k++) {
        depth[k] = -(p[k][0] * normal[0] + p[k][1] * normal[1] + height);
        behind += !(depth[k] <= 0);
    }
    if (behind == 0) return false;
    *overlap = (scree_overlap){.flags = SCREE_OVERLAP_INSIDE};
    if (behind == count) {
        overlap->area = scree_polygon_area(count, p);
        finish(normal, height, polygon->radius, polygon->bound, overlap);
        return true;
    }
    // In coordinates along the wall and behind it, the area is the integral of the depth along the outline.
    for (int k = 0; k < count; k++) {
        int next = k + 1 < count ? k + 1 : 0;
        double from = p[k][0] * tangent[0] + p[k][1] * tangent[1],
               to = p[next][0] * tangent[0] + p[next][1] * tangent[1];
        double least = fmax(depth[k], 0), most = fmax(depth[next], 0);
        bool leaves = depth[k] > 0, stays = depth[next] > 0;
        if (leaves != stays) {
            double share = depth[k] / (depth[k] - depth[next]), at = from + share * (to - from);
            *(leaves ? &to : &from) = at;
            for (int i = 0; i < 2; i++) {
                overlap->edge[leaves][0][i] = p[next][i] - p[k][i];
                overlap->edge[leaves][1][i] = tangent[i];
            }
            // The outline runs backwards behind the wall: from where it goes in to where it comes out.
            way += leaves ? -at : at;
            for (int i = 0; i < 2; i++) place[i] += p[k][i] + share * (p[next][i] - p[k][i]);
            crossings++;
        }
        if (leaves || stays) twice += (least + most) * (from - to);
    }
    overlap->area = twice / 2;
    overlap->flags = 0;
    overlap->crossings = crossings;
    for (int i = 0; i < 2; i++) {
        overlap->chord[i] = -way * normal[i];
        overlap->arm[0][i] = place[i] / crossings;
    }
    if (overlap->area <= 0) return false;
    finish(normal, height, polygon->radius, polygon->bound, overlap);
    return true;
}

bool scree_disc_half_plane_overlap(double radius, const double normal[2], double height, scree_overlap *overlap)
{
    if (height >= radius) return false;
    *overlap = (scree_overlap){.area = M_PI * radius * radius, .flags = SCREE_OVERLAP_INSIDE};
    if (height > -radius) {
        double half = sqrt((radius - height) * (radius + height));
        overlap->area = scree_disc_cap(radius, half, height);
        overlap->flags = 0;
        overlap->crossings = 2;
        for (int i = 0; i < 2; i++) {
            overlap->chord[i] = -2 * half * normal[i];
            overlap->arm[0][i] = -height * normal[i];
        }
        const double tangent[2] = {-normal[1], normal[0]};
        for (int k = 0; k < 2; k++) {
            // From the foot on the wall, half a chord along it.
            const double along = k == 0 ? half : -half;
            for (int i = 0; i < 2; i++) overlap->edge[k][1][i] = tangent[i];
            overlap->edge[k][0][0] = -(overlap->arm[0][1] + along * tangent[1]);
            overlap->edge[k][0][1] = overlap->arm[0][0] + along * tangent[0];
        }
    }
    finish(normal, height, radius, radius, overlap);
    return true;
}
