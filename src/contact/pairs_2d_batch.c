/// The kernel of discs: contact/pairs.h with the dimension as a constant.
#include "contact/pairs.h"

PAIRS_KERNEL(pairs_2d, PAIRS_2D)
