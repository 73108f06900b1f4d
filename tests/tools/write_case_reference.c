/// Prints the case reference: build/tests/write_case_reference > docs/case-reference.md
#include <scree/scree.h>

int main(void)
{
    scree_error error;
    return (int)scree_schema_write_manual(stdout, &error);
}
