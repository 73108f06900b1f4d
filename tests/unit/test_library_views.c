/// What a program sees of a simulation: time and stages, views that are the fields themselves, contacts and measures
/// that are those of the files, drafts of cases.
#include "library_fixture.h"

#include "base/memory.h"
#include "state/store.h"

#include "measure/measure.h"
#include "state/plates.h"

static void time_goes_by_steps_and_stages(void **unused)
{
    (void)unused;
    scree_case *c = case_read(SIMULATION_SMALL, NULL, 0);
    scree_simulation *s = library_create(c);
    const char *name;
    assert_int_equal(scree_simulation_bodies(s), 0);
    assert_true(scree_simulation_stage(s, &name) == 0);
    assert_string_equal(name, "prepare");
    assert_false(library_advance_stage(s));
    assert_int_equal(scree_simulation_bodies(s), 70);
    assert_true(scree_simulation_steps(s) == 0 && scree_simulation_stage(s, NULL) == 0);
    assert_false(library_advance(s, 10));
    assert_true(scree_simulation_steps(s) == 10 && scree_simulation_stage(s, &name) == 1);
    assert_string_equal(name, "confine");
    assert_true(fabs(scree_simulation_time(s) - 10 * scree_simulation_step_size(s)) < 1e-15);
    assert_true(isnan(scree_simulation_loading_strain(s)));
    assert_false(library_advance_stage(s));
    assert_true(scree_simulation_stage(s, &name) == 1);
    assert_true(library_advance_stage(s));
    assert_true(scree_simulation_stage(s, &name) == 2);
    assert_string_equal(name, "compress");
    // 0.5 % and at most one sample of twenty more.
    assert_true(scree_simulation_loading_strain(s) > 0.00499 && scree_simulation_loading_strain(s) < 0.00526);
    uint64_t steps = scree_simulation_steps(s);
    assert_true(library_advance_stage(s) && library_advance(s, 1));
    assert_true(scree_simulation_steps(s) == steps && scree_simulation_stage(s, &name) == 3 && !name);
    scree_simulation_free(s);
    scree_case_free(c);
}

/// Every field: the address, the number and the unit of the declaration; nothing is copied.
static void views_are_the_fields(const char *text)
{
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation *s = library_create(c);
    library_advance(s, 400);
    size_t seen = 0, filled = 0;
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        if (!scree_field_is_here(&s->state, field)) continue;
        assert_string_equal(scree_simulation_view_name(s, seen++), field->name);
        scree_view view = library_view(s, field->name);
        assert_true(view.count == scree_field_rows_count(&s->state, field));
        assert_true(view.type == field->type && view.unit == field->unit && view.meaning == field->meaning);
        assert_int_equal(view.components, scree_components(field->components, s->model.dimension));
        for (size_t row = 0; row < view.count; row++)
            assert_ptr_equal((const char *)view.data + row * view.stride, scree_field_get(&s->state, field, row));
        filled += view.count > 0;
    }
    assert_null(scree_simulation_view_name(s, seen));
    assert_true(filled > 60);
    scree_simulation_free(s);
    scree_case_free(c);
}

static void views_are_the_fields_in_2d(void **unused)
{
    (void)unused;
    views_are_the_fields(SIMULATION_SMALL);
}

static void views_are_the_fields_in_3d(void **unused)
{
    (void)unused;
    views_are_the_fields(LIBRARY_PAIR_3D);
}

static void known_views_hold_what_they_say(void **unused)
{
    (void)unused;
    scree_case *c = case_read(SIMULATION_SMALL, NULL, 0);
    scree_simulation *s = library_create(c);
    assert_true(library_view(s, "position").count == 0 && !library_view(s, "position").data);
    assert_true(library_view(s, "contacts/first").count == 0);
    library_advance(s, 400);
    scree_view position = library_view(s, "position"), radius = library_view(s, "radius");
    assert_ptr_equal(position.data, &s->state.row[0].x);
    assert_ptr_equal(radius.data, &s->state.row[0].radius);
    assert_true(position.stride == sizeof(scree_row) && position.components == 2 && position.count == 70);
    assert_ptr_equal(library_view(s, "walls/position").data, &scree_plates(&s->state)[0].position);
    assert_ptr_equal(library_view(s, "periodic/lattice").data, scree_cell(&s->state)->lattice);
    assert_int_equal(library_view(s, "membrane/rest").count, 0);
    assert_true(library_view(s, "contacts/first").count > 50);
    // velocity_verlet keeps velocities of the present time.
    assert_true(library_view(s, "scheme_velocity").time == scree_simulation_time(s));
    scree_simulation_free(s);
    scree_case_free(c);
    const char *const leapfrog[] = {"integrator.scheme=position_verlet"};
    c = case_read(SIMULATION_SMALL, leapfrog, 1);
    s = library_create(c);
    library_advance(s, 400);
    double lag = scree_simulation_time(s) - library_view(s, "scheme_velocity").time;
    assert_true(fabs(lag - 1e-5) < 1e-12 && library_view(s, "position").time == scree_simulation_time(s));
    scree_simulation_free(s);
    scree_case_free(c);
}

static void expect_no_view(scree_simulation *s, const char *name, const char *nearest)
{
    scree_error error;
    scree_view view;
    assert_int_equal(scree_simulation_view(s, name, &view, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.accepted, nearest);
    assert_non_null(strstr(error.message, name));
    assert_null(view.data);
}

static void names_that_are_none_are_refused(void **unused)
{
    (void)unused;
    scree_error error;
    double value;
    scree_case *c = case_read(SIMULATION_SMALL, NULL, 0);
    scree_simulation *s = library_create(c);
    expect_no_view(s, "postion", "position");
    expect_no_view(s, "velocity", "scheme_velocity");
    expect_no_view(s, "membrane/rset", "membrane/rest");
    expect_no_view(s, "gfrqwe", "");
    assert_int_equal(scree_simulation_sample(s, "time", &value, &error), SCREE_ERROR_INPUT);
    library_advance(s, 2000);
    check(scree_simulation_sample(s, "coordination", &value, &error), &error);
    assert_true(value == s->sample[SCREE_SAMPLE_COORDINATION] && value > 1);
    assert_int_equal(scree_simulation_sample(s, "cordination", &value, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.accepted, "coordination");
    scree_simulation_free(s);
    scree_case_free(c);
}

static void copies_are_by_id(void **unused)
{
    (void)unused;
    enum { COUNT = 70 };
    double position[COUNT][2], velocity[COUNT][2], spin[COUNT];
    const char *const leapfrog[] = {"integrator.scheme=position_verlet"};
    scree_case *c = case_read(SIMULATION_SMALL, leapfrog, 1);
    scree_simulation *s = library_create(c);
    library_advance(s, 400);
    scree_simulation_copy(s, position[0], velocity[0], spin);
    for (size_t id = 0; id < COUNT; id++) {
        scree_vector speed, turn;
        size_t row = s->state.row_of_id[id];
        scree_body_velocity(&s->stage_model, &s->state, row, speed, turn);
        assert_true(position[id][0] == s->state.row[row].x && position[id][1] == s->state.row[row].y);
        assert_true(velocity[id][0] == speed[0] && velocity[id][1] == speed[1] && spin[id] == turn[2]);
        // Half a step of acceleration lies between.
        assert_true(speed[1] != s->state.row[row].vy || s->state.sum[row].fy == 0);
    }
    scree_simulation_free(s);
    scree_case_free(c);
}

/// The forces of the contacts of a body add up to the force on it, and the measures are those of the sample.
static void contacts_and_measures_agree(void **unused)
{
    (void)unused;
    const scree_contact_point *contact;
    size_t count;
    scree_error error;
    scree_structure structure;
    double sum = 0, scale = 0, stress[9], trace = 0, boundary[9];
    scree_case *c = case_read(SIMULATION_SMALL, NULL, 0);
    scree_simulation *s = library_create(c);
    assert_int_equal(scree_simulation_contacts(s, &contact, &count, &error), SCREE_ERROR_INPUT);
    while (!s->stage || !s->stage->loading) library_advance(s, 1);
    while (!s->sampled) library_advance(s, 1);
    check(scree_simulation_contacts(s, &contact, &count, &error), &error);
    check(scree_simulation_structure(s, &structure, &error), &error);
    check(scree_simulation_stress(s, stress, &error), &error);
    check(scree_simulation_boundary_stress(s, boundary, &error), &error);
    assert_true(count == structure.contacts && count == s->table.count && count > 100);
    // A body inside, with no force of the pressure: the mean over bodies that touch no plate and are not on the loop.
    uint32_t id = contact[count / 2].first;
    for (size_t k = 0; k < count; k++) {
        bool body = contact[k].partner == SCREE_PARTNER_BODY;
        assert_true(body ? contact[k].second > contact[k].first : contact[k].second < SCREE_WALL_COUNT);
        double along = scree_dot(contact[k].force, contact[k].normal);
        assert_true(fabs(along - contact[k].normal_force) <= 1e-12 * contact[k].normal_force);
        if (contact[k].first == id) sum += contact[k].force[0];
        if (body && contact[k].second == id) sum -= contact[k].force[0];
        scale = fmax(scale, contact[k].normal_force);
    }
    scree_sum_row *row = &s->state.sum[s->state.row_of_id[id]];
    double force = (double)row->fx * s->state.force_quantum;
    for (size_t k = 0; k < scree_loop_of(&s->state)->count; k++)
        if (scree_loop_of(&s->state)->id[k] == id) force -= scree_loop_of(&s->state)->fx[k];
    // velocity_verlet evaluates contacts again with a velocity that was rounded twice.
    assert_true(fabs(sum - force) < 1e-9 * scale);
    for (int k = 0; k < 9; k += 4) trace += structure.fabric[k];
    assert_true(fabs(trace - 1) < 1e-12);
    assert_true(structure.coordination == s->sample[SCREE_SAMPLE_COORDINATION]);
    assert_true(structure.solid_fraction == s->sample[SCREE_SAMPLE_SOLID_FRACTION]);
    assert_true(-stress[4] == s->sample[SCREE_SAMPLE_AXIAL_CONTACTS]);
    assert_true(fabs(boundary[4] / stress[4] - 1) < 0.05);
    assert_true(scree_simulation_volume(s) == s->sample[SCREE_SAMPLE_VOLUME]);
    assert_true(library_energies(s).residual == s->sample[SCREE_SAMPLE_ENERGY_RESIDUAL]);
    scree_simulation_free(s);
    scree_case_free(c);
}

static void drafts_make_cases(void **unused)
{
    (void)unused;
    scree_error error;
    scree_draft *draft;
    scree_case *c;
    scree_problems *problems;
    assert_int_equal(scree_draft_builtin("biaxal", &draft, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.accepted, "biaxial");
    assert_int_equal(scree_draft_read("/nowhere/case.yaml", &draft, &error), SCREE_ERROR_INPUT);
    check(scree_draft_builtin("biaxial", &draft, &error), &error);
    scree_draft_set_quick(draft, true);
    check(scree_draft_set(draft, "particles.count", "60", &error), &error);
    check(scree_draft_set(draft, "stages.compress.rate", "2e-2 1/s", &error), &error);
    check(scree_draft_set_number(draft, "seed", 7, &error), &error);
    assert_int_equal(scree_draft_check(draft, &c, &problems), SCREE_OK);
    assert_true(c->config.particles.count == 60 && c->config.seed == 7);
    scree_case_free(c);
    // All that is wrong is told at once, and the draft can go on.
    check(scree_draft_set(draft, "particles.cuont", "60", &error), &error);
    check(scree_draft_set(draft, "stages.compress.rate", "2 m", &error), &error);
    assert_int_equal(scree_draft_check(draft, &c, &problems), SCREE_ERROR_INPUT);
    assert_int_equal(scree_problems_count(problems), 2);
    scree_problems_free(problems);
    scree_draft_free(draft);
    scree_draft_free(NULL);
}

/// What is kept can be read when the arrays have moved, and when the simulation is gone; then it is freed.
static void kept_views_outlive_their_simulation(void **unused)
{
    (void)unused;
    static const char *const names[] = {"position", "radius", "walls/position", "contacts/first", "ledger/outside"};
    enum { COUNT = sizeof names / sizeof *names };
    size_t before, behind;
    scree_error error;
    scree_view view[COUNT];
    scree_keeper *keeper[COUNT];
    unsigned char first[COUNT][8];
    scree_case *c = case_read(SIMULATION_SMALL, NULL, 0);
    scree_allocation_statistics(&before, NULL);
    scree_simulation *s = library_create(c);
    check(scree_simulation_keep_view(s, "position", &view[0], &keeper[0], &error), &error);
    assert_null(keeper[0]);
    scree_keeper_free(NULL);
    assert_int_equal(scree_simulation_keep_view(s, "postion", &view[0], &keeper[0], &error), SCREE_ERROR_INPUT);
    library_advance(s, 400);
    for (size_t k = 0; k < COUNT; k++) {
        check(scree_simulation_keep_view(s, names[k], &view[k], &keeper[k], &error), &error);
        assert_ptr_equal(view[k].data, library_view(s, names[k]).data);
        memcpy(first[k], view[k].data, k == 3 ? 4 : 8);
    }
    // The arrays of bodies move; what was kept stays as it was.
    check(scree_state_reserve_rows(&s->state, 10 * s->state.row_capacity, &error), &error);
    assert_ptr_not_equal(view[0].data, library_view(s, "position").data);
    scree_simulation_free(s);
    size_t held;
    scree_allocation_statistics(&held, NULL);
    assert_true(held > before);
    for (size_t k = 0; k < 4; k++) assert_memory_equal(first[k], view[k].data, k == 3 ? 4 : 8);
    for (size_t k = 0; k < COUNT; k++) scree_keeper_free(keeper[k]);
    scree_allocation_statistics(&behind, NULL);
    assert_int_equal(behind, before);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(time_goes_by_steps_and_stages),       cmocka_unit_test(views_are_the_fields_in_2d),
        cmocka_unit_test(views_are_the_fields_in_3d),          cmocka_unit_test(known_views_hold_what_they_say),
        cmocka_unit_test(names_that_are_none_are_refused),     cmocka_unit_test(copies_are_by_id),
        cmocka_unit_test(contacts_and_measures_agree),         cmocka_unit_test(drafts_make_cases),
        cmocka_unit_test(kept_views_outlive_their_simulation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
