/// The case reference as Markdown, from the schema.
#include "case/check.h"

#include <string.h>

static const char introduction[] =
    "# Case reference\n"
    "\n"
    "<!-- Generated from the schema table (src/case/schema.c); a test compares. -->\n"
    "\n"
    "A case is a YAML file. `scree list` shows the built-in cases, `scree new biaxial > my.yaml` writes one to start "
    "from,\n"
    "and `scree check my.yaml` says everything that is wrong with it, with line, column and what is accepted.\n"
    "\n"
    "- **Values with units** are text: `100 kPa`, `0.75 mm`, `5e-3 1/s`, `10 %`. Any unit of the right dimension that\n"
    "  udunits2 knows will do. A bare number is in SI units, given in the column *unit*.\n"
    "- **auto** leaves a value to Scree, where the column *default* says so.\n"
    "- **Flags** are `yes` or `no` (`true` and `false` too). **Names** are made of letters, digits, `_` and `-`, a "
    "letter first.\n"
    "- **Schedules** follow time. A value stays. A table `[[0 s, 0 mm/s], [1 s, 5 mm/s]]` is linear between its rows "
    "and\n"
    "  constant beyond them; its times increase; `gate.csv` beside the case file holds one too, with a first line\n"
    "  `time [s], velocity [mm/s]` where its numbers are not in SI units (`time` may stand anywhere in it), and the "
    "resolved\n"
    "  case holds the rows. A ramp is\n"
    "  `{from: 0 mm/s, to: 5 mm/s, begin: 0 s, end: 1 s, smooth: yes}`, a harmonic\n"
    "  `{amplitude: 1 mm, frequency: 50 1/s, phase: 0 degrees, mean: 0 mm}`. Vectors are `[0, -9.81 m/s2]` or tables "
    "with\n"
    "  two or three values a row.\n"
    "- **Key paths** join keys with dots. Elements of lists are called by number, from 0, or by name: "
    "`stages.2.rate`,\n"
    "  `stages.compress.rate`, `materials.quartz.friction`. Several stages of one kind are called `compress_1`,\n"
    "  `compress_2`, unless they have a `name`.\n"
    "- **--set path=value** overrules the file, also where it does not have the key. A value that begins with `[` or "
    "`{` is\n"
    "  read as YAML: `--set 'measure.windows=[[1 %, 3 %]]'`.\n"
    "- **quick** holds key paths and values that count with `--quick` and are checked always; `--set` overrules them.\n"
    "- A key that is unknown, given twice, or **not used** with the choices made is an error. Only where `quick` or\n"
    "  `--set` makes a choice, the keys that the file had for its own choice are left out silently.\n"
    "- Anchors, aliases, tags, several documents and files above 1 MiB are not accepted.\n";

static void write_when(FILE *file, const scree_key *key)
{
    for (const char *when = key->when; when; when = scree_next_condition(when)) {
        size_t equals = strcspn(when, "=");
        if (strncmp(when + equals, "=[]", 3) == 0 || strcmp(when + equals, "=given") == 0) {
            (void)fprintf(file, " Only with%s `%.*s", when[equals + 1] == '[' ? "out" : "", (int)equals, when);
            continue;
        }
        (void)fprintf(file, "%s `%.*s: ", when == key->when ? " Only with" : "` and", (int)equals, when);
        for (const char *c = when + equals + 1; *c && *c != '&'; c++)
            (void)(*c == '|' ? fputs("` or `", file) : fputc(*c, file));
    }
    if (key->when) (void)fputs("`.", file);
}

static const char *type_name(scree_key_type type)
{
    static const char *const names[] = {
        [SCREE_KEY_NUMBER] = "number",     [SCREE_KEY_INTEGER] = "integer",   [SCREE_KEY_TEXT] = "text",
        [SCREE_KEY_WORD] = "name",         [SCREE_KEY_FLAG] = "flag",         [SCREE_KEY_CHOICE] = "choice",
        [SCREE_KEY_VECTOR] = "vector",     [SCREE_KEY_PAIRS] = "pairs",       [SCREE_KEY_SECTION] = "section",
        [SCREE_KEY_LIST] = "list",         [SCREE_KEY_VALUES] = "values",     [SCREE_KEY_PATHS] = "key paths",
        [SCREE_KEY_TENSOR] = "components", [SCREE_KEY_SCHEDULE] = "schedule",
    };
    return names[type];
}

static void write_default(FILE *file, const scree_key *key)
{
    bool section = key->type == SCREE_KEY_SECTION || key->type == SCREE_KEY_PATHS;
    if (section || (key->standard && !key->standard[0]))
        (void)fputs("", file);
    else if (key->standard)
        (void)fprintf(file, "`%s`", key->standard);
    else
        (void)fputs("required", file);
}

/// One table of keys, then the choices of those that have some, and tables of the lists in it.
static void write_table(FILE *file, const scree_section *section)
{
    (void)fputs("\n| key | type | unit | default | accepted | meaning |\n|---|---|---|---|---|---|\n", file);
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        char limits[200];
        scree_limits_text(key, limits, sizeof limits);
        (void)fprintf(file, "| `%s` | %s | %s | ", key->name, type_name(key->type), key->unit ? key->unit : "");
        write_default(file, key);
        (void)fprintf(file, " | %s | %s", limits, key->meaning);
        write_when(file, key);
        (void)fputs(" |\n", file);
    }
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        if (key->type != SCREE_KEY_CHOICE || strcmp(key->name, "stage") == 0) continue;
        (void)fprintf(file, "\nChoices of `%s`:\n\n", key->name);
        for (const scree_choice *choice = key->choices; choice->name; choice++)
            (void)fprintf(file, "- `%s`: %s\n", choice->name, choice->meaning);
    }
    for (size_t i = 0; i < section->count && section != scree_schema(); i++) {
        const scree_key *key = &section->keys[i];
        if (key->type != SCREE_KEY_LIST) continue;
        (void)fprintf(file, "\nKeys of each element of `%s`:\n", key->name);
        write_table(file, key->sections);
    }
}

static void write_list(FILE *file, const scree_key *key)
{
    (void)fprintf(file, "\n## %s\n\n%s A list: each element starts with `- `.\n", key->name, key->meaning);
    if (key->section_count == 1) {
        write_table(file, key->sections);
        return;
    }
    (void)fprintf(file, "The key `%s` says which kind it is:\n\n", key->sections[0].keys[0].name);
    for (const scree_choice *choice = key->sections[0].keys[0].choices; choice->name; choice++)
        (void)fprintf(file, "- `%s`: %s\n", choice->name, choice->meaning);
    for (size_t i = 0; i < key->section_count; i++) {
        (void)fprintf(file, "\n### %s\n\n%s\n", key->sections[i].name, key->sections[i].meaning);
        write_table(file, &key->sections[i]);
    }
}

scree_status scree_schema_write_manual(FILE *file, scree_error *error)
{
    (void)fprintf(file, "%s\n## The case\n", introduction);
    write_table(file, scree_schema());
    for (size_t i = 0; i < scree_schema()->count; i++) {
        const scree_key *key = &scree_schema()->keys[i];
        if (key->type == SCREE_KEY_LIST) write_list(file, key);
        if (key->type != SCREE_KEY_SECTION) continue;
        (void)fprintf(file, "\n## %s\n\n%s\n", key->name, key->sections->meaning);
        write_table(file, key->sections);
    }
    if (fflush(file) != 0 || ferror(file))
        return scree_error_set_errno(error, SCREE_ERROR_IO, "the case reference cannot be written");
    return SCREE_OK;
}
