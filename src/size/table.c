/// Radii with their shares, of the number of particles or of their mass. Equal densities: shares s of the mass are
/// numbers that go as s / R^d in d dimensions.
#include "size/table.h"
#include "size/limits.h"

#include <math.h>
#include <stdio.h>

static const scree_choice kinds[] = {
    {"number", SCREE_TABLE_BY_NUMBER, "of the number of particles"},
    {"mass", SCREE_TABLE_BY_MASS, "of the mass of the particles"},
    {0},
};
typedef scree_table_size size;
static const scree_key size_keys[] = {
    NUMBER(size, radius, "m", FROM("1 nm"), TO("100 m"), .meaning = "Radius of these particles."),
    NUMBER(size, share, "1", ABOVE("0"), TO("100 %"), .meaning = "Their share of all of the species."),
};
static const size unknown = {NAN, NAN};
static const scree_section size_table[] = {TABLE("sizes", "One of the sizes.", size_keys)};
typedef scree_table_config config;
static const scree_key keys[] = {
    CHOICE(config, by, kinds, .standard = "number", .when = "distribution=table", .meaning = "What shares are of."),
    KEY(config, sizes, SCREE_KEY_LIST, FROM("1"), TO("100"), .sections = size_table, .section_count = 1,
        .count_offset = offsetof(config, size_count), .element_size = sizeof(size), .initial = &unknown,
        .when = "distribution=table", .meaning = "Radii with their shares, which add up to 100 %."),
};

/// Share of the number, times what all of them add up to.
static double weight_of(const config *c, int dimension, int64_t index)
{
    const size *s = &c->sizes[index];
    return c->by == SCREE_TABLE_BY_MASS ? s->share * pow(c->sizes[0].radius / s->radius, dimension) : s->share;
}

static double weight_of_all(const config *c, int dimension)
{
    double sum = 0;
    for (int64_t i = 0; i < c->size_count; i++) sum += weight_of(c, dimension, i);
    return sum;
}

static scree_size_moments moments(const void *own, int dimension)
{
    const config *c = own;
    scree_size_moments m = {.least = INFINITY};
    double whole = weight_of_all(c, dimension);
    for (int64_t i = 0; i < c->size_count; i++) {
        double r = c->sizes[i].radius, share = weight_of(c, dimension, i) / whole;
        m.least = fmin(m.least, r);
        m.most = fmax(m.most, r);
        m.mean += share * r;
        m.square += share * r * r;
        m.cube += share * r * r * r;
    }
    return m;
}

static double radius(const void *own, int dimension, double uniform)
{
    const config *c = own;
    double left = uniform * weight_of_all(c, dimension);
    int64_t i = 0;
    for (; i + 1 < c->size_count; i++) {
        left -= weight_of(c, dimension, i);
        if (left < 0) break;
    }
    return c->sizes[i].radius;
}

static bool wrong(const void *own, scree_size_problem *problem)
{
    const config *c = own;
    double sum = 0;
    for (int64_t i = 0; i < c->size_count; i++) sum += c->sizes[i].share;
    if (c->size_count == 0 || !(fabs(sum - 1) > 1e-6)) return false;
    *problem = (scree_size_problem){.key = "sizes"};
    (void)snprintf(problem->text, sizeof problem->text, "the shares add up to %.6g %%, not to 100 %%", 100 * sum);
    return true;
}

const scree_module scree_module_table = {
    .name = "table",
    .meaning = "sizes with their shares, by number or by mass",
    .choice_of = SIZE_CHOICE,
    .keys = SIZE_KEYS(keys, config),
    .keys_count = 2,
    .sizes = &(const scree_size_distribution){.moments = moments, .radius = radius, .wrong = wrong},
};
