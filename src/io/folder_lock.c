/// The lock on a folder. The file is removed by who holds it, so the one that was locked may be gone from the folder by
/// then: after locking, the file of that name has to be the one that is open, else it is tried again.
#include "io/folder_lock.h"

#include "io/replacement.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { LONGEST_TEXT = 400, MOST_TRIES = 1000, MOMENT = 20 * 1000 * 1000 };

/// 0, or the error number: EWOULDBLOCK when somebody has the lock.
static int lock_file(int file)
{
    int result;
    do result = flock(file, LOCK_EX | LOCK_NB);
    while (result != 0 && errno == EINTR);
    return result == 0 ? 0 : errno;
}

/// The same, but who only asks whether the lock is held (scree_folder_lock_is_held) does not count.
static int lock_file_for_long(int file)
{
    int number = lock_file(file);
    if (number != EWOULDBLOCK) return number;
    (void)nanosleep(&(struct timespec){.tv_nsec = MOMENT}, NULL);
    return lock_file(file);
}

/// File systems without locks say so in one of these ways.
static bool is_unsupported(int number)
{
    return number == ENOSYS || number == EOPNOTSUPP || number == ENOLCK || number == EINVAL;
}

static bool is_in_place(int file, const char *path)
{
    struct stat mine, named;
    return fstat(file, &mine) == 0 && stat(path, &named) == 0 && mine.st_dev == named.st_dev &&
           mine.st_ino == named.st_ino;
}

/// What the holder wrote, as one line; it may not have done so yet.
static void read_holder(int file, char *who, size_t size)
{
    char text[LONGEST_TEXT];
    ssize_t got = pread(file, text, sizeof text - 1, 0);
    text[got > 0 ? got : 0] = 0;
    text[strcspn(text, "\n")] = 0;
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < ' ') *c = '?';
    (void)snprintf(who, size, "%s", text[0] ? text : "another process");
}

/// "scree run, process 1234 on host n17, since 2026-11-22T10:00:00Z". A text that cannot be written is only missed.
static void write_holder(int file, const char *user)
{
    char host[65] = "", stamp[32] = "", text[LONGEST_TEXT];
    struct tm begin;
    time_t seconds = time(NULL);
    (void)gethostname(host, sizeof host - 1);
    (void)strftime(stamp, sizeof stamp, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&seconds, &begin));
    int length =
        snprintf(text, sizeof text, "%s, process %ld on host %s, since %s\n", user, (long)getpid(), host, stamp);
    // Flushed, so that other machines see it.
    bool written = ftruncate(file, 0) == 0 && pwrite(file, text, (size_t)length, 0) == length && fsync(file) == 0;
    (void)written;
}

static scree_status refuse(int number, int file, const char *directory, const char *path, scree_error *error)
{
    char who[LONGEST_TEXT];
    if (number == EWOULDBLOCK) {
        read_holder(file, who, sizeof who);
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "the folder '%s' is in use by %s: wait until it has ended, or stop it", directory, who);
    }
    errno = number;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot lock '%s'", path);
}

scree_status scree_folder_lock_take(scree_folder_lock *lock, const char *directory, const char *user,
                                    scree_error *error)
{
    *lock = (scree_folder_lock){.file = -1};
    scree_status status = scree_path_join(lock->path, sizeof lock->path, directory, SCREE_FILE_LOCK, error);
    for (int tries = 0; !status && !lock->held && tries < MOST_TRIES; tries++) {
        int file = open(lock->path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (file < 0 && (errno == ENOENT || errno == ENOTDIR))
            return scree_error_set(error, SCREE_ERROR_INPUT, "there is no folder '%s'", directory);
        if (file < 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", lock->path);
        int number = lock_file_for_long(file);
        lock->unsupported = is_unsupported(number);
        if (number && !lock->unsupported) status = refuse(number, file, directory, lock->path, error);
        lock->held = !status && is_in_place(file, lock->path);
        lock->file = file;
        if (!lock->held) close(file);
    }
    if (!status && !lock->held)
        status = scree_error_set(error, SCREE_ERROR_IO, "cannot lock '%s': it is replaced again and again", lock->path);
    if (!status) write_holder(lock->file, user);
    return status;
}

void scree_folder_lock_release(scree_folder_lock *lock)
{
    if (!lock->held) return;
    if (is_in_place(lock->file, lock->path)) (void)unlink(lock->path);
    close(lock->file);
    lock->held = false;
}

bool scree_folder_lock_is_held(const char *directory, char *who, size_t size)
{
    char path[PATH_MAX];
    if (scree_path_join(path, sizeof path, directory, SCREE_FILE_LOCK, NULL)) return false;
    int file = open(path, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) return false;
    bool held = lock_file(file) == EWOULDBLOCK;
    if (held) read_holder(file, who, size);
    close(file);
    return held;
}

void scree_folder_lock_text(const char *directory, char *text, size_t size)
{
    char path[PATH_MAX];
    text[0] = 0;
    if (scree_path_join(path, sizeof path, directory, SCREE_FILE_LOCK, NULL)) return;
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) return;
    ssize_t got = pread(file, text, size - 1, 0);
    text[got > 0 ? got : 0] = 0;
    close(file);
}
