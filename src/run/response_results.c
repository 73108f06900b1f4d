/// Response of a layer to a load on one grain at its top: what it is like at the end of the run less what it was like
/// before the load, with the contacts that the load has made, lost or brought to sliding (average/response.h).
///
/// The unloaded layer is that of the last snapshot before the load begins, the loaded one that of the last one, where
/// the load still acts; its force is that of series.csv. Snapshots in between tell which contacts slide while it grows.
/// Up to which load nothing changes: response_watch.c. Tables: response.csv (along cuts), response-depths.csv (their
/// peaks), response-contacts.csv.
#include "average/strain.h"
#include "base/vectors.h"
#include "case/check.h"
#include "io/run_directory.h"
#include "io/sample_file.h"
#include "load/prescribed.h"
#include "module/key_rows.h"
#include "run/conclusion.h"
#include "run/response_curves.h"
#include "run/response_load.h"
#include "selection/selection.h"
#include "state/body.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- keys --------------------------------------------------------------------------------------------------------

typedef struct config {
    char *load;     ///< its name
    double element; ///< m
    double poisson; ///< 1
} config;

static const scree_key keys[] = {
    {.name = "response_load",
     .type = SCREE_KEY_WORD,
     .standard = "auto",
     FROM("1"),
     TO("63"),
     .offset = offsetof(config, load),
     .meaning = "Name of the load `prescribed` whose response is told: it presses on one grain at the top, from its "
                "first stage to the end of the run. auto: none."},
    {.name = "response_element",
     .type = SCREE_KEY_NUMBER,
     .unit = "m",
     .standard = "auto",
     ABOVE("0 m"),
     TO("100 km"),
     .offset = offsetof(config, element),
     .meaning = "Side of the elements that the response is a mean over; auto: two mean diameters. Not used without "
                "`response_load`."},
    {.name = "response_poisson_ratio",
     .type = SCREE_KEY_NUMBER,
     .unit = "1",
     .standard = "0.3",
     ABOVE("-1"),
     TO("0.5"),
     .offset = offsetof(config, poisson),
     .meaning = "Of the elastic layer on a bonded base that the response is compared with, in plane strain."},
};

static const config *own_config(const scree_config *whole)
{
    return whole->measure.own ? scree_config_own(&scree_module_response, "measure", whole->measure.own) : NULL;
}

/// Number of the load of this name; -1: there is none.
static int64_t find_load(const scree_config_load *loads, int64_t count, const char *name)
{
    for (int64_t k = 0; k < count && name; k++) {
        const scree_prescribed_config *load = scree_prescribed_config_of(loads, k);
        if (load && scree_prescribed_name(load) && strcmp(scree_prescribed_name(load), name) == 0) return k;
    }
    return -1;
}

/// A selection that the case lets have several grains. What hangs on the sample is refused when the load begins.
static void check_selection(scree_reader *reader, const scree_config *whole, int64_t load)
{
    const char *name = scree_prescribed_config_of(whole->loads, load)->selection;
    const int64_t index = name ? scree_config_selection_find(whole->selections, whole->selection_count, name) : -1;
    const scree_config_selection *selection = index >= 0 ? &whole->selections[index] : NULL;
    if (!selection || selection->kind < 0 || !selection->own) return;
    const scree_selection_kind *kind = scree_modules[selection->kind]->selection;
    const size_t number = kind->number ? kind->number(selection->own) : 1;
    if (number > 1)
        scree_rule_refuse(reader, "measure.response_load", "a load on one grain, such as that of a selection `top`",
                          "the load presses on the %zu particles of '%s': the response is that to a load on one grain",
                          number, name);
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    const config *own = own_config(whole);
    const char *names[SCREE_LOADS];
    size_t count = 0;
    if (!own || !own->load) return;
    for (int64_t k = 0; k < whole->load_count && count < SCREE_LOADS; k++) {
        const scree_prescribed_config *load = scree_prescribed_config_of(whole->loads, k);
        if (load && scree_prescribed_name(load)) names[count++] = scree_prescribed_name(load);
    }
    if (find_load(whole->loads, whole->load_count, own->load) < 0)
        scree_rule_refuse_name(reader, "measure.response_load", "load of the kind prescribed", own->load, names, count);
    else if (whole->dimension != 2 || whole->boundary.periodic > 0)
        scree_rule_refuse(reader, "measure.response_load", "auto",
                          "responses are those of layers in two dimensions that do not repeat themselves");
    else
        check_selection(reader, whole, find_load(whole->loads, whole->load_count, own->load));
}

typedef scree_response_numbers numbers;

static scree_status resolve(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_response, "measure", model->config->measure.own);
    numbers *n = scree_model_reserve_numbers(model, SCREE_SLOT_response);
    (void)error;
    *n = (numbers){.load = -1};
    if (!own || !own->load) return SCREE_OK;
    n->load = find_load(model->loads, model->load_count, own->load);
    n->element = own->element > 0 ? own->element : 0;
    n->poisson = own->poisson;
    return SCREE_OK;
}

/// Its selection and its element are looked for among all bodies.
static bool begins_whole(const scree_context *c)
{
    return scree_response_numbers_of(c->model) != NULL;
}

static scree_status begin(const scree_context *c, scree_error *error)
{
    return scree_response_load_begins(c) ? scree_response_check_load(c, error) : SCREE_OK;
}

// ---- results -----------------------------------------------------------------------------------------------------

#define AT(name, unit, meaning)                                                                                        \
    {name "_quarter", unit, meaning ", at a quarter of the depth of the layer"},                                       \
        {name "_half", unit, "the same at a half"}, {name "_three_quarters", unit, "the same at three quarters"},      \
    {                                                                                                                  \
        name "_bottom", unit, "the same in elements that stand on the base"                                            \
    }
static const scree_result results[] = {
    {"response_force", "N", "load at the end (measure.response_load), downwards"},
    {"response_grain_weights", "1", "the same over the mean weight of a grain"},
    {"response_thickness", "m", "of the layer, from the top of the loaded grain to the bottom of the lowest one"},
    {"response_element", "m", "side of the elements that all is a mean over"},
    {"response_element_grains", "1", "grains in them at the mean density of the layer"},
    {"response_missing", "1", "largest part of the load that is missing in what a row of elements and walls bear"},
    {"response_contacts", "1", "contacts of grains before the load"},
    {"response_made", "1", "contacts that there are with the load alone"},
    {"response_lost", "1", "contacts that there were before the load alone"},
    {"response_sliding", "1",
     "contacts whose friction is used up (to 0.1 %) in a snapshot under the load and was not before"},
    {"response_order", "1",
     "Re sum f exp(6 i angle) / sum f of the normal forces f between grains under load: 1 where all point along "
     "multiples of 60 degrees"},
    {"response_force_order", "1", "the same of the whole forces, friction included"},
    {"response_unbalanced", "1", "the larger unbalanced ratio of both samples"},
    AT("response_peak", "1", "largest vertical response times depth over load; of the half-space 2 / pi"),
    AT("response_horizontal", "1", "largest horizontal response times depth over load"),
    AT("response_dip", "1", "1 - vertical response below the load over the largest one; 0: a single peak"),
    AT("response_place", "1", "distance of the largest vertical response from the load over the depth"),
    AT("response_width", "m", "distance from the load beyond which the vertical response is below half of the largest"),
    AT("response_centre", "1", "mean vertical response within 1/5 of the depth of the load, times depth over load"),
    AT("response_horizontal_centre", "1", "mean horizontal response within 1/5 of the depth, likewise"),
    AT("response_beside", "1", "the same from 2/5 to 4/5 of the depth beside the load"),
    AT("response_reach", "m", "distance from the load within which half of the vertical response lies"),
    AT("response_strain_dip", "1", "1 - vertical strain below the load over the largest one"),
    {"response_widening", "1", "p in reach ~ depth^p; 1: linear"},
    {"response_over_half_space", "1",
     "mean vertical response at the base within 1/5 of the depth of the load over that of the elastic half-space"},
    {"response_over_smooth", "1", "the same of the elastic layer on a smooth rigid base"},
    {"response_over_bonded", "1", "the same of the elastic layer bonded to a rigid base"},
    {"response_misfit_half_space", "1",
     "root mean square difference from the half-space at the base, within a thickness, over its peak"},
    {"response_misfit_smooth", "1", "the same of the layer on a smooth base"},
    {"response_misfit_bonded", "1", "the same of the layer bonded to its base"},
    {"response_horizontal_over_half_space", "1",
     "largest horizontal response at the base over that of the elastic half-space"},
    {"response_horizontal_over_smooth", "1", "the same of the elastic layer on a smooth rigid base"},
    {"response_horizontal_over_bonded", "1", "the same of the elastic layer bonded to a rigid base"},
    {"response_horizontal_misfit_half_space", "1",
     "root mean square difference of the horizontal response from the half-space, likewise"},
    {"response_horizontal_misfit_smooth", "1", "the same of the layer on a smooth base"},
    {"response_horizontal_misfit_bonded", "1", "the same of the layer bonded to its base"},
};

/// What is needed while results are found.
typedef struct finding {
    const scree_conclusion *run;
    const numbers *n;
    scree_snapshot_mark *mark;
    size_t count, first; ///< of snapshots; the unloaded one
    const double *time, *force[2];
    scree_average_sample before, after;
    scree_response response;
    scree_response_changes changes;
    scree_response_curves *curves;
} finding;

static void set(const finding *f, const char *name, const char *where, double value)
{
    char text[64];
    (void)snprintf(text, sizeof text, "response_%s%s", name, where);
    scree_summary_set_number(f->run->summary, text, value);
}

/// Force of the load at a time [N], downwards, from series.csv.
static double force_at(const finding *f, double time)
{
    size_t best = 0;
    for (size_t k = 0; k < f->run->series->row_count; k++)
        if (fabs(f->time[k] - time) <= fabs(f->time[best] - time)) best = k;
    return -f->force[1][best];
}

static scree_status find_snapshots(finding *f, scree_error *error)
{
    const scree_prescribed *all = scree_prescribed_of(&f->run->s->state);
    const scree_prescribed_config *own = scree_prescribed_config_of(f->run->s->model.loads, f->n->load);
    char column[SCREE_RESULT_NAME];
    scree_status status = scree_snapshot_marks(f->run->directory, &f->mark, &f->count, error);
    if (status) return status;
    const double begun = all->begun[f->n->load] * (1 + 1e-12);
    while (f->first + 1 < f->count && f->mark[f->first + 1].time <= begun) f->first++;
    f->time = scree_series_get(f->run->series, "time");
    for (int k = 0; k < 2; k++) {
        (void)snprintf(column, sizeof column, "%s_exerted_force_%c", scree_prescribed_name(own), "xy"[k]);
        f->force[k] = scree_series_get(f->run->series, column);
    }
    if (f->first + 1 < f->count && f->time && f->force[1] && f->run->series->row_count > 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "there are no snapshots before and after the load");
}

/// Friction coefficient between two grains; between a grain and what is none it is taken to be that of two such grains.
static double friction_of(const scree_simulation *s, uint32_t first, uint32_t second)
{
    const uint32_t one = scree_state_row_of(&s->state, first);
    const uint32_t other = second == SCREE_AVERAGE_OUTSIDE ? one : scree_state_row_of(&s->state, second);
    if (one == SCREE_NO_ROW || other == SCREE_NO_ROW) return NAN;
    return s->stage_model.pairs[scree_body_material(&s->state, one)][scree_body_material(&s->state, other)]
        .value[SCREE_FRICTION];
}

/// A snapshot; contacts slide where their friction is used up, whether they slip at this instant or not.
static scree_status read_sample(const finding *f, size_t mark, scree_average_sample *sample, scree_error *error)
{
    scree_status status = scree_sample_read(f->run->directory, f->mark[mark].index, sample, error);
    for (size_t k = 0; k < sample->contacts && !status; k++) {
        scree_average_contact *c = &sample->contact[k];
        const uint32_t first = sample->grain[c->first].id;
        const uint32_t second =
            c->second == SCREE_AVERAGE_OUTSIDE ? SCREE_AVERAGE_OUTSIDE : sample->grain[c->second].id;
        c->sliding = scree_response_slides(friction_of(f->run->s, first, second), c->tangential_force, c->normal_force);
    }
    return status;
}

static scree_status read_samples(finding *f, scree_error *error)
{
    const scree_simulation *s = f->run->s;
    uint32_t row;
    scree_status status = scree_response_find_loaded(&s->model, &s->state, f->n->load, &row, error);
    if (!status) status = read_sample(f, f->first, &f->before, error);
    if (!status) status = read_sample(f, f->count - 1, &f->after, error);
    if (!status) status = scree_average_move(&f->after, &f->before, error);
    if (!status) status = scree_average_sample_finish(&f->before, error);
    if (!status) status = scree_average_sample_finish(&f->after, error);
    if (!status) status = scree_response_compare(&f->before, &f->after, &f->changes, error);
    if (!status)
        status = scree_response_open(&f->before, &f->after, s->state.id[row], f->n->element, &f->response, error);
    f->response.force = force_at(f, f->mark[f->count - 1].time);
    const scree_prescribed_config *own = scree_prescribed_config_of(s->model.loads, f->n->load);
    if (!status && own->until_force > 0 && scree_length(scree_prescribed_of(&s->state)->given[f->n->load]) == 0)
        status = scree_error_set(error, SCREE_ERROR_INPUT,
                                 "the layer gives way: the load has not met its force (until_force) and still moves; "
                                 "take a smaller force");
    if (!status && !(f->response.force > 0))
        status = scree_error_set(error, SCREE_ERROR_INPUT, "the load pulls, or is none at the end");
    return status;
}

/// Whether the contact of these bodies is known to have slid.
static bool is_noted(const scree_response_changes *all, const scree_response_change *change)
{
    for (size_t k = 0; k < all->count; k++)
        if (all->list[k].kind == SCREE_RESPONSE_SLIDING && all->list[k].first == change->first &&
            all->list[k].second == change->second)
            return true;
    return false;
}

/// Adds the contacts that slid at an instant under the load to those that slide at the end.
static scree_status add_sliding(finding *f, const scree_response_changes *now, scree_error *error)
{
    scree_response_changes *all = &f->changes;
    const size_t room = all->count + now->sliding;
    scree_status status = scree_reallocate(&all->list, all->count, room + 1, sizeof *all->list, error);
    for (size_t k = 0; k < now->count && !status; k++) {
        if (now->list[k].kind != SCREE_RESPONSE_SLIDING || is_noted(all, &now->list[k])) continue;
        all->list[all->count++] = now->list[k];
        all->sliding++;
    }
    return status;
}

/// Goes through the snapshots under load: what slid.
static scree_status follow_load(finding *f, scree_error *error)
{
    for (size_t k = f->first + 1; k < f->count; k++) {
        scree_average_sample sample;
        scree_response_changes changes = {0};
        scree_status status = read_sample(f, k, &sample, error);
        if (!status) status = scree_response_compare(&f->before, &sample, &changes, error);
        if (!status) status = add_sliding(f, &changes, error);
        scree_average_sample_destroy(&sample);
        scree_release(&changes.list);
        if (status) return status;
    }
    return SCREE_OK;
}

static void set_depths(const finding *f)
{
    static const char *const where[] = {"_quarter", "_half", "_three_quarters", "_bottom"};
    for (int k = 0; k < 4; k++) {
        const scree_response_level *level = &f->curves->level[2 * k + 1];
        const scree_response_peak *peak = level->peak;
        const double unit = level->depth * f->after.thickness / f->response.force;
        set(f, "peak", where[k], peak[SCREE_RESPONSE_VERTICAL].most * unit);
        set(f, "horizontal", where[k], peak[SCREE_RESPONSE_HORIZONTAL].most * unit);
        set(f, "horizontal_centre", where[k], level->centre[SCREE_RESPONSE_HORIZONTAL] * unit);
        set(f, "dip", where[k], peak[SCREE_RESPONSE_VERTICAL].dip);
        set(f, "place", where[k], peak[SCREE_RESPONSE_VERTICAL].place / level->depth);
        set(f, "width", where[k], peak[SCREE_RESPONSE_VERTICAL].width);
        set(f, "centre", where[k], level->centre[SCREE_RESPONSE_VERTICAL] * unit);
        set(f, "beside", where[k], level->beside * unit);
        set(f, "reach", where[k], level->reach);
        set(f, "strain_dip", where[k], peak[SCREE_RESPONSE_STRAIN].dip);
    }
}

static void set_theories(const finding *f)
{
    static const char *const name[] = {"half_space", "smooth", "bonded"};
    const scree_response_level *base = &f->curves->level[SCREE_RESPONSE_LEVELS - 1];
    const double *centre = base->centre;
    set(f, "widening", "", scree_response_widening(f->curves));
    for (int k = 0; k < 3; k++) {
        const scree_response_curve theory = (scree_response_curve)(SCREE_RESPONSE_HALF_SPACE + k);
        set(f, "over_", name[k], centre[SCREE_RESPONSE_VERTICAL] / centre[theory]);
        set(f, "misfit_", name[k], scree_response_misfit(f->curves, theory));
        const scree_response_curve across = (scree_response_curve)(SCREE_RESPONSE_HALF_SPACE_HORIZONTAL + k);
        set(f, "horizontal_over_", name[k], base->peak[SCREE_RESPONSE_HORIZONTAL].most / base->peak[across].most);
        set(f, "horizontal_misfit_", name[k], scree_response_misfit(f->curves, across));
    }
}

/// Grains in an element, at the density of the layer from end to end.
static double grains_of(const finding *f)
{
    const scree_response *r = &f->response;
    const double area = (r->right - r->left) * (r->top - r->base);
    return (double)f->before.counted * r->side * r->side / area;
}

static scree_status set_results(finding *f, scree_error *error)
{
    double missing = 0, contacts = 0;
    scree_status status = follow_load(f, error);
    if (status) return status;
    for (int k = 0; k < SCREE_RESPONSE_LEVELS; k++) missing = fmax(missing, fabs(f->curves->level[k].missing));
    for (size_t c = 0; c < f->before.contacts; c++) contacts += f->before.grain[f->before.contact[c].first].counted;
    set(f, "force", "", f->response.force);
    set(f, "grain_weights", "",
        f->response.force * (double)f->before.counted / (-f->before.mass * f->before.gravity[1]));
    set(f, "thickness", "", f->curves->thickness);
    const double grains = grains_of(f);
    set(f, "element", "", f->response.side);
    set(f, "element_grains", "", grains);
    scree_conclude_few(f->run, "response", grains,
                       "take the mean over several layers, or a larger `measure.response_element`");
    set(f, "missing", "", missing);
    set(f, "contacts", "", contacts);
    set(f, "made", "", (double)f->changes.made);
    set(f, "lost", "", (double)f->changes.lost);
    set(f, "sliding", "", (double)f->changes.sliding);
    set(f, "order", "", scree_response_order(&f->after, true));
    set(f, "force_order", "", scree_response_order(&f->after, false));
    set(f, "unbalanced", "", fmax(f->before.unbalanced_ratio, f->after.unbalanced_ratio));
    set_depths(f);
    set_theories(f);
    return SCREE_OK;
}

// ---- tables ------------------------------------------------------------------------------------------------------

static const char *const curve_names[SCREE_RESPONSE_CURVES] = {"vertical [Pa]",
                                                               "horizontal [Pa]",
                                                               "strain [1]",
                                                               "half_space [Pa]",
                                                               "smooth [Pa]",
                                                               "bonded [Pa]",
                                                               "half_space_horizontal [Pa]",
                                                               "smooth_horizontal [Pa]",
                                                               "bonded_horizontal [Pa]"};

static void write_cuts(FILE *file, const finding *f)
{
    fputs("depth [m],x [m],left [Pa],right [Pa]", file);
    for (int c = 0; c < SCREE_RESPONSE_CURVES; c++) fprintf(file, ",%s", curve_names[c]);
    fputc('\n', file);
    for (int k = 0; k < SCREE_RESPONSE_LEVELS; k++)
        for (size_t i = 0; i < f->curves->count; i++) {
            const scree_response_level *level = &f->curves->level[k];
            fprintf(file, "%.9g,%.9g,%.9g,%.9g", level->depth, f->curves->gap * (double)i, level->left[i],
                    level->right[i]);
            for (int c = 0; c < SCREE_RESPONSE_CURVES; c++) fprintf(file, ",%.9g", level->value[c][i]);
            fputc('\n', file);
        }
}

static void write_depths(FILE *file, const finding *f)
{
    fputs("depth [m],missing [1],peak [Pa],place [m],dip [1],width [m],reach [m],horizontal_peak [Pa],strain_peak "
          "[1],strain_dip "
          "[1],half_space_peak [Pa],smooth_peak [Pa],bonded_peak [Pa],half_space_width [m],smooth_width [m],"
          "bonded_width [m]\n",
          file);
    for (int k = 0; k < SCREE_RESPONSE_LEVELS; k++) {
        const scree_response_level *level = &f->curves->level[k];
        const scree_response_peak *p = level->peak;
        fprintf(file, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g", level->depth, level->missing,
                p[SCREE_RESPONSE_VERTICAL].most, p[SCREE_RESPONSE_VERTICAL].place, p[SCREE_RESPONSE_VERTICAL].dip,
                p[SCREE_RESPONSE_VERTICAL].width, level->reach, p[SCREE_RESPONSE_HORIZONTAL].most,
                p[SCREE_RESPONSE_STRAIN].most, p[SCREE_RESPONSE_STRAIN].dip);
        for (int c = SCREE_RESPONSE_HALF_SPACE; c <= SCREE_RESPONSE_BONDED; c++) fprintf(file, ",%.9g", p[c].most);
        for (int c = SCREE_RESPONSE_HALF_SPACE; c <= SCREE_RESPONSE_BONDED; c++) fprintf(file, ",%.9g", p[c].width);
        fputc('\n', file);
    }
}

static void write_contacts(FILE *file, const finding *f)
{
    static const char *const kind[] = {"made", "lost", "sliding"};
    fputs("change,first,second,x [m],y [m],normal_force_before [N],normal_force_after [N]\n", file);
    for (size_t k = 0; k < f->changes.count; k++) {
        const scree_response_change *c = &f->changes.list[k];
        fprintf(file, "%s,%u,", kind[c->kind], c->first);
        if (c->second == SCREE_AVERAGE_OUTSIDE)
            fputs("wall", file);
        else
            fprintf(file, "%u", c->second);
        fprintf(file, ",%.9g,%.9g,%.9g,%.9g\n", c->point[0], c->point[1], c->before, c->after);
    }
}

static scree_status write_table(const finding *f, const char *name, void (*write)(FILE *, const finding *),
                                scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, f->run->directory, name, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    write(file, f);
    return scree_replace_finish(path, file, true, error);
}

// ---- the whole ---------------------------------------------------------------------------------------------------

static scree_status find_all(finding *f, scree_error *error)
{
    scree_status status = find_snapshots(f, error);
    if (!status) status = read_samples(f, error);
    if (!status) status = scree_allocate(&f->curves, 1, sizeof *f->curves, error);
    if (!status) status = scree_response_curves_find(&f->response, f->n->poisson, f->curves, error);
    if (!status) status = set_results(f, error);
    if (!status) status = write_table(f, SCREE_FILE_RESPONSE, write_cuts, error);
    if (!status) status = write_table(f, SCREE_FILE_RESPONSE_DEPTHS, write_depths, error);
    if (!status) status = write_table(f, SCREE_FILE_RESPONSE_CONTACTS, write_contacts, error);
    return status;
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    scree_error why = {0};
    finding f = {.run = run, .n = scree_response_numbers_of(&run->s->model)};
    // A run that has been stopped before a step under the load has none.
    const scree_prescribed *all = scree_prescribed_of(&run->s->state);
    if (!f.n || !all->acts[f.n->load] || !(scree_state_time(&run->s->state) > all->begun[f.n->load])) return SCREE_OK;
    scree_status status = find_all(&f, &why);
    scree_release(&f.mark);
    scree_release(&f.changes.list);
    scree_release(&f.curves);
    scree_average_sample_destroy(&f.before);
    scree_average_sample_destroy(&f.after);
    if (status == SCREE_ERROR_INPUT)
        scree_log_write(run->log, SCREE_LOG_WARNING, "no response: %s", why.message);
    else if (status && error)
        *error = why;
    return status == SCREE_ERROR_INPUT ? SCREE_OK : status;
}

const scree_module scree_module_response = {
    .name = "response",
    .meaning = "response of a layer to a load on one grain at its top: stresses, strains and contacts, loaded less "
               "unloaded",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(numbers),
    .resolve = resolve,
    .begin = begin,
    .begins_whole = begins_whole,
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
