/// Pages drawn in an address space of any size: each is drawn or refused, none ends the program (where Cairo cannot
/// have memory for the edges of a shape it destroys its stack).
#include "testing.h"

#include "base/error.h"
#include "io_scratch.h"
#include "view/page.h"

#include <math.h>
#include <sys/wait.h>

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define SANITIZED 1
#elif defined __has_feature
#define SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define SANITIZED 0
#endif

enum { WIDTH = 400, SIDE = 30, DISCS = SIDE * SIDE, LEAST = 14 << 20, MOST = 62 << 20, STEP = 500 << 10 };

/// Discs as one shape with many edges, its rim, and a line of text.
static void draw(cairo_t *cairo, void *unused)
{
    (void)unused;
    scree_text_show(cairo, 10, 20, 0, "Title", (scree_text_style){.size = 12, .bold = true});
    for (int k = 0; k < DISCS; k++) {
        double x = 20 + (WIDTH - 40) * (k % SIDE + 0.5) / SIDE, y = 30 + (WIDTH - 40) * (k / SIDE + 0.5) / SIDE;
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, x, y, 0.45 * (WIDTH - 40) / SIDE, 0, 2 * M_PI);
    }
    cairo_set_source_rgb(cairo, 0.5, 0.5, 0.9);
    cairo_fill_preserve(cairo);
    cairo_set_source_rgb(cairo, 0, 0, 0);
    cairo_stroke(cairo);
}

/// Bytes of this process's address space.
static size_t address_space(void)
{
    size_t pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%zu", &pages) != 1) fail_msg("there is no /proc/self/statm");
    (void)fclose(file);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

/// In a child, with `room` bytes more than this process has: 0 drawn, 1 refused for memory, 2 another error.
static int draw_within(size_t room)
{
    scree_error error = {0};
    const scree_page page = {WIDTH, WIDTH, DISCS, draw, NULL, 0};
    const struct rlimit limit = {address_space() + room, RLIM_INFINITY};
    if (setrlimit(RLIMIT_AS, &limit) != 0) return 2;
    scree_status status = scree_page_write("page", &page, &error);
    if (!status) return 0;
    return status == SCREE_ERROR_IO && strstr(error.message, "out of memory") ? 1 : 2;
}

static void every_page_is_drawn_or_refused(void **unused)
{
    (void)unused;
    if (SANITIZED) skip(); // their shadows need more than any limit
    int ends[3] = {0};
    for (size_t room = LEAST; room <= MOST; room += STEP) {
        int how = 0;
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) _exit(draw_within(room));
        assert_int_equal(waitpid(child, &how, 0), child);
        if (!WIFEXITED(how)) fail_msg("room for %zu bytes: signal %d", room, WTERMSIG(how));
        assert_in_range(WEXITSTATUS(how), 0, 2);
        ends[WEXITSTATUS(how)]++;
    }
    print_message("%d drawn, %d refused\n", ends[0], ends[1]);
    assert_true(ends[0] > 0 && ends[1] > 0);
    assert_int_equal(ends[2], 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_page_is_drawn_or_refused, enter_scratch, leave_scratch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
