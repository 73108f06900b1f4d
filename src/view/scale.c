/// Round numbers, percentiles and tick texts. Percentiles cost O(n log n) (sorting).
#include "view/scale.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double scree_round_below(double value)
{
    double power = pow(10, floor(log10(value)));
    double lead = value / power * (1 + 1e-12);
    return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void scree_sort(double *value, size_t count)
{
    if (count > 1) qsort(value, count, sizeof *value, compare);
}

double scree_quantile(const double *ascending, size_t count, double fraction)
{
    if (count == 0) return NAN;
    double place = fraction * (double)(count - 1);
    size_t below = (size_t)place;
    size_t above = below + 1 < count ? below + 1 : below;
    double part = place - (double)below;
    return ascending[below] * (1 - part) + ascending[above] * part;
}

/// Limits that are not an interval (equal values, or all but a few equal) become one; nothing but zeros goes up from 0.
static void widen(scree_limits *limits)
{
    if (limits->low < limits->high) return;
    limits->low = limits->smallest;
    limits->high = limits->largest;
    if (limits->low < limits->high) return;
    const double half = 0.1 * fabs(limits->low);
    limits->low -= half;
    limits->high += half == 0 ? 1 : half;
}

scree_status scree_limits_find(const double *value, size_t count, bool symmetric, scree_limits *limits,
                               scree_error *error)
{
    double *sorted;
    scree_status status = scree_allocate(&sorted, count, sizeof *sorted, error);
    if (status) return status;
    size_t finite = 0;
    for (size_t k = 0; k < count; k++)
        if (isfinite(value[k])) sorted[finite++] = value[k];
    *limits = (scree_limits){.low = -1, .high = 1, .smallest = NAN, .largest = NAN, .undefined = count - finite};
    scree_sort(sorted, finite);
    if (finite > 0) {
        limits->smallest = sorted[0];
        limits->largest = sorted[finite - 1];
        limits->low = scree_quantile(sorted, finite, 0.02);
        limits->high = scree_quantile(sorted, finite, 0.98);
        if (symmetric) {
            for (size_t k = 0; k < finite; k++) sorted[k] = fabs(sorted[k]);
            scree_sort(sorted, finite);
            limits->high = scree_quantile(sorted, finite, 0.98);
            if (limits->high == 0) limits->high = sorted[finite - 1];
            if (limits->high == 0) limits->high = 1;
            limits->low = -limits->high;
        }
        widen(limits);
        limits->clipped_low = limits->smallest < limits->low;
        limits->clipped_high = limits->largest > limits->high;
    }
    scree_release(&sorted);
    return SCREE_OK;
}

/// 10 to the `exponent` as text: superscript digits.
static void power_text(char *text, size_t size, int exponent)
{
    static const char *const digit[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char plain[16];
    (void)snprintf(plain, sizeof plain, "%d", exponent);
    (void)snprintf(text, size, "10");
    for (const char *c = plain; *c; c++) {
        size_t length = strlen(text);
        (void)snprintf(text + length, size - length, "%s", *c == '-' ? "⁻" : digit[*c - '0']);
    }
}

/// Fixed-point text with U+2212 as minus sign.
static void fixed_text(char *text, size_t size, double value, int decimals)
{
    char plain[400];
    (void)snprintf(plain, sizeof plain, "%.*f", decimals, fabs(value));
    bool zero = strspn(plain, "0.") == strlen(plain);
    (void)snprintf(text, size, "%s%s", value < 0 && !zero ? "−" : "", plain);
}

static int exponent_of(double value)
{
    return value == 0 ? 0 : (int)floor(log10(fabs(value)) + 1e-12);
}

scree_ticks scree_ticks_make(double low, double high)
{
    scree_ticks ticks = {0};
    double step = scree_round_below((high - low) / 3);
    double first = ceil(low / step - 1e-9), last = floor(high / step + 1e-9);
    int power = exponent_of(fmax(fabs(low), fabs(high)));
    if (power > -3 && power < 5) power = 0;
    int decimals = power - exponent_of(step);
    if (decimals < 0) decimals = 0;
    if (decimals > 12) decimals = 12;
    for (; ticks.count < SCREE_TICKS && first + ticks.count <= last; ticks.count++) {
        double value = (first + ticks.count) * step;
        ticks.value[ticks.count] = value;
        fixed_text(ticks.text[ticks.count], sizeof ticks.text[0], value * pow(10, -power), decimals);
    }
    if (power != 0) power_text(ticks.factor, sizeof ticks.factor, power);
    return ticks;
}

void scree_number_text(char *text, size_t size, double value, int digits)
{
    int power = exponent_of(value);
    if (!isfinite(value)) {
        (void)snprintf(text, size, "%s", isnan(value) ? "undefined" : value < 0 ? "−∞" : "∞");
    } else if (value == 0) {
        (void)snprintf(text, size, "0");
    } else if (power > 4 || power < -3) {
        char mantissa[32], factor[32];
        fixed_text(mantissa, sizeof mantissa, value * pow(10, -power), digits - 1);
        power_text(factor, sizeof factor, power);
        (void)snprintf(text, size, "%s×%s", mantissa, factor);
    } else {
        int decimals = digits - 1 - power;
        fixed_text(text, size, value, decimals < 0 ? 0 : decimals);
    }
}

void scree_length_text(char *text, size_t size, double length)
{
    double millimetres = length * 1e3;
    bool small = millimetres < 0.0099;
    char number[48];
    (void)snprintf(number, sizeof number, "%.6g", small ? millimetres * 1e3 : millimetres);
    (void)snprintf(text, size, "%s %s", number, small ? "µm" : "mm");
}
