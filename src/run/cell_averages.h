/// Numbers of a loading stage that are averages of its cell fields (docs/output.md): what circles see of the pressure,
/// what happens near the plates and the sides, and whether the cells agree with the sample as a whole.
#ifndef SCREE_RUN_CELL_AVERAGES_H
#define SCREE_RUN_CELL_AVERAGES_H

#include "case/config.h"
#include "io/cell_file.h"
#include "io/series.h"
#include "io/summary.h"

enum { SCREE_CIRCLES = 3 };

/// Circles from so many mean diameters on hold more than a chain or none.
enum { SCREE_CIRCLE_WIDE = 4 };

typedef struct scree_cell_averages {
    const scree_series *series; ///< NULL: nothing to compare with
    double from, to;            ///< axial strains between which instants count for circles and regions
    double instants;            ///< of them
    double distortion[SCREE_REGION_COUNT], pressure[SCREE_REGION_COUNT]; ///< sums over them
    double strong[SCREE_REGION_COUNT];       ///< sums over them of shares of the volume above STRONG mean pressures
    double deformed[SCREE_REGION_COUNT];     ///< the same above DEFORMED mean distortions
    double spread, diameter, wide;           ///< sums over them; wide: spread of circles from WIDE diameters on
    double wide_instants;                    ///< of those that have such circles
    double cell_stress[9], sample_stress[9]; ///< sums over all instants of the stage
    double cell_strain[9];                   ///< sum over its snapshots
    double renewed; ///< 1, sum over its snapshots of log (volume of the cells found there / of those that came there)
    double first_volume, last_volume; ///< m3 (m2 in 2D), of all cells of its first and its last snapshot
    double begin, end;                ///< s, of the first and the last; NAN without
} scree_cell_averages;

/// Forgets everything: a stage begins.
void scree_cell_averages_begin(scree_cell_averages *averages, const scree_config_measure *config,
                               const scree_series *series);

/// Adds a snapshot. ratio: pressure over that of all cells, `count` growing circles around each of SCREE_CIRCLES
/// places. Errors: memory.
scree_status scree_cell_averages_add(scree_cell_averages *averages, const scree_cell_snapshot *snapshot,
                                     const double *ratio, size_t count, scree_error *error) SCREE_MUST_USE;

/// Adds the strain of the cells of `first` between two snapshots. Errors: memory.
scree_status scree_cell_averages_strain(scree_cell_averages *averages, const scree_cell_snapshot *first,
                                        const scree_cell_snapshot *second, scree_error *error) SCREE_MUST_USE;

/// Names in summary.json; what was not measured is left out.
void scree_cell_averages_summarise(const scree_cell_averages *averages, int dimension, scree_summary *summary);

#endif
