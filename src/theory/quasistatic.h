/// What tells whether a loading is quasistatic: the formulas and the limits, nowhere else (theory/quasistatic.c).
#ifndef SCREE_THEORY_QUASISTATIC_H
#define SCREE_THEORY_QUASISTATIC_H

#include <stdbool.h>

/// Quasistatic and size coefficients (Padbidri 2010, eqs. 2.13, 2.14, 2.B1 and physics.md, section 3).
/// mass [kg] mean; radius [m] mean; rate [1/s]; pressure [Pa]; thickness [m] (2D: f0 = p 2R thickness; 3D: f0 = p
/// (2R)^2).
void scree_quasistatic_numbers(int dimension, double count, double mass, double radius, double thickness, double rate,
                               double pressure, double *phi, double *psi);

/// Inertial number [1]. 2D: rate sqrt(m / (p thickness)); 3D: rate d sqrt(density / p), density that of the grains.
/// mass [kg] mean; radius [m] mean; rate [1/s]; thickness [m], 2D only; pressure [Pa] above zero, else NAN.
double scree_inertial_number(int dimension, double mass, double radius, double density, double thickness, double rate,
                             double pressure);

/// Speed [m/s] of a wave in a packing of the longitudinal modulus [Pa], density of the grains [kg/m3] times solid
/// fraction.
double scree_wave_speed(double modulus, double density, double solid_fraction);

/// The criteria, each a number and its limit.
typedef enum scree_quasistatic_criterion {
    SCREE_QUASISTATIC_INERTIAL, ///< inertial number
    SCREE_QUASISTATIC_KINETIC,  ///< kinetic over elastic energy
    SCREE_QUASISTATIC_MODULUS,  ///< Young's modulus of the grains over the pressure
    SCREE_QUASISTATIC_WEIGHT,   ///< weight of a column of the sample over the pressure
    SCREE_QUASISTATIC_SOUND,    ///< strain that is imposed while a wave crosses the sample once
    SCREE_QUASISTATIC_COUNT
} scree_quasistatic_criterion;

typedef struct scree_quasistatic_limit {
    const char *name;
    double limit;
    bool least; ///< the number must not be below the limit; else not above it
} scree_quasistatic_limit;
extern const scree_quasistatic_limit scree_quasistatic_limits[SCREE_QUASISTATIC_COUNT];

/// Whether `value` keeps the limit. NAN, a number that does not exist here, does.
bool scree_quasistatic_keeps(scree_quasistatic_criterion criterion, double value);

#endif
