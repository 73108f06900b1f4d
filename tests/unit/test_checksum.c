/// The state checksum against its definition in docs/architecture.md: numbers worked out by another program from the
/// text alone; what belongs to the physics shows, and what is bookkeeping does not.
#include "law_choice.h"
#include "measure/delaunay_boundary.h"
#include "measure/imposed_gradient.h"
#include "state/case_walls.h"
#include "state/periodic.h"
#include "state/plates.h"
#include "testing.h"

#include "base/checksum.h"
#include "run/loading.h"
#include "state/state.h"

#include <string.h>

typedef struct sample {
    scree_config_wall wall;
    scree_model model;
    scree_state state;
} sample;

/// Three bodies with numbers of their own in everything.
static void create(sample *s, int dimension)
{
    memset(s, 0, sizeof *s);
    s->model.walls_of_case = &s->wall;
    s->model.dimension = dimension;
    s->model.laws[0].law = SCREE_SLOT_hertz_mindlin;
    s->model.material_count = 2;
    for (int m = 0; m < 2; m++) {
        s->model.density[m] = 2000 + 500 * m;
        s->model.pairs[m][m] = hertz_pair(1e9 + m, 2e9, 0.25 + 0.25 * m, 0.125);
        s->model.pairs[m][m].value[HERTZ_ROLLING] = 0.0625;
    }
    assert_int_equal(scree_state_create(&s->state, dimension, 3, NULL), SCREE_OK);
    scree_state *state = &s->state;
    state->step = 1234;
    state->tick = 0.5;
    state->force_quantum = 0.25;
    state->torque_quantum = 0.125;
    for (int k = 0; k < 3; k++) {
        double n = k + 1;
        state->row[k] = (scree_row){.x = n, .y = -n, .radius = 0.5 * n, .vx = 0.1 * n, .vy = 0.2 * n, .mass = 3 * n};
        state->sum[k] = (scree_sum_row){.fx = 10 * k, .fy = -k, .contacts = 1};
        if (dimension == 2) {
            state->row[k].material = k == 2;
            state->row[k].spin = 7 * n;
            state->sum[k].torque = 100 * k;
        } else {
            state->row[k].z = 4 * n;
            state->row[k].vz = 0.3 * n;
            state->sum[k].fz = 5 * k;
            state->turn[k] = (scree_turn_row){.wx = n, .wy = 2 * n, .wz = 3 * n, .material = k == 2};
            state->torque[k] = (scree_torque_row){.x = k, .y = 2 * k, .z = 3 * k};
        }
    }
    assert_int_equal(scree_state_reserve_contacts(state, 4, NULL), SCREE_OK);
    assert_int_equal(scree_state_add_rolling(state, NULL), SCREE_OK);
    state->law[SCREE_LIST_CONTACTS] = (scree_remembered_law){&scree_module_hertz_mindlin, 2}; // with rolling
    state->contact[0] = (scree_contact_memory){0, 1, {{0.5, 0.25, 0.125, 9}}};
    state->contact[1] = (scree_contact_memory){0, 2, {{0, 0, 0, 8}}};
    state->contact[2] = (scree_contact_memory){1, SCREE_PRIMITIVE_ID + 3, {{-1, -2, -3, 7}}};
    state->contact[3] = (scree_contact_memory){1, SCREE_WALL_ID + 1, {{4, 5, 6, 6}}};
    for (int k = 0; k < 4; k++)
        state->rolling[k] = (scree_rolling){.value = {k == 1 ? 0 : k + 1.5, 0, -k, 2.0 * k}, .last = {3}};
    if (dimension == 2) state->rolling[1].value[1] = 77; // its force, not its displacement
    if (dimension == 3) memset(&state->rolling[1], 0, sizeof state->rolling[1]);
    state->contact_count = 4;
    scree_plates(state)[SCREE_WALL_TOP] = (scree_wall){
        .position = -9, .normal = {0, -1, 0}, .velocity = 0.75, .tangential_velocity = {1, 2, 3}, .active = 1};
    scree_plates(state)[SCREE_WALL_LEFT] = (scree_wall){.position = 5, .velocity = 6};
    for (int k = 0; k < 9; k++) scree_strain_of(state)->gradient[k] = 0.001 * k;
    state->ledger = (scree_ledger){1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 13};
}

/// With a cell and a moving wall of the case.
static void create_full(sample *s, int dimension)
{
    create(s, dimension);
    s->model.wall_count = 1;
    s->wall = (scree_config_wall){
        .velocity = {{.value = 1}, {.value = 2}, {.value = 3}}, .spin = {0, 4, 0}, .centre = {0.5, 0.25, 0}};
    scree_case_walls(&s->state)->ticks = 6;
    scree_case_walls(&s->state)->moving = 1;
    scree_cell(&s->state)->directions = 1;
    for (int k = 0; k < 9; k++) {
        scree_cell(&s->state)->lattice[k] = k + 1;
        scree_cell(&s->state)->gradient[k] = 0.25 * k;
        scree_cell(&s->state)->strain[k] = 0.5 * k;
    }
}

static uint64_t checksum_of(const sample *s)
{
    return scree_state_checksum(&s->model, &s->state);
}

/// The numbers are from tests/tools/state_checksum.py.
static void the_definition_holds(void **unused)
{
    (void)unused;
    static const uint64_t expected[2][2] = {{UINT64_C(0x7f18b7658673b2dc), UINT64_C(0x92d80f6a08cd4700)},
                                            {UINT64_C(0xdf671b587d42fed5), UINT64_C(0x393a792793909168)}};
    for (int full = 0; full < 2; full++)
        for (int dimension = 2; dimension <= 3; dimension++) {
            sample s;
            (full ? create_full : create)(&s, dimension);
            assert_true(checksum_of(&s) == expected[full][dimension - 2]);
            scree_state_destroy(&s.state);
        }
}

/// What a program did from outside is the last word, where it did something.
static void work_from_outside_is_a_word(void **unused)
{
    (void)unused;
    sample s;
    create(&s, 2);
    uint64_t before = checksum_of(&s);
    s.state.ledger.outside = -0.0;
    assert_true(checksum_of(&s) == before);
    s.state.ledger.outside = 13;
    assert_true(checksum_of(&s) == scree_checksum_number(before, 13));
    scree_state_destroy(&s.state);
}

/// With a body taken out the ids of the others enter, the number of ids, and the energy that left.
static void holes_show(void **unused)
{
    (void)unused;
    static const uint64_t expected[2] = {UINT64_C(0x3a77cf4429fb0944), UINT64_C(0xceb00cfca87f29ea)};
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample s;
        create(&s, dimension);
        assert_int_equal(scree_state_remove(&s.state, (const uint32_t[]){1}, 1, NULL), SCREE_OK);
        assert_true(checksum_of(&s) == expected[dimension - 2]);
        scree_state_destroy(&s.state);
    }
}

/// Bookkeeping of stages, samples, boundaries and quanta, materials that nothing is made of, signs of zeros.
static void bookkeeping_does_not_show(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample s;
        create(&s, dimension);
        uint64_t before = checksum_of(&s);
        scree_state *state = &s.state;
        state->stage = (scree_stage_state){.index = 3, .samples = 4, .snapshots = 5, .counter = 6};
        scree_loading_of(state)->height = 7;
        state->sampled_step = state->evaluations = 77;
        state->sampled_velocity[1][0] = state->reference[2][1] = 3;
        scree_loop_of(state)->updated = scree_hull_of(state)->updated = 9;
        state->largest_overlap = state->largest_speed = scree_imposed(state)->achieved = 4;
        scree_plates(state)[SCREE_WALL_LEFT].position = 8; // stands no more
        scree_plates(state)[SCREE_WALL_TOP].force = 1;
        state->last_force = NULL;
        state->contact[1].history.value[3] = 55; // what is kept for the ledger alone
        // The same forces in quanta half as large.
        state->force_quantum /= 2;
        for (int k = 0; k < 3; k++) {
            state->sum[k].fx *= 2;
            state->sum[k].fy *= 2;
            if (dimension == 3) state->sum[k].fz *= 2;
        }
        // A material before the others.
        for (int m = 2; m > 0; m--) {
            s.model.pairs[m][m] = s.model.pairs[m - 1][m - 1];
            s.model.density[m] = s.model.density[m - 1];
        }
        s.model.density[0] = 1;
        for (int k = 0; k < 3; k++) *(dimension == 3 ? &state->turn[k].material : &state->row[k].material) += 1;
        scree_strain_of(state)->gradient[0] = -0.0;
        assert_true(checksum_of(&s) == before);
        scree_state_destroy(&state[0]);
    }
}

/// Bodies in other rows.
static void rows_do_not_show(void **unused)
{
    (void)unused;
    static const uint32_t order[] = {2, 0, 1};
    sample s;
    create_full(&s, 3);
    uint64_t before = checksum_of(&s);
    assert_int_equal(scree_state_permute(&s.state, order, NULL), SCREE_OK);
    assert_true(checksum_of(&s) == before);
    scree_state_destroy(&s.state);
}

/// Each number of the physics shows.
static void physics_shows(void **unused)
{
    (void)unused;
    sample s;
    create_full(&s, 3);
    scree_state *state = &s.state;
    double *const numbers[] = {
        &state->tick,
        &state->row[1].x,
        &state->row[1].z,
        &state->row[1].vy,
        &state->turn[1].wx,
        &state->row[1].radius,
        &state->row[1].mass,
        &s.model.density[1],
        &s.model.pairs[0][0].value[SCREE_FRICTION],
        &state->contact[0].history.value[2],
        &state->rolling[2].value[3],
        &scree_plates(state)[SCREE_WALL_TOP].position,
        &scree_plates(state)[SCREE_WALL_TOP].velocity,
        &scree_plates(state)[SCREE_WALL_TOP].tangential_velocity[2],
        &s.wall.velocity[1].value,
        &s.wall.spin[1],
        &scree_cell(state)->lattice[8],
        &scree_cell(state)->gradient[8],
        &scree_cell(state)->strain[8],
        &scree_strain_of(state)->gradient[4],
        &state->ledger.damping,
        &state->ledger.turnover,
    };
    uint64_t before = checksum_of(&s);
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        double kept = *numbers[k];
        *numbers[k] = kept + 1;
        assert_true(checksum_of(&s) != before);
        *numbers[k] = kept;
    }
    state->step++;
    assert_true(checksum_of(&s) != before);
    state->step--;
    state->sum[2].fz++;
    assert_true(checksum_of(&s) != before);
    state->sum[2].fz--;
    state->torque[2].y++;
    assert_true(checksum_of(&s) != before);
    state->torque[2].y--;
    state->contact[2].second++;
    assert_true(checksum_of(&s) != before);
    state->contact[2].second--;
    scree_case_walls(state)->moving = 0;
    assert_true(checksum_of(&s) != before);
    scree_state_destroy(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_definition_holds), cmocka_unit_test(work_from_outside_is_a_word),
        cmocka_unit_test(holes_show),           cmocka_unit_test(bookkeeping_does_not_show),
        cmocka_unit_test(rows_do_not_show),     cmocka_unit_test(physics_shows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
