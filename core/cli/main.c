#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

static const struct Command {
    const char *name, *what;
    int (*run)(int argc, char **argv);
} COMMANDS[] = {
    {"run", "simulate a scene", cli_run},
    {"report", "measure a recording, simulated or real", cli_report},
    {"render", "draw a scene or a recording: pictures, frames, video", cli_render},
    {"view", "show a recording on the live page", cli_view},
    {"check", "find every error in scenes and behaviours, without running", cli_check},
    {"test", "run tests of behaviours, written in Lua", cli_test},
    {"new", "write a commented start of a behaviour, scene or mod", cli_new},
    {"mod", "list mods, and tell who set a value", cli_mod},
    {"reference", "print every word and key, for people and for editors", cli_reference},
    {"reproduce", "run what papers and real crowds show, and compare", cli_reproduce},
    {"bench", "time scenes and stages", cli_bench},
};

static void print_help(FILE *out) {
    fprintf(out,
            "Jostle %s: dense crowds that push, with bodies and behaviours in Lua.\n\n"
            "usage: jostle COMMAND ...\n\n",
            jo_version());
    for (size_t i = 0; i < sizeof COMMANDS / sizeof *COMMANDS; i++)
        fprintf(out, "  %-10s %s\n", COMMANDS[i].name, COMMANDS[i].what);
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
    for (size_t i = 0; i < sizeof COMMANDS / sizeof *COMMANDS; i++)
        if (!strcmp(word, COMMANDS[i].name))
            return COMMANDS[i].run(argc - 1, argv + 1);
    fprintf(stderr, "jostle: unknown command '%s'\n\n", word);
    print_help(stderr);
    return JO_USAGE;
}
