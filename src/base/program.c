/// Programs through posix_spawn: arguments go to the program as they are, no shell reads them.
#include "base/program.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/// Starts it with its output going into `sink`, or into its log. Returns an error number.
static int start(const scree_program *program, int sink, pid_t *process)
{
    posix_spawn_file_actions_t actions;
    int number = posix_spawn_file_actions_init(&actions);
    if (number) return number;
    number = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (!number) number = posix_spawn_file_actions_addchdir_np(&actions, program->folder);
    if (!number && program->log)
        number =
            posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, program->log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    else if (!number)
        number = posix_spawn_file_actions_adddup2(&actions, sink, STDOUT_FILENO);
    if (!number) number = posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    if (!number)
        number = posix_spawnp(process, program->arguments[0], &actions, NULL,
                              (char *const *)(uintptr_t)program->arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return number;
}

/// Reads to the end, keeps the beginning, and makes one line of it.
static void read_message(int source, char *text, size_t size)
{
    size_t used = 0;
    char block[512];
    for (;;) {
        ssize_t got = read(source, block, sizeof block);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        for (ssize_t k = 0; k < got; k++) {
            bool space = strchr(" \t\r\n", block[k]) != NULL;
            if (space && (used == 0 || text[used - 1] == ' ')) continue;
            if (used + 1 < size) text[used++] = space ? ' ' : block[k];
        }
    }
    text[used] = '\0';
}

scree_status scree_program_run(const scree_program *program, scree_program_end *end, scree_error *error)
{
    int ends[2], state = 0;
    pid_t process;
    *end = (scree_program_end){0};
    if (pipe2(ends, O_CLOEXEC))
        return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot start %s", program->arguments[0]);
    int number = start(program, ends[1], &process);
    close(ends[1]);
    if (!number) {
        read_message(ends[0], end->said, sizeof end->said);
        while (waitpid(process, &state, 0) < 0 && errno == EINTR) continue;
    }
    close(ends[0]);
    if (number) {
        errno = number;
        return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot run %s in '%s'", program->arguments[0],
                                     program->folder);
    }
    end->done = WIFEXITED(state) && WEXITSTATUS(state) == 0;
    end->missing = WIFEXITED(state) && WEXITSTATUS(state) == 127 && !end->said[0];
    return SCREE_OK;
}

bool scree_program_find(const char *name, char *path, size_t room)
{
    const char *folders = getenv("PATH");
    struct stat about;
    while (folders && *folders) {
        const size_t length = strcspn(folders, ":");
        const int size = snprintf(path, room, "%.*s/%s", (int)length, folders, name);
        if (length > 0 && size < (int)room && access(path, X_OK) == 0 && stat(path, &about) == 0 &&
            S_ISREG(about.st_mode))
            return true;
        folders += length + (folders[length] == ':');
    }
    return false;
}

bool scree_program_is_there(const char *name)
{
    char path[PATH_MAX];
    return scree_program_find(name, path, sizeof path);
}
