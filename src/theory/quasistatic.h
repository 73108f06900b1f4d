/// Quasistatic and size coefficients (Padbidri 2010, eqs. 2.13, 2.14, 2.B1 and physics.md, section 3).
#ifndef SCREE_THEORY_QUASISTATIC_H
#define SCREE_THEORY_QUASISTATIC_H

/// mass [kg] mean; radius [m] mean; rate [1/s]; pressure [Pa]; thickness [m] (2D: f0 = p 2R thickness; 3D: f0 = p
/// (2R)^2).
void scree_quasistatic_numbers(int dimension, double count, double mass, double radius, double thickness, double rate,
                               double pressure, double *phi, double *psi);

#endif
