/// What a case says of sizes with their shares.
#ifndef SCREE_SIZE_TABLE_H
#define SCREE_SIZE_TABLE_H

#include <stdint.h>

typedef struct scree_table_size {
    double radius; ///< m
    double share;  ///< 1, of the number or of the mass
} scree_table_size;

typedef enum scree_table_by { SCREE_TABLE_BY_NUMBER, SCREE_TABLE_BY_MASS } scree_table_by;

typedef struct scree_table_config {
    int by; ///< scree_table_by
    scree_table_size *sizes;
    int64_t size_count;
} scree_table_config;

#endif
