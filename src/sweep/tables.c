/// members.csv, table.csv and sweep.json. Numbers are SI and have 15 significant digits in the tables; texts are
/// quoted where CSV wants it (RFC 4180).
#include "sweep/results.h"

#include "io/run_directory.h"

#include <jansson.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static void put_text(FILE *file, const char *text)
{
    bool quoted = strpbrk(text, ",\"\n") != NULL;
    if (quoted) (void)fputc('"', file);
    for (const char *c = text; *c; c++) {
        if (*c == '"') (void)fputc('"', file);
        (void)fputc(*c, file);
    }
    if (quoted) (void)fputc('"', file);
}

static void put_number(FILE *file, double value)
{
    if (isfinite(value))
        (void)fprintf(file, "%.15g", value);
    else
        (void)fputs("nan", file);
}

static void put_parameter_heads(FILE *file, const scree_sweep *sweep)
{
    for (size_t k = 0; k < sweep->parameter_count; k++) {
        const scree_sweep_parameter *parameter = &sweep->parameter[k];
        char head[256];
        (void)snprintf(head, sizeof head, parameter->unit ? "%s [%s]" : "%s", parameter->name, parameter->unit);
        (void)fputc(',', file);
        put_text(file, head);
    }
}

static void put_parameters(FILE *file, const scree_sweep *sweep, size_t point)
{
    for (size_t k = 0; k < sweep->parameter_count; k++) {
        const scree_sweep_parameter *parameter = &sweep->parameter[k];
        size_t setting = scree_point_setting(sweep, point, parameter->dimension);
        (void)fputc(',', file);
        if (parameter->unit && isfinite(parameter->number[setting]))
            put_number(file, parameter->number[setting]);
        else
            put_text(file, parameter->text[setting]);
    }
}

static bool put_members(FILE *file, const scree_sweep_results *results)
{
    const scree_sweep *sweep = results->sweep;
    (void)fputs("member,folder,point,realisation,seed", file);
    put_parameter_heads(file, sweep);
    (void)fputs(",status,wall_time [s]", file);
    for (size_t k = 0; k < sweep->measure_count; k++) (void)fprintf(file, ",%s", sweep->measure[k]);
    for (size_t i = 0; i < sweep->member_count; i++) {
        size_t point = scree_member_point(sweep, i);
        (void)fprintf(file, "\n%zu,%s,%zu,%zu,%lld", i, sweep->folder[i], point, i / sweep->point_count,
                      (long long)scree_member_seed(sweep, i));
        put_parameters(file, sweep, point);
        (void)fprintf(file, ",%s,", scree_member_state_name(results->state[i]));
        put_number(file, results->wall_time[i]);
        for (size_t k = 0; k < sweep->measure_count; k++) {
            (void)fputc(',', file);
            put_number(file, results->value[i * sweep->measure_count + k]);
        }
    }
    (void)fputc('\n', file);
    return true;
}

static bool put_points(FILE *file, const scree_sweep_results *results)
{
    const scree_sweep *sweep = results->sweep;
    static const char *const tails[] = {"", ".deviation", ".low", ".high", ".n", ".of"};
    (void)fputs("point,name", file);
    put_parameter_heads(file, sweep);
    for (size_t k = 0; k < sweep->measure_count; k++)
        for (size_t j = 0; j < sizeof tails / sizeof *tails; j++)
            (void)fprintf(file, ",%s%s", sweep->measure[k], tails[j]);
    for (size_t point = 0; point < sweep->point_count; point++) {
        (void)fprintf(file, "\n%zu,%s", point, sweep->point[point]);
        put_parameters(file, sweep, point);
        for (size_t k = 0; k < sweep->measure_count; k++) {
            const scree_estimate *e = &results->estimate[point * sweep->measure_count + k];
            const double shown[] = {e->mean, e->deviation, e->mean - e->half, e->mean + e->half};
            for (size_t j = 0; j < 4; j++) {
                (void)fputc(',', file);
                put_number(file, shown[j]);
            }
            (void)fprintf(file, ",%zu,%zu", e->count, e->of);
        }
    }
    (void)fputc('\n', file);
    return true;
}

/// Writes a file of the sweep directory as a whole; `put` is false when it ran out of memory.
static scree_status write_file(const scree_sweep_results *results, const char *name,
                               bool (*put)(FILE *file, const scree_sweep_results *results), scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, results->options->output, name, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    bool whole = put(file, results);
    status = scree_replace_finish(path, file, whole, error);
    return status || whole ? status : scree_error_set(error, SCREE_ERROR_IO, "cannot write '%s': out of memory", path);
}

scree_status scree_sweep_write_tables(const scree_sweep_results *results, scree_error *error)
{
    scree_status status = write_file(results, "members.csv", put_members, error);
    return status ? status : write_file(results, "table.csv", put_points, error);
}

static json_t *describe_points(const scree_sweep_results *results)
{
    const scree_sweep *sweep = results->sweep;
    json_t *points = json_array();
    for (size_t i = 0; i < sweep->point_count; i++) {
        json_t *values = json_object();
        char label[256];
        for (size_t k = 0; k < sweep->parameter_count; k++) {
            const scree_sweep_parameter *parameter = &sweep->parameter[k];
            size_t setting = scree_point_setting(sweep, i, parameter->dimension);
            (void)json_object_set_new(values, parameter->name, json_string(parameter->text[setting]));
        }
        scree_point_label(sweep, i, SIZE_MAX, label, sizeof label);
        (void)json_array_append_new(
            points, json_pack("{s:s, s:s, s:o}", "name", sweep->point[i], "label", label, "values", values));
    }
    return points;
}

static json_t *describe_members(const scree_sweep_results *results)
{
    const scree_sweep *sweep = results->sweep;
    json_t *members = json_array();
    for (size_t i = 0; i < sweep->member_count; i++)
        (void)json_array_append_new(members, json_pack("{s:s, s:I, s:I, s:I, s:s}", "folder", sweep->folder[i], "point",
                                                       (json_int_t)scree_member_point(sweep, i), "realisation",
                                                       (json_int_t)(i / sweep->point_count), "seed",
                                                       (json_int_t)scree_member_seed(sweep, i), "status",
                                                       scree_member_state_name(results->state[i])));
    return members;
}

static bool put_record(FILE *file, const scree_sweep_results *results)
{
    const scree_sweep *sweep = results->sweep;
    json_t *root = json_pack("{s:s, s:s, s:s, s:b, s:I, s:f, s:s, s:o, s:o}", "sweep", sweep->config.name, "source",
                             sweep->source, "case", sweep->config.base, "quick", sweep->quick, "realisations",
                             (json_int_t)sweep->realisations, "confidence", sweep->config.confidence, "version",
                             SCREE_VERSION, "points", describe_points(results), "members", describe_members(results));
    bool whole = root != NULL;
    // What cannot be written shows in the stream's error flag.
    if (whole) (void)json_dumpf(root, file, JSON_INDENT(2) | JSON_PRESERVE_ORDER);
    (void)fputc('\n', file);
    json_decref(root);
    return whole;
}

scree_status scree_sweep_write_record(const scree_sweep_results *results, scree_error *error)
{
    return write_file(results, "sweep.json", put_record, error);
}
