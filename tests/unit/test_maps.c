/// Maps, and displacements as arrows: colours of values of one sign and of two, the bar of a flat map, which grains
/// have an arrow.
#include "hand_made_snapshot.h"
#include "view_testing.h"

#include "view/displacements.h"
#include "view/map.h"

// ---- maps --------------------------------------------------------------------------------------------------------

enum { COLUMNS = 10, ROWS = 2 };

/// A map 1 m wide and 0.2 m high whose values go from `first` to `last`, the same in both rows.
static picture draw_map(double first, double last)
{
    double value[COLUMNS * ROWS];
    scree_error error = {0};
    for (int k = 0; k < COLUMNS * ROWS; k++) value[k] = first + (last - first) * (k % COLUMNS) / (COLUMNS - 1);
    const scree_map map = {.title = "Map",
                           .name = "value (1)",
                           .columns = COLUMNS,
                           .rows = ROWS,
                           .high = {1, 0.2},
                           .value = value,
                           .colours = SCREE_COLOUR_DIVERGING};
    check(scree_map_draw("map", &map, &error), &error);
    return picture_read("map.png");
}

/// Colour in the middle of a rectangle of the lower row; the map begins 58 pt from the left, is 430 pt wide and begins
/// 42 pt from the top, on a page of 614 pt.
static bool has_colour(const picture *p, int column, scree_colour colour)
{
    const double scale = p->width / 614.0, x = 58 + 43 * (column + 0.5), y = 42 + 64.5;
    return is_colour(picture_pixel(p, (int)(scale * x), (int)(scale * y)), colour);
}

static void values_of_one_sign_have_a_sequential_scale(void **state)
{
    (void)state;
    const scree_colour weak = scree_colour_at(SCREE_COLOUR_SEQUENTIAL, 0),
                       strong = scree_colour_at(SCREE_COLOUR_SEQUENTIAL, 1);
    picture p = draw_map(1, 9);
    assert_true(has_colour(&p, 0, weak) && has_colour(&p, COLUMNS - 1, strong));
    cairo_surface_destroy(p.surface);
    p = draw_map(-9, -1);
    assert_true(has_colour(&p, 0, strong) && has_colour(&p, COLUMNS - 1, weak));
    cairo_surface_destroy(p.surface);
    p = draw_map(-9, 9);
    assert_true(has_colour(&p, 0, scree_colour_at(SCREE_COLOUR_DIVERGING, 0)));
    assert_true(has_colour(&p, COLUMNS - 1, scree_colour_at(SCREE_COLOUR_DIVERGING, 1)));
    cairo_surface_destroy(p.surface);
}

/// What stands below the map, its numbers and the name of its axis, is lower than what stands below the bar.
static void the_bar_of_a_flat_map_is_no_higher(void **state)
{
    (void)state;
    picture p = draw_map(1, 9);
    assert_true(fabs(p.height * 614.0 / p.width - (42 + 86 + 44)) < 1);
    cairo_surface_destroy(p.surface);
}

// ---- displacements -----------------------------------------------------------------------------------------------

/// Arrows that displacements.svg has: closed parts of the paths that are filled with their colour, as any Cairo writes
/// it.
static size_t count_arrows(void)
{
    char *text = read_whole("displacements.svg");
    size_t count = 0;
    for (char *path = strstr(text, "<path"); path; path = strstr(path + 1, "<path")) {
        char *end = strchr(path, '>');
        *end = 0;
        for (char *part = strstr(path, "rgb(7%") ? strchr(path, 'Z') : NULL; part; part = strchr(part + 1, 'Z'))
            count++;
        *end = '>';
    }
    free(text);
    return count;
}

/// Draws `side` x `side` grains of 1 mm that lie `gap` diameters apart and have moved alike. The sample lacks the first
/// one, and does not know how the last one has moved.
static size_t draw_displacements(size_t side, double gap)
{
    scree_error error = {0};
    scree_snapshot s;
    hand_made_create(&s, side * side, 0, 0);
    s.id = hand_made_array(s.count, sizeof *s.id);
    scree_average_sample sample = {.dimension = 2, .bodies = s.count - 1, .count = s.count - 1};
    sample.grain = hand_made_array(s.count, sizeof *sample.grain);
    for (size_t k = 0; k < s.count; k++) {
        s.id[k] = (uint32_t)(2 * k);
        s.x[k] = 1e-3 * gap * (double)(k % side);
        s.y[k] = 1e-3 * gap * (double)(k / side);
        s.radius[k] = 5e-4;
        if (k > 0)
            sample.grain[k - 1] = (scree_average_grain){
                .id = s.id[k], .counted = true, .moved = k + 1 < s.count, .displacement = {1e-6, 2e-6}};
    }
    check(scree_displacements_draw("displacements", &s, &sample, NULL, &error), &error);
    const size_t arrows = count_arrows() - 1; // that of the legend
    scree_release(&s.id);
    scree_release(&sample.grain);
    hand_made_destroy(&s);
    return arrows;
}

static void grains_that_lie_apart_have_arrows_where_their_way_is_known(void **state)
{
    (void)state;
    assert_int_equal(draw_displacements(4, 3), 14);
}

/// Of those that touch one in a square of two diameters has, and of thousands no more than 700.
static void of_many_grains_some_have_arrows(void **state)
{
    (void)state;
    const size_t few = draw_displacements(20, 1.01), many = draw_displacements(100, 1.01);
    assert_true(few >= 90 && few <= 110);
    assert_true(many >= 600 && many <= 700);
}

static void what_has_not_moved_is_not_drawn(void **state)
{
    (void)state;
    scree_error error = {0};
    scree_snapshot s;
    scree_average_sample sample = {.dimension = 2};
    hand_made_create(&s, 4, 0, 0);
    s.id = hand_made_array(s.count, sizeof *s.id);
    assert_int_equal(scree_displacements_draw("nothing", &s, &sample, NULL, &error), SCREE_ERROR_INPUT);
    s.dimension = 3;
    assert_int_equal(scree_displacements_draw("nothing", &s, &sample, NULL, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "plane"));
    s.dimension = 2;
    scree_release(&s.id);
    hand_made_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_of_one_sign_have_a_sequential_scale),
        cmocka_unit_test(the_bar_of_a_flat_map_is_no_higher),
        cmocka_unit_test(grains_that_lie_apart_have_arrows_where_their_way_is_known),
        cmocka_unit_test(of_many_grains_some_have_arrows),
        cmocka_unit_test(what_has_not_moved_is_not_drawn),
    };
    return cmocka_run_group_tests(tests, enter_scratch, leave_scratch);
}
