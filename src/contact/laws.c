/// The table of laws for those who do not evaluate them.
#include "contact/laws.h"

#define LAW_DECLARE(law) extern const scree_law scree_law_##law;
#define LAW_ENTRY(law)   [LAW_##law] = &scree_law_##law,
SCREE_LAWS(LAW_DECLARE)

const scree_law *const scree_laws[] = {SCREE_LAWS(LAW_ENTRY)};
const int scree_law_count = LAW_COUNT;
