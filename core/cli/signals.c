/* Ends commands from outside. Of SIGINT, SIGTERM and, when the terminal closes, SIGHUP, the first
   asks the command to end with its files whole, and the second ends the process at once. Also
   checks standard output: a server whose address could not be printed ends. */
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include "cli/cli.h"

/* Exit statuses as in shells: this plus the number of the signal that ended the process. */
enum { STATUS = 128 };

volatile int cli_signal;
/* Whether the command has files to finish before it ends. */
static volatile sig_atomic_t holds;

static void handle_signal(int number) {
    if (cli_signal || !holds)
        _exit(STATUS + number);
    cli_signal = number;
}

bool cli_request_end(int number) {
    if (cli_signal || !holds)
        return false;
    cli_signal = number;
    return true;
}

void cli_catch_signals(bool has_files) {
    /* No SA_RESTART: calls that wait are interrupted */
    const struct sigaction action = {.sa_handler = handle_signal};
    holds = has_files;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    struct sigaction before;
    /* SIGHUP stays ignored if nohup set that. */
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
        sigaction(SIGHUP, &action, NULL);
}

int cli_add_signal_status(int status) {
    return !cli_signal || status != JO_OK                   ? status
           : cli_signal == SIGXCPU || cli_signal == SIGPIPE ? JO_FAILED
                                                            : STATUS + cli_signal;
}

int cli_output_errno;
static bool output_is_data;

void cli_output_is_data(void) {
    output_is_data = true;
}

/* Returns whether standard output is a pipe without a reader. */
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
        cli_signal = SIGPIPE; /* nobody knows the address, so the command ends */
}
