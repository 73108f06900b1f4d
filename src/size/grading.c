/// A grading curve: the openings of sieves and the share of the mass that passes each, from nothing to all. Grains have
/// one density; the opening that one just passes is its diameter (of a polygon that of the disc of equal area).
///
/// Between two sieves the passing grows in proportion to the logarithm of the size, as the curve is drawn, or to the
/// size. A share of mass that is constant in ln R, or in R, is a density by number that falls as R^-n, with n = d + 1
/// or n = d in d dimensions: so each piece is a power law (size/power_law.h), of a weight by number of its share of
/// the mass over <R^d>. Grains of one radius lie between sieves of the same opening. Cost: linear in the sieves.
#include "size/grading.h"
#include "size/limits.h"
#include "size/power_law.h"

#include <math.h>
#include <stdio.h>

static const scree_choice ways[] = {
    {"logarithm", SCREE_GRADING_LOGARITHM, "in proportion to the logarithm of the size"},
    {"size", SCREE_GRADING_SIZE, "in proportion to the size"},
    {0},
};
typedef scree_sieve sieve;
static const scree_key sieve_keys[] = {
    NUMBER(sieve, sieve, "m", FROM("1 nm"), TO("100 m"), .meaning = "Opening: the diameter of what just passes."),
    NUMBER(sieve, passing, "1", FROM("0"), TO("100 %"), .meaning = "Share of the mass that passes."),
};
static const sieve unknown = {NAN, NAN};
static const scree_section sieve_table[] = {TABLE("grading", "One of the sieves.", sieve_keys)};
typedef scree_grading_config config;
static const scree_key keys[] = {
    KEY(config, grading, SCREE_KEY_LIST, FROM("2"), TO("100"), .sections = sieve_table, .section_count = 1,
        .count_offset = offsetof(config, sieve_count), .element_size = sizeof(sieve), .initial = &unknown,
        .when = "distribution=grading",
        .meaning =
            "Sieves from fine to coarse, the first with 0 %, the last with 100 % passing; or a .csv file with the "
            "columns sieve and passing."),
    CHOICE(config, between, ways, .standard = "logarithm", .when = "distribution=grading",
           .meaning = "How the share that passes grows between two sieves."),
};

static scree_power_law_config piece_of(const config *c, int dimension, int64_t index)
{
    return (scree_power_law_config){.radius_min = 0.5 * c->grading[index].sieve,
                                    .radius_max = 0.5 * c->grading[index + 1].sieve,
                                    .exponent = dimension + (c->between == SCREE_GRADING_LOGARITHM)};
}

/// Share of the number that lies in a piece, times what all of them add up to.
static double weight_of(const config *c, int dimension, int64_t index)
{
    const double share = c->grading[index + 1].passing - c->grading[index].passing;
    const double first = 0.5 * c->grading[0].sieve;
    const scree_power_law_config piece = piece_of(c, dimension, index);
    return share > 0 ? share * pow(first, dimension) / scree_power_law_moment(&piece, dimension) : 0;
}

static double weight_of_all(const config *c, int dimension)
{
    double sum = 0;
    for (int64_t i = 0; i + 1 < c->sieve_count; i++) sum += weight_of(c, dimension, i);
    return sum;
}

static scree_size_moments moments(const void *own, int dimension)
{
    const config *c = own;
    scree_size_moments m = {.least = INFINITY};
    const double whole = weight_of_all(c, dimension);
    for (int64_t i = 0; i + 1 < c->sieve_count; i++) {
        const double share = weight_of(c, dimension, i) / whole;
        if (!(share > 0)) continue;
        const scree_power_law_config piece = piece_of(c, dimension, i);
        m.least = fmin(m.least, piece.radius_min);
        m.most = fmax(m.most, piece.radius_max);
        m.mean += share * scree_power_law_moment(&piece, 1);
        m.square += share * scree_power_law_moment(&piece, 2);
        m.cube += share * scree_power_law_moment(&piece, 3);
    }
    return m;
}

static double radius(const void *own, int dimension, double uniform)
{
    const config *c = own;
    double left = uniform * weight_of_all(c, dimension), weight = 0;
    int64_t piece = 0;
    for (int64_t i = 0; i + 1 < c->sieve_count; i++) {
        const double next = weight_of(c, dimension, i);
        if (!(next > 0)) continue;
        if (weight > 0) left -= weight;
        piece = i;
        weight = next;
        if (left < weight) break;
    }
    const scree_power_law_config law = piece_of(c, dimension, piece);
    return scree_power_law_radius(&law, fmin(left / weight, 1));
}

/// The first fault, from fine to coarse.
static bool wrong(const void *own, scree_size_problem *problem)
{
    const config *c = own;
    *problem = (scree_size_problem){.key = "grading"};
    for (int64_t i = 0; i + 1 < c->sieve_count; i++) {
        const sieve *a = &c->grading[i], *b = &c->grading[i + 1];
        if (isnan(a->sieve) || isnan(b->sieve)) return false; // refused where it was read
        if (b->passing < a->passing)
            (void)snprintf(problem->text, sizeof problem->text,
                           "the curve falls: %.6g %% pass the sieve of %.6g mm, and %.6g %% that of %.6g mm",
                           100 * a->passing, 1e3 * a->sieve, 100 * b->passing, 1e3 * b->sieve);
        else if (b->sieve < a->sieve || (b->sieve == a->sieve && b->passing == a->passing))
            (void)snprintf(problem->text, sizeof problem->text,
                           "the sieve of %.6g mm stands behind that of %.6g mm: list them from fine to coarse",
                           1e3 * b->sieve, 1e3 * a->sieve);
        if (problem->text[0]) return true;
    }
    const sieve *first = &c->grading[0], *last = &c->grading[c->sieve_count > 0 ? c->sieve_count - 1 : 0];
    if (c->sieve_count < 2 || isnan(first->passing) || isnan(last->passing)) return false;
    if (first->passing > 0)
        (void)snprintf(problem->text, sizeof problem->text,
                       "%.6g %% pass the finest sieve (%.6g mm): how small the grains are must be said by one that "
                       "nothing passes",
                       100 * first->passing, 1e3 * first->sieve);
    else if (last->passing < 1)
        (void)snprintf(problem->text, sizeof problem->text,
                       "only %.6g %% pass the coarsest sieve (%.6g mm): how large the grains are must be said by one "
                       "that all pass",
                       100 * last->passing, 1e3 * last->sieve);
    return problem->text[0] != 0;
}

const scree_module scree_module_grading = {
    .name = "grading",
    .meaning = "a grading curve: openings of sieves and the share of the mass that passes",
    .choice_of = SIZE_CHOICE,
    .keys = SIZE_KEYS(keys, config),
    .keys_count = 2,
    .sizes = &(const scree_size_distribution){.moments = moments, .radius = radius, .wrong = wrong},
};
