/// A number that follows time: a constant, a ramp, a table, a harmonic. A pure function of time without state, so that
/// a run that is continued, on any number of threads, sees the same bits.
///
/// With t the time [s] and s = (t - begin) / duration, cut to 0 .. 1:
///   constant  value
///   ramp      value + change s
///   smooth    value + change s^2 (3 - 2 s)                            rate 0 at both ends
///   harmonic  value + change sin(2 pi frequency t + phase)
///   table     linear between its rows, constant before the first and behind the last one
///
/// Cost: a table is searched by halves, its integral up to each row is stored with it.
#ifndef SCREE_BASE_SCHEDULE_H
#define SCREE_BASE_SCHEDULE_H

#include <stdbool.h>
#include <stddef.h>

typedef enum scree_schedule_form {
    SCREE_SCHEDULE_CONSTANT,
    SCREE_SCHEDULE_RAMP,
    SCREE_SCHEDULE_SMOOTH,
    SCREE_SCHEDULE_HARMONIC,
    SCREE_SCHEDULE_TABLE,
} scree_schedule_form;

/// All zero: the constant 0. Values in the unit U of what it says, times in s.
typedef struct scree_schedule {
    int form;               ///< scree_schedule_form
    double value;           ///< U: the constant, the begin of a ramp, the mean of a harmonic
    double change;          ///< U: of a ramp from begin to end; amplitude of a harmonic
    double begin, duration; ///< s: ramps
    double frequency;       ///< 1/s: harmonic
    double phase;           ///< rad: harmonic, at time 0
    /// Table: rows of a time [s], `columns` values [U], and their integrals [U s] since the first row
    /// (scree_schedule_integrate_table). Times increase. This schedule is the values of `column`.
    const double *row;
    size_t count, columns, column;
} scree_schedule;

/// Numbers in one row of a table.
static inline size_t scree_schedule_stride(size_t columns)
{
    return 1 + 2 * columns;
}

/// Fills the integrals of a table whose times and values are there.
void scree_schedule_integrate_table(double *row, size_t count, size_t columns);

/// The value at `time` [U].
double scree_schedule_at(const scree_schedule *schedule, double time);

/// Its derivative [U/s]; where a table bends that of what follows.
double scree_schedule_rate(const scree_schedule *schedule, double time);

/// Its integral from 0 to `time` [U s], in closed form.
double scree_schedule_integral(const scree_schedule *schedule, double time);

/// A bound of |value| and of |rate| at all times.
double scree_schedule_largest(const scree_schedule *schedule);
double scree_schedule_largest_rate(const scree_schedule *schedule);

/// Whether it never changes.
bool scree_schedule_is_constant(const scree_schedule *schedule);

/// Whether two say the same, number by number.
bool scree_schedule_is_same(const scree_schedule *one, const scree_schedule *other);

#endif
