/// Waves: receivers at places, and layers of the sample, whose displacements are recorded every few steps.
#ifndef SCREE_RUN_WAVES_H
#define SCREE_RUN_WAVES_H

#include "run/conclusion.h"

enum { SCREE_RECEIVERS = 64 }; ///< most

/// A place where waves are recorded.
typedef struct scree_receiver_place {
    char *name;
    double place[3]; ///< m
} scree_receiver_place;

/// Numbers of the model.
typedef struct scree_wave_numbers {
    int64_t stage; ///< with which the recording begins
    int64_t every; ///< steps between two records
    int64_t receiver_count;
    int64_t layers;                       ///< 0: none
    int axis;                             ///< 0 to 2, along which the wave goes
    int lattice;                          ///< scree_lattice + 1 that the sample was prepared as; 0: none
    bool turned;                          ///< its horizontal axes are diagonals of the cubic cell
    const scree_receiver_place *receiver; ///< in the config, which outlives every copy of the model
} scree_wave_numbers;

/// A body that is listened to.
typedef struct scree_receiver {
    uint32_t id;
    double place[3]; ///< m, when the recording began
} scree_receiver;

/// State of the module.
typedef struct scree_waves {
    scree_receiver *receiver;
    size_t receiver_count, receiver_capacity;
    double *time; ///< s, of each record
    size_t record_count, record_capacity;
    double (*value)[3]; ///< m, displacements: of the receivers, then of the layers, record by record
    size_t value_count, value_capacity;
    scree_vector *reference; ///< m, place of each body when the recording began; NULL without layers
    double first, spacing;   ///< m, of the layers
    uint64_t begun;          ///< evaluations when the recording began
} scree_waves;

static inline scree_waves *scree_waves_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_waves];
}

/// Numbers of the model; NULL: nothing is recorded.
static inline const scree_wave_numbers *scree_wave_numbers_of(const scree_model *model)
{
    return scree_model_numbers(model, SCREE_SLOT_waves);
}

/// Displacements of one record: receivers, then layers.
static inline size_t scree_wave_channels(const scree_wave_numbers *own)
{
    return (size_t)(own->receiver_count + own->layers);
}

/// What is told at the end.
enum { SCREE_WAVE_ROWS = 16 };
extern const scree_result scree_wave_rows[SCREE_WAVE_ROWS];

/// A signal: component `axis` of channel `channel`, all records, from 0 at the first. Release *signal. Errors: memory.
scree_status scree_wave_signal(const scree_state *state, const scree_wave_numbers *own, size_t channel, int axis,
                               double **signal, scree_error *error) SCREE_MUST_USE;

/// wave_dispersion.c: the dispersion relation of the layers, beside that of the lattice that the sample was prepared
/// as.
scree_status scree_waves_disperse(const scree_conclusion *run, scree_error *error) SCREE_MUST_USE;

/// wave_results.c: tables and results at the end.
scree_status scree_waves_conclude(const scree_conclusion *run, scree_error *error) SCREE_MUST_USE;

#endif
