/// The run directory: creation, refusal, emptying, and replacement of a file as a whole.
///
/// A new run is written into a folder that is new, empty, or (with `force`) anything but the root of the file system.
/// Emptying removes the files that Scree writes and nothing else: the fixed names below, what was left beside them by
/// a kill in the middle of a replacement (NAME.*), and in Scree's own subfolders the files with Scree's extensions.
/// Links are removed, never followed. A file is replaced by writing NAME.new, flushing it to the disk, and renaming.
#include "io/run_directory.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define REPLACEMENT ".new"
enum { LONGEST_FILE_NAME = 64 }; ///< below the run directory, with its subfolder

static const char *const own_files[] = {SCREE_FILE_CASE,  SCREE_FILE_SUMMARY, SCREE_FILE_SERIES, SCREE_FILE_CELLS,
                                        SCREE_FILE_BANDS, SCREE_FILE_RUN,     SCREE_FILE_LOG,
                                        SCREE_FILE_WALLS};
enum { OWN_FILE_COUNT = sizeof own_files / sizeof own_files[0] };

static const struct folder {
    const char *name;
    const char *extension[4];
} own_folders[] = {
    {SCREE_FOLDER_FIGURES, {".svg", ".png", ".gp", ".csv"}},
    {SCREE_FOLDER_PARAVIEW, {".pvd", ".vtp", ".vtu"}},
    {SCREE_FOLDER_PARTS, {".h5"}},
};
enum { OWN_FOLDER_COUNT = sizeof own_folders / sizeof own_folders[0] };

scree_status scree_path_join(char *path, size_t size, const char *directory, const char *name, scree_error *error)
{
    size_t length = strlen(directory);
    const char *separator = length > 0 && directory[length - 1] != '/' ? "/" : "";
    int written = snprintf(path, size, "%s%s%s", directory, separator, name);
    if (written < 0 || (size_t)written >= size)
        return scree_error_set(error, SCREE_ERROR_INPUT, "the path '%.100s...' is too long: %zu bytes at most",
                               directory, size - 1);
    return SCREE_OK;
}

/// `name` is `stem`, or what a replacement left beside it.
static bool stands_for(const char *name, const char *stem)
{
    size_t length = strlen(stem);
    return strncmp(name, stem, length) == 0 && (name[length] == 0 || name[length] == '.');
}

static bool is_own_file(const char *name)
{
    for (size_t i = 0; i < OWN_FILE_COUNT; i++)
        if (stands_for(name, own_files[i])) return true;
    return false;
}

static bool has_own_extension(const char *name, const struct folder *folder)
{
    for (size_t i = 0; i < sizeof folder->extension / sizeof folder->extension[0] && folder->extension[i]; i++) {
        const char *found = strstr(name, folder->extension[i]);
        if (found && stands_for(found, folder->extension[i])) return true;
    }
    return false;
}

/// Opens a folder below `parent`, or NULL with errno; a link is not followed.
static DIR *open_folder(int parent, const char *name)
{
    int descriptor = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) return NULL;
    DIR *folder = fdopendir(descriptor);
    if (!folder) close(descriptor);
    return folder;
}

/// Removes Scree's files from one of its subfolders, and the folder itself when nothing else is left in it.
static bool empty_own_folder(int parent, const struct folder *own)
{
    DIR *folder = open_folder(parent, own->name);
    if (!folder) return errno == ENOENT || unlinkat(parent, own->name, 0) == 0;
    bool good = true;
    for (struct dirent *entry; good && (entry = readdir(folder));)
        if (has_own_extension(entry->d_name, own)) good = unlinkat(dirfd(folder), entry->d_name, 0) == 0;
    closedir(folder);
    if (!good) return false;
    return unlinkat(parent, own->name, AT_REMOVEDIR) == 0 || errno == ENOTEMPTY || errno == EEXIST;
}

/// Subfolders first and only beside a log: without one, a folder `figures` is the user's own.
static scree_status remove_old_run(DIR *directory, const char *path, scree_error *error)
{
    int here = dirfd(directory);
    bool logged = faccessat(here, SCREE_FILE_LOG, F_OK, AT_SYMLINK_NOFOLLOW) == 0;
    for (size_t i = 0; i < OWN_FOLDER_COUNT && logged; i++)
        if (!empty_own_folder(here, &own_folders[i]))
            return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot remove '%s' of the old run in '%s'",
                                         own_folders[i].name, path);
    rewinddir(directory);
    for (struct dirent *entry; (entry = readdir(directory));)
        if (is_own_file(entry->d_name) && unlinkat(here, entry->d_name, 0) != 0)
            return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot remove '%s' of the old run in '%s'",
                                         entry->d_name, path);
    return SCREE_OK;
}

/// Refuses a directory that is in use, or empties it of the old run when `force` is set.
static scree_status take_over(const char *path, bool force, scree_error *error)
{
    struct stat self, root;
    if (stat(path, &self) == 0 && stat("/", &root) == 0 && self.st_dev == root.st_dev && self.st_ino == root.st_ino)
        return scree_error_set(error, SCREE_ERROR_INPUT, "'%s' is the root of the file system: choose another folder",
                               path);
    DIR *directory = opendir(path);
    if (!directory) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read the folder '%s'", path);
    bool run = false;
    char other[NAME_MAX + 1] = "";
    for (struct dirent *entry; (entry = readdir(directory));) {
        if (is_own_file(entry->d_name))
            run = true;
        else if (entry->d_name[0] != '.')
            (void)snprintf(other, sizeof other, "%s", entry->d_name);
    }
    scree_status status = SCREE_OK;
    if (run && !force)
        status = scree_error_set(
            error, SCREE_ERROR_INPUT,
            "the folder '%s' holds another run: choose another one, or --force to replace that run", path);
    else if (other[0] && !force)
        status = scree_error_set(error, SCREE_ERROR_INPUT,
                                 "the folder '%s' holds other files ('%s'): choose a new folder, or --force to write "
                                 "among them (they are left alone)",
                                 path, other);
    else if (run)
        status = remove_old_run(directory, path, error);
    closedir(directory);
    return status;
}

scree_status scree_folders_make(const char *path, scree_error *error)
{
    char part[PATH_MAX];
    scree_status status = scree_path_join(part, sizeof part, path, "", error);
    if (status) return status;
    for (char *end = strchr(part + 1, '/'); end; end = strchr(end + 1, '/')) {
        *end = 0;
        struct stat information;
        int made = mkdir(part, 0777);
        if (made != 0 && errno != EEXIST)
            return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot make the folder '%s'", part);
        if (made != 0 && stat(part, &information) == 0 && !S_ISDIR(information.st_mode))
            return scree_error_set(error, SCREE_ERROR_INPUT, "'%s' is a file: a run needs a folder", part);
        *end = '/';
    }
    return SCREE_OK;
}

scree_status scree_run_directory_create(const char *path, bool force, scree_error *error)
{
    if (!path || !path[0])
        return scree_error_set(error, SCREE_ERROR_INPUT, "a run needs a folder to write into: the name given is empty");
    if (strlen(path) + 1 + LONGEST_FILE_NAME >= PATH_MAX)
        return scree_error_set(error, SCREE_ERROR_INPUT, "the name of the run's folder has %zu bytes, at most %d work",
                               strlen(path), PATH_MAX - LONGEST_FILE_NAME - 2);
    scree_status status = scree_folders_make(path, error);
    if (status || (status = take_over(path, force, error))) return status;
    for (size_t i = 0; i < OWN_FOLDER_COUNT; i++) {
        char folder[PATH_MAX];
        status = scree_path_join(folder, sizeof folder, path, own_folders[i].name, error);
        if (status) return status;
        if (mkdir(folder, 0777) != 0 && errno != EEXIST)
            return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot make the folder '%s'", folder);
    }
    return SCREE_OK;
}

static scree_status replacement_name(char *name, size_t size, const char *path, scree_error *error)
{
    int length = snprintf(name, size, "%s" REPLACEMENT, path);
    if (length < 0 || (size_t)length >= size)
        return scree_error_set(error, SCREE_ERROR_INPUT, "the path '%.100s...' is too long", path);
    return SCREE_OK;
}

scree_status scree_replace_begin(const char *path, FILE **file, scree_error *error)
{
    char name[PATH_MAX];
    *file = NULL;
    scree_status status = replacement_name(name, sizeof name, path, error);
    if (status) return status;
    *file = fopen(name, "wbe");
    if (!*file) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", name);
    return SCREE_OK;
}

scree_status scree_replace_finish(const char *path, FILE *file, bool keep, scree_error *error)
{
    char name[PATH_MAX];
    scree_status status = replacement_name(name, sizeof name, path, error);
    if (status) {
        fclose(file);
        return status;
    }
    // A write that failed earlier left the stream's error flag, but not always errno.
    errno = 0;
    bool good = fflush(file) == 0 && !ferror(file) && fsync(fileno(file)) == 0;
    int number = errno ? errno : EIO;
    if (fclose(file) != 0 && good) {
        good = false;
        number = errno;
    }
    if (keep && good && rename(name, path) != 0) {
        good = false;
        number = errno;
    }
    if (!keep || !good) unlink(name);
    if (!keep || good) return SCREE_OK;
    errno = number;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", path);
}
