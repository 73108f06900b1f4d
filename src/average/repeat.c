/// Images of a sample that repeats itself, so that elements and kernels may reach out of its cell.
///
/// An image is a body once more, moved by a lattice vector H n with n in {-1, 0, 1}; a contact goes with its first
/// body. What a body has moved by since an earlier instant its image has, and the change of H n beside it.
#include "average/sample.h"
#include "base/matrix.h"
#include "state/periodic.h"

#include <math.h>
#include <string.h>

typedef struct repetition {
    scree_average_sample *sample;
    double inverse[9], width[3], margin;
    uint32_t *place; ///< of the image of each body that is being made; SCREE_AVERAGE_OUTSIDE: it has none
} repetition;

/// Whether the body, moved by whole lattice vectors `steps`, lies within the margin of the cell.
static bool is_near(const repetition *r, const scree_average_grain *grain, const int steps[3])
{
    double fraction[3];
    scree_matrix_apply(r->inverse, grain->position, fraction);
    for (int k = 0; k < 3; k++) {
        if (!(r->sample->directions >> k & 1)) continue;
        const double at = fraction[k] + steps[k], reach = (r->margin + grain->radius) / r->width[k];
        if (at < -reach || at > 1 + reach) return false;
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
    for (size_t p = 0; p < s->bodies; p++) grains += is_near(r, &s->grain[p], steps);
    for (size_t c = 0; c < s->contacts; c++) contacts += is_near(r, &s->grain[s->contact[c].first], steps);
    const size_t count = s->count + grains, all = s->contact_count + contacts;
    scree_status status = scree_reallocate(&s->grain, s->count, count, sizeof *s->grain, error);
    if (!status) status = scree_reallocate(&s->own, s->count, count, sizeof *s->own, error);
    if (!status) status = scree_reallocate(&s->contact, s->contact_count, all, sizeof *s->contact, error);
    for (size_t p = 0; p < s->bodies && !status; p++) {
        if (!is_near(r, &s->grain[p], steps)) continue;
        r->place[p] = (uint32_t)s->count;
        s->own[s->count] = s->own[p];
        s->grain[s->count] = s->grain[p];
        scree_along(s->grain[p].displacement, 1, change, s->grain[s->count].displacement);
        scree_along(s->grain[p].position, 1, shift, s->grain[s->count++].position);
    }
    for (size_t c = 0; c < s->contacts && !status; c++) {
        if (!is_near(r, &s->grain[s->contact[c].first], steps)) continue;
        scree_average_contact *image = &s->contact[s->contact_count++];
        *image = s->contact[c];
        image->first = r->place[image->first];
        scree_along(s->contact[c].point, 1, shift, image->point);
    }
    return status;
}

scree_status scree_average_sample_repeat(scree_average_sample *sample, double margin, scree_error *error)
{
    repetition r = {.sample = sample, .margin = margin};
    int most[3];
    if (!sample->directions || sample->count > sample->bodies) return SCREE_OK;
    scree_matrix_invert(sample->lattice, r.inverse);
    scree_periodic_widths(r.inverse, r.width);
    scree_status status = scree_allocate(&r.place, sample->bodies, sizeof *r.place, error);
    for (int k = 0; k < 3; k++) most[k] = (int)(sample->directions >> k & 1);
    for (int i = -most[0]; i <= most[0] && !status; i++)
        for (int j = -most[1]; j <= most[1] && !status; j++)
            for (int k = -most[2]; k <= most[2] && !status; k++)
                if (i || j || k) status = append(&r, (int[]){i, j, k}, error);
    scree_release(&r.place);
    return status;
}
