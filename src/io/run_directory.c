/// The run directory: creation, refusal, emptying, and replacement of a file as a whole.
///
/// A new run is written into a folder that is new, empty, or (with `force`) anything but the root of the file system.
/// Emptying removes what files.txt lists (io/manifest.h), in parts/ the files with the numbered names of parts, and
/// nothing else; in a folder of a version without such a list only the fixed names below. Links are not followed. A
/// file is replaced by writing NAME.new, flushing it to the disk, and renaming.
#include "io/run_directory.h"

#include "io/manifest.h"

#include <scree/scree.h>

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LONGEST_FILE_NAME = 64 }; ///< below the run directory, with its subfolder

/// What every run writes, listed at once; what a case adds to it is listed when it is written.
static const char *const usual_files[] = {SCREE_FILE_CASE, SCREE_FILE_SUMMARY, SCREE_FILE_SERIES, SCREE_FILE_RUN,
                                          SCREE_FILE_LOG};
/// What runs of versions without a list wrote beside that, under fixed names.
static const char *const former_files[] = {"walls.csv",          SCREE_FILE_CELLS,     SCREE_FILE_BANDS,
                                           SCREE_FILE_RUN_WHOLE, "rotation-decay.csv", "rotation-rose.csv",
                                           "rotation-bodies.csv"};
enum {
    USUAL_FILES = sizeof usual_files / sizeof *usual_files,
    FORMER_FILES = sizeof former_files / sizeof *former_files
};

static const char *const own_folders[] = {SCREE_FOLDER_FIGURES, SCREE_FOLDER_PARAVIEW, SCREE_FOLDER_PARTS};
enum { OWN_FOLDERS = sizeof own_folders / sizeof *own_folders };

/// `name` is `stem`, or what a replacement left beside it.
static bool stands_for(const char *name, const char *stem)
{
    size_t length = strlen(stem);
    return strncmp(name, stem, length) == 0 && (name[length] == 0 || strcmp(name + length, SCREE_REPLACEMENT) == 0);
}

static bool is_one_of(const char *name, const char *const *stems, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (stands_for(name, stems[i])) return true;
    return false;
}

/// "snapshot-000012.h5" and "checkpoint-000003.h5", or what a replacement left beside them.
static bool is_part(const char *name)
{
    static const char *const kinds[] = {"snapshot-", "checkpoint-"};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        size_t length = strlen(kinds[i]), digits = length;
        if (strncmp(name, kinds[i], length) != 0) continue;
        while (isdigit((unsigned char)name[digits])) digits++;
        return digits > length && stands_for(name + digits, ".h5");
    }
    return false;
}

/// Whether Scree wrote the file of this name in the run folder itself.
static bool is_own_file(const scree_manifest *manifest, const char *name)
{
    if (manifest->there) return scree_manifest_has(manifest, name) || stands_for(name, SCREE_FILE_MANIFEST);
    return is_one_of(name, usual_files, USUAL_FILES) || is_one_of(name, former_files, FORMER_FILES);
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

/// Number of entries of a folder below `parent` whose names begin with `prefix`.
static size_t count_entries(int parent, const char *name, const char *prefix)
{
    DIR *folder = open_folder(parent, name);
    size_t count = 0;
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        count += entry->d_name[0] != '.' && strncmp(entry->d_name, prefix, strlen(prefix)) == 0;
    if (folder) closedir(folder);
    return count;
}

/// A folder of that name is not Scree's.
static bool remove_file(int parent, const char *name)
{
    return unlinkat(parent, name, 0) == 0 || errno == ENOENT || errno == EISDIR;
}

/// Removes a file of the run, whose name may begin with one of its folders, and what a replacement left beside it.
static bool remove_listed(int parent, const char *name)
{
    char half[NAME_MAX + sizeof SCREE_REPLACEMENT];
    const char *slash = strchr(name, '/');
    int folder = parent;
    if (slash) {
        (void)snprintf(half, sizeof half, "%.*s", (int)(slash - name), name);
        folder = openat(parent, half, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        // A link, or a file, in place of the folder is not Scree's.
        if (folder < 0) return errno == ENOENT || errno == ENOTDIR || errno == ELOOP;
        name = slash + 1;
    }
    (void)snprintf(half, sizeof half, "%s" SCREE_REPLACEMENT, name);
    bool good = remove_file(folder, name) && remove_file(folder, half);
    int number = errno;
    if (slash) close(folder);
    errno = number;
    return good;
}

static bool remove_parts(int parent)
{
    DIR *folder = open_folder(parent, SCREE_FOLDER_PARTS);
    bool good = true;
    for (struct dirent *entry; folder && good && (entry = readdir(folder));)
        if (is_part(entry->d_name)) good = remove_file(dirfd(folder), entry->d_name);
    if (folder) closedir(folder);
    return good;
}

/// The folders go when nothing is left in them, and the list goes last: a removal that is cut short can go on.
static scree_status remove_old_run(int here, const scree_manifest *manifest, const char *path, scree_error *error)
{
    char name[NAME_MAX + 16] = SCREE_FOLDER_PARTS;
    bool good = remove_parts(here);
    for (size_t at = 0; good && scree_manifest_next(manifest, &at, name, sizeof name);)
        good = remove_listed(here, name);
    for (size_t i = 0; good && !manifest->there && i < USUAL_FILES + FORMER_FILES; i++) {
        (void)snprintf(name, sizeof name, "%s", i < USUAL_FILES ? usual_files[i] : former_files[i - USUAL_FILES]);
        good = remove_listed(here, name);
    }
    for (size_t i = 0; good && i < OWN_FOLDERS; i++) (void)unlinkat(here, own_folders[i], AT_REMOVEDIR);
    if (good && remove_listed(here, SCREE_FILE_MANIFEST)) return SCREE_OK;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot remove '%s' of the old run in '%s'", name, path);
}

/// What is in a folder before a run.
typedef struct contents {
    scree_manifest manifest;
    bool run;                 ///< files of a run
    bool begun;               ///< ... that has got as far as its first checkpoint
    char other[NAME_MAX + 1]; ///< a file that is not Scree's
} contents;

static bool is_own_folder(const contents *found, const char *name)
{
    for (size_t i = 0; i < OWN_FOLDERS; i++)
        if (strcmp(name, own_folders[i]) == 0) return found->manifest.there;
    return false;
}

/// Whether a run of this version has got as far as its first checkpoint: the parts or the gathered run.h5 hold one, or
/// it ended by itself.
static bool has_begun(int here, const char *path)
{
    char status[64];
    if (count_entries(here, SCREE_FOLDER_PARTS, "checkpoint-") > 0) return true;
    if (scree_result_get(path, "status", status, sizeof status, NULL) == SCREE_OK && strcmp(status, "stopped") != 0)
        return true;
    bool gathered = faccessat(here, SCREE_FILE_RUN, F_OK, AT_SYMLINK_NOFOLLOW) == 0;
    return gathered && count_entries(here, SCREE_FOLDER_PARTS, "snapshot-") == 0;
}

static scree_status look_into(DIR *directory, const char *path, contents *found, scree_error *error)
{
    *found = (contents){0};
    scree_status status = scree_manifest_read(dirfd(directory), &found->manifest, error);
    if (status) return status;
    for (struct dirent *entry; (entry = readdir(directory));) {
        const char *name = entry->d_name;
        if (is_own_file(&found->manifest, name))
            found->run = true;
        else if (name[0] != '.' && strcmp(name, SCREE_FILE_LOCK) != 0 && !is_own_folder(found, name))
            (void)snprintf(found->other, sizeof found->other, "%s", name);
    }
    found->begun = !found->manifest.there || has_begun(dirfd(directory), path);
    return SCREE_OK;
}

/// Tells, in a message without a failure, what the removal of an old run was not told of.
static void note_rest(int here, const contents *found, const char *path, scree_error *note)
{
    size_t figures = count_entries(here, SCREE_FOLDER_FIGURES, ""),
           scenes = count_entries(here, SCREE_FOLDER_PARAVIEW, "");
    if (!found->begun)
        (void)scree_error_set(note, SCREE_OK, "a run in '%s' that ended before its first checkpoint is replaced", path);
    else if (!found->manifest.there && figures + scenes > 0)
        (void)scree_error_set(note, SCREE_OK,
                              "an older version of Scree kept no list of its files: %zu in '%s/" SCREE_FOLDER_FIGURES
                              "' and %zu in '" SCREE_FOLDER_PARAVIEW "' are left alone",
                              figures, path, scenes);
}

/// Refuses a directory that is in use, or empties it of the old run when `force` is set or there is nothing to lose.
static scree_status take_over(const char *path, bool force, scree_error *error)
{
    contents found;
    DIR *directory = opendir(path);
    if (!directory) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read the folder '%s'", path);
    scree_status status = look_into(directory, path, &found, error);
    if (!status && found.run && found.begun && !force)
        status = scree_error_set(
            error, SCREE_ERROR_INPUT,
            "the folder '%s' holds another run: choose another one, or --force to replace that run", path);
    else if (!status && found.other[0] && !force)
        status = scree_error_set(error, SCREE_ERROR_INPUT,
                                 "the folder '%s' holds other files ('%s'): choose a new folder, or --force to write "
                                 "among them (they are left alone)",
                                 path, found.other);
    else if (!status && found.run)
        status = remove_old_run(dirfd(directory), &found.manifest, path, error);
    if (!status && found.run) note_rest(dirfd(directory), &found, path, error);
    scree_manifest_destroy(&found.manifest);
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

bool scree_folders_are_same(const char *one, const char *other)
{
    struct stat a, b;
    return stat(one, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

static scree_status check_path(const char *path, scree_error *error)
{
    if (!path || !path[0])
        return scree_error_set(error, SCREE_ERROR_INPUT, "a run needs a folder to write into: the name given is empty");
    if (strlen(path) + 1 + LONGEST_FILE_NAME >= PATH_MAX)
        return scree_error_set(error, SCREE_ERROR_INPUT, "the name of the run's folder has %zu bytes, at most %d work",
                               strlen(path), PATH_MAX - LONGEST_FILE_NAME - 2);
    if (scree_folders_are_same(path, "/"))
        return scree_error_set(error, SCREE_ERROR_INPUT, "'%s' is the root of the file system: choose another folder",
                               path);
    return SCREE_OK;
}

scree_status scree_run_directory_lock(const char *path, scree_folder_lock *lock, scree_error *error)
{
    *lock = (scree_folder_lock){0};
    scree_status status = check_path(path, error);
    if (!status) status = scree_folders_make(path, error);
    return status ? status : scree_folder_lock_take(lock, path, "scree run", error);
}

scree_status scree_run_directory_create(const char *path, bool force, scree_error *error)
{
    scree_error nowhere;
    if (!error) error = &nowhere;
    memset(error, 0, sizeof *error);
    scree_status status = check_path(path, error);
    if (!status) status = scree_folders_make(path, error);
    if (!status) status = take_over(path, force, error);
    if (!status) status = scree_manifest_create(path, usual_files, USUAL_FILES, error);
    for (size_t i = 0; i < OWN_FOLDERS && !status; i++) {
        char folder[PATH_MAX];
        status = scree_path_join(folder, sizeof folder, path, own_folders[i], error);
        if (!status && mkdir(folder, 0777) != 0 && errno != EEXIST)
            status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot make the folder '%s'", folder);
    }
    return status;
}

// ---- one file ----------------------------------------------------------------------------------------------------

scree_status scree_replace_begin(const char *path, FILE **file, scree_error *error)
{
    *file = NULL;
    scree_status status = scree_manifest_add(path, &(const char *){""}, 1, error);
    return status ? status : scree_replacement_open(path, file, error);
}

scree_status scree_replace_finish(const char *path, FILE *file, bool keep, scree_error *error)
{
    return scree_replacement_close(path, file, keep, error);
}

scree_status scree_file_copy(const char *from, const char *to, scree_error *error)
{
    char block[65536];
    size_t count;
    FILE *file, *source = fopen(from, "rbe");
    if (!source) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '%s'", from);
    scree_status status = scree_replace_begin(to, &file, error);
    while (!status && (count = fread(block, 1, sizeof block, source)) > 0)
        if (fwrite(block, 1, count, file) != count) break; // finish says why
    const bool whole = !ferror(source);
    (void)fclose(source);
    return status ? status : scree_replace_finish(to, file, whole, error);
}
