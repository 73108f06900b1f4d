/// What is read off the curves of a loading, as P reads them (figs. 2.3, 2.5, 3.6): means over a part of the strain,
/// first peaks and what follows them.
///
/// Means: of the stress ratio over the strain (trapezoids), up to INITIAL (`stress_ratio_at_begin`) and over the second
/// half of the strain of the stage (`stress_ratio_second_half`; P's 5 to 10 %): curves are compared, not their peaks.
///
/// First peak (`first_dilation_peak`): the first maximum of the dilation that is followed by a fall of FALL of it
/// before it is passed, and that has a tenth
/// of the largest dilation (a curve around zero has many). Without such a fall there is none: a curve that stays
/// constant has no peak. The dip is the largest fall from there on, over the peak; 0 without a peak. Maxima
/// (`dilation_maxima`): those with falls of FALL of the range of the curve on both sides (P fig. 3.6: local peaks of
/// (c)); an end of the curve is none. The two that stand out most are told by their strains. Cost: O(rows).
#include "io/loading_stage.h"
#include "module/module.h"
#include "run/conclusion.h"

#include <math.h>

static const double FALL = 0.05;
static const double INITIAL = 0.01;

/// A column over the axial strain.
typedef struct curve {
    const double *strain, *value;
    scree_loading_rows rows;
} curve;

/// Mean over the strain between `from` and `to`, by trapezoids between the rows in there; NAN with less than two.
static double mean_between(const curve *c, double from, double to)
{
    double sum = 0, width = 0;
    for (size_t k = c->rows.first + 1; k < c->rows.last; k++) {
        if (!(c->strain[k - 1] >= from && c->strain[k] <= to)) continue;
        double part = c->strain[k] - c->strain[k - 1];
        sum += part * 0.5 * (c->value[k] + c->value[k - 1]);
        width += part;
    }
    return width > 0 ? sum / width : NAN;
}

static void summarise_stress(const curve *ratio, scree_summary *summary)
{
    double end = ratio->strain[ratio->rows.last - 1];
    scree_summary_set_number(summary, "stress_ratio_at_begin", mean_between(ratio, 0, INITIAL));
    scree_summary_set_number(summary, "stress_ratio_second_half", mean_between(ratio, 0.5 * end, end));
}

static void summarise_dilation(const curve *dilation, scree_summary *summary)
{
    scree_first_peak peak = scree_first_peak_find(dilation->value, dilation->strain, dilation->rows, FALL);
    scree_summary_set_number(summary, "strain_at_first_dilation_peak", peak.strain);
    scree_summary_set_number(summary, "first_dilation_peak", peak.value);
    scree_summary_set_number(summary, "dilation_dip", isnan(peak.dip) ? 0 : peak.dip);
    scree_summary_set_number(summary, "dilation_maxima",
                             (double)scree_maxima_count(dilation->value, dilation->rows, FALL));
    size_t row[2];
    const bool two = scree_maxima_most(dilation->value, dilation->rows, row);
    scree_summary_set_number(summary, "strain_at_earlier_maximum", two ? dilation->strain[row[0]] : NAN);
    scree_summary_set_number(summary, "strain_at_later_maximum", two ? dilation->strain[row[1]] : NAN);
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    (void)error;
    const scree_series *series = run->series;
    scree_loading_rows rows = scree_loading_rows_find(series);
    const double *strain = scree_series_get(series, "axial_strain");
    const double *volumetric = scree_series_get(series, "volumetric_strain");
    const curve ratio = {strain, scree_series_get(series, "stress_ratio"), rows};
    if (rows.last - rows.first < 2 || !ratio.value || !volumetric) return SCREE_OK;
    if (!(strain[rows.last - 1] > 0)) return SCREE_OK;
    double *dilation = NULL;
    scree_status status = scree_allocate(&dilation, rows.last, sizeof *dilation, error);
    if (status) return status;
    for (size_t k = rows.first; k < rows.last; k++) dilation[k] = -volumetric[k];
    summarise_stress(&ratio, run->summary);
    summarise_dilation(&(curve){strain, dilation, rows}, run->summary);
    scree_release(&dilation);
    return SCREE_OK;
}

static const scree_result results[] = {
    {"stress_ratio_at_begin", "1", "mean stress ratio up to 1 % of axial strain"},
    {"stress_ratio_second_half", "1", "mean stress ratio over the second half of the strain"},
    {"first_dilation_peak", "1", "first maximum of the dilation that a fall of 5 % of it follows"},
    {"strain_at_first_dilation_peak", "1", "axial strain there"},
    {"dilation_dip", "1", "largest fall of the dilation after its first peak, over the peak"},
    {"dilation_maxima", "1", "maxima of the dilation with falls of 5 % of its range on both sides"},
    {"strain_at_earlier_maximum", "1", "axial strain of the earlier one of the two maxima that stand out most"},
    {"strain_at_later_maximum", "1", "that of the later one"},
};

const scree_module scree_module_loading_curves = {
    .name = "loading_curves",
    .meaning = "means and first peaks of the curves of a loading",
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
