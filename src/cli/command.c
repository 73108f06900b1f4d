/// Reading a command line against the table of verbs. No abbreviations: what is nearly an option is suggested, not
/// taken.
#include "cli/command.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

scree_status scree_command_refuse(scree_error *error, const char *field, const char *accepted, const char *format, ...)
{
    va_list arguments;
    memset(error, 0, sizeof *error);
    error->status = SCREE_ERROR_INPUT;
    (void)snprintf(error->field, sizeof error->field, "%s", field);
    (void)snprintf(error->accepted, sizeof error->accepted, "%s", accepted);
    va_start(arguments, format);
    (void)vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    return SCREE_ERROR_INPUT;
}

/// By its letter, or, with two dashes, by its whole name.
static const scree_verb_option *find_in(const scree_verb_option *row, const char *name, size_t length, bool longer)
{
    for (; row->name; row++) {
        if (!longer && row->letter == name[0]) return row;
        if (longer && strlen(row->name) == length && strncmp(row->name, name, length) == 0) return row;
    }
    return NULL;
}

static const scree_verb_option *find_option(const scree_verb *verb, const char *name, size_t length, bool longer)
{
    const scree_verb_option *found = find_in(verb->option, name, length, longer);
    return found ? found : find_in(scree_common_options, name, length, longer);
}

/// Says which option is nearest, or else which there are.
static scree_status refuse_option(const scree_verb *verb, const char *word, size_t length, scree_error *error)
{
    const char *names[2 * SCREE_VERB_ROWS];
    size_t count = 0;
    char given[64], accepted[sizeof error->accepted] = "";
    for (const scree_verb_option *row = verb->option; row->name; row++) names[count++] = row->name;
    for (const scree_verb_option *row = scree_common_options; row->name; row++) names[count++] = row->name;
    (void)snprintf(given, sizeof given, "%.*s", (int)(length < sizeof given ? length : sizeof given - 1), word);
    const char *nearest = scree_nearest(given + strspn(given, "-"), names, count);
    if (nearest) {
        names[0] = nearest;
        count = 1;
    }
    for (size_t i = 0; i < count; i++) {
        size_t used = strlen(accepted);
        (void)snprintf(accepted + used, sizeof accepted - used, "%s--%s", i > 0 ? ", " : "", names[i]);
    }
    return scree_command_refuse(error, given, accepted, "there is no such option");
}

/// Reads the option in words[*at], with its value; *at moves to the last word used.
static scree_status parse_option(scree_command *command, size_t count, char *const *words, size_t *at,
                                 scree_error *error)
{
    const char *word = words[*at];
    bool longer = word[1] == '-';
    const char *name = word + (longer ? 2 : 1);
    size_t length = longer ? strcspn(name, "=") : 1;
    const scree_verb_option *option = find_option(command->verb, name, length, longer);
    if (!option) return refuse_option(command->verb, word, (size_t)(name - word) + length, error);
    const char *value = name[length] ? name + length + (longer ? 1 : 0) : NULL;
    char shown[64];
    (void)snprintf(shown, sizeof shown, "--%s", option->name);
    if (value && !option->value) return scree_command_refuse(error, shown, shown, "this option takes no value");
    if (!value && option->value) {
        if (*at + 1 >= count) return scree_command_refuse(error, shown, option->value, "its value is missing");
        value = words[++*at];
    }
    command->option[command->option_count++] = (scree_command_option){option, value};
    return SCREE_OK;
}

static scree_status check_arguments(const scree_command *command, scree_error *error)
{
    size_t least = 0, most = 0;
    for (const scree_verb_argument *row = command->verb->argument; row->name; row++) {
        least += !row->optional;
        most = row->repeated ? SIZE_MAX : most + 1;
    }
    if (command->argument_count < least) {
        const scree_verb_argument *missing = &command->verb->argument[command->argument_count];
        return scree_command_refuse(error, missing->name, missing->meaning, "this argument is missing");
    }
    if (command->argument_count > most)
        return scree_command_refuse(error, "", "", "'%s' is one argument too many", command->argument[most]);
    return SCREE_OK;
}

scree_status scree_command_parse(const scree_verb *verb, size_t count, char *const *words, scree_command *command,
                                 scree_error *error)
{
    *command = (scree_command){.verb = verb};
    command->argument = calloc(count + 1, sizeof *command->argument);
    command->option = calloc(count + 1, sizeof *command->option);
    if (!command->argument || !command->option) {
        *error = (scree_error){.status = SCREE_ERROR_IO, .message = "out of memory"};
        return SCREE_ERROR_IO;
    }
    bool options_ended = false;
    for (size_t i = 0; i < count; i++) {
        scree_status status = SCREE_OK;
        if (!options_ended && strcmp(words[i], "--") == 0)
            options_ended = true;
        else if (!options_ended && words[i][0] == '-' && words[i][1])
            status = parse_option(command, count, words, &i, error);
        else
            command->argument[command->argument_count++] = words[i];
        if (status) return status;
    }
    return scree_command_has(command, "help") ? SCREE_OK : check_arguments(command, error);
}

void scree_command_free(scree_command *command)
{
    free(command->argument);
    free(command->option);
    *command = (scree_command){0};
}

bool scree_command_has(const scree_command *command, const char *name)
{
    for (size_t i = 0; i < command->option_count; i++)
        if (strcmp(command->option[i].option->name, name) == 0) return true;
    return false;
}

size_t scree_command_values(const scree_command *command, const char *name, const char **values)
{
    size_t count = 0;
    for (size_t i = 0; i < command->option_count; i++)
        if (strcmp(command->option[i].option->name, name) == 0) values[count++] = command->option[i].value;
    return count;
}

const char *scree_command_value(const scree_command *command, const char *name)
{
    for (size_t i = command->option_count; i > 0; i--)
        if (strcmp(command->option[i - 1].option->name, name) == 0) return command->option[i - 1].value;
    return NULL;
}

scree_status scree_command_number(const scree_command *command, const char *name, long least, long most, long *value,
                                  scree_error *error)
{
    const char *text = scree_command_value(command, name);
    char *end, field[64], accepted[80];
    if (!text) return SCREE_OK;
    errno = 0;
    long number = strtol(text, &end, 10);
    (void)snprintf(field, sizeof field, "--%s", name);
    (void)snprintf(accepted, sizeof accepted, "a number from %ld to %ld", least, most);
    if (end == text || *end || errno || number < least || number > most)
        return scree_command_refuse(error, field, accepted, "'%s' is not a number of %s", text, name);
    *value = number;
    return SCREE_OK;
}

scree_status scree_command_real(const scree_command *command, const char *name, double *value, scree_error *error)
{
    const char *text = scree_command_value(command, name);
    char *end, field[64];
    if (!text) return SCREE_OK;
    *value = strtod(text, &end);
    (void)snprintf(field, sizeof field, "--%s", name);
    return end == text || *end || !isfinite(*value)
               ? scree_command_refuse(error, field, "a number in SI units", "'%s' is no number", text)
               : SCREE_OK;
}

scree_status scree_command_choice(const scree_command *command, const char *name, const char *const *words,
                                  size_t *index, scree_error *error)
{
    const char *text = scree_command_value(command, name);
    char field[64], accepted[200] = "";
    if (!text) return SCREE_OK;
    for (size_t k = 0; words[k]; k++) {
        if (strcmp(text, words[k]) == 0) {
            *index = k;
            return SCREE_OK;
        }
        (void)snprintf(accepted + strlen(accepted), sizeof accepted - strlen(accepted), "%s%s", k > 0 ? ", " : "",
                       words[k]);
    }
    (void)snprintf(field, sizeof field, "--%s", name);
    return scree_command_refuse(error, field, accepted, "'%s' is not one of its values", text);
}
