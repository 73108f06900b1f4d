/// Strengths of bonds. Scatter multiplies both strengths of a bond by one factor of mean 1, which nothing but the seed
/// and the ids of the two bodies decide: it is the same whatever was bonded before, in any order.
///     normal:   1 + s z, z standard normal, drawn again below LEAST
///     Weibull:  (-ln(1 - u))^(1/m) / Gamma(1 + 1/m)                                   (Weibull 1951)
#include "bond/strength.h"

#include "base/random.h"

#include <math.h>

#define LEAST 0.05
enum { MOST_DRAWS = 1000 };

double scree_bond_area(const scree_model *model, double radius_a, double radius_b)
{
    return model->dimension == 3 ? M_PI * radius_a * radius_b : model->thickness * (radius_a + radius_b);
}

/// Not before a thousand draws, each of them above LEAST with more than an even chance, does the mean take their place.
static double normal_factor(const scree_strength *s, uint64_t pair)
{
    uint32_t words[4];
    scree_random_words(s->seed, SCREE_RANDOM_STRENGTH, pair, words);
    const uint64_t of_pair = (uint64_t)words[0] << 32 | words[1];
    for (uint64_t draw = 0; draw < MOST_DRAWS; draw++) {
        double factor = 1 + s->deviation * scree_random_normal(of_pair, SCREE_RANDOM_STRENGTH, draw);
        if (factor >= LEAST) return factor;
    }
    return 1;
}

double scree_bond_factor(const scree_strength *s, uint32_t id_a, uint32_t id_b)
{
    const uint64_t pair = id_a < id_b ? (uint64_t)id_a << 32 | id_b : (uint64_t)id_b << 32 | id_a;
    if (s->scatter == SCREE_SCATTER_NORMAL) return normal_factor(s, pair);
    if (s->scatter != SCREE_SCATTER_WEIBULL) return 1;
    const double below = 1 - scree_random_uniform(s->seed, SCREE_RANDOM_STRENGTH, pair); // above 0, up to 1
    // A strength of zero, at u = 0, would be no bond.
    return fmax(pow(-log(below), 1 / s->modulus) / tgamma(1 + 1 / s->modulus), 1e-6);
}

static double limit(double force, double stress, double area)
{
    if (!isnan(force)) return force;
    return isnan(stress) ? (double)INFINITY : stress * area;
}

void scree_bond_strengths(const scree_strength *s, uint32_t id_a, uint32_t id_b, double area,
                          double constant[SCREE_MEMBER_CONSTANTS])
{
    const double factor = scree_bond_factor(s, id_a, id_b);
    constant[SCREE_MEMBER_TENSION] = factor * limit(s->tensile, s->tensile_stress, area);
    constant[SCREE_MEMBER_SHEAR] = factor * limit(s->shear, s->shear_stress, area);
    constant[SCREE_MEMBER_SLOPE] = s->internal_friction;
}
