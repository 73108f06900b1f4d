/// The cases of a sweep's members. Each is read from the text of the sweep's case with all that the sweep sets as
/// overrides, so that everything that --set accepts can vary, and each problem is put where the sweep file says it.
#include "case/case.h"
#include "case/path.h"
#include "sweep/sweep.h"

#include "base/memory.h"
#include "base/units.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// All assignments of a member in the order in which they count; the seed comes last but for the command line.
typedef struct assignments {
    const scree_sweep_assignment **item;
    const char **text;
    size_t count;
    scree_sweep_assignment seed;
    char seed_text[40];
} assignments;

static void add(assignments *all, const scree_sweep_assignment *list, size_t count)
{
    for (size_t i = 0; i < count; i++, all->count++) {
        all->item[all->count] = &list[i];
        all->text[all->count] = list[i].text;
    }
}

static void destroy(assignments *all)
{
    scree_release(&all->item);
    scree_release(&all->text);
}

static scree_status gather(const scree_sweep *sweep, size_t member, assignments *all, scree_error *error)
{
    size_t point = scree_member_point(sweep, member), most = sweep->fixed_count + sweep->last_count + 1;
    *all = (assignments){0};
    for (size_t k = 0; k < sweep->dimension_count; k++)
        most += sweep->dimension[k].setting[scree_point_setting(sweep, point, k)].assignment_count;
    scree_status status = scree_allocate(&all->item, most, sizeof *all->item, error);
    if (!status) status = scree_allocate(&all->text, most, sizeof *all->text, error);
    if (status) {
        destroy(all);
        return status;
    }
    add(all, sweep->fixed, sweep->fixed_count);
    for (size_t k = 0; k < sweep->dimension_count; k++) {
        const scree_sweep_setting *setting = &sweep->dimension[k].setting[scree_point_setting(sweep, point, k)];
        add(all, setting->assignment, setting->assignment_count);
    }
    (void)snprintf(all->seed_text, sizeof all->seed_text, "seed=%lld", (long long)scree_member_seed(sweep, member));
    all->seed = (scree_sweep_assignment){.path = "seed", .text = all->seed_text};
    add(all, &all->seed, 1);
    add(all, sweep->last, sweep->last_count);
    return SCREE_OK;
}

/// Where the sweep file has the value that `problem` is about; false when it is about something else.
static bool find_place(const assignments *all, const scree_error *problem, scree_place *place)
{
    char source[256];
    for (size_t i = 0; i < all->count; i++) {
        (void)snprintf(source, sizeof source, "--set %s", scree_show(all->text[i]).text);
        if (strcmp(source, problem->file) != 0 || !all->item[i]->place.source) continue;
        *place = all->item[i]->place;
        return true;
    }
    return false;
}

static scree_status read_member(const scree_sweep *sweep, const assignments *all, scree_case **out,
                                scree_problems **problems)
{
    scree_case_options options = {.overrides = all->text, .override_count = all->count, .quick = sweep->quick};
    return scree_case_parse(sweep->case_text, sweep->case_length, sweep->case_name, &options, out, problems);
}

scree_status scree_member_case(const scree_sweep *sweep, size_t member, scree_case **out, scree_problems **problems)
{
    assignments all;
    scree_error error;
    *out = NULL;
    if (problems) *problems = NULL;
    scree_status status = gather(sweep, member, &all, &error);
    if (!status) status = read_member(sweep, &all, out, problems);
    destroy(&all);
    return status;
}

scree_status scree_member_resolve(const scree_sweep *sweep, size_t member, scree_case **out, scree_error *error)
{
    scree_problems *problems;
    scree_status status = scree_member_case(sweep, member, out, &problems);
    if (status && scree_problems_count(problems) > 0 && error) *error = *scree_problems_get(problems, 0);
    if (status && scree_problems_count(problems) == 0) scree_error_set_memory(error, sweep->case_length);
    scree_problems_free(problems);
    return status;
}

scree_status scree_member_text(const scree_sweep *sweep, size_t member, char **text, scree_error *error)
{
    scree_case *c;
    size_t length;
    *text = NULL;
    scree_status status = scree_member_resolve(sweep, member, &c, error);
    if (status) return status;
    FILE *memory = open_memstream(text, &length);
    if (!memory)
        status = scree_error_set_memory(error, 4096);
    else
        status = scree_case_write(c, memory, error);
    if (memory && fclose(memory) != 0 && !status) status = scree_error_set_memory(error, 4096);
    scree_case_free(c);
    return status;
}

static void note_problems(scree_reader *reader, const assignments *all, const scree_problems *problems)
{
    for (size_t i = 0; i < scree_problems_count(problems); i++) {
        const scree_error *problem = scree_problems_get(problems, i);
        scree_place place = {problem->file, problem->line, problem->column, SCREE_ORIGIN_FILE};
        (void)find_place(all, problem, &place);
        bool known = false;
        for (size_t k = 0; k < scree_problems_count(reader->problems) && !known; k++) {
            const scree_error *other = scree_problems_get(reader->problems, k);
            known = other->line == place.line && other->column == place.column && place.source &&
                    strcmp(other->file, place.source) == 0 && strcmp(other->message, problem->message) == 0;
        }
        if (!known)
            scree_problem_add(reader, place, problem->field, problem->value, problem->accepted, "%s", problem->message);
    }
}

/// A parameter of the dimension's k-th key, with its numbers where the schema knows a unit.
static void add_parameter(scree_reader *reader, scree_sweep *sweep, size_t dimension, size_t k)
{
    const scree_sweep_dimension *d = &sweep->dimension[dimension];
    scree_sweep_parameter *parameter = &sweep->parameter[sweep->parameter_count];
    double *number = scree_arena_take(reader->arena, d->count * sizeof *number);
    const char **text = scree_arena_take(reader->arena, d->count * sizeof *text);
    if (!number || !text) {
        scree_reader_fail(reader, d->count);
        return;
    }
    *parameter = (scree_sweep_parameter){d->setting[0].assignment[k].path, dimension, NULL, number, text};
    for (size_t i = 0; i < d->count; i++) {
        scree_case *c;
        scree_target target;
        size_t point = i;
        for (size_t j = dimension + 1; j < sweep->dimension_count; j++) point *= sweep->dimension[j].count;
        text[i] = d->setting[i].assignment[k].value;
        number[i] = NAN;
        if (scree_member_case(sweep, point, &c, NULL)) continue;
        bool found =
            scree_path_follow(scree_case_root(c), parameter->name, NULL, d->setting[i].assignment[k].place, &target);
        bool numeric =
            found && !target.element &&
            (target.component || target.key->type == SCREE_KEY_NUMBER || target.key->type == SCREE_KEY_INTEGER);
        const char *unit = numeric && target.key->unit ? target.key->unit : "1";
        if (numeric && scree_units_parse(text[i], unit, &number[i], NULL)) number[i] = NAN;
        if (numeric) parameter->unit = unit;
        scree_case_free(c);
    }
    sweep->parameter_count++;
}

static void add_names(scree_reader *reader, scree_sweep *sweep, size_t dimension)
{
    const scree_sweep_dimension *d = &sweep->dimension[dimension];
    const char **text = scree_arena_take(reader->arena, d->count * sizeof *text);
    if (!text) {
        scree_reader_fail(reader, d->count);
        return;
    }
    for (size_t i = 0; i < d->count; i++) text[i] = d->setting[i].label;
    sweep->parameter[sweep->parameter_count++] = (scree_sweep_parameter){d->name, dimension, NULL, NULL, text};
}

/// A dimension of alternatives has only names: its settings set different keys.
static void list_parameters(scree_reader *reader, scree_sweep *sweep)
{
    size_t most = 0;
    for (size_t i = 0; i < sweep->dimension_count; i++) most += 1 + sweep->dimension[i].setting[0].assignment_count;
    sweep->parameter = scree_arena_take(reader->arena, most * sizeof *sweep->parameter);
    if (!sweep->parameter) scree_reader_fail(reader, most);
    for (size_t i = 0; i < sweep->dimension_count && !reader->failure.status; i++) {
        const scree_sweep_dimension *d = &sweep->dimension[i];
        bool alternatives = sweep->config.vary[i].alternative_count > 0;
        if (d->named) add_names(reader, sweep, i);
        for (size_t k = 0; !alternatives && k < d->setting[0].assignment_count; k++) add_parameter(reader, sweep, i, k);
    }
}

void scree_sweep_check_cases(scree_reader *reader, scree_sweep *sweep)
{
    for (size_t i = 0; i < sweep->point_count && !reader->failure.status; i++) {
        assignments all;
        scree_case *c = NULL;
        scree_problems *problems = NULL;
        scree_status status = gather(sweep, i, &all, &reader->failure);
        if (status) return;
        if (read_member(sweep, &all, &c, &problems)) note_problems(reader, &all, problems);
        scree_problems_free(problems);
        scree_case_free(c);
        destroy(&all);
    }
    if (scree_problems_count(reader->problems) == 0 && !reader->failure.status) list_parameters(reader, sweep);
}
