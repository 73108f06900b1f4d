/// The table of figures: a row a family. To add one: a file in src/view/ with its descriptor, and a row here.
#include "view/figures.h"

#include <stddef.h>

// clang-format off
#define SCREE_FIGURE_FAMILIES(row) \
    row(charts)       /* columns over the strain of loading */ \
    row(times)        /* columns over time, of runs without loading */ \
    row(paths)        /* stress paths over all loading stages */ \
    row(sizes)        /* of the particles */ \
    row(samples)      /* averages over the grains of snapshots */ \
    row(scenes)       /* single snapshots */ \
    row(cell_maps)    /* cells of a snapshot */ \
    row(fluctuations) /* displacements in the strain windows */ \
    row(displacements) /* since an earlier stage */ \
    row(distortion)   /* cells in the strain windows */ \
    row(breaks)       /* bonds that broke */ \
    row(iterates)     /* strains of particles that are held */ \
    row(pile)         /* what was poured */ \
    row(response)     /* a load on a layer */ \
    row(waves)        /* receivers and layers */ \
    row(fem)          /* finite elements beside the run */ \
    row(circles)      /* pressure over growing circles */ \
    row(rotation)     /* a particle that was turned */
// clang-format on

#define DECLARE(name) extern const scree_figure_family scree_figures_##name;
SCREE_FIGURE_FAMILIES(DECLARE)

#define ADDRESS(name) &scree_figures_##name,
const scree_figure_family *const scree_figure_families[] = {SCREE_FIGURE_FAMILIES(ADDRESS) NULL};
