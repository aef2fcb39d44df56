#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

static void print_help(FILE *out) {
    fprintf(out,
            "Jostle %s: dense crowds that push, with bodies and behaviours in Lua.\n\n"
            "usage: jostle COMMAND ...\n\n",
            jo_version());
    for (size_t c = 0; c < cli_command_count; c++)
        fprintf(out, "  %-10s %s\n", cli_commands[c]->name, cli_commands[c]->what);
    fprintf(out, "\n'jostle COMMAND --help' lists a command's options.\n");
}

int main(int argc, char **argv) {
    if (argc < 2) {
        print_help(stderr);
        return JO_USAGE;
    }
    const char *word = argv[1];
    if (!strcmp(word, "--help") || !strcmp(word, "-h") || !strcmp(word, "help")) {
        print_help(stdout);
        return JO_OK;
    }
    if (!strcmp(word, "--version")) {
        printf("jostle %s\n", jo_version());
        return JO_OK;
    }
    for (size_t c = 0; c < cli_command_count; c++)
        if (!strcmp(word, cli_commands[c]->name))
            return cli_commands[c]->run(argc - 1, argv + 1);
    fprintf(stderr, "jostle: unknown command '%s'\n\n", word);
    print_help(stderr);
    return JO_USAGE;
}
