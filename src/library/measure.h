/// What `scree_measure` measures and what it has found. Private to src/library/.
#ifndef SCREE_LIBRARY_MEASURE_H
#define SCREE_LIBRARY_MEASURE_H

#include "average/cuts.h"
#include "average/dip.h"
#include "average/kernel.h"
#include "average/minimum.h"
#include "average/sizes.h"
#include "io/sample_file.h"
#include "theory/fit.h"

#include <scree/measure.h>

/// Tables of a run, each a file.
typedef enum measure_product {
    MEASURE_VALUES, ///< one row
    MEASURE_CUTS,
    MEASURE_MAP,
    MEASURE_KERNEL,
    MEASURE_FORCES,
    MEASURE_FRICTION,
    MEASURE_ROSE,
    MEASURE_SIZES,
    MEASURE_SCATTER,  ///< of an ensemble alone
    MEASURE_RESPONSE, ///< of runs with a response to a load (measure_response.c)
    MEASURE_PRODUCTS
} measure_product;

enum { MEASURE_BANDS = 5 }; ///< bands of fewer runs are too narrow (docs/theory/averages.md), and warned of
enum { MEASURE_FITS = 12, MEASURE_FIT_NUMBERS = 240, MEASURE_FIT_RUNS = 3, MEASURE_FIT_COMPONENTS = 3 };

/// Theories that are fitted to the mean cuts of plane piles, what comes of it, and closures (measure_fit.c); or to the
/// mean response of layers (measure_fit_layers.c).
typedef struct measure_fit_number {
    char name[64];
    const char *unit;
    bool sampled;            ///< it has an interval
    double value, low, high; ///< of 95 %; NAN where it has none
} measure_fit_number;

typedef struct measure_fit_row {
    size_t cut;            ///< of layers the depth, from 0
    scree_fit_point point; ///< folded: x >= 0
    scree_stress_2d theory[MEASURE_FITS];
    bool fitted; ///< one of those that fits are made to
} measure_fit_row;

typedef struct measure_fits {
    size_t count;
    const char *theory[MEASURE_FITS];
    bool solved[MEASURE_FITS];
    scree_fit fit[MEASURE_FITS]; ///< of piles alone: what was found, of what was solved
    size_t numbers;
    measure_fit_number number[MEASURE_FIT_NUMBERS];
    size_t rows, room;
    measure_fit_row *row;
    double slope[2]; ///< rad, left and right
    bool layers;
} measure_fits;

#define MEASURE_AT_REST 1e-2 /* what is not at rest has a larger unbalanced ratio */

/// SI units of one unit of a file of grains.
typedef struct measure_file_units {
    double length, time, force; ///< m, s, N
} measure_file_units;

/// The options, read.
typedef struct measure_plan {
    measure_file_units units;
    scree_average_plan average;
    bool element_given, kernel;
    double share;            ///< of the grains of a run in an element, 0: the average says
    double kernel_width;     ///< m, 0: kernel_diameters
    double kernel_diameters; ///< mean diameters
    const char *at, *from;
    bool mean; ///< over all snapshots of the stage `at`
    int threads;
    bool two_slopes;               ///< fits do not fold
    const char *fit[MEASURE_FITS]; ///< names of theories that are fitted
    size_t fits;
    bool layers;         ///< they are theories of layers
    const char *network; ///< folder that the network of the run is drawn into; NULL: it is not
    const scree_measure_options *options;
} measure_plan;

typedef struct measure_tables {
    scree_average_table of[MEASURE_PRODUCTS];
} measure_tables;

/// What there is of an ensemble.
typedef struct measure_found {
    size_t runs;
    measure_tables mean, low, high;
    scree_average_dip *dip;                               ///< a cut; NULL: no stress along cuts
    scree_average_dip *strain_dip[SCREE_AVERAGE_STRAINS]; ///< the same of the vertical strain by each definition; NULL:
                                                          ///< no elastic constants
    scree_average_minimum minimum; ///< of the pressure of the lowest cut, from the apex; NAN: of no plane pile
    measure_fits *fits;            ///< NULL: none was asked for
    size_t responses;              ///< runs that have a response to a load
    double exponent[SCREE_AVERAGE_SIZED][3]; ///< of the scatter of the tensors against the size, with its interval
    double dip_height;                       ///< 1, relative height above which no dip is significant; NAN with one run
} measure_found;

/// Reads the options. Errors: SCREE_ERROR_INPUT with the option as field.
scree_status measure_plan_read(const scree_measure_options *options, measure_plan *plan, scree_error *error);

/// Whether a path is that of a file, of grains then.
bool measure_is_file(const char *path);

/// The sample of a file of grains under the case of the options, with its contacts (library/measure_file.c). Errors: as
/// scree_measure.
scree_status measure_file_sample(const char *path, const measure_plan *plan, scree_average_sample *sample,
                                 scree_error *error);

/// Measures one run, or one file of grains. Errors: as scree_measure.
scree_status measure_run(const char *directory, const measure_plan *plan, measure_tables *tables, scree_error *error);
void measure_tables_destroy(measure_tables *tables);

/// Smooth fields of a sample, and where it has earlier moments those of its changes since `before`. Errors: memory.
scree_status measure_kernel(const scree_average_sample *before, const scree_average_sample *sample,
                            const scree_average_view *view, const measure_plan *plan, measure_tables *tables,
                            scree_error *error);

enum { MEASURE_RESPONSE_PLACE = 3 }; ///< columns of depth, place and element, before the values

/// Profiles of the response of a run to a load, from its response.csv, over the thickness of the layer and over what
/// the load is over it; no rows without a response. thickness: across the plane [m]. Errors: SCREE_ERROR_INPUT for a
/// table that is none, SCREE_ERROR_IO; memory.
scree_status measure_response(const char *directory, double thickness, scree_average_table *table, scree_error *error);
/// Draws the mean profiles. Errors: SCREE_ERROR_IO; memory.
scree_status measure_draw_response(const char *folder, const measure_found *found, scree_error *error);

/// Fits the theories of piles of the plan. Errors: SCREE_ERROR_INPUT with field --fit for fewer runs than
/// MEASURE_FIT_RUNS, samples that are not plane piles, cuts without stress; memory.
scree_status measure_fit(const measure_tables *each, size_t count, const measure_plan *plan, measure_found *found,
                         scree_error *error);
scree_status measure_fit_write(const char *folder, const measure_plan *plan, const measure_fits *fits,
                               scree_error *error);
scree_status measure_fit_draw(const char *folder, const measure_plan *plan, const measure_fits *fits,
                              scree_error *error);

/// Expression of Mohr and Coulomb, each side with its own slope: 0 where it yields.
double measure_fit_yielding(const measure_fits *fits, const scree_fit_point *point);

/// The same of layers. Errors: SCREE_ERROR_INPUT with field --fit for runs without a response; memory.
scree_status measure_fit_layers(const measure_tables *each, size_t count, const measure_plan *plan,
                                measure_found *found, scree_error *error);
scree_status measure_fit_layers_write(const char *folder, const measure_fits *fits, scree_error *error);
scree_status measure_fit_layers_draw(const char *folder, const measure_fits *fits, scree_error *error);

/// measure_fit_numbers.c: values whose mean and standard error are wanted.
typedef struct measure_fit_mean {
    double sum, squares, number;
} measure_fit_mean;

void measure_fit_add(measure_fit_mean *mean, double value);
/// error: of the mean.
double measure_fit_mean_of(const measure_fit_mean *mean, double *error);
/// xx, yy or xy.
double *measure_fit_component(scree_stress_2d *stress, int component);
/// Errors of these rows become their root mean square.
void measure_fit_pool(measure_fit_row *row, size_t count);

/// Tells a number; `second` is part of its name.
void measure_fit_tell(measure_fits *fits, const char *first, const char *second, const char *unit, bool sampled,
                      double value);
/// Tells theory k; what was not solved tells the same names without numbers. measured: weight, or force, that the
/// fitted one is told over.
void measure_fit_tell_theory(measure_fits *fits, size_t k, const scree_fit *fit, bool solved, double measured);
/// All numbers with one sample left out (SIZE_MAX: none).
typedef scree_status measure_fit_find(measure_fits *fits, void *user, size_t without, scree_error *error);
/// Intervals from leaving out each of `count` samples once. Errors: those of `find`; memory.
scree_status measure_fit_jackknife(measure_fits *fits, size_t count, measure_fit_find *find, void *user,
                                   scree_error *error);
scree_status measure_fit_write_numbers(const char *folder, const measure_fits *fits, scree_error *error);

/// Writes what was found into the folder. Errors: SCREE_ERROR_IO.
scree_status measure_write(const char *folder, const measure_plan *plan, const measure_found *found,
                           scree_error *error);

/// Draws it. Errors: SCREE_ERROR_IO; memory.
scree_status measure_draw(const char *folder, const measure_plan *plan, const measure_found *found, scree_error *error);

enum { MEASURE_LINES = 7 }; ///< of one chart that can be told apart

/// Of `count` cuts the one that line k of a chart shows: all, or MEASURE_LINES of them spread evenly, the first and the
/// last one with them.
size_t measure_spread(size_t count, size_t k);
/// A title that says so where not all cuts are shown.
void measure_title(char *title, size_t size, const char *text, size_t count);

/// Draws averages against the size of their elements. Errors: SCREE_ERROR_IO; memory.
scree_status measure_draw_sizes(const char *folder, const measure_found *found, scree_error *error);

/// Draws elements as points in the plane of two of their numbers, where there are elastic constants. Errors:
/// SCREE_ERROR_IO; memory.
scree_status measure_draw_clouds(const char *folder, const measure_plan *plan, const measure_found *found,
                                 scree_error *error);

/// Draws the network of a plane sample and its chains. linked: a contact, 1 where it is a link of a chain. Errors:
/// SCREE_ERROR_IO; memory.
scree_status measure_draw_network(const char *folder, const scree_average_sample *sample, const uint8_t *linked,
                                  scree_error *error);

/// Draws the displacements of a plane sample on the grains of its earlier state, snapshot number `place` of the run.
/// values: its own, with where it lies. Errors: SCREE_ERROR_IO, SCREE_ERROR_INPUT; memory.
scree_status measure_draw_displacements(const char *folder, const char *directory, size_t place,
                                        const scree_average_sample *sample, const scree_average_table *values,
                                        scree_error *error);

/// Tells a line, printf-like.
__attribute__((format(printf, 2, 3))) void measure_say(const measure_plan *plan, const char *format, ...);

/// Names of the files of the products.
extern const char *const measure_files[MEASURE_PRODUCTS];

#endif
