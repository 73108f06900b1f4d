/// What a case says of growth.
#ifndef SCREE_PREPARE_GROWTH_H
#define SCREE_PREPARE_GROWTH_H

typedef struct scree_growth_config {
    double solid_fraction; ///< 1; auto: 80 % of discs, 60 % of spheres, less what the walls take
} scree_growth_config;

#endif
