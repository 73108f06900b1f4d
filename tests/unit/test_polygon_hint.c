/// Hints of pairs of outlines: what they say holds in every pose that they are kept for, whatever the pair, and not far
/// beyond; the room is no more than what is between the bodies.
#include "polygon_pairs.h"
#include "shape/polygon_hint.h"
#include "testing.h"

/// A pair in a pose: its sample with both bodies turned and the second shifted.
typedef struct posed_pair {
    pair_sample sample;
    scree_polygon_pose pose;
} posed_pair;

/// turned: rad, of both bodies.
static void pose_pair(const pair_sample *s, const double shift[2], const double turned[2], posed_pair *p)
{
    p->sample = *s;
    for (int b = 0; b < 2; b++) {
        scree_polygon_turn(s->polygon[b].count, (const double(*)[2])s->corner[b], cos(turned[b]), sin(turned[b]),
                           p->sample.corner[b]);
        p->sample.polygon[b].corner = (const double(*)[2])p->sample.corner[b];
        p->sample.polygon[b].bound = s->polygon[b].bound * (1 + 0x1p-40);
        p->sample.apart[b] = s->apart[b] + shift[b];
    }
    p->pose = (scree_polygon_pose){.polygon = {&p->sample.polygon[0], &p->sample.polygon[1]},
                                   .apart = {p->sample.apart[0], p->sample.apart[1]},
                                   .angle = {turned[0], turned[1]}};
}

static bool overlaps(const posed_pair *p, scree_overlap *overlap)
{
    int none = 0;
    return scree_polygon_pair_overlap(p->pose.polygon[0], p->pose.polygon[1], p->pose.apart, &none, overlap);
}

/// Whether the pose is as the hint says.
static bool holds(const posed_pair *p, const scree_pair_hint *hint)
{
    scree_overlap overlap;
    const bool met = overlaps(p, &overlap);
    if (hint->room < 0) return !met;
    if (!met || overlap.crossings != 2) return false;
    scree_pair_hint now = {.room = 0};
    (void)scree_pair_hint_renew(&p->pose, &now);
    return !(now.room > 0) || memcmp(now.edge, hint->edge, sizeof now.edge) == 0;
}

/// A pose that differs by `share` of the room, in a way of its own.
static void move(pair_random *r, const pair_sample *s, const scree_pair_hint *hint, double share, posed_pair *to)
{
    const double lever = scree_polygon_lever(s->polygon[0].bound, s->polygon[1].bound) * (1 + 0x1p-40);
    double weight[4], sum = 0;
    for (int k = 0; k < 4; k++) {
        const double drawn = draw(r, -1, 1);
        weight[k] = drawn * drawn * drawn; // often along one of them
        sum += fabs(weight[k]);
    }
    const double size = share * fabs((double)hint->room) / sum;
    double shift[2], turned[2];
    for (int k = 0; k < 2; k++) {
        shift[k] = (double)hint->pose[k] + size * weight[k] - s->apart[k];
        turned[k] = (double)hint->pose[2 + k] + size * weight[2 + k] / lever;
    }
    pose_pair(s, shift, turned, to);
}

typedef struct tally {
    int twice, apart, few, far[2];
} tally;

static void try_pair(uint64_t id, tally *t)
{
    static const double still[2] = {0, 0};
    pair_random r = {.id = id, .used = 100};
    pair_sample s;
    posed_pair from, to;
    scree_pair_hint hint = {.room = 0};
    pair_make(id, &s);
    pose_pair(&s, still, still, &from);
    const bool found = scree_pair_hint_renew(&from.pose, &hint);
    t->few += hint.room < 0 || hint.room > 0 ? 0 : 1;
    if (found && hint.room < 0) fail_msg("pair %d (%s): %g", (int)id, pair_names[s.kind], (double)hint.room);
    if (!(hint.room < 0) && !(hint.room > 0)) return;
    *(hint.room > 0 ? &t->twice : &t->apart) += 1;
    for (int k = 0; k < 20; k++) {
        move(&r, &s, &hint, k % 2 ? 0.999 : draw(&r, 0, 1), &to);
        if (!holds(&to, &hint)) fail_msg("pair %d (%s), room %g", (int)id, pair_names[s.kind], (double)hint.room);
        move(&r, &s, &hint, 8, &to);
        t->far[hint.room < 0] += !holds(&to, &hint);
    }
}

static void test_room(void **state)
{
    (void)state;
    tally t = {0};
    for (uint64_t id = 0; id < 30000; id++) try_pair(id, &t);
    print_message("cross twice %d, apart %d, nothing known %d; eight times as far it holds no more: %d, %d\n", t.twice,
                  t.apart, t.few, t.far[0], t.far[1]);
    assert_true(t.twice > 5000 && t.apart > 1000 && t.few > 1000);
    assert_true(t.far[0] > 2 * t.twice && t.far[1] > t.apart / 2); // rooms are not so small that nothing could fail
}

/// Two squares of side 2, the second beside the first: rooms that can be read off.
static void test_squares(void **state)
{
    (void)state;
    const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    scree_polygon square = {.corner = corner, .count = 4, .radius = 2 / sqrt(M_PI), .bound = sqrt(2)};
    scree_polygon_pose pose = {.polygon = {&square, &square}, .apart = {2.25, 0.5}};
    scree_pair_hint hint = {.room = 0};
    // Without an edge in mind: less than the gap, or one is found.
    assert_false(scree_pair_hint_renew(&pose, &hint));
    assert_true(hint.room <= 0 && hint.room >= -0.25F);
    hint = (scree_pair_hint){.edge = {2}};
    assert_false(scree_pair_hint_renew(&pose, &hint));
    assert_true(fabs((double)hint.room + 0.25) < 1e-5);
    assert_int_equal(hint.edge[0], 2);
    // Out of reach of each other.
    pose.apart[0] = 4;
    assert_false(scree_pair_hint_renew(&pose, &hint));
    assert_true(fabs((double)hint.room + (hypot(4, 0.5) - 2 * sqrt(2))) < 1e-5);
    // Corner in corner, 0.25 by 0.5: the nearest line is 0.25 from a corner.
    pose.apart[0] = 1.75;
    pose.apart[1] = 1.5;
    assert_true(scree_pair_hint_renew(&pose, &hint));
    assert_true(fabs((double)hint.room - 0.25) < 1e-5);
    const int8_t expected[4] = {1, 0, 2, 3}; // its right side goes in over the bottom, its top out over the left side
    assert_memory_equal(hint.edge, expected, 4);
    // An image's angle is not known: the pose alone.
    pose.fixed = true;
    assert_true(scree_pair_hint_renew(&pose, &hint));
    assert_true(hint.room > 0 && hint.room < 1e-30F);
}

/// What a hint does not tell: discs, one body within the other, one place, what is not a number, four crossings.
static void test_nothing_known(void **state)
{
    (void)state;
    const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
                 flat[4][2] = {{-2, -0.1}, {2, -0.1}, {2, 0.1}, {-2, 0.1}};
    scree_polygon square = {.corner = corner, .count = 4, .bound = sqrt(2)}, disc = {.radius = 1, .bound = 1};
    scree_polygon bar = {.corner = flat, .count = 4, .bound = hypot(2, 0.1)};
    const scree_polygon_pose poses[] = {{.polygon = {&square, &disc}, .apart = {1.5, 0}},
                                        {.polygon = {&square, &square}},
                                        {.polygon = {&square, &square}, .apart = {NAN, 0}},
                                        {.polygon = {&square, &bar}, .apart = {0.1, 0.2}}};
    for (size_t k = 0; k < sizeof poses / sizeof *poses; k++) {
        scree_pair_hint hint = {.room = 1, .edge = {1, 2, 3, 0}};
        if (!scree_pair_hint_renew(&poses[k], &hint) || hint.room < 0 || hint.room > 0 || hint.edge[0] != 0)
            fail_msg("pose %zu: room %g", k, (double)hint.room);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_room), cmocka_unit_test(test_squares),
                                       cmocka_unit_test(test_nothing_known)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
