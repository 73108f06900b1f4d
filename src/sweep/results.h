/// What the members of a sweep left behind, and what is made of it.
#ifndef SCREE_SWEEP_RESULTS_H
#define SCREE_SWEEP_RESULTS_H

#include "sweep/member.h"
#include "sweep/statistics.h"

enum { SCREE_CURVE_PLACES = 200 };

typedef struct scree_sweep_results {
    const scree_sweep *sweep;
    const scree_sweep_options *options;
    scree_member_state *state; ///< [member]
    double *wall_time;         ///< s, [member], NAN when not done
    double *value;             ///< [member][measure], NAN when not done or not measured
    scree_estimate *estimate;  ///< [point][measure], over the members that are done
    size_t done, failed;
} scree_sweep_results;

/// Reads the states and the measures of all members. A measure that no finished member has is told as a warning.
scree_status scree_sweep_results_read(scree_sweep_results *results, const scree_sweep *sweep,
                                      const scree_sweep_options *options, scree_error *error) SCREE_MUST_USE;
void scree_sweep_results_destroy(scree_sweep_results *results);

/// Measures every point that has finished members, where the sweep asks for it. What cannot be measured is told, and
/// leaves the others alone. Errors: SCREE_ERROR_IO; memory.
scree_status scree_ensembles_measure(const scree_sweep_results *results, scree_error *error) SCREE_MUST_USE;

/// members.csv: one row a member; table.csv: one row a point; sweep.json: what the sweep is, for other programs.
scree_status scree_sweep_write_tables(const scree_sweep_results *results, scree_error *error) SCREE_MUST_USE;
scree_status scree_sweep_write_record(const scree_sweep_results *results, scree_error *error) SCREE_MUST_USE;

/// Averages of one curve at each point of the grid, on an abscissa of its own for each.
typedef struct scree_mean_curve {
    const char *name_x, *name_y;
    bool log_y;
    char unit_x[32], unit_y[32];
    bool *there;              ///< [point]
    double *x;                ///< [point][place]
    scree_estimate *estimate; ///< [point][place]
} scree_mean_curve;

/// Averages curve `index` of the sweep over the finished members. Errors: SCREE_ERROR_INPUT when no point has it.
scree_status scree_mean_curve_make(const scree_sweep_results *results, size_t index, scree_mean_curve *curve,
                                   scree_error *error) SCREE_MUST_USE;
void scree_mean_curve_destroy(scree_mean_curve *curve);
/// curves/Y-over-X.csv
scree_status scree_mean_curve_write(const scree_sweep_results *results, const scree_mean_curve *curve,
                                    scree_error *error) SCREE_MUST_USE;

/// figures/: mean curves with their bands, and each measure against what varies. Failures are told; none stops the
/// others.
void scree_sweep_draw_curve(const scree_sweep_results *results, const scree_mean_curve *curve);
void scree_sweep_draw_measures(const scree_sweep_results *results);

void scree_sweep_tell(const scree_sweep_options *options, int level, const char *format, ...) SCREE_PRINTF(3, 4);

#endif
