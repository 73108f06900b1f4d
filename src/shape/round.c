/// Round particles: discs, which are cylinders whose axis is normal to the plane, and spheres. One radius says all.
#include "module/key.h"
#include "module/shape.h"

#include <math.h>

static double disc_area(double square)
{
    return M_PI * square;
}

static double sphere_volume(double cube)
{
    return 4.0 / 3.0 * M_PI * cube;
}

static const scree_choice_of choice[] = {{.key = "particles.shape"}, {.key = "particles.species.shape"}, {0}};

const scree_module scree_module_disc = {
    .name = "disc",
    .meaning = "a cylinder whose axis is normal to the plane, in two dimensions",
    .choice_of = choice,
    .shape = &(const scree_shape){.dimension = 2,
                                  .elsewhere = "sphere",
                                  .only_here = "in three dimensions particles are spheres: set particles.shape "
                                               "to sphere",
                                  .round = true,
                                  .volume = disc_area},
    .spreads = true,
};

const scree_module scree_module_sphere = {
    .name = "sphere",
    .meaning = "in three dimensions",
    .choice_of = choice,
    .shape = &(const scree_shape){.dimension = 3,
                                  .elsewhere = "disc",
                                  .only_here = "spheres need dimension: 3; in two dimensions particles are discs",
                                  .round = true,
                                  .volume = sphere_volume},
    .spreads = true,
};
