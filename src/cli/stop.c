/// Signals that ask for an orderly end.
#include "cli/stop.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <unistd.h>

/// A signal handler can reach nothing else.
static volatile sig_atomic_t stop_signal;

static void ask_to_stop(int signal_number)
{
    static const char note[] = "\nstopping after a checkpoint; a second signal ends at once\n";
    int number = errno;
    stop_signal = signal_number;
    ssize_t ignored = write(STDERR_FILENO, note, sizeof note - 1);
    (void)ignored;
    errno = number;
}

/// These come again by themselves, SIGXCPU every second, SIGHUP from shell and kernel, SIGUSR1 where a batch system and
/// a script both send it: a second one ends nothing.
static void ask_to_stop_again(int signal_number)
{
    stop_signal = signal_number;
}

const volatile int *scree_stop_signal(void)
{
    return &stop_signal;
}

void scree_stop_catch(void)
{
    // The handler is gone after the first signal.
    struct sigaction action = {.sa_handler = ask_to_stop, .sa_flags = SA_RESTART | (int)SA_RESETHAND}, before;
    (void)sigaction(SIGINT, &action, NULL);
    (void)sigaction(SIGTERM, &action, NULL);
    struct sigaction lasting = {.sa_handler = ask_to_stop_again, .sa_flags = SA_RESTART};
    (void)sigaction(SIGXCPU, &lasting, NULL);
    (void)sigaction(SIGUSR1, &lasting, NULL);
    // nohup: the terminal may close.
    bool ignored = sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler == SIG_IGN;
    if (!ignored) (void)sigaction(SIGHUP, &lasting, NULL);
}
