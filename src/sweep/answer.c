/// Values realisation by realisation, their interval, the verdict, and the remarks.
#include "sweep/answer.h"
#include "sweep/ensemble.h"
#include "sweep/origin.h"

#include "base/memory.h"
#include "sweep/expression.h"

#include <scree/scree.h>

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_REFERENCES = 16, MOST_NAMED = 3 };

/// An expression, the runs that it is about, and what became of it.
typedef struct side {
    const char *text;
    scree_reference reference[MOST_REFERENCES]; ///< name and label; each once
    size_t reference_count;
    bool too_many;
    double *value;    ///< finite ones
    size_t count;     ///< of them
    size_t samples;   ///< with all runs that it needs
    size_t strangers; ///< seeds whose runs did not have the same sample
} side;

/// What all steps share.
typedef struct question {
    const scree_findings *findings;
    const scree_statement *statement;
    scree_finding_form form;
    scree_answer *answer;
    scree_error *error;
    const side *side;                                   ///< that is evaluated
    const scree_finding *run[MOST_REFERENCES];          ///< of the realisation that is evaluated
    char missing[sizeof((scree_reference *)0)->result]; ///< a result that a run does not have
} question;

static void remark(scree_answer *answer, const char *format, ...) SCREE_PRINTF(2, 3);
static void remark(scree_answer *answer, const char *format, ...)
{
    size_t used = strlen(answer->remark), size = sizeof answer->remark;
    if (used > 0 && used + 3 < size) used += (size_t)snprintf(answer->remark + used, size - used, "; ");
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(answer->remark + used, size - used, format, arguments);
    va_end(arguments);
}

static size_t reference_index(const side *s, const scree_reference *reference)
{
    size_t k = 0;
    for (; k < s->reference_count; k++)
        if (strcmp(s->reference[k].name, reference->name) == 0 && strcmp(s->reference[k].label, reference->label) == 0)
            break;
    return k;
}

/// Notes the run that a name is about.
static double note_name(void *user, const char *name)
{
    side *s = user;
    scree_reference reference;
    if (!scree_reference_read(name, &reference) || reference_index(s, &reference) < s->reference_count) return 1;
    s->too_many |= s->reference_count == MOST_REFERENCES;
    if (!s->too_many) s->reference[s->reference_count++] = reference;
    return 1;
}

static scree_status open_side(const question *q, const char *text, side *s)
{
    double value;
    *s = (side){.text = text};
    scree_status status = scree_expression_evaluate(text, note_name, s, &value, q->error);
    if (!status && s->too_many)
        status = scree_error_set(q->error, SCREE_ERROR_INPUT, "%s: results of more than %d runs in one value",
                                 q->statement->id, MOST_REFERENCES);
    return status ? status : scree_allocate(&s->value, q->findings->count + 1, sizeof *s->value, q->error);
}

/// The next run that `reference` means, behind `after` (NULL: the first); NULL when there is none. Of runs of the same
/// seed only the first counts.
static const scree_finding *next_run(const question *q, const scree_reference *reference, const scree_finding *after)
{
    const scree_finding *begin = q->findings->item, *end = begin + q->findings->count;
    for (const scree_finding *f = after ? after + 1 : begin; f < end; f++) {
        if (!scree_finding_is(f, reference, q->form)) continue;
        const scree_finding *first = begin;
        while (first->seed != f->seed || !scree_finding_is(first, reference, q->form)) first++;
        if (first == f) return f;
    }
    return NULL;
}

static const scree_finding *run_of_seed(const question *q, const scree_reference *reference, long long seed)
{
    const scree_finding *f = next_run(q, reference, NULL);
    while (f && f->seed != seed) f = next_run(q, reference, f);
    return f && f->state == SCREE_FINDING_DONE ? f : NULL;
}

/// Number of runs of a reference: all, or those in one state.
static size_t count_runs(const question *q, const scree_reference *reference, int state)
{
    size_t count = 0;
    for (const scree_finding *f = next_run(q, reference, NULL); f; f = next_run(q, reference, f))
        count += state < 0 || (int)f->state == state;
    return count;
}

static double look_up(void *user, const char *name)
{
    question *q = user;
    scree_reference reference;
    char text[64], *end;
    if (!scree_reference_read(name, &reference)) return NAN;
    const scree_finding *run = q->run[reference_index(q->side, &reference)];
    if (scree_result_get(run->directory, reference.result, text, sizeof text, NULL)) {
        memcpy(q->missing, reference.result, sizeof q->missing);
        return NAN;
    }
    double value = strtod(text, &end);
    return end != text && !*end ? value : NAN;
}

/// Whether every run of this seed is there; *same says whether all had one sample.
static bool gather_runs(question *q, const side *s, long long seed, bool *same)
{
    *same = true;
    for (size_t k = 0; k < s->reference_count; k++) {
        q->run[k] = run_of_seed(q, &s->reference[k], seed);
        if (!q->run[k]) return false;
        *same &= q->statement->deterministic || scree_finding_same_sample(q->run[0], q->run[k]);
    }
    return true;
}

/// One value for each sample.
static scree_status evaluate(question *q, side *s)
{
    scree_status status = SCREE_OK;
    const scree_finding *f = next_run(q, &s->reference[0], NULL);
    for (; f && !status; f = next_run(q, &s->reference[0], f)) {
        bool same;
        double value;
        if (!gather_runs(q, s, f->seed, &same)) continue;
        s->strangers += !same;
        if (!same) continue;
        s->samples++;
        q->side = s;
        status = scree_expression_evaluate(s->text, look_up, q, &value, q->error);
        if (!status && isfinite(value)) s->value[s->count++] = value;
    }
    return status;
}

/// Whether a name begins in text[from, to): a letter that does not belong to a number.
static bool has_name(const char *text, size_t from, size_t to)
{
    for (size_t i = from; i < to; i++)
        if (isalpha((unsigned char)text[i]) &&
            (i == from || (!isdigit((unsigned char)text[i - 1]) && text[i - 1] != '.')))
            return true;
    return false;
}

/// Whether the value is results over results.
static bool is_quotient(const char *text)
{
    scree_expression_split split = scree_expression_take_apart(text);
    return split.sign == '/' && has_name(text, 0, split.left) && has_name(text, split.right, strlen(text));
}

/// Takes logarithms in place where the statement is about a ratio; false when it is not, or when a value is not
/// positive.
static bool take_logarithms(const question *q, side *s, bool *not_positive)
{
    const scree_statement *statement = q->statement;
    if (statement->kind == SCREE_CRITERION_HOLDS || statement->average == SCREE_AVERAGE_PLAIN) return false;
    if (statement->average == SCREE_AVERAGE_AUTO && !is_quotient(statement->value)) return false;
    for (size_t i = 0; i < s->count; i++) *not_positive |= s->value[i] <= 0;
    if (*not_positive) return false;
    for (size_t i = 0; i < s->count; i++) s->value[i] = log(s->value[i]);
    return true;
}

/// The interval of what was evaluated sample by sample.
static scree_interval settle(const question *q, side *s)
{
    double confidence = scree_statement_confidence(q->statement);
    bool not_positive = false;
    if (q->statement->kind == SCREE_CRITERION_HOLDS) {
        for (size_t i = 0; i < s->count; i++) q->answer->successes += s->value[i] > 0.5;
        if (!q->statement->deterministic && s->count > 1)
            return scree_interval_proportion(q->answer->successes, s->count, confidence);
    }
    if (q->statement->deterministic) return scree_interval_range(s->value, s->count);
    bool logarithms = take_logarithms(q, s, &not_positive);
    if (not_positive) remark(q->answer, "plain mean: not all ratios are positive");
    scree_interval interval = scree_interval_mean(s->value, s->count, confidence);
    return logarithms ? scree_interval_exponential(interval) : interval;
}

/// From two groups of samples: of logarithms for a quotient, which otherwise has no interval here.
static scree_interval settle_apart(question *q, side sides[2], char sign)
{
    double confidence = scree_statement_confidence(q->statement);
    if (sign == '/') {
        bool not_positive = false;
        for (int k = 0; k < 2; k++)
            for (size_t i = 0; i < sides[k].count; i++) {
                not_positive |= sides[k].value[i] <= 0;
                sides[k].value[i] = log(sides[k].value[i]);
            }
        if (not_positive) {
            remark(q->answer, "a ratio of values that are not all positive has no interval");
            return (scree_interval){NAN, NAN, NAN, sides[0].count < sides[1].count ? sides[0].count : sides[1].count};
        }
    }
    for (size_t i = 0; sign == '+' && i < sides[1].count; i++) sides[1].value[i] = -sides[1].value[i];
    scree_interval interval =
        scree_interval_difference(sides[0].value, sides[0].count, sides[1].value, sides[1].count, confidence);
    return sign == '/' ? scree_interval_exponential(interval) : interval;
}

/// Means of both sides of a quotient, a sum or a difference, whose runs did not have the same samples.
static scree_status compare_apart(question *q)
{
    const char *text = q->statement->value;
    scree_expression_split split = scree_expression_take_apart(text);
    side sides[2] = {{0}, {0}};
    char *left = NULL;
    q->answer->verdict = SCREE_UNDECIDED;
    remark(q->answer, "not of the same samples");
    if (!split.sign || !strchr("/+-", split.sign)) return SCREE_OK;
    scree_status status = scree_allocate(&left, split.left + 1, 1, q->error);
    if (!status) memcpy(left, text, split.left);
    if (!status) status = open_side(q, left, &sides[0]);
    if (!status) status = open_side(q, text + split.right, &sides[1]);
    bool apart = sides[0].reference_count > 0 && sides[1].reference_count > 0;
    for (int k = 0; k < 2 && apart && !status; k++) status = evaluate(q, &sides[k]);
    if (!status && apart && sides[0].strangers + sides[1].strangers == 0) {
        q->answer->interval = settle_apart(q, sides, split.sign);
        remark(q->answer, "means of %zu and %zu compared", sides[0].count, sides[1].count);
        const bool mixed = sides[0].samples == 0 || sides[1].samples == 0;
        if (mixed) remark(q->answer, "one side mixes samples: put those of one kind into brackets, a - (b + c)");
        if (sides[0].count == 0 || sides[1].count == 0) q->answer->verdict = SCREE_NOT_MEASURED;
    }
    for (int k = 0; k < 2; k++) scree_release(&sides[k].value);
    scree_release(&left);
    return status;
}

// ---- remarks -----------------------------------------------------------------------------------------------------

/// Texts that are not the same, at most so many.
typedef struct names {
    char text[MOST_NAMED][64];
    size_t count;
} names;

static void names_add(names *n, const char *text)
{
    for (size_t k = 0; k < n->count && k < MOST_NAMED; k++)
        if (strncmp(n->text[k], text, sizeof n->text[k] - 1) == 0) return;
    if (n->count < MOST_NAMED) (void)snprintf(n->text[n->count], sizeof n->text[n->count], "%s", text);
    n->count++;
}

static void remark_names(scree_answer *answer, const char *what, const names *n)
{
    char list[MOST_NAMED * 66] = "";
    size_t used = 0;
    if (n->count < 2) return;
    for (size_t k = 0; k < n->count && k < MOST_NAMED; k++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", k > 0 ? ", " : "",
                                 n->text[k][0] ? n->text[k] : "unknown");
    remark(answer, "%s: %s%s", what, list, n->count > MOST_NAMED ? ", ..." : "");
}

static void add_number(names *n, double value)
{
    char text[40] = "unknown";
    if (isfinite(value)) (void)snprintf(text, sizeof text, "%.4g", value);
    names_add(n, text);
}

/// Builds and preparations where they are not the same, or not those of the sweep now, what was too fast, what failed.
static void remark_runs(const question *q, const side *s)
{
    names builds = {0}, frictions = {0};
    size_t failed = 0, done = 0, hasty = 0;
    bool sample = false, other = false, seeds = false;
    for (size_t k = 0; k < s->reference_count; k++) {
        names sizes = {0};
        for (const scree_finding *f = next_run(q, &s->reference[k], NULL); f; f = next_run(q, &s->reference[k], f)) {
            failed += f->state == SCREE_FINDING_FAILED;
            if (f->state != SCREE_FINDING_DONE) continue;
            done++;
            hasty += f->hasty;
            sample |= f->other_sample;
            other |= f->other_case[0];
            seeds |= f->other_seed;
            names_add(&builds, f->build);
            add_number(&frictions, f->friction);
            add_number(&sizes, f->particles);
        }
        remark_names(q->answer, "particles differ", &sizes);
    }
    remark_names(q->answer, "builds differ", &builds);
    remark_names(q->answer, "preparations differ, friction of the confinement", &frictions);
    if (sample || other) remark(q->answer, "of another %s than the case has now", sample ? "preparation" : "setting");
    if (seeds) remark(q->answer, SCREE_ORIGIN_SEEDS);
    if (hasty > 0) remark(q->answer, "not quasistatic by their own account: %zu of %zu runs", hasty, done);
    if (failed > 0) remark(q->answer, "%zu failed", failed);
}

/// Whether every run that the statement needs is there at least once; a remark when not.
static bool has_runs(const question *q, const side *s)
{
    bool all = s->reference_count > 0;
    for (size_t k = 0; k < s->reference_count; k++) {
        const scree_reference *r = &s->reference[k];
        size_t planned = count_runs(q, r, -1), failed = count_runs(q, r, SCREE_FINDING_FAILED);
        if (planned > q->answer->planned) q->answer->planned = planned;
        if (count_runs(q, r, SCREE_FINDING_DONE) > 0) continue;
        if (all && failed > 0)
            remark(q->answer, "%s%s%s: %zu of %zu failed", r->name, r->label[0] ? "/" : "", r->label, failed, planned);
        else if (all)
            remark(q->answer, "%s%s%s is not there", r->name, r->label[0] ? "/" : "", r->label);
        all = false;
    }
    return all;
}

/// What is said of samples that have no value, or of too few.
static void judge(const question *q, const side *s)
{
    scree_answer *answer = q->answer;
    size_t count = answer->interval.count;
    if (answer->verdict == SCREE_NOT_MEASURED && q->missing[0]) remark(answer, "no result '%s'", q->missing);
    if (answer->verdict == SCREE_NOT_MEASURED) return;
    if (s->samples > s->count) remark(answer, "%zu without a value", s->samples - s->count);
    if (count == 1 && !q->statement->deterministic) remark(answer, "one sample: no interval");
    answer->verdict = scree_verdict_of(q->statement, &answer->interval);
}

// ---- ensembles ---------------------------------------------------------------------------------------------------

/// Results of ensembles that an expression names, in its order.
typedef struct naming {
    const question *q;
    scree_ensemble_value value[SCREE_ENSEMBLE_NAMES];
    size_t group_runs[SCREE_ENSEMBLE_NAMES]; ///< of each reference of the side
    size_t count, others;                    ///< names, and those of single runs
    char missing[160];
} naming;

/// The averages over the most members of a point, where several folders have some.
static size_t find_ensemble(const question *q, const scree_reference *reference, const char **folder, size_t *done)
{
    size_t most = 0;
    *done = 0;
    for (const scree_finding *f = next_run(q, reference, NULL); f; f = next_run(q, reference, f)) {
        const bool known = most > 0 && strcmp(f->ensemble, *folder) == 0;
        const size_t runs = known ? 0 : scree_ensemble_runs(f->ensemble);
        *done += f->state == SCREE_FINDING_DONE;
        if (runs > most) *folder = f->ensemble;
        if (runs > most) most = runs;
    }
    return most;
}

static double note_ensemble(void *user, const char *name)
{
    naming *n = user;
    const char *folder = "", *result;
    size_t done;
    scree_reference reference;
    if (!scree_reference_read(name, &reference)) return 1;
    const bool one = scree_reference_is_ensemble(&reference);
    n->others += !one;
    if (!one || n->count == SCREE_ENSEMBLE_NAMES) return 1;
    result = reference.result + sizeof SCREE_ENSEMBLE_PREFIX - 1;
    const size_t group = reference_index(n->q->side, &reference),
                 runs = find_ensemble(n->q, &reference, &folder, &done);
    if (runs != done && n->group_runs[group] == 0)
        remark(n->q->answer, "averages over %zu of the %zu runs that are done: call `scree sweep --collect`", runs,
               done);
    n->group_runs[group] = runs;
    scree_ensemble_value *value = &n->value[n->count++];
    *value = scree_ensemble_get(folder, result);
    value->group = group;
    if (isnan(value->middle)) (void)snprintf(n->missing, sizeof n->missing, "%.150s", reference.result);
    return 1;
}

/// Least number of runs of the ensembles that are meant.
static size_t fewest_runs(const naming *n)
{
    size_t fewest = SIZE_MAX;
    for (size_t k = 0; k < n->count; k++)
        if (n->group_runs[n->value[k].group] < fewest) fewest = n->group_runs[n->value[k].group];
    return n->count > 0 ? fewest : 0;
}

/// An expression of averages over members, which has one value and its interval.
static scree_status settle_ensembles(question *q, side *s, bool *mine)
{
    naming n = {.q = q};
    double ignored;
    scree_interval *interval = &q->answer->interval;
    q->side = s;
    scree_status status = scree_expression_evaluate(q->statement->value, note_ensemble, &n, &ignored, q->error);
    *mine = n.count > 0;
    if (status || n.count == 0) return status;
    q->answer->verdict = SCREE_NOT_MEASURED;
    if (n.others > 0 || n.count == SCREE_ENSEMBLE_NAMES || q->statement->kind == SCREE_CRITERION_HOLDS) {
        q->answer->verdict = SCREE_UNDECIDED;
        remark(q->answer, "results of ensembles make no value with those of single runs, nor `holds`");
        return SCREE_OK;
    }
    if (n.missing[0]) remark(q->answer, "no result '%s'", n.missing);
    if (n.missing[0]) return SCREE_OK;
    status = scree_ensemble_evaluate(q->statement->value, n.value, n.count, &interval->middle, &interval->low,
                                     &interval->high, q->error);
    interval->count = fewest_runs(&n);
    if (q->statement->deterministic) interval->low = interval->high = interval->middle;
    const bool few = interval->count < SCREE_ENSEMBLE_FEWEST && !q->statement->deterministic;
    q->answer->few = few;
    q->answer->verdict = few ? SCREE_UNDECIDED : scree_verdict_of(q->statement, interval);
    if (few) remark(q->answer, SCREE_ANSWER_FEW " %d samples have no interval of 95 %%", SCREE_ENSEMBLE_FEWEST);
    return status;
}

scree_status scree_answer_find(const scree_findings *findings, const scree_statement *statement,
                               scree_finding_form form, scree_answer *answer, scree_error *error)
{
    question q = {.findings = findings, .statement = statement, .form = form, .answer = answer, .error = error};
    side whole;
    *answer = (scree_answer){.verdict = SCREE_NOT_RUN, .interval = {NAN, NAN, NAN, 0}};
    scree_status status = open_side(&q, statement->value, &whole);
    bool there = !status && has_runs(&q, &whole), ensemble = false;
    if (there) status = settle_ensembles(&q, &whole, &ensemble);
    if (there && ensemble && !status) remark_runs(&q, &whole);
    if (there && !ensemble && !status) {
        status = evaluate(&q, &whole);
        bool one_sample = whole.strangers == 0 && (whole.samples > 0 || whole.reference_count == 1);
        if (!status && one_sample) {
            answer->verdict = whole.count > 0 ? SCREE_UNDECIDED : SCREE_NOT_MEASURED;
            if (whole.count > 0) answer->interval = settle(&q, &whole);
        } else if (!status) {
            whole.samples = whole.count = 0;
            status = compare_apart(&q);
        }
        if (!status) judge(&q, &whole);
        if (!status) remark_runs(&q, &whole);
    }
    scree_release(&whole.value);
    return status;
}
