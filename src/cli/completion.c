/// Completion for bash, made from the table of verbs.
#include "cli/help.h"

#include <string.h>

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
    case SCREE_VALUE_KEY:
        return "compgen -S = -W \"$(_scree_keys \"${COMP_WORDS[2]}\")\" -- \"$word\"";
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
    if (command && row->kind == SCREE_VALUE_KEY) fprintf(file, ") compopt -o nospace 2>/dev/null");
    if (command)
        fprintf(file, "%s mapfile -t COMPREPLY < <(%s); return;;\n", row->kind == SCREE_VALUE_KEY ? ";" : ")", command);
    else
        fprintf(file, ") return;;\n");
}

static void write_verb(FILE *file, const scree_verb *verb)
{
    const size_t words = strchr(verb->name, ' ') ? 2 : 1;
    fprintf(file, "    \"%s\")\n        if [[ $word == -* ]]; then\n            mapfile -t COMPREPLY < <(compgen -W \"",
            verb->name);
    for (const scree_verb_option *row = verb->option; row->name; row++) fprintf(file, "--%s ", row->name);
    for (const scree_verb_option *row = scree_common_options; row->name; row++) fprintf(file, "--%s ", row->name);
    fprintf(file, "\" -- \"$word\")\n            return\n        fi\n");
    // Words before the cursor tell the argument; good enough for verbs whose options mostly follow it.
    for (size_t i = 0; verb->argument[i].name; i++) {
        const char *command = candidates(verb->argument[i].kind);
        bool last = !verb->argument[i + 1].name;
        fprintf(file, "        ");
        if (!last) fprintf(file, "[[ $COMP_CWORD -eq %zu ]] && ", i + 1 + words);
        fprintf(file, "mapfile -t COMPREPLY < <(%s)%s\n", command ? command : "true", last ? "" : " && return");
    }
    fprintf(file, "        ;;\n");
}

/// Whether the verb of this number is the first one with its first word.
static bool is_first(size_t number)
{
    const size_t length = strcspn(scree_verb_at(number)->name, " ");
    for (size_t i = 0; i < number; i++)
        if (strcspn(scree_verb_at(i)->name, " ") == length &&
            strncmp(scree_verb_at(i)->name, scree_verb_at(number)->name, length) == 0)
            return false;
    return true;
}

static void write_first_words(FILE *file)
{
    for (size_t i = 0; scree_verb_at(i); i++)
        if (is_first(i))
            fprintf(file, "%s%.*s", i > 0 ? " " : "", (int)strcspn(scree_verb_at(i)->name, " "),
                    scree_verb_at(i)->name);
}

/// Of a group of verbs: its second words, and from there on both are the verb.
static void write_group(FILE *file, size_t number)
{
    const char *name = scree_verb_at(number)->name;
    const int length = (int)strcspn(name, " ");
    if (!name[length] || !is_first(number)) return;
    fprintf(file,
            "    %.*s)\n        if [[ $COMP_CWORD -eq 2 ]]; then\n            mapfile -t COMPREPLY < <(compgen -W \"",
            length, name);
    for (size_t i = number; scree_verb_at(i); i++)
        if (strncmp(scree_verb_at(i)->name, name, (size_t)length + 1) == 0)
            fprintf(file, "%s ", scree_verb_at(i)->name + length + 1);
    fprintf(file, "\" -- \"$word\")\n            return\n        fi\n        verb=\"$verb ${COMP_WORDS[2]}\";;\n");
}

/// The function that prints the paths of the keys of a case, from the form that `scree check` writes: lines "key:
/// value", sections and lists by the column they begin in. Items of lists are called by number, and by their name, else
/// their kind, numbered from 1 where there are several (case/usage.c).
static void write_keys(FILE *file)
{
    fputs("_scree_keys() {\n"
          "    scree check \"$1\" 2>/dev/null | awk '\n"
          "        { sub(/ +# .*/, \"\") }\n"
          "        match($0, /^ *(- )?[a-z_0-9]+:/) {\n"
          "            key = substr($0, 1, RLENGTH - 1); value = substr($0, RLENGTH + 2)\n"
          "            column = match(key, /[^ ]/) - 1; begins = key ~ /^ *- /\n"
          "            while (n > 0 && at[n] >= column) n--\n"
          "            if (begins) { at[++n] = column; path[n] = path[n - 1] items[path[n - 1]]++ \".\" }\n"
          "            sub(/^ *(- )?/, \"\", key)\n"
          "            if (begins && value ~ /^[a-z_]+$/) { kind[path[n]] = value; list[path[n]] = path[n - 1] }\n"
          "            if (key == \"name\" && value != \"auto\") name[path[n]] = value\n"
          "            if (value == \"\") { at[++n] = column; path[n] = path[n - 1] key \".\" } else leaf[++leaves] = "
          "path[n] key\n"
          "            if (begins) order[++entries] = path[n]\n"
          "        }\n"
          "        END {\n"
          "            for (i = 1; i <= entries; i++) {\n"
          "                p = order[i]; if ((p in kind) && !(p in name)) number[p] = ++all[list[p], kind[p]]\n"
          "            }\n"
          "            for (p in number) name[p] = kind[p] (all[list[p], kind[p]] > 1 ? \"_\" number[p] : \"\")\n"
          "            for (i = 1; i <= leaves; i++) {\n"
          "                k = split(leaf[i], part, \".\"); p = \"\"; by_name = \"\"\n"
          "                for (j = 1; j <= k; j++) {\n"
          "                    p = p part[j] \".\"\n"
          "                    by_name = by_name (j > 1 ? \".\" : \"\") ((p in name) && p != \"\" && part[j] ~ "
          "/^[0-9]/ ? name[p] : part[j])\n"
          "                }\n"
          "                print leaf[i]; if (by_name != leaf[i]) print by_name\n"
          "            }\n"
          "        }'\n"
          "}\n",
          file);
}

void scree_help_write_completion(FILE *file)
{
    fprintf(file, "# Completion of scree for bash, made by `scree help --completion bash`.\n");
    write_keys(file);
    fprintf(file,
            "_scree() {\n"
            "    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}\n"
            "    local verbs='");
    write_first_words(file);
    fprintf(file, "'\n"
                  "    COMPREPLY=()\n"
                  "    if [[ $COMP_CWORD -eq 1 ]]; then\n"
                  "        mapfile -t COMPREPLY < <(compgen -W \"$verbs --help --version\" -- \"$word\")\n"
                  "        return\n"
                  "    fi\n"
                  "    case $verb in\n");
    for (size_t i = 0; scree_verb_at(i); i++) write_group(file, i);
    fprintf(file, "    esac\n    case \"$verb $previous\" in\n");
    for (size_t i = 0; scree_verb_at(i); i++)
        for (const scree_verb_option *row = scree_verb_at(i)->option; row->name; row++)
            write_value(file, scree_verb_at(i), row);
    fprintf(file, "    esac\n    case $verb in\n");
    for (size_t i = 0; scree_verb_at(i); i++) write_verb(file, scree_verb_at(i));
    fprintf(file, "    esac\n}\ncomplete -o filenames -F _scree scree\n");
}
