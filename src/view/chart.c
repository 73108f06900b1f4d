/// Charts: a CSV of the values, a gnuplot script that draws them, and the figures it makes. The script uses relative
/// names, so the folder can be moved and the figure changed by hand: `gnuplot NAME.gp`.
/// Palette: Okabe and Ito 2008, made for all kinds of colour blindness (without its yellow, too light for lines).
#include "view/chart.h"

#include "io/manifest.h"
#include "io/run_directory.h"
#include "view/font.h"
#include "view/gnuplot.h"
#include "view/page.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define WIDTH      720 /* pt of the SVG; the PNG has PNG_SCALE pixels for each, unless others were chosen */
#define HEIGHT     450
#define PNG_SCALE  3
#define COLOURS    7
#define TEXT_LIMIT 512
#define CHARACTER  7.5 /* pt, width of one at the size of the numbers */
#define KEY_SAMPLE 42  /* pt, what stands before a text of the legend */

static const char *const palette[COLOURS] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#56b4e9", "#e69f00", "#000000"};

/// Of lines that come when all colours are used, and again.
static const char *const dashes[] = {"solid", "(2,3)", "(14,3,2,3)"};
static const int marks[] = {7, 5, 9};

typedef struct line_look {
    double width;
    size_t number; ///< among the lines that are drawn
} line_look;

typedef struct chart_place {
    char folder[PATH_MAX];
    const char *name; ///< of the figure, without folder and extension
} chart_place;

static bool drawable(const scree_chart *chart, double x, double y)
{
    return isfinite(x) && isfinite(y) && !(chart->log_x && x <= 0) && !(chart->log_y && y <= 0);
}

static bool line_drawable(const scree_chart *chart, const scree_chart_line *line)
{
    for (size_t k = 0; k < line->count; k++)
        if (drawable(chart, line->x[k], line->y[k])) return true;
    return false;
}

/// Text in double quotes for gnuplot. In them it runs what stands in back quotes, so these are written by their number.
static void write_quoted(FILE *file, const char *text)
{
    char clean[TEXT_LIMIT];
    scree_text_clean(clean, sizeof clean, text ? text : "");
    fputc('"', file);
    for (const char *c = clean; *c; c++) {
        if (*c == '"' || *c == '\\') fputc('\\', file);
        if (*c == '`')
            fputs("\\140", file);
        else
            fputc(*c, file);
    }
    fputc('"', file);
}

/// The title: bold, `size` times the usual size, with everything that enhanced text would interpret escaped.
static void write_title(FILE *file, const char *title, double size)
{
    char text[2 * TEXT_LIMIT];
    int used = snprintf(text, sizeof text, "{/:Bold*%.2f ", size);
    for (const char *c = title ? title : ""; *c && used < TEXT_LIMIT - 4; c++) {
        if (strchr("\\^_{}@&~", *c)) text[used++] = '\\';
        text[used++] = *c;
    }
    text[used++] = '}';
    text[used] = '\0';
    write_quoted(file, text);
}

/// Text in double quotes for CSV (RFC 4180).
static void write_csv_text(FILE *file, const char *text)
{
    char clean[TEXT_LIMIT];
    scree_text_clean(clean, sizeof clean, text ? text : "");
    fputc('"', file);
    for (const char *c = clean; *c; c++) fputs(*c == '"' ? "\"\"" : (char[]){*c, '\0'}, file);
    fputc('"', file);
}

/// A line shares the x column of the line before it when its x is the same array.
static bool shares_x(const scree_chart *chart, size_t line)
{
    return line > 0 && chart->line[line].x == chart->line[line - 1].x &&
           chart->line[line].count == chart->line[line - 1].count;
}

static void write_value(FILE *file, const scree_chart_line *line, const double *value, size_t row)
{
    if (row < line->count && isfinite(value[row]))
        fprintf(file, "%.9g", value[row]);
    else
        fputs("nan", file);
}

static void write_data(FILE *file, const scree_chart *chart)
{
    size_t rows = 0;
    for (size_t k = 0; k < chart->line_count; k++) {
        const scree_chart_line *line = &chart->line[k];
        if (line->count > rows) rows = line->count;
        if (!shares_x(chart, k)) {
            if (k > 0) fputc(',', file);
            write_csv_text(file, chart->x_label);
        }
        fputc(',', file);
        write_csv_text(file, line->label ? line->label : chart->y_label);
        if (line->low) fputs(",low,high", file);
    }
    fputc('\n', file);
    for (size_t row = 0; row < rows; row++) {
        for (size_t k = 0; k < chart->line_count; k++) {
            const scree_chart_line *line = &chart->line[k];
            if (!shares_x(chart, k)) {
                if (k > 0) fputc(',', file);
                write_value(file, line, line->x, row);
            }
            fputc(',', file);
            write_value(file, line, line->y, row);
            for (int side = 0; line->low && side < 2; side++) {
                fputc(',', file);
                write_value(file, line, side == 0 ? line->low : line->high, row);
            }
        }
        fputc('\n', file);
    }
}

/// Powers of ten that the numbers of both axes are shown in, 0: as they are. The data file has the true values.
typedef struct chart_scale {
    int x, y;
} chart_scale;

/// A multiple of three where the largest magnitude is so small or large that its numbers would crowd the axis.
static int find_exponent(double largest)
{
    if (!(largest > 0) || (largest >= 1e-3 && largest < 1e5)) return 0;
    return 3 * (int)floor(log10(largest) / 3);
}

static chart_scale scale_of(const scree_chart *chart)
{
    double x = 0, y = 0;
    for (size_t k = 0; k < chart->line_count; k++)
        for (size_t row = 0; row < chart->line[k].count; row++) {
            const scree_chart_line *line = &chart->line[k];
            if (!drawable(chart, line->x[row], line->y[row])) continue;
            x = fmax(x, fabs(line->x[row]));
            y = fmax(y, fabs(line->y[row]));
        }
    return (chart_scale){chart->log_x || chart->x_name ? 0 : find_exponent(x), chart->log_y ? 0 : find_exponent(y)};
}

/// "limit (s)" becomes "limit (10^{-9} s)".
static void write_axis_label(FILE *file, const char *label, int exponent)
{
    char text[TEXT_LIMIT];
    const char *unit = label ? strrchr(label, '(') : NULL;
    if (exponent == 0 || !label)
        (void)snprintf(text, sizeof text, "%s", label ? label : "");
    else if (!unit)
        (void)snprintf(text, sizeof text, "%s (10^{%d})", label, exponent);
    else
        (void)snprintf(text, sizeof text, "%.*s(10^{%d}%s%s", (int)(unit - label), label, exponent,
                       strcmp(unit, "(1)") == 0 ? "" : " ", strcmp(unit, "(1)") == 0 ? ")" : unit + 1);
    write_quoted(file, text);
}

/// A column of the data file as `using` has it.
static void write_column(FILE *file, const char *before, size_t column, int exponent)
{
    if (exponent == 0)
        fprintf(file, "%s%zu", before, column);
    else
        fprintf(file, "%s($%zu*1e%d)", before, column, -exponent);
}

/// One line of the plot command: the columns of the data file, then how they are drawn.
static void begin_plot(FILE *file, const char *name, bool first)
{
    fputs(first ? "plot " : ", \\\n     ", file);
    write_quoted(file, name);
    fputs(".'.csv' skip 1 using ", file);
}

/// The band or the error bars of the line whose y is in column y; they are drawn first, under the line.
static void write_range(FILE *file, const scree_chart_line *line, size_t x, size_t y, chart_scale scale,
                        const char *colour)
{
    write_column(file, "", x, scale.x);
    if (line->points) write_column(file, ":", y, scale.y);
    write_column(file, ":", y + 1, scale.y);
    write_column(file, ":", y + 2, scale.y);
    if (line->points)
        fprintf(file, " with yerrorbars linecolor rgb '%s' linewidth 1.4 pointtype 0", colour);
    else
        fprintf(file, " with filledcurves fillcolor rgb '%s' fillstyle transparent solid 0.15 noborder", colour);
    fputs(" notitle", file);
}

/// Whether a later line of the same kind lies upon line `k` along a quarter of it: closer than the width of a line.
/// Where both are zero neither is missed.
static bool is_hidden(const scree_chart *chart, size_t k)
{
    const scree_chart_line *line = &chart->line[k];
    double low = INFINITY, high = -INFINITY;
    for (size_t row = 0; row < line->count; row++)
        if (isfinite(line->y[row])) {
            low = fmin(low, line->y[row]);
            high = fmax(high, line->y[row]);
        }
    for (size_t other = k + 1; other < chart->line_count; other++) {
        const scree_chart_line *upon = &chart->line[other];
        size_t same = 0, all = 0;
        if (upon->x != line->x || upon->count != line->count || upon->dashed || line->dashed || upon->points) continue;
        for (size_t row = 0; row < line->count; row++) {
            if (!isfinite(line->y[row]) || !isfinite(upon->y[row])) continue;
            all++;
            const double width = 0.004 * (high - low);
            same += fabs(line->y[row] - upon->y[row]) <= width && fabs(line->y[row]) > width;
        }
        if (all > 0 && 4 * same >= all) return true;
    }
    return false;
}

static const char *colour_of(const scree_chart_line *line, size_t number)
{
    return palette[line->colour > 0 ? (size_t)(line->colour - 1) % COLOURS : number % COLOURS];
}

static void write_line(FILE *file, const scree_chart_line *line, line_look look, size_t x, size_t y, chart_scale scale)
{
    const size_t turn = line->colour > 0 ? 0 : look.number / COLOURS % (sizeof marks / sizeof *marks);
    write_column(file, "", x, scale.x);
    write_column(file, ":", y, scale.y);
    fprintf(file, " with %s linecolor rgb '%s'",
            line->bare     ? "points"
            : line->points ? "linespoints"
                           : "lines",
            colour_of(line, look.number));
    fprintf(file, " linewidth %g%s%s", look.width, line->bare ? "" : " dashtype ",
            line->bare     ? ""
            : line->dashed ? "(7,4)"
                           : dashes[turn]);
    if (line->points) {
        bool large = line->low || line->bare;
        fprintf(file, " pointtype %d pointsize %s", marks[turn], line->faint ? "0.22" : large ? "1" : "0.5");
    }
    if (line->label) {
        fputs(" title ", file);
        write_quoted(file, line->label);
    } else {
        fputs(" notitle", file);
    }
}

/// Bands come before all lines, so that none is dulled by the band of another; error bars belong to their points.
static void write_plot(FILE *file, const scree_chart *chart, const char *name)
{
    const chart_scale scale = scale_of(chart);
    bool first = true;
    for (int bands = 1; bands >= 0; bands--) {
        size_t column = 0, x_column = 0, written = 0;
        for (size_t k = 0; k < chart->line_count; k++) {
            const scree_chart_line *line = &chart->line[k];
            if (!shares_x(chart, k)) x_column = ++column;
            size_t y_column = ++column;
            if (line->low) column += 2;
            if (!line_drawable(chart, line)) continue;
            const size_t number = written++;
            if (line->low && bands != line->points) {
                begin_plot(file, name, first);
                write_range(file, line, x_column, y_column, scale, colour_of(line, number));
                first = false;
            }
            if (bands) continue;
            begin_plot(file, name, first);
            // One that another lies upon is wider, so that both are seen.
            write_line(file, line, (line_look){is_hidden(chart, k) ? 5 : 2, number}, x_column, y_column, scale);
            first = false;
        }
    }
    fputc('\n', file);
}

/// Characters of the longest name, where names side by side would run into one another; 0: they have room.
static size_t find_crowd(const scree_chart *chart, bool legend)
{
    size_t longest = 0;
    for (size_t k = 0; chart->x_name && k < chart->x_name_count; k++) {
        const size_t length = strlen(chart->x_name[k]);
        if (length > longest) longest = length;
    }
    const double room = (legend ? 0.55 : 0.8) * WIDTH;
    return longest > 0 && CHARACTER * (double)((longest + 1) * chart->x_name_count) > room ? longest : 0;
}

/// Names in place of numbers along the x axis, with half a place free at both ends. Crowded ones are turned.
static void write_x_names(FILE *file, const scree_chart *chart, size_t crowd)
{
    if (!chart->x_name) return;
    fputs("unset mxtics\nset xtics ", file);
    if (crowd > 0) fputs("rotate by 35 right ", file);
    fputs("(", file);
    for (size_t k = 0; k < chart->x_name_count; k++) {
        fputs(k > 0 ? ", " : "", file);
        write_quoted(file, chart->x_name[k]);
        fprintf(file, " %zu", k + 1);
    }
    fprintf(file, ") noenhanced\nset xrange [0.5:%zu.5]\n", chart->x_name_count);
    // The names take this much more of the height below the axis; sin(35) is 0.57.
    if (crowd > 0)
        fprintf(file, "set bmargin at screen %.3f\n", fmin(0.5, 0.15 + 0.57 * CHARACTER * (double)crowd / HEIGHT));
}

static void write_output(FILE *file, const char *name, const char *extension, const char *terminal)
{
    fprintf(file, "\nset terminal %s\nset output ", terminal);
    write_quoted(file, name);
    fprintf(file, ".'.%s'\n", extension);
}

/// Points with error bars keep clear of the sides.
static bool has_bars(const scree_chart *chart)
{
    bool bars = false;
    for (size_t k = 0; k < chart->line_count; k++) bars |= chart->line[k].points && chart->line[k].low;
    return bars && !chart->x_name;
}

/// Values that are all positive, and not far from zero, are shown from zero.
static bool begins_at_zero(const scree_chart *chart)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < chart->line_count; k++)
        for (size_t row = 0; row < chart->line[k].count; row++) {
            const scree_chart_line *line = &chart->line[k];
            if (!drawable(chart, line->x[row], line->y[row])) continue;
            low = fmin(low, line->low && isfinite(line->low[row]) ? line->low[row] : line->y[row]);
            high = fmax(high, line->y[row]);
        }
    return low >= 0 && low < 0.25 * high;
}

/// Where the plot ends, as a share of the page: the legend behind it takes what its longest text needs.
static double find_right(const scree_chart *chart)
{
    size_t longest = 0;
    for (size_t k = 0; k < chart->line_count; k++) {
        const size_t length = chart->line[k].label ? strlen(chart->line[k].label) : 0;
        if (length > longest) longest = length;
    }
    return fmax(0.45, fmin(0.70, 0.985 - (KEY_SAMPLE + CHARACTER * (double)longest) / WIDTH));
}

/// Everything but the data: the look of all charts.
static void write_style(FILE *file, const scree_chart *chart)
{
    // A long title is set smaller, so that it stays on the page.
    size_t length = chart->title ? strlen(chart->title) : 0;
    double title_size = length > 60 ? fmax(0.4, 1.15 * 60 / (double)length) : 1.15;
    fputs("set encoding utf8\nset datafile separator comma\nset datafile missing 'nan'\nset minussign\nset label 1 ",
          file);
    write_title(file, chart->title, title_size);
    fputs(" at screen 0.02,0.955 left textcolor rgb '#222222'\n", file);
    const chart_scale scale = scale_of(chart);
    fputs("set xlabel ", file);
    write_axis_label(file, chart->x_label, scale.x);
    fputs("\nset ylabel ", file);
    write_axis_label(file, chart->y_label, scale.y);
    fputs("\nset border 3 linecolor rgb '#333333' linewidth 1\n"
          "set tics nomirror out scale 0.6 textcolor rgb '#222222'\nset mxtics 2\n"
          "set grid back xtics ytics linetype 1 linecolor rgb '#e4e4e4' linewidth 0.8\n"
          "set xzeroaxis linetype 1 linecolor rgb '#999999' linewidth 1\n"
          "set autoscale xfix\nset bmargin at screen 0.15\nset tmargin at screen 0.89\n",
          file);
    bool legend = false;
    for (size_t k = 0; k < chart->line_count; k++) legend |= chart->line[k].label != NULL;
    const double right = find_right(chart);
    if (legend)
        fprintf(file,
                "set rmargin at screen %.2f\n"
                "set key at screen %.3f,0.90 left top vertical Left reverse samplen 2.2 spacing 1.35\n",
                right, right + 0.015);
    else
        fputs("set rmargin at screen 0.945\nunset key\n", file);
    bool zero = !chart->log_y && begins_at_zero(chart);
    const char *side = has_bars(chart) && !chart->log_x ? "graph 0.04" : "0";
    fprintf(file, "set offsets %s, %s, graph 0.03, %s\n%s", side, side, zero ? "0" : "graph 0.03",
            zero ? "set yrange [0:]\n" : "");
    if (chart->highest_y > 0) fprintf(file, "set yrange [0:%g]\n", chart->highest_y);
    write_x_names(file, chart, find_crowd(chart, legend));
    if (chart->log_x) fputs("set logscale x\nset format x '10^{%L}'\n", file);
    if (chart->log_y) fputs("unset offsets\nset logscale y\nset format y '10^{%L}'\n", file);
}

static void write_script(FILE *file, const scree_chart *chart, const char *name)
{
    char terminal[256];
    fprintf(file, "# Run in this folder to draw the figure again: gnuplot %s.gp\n", name);
    write_style(file, chart);
    (void)snprintf(terminal, sizeof terminal,
                   "svg size %d,%d dynamic enhanced font '" SCREE_FONT ",13' background rgb 'white'", WIDTH, HEIGHT);
    write_output(file, name, "svg", terminal);
    write_plot(file, chart, name);
    const int asked = scree_page_chosen_pixels();
    const double scale = asked > 0 ? asked / (double)WIDTH : PNG_SCALE;
    (void)snprintf(terminal, sizeof terminal,
                   "pngcairo size %.0f,%.0f enhanced font '" SCREE_FONT ",10' fontscale %.4g linewidth %.4g",
                   WIDTH * scale, HEIGHT * scale, scale, scale);
    write_output(file, name, "png", terminal);
    fputs("replot\nset output\n", file);
}

static scree_status split_path(const char *path, chart_place *place, scree_error *error)
{
    const char *slash = strrchr(path, '/');
    size_t length = slash ? (size_t)(slash - path) : 0;
    place->name = slash ? slash + 1 : path;
    if (length + 1 >= sizeof place->folder || strlen(place->name) > 240)
        return scree_error_set(error, SCREE_ERROR_IO, "the path of the figure '%s' is too long", path);
    for (const char *c = place->name; *c; c++)
        if ((unsigned char)*c < 0x20)
            return scree_error_set(error, SCREE_ERROR_IO, "the figure '%s' has a control character in its name", path);
    memcpy(place->folder, path, length);
    if (length == 0) place->folder[length++] = slash ? '/' : '.';
    place->folder[length] = '\0';
    return SCREE_OK;
}

scree_status scree_chart_draw(const char *path, const scree_chart *chart, scree_error *error)
{
    chart_place place;
    scree_status status = split_path(path, &place, error);
    if (status) return status;
    bool any = false;
    for (size_t k = 0; k < chart->line_count; k++) any |= line_drawable(chart, &chart->line[k]);
    if (!any) return scree_error_set(error, SCREE_ERROR_INPUT, "the chart '%s' has no value to draw", place.name);
    static const char *const endings[] = {".csv", ".gp", ".svg", ".png"};
    status = scree_manifest_add(path, endings, sizeof endings / sizeof *endings, error);
    if (status) return status;
    char file_name[PATH_MAX + 8], script[256];
    FILE *file;
    (void)snprintf(file_name, sizeof file_name, "%s.csv", path);
    status = scree_replace_begin(file_name, &file, error);
    if (status) return status;
    write_data(file, chart);
    status = scree_replace_finish(file_name, file, true, error);
    if (status) return status;
    (void)snprintf(file_name, sizeof file_name, "%s.gp", path);
    status = scree_replace_begin(file_name, &file, error);
    if (status) return status;
    write_script(file, chart, place.name);
    status = scree_replace_finish(file_name, file, true, error);
    if (status) return status;
    (void)snprintf(script, sizeof script, "%s.gp", place.name);
    return scree_gnuplot_run(place.folder, script, error);
}
