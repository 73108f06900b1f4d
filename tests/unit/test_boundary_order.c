/// The order of stiffness of one sample under different boundaries.
#include "measure/imposed_gradient.h"
#include "run_fixture.h"

#include "boundary/imposed_gradient.h"
#include "boundary_cases.h"
#include "run/step.h"

#include <math.h>
#include <string.h>

/// Stress that the boundary `traction` applies besides the pressure at the end, and steps in which it is raised.
static double applied[9];
static uint64_t raised_in;

static scree_status apply_traction(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    (void)error;
    double fraction = (double)(state->step - state->stage.first_step) / (double)raised_in;
    double stress[9];
    for (int i = 0; i < 9; i++) stress[i] = applied[i] * scree_smooth_ramp(fraction);
    memset(scree_imposed(state)->force, 0, scree_imposed(state)->count * sizeof *scree_imposed(state)->force);
    scree_imposed_apply_stress(c->model, state, stress);
    scree_imposed_add_work(state);
    return SCREE_OK;
}

/// Nothing but the traction acts, whatever the stage demands.
static void impose_nothing(const scree_context *c, const scree_demand *demand, double rise)
{
    (void)c, (void)demand, (void)rise;
}

/// Strain and increments of stress of the last stage of a case; with `traction` its boundary is replaced by a uniform
/// traction.
static void load(const char *text, const char *const *overrides, size_t count, const scree_boundary *traction,
                 double strain[9], double stress[9])
{
    scree_case *c = case_read(text, overrides, count);
    scree_simulation s;
    scree_error error;
    double begin_strain[9] = {0}, begin_stress[9] = {0};
    simulation_open(c, 1, &s);
    uint64_t steps = 0;
    bool begun = false;
    while (traction ? steps < 2 * raised_in : s.state.stage.index < 4) {
        if (begun && traction) {
            check(scree_step(&s, &error), &error);
            steps++;
        } else {
            simulation_step(&s);
            raised_in = traction ? raised_in : s.state.step - s.state.stage.first_step;
        }
        if (begun || s.state.stage.index < 3 || s.state.stage.counter < 0) continue;
        begun = true;
        if (traction) {
            s.boundary = traction;
            scree_step_compile(&s);
        }
        scree_strain_measure(&s.state, begin_strain);
        double volume = scree_sample_area(&s.state) * s.model.thickness;
        scree_stress_from_contacts(&s.state, &s.table, volume, begin_stress);
    }
    scree_strain_measure(&s.state, strain);
    check(scree_contact_table_build(&s.model, &s.state, &s.work, &s.table, &error), &error);
    scree_stress_from_contacts(&s.state, &s.table, scree_sample_area(&s.state) * s.model.thickness, stress);
    for (int i = 0; i < 9; i++) {
        strain[i] -= begin_strain[i];
        stress[i] -= begin_stress[i];
    }
    // Keep what was applied, for a traction that repeats it.
    if (s.boundary == scree_module_minimal.boundary) memcpy(applied, scree_imposed(&s.state)->stress, sizeof applied);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// One sample, one small strain: uniform displacement of the boundary >= (a periodic cell >=) minimal conditions >=
/// uniform traction. Minimal conditions ARE a uniform traction whose value is not known before: their stress applied as
/// a traction gives their strain back.
static void boundaries_are_ordered_by_stiffness(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"particles.count=120", "stages.confine.unbalanced_limit=1e-3",
                                     "boundary.penalty=1e12 Pa s", "stages.3.boundary=affine",
                                     "stages.3.strain=0.01 %"};
    const char *const minimal[] = {overrides[0], overrides[1], overrides[2], "stages.3.boundary=minimal", overrides[4]};
    static const scree_pass passes[] = SCREE_IMPOSED_PASSES(apply_traction);
    static const scree_boundary traction = {.passes = passes, .pass_count = 3, .deform = impose_nothing};
    double strain[3][9], stress[3][9];
    load(BOUNDARY_COMMON BOUNDARY_SETTLE BOUNDARY_AFFINE, overrides, 5, NULL, strain[0], stress[0]);
    load(BOUNDARY_COMMON BOUNDARY_SETTLE BOUNDARY_AFFINE, minimal, 5, NULL, strain[1], stress[1]);
    raised_in = 10000;
    load(BOUNDARY_COMMON BOUNDARY_SETTLE BOUNDARY_AFFINE, minimal, 5, &traction, strain[2], stress[2]);
    double modulus[3];
    for (int k = 0; k < 3; k++) {
        modulus[k] = stress[k][4] / strain[k][4];
        print_message("strain %.4g, stress %.5g Pa, secant modulus %.4g MPa\n", strain[k][4], stress[k][4],
                      1e-6 * modulus[k]);
    }
    for (int k = 0; k < 2; k++) assert_true(fabs(strain[k][4] + 1e-4) < 1.1e-5);
    assert_true(modulus[0] > modulus[1] * 1.02);
    assert_true(modulus[1] > modulus[2] * 0.97); // equal but for inertia, and creep of sliding contacts
    assert_true(modulus[2] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boundaries_are_ordered_by_stiffness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
