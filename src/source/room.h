/// Whether the grains of a source find room: where they are born, and on their way down.
#ifndef SCREE_SOURCE_ROOM_H
#define SCREE_SOURCE_ROOM_H

#include "base/log.h"
#include "model/model.h"
#include "shape/wall_set.h"

/// Grains of a source, or the first ten thousand of them.
typedef struct scree_source_grains {
    double reach;     ///< m, radius of the smallest circle or sphere that holds the largest one
    double narrowest; ///< m, width of the one that passes the narrowest opening
} scree_source_grains;

scree_source_grains scree_source_grains_of(const scree_model *model, const scree_config_source *source);

/// Place number `k` of those that have `parts` + 1 along each edge; false: there is none. parts 1: the ends.
bool scree_source_probe(const scree_source_place *place, size_t parts, size_t k, scree_vector at);

/// Whether source `index` has room: the ends of its place for its smallest grain, and some place of it for its largest
/// one, beside walls that never move, unless it moves itself. wall_set: at its present pose; NULL: there are no walls.
/// Errors: SCREE_ERROR_INPUT with the field sources.N.
scree_status scree_source_check_room(const scree_model *model, const scree_wall_set *wall_set, int64_t index,
                                     scree_error *error) SCREE_MUST_USE;

/// An opening between two walls below a source through which its grains have to fall.
typedef struct scree_source_opening {
    int wall[2];      ///< the one to the left, and to the right
    double width;     ///< m
    double middle[2]; ///< m, of its narrowest place
    bool above;       ///< something else stands below it
} scree_source_opening;

/// The widest opening below source `index`; false: there is none. Of two dimensions, and of solid walls with corners
/// that never move (polygons, boxes seen from outside): the whole source lies above the two, the narrowest place
/// between them is rather level, and below it is room for the grain that is narrowest.
bool scree_source_find_opening(const scree_model *model, const scree_wall_set *wall_set, int64_t index,
                               double narrowest, scree_source_opening *opening);

/// Refuses an opening that no grain passes although something stands below it. Errors: SCREE_ERROR_INPUT with the field
/// walls.N.
scree_status scree_source_check_opening(const scree_model *model, const scree_wall_set *wall_set, int64_t index,
                                        scree_error *error) SCREE_MUST_USE;

/// Tells a log of openings that may clog, and of sources that are no longer than a grain.
void scree_source_warn(const scree_model *model, const scree_wall_set *wall_set, scree_log *log);

#endif
