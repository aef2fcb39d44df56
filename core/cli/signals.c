/* What ends a command from outside. SIGINT, SIGTERM and, where the terminal closes, SIGHUP: the
   first asks it to end, with its files whole; the second ends the process at once. Standard output
   that cannot be written: serving a page of which nobody knows ends. */
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include "cli/cli.h"

enum { STATUS = 128 }; /* and the signal's number, as a shell says of who died of it */

volatile int cli_signal;
static volatile sig_atomic_t holds;

static void take(int number) {
    if (cli_signal || !holds)
        _exit(STATUS + number);
    cli_signal = number;
}

bool cli_end_soon(int number) {
    if (cli_signal || !holds)
        return false;
    cli_signal = number;
    return true;
}

void cli_catch_signals(bool has_files) {
    const struct sigaction action = {.sa_handler = take}; /* calls that wait are interrupted */
    holds = has_files;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    struct sigaction before;
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN) /* as by nohup */
        sigaction(SIGHUP, &action, NULL);
}

int cli_interrupted(int status) {
    return !cli_signal || status != JO_OK                   ? status
           : cli_signal == SIGXCPU || cli_signal == SIGPIPE ? JO_FAILED
                                                            : STATUS + cli_signal;
}

int cli_output_errno;
static bool output_is_data;

void cli_output_is_data(void) {
    output_is_data = true;
}

/* Whether standard output is a pipe that nobody reads any more. */
static bool is_closed_pipe(void) {
    struct pollfd output = {.fd = STDOUT_FILENO, .events = POLLOUT};
    return poll(&output, 1, 0) == 1 && (output.revents & POLLERR);
}

bool cli_flush(void) {
    const bool flushed = fflush(stdout) == 0 && !ferror(stdout);
    const int why = errno;
    if (flushed || (!output_is_data && is_closed_pipe()))
        return true;
    if (cli_output_errno == 0)
        cli_output_errno = why;
    return false;
}

void cli_print_address(void *context, const char *address) {
    (void)context;
    cli_output_is_data();
    printf("%s\n", address);
    if (cli_flush())
        fputs("Open this address in a browser; Ctrl-C ends it.\n", stderr);
    else
        cli_signal = SIGPIPE; /* nobody knows the address: nobody can open the page, nor end it */
}
