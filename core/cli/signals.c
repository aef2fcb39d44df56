/* SIGINT and SIGTERM: the first asks a command to end, with its files whole; the second ends the
   process at once. */
#include <signal.h>
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

void cli_catch_signals(bool has_files) {
    const struct sigaction action = {.sa_handler = take}; /* calls that wait are interrupted */
    holds = has_files;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

int cli_interrupted(int status) {
    return cli_signal && status == JO_OK ? STATUS + cli_signal : status;
}
