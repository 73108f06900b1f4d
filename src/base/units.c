/// Values with units. The number is read here (decimal, C locale), the unit by udunits2. Only proportional units count:
/// offsets ("degC", "m @ 3"), logarithms and udunits' reciprocals ("s" for "1/s") are refused.
#include "base/units.h"

#include "base/checksum.h"
#include "base/memory.h"

#include <udunits2.h>

#include <ctype.h>
#include <errno.h>
#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { LONGEST_UNIT = 48, LONGEST_NUMBER = 400, SHOWN = 60 };

typedef struct quantity {
    const char *unit, *noun, *example;
} quantity;

/// Names of dimensions, in the order in which they are tried.
static const quantity quantities[] = {
    {"1", "a plain number", "0.3 or 30 %"},
    {"m", "a length", "0.5 mm"},
    {"s", "a time", "2 ms"},
    {"Pa", "a pressure", "100 kPa"},
    {"kg/m3", "a density", "2650 kg/m3"},
    {"1/s", "a rate", "1e-2 1/s"},
    {"rad/s", "an angular velocity", "0.03 rad/s"},
    {"m/s", "a velocity", "5 mm/s"},
    {"m/s2", "an acceleration", "9.81 m/s2"},
    {"rad", "an angle", "30 degrees"},
    {"kg", "a mass", "2 g"},
    {"N", "a force", "10 kN"},
    {"N m", "a torque", "2 N m"},
    {"N/m", "a stiffness", "10 N/mm"},
    {"Pa s", "a viscosity", "1e9 Pa s"},
    {"J", "an energy", "3 J"},
    {"J/m2", "a surface energy", "0.05 J/m2"},
    {"W", "a power", "3 W"},
    {"m2", "an area", "2 mm2"},
    {"m3", "a volume", "2 mm3"},
    {"kg/m2", "an area density", "5 kg/m2"},
    {"K", "a temperature", "300 K"},
};

/// Units that people write in the wrong case.
static const char *const common_units[] = {"Pa", "kPa", "MPa", "GPa", "m",  "cm", "mm", "um", "nm", "km", "s",
                                           "ms", "us",  "min", "h",   "kg", "g",  "mg", "N",  "kN", "J",  "kg/m3"};

static const quantity *quantity_of(const char *unit)
{
    for (size_t i = 0; i < sizeof quantities / sizeof *quantities; i++)
        if (strcmp(quantities[i].unit, unit) == 0) return &quantities[i];
    return NULL;
}

const char *scree_units_quantity(const char *unit)
{
    const quantity *known = quantity_of(unit);
    return known ? known->noun : "a value";
}

const char *scree_units_example(const char *unit)
{
    const quantity *known = quantity_of(unit);
    return known ? known->example : unit;
}

/// Length of the decimal number that `text` begins with, 0 if none: sign, digits, point, exponent. No hexadecimal,
/// "inf" or "nan". "3 e-2" and "3em" have the number 3.
static size_t number_length(const char *text)
{
    size_t at = strspn(text, "+-") > 0 ? 1 : 0;
    size_t whole = strspn(text + at, "0123456789");
    at += whole;
    size_t part = 0;
    if (text[at] == '.') {
        part = strspn(text + at + 1, "0123456789");
        at += whole + part > 0 ? 1 + part : 0;
    }
    if (whole + part == 0) return 0;
    if (text[at] == 'e' || text[at] == 'E') {
        size_t sign = text[at + 1] == '+' || text[at + 1] == '-';
        size_t digits = strspn(text + at + 1 + sign, "0123456789");
        at += digits > 0 ? 1 + sign + digits : 0;
    }
    return at;
}

/// Bytes of `text` to show in a message: at most 60, whole characters.
static int shown(const char *text)
{
    size_t length = strlen(text);
    if (length <= SHOWN) return (int)length;
    length = SHOWN;
    while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80) length--;
    return (int)length;
}

/// Whether `unit` may be handed to udunits2: short, and without its dates, offsets and numeric factors ("2 m"), except
/// the leading "1/" of "1/s".
static bool is_plausible(const char *unit)
{
    if (strlen(unit) > LONGEST_UNIT) return false;
    const char *rest = strncmp(unit, "1/", 2) == 0 ? unit + 2 : unit;
    for (const char *c = rest; *c; c++) {
        bool letter = isalpha((unsigned char)*c) || (unsigned char)*c >= 0x80;
        bool factor = c == rest || strchr(" ./(", c[-1]) || (c[-1] == '*' && (c - 1 == rest || c[-2] != '*'));
        if (isdigit((unsigned char)*c) && factor) return false;
        if (!letter && !isdigit((unsigned char)*c) && !strchr("%/*^.-+() ", *c)) return false;
    }
    return *rest != 0;
}

static pthread_mutex_t udunits_lock = PTHREAD_MUTEX_INITIALIZER;
static ut_system *unit_system; ///< guarded by udunits_lock, never changed once it is loaded

/// The unit of `text`, or NULL. The lock is held.
static ut_unit *unit_of(const char *text)
{
    // The Greek letter mu and the micro sign look the same; udunits2 knows the plain letter too. "/s" is 1/s.
    char plain[2 * LONGEST_UNIT + 8] = "";
    size_t length = 0;
    if (text[0] == '/') plain[length++] = '1';
    while (*text) {
        bool micro = strncmp(text, "\u00b5", 2) == 0 || strncmp(text, "\u03bc", 2) == 0;
        plain[length++] = micro ? 'u' : *text;
        text += micro ? 2 : 1;
    }
    return ut_parse(unit_system, plain, UT_UTF8);
}

/// Whether a unit's definition holds the radian, which udunits2 takes for a plain number.
static bool is_angular(const ut_unit *unit)
{
    char definition[256];
    int length = ut_format(unit, definition, sizeof definition, UT_ASCII | UT_DEFINITION);
    return length > 0 && (size_t)length < sizeof definition && strstr(definition, "rad");
}

/// Factor from one unit to another when they are proportional, else 0.
static double factor_between(const ut_unit *from, const ut_unit *to)
{
    if (!ut_are_convertible(from, to) || is_angular(from) != is_angular(to)) return 0;
    cv_converter *converter = ut_get_converter((ut_unit *)from, (ut_unit *)to);
    if (!converter) return 0;
    double zero = cv_convert_double(converter, 0), one = cv_convert_double(converter, 1);
    cv_free(converter);
    // Neither offsets nor logarithms nor reciprocals map 0 to 0.
    return zero == 0 && isfinite(one) && one > 0 ? one : 0;
}

typedef enum lookup { FOUND, UNKNOWN_UNIT, OTHER_DIMENSION, NO_DATABASE, NO_MEMORY } lookup;

/// What reading the database takes, and a lookup, with room to spare: udunits2 2.2.28 keeps 0.5 MB. Where memory runs
/// out inside of it, it ends the program.
enum { DATABASE_BYTES = 2 << 20, LOOKUP_BYTES = 1 << 16 };

/// Factor from `text` to the SI `unit`; `noun` is set when the dimension is another one. The lock is held.
static lookup find_factor(const char *text, const char *unit, double *factor, const char **noun)
{
    if (scree_memory_check(unit_system ? LOOKUP_BYTES : DATABASE_BYTES, NULL)) return NO_MEMORY;
    errno = 0;
    if (!unit_system) unit_system = ut_read_xml(NULL);
    if (!unit_system) return errno == ENOMEM ? NO_MEMORY : NO_DATABASE;
    ut_unit *given = is_plausible(text) ? unit_of(text) : NULL;
    ut_unit *wanted = unit_of(unit);
    *factor = given && wanted ? factor_between(given, wanted) : 0;
    lookup result = *factor > 0 ? FOUND : given ? OTHER_DIMENSION : UNKNOWN_UNIT;
    *noun = NULL;
    for (size_t i = 0; result == OTHER_DIMENSION && !*noun && i < sizeof quantities / sizeof *quantities; i++) {
        ut_unit *tried = unit_of(quantities[i].unit);
        if (tried && factor_between(given, tried) > 0) *noun = quantities[i].noun;
        ut_free(tried);
    }
    ut_free(given);
    ut_free(wanted);
    return result != FOUND && errno == ENOMEM ? NO_MEMORY : result;
}

/// Factors that were found, each in the place of its hash, where the next one of that hash takes its place. A case has
/// some hundred values with a few dozen units between them, and the limits of its keys; udunits2 takes ten times as
/// long as all else that reads them. Guarded by udunits_lock.
enum { KNOWN_FACTORS = 256 };
static struct {
    char text[LONGEST_UNIT + 2], unit[LONGEST_UNIT + 2];
    double factor; ///< 0: none
} known_factors[KNOWN_FACTORS];

static size_t known_place(const char *text, const char *unit)
{
    const uint64_t hash = scree_checksum_bytes(scree_checksum_bytes(0, text, strlen(text)), unit, strlen(unit));
    return (size_t)(hash % KNOWN_FACTORS);
}

/// The lock is held.
static bool is_known(const char *text, const char *unit, double *factor)
{
    const size_t k = known_place(text, unit);
    if (!(known_factors[k].factor > 0) || strcmp(known_factors[k].text, text) != 0 ||
        strcmp(known_factors[k].unit, unit) != 0)
        return false;
    *factor = known_factors[k].factor;
    return true;
}

static void know(const char *text, const char *unit, double factor)
{
    const size_t k = known_place(text, unit);
    if (strlen(text) >= sizeof known_factors[k].text || strlen(unit) >= sizeof known_factors[k].unit) return;
    (void)snprintf(known_factors[k].text, sizeof known_factors[k].text, "%s", text);
    (void)snprintf(known_factors[k].unit, sizeof known_factors[k].unit, "%s", unit);
    known_factors[k].factor = factor;
}

static lookup find_factor_alone(const char *text, const char *unit, double *factor, const char **noun)
{
    pthread_mutex_lock(&udunits_lock);
    if (is_known(text, unit, factor)) {
        pthread_mutex_unlock(&udunits_lock);
        return FOUND;
    }
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    locale_t before = uselocale(c_locale);
    ut_error_message_handler loud = ut_set_error_message_handler(ut_ignore);
    lookup result = find_factor(text, unit, factor, noun);
    if (result == FOUND) know(text, unit, *factor);
    ut_set_error_message_handler(loud);
    uselocale(before);
    freelocale(c_locale);
    pthread_mutex_unlock(&udunits_lock);
    return result;
}

static scree_status refuse_unit(const char *text, const char *unit_text, const char *unit, lookup result,
                                const char *noun, scree_error *error)
{
    const char *quantity_noun = scree_units_quantity(unit), *example = scree_units_example(unit);
    if (result == NO_MEMORY) return scree_error_set_memory(error, unit_system ? LOOKUP_BYTES : DATABASE_BYTES);
    if (result == NO_DATABASE)
        return scree_error_set(error, SCREE_ERROR_IO,
                               "the unit database of udunits2 cannot be read (Debian package libudunits2-data)");
    if (result == OTHER_DIMENSION && noun)
        return scree_error_set(error, SCREE_ERROR_INPUT, "'%.*s' is %s; expected %s, e.g. %s", shown(text), text, noun,
                               quantity_noun, example);
    if (result == OTHER_DIMENSION)
        return scree_error_set(error, SCREE_ERROR_INPUT, "'%.*s' has the wrong dimension; expected %s, e.g. %s",
                               shown(text), text, quantity_noun, example);
    if (unit_text[0] == ',' && isdigit((unsigned char)unit_text[1]))
        return scree_error_set(error, SCREE_ERROR_INPUT, "'%.*s' has a decimal comma; write a point, e.g. %s",
                               shown(text), text, example);
    for (size_t i = 0; i < sizeof common_units / sizeof *common_units; i++)
        if (strcasecmp(unit_text, common_units[i]) == 0)
            return scree_error_set(error, SCREE_ERROR_INPUT, "unknown unit '%s'; did you mean '%s'?", unit_text,
                                   common_units[i]);
    return scree_error_set(error, SCREE_ERROR_INPUT, "unknown unit '%.*s'; expected %s, e.g. %s", shown(unit_text),
                           unit_text, quantity_noun, example);
}

/// Factors are products of decimal prefixes that carry round-off: a factor next to a whole number is that number, and
/// one next to the inverse of a whole number divides by it. So "7 %" is the double nearest to 0.07, as "0.07" is.
static double scaled(double number, double factor)
{
    bool is_part = factor < 1;
    double whole = rint(is_part ? 1 / factor : factor);
    bool is_whole = whole < 1e15 && fabs((is_part ? whole * factor : factor / whole) - 1) < 1e-14;
    if (!is_whole) return number * factor + 0.0;
    return (is_part ? number / whole : number * whole) + 0.0;
}

/// The number at the head of `text`, which has `length` bytes, in the C locale.
static double number_of(const char *text, size_t length)
{
    char digits[LONGEST_NUMBER + 1];
    memcpy(digits, text, length);
    digits[length] = 0;
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    double number = strtod_l(digits, NULL, c_locale);
    freelocale(c_locale);
    return number;
}

scree_status scree_units_parse(const char *text, const char *unit, double *value, scree_error *error)
{
    const char *start = text + strspn(text, " ");
    size_t length = number_length(start);
    if (length == 0 || length > LONGEST_NUMBER)
        return scree_error_set(error, SCREE_ERROR_INPUT, "'%.*s' is not a number; expected %s, e.g. %s", shown(text),
                               text, scree_units_quantity(unit), scree_units_example(unit));
    double number = number_of(start, length), factor = 1;
    char unit_text[LONGEST_UNIT + 2];
    (void)snprintf(unit_text, sizeof unit_text, "%s", start + length + strspn(start + length, " "));
    size_t end = strlen(unit_text);
    while (end > 0 && unit_text[end - 1] == ' ') unit_text[--end] = 0;
    if (end > 0 && strcmp(unit_text, unit) != 0) {
        const char *noun = NULL;
        lookup result = find_factor_alone(unit_text, unit, &factor, &noun);
        if (result != FOUND) return refuse_unit(text, unit_text, unit, result, noun, error);
    }
    double si = scaled(number, factor);
    if (!isfinite(si))
        return scree_error_set(error, SCREE_ERROR_INPUT, "'%.*s' is too large for a computer number", shown(text),
                               text);
    *value = si;
    return SCREE_OK;
}
