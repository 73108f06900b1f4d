/// Lattices of equal particles: theory/lattice.c and theory/lattice_waves.c for programs.
#include "library/theory.h"

#include "model/compliance.h"
#include "theory/lattice_waves.h"

#include <scree/scree.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Points between two corners of the path.
enum { BETWEEN = 60 };

static const char *const names[SCREE_LATTICES + 1] = {
    [SCREE_LATTICE_ROW] = "row",
    [SCREE_LATTICE_SQUARE] = "square",
    [SCREE_LATTICE_HEXAGONAL] = "hexagonal",
    [SCREE_LATTICE_SIMPLE_CUBIC] = "simple_cubic",
    [SCREE_LATTICE_BODY_CENTRED] = "body_centred",
    [SCREE_LATTICE_FACE_CENTRED] = "face_centred",
};

// ---- what is asked -----------------------------------------------------------------------------------------------

static scree_status find_kind(const char *kind, scree_lattice *lattice, scree_error *error)
{
    for (int k = 0; k <= SCREE_LATTICES; k++)
        if (kind && strcmp(kind, names[k]) == 0) {
            *lattice = (scree_lattice)k;
            return SCREE_OK;
        }
    const char *nearest = kind ? scree_nearest(kind, names, SCREE_LATTICES + 1) : NULL;
    return scree_error_refuse(error, "kind",
                              nearest ? nearest : "row, square, hexagonal, simple_cubic, body_centred, face_centred",
                              "there is no such lattice");
}

static scree_status check(const scree_theory_lattice_of *of, scree_error *error)
{
    const struct {
        const char *name;
        double value;
    } positive[] = {{"radius", of->radius},
                    {"length", of->length},
                    {"density", of->density},
                    {"normal_stiffness", of->normal_stiffness}};
    for (size_t k = 0; k < sizeof positive / sizeof *positive; k++)
        if (!(positive[k].value > 0 && isfinite(positive[k].value)))
            return scree_error_refuse(error, positive[k].name, "a number above 0",
                                      "this has to be a finite number above 0");
    if (!(of->stiffness_ratio >= 0 && isfinite(of->stiffness_ratio)))
        return scree_error_refuse(error, "stiffness_ratio", "0 or more",
                                  "k_t over k_n has to be a finite number, 0 or more");
    if (!(of->young_modulus > 0))
        return scree_error_refuse(error, "young_modulus", "above 0, infinite for rigid particles",
                                  "the Young's modulus of particles has to be above 0");
    if (!scree_elasticity_is_stable(1, of->poisson_ratio))
        return scree_error_refuse(error, "poisson_ratio", "above -1 and below 0.5",
                                  "no particle of this Poisson's ratio resists every strain");
    return SCREE_OK;
}

static scree_lattice_material material_of(const scree_theory_lattice_of *of, scree_lattice lattice, double young)
{
    const scree_plane_condition condition = scree_lattice_dimension(lattice) == 3 ? SCREE_SOLID
                                            : of->plane_stress                    ? SCREE_PLANE_STRESS
                                                                                  : SCREE_PLANE_STRAIN;
    const scree_compliance c = scree_compliance_of(condition, young, of->poisson_ratio);
    return (scree_lattice_material){.radius = of->radius,
                                    .length = of->length,
                                    .density = of->density,
                                    .normal = of->normal_stiffness,
                                    .tangential = of->stiffness_ratio * of->normal_stiffness,
                                    .shear = isfinite(young) ? c.shear : 0,
                                    .trace = isfinite(young) ? c.trace : 0,
                                    .corrected = of->corrected};
}

// ---- values ------------------------------------------------------------------------------------------------------

static double radius_of(scree_lattice lattice, const scree_lattice_material *m)
{
    return lattice == SCREE_LATTICE_ROW ? scree_row_radius(2, m) : scree_lattice_radius(lattice, m);
}

/// The largest k_n / E_p is k_n / E_p over the spectral radius; it depends on the Poisson's ratio alone.
static void add_limits(scree_theory *t, const scree_theory_lattice_of *of, scree_lattice lattice,
                       const scree_lattice_material *m)
{
    const scree_lattice_material unit = material_of(of, lattice, of->normal_stiffness);
    theory_add(t, "largest_ratio", 1 / radius_of(lattice, &unit), "m", "k_n / E_p that explicit strains bear");
    if (!(m->shear > 0)) return;
    theory_add(t, "stiffness_ratio", of->normal_stiffness / of->young_modulus, "m", "k_n / E_p");
    theory_add(t, "spectral_radius", radius_of(lattice, m), "1", "of the iteration of forces; explicit below 1");
}

static void add_row(scree_theory *t, const scree_lattice_material *m)
{
    const double stiffness = scree_row_stiffness(2, m), mass = m->density * scree_particle_volume(2, m);
    theory_add(t, "contact_stiffness", stiffness, "N/m", "force over the way of the centres, of one contact");
    theory_add(t, "young_modulus", stiffness / m->length, "Pa", "along the row, of a bar as wide as a disc");
    theory_add(t, "poisson_ratio", scree_row_poisson(2, m), "1", "");
    theory_add(t, "longitudinal_speed", 2 * m->radius * sqrt(stiffness / mass), "m/s", "of long waves along the row");
}

typedef struct moduli_names {
    const char *stiffness_11, *stiffness_12, *stiffness_44, *young, *poisson, *bulk, *shear, *isotropic_young,
        *isotropic_poisson, *longitudinal, *transverse;
} moduli_names;

/// Of the particles as they are, of rigid ones.
static const moduli_names deformed_names = {
    "stiffness_11",  "stiffness_12",  "stiffness_44",  "axial_young_modulus", "axial_poisson_ratio", "bulk_modulus",
    "shear_modulus", "young_modulus", "poisson_ratio", "longitudinal_speed",  "shear_speed"};
static const moduli_names rigid_names = {
    "rigid_stiffness_11",        "rigid_stiffness_12",       "rigid_stiffness_44",  "rigid_axial_young_modulus",
    "rigid_axial_poisson_ratio", "rigid_bulk_modulus",       "rigid_shear_modulus", "rigid_young_modulus",
    "rigid_poisson_ratio",       "rigid_longitudinal_speed", "rigid_shear_speed"};

static void add_moduli(scree_theory *t, const moduli_names *n, scree_lattice lattice, const scree_lattice_material *m)
{
    const int d = scree_lattice_dimension(lattice);
    const double round = scree_lattice_modulus(lattice, SCREE_LATTICE_ALL_ROUND, m),
                 diagonal = scree_lattice_modulus(lattice, SCREE_LATTICE_DIAGONAL, m),
                 off = 0.5 * scree_lattice_modulus(lattice, SCREE_LATTICE_SHEAR, m);
    const double across = (round - diagonal) / d, along = across + diagonal;
    const double density = m->density * scree_particle_volume(d, m) / scree_lattice_cell(lattice, m);
    double young, poisson, bulk, shear;
    theory_add(t, n->stiffness_11, along, "Pa", "C_xxxx, in the axes of the cubic cell");
    theory_add(t, n->stiffness_12, across, "Pa", "C_xxyy");
    theory_add(t, n->stiffness_44, off, "Pa", "C_xyxy");
    scree_lattice_axial(lattice, m, &young, &poisson);
    theory_add(t, n->young, young, "Pa", "under stress along an axis");
    theory_add(t, n->poisson, poisson, "1", "under stress along an axis");
    scree_lattice_isotropic(lattice, m, &bulk, &shear);
    scree_moduli_of_bulk_and_shear(d, bulk, shear, &young, &poisson);
    theory_add(t, n->bulk, bulk, "Pa", d == 3 ? "" : "of areas");
    theory_add(t, n->shear, shear, "Pa", "of the nearest isotropic tensor");
    theory_add(t, n->isotropic_young, young, "Pa", "of the nearest isotropic tensor");
    theory_add(t, n->isotropic_poisson, poisson, "1", "of the nearest isotropic tensor");
    theory_add(t, n->longitudinal, sqrt(along / density), "m/s", "of long waves along an axis");
    theory_add(t, n->transverse, sqrt(off / density), "m/s", "of long waves along an axis");
}

static void add_voigt(scree_theory *t, scree_lattice lattice, const scree_lattice_material *m)
{
    const double(*direction)[3];
    const int d = scree_lattice_dimension(lattice), contacts = scree_lattice_contacts(lattice, &direction);
    const scree_voigt_moduli v = scree_voigt_estimate(d, contacts, m->radius * m->radius,
                                                      scree_lattice_cell(lattice, m), m->normal, m->tangential);
    theory_add(t, "voigt_young_modulus", v.young, "Pa", "of as many contacts in all directions (M 4.15 - 4.18)");
    theory_add(t, "voigt_poisson_ratio", v.poisson, "1", "");
    theory_add(t, "voigt_bulk_modulus", v.bulk, "Pa", d == 3 ? "" : "of areas");
    theory_add(t, "voigt_shear_modulus", v.shear, "Pa", "");
}

static void add_steps(scree_theory *t, scree_lattice lattice, const scree_lattice_material *m)
{
    theory_add(t, "critical_step", scree_lattice_critical_step(lattice, m, SCREE_STRAIN_NONE, NULL), "s",
               "of rigid particles");
    if (!(m->shear > 0)) return;
    const double radius = radius_of(lattice, m);
    theory_add(t, "explicit_step", scree_lattice_critical_step(lattice, m, SCREE_STRAIN_EXPLICIT, NULL), "s",
               "strain of the last forces; 0: none is stable");
    // theta = 1 / (1 + radius), theta / (2 - theta).
    theory_add(t, "relaxed_step", scree_lattice_critical_step(lattice, m, 1 / (1 + 2 * radius), NULL), "s",
               "strain relaxed by 1 / (1 + spectral_radius)");
    theory_add(t, "implicit_step", scree_lattice_critical_step(lattice, m, SCREE_STRAIN_AT_ONCE, NULL), "s",
               "strain solved for");
}

// ---- waves -------------------------------------------------------------------------------------------------------

/// Frequencies along the path, at point `row`: of rigid particles, behind them those of deformable ones.
static void find_point(theory_figure *f, scree_lattice lattice, const scree_lattice_material *m, size_t row)
{
    const scree_lattice_corner *path = scree_lattice_path(lattice);
    const size_t corner = row / BETWEEN;
    const double share = (double)(row % BETWEEN) / BETWEEN;
    double wave[3], frequency[SCREE_LATTICE_BRANCHES];
    for (int k = 0; k < 3; k++) {
        const double to = share > 0 ? path[corner + 1].wave[k] : 0;
        wave[k] = (path[corner].wave[k] * (1 - share) + to * share) / (2 * m->radius);
    }
    f->x[row] = 1 + (double)corner + share;
    int count = scree_lattice_frequencies(lattice, m, wave, SCREE_STRAIN_NONE, frequency);
    for (int k = 0; k < count; k++) f->curve[k].y[row] = frequency[k];
    if (f->curve_count == (size_t)count) return;
    count = scree_lattice_frequencies(lattice, m, wave, SCREE_STRAIN_AT_ONCE, frequency);
    for (int k = 0; k < count; k++) f->curve[count + k].y[row] = frequency[k];
}

static scree_status add_waves(scree_theory *t, scree_lattice lattice, const scree_lattice_material *m,
                              scree_error *error)
{
    static const char *const columns[2][SCREE_LATTICE_BRANCHES] = {
        {"rigid_1", "rigid_2", "rigid_3", "rigid_4", "rigid_5", "rigid_6"},
        {"deformable_1", "deformable_2", "deformable_3", "deformable_4", "deformable_5", "deformable_6"}};
    const scree_lattice_corner *path = scree_lattice_path(lattice);
    const size_t branches = scree_lattice_dimension(lattice) == 3 ? 6 : 3;
    const bool deforms = m->shear > 0;
    theory_figure *f;
    size_t corners = 0;
    while (path[corners].name) corners++;
    scree_status status =
        theory_begin_figure(t, "dispersion", (corners - 1) * BETWEEN + 1, branches << deforms, &f, error);
    if (status) return status;
    for (; f->corner_count < corners; f->corner_count++) f->corner[f->corner_count] = path[f->corner_count].name;
    (void)snprintf(f->title, sizeof f->title, "Plane waves: %s%s", scree_lattice_name(lattice),
                   lattice == SCREE_LATTICE_ROW ? " of discs" : " lattice");
    f->x_name = "path";
    f->x_unit = "1";
    f->x_label = "wave vector, by corners of the zone";
    f->y_unit = "rad/s";
    f->y_label = "circular frequency (rad/s)";
    for (size_t k = 0; k < f->curve_count; k++) {
        const bool second = k >= branches;
        f->curve[k].name = columns[second][k % branches];
        if (k % branches == 0) f->curve[k].label = second ? "deformable" : "rigid";
        f->curve[k].colour = second ? 2 : 1;
        f->curve[k].dashed = second;
    }
    for (size_t row = 0; row < f->points; row++) find_point(f, lattice, m, row);
    return SCREE_OK;
}

scree_status scree_theory_lattice(const scree_theory_lattice_of *of, scree_theory **theory, scree_error *error)
{
    scree_lattice lattice = SCREE_LATTICE_ROW;
    *theory = NULL;
    scree_status status = find_kind(of->kind, &lattice, error);
    if (!status) status = check(of, error);
    if (!status) status = theory_create(theory, error);
    if (status) return status;
    const scree_lattice_material m = material_of(of, lattice, of->young_modulus);
    scree_lattice_material rigid = m;
    rigid.shear = rigid.trace = 0;
    add_limits(*theory, of, lattice, &m);
    add_steps(*theory, lattice, &m);
    if (lattice == SCREE_LATTICE_ROW) {
        add_row(*theory, &m);
    } else {
        add_moduli(*theory, &deformed_names, lattice, &m);
        if (m.shear > 0) add_moduli(*theory, &rigid_names, lattice, &rigid);
        add_voigt(*theory, lattice, &m);
    }
    status = add_waves(*theory, lattice, &m, error);
    if (!status) return SCREE_OK;
    scree_theory_free(*theory);
    *theory = NULL;
    return status;
}
