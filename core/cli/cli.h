/* What the commands share: arguments and exit statuses. */
#ifndef JOX_CLI_CLI_H
#define JOX_CLI_CLI_H

#include <stdbool.h>
#include <stdint.h>

#include "jostle.h"

/* Exit statuses are those of JoCode: 0 done, 1 the run failed, 2 wrong usage, 3 bad input. */
int cli_run(int argc, char **argv);
int cli_report(int argc, char **argv);
int cli_render(int argc, char **argv);
int cli_view(int argc, char **argv);
int cli_check(int argc, char **argv);
int cli_bench(int argc, char **argv);
int cli_mod(int argc, char **argv);
int cli_test(int argc, char **argv);
int cli_new(int argc, char **argv);
int cli_reproduce(int argc, char **argv);
int cli_reference(int argc, char **argv);

/* Walks over arguments: `--name value`, `--name=value`, and what is no option. */
typedef struct CliArgs {
    int argc, next;
    char **argv;
    const char *command; /* for messages */
    const char *value;   /* of the present option, when it was given with '=' */
    bool failed;         /* an error was printed */
} CliArgs;

/* The next option's name without dashes ("for", "h"), or NULL for a plain argument (in *plain), or
   NULL with *plain NULL at the end. */
const char *cli_next(CliArgs *args, const char **plain);
/* The value of the option just read; prints an error and sets `failed` when it is missing. */
const char *cli_value(CliArgs *args, const char *option);
double cli_number(CliArgs *args, const char *option, double least, double greatest);
uint64_t cli_whole(CliArgs *args, const char *option, uint64_t least, uint64_t greatest);
/* m of a unit: m or cm. */
double cli_unit(CliArgs *args, const char *option);
/* Writes text to a file, or to standard output for "-"; JO_FAILED with a message. */
int cli_write(const char *command, const char *path, const char *text);
/* Prints "jostle COMMAND: unknown option --xyz" and a way out; returns JO_USAGE. */
int cli_unknown(CliArgs *args, const char *option, const char *const *known);

#endif
