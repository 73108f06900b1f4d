/// What follows from a declaration alone.
#include "module/field.h"

int scree_components(int components, int dimension)
{
    if (components == SCREE_VECTOR) return dimension;
    if (components == SCREE_AXIAL_VECTOR) return dimension == 3 ? 3 : 1;
    return components;
}

size_t scree_field_size(scree_field_type type)
{
    switch (type) {
    case SCREE_FIELD_DOUBLE:
    case SCREE_FIELD_INT64:
    case SCREE_FIELD_UINT64:
        return 8;
    case SCREE_FIELD_FLOAT:
    case SCREE_FIELD_INT32:
    case SCREE_FIELD_UINT32:
        return 4;
    case SCREE_FIELD_UINT8:
        break;
    }
    return 1;
}
