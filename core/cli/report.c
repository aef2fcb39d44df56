#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle report RECORDING [options]\n\n"
    "Measures a recording: an SQLite file of `jostle run --record` or of JuPedSim (versions 1 and\n"
    "2), text with the columns id, frame, x, y (PeTrack, the archive of Juelich), or CSV with a\n"
    "line of names (ID,Frame,x,y,v_x,v_y). Give one of --out and --summary, or both.\n\n"
    "  --scene SCENE      its `probes` measure, its walls are drawn (without: fields, and\n"
    "                     densities and speeds over time, of all the area)\n"
    "  --out DIR          a page, index.html; CSV files and pictures, NAME.csv, NAME.png and\n"
    "                     NAME.svg, of each probe and of danger: density, crowd pressure and, in\n"
    "                     recordings of `jostle run`, compression\n"
    "  --summary FILE     write the figures as JSON; '-' is standard output\n"
    "  --fps N            frames a second, where the recording does not say\n"
    "  --unit m|cm        unit of its lengths, where it does not say\n\n"
    "exit status: 0 done, 1 writing failed, 2 wrong usage, 3 bad input\n";

static const char *const KNOWN[] = {"scene", "out", "summary", "fps", "unit", "help", NULL};

typedef struct Wanted {
    JoReportDef def;
    const char *summary;
} Wanted;

/* Reads one option; false if there is none of this name. */
static bool read_option(Wanted *wanted, CliArgs *args, const char *option) {
    if (!strcmp(option, "scene")) {
        wanted->def.scene = cli_value(args, option);
    } else if (!strcmp(option, "out")) {
        wanted->def.directory = cli_value(args, option);
    } else if (!strcmp(option, "summary")) {
        wanted->summary = cli_value(args, option);
    } else if (!strcmp(option, "fps")) {
        wanted->def.fps = cli_number(args, option, 0.01, 10000);
    } else if (!strcmp(option, "unit")) {
        wanted->def.unit = cli_unit(args, option);
    } else {
        return false;
    }
    return true;
}

int cli_report(int argc, char **argv) {
    CliArgs args = {.argc = argc, .argv = argv, .next = 1, .command = "report"};
    Wanted wanted = {.def = jo_default_report_def()};
    const char *option, *plain;
    while ((option = cli_next(&args, &plain)) || plain) {
        if (plain && wanted.def.recording) {
            fprintf(stderr, "jostle report: one recording at a time; what is '%s'?\n", plain);
            return JO_USAGE;
        } else if (plain) {
            wanted.def.recording = plain;
        } else if (!strcmp(option, "help") || !strcmp(option, "h")) {
            fputs(HELP, stdout);
            return JO_OK;
        } else if (!read_option(&wanted, &args, option)) {
            return cli_unknown(&args, option, KNOWN);
        }
    }
    const char *why = !wanted.def.recording ? "no recording given"
                      : !wanted.def.directory && !wanted.summary
                          ? "nothing is asked for: give --out DIR, or --summary FILE"
                          : NULL;
    if (why && !args.failed)
        fprintf(stderr, "jostle report: %s\nTry 'jostle report --help'.\n", why);
    if (why || args.failed)
        return JO_USAGE;
    JoError error = {0};
    char *summary = jo_report(&wanted.def, &error);
    if (!summary) {
        if (error.code == JO_FAILED) /* else it was sent as a message */
            fprintf(stderr, "jostle report: %s\n", error.text);
        return error.code ? (int)error.code : JO_FAILED;
    }
    int status = wanted.summary ? cli_write("report", wanted.summary, summary) : JO_OK;
    jo_free(summary);
    return status;
}
