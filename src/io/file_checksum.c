/// Writing and checking, block by block. The checksum chain (base/checksum.h) goes by words, so a block is a multiple
/// of 8.
#include "io/file_checksum.h"

#include "base/checksum.h"

#include <stdbool.h>
#include <stdio.h>

static const char mark[8] = {'S', 'C', 'R', 'E', 'E', 's', 'u', 'm'};
enum { BLOCK = 1 << 16 };

static void fill_checksum(uint64_t checksum, uint64_t size, unsigned char ending[SCREE_FILE_CHECKSUM_SIZE])
{
    checksum = scree_checksum_word(checksum, size);
    memcpy(ending, mark, sizeof mark);
    memcpy(ending + sizeof mark, &checksum, sizeof checksum);
}

void scree_file_checksum_make(const void *bytes, size_t size, unsigned char ending[SCREE_FILE_CHECKSUM_SIZE])
{
    fill_checksum(scree_checksum_bytes(0, bytes, size), size, ending);
}

/// Checksum of the first `size` bytes from where `file` stands; false when there are fewer.
static bool checksum_of_file(FILE *file, uint64_t size, unsigned char ending[SCREE_FILE_CHECKSUM_SIZE])
{
    unsigned char block[BLOCK];
    uint64_t checksum = 0;
    for (uint64_t left = size; left > 0;) {
        size_t wanted = left < BLOCK ? (size_t)left : BLOCK;
        if (fread(block, 1, wanted, file) != wanted) return false;
        checksum = scree_checksum_bytes(checksum, block, wanted);
        left -= wanted;
    }
    fill_checksum(checksum, size, ending);
    return true;
}

/// Length of an open file, or -1; the file stands at its start afterwards.
static off_t length_of(FILE *file)
{
    off_t length = fseeko(file, 0, SEEK_END) == 0 ? ftello(file) : -1;
    return length >= 0 && fseeko(file, 0, SEEK_SET) == 0 ? length : -1;
}

scree_status scree_file_checksum_append(const char *path, scree_error *error)
{
    unsigned char ending[SCREE_FILE_CHECKSUM_SIZE];
    FILE *file = fopen(path, "r+be");
    if (!file) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot open '%s'", path);
    off_t length = length_of(file);
    bool good = length >= 0 && checksum_of_file(file, (uint64_t)length, ending) && fseeko(file, 0, SEEK_END) == 0 &&
                fwrite(ending, 1, sizeof ending, file) == sizeof ending;
    good = fclose(file) == 0 && good;
    return good ? SCREE_OK : scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", path);
}

scree_status scree_file_checksum_check(const char *path, scree_error *error)
{
    unsigned char expected[SCREE_FILE_CHECKSUM_SIZE], found[SCREE_FILE_CHECKSUM_SIZE];
    FILE *file = fopen(path, "rbe");
    if (!file) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot open '%s'", path);
    off_t length = length_of(file);
    bool good = length >= SCREE_FILE_CHECKSUM_SIZE &&
                checksum_of_file(file, (uint64_t)length - SCREE_FILE_CHECKSUM_SIZE, expected) &&
                fread(found, 1, sizeof found, file) == sizeof found && memcmp(found, expected, sizeof found) == 0;
    (void)fclose(file);
    if (good) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_IO, "'%s' is cut, damaged or was changed: its checksum does not match",
                           path);
}
