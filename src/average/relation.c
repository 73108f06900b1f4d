/// How two numbers of the same elements go together. See relation.h.
#include "average/relation.h"

#include "average/tensor.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

static double rank_of(const double *value, size_t count, size_t which)
{
    double rank = 0;
    for (size_t k = 0; k < count; k++) rank += value[k] < value[which] ? 1 : value[k] == value[which] ? 0.5 : 0;
    return rank;
}

double scree_average_rank_correlation(const double *x, const double *y, size_t count)
{
    const double mean = 0.5 * (double)count; // of the ranks of both
    double xx = 0, yy = 0, xy = 0;
    for (size_t k = 0; k < count; k++) {
        const double a = rank_of(x, count, k) - mean, b = rank_of(y, count, k) - mean;
        xx += a * a;
        yy += b * b;
        xy += a * b;
    }
    return count > 2 ? xy / sqrt(xx * yy) : NAN;
}

/// The parabola less its own line, x^2 - <x^2> - (<x^3>/<x^2>) x about the mean of x, is orthogonal to 1 and to x.
double scree_average_bend(const double *x, const double *y, size_t count)
{
    double mean = 0, second = 0, third = 0, on_line = 0, on_bend = 0, line = 0, bend = 0;
    for (size_t k = 0; k < count; k++) mean += x[k] / (double)count;
    for (size_t k = 0; k < count; k++) {
        const double apart = x[k] - mean;
        second += apart * apart / (double)count;
        third += apart * apart * apart / (double)count;
    }
    for (size_t k = 0; k < count; k++) {
        const double apart = x[k] - mean, bent = apart * apart - second - third / second * apart;
        on_line += apart * y[k];
        on_bend += bent * y[k];
        line += apart * apart;
        bend += bent * bent;
    }
    const double of_line = on_line * on_line / line, of_bend = on_bend * on_bend / bend;
    return count > 3 ? of_bend / (of_line + of_bend) : NAN;
}

/// The direction of the largest principal value of a tensor in space; false: there is none.
static bool find_axis(const scree_average_table *table, size_t row, const char *name, double sign, double axis[9])
{
    double tensor[9], value[3];
    for (int k = 0; k < 9; k++) {
        char text[48];
        (void)snprintf(text, sizeof text, "%s_%c%c", name, "xyz"[k / 3], "xyz"[k % 3]);
        const size_t column = scree_average_table_find(table, text);
        tensor[k] = column == SIZE_MAX ? (double)NAN : sign * scree_average_table_get(table, row, column);
        if (!isfinite(tensor[k])) return false;
    }
    if (isnan(scree_tensor_form_of(tensor, 3).angle)) return false;
    scree_tensor_principal(tensor, 3, value, axis);
    return true;
}

double scree_average_axes_apart(const scree_average_table *table, size_t row, const char *first, double sign,
                                const char *second)
{
    double one[9], other[9], across[3];
    if (!find_axis(table, row, first, sign, one) || !find_axis(table, row, second, 1, other)) return NAN;
    scree_cross(one, other, across);
    return atan2(scree_length(across), fabs(scree_dot(one, other))) * 180 / M_PI;
}
