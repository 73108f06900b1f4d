/// State of members on disk. Nothing is kept elsewhere: a sweep that is killed finds out what there is by looking.
#include "sweep/member.h"

#include "case/case.h"
#include "io/file_checksum.h"
#include "io/run_directory.h"
#include "io/run_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#define NOTE "scree sweep: "
enum { TAIL = 8192 };

const char *scree_member_state_name(scree_member_state state)
{
    static const char *const names[] = {"missing", "interrupted", "done", "failed", "changed"};
    return names[state];
}

scree_status scree_member_find(const scree_sweep *sweep, size_t member, const char *output, scree_member_paths *paths,
                               scree_error *error)
{
    char name[400];
    (void)snprintf(name, sizeof name, "members/%s", sweep->folder[member]);
    scree_status status = scree_path_join(paths->folder, sizeof paths->folder, output, name, error);
    (void)snprintf(name, sizeof name, "members/%s.yaml", sweep->folder[member]);
    if (!status) status = scree_path_join(paths->file, sizeof paths->file, output, name, error);
    (void)snprintf(name, sizeof name, "members/%s.txt", sweep->folder[member]);
    if (!status) status = scree_path_join(paths->log, sizeof paths->log, output, name, error);
    return status;
}

/// 0: the file is not there, or no file; 1: it holds this case; -1: another one, or one that this version cannot read.
static int compare_case(const char *path, const scree_case *wanted)
{
    scree_case *stored;
    if (access(path, F_OK) != 0) return 0;
    scree_status status = scree_case_reread(path, scree_former_keys, &stored, NULL);
    if (status) return status == SCREE_ERROR_INPUT ? -1 : 0;
    int result = scree_case_same(stored, wanted) ? 1 : -1;
    scree_case_free(stored);
    return result;
}

/// The end of a log as lines: the last note of the sweep, and the last line before it that the member printed.
static void read_log(const char *path, char *note, char *said, size_t size)
{
    char tail[TAIL + 1], *rest = tail;
    note[0] = said[0] = 0;
    int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    off_t end = lseek(file, 0, SEEK_END);
    ssize_t got = pread(file, tail, TAIL, end > TAIL ? end - TAIL : 0);
    close(file);
    tail[got > 0 ? got : 0] = 0;
    for (char *line; (line = strsep(&rest, "\n"));) {
        bool own = strncmp(line, NOTE, strlen(NOTE)) == 0;
        if (own)
            (void)snprintf(note, size, "%s", line + strlen(NOTE));
        else if (line[0])
            (void)snprintf(said, size, "%s", line);
    }
}

void scree_member_last_words(const char *log, char *text, size_t size)
{
    char note[1024], said[1024];
    read_log(log, note, said, sizeof note);
    const bool failed = strncmp(note, SCREE_MEMBER_FAILURE, strlen(SCREE_MEMBER_FAILURE)) == 0;
    (void)snprintf(text, size, "%s", !failed ? "" : said[0] ? said : note + strlen(SCREE_MEMBER_FAILURE));
}

scree_member_state scree_member_look(const scree_member_paths *paths, const scree_case *c, char *reason, size_t size)
{
    char path[PATH_MAX], status[64], words[1024];
    scree_member_last_words(paths->log, words, sizeof words);
    const bool failed = words[0];
    if (reason) (void)snprintf(reason, size, "%s", words);
    if (scree_path_join(path, sizeof path, paths->folder, SCREE_FILE_CASE, NULL)) return SCREE_MEMBER_MISSING;
    int same = compare_case(path, c);
    if (same < 0) return SCREE_MEMBER_CHANGED;
    // Without a directory, a member may still have failed: with this case, or with another one that counts no more.
    if (same == 0) return failed && compare_case(paths->file, c) > 0 ? SCREE_MEMBER_FAILED : SCREE_MEMBER_MISSING;
    if (scree_result_get(paths->folder, "status", status, sizeof status, NULL) == SCREE_OK) {
        if (strcmp(status, "done") == 0) return SCREE_MEMBER_DONE;
        if (strcmp(status, "stopped") == 0) return SCREE_MEMBER_FAILED;
    }
    return failed ? SCREE_MEMBER_FAILED : SCREE_MEMBER_INTERRUPTED;
}

static bool has_whole_part(const char *folder)
{
    char path[PATH_MAX];
    scree_error ignored;
    scree_part_list list = {0};
    bool found = false;
    if (scree_parts_list(folder, SCREE_PART_CHECKPOINT, &list, &ignored)) return false;
    for (size_t k = 0; k < list.count && !found; k++)
        found = !scree_part_path(folder, SCREE_PART_CHECKPOINT, list.index[k], path, sizeof path, &ignored) &&
                !scree_file_checksum_check(path, &ignored);
    scree_part_list_destroy(&list);
    return found;
}

/// A run that was at its end has its checkpoints in run.h5 itself.
static bool has_gathered(const char *folder)
{
    char path[PATH_MAX];
    scree_hdf5 run;
    scree_error ignored;
    scree_part_list list = {0};
    if (scree_run_file_path(folder, path, sizeof path, &ignored) || access(path, F_OK) != 0) return false;
    scree_hdf5_open_checked(&run, path, &ignored);
    bool found = !scree_run_file_list(&run, SCREE_PART_CHECKPOINT, true, &list) && list.count > 0;
    scree_part_list_destroy(&list);
    return !scree_hdf5_close(&run) && found;
}

bool scree_member_can_continue(const scree_member_paths *paths, scree_member_state state)
{
    char status[64], note[1024], said[1024];
    if (state != SCREE_MEMBER_INTERRUPTED && state != SCREE_MEMBER_FAILED) return false;
    read_log(paths->log, note, said, sizeof note);
    bool refused = strcmp(note, SCREE_MEMBER_FAILURE "exit status 2") == 0;
    if (refused || (scree_result_get(paths->folder, "status", status, sizeof status, NULL) == SCREE_OK &&
                    strcmp(status, "stopped") == 0))
        return false;
    return has_whole_part(paths->folder) || has_gathered(paths->folder);
}

scree_status scree_member_open_log(const scree_member_paths *paths, int *log, scree_error *error)
{
    *log = open(paths->log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (*log < 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", paths->log);
    if (flock(*log, LOCK_EX | LOCK_NB) == 0) return SCREE_OK;
    bool held = errno == EWOULDBLOCK;
    scree_status status = held ? scree_error_set(error, SCREE_ERROR_INPUT, "another sweep runs this member now")
                               : scree_error_set_errno(error, SCREE_ERROR_IO, "cannot lock '%s'", paths->log);
    close(*log);
    *log = -1;
    return status;
}

void scree_member_note(int log, const char *format, ...)
{
    char line[2048];
    int used = snprintf(line, sizeof line, NOTE);
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(line + used, sizeof line - (size_t)used - 1, format, arguments);
    va_end(arguments);
    size_t length = strlen(line);
    line[length++] = '\n';
    // A log that cannot be written loses a reason, not a result.
    ssize_t ignored = write(log, line, length);
    (void)ignored;
}
