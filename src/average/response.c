/// Response of a sample to a load. See response.h.
#include "average/response.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- the same contacts in two samples ----------------------------------------------------------------------------

/// A contact by the ids of its ends, the smaller one first.
typedef struct known {
    uint32_t low, high;
    double normal[3]; ///< from the end with the larger id to the other; of a wall to the grain
    double sign;      ///< 1: the first one of the contact is `low`
    size_t place;     ///< among the contacts
    bool met;
} known;

static uint32_t id_of(const scree_average_sample *sample, uint32_t place)
{
    return place == SCREE_AVERAGE_OUTSIDE ? SCREE_AVERAGE_OUTSIDE : sample->grain[place].id;
}

static known know(const scree_average_sample *sample, size_t place)
{
    const scree_average_contact *c = &sample->contact[place];
    const uint32_t first = id_of(sample, c->first), second = id_of(sample, c->second);
    known k = {.low = first, .high = second, .sign = 1, .place = place};
    if (second < first) k = (known){.low = second, .high = first, .sign = -1, .place = place};
    for (int i = 0; i < 3; i++) k.normal[i] = k.sign * c->normal[i];
    return k;
}

static int by_ends(const void *left, const void *right)
{
    const known *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return a->place < b->place ? -1 : a->place > b->place;
}

/// Whether some end is a grain.
static bool is_counted(const scree_average_sample *sample, const scree_average_contact *c)
{
    return sample->grain[c->first].counted || (c->second != SCREE_AVERAGE_OUTSIDE && sample->grain[c->second].counted);
}

static scree_status know_all(const scree_average_sample *sample, known **list, size_t *count, scree_error *error)
{
    scree_status status = scree_allocate(list, sample->contacts + 1, sizeof **list, error);
    *count = 0;
    for (size_t c = 0; c < sample->contacts && !status; c++)
        if (is_counted(sample, &sample->contact[c])) (*list)[(*count)++] = know(sample, c);
    if (!status) qsort(*list, *count, sizeof **list, by_ends);
    return status;
}

/// The contact with these ends that has not been met and whose normal is nearest; NULL: there is none within a right
/// angle.
static known *find(known *list, size_t count, const known *wanted)
{
    size_t low = 0, high = count;
    known *best = NULL;
    double most = 0;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (list[middle].low < wanted->low || (list[middle].low == wanted->low && list[middle].high < wanted->high))
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < count && list[low].low == wanted->low && list[low].high == wanted->high; low++) {
        const double *a = list[low].normal, *b = wanted->normal, along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        if (list[low].met || !(along > most)) continue;
        most = along;
        best = &list[low];
    }
    return best;
}

/// Both samples' contacts.
typedef struct pairing {
    known *before, *after;
    size_t before_count, after_count;
} pairing;

static void forget(pairing *p)
{
    scree_release(&p->before);
    scree_release(&p->after);
}

static scree_status pair_up(const scree_average_sample *before, const scree_average_sample *after, pairing *p,
                            scree_error *error)
{
    *p = (pairing){0};
    scree_status status = know_all(before, &p->before, &p->before_count, error);
    if (!status) status = know_all(after, &p->after, &p->after_count, error);
    if (status) forget(p);
    return status;
}

// ---- what became of them -----------------------------------------------------------------------------------------

static void note(scree_response_changes *changes, scree_response_kind kind, const scree_average_sample *sample,
                 const known *k, double before, double after)
{
    scree_response_change *change = &changes->list[changes->count++];
    *change = (scree_response_change){kind, k->low, k->high, {0}, before, after};
    memcpy(change->point, sample->contact[k->place].point, sizeof change->point);
    changes->made += kind == SCREE_RESPONSE_MADE;
    changes->lost += kind == SCREE_RESPONSE_LOST;
    changes->sliding += kind == SCREE_RESPONSE_SLIDING;
}

scree_status scree_response_compare(const scree_average_sample *before, const scree_average_sample *after,
                                    scree_response_changes *changes, scree_error *error)
{
    pairing p;
    *changes = (scree_response_changes){0};
    scree_status status = pair_up(before, after, &p, error);
    if (!status)
        status = scree_allocate(&changes->list, p.before_count + p.after_count + 1, sizeof *changes->list, error);
    for (size_t k = 0; k < p.after_count && !status; k++) {
        const scree_average_contact *now = &after->contact[p.after[k].place];
        known *same = find(p.before, p.before_count, &p.after[k]);
        if (same) same->met = true;
        const scree_average_contact *then = same ? &before->contact[same->place] : NULL;
        if (!then)
            note(changes, SCREE_RESPONSE_MADE, after, &p.after[k], 0, now->normal_force);
        else if (now->sliding && !then->sliding)
            note(changes, SCREE_RESPONSE_SLIDING, after, &p.after[k], then->normal_force, now->normal_force);
    }
    for (size_t k = 0; k < p.before_count && !status; k++)
        if (!p.before[k].met)
            note(changes, SCREE_RESPONSE_LOST, before, &p.before[k], before->contact[p.before[k].place].normal_force,
                 0);
    forget(&p);
    return status;
}

/// Place of the body with an id; they are in the order of ids.
static size_t place_of(const scree_average_sample *sample, uint32_t id)
{
    size_t low = 0, high = sample->bodies;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sample->grain[middle].id < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < sample->bodies && sample->grain[low].id == id ? low : SIZE_MAX;
}

double scree_response_order(const scree_average_sample *sample, bool normals)
{
    double sum = 0, order = 0;
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        if (contact->second == SCREE_AVERAGE_OUTSIDE || !is_counted(sample, contact)) continue;
        const double *along = normals ? contact->normal : contact->force;
        const double size = normals ? contact->normal_force : hypot(along[0], along[1]);
        sum += size;
        order += size * cos(6 * atan2(along[1], along[0]));
    }
    return order / sum;
}

// ---- stress ------------------------------------------------------------------------------------------------------

/// The part of the way from `from` along `way` that lies between two planes across an axis.
static void clip(double from, double way, double low, double high, double range[2])
{
    if (way == 0) {
        if (from < low || from >= high) range[1] = range[0];
        return;
    }
    const double one = (low - from) / way, other = (high - from) / way;
    range[0] = fmax(range[0], fmin(one, other));
    range[1] = fmin(range[1], fmax(one, other));
}

/// Length of the part of a branch (1: the whole) that lies in a part of an element, times its weight there: 1 in a
/// box; in a hat it falls linearly from the middle of the element, at `centre`, to 0 at a side from it.
static double share_of(const scree_average_contact *contact, const double *x, const scree_average_element *part,
                       bool hat, double centre, double side)
{
    const double *l = contact->branch;
    double range[2] = {0, 1};
    for (int k = 0; k < 2; k++) clip(x[k], -l[k], part->low[k], part->high[k], range);
    if (!(range[1] > range[0])) return 0;
    const double middle = x[0] - 0.5 * (range[0] + range[1]) * l[0];
    return (range[1] - range[0]) * (hat ? 1 - fabs(middle - centre) / side : 1);
}

void scree_response_pressure(const scree_average_sample *sample, const scree_average_element *element, bool hat,
                             double pressure[3])
{
    const double volume = scree_average_element_volume(element, 2) * sample->thickness;
    const double side = element->high[0] - element->low[0], centre = 0.5 * (element->high[0] + element->low[0]);
    // A hat reaches a side to the left and to the right, and is linear in each half.
    scree_average_element part[2] = {*element, *element};
    if (hat) part[0].low[0] = centre - side, part[0].high[0] = centre;
    if (hat) part[1].low[0] = centre, part[1].high[0] = centre + side;
    memset(pressure, 0, 3 * sizeof *pressure);
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        const double *x = sample->grain[contact->first].position, *l = contact->branch, *f = contact->force;
        if (!is_counted(sample, contact)) continue;
        double share = 0;
        for (int k = 0; k < (hat ? 2 : 1); k++) share += share_of(contact, x, &part[k], hat, centre, side) / volume;
        pressure[0] += share * f[0] * l[0];
        pressure[1] += share * f[1] * l[1];
        pressure[2] -= 0.5 * share * (f[0] * l[1] + f[1] * l[0]);
    }
}

/// Radius of a disc of its area.
static double size_of(const scree_average_grain *grain)
{
    return sqrt(grain->volume / M_PI);
}

scree_status scree_response_open(const scree_average_sample *before, const scree_average_sample *after, uint32_t id,
                                 double side, scree_response *response, scree_error *error)
{
    const size_t one = place_of(before, id), other = place_of(after, id);
    double sizes = 0, count = 0;
    if (one == SIZE_MAX || other == SIZE_MAX)
        return scree_error_set(error, SCREE_ERROR_INPUT, "particle %u is not in both samples", id);
    const scree_average_grain *loaded = &before->grain[one];
    *response = (scree_response){.before = before,
                                 .after = after,
                                 .x = loaded->position[0],
                                 .y = after->grain[other].position[1],
                                 .top = loaded->position[1] + size_of(loaded),
                                 .base = INFINITY,
                                 .left = INFINITY,
                                 .right = -INFINITY};
    for (size_t p = 0; p < before->bodies; p++) {
        const scree_average_grain *grain = &before->grain[p];
        if (!grain->counted) continue;
        const double size = size_of(grain);
        response->base = fmin(response->base, grain->position[1] - size);
        response->left = fmin(response->left, grain->position[0] - size);
        response->right = fmax(response->right, grain->position[0] + size);
        sizes += size, count++;
    }
    response->side = side > 0 ? side : 4 * sizes / count;
    return SCREE_OK;
}

scree_average_element scree_response_element(const scree_response *r, double depth, double x)
{
    const scree_vector centre = {r->x + x, fmax(r->top - depth, r->base + 0.5 * r->side), 0};
    return scree_average_element_at(centre, (scree_vector){r->side, r->side, 0});
}

void scree_response_at(const scree_response *r, double depth, double x, double pressure[3])
{
    const scree_average_element element = scree_response_element(r, depth, x);
    double unloaded[3];
    scree_response_pressure(r->after, &element, true, pressure);
    scree_response_pressure(r->before, &element, true, unloaded);
    for (int k = 0; k < 3; k++) pressure[k] -= unloaded[k];
}

/// Vertical force [N] that goes from grains into what is none above an element, as a mean over its height.
static double into_walls(const scree_average_sample *sample, const scree_average_element *element)
{
    const double height = element->high[1] - element->low[1];
    double sum = 0;
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        const bool first = sample->grain[contact->first].counted;
        const bool second = contact->second != SCREE_AVERAGE_OUTSIDE && sample->grain[contact->second].counted;
        if (first == second) continue;
        const double *x = sample->grain[contact->first].position;
        const double y = first ? x[1] - contact->branch[1] : x[1];
        sum += (first ? 1 : -1) * contact->force[1] * fmin(1, fmax(0, (y - element->low[1]) / height));
    }
    return sum;
}

/// Weight [N] of the grains above an element, as a mean over its height: they sink under the load.
static double weight_above(const scree_average_sample *sample, const scree_average_element *element)
{
    const double height = element->high[1] - element->low[1];
    double sum = 0;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        if (!grain->counted) continue;
        sum -= grain->mass * sample->gravity[1] * fmin(1, fmax(0, (grain->position[1] - element->low[1]) / height));
    }
    return sum;
}

double scree_response_missing(const scree_response *r, double depth)
{
    scree_average_element row = scree_response_element(r, depth, 0);
    double loaded[3], unloaded[3];
    row.low[0] = r->left - 4 * r->side;
    row.high[0] = r->right + 4 * r->side;
    scree_response_pressure(r->after, &row, false, loaded);
    scree_response_pressure(r->before, &row, false, unloaded);
    const double width = (row.high[0] - row.low[0]) * r->after->thickness;
    const double above = r->force * fmin(1, fmax(0, (r->y - row.low[1]) / (row.high[1] - row.low[1])));
    const double walls = into_walls(r->after, &row) - into_walls(r->before, &row);
    const double weight = weight_above(r->after, &row) - weight_above(r->before, &row);
    return (above + weight - walls - width * (loaded[1] - unloaded[1])) / r->force;
}

// ---- peaks -------------------------------------------------------------------------------------------------------

scree_response_peak scree_response_find_peak(const double *value, size_t count, double gap)
{
    scree_response_peak peak = {.centre = value[0], .most = value[0], .width = NAN};
    for (size_t k = 0; k < count; k++) {
        if (!(value[k] > peak.most)) continue;
        peak.most = value[k];
        peak.place = gap * (double)k;
    }
    peak.dip = 1 - peak.centre / peak.most;
    for (size_t k = count; k-- > 1 && peak.most > 0;) {
        if (!(value[k - 1] >= 0.5 * peak.most)) continue;
        peak.width = gap * ((double)(k - 1) + (value[k - 1] - 0.5 * peak.most) / (value[k - 1] - value[k]));
        break;
    }
    return peak;
}
