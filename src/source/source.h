/// Where a source is now, and where in it the next grain may be born.
#ifndef SCREE_SOURCE_SOURCE_H
#define SCREE_SOURCE_SOURCE_H

#include "measure/pile.h"
#include "module/source.h"
#include "state/births.h"

/// Places of the grains of a layer, side by side.
typedef struct scree_source_slots {
    scree_source_place place;
    size_t along[3]; ///< so many along each edge
    size_t count;
} scree_source_slots;

/// Number of the species that it is said to pour; -1: all.
int scree_source_species(const scree_model *model, const scree_config_source *source);

/// Whether it is told where the top of the pile is when a layer begins.
bool scree_source_follows(const scree_config_source *source);

/// The pile as it is when a layer begins; NULL: there is none.
void scree_source_begin_layer(const scree_model *model, const scree_config_source *source, const scree_pile *pile,
                              scree_source_state *own);

/// Whether it has no more grains because no more than three of the mean size lie side by side on its plateau.
bool scree_source_used_up(const scree_model *model, const scree_config_source *source, const scree_source_state *own);

/// Its place at `time` [s], for a grain that reaches so far from its centre.
void scree_source_place_now(const scree_model *model, const scree_config_source *source, const scree_source_state *own,
                            double time, double reach, scree_source_place *place);

/// Grains of one of its layers.
uint64_t scree_source_layer(const scree_model *model, const scree_config_source *source,
                            const scree_source_place *place);

/// A random point of it: a pure function of seed, number of the body and attempt.
void scree_source_draw(const scree_model *model, const scree_source_place *place, uint64_t number, uint64_t attempt,
                       scree_vector position);

/// Slots of a layer of grains none of which reaches farther than `reach`.
scree_source_slots scree_source_make_slots(const scree_source_place *place, double reach);

/// Place in a slot for body `number`, which moves at random as far as the slot has room.
void scree_source_draw_slot(const scree_model *model, const scree_source_slots *slots, size_t slot, double reach,
                            uint64_t number, scree_vector position);

/// Velocity [m/s] and angle [rad] of body `number`.
void scree_source_draw_motion(const scree_model *model, const scree_config_source *source, uint64_t number,
                              scree_vector velocity, double *angle);

#endif
