/// A plausible snapshot of a compressed sample without a simulation: a hexagonal lattice with noise in radius and
/// place, force chains that favour the vertical, and an inclined shear band in which discs rotate.
#ifndef HAND_MADE_SNAPSHOT_H
#define HAND_MADE_SNAPSHOT_H

#include "io/snapshot.h"

#include "base/memory.h"
#include "state/plates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static uint64_t hand_made_seed;

/// Uniform in 0 to 1 (SplitMix64).
static inline double hand_made_random(void)
{
    uint64_t z = hand_made_seed += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static inline void *hand_made_array(size_t count, size_t size)
{
    void *array = NULL;
    if (scree_allocate(&array, count, size, NULL)) abort();
    return array;
}

static inline void hand_made_create(scree_snapshot *s, size_t count, size_t contacts, size_t loop)
{
    *s = (scree_snapshot){
        .dimension = 2, .count = count, .contact_count = contacts, .loop_count = loop, .axial_strain = NAN};
    (void)snprintf(s->stage, sizeof s->stage, "compress");
    double **body[] = {&s->x, &s->y, &s->radius, &s->angle, &s->vx, &s->vy, &s->spin};
    for (size_t k = 0; k < sizeof body / sizeof body[0]; k++) *body[k] = hand_made_array(count, sizeof(double));
    double **contact[] = {&s->normal_force, &s->tangential_force, &s->contact_x,
                          &s->contact_y,    &s->branch_x,         &s->branch_y};
    for (size_t k = 0; k < sizeof contact / sizeof contact[0]; k++)
        *contact[k] = hand_made_array(contacts, sizeof(double));
    s->first = hand_made_array(contacts, sizeof(uint32_t));
    s->second = hand_made_array(contacts, sizeof(uint32_t));
    s->loop = hand_made_array(loop, sizeof(uint32_t));
}

static inline void hand_made_destroy(scree_snapshot *s)
{
    double **array[] = {&s->x,
                        &s->y,
                        &s->radius,
                        &s->angle,
                        &s->vx,
                        &s->vy,
                        &s->spin,
                        &s->normal_force,
                        &s->tangential_force,
                        &s->contact_x,
                        &s->contact_y,
                        &s->branch_x,
                        &s->branch_y};
    for (size_t k = 0; k < sizeof array / sizeof array[0]; k++) scree_release(array[k]);
    scree_release(&s->first);
    scree_release(&s->second);
    scree_release(&s->loop);
}

static inline void hand_made_contact(scree_snapshot *s, uint32_t first, uint32_t second)
{
    size_t k = s->contact_count++;
    double dx = s->x[first] - s->x[second], dy = s->y[first] - s->y[second], length = hypot(dx, dy);
    s->first[k] = first;
    s->second[k] = second;
    s->contact_x[k] = s->x[second] + dx / 2;
    s->contact_y[k] = s->y[second] + dy / 2;
    s->branch_x[k] = dx;
    s->branch_y[k] = dy;
    s->normal_force[k] = -20 * log(1 - hand_made_random()) * (0.35 + 1.6 * pow(fabs(dy) / length, 3));
    s->tangential_force[k] = 0.3 * s->normal_force[k] * (hand_made_random() - 0.5);
}

/// `columns` x `rows` discs of 0.5 to 1 mm radius, axial strain `strain`; plates below and above.
static inline void hand_made_packing(scree_snapshot *s, uint32_t columns, uint32_t rows, double strain)
{
    const double spacing = 1.55e-3, height = spacing * sqrt(3) / 2;
    uint32_t count = columns * rows;
    hand_made_seed = 7;
    hand_made_create(s, count, 4 * (size_t)count, 2 * ((size_t)columns + rows) - 4);
    s->axial_strain = strain;
    s->time = strain / 0.01;
    double top = (rows - 1) * height * (1 - strain), middle = columns * spacing / 2;
    for (uint32_t k = 0; k < count; k++) {
        double row = k / columns, column = k % columns;
        double x = (column + 0.5 * (k / columns % 2) + 0.12 * (hand_made_random() - 0.5)) * spacing;
        double y = (row + 0.12 * (hand_made_random() - 0.5)) * height * (1 - strain);
        double across = ((x - middle) * 0.8 - (y - top / 2) * 0.6) / (4 * spacing);
        double slide = 6 * strain * spacing * tanh(across), band = 1 / pow(cosh(across), 2);
        s->radius[k] = spacing / 2 * (0.80 + 0.24 * hand_made_random());
        s->x[k] = x + (x - middle) * strain * 0.9 + 0.6 * slide + 0.4 * strain * spacing * (hand_made_random() - 0.5);
        s->y[k] = y + 0.8 * slide + 0.4 * strain * spacing * (hand_made_random() - 0.5);
        s->angle[k] = strain * (6 * band + 1.2) * (hand_made_random() - 0.5) + 3 * strain * band;
        s->spin[k] = 0.01 * s->angle[k] / (strain + 1e-3);
        s->vx[k] = 1e-4 * tanh(across);
        s->vy[k] = -1e-4 * (1 + row / rows) + 0.8e-4 * tanh(across);
    }
    s->contact_count = 0;
    for (uint32_t k = 0; k < count; k++) {
        uint32_t row = k / columns, column = k % columns, shift = row % 2;
        if (column + 1 < columns && hand_made_random() < 0.55) hand_made_contact(s, k, k + 1);
        if (row + 1 == rows) continue;
        if (column + shift >= 1 && hand_made_random() < 0.8) hand_made_contact(s, k, k + columns + shift - 1);
        if (column + shift < columns && hand_made_random() < 0.8) hand_made_contact(s, k, k + columns + shift);
    }
    size_t n = 0;
    for (uint32_t c = 0; c < columns; c++) s->loop[n++] = c;
    for (uint32_t r = 1; r < rows; r++) s->loop[n++] = r * columns + columns - 1;
    for (uint32_t c = columns - 1; c-- > 0;) s->loop[n++] = (rows - 1) * columns + c;
    for (uint32_t r = rows - 1; r-- > 1;) s->loop[n++] = r * columns;
    s->wall[SCREE_WALL_BOTTOM] = (scree_wall){.normal = {0, 1}, .active = 1, .position = -0.9e-3};
    s->wall[SCREE_WALL_TOP] = (scree_wall){.normal = {0, -1}, .active = 1, .position = -(top + 0.9e-3)};
}

#endif
