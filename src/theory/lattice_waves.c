/// Plane waves of lattices (Born and Huang 1954, par. 24, for particles that turn and are strained as well).
///
/// One particle a cell, contacts along unit vectors d, one of each opposite two. A wave of wave vector k has between
/// the two particles of a contact the phase 2 a, a = R k.d. Seen from its middle, and with rotations and strains a
/// quarter of a period behind displacements, everything is real: relative displacement and opening by the strain are
///     G (u, w) = 2 sin a u + 2 R cos a w x d          L^T e = 2 R cos a e d
/// With D = k_n d d + k_t (1 - d d), D_B = k_n d d as published and D corrected, sums over the contacts of a cell:
///     K = sum G^T D G,   W = sum L D_B L^T,   Y = sum L D G,   Z = sum G^T D_B L^T,   V S^-1 of a particle (M 2.46)
/// A wave that changes its sign in every step, or with the share s = -1 any wave, has the strain and the stiffness
/// (docs/theory/ddem.md, "Critical steps")
///     (V S^-1 - s W) e = Y (u, w)          K_s = K + s Z (V S^-1 - s W)^-1 Y
/// and the squares of its frequencies are the eigenvalues of M^-1 K_s. Those of rigid discs with k_t = 0 are textbook
/// forms: row and square 4 k_n / m sin^2 a, hexagonal 6 k_n / m in the middle of a side of the zone, so that the
/// critical step is sqrt(m / k_n) (M 3.46) and sqrt(2 m / 3 k_n).
///
/// The fastest wave is looked for on a grid of the zone, which has its corners, and from there by steps that halve.
/// Units: SI. Limits: touching particles (no overlap), no dashpots. Cost: 10 us a wave vector; a critical step of
/// spheres some 0.1 s.
#include "theory/lattice_waves.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOTIONS = SCREE_LATTICE_BRANCHES, STRAINS = 6, CONTACTS = 6, GRID = 24, HALVINGS = 26 };

#define H 0.5
#define Q 0.86602540378443865 // sqrt(3) / 2
#define T 0.57735026918962576 // 1 / sqrt(3)
#define S 0.70710678118654752 // 1 / sqrt(2)

/// The first `dimension` directions are the edges of a cell.
typedef struct crystal {
    int dimension, edges, contacts;
    double direction[CONTACTS][3];
    scree_lattice_corner path[SCREE_LATTICE_CORNERS + 1];
} crystal;

static const crystal crystals[SCREE_LATTICES + 1] = {
    [SCREE_LATTICE_ROW] = {2, 1, 1, {{1, 0, 0}}, {{"0", {0}}, {"X", {M_PI}}}},
    [SCREE_LATTICE_SQUARE] =
        {2, 2, 2, {{1, 0, 0}, {0, 1, 0}}, {{"0", {0}}, {"X", {M_PI}}, {"M", {M_PI, M_PI}}, {"0", {0}}}},
    [SCREE_LATTICE_HEXAGONAL] = {2,
                                 2,
                                 3,
                                 {{1, 0, 0}, {H, Q, 0}, {-H, Q, 0}},
                                 {{"0", {0}}, {"M", {0, 2 * M_PI *T}}, {"K", {2 * M_PI / 3, 2 * M_PI *T}}, {"0", {0}}}},
    [SCREE_LATTICE_SIMPLE_CUBIC] =
        {3,
         3,
         3,
         {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
         {{"0", {0}}, {"X", {M_PI}}, {"M", {M_PI, M_PI}}, {"0", {0}}, {"R", {M_PI, M_PI, M_PI}}}},
    // Edges of the cubic cell 2 / sqrt(3) and sqrt(2) times 2 R.
    [SCREE_LATTICE_BODY_CENTRED] = {3,
                                    3,
                                    4,
                                    {{T, T, -T}, {T, -T, T}, {-T, T, T}, {T, T, T}},
                                    {{"0", {0}},
                                     {"H", {2 * M_PI * Q}},
                                     {"N", {M_PI * Q, M_PI *Q}},
                                     {"0", {0}},
                                     {"P", {M_PI * Q, M_PI *Q, M_PI *Q}}}},
    [SCREE_LATTICE_FACE_CENTRED] = {3,
                                    3,
                                    6,
                                    {{S, S, 0}, {S, 0, S}, {0, S, S}, {S, -S, 0}, {S, 0, -S}, {0, S, -S}},
                                    {{"0", {0}},
                                     {"X", {2 * M_PI * S}},
                                     {"W", {2 * M_PI * S, M_PI *S}},
                                     {"L", {M_PI * S, M_PI *S, M_PI *S}},
                                     {"0", {0}}}},
};

const scree_lattice_corner *scree_lattice_path(scree_lattice lattice)
{
    return crystals[lattice].path;
}

int scree_lattice_contacts(scree_lattice lattice, const double (**direction)[3])
{
    *direction = crystals[lattice].direction;
    return crystals[lattice].contacts;
}

// ---- one wave vector ---------------------------------------------------------------------------------------------

/// Small matrices by rows, of the size that the dimension asks for.
typedef struct wave {
    int dimension, motions, strains;
    double stiffness[MOTIONS * MOTIONS]; ///< K
    double strained[STRAINS * STRAINS];  ///< W
    double answer[STRAINS * MOTIONS];    ///< Y
    double push[MOTIONS * STRAINS];      ///< Z
} wave;

/// Components of a strain: diagonal, then sqrt 2 times those off it.
static const int plane_pairs[3][2] = {{0, 0}, {1, 1}, {0, 1}};
static const int space_pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

/// G of a contact, dimension x motions.
static void opening(const wave *w, const double d[3], double radius, double angle, double g[3][MOTIONS])
{
    const double sine = 2 * sin(angle), lever = 2 * radius * cos(angle);
    memset(g, 0, 3 * sizeof *g);
    for (int i = 0; i < w->dimension; i++) g[i][i] = sine;
    if (w->dimension == 2) {
        g[0][2] = -lever * d[1];
        g[1][2] = lever * d[0];
        return;
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        // e_k x d
        g[j][3 + k] = lever * d[i];
        g[i][3 + k] = -lever * d[j];
    }
}

/// L^T of a contact, dimension x strains.
static void swelling(const wave *w, const double d[3], double radius, double angle, double l[3][STRAINS])
{
    const double lever = 2 * radius * cos(angle);
    const int(*pair)[2] = w->dimension == 2 ? plane_pairs : space_pairs;
    memset(l, 0, 3 * sizeof *l);
    for (int k = 0; k < w->strains; k++) {
        const int i = pair[k][0], j = pair[k][1];
        const double part = i == j ? lever : M_SQRT1_2 * lever;
        l[i][k] += part * d[j];
        if (i != j) l[j][k] += part * d[i];
    }
}

static void apply_springs(int dimension, double normal, double tangential, const double d[3], double column[3])
{
    double along = 0;
    for (int i = 0; i < dimension; i++) along += d[i] * column[i];
    for (int i = 0; i < dimension; i++) column[i] = tangential * column[i] + (normal - tangential) * along * d[i];
}

/// Adds rows^T D columns to `out`, by rows. Both have three rows and a width of 6.
static void add_product(const wave *w, const double left[3][6], int rows, const double right[3][6], int columns,
                        double *out)
{
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            for (int k = 0; k < w->dimension; k++) out[i * columns + j] += left[k][i] * right[k][j];
}

static void apply_to_columns(const wave *w, double normal, double tangential, const double d[3], double matrix[3][6])
{
    for (int j = 0; j < 6; j++) {
        double column[3] = {matrix[0][j], matrix[1][j], matrix[2][j]};
        apply_springs(w->dimension, normal, tangential, d, column);
        for (int i = 0; i < 3; i++) matrix[i][j] = column[i];
    }
}

static void add_contact(wave *w, const scree_lattice_material *m, const double d[3], double angle)
{
    double g[3][6], l[3][6], dg[3][6], dl[3][6];
    opening(w, d, m->radius, angle, g);
    swelling(w, d, m->radius, angle, l);
    memcpy(dg, g, sizeof g);
    memcpy(dl, l, sizeof l);
    apply_to_columns(w, m->normal, m->tangential, d, dg);
    apply_to_columns(w, m->normal, m->corrected ? m->tangential : 0, d, dl);
    add_product(w, (const double(*)[6])g, w->motions, (const double(*)[6])dg, w->motions, w->stiffness);
    add_product(w, (const double(*)[6])l, w->strains, (const double(*)[6])dl, w->strains, w->strained);
    add_product(w, (const double(*)[6])l, w->strains, (const double(*)[6])dg, w->motions, w->answer);
    add_product(w, (const double(*)[6])g, w->motions, (const double(*)[6])dl, w->strains, w->push);
}

/// Adds s Z (V S^-1 - s W)^-1 Y to K. False: no step is stable.
static bool soften(wave *w, const scree_lattice_material *m, double share)
{
    const int n = w->strains, d = w->dimension;
    const double volume = scree_particle_volume(d, m), shear = volume / m->shear;
    // Of S = shear + trace 1 1: S^-1 = 1 / shear - trace / (shear (shear + d trace)) 1 1.
    const double round = shear * m->trace / (m->shear + d * m->trace);
    double matrix[STRAINS * STRAINS], strain[STRAINS * MOTIONS];
    lapack_int pivot[STRAINS];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            matrix[i * n + j] = (i == j ? shear : 0) - (i < d && j < d ? round : 0) - share * w->strained[i * n + j];
    memcpy(strain, w->answer, sizeof strain);
    if (LAPACKE_dgesv(LAPACK_ROW_MAJOR, n, w->motions, matrix, n, pivot, strain, w->motions) != 0) return false;
    for (int i = 0; i < w->motions; i++)
        for (int j = 0; j < w->motions; j++)
            for (int k = 0; k < n; k++)
                w->stiffness[i * w->motions + j] += share * w->push[i * n + k] * strain[k * w->motions + j];
    return true;
}

/// Square of a frequency [rad2/s2], its real part where it grows.
typedef struct square {
    double value;
    double part; ///< of a motion of length 1
    bool grows;
} square;

static int compare(const void *a, const void *b)
{
    const double p = ((const square *)a)->value, q = ((const square *)b)->value;
    return p < q ? -1 : p > q;
}

/// From K to the matrix M^-1/2 K M^-1/2, whose eigenvalues are the squares of the frequencies.
static void divide_by_mass(wave *w, const scree_lattice_material *m)
{
    const int n = w->motions, d = w->dimension;
    const double mass = m->density * scree_particle_volume(d, m),
                 inertia = mass * m->radius * m->radius * (d == 3 ? 0.4 : 0.5);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            w->stiffness[i * n + j] /= sqrt((i < d ? mass : inertia) * (j < d ? mass : inertia));
}

/// Squares of the frequencies, ascending, with the part of the motion that is a displacement along `direction`, if that
/// is asked for.
static bool find_squares(wave *w, bool symmetric, const double *direction, square out[MOTIONS])
{
    const int n = w->motions;
    double real[MOTIONS], imaginary[MOTIONS] = {0}, motion[MOTIONS * MOTIONS], none[1];
    const char job = direction ? 'V' : 'N';
    const lapack_int failed =
        symmetric ? LAPACKE_dsyev(LAPACK_ROW_MAJOR, job, 'U', n, w->stiffness, n, real)
                  : LAPACKE_dgeev(LAPACK_ROW_MAJOR, 'N', job, n, w->stiffness, n, real, imaginary, none, n, motion, n);
    if (failed) return false;
    const double *vector = symmetric ? w->stiffness : motion;
    double largest = 0;
    for (int k = 0; k < n; k++) largest = fmax(largest, fabs(real[k]));
    for (int k = 0; k < n; k++) {
        // Two equal ones come out with an imaginary part of the order of the root of rounding.
        out[k] = (square){real[k], 0, real[k] < -1e-9 * largest || fabs(imaginary[k]) > 1e-7 * largest};
        for (int i = 0; direction && i < w->dimension; i++) out[k].part += direction[i] * vector[i * n + k];
    }
    qsort(out, (size_t)n, sizeof *out, compare);
    return true;
}

static bool find_wave(scree_lattice lattice, const scree_lattice_material *m, const double k[3], double share,
                      const double *direction, square out[MOTIONS])
{
    const crystal *c = &crystals[lattice];
    wave w = {.dimension = c->dimension, .motions = c->dimension == 3 ? 6 : 3, .strains = c->dimension == 3 ? 6 : 3};
    for (int b = 0; b < c->contacts; b++) {
        double angle = 0;
        for (int i = 0; i < c->dimension; i++) angle += m->radius * k[i] * c->direction[b][i];
        add_contact(&w, m, c->direction[b], angle);
    }
    const bool deforms = share != 0 && m->shear > 0;
    if (deforms && !soften(&w, m, share)) return false;
    divide_by_mass(&w, m);
    return find_squares(&w, !deforms || m->corrected || m->tangential == 0, direction, out);
}

static double radius_of(scree_lattice lattice, const scree_lattice_material *m)
{
    return lattice == SCREE_LATTICE_ROW ? scree_row_radius(2, m) : scree_lattice_radius(lattice, m);
}

int scree_lattice_frequencies(scree_lattice lattice, const scree_lattice_material *m, const double k[3], double share,
                              double frequency[SCREE_LATTICE_BRANCHES])
{
    square found[MOTIONS];
    const int count = crystals[lattice].dimension == 3 ? 6 : 3;
    const bool stable = share * radius_of(lattice, m) < 1 && find_wave(lattice, m, k, share, NULL, found);
    for (int b = 0; b < count; b++) frequency[b] = stable && !found[b].grows ? sqrt(fmax(found[b].value, 0)) : NAN;
    return count;
}

double scree_lattice_frequency_along(scree_lattice lattice, const scree_lattice_material *m, const double k[3],
                                     double share, const double direction[3])
{
    square found[MOTIONS];
    int most = 0;
    if (!(share * radius_of(lattice, m) < 1) || !find_wave(lattice, m, k, share, direction, found)) return NAN;
    for (int b = 1; b < (crystals[lattice].dimension == 3 ? 6 : 3); b++)
        if (fabs(found[b].part) > fabs(found[most].part)) most = b;
    return found[most].grows ? NAN : sqrt(fmax(found[most].value, 0));
}

// ---- the fastest wave --------------------------------------------------------------------------------------------

/// Wave vector of phases along the edges of a cell.
static void wave_of(const crystal *c, double radius, const double phase[3], double k[3])
{
    const double(*e)[3] = c->direction;
    memset(k, 0, 3 * sizeof *k);
    if (c->edges == 1) {
        k[0] = phase[0] / (2 * radius);
    } else if (c->edges == 2) {
        const double area = 2 * radius * (e[0][0] * e[1][1] - e[0][1] * e[1][0]);
        k[0] = (phase[0] * e[1][1] - phase[1] * e[0][1]) / area;
        k[1] = (phase[1] * e[0][0] - phase[0] * e[1][0]) / area;
    } else {
        double volume = 0, across[3][3];
        for (int a = 0; a < 3; a++)
            for (int i = 0; i < 3; i++) {
                const double *p = e[(a + 1) % 3], *q = e[(a + 2) % 3];
                across[a][i] = p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
            }
        for (int i = 0; i < 3; i++) volume += 2 * radius * e[0][i] * across[0][i];
        for (int i = 0; i < 3; i++)
            for (int a = 0; a < 3; a++) k[i] += phase[a] * across[a][i] / volume;
    }
}

typedef struct hunt {
    scree_lattice lattice;
    const scree_lattice_material *material;
    double share, best;
    double phase[3];
} hunt;

static void look(hunt *h, const double phase[3])
{
    double k[3];
    square found[MOTIONS];
    const crystal *c = &crystals[h->lattice];
    wave_of(c, h->material->radius, phase, k);
    if (!find_wave(h->lattice, h->material, k, h->share, NULL, found)) return;
    for (int b = 0; b < (c->dimension == 3 ? 6 : 3); b++)
        if (!found[b].grows && found[b].value > h->best * (1 + 1e-12)) {
            h->best = found[b].value;
            memcpy(h->phase, phase, 3 * sizeof *phase);
        }
}

/// Steps of one size around the best wave, until none is better.
static void climb(hunt *h, int edges, double step)
{
    for (bool better = true; better;) {
        const double before = h->best, from[3] = {h->phase[0], h->phase[1], h->phase[2]};
        for (int n = 0; n < 27; n++) {
            const int move[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
            double phase[3] = {0};
            if ((edges < 3 && move[2]) || (edges < 2 && move[1])) continue;
            for (int i = 0; i < edges; i++) phase[i] = from[i] + step * move[i];
            look(h, phase);
        }
        better = h->best > before * (1 + 1e-10);
    }
}

double scree_lattice_critical_step(scree_lattice lattice, const scree_lattice_material *m, double share, double k[3])
{
    const crystal *c = &crystals[lattice];
    hunt h = {.lattice = lattice, .material = m, .share = share};
    if (k) memset(k, 0, 3 * sizeof *k);
    if (share * radius_of(lattice, m) >= 1) return 0;
    // A wave and its opposite are alike: half of the zone.
    for (int i = 0; i <= GRID / 2; i++)
        for (int j = 0; j < (c->edges > 1 ? GRID : 1); j++)
            for (int l = 0; l < (c->edges > 2 ? GRID : 1); l++)
                look(&h, (const double[3]){2 * M_PI * i / GRID, 2 * M_PI * j / GRID, 2 * M_PI * l / GRID});
    double step = M_PI / GRID;
    for (int n = 0; n < HALVINGS; n++, step *= 0.5) climb(&h, c->edges, step);
    if (k) wave_of(c, m->radius, h.phase, k);
    return 2 / sqrt(h.best);
}
