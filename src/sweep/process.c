/// Fork, exec, wait. Between fork and exec only functions that POSIX calls async-signal-safe are used, because other
/// threads of the program may hold locks. A pipe that closes with the exec brings an error of the child back.
#include "sweep/process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

static void default_signals(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGQUIT, SIGUSR1, SIGPIPE, SIGXCPU, SIGXFSZ};
    struct sigaction action = {.sa_handler = SIG_DFL};
    sigset_t none;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) (void)sigaction(numbers[i], &action, NULL);
    (void)sigemptyset(&none);
    (void)sigprocmask(SIG_SETMASK, &none, NULL);
}

/// In the child: becomes the program, or sends the error number back.
static void become(const char *const *arguments, int output, int null, int report, pid_t parent)
{
    bool good = setpgid(0, 0) == 0 && prctl(PR_SET_PDEATHSIG, SIGTERM) == 0;
    // The parent may have died before the request.
    if (getppid() != parent) _exit(127);
    default_signals();
    good =
        good && dup2(null, STDIN_FILENO) >= 0 && dup2(output, STDOUT_FILENO) >= 0 && dup2(output, STDERR_FILENO) >= 0;
    if (good) (void)execv(arguments[0], (char *const *)(uintptr_t)arguments);
    int number = errno;
    ssize_t ignored = write(report, &number, sizeof number);
    (void)ignored;
    _exit(127);
}

scree_status scree_process_start(const char *const *arguments, int output, pid_t *process, scree_error *error)
{
    int ends[2], number = 0;
    int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (null < 0 || pipe2(ends, O_CLOEXEC) != 0) {
        scree_error_set_errno(error, SCREE_ERROR_IO, "cannot start '%s'", arguments[0]);
        if (null >= 0) close(null);
        return SCREE_ERROR_IO;
    }
    pid_t parent = getpid();
    *process = fork();
    if (*process == 0) become(arguments, output, null, ends[1], parent);
    if (*process < 0) number = errno;
    close(ends[1]);
    close(null);
    ssize_t got;
    do got = *process > 0 ? read(ends[0], &number, sizeof number) : 0;
    while (got < 0 && errno == EINTR);
    close(ends[0]);
    if (number == 0) return SCREE_OK;
    if (*process > 0)
        while (waitpid(*process, NULL, 0) < 0 && errno == EINTR) continue;
    errno = number;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot start '%s'", arguments[0]);
}

bool scree_process_ended(pid_t process, int *state)
{
    pid_t got;
    do got = waitpid(process, state, WNOHANG);
    while (got < 0 && errno == EINTR);
    // Somebody else's handler took the status: all that is known is that the process is gone.
    if (got < 0) *state = 127 << 8;
    return got != 0;
}

void scree_process_interrupt(pid_t process, bool several)
{
    // A launcher of MPI that is interrupted leaves its processes a second.
    (void)kill(process, several ? SIGUSR1 : SIGINT);
}
