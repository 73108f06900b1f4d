/// Keepers: memory that is looked at from somewhere that cannot know when its owner goes, as bindings of other
/// languages.
#ifndef SCREE_KEEPER_H
#define SCREE_KEEPER_H

#include <scree/api.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scree_keeper scree_keeper; ///< keeps the memory of a view

/// Lets go of what it keeps, NULL: nothing. Any thread may do it.
SCREE_API void scree_keeper_free(scree_keeper *keeper);

#ifdef __cplusplus
}
#endif
#endif
