/// Samples made by hand for averages: grains and contacts one by one.
#ifndef AVERAGE_FIXTURE_H
#define AVERAGE_FIXTURE_H

#include "testing.h"

#include "average/sample.h"
#include "base/random.h"

#include <math.h>
#include <string.h>

enum { ROOM = 4096 };

/// Fails unless a value is within a distance of what it should be.
#define near(value, expected, distance) near_at(__FILE__, __LINE__, value, expected, distance)
static inline void near_at(const char *file, int line, double value, double expected, double distance)
{
    if (fabs(value - expected) <= distance) return;
    print_error("%.17g is not within %.3g of %.17g (%.3g away)\n", value, distance, expected, value - expected);
    _fail(file, line);
}

static inline double average_random(uint64_t counter)
{
    return scree_random_uniform(11, SCREE_RANDOM_TEST, counter);
}

static inline scree_average_sample average_begin(int dimension)
{
    scree_average_sample s = {.dimension = dimension, .thickness = dimension == 2 ? 0.25 : 1};
    assert_int_equal(scree_allocate(&s.grain, ROOM, sizeof *s.grain, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s.contact, ROOM, sizeof *s.contact, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s.corner, ROOM, sizeof *s.corner, NULL), SCREE_OK);
    return s;
}

/// A disc or sphere of density 1000 kg/m3.
static inline uint32_t average_add(scree_average_sample *s, double x, double y, double z, double radius)
{
    const double volume = M_PI * radius * radius * (s->dimension == 2 ? 1 : 4.0 / 3 * radius);
    assert_true(s->bodies < ROOM);
    s->grain[s->bodies] = (scree_average_grain){.position = {x, y, z},
                                                .radius = radius,
                                                .volume = volume,
                                                .mass = 1000 * volume * s->thickness,
                                                .id = (uint32_t)s->bodies,
                                                .counted = true};
    return (uint32_t)s->bodies++;
}

/// A contact of two grains whose point lies on the line of their centres at the surface of the first, with a force on
/// it.
static inline void average_touch(scree_average_sample *s, uint32_t first, uint32_t second, const double force[3])
{
    assert_true(s->contacts < ROOM);
    scree_average_contact *c = &s->contact[s->contacts++];
    *c = (scree_average_contact){.first = first, .second = second};
    scree_subtract(s->grain[first].position, s->grain[second].position, c->branch);
    memcpy(c->normal, c->branch, sizeof c->normal);
    (void)scree_normalise(c->normal);
    scree_along(s->grain[first].position, -s->grain[first].radius, c->normal, c->point);
    memcpy(c->force, force, sizeof c->force);
    c->normal_force = scree_dot(force, c->normal);
    double along[3];
    scree_along(force, -c->normal_force, c->normal, along);
    c->tangential_force = scree_length(along);
}

/// One with what is no body, at a point.
static inline void average_stand(scree_average_sample *s, uint32_t first, const double point[3], const double force[3])
{
    assert_true(s->contacts < ROOM);
    scree_average_contact *c = &s->contact[s->contacts++];
    *c = (scree_average_contact){.first = first, .second = SCREE_AVERAGE_OUTSIDE};
    scree_subtract(s->grain[first].position, point, c->branch);
    memcpy(c->normal, c->branch, sizeof c->normal);
    (void)scree_normalise(c->normal);
    memcpy(c->point, point, sizeof c->point);
    memcpy(c->force, force, sizeof c->force);
    c->normal_force = scree_dot(force, c->normal);
}

static inline void average_finish(scree_average_sample *s)
{
    scree_error error;
    check(scree_average_sample_finish(s, &error), &error);
}

/// Columns and rows of touching discs with centres at (k + 1/2) 2 r, the same normal force between all neighbours in x
/// and another in y, and all around from outside: sigma_xx = -fx / (2 r thickness), everywhere.
static inline scree_average_sample average_lattice(size_t n, double r, double fx, double fy)
{
    scree_average_sample s = average_begin(2);
    for (size_t k = 0; k < n * n; k++)
        (void)average_add(&s, (2 * (double)(k % n) + 1) * r, (2 * (double)(k / n) + 1) * r, 0, r);
    const double right[3] = {fx, 0, 0}, left[3] = {-fx, 0, 0}, up[3] = {0, fy, 0}, down[3] = {0, -fy, 0};
    for (uint32_t k = 0; k < n * n; k++) {
        const double *x = s.grain[k].position;
        if (k % n > 0)
            average_touch(&s, k, k - 1, right);
        else
            average_stand(&s, k, (double[3]){x[0] - r, x[1], 0}, right);
        if (k % n == n - 1) average_stand(&s, k, (double[3]){x[0] + r, x[1], 0}, left);
        if (k / n > 0)
            average_touch(&s, k, k - (uint32_t)n, up);
        else
            average_stand(&s, k, (double[3]){x[0], x[1] - r, 0}, up);
        if (k / n == n - 1) average_stand(&s, k, (double[3]){x[0], x[1] + r, 0}, down);
    }
    return s;
}

/// Grains at random places with random forces between those that are near, and of the outside on some.
static inline scree_average_sample average_cloud(int dimension, size_t count)
{
    scree_average_sample s = average_begin(dimension);
    uint64_t at = 0;
    for (size_t k = 0; k < count; k++) {
        double x[3];
        for (int i = 0; i < 3; i++) x[i] = i < dimension ? average_random(at++) : 0;
        (void)average_add(&s, x[0], x[1], x[2], 0.02 + 0.03 * average_random(at++));
    }
    for (uint32_t k = 0; k < count; k++) {
        double force[3] = {0};
        for (int i = 0; i < dimension; i++) force[i] = average_random(at++) - 0.5;
        if (k > 0) average_touch(&s, k, (uint32_t)(average_random(at++) * k), force);
        if (k % 5 == 0) {
            const double *x = s.grain[k].position;
            average_stand(&s, k, (double[3]){x[0] + 0.03, x[1] - 0.04, x[2]}, force);
        }
    }
    s.gravity[1] = -9.81;
    return s;
}

#endif
