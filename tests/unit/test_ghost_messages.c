/// Messages between bodies and their ghosts follow from declarations: what ghosts keep, follow in, and give back, of
/// the state's own fields and of those of a module that nobody has written a line for. The table of modules is one of
/// this test. Lists of ghosts are compared with all ghosts that there are within reach, found by brute force.
#include "periodic_fixture.h"
#include "test_module.h"

#include "comm/comm.h"
#include "integrate/forced_spin.h"
#include "search/ghosts.h"

typedef struct pulse {
    int64_t left, right;
    double quiet; ///< between what is added back: nothing ghosts touch
    int64_t turns;
} pulse;

/// The struct of the module of this test, in the slot of the forced spin.
typedef struct own {
    scree_forced_spin forced;
    float (*colour)[3]; ///< kept
    double *strain;     ///< follows
    double *alone;      ///< ghosts have none of it
    pulse *pulses;      ///< turns, left and right are added back
    double *late;       ///< follows, when there is an array
} own;

static const scree_field test_fields[] = {
    BODY_FIELD(colour, float[3], "colour", SCREE_FIELD_FLOAT, 3, .ghosts = SCREE_GHOSTS_KEEP),
    BODY_FIELD(strain, double, "strain", SCREE_FIELD_DOUBLE, 1, .ghosts = SCREE_GHOSTS_FOLLOW),
    BODY_FIELD(alone, double, "alone", SCREE_FIELD_DOUBLE, 1),
    BODY_FIELD(pulses, pulse, "pulse", SCREE_FIELD_INT64, 2, .ghosts = SCREE_GHOSTS_ADD_BACK),
    BODY_FIELD(pulses, pulse, "quiet", SCREE_FIELD_DOUBLE, 1, .offset = offsetof(pulse, quiet),
               .ghosts = SCREE_GHOSTS_FOLLOW),
    BODY_FIELD(pulses, pulse, "turns", SCREE_FIELD_INT64, 1, .offset = offsetof(pulse, turns),
               .ghosts = SCREE_GHOSTS_ADD_BACK),
    BODY_FIELD(late, double, "late", SCREE_FIELD_DOUBLE, 1, .ghosts = SCREE_GHOSTS_FOLLOW, .optional = true),
};

static const scree_module test_module = {
    .name = "test",
    .meaning = "fields that ghosts have",
    .state_size = sizeof(own),
    .fields = test_fields,
    .field_count = sizeof test_fields / sizeof *test_fields,
};

TEST_MODULES

static own *own_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_forced_spin];
}

enum { COUNT = 60 };

/// Bodies at random in a leaning cell that is sheared, each with values of its own.
static void create(periodic_sample *s, int dimension, uint64_t directions)
{
    const double lattice[9] = {14e-3, 3e-3, 0, 0, 13e-3, 0, 0, dimension == 3 ? 2e-3 : 0, dimension == 3 ? 12e-3 : 1};
    periodic_create(s, dimension, COUNT, lattice, HERTZ_MINDLIN);
    for (size_t k = 0; k < COUNT; k++) {
        double f[3], position[3], velocity[3];
        for (int i = 0; i < 3; i++) f[i] = i < dimension ? periodic_random(6 * k + (uint64_t)i) + 0.5 : 0;
        for (int i = 0; i < 3; i++) velocity[i] = i < dimension ? periodic_random(6 * k + 3 + (uint64_t)i) : 0;
        scree_matrix_apply(lattice, f, position);
        periodic_place(s, k, position, velocity, 1e-3 * (1 + 0.2 * periodic_random(6 * COUNT + k)));
        own_of(&s->state)->strain[k] = 0.5 + (double)k;
        own_of(&s->state)->colour[k][2] = (float)k;
        own_of(&s->state)->pulses[k].quiet = -1 - (double)k;
    }
    // Directions that do not repeat have their unit vector: brute force looks along no others.
    scree_cell(&s->state)->directions = directions;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            if (!(directions >> k & 1)) scree_cell(&s->state)->lattice[3 * i + k] = i == k;
    const double gradient[9] = {-2, 11, 0, 0, 3, 0, 0, dimension == 3 ? 5 : 0, 0};
    memcpy(scree_cell(&s->state)->gradient, gradient, sizeof gradient);
    s->state.step_size = 1e-4;
}

static void make(periodic_sample *s)
{
    scree_error error;
    check(scree_ghosts_make(&s->state, &s->work, &error), &error);
}

/// Some body is nearer to the ghost of `row` at this shift than both radii and the skin.
static bool is_needed(const periodic_sample *s, size_t row, const int32_t shift[3])
{
    const double n[3] = {shift[0], shift[1], shift[2]};
    double by[3], copy[3], other[3];
    scree_matrix_apply(scree_cell(&s->state)->lattice, n, by);
    scree_body_position(&s->state, row, copy);
    for (size_t k = 0; k < COUNT; k++) {
        double square = 0, reach = s->state.row[row].radius + s->state.row[k].radius + s->work.skin;
        scree_body_position(&s->state, k, other);
        for (int i = 0; i < 3; i++) square += (copy[i] + by[i] - other[i]) * (copy[i] + by[i] - other[i]);
        if (square < reach * reach) return true;
    }
    return false;
}

static bool is_listed(const periodic_sample *s, size_t row, const int32_t shift[3])
{
    for (size_t k = 0; k < s->work.ghosts.count; k++) {
        const scree_ghost *ghost = &s->work.ghosts.ghost[k];
        if (ghost->parent == row && memcmp(ghost->shift, shift, sizeof ghost->shift) == 0) return true;
    }
    return false;
}

/// The first component that is not zero is positive.
static bool is_positive(const int32_t shift[3])
{
    for (int k = 0; k < 3; k++)
        if (shift[k] != 0) return shift[k] > 0;
    return false;
}

static void all_that_are_needed_are_listed(int dimension, uint64_t directions)
{
    periodic_sample s;
    create(&s, dimension, directions);
    make(&s);
    size_t needed = 0;
    for (int32_t code = 0; code < 125; code++) {
        const int32_t shift[3] = {code % 5 - 2, code / 5 % 5 - 2, code / 25 - 2};
        bool repeats = is_positive(shift);
        for (int k = 0; k < 3; k++) repeats = repeats && (shift[k] == 0 || (directions >> k & 1));
        for (size_t row = 0; row < COUNT && repeats; row++) {
            if (!is_needed(&s, row, shift)) continue;
            needed++;
            assert_true(is_listed(&s, row, shift));
        }
    }
    assert_true(needed > 0);
    for (size_t k = 0; k < s.work.ghosts.count; k++)
        for (int i = 0; i < 3; i++) assert_true(s.work.ghosts.ghost[k].shift[i] == 0 || (directions >> i & 1));
    periodic_destroy(&s);
}

static void lists_hold_all_near_images(void **unused)
{
    (void)unused;
    for (uint64_t directions = 1; directions < 8; directions++) {
        if (directions < 4) all_that_are_needed_are_listed(2, directions);
        all_that_are_needed_are_listed(3, directions);
    }
}

/// Position and velocity of a ghost. The velocity of the lattice at the end of the step: the gradient on it in the
/// middle of the step, half a step earlier.
static void assert_moved(const periodic_sample *s, const scree_ghost *ghost, size_t row)
{
    const scree_periodic_cell *cell = scree_cell(&s->state);
    double plus[9], back[9], middle[9], speed[9], by[3], faster[3], body[3], copy[3], v[3], w[3], spin[3];
    const double n[3] = {ghost->shift[0], ghost->shift[1], ghost->shift[2]};
    scree_matrix_unit_plus(0.5 * s->state.step_size, cell->gradient, plus);
    scree_matrix_invert(plus, back);
    scree_matrix_multiply(back, cell->lattice, middle);
    scree_matrix_multiply(cell->gradient, middle, speed);
    scree_matrix_apply(cell->lattice, n, by);
    scree_matrix_apply(speed, n, faster);
    scree_body_position(&s->state, ghost->parent, body);
    scree_body_position(&s->state, row, copy);
    scree_body_motion(&s->state, ghost->parent, v, spin);
    scree_body_motion(&s->state, row, w, spin);
    // The same operations on the same numbers: equal to the last bit.
    for (int i = 0; i < s->state.dimension; i++) {
        assert_true(copy[i] == body[i] + by[i]);
        assert_true(w[i] == v[i] + faster[i]);
    }
}

static void ghosts_hold_what_is_declared(int dimension)
{
    periodic_sample s;
    create(&s, dimension, dimension == 2 ? 3 : 7);
    make(&s);
    scree_state *state = &s.state;
    assert_true(s.work.ghosts.count > 20);
    // A step later: the strain and the colour of all bodies have changed, an optional array has come.
    scree_error error;
    check(scree_state_begin_field(state, &test_fields[6], &error), &error);
    for (size_t k = 0; k < COUNT; k++) {
        own_of(state)->strain[k] *= -3;
        own_of(state)->colour[k][2] = 1000;
        own_of(state)->late[k] = 7 * (double)k;
        state->row[k].x += 1e-5 * (double)k;
        state->row[k].vy -= 2;
        if (dimension == 3) state->turn[k].wy = (double)k;
    }
    for (size_t k = COUNT; k < COUNT + s.work.ghosts.count; k++) own_of(state)->pulses[k].left = (int64_t)k;
    assert_int_equal(scree_comm_exchange(state, &s.work, &error), SCREE_OK);
    for (size_t k = 0; k < s.work.ghosts.count; k++) {
        const scree_ghost *ghost = &s.work.ghosts.ghost[k];
        size_t row = COUNT + k, parent = ghost->parent;
        assert_moved(&s, ghost, row);
        assert_true(state->id[row] == state->id[parent] && state->mark[row] == state->mark[parent]);
        assert_true(state->row[row].radius == state->row[parent].radius);
        assert_true(state->row[row].mass == state->row[parent].mass);
        assert_true(scree_body_material(state, row) == scree_body_material(state, parent));
        assert_true(dimension == 2 || state->turn[row].wy == (double)parent);
        assert_true(own_of(state)->strain[row] == own_of(state)->strain[parent]);
        assert_true(own_of(state)->colour[row][2] == (float)parent); // kept
        assert_true(own_of(state)->late[row] == 7 * (double)parent);
        assert_true(own_of(state)->pulses[row].quiet == -1 - (double)parent);
        assert_int_equal(own_of(state)->pulses[row].left, row); // what is given back is not overwritten
    }
    periodic_destroy(&s);
}

static void what_is_declared_is_sent(void **unused)
{
    (void)unused;
    ghosts_hold_what_is_declared(2);
    ghosts_hold_what_is_declared(3);
}

/// Two fields of one array, and the force sums, whatever stands between them.
static void what_is_collected_comes_back(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        periodic_sample s;
        create(&s, dimension, dimension == 2 ? 3 : 7);
        make(&s);
        scree_state *state = &s.state;
        pulse *pulses = own_of(state)->pulses, wanted[COUNT] = {{0}};
        int64_t force[COUNT] = {0};
        for (size_t k = 0; k < COUNT; k++) {
            force[k] = state->sum[k].fy = INT64_MAX - 5; // sums go round without harm
            wanted[k].turns = pulses[k].turns = (int64_t)k;
        }
        for (size_t k = 0; k < s.work.ghosts.count; k++) {
            size_t row = COUNT + k, parent = s.work.ghosts.ghost[k].parent;
            state->sum[row] = (scree_sum_row){.fx = 1, .fy = (int64_t)k, .contacts = 2};
            pulses[row].right = (int64_t)(3 * k);
            pulses[row].turns = -(int64_t)k;
            force[parent] = (int64_t)((uint64_t)force[parent] + k);
            wanted[parent].left++; // as many as it has ghosts
            wanted[parent].right += (int64_t)(3 * k);
            wanted[parent].turns -= (int64_t)k;
        }
        scree_comm_add_back(state, &s.work);
        for (size_t k = 0; k < COUNT; k++) {
            assert_int_equal(state->sum[k].fx, wanted[k].left);
            assert_int_equal(state->sum[k].contacts, 2 * wanted[k].left);
            assert_int_equal(state->sum[k].fy, force[k]);
            assert_int_equal(pulses[k].right, wanted[k].right);
            assert_int_equal(pulses[k].turns, wanted[k].turns);
            assert_true(pulses[k].quiet == -1 - (double)k);
        }
        for (size_t row = COUNT; row < COUNT + s.work.ghosts.count; row++) {
            assert_true(state->sum[row].fx == 0 && state->sum[row].fy == 0 && state->sum[row].contacts == 0);
            assert_true(pulses[row].right == 0 && pulses[row].turns == 0 && pulses[row].quiet != 0);
        }
        periodic_destroy(&s);
    }
}

/// A message says no more than the fields need: in 2D position, velocity and spin (40 bytes), in 3D 72, and in this
/// test the strain and `quiet`; back come forces, torques, the number of contacts, and three numbers of the test.
static void messages_are_short(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        periodic_sample s;
        create(&s, dimension, 3);
        assert_int_equal(scree_message_bytes(&s.state, SCREE_MESSAGE_STEP), (dimension == 2 ? 40 : 72) + 16);
        assert_int_equal(scree_message_bytes(&s.state, SCREE_MESSAGE_BACK), (dimension == 2 ? 32 : 56) + 24);
        periodic_destroy(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_hold_all_near_images),
        cmocka_unit_test(what_is_declared_is_sent),
        cmocka_unit_test(what_is_collected_comes_back),
        cmocka_unit_test(messages_are_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
