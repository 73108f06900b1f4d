/// Physical values with units in text, through udunits2.
/// Threads: any thread may call these at any time. udunits2 keeps its parser's state and its error handler in globals,
/// so its calls are serialised by a lock inside units.c; the unit database (10 ms to load) is read once a process, when
/// a value first has a unit other than the SI unit itself, and stays.
#ifndef SCREE_BASE_UNITS_H
#define SCREE_BASE_UNITS_H

#include "base/error.h"

/// Converts `text` ("100 kPa", "0.75 mm", "5e-3 1/s", "10 %", "3") to SI. A bare number is SI. `unit` is the SI unit
/// expected ("Pa", "1/s", "1", "kg/m3"). The result is finite; "-0" is 0. Numbers have a decimal point in any locale.
/// Errors: not a number, unknown unit, wrong dimension (says what was expected, with an example).
scree_status scree_units_parse(const char *text, const char *unit, double *value, scree_error *error) SCREE_MUST_USE;

/// What an SI unit measures, with its article ("a length" for "m"), and an example as a user writes it ("0.5 mm").
/// "a value" and the unit itself where there is no word for it.
const char *scree_units_quantity(const char *unit);
const char *scree_units_example(const char *unit);

#endif
