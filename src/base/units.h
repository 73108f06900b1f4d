/// Physical values with units in text, through udunits2.
#ifndef SCREE_BASE_UNITS_H
#define SCREE_BASE_UNITS_H

#include "base/error.h"

/// Converts `text` ("100 kPa", "0.75 mm", "5e-3 1/s", "10 %", "3") to SI. A bare number is SI. `unit` is the SI unit
/// expected ("Pa", "1/s", "1", "kg/m3"). Errors: not a number, unknown unit, wrong dimension (says what was expected).
scree_status scree_units_parse(const char *text, const char *unit, double *value, scree_error *error) SCREE_MUST_USE;

#endif
