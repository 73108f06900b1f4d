/// Convex polygons in runs, law polygon_overlap, ledger on, everything awake, one thread, processor time.
///
/// First 300 grains that have settled in a box (bench/data/settled.yaml), of 6 to 8, of 6 and of 24 corners:
/// particle-steps per second, contacts, and what a step costs for each contact, over that of 6 corners. The three
/// samples take turns, and each figure is the best of several short runs, so that a change of the machine's load falls
/// on all of them.
///
/// Then the memory of a polygon of 8 corners: what 900 more grains allocate.
///
/// Then the share of list upkeep while one grain each 0.1 s falls from 30 cm onto 300 that have settled in a box
/// (bench/data/bed.yaml): what steps that make a list take more than those that do not, over all. Births and falls are
/// those of a pour; the bed stands for the pile, which a bench has no time to pour. Larger beds are not made: their
/// layers of grains block one another.
#include "bench.h"

#include "base/memory.h"
#include "run/simulation.h"

#include <math.h>

enum { RUNS = 8, STEPS = 3000, FALL_STEPS = 37500, POUR_STEPS = 25000, SMALL = 300, LARGE = 1200, FALLING = 30 };

typedef struct sample {
    scree_case *c;
    scree_simulation s;
    double rate; ///< particle-steps/s, the best
} sample;

/// Opens a case of bench/data and goes to the begin of a stage.
static void open_case(sample *b, const char *path, const char *const *overrides, size_t count, int64_t stage)
{
    scree_case_options choice = {.overrides = overrides, .override_count = count};
    scree_problems *problems = NULL;
    scree_error error;
    *b = (sample){0};
    if (scree_case_read(path, &choice, &b->c, &problems)) require(SCREE_ERROR_INPUT, scree_problems_get(problems, 0));
    require(scree_simulation_open(b->c, 1, &b->s, &error), &error);
    while (b->s.state.stage.index < stage) require(scree_simulation_step(&b->s, &error), &error);
}

/// Width of a box in which so many grains are as high as 300 in one of 10 cm, in proportion [m].
static double width_of(int count)
{
    return 0.1 * sqrt(count / (double)SMALL);
}

/// Settled grains of `low` to `high` corners.
static void open_settled(sample *b, int count, int low, int high)
{
    char text[5][96];
    (void)snprintf(text[0], sizeof text[0], "particles.count=%d", count);
    (void)snprintf(text[1], sizeof text[1], "particles.corners_min=%d", low);
    (void)snprintf(text[2], sizeof text[2], "particles.corners_max=%d", high);
    (void)snprintf(text[3], sizeof text[3], "walls.right.point=[%.17g m, 0]", width_of(count));
    (void)snprintf(text[4], sizeof text[4], "stages.prepare.width=%.17g m", width_of(count));
    const char *const overrides[] = {text[0], text[1], text[2], text[3], text[4]};
    open_case(b, SCREE_SOURCE_DIR "/bench/data/settled.yaml", overrides, 5, 2);
}

/// A settled bed that grains begin to fall onto.
static void open_bed(sample *b, int count)
{
    char text[5][96];
    const double width = width_of(count);
    (void)snprintf(text[0], sizeof text[0], "particles.count=%d", count + FALLING);
    (void)snprintf(text[1], sizeof text[1], "stages.fill.count=%d", count);
    (void)snprintf(text[2], sizeof text[2], "walls.right.point=[%.17g m, 0]", width);
    (void)snprintf(text[3], sizeof text[3], "sources.rain.end=[%.17g m, 1 cm]", width - 5e-3);
    (void)snprintf(text[4], sizeof text[4], "sources.spout.place=[%.17g m, 2 m]", width / 2);
    const char *const overrides[] = {text[0], text[1], text[2], text[3], text[4]};
    open_case(b, SCREE_SOURCE_DIR "/bench/data/bed.yaml", overrides, 5, 3);
}

static void close_sample(sample *b)
{
    scree_simulation_close(&b->s);
    scree_case_free(b->c);
}

static size_t contacts_of(sample *b)
{
    scree_contact_table table = {0};
    scree_error error;
    require(scree_contact_table_build(&b->s.stage_model, &b->s.state, &b->s.work, &table, &error), &error);
    size_t count = table.count;
    scree_contact_table_destroy(&table);
    return count;
}

static void measure(sample *b)
{
    scree_error error;
    const double begin = seconds(1);
    for (int k = 0; k < STEPS; k++) require(scree_simulation_step(&b->s, &error), &error);
    b->rate = fmax(b->rate, (double)b->s.state.count * STEPS / (seconds(1) - begin));
}

static void print_settled(void)
{
    static const int corners[3][2] = {{6, 8}, {6, 6}, {24, 24}};
    sample all[3];
    double cost[3];
    for (int k = 0; k < 3; k++) open_settled(&all[k], SMALL, corners[k][0], corners[k][1]);
    for (int run = 0; run < RUNS; run++)
        for (int k = 0; k < 3; k++) measure(&all[k]);
    printf("settled grains, ledger on, all awake\n%8s %8s %10s %8s %12s\n", "corners", "grains", "contacts", "Mps/s",
           "ns/contact");
    for (int k = 0; k < 3; k++) {
        const size_t contacts = contacts_of(&all[k]), count = all[k].s.state.count;
        cost[k] = 1e9 * (double)count / all[k].rate / (double)contacts;
        printf("%4d to %d %8zu %10zu %8.2f %12.1f\n", corners[k][0], corners[k][1], count, contacts, 1e-6 * all[k].rate,
               cost[k]);
        close_sample(&all[k]);
    }
    printf("a contact of 24 corners costs %.2f times that of 6\n", cost[2] / cost[1]);
}

static void print_memory(void)
{
    size_t all[2], without[2], peak, before;
    for (int k = 0; k < 2; k++) {
        sample b;
        scree_allocation_statistics(&before, &peak);
        open_settled(&b, k ? LARGE : SMALL, 8, 8);
        scree_allocation_statistics(&all[k], &peak);
        scree_contact_table_destroy(&b.s.table);
        scree_allocation_statistics(&without[k], &peak);
        all[k] -= before;
        without[k] -= before;
        close_sample(&b);
    }
    const double more = LARGE - SMALL;
    printf(
        "memory: %.0f bytes a polygon of 8 corners, with its share of the lists; the contact table of samples %.0f\n",
        (double)(without[1] - without[0]) / more, (double)(all[1] - all[0] - (without[1] - without[0])) / more);
}

static void print_pour(int count)
{
    sample b;
    scree_error error;
    double all = 0, with = 0;
    uint64_t lists = 0;
    open_bed(&b, count);
    // The first grains have landed then.
    for (int k = 0; k < FALL_STEPS; k++) require(scree_simulation_step(&b.s, &error), &error);
    for (int k = 0; k < POUR_STEPS; k++) {
        const uint64_t before = b.s.work.rebuilds;
        const double begin = seconds(1);
        require(scree_simulation_step(&b.s, &error), &error);
        const double step = seconds(1) - begin;
        all += step;
        if (b.s.work.rebuilds == before) continue;
        with += step;
        lists++;
    }
    const double without = (all - with) / (double)(POUR_STEPS - lists);
    printf(
        "pour onto %d grains: a list in %.0f steps, %.2f times a step; list upkeep %.1f %% of the time; %.2f Mps/s\n",
        count, (double)POUR_STEPS / (double)lists, with / (double)lists / without - 1,
        100 * (with - (double)lists * without) / all, 1e-6 * (double)b.s.state.count * POUR_STEPS / all);
    close_sample(&b);
}

int main(void)
{
    print_settled();
    print_memory();
    print_pour(SMALL);
    return EXIT_SUCCESS;
}
