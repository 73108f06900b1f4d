/// Files that a case names: see own_file.h.
#include "case/own_file.h"

#include "base/checksum.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool find_checksum(const char *path, char text[24])
{
    enum { CHUNK = 1 << 16 };
    char bytes[CHUNK];
    FILE *file = fopen(path, "rbe");
    if (!file) return false;
    uint64_t checksum = 0;
    for (size_t got; (got = fread(bytes, 1, sizeof bytes, file)) > 0;)
        checksum = scree_checksum_bytes(scree_checksum_word(checksum, got), bytes, got);
    bool whole = !ferror(file);
    (void)fclose(file);
    (void)snprintf(text, 24, "x%016" PRIx64, checksum);
    return whole;
}

bool scree_own_file_find(scree_reader *reader, const char *section, char **file, char **checksum)
{
    char whole[2 * PATH_MAX], path[PATH_MAX], found[24], key[2][SCREE_PATH_BYTES];
    if (!*file) return false; // missing, and noted
    scree_key_join(key[0], section, "file");
    scree_key_join(key[1], section, "checksum");
    scree_file_beside(reader, *file, whole, sizeof whole);
    errno = 0;
    if (!realpath(whole, path) || !find_checksum(path, found)) {
        scree_rule_refuse(reader, key[0], NULL, "the file cannot be read: %s", strerror(errno));
        return false;
    }
    if (*checksum && strcmp(*checksum, found) != 0) {
        scree_rule_refuse(reader, key[1], found, "the file has changed: its checksum is %s now", found);
        return false;
    }
    scree_rule_set_text(reader, key[0], path, file);
    scree_rule_set_text(reader, key[1], found, checksum);
    return true;
}
