/// Snapshots and checkpoints in HDF5. During a run every snapshot is a file of its own under parts/ (written aside and
/// renamed), and run.h5 is a small file of external links, replaced after each: a kill at any moment leaves a readable
/// run.h5. `scree_run_file_finish` gathers everything into one self-contained run.h5 and removes the parts.
///
///   /snapshots/000012/            attributes: step, dimension, time [s], stage, axial_strain, pressure [Pa]
///       position (n x 2), radius, velocity, spin, ... from the field table and io/array.h, in id order
///       contacts/ first, second (ids), normal, point, branch, normal_force, tangential_force, ...
///       boundary/ id (the loop), loaded, ...; walls/ position, normal, force, ...; cells/ (cell_file.h)
///       case_walls/ force, torque, work; triangle (n x 9) and wall, where there are some (attribute wall_triangles)
///       state/ what else of scree_state there is, bit for bit, to go on from the snapshot
///   /checkpoints/000003/          everything in scree_state, bit for bit; attribute case_checksum
/// Every dataset has the attributes `unit` and `description`; docs/output.md lists all of them.
#ifndef SCREE_IO_SNAPSHOT_H
#define SCREE_IO_SNAPSHOT_H

#include "base/notes.h"
#include "comm/ranges.h"
#include "contact/contact.h"
#include "integrate/integrate.h"
#include "measure/cells.h"
#include "shape/wall_set.h"
#include "state/periodic.h"
#include "state/plates.h"

typedef struct scree_snapshot_info {
    int64_t index;                     ///< running number, names the group
    double time;                       ///< s
    double axial_strain;               ///< NAN outside loading
    const char *stage;                 ///< its kind
    const char *stage_name;            ///< in the case; NULL: it has none
    const scree_cells *cells;          ///< with all their fields; NULL: not written
    const scree_wall_triangles *walls; ///< of the case; NULL: none
    const scree_ranges *ranges;        ///< all processes write it together; NULL: this one writes it
    bool restartable;                  ///< with the whole state, which must have its contacts saved
    uint64_t case_checksum;            ///< what the state belongs to
} scree_snapshot_info;

/// "/snapshots/000012/state": what a snapshot has of the state besides its own fields.
void scree_snapshot_state_group(int64_t index, char *name, size_t size);

/// Writes parts/snapshot-INDEX.h5 and renews run.h5's links. With ranges all processes call it; a part of a sample is
/// written with its ranges alone. Errors, then: of one process alone, which has to end the others.
scree_status scree_snapshot_write(const char *directory, const scree_model *model, const scree_state *state,
                                  const scree_contact_table *table, const scree_snapshot_info *info,
                                  scree_error *error) SCREE_MUST_USE;

/// Writes a checkpoint (contacts must have been saved into the state); keeps the newest two.
scree_status scree_checkpoint_write(const char *directory, const scree_state *state, uint64_t case_checksum,
                                    scree_error *error) SCREE_MUST_USE;
/// The same by all processes, which call it together, each its range of rows. Errors: of one process alone, which has
/// to end the others.
scree_status scree_checkpoint_write_ranges(const char *directory, const scree_state *state, const scree_ranges *ranges,
                                           uint64_t case_checksum, scree_error *error) SCREE_MUST_USE;
/// Reads the newest checkpoint of a state of this dimension that is whole, or without one the newest snapshot, into
/// *state, which must own nothing and stays empty on failure; rows are in the order in which they were written, derived
/// arrays but row_of_id are zero. When the newest is damaged and an older one is used, the status is SCREE_OK and
/// error->message says so; else the message is empty. Errors: SCREE_ERROR_INPUT: none there, of another case
/// (checksum), of another version of the state (field tables); SCREE_ERROR_IO: none is whole, memory.
scree_status scree_checkpoint_read(const char *directory, int dimension, scree_state *state, uint64_t case_checksum,
                                   scree_error *error) SCREE_MUST_USE;

/// Where a run can go on from: a checkpoint, or a snapshot with its state. In parts/, or in run.h5 itself.
typedef struct scree_restart_point {
    bool snapshot;
    int64_t index;
    bool part;
} scree_restart_point;
typedef struct scree_restart_points {
    scree_restart_point *point; ///< checkpoints, the newest first, then snapshots, the newest first
    size_t count;
    scree_error run; ///< why run.h5 could not be looked into; status SCREE_OK: it could
} scree_restart_points;
/// Lists them without reading them. Errors: memory, unreadable folder.
scree_status scree_restart_points_list(const char *directory, scree_restart_points *points,
                                       scree_error *error) SCREE_MUST_USE;
void scree_restart_points_destroy(scree_restart_points *points);

/// What is wanted of a state. `usable` (may be NULL) looks at one that was read, and fills the error when it cannot be
/// used; the next is tried then, as if it were damaged.
typedef struct scree_restart_wanted {
    int dimension;
    uint64_t case_checksum;
    int64_t snapshot; ///< its number, or one of the two below
    scree_status (*usable)(void *context, const scree_state *state, scree_error *error);
    void *context;
    bool in_ranges; ///< all processes read it, each its range of rows (io/state_file.h), and all find the same
} scree_restart_wanted;
enum { SCREE_RESTART_NEWEST = -1, SCREE_RESTART_LATEST_SNAPSHOT = -2 };

/// Reads the state of one point into *state, which must own nothing and stays empty on failure. *another: the point is
/// at fault, another one may serve. Errors: as scree_checkpoint_read.
scree_status scree_restart_point_read(const char *directory, const scree_restart_point *point,
                                      const scree_restart_wanted *wanted, scree_state *state, bool *another,
                                      scree_error *error) SCREE_MUST_USE;

/// Whether what a point lies in is whole: the checksum of a part, or of run.h5, or the checksums of its group in there.
/// Errors: SCREE_ERROR_IO with the reason; memory.
scree_status scree_restart_point_check(const char *directory, const scree_restart_point *point,
                                       scree_error *error) SCREE_MUST_USE;

/// Reads the first point that can be used; *used says which. Without a failure error->message says when it is not the
/// first one, and why.
scree_status scree_restart_find(const char *directory, const scree_restart_wanted *wanted, scree_restart_point *used,
                                scree_state *state, scree_error *error) SCREE_MUST_USE;

/// A snapshot read back for figures. Arrays of `count` bodies in id order, contacts of `contact_count`.
typedef struct scree_snapshot {
    int64_t index;
    double time, axial_strain;
    char stage[32];
    int dimension;
    size_t count;
    uint64_t grains;                                 ///< number of bodies with the mark of a grain
    uint32_t *id;                                    ///< ascending
    uint8_t *mark;                                   ///< scree_mark
    double *x, *y, *radius, *angle, *vx, *vy, *spin; ///< in 3D no angle (NULL), and spin is the magnitude
    double *z, *vz;                                  ///< 3D only, else NULL
    uint32_t *first_corner, *corner_count;           ///< of polygons, 0 of a disc; NULL: all are round
    double (*corner)[2];                             ///< m, in the frames of their bodies
    size_t corners;                                  ///< so many
    double *rounding;                                ///< m, of corners; NULL: all are sharp
    double *birth;                                   ///< s; NULL: no body was born in the run
    size_t contact_count;
    uint32_t *first, *second;                ///< places in these arrays; second >= SCREE_PRIMITIVE_ID is a wall
    double *normal_force, *tangential_force; ///< N
    double *contact_x, *contact_y;           ///< m
    double *contact_z;                       ///< m, 3D only, else NULL
    double *branch_x, *branch_y, *branch_z; ///< m, from the second (its ghost in a periodic cell) to the first; z in 3D
    size_t loop_count;
    uint32_t *loop;          ///< places
    size_t triangle_count;   ///< of the membrane in 3D
    uint32_t (*triangle)[3]; ///< places, counter-clockwise seen from outside
    scree_wall wall[SCREE_WALL_COUNT];
    size_t wall_triangle_count;
    double *wall_triangle; ///< m, walls of the case: 9 each, three corners; in 2D lines, the last two corners the same
    size_t wall_line_count;
    double *wall_line;            ///< m, of a projection or section: 4 each, the ends of a line on the page
    scree_periodic_cell periodic; ///< directions 0: none
} scree_snapshot;
scree_status scree_snapshot_count(const char *directory, size_t *count, scree_error *error) SCREE_MUST_USE;
scree_status scree_snapshot_read(const char *directory, size_t which, scree_snapshot *snapshot,
                                 scree_error *error) SCREE_MUST_USE;
void scree_snapshot_destroy(scree_snapshot *snapshot);

/// Body k is a grain; without marks all of them are.
static inline bool scree_snapshot_is_grain(const scree_snapshot *snapshot, size_t k)
{
    return !snapshot->mark || snapshot->mark[k] == SCREE_MARK_GRAIN;
}

#endif
