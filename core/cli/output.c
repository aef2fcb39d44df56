/* What commands print: whether it got to where it went. */
#include <errno.h>
#include <signal.h>
#include <stdio.h>

#include "cli/cli.h"

int cli_output_errno;

bool cli_flush(void) {
    const bool flushed = fflush(stdout) == 0 && !ferror(stdout);
    if (!flushed && cli_output_errno == 0)
        cli_output_errno = errno;
    return flushed;
}

void cli_print_address(void *context, const char *address) {
    (void)context;
    printf("%s\n", address);
    if (cli_flush())
        fputs("Open this address in a browser; Ctrl-C ends it.\n", stderr);
    else
        cli_signal = SIGPIPE; /* nobody knows the address: nobody can open the page, nor end it */
}
