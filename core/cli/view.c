#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle view RECORDING [options]\n\n"
    "Shows a recording on the live page, to play, stop and look through: an SQLite file of\n"
    "`jostle run --record` or of JuPedSim (versions 1 and 2), text with the columns id, frame, x, "
    "y\n"
    "(PeTrack, the archive of Juelich), or CSV with a line of names. Prints the page's address.\n\n"
    "  --scene SCENE      draw its walls, places and bodies (default: the recording's walls)\n"
    "  --port N           serve at this port (default: 8730, or the next that is free)\n"
    "  --view-address A   listen at this address, not at 127.0.0.1: others can then reach the "
    "page\n"
    "  --page DIR         folder of the page's files\n"
    "  --three DIR        folder of three.js\n"
    "  --fps N            frames a second, where the recording does not say\n"
    "  --unit m|cm        unit of its lengths, where it does not say\n\n"
    "exit status: 0 done (Ctrl-C ends it), 1 the page cannot be served, 2 wrong usage, 3 bad "
    "input\n";

static const char *const KNOWN[] = {"scene", "port", "view-address", "page", "three",
                                    "fps",   "unit", "help",         NULL};
static volatile sig_atomic_t interrupted;

static void interrupt(int number) {
    (void)number;
    interrupted = 1;
}

static void print_address(void *context, const char *address) {
    (void)context;
    printf("%s\n", address);
    fflush(stdout);
    fputs("Open this address in a browser; Ctrl-C ends it.\n", stderr);
}

/* Reads one option; false if there is none of this name. */
static bool read_option(JoViewRecordingDef *def, CliArgs *args, const char *option) {
    if (!strcmp(option, "scene")) {
        def->scene = cli_value(args, option);
    } else if (!strcmp(option, "port")) {
        def->port = (int)cli_whole(args, option, 1, 65535);
    } else if (!strcmp(option, "view-address")) {
        def->address = cli_value(args, option);
    } else if (!strcmp(option, "page")) {
        def->page = cli_value(args, option);
    } else if (!strcmp(option, "three")) {
        def->three = cli_value(args, option);
    } else if (!strcmp(option, "fps")) {
        def->fps = cli_number(args, option, 0.01, 10000);
    } else if (!strcmp(option, "unit")) {
        def->unit = cli_unit(args, option);
    } else {
        return false;
    }
    return true;
}

int cli_view(int argc, char **argv) {
    CliArgs args = {.argc = argc, .argv = argv, .next = 1, .command = "view"};
    JoViewRecordingDef def = jo_default_view_recording_def();
    const char *option, *plain;
    while ((option = cli_next(&args, &plain)) || plain) {
        if (plain && def.recording) {
            fprintf(stderr, "jostle view: one recording at a time; what is '%s'?\n", plain);
            return JO_USAGE;
        } else if (plain) {
            def.recording = plain;
        } else if (!strcmp(option, "help") || !strcmp(option, "h")) {
            fputs(HELP, stdout);
            return JO_OK;
        } else if (!read_option(&def, &args, option)) {
            return cli_unknown(&args, option, KNOWN);
        }
    }
    if (!def.recording && !args.failed)
        fprintf(stderr, "jostle view: no recording given; `jostle run SCENE --view` shows a scene\n"
                        "Try 'jostle view --help'.\n");
    if (!def.recording || args.failed)
        return JO_USAGE;
    signal(SIGINT, interrupt);
    signal(SIGTERM, interrupt);
    JoError error = {0};
    def.stop = &interrupted;
    def.opened = print_address;
    if (jo_view_recording(&def, &error))
        return JO_OK;
    if (error.code == JO_FAILED) /* else it was sent as a message */
        fprintf(stderr, "jostle view: %s\n", error.text);
    return error.code ? (int)error.code : JO_FAILED;
}
