/// Views: fields of a simulation as arrays, where they lie, without a copy.
#ifndef SCREE_VIEW_H
#define SCREE_VIEW_H

#include <scree/error.h>

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Type of one component.
typedef enum scree_field_type {
    SCREE_FIELD_DOUBLE,
    SCREE_FIELD_INT64,
    SCREE_FIELD_UINT64,
    SCREE_FIELD_FLOAT,
    SCREE_FIELD_INT32,
    SCREE_FIELD_UINT32,
    SCREE_FIELD_UINT8
} scree_field_type;

/// Component k of element i is of `type` and lies `i * stride` bytes and k components behind `data`. Read only.
typedef struct scree_view {
    const void *data; ///< NULL without elements
    size_t count;     ///< elements: bodies in the order of their rows (the field "id" names them), contacts, nodes; 1
                      ///< of what the run has once
    int components;   ///< of an element; they lie side by side
    scree_field_type type; ///< of a component
    size_t stride;         ///< bytes from one element to the next
    double time;           ///< s, that the values are of: half a step back for velocities of a leapfrog scheme
    const char *unit;      ///< as udunits writes it, "1" for none
    const char *meaning;
} scree_view;

#ifdef __cplusplus
}
#endif
#endif
