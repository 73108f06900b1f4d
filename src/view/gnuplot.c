/// gnuplot through posix_spawn: arguments go to the program as they are, no shell reads them.
#include "view/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/// Starts gnuplot with its output going into `sink`. Returns an error number.
static int start(const char *folder, const char *script, int sink, pid_t *process)
{
    char name[300];
    (void)snprintf(name, sizeof name, "./%s", script);
    char program[] = "gnuplot", defaults[] = "--default-settings";
    char *arguments[] = {program, defaults, name, NULL};
    posix_spawn_file_actions_t actions;
    int number = posix_spawn_file_actions_init(&actions);
    if (number) return number;
    number = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (!number) number = posix_spawn_file_actions_adddup2(&actions, sink, STDOUT_FILENO);
    if (!number) number = posix_spawn_file_actions_adddup2(&actions, sink, STDERR_FILENO);
    if (!number) number = posix_spawn_file_actions_addchdir_np(&actions, folder);
    if (!number) number = posix_spawnp(process, program, &actions, NULL, arguments, environ);
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

scree_status scree_gnuplot_run(const char *folder, const char *script, scree_error *error)
{
    int ends[2], state = 0;
    pid_t process;
    if (pipe2(ends, O_CLOEXEC)) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot start gnuplot");
    int number = start(folder, script, ends[1], &process);
    close(ends[1]);
    char said[600] = "";
    if (!number) {
        read_message(ends[0], said, sizeof said);
        while (waitpid(process, &state, 0) < 0 && errno == EINTR) continue;
    }
    close(ends[0]);
    if (number) {
        errno = number;
        return scree_error_set_errno(error, SCREE_ERROR_IO,
                                     "no chart was drawn: cannot run gnuplot (Debian package gnuplot-nox) in '%s'",
                                     folder);
    }
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return SCREE_OK;
    if (WIFEXITED(state) && WEXITSTATUS(state) == 127 && !said[0])
        return scree_error_set(error, SCREE_ERROR_IO, "no chart was drawn: gnuplot could not be started in '%s'",
                               folder);
    return scree_error_set(error, SCREE_ERROR_IO, "gnuplot failed on '%s/%s': %s", folder, script, said);
}
