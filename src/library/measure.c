/// Averages of runs and of ensembles of runs.
#include "library/measure.h"

#include "average/elastic_ensemble.h"
#include "average/increment.h"
#include "io/run_directory.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

enum { BANDS = 60000 };   ///< numbers of a table that has bands; each is resampled
#define LEAST_INSIDE 0.5  /* of an element, where strains are looked at: outside of the surface there are none */
#define SIGNIFICANT  0.05 /* largest p of a dip that is one */

// ---- ensembles ---------------------------------------------------------------------------------------------------

static void found_destroy(measure_found *found)
{
    measure_tables_destroy(&found->mean);
    measure_tables_destroy(&found->low);
    measure_tables_destroy(&found->high);
    scree_release(&found->dip);
    for (int k = 0; k < SCREE_AVERAGE_STRAINS; k++) scree_release(&found->strain_dip[k]);
    if (found->fits) scree_release(&found->fits->row);
    scree_release(&found->fits);
}

/// A mean over some of the runs alone is not that of the others: rows that one has not, a size that does not fit or a
/// place beyond its ends, have none, from column `first` on.
static void leave_out(const scree_average_table *same, size_t count, int product, size_t first, measure_found *found)
{
    scree_average_table *const all[] = {&found->mean.of[product], &found->low.of[product], &found->high.of[product]};
    for (size_t row = 0; row < same->rows; row++)
        for (size_t i = 0; i < count; i++) {
            if (isfinite(scree_average_table_get(&same[i], row, first))) continue;
            for (size_t t = 0; t < 3; t++)
                for (size_t k = first; k < all[t]->columns && row < all[t]->rows; k++)
                    all[t]->value[row * all[t]->columns + k] = NAN;
        }
}

/// The tables of one product. A layer that gives way has no response: the others are the ensemble.
static size_t gather(const measure_tables *each, size_t count, int product, scree_average_table *same)
{
    size_t taken = 0;
    for (size_t i = 0; i < count; i++)
        if (product != MEASURE_RESPONSE || each[i].of[product].rows > 0) same[taken++] = each[i].of[product];
    return taken > 0 && same[0].rows > 0 ? taken : 0;
}

static scree_status find_means(const measure_tables *each, size_t count, measure_found *found, scree_error *error)
{
    scree_average_table *same;
    scree_status status = scree_allocate(&same, count, sizeof *same, error);
    for (int k = 0; k < MEASURE_PRODUCTS && !status; k++) {
        const size_t taken = gather(each, count, k, same);
        if (k == MEASURE_RESPONSE) found->responses = taken;
        if (taken == 0) continue;
        status =
            scree_average_table_mean(same, taken, &found->mean.of[k], &found->low.of[k], &found->high.of[k], error);
        if (!status && taken > 1)
            status = scree_average_elastic_ensemble(same, taken, &found->mean.of[k],
                                                    found->low.of[k].rows > 0 ? &found->low.of[k] : NULL,
                                                    &found->high.of[k], error);
        if (!status && k == MEASURE_RESPONSE) leave_out(same, taken, k, MEASURE_RESPONSE_PLACE, found);
    }
    scree_release(&same);
    return status;
}

/// What elements of each size scatter by from run to run.
static scree_status find_scatter(const measure_tables *each, size_t count, measure_found *found, scree_error *error)
{
    scree_average_table *same;
    if (count < 2 || each[0].of[MEASURE_SIZES].rows == 0) return SCREE_OK;
    scree_status status = scree_allocate(&same, count, sizeof *same, error);
    for (size_t i = 0; i < count && !status; i++) same[i] = each[i].of[MEASURE_SIZES];
    if (!status) leave_out(same, count, MEASURE_SIZES, 2, found);
    if (!status) status = scree_average_sizes_scatter(same, count, &found->mean.of[MEASURE_SCATTER], error);
    for (scree_average_sized k = 0; k < SCREE_AVERAGE_SIZED && !status; k++)
        scree_average_sizes_exponent(same, count, k, &found->exponent[k][0], &found->exponent[k][1],
                                     &found->exponent[k][2]);
    scree_release(&same);
    return status;
}

/// What is looked at along cuts.
typedef struct profiles {
    size_t column;
    double least; ///< so much of an element has to lie in the sample
    double reach; ///< so far from the axis, over the half width
    double sign;
} profiles;

/// Profiles of a column of a cut, run by run. Those of the pressure of an ensemble are scaled by what a pile without
/// voids of its bulk density and height would bear, where there is gravity, so that piles of other sizes weigh alike.
static void take_profiles(const measure_tables *each, size_t count, const measure_plan *plan, size_t cut,
                          const profiles *of, double *profile)
{
    const size_t points = plan->average.points;
    for (size_t i = 0; i < count; i++) {
        const scree_average_table *cuts = &each[i].of[MEASURE_CUTS];
        const size_t inside = scree_average_table_find(cuts, "inside"), place = scree_average_table_find(cuts, "place");
        for (size_t j = 0; j < points; j++) {
            const size_t row = cut * points + j;
            const bool taken = scree_average_table_get(cuts, row, inside) >= of->least &&
                               fabs(scree_average_table_get(cuts, row, place)) <= of->reach;
            profile[i * points + j] = taken ? of->sign * scree_average_table_get(cuts, row, of->column) : NAN;
        }
    }
}

/// Dips of a column, cut by cut.
static scree_status find_dips_of(const measure_tables *each, size_t count, const measure_plan *plan, const profiles *of,
                                 scree_average_dip **dip, scree_error *error)
{
    double *profile;
    scree_status status = scree_allocate(&profile, count * plan->average.points, sizeof *profile, error);
    if (!status) status = scree_allocate(dip, plan->average.cuts, sizeof **dip, error);
    for (size_t k = 0; k < plan->average.cuts && !status; k++) {
        take_profiles(each, count, plan, k, of, profile);
        status = scree_average_dip_find(profile, count, plan->average.points, &(*dip)[k], error);
    }
    scree_release(&profile);
    return status;
}

/// Of the vertical strain by each definition; where gravity falls that is an extension. What is known of the axis of no
/// run has none.
static scree_status find_strain_dips(const measure_tables *each, size_t count, const measure_plan *plan,
                                     measure_found *found, scree_error *error)
{
    const scree_average_table *values = &found->mean.of[MEASURE_VALUES], *cuts = &each[0].of[MEASURE_CUTS];
    const size_t mean = scree_average_table_find(values, "strain_mean");
    scree_status status = SCREE_OK;
    for (int k = 0; k < SCREE_AVERAGE_STRAINS && mean != SIZE_MAX && !status; k++) {
        char name[32];
        profiles of = {
            .least = LEAST_INSIDE, .reach = scree_increment_reach(k), .sign = values->value[mean] < 0 ? -1 : 1};
        (void)snprintf(name, sizeof name, "%s_zz", scree_average_strain_names[k]);
        of.column = scree_average_table_find(cuts, name);
        (void)snprintf(name, sizeof name, "%s_yy", scree_average_strain_names[k]);
        if (of.column == SIZE_MAX) of.column = scree_average_table_find(cuts, name);
        if (of.column == SIZE_MAX ||
            isnan(scree_average_table_get(&found->mean.of[MEASURE_CUTS], plan->average.points / 2, of.column)))
            continue;
        status = find_dips_of(each, count, plan, &of, &found->strain_dip[k], error);
    }
    return status;
}

/// Where the pressure of the lowest cut is least and largest, from the apex that plane piles have.
static scree_status find_minimum(const measure_tables *each, size_t count, const measure_plan *plan, const profiles *of,
                                 measure_found *found, scree_error *error)
{
    const size_t points = plan->average.points;
    double *profile = NULL, *apex = NULL;
    bool plane = true;
    scree_status status = scree_allocate(&profile, count * points, sizeof *profile, error);
    if (!status) status = scree_allocate(&apex, count, sizeof *apex, error);
    for (size_t i = 0; i < count && !status; i++) {
        const scree_average_table *values = &each[i].of[MEASURE_VALUES];
        const size_t at = scree_average_table_find(values, "triangle_apex"),
                     half = scree_average_table_find(values, "half_width");
        apex[i] = at == SIZE_MAX || half == SIZE_MAX ? (double)NAN : values->value[at] / values->value[half];
        plane = plane && isfinite(apex[i]);
    }
    if (!status) take_profiles(each, count, plan, 0, of, profile);
    if (!status && plane) status = scree_average_minimum_find(profile, apex, count, points, &found->minimum, error);
    scree_release(&profile);
    scree_release(&apex);
    return status;
}

static scree_status find_dips(const measure_tables *each, size_t count, const measure_plan *plan, measure_found *found,
                              scree_error *error)
{
    const scree_average_table *cuts = &each[0].of[MEASURE_CUTS];
    const size_t cut_count = plan->average.cuts;
    const profiles of = {.column = scree_average_table_find(cuts, "vertical_pressure_scaled"), .reach = 1, .sign = 1};
    scree_status status = find_strain_dips(each, count, plan, found, error);
    if (status || of.column == SIZE_MAX || isnan(scree_average_table_get(cuts, 0, of.column))) return status;
    status = find_dips_of(each, count, plan, &of, &found->dip, error);
    found->dip_height = count > 1 ? 0 : NAN;
    for (size_t k = 0; k < cut_count && !status && found->dip[k].p <= SIGNIFICANT; k++)
        found->dip_height = plan->average.height[k];
    return status ? status : find_minimum(each, count, plan, &of, found, error);
}

// ---- what is printed ---------------------------------------------------------------------------------------------

static void say_values(const measure_plan *plan, const measure_found *found)
{
    const scree_average_table *values = &found->mean.of[MEASURE_VALUES];
    for (size_t k = 0; k < values->columns; k++) {
        const scree_average_column *column = &values->column[k];
        if (found->runs == 1)
            measure_say(plan, "%-26s %-12.6g %s", column->name, values->value[k], column->unit);
        else
            measure_say(plan, "%-26s %-12.6g %-5s (%.6g to %.6g)", column->name, values->value[k], column->unit,
                        found->low.of[MEASURE_VALUES].value[k], found->high.of[MEASURE_VALUES].value[k]);
    }
}

static void say_between(const measure_plan *plan, const char *name, const scree_average_between *of)
{
    if (isnan(of->low))
        measure_say(plan, "%-26s %-12.6g 1", name, of->value);
    else
        measure_say(plan, "%-26s %-12.6g 1     (%.6g to %.6g)", name, of->value, of->low, of->high);
}

static void say_dips(const measure_plan *plan, const measure_found *found)
{
    if (!found->dip) return;
    measure_say(plan, "%-8s %-10s %-22s %-10s %-8s %s", "height", "dip", "interval", "checked", "p", "place");
    for (size_t k = 0; k < plan->average.cuts; k++) {
        const scree_average_dip *dip = &found->dip[k];
        measure_say(plan, "%-8.3g %-10.4f %8.4f to %-10.4f %-10.4f %-8.3g %.3g", plan->average.height[k], dip->dip,
                    dip->low, dip->high, dip->checked, dip->p, dip->place);
    }
    if (isfinite(found->minimum.depth.value)) {
        say_between(plan, "pressure_minimum_place", &found->minimum.place);
        say_between(plan, "pressure_minimum_depth", &found->minimum.depth);
        say_between(plan, "pressure_maximum_place", &found->minimum.highest);
    }
    if (found->runs == 1) measure_say(plan, "one run has no interval and no p: give the folders of several piles");
}

static void say_responses(const measure_plan *plan, const measure_found *found)
{
    if (found->responses > 0 && found->responses < found->runs)
        measure_say(plan, "warning: %zu of %zu runs have a response to a load: its means are theirs", found->responses,
                    found->runs);
}

static void say_fits(const measure_plan *plan, const measure_fits *fits)
{
    for (size_t k = 0; fits && k < fits->numbers; k++) {
        const measure_fit_number *n = &fits->number[k];
        if (isnan(n->low))
            measure_say(plan, "%-30s %-12.6g %s", n->name, n->value, n->unit);
        else
            measure_say(plan, "%-30s %-12.6g %-5s (%.6g to %.6g)", n->name, n->value, n->unit, n->low, n->high);
    }
}

// ---- the whole ---------------------------------------------------------------------------------------------------

static scree_status find_folder(const char *const *runs, size_t count, const measure_plan *plan, char *folder,
                                size_t size, scree_error *error)
{
    const char *given = plan->options->output;
    if (!given && count == 1 && !measure_is_file(runs[0]))
        return scree_path_join(folder, size, runs[0], "measure", error);
    (void)snprintf(folder, size, "%s", given ? given : "measure");
    return SCREE_OK;
}

static scree_status measure_all(const char *const *runs, size_t count, const measure_plan *plan, measure_tables *each,
                                measure_found *found, scree_error *error)
{
    scree_status status = SCREE_OK;
    measure_plan others = *plan;
    others.network = NULL; // that of the first run is drawn
    for (size_t k = 0; k < count && !status; k++)
        status = measure_run(runs[k], k == 0 ? plan : &others, &each[k], error);
    if (!status) status = find_means(each, count, found, error);
    if (!status) status = find_scatter(each, count, found, error);
    if (!status) status = find_dips(each, count, plan, found, error);
    if (!status && plan->fits > 0)
        status = plan->layers ? measure_fit_layers(each, count, plan, found, error)
                              : measure_fit(each, count, plan, found, error);
    return status;
}

/// Options that are of files of grains are of no use to runs.
static scree_status check_kinds(const char *const *runs, size_t count, const scree_measure_options *options,
                                scree_error *error)
{
    size_t files = 0;
    for (size_t k = 0; k < count; k++) {
        if (access(runs[k], F_OK) != 0)
            return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot open '%s'", runs[k]);
        files += measure_is_file(runs[k]);
    }
    const char *wrong = files > 0 ? NULL : options->sample_case ? "case" : options->contacts ? "contacts" : NULL;
    if (!wrong && (!options->contacts || files <= 1)) return SCREE_OK;
    (void)scree_error_set(error, SCREE_ERROR_INPUT,
                          wrong ? "it is of files of grains; a run has its own" : "contacts are those of one file");
    return scree_error_key(error, SCREE_ERROR_INPUT, "--%s", wrong ? wrong : "contacts");
}

/// A run that stands twice among those of an ensemble is one sample: intervals are too narrow by it.
static void warn_of_repeats(const char *const *runs, size_t count, const measure_plan *plan)
{
    for (size_t k = 1; k < count; k++)
        for (size_t i = 0; i < k; i++)
            if (scree_folders_are_same(runs[i], runs[k])) {
                measure_say(plan, "warning: %s: this run is named twice: intervals take each as a sample of its own",
                            runs[k]);
                break;
            }
}

/// No resample leaves the range of the runs.
static void warn_of_bands(size_t count, const measure_plan *plan)
{
    if (count > 1 && count < MEASURE_BANDS)
        measure_say(plan, "warning: bands and intervals of %zu runs are too narrow: give %d or more", count,
                    MEASURE_BANDS);
}

scree_status scree_measure_check(const scree_measure_options *options, scree_error *error)
{
    measure_plan plan;
    return measure_plan_read(options, &plan, error);
}

scree_status scree_measure(const char *const *runs, size_t count, const scree_measure_options *options,
                           scree_error *error)
{
    char folder[PATH_MAX];
    measure_plan plan;
    measure_tables *each = NULL;
    const scree_average_between none = {NAN, NAN, NAN};
    measure_found found = {.runs = count, .dip_height = NAN, .minimum = {none, none, none, NAN}};
    if (count == 0) return scree_error_set(error, SCREE_ERROR_INPUT, "no run is named");
    scree_status status = measure_plan_read(options, &plan, error);
    if (!status) status = check_kinds(runs, count, options, error);
    if (!status) status = find_folder(runs, count, &plan, folder, sizeof folder, error);
    if (!status) warn_of_repeats(runs, count, &plan);
    if (!status) warn_of_bands(count, &plan);
    plan.network = !plan.mean && !options->no_figures ? folder : NULL;
    if (!status) status = scree_allocate(&each, count, sizeof *each, error);
    if (!status) status = measure_all(runs, count, &plan, each, &found, error);
    if (!status) {
        say_values(&plan, &found);
        say_dips(&plan, &found);
        say_responses(&plan, &found);
        say_fits(&plan, found.fits);
        status = scree_folders_make(folder, error);
    }
    if (!status) status = measure_write(folder, &plan, &found, error);
    if (!status && !options->no_figures) status = measure_draw(folder, &plan, &found, error);
    for (size_t k = 0; k < count && each; k++) measure_tables_destroy(&each[k]);
    scree_release(&each);
    found_destroy(&found);
    return status;
}
