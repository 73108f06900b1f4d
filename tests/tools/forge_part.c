/// forge_part FILE CHECKPOINT DATASET ROW VALUE: writes one number into the part of a run that holds this checkpoint
/// (row -1 is the last one), with a checksum that is right. Status 1 when it cannot.
#include "forged_part.h"

#include <stdlib.h>

int main(int argc, char **argv)
{
    if (argc == 6 && forge_part(argv[1], atol(argv[2]), argv[3], atol(argv[4]), atof(argv[5]))) return 0;
    printf("forge_part FILE CHECKPOINT DATASET ROW VALUE: not done\n");
    return 1;
}
