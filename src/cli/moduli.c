/// scree moduli CASE|DIR: the elasticity of a specimen.
#include "cli/specimen_argument.h"
#include "cli/terminal.h"

#include <math.h>

static void print_row(const char *name, double value, const char *unit, const char *meaning)
{
    printf("%-24s %-12.6g %-3s %s\n", name, value + 0.0, unit, meaning);
}

static void print_moduli(const char *before, const scree_isotropic_moduli *m, const char *meaning)
{
    const struct {
        const char *name, *unit;
        double value;
    } row[] = {
        {"young_modulus", "Pa", m->young},
        {"poisson_ratio", "1", m->poisson},
        {"bulk_modulus", "Pa", m->bulk},
        {"shear_modulus", "Pa", m->shear},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        char name[64];
        (void)snprintf(name, sizeof name, "%s%s", before, row[k].name);
        print_row(name, row[k].value, row[k].unit, k == 0 ? meaning : "");
    }
}

/// C_ijkl, and of the fabric its components.
static void print_tensors(const scree_moduli *m)
{
    static const char *const pairs[2][6] = {{"xx", "yy", "xy"}, {"xx", "yy", "zz", "yz", "xz", "xy"}};
    static const int place[2][6] = {{0, 4, 1}, {0, 4, 8, 5, 2, 1}};
    const int n = m->dimension == 3 ? 6 : 3, space = m->dimension - 2;
    char name[64];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            (void)snprintf(name, sizeof name, "stiffness_%s%s", pairs[space][i], pairs[space][j]);
            print_row(name, m->stiffness[i * n + j], "Pa", "");
        }
    for (int i = 0; i < n; i++) {
        (void)snprintf(name, sizeof name, "fabric_%s", pairs[space][i]);
        print_row(name, m->fabric[place[space][i]], "1", i == 0 ? "mean of n n over the contacts" : "");
    }
}

/// Of a specimen between plates; nothing of one that is periodic.
static void print_uniaxial(const scree_moduli *m)
{
    char name[64];
    for (int i = 0; i < m->dimension; i++) {
        if (isnan(m->uniaxial_young[i])) continue;
        (void)snprintf(name, sizeof name, "uniaxial_young_modulus_%c", "xyz"[i]);
        print_row(name, m->uniaxial_young[i], "Pa", i == 0 ? "between smooth plates across this axis, sides free" : "");
        for (int j = 0; j < m->dimension; j++) {
            if (i == j) continue;
            (void)snprintf(name, sizeof name, "uniaxial_poisson_ratio_%c%c", "xyz"[i], "xyz"[j]);
            print_row(name, m->uniaxial_poisson[3 * i + j], "1", "");
        }
    }
    if (!isnan(m->pressed_bulk))
        print_row("pressed_bulk_modulus", m->pressed_bulk, "Pa", "between smooth plates all around");
}

static void print_all(const scree_moduli *m)
{
    printf("%-24s %zu\n%-24s %zu\n", "bodies", m->bodies, "contacts", m->contacts);
    print_moduli("", &m->isotropic, "of the nearest isotropic tensor");
    print_row("anisotropy", m->anisotropy, "1", "distance from it over the size of the tensor");
    print_row("asymmetry", m->asymmetry, "1", "skew part over the size of the tensor");
    print_moduli("voigt_", &m->voigt, "if rigid particles followed the mean strain");
    print_moduli("estimate_", &m->estimate, "the same from number of contacts and mean square radius");
    print_tensors(m);
    print_uniaxial(m);
}

scree_status scree_verb_moduli(const scree_command *command)
{
    scree_specimen_argument argument;
    scree_moduli moduli;
    scree_error error = {0};
    scree_status status = scree_specimen_argument_read(command, &argument);
    if (status) return status;
    status = scree_simulation_moduli(argument.simulation, argument.elasticity, &moduli, &error);
    if (status)
        status = scree_terminal_error("moduli", &error);
    else
        print_all(&moduli);
    scree_specimen_argument_free(&argument);
    return status;
}
