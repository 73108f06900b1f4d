/// Recursive descent:
///     comparison = sum [ (< | <= | > | >=) sum ]      sum     = product { (+ | -) product }
///     product    = factor { (* | /) factor }          factor  = - factor | number | name | ( comparison )
#include "sweep/expression.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 32 };

typedef struct parser {
    const char *text, *at;
    scree_expression_lookup *lookup;
    void *user;
    int depth;
    scree_expression_split split; ///< of the outermost operator that binds least, the last of its kind
    scree_status status;
    scree_error *error;
} parser;

static double comparison(parser *p);

static double refuse(parser *p, const char *what)
{
    if (!p->status)
        p->status = scree_error_set(p->error, SCREE_ERROR_INPUT, "%s at '%.40s' in '%s'", what,
                                    *p->at ? p->at : "the end", p->text);
    return NAN;
}

static void skip_space(parser *p)
{
    while (*p->at == ' ') p->at++;
}

/// Takes `sign` when it comes next.
static bool take(parser *p, char sign)
{
    skip_space(p);
    if (*p->at != sign) return false;
    p->at++;
    return true;
}

static int strength(char sign)
{
    return sign == '*' || sign == '/' ? 2 : sign == '+' || sign == '-' ? 1 : 0;
}

/// Takes an operator, and notes where it stands.
static bool take_operator(parser *p, char sign)
{
    if (!take(p, sign)) return false;
    if (p->depth == 0 && (!p->split.sign || strength(sign) <= strength(p->split.sign)))
        p->split = (scree_expression_split){sign, (size_t)(p->at - p->text) - 1, (size_t)(p->at - p->text)};
    return true;
}

static double number(parser *p)
{
    // Hexadecimal numbers, infinities and signs are not numbers here.
    size_t digits = strspn(p->at, "0123456789.");
    char *end;
    double value = strtod(p->at, &end);
    if (end == p->at || (size_t)(end - p->at) < digits || (p->at[0] == '0' && (p->at[1] == 'x' || p->at[1] == 'X')))
        return refuse(p, "this is not a number");
    p->at = end;
    return value;
}

static double name(parser *p)
{
    char text[SCREE_EXPRESSION_NAME];
    size_t length = 0;
    while (isalnum((unsigned char)p->at[length]) || (p->at[length] && strchr("_/.=-", p->at[length]))) length++;
    if (length >= sizeof text) return refuse(p, "this name is too long");
    memcpy(text, p->at, length);
    text[length] = 0;
    p->at += length;
    return p->status ? NAN : p->lookup(p->user, text);
}

static double factor(parser *p)
{
    double value;
    skip_space(p);
    if (p->status) return NAN;
    if (++p->depth > DEEPEST) return refuse(p, "nested too deep");
    if (take(p, '-')) {
        value = -factor(p);
    } else if (take(p, '(')) {
        value = comparison(p);
        if (!p->status && !take(p, ')')) value = refuse(p, "a ')' is missing");
    } else if (isdigit((unsigned char)*p->at) || *p->at == '.') {
        value = number(p);
    } else if (isalpha((unsigned char)*p->at)) {
        value = name(p);
    } else {
        value = refuse(p, "a number or a name is missing");
    }
    p->depth--;
    return value;
}

static double product(parser *p)
{
    double value = factor(p);
    while (!p->status) {
        if (take_operator(p, '*'))
            value *= factor(p);
        else if (take_operator(p, '/'))
            value /= factor(p);
        else
            break;
    }
    return value;
}

static double sum(parser *p)
{
    double value = product(p);
    while (!p->status) {
        if (take_operator(p, '+'))
            value += product(p);
        else if (take_operator(p, '-'))
            value -= product(p);
        else
            break;
    }
    return value;
}

static double comparison(parser *p)
{
    double left = sum(p);
    bool less = !p->status && take_operator(p, '<');
    bool more = !p->status && !less && take_operator(p, '>');
    if (!less && !more) return left;
    bool equal = *p->at == '=';
    p->at += equal;
    if (p->depth == 0) p->split.right += equal;
    double right = sum(p);
    if (isnan(left) || isnan(right)) return NAN;
    return (less ? left < right : left > right) || (equal && left == right);
}

scree_status scree_expression_evaluate(const char *text, scree_expression_lookup *lookup, void *user, double *value,
                                       scree_error *error)
{
    parser p = {.text = text, .at = text, .lookup = lookup, .user = user, .error = error};
    *value = comparison(&p);
    skip_space(&p);
    if (!p.status && *p.at) (void)refuse(&p, "this is not expected");
    if (p.status) *value = NAN;
    return p.status;
}

static double one(void *user, const char *name)
{
    (void)user, (void)name;
    return 1;
}

scree_expression_split scree_expression_take_apart(const char *text)
{
    scree_error error;
    parser p = {.text = text, .at = text, .lookup = one, .error = &error};
    (void)comparison(&p);
    skip_space(&p);
    return p.status || *p.at ? (scree_expression_split){0} : p.split;
}
