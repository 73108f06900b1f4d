/// A disk that a power cut can be simulated on: what a run does to its folder is recorded, call by call, and the folder
/// can be made anew as it may look when the power fails after any of them.
///
/// The calls of the library (write, fsync, rename, unlink, ...) are those below, in place of libc's. Before and after
/// each of them the folder is looked through, so that what stdio and HDF5 have written is seen, too. Model: contents
/// and names reach the disk in any order or not at all, until the file, or the folder for names, is flushed. What was
/// not flushed of a file may be there, be cut anywhere, or be zeros.
#ifndef SCREE_TESTS_POWER_CUT_H
#define SCREE_TESTS_POWER_CUT_H

#include "testing.h"

#include "base/random.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { CUT_NAMES = 200, CUT_FILES = 2000, CUT_VERSIONS = 1000, CUT_BINDINGS = 400, CUT_FOLDERS = 2, CUT_PATH = 64 };
static const char *const cut_folders[CUT_FOLDERS] = {"run", "run/parts"};

typedef struct cut_version {
    int event;
    size_t size;
    unsigned char *bytes;
} cut_version;

/// A file, whatever it is called.
typedef struct cut_file {
    ino_t inode;
    bool present; ///< at the last look
    int synced;   ///< event of each flush are among the versions: index of the newest flushed one, -1: none
    int count;
    cut_version version[CUT_VERSIONS];
    int flush_count, flush_event[CUT_VERSIONS], flush_version[CUT_VERSIONS];
} cut_file;

/// What a name has stood for: a number of a file, or -1.
typedef struct cut_name {
    char path[CUT_PATH];
    int folder, count, event[CUT_BINDINGS], file[CUT_BINDINGS];
} cut_name;

static struct {
    bool recording;
    bool still; ///< flushes do nothing, to be fast
    int event, names, files;
    cut_name name[CUT_NAMES];
    cut_file *file[CUT_FILES];
    int sync_count[CUT_FOLDERS], sync_event[CUT_FOLDERS][CUT_VERSIONS];
} cut;

static void cut_bind(const char *path, int folder, int file)
{
    int k = 0;
    while (k < cut.names && strcmp(cut.name[k].path, path) != 0) k++;
    if (k == cut.names) {
        assert_true(k < CUT_NAMES);
        cut.names++;
        cut.name[k].folder = folder;
        (void)snprintf(cut.name[k].path, CUT_PATH, "%s", path);
    }
    cut_name *name = &cut.name[k];
    if (name->count > 0 ? name->file[name->count - 1] == file : file < 0) return;
    assert_true(name->count < CUT_BINDINGS);
    name->event[name->count] = cut.event;
    name->file[name->count++] = file;
}

static int cut_file_of(ino_t inode)
{
    for (int k = 0; k < cut.files; k++)
        if (cut.file[k]->present && cut.file[k]->inode == inode) return k;
    assert_true(cut.files < CUT_FILES);
    cut.file[cut.files] = calloc(1, sizeof(cut_file));
    assert_non_null(cut.file[cut.files]);
    cut.file[cut.files]->inode = inode;
    cut.file[cut.files]->synced = -1;
    return cut.files++;
}

/// Keeps what the file holds now, if that is new.
static void cut_read(const char *path, cut_file *file, size_t size)
{
    int opened = (int)syscall(SYS_openat, AT_FDCWD, path, O_RDONLY, 0);
    unsigned char *bytes = malloc(size + 1);
    assert_true(opened >= 0 && bytes);
    ssize_t got = read(opened, bytes, size);
    assert_true(got >= 0);
    close(opened);
    const cut_version *last = file->count > 0 ? &file->version[file->count - 1] : NULL;
    if (last && last->size == (size_t)got && memcmp(last->bytes, bytes, last->size) == 0) {
        free(bytes);
        return;
    }
    assert_true(file->count < CUT_VERSIONS);
    file->version[file->count++] = (cut_version){cut.event, (size_t)got, bytes};
}

/// Looks through the folder: names and contents that have changed.
static void cut_look(void)
{
    bool there[CUT_NAMES] = {false}, present[CUT_FILES] = {false};
    for (int f = 0; f < CUT_FOLDERS; f++) {
        DIR *folder = opendir(cut_folders[f]);
        for (struct dirent *entry; folder && (entry = readdir(folder));) {
            char path[CUT_PATH + NAME_MAX + 2];
            struct stat information;
            (void)snprintf(path, sizeof path, "%s/%s", cut_folders[f], entry->d_name);
            if (entry->d_name[0] == '.' || stat(path, &information) != 0 || !S_ISREG(information.st_mode)) continue;
            int file = cut_file_of(information.st_ino);
            cut.file[file]->present = present[file] = true;
            cut_read(path, cut.file[file], (size_t)information.st_size);
            cut_bind(path, f, file);
            for (int k = 0; k < cut.names; k++) there[k] = there[k] || strcmp(cut.name[k].path, path) == 0;
        }
        if (folder) closedir(folder);
    }
    for (int k = 0; k < cut.names; k++)
        if (!there[k]) cut_bind(cut.name[k].path, cut.name[k].folder, -1);
    for (int k = 0; k < cut.files; k++) cut.file[k]->present = present[k];
}

static void cut_before(void)
{
    if (!cut.recording) return;
    cut.event++;
    cut_look();
    cut.event++;
}

static void cut_after(void)
{
    if (cut.recording) cut_look();
}

static void cut_flush(int file)
{
    struct stat information, folder;
    if (!cut.recording || fstat(file, &information) != 0) return;
    for (int f = 0; f < CUT_FOLDERS; f++)
        if (stat(cut_folders[f], &folder) == 0 && folder.st_ino == information.st_ino)
            cut.sync_event[f][cut.sync_count[f]++] = cut.event;
    for (int k = 0; k < cut.files && S_ISREG(information.st_mode); k++) {
        cut_file *one = cut.file[k];
        if (!one->present || one->inode != information.st_ino) continue;
        one->flush_event[one->flush_count] = cut.event;
        one->flush_version[one->flush_count++] = one->count - 1;
    }
}

// ---- the calls of the library ------------------------------------------------------------------------------------

int fsync(int file)
{
    cut_before();
    cut_flush(file);
    return cut.still ? 0 : (int)syscall(SYS_fsync, file);
}

ssize_t write(int file, const void *bytes, size_t size)
{
    cut_before();
    ssize_t done = syscall(SYS_write, file, bytes, size);
    cut_after();
    return done;
}

int ftruncate(int file, off_t length)
{
    cut_before();
    int result = (int)syscall(SYS_ftruncate, file, length);
    cut_after();
    return result;
}

int rename(const char *from, const char *to)
{
    cut_before();
    int result = (int)syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to);
    cut_after();
    return result;
}

int unlink(const char *path)
{
    cut_before();
    int result = (int)syscall(SYS_unlinkat, AT_FDCWD, path, 0);
    cut_after();
    return result;
}

int unlinkat(int folder, const char *path, int flags)
{
    cut_before();
    int result = (int)syscall(SYS_unlinkat, folder, path, flags);
    cut_after();
    return result;
}

// ---- the folder after a power cut --------------------------------------------------------------------------------

/// What of it all is lost.
typedef enum cut_loss {
    CUT_ALL,   ///< whatever was not flushed
    CUT_NAMED, ///< contents that were not flushed, under their new names
    CUT_SOME,  ///< anything, by chance
    CUT_LOSSES
} cut_loss;

static uint32_t cut_dice(uint64_t *counter, uint32_t sides)
{
    uint32_t words[4];
    scree_random_words(17, SCREE_RANDOM_TEST, (*counter)++, words);
    return words[0] % sides;
}

/// Number of the file that a name stands for after a cut at `event`.
static int cut_binding(const cut_name *name, int event, cut_loss loss, uint64_t *counter)
{
    int flushed = -1, least = -1, most = -1;
    for (int k = 0; k < cut.sync_count[name->folder]; k++)
        if (cut.sync_event[name->folder][k] <= event) flushed = cut.sync_event[name->folder][k];
    for (int k = 0; k < name->count; k++) {
        if (name->event[k] <= flushed) least = k;
        if (name->event[k] <= event) most = k;
    }
    int chosen = loss == CUT_ALL     ? least
                 : loss == CUT_NAMED ? most
                                     : least + (int)cut_dice(counter, (uint32_t)(most - least + 1));
    return chosen < 0 ? -1 : name->file[chosen];
}

/// Writes the file as it may be after a cut at `event`.
static void cut_write(const char *path, const cut_file *file, int event, cut_loss loss, uint64_t *counter)
{
    int flushed = -1, last = -1;
    for (int k = 0; k < file->flush_count; k++)
        if (file->flush_event[k] <= event) flushed = file->flush_version[k];
    for (int k = 0; k < file->count; k++)
        if (file->version[k].event <= event) last = k;
    const cut_version *safe = flushed >= 0 ? &file->version[flushed] : NULL, *now = &file->version[last];
    size_t kept = 0, most = safe ? safe->size : 0;
    // What grows keeps its beginning; anything else may be lost from its first byte on.
    if (safe) kept = safe->size <= now->size && memcmp(safe->bytes, now->bytes, safe->size) == 0 ? safe->size : 0;
    bool changed = !safe || safe != now;
    size_t cut_at = changed && loss == CUT_SOME && now->size > kept
                        ? kept + cut_dice(counter, (uint32_t)(now->size - kept + 1))
                        : kept;
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    if (!changed || kept > 0 || !safe) {
        assert_true(fwrite(now->bytes, 1, changed ? cut_at : now->size, out) == (changed ? cut_at : now->size));
        // A hole: a later block has come, an earlier one has not.
        if (changed && loss == CUT_SOME && cut_dice(counter, 2) == 0)
            for (size_t k = cut_at; k < now->size; k++)
                (void)fputc(k < cut_at + (now->size - cut_at) / 2 ? 0 : now->bytes[k], out);
    } else {
        const cut_version *either = loss == CUT_SOME && cut_dice(counter, 2) ? now : safe;
        assert_true(fwrite(either->bytes, 1, either->size, out) == either->size);
    }
    (void)most;
    assert_int_equal(fclose(out), 0);
}

/// Makes `part` the folder that is left after a power cut at `event`.
static void cut_folder(const char *part, int event, cut_loss loss, uint64_t *counter)
{
    char path[2 * CUT_PATH];
    (void)snprintf(path, sizeof path, "rm -rf %s && mkdir -p %s/parts", part, part);
    assert_int_equal(system(path), 0);
    for (int k = 0; k < cut.names; k++) {
        int file = cut_binding(&cut.name[k], event, loss, counter);
        (void)snprintf(path, sizeof path, "%s%s", part, cut.name[k].path + strlen("run"));
        if (file >= 0) cut_write(path, cut.file[file], event, loss, counter);
    }
}

/// First event after which a folder of the run has been flushed with this name in it; -1: never.
static int cut_first(const char *path)
{
    for (int k = 0; k < cut.names; k++) {
        if (strcmp(cut.name[k].path, path) != 0) continue;
        for (int s = 0; s < cut.sync_count[0]; s++)
            if (cut.sync_event[0][s] > cut.name[k].event[0]) return cut.sync_event[0][s];
    }
    return -1;
}

static void cut_forget(void)
{
    for (int k = 0; k < cut.files; k++) {
        for (int v = 0; v < cut.file[k]->count; v++) free(cut.file[k]->version[v].bytes);
        free(cut.file[k]);
    }
    memset(&cut, 0, sizeof cut);
}

#endif
