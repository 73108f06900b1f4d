/// Force chains.
#include "average/chains.h"

#include "average/tensor.h"

#include <math.h>
#include <string.h>

/// The major principal pressure of each body.
typedef struct pressed {
    double pressure; ///< Pa, 0 without contacts
    scree_vector direction;
    uint32_t root, members;
} pressed;

static uint32_t root_of(pressed *grain, uint32_t p)
{
    while (grain[p].root != p) p = grain[p].root = grain[grain[p].root].root;
    return p;
}

static void find_pressures(const scree_average_sample *sample, pressed *grain, double *mean, double *touching)
{
    *mean = *touching = 0;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_own *own = &sample->own[p];
        double minus[9], value[3], direction[9];
        grain[p].root = (uint32_t)p;
        grain[p].members = 1;
        if (!sample->grain[p].counted || own->contacts == 0) continue;
        for (int k = 0; k < 9; k++) minus[k] = -own->moment[k] / (sample->grain[p].volume * sample->thickness);
        scree_tensor_principal(minus, sample->dimension, value, direction);
        grain[p].pressure = value[0];
        memcpy(grain[p].direction, direction, sizeof grain[p].direction);
        *mean += value[0];
        (*touching)++;
    }
    *mean /= *touching;
}

/// Whether a contact links two highly stressed grains.
static bool links(const scree_average_sample *sample, const pressed *grain, double mean, double alpha, size_t c)
{
    const scree_average_contact *contact = &sample->contact[c];
    scree_vector line = {contact->branch[0], contact->branch[1], contact->branch[2]};
    if (contact->second == SCREE_AVERAGE_OUTSIDE || !(scree_normalise(line) > 0)) return false;
    for (int end = 0; end < 2; end++) {
        const pressed *one = &grain[end ? contact->second : contact->first];
        if (!(one->pressure > mean) || fabs(scree_dot(line, one->direction)) < cos(alpha)) return false;
    }
    return true;
}

static void sum_up(const scree_average_sample *sample, pressed *grain, double touching, scree_average_chains *chains)
{
    double borne = 0, all = 0;
    for (uint32_t p = 0; p < sample->bodies; p++) {
        const double load = grain[p].pressure * sample->grain[p].volume;
        const uint32_t members = grain[root_of(grain, p)].members;
        all += load;
        if (members < 3) continue;
        borne += load;
        chains->grains++;
        if (grain[p].root != p) continue;
        chains->chains++;
        if (members > chains->longest) chains->longest = members;
    }
    chains->grain_share = (double)chains->grains / touching;
    chains->pressure_share = borne / all;
    chains->length = chains->chains > 0 ? (double)chains->grains / (double)chains->chains : NAN;
}

scree_status scree_average_chains_find(const scree_average_sample *sample, double alpha, uint8_t *linked,
                                       scree_average_chains *chains, scree_error *error)
{
    pressed *grain;
    double mean, touching;
    *chains = (scree_average_chains){0};
    scree_status status = scree_allocate(&grain, sample->bodies, sizeof *grain, error);
    if (status) return status;
    find_pressures(sample, grain, &mean, &touching);
    for (size_t c = 0; c < sample->contacts; c++) {
        if (!links(sample, grain, mean, alpha, c)) continue;
        const uint32_t a = root_of(grain, sample->contact[c].first), b = root_of(grain, sample->contact[c].second);
        if (a == b) continue;
        grain[b].root = a;
        grain[a].members += grain[b].members;
    }
    sum_up(sample, grain, touching, chains);
    for (size_t c = 0; c < sample->contacts && linked; c++)
        linked[c] =
            links(sample, grain, mean, alpha, c) && grain[root_of(grain, sample->contact[c].first)].members >= 3;
    scree_release(&grain);
    return status;
}
