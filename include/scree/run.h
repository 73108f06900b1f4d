/// Runs: a case into a folder of files, and what is in such a folder.
#ifndef SCREE_RUN_H
#define SCREE_RUN_H

#include <scree/case.h>
#include <scree/keeper.h>
#include <scree/view.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scree_progress {
    const char *stage; ///< name of the stage
    double fraction;   ///< of the stage, 0 to 1; NAN when not known in advance
    double time;       ///< s, simulated
    double strain;     ///< axial, NAN outside loading stages
    double particle_steps_per_second;
    double seconds_left; ///< wall, of the whole run; NAN when not known
} scree_progress;

typedef struct scree_run_options {
    const char *output;   ///< run directory
    int threads;          ///< at most; 0: one for every 4000 bodies, at most all cores. Fewer work while other
                          ///< programs hold the cores and fewer are faster
    bool balance_by_time; ///< of several processes: parts of the sample by the time that they take, which is not the
                          ///< same from run to run, in place of their numbers of bodies and contacts; results are the
                          ///< same
    bool force;        ///< write into a directory that holds another run (replaces it)
    const char *from;  ///< scree_restart: number of the snapshot to go on from, or "latest"; NULL: a checkpoint
    const char *after; ///< scree_run: folder of a run whose first stages are those of the case: it goes on behind
                       ///< the last of them that has ended there, with its rows and snapshots; NULL: from the begin
    bool figures;      ///< draw figures at the end
    const volatile int *stop; ///< becomes non-zero (signal number) to ask for a checkpoint and an orderly end
    void (*progress)(void *user, const scree_progress *progress); ///< about twice a second; may be NULL
    void (*message)(void *user, int level, const char *line);     ///< lines of log.txt (level 0 information, 1 warning,
                                                                  ///< 2 error) as they are written; may be NULL
    void *user;
} scree_run_options;

/// Runs a case into a new run directory. Errors: SCREE_ERROR_INPUT (directory in use), _GUARD, _IO, SCREE_INTERRUPTED.
SCREE_API scree_status scree_run(const scree_case *c, const scree_run_options *options, scree_error *error);

/// Continues the run in `directory` from its newest checkpoint, or from a snapshot, bit for bit. What came after it is
/// dropped; what is damaged and not needed is set aside, with a line in log.txt. Errors: as scree_run;
/// SCREE_ERROR_INPUT while another process writes there.
SCREE_API scree_status scree_restart(const char *directory, const scree_run_options *options, scree_error *error);

// ---- several processes (mpirun), of a library that is built with MPI ----------------------------------------------

/// Whether processes can compute together: the library is built with MPI.
SCREE_API bool scree_processes_can_join(void);

/// This process takes part with the others that its launcher has started: scree_run and scree_restart are called by all
/// of them, alike, and compute one run, with the bits of one process; process 0 writes it. Called once, before anything
/// else. *count: processes that take part, 1 in a library without MPI. Errors: SCREE_ERROR_IO, MPI does not start.
SCREE_API scree_status scree_processes_join(int *count, scree_error *error);

/// Number of this process, from 0.
SCREE_API int scree_processes_number(void);

/// If one of the processes has failed all get its status and its error, those of the lowest number. All call it.
SCREE_API scree_status scree_processes_agree(scree_status status, scree_error *error);

/// At the end, by all.
SCREE_API void scree_processes_leave(void);

/// One thing in the folder of a run (`scree check DIR`).
typedef struct scree_folder_item {
    const char *name;  ///< "series.csv", "checkpoint 5", "snapshot 12"
    const char *state; ///< "whole", "damaged", or "left over": something that nothing needs
    const char *text;  ///< what it holds, or what is wrong with it
    bool restart;      ///< the run can go on from it
    bool snapshot;     ///< it is one, and `index` is its number
    int64_t index;
} scree_folder_item;

/// Looks at everything in the folder of a run and tells `visit` of it, without changing anything. Errors:
/// SCREE_ERROR_INPUT when it is none of a run, SCREE_ERROR_IO when something is damaged (the message says how much) or
/// cannot be read; memory.
SCREE_API scree_status scree_folder_check(const char *directory,
                                          void (*visit)(void *user, const scree_folder_item *item), void *user,
                                          scree_error *error);

// ---- results -----------------------------------------------------------------------------------------------------

/// Value of `name` in summary.json as text into `value` (cut to `size`). Numbers have the fewest digits that read back
/// as the same double; a value that does not exist is `nan`. Errors: SCREE_ERROR_IO (no run there), SCREE_ERROR_INPUT
/// (no such name; `accepted` holds the nearest).
SCREE_API scree_status scree_result_get(const char *directory, const char *name, char *value, size_t size,
                                        scree_error *error);

/// Calls `visit` for every name in summary.json.
SCREE_API scree_status scree_result_visit(const char *directory,
                                          void (*visit)(void *user, const char *name, const char *value), void *user,
                                          scree_error *error);

// ---- run.h5 ------------------------------------------------------------------------------------------------------

/// Calls `visit` for what is in a group of run.h5 ("/", "snapshots", "snapshots/000012"), by name. Errors:
/// SCREE_ERROR_IO (no run.h5 there, or it is damaged), SCREE_ERROR_INPUT: no such group; memory.
SCREE_API scree_status scree_run_data_visit(const char *directory, const char *group,
                                            void (*visit)(void *user, const char *name, bool is_group), void *user,
                                            scree_error *error);

/// Reads a dataset, "snapshots/000012/contacts/normal_force" (docs/output.md), into memory of its own that *keeper
/// keeps, texts of the view too. Errors: as above.
SCREE_API scree_status scree_run_data_read(const char *directory, const char *path, scree_view *view,
                                           scree_keeper **keeper, scree_error *error);

/// Calls `visit` for each attribute of a group or a dataset: a number, or a text (NULL for a number). Errors: as above.
SCREE_API scree_status scree_run_data_attributes(const char *directory, const char *path,
                                                 void (*visit)(void *user, const char *name, double number,
                                                               const char *text),
                                                 void *user, scree_error *error);

/// Writes the snapshots of a run, of the stage with this name or kind (NULL: all), as a dump of LAMMPS: a frame a
/// snapshot, columns id type x y z radius vx vy vz omegax omegay omegaz mark, in the plane angle, in SI units. *frames:
/// how many. Errors: SCREE_ERROR_IO; SCREE_ERROR_INPUT: no snapshot, no such stage (`accepted` holds all), a cell whose
/// vectors do not lie as LAMMPS needs it; memory.
SCREE_API scree_status scree_export_lammps(const char *directory, const char *stage, const char *path, size_t *frames,
                                           scree_error *error);
/// The same of their contacts, as a local dump: ids from 1, a second of -1 is a wall or a body of a membrane; force [N]
/// on the first; point [m]. `scree_measure` reads it beside the dump of the grains.
SCREE_API scree_status scree_export_contacts(const char *directory, const char *stage, const char *path, size_t *frames,
                                             scree_error *error);
/// Keeps a run in little: the new folder `target` has its case, results and series, and a run.h5 of the last snapshot
/// and of the last one of `stage` (name or kind; NULL: none), with numbers of 24 bits and without the state to go on
/// from. Averages, figures of these snapshots and ensembles read it as they read the run. Errors: SCREE_ERROR_INPUT: no
/// snapshot, no such stage, the folder is there; SCREE_ERROR_IO; memory.
SCREE_API scree_status scree_export_archive(const char *directory, const char *stage, const char *target,
                                            scree_error *error);

/// Chooses the long side of PNG figures in pixels, "200" to "20000", for all that this process draws from now on; NULL:
/// 2000, of charts 2160. The program `scree` calls this with SCREE_PIXELS. Errors: SCREE_ERROR_INPUT: no such number;
/// nothing is changed then.
SCREE_API scree_status scree_figure_pixels_choose(const char *text, scree_error *error);

/// Draws the usual figures of a run, at most some ten, into `directory`/figures. `message` tells which; may be NULL.
/// Errors: SCREE_ERROR_IO, SCREE_ERROR_INPUT while a run goes on there.
SCREE_API scree_status scree_plot(const char *directory, void (*message)(void *user, const char *path), void *user,
                                  scree_error *error);

#define SCREE_ALL_FIGURES "all"

/// The same for the figures in `names`, separated by commas; SCREE_ALL_FIGURES: all that there are; NULL: the usual
/// ones. Errors beside those of scree_plot:
/// SCREE_ERROR_INPUT when the run has no figure of a name (`accepted` holds the nearest; nothing is drawn), or lacks
/// what a figure that was asked for needs.
SCREE_API scree_status scree_plot_only(const char *directory, const char *names,
                                       void (*message)(void *user, const char *path), void *user, scree_error *error);

/// A chart that the user asks for.
typedef struct scree_plot_columns {
    const char *x;     ///< column of series.csv; NULL: time
    const char *y;     ///< columns, separated by commas, all of one unit
    const char *stage; ///< stages by name, kind or number, separated by commas; NULL: all rows
} scree_plot_columns;

/// Draws columns of series.csv over another one into `directory`/figures. Errors beside those of scree_plot:
/// SCREE_ERROR_INPUT when there is no such column or stage (`accepted` holds the nearest, or all), or units differ.
SCREE_API scree_status scree_plot_chart(const char *directory, const scree_plot_columns *columns,
                                        void (*message)(void *user, const char *path), void *user, scree_error *error);

/// A scene that the user asks for.
typedef struct scree_plot_scene {
    const char *field; ///< name of scree_plot_field_visit
    const char *at;    ///< end (NULL), start, #N, an axial strain, a time with its unit, or a stage for its end
    bool section;      ///< spheres where a plane cuts them, in place of the view from outside
} scree_plot_scene;

/// Draws the bodies of one snapshot, coloured by a field, into `directory`/figures. Errors beside those of scree_plot:
/// SCREE_ERROR_INPUT when there is no such field (`accepted` holds the nearest) or snapshot, or no sphere to cut.
SCREE_API scree_status scree_plot_field(const char *directory, const scree_plot_scene *scene,
                                        void (*message)(void *user, const char *path), void *user, scree_error *error);

/// Draws the scenes of all snapshots in one frame and with one scale of colours, as PNG files in
/// `directory`/figures/movie-FIELD/, and a movie-FIELD.mp4 beside it where ffmpeg is installed; `scene->at` is not
/// used. `message` tells the path of the movie, or a warning why there are the frames alone. Errors as of
/// scree_plot_field.
SCREE_API scree_status scree_plot_movie(const char *directory, const scree_plot_scene *scene,
                                        void (*message)(void *user, const char *path), void *user, scree_error *error);

/// Calls `visit` for every field of scenes: its name and what it is.
SCREE_API void scree_plot_field_visit(void (*visit)(void *user, const char *name, const char *meaning), void *user);

/// Calls `visit` for every figure that can be drawn of a run, in the order in which they are drawn; usual: it is one of
/// those that are drawn unless others are asked for. Errors as of
/// scree_plot; figures of the files that can be read are told all the same.
SCREE_API scree_status scree_figure_visit(const char *directory,
                                          void (*visit)(void *user, const char *name, const char *meaning, bool usual),
                                          void *user, scree_error *error);

#ifdef __cplusplus
}
#endif
#endif
