/// The verb `help`, and help as text, wrapped at 80 columns.
#include "cli/help.h"

#include "cli/command.h"
#include "cli/terminal.h"

#include <string.h>

enum { WIDTH = 80, TERM_WIDTH = 26 };

/// Prints paragraphs wrapped at WIDTH; the cursor stands in `column`, new lines begin at `indent`.
static void write_wrapped(FILE *file, const char *text, size_t column, size_t indent)
{
    while (*text) {
        size_t length = strcspn(text, " \n");
        if (column > indent && column + 1 + length > WIDTH) {
            fprintf(file, "\n%*s", (int)indent, "");
            column = indent;
        }
        column += (size_t)fprintf(file, "%s%.*s", column > indent ? " " : "", (int)length, text);
        text += length;
        if (strncmp(text, "\n\n", 2) == 0) {
            fprintf(file, "\n\n%*s", (int)indent, "");
            column = indent;
        }
        text += strspn(text, " \n");
    }
    fputc('\n', file);
}

/// "  term     meaning", the meaning on its own line when the term is long.
static void write_term(FILE *file, const char *term, const char *meaning)
{
    fprintf(file, "  %-*s", TERM_WIDTH - 2, term);
    if (strlen(term) > TERM_WIDTH - 4) fprintf(file, "\n%*s", TERM_WIDTH, "");
    write_wrapped(file, meaning, TERM_WIDTH, TERM_WIDTH);
}

void scree_help_usage(const scree_verb *verb, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "%s%s", verb->name, verb->option[0].name ? " [OPTION]..." : "");
    for (const scree_verb_argument *row = verb->argument; row->name && used < size; row++)
        used += (size_t)snprintf(text + used, size - used, row->optional ? " [%s]%s" : " %s%s", row->name,
                                 row->repeated ? "..." : "");
}

void scree_help_write(FILE *file)
{
    fprintf(file, "Usage: scree VERB [OPTION]... [ARGUMENT]...\n\n");
    write_wrapped(file, scree_purpose, 0, 0);
    fprintf(file, "\nVerbs:\n");
    for (size_t i = 0; scree_verb_at(i); i++) write_term(file, scree_verb_at(i)->name, scree_verb_at(i)->meaning);
    fprintf(file, "\nOptions:\n");
    write_term(file, "-h, --help", "print this help; `scree VERB --help` tells about one verb");
    write_term(file, "-V, --version", "print the version");
    fprintf(file, "\nExit status:\n");
    for (const scree_exit_status *row = scree_exit_statuses; row->meaning; row++) {
        char number[16];
        (void)snprintf(number, sizeof number, "%d", row->status);
        write_term(file, number, row->meaning);
    }
    fprintf(file, "\nEnvironment:\n");
    for (const scree_verb_example *row = scree_environment; row->line; row++) write_term(file, row->line, row->meaning);
    fprintf(file, "\nA first run:\n");
    fprintf(file, "  scree new biaxial > my.yaml\n  scree run my.yaml --quick -o out\n  scree get out\n");
}

static void write_options(FILE *file, const scree_verb_option *row)
{
    for (; row->name; row++) {
        char term[80], meaning[256];
        char letter[8] = "    ";
        if (row->letter) (void)snprintf(letter, sizeof letter, "-%c, ", row->letter);
        (void)snprintf(term, sizeof term, "%s--%s%s%s", letter, row->name, row->value ? " " : "",
                       row->value ? row->value : "");
        (void)snprintf(meaning, sizeof meaning, "%s%s%s%s", row->meaning, row->preset ? " (default: " : "",
                       row->preset ? row->preset : "", row->preset ? ")" : "");
        write_term(file, term, meaning);
    }
}

void scree_help_write_verb(FILE *file, const scree_verb *verb)
{
    char usage[160];
    scree_help_usage(verb, usage, sizeof usage);
    fprintf(file, "Usage: scree %s\n\n", usage);
    write_wrapped(file, verb->text, 0, 0);
    if (verb->argument[0].name) fprintf(file, "\nArguments:\n");
    for (const scree_verb_argument *row = verb->argument; row->name; row++) write_term(file, row->name, row->meaning);
    fprintf(file, "\nOptions:\n");
    write_options(file, verb->option);
    write_options(file, scree_common_options);
    fprintf(file, "\nExit status:\n");
    write_term(file, "0", scree_exit_status_meaning(SCREE_OK));
    for (const int *status = verb->status; *status; status++) {
        char number[16];
        (void)snprintf(number, sizeof number, "%d", *status);
        write_term(file, number, scree_exit_status_meaning(*status));
    }
    fprintf(file, "\nExamples:\n");
    for (const scree_verb_example *row = verb->example; row->line; row++)
        fprintf(file, "  %s\n      %s\n", row->line, row->meaning);
}

/// The first word of a verb of two: length, else 0.
static size_t group_of(const scree_verb *verb)
{
    const char *space = strchr(verb->name, ' ');
    return space ? (size_t)(space - verb->name) : 0;
}

static bool is_group(const char *word)
{
    for (size_t i = 0; scree_verb_at(i); i++) {
        const size_t length = group_of(scree_verb_at(i));
        if (length > 0 && strlen(word) == length && strncmp(scree_verb_at(i)->name, word, length) == 0) return true;
    }
    return false;
}

/// `name` is no verb; in_group: its first word is that of a group.
static void refuse_verb(const char *name, bool in_group)
{
    const char *names[32];
    size_t count = 0;
    scree_error error;
    char accepted[sizeof error.accepted] = "";
    for (size_t i = 0; scree_verb_at(i) && count < sizeof names / sizeof names[0]; i++) {
        if (in_group && strncmp(scree_verb_at(i)->name, name, strcspn(name, " ")) != 0) continue;
        size_t used = strlen(accepted);
        names[count++] = scree_verb_at(i)->name;
        (void)snprintf(accepted + used, sizeof accepted - used, "%s%s", count > 1 ? ", " : "", scree_verb_at(i)->name);
    }
    const char *nearest = scree_nearest(name, names, count);
    scree_command_refuse(&error, name, nearest ? nearest : accepted, "there is no such verb");
    (void)scree_terminal_error(NULL, &error);
}

const scree_verb *scree_verb_match(size_t count, const char *const *words, size_t *used)
{
    char name[128];
    const bool in_group = is_group(words[0]), second = in_group && count > 1 && words[1][0] != '-';
    (void)snprintf(name, sizeof name, "%s%s%s", words[0], second ? " " : "", second ? words[1] : "");
    *used = second ? 2 : 1;
    const scree_verb *verb = scree_verb_find(name);
    if (!verb) refuse_verb(name, in_group);
    return verb;
}

bool scree_help_write_group(FILE *file, size_t count, const char *const *words, bool second)
{
    if (count != (second ? 2 : 1) || !is_group(words[0])) return false;
    if (second && strcmp(words[1], "--help") != 0 && strcmp(words[1], "-h") != 0) return false;
    const size_t length = strlen(words[0]);
    fprintf(file, "Usage: scree %s NAME [OPTION...]\n\nVerbs of this group:\n", words[0]);
    for (size_t i = 0; scree_verb_at(i); i++)
        if (group_of(scree_verb_at(i)) == length && strncmp(scree_verb_at(i)->name, words[0], length) == 0)
            write_term(file, scree_verb_at(i)->name, scree_verb_at(i)->meaning);
    fprintf(file, "\n`scree %s NAME --help` says more.\n", words[0]);
    return true;
}

scree_status scree_verb_help(const scree_command *command)
{
    scree_error error = {0};
    const char *shell = scree_command_value(command, "completion");
    const bool named = command->argument_count > 0;
    int asked = scree_command_has(command, "man") + (shell != NULL) + scree_command_has(command, "case-reference");
    if (asked + named > 1) {
        scree_command_refuse(&error, "", "", "one of VERB, --man, --completion and --case-reference at a time");
        return scree_terminal_error("help", &error);
    }
    if (shell && strcmp(shell, "bash") != 0) {
        scree_command_refuse(&error, "--completion", "bash", "there is no completion for '%s'", shell);
        return scree_terminal_error("help", &error);
    }
    if (scree_command_has(command, "case-reference")) {
        scree_status status = scree_schema_write_manual(stdout, &error);
        return status ? scree_terminal_error("help", &error) : SCREE_OK;
    }
    if (scree_help_write_group(stdout, command->argument_count, command->argument, false)) return SCREE_OK;
    size_t used = 0;
    const scree_verb *verb = named ? scree_verb_match(command->argument_count, command->argument, &used) : NULL;
    if (named && !verb) return SCREE_ERROR_INPUT;
    if (used < command->argument_count) {
        scree_command_refuse(&error, "", "", "'%s' is one argument too many", command->argument[used]);
        return scree_terminal_error("help", &error);
    }
    if (verb)
        scree_help_write_verb(stdout, verb);
    else if (shell)
        scree_help_write_completion(stdout);
    else if (asked)
        scree_help_write_manual(stdout);
    else
        scree_help_write(stdout);
    return SCREE_OK;
}
