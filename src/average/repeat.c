/// Images of a sample that repeats itself, so that elements and kernels may reach out of its cell.
///
/// An image is a body once more, moved by a lattice vector H n; a contact goes with its first body. Elements and points
/// lie in a box along the axes, of which a cell that leans leaves corners empty: numbers n are all those with which a
/// body may come near the box. What a body has moved by since an earlier instant its image has, and the change of H n
/// beside it.
#include "average/sample.h"
#include "base/matrix.h"

#include <math.h>
#include <string.h>

typedef struct repetition {
    scree_average_sample *sample;
    double margin;   ///< m
    uint32_t *place; ///< of the image of each body that is being made; SCREE_AVERAGE_OUTSIDE: it has none
} repetition;

/// Whether a body, moved by `shift`, lies within its own radius and the margin of the box.
static bool is_near(const repetition *r, const scree_average_grain *grain, const double shift[3])
{
    const scree_average_sample *sample = r->sample;
    const double reach = r->margin + grain->radius;
    for (int k = 0; k < 3; k++) {
        if (!scree_average_repeats(sample, k)) continue;
        const double at = grain->position[k] + shift[k];
        if (at < sample->low[k] - reach || at > sample->high[k] + reach) return false;
    }
    return true;
}

static scree_status append(repetition *r, const int steps[3], scree_error *error)
{
    scree_average_sample *s = r->sample;
    const double n[3] = {steps[0], steps[1], steps[2]};
    double shift[3], change[3];
    size_t grains = 0, contacts = 0;
    scree_matrix_apply(s->lattice, n, shift);
    scree_matrix_apply(s->lattice_change, n, change);
    for (size_t p = 0; p < s->bodies; p++) grains += is_near(r, &s->grain[p], shift);
    for (size_t c = 0; c < s->contacts; c++) contacts += is_near(r, &s->grain[s->contact[c].first], shift);
    if (grains == 0) return SCREE_OK;
    const size_t count = s->count + grains, all = s->contact_count + contacts;
    scree_status status = scree_reallocate(&s->grain, s->count, count, sizeof *s->grain, error);
    if (!status) status = scree_reallocate(&s->own, s->count, count, sizeof *s->own, error);
    if (!status) status = scree_reallocate(&s->contact, s->contact_count, all, sizeof *s->contact, error);
    for (size_t p = 0; p < s->bodies && !status; p++) {
        if (!is_near(r, &s->grain[p], shift)) continue;
        r->place[p] = (uint32_t)s->count;
        s->own[s->count] = s->own[p];
        s->grain[s->count] = s->grain[p];
        scree_along(s->grain[p].displacement, 1, change, s->grain[s->count].displacement);
        scree_along(s->grain[p].position, 1, shift, s->grain[s->count++].position);
    }
    for (size_t c = 0; c < s->contacts && !status; c++) {
        if (!is_near(r, &s->grain[s->contact[c].first], shift)) continue;
        scree_average_contact *image = &s->contact[s->contact_count++];
        *image = s->contact[c];
        image->first = r->place[image->first];
        scree_along(s->contact[c].point, 1, shift, image->point);
    }
    return status;
}

/// Least and most whole steps along each lattice vector with which a body may come near the box.
static void find_steps(const repetition *r, double largest, int least[3], int most[3])
{
    const scree_average_sample *s = r->sample;
    double inverse[9], low[3], high[3], first[3], last[3], at[3];
    scree_matrix_invert(s->lattice, inverse);
    for (int k = 0; k < 3; k++) {
        const bool repeats = scree_average_repeats(s, k);
        low[k] = repeats ? s->low[k] - r->margin - largest : 0;
        high[k] = repeats ? s->high[k] + r->margin + largest : 0;
        first[k] = INFINITY, last[k] = -INFINITY;
    }
    for (size_t p = 0; p < s->bodies; p++) {
        scree_matrix_apply(inverse, s->grain[p].position, at);
        for (int k = 0; k < 3; k++) first[k] = fmin(first[k], at[k]), last[k] = fmax(last[k], at[k]);
    }
    for (int k = 0; k < 3; k++) {
        double from = 0, to = 0; // of the box, whose extreme corner is one for each sign of the inverse
        for (int j = 0; j < 3; j++) {
            from += fmin(inverse[3 * k + j] * low[j], inverse[3 * k + j] * high[j]);
            to += fmax(inverse[3 * k + j] * low[j], inverse[3 * k + j] * high[j]);
        }
        least[k] = scree_average_repeats(s, k) ? (int)floor(from - last[k]) : 0;
        most[k] = scree_average_repeats(s, k) ? (int)ceil(to - first[k]) : 0;
    }
}

scree_status scree_average_sample_repeat(scree_average_sample *sample, double margin, scree_error *error)
{
    double largest = 0, longest = 0;
    int least[3], most[3];
    if (!sample->directions || (sample->count > sample->bodies && margin <= sample->margin)) return SCREE_OK;
    sample->count = sample->bodies;
    sample->contact_count = sample->contacts;
    sample->margin = margin;
    for (size_t p = 0; p < sample->bodies; p++) largest = fmax(largest, sample->grain[p].radius);
    // A contact lies as far from its first body as its branch is long.
    for (size_t c = 0; c < sample->contacts; c++) longest = fmax(longest, scree_length(sample->contact[c].branch));
    repetition r = {.sample = sample, .margin = margin + longest};
    find_steps(&r, largest, least, most);
    scree_status status = scree_allocate(&r.place, sample->bodies, sizeof *r.place, error);
    for (int i = least[0]; i <= most[0] && !status; i++)
        for (int j = least[1]; j <= most[1] && !status; j++)
            for (int k = least[2]; k <= most[2] && !status; k++)
                if (i || j || k) status = append(&r, (int[]){i, j, k}, error);
    scree_release(&r.place);
    return status;
}
