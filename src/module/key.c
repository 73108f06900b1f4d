/// Choices that keys of several modules have.
#include "module/key.h"

const scree_choice scree_gradient_components[] = {
    {"xx", 0, "d v_x / d x"}, {"xy", 1, "d v_x / d y"},
    {"xz", 2, "d v_x / d z"}, {"yx", 3, "d v_y / d x"},
    {"yy", 4, "d v_y / d y"}, {"yz", 5, "d v_y / d z"},
    {"zx", 6, "d v_z / d x"}, {"zy", 7, "d v_z / d y"},
    {"zz", 8, "d v_z / d z"}, {0},
};
