/// What a case says of a gas.
#ifndef SCREE_PREPARE_GAS_H
#define SCREE_PREPARE_GAS_H

typedef struct scree_gas_config {
    double solid_fraction; ///< 1; auto: 30 % of discs, 15 % of spheres
    double velocity;       ///< m/s, root-mean-square component
} scree_gas_config;

#endif
