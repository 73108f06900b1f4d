/// What a pile that was poured tells: its grains, height, width, angles of repose, and the force on its plate against
/// its weight (measure/pile.h); at every sample, and at the end with the dip of the pressure over its plate
/// (average/dip.h) and the table of its outline, outline.csv.
#include "average/cuts.h"
#include "average/dip.h"
#include "case/check.h"
#include "io/run_directory.h"
#include "measure/measure.h"
#include "measure/pile.h"
#include "module/key_rows.h"
#include "module/table.h"
#include "run/conclusion.h"
#include "source/lowest_wall.h"
#include "state/births.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct config {
    char *plate; ///< name of a wall
} config;

static const scree_key keys[] = {
    KEY(config, plate, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of the wall on which a pile lies, whose force is compared with its weight; auto: all that "
                   "stands."),
};

static const config *own_config(const scree_config *whole)
{
    return whole->measure.own ? scree_config_own(&scree_module_pile, "measure", whole->measure.own) : NULL;
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    const config *own = own_config(whole);
    const char *names[SCREE_SURFACES];
    size_t count = 0;
    if (!own || !own->plate) return;
    for (int64_t k = 0; k < whole->wall_count; k++) {
        if (!whole->walls[k].name || strcmp(whole->walls[k].name, own->plate) == 0) return;
        names[count++] = whole->walls[k].name;
    }
    scree_rule_refuse_name(reader, "measure.plate", "wall", own->plate, names, count);
}

typedef struct numbers {
    int plate; ///< number of the wall; -1: all that stands
} numbers;

static scree_status resolve(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_pile, "measure", model->config->measure.own);
    numbers *n = scree_model_reserve_numbers(model, SCREE_SLOT_pile);
    (void)error;
    n->plate = -1;
    for (int64_t k = 0; own && own->plate && k < model->wall_count; k++)
        if (model->walls_of_case[k].name && strcmp(model->walls_of_case[k].name, own->plate) == 0) n->plate = (int)k;
    return SCREE_OK;
}

static scree_status measure(const scree_context *c, scree_pile *pile, scree_error *error)
{
    const numbers *n = scree_model_numbers(c->model, SCREE_SLOT_pile);
    return scree_pile_measure(c->model, c->state, c->work, c->table, n ? n->plate : -1, pile, error);
}

/// There is a pile where there are sources.
static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    name[0] = 0;
    return index == 0 && whole->source_count > 0;
}

static double degrees(double angle)
{
    return angle * 180 / M_PI;
}

static const scree_result columns[] = {
    {"pile_grains", "1", "particles that rest on what stands, by their contacts"},
    {"pile_height", "m", "from the lowest contact with what stands to the highest point of the pile"},
    {"pile_width", "m", "of the foot of its heap, without single particles that lie apart"},
    {"pile_weight", "N", "weight of its particles"},
    {"plate_force", "N", "upward force of the plate (measure.plate), or of all that stands, on them"},
    {"grains_lost", "1", "particles that have fallen past everything that stands, and were taken out"},
};

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    scree_pile pile;
    (void)index;
    scree_status status = measure(c, &pile, error);
    if (status) return status;
    value[0] = (double)pile.grains;
    value[1] = pile.grains > 0 ? pile.top - pile.base : 0;
    value[2] = pile.grains > 0 ? pile.right - pile.left : 0;
    value[3] = pile.weight;
    value[4] = pile.plate;
    value[5] = (double)scree_births_of(c->state)->lost;
    scree_pile_destroy(&pile);
    return SCREE_OK;
}

static const scree_result results[] = {
    {"grains", "1", "particles of the pile"},
    {"pile_height", "m", "from the lowest contact with what stands to the highest point of the pile"},
    {"pile_width", "m", "of the foot of its heap"},
    {"pile_apex", "m", "x of the highest point"},
    {"angle_of_repose", "degree", "mean of the left and the right one, by the corners of the heap: foot to apex"},
    {"angle_of_repose_left", "degree", "slope of the line from its left foot to its highest point"},
    {"angle_of_repose_right", "degree", "slope of the line from its right foot to its highest point"},
    {"angle_of_surface", "degree", "mean of the left and the right one, by a fit"},
    {"angle_of_surface_left", "degree",
     "slope of the line of least squares through its left surface, from 10 to 90 % of the height"},
    {"angle_of_surface_right", "degree", "the same of the right one"},
    {"pile_weight", "N", "weight of its particles"},
    {"weight_ratio", "1", "upward force of the plate (measure.plate), or of all that stands, over this weight"},
    {"pile_solid_fraction", "1", "area of the particles of its heap over that under its surface, 2D"},
    {"pile_coordination", "1", "contacts a particle of the pile, those with what stands among them"},
    {"plate_share_middle", "1", "of the force on the plate what acts on the middle third of the foot"},
    {"unbalanced", "1", "mean unbalanced force on its particles now over the mean contact force"},
    {"grains_lost", "1", "particles that have fallen past everything that stands, and were taken out"},
    {"dip", "1", "of the vertical pressure over the plate: 1 - that on the axis over the largest one"},
    {"dip_element", "1", "particles in the elements that this pressure is a mean over"},
};

#define PLATE_MISSES 1e-3 /* of what holds the pile up: more is said */
#define AT_REST      1e-5 /* unbalanced force ratio: ten times what the piles of the built-in cases settle to */
#define WEIGHT_OFF   1e-3 /* share of the weight that what stands bears too much or too little */
enum { DIP_GRAINS = 150, DIP_SHARE = 10, DIP_POINTS = 41 };

/// Dip of the lowest cut (average/dip.h), in elements of DIP_GRAINS, in small piles of a tenth of the grains. NAN of
/// what is too small for them, or stands nowhere.
static scree_status find_dip(const scree_context *c, double *dip, double *grains, scree_error *error)
{
    scree_average_sample sample;
    scree_average_view view;
    scree_average_table table = {0};
    double profile[DIP_POINTS];
    scree_average_plan plan = {.fields = SCREE_AVERAGE_STRESS, .cuts = 1, .points = DIP_POINTS};
    scree_average_dip found;
    *dip = *grains = NAN;
    scree_status status = scree_average_sample_of_state(c->model, c->state, c->table, &sample, error);
    if (status) return status;
    status = scree_average_sample_finish(&sample, error);
    plan.grains = sample.counted < DIP_GRAINS * DIP_SHARE ? fmax(1, (double)sample.counted / DIP_SHARE) : DIP_GRAINS;
    if (!status) status = scree_average_view_open(&sample, &plan, &view, error);
    if (!status) {
        status = scree_average_cuts_table(&view, &plan, &table, error);
        const size_t column = scree_average_table_find(&table, "vertical_pressure_scaled");
        for (size_t k = 0; k < DIP_POINTS && !status; k++) profile[k] = scree_average_table_get(&table, k, column);
        if (!status) status = scree_average_dip_find(profile, 1, DIP_POINTS, &found, error);
        if (!status) *dip = found.dip;
        if (!status) *grains = view.grains;
        scree_average_view_close(&view);
    }
    scree_average_table_destroy(&table);
    scree_average_sample_destroy(&sample);
    return status == SCREE_ERROR_INPUT ? SCREE_OK : status;
}

static scree_status conclude_numbers(const scree_context *c, size_t index, double *value, scree_error *error)
{
    scree_pile pile;
    (void)index;
    scree_status status = measure(c, &pile, error);
    if (status) return status;
    value[0] = (double)pile.grains;
    value[1] = pile.top - pile.base;
    value[2] = pile.right - pile.left;
    value[3] = pile.apex;
    value[4] = degrees(0.5 * (pile.angle[0] + pile.angle[1]));
    value[5] = degrees(pile.angle[0]);
    value[6] = degrees(pile.angle[1]);
    value[7] = degrees(0.5 * (pile.fitted[0] + pile.fitted[1]));
    value[8] = degrees(pile.fitted[0]);
    value[9] = degrees(pile.fitted[1]);
    value[10] = pile.weight;
    value[11] = pile.plate / pile.weight;
    value[12] = pile.solid_fraction;
    value[13] = pile.coordination;
    value[14] = pile.middle;
    value[15] = scree_unbalanced_ratio(c->model, c->state, c->table);
    value[16] = (double)scree_births_of(c->state)->lost;
    scree_pile_destroy(&pile);
    return find_dip(c, &value[17], &value[18], error);
}

static void write_outline(FILE *file, const scree_pile *pile)
{
    fputs("x [m],height [m],heap [1]\n", file);
    for (size_t k = 0; k < pile->columns; k++) {
        const scree_pile_column *column = &pile->column[k];
        if (isnan(column->height)) continue;
        fprintf(file, "%.9g,%.9g,%d\n", column->x, column->height, column->x > pile->left && column->x < pile->right);
    }
}

/// Grains that hang on something beside the plate, such as a funnel: they are no part of the pile, or it leans on it.
static void warn_of_hanging(const scree_conclusion *run, const scree_pile *pile)
{
    const numbers *n = scree_model_numbers(&run->s->model, SCREE_SLOT_pile);
    if (!n || n->plate < 0) return;
    const char *name = run->s->model.walls_of_case[n->plate].name;
    if (pile->hanging > 0)
        scree_log_write(run->log, SCREE_LOG_WARNING,
                        "grains that are no part of the pile on wall '%s' touch other walls at %zu points: if these "
                        "are a funnel, it has clogged; make its opening wider",
                        name, pile->hanging);
    if (pile->plate < (1 - PLATE_MISSES) * pile->support)
        scree_log_write(run->log, SCREE_LOG_WARNING,
                        "wall '%s' (measure.plate) bears %.1f %% of the pile, the rest leans on something else that "
                        "stands",
                        name, 100 * pile->plate / pile->support);
}

/// Where no plate is named all that stands bears the pile: a clogged funnel, too, whose grains are no pile on the wall
/// that the sources pour on to at last.
static scree_status warn_of_funnel(const scree_conclusion *run, const scree_context *c, const scree_pile *pile,
                                   scree_error *error)
{
    const numbers *n = scree_model_numbers(c->model, SCREE_SLOT_pile);
    int lowest = -1;
    scree_pile below;
    if (n && n->plate >= 0) return SCREE_OK;
    scree_status status = scree_source_lowest_wall(c->model, c->work->wall_set, &lowest, error);
    if (status || lowest < 0) return status;
    status = scree_pile_measure(c->model, c->state, c->work, c->table, lowest, &below, error);
    if (status) return status;
    if (below.grains < pile->grains)
        scree_log_write(run->log, SCREE_LOG_WARNING,
                        "%zu of the %zu grains of the pile do not rest on wall '%s', the lowest one below the sources, "
                        "but on others alone: if these are a funnel, it has clogged, make its opening wider; give "
                        "measure.plate the name of the wall on which the pile lies",
                        pile->grains - below.grains, pile->grains, c->model->walls_of_case[lowest].name);
    scree_pile_destroy(&below);
    return SCREE_OK;
}

/// What a user may do about a pile that has not come to rest.
static const char *remedy_of_motion(const scree_model *model)
{
    static _Thread_local char text[160];
    const int64_t last = model->stage_count - 1;
    if (scree_modules[model->stages[last].kind]->numbers->pours)
        (void)snprintf(text, sizeof text, "give a smaller stages.%lld.unbalanced_limit, or a stage relax behind it",
                       (long long)last);
    else
        (void)snprintf(text, sizeof text, "lengthen stage '%s'", model->stages[last].name);
    return text;
}

/// What is told of a pile that is not at rest is told of an instant; of none nothing can be told.
static void warn_of_motion(const scree_conclusion *run, const scree_pile *pile)
{
    const double unbalanced = scree_summary_number(run->summary, "unbalanced"),
                 ratio = scree_summary_number(run->summary, "weight_ratio");
    const char *remedy = remedy_of_motion(&run->s->model);
    char text[120];
    if (pile->grains == 0) {
        (void)snprintf(text, sizeof text, "there is no pile: no particle rests on what it would lie on");
        scree_log_write(run->log, SCREE_LOG_WARNING, "%s; if they still fall, %s", text, remedy);
    } else if (unbalanced > AT_REST || fabs(ratio - 1) > WEIGHT_OFF) {
        (void)snprintf(text, sizeof text, "the pile is not at rest: unbalanced %.3g, weight_ratio %.4g", unbalanced,
                       ratio);
        scree_log_write(run->log, SCREE_LOG_WARNING,
                        "%s (at rest: below %g, and 1 to within %g): what is told of it is told of an instant; %s",
                        text, AT_REST, WEIGHT_OFF, remedy);
    } else
        return;
    scree_summary_add_text(run->summary, "warnings", text);
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_pile pile;
    scree_simulation *s = run->s;
    if (s->model.source_count == 0 || s->state.count == 0) return SCREE_OK;
    const scree_context c = {.model = &s->stage_model, .state = &s->state, .work = &s->work, .table = &s->table};
    scree_status status = measure(&c, &pile, error);
    if (status) return status;
    warn_of_hanging(run, &pile);
    status = warn_of_funnel(run, &c, &pile, error);
    warn_of_motion(run, &pile);
    scree_conclude_few(run, "dip", scree_summary_number(run->summary, "dip_element"),
                       "take the mean over several piles with `scree measure`, or pour more particles");
    if (!status) status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_OUTLINE, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (!status) {
        write_outline(file, &pile);
        status = scree_replace_finish(path, file, true, error);
    }
    scree_pile_destroy(&pile);
    return status;
}

const scree_module scree_module_pile = {
    .name = "pile",
    .meaning = "the pile that was poured: height, width, angles of repose, force on its plate",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(numbers),
    .resolve = resolve,
    .columns = SCREE_RESULTS(columns, sample),
    .results = SCREE_RESULTS(results, conclude_numbers),
    .told = told,
    .conclude = conclude,
};
