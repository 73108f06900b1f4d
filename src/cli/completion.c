/// Completion for bash, made from the table of verbs.
#include "cli/help.h"

/// A shell command that prints the candidates for a value of this kind, NULL when there are none to offer.
static const char *candidates(scree_value_kind kind)
{
    switch (kind) {
    case SCREE_VALUE_FILE:
        return "compgen -f -- \"$word\"";
    case SCREE_VALUE_FOLDER:
        return "compgen -d -- \"$word\"";
    case SCREE_VALUE_CASE:
        return "compgen -f -X '!*.y*ml' -- \"$word\"; compgen -d -S / -- \"$word\"; "
               "compgen -W \"$(scree list | cut -d ' ' -f 1)\" -- \"$word\"";
    case SCREE_VALUE_BUILTIN:
        return "compgen -W \"$(scree list | cut -d ' ' -f 1)\" -- \"$word\"";
    case SCREE_VALUE_SWEEP:
        return "compgen -f -X '!*.y*ml' -- \"$word\"; compgen -d -S / -- \"$word\"; "
               "compgen -W \"$(scree list --sweeps | cut -d ' ' -f 1)\" -- \"$word\"";
    case SCREE_VALUE_RESULT:
        return "compgen -W \"$(scree get \"${COMP_WORDS[2]}\" 2>/dev/null | cut -d ' ' -f 1)\" -- \"$word\"";
    case SCREE_VALUE_FIGURE:
        return "compgen -W \"$(scree plot \"${COMP_WORDS[2]}\" --list 2>/dev/null | cut -d ' ' -f 1)\" -- \"$word\"";
    case SCREE_VALUE_VERB:
        return "compgen -W \"$verbs\" -- \"$word\"";
    case SCREE_VALUE_TEXT:
        break;
    }
    return NULL;
}

/// A case of the shell's `case "$verb $previous"`: the value of an option.
static void write_value(FILE *file, const scree_verb *verb, const scree_verb_option *row)
{
    const char *command = candidates(row->kind);
    if (!row->value) return;
    fprintf(file, "    \"%s --%s\"", verb->name, row->name);
    if (row->letter) fprintf(file, "|\"%s -%c\"", verb->name, row->letter);
    if (command)
        fprintf(file, ") mapfile -t COMPREPLY < <(%s); return;;\n", command);
    else
        fprintf(file, ") return;;\n");
}

static void write_verb(FILE *file, const scree_verb *verb)
{
    fprintf(file, "    %s)\n        if [[ $word == -* ]]; then\n            mapfile -t COMPREPLY < <(compgen -W \"",
            verb->name);
    for (const scree_verb_option *row = verb->option; row->name; row++) fprintf(file, "--%s ", row->name);
    for (const scree_verb_option *row = scree_common_options; row->name; row++) fprintf(file, "--%s ", row->name);
    fprintf(file, "\" -- \"$word\")\n            return\n        fi\n");
    // Words before the cursor tell the argument; good enough for verbs whose options mostly follow it.
    for (size_t i = 0; verb->argument[i].name; i++) {
        const char *command = candidates(verb->argument[i].kind);
        bool last = !verb->argument[i + 1].name;
        fprintf(file, "        ");
        if (!last) fprintf(file, "[[ $COMP_CWORD -eq %zu ]] && ", i + 2);
        fprintf(file, "mapfile -t COMPREPLY < <(%s)%s\n", command ? command : "true", last ? "" : " && return");
    }
    fprintf(file, "        ;;\n");
}

void scree_help_write_completion(FILE *file)
{
    fprintf(file,
            "# Completion of scree for bash, made by `scree help --completion bash`.\n"
            "_scree() {\n"
            "    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}\n"
            "    local verbs='");
    for (size_t i = 0; i < scree_verbs_count; i++) fprintf(file, "%s%s", i > 0 ? " " : "", scree_verbs[i].name);
    fprintf(file, "'\n"
                  "    COMPREPLY=()\n"
                  "    if [[ $COMP_CWORD -eq 1 ]]; then\n"
                  "        mapfile -t COMPREPLY < <(compgen -W \"$verbs --help --version\" -- \"$word\")\n"
                  "        return\n"
                  "    fi\n"
                  "    case \"$verb $previous\" in\n");
    for (size_t i = 0; i < scree_verbs_count; i++)
        for (const scree_verb_option *row = scree_verbs[i].option; row->name; row++)
            write_value(file, &scree_verbs[i], row);
    fprintf(file, "    esac\n    case $verb in\n");
    for (size_t i = 0; i < scree_verbs_count; i++) write_verb(file, &scree_verbs[i]);
    fprintf(file, "    esac\n}\ncomplete -o filenames -F _scree scree\n");
}
