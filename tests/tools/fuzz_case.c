/// Mutates the built-in cases and reads them: fuzz_case COUNT SEED. Prints how many were accepted and rejected. Each
/// accepted case must be written and read again; each rejected one must have problems with a message. Exit status 1
/// otherwise. Build it under the address sanitizer to find what lies beyond. Numbers come from Philox: the same seed,
/// the same files.
#include "base/random.h"

#include <scree/scree.h>

#include <stdlib.h>
#include <string.h>

/// What libfyaml and udunits2 lose themselves on malformed text (16 kB in 100,000 files) is not Scree's to free.
/// Exported, else the sanitizer does not see it.
SCREE_API const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libfyaml\nleak:libudunits2\n";
}

enum { LARGEST = 1 << 16, MOST_CHANGES = 4 };

typedef struct sample {
    char text[LARGEST];
    size_t length;
} sample;

/// Numbers of one file: the counter runs on.
typedef struct source {
    uint64_t seed, counter;
} source;

static size_t below(source *s, size_t limit)
{
    uint32_t words[4];
    scree_random_words(s->seed, SCREE_RANDOM_TEST, s->counter++, words);
    return limit ? ((uint64_t)words[1] << 32 | words[0]) % limit : 0;
}

/// Replaces `removed` bytes at `at` by `added` bytes of `text`; nothing when it would grow too large.
static void splice(sample *f, size_t at, size_t removed, const char *text, size_t added)
{
    if (at > f->length || removed > f->length - at || f->length - removed + added > LARGEST) return;
    char copy[LARGEST];
    if (added > sizeof copy) return;
    memcpy(copy, text, added); // `text` may lie in the sample
    memmove(f->text + at + added, f->text + at + removed, f->length - at - removed);
    memcpy(f->text + at, copy, added);
    f->length += added - removed;
}

static size_t line_start(const sample *f, size_t at)
{
    while (at > 0 && f->text[at - 1] != '\n') at--;
    return at;
}

static size_t line_end(const sample *f, size_t at)
{
    while (at < f->length && f->text[at] != '\n') at++;
    return at < f->length ? at + 1 : at;
}

static const char *const tokens[] = {
    "1e400",
    "-1",
    "nan",
    "inf",
    "1e-320",
    "-0",
    "99999999999999999999",
    "0x10",
    "100 kPa",
    "3 m",
    "5 s",
    "10 %",
    "auto",
    "yes",
    "no",
    "~",
    "null",
    "[",
    "]",
    "{",
    "}",
    "[[",
    ": ",
    ":\n",
    "- ",
    "? ",
    "|\n",
    ">\n",
    "&a ",
    "*a",
    "!!str ",
    "\"",
    "'",
    "\\",
    "\t",
    "\r\n",
    "#",
    "%",
    "---\n",
    "...\n",
    "%YAML 1.2\n",
    "\xff",
    "\xc2\xb5",
    "\xef\xbb\xbf",
    "@",
    "`",
    "stages:",
    "quick:",
    "materials:",
    "name:",
    "stage: confine\n",
    "law: hertz_brilliantov\n",
    "radius: 1 mm\n",
    "distribution: equal\n",
    "\"\\u0000\"",
    "\"\\ud800\"",
    "\"\\x07\"",
    "<<: ",
    "1/s",
    "m3",
    "kg/m3",
    "@ 3",
    "since 1990",
    "particles.count: 3\n",
    "  ",
    "\n",
    "\n\n  ",
    ",",
    "1,5",
    "1 000",
};

static const char *const settings[] = {
    "contact.law=hertz_brilliantov",
    "particles.distribution=equal",
    "particles.radius=1 mm",
    "stages.2.name=load",
    "stages.1.stage=prepare",
    "stages.compress.rate=5 1/s",
    "measure.windows=[]",
    "measure.windows=[[1 %, 2 %]]",
    "integrator.step=auto",
    "boundary.lateral=plates",
    "stages=[{stage: prepare, method: gas}]",
    "quick={}",
    "title=a: \"b\" #",
    "stages.0.method=gas",
    "gravity=[0, -9.81]",
    "materials.0.name=glass",
    "particles.count=nan",
    "a.b.c=1",
    "[=]",
    "=",
};

static void mutate(sample *f, source *s)
{
    size_t at = below(s, f->length + 1);
    size_t start = line_start(f, at), end = line_end(f, at), other = below(s, f->length + 1);
    const char *token = tokens[below(s, sizeof tokens / sizeof *tokens)];
    char byte = (char)below(s, 256);
    switch (below(s, 9)) {
    case 0: // flip a bit
        if (at < f->length) f->text[at] = (char)(f->text[at] ^ (1 << below(s, 8)));
        break;
    case 1:
        splice(f, at, at < f->length, &byte, 1);
        break;
    case 2:
        splice(f, at, 0, token, strlen(token));
        break;
    case 3:
        f->length = below(s, 8) == 0 ? at : f->length;
        break; // cut the rest off
    case 4:
        splice(f, end, 0, f->text + start, end - start);
        break; // duplicate a line
    case 5:
        splice(f, start, end - start, "", 0);
        break;
    case 6: // a piece from elsewhere
        splice(f, at, 0, f->text + other, below(s, f->length - other < 200 ? f->length - other + 1 : 200));
        break;
    case 7: { // replace the value of a line
        const char *colon = memchr(f->text + start, ':', end - start);
        if (!colon || end <= start) break;
        size_t value = (size_t)(colon - f->text) + 1;
        splice(f, value, end - value, "\n", 1);
        splice(f, value, 0, token, strlen(token));
        splice(f, value, 0, " ", 1);
        break;
    }
    default: { // many of one thing
        size_t times = below(s, 300);
        for (size_t i = 0; i < times; i++) splice(f, at, 0, token, strlen(token));
    }
    }
}

/// True when `c` can be written and what was written can be read.
static bool is_written_well(const scree_case *c)
{
    char *text = NULL;
    size_t length = 0;
    scree_error error;
    FILE *file = open_memstream(&text, &length);
    if (!file) return false;
    bool good = scree_case_write(c, file, &error) == SCREE_OK;
    good = fclose(file) == 0 && good;
    scree_case *again = NULL;
    scree_problems *problems = NULL;
    good = good && scree_case_parse(text, length, "written.yaml", NULL, &again, &problems) == SCREE_OK;
    if (!good && scree_problems_count(problems) > 0) {
        char line[2048];
        scree_error_format(scree_problems_get(problems, 0), line, sizeof line);
        fprintf(stderr, "%s\n", line);
    }
    scree_problems_free(problems);
    scree_case_free(again);
    free(text);
    return good;
}

/// 1 accepted, 0 rejected, -1 something is wrong with Scree.
static int try_sample(const sample *f, source *s)
{
    const char *overrides[2];
    for (size_t i = 0; i < 2; i++) overrides[i] = settings[below(s, sizeof settings / sizeof *settings)];
    scree_case_options options = {.overrides = overrides, .override_count = below(s, 4) == 0 ? 1 + below(s, 2) : 0};
    options.quick = below(s, 4) == 0;
    scree_case *c;
    scree_problems *problems;
    scree_status status = scree_case_parse(f->text, f->length, "fuzz.yaml", &options, &c, &problems);
    if (status == SCREE_OK) {
        bool good = is_written_well(c);
        scree_case_free(c);
        return good ? 1 : -1;
    }
    bool good = status == SCREE_ERROR_INPUT && !c && scree_problems_count(problems) > 0;
    for (size_t i = 0; i < scree_problems_count(problems); i++) {
        const scree_error *problem = scree_problems_get(problems, i);
        char line[2048];
        scree_error_format(problem, line, sizeof line);
        good = good && problem->message[0] && problem->status == SCREE_ERROR_INPUT;
    }
    scree_problems_free(problems);
    return good ? 0 : -1;
}

int main(int count, char **arguments)
{
    if (count != 3) {
        fprintf(stderr, "usage: fuzz_case COUNT SEED\n");
        return 2;
    }
    unsigned long long files = strtoull(arguments[1], NULL, 10), accepted = 0, wrong = 0;
    sample *f = malloc(sizeof *f);
    if (!f) return 4;
    for (unsigned long long i = 0; i < files; i++) {
        source s = {strtoull(arguments[2], NULL, 10), (uint64_t)i << 24};
        const char *name = scree_template_name(below(&s, scree_template_count()));
        f->length = strlen(scree_template_text(name));
        memcpy(f->text, scree_template_text(name), f->length);
        for (size_t changes = 1 + below(&s, MOST_CHANGES); changes > 0; changes--) mutate(f, &s);
        int result = try_sample(f, &s);
        accepted += result == 1;
        if (result >= 0) continue;
        fprintf(stderr, "file %llu is handled wrongly:\n%.*s\n", i, (int)f->length, f->text);
        wrong++;
    }
    printf("%llu files, %llu accepted, %llu rejected\n", files, accepted, files - accepted - wrong);
    (void)fflush(stdout); // before a leak checker may end the process
    free(f);
    return wrong > 0;
}
