/// After Labra and Onate (2009, Commun. Numer. Meth. Engng 25, 837). Unknowns are the centres x, the radii r and the
/// mean overlap m; over the edges of the net (prepare/gap_net.h), the bodies at walls and all bodies
///     1/2 sum w (|x_a - x_b| - r_a - r_b + m)^2 + 1/2 WALL sum w (distance - r)^2 + 1/2 p sum (r - r_0)^2
/// and stiff terms for radii beyond their limits and for what the bodies fill together, is lowered by Levenberg's
/// method: steps from (J^T w J + lambda) step = -gradient by conjugate gradients with the
/// diagonal as preconditioner; the matrix is never made. Between the steps
/// - the net is renewed;
/// - the sizes asked for are dealt out anew: the smallest r_0 of a class goes to its smallest body and so on, so the
///   last sum is the squared Wasserstein distance of the two distributions (their order statistics), and bodies may
///   exchange sizes;
/// - wide gaps lose weight, w = 1/(1 + (gap + m)^2/c^2)^2 (Geman and McClure) for gaps wider than the mean, with c
///   lowered to what a bond may be off: the triangulation has edges across holes, which need not close;
/// - at the end, where two bodies are still pressed into each other, as between others in a corner, the one that is
///   pressed most goes to the widest hole (in space; of 400 spheres one in four packings has such a pair).
/// In the plane edges, walls and the unknown m are as many as unknowns, so but for p all gaps may close (Koebe); in
/// space there are more edges than unknowns.
///
/// All lengths are in mean radii. Sums run in the order of the net: one thread, the same bits anywhere.
/// Cost: some 30 ns an edge for a product, 20 to 60 products a step.
#include "prepare/fit_gaps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 4, MOST_PRODUCTS = 60, TRIALS = 6 };
static const double WALL = 100;      // weight of a gap to a wall
static const double FILLING = 100;   // weight of the squared excess of the mean radius, a body
static const double STIFF = 100;     // weight of a radius beyond its limits
static const double WIDE = 1;        // mean radii: c of the first round
static const double NARROWER = 0.85; // from round to round
static const double EXACT = 1e-2;    // residual of a linear solution
static const double FARTHEST = 0.3;  // mean radii: largest move in a step
static const double SLOW = 0.95;     // ratio of the scatter of two rounds at the end
static const double SETTLED = 1e-3;  // share of bonds that a round may still add at the end
static const double REOPENED = 0.3;  // mean radii: c after a body has been moved into a hole
enum { PATIENCE = 8 };               // rounds between two bodies that are moved into holes

typedef struct fit {
    const scree_gap_task *task;
    scree_gap_bodies *bodies;
    scree_gap_net net;
    size_t unknowns; ///< all of the bodies, then the mean overlap
    double overlap, lambda;
    double *weight;      ///< of edges, then of touches
    double (*normal)[3]; ///< of edges
    double *target;      ///< radius of each body
    double *gradient, *diagonal, *step, *residual, *direction, *product, *trial;
} fit;

// ---- sizes -------------------------------------------------------------------------------------------------------

/// What qsort is told by: a body and its size.
typedef struct sized {
    double radius;
    uint32_t body;
    uint8_t class_of;
} sized;

static int compare(const void *a, const void *b)
{
    const sized *p = a, *q = b;
    if (p->class_of != q->class_of) return p->class_of < q->class_of ? -1 : 1;
    if (p->radius != q->radius) return p->radius < q->radius ? -1 : 1;
    return p->body < q->body ? -1 : p->body > q->body;
}

static size_t width_of(const scree_gap_bodies *b)
{
    return (size_t)b->dimension + 1;
}

static double *radius_of(const scree_gap_bodies *b, size_t body)
{
    return &b->at[body * width_of(b) + (size_t)b->dimension];
}

/// The smallest to the smallest.
static scree_status deal_sizes(const scree_gap_sizes *sizes, const scree_gap_bodies *b, double *target,
                               scree_error *error)
{
    sized *list;
    scree_status status = scree_allocate(&list, b->count, sizeof *list, error);
    if (status) return status;
    for (size_t i = 0; i < b->count; i++) list[i] = (sized){*radius_of(b, i), (uint32_t)i, sizes->class_of[i]};
    qsort(list, b->count, sizeof *list, compare);
    for (size_t k = 0; k < b->count; k++) target[list[k].body] = sizes->radius[k];
    scree_release(&list);
    return SCREE_OK;
}

// ---- the sum of squares ------------------------------------------------------------------------------------------

static double solid_of(const scree_gap_bodies *b)
{
    double sum = 0;
    for (size_t i = 0; i < b->count; i++) {
        const double r = *radius_of(b, i);
        sum += b->dimension == 3 ? 4 * M_PI / 3 * r * r * r : M_PI * r * r;
    }
    return sum;
}

/// What radii have too much in the mean for the bodies to fill what they shall.
static double excess_of(const fit *f)
{
    return (solid_of(f->bodies) / f->task->solid - 1) / f->bodies->dimension;
}

/// Derivative of the excess by the radius of a body.
static double excess_by(const fit *f, size_t body)
{
    const double r = *radius_of(f->bodies, body);
    return (f->bodies->dimension == 3 ? 4 * M_PI * r * r : 2 * M_PI * r) / f->task->solid / f->bodies->dimension;
}

/// By how much a radius is above or below its limits.
static double beyond_of(const fit *f, size_t body)
{
    const double r = *radius_of(f->bodies, body);
    const uint8_t c = f->task->sizes.class_of[body];
    return r - fmin(fmax(r, f->task->sizes.least[c]), f->task->sizes.most[c]);
}

static double cost_of(const fit *f, double overlap)
{
    const scree_gap_bodies *b = f->bodies;
    const scree_gap_net *net = &f->net;
    double sum = 0, normal[3];
    for (size_t e = 0; e < net->edge_count; e++) {
        const double off = scree_gap_of_edge(b, &net->edge[e], normal) + overlap;
        sum += f->weight[e] * off * off;
    }
    for (size_t t = 0; t < net->touch_count; t++) {
        const double off = scree_gap_of_touch(b, &net->touch[t]);
        sum += f->weight[net->edge_count + t] * off * off;
    }
    for (size_t i = 0; i < b->count; i++) {
        const double off = *radius_of(b, i) - f->target[i];
        const double beyond = beyond_of(f, i);
        sum += f->task->penalty * off * off + STIFF * beyond * beyond;
    }
    const double excess = excess_of(f);
    return (sum + FILLING * (double)b->count * excess * excess) / 2;
}

/// y += factor x of what an edge, or a touch, asks of the unknowns: x is J v or a residual.
static void spread_edge(const fit *f, size_t e, double x, double *y)
{
    const scree_gap_edge *edge = &f->net.edge[e];
    const int d = f->bodies->dimension;
    double *a = y + edge->first * width_of(f->bodies), *b = y + edge->second * width_of(f->bodies);
    for (int k = 0; k < d; k++) {
        a[k] += x * f->normal[e][k];
        b[k] -= x * f->normal[e][k];
    }
    a[d] -= x;
    b[d] -= x;
    y[f->unknowns - 1] += x;
}

static void spread_touch(const fit *f, size_t t, double x, double *y)
{
    const scree_gap_touch *touch = &f->net.touch[t];
    double *a = y + touch->body * width_of(f->bodies);
    a[touch->wall / 2] += touch->wall % 2 ? -x : x;
    a[f->bodies->dimension] -= x;
}

/// Weights of the edges and touches by their gaps.
static void weigh(fit *f, double wide)
{
    double normal[3];
    const scree_gap_net *net = &f->net;
    for (size_t k = 0; k < net->edge_count + net->touch_count; k++) {
        const bool edge = k < net->edge_count;
        const double off = edge ? scree_gap_of_edge(f->bodies, &net->edge[k], normal) + f->overlap
                                : scree_gap_of_touch(f->bodies, &net->touch[k - net->edge_count]);
        const double share = off > 0 ? 1 / (1 + off * off / (wide * wide)) : 1;
        f->weight[k] = (edge ? 1 : WALL) * share * share;
    }
}

/// Gradient and diagonal at the present place.
static void linearise(fit *f)
{
    const scree_gap_bodies *b = f->bodies;
    const scree_gap_net *net = &f->net;
    const size_t width = width_of(b), d = width - 1;
    const double filling = FILLING * (double)b->count, excess = excess_of(f);
    memset(f->gradient, 0, f->unknowns * sizeof *f->gradient);
    memset(f->diagonal, 0, f->unknowns * sizeof *f->diagonal);
    for (size_t e = 0; e < net->edge_count; e++) {
        const double off = scree_gap_of_edge(b, &net->edge[e], f->normal[e]) + f->overlap, w = f->weight[e];
        double *p = f->diagonal + net->edge[e].first * width, *q = f->diagonal + net->edge[e].second * width;
        spread_edge(f, e, w * off, f->gradient);
        for (size_t k = 0; k < d; k++) {
            p[k] += w * f->normal[e][k] * f->normal[e][k];
            q[k] += w * f->normal[e][k] * f->normal[e][k];
        }
        p[d] += w;
        q[d] += w;
        f->diagonal[f->unknowns - 1] += w;
    }
    for (size_t t = 0; t < net->touch_count; t++) {
        const double w = f->weight[net->edge_count + t];
        double *p = f->diagonal + net->touch[t].body * width;
        spread_touch(f, t, w * scree_gap_of_touch(b, &net->touch[t]), f->gradient);
        p[net->touch[t].wall / 2] += w;
        p[d] += w;
    }
    for (size_t i = 0; i < b->count; i++) {
        const double by = excess_by(f, i), beyond = beyond_of(f, i);
        f->gradient[i * width + d] +=
            f->task->penalty * (*radius_of(b, i) - f->target[i]) + STIFF * beyond + filling * excess * by;
        f->diagonal[i * width + d] += f->task->penalty + (beyond != 0 ? STIFF : 0) + filling * by * by;
    }
}

/// y = (J^T w J + lambda) v.
static void multiply(const fit *f, const double *v, double *y)
{
    const scree_gap_bodies *b = f->bodies;
    const scree_gap_net *net = &f->net;
    const size_t width = width_of(b), d = width - 1;
    for (size_t i = 0; i < f->unknowns; i++) y[i] = f->lambda * v[i];
    double excess = 0;
    for (size_t i = 0; i < b->count; i++) excess += excess_by(f, i) * v[i * width + d];
    for (size_t i = 0; i < b->count; i++)
        y[i * width + d] += (f->task->penalty + (beyond_of(f, i) != 0 ? STIFF : 0)) * v[i * width + d] +
                            FILLING * (double)b->count * excess * excess_by(f, i);
    for (size_t e = 0; e < net->edge_count; e++) {
        const double *p = v + net->edge[e].first * width, *q = v + net->edge[e].second * width;
        double change = v[f->unknowns - 1] - p[d] - q[d];
        for (size_t k = 0; k < d; k++) change += f->normal[e][k] * (p[k] - q[k]);
        spread_edge(f, e, f->weight[e] * change, y);
    }
    for (size_t t = 0; t < net->touch_count; t++) {
        const scree_gap_touch *touch = &net->touch[t];
        const double *p = v + touch->body * width, along = p[touch->wall / 2];
        const double change = (touch->wall % 2 ? -along : along) - p[d];
        spread_touch(f, t, f->weight[net->edge_count + t] * change, y);
    }
}

// ---- a step ------------------------------------------------------------------------------------------------------

static double dot(const double *a, const double *b, size_t count)
{
    double sum = 0;
    for (size_t k = 0; k < count; k++) sum += a[k] * b[k];
    return sum;
}

/// residual over the diagonal, into product; returns their product.
static double precondition(const fit *f)
{
    for (size_t k = 0; k < f->unknowns; k++) f->product[k] = f->residual[k] / (f->diagonal[k] + f->lambda);
    return dot(f->residual, f->product, f->unknowns);
}

/// Conjugate gradients for the step.
static void solve(fit *f)
{
    const size_t n = f->unknowns;
    memset(f->step, 0, n * sizeof *f->step);
    for (size_t k = 0; k < n; k++) f->residual[k] = -f->gradient[k];
    double size = precondition(f);
    const double first = size;
    memcpy(f->direction, f->product, n * sizeof *f->direction);
    for (int i = 0; i < MOST_PRODUCTS && size > EXACT * EXACT * first; i++) {
        multiply(f, f->direction, f->product);
        const double length = size / dot(f->direction, f->product, n);
        for (size_t k = 0; k < n; k++) {
            f->step[k] += length * f->direction[k];
            f->residual[k] -= length * f->product[k];
        }
        const double next = precondition(f);
        for (size_t k = 0; k < n; k++) f->direction[k] = f->product[k] + next / size * f->direction[k];
        size = next;
    }
}

/// Goes the step, not too far, with radii kept within their limits.
static void move(fit *f)
{
    scree_gap_bodies *b = f->bodies;
    const size_t width = width_of(b), d = width - 1;
    for (size_t i = 0; i < b->count; i++) {
        double far = 0, *at = b->at + i * width;
        for (size_t k = 0; k < width; k++) far = fmax(far, fabs(f->step[i * width + k]));
        const double share = far > FARTHEST ? FARTHEST / far : 1;
        for (size_t k = 0; k < width; k++) at[k] += share * f->step[i * width + k];
        for (size_t k = 0; k < d; k++) {
            if (!(b->periodic >> k & 1)) at[k] = fmin(fmax(at[k], 0), b->side[k]);
        }
    }
    f->overlap += f->step[f->unknowns - 1];
}

/// A step of Levenberg's method: lambda grows until the sum falls.
static void take_step(fit *f)
{
    scree_gap_bodies *b = f->bodies;
    const size_t bytes = b->count * width_of(b) * sizeof *b->at;
    const double before = cost_of(f, f->overlap), overlap = f->overlap;
    memcpy(f->trial, b->at, bytes);
    linearise(f);
    for (int trial = 0; trial < TRIALS; trial++) {
        solve(f);
        move(f);
        if (cost_of(f, f->overlap) < before) {
            f->lambda = fmax(f->lambda / 4, 1e-9);
            return;
        }
        memcpy(b->at, f->trial, bytes);
        f->overlap = overlap;
        f->lambda *= 8;
    }
}

// ---- rounds ------------------------------------------------------------------------------------------------------

static void destroy_fit(fit *f)
{
    scree_gap_net_destroy(&f->net);
    scree_release(&f->weight);
    scree_release(&f->normal);
    scree_release(&f->target);
    scree_release(&f->gradient);
    scree_release(&f->diagonal);
    scree_release(&f->step);
    scree_release(&f->residual);
    scree_release(&f->direction);
    scree_release(&f->product);
    scree_release(&f->trial);
}

static scree_status create_fit(fit *f, scree_error *error)
{
    double **const of_unknowns[] = {&f->gradient,  &f->diagonal, &f->step, &f->residual,
                                    &f->direction, &f->product,  &f->trial};
    scree_status status = scree_allocate(&f->target, f->bodies->count, sizeof *f->target, error);
    for (size_t k = 0; k < sizeof of_unknowns / sizeof *of_unknowns && !status; k++)
        status = scree_allocate(of_unknowns[k], f->unknowns, sizeof **of_unknowns[k], error);
    return status;
}

/// Bodies that left through a periodic face come in on the other side.
static void wrap(scree_gap_bodies *b)
{
    for (size_t i = 0; i < b->count; i++)
        for (int k = 0; k < b->dimension; k++) {
            double *at = &b->at[i * width_of(b) + (size_t)k];
            if (b->periodic >> k & 1) *at -= b->side[k] * floor(*at / b->side[k]);
        }
}

/// A new net with its weights, and sizes dealt out.
static scree_status renew(fit *f, double wide, scree_error *error)
{
    scree_gap_net_destroy(&f->net);
    scree_release(&f->weight);
    scree_release(&f->normal);
    wrap(f->bodies);
    scree_status status = scree_gap_net_build(f->bodies, &f->net, error);
    const size_t edges = f->net.edge_count;
    if (!status) status = scree_allocate(&f->weight, edges + f->net.touch_count, sizeof *f->weight, error);
    if (!status) status = scree_allocate(&f->normal, edges, sizeof *f->normal, error);
    if (!status) status = deal_sizes(&f->task->sizes, f->bodies, f->target, error);
    if (!status) weigh(f, wide);
    return status;
}

/// Those at a wall touch it, none reaches into it.
static void set_to_walls(fit *f, double farthest)
{
    scree_gap_bodies *b = f->bodies;
    for (size_t t = 0; t < f->net.touch_count; t++) {
        const scree_gap_touch *touch = &f->net.touch[t];
        const int axis = touch->wall / 2;
        double *at = &b->at[touch->body * width_of(b)], radius = at[b->dimension];
        if (scree_gap_of_touch(b, touch) > farthest) continue;
        at[axis] = touch->wall % 2 ? b->side[axis] - radius : radius;
    }
    for (size_t i = 0; i < b->count; i++)
        for (int k = 0; k < b->dimension; k++) {
            double *at = &b->at[i * width_of(b)], radius = at[b->dimension];
            if (b->periodic >> k & 1) continue;
            at[k] = fmin(fmax(at[k], radius), b->side[k] - radius);
        }
}

/// All radii by the same factor, until the bodies fill what they shall.
static void set_solid(fit *f)
{
    scree_gap_bodies *b = f->bodies;
    enum { PASSES = 3 }; // limits of radii may hold some back
    for (int pass = 0; pass < PASSES; pass++) {
        const double ratio = f->task->solid / solid_of(b), factor = b->dimension == 3 ? cbrt(ratio) : sqrt(ratio);
        for (size_t i = 0; i < b->count; i++) {
            const uint8_t c = f->task->sizes.class_of[i];
            double *radius = radius_of(b, i);
            *radius = fmin(fmax(*radius * factor, f->task->sizes.least[c]), f->task->sizes.most[c]);
        }
    }
}

/// Of the pairs that are pressed into each other deeper than a bond may be, the body with most of it; count: there is
/// none.
static size_t most_pressed(fit *f, double farthest)
{
    const size_t count = f->bodies->count;
    double normal[3], *pressed = f->trial;
    size_t most = count;
    memset(pressed, 0, count * sizeof *pressed);
    for (size_t e = 0; e < f->net.edge_count; e++) {
        const scree_gap_edge *edge = &f->net.edge[e];
        const double off = scree_gap_of_edge(f->bodies, edge, normal) + f->overlap;
        if (off >= -farthest) continue;
        pressed[edge->first] -= off;
        pressed[edge->second] -= off;
    }
    for (size_t i = 0; i < count; i++)
        if (pressed[i] > (most < count ? pressed[most] : 0)) most = i;
    return most;
}

/// Puts it into the widest hole, as large as fits between bodies of the mean size; false: none is pressed.
static bool move_to_hole(fit *f, double farthest)
{
    scree_gap_bodies *b = f->bodies;
    const size_t body = most_pressed(f, farthest);
    if (body == b->count || !(f->net.hole.power > 0)) return false;
    const uint8_t c = f->task->sizes.class_of[body];
    memcpy(&b->at[body * width_of(b)], f->net.hole.centre, (size_t)b->dimension * sizeof *b->at);
    *radius_of(b, body) = fmin(fmax(sqrt(f->net.hole.power + 1) - 1, f->task->sizes.least[c]), f->task->sizes.most[c]);
    return true;
}

/// Nothing is left to do: gaps have been weighed to the end, scatter as little as they may, and no more of them close.
static bool is_done(const fit *f, double wide, const scree_gap_report *before, const scree_gap_report *report)
{
    const double farthest = SCREE_GAP_FARTHEST * f->task->tolerance;
    return wide <= farthest && scree_gap_report_meets(report, f->task->tolerance) &&
           (double)report->bonds <= (1 + SETTLED) * (double)before->bonds && report->scatter >= SLOW * before->scatter;
}

scree_status scree_gaps_fit(const scree_gap_task *task, scree_gap_bodies *bodies, scree_gap_report *report,
                            scree_error *error)
{
    const double farthest = SCREE_GAP_FARTHEST * task->tolerance;
    fit f = {.task = task, .bodies = bodies, .unknowns = bodies->count * width_of(bodies) + 1, .lambda = 1e-2};
    double wide = WIDE;
    bool done = false;
    int64_t narrow = 0; // rounds since gaps have been weighed to the end
    scree_status status = create_fit(&f, error);
    *report = (scree_gap_report){0};
    for (int64_t round = 0; round < task->rounds && !status && !done; round++) {
        const scree_gap_report before = *report;
        status = renew(&f, wide, error);
        for (int step = 0; step < STEPS && !status; step++) take_step(&f);
        if (!status) scree_gap_report_of_net(bodies, &f.net, f.overlap, task->tolerance, report);
        if (!status) done = is_done(&f, wide, &before, report);
        narrow = wide <= farthest ? narrow + 1 : 0;
        wide = fmax(wide * NARROWER, farthest);
        if (!status && !done && narrow % PATIENCE == PATIENCE - 1 && move_to_hole(&f, farthest)) wide = REOPENED;
    }
    if (!status) {
        set_solid(&f);
        set_to_walls(&f, farthest);
    }
    if (!status) status = renew(&f, wide, error);
    if (!status) scree_gap_report_of_net(bodies, &f.net, f.overlap, task->tolerance, report);
    destroy_fit(&f);
    return status;
}
