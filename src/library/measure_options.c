/// Options of scree_measure.
#include "library/measure.h"

#include "base/units.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// A number and nothing behind it. False: *value stays as it is, so that "30 mm" leaves no 30 behind.
static bool read_number(const char *text, double *value)
{
    char *end;
    const double number = strtod(text, &end);
    const bool whole = end != text && *end == 0 && isfinite(number);
    if (whole) *value = number;
    return whole;
}

static scree_status read_fields(const char *text, unsigned *fields, scree_error *error)
{
    const char *accepted = "density, coordination, stress, fabric, inertia, velocity, elastic, kinetic";
    *fields = 0;
    for (const char *at = text; *at;) {
        const size_t length = strcspn(at, ",");
        int k = 0;
        while (k < SCREE_AVERAGE_FIELDS && !(strlen(scree_average_field_names[k]) == length &&
                                             strncmp(scree_average_field_names[k], at, length) == 0))
            k++;
        if (k == SCREE_AVERAGE_FIELDS)
            return scree_error_refuse(error, "--fields", accepted, "there is no field '%.*s'", (int)length, at);
        *fields |= 1U << k;
        at += length;
        at += *at == ',';
    }
    return *fields ? SCREE_OK : scree_error_refuse(error, "--fields", accepted, "no field is named");
}

/// A number of cuts, or their heights.
static scree_status read_cuts(const char *text, scree_average_plan *plan, scree_error *error)
{
    const char *accepted = "a number from 1 to 64, or relative heights from 0 to 1 with commas";
    double value;
    plan->cuts = 0;
    if (read_number(text, &value) && value == floor(value) && value >= 1 && value <= SCREE_AVERAGE_CUTS) {
        plan->cuts = (size_t)value;
        for (size_t k = 0; k < plan->cuts; k++) plan->height[k] = (double)k / (double)plan->cuts;
        return SCREE_OK;
    }
    for (const char *at = text; *at;) {
        char *end;
        value = strtod(at, &end);
        if (end == at || (*end && *end != ',') || !(value >= 0 && value <= 1) || plan->cuts == SCREE_AVERAGE_CUTS)
            return scree_error_refuse(error, "--cuts", accepted, "'%s' says no heights of cuts", text);
        // In their order: the first cut is the lowest one to whatever is told of that.
        size_t place = plan->cuts++;
        for (; place > 0 && plan->height[place - 1] > value; place--) plan->height[place] = plan->height[place - 1];
        plan->height[place] = value;
        at = end + (*end == ',');
    }
    return plan->cuts > 0 ? SCREE_OK : scree_error_refuse(error, "--cuts", accepted, "no cut is named");
}

static scree_status read_sizes(const char *text, scree_average_plan *plan, scree_error *error)
{
    const char *accepted = "numbers of grains that grow, with commas, such as 5,10,20,50,100,200,400,800; up to 32";
    plan->sizes = 0;
    for (const char *at = text; *at;) {
        char *end;
        const double value = strtod(at, &end);
        const double last = plan->sizes > 0 ? plan->size[plan->sizes - 1] : 0;
        if (end == at || (*end && *end != ',') || !(value >= 1 && value > last && value < 1e12) ||
            plan->sizes == SCREE_AVERAGE_SIZES)
            return scree_error_refuse(error, "--sizes", accepted, "'%s' says no sizes of elements", text);
        plan->size[plan->sizes++] = value;
        at = end + (*end == ',');
    }
    return plan->sizes > 0 ? SCREE_OK : scree_error_refuse(error, "--sizes", accepted, "no size is named");
}

/// Whether a word means a theory; `wedge` means all four of them, `layer` those of layers.
static bool means(const char *word, size_t length, const char *theory)
{
    if (length == 5 && strncmp(word, "wedge", 5) == 0) return strncmp(theory, "wedge_", 6) == 0;
    if (length == 5 && strncmp(word, "layer", 5) == 0) return scree_fit_is_layer(theory);
    return strlen(theory) == length && strncmp(theory, word, length) == 0;
}

static scree_status read_fits(const char *text, measure_plan *plan, scree_error *error)
{
    const char *accepted = "of piles ife, bcc, fpa, osl, oriented, wedge, wedge_dip, wedge_smooth, wedge_peak, "
                           "wedge_core; of layers layer, flamant, layer_smooth, layer_bonded";
    size_t layers = 0;
    for (const char *at = text; *at;) {
        const size_t length = strcspn(at, ","), before = plan->fits;
        const char *name;
        for (size_t k = 0; (name = scree_fit_theory_name(k)); k++) {
            if (!means(at, length, name) || plan->fits == MEASURE_FITS) continue;
            plan->fit[plan->fits++] = name;
            layers += scree_fit_is_layer(name);
        }
        if (plan->fits == before)
            return scree_error_refuse(error, "--fit", accepted, "there is no theory '%.*s'", (int)length, at);
        at += length;
        at += *at == ',';
    }
    plan->layers = layers > 0;
    if (layers > 0 && layers < plan->fits)
        return scree_error_refuse(error, "--fit", "theories of piles, or of layers",
                                  "theories of piles and of layers are not fitted to the same runs");
    return plan->fits > 0 ? SCREE_OK : scree_error_refuse(error, "--fit", accepted, "no theory is named");
}

static scree_status read_element(const char *text, measure_plan *whole, scree_error *error)
{
    const char *accepted = "a number of grains, such as 150, a part of all, such as 10 %, or a length, such as 30 mm";
    scree_average_plan *plan = &whole->average;
    scree_error problem = {0};
    const size_t length = strlen(text);
    if (length > 1 && text[length - 1] == '%' && !scree_units_parse(text, "1", &whole->share, &problem))
        return whole->share > 0 && whole->share < 1
                   ? SCREE_OK
                   : scree_error_refuse(error, "--element", accepted, "'%s' is no part", text);
    if (read_number(text, &plan->grains))
        return plan->grains >= 1 ? SCREE_OK
                                 : scree_error_refuse(error, "--element", accepted, "'%s' are no grains", text);
    if (scree_units_parse(text, "m", &plan->side, &problem) || !(plan->side > 0))
        return scree_error_refuse(error, "--element", accepted, "'%s' is neither a number of grains nor a length",
                                  text);
    return SCREE_OK;
}

static scree_status read_grid(const char *text, scree_average_plan *plan, scree_error *error)
{
    char rest;
    size_t *n = plan->grid;
    n[2] = 0;
    const int read = sscanf(text, "%zux%zu%c", &n[0], &n[1], &rest) == 2
                         ? 2
                         : (sscanf(text, "%zux%zux%zu%c", &n[0], &n[1], &n[2], &rest) == 3 ? 3 : 0);
    if (read == 0 || n[0] < 1 || n[1] < 1 || (read == 3 && n[2] < 1) || n[0] > 4096 || n[1] > 4096 || n[2] > 4096)
        return scree_error_refuse(error, "--grid", "points, such as 100x50 or in 3D 20x20x20, up to 4096 each",
                                  "'%s' is no grid", text);
    return SCREE_OK;
}

static scree_status read_kernel(const char *text, measure_plan *plan, scree_error *error)
{
    scree_error problem = {0};
    plan->kernel = true;
    if (read_number(text, &plan->kernel_diameters) && plan->kernel_diameters > 0) return SCREE_OK;
    if (!scree_units_parse(text, "m", &plan->kernel_width, &problem) && plan->kernel_width > 0) return SCREE_OK;
    return scree_error_refuse(error, "--kernel", "mean diameters, such as 3, or a length, such as 15 mm",
                              "'%s' is no width", text);
}

static scree_status read_axis(const char *text, scree_average_plan *plan, scree_error *error)
{
    scree_error problem = {0};
    plan->axis = SCREE_AVERAGE_AXIS_GIVEN;
    if (strcmp(text, "mass") == 0) plan->axis = SCREE_AVERAGE_AXIS_MASS;
    if (strcmp(text, "apex") == 0) plan->axis = SCREE_AVERAGE_AXIS_APEX;
    if (plan->axis != SCREE_AVERAGE_AXIS_GIVEN) return SCREE_OK;
    if (!scree_units_parse(text, "m", &plan->axis_given, &problem)) return SCREE_OK;
    return scree_error_refuse(error, "--axis", "mass, apex, or a position, such as 0 mm",
                              "'%s' is no position of the axis", text);
}

/// What one unit of a file is in SI units: "1 mm", or "mm".
static scree_status read_unit(const char *text, const char *option, const char *si, double *unit, scree_error *error)
{
    char one[80];
    scree_error why;
    *unit = 1;
    if (!text) return SCREE_OK;
    (void)snprintf(one, sizeof one, "%s%.60s", *text && strchr("0123456789.", *text) ? "" : "1 ", text);
    if (scree_units_parse(one, si, unit, &why))
        return scree_error_refuse(error, option, why.accepted, "%s", why.message);
    if (!(*unit > 0)) return scree_error_refuse(error, option, "a unit", "'%s' is not above 0", text);
    return SCREE_OK;
}

static scree_status read_units(const scree_measure_options *options, measure_file_units *units, scree_error *error)
{
    scree_status status = read_unit(options->length_unit, "length-unit", "m", &units->length, error);
    if (!status) status = read_unit(options->time_unit, "time-unit", "s", &units->time, error);
    return status ? status : read_unit(options->force_unit, "force-unit", "N", &units->force, error);
}

scree_status measure_plan_read(const scree_measure_options *options, measure_plan *plan, scree_error *error)
{
    static const char mean[] = "mean:";
    *plan = (measure_plan){.options = options,
                           .at = options->at ? options->at : "end",
                           .from = options->from,
                           .threads = options->threads,
                           .two_slopes = options->two_slopes,
                           .element_given = options->element != NULL};
    plan->mean = strncmp(plan->at, mean, sizeof mean - 1) == 0;
    if (plan->mean) plan->at += sizeof mean - 1;
    if (plan->mean && plan->from)
        return scree_error_refuse(error, "--from", "--at with one snapshot",
                                  "a mean over a stage has no displacements");
    plan->average.points = 41;
    if (options->points != 0 && (options->points < 1 || options->points > 10001 || options->points % 2 == 0))
        return scree_error_refuse(error, "--points", "an odd number from 1 to 10001", "%ld places have no middle",
                                  options->points);
    if (options->points != 0) plan->average.points = (size_t)options->points;
    scree_status status = read_fields(options->fields ? options->fields : "density,coordination,stress,fabric",
                                      &plan->average.fields, error);
    if (!status && plan->average.fields & SCREE_AVERAGE_ELASTIC && !plan->from)
        status = scree_error_refuse(error, "--fields", "elastic with --from: start, #N, or a stage",
                                    "elastic constants need two states of the run: say the earlier one");
    if (!status) status = read_cuts(options->cuts ? options->cuts : "5", &plan->average, error);
    if (!status && options->element) status = read_element(options->element, plan, error);
    if (!status && options->grid) status = read_grid(options->grid, &plan->average, error);
    if (!status && options->sizes) status = read_sizes(options->sizes, &plan->average, error);
    plan->average.threads = options->threads;
    if (!status && options->kernel) status = read_kernel(options->kernel, plan, error);
    if (!status && options->fit) status = read_fits(options->fit, plan, error);
    if (!status) status = read_units(options, &plan->units, error);
    if (!status) status = read_axis(options->axis ? options->axis : "mass", &plan->average, error);
    return status;
}
