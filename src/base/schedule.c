/// Numbers that follow time: see schedule.h.
#include "base/schedule.h"

#include <math.h>

// ---- tables ------------------------------------------------------------------------------------------------------

static const double *row_of(const scree_schedule *s, size_t index)
{
    return s->row + index * scree_schedule_stride(s->columns);
}

static double value_of(const scree_schedule *s, size_t index)
{
    return row_of(s, index)[1 + s->column];
}

/// Index of the last row that is not behind `time`; the first row where all are.
static size_t find_row(const scree_schedule *s, double time)
{
    size_t low = 0, high = s->count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        *(row_of(s, middle)[0] <= time ? &low : &high) = middle;
    }
    return low;
}

/// Slope [U/s] behind row `index`; 0 beyond the ends of the table.
static double slope_of(const scree_schedule *s, size_t index, double time)
{
    if (index + 1 >= s->count || time < row_of(s, 0)[0]) return 0;
    return (value_of(s, index + 1) - value_of(s, index)) / (row_of(s, index + 1)[0] - row_of(s, index)[0]);
}

static double table_at(const scree_schedule *s, double time)
{
    size_t k = find_row(s, time);
    return value_of(s, k) + slope_of(s, k, time) * (time - row_of(s, k)[0]);
}

/// Integral since the first row.
static double table_integral(const scree_schedule *s, double time)
{
    size_t k = find_row(s, time);
    double since = time - row_of(s, k)[0];
    return row_of(s, k)[1 + s->columns + s->column] + since * (value_of(s, k) + 0.5 * slope_of(s, k, time) * since);
}

void scree_schedule_integrate_table(double *row, size_t count, size_t columns)
{
    size_t stride = scree_schedule_stride(columns);
    for (size_t c = 0; c < columns; c++) {
        if (count > 0) row[1 + columns + c] = 0;
        for (size_t k = 1; k < count; k++) {
            double *now = row + k * stride, *before = now - stride;
            now[1 + columns + c] = before[1 + columns + c] + 0.5 * (now[0] - before[0]) * (now[1 + c] + before[1 + c]);
        }
    }
}

// ---- ramps -------------------------------------------------------------------------------------------------------

static double share_of(const scree_schedule *s, double time)
{
    return fmin(fmax((time - s->begin) / s->duration, 0), 1);
}

static double smooth(double s)
{
    return s * s * (3 - 2 * s);
}

/// Integral of what a ramp adds to `value`, since its begin.
static double ramp_integral(const scree_schedule *s, double time)
{
    double x = share_of(s, time), beyond = fmax(time - s->begin - s->duration, 0);
    double part = s->form == SCREE_SCHEDULE_SMOOTH ? x * x * x * (1 - 0.5 * x) : 0.5 * x * x;
    return s->change * (s->duration * part + beyond);
}

// ---- all ---------------------------------------------------------------------------------------------------------

static double angle_of(const scree_schedule *s, double time)
{
    return 2 * M_PI * s->frequency * time + s->phase;
}

double scree_schedule_at(const scree_schedule *s, double time)
{
    switch ((scree_schedule_form)s->form) {
    case SCREE_SCHEDULE_RAMP:
        return s->value + s->change * share_of(s, time);
    case SCREE_SCHEDULE_SMOOTH:
        return s->value + s->change * smooth(share_of(s, time));
    case SCREE_SCHEDULE_HARMONIC:
        return s->value + s->change * sin(angle_of(s, time));
    case SCREE_SCHEDULE_TABLE:
        return table_at(s, time);
    case SCREE_SCHEDULE_CONSTANT:
        break;
    }
    return s->value;
}

double scree_schedule_rate(const scree_schedule *s, double time)
{
    double x = (time - s->begin) / s->duration;
    bool inside = x >= 0 && x < 1;
    switch ((scree_schedule_form)s->form) {
    case SCREE_SCHEDULE_RAMP:
        return inside ? s->change / s->duration : 0;
    case SCREE_SCHEDULE_SMOOTH:
        return inside ? 6 * x * (1 - x) * s->change / s->duration : 0;
    case SCREE_SCHEDULE_HARMONIC:
        return 2 * M_PI * s->frequency * s->change * cos(angle_of(s, time));
    case SCREE_SCHEDULE_TABLE:
        return slope_of(s, find_row(s, time), time);
    case SCREE_SCHEDULE_CONSTANT:
        break;
    }
    return 0;
}

double scree_schedule_integral(const scree_schedule *s, double time)
{
    switch ((scree_schedule_form)s->form) {
    case SCREE_SCHEDULE_RAMP:
    case SCREE_SCHEDULE_SMOOTH:
        return s->value * time + (ramp_integral(s, time) - ramp_integral(s, 0));
    case SCREE_SCHEDULE_HARMONIC:
        if (s->frequency == 0) return scree_schedule_at(s, 0) * time;
        // cos a - cos b without the cancellation of a short time.
        return s->value * time + s->change / (M_PI * s->frequency) * sin(0.5 * (angle_of(s, time) + s->phase)) *
                                     sin(M_PI * s->frequency * time);
    case SCREE_SCHEDULE_TABLE:
        return table_integral(s, time) - table_integral(s, 0);
    case SCREE_SCHEDULE_CONSTANT:
        break;
    }
    return s->value * time;
}

double scree_schedule_largest(const scree_schedule *s)
{
    double largest = 0;
    switch ((scree_schedule_form)s->form) {
    case SCREE_SCHEDULE_HARMONIC:
        return fabs(s->value) + fabs(s->change);
    case SCREE_SCHEDULE_TABLE:
        for (size_t k = 0; k < s->count; k++) largest = fmax(largest, fabs(value_of(s, k)));
        return largest;
    case SCREE_SCHEDULE_RAMP:
    case SCREE_SCHEDULE_SMOOTH:
        return fmax(fabs(s->value), fabs(s->value + s->change));
    case SCREE_SCHEDULE_CONSTANT:
        break;
    }
    return fabs(s->value);
}

double scree_schedule_largest_rate(const scree_schedule *s)
{
    double largest = 0;
    switch ((scree_schedule_form)s->form) {
    case SCREE_SCHEDULE_RAMP:
        return fabs(s->change / s->duration);
    case SCREE_SCHEDULE_SMOOTH:
        return 1.5 * fabs(s->change / s->duration);
    case SCREE_SCHEDULE_HARMONIC:
        return fabs(2 * M_PI * s->frequency * s->change);
    case SCREE_SCHEDULE_TABLE:
        for (size_t k = 0; k + 1 < s->count; k++) largest = fmax(largest, fabs(slope_of(s, k, row_of(s, k)[0])));
        return largest;
    case SCREE_SCHEDULE_CONSTANT:
        break;
    }
    return 0;
}

bool scree_schedule_is_constant(const scree_schedule *s)
{
    return s->form == SCREE_SCHEDULE_CONSTANT || scree_schedule_largest_rate(s) == 0;
}

/// NaN is a value that is left open, and like itself.
static bool is_same(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

bool scree_schedule_is_same(const scree_schedule *a, const scree_schedule *b)
{
    if (a->form != b->form) return false;
    bool same = is_same(a->value, b->value) && is_same(a->change, b->change) && is_same(a->begin, b->begin) &&
                is_same(a->duration, b->duration) && is_same(a->frequency, b->frequency) &&
                is_same(a->phase, b->phase) && a->count == b->count;
    for (size_t k = 0; same && k < a->count; k++)
        same = is_same(row_of(a, k)[0], row_of(b, k)[0]) && is_same(value_of(a, k), value_of(b, k));
    return same;
}
