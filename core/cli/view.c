/* The command `view`: shows a recording on the live page by jo_view_recording. */
#include "base/format/installed.h"
#include "cli/cli.h"

typedef struct View {
    JoViewRecordingDef def;
    bool trusted;
} View;

static bool read_view_unit(void *options, const char *text, char why[160]) {
    return cli_read_unit(&((View *)options)->def.unit, text, why);
}

static const CliOption OPTIONS[] = {
    {"scene", "SCENE",
     "draw its places and scenery as they are now, and the walls and bodies that the recording "
     "lacks",
     "what the recording has", CLI_TO(View, def.scene)},
    {"port", "N", "serve at this port", "8730, or the next that is free", CLI_TO(View, def.port),
     CLI_RANGE(1, 65535)},
    {"view-address", "A",
     "listen at this address, not at 127.0.0.1: others can then reach the page",
     CLI_TO(View, def.address)},
    {"page", "DIR", "folder of the page's files", CLI_TO(View, def.page)},
    {"fps", "N", "frames per second, if the recording does not say", CLI_TO(View, def.fps),
     CLI_RANGE(0.01, 10000)},
    {"unit", "m|cm", "unit of its lengths, if it does not say", .kind = CLI_READ,
     .read = read_view_unit},
    CLI_TRUSTED_OPTION(View),
};

static void confine_view(const View *view) {
    CliReach reach = {.serves = true};
    cli_reach_file(&reach, view->def.recording);
    cli_reach_scene(&reach, view->def.scene);
    cli_reach_folder(&reach, view->def.page ? view->def.page : jox_page_folder());
    cli_confine_work(&reach, view->trusted);
}

static bool find_view_inputs(View *v) {
    return cli_check_recording(&cli_view, v->def.recording) &&
           (!v->def.scene || (v->def.scene = cli_scene(&cli_view, v->def.scene, NULL)));
}

static int run_view(int argc, char **argv) {
    View view = {.def = jo_default_view_recording_def()};
    CliList plain = {0};
    JoError error = {0};
    int status = cli_parse(&cli_view, argc, argv, &view, &plain);
    view.def.recording = plain.count ? plain.items[0] : NULL;
    if (status == CLI_GO_ON && !find_view_inputs(&view))
        status = JO_INPUT;
    if (status == CLI_GO_ON) {
        cli_catch_signals(true);
        view.def.stop = &cli_signal;
        view.def.opened = cli_print_address;
        confine_view(&view);
        status = jo_view_recording(&view.def, &error)
                     ? cli_add_signal_status(JO_OK) /* faults of files were sent as messages */
                     : cli_report_error(&cli_view, &error, error.code != JO_FAILED);
    }
    cli_free(&cli_view, &view, &plain);
    return status;
}

const CliCommand cli_view = {
    .name = "view",
    .what = "show a recording on the live page",
    .usage = "RECORDING [options]",
    .about =
        "Shows a recording on the live page, to play, pause and inspect: an SQLite file of `jostle "
        "run --record` or of JuPedSim (versions 1 and 2), text with the columns id, frame, x, y "
        "(PeTrack, the archive of Juelich), or CSV with a header line. Prints the page's address.",
    .notes = "exit status: 1 the page cannot be served, 2 wrong usage, 3 bad input; 129, 130 and "
             "143: SIGHUP, SIGINT (Ctrl-C) or SIGTERM ended it",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "recording",
    .least = 1,
    .most = 1,
    .none_said = "no recording given; `jostle run SCENE --view` shows a scene",
    .run = run_view,
};
