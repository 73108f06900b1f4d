/// Species: what they are in numbers, and which body is of which.
///
/// Numbers. Shares by mass become shares of the number by the mean mass of a body, density times <R^2> in 2D (all discs
/// are equally long) and <R^3> in 3D. Of N bodies each species has its share rounded down, and those with the largest
/// rests one more, until all are taken.
///
/// Which. Bodies 0 .. N-1 are put into a random order by a permutation of [0, N), and the species take theirs one after
/// the other; so do the bodies N .. 2N-1, and so on, of preparations that draw more than they keep. The permutation is
/// a Feistel network of ROUNDS rounds over the next power of four, whose round function is the counter-based generator
/// (Luby and Rackoff 1988), repeated until it leads into [0, N) again (Black and Rogaway 2002, cycle walking): a
/// function of seed and number alone, without a table. Cost: some 20 numbers a body, and only with several species.
#include "base/random.h"
#include "model/model.h"

#include <math.h>
#include <stdio.h>

enum { ROUNDS = 4 };

// ---- numbers -----------------------------------------------------------------------------------------------------

/// <R^d>: mass over density, and over a factor that all have in common.
static double mean_power(const scree_model *model, const scree_species *species)
{
    return model->dimension == 3 ? species->radius.cube : species->radius.square;
}

static double weight_of(const scree_model *model, int index)
{
    const scree_config_particles *particles = &model->config->particles;
    scree_config_species said = scree_config_species_at(particles, index);
    const scree_species *species = &model->species[index];
    if (particles->species_count == 0) return 1;
    if (particles->share_by == SCREE_SHARE_BY_COUNT) return (double)said.count;
    if (particles->share_by == SCREE_SHARE_BY_NUMBER) return said.share;
    return said.share / (model->density[species->material] * mean_power(model, species));
}

static void share_out(scree_model *model)
{
    double whole = 0, rest[SCREE_MOST_SPECIES];
    uint64_t count[SCREE_MOST_SPECIES], all = (uint64_t)model->config->particles.count, taken = 0;
    for (int s = 0; s < model->species_count; s++) whole += weight_of(model, s);
    for (int s = 0; s < model->species_count; s++) {
        model->species[s].fraction = weight_of(model, s) / whole;
        double exact = model->species[s].fraction * (double)all, below = floor(exact * (1 + 1e-12));
        count[s] = (uint64_t)below;
        rest[s] = exact - below;
        taken += count[s];
    }
    for (; taken < all; taken++) {
        int most = 0;
        for (int s = 1; s < model->species_count; s++)
            if (rest[s] > rest[most]) most = s;
        count[most]++;
        rest[most] -= 1;
    }
    uint64_t end = 0;
    for (int s = 0; s < model->species_count; s++) model->species[s].end = end += count[s];
}

static scree_status refuse_sizes(const scree_model *model, int index, const scree_size_problem *problem,
                                 scree_error *error)
{
    scree_status status = scree_error_set(error, SCREE_ERROR_INPUT, "%s", problem->text);
    return model->config->particles.species_count > 0
               ? scree_error_key(error, status, "particles.species.%d.%s", index, problem->key)
               : scree_error_key(error, status, "particles.%s", problem->key);
}

scree_status scree_model_resolve_species(scree_model *model, scree_error *error)
{
    const scree_config_particles *particles = &model->config->particles;
    model->species_count = (int)scree_config_species_count(particles);
    for (int s = 0; s < model->species_count; s++) {
        scree_config_species said = scree_config_species_at(particles, s);
        scree_species *species = &model->species[s];
        scree_size_problem problem;
        *species = (scree_species){.material = scree_model_material(model, said.material),
                                   .distribution = scree_modules[said.distribution]->sizes,
                                   .sizes = scree_config_sizes(particles, s),
                                   .shape = scree_modules[scree_config_shape(particles, s)]->shape,
                                   .outline = scree_config_shape_keys(particles, s),
                                   .name = said.name};
        if (species->distribution->wrong(species->sizes, &problem)) return refuse_sizes(model, s, &problem, error);
        species->radius = species->distribution->moments(species->sizes, model->dimension);
    }
    share_out(model);
    const scree_species *first = &model->species[0];
    model->radius_min = first->radius.least;
    model->radius_max = first->radius.most;
    model->bounding_max = 0;
    model->mean_radius = model->mean_square = model->mean_cube = 0;
    for (int s = 0; s < model->species_count; s++) {
        const scree_species *species = &model->species[s];
        model->radius_min = fmin(model->radius_min, species->radius.least);
        model->radius_max = fmax(model->radius_max, species->radius.most);
        const bool round = !species->shape || species->shape->round;
        const double reach = round ? 1 : species->shape->largest_reach(species->outline);
        model->bounding_max = fmax(model->bounding_max, reach * species->radius.most);
        model->mean_radius += species->fraction * species->radius.mean;
        model->mean_square += species->fraction * species->radius.square;
        model->mean_cube += species->fraction * species->radius.cube;
    }
    return SCREE_OK;
}

// ---- means -------------------------------------------------------------------------------------------------------

const scree_shape *scree_model_shape(const scree_model *model)
{
    const scree_shape *shape = model->shape;
    for (int m = 0; m < SCREE_MODULE_COUNT && !shape; m++) {
        const scree_shape *one = scree_modules[m]->shape;
        if (one && one->round && one->dimension == model->dimension) shape = one;
    }
    return shape;
}

double scree_model_mean_solid(const scree_model *model)
{
    return scree_model_shape(model)->volume(model->dimension == 3 ? model->mean_cube : model->mean_square);
}

double scree_model_mean_mass(const scree_model *model)
{
    double sum = 0, factor = scree_model_shape(model)->volume(1);
    if (model->dimension == 2) factor *= model->thickness;
    for (int s = 0; s < model->species_count; s++) {
        const scree_species *species = &model->species[s];
        sum += species->fraction * model->density[species->material] * mean_power(model, species);
    }
    return factor * sum;
}

double scree_model_mean_density(const scree_model *model)
{
    double mass = 0, volume = 0;
    if (model->species_count <= 1) return model->density[model->species[0].material];
    for (int s = 0; s < model->species_count; s++) {
        const scree_species *species = &model->species[s];
        double share = species->fraction * mean_power(model, species);
        mass += share * model->density[species->material];
        volume += share;
    }
    return mass / volume;
}

scree_mean_pair scree_model_mean_pair(const scree_model *model, int law)
{
    const scree_species *species = model->species;
    const int only = species->material;
    scree_mean_pair mean = {0};
    // Of one species its own, to the last bit.
    if (model->species_count <= 1)
        return (scree_mean_pair){model->law_of_pairs[only][only] == law, model->pairs[only][only]};
    for (int s = 0; s < model->species_count; s++)
        for (int t = 0; t < model->species_count; t++) {
            const int one = species[s].material, other = species[t].material;
            if (model->law_of_pairs[one][other] != law) continue;
            mean.share += species[s].fraction * species[t].fraction;
            for (int k = 0; k < SCREE_PAIR_CONSTANTS; k++)
                mean.constants.value[k] +=
                    species[s].fraction * species[t].fraction * model->pairs[one][other].value[k];
        }
    // Under one law they are all.
    if (model->pair_laws == 0) mean.share = 1;
    for (int k = 0; k < SCREE_PAIR_CONSTANTS && mean.share > 0; k++) mean.constants.value[k] /= mean.share;
    return mean;
}

double scree_model_mean_of(const scree_model *model,
                           double (*of)(const scree_elastic *elastic, const scree_pair_constants *pair, double radius,
                                        double argument),
                           double effective_radius, double argument)
{
    double sum = 0;
    for (int k = 0; k < scree_model_law_count(model); k++) {
        const scree_mean_pair pair = scree_model_mean_pair(model, k);
        if (pair.share > 0)
            sum += pair.share *
                   of(scree_law_get(model->laws[k].law)->elastic, &pair.constants, effective_radius, argument);
    }
    return sum;
}

/// Of a species: that of the springs of its grains, or its own.
static double modulus_of(const scree_model *model, const scree_species *species, const char **key)
{
    const scree_config_material *material = &model->config->materials[model->listed[species->material]];
    const scree_contact_space space = {.dimension = model->dimension, .thickness = model->thickness};
    const scree_law *law = scree_law_get(scree_model_law_between(model, species->material, species->material)->law);
    double modulus = law->modulus ? law->modulus(&space, material, model->mean_radius) : NAN;
    *key = isnan(modulus) ? NULL : law->modulus_key;
    return isnan(modulus) ? material->young_modulus : modulus;
}

double scree_model_mean_modulus(const scree_model *model)
{
    double sum = 0;
    const char *key;
    for (int s = 0; s < model->species_count; s++)
        sum += model->species[s].fraction * modulus_of(model, &model->species[s], &key);
    return sum;
}

const char *scree_model_modulus_key(const scree_model *model)
{
    const char *key;
    (void)modulus_of(model, &model->species[0], &key);
    return key;
}

double scree_model_filling_radius(const scree_model *model)
{
    // Narrow: the solid fraction that such estimates take is no better known.
    const double narrow = 1.2;
    double mean = model->mean_radius, power = model->dimension == 3 ? model->mean_cube : model->mean_square;
    double of_mean = model->dimension == 3 ? mean * mean * mean : mean * mean;
    if (!(power > narrow * of_mean)) return mean;
    return model->dimension == 3 ? cbrt(power) : sqrt(power);
}

// ---- which -------------------------------------------------------------------------------------------------------

/// Place of `number` in a random order of [0, count), which is that of this block.
static uint64_t shuffled(uint64_t seed, uint64_t block, uint64_t number, uint64_t count)
{
    unsigned half = 1;
    while (count > UINT64_C(1) << 2 * half) half++;
    const uint64_t mask = (UINT64_C(1) << half) - 1;
    uint64_t place = number;
    do {
        uint64_t left = place >> half, right = place & mask;
        for (uint64_t round = 0; round < ROUNDS; round++) {
            uint32_t words[4];
            scree_random_words(seed, SCREE_RANDOM_SPECIES, ((block * ROUNDS + round) << half) | right, words);
            uint64_t next = left ^ (words[0] & mask);
            left = right;
            right = next;
        }
        place = left << half | right;
    } while (place >= count);
    return place;
}

int scree_model_drawn_species(const scree_model *model, uint64_t number)
{
    int species = 0;
    if (model->species_count <= 1) return 0;
    uint64_t count = (uint64_t)model->config->particles.count, block = number / count;
    uint64_t place = shuffled((uint64_t)model->config->seed, block, number % count, count);
    while (species + 1 < model->species_count && place >= model->species[species].end) species++;
    return species;
}

double scree_model_radius_of_species(const scree_model *model, int species, uint64_t number)
{
    const scree_species *drawn = &model->species[species];
    double uniform = scree_random_uniform((uint64_t)model->config->seed, SCREE_RANDOM_RADIUS, number);
    return drawn->distribution->radius(drawn->sizes, model->dimension, uniform);
}

double scree_model_drawn_radius(const scree_model *model, uint64_t number)
{
    return scree_model_radius_of_species(model, scree_model_drawn_species(model, number), number);
}

double scree_model_bound_of_species(const scree_model *model, int species, uint64_t number)
{
    const scree_species *drawn = &model->species[species];
    const double radius = scree_model_radius_of_species(model, species, number);
    if (!drawn->shape || drawn->shape->round) return radius;
    return radius * drawn->shape->reach(drawn->outline, model->seed, number);
}

double scree_model_drawn_bound(const scree_model *model, uint64_t number)
{
    return scree_model_bound_of_species(model, scree_model_drawn_species(model, number), number);
}
