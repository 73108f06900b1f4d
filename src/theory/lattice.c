/// Closed forms of lattices.
///
/// A uniform strain E, an eigenstrain of the lattice and of the particles, opens each contact by q = 2 R (E - e) n with
/// the strain e of the particles. With the sums over the contacts of a particle
///     s_n = sum (n . E n)^2 / E:E,    s_t = sum (|E n|^2 - (n . E n)^2) / E:E
/// (the rows of the table) the stress of a particle is 2 R^2 / V (k_n s_n + k_t s_t) (E - e), V its volume, and that of
/// the lattice the same over the volume of a cell. Particles answer e = c times their stress, c = shear + d trace for
/// an all-round strain, else shear. With b = 2 R^2 c k s / V:
///     corrected  stress = C E,  C = (C_n + C_t) / (1 + b_n + b_t)
///     published  (the tangential displacement is 2 R of E alone)  C = C_n (1 - b_t) / (1 + b_n) + C_t
/// b_n is an eigenvalue of -B. It is its spectral radius: for two particles of a contact (n . e1 n + n . e2 n)^2 is at
/// most 2 (n . e1 n)^2 + 2 (n . e2 n)^2, so no eigenvalue exceeds the largest that a particle alone has with twice its
/// stiffness, and in a lattice uniform strains reach that.
#include "theory/lattice.h"

#include <math.h>

typedef struct lattice_row {
    const char *name;
    int dimension;
    double cell;                              ///< volume of a particle's cell over R^2 length, R^3
    double normal[SCREE_LATTICE_STRAINS];     ///< s_n
    double tangential[SCREE_LATTICE_STRAINS]; ///< s_t
} lattice_row;

static const lattice_row rows[SCREE_LATTICES] = {
    [SCREE_LATTICE_SQUARE] = {"square", 2, 4, {2, 2, 0}, {0, 0, 2}},
    [SCREE_LATTICE_HEXAGONAL] = {"hexagonal", 2, 3.4641016151377546, {3, 1.5, 1.5}, {0, 1.5, 1.5}},
    [SCREE_LATTICE_SIMPLE_CUBIC] = {"simple cubic", 3, 8, {2, 2, 0}, {0, 0, 2}},
    [SCREE_LATTICE_BODY_CENTRED] =
        {"body-centred cubic", 3, 6.1584028713560086, {8. / 3, 0, 16. / 9}, {0, 8. / 3, 8. / 9}},
    [SCREE_LATTICE_FACE_CENTRED] = {"face-centred cubic", 3, 5.6568542494923806, {4, 1, 2}, {0, 3, 2}},
};

const char *scree_lattice_name(scree_lattice lattice)
{
    return lattice == SCREE_LATTICE_ROW ? "row" : rows[lattice].name;
}

int scree_lattice_dimension(scree_lattice lattice)
{
    return lattice == SCREE_LATTICE_ROW ? 2 : rows[lattice].dimension;
}

double scree_particle_volume(int dimension, const scree_lattice_material *m)
{
    return M_PI * m->radius * m->radius * (dimension == 3 ? 4. / 3 * m->radius : m->length);
}

/// Compliance of a particle under one of the strains.
static double compliance(int dimension, scree_lattice_strain strain, const scree_lattice_material *m)
{
    return m->shear + (strain == SCREE_LATTICE_ALL_ROUND ? dimension * m->trace : 0);
}

double scree_lattice_radius(scree_lattice lattice, const scree_lattice_material *m)
{
    const lattice_row *row = &rows[lattice];
    double most = 0;
    for (int k = 0; k < SCREE_LATTICE_STRAINS; k++)
        most = fmax(most, row->normal[k] * compliance(row->dimension, (scree_lattice_strain)k, m));
    return 2 * m->radius * m->radius * m->normal * most / scree_particle_volume(row->dimension, m);
}

double scree_row_radius(int dimension, const scree_lattice_material *m)
{
    return 4 * m->radius * m->radius * m->normal * (m->shear + m->trace) / scree_particle_volume(dimension, m);
}

double scree_row_stiffness(int dimension, const scree_lattice_material *m)
{
    return m->normal / (1 + scree_row_radius(dimension, m));
}

double scree_row_poisson(int dimension, const scree_lattice_material *m)
{
    // Stress along the row under a strain E of the centres: 2 R f / V, f = stiffness 2 R E.
    const double stress =
        4 * m->radius * m->radius * scree_row_stiffness(dimension, m) / scree_particle_volume(dimension, m);
    return -m->trace * stress;
}

double scree_lattice_cell(scree_lattice lattice, const scree_lattice_material *m)
{
    const lattice_row *row = &rows[lattice];
    return row->cell * m->radius * m->radius * (row->dimension == 3 ? m->radius : m->length);
}

double scree_lattice_modulus(scree_lattice lattice, scree_lattice_strain strain, const scree_lattice_material *m)
{
    const lattice_row *row = &rows[lattice];
    const double square = 2 * m->radius * m->radius;
    const double cell = scree_lattice_cell(lattice, m);
    const double soft = compliance(row->dimension, strain, m) * square / scree_particle_volume(row->dimension, m);
    const double normal = m->normal * row->normal[strain], tangential = m->tangential * row->tangential[strain];
    if (m->corrected) return square / cell * (normal + tangential) / (1 + soft * (normal + tangential));
    return square / cell * (normal * (1 - soft * tangential) / (1 + soft * normal) + tangential);
}

void scree_lattice_axial(scree_lattice lattice, const scree_lattice_material *m, double *young, double *poisson)
{
    const int d = rows[lattice].dimension;
    const double round = scree_lattice_modulus(lattice, SCREE_LATTICE_ALL_ROUND, m),
                 diagonal = scree_lattice_modulus(lattice, SCREE_LATTICE_DIAGONAL, m);
    // C11 + (d - 1) C12 = d K, C11 - C12 = 2 G'.
    const double across = (round - diagonal) / d, along = across + diagonal;
    *poisson = across / (along + (d - 2) * across);
    *young = along - (d - 1) * across * *poisson;
}

void scree_lattice_isotropic(scree_lattice lattice, const scree_lattice_material *m, double *bulk, double *shear)
{
    const int d = rows[lattice].dimension;
    const double diagonal = 0.5 * scree_lattice_modulus(lattice, SCREE_LATTICE_DIAGONAL, m),
                 off = 0.5 * scree_lattice_modulus(lattice, SCREE_LATTICE_SHEAR, m);
    *bulk = scree_lattice_modulus(lattice, SCREE_LATTICE_ALL_ROUND, m) / d;
    *shear = d == 3 ? (2 * diagonal + 3 * off) / 5 : (diagonal + off) / 2;
}

void scree_moduli_of_bulk_and_shear(int dimension, double bulk, double shear, double *young, double *poisson)
{
    const bool solid = dimension == 3;
    *young = solid ? 9 * bulk * shear / (3 * bulk + shear) : 4 * bulk * shear / (bulk + shear);
    *poisson = solid ? (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear)) : (bulk - shear) / (bulk + shear);
}

scree_voigt_moduli scree_voigt_estimate(int dimension, double contacts, double square_radius, double volume,
                                        double normal, double tangential)
{
    // Means over all directions of n n n n and of the rest; branches are 2 R long.
    const double each = 4 * contacts * square_radius / volume;
    scree_voigt_moduli m = {
        .bulk = each * normal / (dimension == 3 ? 9 : 4),
        .shear = dimension == 3 ? each * (2 * normal + 3 * tangential) / 30 : each * (normal + tangential) / 8,
    };
    scree_moduli_of_bulk_and_shear(dimension, m.bulk, m.shear, &m.young, &m.poisson);
    return m;
}
