/// files.txt of a run folder. Lines are appended and flushed to the disk; a line that a power cut or a full disk has
/// torn has no newline, does not count, and is cut off before the next is appended.
#include "io/manifest.h"

#include "base/memory.h"
#include "io/file_names.h"
#include "io/replacement.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define HEAD "# What Scree has written into this folder. `scree run --force` removes these files and nothing else.\n"

/// A run folder, and a name in it.
typedef struct place {
    char directory[PATH_MAX];
    char name[NAME_MAX + 16]; ///< "figures/" and a name
} place;

static scree_status fail(const char *directory, scree_error *error)
{
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write the list of files '%s/" SCREE_FILE_MANIFEST "'",
                                 directory);
}

static bool has_list(const char *directory)
{
    char path[PATH_MAX];
    return !scree_path_join(path, sizeof path, directory, SCREE_FILE_MANIFEST, NULL) && access(path, F_OK) == 0;
}

/// The folder that `path` lies in, and the last part of the path.
static const char *split(const char *path, char folder[PATH_MAX])
{
    const char *slash = strrchr(path, '/');
    int length = slash ? (int)(slash - path) : 0;
    while (length > 0 && path[length - 1] == '/') length--;
    (void)snprintf(folder, PATH_MAX, "%.*s%s", length, path, length > 0 ? "" : slash ? "/" : ".");
    return slash ? slash + 1 : path;
}

/// The run folder that the file `path` lies in, and its name there; false when it lies in none.
static bool find_place(const char *path, place *found)
{
    char folder[PATH_MAX];
    if (strlen(path) >= PATH_MAX) return false;
    const char *name = split(path, folder);
    if (strlen(name) > NAME_MAX) return false;
    (void)snprintf(found->name, sizeof found->name, "%s", name);
    memcpy(found->directory, folder, sizeof folder);
    if (has_list(folder)) return true;
    const char *last = split(folder, found->directory);
    bool own = strcmp(last, SCREE_FOLDER_FIGURES) == 0 || strcmp(last, SCREE_FOLDER_PARAVIEW) == 0;
    if (!own || !has_list(found->directory)) return false;
    (void)snprintf(found->name, sizeof found->name, "%.10s/%s", last, name);
    return true;
}

static scree_status read_all(int file, char **text, size_t *length, scree_error *error)
{
    struct stat about;
    if (fstat(file, &about) != 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read a list of files");
    size_t size = about.st_size > 0 ? (size_t)about.st_size : 0;
    *length = 0;
    scree_status status = scree_allocate(text, size + 1, 1, error);
    while (!status && *length < size) {
        ssize_t got = pread(file, *text + *length, size - *length, (off_t)*length);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read a list of files");
        if (got <= 0) break;
        *length += (size_t)got;
    }
    // What stands behind the last newline is torn.
    while (!status && *length > 0 && (*text)[*length - 1] != '\n') (*text)[--*length] = 0;
    if (status) scree_release(text);
    return status;
}

static bool has_line(const char *text, const char *line, size_t length)
{
    for (const char *at = strchr(text, '\n'); at; at = strchr(at + 1, '\n'))
        if (strncmp(at + 1, line, length) == 0 && at[1 + length] == '\n') return true;
    return false;
}

/// Appends the names that are not there yet; all with one write and one flush.
static scree_status append(int file, const place *found, const char *const *endings, size_t count, scree_error *error)
{
    char lines[4 * sizeof found->name], *text;
    size_t used = 0, length;
    scree_status status = read_all(file, &text, &length, error);
    if (status) return status;
    for (size_t i = 0; i < count; i++) {
        char line[sizeof found->name + 8];
        int size = snprintf(line, sizeof line, "%s%s\n", found->name, endings[i]);
        bool fits = size < (int)sizeof line && used + (size_t)size < sizeof lines;
        if (!fits)
            status = scree_error_set(error, SCREE_ERROR_IO, "the file name '%.100s...' is too long", found->name);
        if (!fits || has_line(text, line, (size_t)size - 1)) continue;
        memcpy(lines + used, line, (size_t)size + 1);
        used += (size_t)size;
    }
    scree_release(&text);
    if (status || used == 0) return status;
    errno = ENOSPC; // where a write takes less than it was given without saying why
    bool good = ftruncate(file, (off_t)length) == 0 && pwrite(file, lines, used, (off_t)length) == (ssize_t)used &&
                fsync(file) == 0;
    return good ? SCREE_OK : fail(found->directory, error);
}

scree_status scree_manifest_add(const char *path, const char *const *endings, size_t count, scree_error *error)
{
    place found;
    char list[PATH_MAX];
    if (!find_place(path, &found)) return SCREE_OK;
    scree_status status = scree_path_join(list, sizeof list, found.directory, SCREE_FILE_MANIFEST, error);
    if (status) return status;
    int file = open(list, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) return fail(found.directory, error);
    status = append(file, &found, endings, count, error);
    close(file);
    return status;
}

scree_status scree_manifest_create(const char *directory, const char *const *names, size_t count, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_MANIFEST, error);
    if (!status) status = scree_replacement_open(path, &file, error);
    if (status) return status;
    (void)fputs(HEAD, file);
    for (size_t i = 0; i < count; i++) (void)fprintf(file, "%s\n", names[i]);
    return scree_replacement_close(path, file, true, error);
}

scree_status scree_manifest_read(int directory, scree_manifest *manifest, scree_error *error)
{
    size_t length;
    *manifest = (scree_manifest){0};
    int file = openat(directory, SCREE_FILE_MANIFEST, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0 && errno == ENOENT) return SCREE_OK;
    if (file < 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '" SCREE_FILE_MANIFEST "'");
    scree_status status = read_all(file, &manifest->text, &length, error);
    manifest->there = !status;
    close(file);
    return status;
}

void scree_manifest_destroy(scree_manifest *manifest)
{
    scree_release(&manifest->text);
    manifest->there = false;
}

bool scree_manifest_has(const scree_manifest *manifest, const char *name)
{
    size_t length = strlen(name), ending = strlen(SCREE_REPLACEMENT);
    if (!manifest->text) return false;
    if (has_line(manifest->text, name, length)) return true;
    return length > ending && strcmp(name + length - ending, SCREE_REPLACEMENT) == 0 &&
           has_line(manifest->text, name, length - ending);
}

/// A name that Scree may have listed: in the folder itself or in one of two below it.
static bool is_sound(const char *name)
{
    static const char *const folders[] = {"", SCREE_FOLDER_FIGURES "/", SCREE_FOLDER_PARAVIEW "/"};
    const char *slash = strrchr(name, '/'), *last = slash ? slash + 1 : name;
    if (!last[0] || last[0] == '#' || strcmp(last, ".") == 0 || strcmp(last, "..") == 0) return false;
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++)
        if (strlen(folders[i]) == (size_t)(last - name) && strncmp(name, folders[i], (size_t)(last - name)) == 0)
            return true;
    return false;
}

bool scree_manifest_next(const scree_manifest *manifest, size_t *at, char *name, size_t size)
{
    while (manifest->text && manifest->text[*at]) {
        const char *line = manifest->text + *at;
        size_t length = strcspn(line, "\n");
        *at += length + 1; // each line that counts ends with a newline
        if (length >= size) continue;
        memcpy(name, line, length);
        name[length] = 0;
        if (is_sound(name)) return true;
    }
    return false;
}
