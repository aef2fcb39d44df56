/* The program `jostle`: prints the help, or runs the command that the first argument names. */
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "base/confine.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/text.h"
#include "cli/cli.h"

static void print_help(FILE *out) {
    fprintf(out,
            "Jostle %s: dense crowds that push, with bodies and behaviours in Lua.\n\n"
            "usage: jostle COMMAND ...\n\n",
            jo_version());
    for (size_t c = 0; c < cli_command_count; c++)
        fprintf(out, "  %-10s %s\n", cli_commands[c]->name, cli_commands[c]->what);
    fprintf(out, "\n'jostle COMMAND --help' lists a command's options.\n");
    cli_list_scenes(out);
}

/* Returns the status of a command, or JO_FAILED with a message if its output could not be
   written. */
static int finish_standard_output(int status) {
    if (cli_flush())
        return status;
    fprintf(stderr, "jostle: cannot write to standard output: %s\n", strerror(cli_output_errno));
    return status == JO_OK ? JO_FAILED : status;
}

/* Runs a command, and ends it with a message if an allocation of its own fails; library calls
   handle theirs. */
static int guard_command(const CliCommand *command, int argc, char **argv) {
    JoxRecovery recovery;
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0) {
        fprintf(stderr, "jostle %s: out of memory\n", command->name);
        return JO_FAILED;
    }
    const int status = command->run(argc, argv);
    jox_recovery_pop(&recovery);
    return status;
}

/* Prints that a word is no command, and what may be meant. */
static int print_unknown_command(const char *word) {
    const char *names[64];
    char hint[JOX_HINT];
    size_t count = 0;
    for (size_t c = 0; c < cli_command_count && count < sizeof names / sizeof *names; c++)
        names[count++] = cli_commands[c]->name;
    const char *near = jox_did_you_mean(word, names, count, hint);
    if (cli_is_scene(word))
        fprintf(stderr, "jostle: '%s' is a scene, no command: jostle run %s\n", word, word);
    else
        fprintf(stderr, "jostle: unknown command '%s'%s%s\nTry 'jostle --help'.\n", word,
                near ? ". " : "", near ? near : "");
    cli_scenes_free();
    return JO_USAGE;
}

int main(int argc, char **argv) {
    /* Commands compute with the same floating-point settings and locale as the library. */
    jox_numeric_use(jox_numeric_plain());
    /* A closed pipe or a file that is too large is an error of one write; it must not end a run
       whose other files are good. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    if (argc < 2) {
        print_help(stderr);
        return JO_USAGE;
    }
    const char *word = argv[1];
    if (!strcmp(word, "--help") || !strcmp(word, "-h") || !strcmp(word, "help")) {
        print_help(stdout);
        return finish_standard_output(JO_OK);
    }
    if (!strcmp(word, "--version")) {
        const JoxConfining can = jox_confine_can();
        printf("jostle %s\n", jo_version());
        printf("scenes are read by a process with %s and %s\n",
               can.files ? "Landlock" : "no Landlock in this kernel",
               can.calls ? "seccomp" : "no seccomp");
        return finish_standard_output(JO_OK);
    }
    for (size_t c = 0; c < cli_command_count; c++)
        if (!strcmp(word, cli_commands[c]->name))
            return finish_standard_output(guard_command(cli_commands[c], argc - 1, argv + 1));
    return print_unknown_command(word);
}
