/// Cost of a neighbour-list rebuild and length of the list, on a random close packing of discs or spheres (radii 0.75
/// to 1.25, uniform by number) between walls, made here by letting overlapping bodies push each other apart.
///
/// Prints, for each number of bodies and each skin: milliseconds per rebuild (the best of several, bodies displaced at
/// random by up to half the skin and back, every contact with a history), pairs a body and touching pairs a body in the
/// packing at rest, and bytes a body of state, list and search. Arguments: threads (default 1), dimension (default 2),
/// numbers of bodies (default 32768 1000000).
#include "bench.h"
#include "state/plates.h"

#include "base/random.h"
#include "search/neighbours.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RELAXATIONS = 150, REBUILDS = 10 };

/// By dimension: just above random close packing.
static const double solid_fraction[] = {0, 0, 0.84, 0.64};

/// Uniform on [-1, 1).
static double symmetric(uint64_t seed, uint64_t counter)
{
    return 2 * scree_random_uniform(seed, SCREE_RANDOM_TEST, counter) - 1;
}

/// Bodies on a square or cubic grid, displaced at random, in a box of the solid fraction.
static void fill_box(scree_state *state)
{
    const int dimension = state->dimension;
    double room = 0;
    for (size_t k = 0; k < state->count; k++) {
        double radius = 1 + 0.25 * symmetric(1, k);
        state->row[k] = (scree_row){.radius = radius, .mass = 1};
        room += dimension == 3 ? 4 * M_PI / 3 * radius * radius * radius : M_PI * radius * radius;
    }
    double side = pow(room / solid_fraction[dimension], 1.0 / dimension);
    double columns = ceil(pow((double)state->count, 1.0 / dimension) - 1e-9), spacing = side / columns;
    for (size_t k = 0; k < state->count; k++) {
        double number = (double)k;
        state->row[k].x = (fmod(number, columns) + 0.5 + 0.4 * symmetric(2, k)) * spacing;
        number = floor(number / columns);
        state->row[k].y = (fmod(number, columns) + 0.5 + 0.4 * symmetric(3, k)) * spacing;
        if (dimension == 3) state->row[k].z = (floor(number / columns) + 0.5 + 0.4 * symmetric(4, k)) * spacing;
    }
    const int axis[SCREE_WALL_COUNT] = {dimension - 1, dimension - 1, 0, 0, 1, 1};
    for (int w = 0; w < 2 * dimension; w++) {
        scree_plates(state)[w] = (scree_wall){.position = w % 2 ? -side : 0, .active = 1};
        scree_plates(state)[w].normal[axis[w]] = w % 2 ? -1 : 1;
    }
}

/// Every overlapping pair moves apart by half its overlap; returns the largest displacement.
static double push_apart(scree_state *state, const scree_work *work, scree_vector *push)
{
    memset(push, 0, state->count * sizeof *push);
    for (size_t k = 0; k < work->pairs.count; k++) {
        uint32_t first = work->pairs.first[k], second = work->pairs.second[k];
        scree_vector a, b;
        scree_body_position(state, first, a);
        scree_body_position(state, second, b);
        scree_vector apart = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        double distance = scree_length(apart),
               overlap = state->row[first].radius + state->row[second].radius - distance;
        if (overlap <= 0 || distance == 0) continue;
        for (int c = 0; c < 3; c++) {
            push[first][c] += 0.3 * overlap / distance * apart[c];
            push[second][c] -= 0.3 * overlap / distance * apart[c];
        }
    }
    for (size_t k = 0; k < work->wall_pairs.count; k++) {
        uint32_t body = work->wall_pairs.body[k];
        const scree_wall *wall = &scree_plates(state)[work->wall_pairs.wall[k]];
        scree_vector a;
        scree_body_position(state, body, a);
        double along = wall->normal[0] * a[0] + wall->normal[1] * a[1] + wall->normal[2] * a[2];
        double overlap = state->row[body].radius + wall->position - along;
        for (int c = 0; c < 3 && overlap > 0; c++) push[body][c] += 0.6 * overlap * wall->normal[c];
    }
    double largest = 0;
    for (size_t k = 0; k < state->count; k++) {
        scree_row *row = &state->row[k];
        row->x += push[k][0];
        row->y += push[k][1];
        if (state->dimension == 3) row->z += push[k][2];
        largest = fmax(largest, scree_length(push[k]));
    }
    return largest;
}

static void measure_skin(const scree_model *model, scree_state *state, scree_work *work, double skin)
{
    scree_error error;
    double best = HUGE_VAL;
    work->skin = skin;
    for (int k = 0; k < REBUILDS; k++) {
        for (size_t p = 0; p < work->pairs.section[1].touching_end; p++) work->pairs.history[p].value[0] = 1;
        for (size_t id = 0; id < state->count; id++) {
            scree_row *row = &state->row[state->row_of_id[id]];
            double sign = k % 2 ? -1 : 1;
            double size = sign * 0.5 / sqrt(state->dimension) * skin;
            row->x += size * symmetric(5 + (uint64_t)k / 2, 3 * id);
            row->y += size * symmetric(5 + (uint64_t)k / 2, 3 * id + 1);
            if (state->dimension == 3) row->z += size * symmetric(5 + (uint64_t)k / 2, 3 * id + 2);
        }
        scree_neighbours_invalidate(work);
        double begin = seconds(work->threads);
        require(scree_neighbours_refresh(model, state, work, &error), &error);
        best = fmin(best, 1e3 * (seconds(work->threads) - begin));
    }
    double count = (double)state->count;
    size_t bytes;
    scree_allocation_statistics(&bytes, NULL);
    const char *bodies = state->dimension == 3 ? "spheres" : "discs";
    printf(
        "%9zu %s  skin %.2f  %8.3f ms a rebuild (%5.1f ns a body)  %5.2f pairs a body, %5.2f touching  %6.1f bytes a "
        "body\n",
        state->count, bodies, skin, best, 1e6 * best / count, (double)work->pairs.count / count,
        (double)work->pairs.section[1].touching_end / count, (double)bytes / count);
}

static void measure(size_t count, int dimension, int threads)
{
    scree_model model = {.dimension = dimension, .mean_radius = 1, .laws = {{.law = SCREE_SLOT_hertz_mindlin}}};
    scree_state state;
    scree_work work;
    scree_error error;
    scree_vector *push = calloc(count, sizeof *push);
    if (!push) exit(EXIT_FAILURE);
    require(scree_state_create(&state, dimension, count, &error), &error);
    require(scree_work_create(&work, &model, threads, &error), &error);
    fill_box(&state);
    for (int k = 0; k < RELAXATIONS; k++) {
        require(scree_neighbours_refresh(&model, &state, &work, &error), &error);
        work.budget -= push_apart(&state, &work, push);
    }
    free(push);
    const double skins[] = {0.05, 0.10, 0.15, 0.20, 0.30};
    for (size_t k = 0; k < sizeof skins / sizeof *skins; k++) measure_skin(&model, &state, &work, skins[k]);
    scree_work_destroy(&work);
    scree_state_destroy(&state);
}

int main(int argc, char **argv)
{
    int threads = argc > 1 ? atoi(argv[1]) : 1, dimension = argc > 2 ? atoi(argv[2]) : 2;
    if (argc <= 3) {
        measure(32768, dimension, threads);
        measure(1000000, dimension, threads);
    }
    for (int k = 3; k < argc; k++) measure((size_t)atol(argv[k]), dimension, threads);
    return EXIT_SUCCESS;
}
