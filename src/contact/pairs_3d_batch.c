/// The kernel of spheres: contact/pairs.h with the dimension as a constant.
#include "contact/pairs.h"

PAIRS_KERNEL(pairs_3d, PAIRS_3D)
