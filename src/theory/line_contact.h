/// Two equal discs without friction, pressed together along the line of their centres by forces on the far ends of
/// their diameters, or by planes through their centres, which by symmetry is the same: Hertz's line contact, and the
/// concentrated forces that hold it in balance.
///
/// Sources: Hertz 1881; Johnson, Contact Mechanics (1985), 4.2(c) for the stresses below the contact and 5.6 for the
/// approach of the centres; Timoshenko and Goodier for the disc between two forces. Limits: the half width of the
/// contact is small beside the radius; the far force is concentrated, which for the half of the disc on this side is
/// exact up to (half width / radius)^2.
#ifndef SCREE_THEORY_LINE_CONTACT_H
#define SCREE_THEORY_LINE_CONTACT_H

#include <stdbool.h>

typedef struct scree_line_contact {
    double radius;        ///< m
    double young_modulus; ///< Pa
    double poisson_ratio;
    bool plane_stress; ///< false: plane strain
    double force;      ///< N for each m of depth
} scree_line_contact;

/// Half the width of the contact [m].
double scree_line_contact_half_width(const scree_line_contact *contact);

/// What the two centres come closer by [m]; zero without a force.
double scree_line_contact_approach(const scree_line_contact *contact);

/// Strain along the line of the centres at a depth [m] below the contact, 0 to the radius; compression is negative.
double scree_line_contact_strain(const scree_line_contact *contact, double depth);

/// What the diameter across becomes longer by [m].
double scree_line_contact_widening(const scree_line_contact *contact);

#endif
