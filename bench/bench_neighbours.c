/// Cost of a neighbour-list rebuild and length of the list, on a random close packing of discs (radii 0.75 to 1.25,
/// uniform by number) between four walls, made here by letting overlapping discs push each other apart.
///
/// Prints, for each number of discs and each skin: milliseconds per rebuild (the best of several, bodies displaced at
/// random by up to half the skin and back, every contact with a history), pairs a disc and touching pairs a disc in the
/// packing at rest, and bytes a disc of state, list and search. Arguments: threads (default 1), numbers of discs
/// (default 32768 1000000).
#include "base/random.h"
#include "search/neighbours.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { RELAXATIONS = 150, REBUILDS = 10 };

static const double solid_fraction = 0.84;

static void require(scree_status status, const scree_error *error)
{
    if (!status) return;
    (void)fprintf(stderr, "%s\n", error->message);
    exit(EXIT_FAILURE);
}

static double seconds(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// Uniform on [-1, 1).
static double symmetric(uint64_t seed, uint64_t counter)
{
    return 2 * scree_random_uniform(seed, SCREE_RANDOM_TEST, counter) - 1;
}

/// Discs on a square grid, displaced at random, in a square box of the solid fraction.
static void fill_box(scree_state *state)
{
    double area = 0;
    for (size_t k = 0; k < state->count; k++) {
        double radius = 1 + 0.25 * symmetric(1, k);
        state->row[k] = (scree_row){.radius = radius, .mass = 1};
        area += M_PI * radius * radius;
    }
    double side = sqrt(area / solid_fraction), columns = ceil(sqrt((double)state->count)), spacing = side / columns;
    for (size_t k = 0; k < state->count; k++) {
        state->row[k].x = (fmod((double)k, columns) + 0.5 + 0.4 * symmetric(2, k)) * spacing;
        state->row[k].y = (floor((double)k / columns) + 0.5 + 0.4 * symmetric(3, k)) * spacing;
    }
    const double normal[SCREE_WALL_COUNT][2] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
    for (int w = 0; w < SCREE_WALL_COUNT; w++)
        state->wall[w] =
            (scree_wall){.position = w % 2 ? -side : 0, .normal = {normal[w][0], normal[w][1]}, .active = 1};
}

/// Every overlapping pair moves apart by half its overlap; returns the largest displacement.
static double push_apart(scree_state *state, const scree_work *work)
{
    for (size_t k = 0; k < state->count; k++) state->row[k].vx = state->row[k].vy = 0;
    for (size_t k = 0; k < work->pairs.count; k++) {
        scree_row *a = &state->row[work->pairs.first[k]], *b = &state->row[work->pairs.second[k]];
        double dx = a->x - b->x, dy = a->y - b->y, distance = sqrt(dx * dx + dy * dy);
        double overlap = a->radius + b->radius - distance;
        if (overlap <= 0 || distance == 0) continue;
        double push = 0.3 * overlap / distance;
        a->vx += push * dx;
        a->vy += push * dy;
        b->vx -= push * dx;
        b->vy -= push * dy;
    }
    for (size_t k = 0; k < work->wall_pairs.count; k++) {
        scree_row *a = &state->row[work->wall_pairs.body[k]];
        const scree_wall *wall = &state->wall[work->wall_pairs.wall[k]];
        double overlap = a->radius + wall->position - wall->normal[0] * a->x - wall->normal[1] * a->y;
        if (overlap <= 0) continue;
        a->vx += 0.6 * overlap * wall->normal[0];
        a->vy += 0.6 * overlap * wall->normal[1];
    }
    double largest = 0;
    for (size_t k = 0; k < state->count; k++) {
        scree_row *row = &state->row[k];
        row->x += row->vx;
        row->y += row->vy;
        largest = fmax(largest, hypot(row->vx, row->vy));
    }
    return largest;
}

static void measure_skin(const scree_model *model, scree_state *state, scree_work *work, double skin)
{
    scree_error error;
    double best = HUGE_VAL;
    work->skin = skin;
    for (int k = 0; k < REBUILDS; k++) {
        for (size_t p = 0; p < work->pairs.touching_count; p++) work->pairs.history[p].value[0] = 1;
        for (size_t id = 0; id < state->count; id++) {
            scree_row *row = &state->row[state->row_of_id[id]];
            double sign = k % 2 ? -1 : 1;
            row->x += sign * 0.35 * skin * symmetric(4 + (uint64_t)k / 2, 2 * id);
            row->y += sign * 0.35 * skin * symmetric(4 + (uint64_t)k / 2, 2 * id + 1);
        }
        scree_neighbours_invalidate(work);
        double begin = seconds();
        require(scree_neighbours_refresh(model, state, work, &error), &error);
        best = fmin(best, 1e3 * (seconds() - begin));
    }
    double count = (double)state->count;
    size_t bytes;
    scree_allocation_statistics(&bytes, NULL);
    printf(
        "%9zu discs  skin %.2f  %8.3f ms a rebuild (%5.1f ns a disc)  %5.2f pairs a disc, %5.2f touching  %6.1f bytes "
        "a disc\n",
        state->count, skin, best, 1e6 * best / count, (double)work->pairs.count / count,
        (double)work->pairs.touching_count / count, (double)bytes / count);
}

static void measure(size_t count, int threads)
{
    scree_model model = {.mean_radius = 1};
    scree_state state;
    scree_work work;
    scree_error error;
    require(scree_state_create(&state, 2, count, &error), &error);
    require(scree_work_create(&work, &model, threads, &error), &error);
    fill_box(&state);
    for (int k = 0; k < RELAXATIONS; k++) {
        require(scree_neighbours_refresh(&model, &state, &work, &error), &error);
        work.budget -= push_apart(&state, &work);
    }
    const double skins[] = {0.05, 0.10, 0.15, 0.20, 0.30};
    for (size_t k = 0; k < sizeof skins / sizeof *skins; k++) measure_skin(&model, &state, &work, skins[k]);
    scree_work_destroy(&work);
    scree_state_destroy(&state);
}

int main(int argc, char **argv)
{
    int threads = argc > 1 ? atoi(argv[1]) : 1;
    if (argc <= 2) {
        measure(32768, threads);
        measure(1000000, threads);
    }
    for (int k = 2; k < argc; k++) measure((size_t)atol(argv[k]), threads);
    return EXIT_SUCCESS;
}
