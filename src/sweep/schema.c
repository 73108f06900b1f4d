/// The schema table of a sweep file, in the language of cases.
#include "sweep/sweep.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))
#define FROM(limit)  .least = {limit, false}
#define TO(limit)    .most = {limit, false}
#define KEY(owner, member, kind, ...)                                                                                  \
    {                                                                                                                  \
        .name = #member, .type = kind, .offset = offsetof(owner, member), __VA_ARGS__                                  \
    }
#define TEXT(owner, member, longest, ...) KEY(owner, member, SCREE_KEY_TEXT, FROM("0"), TO(longest), __VA_ARGS__)
#define VALUES(owner, member, ...)        KEY(owner, member, SCREE_KEY_VALUES, FROM("1"), TO("1000"), __VA_ARGS__)
#define PATHS(owner, member, ...)                                                                                      \
    KEY(owner, member, SCREE_KEY_PATHS, .element_size = sizeof(scree_node *), .standard = "{}", __VA_ARGS__)
#define LIST(owner, member, table, number, ...)                                                                        \
    KEY(owner, member, SCREE_KEY_LIST, .standard = "[]", FROM("1"), TO("100"), .sections = table, .section_count = 1,  \
        .count_offset = offsetof(owner, number), .element_size = sizeof *((owner *)0)->member, __VA_ARGS__)
#define TABLE(title, text, keys_)                                                                                      \
    {                                                                                                                  \
        .name = title, .meaning = text, .keys = keys_, .count = COUNT(keys_)                                           \
    }

typedef scree_sweep_together together;
static const scree_key together_keys[] = {
    TEXT(together, key, "159", .meaning = "Key path in the case."),
    VALUES(together, values, .meaning = "One value for each setting."),
};
static const scree_section together_table[] = {TABLE("together", "Keys that vary in step.", together_keys)};

typedef scree_sweep_alternative alternative;
static const scree_key alternative_keys[] = {
    TEXT(alternative, name, "60", .meaning = "What it is called in figures, tables and folders."),
    PATHS(alternative, set, .meaning = "Key path and value of everything that it changes."),
};
static const scree_section alternative_table[] = {
    TABLE("alternatives", "Variants of the case, each with settings of its own.", alternative_keys)};

typedef scree_sweep_vary vary;
static const scree_key vary_keys[] = {
    KEY(vary, name, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "What varies; auto: the last part of the key path."),
    TEXT(vary, key, "159", .standard = "", .meaning = "Key path in the case."),
    VALUES(vary, values, .standard = "[]", .meaning = "Values of the key."),
    VALUES(vary, quick_values, .standard = "[]", .meaning = "Values of the key in the quick form, instead."),
    VALUES(vary, names, .standard = "[]", .meaning = "What the values are called in figures, tables and folders."),
    LIST(vary, together, together_table, together_count, .meaning = "Several keys that vary in step, instead of one."),
    LIST(vary, alternatives, alternative_table, alternative_count,
         .meaning = "Variants with different keys, instead of values of one."),
};
static const scree_section vary_table[] = {TABLE("vary", "One dimension of the grid.", vary_keys)};

typedef scree_sweep_curve curve;
static const scree_key curve_keys[] = {
    TEXT(curve, x, "63", .standard = "axial_strain", .meaning = "Column of series.csv that the curve runs along."),
    TEXT(curve, y, "63", .meaning = "Column of series.csv."),
    KEY(curve, log_y, SCREE_KEY_FLAG, .standard = "no", .meaning = "Whether its axis is logarithmic."),
};
static const scree_section curve_table[] = {TABLE("curves", "A curve, averaged over realisations.", curve_keys)};

typedef scree_sweep_relation relation;
static const scree_key relation_keys[] = {
    TEXT(relation, x, "63", .meaning = "One of the measures."),
    TEXT(relation, y, "63", .meaning = "Another one, drawn over it."),
    KEY(relation, log_y, SCREE_KEY_FLAG, .standard = "no", .meaning = "Whether its axis is logarithmic."),
};
static const scree_section relation_table[] = {TABLE("relations", "One measure over another.", relation_keys)};

typedef scree_sweep_bisect bisect;
static const scree_key bisect_keys[] = {
    TEXT(bisect, key, "159", .standard = "", .meaning = "Key path of a number in the case."),
    VALUES(bisect, between, .standard = "[]", .meaning = "Two values of it: runs stand at one, and not at the other."),
    KEY(bisect, tolerance, SCREE_KEY_NUMBER, .unit = "1", .standard = "0.1 %", FROM("1e-9"), TO("50 %"),
        .meaning = "Distance of the two, over their mean, at which the search ends."),
    TEXT(bisect, measure, "63", .standard = "", .meaning = "Result of a run by which it stands."),
    KEY(bisect, below, SCREE_KEY_NUMBER, .unit = "1", .standard = "auto", FROM("-1e300"), TO("1e300"),
        .meaning = "A run stands only if the result is below this (in SI units); auto: no such bound."),
    KEY(bisect, above, SCREE_KEY_NUMBER, .unit = "1", .standard = "auto", FROM("-1e300"), TO("1e300"),
        .meaning = "A run stands only if the result is above this; auto: no such bound."),
    KEY(bisect, target, SCREE_KEY_NUMBER, .unit = "1", .standard = "auto", FROM("-1e300"), TO("1e300"),
        .meaning = "What the result has to be, within the tolerance; auto: bounds decide."),
    TEXT(bisect, curve, "63", .standard = "",
         .meaning = "Column of series.csv that figures/runs of a member shows over time, of runs near the limit."),
};
static const scree_section bisect_table[] = {
    TABLE("bisect", "Search for a limit by runs, in the place of one run a member.", bisect_keys)};

typedef scree_sweep_ensemble ensemble;
#define OPTION(member, ...) TEXT(ensemble, member, "400", .standard = "", __VA_ARGS__)
static const scree_key ensemble_keys[] = {
    OPTION(fields, .meaning = "Fields that are averaged, as `scree measure --fields`."),
    OPTION(cuts, .meaning = "Number of cuts, or their relative heights."),
    OPTION(element, .meaning = "Grains in an element, or its side."),
    OPTION(grid, .meaning = "Points of a map."),
    OPTION(kernel, .meaning = "Width of smooth fields."),
    OPTION(at, .meaning = "Snapshot, or mean over those of a stage."),
    OPTION(from, .meaning = "Snapshot that displacements and strains begin at."),
    OPTION(fit,
           .meaning = "Theories of piles that are fitted to the mean stresses, or of layers to the mean response."),
    OPTION(sizes, .meaning = "Grains of elements about one place: how many make an average."),
    OPTION(axis, .meaning = "Axis of the pile: mass, apex, or a position."),
    KEY(ensemble, points, SCREE_KEY_INTEGER, .standard = "0", FROM("0"), TO("10001"),
        .meaning = "Places along a cut; 0: as many as `scree measure` takes."),
    KEY(ensemble, two_slopes, SCREE_KEY_FLAG, .standard = "no",
        .meaning = "Fits take piles with a slope of their own on each side."),
    KEY(ensemble, mirror, SCREE_KEY_FLAG, .standard = "no",
        .meaning = "Cuts of each member are means of it and its mirror image."),
    OPTION(figures, .meaning = "Names of the figures that a report shows, such as rose; else the pressure by height."),
};
static const scree_section ensemble_table[] = {TABLE(
    "ensemble", "Averages over all members of a point, as `scree measure` makes them of several runs.", ensemble_keys)};

typedef scree_sweep_config config;
static const scree_key root_keys[] = {
    {.name = "sweep",
     .type = SCREE_KEY_INTEGER,
     .standard = "1",
     FROM("1"),
     TO("1"),
     .offset = offsetof(config, language),
     .meaning = "Version of the sweep language."},
    KEY(config, name, SCREE_KEY_WORD, .standard = "sweep", FROM("1"), TO("63"), .meaning = "Short name."),
    TEXT(config, title, "200", .standard = "", .meaning = "Title of the figures."),
    {.name = "case",
     .type = SCREE_KEY_TEXT,
     FROM("1"),
     TO("1000"),
     .offset = offsetof(config, base),
     .meaning = "Name of a built-in case, or a case file beside this file."},
    TEXT(config, needs, "63", .standard = "",
         .meaning = "Program that has to be installed; without it nothing is run, and reports say so."),
    KEY(config, quick, SCREE_KEY_FLAG, .standard = "no", .meaning = "Apply the `quick` section of the case."),
    KEY(config, realisations, SCREE_KEY_INTEGER, .standard = "1", FROM("1"), TO("10000"),
        .meaning = "Number of samples at each point, which differ in their seed."),
    KEY(config, quick_realisations, SCREE_KEY_INTEGER, .standard = "0", FROM("0"), TO("10000"),
        .meaning = "The same with `quick`; 0: as many."),
    KEY(config, seed, SCREE_KEY_INTEGER, .standard = "1", FROM("0"), TO("9007199254000000"),
        .meaning = "Seed of the first realisation; the others follow."),
    TEXT(config, share, "63", .standard = "",
         .meaning = "A stage. Members whose cases are the same up to its end share what came out of it: the first of "
                    "them runs it, the others go on from there."),
    PATHS(config, set, .meaning = "Key path and value of everything that all members change."),
    PATHS(config, quick_set, .meaning = "The same with `quick`, after `set`."),
    PATHS(config, full_set, .meaning = "The same without `quick`, after `set`."),
    LIST(config, vary, vary_table, vary_count, .meaning = "The grid: every combination of these."),
    VALUES(config, measures, .standard = "[]", .meaning = "Names in summary.json that are averaged and compared."),
    LIST(config, curves, curve_table, curve_count, .meaning = "Curves that are averaged and drawn."),
    LIST(config, relations, relation_table, relation_count,
         .meaning = "Measures that are drawn over one another, a place for each point of the grid."),
    KEY(config, bisect, SCREE_KEY_SECTION, .sections = bisect_table, .section_count = 1,
        .meaning = "Search for the limit of a number between which runs stand and do not stand."),
    KEY(config, ensemble, SCREE_KEY_SECTION, .sections = ensemble_table, .section_count = 1,
        .meaning = "Averages over the members of each point: fields, cuts, dips, with intervals."),
    KEY(config, confidence, SCREE_KEY_NUMBER, .unit = "1", .standard = "95 %", FROM("50 %"), TO("99.9 %"),
        .meaning = "Probability of the confidence intervals."),
};

const scree_section scree_sweep_schema = TABLE("sweep", "A sweep file.", root_keys);
