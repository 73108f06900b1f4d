/// Elastic constants of elements, and the fabric that sizes predict.
#include "average/elastic.h"

#include "average/tensor.h"

#include <math.h>
#include <stdio.h>

// ---- constants ---------------------------------------------------------------------------------------------------

/// The symmetric part of a tensor without its mean; *trace its trace.
static void split(int dimension, const double tensor[9], double *trace, double deviator[9])
{
    *trace = 0;
    for (int k = 0; k < dimension; k++) *trace += tensor[4 * k];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            deviator[3 * i + j] = i < dimension && j < dimension ? 0.5 * (tensor[3 * i + j] + tensor[3 * j + i]) -
                                                                       (i == j ? *trace / dimension : 0)
                                                                 : 0;
}

static double contract(const double a[9], const double b[9])
{
    double sum = 0;
    for (int k = 0; k < 9; k++) sum += a[k] * b[k];
    return sum;
}

static double misfit_of(int dimension, double stress_trace, double strain_trace, const double s[9], const double e[9],
                        double bulk, double shear)
{
    const double mean = (stress_trace - dimension * bulk * strain_trace) / dimension;
    double rest = dimension * mean * mean;
    for (int k = 0; k < 9; k++) rest += pow(s[k] - 2 * shear * e[k], 2);
    return sqrt(rest / (contract(s, s) + stress_trace * stress_trace / dimension));
}

/// Share of a strain below which its trace, or its deviator, is the round-off of a difference of places.
static const double ROUND_OFF = 1e-12;

scree_average_elastic scree_average_elastic_find(int dimension, const double stress[9], const double gradient[9])
{
    double stress_trace, strain_trace, s[9], e[9];
    split(dimension, stress, &stress_trace, s);
    split(dimension, gradient, &strain_trace, e);
    const double square = contract(e, e), least = ROUND_OFF * hypot(sqrt(square), strain_trace);
    const double k = fabs(strain_trace) > least ? stress_trace / (dimension * strain_trace) : NAN;
    const double g = sqrt(square) > least ? 0.5 * contract(s, e) / square : NAN;
    return (scree_average_elastic){.bulk = k,
                                   .shear = g,
                                   .young = dimension == 2 ? 3 * g - g * g / k : 9 * k * g / (3 * k + g),
                                   .poisson = dimension == 2 ? 0.5 * (1 - g / k) : (3 * k - 2 * g) / (2 * (3 * k + g)),
                                   .misfit = misfit_of(dimension, stress_trace, strain_trace, s, e, k, g)};
}

// ---- an element --------------------------------------------------------------------------------------------------

static void tell_form(const char *name, const char *unit, const double tensor[9], int dimension,
                      scree_average_sink *sink, void *user)
{
    char text[48];
    scree_tensor_form form = {NAN, NAN, NAN};
    if (isfinite(contract(tensor, tensor))) form = scree_tensor_form_of(tensor, dimension);
    (void)snprintf(text, sizeof text, "%s_trace", name);
    sink(user, text, unit, form.trace);
    (void)snprintf(text, sizeof text, "%s_deviator", name);
    sink(user, text, unit, form.deviator);
    (void)snprintf(text, sizeof text, "%s_angle", name);
    sink(user, text, "degree", form.deviator > 0 ? form.angle * 180 / M_PI : NAN);
}

void scree_average_elastic_tell(const scree_average_sample *sample, const scree_average_value *value,
                                double gradient[SCREE_AVERAGE_STRAINS][9], scree_average_sink *sink, void *user)
{
    const int d = sample->dimension;
    double stress[9];
    char text[48];
    for (int k = 0; k < 9; k++) stress[k] = value->centres.change[k] / (value->volume * sample->thickness);
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) {
            (void)snprintf(text, sizeof text, "stress_change_%c%c", "xyz"[i], "xyz"[j]);
            sink(user, text, "Pa", stress[3 * i + j]);
        }
    tell_form("stress_change", "Pa", stress, d, sink, user);
    tell_form("strain", "1", gradient[SCREE_AVERAGE_CUNDALL], d, sink, user);
    const scree_average_elastic usual = scree_average_elastic_find(d, stress, gradient[SCREE_AVERAGE_CUNDALL]);
    sink(user, "bulk_modulus", "Pa", usual.bulk);
    sink(user, "shear_modulus", "Pa", usual.shear);
    sink(user, "young_modulus", "Pa", usual.young);
    sink(user, "poisson_ratio", "1", usual.poisson);
    sink(user, "elastic_misfit", "1", usual.misfit);
    // Stress is spread over what is empty, strain is not: constants of the part inside are those of its own stress.
    sink(user, "bulk_modulus_inside", "Pa", usual.bulk / value->inside);
    sink(user, "shear_modulus_inside", "Pa", usual.shear / value->inside);
    sink(user, "young_modulus_inside", "Pa", usual.young / value->inside);
    for (int k = 0; k < SCREE_AVERAGE_STRAINS; k++) {
        if (k == SCREE_AVERAGE_CUNDALL) continue;
        const scree_average_elastic other = scree_average_elastic_find(d, stress, gradient[k]);
        (void)snprintf(text, sizeof text, "bulk_modulus_%s", scree_average_strain_names[k]);
        sink(user, text, "Pa", other.bulk);
        (void)snprintf(text, sizeof text, "shear_modulus_%s", scree_average_strain_names[k]);
        sink(user, text, "Pa", other.shear);
    }
}

// ---- fabric from sizes -------------------------------------------------------------------------------------------

static double radius_of(const scree_average_sample *sample, const scree_average_grain *grain)
{
    return sample->dimension == 2 ? sqrt(grain->volume / M_PI) : cbrt(0.75 * grain->volume / M_PI);
}

double scree_average_fabric_factor(const scree_average_sample *sample)
{
    double mean = 0, volume = 0, contacts = 0, both = 0;
    const double n = (double)sample->counted;
    for (size_t p = 0; p < sample->bodies; p++)
        if (sample->grain[p].counted) mean += radius_of(sample, &sample->grain[p]) / n;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        if (!grain->counted) continue;
        // The angle that a neighbour of mean size covers, as seen from the centre.
        const double sine = 1 / (1 + radius_of(sample, grain) / mean);
        const double angle = sample->dimension == 2 ? 2 * asin(sine) : 2 * M_PI * (1 - sqrt(1 - sine * sine));
        volume += grain->volume / n;
        contacts += 1 / angle / n;
        both += grain->volume / angle / n;
    }
    return both / (volume * contacts);
}
