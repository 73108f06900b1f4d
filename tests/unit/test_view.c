/// Colour maps, scales, scenes and charts. The figures of a whole run are in test_plot.c.
#include "view_testing.h"

#include "hand_made_snapshot.h"

#include "base/file_bytes.h"
#include "base/memory.h"
#include "base/random.h"
#include "search/tetrahedra.h"
#include "state/plates.h"
#include "view/cell_section.h"
#include "view/chart.h"
#include "view/colour.h"
#include "view/gnuplot.h"
#include "view/page.h"
#include "view/scale.h"
#include "view/scene.h"
#include "view/wall_lines.h"

#include <math.h>
#include <sys/stat.h>

// ---- colours ------------------------------------------------------------------------------------------------------

/// A colour outside the sRGB gamut would be clipped, which shows as a lightness off its straight line. 0.2 is a tenth
/// of the least step of lightness that can be seen.
static void sequential_lightness_falls_evenly(void **state)
{
    (void)state;
    for (int k = 0; k <= 256; k++) {
        double t = k / 256.0, lightness = scree_colour_lightness(scree_colour_at(SCREE_COLOUR_SEQUENTIAL, t));
        assert_true(fabs(lightness - (95 - 75 * t)) < 0.2);
    }
}

static void diverging_lightness_falls_evenly_to_both_sides(void **state)
{
    (void)state;
    for (int k = 0; k <= 256; k++) {
        double t = k / 256.0, lightness = scree_colour_lightness(scree_colour_at(SCREE_COLOUR_DIVERGING, t));
        assert_true(fabs(lightness - (96 - 58 * fabs(2 * t - 1))) < 0.2);
    }
    scree_colour cold = scree_colour_at(SCREE_COLOUR_DIVERGING, 0), warm = scree_colour_at(SCREE_COLOUR_DIVERGING, 1);
    assert_true(cold.blue > cold.red + 0.3 && warm.red > warm.blue + 0.3);
}

static void colours_clamp_and_undefined_is_grey(void **state)
{
    (void)state;
    scree_colour low = scree_colour_at(SCREE_COLOUR_SEQUENTIAL, -INFINITY);
    scree_colour first = scree_colour_at(SCREE_COLOUR_SEQUENTIAL, 0);
    assert_true(low.red == first.red && low.green == first.green && low.blue == first.blue);
    scree_colour grey = scree_colour_at(SCREE_COLOUR_DIVERGING, NAN);
    assert_true(grey.red == grey.green && grey.green == grey.blue);
}

// ---- text ---------------------------------------------------------------------------------------------------------

/// A line may be as wide as `words` are.
static double lines_of(cairo_t *cairo, const char *text, const char *words)
{
    const scree_text_style style = {.size = 10};
    const double width = scree_text_width(cairo, words, style) + 1e-6;
    return scree_text_paragraph(cairo, 0, 0, width, text, style) / (1.25 * style.size);
}

static void lines_break_at_spaces_and_not_before_a_percent_sign(void **state)
{
    (void)state;
    cairo_surface_t *surface = cairo_recording_surface_create(CAIRO_CONTENT_COLOR, NULL);
    cairo_t *cairo = cairo_create(surface);
    assert_int_equal(lround(lines_of(cairo, "from 7.9 to 12 %", "from 7.9 to 12 %")), 1);
    assert_int_equal(lround(lines_of(cairo, "from 7.9 to 12 %", "from 7.9 to 12")), 2);
    assert_int_equal(lround(lines_of(cairo, "12 mm", "12")), 2);
    assert_int_equal(lround(lines_of(cairo, "12 %", "12")), 1);
    assert_int_equal(lround(lines_of(cairo, "12 %, and 13 % more", "13 %")), 4);
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
}

// ---- sections of cells --------------------------------------------------------------------------------------------

/// Tetrahedra of a unit cube with points inside.
static void fill_cube(double *place, size_t count, scree_tetrahedra *tetrahedra)
{
    for (size_t k = 0; k < 3 * count; k++)
        place[k] = k < 24 ? (double)(k / 3 >> k % 3 & 1) : scree_random_uniform(5, SCREE_RANDOM_TEST, k);
    assert_int_equal(scree_tetrahedra_build(place, count, tetrahedra, NULL), SCREE_OK);
}

static double outline_of(const scree_cell_section *section)
{
    double length = 0;
    for (size_t k = 0; k < section->cells.count; k++)
        for (int n = 0; n < 3; n++) {
            const double *a = section->place + 3 * (size_t)section->cells.node[k][(n + 1) % 3];
            const double *b = section->place + 3 * (size_t)section->cells.node[k][(n + 2) % 3];
            if (section->cells.neighbour[k][n] < 0) length += hypot(a[0] - b[0], a[1] - b[1]);
        }
    return length;
}

/// Every section of a unit cube is a unit square with its outline, and the field integrated over sections is that
/// integrated over the cells (Cavalieri); the midpoint rule with N sections is off by about 1 / N^2.
static void sections_of_cells_fill_the_plane(void **state)
{
    (void)state;
    enum { COUNT = 40, SECTIONS = 400 };
    double place[3 * COUNT], field[20 * COUNT], whole = 0, added = 0;
    scree_tetrahedra tetrahedra;
    fill_cube(place, COUNT, &tetrahedra);
    assert_true(tetrahedra.count > COUNT && tetrahedra.count < 20 * COUNT);
    const scree_cells solid = {.dimension = 3,
                               .count = tetrahedra.count,
                               .bodies = COUNT,
                               .node = tetrahedra.vertex,
                               .neighbour = tetrahedra.neighbour};
    for (size_t k = 0; k < solid.count; k++) {
        field[k] = (double)(k * k % 17);
        whole += field[k] * scree_cell_volume_at(&solid, k, place);
    }
    for (int cut = 0; cut < SECTIONS; cut++) {
        scree_cell_section section;
        double area = 0;
        assert_int_equal(scree_cell_section_create(&solid, place, field, (cut + 0.5) / SECTIONS, &section, NULL),
                         SCREE_OK);
        for (size_t k = 0; k < section.cells.count; k++) {
            area += section.cells.volume[k];
            added += section.field[k] * section.cells.volume[k] / SECTIONS;
        }
        assert_true(fabs(area - 1) < 1e-12);
        assert_true(fabs(outline_of(&section) - 4) < 1e-12);
        scree_cell_section_destroy(&section);
    }
    assert_true(fabs(added / whole - 1) < 1e-4);
    scree_tetrahedra_destroy(&tetrahedra);
}

// ---- scales -------------------------------------------------------------------------------------------------------

static void limits_ignore_extremes(void **state)
{
    (void)state;
    double value[103];
    for (int k = 0; k <= 100; k++) value[k] = 100 - k;
    value[101] = NAN;
    value[102] = INFINITY;
    scree_limits limits;
    assert_int_equal(scree_limits_find(value, 103, false, &limits, NULL), SCREE_OK);
    // The quantiles of 0, 1, ..., 100 are the numbers themselves; round-off of 0.98 * 100 only.
    assert_true(fabs(limits.low - 2) < 1e-12 && fabs(limits.high - 98) < 1e-12);
    assert_true(limits.clipped_low && limits.clipped_high);
    assert_int_equal(limits.undefined, 2);
    value[0] = 1e300;
    assert_int_equal(scree_limits_find(value, 103, true, &limits, NULL), SCREE_OK);
    assert_true(limits.high < 100 && limits.low == -limits.high && limits.largest == 1e300);
}

static void limits_of_degenerate_fields_are_intervals(void **state)
{
    (void)state;
    const double fields[][3] = {{0, 0, 0}, {-7, -7, -7}, {1e300, 1e300, 1e300}, {NAN, NAN, NAN}, {0, 0, 1e-300}};
    for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++)
        for (int symmetric = 0; symmetric < 2; symmetric++) {
            scree_limits limits;
            assert_int_equal(scree_limits_find(fields[k], 3, symmetric, &limits, NULL), SCREE_OK);
            assert_true(isfinite(limits.low) && isfinite(limits.high) && limits.low < limits.high);
            if (k == 0) assert_true(limits.low == (symmetric ? -1 : 0) && limits.high == 1);
        }
}

static void ticks_lie_within_the_limits(void **state)
{
    (void)state;
    const double limits[][2] = {{0, 1},        {-29.3, 29.3},  {0.0799, 0.2963}, {1e-9, 7e-9},
                                {-3e12, 1e12}, {1000, 1000.5}, {1, 1 + 1e-15}};
    for (size_t k = 0; k < sizeof limits / sizeof limits[0]; k++) {
        scree_ticks ticks = scree_ticks_make(limits[k][0], limits[k][1]);
        double slack = 1e-6 * (limits[k][1] - limits[k][0]);
        assert_true(ticks.count >= 1 && ticks.count <= SCREE_TICKS);
        for (int tick = 0; tick < ticks.count; tick++)
            assert_true(ticks.value[tick] >= limits[k][0] - slack && ticks.value[tick] <= limits[k][1] + slack);
    }
    scree_ticks ticks = scree_ticks_make(-29.3, 29.3);
    assert_int_equal(ticks.count, 5);
    assert_string_equal(ticks.text[0], "−20");
    assert_string_equal(ticks.text[2], "0");
    ticks = scree_ticks_make(1e-9, 7e-9);
    assert_string_equal(ticks.factor, "10⁻⁹");
    assert_string_equal(ticks.text[0], "2");
}

static void numbers_and_lengths_as_text(void **state)
{
    (void)state;
    char text[64];
    scree_number_text(text, sizeof text, -1234.5, 3);
    assert_string_equal(text, "−1234");
    scree_number_text(text, sizeof text, 1.5e-7, 3);
    assert_string_equal(text, "1.50×10⁻⁷");
    scree_number_text(text, sizeof text, NAN, 3);
    assert_string_equal(text, "undefined");
    scree_length_text(text, sizeof text, 0.02);
    assert_string_equal(text, "20 mm");
    scree_length_text(text, sizeof text, 5e-6);
    assert_string_equal(text, "5 µm");
    assert_true(fabs(scree_round_below(0.0999999) - 0.05) < 1e-15);
    assert_true(fabs(scree_round_below(2) - 2) < 1e-15);
}

static void text_becomes_valid(void **state)
{
    (void)state;
    char text[32];
    scree_text_clean(text, sizeof text, "a\nb\x01\xff\xc3+\xed\xa0\x80\xc0\x80 σ₁");
    assert_string_equal(text, "a b??"
                              "?+????? σ₁");
    scree_text_clean(text, 4, "abσ");
    assert_string_equal(text, "ab");
}

// ---- scenes -------------------------------------------------------------------------------------------------------

static scree_scene whole_scene(const double *field, const double *arrow)
{
    return (scree_scene){.title = "Rotation & <force> \"network\" 'x' \xff",
                         .field = field,
                         .field_name = "rotation <degrees> & more",
                         .map = SCREE_COLOUR_DIVERGING,
                         .force_network = true,
                         .boundary = true,
                         .plates = true,
                         .arrow_x = arrow,
                         .arrow_y = arrow};
}

static void assert_draws(const char *name, const scree_snapshot *snapshot, const scree_scene *scene)
{
    scree_error error = {0};
    scree_status status = scree_scene_draw(name, snapshot, scene, &error);
    if (status) fail_msg("%s: %s", name, error.message);
    assert_figure(name);
}

static void scene_of_every_kind_is_written(void **state)
{
    (void)state;
    scree_snapshot s;
    hand_made_packing(&s, 17, 35, 0.1);
    assert_draws("plain", &s, &(scree_scene){.title = "Packing"});
    assert_draws("field", &s,
                 &(scree_scene){.title = "Angle", .field = s.angle, .field_name = "angle", .boundary = true});
    assert_draws("network", &s, &(scree_scene){.title = "Forces", .force_network = true, .plates = true});
    assert_draws("arrows", &s, &(scree_scene){.title = "Arrows", .arrow_x = s.vx, .arrow_y = s.vy});
    scree_scene all = whole_scene(s.angle, s.vx);
    assert_draws("all", &s, &all);
    hand_made_destroy(&s);
}

/// 5000 discs, coloured, in less than 1.5 MB: 300 bytes a disc.
static void large_scene_is_a_small_file(void **state)
{
    (void)state;
    scree_snapshot s;
    struct stat information;
    hand_made_packing(&s, 50, 100, 0.1);
    assert_draws("large", &s, &(scree_scene){.title = "Large", .field = s.angle, .boundary = true, .plates = true});
    assert_int_equal(stat("large.svg", &information), 0);
    assert_true(information.st_size < 1500000);
    hand_made_destroy(&s);
}

/// Discs and contacts of 40,000 discs are an image within the vector page, whose text stays vectors; a place has the
/// colour of its disc.
static void very_many_marks_are_pixels(void **state)
{
    (void)state;
    scree_snapshot s;
    struct stat information;
    scree_error error = {0};
    char *svg;
    size_t length;
    hand_made_packing(&s, 200, 200, 0.1);
    for (size_t k = 0; k < s.count; k++) s.angle[k] = s.x[k];
    assert_draws("pixels", &s, &(scree_scene){.title = "Very large", .field = s.angle, .field_name = "x"});
    assert_int_equal(stat("pixels.svg", &information), 0);
    assert_true(information.st_size < 4000000);
    assert_int_equal(scree_file_load("pixels.svg", &svg, &length, &error), SCREE_OK);
    assert_non_null(strstr(svg, "<image"));
    assert_non_null(strstr(svg, "<use")); // glyphs
    scree_release(&svg);
    picture p = picture_read("pixels.png");
    int width, height;
    picture_extent(&p, scree_colour_at(SCREE_COLOUR_SEQUENTIAL, 0.5), 0.7, &width, &height);
    assert_true(width > 0 && width < 100 && height > 500); // a narrow stripe, as high as the sample
    cairo_surface_destroy(p.surface);
    hand_made_destroy(&s);
}

/// A disc is as wide as it is high, and has the colour of its value. Two pixels for the anti-aliased rim.
static void discs_are_round_and_have_their_colour(void **state)
{
    (void)state;
    scree_snapshot s;
    hand_made_create(&s, 3, 0, 0);
    for (int k = 0; k < 3; k++) {
        s.x[k] = 5e-3 * k;
        s.radius[k] = 1e-3;
    }
    const double field[3] = {0, 1, 2};
    assert_draws("round", &s, &(scree_scene){.title = "Round", .field = field, .field_name = "value"});
    picture p = picture_read("round.png");
    // The middle value lies in the middle of the limits. The legend is to the right.
    scree_colour colour = scree_colour_at(SCREE_COLOUR_SEQUENTIAL, 0.5);
    int width, height;
    picture_extent(&p, colour, 0.7, &width, &height);
    assert_true(width > 100 && abs(width - height) <= 2);
    cairo_surface_destroy(p.surface);
    hand_made_destroy(&s);
}

/// A disc far away does not make the others small where only a part is shown, and one beyond it is not drawn.
static void what_is_not_shown_takes_no_room(void **state)
{
    (void)state;
    scree_snapshot s;
    hand_made_create(&s, 4, 0, 0);
    const double place[4] = {1, 0, 3e-3, 5.2e-3}, field[4] = {NAN, 0, 1, 2}, shown[2] = {-3e-3, 5e-3};
    for (int k = 0; k < 4; k++) {
        s.x[k] = place[k];
        s.radius[k] = 1e-3;
    }
    assert_draws("part", &s, &(scree_scene){.title = "Part", .field = field, .field_name = "value", .shown = shown});
    picture p = picture_read("part.png");
    int width, height;
    // The sample ends before, the colour bar begins behind 0.59 of the page.
    picture_extent(&p, scree_colour_at(SCREE_COLOUR_SEQUENTIAL, 0.5), 0.59, &width, &height);
    assert_true(width > 100 && abs(width - height) <= 2);
    // Radii of 30 pt, the largest there are, on a page of 288 pt: the mean radius is that of all.
    assert_true(fabs((double)width / p.width - 60.0 / 288) < 0.01);
    picture_extent(&p, scree_colour_at(SCREE_COLOUR_SEQUENTIAL, 1), 0.59, &width, &height);
    assert_true(width <= 0);
    cairo_surface_destroy(p.surface);
    hand_made_destroy(&s);
}

static void extreme_snapshots_are_drawn(void **state)
{
    (void)state;
    scree_snapshot s;
    hand_made_create(&s, 1, 0, 0);
    s.radius[0] = 1e-3;
    const double none = NAN, zero = 0, huge = 1e300;
    scree_scene scene = whole_scene(&zero, &zero);
    assert_draws("one", &s, &scene);
    scene = whole_scene(&none, &none);
    assert_draws("one-undefined", &s, &scene);
    picture p = picture_read("one-undefined.png");
    int width, height;
    picture_extent(&p, scree_colour_at(SCREE_COLOUR_DIVERGING, NAN), 0.4, &width, &height);
    assert_true(width > 100 && abs(width - height) <= 2);
    cairo_surface_destroy(p.surface);
    scene = whole_scene(&huge, &huge);
    assert_draws("one-huge", &s, &scene);
    s.x[0] = 1e12;
    s.y[0] = -1e12;
    s.radius[0] = 1;
    assert_draws("one-far", &s, &scene);
    hand_made_destroy(&s);
}

static void damaged_snapshots_are_drawn(void **state)
{
    (void)state;
    scree_snapshot s;
    hand_made_packing(&s, 12, 20, 0.05);
    double *field = hand_made_array(s.count, sizeof *field), *arrow = hand_made_array(s.count, sizeof *arrow);
    for (size_t k = 0; k < s.count; k++) {
        field[k] = k % 3 ? 5.0 : NAN;
        arrow[k] = k % 5 ? 1e-4 : k % 2 ? INFINITY : 1e200;
    }
    s.x[3] = NAN;
    s.radius[4] = -1;
    s.y[5] = INFINITY;
    s.first[0] = UINT32_MAX;
    s.second[1] = UINT32_C(0x70000000);
    s.second[2] = SCREE_WALL_ID + 1;
    s.normal_force[3] = NAN;
    s.normal_force[4] = -5;
    s.loop[0] = UINT32_MAX;
    s.wall[SCREE_WALL_LEFT] = (scree_wall){.active = 1, .position = NAN, .normal = {1, 0}};
    s.wall[SCREE_WALL_RIGHT] = (scree_wall){.active = 1, .position = 1e9, .normal = {-1, 0}};
    scree_scene scene = whole_scene(field, arrow);
    assert_draws("damaged", &s, &scene);
    s.contact_count = 0;
    s.loop_count = 0;
    scene.title = NULL;
    scene.field_name = NULL;
    assert_draws("no-contacts", &s, &scene);
    // Far apart, and one disc far larger than the others.
    s.x[0] = 1e150;
    s.radius[7] = 1e140;
    assert_draws("scattered", &s, &scene);
    scree_release(&field);
    scree_release(&arrow);
    hand_made_destroy(&s);
}

static void scene_that_cannot_be_drawn_says_so(void **state)
{
    (void)state;
    scree_snapshot s;
    scree_error error;
    hand_made_create(&s, 2, 0, 0);
    assert_int_equal(scree_scene_draw("nothing", &s, &(scree_scene){.title = ""}, &error), SCREE_ERROR_INPUT);
    s.count = 0;
    assert_int_equal(scree_scene_draw("nothing", &s, &(scree_scene){.title = ""}, &error), SCREE_ERROR_INPUT);
    s.count = 1;
    s.radius[0] = 1;
    assert_int_equal(scree_scene_draw("no/such/folder", &s, &(scree_scene){.title = ""}, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "no/such/folder"));
    s.count = 2;
    hand_made_destroy(&s);
}

/// Every allocation of a scene fails once: an error each time, and nothing is left behind.
static void scene_survives_lack_of_memory(void **state)
{
    (void)state;
    scree_snapshot s;
    scree_error error;
    hand_made_packing(&s, 3, 3, 0.1);
    scree_scene scene = whole_scene(s.angle, s.vx);
    size_t before, after;
    scree_allocation_statistics(&before, NULL);
    (void)scree_allocation_fail_after(0);
    assert_int_equal(scree_scene_draw("memory", &s, &scene, &error), SCREE_OK);
    uint64_t calls = scree_allocation_fail_after(0);
    assert_true(calls >= 3);
    for (uint64_t k = 1; k <= calls; k++) {
        (void)scree_allocation_fail_after(k);
        assert_int_equal(scree_scene_draw("memory", &s, &scene, &error), SCREE_ERROR_IO);
    }
    (void)scree_allocation_fail_after(0);
    scree_allocation_statistics(&after, NULL);
    assert_int_equal(before, after);
    hand_made_destroy(&s);
}

// ---- charts -------------------------------------------------------------------------------------------------------

enum { ROWS = 50 };
static double strain[ROWS], ratio[ROWS];

static scree_chart make_chart(const scree_chart_line *line, size_t count)
{
    for (int k = 0; k < ROWS; k++) {
        strain[k] = 0.3 * k;
        ratio[k] = 1 + sin(strain[k]);
    }
    return (scree_chart){.title = "Stress ratio",
                         .x_label = "axial strain (%)",
                         .y_label = "σ_1/σ_3 (1)",
                         .line = line,
                         .line_count = count};
}

static void assert_charts(const char *name, const scree_chart *chart)
{
    scree_error error = {0};
    scree_status status = scree_chart_draw(name, chart, &error);
    if (status) fail_msg("%s: %s", name, error.message);
    assert_figure(name);
}

static void chart_is_written_and_drawn_again_by_its_script(void **state)
{
    (void)state;
    const scree_chart_line line[] = {{.x = strain, .y = ratio, .count = ROWS, .label = "from plates"},
                                     {.x = strain, .y = strain, .count = ROWS, .label = "it's", .dashed = true},
                                     {.x = ratio, .y = ratio, .count = ROWS / 2, .label = "points", .points = true}};
    scree_chart chart = make_chart(line, 3);
    assert_int_equal(mkdir("charts", 0777), 0);
    assert_charts("charts/ratio", &chart);
    assert_int_equal(unlink("charts/ratio.svg"), 0);
    assert_int_equal(unlink("charts/ratio.png"), 0);
    scree_error error;
    assert_int_equal(scree_gnuplot_run("charts", "ratio.gp", &error), SCREE_OK);
    assert_figure("charts/ratio");
    char *data = read_whole("charts/ratio.csv");
    assert_memory_equal(
        data, "\"axial strain (%)\",\"from plates\",\"it's\",\"axial strain (%)\",\"points\"\n0,1,0,1,1\n",
        strlen("\"axial strain (%)\",\"from plates\",\"it's\",\"axial strain (%)\",\"points\"\n0,1,0,1,1\n"));
    free(data);
}

/// No two of them look alike.
static void more_lines_than_colours_are_dashed(void **state)
{
    (void)state;
    enum { LINES = 16 };
    static double shifted[LINES][ROWS];
    scree_chart_line line[LINES];
    char *last = NULL, look[LINES][64];
    for (int k = 0; k < LINES; k++) line[k] = (scree_chart_line){.x = strain, .y = shifted[k], .count = ROWS};
    const scree_chart chart = make_chart(line, LINES);
    for (int k = 0; k < LINES; k++)
        for (int row = 0; row < ROWS; row++) shifted[k][row] = ratio[row] + k;
    assert_charts("many", &chart);
    char *script = read_whole("many.gp");
    for (int k = 0; k < LINES; k++) {
        last = strstr(last ? last + 1 : script, "with lines linecolor");
        assert_non_null(last);
        assert_int_equal(sscanf(last, "with lines linecolor %63[^\n]", look[k]), 1);
        *strstr(look[k], " notitle") = '\0';
        for (int other = 0; other < k; other++) assert_string_not_equal(look[k], look[other]);
    }
    free(script);
}

/// Nothing that stands in a text is run or breaks the figure.
static void texts_of_a_chart_are_only_texts(void **state)
{
    (void)state;
    const char *evil = "'; system \"touch hacked\"; # `touch hacked` $(touch hacked) \\ & < > \" {/:Bold x^_@~}\nquit";
    const scree_chart_line line = {.x = strain, .y = ratio, .count = ROWS, .label = "a'b"};
    scree_chart chart = make_chart(&line, 1);
    chart.title = evil;
    assert_charts("-it's `touch hacked`; $(touch hacked)", &chart);
    chart.y_label = evil;
    assert_charts("evil", &chart);
    assert_int_not_equal(access("hacked", F_OK), 0);
    scree_error error;
    assert_int_equal(scree_chart_draw("a\nb", &chart, &error), SCREE_ERROR_IO);
}

static void charts_of_odd_values(void **state)
{
    (void)state;
    scree_chart_line line[] = {{.x = strain, .y = ratio, .count = ROWS, .label = "values"},
                               {.x = strain, .y = ratio, .count = 0, .label = "empty"}};
    scree_chart chart = make_chart(line, 2);
    ratio[3] = NAN;
    ratio[4] = -INFINITY;
    assert_charts("gaps", &chart);
    char *script = read_whole("gaps.gp");
    assert_non_null(strstr(script, "values"));
    assert_null(strstr(script, "empty"));
    free(script);
    for (int k = 0; k < ROWS; k++) ratio[k] = 7;
    assert_charts("constant", &chart);
    for (int k = 0; k < ROWS; k++) ratio[k] = k % 2 ? 0 : 1e-5;
    chart.log_y = true;
    assert_charts("logarithmic", &chart);
    line[0].count = 1;
    assert_charts("one-point", &chart);
    ratio[0] = 0;
    scree_error error;
    assert_int_equal(scree_chart_draw("undrawable", &chart, &error), SCREE_ERROR_INPUT);
    assert_int_not_equal(access("undrawable.gp", F_OK), 0);
}

/// Whether a file has this text.
static bool has_text(const char *name, const char *text)
{
    char block[8192];
    FILE *file = fopen(name, "r");
    if (!file) return false;
    block[fread(block, 1, sizeof block - 1, file)] = 0;
    (void)fclose(file);
    return strstr(block, text) != NULL;
}

static void small_numbers_and_long_names_stay_legible(void **state)
{
    (void)state;
    static const double place[] = {1, 2, 3}, step[] = {6.1e-8, 6.3e-8, 6.2e-8}, share[] = {2e-9, 3e-9, 4e-9};
    static const char *const shorts[] = {"a", "b", "c"}, *const longs[] = {"a rather long name of a setting",
                                                                           "another one of them", "and a third one"};
    const scree_chart_line line = {.x = place, .y = step, .count = 3};
    scree_chart chart = {.title = "steps",
                         .x_label = "setting",
                         .y_label = "limit (s)",
                         .line = &line,
                         .line_count = 1,
                         .x_name = shorts,
                         .x_name_count = 3};
    scree_error error;
    check(scree_chart_draw("small", &chart, &error), &error);
    assert_true(has_text("small.gp", "set ylabel \"limit (10^{-9} s)\"") && has_text("small.gp", "1:($2*1e9)"));
    // The table keeps the true values, and short names stand upright.
    assert_true(has_text("small.csv", "6.1e-08") && !has_text("small.gp", "rotate"));
    const scree_chart_line other = {.x = place, .y = share, .count = 3};
    chart.line = &other;
    chart.y_label = "share (1)";
    chart.x_name = longs;
    check(scree_chart_draw("long", &chart, &error), &error);
    assert_true(has_text("long.gp", "share (10^{-9})") && has_text("long.gp", "rotate by 35 right"));
    // Of ordinary size: nothing is changed; a number of names without names means nothing.
    const scree_chart_line ordinary = {.x = place, .y = place, .count = 3};
    chart.line = &ordinary;
    chart.x_name = NULL;
    check(scree_chart_draw("ordinary", &chart, &error), &error);
    assert_true(has_text("ordinary.gp", "using 1:2") && has_text("ordinary.gp", "\"share (1)\""));
}

static void missing_or_failing_gnuplot_is_an_error_with_its_message(void **state)
{
    (void)state;
    FILE *file = fopen("bad.gp", "w");
    assert_non_null(file);
    fputs("plot 'there is no such file'\n", file);
    fclose(file);
    scree_error error;
    assert_int_equal(scree_gnuplot_run(".", "bad.gp", &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "there is no such file"));
    assert_int_equal(scree_gnuplot_run("no such folder", "bad.gp", &error), SCREE_ERROR_IO);
    char *path = strdup(getenv("PATH"));
    assert_int_equal(setenv("PATH", scratch, 1), 0);
    const scree_chart_line line = {.x = strain, .y = ratio, .count = ROWS};
    scree_chart chart = make_chart(&line, 1);
    assert_int_equal(scree_chart_draw("no-gnuplot", &chart, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "gnuplot-nox"));
    assert_int_equal(access("no-gnuplot.csv", F_OK), 0);
    assert_int_equal(setenv("PATH", path, 1), 0);
    free(path);
}

/// An open cylinder seen from the side: its rims, and where it turns away from the eye two straight lines.
static void round_walls_have_an_outline(void **state)
{
    (void)state;
    enum { SIDES = 48 };
    static double triangle[2 * SIDES][9];
    for (int k = 0; k < SIDES; k++) {
        const double a = 2 * M_PI * k / SIDES, b = 2 * M_PI * ((k + 1) % SIDES) / SIDES;
        const double low[9] = {cos(a), sin(a), 0, cos(b), sin(b), 0, cos(a), sin(a), 3};
        const double high[9] = {cos(b), sin(b), 0, cos(b), sin(b), 3, cos(a), sin(a), 3};
        memcpy(triangle[2 * k], low, sizeof low);
        memcpy(triangle[2 * k + 1], high, sizeof high);
    }
    scree_snapshot solid = {.dimension = 3, .wall_triangle_count = 2 * SIDES, .wall_triangle = triangle[0]};
    scree_snapshot plane = {.dimension = 2};
    const double right[3] = {1, 0, 0}, up[3] = {0, 0, 1};
    assert_int_equal(scree_wall_edges(&solid, right, up, &plane, NULL), SCREE_OK);
    int upright = 0;
    for (size_t k = 0; k < plane.wall_line_count; k++) {
        const double *line = &plane.wall_line[4 * k];
        if (fabs(line[3] - line[1]) < 1) continue;
        assert_true(fabs(fabs(line[0]) - 1) < 1e-12 && fabs(line[2] - line[0]) < 1e-12);
        upright++;
    }
    assert_int_equal(upright, 2);
    assert_int_equal(plane.wall_line_count, 2 * SIDES + 2);
    scree_release(&plane.wall_line);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_break_at_spaces_and_not_before_a_percent_sign),
        cmocka_unit_test(round_walls_have_an_outline),
        cmocka_unit_test(sequential_lightness_falls_evenly),
        cmocka_unit_test(diverging_lightness_falls_evenly_to_both_sides),
        cmocka_unit_test(colours_clamp_and_undefined_is_grey),
        cmocka_unit_test(sections_of_cells_fill_the_plane),
        cmocka_unit_test(limits_ignore_extremes),
        cmocka_unit_test(limits_of_degenerate_fields_are_intervals),
        cmocka_unit_test(ticks_lie_within_the_limits),
        cmocka_unit_test(numbers_and_lengths_as_text),
        cmocka_unit_test(text_becomes_valid),
        cmocka_unit_test(scene_of_every_kind_is_written),
        cmocka_unit_test(large_scene_is_a_small_file),
        cmocka_unit_test(discs_are_round_and_have_their_colour),
        cmocka_unit_test(what_is_not_shown_takes_no_room),
        cmocka_unit_test(extreme_snapshots_are_drawn),
        cmocka_unit_test(damaged_snapshots_are_drawn),
        cmocka_unit_test(very_many_marks_are_pixels),
        cmocka_unit_test(scene_that_cannot_be_drawn_says_so),
        cmocka_unit_test(scene_survives_lack_of_memory),
        cmocka_unit_test(chart_is_written_and_drawn_again_by_its_script),
        cmocka_unit_test(more_lines_than_colours_are_dashed),
        cmocka_unit_test(texts_of_a_chart_are_only_texts),
        cmocka_unit_test(charts_of_odd_values),
        cmocka_unit_test(small_numbers_and_long_names_stay_legible),
        cmocka_unit_test(missing_or_failing_gnuplot_is_an_error_with_its_message),
    };
    return cmocka_run_group_tests(tests, enter_scratch, leave_scratch);
}
