/// The power fails at any moment of a run: from the first checkpoint on it can be continued, and ends with the same
/// state, rows and snapshots.
#include "power_cut.h"
#include "run_fixture.h"

#include "io_scratch.h"

#define COMMON                                                                                                         \
    "scree: 1\n"                                                                                                       \
    "name: small\n"                                                                                                    \
    "seed: 3\n"                                                                                                        \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}\n"            \
    "particles: {material: quartz, count: 30, radius_min: 0.6 mm, radius_max: 0.9 mm}\n"                               \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "integrator: {scheme: velocity_verlet, step: 2e-5 s}\n"                                                            \
    "measure: {samples: 10, cells: no}\n"                                                                              \
    "output: {snapshots: 2, paraview: no, figures: no, checkpoint_steps: 130}\n"

static const char *const cases[] = {
    COMMON "boundary: {periodic: xy}\n"
           "stages:\n"
           "  - {stage: prepare, method: gas, solid_fraction: 40 %, velocity: 20 mm/s}\n"
           "  - {stage: relax, duration: 6 ms}\n"
           "  - {stage: relax, duration: 7 ms}\n",
    COMMON "gravity: [0, -10]\n"
           "walls:\n"
           "  - {shape: box, lower: [0, 0], upper: [12 mm, 60 mm]}\n"
           "stages:\n"
           "  - {stage: prepare, method: gas, width: 12 mm, solid_fraction: 20 %, velocity: 10 mm/s}\n"
           "  - {stage: relax, duration: 8 ms}\n",
};

static void command(const char *text)
{
    if (system(text) != 0) fail_msg("%s", text);
}

/// part/ has become what whole/ is.
static void compare(int event, cut_loss loss)
{
    char sum[2][32];
    size_t count[2];
    scree_error error;
    static const char *const folders[] = {"whole", "part"};
    for (int k = 0; k < 2; k++) {
        run_checksum(folders[k], sum[k]);
        check(scree_snapshot_count(folders[k], &count[k], &error), &error);
    }
    if (strcmp(sum[0], sum[1]) != 0) fail_msg("cut at %d, loss %d: another state", event, (int)loss);
    if (count[0] != count[1])
        fail_msg("cut at %d, loss %d: %zu of %zu snapshots", event, (int)loss, count[1], count[0]);
    command("cmp whole/series.csv part/series.csv");
}

static void a_power_cut_at_any_moment(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        scree_error error;
        uint64_t counter = 0;
        int tried = 0;
        scree_case *c = case_read(cases[k], NULL, 0);
        const scree_run_options options = {.output = "run", .threads = 1, .force = true}, again = {.threads = 1};
        cut.recording = cut.still = true;
        check(scree_run(c, &options, &error), &error);
        cut.recording = false;
        command("rm -rf whole && cp -r run whole");
        int first = cut_first("run/parts/checkpoint-000000.h5");
        assert_true(first > 0);
        // Even events are what calls have done, odd ones what was written before them.
        for (int event = first; event <= cut.event; event += 2) {
            cut_loss loss = (cut_loss)(event / 2 % CUT_LOSSES);
            cut_folder("part", event, loss, &counter);
            if (scree_restart("part", &again, &error))
                fail_msg("cut at %d of %d, loss %d: %s", event, cut.event, (int)loss, error.message);
            compare(event, loss);
            tried++;
        }
        print_message("%d cuts of a run of %d calls\n", tried, cut.event / 2);
        assert_true(tried > 70);
        cut_forget();
        command("rm -rf run");
        scree_case_free(c);
    }
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_scratch)
int main(void)
{
    const struct CMUnitTest tests[] = {IN_SCRATCH(a_power_cut_at_any_moment)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
