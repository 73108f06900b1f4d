/// Reading cases: what is accepted, every kind of mistake with its message and place, --set, quick, lost memory.
#include "base/memory.h"
#include "case/case.h"
#include "case/path.h"
#include "good_case.h"
#include "law_choice.h"
#include "own_config.h"
#include "run/stage_compress.h"
#include "run/stage_confine.h"
#include "size/equal.h"
#include "size/limits.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/// Limits of radii that have some.
static const scree_size_limits *limits_of(const scree_config *config)
{
    return scree_config_sizes(&config->particles, 0);
}

static const char minimal[] = "materials: [{name: steel, young_modulus: 200 GPa, density: 7800, friction: 0.1}]\n"
                              "particles: {material: steel, count: 10, radius_min: 1 mm, radius_max: 1 mm}\n"
                              "stages: [{stage: prepare}]\n";

/// Parses `text` with up to 4 overrides (NULL ends them).
static scree_status parse(const char *text, const char *const overrides[], bool quick, scree_case **c,
                          scree_problems **problems)
{
    scree_case_options options = {.overrides = overrides, .quick = quick};
    while (overrides && overrides[options.override_count]) options.override_count++;
    return scree_case_parse(text, strlen(text), "test.yaml", &options, c, problems);
}

/// A case that must be right; says what is wrong otherwise. The caller frees it.
static scree_case *right(const char *text, const char *const overrides[], bool quick)
{
    scree_case *c;
    scree_problems *problems;
    char line[2048] = "";
    if (parse(text, overrides, quick, &c, &problems)) {
        if (scree_problems_count(problems) > 0) scree_error_format(scree_problems_get(problems, 0), line, sizeof line);
        fail_msg("refused: %s", line);
    }
    assert_null(problems);
    return c;
}

/// A case that must be wrong in exactly one way, whose formatted message holds `message`.
static void wrong(const char *text, const char *const overrides[], const char *message)
{
    scree_case *c;
    scree_problems *problems;
    char line[2048];
    assert_int_equal(parse(text, overrides, false, &c, &problems), SCREE_ERROR_INPUT);
    assert_null(c);
    scree_error_format(scree_problems_get(problems, 0), line, sizeof line);
    if (!strstr(line, message)) fail_msg("expected \"%s\", got \"%s\"", message, line);
    if (scree_problems_count(problems) != 1) fail_msg("more than one problem, the first: %s", line);
    scree_problems_free(problems);
}

static void defaults_are_filled_in(void **state)
{
    (void)state;
    scree_case *c = right(minimal, NULL, false);
    const scree_config *config = &c->config;
    assert_string_equal(config->name, "case");
    assert_int_equal(config->dimension, 2);
    assert_true(config->materials[0].young_modulus == 200e9);
    assert_true(config->materials[0].poisson_ratio == 0.3);
    assert_true(isnan(config->materials[0].wall_friction));
    assert_true(limits_of(config)->radius_min == 1e-3);
    assert_int_equal(config->contact.law, SCREE_SLOT_hertz_mindlin);
    assert_true(isnan(config->integrator.step));
    assert_int_equal(config->stage_count, 1);
    assert_string_equal(config->stages[0].name, "prepare");
    assert_true(STAGE(config, 0, prepare)->aspect_ratio == 2);
    assert_true(config->output.figures);
    assert_int_equal(config->measure.window_count, 0);
    scree_case_free(c);
}

static void built_in_cases_are_right(void **state)
{
    (void)state;
    assert_true(scree_template_count() > 0);
    assert_null(scree_template_text("no such case"));
    assert_null(scree_template_name(scree_template_count()));
    for (size_t i = 0; i < scree_template_count(); i++) {
        const char *name = scree_template_name(i);
        assert_true(strlen(scree_template_meaning(i)) > 20);
        assert_true(scree_template_meaning(i)[0] != '#');
        for (int quick = 0; quick < 2; quick++) {
            scree_case *c = right(scree_template_text(name), NULL, quick);
            assert_string_equal(c->config.name, name);
            scree_case_free(c);
        }
    }
}

static void values_mean_what_they_say(void **state)
{
    (void)state;
    scree_case *c = right(good_case(), NULL, false);
    const scree_config *config = &c->config;
    assert_true(config->materials[0].density == 2.675e8);
    assert_true(limits_of(config)->radius_max == 1e-3);
    assert_true(STAGE(config, 1, confine)->pressure == 1e5);
    assert_true(STAGE(config, 2, compress)->strain == 0.15);
    assert_true(STAGE(config, 2, compress)->rate == 1e-2);
    assert_string_equal(config->stages[2].name, "compress");
    assert_int_equal(config->measure.window_count, 2);
    assert_true(config->measure.windows[1].from == 0.1 && config->measure.windows[1].to == 0.15);
    scree_case_free(c);
    c = right(good_case(), NULL, true);
    assert_int_equal(c->config.particles.count, 600);
    assert_true(STAGE(&c->config, 2, compress)->rate == 3e-2);
    scree_case_free(c);
}

/// Each tests/cases/bad/*.yaml says in "# expect:" lines what must be noted, in order, and nothing else may be.
static void check_bad_file(const char *path)
{
    char expected[32][256], line[2048];
    size_t count = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file) && strncmp(line, "# expect: ", 10) == 0 && count < 32) {
        line[strcspn(line, "\n")] = 0;
        (void)snprintf(expected[count++], sizeof expected[0], "%.255s", line + 10);
    }
    fclose(file);
    scree_case *c;
    scree_problems *problems;
    if (scree_case_read(path, NULL, &c, &problems) != SCREE_ERROR_INPUT) fail_msg("%s is accepted", path);
    for (size_t i = 0; i < scree_problems_count(problems); i++) {
        scree_error_format(scree_problems_get(problems, i), line, sizeof line);
        if (i >= count) fail_msg("not expected: %s", line);
        if (!strstr(line, expected[i])) fail_msg("expected \"%s\", got \"%s\"", expected[i], line);
        if (strncmp(line, path, strlen(path)) != 0) fail_msg("no place: %s", line);
        assert_true(scree_problems_get(problems, i)->line > 0);
    }
    if (scree_problems_count(problems) != count) fail_msg("%s: fewer problems than expected", path);
    scree_problems_free(problems);
}

static void bad_files_are_explained(void **state)
{
    (void)state;
    DIR *folder = opendir(SCREE_SOURCE_DIR "/tests/cases/bad");
    assert_non_null(folder);
    size_t files = 0;
    for (const struct dirent *entry; (entry = readdir(folder));) {
        char path[600];
        if (!strstr(entry->d_name, ".yaml")) continue;
        (void)snprintf(path, sizeof path, SCREE_SOURCE_DIR "/tests/cases/bad/%s", entry->d_name);
        check_bad_file(path);
        files++;
    }
    closedir(folder);
    assert_true(files > 50);
}

/// Reads a file made of `length` bytes; it must fail with `status` and `message`.
static void check_bytes(const char *bytes, size_t length, scree_status status, const char *message)
{
    char path[] = "/tmp/scree-test-XXXXXX";
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    assert_int_equal(write(descriptor, bytes, length), (ssize_t)length);
    close(descriptor);
    scree_case *c;
    scree_problems *problems;
    assert_int_equal(scree_case_read(path, NULL, &c, &problems), status);
    unlink(path);
    assert_int_equal(scree_problems_count(problems), 1);
    if (!strstr(scree_problems_get(problems, 0)->message, message))
        fail_msg("expected \"%s\", got \"%s\"", message, scree_problems_get(problems, 0)->message);
    scree_problems_free(problems);
}

static void files_that_are_no_cases_are_refused(void **state)
{
    (void)state;
    enum { TEN_MEGABYTES = 10 << 20 };
    char *large = calloc(1, TEN_MEGABYTES);
    assert_non_null(large);
    memset(large, 'a', TEN_MEGABYTES);
    check_bytes(large, TEN_MEGABYTES, SCREE_ERROR_INPUT, "too large for a case file: 10485760 bytes");
    check_bytes(large, 1 << 20, SCREE_ERROR_INPUT, "this line has more than 4096 bytes");
    memset(large, '[', TEN_MEGABYTES);
    check_bytes(large, 4000, SCREE_ERROR_INPUT, "nested more than 16 levels");
    for (size_t i = 0; i < 1 << 20; i++) large[i] = "- b\n"[i % 4];
    check_bytes(large, 1 << 20, SCREE_ERROR_INPUT, "more than 30000 keys and values");
    for (size_t i = 0; i < TEN_MEGABYTES; i++) large[i] = "#\n"[i % 2];
    large[(1 << 20) + 1] = 0;
    wrong(large, NULL, "too large for a case file: 1048577 bytes (accepted: at most 1 MiB)");
    free(large);
    check_bytes("", 0, SCREE_ERROR_INPUT, "the case file is empty");
    check_bytes("\x7f"
                "ELF\x02\0\0",
                7, SCREE_ERROR_INPUT, "a control character");
    check_bytes("name: a\0b", 9, SCREE_ERROR_INPUT, "this is a binary file");
    check_bytes("name: \xff\xfe", 8, SCREE_ERROR_INPUT, "this is not UTF-8");
    check_bytes("name: \xc0\x80", 8, SCREE_ERROR_INPUT, "this is not UTF-8");
    check_bytes("name: \xed\xa0\x80", 9, SCREE_ERROR_INPUT, "this is not UTF-8");
    check_bytes("name: \xe2\x82", 8, SCREE_ERROR_INPUT, "this is not UTF-8");
}

static void missing_files_are_input_errors(void **state)
{
    (void)state;
    scree_case *c;
    scree_problems *problems;
    assert_int_equal(scree_case_read("/nonexistent/case.yaml", NULL, &c, &problems), SCREE_ERROR_INPUT);
    assert_string_equal(scree_problems_get(problems, 0)->message,
                        "the case file cannot be read: No such file or directory");
    assert_string_equal(scree_problems_get(problems, 0)->file, "/nonexistent/case.yaml");
    scree_problems_free(problems);
    assert_int_equal(scree_case_read("/tmp", NULL, &c, &problems), SCREE_ERROR_IO);
    assert_string_equal(scree_problems_get(problems, 0)->message, "this is a directory, not a case file");
    scree_problems_free(problems);
    assert_int_equal(scree_case_read("/dev/zero", NULL, &c, &problems), SCREE_ERROR_INPUT);
    scree_problems_free(problems);
    assert_int_equal(scree_case_read("/nonexistent/case.yaml", NULL, &c, NULL), SCREE_ERROR_INPUT);
}

#define SET(...) ((const char *const[]){__VA_ARGS__, NULL})

static void overrides_change_the_case(void **state)
{
    (void)state;
    const char *text = good_case();
    scree_case *c = right(text,
                          SET("stages.2.rate=2e-2 1/s", "stages.confine.pressure=0.5 MPa",
                              "materials.quartz.friction=0.3", "measure.windows=[[0, 5 %]]", "guard.overlap=10 %",
                              "title=A test: of --set = \"quoted\" # text", "gravity=[0, -9.81 m/s2]",
                              "stages.confine.name=squeeze", "stages.squeeze.ramp_time=3 s", "particles.count=1e5"),
                          false);
    assert_true(STAGE(&c->config, 2, compress)->rate == 2e-2);
    assert_true(STAGE(&c->config, 1, confine)->pressure == 5e5);
    assert_true(STAGE(&c->config, 1, confine)->ramp_time == 3);
    assert_string_equal(c->config.stages[1].name, "squeeze");
    assert_true(c->config.materials[0].friction == 0.3);
    assert_int_equal(c->config.measure.window_count, 1);
    assert_true(c->config.measure.windows[0].to == 0.05);
    assert_true(c->config.guard.overlap == 0.1);
    assert_true(c->config.gravity[1].value == -9.81);
    assert_string_equal(c->config.title, "A test: of --set = \"quoted\" # text");
    assert_int_equal(c->config.particles.count, 100000);
    scree_case_free(c);
    // A component of a tensor has a path, whether the case gives the tensor or not.
    static const char sheared[] = "materials: [{name: a, young_modulus: 1 GPa, density: 1000, friction: 0}]\n"
                                  "particles: {material: a, count: 3, radius_min: 1, radius_max: 2}\n"
                                  "boundary: {periodic: xy}\nstages:\n- {stage: prepare, method: gas}\n"
                                  "- {stage: confine, pressure: 1 kPa}\n"
                                  "- {stage: deform, velocity_gradient: {xy: 1 1/s}, strain: 5 %}\n";
    for (int given = 0; given < 2; given++) {
        c = right(sheared,
                  given ? SET("stages.deform.velocity_gradient.xy=3 1/s", "stages.2.stress.yy=5 kPa")
                        : SET("stages.deform.stress.yy=5 kPa", "stages.deform.velocity_gradient.xy=3 1/s"),
                  false);
        scree_target target;
        assert_true(
            scree_path_follow(scree_case_root(c), "stages.2.velocity_gradient.xy", NULL, (scree_place){0}, &target));
        assert_string_equal(target.node->text, "3 1/s");
        assert_true(scree_path_follow(scree_case_root(c), "stages.2.stress.yy", NULL, (scree_place){0}, &target));
        assert_string_equal(target.node->text, "5 kPa");
        scree_case_free(c);
    }
    // --set overrules quick.
    c = right(text, SET("particles.count=77"), true);
    assert_int_equal(c->config.particles.count, 77);
    assert_true(STAGE(&c->config, 2, compress)->rate == 3e-2);
    scree_case_free(c);
    scree_problems *problems;
    assert_int_equal(parse(minimal, NULL, true, &c, &problems), SCREE_ERROR_INPUT);
    assert_non_null(strstr(scree_problems_get(problems, 0)->message, "the case does not say what it changes"));
    scree_problems_free(problems);
    // What the file lacks may come from --set, sections too.
    c = right("materials: [{name: a, young_modulus: 1 GPa, density: 1000, friction: 0}]\nstages: [{stage: prepare}]\n",
              SET("particles.material=a", "particles.count=3", "particles.radius_min=1", "particles.radius_max=2"),
              false);
    assert_true(limits_of(&c->config)->radius_max == 2);
    scree_case_free(c);
}

/// An override that chooses leaves out what the file had for its own choice; an override that is not used is an error.
static void overrides_may_choose(void **state)
{
    (void)state;
    const char *text = good_case();
    scree_case *c = right(text, SET("contact.law=hertz_brilliantov"), false);
    assert_int_equal(c->config.contact.law, SCREE_SLOT_hertz_brilliantov);
    assert_true(OWN(c->config.contact.own, scree_brilliantov_config, hertz_brilliantov, "contact")->damping_time ==
                2e-3);
    assert_true(OWN(c->config.materials[0].own, scree_mindlin_material, hertz_mindlin, "materials")->restitution == 0);
    scree_case_free(c);
    c = right(text, SET("particles.distribution=equal", "particles.radius=2 mm"), false);
    assert_true(((const scree_equal_config *)scree_config_sizes(&c->config.particles, 0))->radius == 2e-3);
    scree_case_free(c);
    c = right(text, SET("stages.1.stage=prepare", "stages=[{stage: prepare, width: 3 cm}]", "measure.windows=[]"),
              false);
    assert_int_equal(c->config.stage_count, 1);
    scree_case_free(c);
    wrong(text, SET("contact.damping_time=1 ms"),
          "--set contact.damping_time=1 ms: contact.damping_time: not used with law: hertz_mindlin");
    wrong(text, SET("stages.1.rate=1"), "did you mean 'stages.2.rate'?");
}

static void wrong_overrides_are_explained(void **state)
{
    (void)state;
    const char *text = good_case();
    wrong(text, SET("stages.5.rate=1e-2"),
          "--set stages.5.rate=1e-2: stages.5.rate: there is no stages.5: the case has "
          "3, numbered from 0; did you mean 'stages.2.rate'?");
    wrong(text, SET("stages.compres.rate=1"),
          "nothing in stages is called 'compres'; did you mean 'stages.compress.rate'?");
    wrong(text, SET("rate=1"), "there is no key 'rate' here; did you mean 'stages.compress.rate'?");
    wrong(text, SET("materials.quartz.densty=1"), "did you mean 'materials.quartz.density'?");
    wrong(text, SET("materials.0.densty=1"), "did you mean 'materials.0.density'?");
    wrong(text, SET("particles.count"), "--set particles.count: a value is missing (accepted: key.path=value)");
    wrong(text, SET("particles.count="), "a value is missing");
    wrong(text, SET("=3"), "a key path is missing");
    wrong(text, SET("particles.count.x=3"),
          "'count' is a value without keys of its own; did you mean 'particles.count'?");
    wrong(text, SET("stages.0={stage: prepare}"), "a whole element cannot be set; name one of its keys");
    wrong(text, SET("quick.seed=3"), "there is no key 'quick' here");
    wrong(text, SET("measure.windows=[[1 %, 2 %"), "this is not valid YAML");
    wrong(text, SET("particles.radius_min=3 kPa"),
          "--set particles.radius_min=3 kPa: particles.radius_min: '3 kPa' is a pressure; expected a length, e.g. 0.5 "
          "mm");
    wrong(text, SET("title=a\x01"), "a control character");
    wrong(text, SET("..=1"), "there is no key ''");
    wrong(text, SET("stages.99999999999999999999.rate=1"), "nothing in stages is called");
}

static void stages_of_one_kind_are_numbered(void **state)
{
    (void)state;
    static const char text[] =
        "materials: [{name: a, young_modulus: 1 GPa, density: 1000, friction: 0}]\n"
        "particles: {material: a, count: 10, radius_min: 1 mm, radius_max: 1 mm}\n"
        "stages:\n  - stage: prepare\n  - {stage: confine, pressure: 1 kPa}\n  - {stage: compress, strain: 1 %, rate: "
        "1}\n"
        "  - {stage: compress, strain: 2 %, rate: 1, name: middle}\n  - {stage: compress, strain: 3 %, rate: 1}\n";
    scree_case *c = right(text, SET("stages.compress_2.rate=7", "stages.middle.rate=5"), false);
    assert_string_equal(c->config.stages[2].name, "compress_1");
    assert_string_equal(c->config.stages[3].name, "middle");
    assert_string_equal(c->config.stages[4].name, "compress_2");
    assert_true(STAGE(&c->config, 4, compress)->rate == 7);
    assert_true(STAGE(&c->config, 3, compress)->rate == 5);
    scree_case_free(c);
    wrong(text, SET("stages.compress.rate=7"), "did you mean 'stages.compress_1.rate'?");
    c = right(text,
              SET("stages=[{stage: prepare}, {stage: confine, pressure: 1}, {stage: confine, pressure: 1}, {stage: "
                  "confine, pressure: 1}, {stage: confine, pressure: 1}, {stage: confine, pressure: 1}, {stage: "
                  "confine, pressure: 1}, {stage: confine, pressure: 1}, {stage: confine, pressure: 1}, {stage: "
                  "confine, pressure: 1}, {stage: confine, pressure: 1}, {stage: confine, pressure: 1}]",
                  "stages.10.pressure=7"),
              false);
    assert_true(STAGE(&c->config, 10, confine)->pressure == 7);
    assert_string_equal(c->config.stages[10].name, "confine_10");
    scree_case_free(c);
}

static void many_problems_are_counted(void **state)
{
    (void)state;
    char *text = calloc(1, 400 * 16);
    assert_non_null(text);
    size_t length = 0;
    for (int i = 0; i < 300; i++) length += (size_t)snprintf(text + length, 16, "xyz%d: 1\n", i);
    strcpy(text + length, "guard: {overlap: 0}\n");
    scree_case *c;
    scree_problems *problems;
    assert_int_equal(parse(text, NULL, false, &c, &problems), SCREE_ERROR_INPUT);
    assert_int_equal(scree_problems_count(problems), 201);
    assert_string_equal(scree_problems_get(problems, 0)->field, "xyz0");
    assert_non_null(strstr(scree_problems_get(problems, 200)->message, "more problems"));
    assert_null(scree_problems_get(problems, 201));
    scree_problems_free(problems);
    free(text);
}

static void later_errors_find_their_place(void **state)
{
    (void)state;
    scree_case *c = right("name: a\nmaterials: [{name: a, young_modulus: 1 GPa, density: 1000, friction: 0}]\n"
                          "particles:\n  material: a\n  count: 10\n  radius_min: 1 mm\n  radius_max: 1 mm\n"
                          "stages:\n  - stage: prepare\n",
                          SET("seed=3"), false);
    static const struct {
        const char *field, *file, *value;
        int line, column;
    } cases[] = {
        {"particles.count", "test.yaml", "10", 5, 10},  {"particles.thickness", "test.yaml", "auto", 4, 3},
        {"integrator.step", "test.yaml", "auto", 1, 1}, {"stages.0.method", "test.yaml", "drop_and_roll", 9, 5},
        {"stages.prepare", "test.yaml", "", 9, 5},      {"seed", "--set seed=3", "3", 0, 0},
        {"no.such.key", "test.yaml", "", 1, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scree_error error = {0};
        strcpy(error.field, cases[i].field);
        scree_case_locate(c, &error);
        assert_string_equal(error.file, cases[i].file);
        assert_string_equal(error.value, cases[i].value);
        assert_int_equal(error.line, cases[i].line);
        assert_int_equal(error.column, cases[i].column);
    }
    scree_case_free(c);
}

static const char loaded[] = "materials: [{name: steel, young_modulus: 200 GPa, density: 7800, friction: 0.1}]\n"
                             "particles: {material: steel, count: 10, radius_min: 1 mm, radius_max: 1 mm}\n"
                             "stages: [{stage: prepare, method: gas}, {stage: confine, pressure: 1 kPa}, "
                             "{stage: compress, rate: 1 1/s, strain: 1 %}]\n";

/// The boundary of stage `index` of a case with these overrides, and of the stage before it, by name.
static void assert_held_by(const char *const overrides[], int64_t index, const char *before, const char *present)
{
    scree_case *c = right(loaded, overrides, false);
    const char *const names[2] = {before, present};
    for (int64_t k = 0; k < 2; k++) {
        int slot = scree_config_boundary_of(&c->config, index - 1 + k);
        assert_in_range(slot, 0, SCREE_MODULE_COUNT - 1);
        assert_string_equal(scree_modules[slot]->name, names[k]);
        assert_ptr_equal(scree_config_held_by(&c->config, index - 1 + k), scree_modules[slot]->boundary);
    }
    scree_case_free(c);
}

/// A section that is none or misspelt is one problem, also where modules have keys in it.
/// Elements of lists that are no sections are refused, each with its place; nothing else is said of them.
static void elements_are_sections(void **state)
{
    (void)state;
    static const struct {
        const char *line, *place;
    } lists[] = {
        {"loads: [5]", "test.yaml:4:9: loads.0"},
        {"loads: [[1, 2]]", "test.yaml:4:9: loads.0"},
        {"walls: [plane]", "test.yaml:4:9: walls.0"},
        {"stages: [prepare]", "test.yaml:4:10: stages.0"},
        {"materials: [5]", "test.yaml:4:13: materials.0"},
        {"particles: {count: 10, species: [5]}", "test.yaml:4:34: particles.species.0"},
    };
    for (size_t k = 0; k < sizeof lists / sizeof *lists; k++) {
        char text[512] = "", keys[3][16] = {"materials", "particles", "stages"};
        const char *rest = minimal;
        size_t length = 0;
        // The line stands in the place of the same key, behind comments, in line 4.
        for (int line = 0; line < 3; line++, rest = strchr(rest, '\n') + 1)
            if (strncmp(lists[k].line, keys[line], strlen(keys[line])) == 0)
                length += (size_t)sprintf(text + length, "#\n");
            else
                length += (size_t)sprintf(text + length, "%.*s", (int)(strchr(rest, '\n') + 1 - rest), rest);
        (void)sprintf(text + length, "%s\n", lists[k].line);
        char message[128];
        (void)snprintf(message, sizeof message, "%s: expected keys with values", lists[k].place);
        wrong(text, NULL, message);
    }
}

static void sections_are_no_values(void **state)
{
    (void)state;
    static const char *const names[] = {"contact", "integrator", "boundary", "measure", "output", "guard"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char text[600], expected[80];
        (void)snprintf(text, sizeof text, "%s%s: 5\n", loaded, names[k]);
        (void)snprintf(expected, sizeof expected, "%s: expected a section", names[k]);
        wrong(text, NULL, expected);
        (void)snprintf(text, sizeof text, "%s%c%s: {}\n", loaded, names[k][0], &names[k][2]);
        (void)snprintf(expected, sizeof expected, "did you mean '%s'?", names[k]);
        wrong(text, NULL, expected);
    }
}

/// What the case leaves no choice of, then what a stage or one before it chooses, then `lateral`.
static void stages_have_boundaries(void **state)
{
    (void)state;
    assert_held_by(NULL, 1, "pressure", "pressure");
    assert_held_by((const char *const[]){"boundary.lateral=plates", NULL}, 2, "plates", "plates");
    assert_held_by((const char *const[]){"boundary.lateral=plates", "stages.2.boundary=membrane", NULL}, 2, "plates",
                   "membrane");
    assert_held_by((const char *const[]){"stages.1.boundary=minimal", NULL}, 2, "minimal", "minimal");
    assert_held_by((const char *const[]){"boundary.periodic=xy", NULL}, 1, "periodic", "periodic");
    assert_held_by((const char *const[]){"boundary.periodic=x", NULL}, 2, "plates", "plates");
    // Of one that was wrong nobody else says anything.
    wrong(loaded, (const char *const[]){"integrator.scheme=two_timescales", "stages.2.boundary=foo", NULL},
          "there is no boundary 'foo'");
}

static void nearest_names(void **state)
{
    (void)state;
    static const char *const names[] = {"young_modulus", "poisson_ratio", "density",
                                        "friction",      "wall_friction", "rate"};
    static const char *const cases[][2] = {
        {"yuong_modulus", "young_modulus"},
        {"Young-Modulus", "young_modulus"},
        {"poisson", "poisson_ratio"},
        {"frction", "friction"},
        {"densit", "density"},
        {"raet", "rate"},
        {"modulus", "young_modulus"},
        {"strain_rate", "rate"},
        {"wall_frictoin", "wall_friction"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *found = scree_nearest(cases[i][0], names, 6);
        assert_non_null(found);
        assert_string_equal(found, cases[i][1]);
    }
    char huge[5000];
    memset(huge, 'a', sizeof huge);
    huge[sizeof huge - 1] = 0;
    assert_null(scree_nearest(huge, names, 6));
    assert_null(scree_nearest("viscosity", names, 6));
    assert_null(scree_nearest("", names, 6));
    assert_null(scree_nearest("rate", names, 0));
}

/// Every allocation fails once: an IO error, no crash, nothing leaked.
static void lost_memory_is_survived(void **state)
{
    (void)state;
    const char *texts[] = {good_case(), "a: 1\nb: 2\nc: 3\nd: 4\ne: 5\nf: 6\ng: 7\nh: 8\n"};
    for (size_t t = 0; t < 2; t++) {
        size_t before, after;
        scree_allocation_statistics(&before, NULL);
        scree_status status = SCREE_ERROR_IO;
        uint64_t n = 0;
        while (status == SCREE_ERROR_IO) {
            scree_case *c;
            scree_problems *problems;
            assert_true(++n < 1000);
            scree_allocation_fail_after(n);
            status = parse(texts[t], SET("seed=3", "guard.overlap=3 %"), false, &c, &problems);
            uint64_t made = scree_allocation_fail_after(0);
            assert_int_equal(status == SCREE_ERROR_IO, made >= n); // no failure is overlooked
            if (status == SCREE_ERROR_IO && problems)
                assert_non_null(strstr(scree_problems_get(problems, 0)->message, "out of memory"));
            scree_problems_free(problems);
            scree_case_free(c);
            scree_allocation_statistics(&after, NULL);
            assert_int_equal(before, after);
        }
        assert_int_equal(status, t == 0 ? SCREE_OK : SCREE_ERROR_INPUT);
        assert_true(n > 20);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_filled_in),
        cmocka_unit_test(built_in_cases_are_right),
        cmocka_unit_test(values_mean_what_they_say),
        cmocka_unit_test(bad_files_are_explained),
        cmocka_unit_test(files_that_are_no_cases_are_refused),
        cmocka_unit_test(missing_files_are_input_errors),
        cmocka_unit_test(overrides_change_the_case),
        cmocka_unit_test(overrides_may_choose),
        cmocka_unit_test(wrong_overrides_are_explained),
        cmocka_unit_test(stages_of_one_kind_are_numbered),
        cmocka_unit_test(many_problems_are_counted),
        cmocka_unit_test(later_errors_find_their_place),
        cmocka_unit_test(stages_have_boundaries),
        cmocka_unit_test(sections_are_no_values),
        cmocka_unit_test(elements_are_sections),
        cmocka_unit_test(nearest_names),
        cmocka_unit_test(lost_memory_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
