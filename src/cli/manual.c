/// The man page, made from the table of verbs: roff with the `man` macros, as groff and mandoc read it.
#include "cli/help.h"

#include <string.h>

/// Escapes text for roff: backslashes, the dashes of options, control characters at the start of a line. A backquote
/// switches between roman and bold. The empty line between paragraphs becomes a macro.
static void write_text(FILE *file, const char *text)
{
    bool bold = false, line_start = true;
    for (; *text; text++) {
        if (strncmp(text, "\n\n", 2) == 0) {
            fprintf(file, "\n.PP\n");
            text++;
            line_start = true;
            continue;
        }
        if (*text == '`') {
            bold = !bold;
            fputs(bold ? "\\fB" : "\\fR", file);
        } else if (*text == '\\') {
            fputs("\\e", file);
        } else if (*text == '-') {
            fputs("\\-", file);
        } else if (line_start && (*text == '.' || *text == '\'')) {
            fprintf(file, "\\&%c", *text);
        } else {
            fputc(*text, file);
        }
        line_start = false;
    }
    fputc('\n', file);
}

static void write_term(FILE *file, const char *term, const char *meaning)
{
    fprintf(file, ".TP\n.B ");
    write_text(file, term);
    write_text(file, meaning);
}

static void write_option(FILE *file, const scree_verb_option *row)
{
    fprintf(file, ".TP\n");
    if (row->letter) fprintf(file, "\\fB\\-%c\\fR, ", row->letter);
    fprintf(file, "\\fB\\-\\-");
    for (const char *letter = row->name; *letter; letter++) fputs(*letter == '-' ? "\\-" : (char[]){*letter, 0}, file);
    fprintf(file, "\\fR%s%s%s\n", row->value ? " \\fI" : "", row->value ? row->value : "", row->value ? "\\fR" : "");
    write_text(file, row->meaning);
    if (row->preset) fprintf(file, "(default: %s)\n", row->preset);
}

static void write_verb(FILE *file, const scree_verb *verb)
{
    char usage[160];
    scree_help_usage(verb, usage, sizeof usage);
    fprintf(file, ".SS scree %s\n", usage);
    write_text(file, verb->text);
    for (const scree_verb_argument *row = verb->argument; row->name; row++) write_term(file, row->name, row->meaning);
    for (const scree_verb_option *row = verb->option; row->name; row++) write_option(file, row);
    fprintf(file, ".PP\nExit status: 0");
    for (const int *status = verb->status; *status; status++) fprintf(file, ", %d", *status);
    fprintf(file, ".\n");
    for (const scree_verb_example *row = verb->example; row->line; row++) {
        fprintf(file, ".PP\nExample, ");
        write_text(file, row->meaning);
        fprintf(file, ".PP\n.RS 4\n.nf\n");
        write_text(file, row->line);
        fprintf(file, ".fi\n.RE\n");
    }
}

void scree_help_write_manual(FILE *file)
{
    fprintf(file, ".\\\" Made by `scree help --man` from the table of verbs.\n");
    fprintf(file, ".TH SCREE 1 \"\" \"Scree %s\" \"Scree\"\n.SH NAME\nscree \\- ", SCREE_VERSION);
    fprintf(file, "discrete\\-element laboratory for granular matter\n.SH SYNOPSIS\n");
    for (size_t i = 0; scree_verb_at(i); i++) {
        char usage[160];
        scree_help_usage(scree_verb_at(i), usage, sizeof usage);
        fprintf(file, "%s.B scree\n%s\n", i > 0 ? ".br\n" : "", usage);
    }
    fprintf(file, ".SH DESCRIPTION\n");
    write_text(file, scree_purpose);
    fprintf(file, ".SH VERBS\n");
    for (size_t i = 0; scree_verb_at(i); i++) write_verb(file, scree_verb_at(i));
    fprintf(file, ".SH OPTIONS\n");
    for (const scree_verb_option *row = scree_common_options; row->name; row++) write_option(file, row);
    fprintf(file, ".TP\n\\fB\\-V\\fR, \\fB\\-\\-version\\fR\nprint the version, the compiler and the instruction set "
                  "in use; only without a verb\n");
    fprintf(file, ".SH EXIT STATUS\n");
    for (const scree_exit_status *row = scree_exit_statuses; row->meaning; row++) {
        char number[16];
        (void)snprintf(number, sizeof number, "%d", row->status);
        write_term(file, number, row->meaning);
    }
    fprintf(file, ".SH ENVIRONMENT\n");
    for (const scree_verb_example *row = scree_environment; row->line; row++) write_term(file, row->line, row->meaning);
    fprintf(file, ".SH COPYRIGHT\nGPL\\-3.0\\-or\\-later.\n");
}
