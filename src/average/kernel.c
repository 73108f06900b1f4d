/// Coarse graining with a polynomial kernel.
#include "average/kernel.h"

#include "base/thread_pool.h"

#include <math.h>

void scree_average_kernel_destroy(scree_average_kernel *k)
{
    double **const arrays[] = {&k->density, &k->fraction, &k->momentum,  &k->motion,
                               &k->stress,  &k->boundary, &k->resultant, &k->divergence};
    for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++) scree_release(arrays[a]);
}

static double constant(int dimension, double width)
{
    return dimension == 2 ? 4 / (M_PI * width * width) : 315 / (64 * M_PI * width * width * width);
}

void scree_average_kernel_kinetic(const scree_average_kernel *kernel, size_t point, double stress[9])
{
    const size_t d = (size_t)kernel->dimension;
    const double *p = kernel->momentum + d * point, *motion = kernel->motion + d * d * point;
    for (size_t a = 0; a < d * d; a++)
        stress[a] = kernel->density[point] > 0 ? p[a / d] * p[a % d] / kernel->density[point] - motion[a] : 0;
}

double scree_average_kernel_value(int dimension, double width, const double away[3])
{
    const double rest = 1 - scree_dot(away, away) / (width * width);
    return rest > 0 ? constant(dimension, width) * rest * rest * rest : 0;
}

/// What one thread works on: its slab of points along the last axis.
typedef struct slab {
    const scree_average_sample *sample;
    scree_average_kernel *kernel;
    const scree_vector *force; ///< N, of contacts and weight on each body
    size_t from, to;           ///< of the points along the last axis
} slab;

/// The points within a box.
typedef struct range {
    size_t from[3], to[3]; ///< to: one behind
} range;

/// Points that lie within the width of a box from low to high and in the slab; false: none.
static bool find_range(const slab *s, const double low[3], const double high[3], range *r)
{
    const scree_average_points *points = &s->kernel->points;
    const int last = s->kernel->dimension - 1;
    for (int k = 0; k < 3; k++) {
        const double first = ceil((low[k] - s->kernel->width - points->first[k]) / points->gap[k]);
        const double end = floor((high[k] + s->kernel->width - points->first[k]) / points->gap[k]) + 1;
        const double least = k == last ? (double)s->from : 0;
        const double most = k == last ? (double)s->to : (double)points->number[k];
        if (k > last) {
            r->from[k] = 0;
            r->to[k] = 1;
            continue;
        }
        if (!(fmax(first, least) < fmin(end, most))) return false;
        r->from[k] = (size_t)fmax(first, least);
        r->to[k] = (size_t)fmin(end, most);
    }
    return true;
}

static size_t place_of(const scree_average_kernel *kernel, size_t i, size_t j, size_t k)
{
    return (k * kernel->points.number[1] + j) * kernel->points.number[0] + i;
}

static void point_at(const scree_average_points *points, size_t i, size_t j, size_t k, double place[3])
{
    place[0] = points->first[0] + (double)i * points->gap[0];
    place[1] = points->first[1] + (double)j * points->gap[1];
    place[2] = points->first[2] + (double)k * points->gap[2];
}

// ---- grains and forces of the outside ----------------------------------------------------------------------------

/// Adds a number times phi to the fields of all points near a place.
typedef void spread(const slab *s, size_t point, double phi, const void *what);

static void spread_about(const slab *s, const double centre[3], spread *add, const void *what)
{
    range r;
    if (!find_range(s, centre, centre, &r)) return;
    for (size_t k = r.from[2]; k < r.to[2]; k++)
        for (size_t j = r.from[1]; j < r.to[1]; j++)
            for (size_t i = r.from[0]; i < r.to[0]; i++) {
                double place[3], away[3];
                point_at(&s->kernel->points, i, j, k, place);
                scree_subtract(place, centre, away);
                if (s->kernel->dimension == 2) away[2] = 0;
                const double phi = scree_average_kernel_value(s->kernel->dimension, s->kernel->width, away);
                if (phi > 0) add(s, place_of(s->kernel, i, j, k), phi / s->sample->thickness, what);
            }
}

static void spread_grain(const slab *s, size_t point, double phi, const void *what)
{
    const size_t p = *(const size_t *)what, d = (size_t)s->kernel->dimension;
    const scree_average_grain *grain = &s->sample->grain[p];
    s->kernel->density[point] += grain->mass * phi;
    s->kernel->fraction[point] += grain->volume * s->sample->thickness * phi;
    for (size_t a = 0; a < d; a++) {
        s->kernel->momentum[d * point + a] += grain->mass * grain->velocity[a] * phi;
        for (size_t b = 0; b < d; b++)
            s->kernel->motion[d * (d * point + a) + b] += grain->mass * grain->velocity[a] * grain->velocity[b] * phi;
        if (s->kernel->resultant) s->kernel->resultant[d * point + a] += s->force[p][a] * phi;
    }
}

static void spread_force(const slab *s, size_t point, double phi, const void *what)
{
    const double *force = what;
    const size_t d = (size_t)s->kernel->dimension;
    for (size_t a = 0; a < d; a++) s->kernel->boundary[d * point + a] += force[a] * phi;
}

// ---- branches ----------------------------------------------------------------------------------------------------

typedef struct branch {
    double begin[3], way[3], force[3]; ///< from the begin on; the force acts at the end
    double square;                     ///< m2, of the way
} branch;

/// Integrals over s of phi, and of way . grad phi, at `away` from the begin of the branch.
static bool integrate(const branch *b, double width, const double away[3], double *phi, double *slope)
{
    static const double node[2] = {0.339981043584856265, 0.861136311594052575};
    static const double weight[2] = {0.652145154862546143, 0.347854845137453857};
    const double along = scree_dot(away, b->way), outside = scree_dot(away, away) - width * width;
    const double root = along * along - b->square * outside, part = 1 / (width * width);
    if (root <= 0) return false;
    const double from = fmax(0, (along - sqrt(root)) / b->square), to = fmin(1, (along + sqrt(root)) / b->square);
    if (!(to > from)) return false;
    double sum = 0, change = 0;
    for (int k = 0; k < 4; k++) {
        const double s = 0.5 * (from + to) + 0.5 * (to - from) * (k < 2 ? node[k] : -node[k - 2]);
        const double rest = -(outside - 2 * s * along + s * s * b->square) * part;
        sum += weight[k % 2] * rest * rest * rest;
        change += weight[k % 2] * rest * rest * (along - s * b->square);
    }
    *phi = 0.5 * (to - from) * sum;
    *slope = 0.5 * (to - from) * -6 * part * change;
    return true;
}

static void add_branch(const slab *s, const branch *b)
{
    scree_average_kernel *kernel = s->kernel;
    const size_t d = (size_t)kernel->dimension;
    const double factor = constant(kernel->dimension, kernel->width) / s->sample->thickness;
    double low[3], high[3], product[9], phi, slope;
    range r;
    for (int k = 0; k < 3; k++) {
        low[k] = fmin(b->begin[k], b->begin[k] + b->way[k]);
        high[k] = fmax(b->begin[k], b->begin[k] + b->way[k]);
    }
    if (!(b->square > 0) || !find_range(s, low, high, &r)) return;
    for (size_t a = 0; a < d * d; a++) product[a] = -factor * b->force[a / d] * b->way[a % d];
    for (size_t k = r.from[2]; k < r.to[2]; k++)
        for (size_t j = r.from[1]; j < r.to[1]; j++)
            for (size_t i = r.from[0]; i < r.to[0]; i++) {
                double away[3];
                point_at(&kernel->points, i, j, k, away);
                for (int a = 0; a < 3; a++) away[a] -= b->begin[a];
                if (d == 2) away[2] = 0;
                if (!integrate(b, kernel->width, away, &phi, &slope)) continue;
                const size_t point = place_of(kernel, i, j, k);
                for (size_t a = 0; a < d * d; a++) kernel->stress[d * d * point + a] += product[a] * phi;
                for (size_t a = 0; kernel->divergence && a < d; a++)
                    kernel->divergence[d * point + a] -= factor * b->force[a] * slope;
            }
}

/// Between two grains the branch joins their centres, else it begins at the point of contact.
static void add_contact(const slab *s, const scree_average_contact *contact)
{
    const scree_average_grain *grain = s->sample->grain;
    const bool first = grain[contact->first].counted;
    const bool second = contact->second != SCREE_AVERAGE_OUTSIDE && grain[contact->second].counted;
    scree_vector end = {0};
    branch b = {0};
    if (!first && !second) return;
    for (int k = 0; k < 3; k++) {
        const double x = grain[contact->first].position[k];
        end[k] = first ? x : x - contact->branch[k];
        b.begin[k] = first && second ? x - contact->branch[k] : contact->point[k];
        b.force[k] = first ? contact->force[k] : -contact->force[k];
        b.way[k] = end[k] - b.begin[k];
    }
    if (s->kernel->dimension == 2) b.way[2] = b.begin[2] = 0;
    b.square = scree_dot(b.way, b.way);
    add_branch(s, &b);
    if (!first || !second) spread_about(s, b.begin, spread_force, b.force);
}

// ---- the whole ---------------------------------------------------------------------------------------------------

static void fill_slab(void *argument, int index, int count)
{
    slab s = *(const slab *)argument;
    const size_t layers = s.kernel->points.number[s.kernel->dimension - 1];
    s.from = scree_thread_pool_begin(layers, index, count);
    s.to = scree_thread_pool_begin(layers, index + 1, count);
    for (size_t p = 0; p < s.sample->count; p++)
        if (s.sample->grain[p].counted) spread_about(&s, s.sample->grain[p].position, spread_grain, &p);
    for (size_t c = 0; c < s.sample->contact_count; c++) add_contact(&s, &s.sample->contact[c]);
}

/// Sum of the contact forces and the weight of each body.
static void find_forces(const scree_average_sample *sample, scree_vector *force)
{
    for (size_t p = 0; p < sample->bodies; p++)
        scree_along((scree_vector){0}, sample->grain[p].mass, sample->gravity, force[p]);
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        scree_along(force[contact->first], 1, contact->force, force[contact->first]);
        if (contact->second == SCREE_AVERAGE_OUTSIDE) continue;
        scree_along(force[contact->second], -1, contact->force, force[contact->second]);
    }
    // An image exerts and bears what its body does.
    for (size_t p = sample->bodies; p < sample->count; p++)
        for (int k = 0; k < 3; k++) force[p][k] = force[sample->grain[p].body][k];
}

static scree_status make_room(bool check, scree_average_kernel *k, scree_error *error)
{
    const size_t n = k->count, d = (size_t)k->dimension;
    scree_status status = scree_allocate(&k->density, n, sizeof(double), error);
    if (!status) status = scree_allocate(&k->fraction, n, sizeof(double), error);
    if (!status) status = scree_allocate(&k->momentum, n * d, sizeof(double), error);
    if (!status) status = scree_allocate(&k->motion, n * d * d, sizeof(double), error);
    if (!status) status = scree_allocate(&k->stress, n * d * d, sizeof(double), error);
    if (!status) status = scree_allocate(&k->boundary, n * d, sizeof(double), error);
    if (!status && check) status = scree_allocate(&k->resultant, n * d, sizeof(double), error);
    if (!status && check) status = scree_allocate(&k->divergence, n * d, sizeof(double), error);
    return status;
}

scree_status scree_average_kernel_find(const scree_average_sample *sample, double width,
                                       const scree_average_points *points, bool check, int threads,
                                       scree_average_kernel *kernel, scree_error *error)
{
    scree_thread_pool *pool = NULL;
    scree_vector *force;
    *kernel = (scree_average_kernel){.dimension = sample->dimension,
                                     .width = width,
                                     .points = *points,
                                     .count = points->number[0] * points->number[1] * points->number[2]};
    scree_status status = scree_allocate(&force, sample->count, sizeof *force, error);
    if (!status) status = make_room(check, kernel, error);
    if (!status) {
        slab whole = {.sample = sample, .kernel = kernel, .force = (const scree_vector *)force};
        find_forces(sample, force);
        scree_thread_pool_run(&pool, threads < 1 ? 1 : threads, fill_slab, &whole);
        scree_thread_pool_destroy(&pool);
    }
    scree_release(&force);
    if (status) scree_average_kernel_destroy(kernel);
    return status;
}

/// Squares of |div stress + boundary + density g - resultant| at a point, and of the same without the resultant.
static void find_squares(const scree_average_sample *sample, const scree_average_kernel *kernel, size_t point,
                         double *off, double *rest)
{
    const size_t d = (size_t)kernel->dimension;
    *off = *rest = 0;
    for (size_t a = 0; a < d; a++) {
        const double left = kernel->divergence[d * point + a], outer = kernel->boundary[d * point + a];
        const double sum = left + outer + kernel->density[point] * sample->gravity[a];
        const double wrong = sum - kernel->resultant[d * point + a];
        *rest += sum * sum;
        *off += wrong * wrong;
    }
}

double scree_average_kernel_residual(const scree_average_sample *sample, const scree_average_kernel *kernel,
                                     size_t point)
{
    double off, rest;
    find_squares(sample, kernel, point, &off, &rest);
    return sqrt(off);
}

scree_average_balance scree_average_kernel_balance(const scree_average_sample *sample,
                                                   const scree_average_kernel *kernel)
{
    const size_t d = (size_t)kernel->dimension;
    const double g = scree_length(sample->gravity);
    scree_average_balance balance = {0};
    for (size_t point = 0; point < kernel->count; point++) {
        double rest, off;
        find_squares(sample, kernel, point, &off, &rest);
        for (size_t a = 0; a < d && g == 0; a++)
            balance.scale = fmax(balance.scale,
                                 fmax(fabs(kernel->divergence[d * point + a]), fabs(kernel->boundary[d * point + a])));
        if (g > 0) balance.scale = fmax(balance.scale, g * kernel->density[point]);
        balance.rest += rest;
        balance.residual = fmax(balance.residual, sqrt(off));
    }
    balance.rest = sqrt(balance.rest / (double)kernel->count);
    return balance;
}
