/// A specimen as a linear operator: bodies, the contacts between them as they stand, and products with what these make
/// of small motions: stiffness K, damping C, mass M, and of deformable particles the iteration of the forces, B of M
/// 3.8. Nothing is assembled.
///
/// Motion. x has `components` numbers a body: x, y, angle in 2D; x, y, z and the angles about them in 3D [m, rad].
/// Contact of first and second, n from second to first: relative displacement of the two bodies where they touch
///     q = G x = u_first - u_second - (a_first w_first + a_second w_second) x n                            [m]
/// with the arms of contact/kinematics.h. Force on first [N], and forces and torques on the bodies
///     f = -D q,  D = k_n n n + k_t (1 - n n),      F = G^T f,      K = G^T D G,  C = G^T D' G (c_n, c_t in D')
///
/// Deformable particles. With L f = sum over the contacts of a particle of R sym(n f) [N m], its strain is
/// -(compliance / V) L f (M 2.41, 2.44, 2.46), and surfaces move by L^T strain towards each other (M 2.52). So
///     f = -D q + B f,   B = -D_B H,   H = L^T (compliance / V) L
/// D_B = k_n n n as published (M 2.53: overlaps alone feel the strain), D_B = D corrected (the tangential displacement
/// does, too). H is symmetric and not negative, so D_B^(1/2) H D_B^(1/2) =: W is, and B has its eigenvalues with the
/// sign changed: all real, none positive, in both forms (docs/theory/ddem.md).
///
/// Left out: forces that turn with a contact (the pre-stress, of order overlap over radius), friction's limit, contacts
/// that open or close. A wall is rigid and stands still.
///
/// Sums go over the contacts in their order. Cost: a product takes some 20 ns a contact.
#ifndef SCREE_SPECIMEN_SPECIMEN_H
#define SCREE_SPECIMEN_SPECIMEN_H

#include "base/error.h"
#include "model/compliance.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// In the place of the second body: a wall.
#define SCREE_SPECIMEN_WALL UINT32_MAX

typedef enum scree_tangential_form {
    SCREE_TANGENTIAL_AS_PUBLISHED, ///< the tangential displacement does not feel the strain: no potential if k_t > 0
    SCREE_TANGENTIAL_CORRECTED,    ///< it does
} scree_tangential_form;

/// Along the normal and in the tangent plane.
typedef struct scree_springs {
    double normal, tangential;
} scree_springs;

typedef struct scree_specimen_contact {
    uint32_t first, second; ///< bodies; second may be SCREE_SPECIMEN_WALL
    double normal[3];       ///< from second to first
    double branch[3];       ///< m, centre of first less that of second (of its image); of a wall less the contact point
    double arm_first, arm_second;     ///< m, of slip and torque; the second is 0 for a wall
    double reach_first, reach_second; ///< m, of stress and strain: radii; the second is 0 for a wall
    scree_springs stiffness;          ///< N/m
    scree_springs damping;            ///< N s/m
} scree_specimen_contact;

typedef struct scree_specimen {
    int dimension;
    int components;        ///< a body: 3 in 2D, 6 in 3D
    int strain_components; ///< a body: 3 in 2D, 6 in 3D: xx, yy(, zz), then sqrt 2 times xy (yz, xz, xy)
    size_t body_count, contact_count;
    double *mass;                 ///< kg
    double *inertia;              ///< kg m2
    double *radius;               ///< m
    double (*position)[3];        ///< m
    double *volume;               ///< m3, of discs area times thickness
    uint8_t *held;                ///< bits of components that do not move, 0 to 2 velocity, 3 to 5 spin (state/body.h)
    scree_compliance *compliance; ///< of each body; all zero: rigid
    scree_plane_condition condition; ///< that of `compliance`; plane strain (in 3D: a solid) unless someone says else
    scree_specimen_contact *contact;
    scree_tangential_form tangential;
    bool dashpots_strain; ///< dashpot forces are part of the stress of particles, too
    unsigned periodic;    ///< bit k: the specimen repeats itself in direction k
    double extent;        ///< m3, volume that the specimen fills; NAN: not known
    double *strain;       ///< scratch: strain_components a body
    double *motion;       ///< scratch: components a body
    double *force;        ///< scratch: dimension a contact
} scree_specimen;

/// Room for bodies and contacts, all zero, without walls, periodic directions and deformation. Errors: memory.
scree_status scree_specimen_create(int dimension, size_t bodies, size_t contacts, scree_specimen *specimen,
                                   scree_error *error) __attribute__((warn_unused_result));
void scree_specimen_destroy(scree_specimen *specimen);

/// A round body of this radius [m] and density [kg/m3]; of a disc `thickness` [m] long.
void scree_specimen_set_body(scree_specimen *specimen, size_t body, double radius, double density, double thickness);

/// A contact with this branch [m, three components], which lies in the middle of the overlap of the two radii.
void scree_specimen_set_contact(scree_specimen *specimen, size_t contact, uint32_t first, uint32_t second,
                                const double branch[3], scree_springs stiffness, scree_springs damping);

/// Numbers of a vector of motions, of a vector of contact forces.
static inline size_t scree_specimen_motions(const scree_specimen *s)
{
    return s->body_count * (size_t)s->components;
}

static inline size_t scree_specimen_contact_forces(const scree_specimen *s)
{
    return s->contact_count * (size_t)s->dimension;
}

/// Particles deform.
bool scree_specimen_is_deformable(const scree_specimen *specimen);

/// A tangential spring acts anywhere; a dashpot does.
bool scree_specimen_resists_slip(const scree_specimen *specimen);
bool scree_specimen_is_damped(const scree_specimen *specimen);

/// What deformation does has a potential: particles are rigid, or no tangential spring acts, or the form is corrected.
bool scree_specimen_has_potential(const scree_specimen *specimen);

// ---- products: results do not overlap arguments ------------------------------------------------------------------
// Components that are held count as zero in x, and come out as zero, in those of K, C, M.

/// y = K x, C x, M x.
void scree_specimen_stiffness(const scree_specimen *specimen, const double *x, double *y);
void scree_specimen_damping(const scree_specimen *specimen, const double *x, double *y);
void scree_specimen_mass(const scree_specimen *specimen, const double *x, double *y);

/// y = M^-1 x; held components have no inverse: zero.
void scree_specimen_accelerate(const scree_specimen *specimen, const double *x, double *y);

/// Forces of the contacts of rigid particles under x, A X of M 3.8: f = -D G x [N], `dimension` numbers a contact.
void scree_specimen_forces(const scree_specimen *specimen, const double *x, double *f);

/// g = B f: what the contacts change by when the particles deform under f.
void scree_specimen_force_iteration(const scree_specimen *specimen, const double *f, double *g);

/// F = G^T f, of all components; q = G x, held or not; sets held components to zero.
void scree_specimen_gather(const scree_specimen *specimen, const double *f, double *on_bodies);
void scree_specimen_relative(const scree_specimen *specimen, const double *x, double *q);
void scree_specimen_fix(const scree_specimen *specimen, double *x);

/// moment = L f [N m]; surface = L^T strain [m]; strain of the particles, that of `moment` [N m] as a stress times
/// volume, may be the same array. Symmetric tensors, strain_components a body.
void scree_specimen_moments(const scree_specimen *specimen, const double *f, double *moment);
void scree_specimen_strain(const scree_specimen *specimen, const double *moment, double *strain);
void scree_specimen_surfaces(const scree_specimen *specimen, const double *strain, double *surface);

/// z = (normal n n + tangential (1 - n n)) v at a contact; z may be v.
static inline void scree_specimen_along(int dimension, const scree_specimen_contact *contact, double normal,
                                        double tangential, const double *v, double *z)
{
    double along = 0;
    for (int k = 0; k < dimension; k++) along += contact->normal[k] * v[k];
    for (int k = 0; k < dimension; k++) z[k] = tangential * v[k] + (normal - tangential) * along * contact->normal[k];
}

/// Stiffness with which the form in use answers a displacement of the surfaces, D_B.
static inline scree_springs scree_specimen_answer(const scree_specimen *specimen, const scree_specimen_contact *contact)
{
    bool corrected = specimen->tangential == SCREE_TANGENTIAL_CORRECTED;
    return (scree_springs){contact->stiffness.normal, corrected ? contact->stiffness.tangential : 0};
}

#endif
