/// What a case says of particles of one radius.
#ifndef SCREE_SIZE_EQUAL_H
#define SCREE_SIZE_EQUAL_H

typedef struct scree_equal_config {
    double radius; ///< m
} scree_equal_config;

#endif
