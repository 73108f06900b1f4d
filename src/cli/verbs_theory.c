/// The table of verbs: theories.
#include "cli/verbs.h"

#define OPTION_PHI                                                                                                     \
    {                                                                                                                  \
        .name = "phi", .value = "DEGREES", .meaning = "angle of repose: slope of both sides, and internal friction"    \
    }
#define OPTIONS_OF_PILES                                                                                               \
    {.name = "height", .value = "M", .meaning = "depth of the base below the apex", .preset = "1"},                    \
        {.name = "density",                                                                                            \
         .value = "KG/M3",                                                                                             \
         .meaning = "of the pile: that of its grains times their solid fraction",                                      \
         .preset = "1"},                                                                                               \
        {.name = "gravity", .value = "M/S2", .meaning = "acceleration", .preset = "1"},                                \
    {                                                                                                                  \
        .name = "output", .letter = 'o', .value = "DIR",                                                               \
        .meaning = "write values.csv, and the stresses on the base as tables and figures, into DIR",                   \
        .kind = SCREE_VALUE_FOLDER                                                                                     \
    }
#define OPTIONS_OF_LOADS                                                                                               \
    {.name = "force", .value = "N/M", .meaning = "load, a length across the plane", .preset = "1"},                    \
    {                                                                                                                  \
        .name = "output", .letter = 'o', .value = "DIR",                                                               \
        .meaning = "write values.csv, and the stresses of cuts as tables and figures, into DIR",                       \
        .kind = SCREE_VALUE_FOLDER                                                                                     \
    }
#define PRINTED                                                                                                        \
    "Prints a line a value, with the residuals of all equations (check_...); `-o` writes them, and the stresses on "   \
    "the base with figures. Compression is positive. All values are SI; without options but the angle stresses are "   \
    "in "                                                                                                              \
    "units of density, gravity and height. docs/theory/piles.md has the equations."

const scree_verb scree_theory_verbs[] = {
    {
        .name = "theory lattice",
        .meaning = "limits, moduli, critical steps and waves of a lattice, from closed forms",
        .text =
            "Equal discs (row, square, hexagonal) or spheres (simple_cubic, body_centred, face_centred) that touch, "
            "with springs k_n and k_t at each contact, rigid or deformed by their mean stress (DDEM, Madan 2019): "
            "the largest k_n / E_p of explicit strains, the elasticity of the unbounded lattice, in its axes and "
            "as the nearest isotropic tensor, Voigt's estimate of it, the critical step of each scheme as that of the "
            "fastest wave, and "
            "the frequencies of all plane waves along the usual path through the zone.\n\n"
            "Prints a line a value; `-o` writes them as a table, with the waves as a table and a figure. All values "
            "are SI; "
            "without options everything is 1, so that results are in units of k_n, the radius and the mass.",
        .option = {{.name = "kind",
                    .value = "LATTICE",
                    .meaning = "row, square, hexagonal, simple_cubic, body_centred or face_centred",
                    .preset = "hexagonal"},
                   {.name = "kn", .value = "N/M", .meaning = "normal stiffness of a contact", .preset = "1"},
                   {.name = "kt", .value = "RATIO", .meaning = "tangential over normal stiffness", .preset = "0"},
                   {.name = "young-modulus", .value = "PA", .meaning = "of the particles", .preset = "rigid"},
                   {.name = "poisson-ratio", .value = "NU", .meaning = "of the particles", .preset = "0"},
                   {.name = "plane", .value = "CONDITION", .meaning = "of discs: strain or stress", .preset = "strain"},
                   {.name = "tangential",
                    .value = "FORM",
                    .meaning = "as_published; or corrected: strains stretch tangential springs, too",
                    .preset = "as_published"},
                   {.name = "radius", .value = "M", .meaning = "of the particles", .preset = "1"},
                   {.name = "length", .value = "M", .meaning = "of discs", .preset = "1"},
                   {.name = "density", .value = "KG/M3", .meaning = "of the particles", .preset = "1"},
                   {.name = "output",
                    .letter = 'o',
                    .value = "DIR",
                    .meaning = "write values.csv, the table of waves and the figure into DIR",
                    .kind = SCREE_VALUE_FOLDER}},
        .example = {{"scree theory lattice --kind hexagonal --kt 0.5", "in units of k_n, radius and mass"},
                    {"scree theory lattice --kind square --young-modulus 2 -o square",
                     "discs that deform; the figure of their waves"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_theory_lattice,
    },
    {
        .name = "theory ife",
        .meaning = "a sand pile that is everywhere at the limit of failure",
        .text = "The pile yields at every point (Mohr and Coulomb), in the active state on its axis. It has a rounded "
                "peak of stress below the apex.\n\n" PRINTED,
        .option = {OPTION_PHI, OPTIONS_OF_PILES},
        .example = {{"scree theory ife --phi 28", "in units of density, gravity and height"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_theory_pile,
    },
    {
        .name = "theory bcc",
        .meaning = "a sand pile with a constant ratio of horizontal to vertical stress",
        .text = "Bouchaud, Cates and Claudin: sigma_xx = eta_0 sigma_yy, eta_0 being the ratio at a surface that "
                "yields. The stress has a plateau below the apex.\n\n" PRINTED,
        .option = {OPTION_PHI, OPTIONS_OF_PILES},
        .example = {{"scree theory bcc --phi 28 -o bcc", "with figures"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_theory_pile,
    },
    {
        .name = "theory fpa",
        .meaning = "a sand pile with fixed principal axes",
        .text = "Wittmer, Cates and Claudin: the major axis of stress keeps the direction that it had at the surface "
                "when the grains were buried. The stress has a deep dip below the apex.\n\n" PRINTED,
        .option = {OPTION_PHI, OPTIONS_OF_PILES},
        .example = {{"scree theory fpa --phi 28 -o fpa", "with figures"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_theory_pile,
    },
    {
        .name = "theory osl",
        .meaning = "a sand pile with oriented stress linearity, any K and tau",
        .text =
            "Wittmer, Cates and Claudin: sigma_xx = eta sigma_yy + mu sign(x) sigma_xy, which is sigma_nn = K sigma_mm "
            "in axes turned by tau. One of eta, mu and tau is enough: the others follow where the surface yields. With "
            "eta and mu, or K and tau, both are taken as they are, and the surface may be away from yield.\n\n" PRINTED,
        .option = {OPTION_PHI,
                   {.name = "eta", .value = "X", .meaning = "of the relation"},
                   {.name = "mu", .value = "X", .meaning = "of the relation"},
                   {.name = "ratio", .value = "K", .meaning = "sigma_nn over sigma_mm, with --tau"},
                   {.name = "tau", .value = "DEGREES", .meaning = "of n from the horizontal"},
                   OPTIONS_OF_PILES},
        .example = {{"scree theory osl --phi 28 --eta 0.74", "mu, K and tau follow"},
                    {"scree theory osl --phi 28 --ratio 1 --tau 76", "fixed principal axes"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_theory_pile,
    },
    {
        .name = "theory wedge",
        .meaning = "an elasto-plastic sand pile, with one slope or two",
        .text = "Cantelaube, Didwania and Goddard: the pile yields near its slopes and is elastic inside. Three "
                "solutions: a smooth core, and two whose core yields on a ray from the apex, with a dip and with a "
                "peak of stress there.\n\n" PRINTED,
        .option = {{.name = "phi", .value = "DEGREES", .meaning = "angle of repose; or two, left and right: 28,21"},
                   {.name = "friction",
                    .value = "DEGREES",
                    .meaning = "of internal friction, not below the slopes",
                    .preset = "each side its slope; the ray the smaller one"},
                   {.name = "state",
                    .value = "STATE",
                    .meaning = "of sides with more friction than slope: active or passive",
                    .preset = "active"},
                   {.name = "axis",
                    .value = "DEGREES",
                    .meaning = "of the ray from the vertical, positive to the right; or free: the ray without shear",
                    .preset = "0"},
                   {.name = "core",
                    .value = "DEGREES",
                    .meaning = "show a core with this right boundary, too, from the vertical"},
                   OPTIONS_OF_PILES},
        .example = {{"scree theory wedge --phi 28", "boundaries of the core at 22.5, 38.6, 48.6 degrees"},
                    {"scree theory wedge --phi 28,21 -o wedge", "two slopes, with figures"},
                    {"scree theory wedge --phi 28 --core 35", "beside a core with a boundary of its own"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_theory_pile,
    },
    {
        .name = "theory flamant",
        .meaning = "a line load on an elastic half-space",
        .text =
            "Flamant: the stress below a load on a half-space, on cuts down to a depth.\n\nPrints a line a value, with "
            "the residuals of the equations (check_...); `-o` writes them, and the cuts with figures. Compression is "
            "positive. All values are SI; without options stresses are in units of force over depth.",
        .option = {{.name = "depth", .value = "M", .meaning = "of the deepest cut", .preset = "1"}, OPTIONS_OF_LOADS},
        .example = {{"scree theory flamant --force 300 --depth 0.15", "a load above a plate 15 cm below"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_theory_layer,
    },
    {
        .name = "theory layer",
        .meaning = "a line load on an elastic layer on a rigid base",
        .text = "The stress in a layer of finite thickness under a line load, by Fourier integrals. The base is rigid: "
                "smooth (no shear on it) or bonded (no displacement). Both raise the peak on the base above that of a "
                "half-space, by 44 % and by 27 to 31 %. The half-space and the other base are shown beside.\n\nPrints "
                "a line a value, with the residuals of the equations (check_...); `-o` writes them, and the cuts with "
                "figures. Compression is positive. All values are SI; without options stresses are in units of force "
                "over thickness.",
        .option = {{.name = "base", .value = "BASE", .meaning = "smooth or bonded", .preset = "bonded"},
                   {.name = "nu",
                    .value = "NU",
                    .meaning = "Poisson's ratio; a smooth base does not feel it",
                    .preset = "0.3"},
                   {.name = "plane", .value = "CONDITION", .meaning = "strain or stress", .preset = "strain"},
                   {.name = "thickness", .value = "M", .meaning = "of the layer", .preset = "1"},
                   OPTIONS_OF_LOADS},
        .example = {{"scree theory layer --nu 0.3 --base bonded", "in units of force over thickness"},
                    {"scree theory layer --base smooth --force 300 --thickness 0.15 -o layer", "with figures"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_theory_layer,
    },
};
const size_t scree_theory_verbs_count = sizeof scree_theory_verbs / sizeof scree_theory_verbs[0];
