/// Files that a case names beside its own: where they lie, and what is in them.
#ifndef SCREE_CASE_OWN_FILE_H
#define SCREE_CASE_OWN_FILE_H

#include "case/check.h"

/// The key `checksum` of such a file.
#define SCREE_OWN_FILE_CHECKSUM(owner, member, ...)                                                                    \
    KEY(owner, member, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),                                        \
        .meaning = "Of the content of the file: another one is refused; auto: any.", __VA_ARGS__)

/// Makes the path of the file under SECTION.file absolute, and gives SECTION.checksum what is in it: in the config and
/// in the tree, so that a run that is taken up again reads the same. False: it is missing, cannot be read, or has
/// another checksum, and that has been noted. Cost: reads the file.
bool scree_own_file_find(scree_reader *reader, const char *section, char **file, char **checksum);

#endif
