/// Places of sources.
///
/// A source that follows the top stands above the highest point that the pile had when its layer began, or, where the
/// pile has grown into its way since, that it has now (source/pour.c); one that follows the plateau reaches from end to
/// end of it, less a margin. The plateau is looked for where it was when the layer before began (before the second one:
/// where the case has the line), so it never grows wider. One narrower than its margins leaves a point in its middle.
/// Its own motion and the shifts of its layers are added to that: of one that follows the plateau a single shift, since
/// the plateau has moved with the layers that made it.
///
/// Random numbers: uniform ones by counter (base/random.h) of the number of the body, so that nothing depends on when
/// they are drawn, or for which source.
#include "source/source.h"

#include "base/random.h"
#include "base/vectors.h"
#include "prepare/birth.h"

#include <math.h>
#include <string.h>

/// Room that a slot has beyond the largest grain, as a share of that.
static const double SLACK = 0.1;

static const scree_source_kind *kind_of(const scree_config_source *source)
{
    return scree_modules[source->kind]->source;
}

static bool follows_plateau(const scree_config_source *source, scree_source_plateau *plateau)
{
    return kind_of(source)->follows && kind_of(source)->follows(source->own, plateau);
}

int scree_source_species(const scree_model *model, const scree_config_source *source)
{
    for (int s = 0; s < model->species_count && source->species; s++)
        if (model->species[s].name && strcmp(model->species[s].name, source->species) == 0) return s;
    return -1;
}

bool scree_source_follows(const scree_config_source *source)
{
    scree_source_plateau plateau;
    return !isnan(source->above) || follows_plateau(source, &plateau);
}

void scree_source_begin_layer(const scree_model *model, const scree_config_source *source, const scree_pile *pile,
                              scree_source_state *own)
{
    scree_source_plateau plateau = {NAN, NAN, false};
    own->top = NAN;
    if (!pile || pile->grains == 0) return;
    own->top = pile->top;
    // The first layer makes the plateau.
    if (own->layer == 0 || !follows_plateau(source, &plateau)) return;
    const double depth = isnan(plateau.depth) ? 2 * model->mean_radius : plateau.depth;
    const double margin = isnan(plateau.margin) ? model->mean_radius : plateau.margin;
    if (isnan(own->left)) {
        scree_source_place line;
        kind_of(source)->place(source->own, &line);
        own->left = fmin(line.origin[0], line.origin[0] + line.edge[0][0]);
        own->right = fmax(line.origin[0], line.origin[0] + line.edge[0][0]);
    }
    own->left -= margin, own->right += margin;
    scree_pile_plateau(pile, depth, &own->left, &own->right);
    const double middle = 0.5 * (own->left + own->right);
    own->left = fmin(own->left + margin, middle);
    own->right = fmax(own->right - margin, middle);
}

/// Diameters; widths are whole columns of a radius, so that it has to be more than a whole number.
static const double USED_UP = 3 + 1e-6;

/// Whether it is where its plateau was when its layer began.
static bool is_on_plateau(const scree_source_state *own)
{
    return own->begun && !isnan(own->left);
}

bool scree_source_used_up(const scree_model *model, const scree_config_source *source, const scree_source_state *own)
{
    scree_source_plateau plateau;
    return is_on_plateau(own) && follows_plateau(source, &plateau) && plateau.stops &&
           own->right - own->left < USED_UP * 2 * model->mean_radius;
}

void scree_source_place_now(const scree_model *model, const scree_config_source *source, const scree_source_state *own,
                            double time, double reach, scree_source_place *place)
{
    const int up = model->dimension - 1;
    double low = 0;
    kind_of(source)->place(source->own, place);
    if (is_on_plateau(own)) {
        place->origin[0] = own->left;
        place->edge[0][0] = own->right - own->left;
    }
    const double since = own->begun ? time - own->start : 0, shifts = is_on_plateau(own) ? 1 : (double)own->layer;
    for (int c = 0; c < 3; c++) place->origin[c] += since * source->motion[c] + shifts * source->shift[c];
    if (isnan(source->above) || isnan(own->top)) return;
    for (int e = 0; e < place->edges; e++) low += fmin(0, place->edge[e][up]);
    place->origin[up] = own->top + source->above + reach - low;
}

uint64_t scree_source_layer(const scree_model *model, const scree_config_source *source,
                            const scree_source_place *place)
{
    double grains = 1;
    if (source->layer > 0) return (uint64_t)source->layer;
    for (int e = 0; e < place->edges; e++)
        grains *= fmax(1, floor(scree_length(place->edge[e]) / (2 * model->mean_radius)));
    return (uint64_t)grains;
}

/// Uniform between 0 and 1.
static double draw(const scree_model *model, uint32_t stream, uint64_t number, uint64_t attempt, int component)
{
    // 31 bits of the number, 24 of the attempt.
    const uint64_t counter = number << 32 | (attempt & 0xffffff) << 8 | (uint64_t)component;
    return scree_random_uniform(model->seed, stream, counter);
}

/// origin + sum u_k edge_k.
static void put(const scree_source_place *place, const double share[3], scree_vector position)
{
    for (int c = 0; c < 3; c++) {
        position[c] = place->origin[c];
        for (int e = 0; e < place->edges; e++) position[c] += share[e] * place->edge[e][c];
    }
}

void scree_source_draw(const scree_model *model, const scree_source_place *place, uint64_t number, uint64_t attempt,
                       scree_vector position)
{
    double share[3];
    for (int e = 0; e < place->edges; e++) share[e] = draw(model, SCREE_RANDOM_BIRTH_PLACE, number, attempt, e);
    put(place, share, position);
}

scree_source_slots scree_source_make_slots(const scree_source_place *place, double reach)
{
    scree_source_slots slots = {.place = *place, .count = 1};
    for (int e = 0; e < place->edges; e++) {
        // Centres lie between the ends, so that one more than lengths fits.
        slots.along[e] = 1 + (size_t)floor(scree_length(place->edge[e]) / (2 * reach * (1 + SLACK)));
        slots.count *= slots.along[e];
    }
    return slots;
}

void scree_source_draw_slot(const scree_model *model, const scree_source_slots *slots, size_t slot, double reach,
                            uint64_t number, scree_vector position)
{
    double share[3];
    for (int e = 0; e < slots->place.edges; e++) {
        const size_t at = slot % slots->along[e], last = slots->along[e] - 1;
        const double length = scree_length(slots->place.edge[e]);
        slot /= slots->along[e];
        if (last == 0) {
            share[e] = draw(model, SCREE_RANDOM_BIRTH_PLACE, number, 0, e);
            continue;
        }
        // A grain may go half of what is free between it and the next one, but not beyond an end.
        const double pitch = length / (double)last, room = 0.5 * (pitch - 2 * reach) / length;
        const double moved = room * (2 * draw(model, SCREE_RANDOM_BIRTH_PLACE, number, 0, e) - 1);
        share[e] = fmin(1, fmax(0, (double)at / (double)last + moved));
    }
    put(&slots->place, share, position);
}

void scree_source_draw_motion(const scree_model *model, const scree_config_source *source, uint64_t number,
                              scree_vector velocity, double *angle)
{
    for (int c = 0; c < 3; c++)
        velocity[c] =
            source->velocity[c] + source->spread[c] * (2 * draw(model, SCREE_RANDOM_BIRTH_MOTION, number, 0, c) - 1);
    *angle = source->turn * (2 * draw(model, SCREE_RANDOM_BIRTH_MOTION, number, 0, 3) - 1);
}
