// Two discs on a spring of our own: a loop of steps, a force that Scree does not know, and the energy balance.
//     cc own_force.c $(pkg-config --cflags --libs scree) && ./a.out
#include <math.h>
#include <scree/scree.h>
#include <string.h>

// A case can be a text. Values carry their units.
static const char text[] = "materials: [{name: rubber, young_modulus: 100 kPa, density: 1000 kg/m3, friction: 0}]\n"
                           "particles: {material: rubber, count: 2, distribution: equal, radius: 1 mm}\n"
                           "integrator: {step: 1e-5 s}\n"
                           "walls: [{shape: plane, point: [0, -1 m], normal: [0, 1]}]\n" // far away: not needed here
                           "stages:\n"
                           "  - stage: prepare\n"
                           "    method: bodies\n"
                           "    bodies: [{position: [0, 0]}, {position: [10 mm, 0]}]\n"
                           "  - {stage: relax, duration: 0.2 s}\n";
static const double stiffness = 0.2, length = 8e-3; // N/m, m

// Scree calls this once a step. Positions are views: nothing is copied; the bodies' ids say which row is which.
static int spring(void *user, scree_simulation *s, scree_loads *loads)
{
    scree_view id, position;
    scree_error error;
    double x[2];
    if (scree_simulation_view(s, "id", &id, &error) || scree_simulation_view(s, "position", &position, &error))
        return 1;
    for (size_t row = 0; row < id.count; row++)
        x[*(const uint32_t *)((const char *)id.data + row * id.stride)] =
            *(const double *)((const char *)position.data + row * position.stride);
    double stretch = x[1] - x[0] - length, pull[3] = {stiffness * stretch, 0, 0}, back[3] = {-pull[0], 0, 0};
    scree_loads_add(loads, 0, pull, NULL);
    scree_loads_add(loads, 1, back, NULL);
    *(double *)user = stretch;
    return 0;
}

int main(void)
{
    scree_case *c = NULL;
    scree_simulation *s = NULL;
    scree_problems *problems = NULL;
    scree_error error = {0};
    scree_energies energies = {0};
    double stretch = 0;
    bool done = false;
    // The bound tells Scree how large the force may become: it is what forces are rounded by, to 15 digits.
    const scree_own_force own = {.name = "spring", .function = spring, .user = &stretch, .largest_force = 1e-2};
    if (scree_case_parse(text, strlen(text), "spring", NULL, &c, &problems)) error = *scree_problems_get(problems, 0);
    if (!error.status) scree_simulation_create(c, 1, &s, &error);
    if (!error.status) scree_simulation_add_force(s, &own, &error);
    while (!error.status && !done && !scree_simulation_advance(s, 2000, &done, &error))
        printf("%.3f s  stretched by %+.4f mm\n", scree_simulation_time(s), 1e3 * stretch);
    if (!error.status && !scree_simulation_energies(s, &energies, &error))
        printf("work %.3g J, balance open by %.1g\n", energies.outside, energies.relative_residual);
    if (error.status) fprintf(stderr, "%s: %s\n", error.field, error.message);
    scree_simulation_free(s);
    scree_case_free(c);
    scree_problems_free(problems);
    return error.status;
}
