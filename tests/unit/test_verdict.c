/// Verdicts on statements of sources: intervals against closed values, criteria at their edges, and the rules by which
/// runs are paired, counted and refused, on folders of made-up runs.
#include "testing.h"

#include "io_scratch.h"

#include "sweep/answer.h"
#include "sweep/expression.h"

#include <math.h>
#include <sys/stat.h>

static char folder[64];

/// Student's t of 95 % for one and two degrees of freedom, of 90 % for two: from any table, to the digits given there;
/// values that rest on them are compared to 1e-4 of themselves.
static const double t1 = 12.7062, t2 = 4.3027, t2_of_90 = 2.9200;

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance * fabs(expected))) fail_msg("%.12g, not %.12g", value, expected);
}

static void assert_interval(scree_interval i, double middle, double low, double high, double tolerance)
{
    assert_near(i.middle, middle, tolerance);
    assert_near(i.low, low, tolerance);
    assert_near(i.high, high, tolerance);
}

// ---- intervals ---------------------------------------------------------------------------------------------------

static void means_have_students_interval(void **state)
{
    (void)state;
    const double value[] = {3, 5, 7};
    // Standard deviation 2.
    double half = t2 * 2 / sqrt(3);
    scree_interval mean = scree_interval_mean(value, 3, 0.95);
    assert_true(mean.middle == 5);
    assert_near(mean.high - 5, half, 1e-4);
    assert_near(5 - mean.low, half, 1e-4);
    assert_true(isnan(scree_interval_mean(value, 1, 0.95).low) && scree_interval_mean(value, 1, 0.95).middle == 3);
    assert_true(isnan(scree_interval_mean(value, 0, 0.95).middle));
    scree_interval range = scree_interval_range(value, 3);
    assert_true(range.low == 3 && range.high == 7 && range.middle == 5);
}

/// Logarithms of 1 and 4: mean ln 2, deviation ln 4 / sqrt 2, half = t1 ln 4 / 2 = t1 ln 2.
static void ratios_have_a_geometric_mean(void **state)
{
    (void)state;
    const double value[] = {log(1), log(4)};
    scree_interval i = scree_interval_exponential(scree_interval_mean(value, 2, 0.95));
    // The error of t1 in the fifth digit is multiplied by ln 2 in the exponent.
    assert_interval(i, 2, pow(2, 1 - t1), pow(2, 1 + t1), 1e-4);
}

static void groups_of_different_samples_have_welchs_interval(void **state)
{
    (void)state;
    const double a[] = {1, 3}, b[] = {5, 7}, c[] = {5, 5};
    // Squared errors 1 and 1: (1 + 1)^2 / (1 + 1) = 2 degrees of freedom, half = t2 sqrt 2.
    assert_interval(scree_interval_difference(a, 2, b, 2, 0.95), -4, -4 - t2 * sqrt(2), -4 + t2 * sqrt(2), 1e-4);
    // 1 and 0: one degree of freedom.
    assert_interval(scree_interval_difference(a, 2, c, 2, 0.95), -3, -3 - t1, -3 + t1, 1e-4);
    scree_interval few = scree_interval_difference(a, 1, b, 2, 0.95);
    assert_true(few.middle == -5 && isnan(few.low) && few.count == 1);
}

/// All of n: (alpha / 2)^(1/n). One of two: x with 1 - (1 - x)^2 = alpha / 2 (closed forms of the beta distribution);
/// GSL's quantiles are good to 1e-9 or so.
static void proportions_are_exact(void **state)
{
    (void)state;
    assert_interval(scree_interval_proportion(6, 6, 0.95), 1, pow(0.025, 1.0 / 6), 1, 1e-8);
    assert_near(scree_interval_proportion(0, 3, 0.95).high, 1 - pow(0.025, 1.0 / 3), 1e-8);
    assert_true(scree_interval_proportion(0, 3, 0.95).low == 0);
    assert_interval(scree_interval_proportion(1, 2, 0.95), 0.5, 1 - sqrt(0.975), sqrt(0.975), 1e-8);
}

// ---- criteria ----------------------------------------------------------------------------------------------------

static scree_arena arena;

/// The one statement of a table; `line` has what is special about it.
static const scree_statement *statement(const char *line)
{
    char text[1000];
    static scree_statement_table table;
    scree_problems *problems;
    (void)snprintf(text, sizeof text,
                   "source: s\ncases:\n- case: c\n  meaning: m\n  statements:\n"
                   "  - {id: a, statement: s, source: p, kind: finding, %s}\n",
                   line);
    if (scree_statements_read("t", text, strlen(text), NULL, &arena, &table, &problems))
        fail_msg("%s: %s", line, scree_problems_get(problems, 0)->message);
    return &table.cases[0].statements[0];
}

static void intervals_are_judged_at_their_edges(void **state)
{
    (void)state;
    static const struct {
        const char *line;
        double low, high;
        scree_verdict verdict;
    } known[] = {
        // 4 less and more 1/4 of it: 3 to 5, the ends included.
        {"given: 4, value: c.r, criterion: within 25 %", 3, 5, SCREE_AGREES},
        {"given: 4, value: c.r, criterion: within 25 %", 2.999, 5, SCREE_UNDECIDED},
        {"given: 4, value: c.r, criterion: within 25 %", 3, 5.001, SCREE_UNDECIDED},
        {"given: 4, value: c.r, criterion: within 25 %", 5, 6, SCREE_UNDECIDED},
        {"given: 4, value: c.r, criterion: within 25 %", 5.001, 6, SCREE_DIFFERS},
        {"given: -4, value: c.r, criterion: within 25 %", -5, -3, SCREE_AGREES},
        // 2 less and more 1/4: of a value that may be 0.
        {"given: 2, value: c.r, criterion: equivalent within 0.25", 1.75, 2.25, SCREE_AGREES},
        {"given: 2, value: c.r, criterion: equivalent within 0.25", 1.749, 2.25, SCREE_UNDECIDED},
        {"given: 2, value: c.r, criterion: equivalent within 0.25", 1.75, 2.251, SCREE_UNDECIDED},
        {"given: 2, value: c.r, criterion: equivalent within 0.25", 2.251, 3, SCREE_DIFFERS},
        {"given: 0, value: c.r, criterion: equivalent within 50 %", -0.5, 0.5, SCREE_AGREES},
        {"given: 0, value: c.r, criterion: equivalent within 50 %", -0.5, 0.501, SCREE_UNDECIDED},
        {"given: x, value: c.r, criterion: greater than 2", 2.001, 9, SCREE_AGREES},
        {"given: x, value: c.r, criterion: greater than 2", 2, 9, SCREE_UNDECIDED},
        {"given: x, value: c.r, criterion: greater than 2", 1, 2, SCREE_DIFFERS},
        {"given: x, value: c.r, criterion: less than 50 %", -9, 0.499, SCREE_AGREES},
        {"given: x, value: c.r, criterion: less than 50 %", -9, 0.5, SCREE_UNDECIDED},
        {"given: x, value: c.r, criterion: less than 50 %", 0.5, 9, SCREE_DIFFERS},
        {"given: x, value: c.r, criterion: between -1 and 1e-2", -1, 0.01, SCREE_AGREES},
        {"given: x, value: c.r, criterion: between -1 and 1e-2", -1.001, 0.01, SCREE_UNDECIDED},
        {"given: x, value: c.r, criterion: between -1 and 1e-2", -3, 3, SCREE_UNDECIDED},
        {"given: x, value: c.r, criterion: between -1 and 1e-2", 0.011, 3, SCREE_DIFFERS},
        {"given: x, value: c.r > 1, criterion: holds", 0.501, 1, SCREE_AGREES},
        {"given: x, value: c.r > 1, criterion: holds", 0.5, 1, SCREE_UNDECIDED},
        {"given: x, value: c.r > 1, criterion: holds", 0, 0.5, SCREE_DIFFERS},
        {"given: x, value: c.r, criterion: greater than 2", NAN, NAN, SCREE_UNDECIDED},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        scree_interval interval = {0.5 * (known[i].low + known[i].high), known[i].low, known[i].high, 3};
        scree_verdict verdict = scree_verdict_of(statement(known[i].line), &interval);
        if (verdict != known[i].verdict)
            fail_msg("%s, [%g, %g]: %d", known[i].line, known[i].low, known[i].high, verdict);
    }
}

static void expressions_come_apart_at_what_is_evaluated_last(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        char sign;
        const char *left, *right;
    } known[] = {
        {"a/b-c.r / d.s", '/', "a/b-c.r ", " d.s"},
        {"a.r - b.r / c.r", '-', "a.r ", " b.r / c.r"},
        {"a.r / b.r / 2", '/', "a.r / b.r ", " 2"},
        {"a.r + 1 <= b.r * 2", '<', "a.r + 1 ", " b.r * 2"},
        {"(a.r / b.r)", 0, "", ""},
        {"- a.r / (b.r - 1)", '/', "- a.r ", " (b.r - 1)"},
        {"a.r /", 0, "", ""},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        scree_expression_split split = scree_expression_take_apart(known[i].text);
        assert_int_equal(split.sign, known[i].sign);
        if (!split.sign) continue;
        assert_int_equal(split.left, strlen(known[i].left));
        assert_string_equal(known[i].text + split.right, known[i].right);
    }
}

// ---- runs --------------------------------------------------------------------------------------------------------

typedef struct run {
    int seed;
    const char *status;  ///< done, failed or to run
    double solid, value; ///< value NAN: null
    double friction;
    const char *build;
    double gaps;       ///< of its packing, where no solid fraction was measured: `solid` NAN
    double unbalanced; ///< of the state before a change, above zero, in place of `gaps`
} run;

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/// A sweep `name` with one point, full form, in a folder of its own.
static void write_sweep(const char *name, const char *point, const run *runs, size_t count)
{
    char path[300], text[3000], value[40], solid[100];
    (void)snprintf(path, sizeof path, "%s/%s-%s", folder, name, point);
    assert_int_equal(mkdir(path, 0777), 0);
    (void)snprintf(path, sizeof path, "%s/%s-%s/members", folder, name, point);
    assert_int_equal(mkdir(path, 0777), 0);
    size_t used = (size_t)snprintf(
        text, sizeof text, "{\"sweep\": \"%s\", \"quick\": false, \"points\": [{\"name\": \"%s\"}], \"members\": [",
        name, point);
    for (size_t i = 0; i < count; i++)
        used += (size_t)snprintf(
            text + used, sizeof text - used,
            "%s{\"folder\": \"%d\", \"point\": 0, \"realisation\": %zu, \"seed\": %d, \"status\": \"%s\"}",
            i > 0 ? ", " : "", runs[i].seed, i, runs[i].seed, runs[i].status);
    (void)snprintf(text + used, sizeof text - used, "]}\n");
    (void)snprintf(path, sizeof path, "%s/%s-%s/sweep.json", folder, name, point);
    write_text(path, text);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(runs[i].status, "done") != 0) continue;
        (void)snprintf(path, sizeof path, "%s/%s-%s/members/%d", folder, name, point, runs[i].seed);
        assert_int_equal(mkdir(path, 0777), 0);
        const char *const other = runs[i].unbalanced > 0 ? "earlier_unbalanced" : "packing_gap_scatter";
        if (isnan(runs[i].solid))
            (void)snprintf(solid, sizeof solid, "null, \"%s\": %.17g", other,
                           runs[i].unbalanced > 0 ? runs[i].unbalanced : runs[i].gaps);
        else
            (void)snprintf(solid, sizeof solid, "%.17g", runs[i].solid);
        (void)snprintf(value, sizeof value, isnan(runs[i].value) ? "null" : "%.17g", runs[i].value);
        (void)snprintf(text, sizeof text,
                       "{\"status\": \"done\", \"version\": \"0\", \"commit\": \"%s\", \"particles\": 100, "
                       "\"confine_friction\": %.17g, "
                       "\"solid_fraction_at_start\": %s, \"r\": %s}\n",
                       runs[i].build ? runs[i].build : "one", runs[i].friction > 0 ? runs[i].friction : 0.05, solid,
                       value);
        strcat(path, "/summary.json");
        write_text(path, text);
    }
}

static scree_answer answer_to(const char *line)
{
    scree_findings findings = {0};
    scree_answer answer;
    scree_error error;
    assert_int_equal(scree_findings_add(&findings, folder, &error), SCREE_OK);
    if (scree_answer_find(&findings, statement(line), SCREE_FINDING_FULL, &answer, &error))
        fail_msg("%s", error.message);
    scree_findings_destroy(&findings);
    return answer;
}

static void assert_remark(const scree_answer *answer, const char *text)
{
    if (text[0] ? !strstr(answer->remark, text) : answer->remark[0]) fail_msg("'%s', not '%s'", answer->remark, text);
}

#define DONE(n, solid_fraction, result)                                                                                \
    {                                                                                                                  \
        .seed = (n), .status = "done", .solid = (solid_fraction), .value = (result)                                    \
    }

/// Values 3.9, 4, 4.1: half of the 90 % interval 2.92 x 0.1 / sqrt 3 = 0.169, of the 95 % interval 0.248; the criteria
/// leave 0.2 to either side.
static void within_is_two_one_sided_tests(void **state)
{
    (void)state;
    const run runs[] = {DONE(1, 0.8, 3.9), DONE(2, 0.81, 4), DONE(3, 0.82, 4.1)};
    write_sweep("s", "p", runs, 3);
    scree_answer within = answer_to("given: 4, value: s/p.r, criterion: within 5 %");
    double half = t2_of_90 * 0.1 / sqrt(3);
    assert_int_equal(within.verdict, SCREE_AGREES);
    assert_interval(within.interval, 4, 4 - half, 4 + half, 1e-4);
    assert_remark(&within, "");
    within = answer_to("given: 4, value: s/p.r, criterion: equivalent within 0.2");
    assert_int_equal(within.verdict, SCREE_AGREES);
    assert_interval(within.interval, 4, 4 - half, 4 + half, 1e-4);
    assert_int_equal(answer_to("given: 4, value: s/p.r, criterion: between 3.8 and 4.2").verdict, SCREE_UNDECIDED);
}

static void missing_failed_and_worthless_runs_are_counted(void **state)
{
    (void)state;
    const run runs[] = {DONE(1, 0.8, 2),
                        DONE(2, 0.81, 4),
                        {.seed = 3, .status = "failed"},
                        DONE(4, 0.82, NAN),
                        {.seed = 5, .status = "to run"},
                        DONE(6, 0.83, 6)};
    write_sweep("s", "p", runs, 6);
    scree_answer a = answer_to("given: x, value: s/p.r, criterion: greater than 1");
    assert_int_equal(a.interval.count, 3);
    assert_int_equal(a.planned, 6);
    assert_true(a.interval.middle == 4);
    assert_remark(&a, "1 without a value");
    assert_remark(&a, "1 failed");
    a = answer_to("given: x, value: s/p.other, criterion: greater than 1");
    assert_int_equal(a.verdict, SCREE_NOT_MEASURED);
    assert_remark(&a, "no result 'other'");
    a = answer_to("given: x, value: s/q.r, criterion: greater than 1");
    assert_int_equal(a.verdict, SCREE_NOT_RUN);
    assert_remark(&a, "s/q is not there");
}

static void one_sample_decides_only_what_is_deterministic(void **state)
{
    (void)state;
    const run runs[] = {DONE(1, 0.8, 3)}, several[] = {DONE(1, 0.8, 3), DONE(2, 0.81, 3.5)};
    write_sweep("s", "p", runs, 1);
    write_sweep("s", "q", several, 2);
    scree_answer a = answer_to("given: x, value: s/p.r, criterion: greater than 2");
    assert_int_equal(a.verdict, SCREE_UNDECIDED);
    assert_true(a.interval.middle == 3);
    assert_remark(&a, "one sample: no interval");
    assert_int_equal(answer_to("given: x, value: s/p.r > 1, criterion: holds").verdict, SCREE_UNDECIDED);
    a = answer_to("given: x, value: s/p.r, criterion: greater than 2, deterministic: yes");
    assert_int_equal(a.verdict, SCREE_AGREES);
    assert_int_equal(answer_to("given: x, value: s/p.r > 4, criterion: holds, deterministic: yes").verdict,
                     SCREE_DIFFERS);
    // Of several the range counts.
    assert_int_equal(answer_to("given: x, value: s/q.r, criterion: less than 3.6, deterministic: yes").verdict,
                     SCREE_AGREES);
    assert_int_equal(answer_to("given: x, value: s/q.r, criterion: less than 3.2, deterministic: yes").verdict,
                     SCREE_UNDECIDED);
}

/// Ratios 1 and 4 on the same samples, at other places of the list: geometric mean 2, and 2.5 as a plain mean.
static void same_samples_are_paired(void **state)
{
    (void)state;
    const run a[] = {DONE(1, 0.8, 10), DONE(2, 0.81, 20), DONE(3, 0.82, 1)}, b[] = {DONE(2, 0.81, 5), DONE(1, 0.8, 10)};
    write_sweep("s", "a", a, 3);
    write_sweep("s", "b", b, 2);
    scree_answer ratio = answer_to("given: x, value: s/a.r / s/b.r, criterion: greater than 0");
    assert_interval(ratio.interval, 2, pow(2, 1 - t1), pow(2, 1 + t1), 1e-4);
    assert_int_equal(ratio.interval.count, 2);
    assert_int_equal(ratio.planned, 3);
    assert_int_equal(ratio.verdict, SCREE_AGREES);
    ratio = answer_to("given: x, value: s/a.r / s/b.r, criterion: greater than 0, average: plain");
    assert_interval(ratio.interval, 2.5, 2.5 - 1.5 * t1, 2.5 + 1.5 * t1, 1e-4);
    // Over a number it is no ratio of results; a zero has no logarithm.
    assert_near(answer_to("given: x, value: s/b.r / 1e1, criterion: less than 9").interval.middle, 0.75, 1e-12);
    ratio = answer_to("given: x, value: (s/a.r - 10) / s/b.r, criterion: less than 9");
    assert_near(ratio.interval.middle, 1, 1e-12);
    assert_remark(&ratio, "not all ratios are positive");
}

/// Two runs each: those of `a` have the samples of `b`, and twice their values; one of `c` has another sample.
static void assert_pairs(const run *a, const run *b, const run *c)
{
    write_sweep("s", "a", a, 2);
    write_sweep("s", "b", b, 2);
    write_sweep("s", "c", c, 2);
    assert_int_equal(answer_to("given: 2, value: s/a.r / s/b.r, criterion: within 1 %").verdict, SCREE_AGREES);
    scree_answer others = answer_to("given: 2, value: s/a.r / s/c.r, criterion: within 1 %");
    assert_int_equal(others.verdict, SCREE_UNDECIDED);
    assert_remark(&others, "not of the same samples");
}

/// Bonded bars, whose solid fraction no boundary measures: by the gaps of their packings. Pairs have the ratio 2.
static void packings_are_paired(void **state)
{
    (void)state;
#define BAR(n, scatter, result)                                                                                        \
    {                                                                                                                  \
        .seed = (n), .status = "done", .solid = NAN, .gaps = (scatter), .value = (result)                              \
    }
    const run a[] = {BAR(1, 0.01, 10), BAR(2, 0.02, 200)}, b[] = {BAR(1, 0.01, 5), BAR(2, 0.02, 100)},
              c[] = {BAR(1, 0.01, 5), BAR(2, nextafter(0.02, 1), 100)};
    assert_pairs(a, b, c);
}

/// Piles that are changed in two ways: by what was unbalanced before. Pairs have the ratio 2; those of `c` were built
/// in another way.
static void changes_of_one_state_are_paired(void **state)
{
    (void)state;
#define PILE(n, before, result)                                                                                        \
    {                                                                                                                  \
        .seed = (n), .status = "done", .solid = NAN, .unbalanced = (before), .value = (result)                         \
    }
    const run a[] = {PILE(1, 1e-12, 10), PILE(2, 2e-12, 200)}, b[] = {PILE(1, 1e-12, 5), PILE(2, 2e-12, 100)},
              c[] = {PILE(1, 1e-12, 5), PILE(2, nextafter(2e-12, 1), 100)};
    assert_pairs(a, b, c);
}

/// Of other solid fractions at the begin: means of the logarithms 1 and 3 and of 5 and 7 (see above), not pairs.
static void other_samples_are_not_paired(void **state)
{
    (void)state;
    const run a[] = {DONE(1, 0.8, exp(1)), DONE(2, 0.81, exp(3))};
    const run b[] = {DONE(1, 0.8, exp(5)), DONE(2, nextafter(0.81, 1), exp(7))};
    write_sweep("s", "a", a, 2);
    write_sweep("s", "b", b, 2);
    scree_answer ratio = answer_to("given: x, value: s/a.r / s/b.r, criterion: less than 1");
    // Tables have t to five digits: 1e-4 of 6 in the exponent.
    assert_interval(ratio.interval, exp(-4), exp(-4 - t2 * sqrt(2)), exp(-4 + t2 * sqrt(2)), 1e-3);
    assert_int_equal(ratio.verdict, SCREE_UNDECIDED);
    assert_remark(&ratio, "not of the same samples; means of 2 and 2 compared");
    scree_answer holds = answer_to("given: x, value: s/a.r < s/b.r, criterion: holds");
    assert_int_equal(holds.verdict, SCREE_UNDECIDED);
    assert_int_equal(holds.interval.count, 0);
    scree_answer sum = answer_to("given: x, value: s/a.r - s/b.r, criterion: less than 1");
    assert_near(sum.interval.middle, (exp(1) + exp(3) - exp(5) - exp(7)) / 2, 1e-12);
}

/// The last operator takes a sum apart: what is left of it must not mix samples, and brackets see to that.
static void sums_of_other_samples_need_brackets(void **state)
{
    (void)state;
    const run a[] = {DONE(1, 0.8, 10), DONE(2, 0.81, 12)}, b[] = {DONE(3, 0.7, 2), DONE(4, 0.71, 3)};
    write_sweep("s", "a", a, 2);
    write_sweep("s", "b", b, 2);
    scree_answer mixed = answer_to("given: x, value: s/a.r + s/a.r - s/b.r - s/b.r, criterion: greater than 0");
    assert_int_equal(mixed.verdict, SCREE_NOT_MEASURED);
    assert_remark(&mixed, "one side mixes samples: put those of one kind into brackets");
    scree_answer apart = answer_to("given: x, value: s/a.r + s/a.r - (s/b.r + s/b.r), criterion: greater than 0");
    assert_near(apart.interval.middle, 17, 1e-12);
    assert_remark(&apart, "means of 2 and 2 compared");
    assert_null(strstr(apart.remark, "brackets"));
}

/// Three of three: 0.025^(1/3) = 0.29; six of six: 0.54.
static void few_samples_do_not_prove_a_comparison(void **state)
{
    (void)state;
    const run few[] = {DONE(1, 0.8, 2), DONE(2, 0.81, 2), DONE(3, 0.82, 2)};
    const run many[] = {DONE(1, 0.8, 2),  DONE(2, 0.81, 2), DONE(3, 0.82, 2),
                        DONE(4, 0.83, 2), DONE(5, 0.84, 2), DONE(6, 0.85, 2)};
    write_sweep("s", "few", few, 3);
    write_sweep("s", "many", many, 6);
    scree_answer a = answer_to("given: x, value: s/few.r > 1, criterion: holds");
    assert_int_equal(a.verdict, SCREE_UNDECIDED);
    assert_int_equal(a.successes, 3);
    assert_int_equal(answer_to("given: x, value: s/many.r > 1, criterion: holds").verdict, SCREE_AGREES);
    assert_int_equal(answer_to("given: x, value: s/many.r > 3, criterion: holds").verdict, SCREE_DIFFERS);
}

static void mixed_builds_and_preparations_show(void **state)
{
    (void)state;
    const run runs[] = {DONE(1, 0.8, 2), {2, "done", 0.81, 3, 0.2, "two", 0, 0}};
    write_sweep("s", "p", runs, 2);
    scree_answer a = answer_to("given: x, value: s/p.r, criterion: greater than 0");
    assert_remark(&a, "builds differ: one, two");
    assert_remark(&a, "preparations differ, friction of the confinement: 0.05, 0.2");
}

// ---- what is wrong with a table ----------------------------------------------------------------------------------

static void wrong_tables_are_refused_with_the_nearest_name(void **state)
{
    (void)state;
    static const struct {
        const char *line, *accepted, *message;
        int column;
    } wrong[] = {
        {"kind: findng, given: 4, value: s/p.r, criterion: holds", "finding", "there is no kind", 44},
        {"kind: finding, given: 4, value: s/p.r, criterion: withn 10 %", "within 10 %, equivalent",
         "there is no criterion 'withn 10 %'; did you mean 'within 10 %'?", 0},
        {"kind: finding, given: 4, value: s/p.r, criterion: near 4", "within 10 %, equivalent",
         "there is no criterion 'near 4'", 0},
        {"kind: finding, given: 4, value: s/p.r, criterion: within 10 m", "within 10 %, equivalent",
         "'within 10 m' is not a criterion, expected behind 'within': a share", 0},
        {"kind: finding, given: 4, value: s/p.r, criterion: between 2 and 1", "",
         "expected behind 'between': two numbers", 0},
        {"kind: finding, given: y, value: s/p.r, criterion: within 10 %", "a number",
         "needs a number in 'given', not 'y'", 0},
        {"kind: finding, given: 4, value: 1 +, criterion: holds", "", "missing", 0},
        {"kind: finding, given: 4, value: x, criterion: holds", "CASE/LABEL.RESULT", "not of this form", 0},
        {"kind: finding, given: 4, value: t/p.r, criterion: holds", "", "there is no sweep or case 't'", 70},
        {"kind: finding, given: 4, value: biaxal.r, criterion: holds", "biaxial", "there is no sweep or case 'biaxal'",
         70},
        {"kind: finding, given: 4, value: s/q.r, criterion: holds", "p", "there is no point 'q'", 70},
        {"kind: finding, given: 4, value: s/p.solid_fraction_at_strt, criterion: holds", "solid_fraction_at_start",
         "there is no result 'solid_fraction_at_strt'", 70},
        {"kind: finding, given: 4, value: biaxial-timescales/IV.r, criterion: holds", "I, II-2-20-5, II-2-15-10",
         "there is no point 'IV'", 70},
        {"kind: finding, given: 4, value: s/p.r, criterion: holds, form: full", "reason", "needs a 'reason'", 0},
        {"given: 4, value: s/p.r, criterion: holds", "", "required", 0},
    };
    const run runs[] = {DONE(1, 0.8, 2)};
    scree_findings findings = {0};
    write_sweep("s", "p", runs, 1);
    assert_int_equal(scree_findings_add(&findings, folder, NULL), SCREE_OK);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[1000];
        scree_statement_table table;
        scree_problems *problems;
        (void)snprintf(
            text, sizeof text,
            "source: s\ncases:\n- case: s\n  meaning: m\n  statements:\n  - {id: a, statement: s, source: p, %s}\n",
            wrong[i].line);
        if (scree_statements_read("t", text, strlen(text), &findings, &arena, &table, &problems) != SCREE_ERROR_INPUT)
            fail_msg("%s is accepted", wrong[i].line);
        const scree_error *e = scree_problems_get(problems, 0);
        bool right = strstr(e->message, wrong[i].message) && strstr(e->accepted, wrong[i].accepted) && e->line == 6;
        if (!right || (wrong[i].column > 0 && e->column != wrong[i].column))
            fail_msg("%s: %d:%d: %s (%s)", wrong[i].line, e->line, e->column, e->message, e->accepted);
        scree_problems_free(problems);
    }
    char text[] =
        "source: s\ncases:\n- case: triaxal\n  meaning: m\n  statements: [{id: a, statement: s, source: p, kind: "
        "check, given: 4, value: s/p.r, criterion: holds}]\n";
    scree_statement_table table;
    scree_problems *problems;
    assert_int_equal(scree_statements_read("t", text, strlen(text), &findings, &arena, &table, &problems),
                     SCREE_ERROR_INPUT);
    assert_int_equal(scree_problems_get(problems, 0)->line, 3);
    assert_string_equal(scree_problems_get(problems, 0)->accepted, "triaxial");
    scree_problems_free(problems);
    scree_findings_destroy(&findings);
}

static int begin(void **state)
{
    (void)state;
    return scratch_create(folder) ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    scratch_destroy(folder);
    scree_arena_release(&arena);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(means_have_students_interval),
        cmocka_unit_test(ratios_have_a_geometric_mean),
        cmocka_unit_test(groups_of_different_samples_have_welchs_interval),
        cmocka_unit_test(proportions_are_exact),
        cmocka_unit_test_setup_teardown(intervals_are_judged_at_their_edges, begin, end),
        cmocka_unit_test(expressions_come_apart_at_what_is_evaluated_last),
        cmocka_unit_test_setup_teardown(within_is_two_one_sided_tests, begin, end),
        cmocka_unit_test_setup_teardown(missing_failed_and_worthless_runs_are_counted, begin, end),
        cmocka_unit_test_setup_teardown(one_sample_decides_only_what_is_deterministic, begin, end),
        cmocka_unit_test_setup_teardown(same_samples_are_paired, begin, end),
        cmocka_unit_test_setup_teardown(packings_are_paired, begin, end),
        cmocka_unit_test_setup_teardown(changes_of_one_state_are_paired, begin, end),
        cmocka_unit_test_setup_teardown(other_samples_are_not_paired, begin, end),
        cmocka_unit_test_setup_teardown(sums_of_other_samples_need_brackets, begin, end),
        cmocka_unit_test_setup_teardown(few_samples_do_not_prove_a_comparison, begin, end),
        cmocka_unit_test_setup_teardown(mixed_builds_and_preparations_show, begin, end),
        cmocka_unit_test_setup_teardown(wrong_tables_are_refused_with_the_nearest_name, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
