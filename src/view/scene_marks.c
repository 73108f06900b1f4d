/// The marks of a scene: plates, discs, force network, Delaunay boundary, arrows. Marks of equal style share one path,
/// which keeps the SVG of 5000 discs near 2 MB. Cost: linear.
#include "shape/rounding.h"
#include "state/plates.h"
#include "view/projection.h"
#include "view/scene_parts.h"

#include <math.h>

/// Points of a rounded corner.
enum { ARC = 9 };
#define LEAST_OUTLINED 6 /* pixels across */

/// Adds the corners of a polygon as it lies, those that are rounded as arcs about the corners of the core.
static void add_polygon(const scree_scene_view *view, cairo_t *cairo, size_t k)
{
    const scree_snapshot *s = view->snapshot;
    const double rounding = s->rounding ? s->rounding[k] : 0, sine = sin(s->angle[k]), cosine = cos(s->angle[k]);
    const uint32_t corners = s->corner_count[k];
    const double(*own)[2] = (const double(*)[2])s->corner + s->first_corner[k];
    double rounded[SCREE_POLYGON_CORNERS * ARC][2];
    size_t points = corners;
    if (rounding > 0 && corners <= SCREE_POLYGON_CORNERS) {
        scree_rounding_trace((int)corners, own, rounding, ARC, rounded);
        own = (const double(*)[2])rounded;
        points *= ARC;
    }
    for (size_t c = 0; c < points; c++)
        cairo_line_to(cairo, scree_scene_x(view, s->x[k] + cosine * own[c][0] - sine * own[c][1]),
                      scree_scene_y(view, s->y[k] + sine * own[c][0] + cosine * own[c][1]));
}

/// Adds the outline of a body to the path: a circle, or a polygon.
static void add_outline(const scree_scene_view *view, cairo_t *cairo, size_t k)
{
    const scree_snapshot *s = view->snapshot;
    const uint32_t corners = s->corner_count ? s->corner_count[k] : 0;
    cairo_new_sub_path(cairo);
    if (corners == 0)
        cairo_arc(cairo, scree_scene_x(view, s->x[k]), scree_scene_y(view, s->y[k]), s->radius[k] * view->scale, 0,
                  2 * M_PI);
    else
        add_polygon(view, cairo, k);
    cairo_close_path(cairo);
}

/// Discs of one colour. Of those that are some pixels wide the lines around them would be all that is seen.
static void draw_disc_paths(const scree_scene_view *view, cairo_t *cairo, size_t from, size_t to, scree_colour colour,
                            scree_colour line)
{
    const bool outlined = 2 * view->mean_radius * view->scale > LEAST_OUTLINED * view->pixel;
    for (size_t begin = from; begin < to; begin += SCREE_SCENE_PATH) {
        for (size_t k = begin; k < to && k < begin + SCREE_SCENE_PATH; k++) add_outline(view, cairo, view->order[k]);
        scree_page_colour(cairo, colour);
        if (outlined) {
            cairo_fill_preserve(cairo);
            scree_page_colour(cairo, line);
            cairo_stroke(cairo);
        } else {
            cairo_fill(cairo);
        }
    }
}

/// A lighter colour; weight 0: the same, 1: white.
static scree_colour lighter(scree_colour colour, double weight)
{
    return (scree_colour){colour.red + weight * (1 - colour.red), colour.green + weight * (1 - colour.green),
                          colour.blue + weight * (1 - colour.blue)};
}

/// Spheres from far to near: a disc with an outline, and two lighter ones towards the light, upper left.
static void draw_spheres(const scree_scene_view *view, cairo_t *cairo)
{
    static const double shade[3][3] = {{1, 0, 0}, {0.68, 0.20, 0.35}, {0.30, 0.38, 0.75}}; // size, offset, weight
    const scree_snapshot *s = view->snapshot;
    double line = fmin(0.5, fmax(0.08, 0.035 * 2 * view->mean_radius * view->scale));
    for (size_t k = 0; k < view->disc_count; k++) {
        uint32_t disc = view->order[k];
        // A membrane is drawn as a net, through which the grains are seen.
        if (s->triangle_count > 0 && !scree_snapshot_is_grain(s, disc)) continue;
        double radius = s->radius[disc] * view->scale;
        double x = scree_scene_x(view, s->x[disc]), y = scree_scene_y(view, s->y[disc]);
        scree_colour colour = scree_scene_disc_colour(view, disc);
        for (int part = 0; part < 3; part++) {
            double shift = shade[part][1] * radius * M_SQRT1_2;
            cairo_new_sub_path(cairo);
            cairo_arc(cairo, x - shift, y - shift, shade[part][0] * radius, 0, 2 * M_PI);
            cairo_close_path(cairo);
            scree_page_colour(cairo, lighter(colour, shade[part][2]));
            if (part > 0) {
                cairo_fill(cairo);
                continue;
            }
            cairo_fill_preserve(cairo);
            cairo_set_line_width(cairo, line);
            scree_page_colour(cairo, scree_scene_ink);
            cairo_stroke(cairo);
        }
    }
}

/// The net of a membrane: the triangles that the viewer sees from inside, behind the grains, or from outside.
static void draw_net(const scree_scene_view *view, cairo_t *cairo, bool outside)
{
    const scree_snapshot *s = view->snapshot;
    for (size_t t = 0; t < s->triangle_count; t++) {
        double x[3], y[3];
        for (int c = 0; c < 3; c++) {
            x[c] = scree_scene_x(view, s->x[s->triangle[t][c]]);
            y[c] = scree_scene_y(view, s->y[s->triangle[t][c]]);
        }
        // Page coordinates grow downwards: counter-clockwise is negative.
        double turn = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        if (!isfinite(turn) || (turn < 0) != outside) continue;
        cairo_new_sub_path(cairo);
        for (int c = 0; c < 3; c++) cairo_line_to(cairo, x[c], y[c]);
        cairo_close_path(cairo);
    }
    scree_colour colour = outside ? scree_scene_ink : scree_scene_quiet;
    cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, outside ? 0.4 : 0.6);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cairo, 0.3);
    cairo_stroke(cairo);
}

/// The bottom (0) or top (1) plate of a view in space.
static void draw_plate_in_space(const scree_scene_view *view, cairo_t *cairo, int which)
{
    const scree_projection *projection = view->scene->projection;
    if (!view->scene->plates || !projection || !projection->has_plate[which]) return;
    for (int c = 0; c < 4; c++) {
        const double *corner = projection->plate[which][c];
        cairo_line_to(cairo, scree_scene_x(view, corner[0]), scree_scene_y(view, corner[1]));
    }
    cairo_close_path(cairo);
    scree_colour colour = scree_scene_quiet;
    cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, which == 1 ? 0.35 : 0.6);
    cairo_fill_preserve(cairo);
    cairo_set_line_width(cairo, 0.8);
    scree_page_colour(cairo, colour);
    cairo_stroke(cairo);
}

static void draw_discs(const scree_scene_view *view, cairo_t *cairo)
{
    const scree_scene *scene = view->scene;
    bool behind = scene->force_network || view->arrow_scale > 0;
    double diameter = 2 * view->mean_radius * view->scale;
    cairo_set_line_width(cairo, fmin(0.5, fmax(0.08, 0.035 * diameter)));
    for (int level = 0; level <= SCREE_SCENE_LEVELS; level++) {
        size_t from = view->start[level], to = view->start[level + 1];
        if (from == to) continue;
        double position = level == SCREE_SCENE_LEVELS ? NAN : (double)level / (SCREE_SCENE_LEVELS - 1);
        scree_colour plain = behind ? (scree_colour){0.955, 0.95, 0.935} : (scree_colour){0.83, 0.86, 0.90};
        draw_disc_paths(view, cairo, from, to, scene->field ? scree_colour_at(scene->map, position) : plain,
                        behind && !scene->field ? (scree_colour){0.80, 0.79, 0.76} : scree_scene_ink);
    }
}

/// Discs of a membrane, dark over their colour.
static void draw_membrane(const scree_scene_view *view, cairo_t *cairo)
{
    const scree_snapshot *s = view->snapshot;
    for (size_t k = 0; k < s->count; k++) {
        if (scree_snapshot_is_grain(s, k)) continue;
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, scree_scene_x(view, s->x[k]), scree_scene_y(view, s->y[k]), s->radius[k] * view->scale, 0,
                  2 * M_PI);
    }
    scree_page_colour(cairo, scree_scene_quiet);
    cairo_fill(cairo);
}

double scree_scene_force_width(const scree_scene_view *view, double ratio)
{
    // In space many lines lie behind one another.
    double diameter = 2 * view->mean_radius * view->scale, slim = view->scene->depth ? 0.4 : 1;
    return fmax(0.1, slim * fmin(ratio, SCREE_SCENE_FORCE_LIMIT) * SCREE_SCENE_FORCE_WIDTH * diameter);
}

/// Where the line of a contact ends: the centre of the other disc (of its image in a periodic cell), or the contact
/// point on a wall. False: not to be drawn.
static bool contact_end(const scree_snapshot *s, size_t k, double *x, double *y)
{
    if (s->first[k] >= s->count || !scree_scene_drawn(s, s->first[k])) return false;
    if (s->second[k] >= SCREE_PRIMITIVE_ID) {
        *x = s->contact_x[k];
        *y = s->contact_y[k];
        return isfinite(*x) && isfinite(*y);
    }
    if (s->second[k] >= s->count || !scree_scene_drawn(s, s->second[k])) return false;
    *x = s->x[s->first[k]] - s->branch_x[k];
    *y = s->y[s->first[k]] - s->branch_y[k];
    return isfinite(*x) && isfinite(*y);
}

static int width_level(const scree_scene_view *view, double force)
{
    double ratio = fabs(force) / view->mean_force / SCREE_SCENE_FORCE_LIMIT;
    return !(ratio > 0) ? -1 : ratio >= 1 ? SCREE_SCENE_LEVELS - 1 : (int)(ratio * (SCREE_SCENE_LEVELS - 1));
}

/// Contacts of one width that push, or pull.
static void draw_level(const scree_scene_view *view, cairo_t *cairo, int level, bool pull)
{
    const scree_snapshot *s = view->snapshot;
    double ratio = (level + 0.5) / (SCREE_SCENE_LEVELS - 1) * SCREE_SCENE_FORCE_LIMIT, x, y;
    cairo_set_line_width(cairo, scree_scene_force_width(view, ratio));
    scree_page_colour(cairo, pull ? scree_scene_pull : ratio < 1 ? scree_scene_weak : scree_scene_strong);
    for (size_t k = 0, lines = 0; k < s->contact_count; k++) {
        const double force = s->normal_force[k];
        if ((force < 0) != pull || width_level(view, force) != level || !contact_end(s, k, &x, &y)) continue;
        cairo_move_to(cairo, scree_scene_x(view, s->x[s->first[k]]), scree_scene_y(view, s->y[s->first[k]]));
        cairo_line_to(cairo, scree_scene_x(view, x), scree_scene_y(view, y));
        if (++lines % SCREE_SCENE_PATH == 0) cairo_stroke(cairo);
    }
    cairo_stroke(cairo);
}

/// Weak contacts (below the mean) first and lighter, then the strong network on top of them; in each width those that
/// pull on top of those that push.
static void draw_network(const scree_scene_view *view, cairo_t *cairo)
{
    if (!view->scene->force_network || view->mean_force <= 0) return;
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    for (int level = 0; level < SCREE_SCENE_LEVELS; level++)
        for (int pull = 0; pull < 2; pull++) draw_level(view, cairo, level, pull);
}

static void draw_boundary(const scree_scene_view *view, cairo_t *cairo)
{
    const scree_snapshot *s = view->snapshot;
    if (!view->scene->boundary || s->loop_count == 0) return;
    for (size_t k = 0; k < s->loop_count; k++)
        if (s->loop[k] < s->count && scree_scene_drawn(s, s->loop[k]))
            cairo_line_to(cairo, scree_scene_x(view, s->x[s->loop[k]]), scree_scene_y(view, s->y[s->loop[k]]));
    cairo_close_path(cairo);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cairo, 1.1);
    scree_page_colour(cairo, scree_scene_boundary);
    cairo_stroke(cairo);
}

/// A plate is a bar on the outer side of the wall's plane, as long as the drawn sample.
static void draw_plates(const scree_scene_view *view, cairo_t *cairo)
{
    double thickness = fmin(6, fmax(2.5, 0.8 * view->mean_radius * view->scale));
    for (int k = 0; view->scene->plates && k < SCREE_WALL_COUNT; k++) {
        const scree_wall *wall = &view->snapshot->wall[k];
        if (!wall->active || !isfinite(wall->position)) continue;
        double nx = wall->normal[0], ny = wall->normal[1];
        double middle_x = (view->low[0] + view->high[0]) / 2, middle_y = (view->low[1] + view->high[1]) / 2;
        double distance = wall->position - nx * middle_x - ny * middle_y;
        double half = (fabs(ny) * (view->high[0] - view->low[0]) + fabs(nx) * (view->high[1] - view->low[1])) / 2;
        double reach = (fabs(nx) * (view->high[0] - view->low[0]) + fabs(ny) * (view->high[1] - view->low[1])) / 2;
        if (fabs(distance) > 1.01 * reach) continue;
        double x = scree_scene_x(view, middle_x + distance * nx) - nx * thickness / 2;
        double y = scree_scene_y(view, middle_y + distance * ny) + ny * thickness / 2;
        cairo_move_to(cairo, x - ny * half * view->scale, y - nx * half * view->scale);
        cairo_line_to(cairo, x + ny * half * view->scale, y + nx * half * view->scale);
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
        cairo_set_line_width(cairo, thickness);
        scree_page_colour(cairo, scree_scene_quiet);
        cairo_stroke(cairo);
    }
}

/// Edges of the periodic cell.
static void draw_periodic_edges(const scree_scene_view *view, cairo_t *cairo)
{
    if (view->periodic.count == 0) return;
    for (size_t k = 0; k < view->periodic.count; k++) {
        const double(*edge)[2] = view->periodic.end[k];
        cairo_move_to(cairo, scree_scene_x(view, edge[0][0]), scree_scene_y(view, edge[0][1]));
        cairo_line_to(cairo, scree_scene_x(view, edge[1][0]), scree_scene_y(view, edge[1][1]));
    }
    cairo_set_dash(cairo, (const double[]){4, 2.5}, 2, 0);
    cairo_set_line_width(cairo, 0.9);
    scree_page_colour(cairo, scree_scene_boundary);
    cairo_stroke(cairo);
    cairo_set_dash(cairo, NULL, 0, 0);
}

void scree_scene_arrow(const scree_scene_view *view, cairo_t *cairo, double x, double y, double dx, double dy)
{
    double length = hypot(dx, dy);
    if (!(length > 0.05)) return;
    double longest = hypot(view->page_width, view->page_height);
    double ex = dx / length, ey = dy / length;
    if (length > longest) length = longest;
    // Where few discs have arrows, these have room.
    const double room = view->arrows > 0 ? sqrt((double)view->disc_count / (double)view->arrows) : 1;
    double shaft = fmin(0.7, fmax(0.3, 0.09 * room * 2 * view->mean_radius * view->scale)) / 2;
    double head = fmin(0.45 * length, 9 * shaft), half = 0.42 * head;
    shaft = fmin(shaft, half / 2);
    const double outline[7][2] = {{0, shaft},  {length - head, shaft}, {length - head, half},
                                  {length, 0}, {length - head, -half}, {length - head, -shaft},
                                  {0, -shaft}};
    for (int k = 0; k < 7; k++) {
        double px = x + outline[k][0] * ex - outline[k][1] * ey, py = y + outline[k][0] * ey + outline[k][1] * ex;
        if (k == 0)
            cairo_move_to(cairo, px, py);
        else
            cairo_line_to(cairo, px, py);
    }
    cairo_close_path(cairo);
}

/// Until cairo_restore nothing is drawn beyond the sample and its overhang.
static void clip_to_sample(const scree_scene_view *view, cairo_t *cairo)
{
    cairo_save(cairo);
    cairo_rectangle(cairo, view->left - 2, view->top - 2, view->width + 4, view->height + 4);
    cairo_clip(cairo);
}

static void draw_arrows(const scree_scene_view *view, cairo_t *cairo)
{
    const scree_scene *scene = view->scene;
    const scree_snapshot *s = view->snapshot;
    if (view->arrow_scale <= 0) return;
    double stretch = view->arrow_scale * view->scale;
    clip_to_sample(view, cairo);
    for (size_t k = 0; k < s->count; k++)
        if (scree_scene_drawn(s, k) && isfinite(scene->arrow_x[k]) && isfinite(scene->arrow_y[k]))
            scree_scene_arrow(view, cairo, scree_scene_x(view, s->x[k]), scree_scene_y(view, s->y[k]),
                              scene->arrow_x[k] * stretch, -scene->arrow_y[k] * stretch);
    scree_page_colour(cairo, scree_scene_strong);
    cairo_fill(cairo);
    cairo_restore(cairo);
}

/// Walls of the case, as far as the page goes.
static void draw_walls(const scree_scene_view *view, cairo_t *cairo)
{
    const scree_snapshot *s = view->snapshot;
    if (s->wall_line_count + s->wall_triangle_count == 0) return;
    clip_to_sample(view, cairo);
    for (size_t k = 0; k < s->wall_line_count; k++) {
        const double *line = &s->wall_line[4 * k];
        cairo_move_to(cairo, scree_scene_x(view, line[0]), scree_scene_y(view, line[1]));
        cairo_line_to(cairo, scree_scene_x(view, line[2]), scree_scene_y(view, line[3]));
    }
    for (size_t k = 0; k < s->wall_triangle_count && s->dimension == 2; k++) {
        const double *corner = &s->wall_triangle[9 * k];
        cairo_move_to(cairo, scree_scene_x(view, corner[0]), scree_scene_y(view, corner[1]));
        cairo_line_to(cairo, scree_scene_x(view, corner[3]), scree_scene_y(view, corner[4]));
    }
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cairo, 1.4);
    scree_page_colour(cairo, scree_scene_quiet);
    cairo_stroke(cairo);
    cairo_restore(cairo);
}

static void draw_marked(const scree_scene_view *view, cairo_t *cairo)
{
    const scree_snapshot *s = view->snapshot;
    if (!view->scene->marked || !scree_scene_drawn(s, *view->scene->marked)) return;
    add_outline(view, cairo, *view->scene->marked);
    cairo_set_source_rgb(cairo, 0, 0, 0);
    cairo_fill(cairo);
}

void scree_scene_marks(const scree_scene_view *view, cairo_t *cairo)
{
    if (view->scene->depth) {
        draw_plate_in_space(view, cairo, 0);
        draw_net(view, cairo, false);
        // The network of the inside would be hidden.
        if (view->scene->force_network)
            draw_network(view, cairo);
        else
            draw_spheres(view, cairo);
        draw_net(view, cairo, true);
        draw_plate_in_space(view, cairo, 1);
        draw_walls(view, cairo);
        draw_periodic_edges(view, cairo);
        return;
    }
    if (view->scene->shown) clip_to_sample(view, cairo);
    draw_plates(view, cairo);
    draw_walls(view, cairo);
    if (view->scene->cells)
        scree_scene_cells(view, cairo);
    else
        draw_discs(view, cairo);
    draw_membrane(view, cairo);
    draw_boundary(view, cairo);
    draw_periodic_edges(view, cairo);
    draw_network(view, cairo);
    draw_marked(view, cairo);
    draw_arrows(view, cairo);
    if (view->scene->shown) cairo_restore(cairo);
}
