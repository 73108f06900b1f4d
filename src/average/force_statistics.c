/// Forces by number.
#include "average/force_statistics.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

enum { LINEAR = 32, DECADES = 4, OF_DECADE = 10, FRICTION = 40, SECTORS = 36, BANDS = 18 };

#define LINEAR_WIDTH 0.25 /* of the mean force */
#define STRONG       3.0  /* over the mean */
#define LOG_FIRST    -3.0 /* power of ten at which logarithmic bins begin */

// ---- forces ------------------------------------------------------------------------------------------------------

/// Forces of a kind over their mean.
typedef struct forces {
    double *n, mean;
    size_t count;
} forces;

static void normalise(forces *f)
{
    double sum = 0;
    for (size_t k = 0; k < f->count; k++) sum += f->n[k];
    f->mean = f->count > 0 ? sum / (double)f->count : NAN;
    for (size_t k = 0; k < f->count; k++) f->n[k] /= f->mean;
}

static scree_status find_normal_forces(const scree_average_sample *sample, forces *f, scree_error *error)
{
    *f = (forces){0};
    scree_status status = scree_allocate(&f->n, sample->contacts, sizeof *f->n, error);
    for (size_t c = 0; c < sample->contacts && !status; c++)
        if (sample->contact[c].normal_force > 0) f->n[f->count++] = sample->contact[c].normal_force;
    normalise(f);
    return status;
}

/// Vertical forces of what lies below, grain by grain.
static scree_status find_bottom_forces(const scree_average_sample *sample, forces *f, scree_error *error)
{
    const int up = sample->dimension - 1;
    double *force;
    *f = (forces){0};
    scree_status status = scree_allocate(&f->n, sample->bodies, sizeof *f->n, error);
    if (status) return status;
    force = f->n;
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        const bool first = sample->grain[contact->first].counted;
        const bool second = contact->second != SCREE_AVERAGE_OUTSIDE && sample->grain[contact->second].counted;
        if (first == second || (first ? 1 : -1) * contact->normal[up] < 0.7) continue;
        force[first ? contact->first : contact->second] += (first ? 1 : -1) * contact->force[up];
    }
    for (size_t p = 0; p < sample->bodies; p++)
        if (force[p] > 0) f->n[f->count++] = force[p];
    normalise(f);
    return status;
}

scree_average_decay scree_average_decay_fit(const double *force, size_t count)
{
    scree_average_decay decay = {NAN, NAN, NAN, 0};
    double mean = 0, sum = 0;
    for (size_t k = 0; k < count; k++) mean += force[k] / (double)count;
    for (size_t k = 0; k < count; k++) {
        if (!(force[k] > mean)) continue;
        sum += force[k] / mean - 1;
        decay.count++;
    }
    const double k = (double)decay.count;
    if (decay.count < 2 || !(sum > 0)) return decay;
    decay.rate = k / sum;
    decay.low = gsl_cdf_chisq_Pinv(0.025, 2 * k) / (2 * sum);
    decay.high = gsl_cdf_chisq_Pinv(0.975, 2 * k) / (2 * sum);
    return decay;
}

static void tell_friction(const scree_average_sample *sample, scree_average_sink *sink, void *user)
{
    double sliding = 0, mobilised = 0, pressing = 0;
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        sliding += contact->sliding;
        if (!(contact->normal_force > 0)) continue;
        mobilised += fabs(contact->tangential_force) / contact->normal_force;
        pressing++;
    }
    sink(user, "sliding_share", "1", sliding / (double)sample->contacts);
    sink(user, "mobilised_friction", "1", mobilised / pressing);
}

/// Share of the forces from `from` to below `to`, over their mean.
static double share(const forces *f, double from, double to)
{
    double number = 0;
    for (size_t k = 0; k < f->count; k++) number += f->n[k] >= from && f->n[k] < to;
    return number / (double)f->count;
}

scree_status scree_average_forces_tell(const scree_average_sample *sample, scree_average_sink *sink, void *user,
                                       scree_error *error)
{
    forces all, bottom;
    scree_status status = find_normal_forces(sample, &all, error), second = find_bottom_forces(sample, &bottom, error);
    if (!status && !second) {
        const scree_average_decay a = scree_average_decay_fit(all.n, all.count);
        const scree_average_decay b = scree_average_decay_fit(bottom.n, bottom.count);
        tell_friction(sample, sink, user);
        sink(user, "force_mean", "N", all.mean);
        sink(user, "force_decay", "1", a.rate);
        sink(user, "force_decay_least", "1", a.low);
        sink(user, "force_decay_most", "1", a.high);
        sink(user, "force_strong_share", "1", share(&all, STRONG, INFINITY));
        sink(user, "bottom_force_mean", "N", bottom.mean);
        sink(user, "bottom_force_decay", "1", b.rate);
        sink(user, "bottom_force_decay_least", "1", b.low);
        sink(user, "bottom_force_decay_most", "1", b.high);
        sink(user, "bottom_share_to_half", "1", share(&bottom, 0, 0.5));
        sink(user, "bottom_share_to_one", "1", share(&bottom, 0.5, 1));
    }
    scree_release(&all.n);
    scree_release(&bottom.n);
    return status ? status : second;
}

// ---- tables ------------------------------------------------------------------------------------------------------

static double bin_edge(int k)
{
    return k <= LINEAR ? k * LINEAR_WIDTH : pow(10, LOG_FIRST + (k - LINEAR - 1) / (double)OF_DECADE);
}

static void tell_bin(const forces *f, double from, double to, const char *density, const char *count,
                     scree_average_table *table)
{
    double number = 0;
    for (size_t k = 0; k < f->count; k++) number += f->n[k] >= from && f->n[k] < to;
    scree_average_table_take(table, density, "1", f->count > 0 ? number / (double)f->count / (to - from) : NAN);
    scree_average_table_take(table, count, "1", number);
}

scree_status scree_average_forces_table(const scree_average_sample *sample, scree_average_table *table,
                                        scree_error *error)
{
    forces all, bottom;
    scree_status status = find_normal_forces(sample, &all, error), second = find_bottom_forces(sample, &bottom, error);
    if (!status) status = second;
    // Bin LINEAR would lie between the two scales.
    for (int k = 0; k < LINEAR + 1 + DECADES * OF_DECADE + 2 && !status; k++) {
        if (k == LINEAR) continue;
        status = scree_average_table_begin_row(table, error);
        if (status) break;
        scree_average_table_take(table, "scale", "1", k > LINEAR);
        scree_average_table_take(table, "from", "1", bin_edge(k));
        scree_average_table_take(table, "to", "1", bin_edge(k + 1));
        tell_bin(&all, bin_edge(k), bin_edge(k + 1), "contacts", "contacts_count", table);
        tell_bin(&bottom, bin_edge(k), bin_edge(k + 1), "bottom", "bottom_count", table);
        status = scree_average_table_end_row(table, error);
    }
    scree_release(&all.n);
    scree_release(&bottom.n);
    return status;
}

scree_status scree_average_friction_table(const scree_average_sample *sample, scree_average_table *table,
                                          scree_error *error)
{
    double count[FRICTION] = {0}, sliding[FRICTION] = {0}, all = 0;
    scree_status status = SCREE_OK;
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        if (!(contact->normal_force > 0)) continue;
        const double ratio = fabs(contact->tangential_force) / contact->normal_force;
        const int bin = ratio < 1 ? (int)(ratio * FRICTION) : FRICTION - 1;
        count[bin]++;
        sliding[bin] += contact->sliding;
        all++;
    }
    for (int k = 0; k < FRICTION && !status; k++) {
        status = scree_average_table_begin_row(table, error);
        if (status) break;
        scree_average_table_take(table, "from", "1", (double)k / FRICTION);
        scree_average_table_take(table, "to", "1", (double)(k + 1) / FRICTION);
        scree_average_table_take(table, "density", "1", count[k] / all * FRICTION);
        scree_average_table_take(table, "sliding", "1", count[k] > 0 ? sliding[k] / count[k] : NAN);
        status = scree_average_table_end_row(table, error);
    }
    return status;
}

/// Sector of a direction.
static int sector_of(const scree_average_sample *sample, const scree_vector n, double sign)
{
    if (sample->dimension == 3) return (int)fmin(BANDS - 1, floor(0.5 * (1 + sign * n[2]) * BANDS));
    const double angle = atan2(sign * n[1], sign * n[0]) / (2 * M_PI) * SECTORS;
    return ((int)floor(angle + 0.5) + SECTORS) % SECTORS; // the first one lies about 0
}

scree_status scree_average_rose_table(const scree_average_sample *sample, scree_average_table *table,
                                      scree_error *error)
{
    const bool in_3d = sample->dimension == 3;
    const int sectors = in_3d ? BANDS : SECTORS;
    double count[SECTORS] = {0}, normal[SECTORS] = {0}, tangential[SECTORS] = {0}, sum[3] = {0};
    scree_status status = SCREE_OK;
    for (size_t c = 0; c < sample->contacts; c++)
        for (int way = -1; way <= 1; way += 2) {
            const scree_average_contact *contact = &sample->contact[c];
            if (contact->second == SCREE_AVERAGE_OUTSIDE) continue;
            const int at = sector_of(sample, contact->normal, way);
            count[at]++;
            normal[at] += contact->normal_force;
            tangential[at] += fabs(contact->tangential_force);
            sum[0]++, sum[1] += contact->normal_force, sum[2] += fabs(contact->tangential_force);
        }
    for (int k = 0; k < sectors && !status; k++) {
        const double angle = in_3d ? asin(2 * (k + 0.5) / sectors - 1) : 2 * M_PI * k / sectors;
        status = scree_average_table_begin_row(table, error);
        if (status) break;
        scree_average_table_take(table, "angle", "degree", angle * 180 / M_PI);
        scree_average_table_take(table, "contacts", "1", count[k] / sum[0] * sectors);
        scree_average_table_take(table, "normal", "1", count[k] > 0 ? normal[k] / count[k] / (sum[1] / sum[0]) : NAN);
        scree_average_table_take(table, "tangential", "1",
                                 count[k] > 0 ? tangential[k] / count[k] / (sum[2] / sum[0]) : NAN);
        status = scree_average_table_end_row(table, error);
    }
    return status;
}
