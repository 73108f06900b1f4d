/// A sweep: a grid of parameters and realisations of one case. What the user said (scree_sweep_config, filled along
/// sweep/schema.c), and what it amounts to: dimensions, points of the grid, members. Immutable once read.
///
/// Members are numbered realisation by realisation, so that more realisations only add members at the end; points are
/// numbered with the last dimension fastest.
#ifndef SCREE_SWEEP_SWEEP_H
#define SCREE_SWEEP_SWEEP_H

#include "case/document.h"

#include <scree/scree.h>

typedef struct scree_sweep_together {
    char *key;
    const scree_node *values;
} scree_sweep_together;

typedef struct scree_sweep_alternative {
    char *name;
    const scree_node *set; ///< mapping of key paths; NULL: the case as it is
} scree_sweep_alternative;

typedef struct scree_sweep_vary {
    char *name; ///< NULL: the last part of the key path
    char *key;  ///< "" when `together` or `alternatives` are given
    const scree_node *values, *quick_values, *names;
    scree_sweep_together *together;
    int64_t together_count;
    scree_sweep_alternative *alternatives;
    int64_t alternative_count;
} scree_sweep_vary;

typedef struct scree_sweep_curve {
    char *x, *y; ///< columns of series.csv
    bool log_y;
} scree_sweep_curve;

typedef struct scree_sweep_relation {
    char *x, *y; ///< measures
    bool log_y;
} scree_sweep_relation;

/// Each member is a search for a limit by runs (bisect.c), not a run.
typedef struct scree_sweep_bisect {
    char *key; ///< "": no search
    const scree_node *between;
    double tolerance;
    char *measure;
    double below, above, target; ///< NAN: not given
    char *curve;
} scree_sweep_bisect;

/// Averages over the members of a point, as `scree measure` makes them of several runs (ensemble.h). Texts are its
/// options; "": as there without the option.
typedef struct scree_sweep_ensemble {
    char *fields, *cuts, *element, *grid, *kernel, *at, *from, *axis, *fit, *sizes;
    int64_t points; ///< 0: as there
    bool mirror, two_slopes;
    char *figures; ///< names of those that a report shows, with commas
} scree_sweep_ensemble;

typedef struct scree_sweep_config {
    int64_t language;
    char *name, *title;
    char *base;  ///< the case: name of a built-in one, or a file beside the sweep file
    char *needs; ///< a program without which its members are not worth running; "": none
    char *share; ///< stage up to whose end members share a sample; "": none
    int64_t realisations, quick_realisations;
    int64_t seed;
    bool quick;
    double confidence;
    const scree_node *set, *quick_set, *full_set;
    scree_sweep_vary *vary;
    int64_t vary_count;
    const scree_node *measures;
    scree_sweep_curve *curves;
    int64_t curve_count;
    scree_sweep_relation *relations;
    int64_t relation_count;
    scree_sweep_bisect bisect;
    scree_sweep_ensemble ensemble;
} scree_sweep_config;

extern const scree_section scree_sweep_schema;

/// Key path = value, with the place in the sweep file that says so.
typedef struct scree_sweep_assignment {
    const char *path;
    const char *text; ///< "path=value", as --set takes it
    const char *value;
    scree_place place;
} scree_sweep_assignment;

/// One value of a dimension: what it sets, and what it is called.
typedef struct scree_sweep_setting {
    const char *label; ///< for people
    const char *slug;  ///< for names of files: letters, digits, _ . = -
    scree_sweep_assignment *assignment;
    size_t assignment_count;
} scree_sweep_setting;

typedef struct scree_sweep_dimension {
    const char *name;
    bool named; ///< settings have names of their own, beside the values of keys
    scree_sweep_setting *setting;
    size_t count;
} scree_sweep_dimension;

/// What varies, as a column of the tables: a key path, or the names of a dimension's settings.
typedef struct scree_sweep_parameter {
    const char *name;
    size_t dimension;
    const char *unit; ///< SI unit of numbers; NULL: texts
    double *number;   ///< [setting], NAN where it is not a number (`auto`)
    const char **text;
} scree_sweep_parameter;

struct scree_sweep {
    scree_arena arena; ///< holds everything below
    scree_sweep_config config;
    const char *source;                ///< file name, or name of the built-in sweep
    const char *case_text, *case_name; ///< text of the case, and its path or built-in name
    size_t case_length;
    bool quick;
    size_t realisations;
    scree_sweep_assignment *fixed; ///< for all members: `set`, then `quick_set` or `full_set`
    size_t fixed_count;
    scree_sweep_assignment *last; ///< --set of the command line
    size_t last_count;
    scree_sweep_dimension *dimension;
    size_t dimension_count;
    scree_sweep_parameter *parameter;
    size_t parameter_count;
    const char **measure;
    size_t measure_count;
    bool bisects;              ///< members are searches for a limit
    scree_bisection bisection; ///< what they search for
    bool measures_ensembles;   ///< there is a section `ensemble`
    const char **point;        ///< name of each point, unique: "0.3_slow"; "" when nothing varies
    size_t point_count;
    const char **folder; ///< "004-0.3_slow-2" of each member
    size_t member_count;
};

static inline size_t scree_member_point(const scree_sweep *sweep, size_t member)
{
    return member % sweep->point_count;
}

static inline int64_t scree_member_seed(const scree_sweep *sweep, size_t member)
{
    return sweep->config.seed + (int64_t)(member / sweep->point_count);
}

/// Number of the setting of `dimension` at `point`.
size_t scree_point_setting(const scree_sweep *sweep, size_t point, size_t dimension);

/// Name of a point for people: labels of its settings; of dimension `leave_out` not (SIZE_MAX: of all).
void scree_point_label(const scree_sweep *sweep, size_t point, size_t leave_out, char *text, size_t size);

/// Whether the sweep, or --set, says something of the key with this path.
bool scree_sweep_asks_for(const scree_sweep *sweep, const char *path);

/// Turns the config into dimensions, points and members (grid.c). Problems are noted; false when there are any.
bool scree_sweep_expand(scree_reader *reader, scree_sweep *sweep);

/// Letters, digits, and _ . = - of `text`; other characters become one '-' between others.
void scree_slug(char *slug, size_t size, const char *text);

/// The resolved case of a member (scree_case_free it). Problems of values that the sweep sets are placed in its file.
scree_status scree_member_case(const scree_sweep *sweep, size_t member, scree_case **out, scree_problems **problems);

/// The same with the first problem as the error.
scree_status scree_member_resolve(const scree_sweep *sweep, size_t member, scree_case **out,
                                  scree_error *error) SCREE_MUST_USE;

/// The same as text, as `case.yaml` of its run directory will be; *text with free().
scree_status scree_member_text(const scree_sweep *sweep, size_t member, char **text, scree_error *error) SCREE_MUST_USE;

/// Checks the case of every point, and fills the parameters' numbers. Notes each problem once.
void scree_sweep_check_cases(scree_reader *reader, scree_sweep *sweep);

#endif
