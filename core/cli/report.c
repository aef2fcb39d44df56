/* The command `report`: measures a recording by jo_report, or writes the page of a sweep's runs. */
#include "cli/cli.h"

typedef struct Wanted {
    JoReportDef def;
    const char *summary;
    bool trusted;
} Wanted;

static bool read_report_unit(void *options, const char *text, char why[160]) {
    return cli_read_unit(&((Wanted *)options)->def.unit, text, why);
}

#define HEAD(name, value, meaning, member)                                                         \
    { name, value, meaning, CLI_TO(Wanted, def.head.member) }
static const CliOption OPTIONS[] = {
    {"scene", "SCENE",
     "measure with this scene's `probes` and draw its walls (without: fields, and densities and "
     "speeds over time, of the whole area)",
     CLI_TO(Wanted, def.scene)},
    {"out", "DIR",
     "write a page, index.html, and NAME.csv, NAME.png and NAME.svg of each probe and of danger: "
     "density, crowd pressure and, for recordings of `jostle run`, loads",
     CLI_TO(Wanted, def.directory), .writes = "folder"},
    {"summary", "FILE", "write the figures as JSON; '-' is standard output",
     CLI_TO(Wanted, summary), .writes = "json txt"},
    {"fps", "N", "frames per second, if the recording does not say", CLI_TO(Wanted, def.fps),
     CLI_RANGE(0.01, 10000)},
    {"unit", "m|cm", "unit of its lengths, if it does not say", .kind = CLI_READ,
     .read = read_report_unit},
    HEAD("title", "TEXT", "title of the report; without: the scene's, or the recording's name",
         title),
    HEAD("author", "NAME",
         "who prepared the report; this and what follows overrides the scene's `report`", author),
    HEAD("organisation", "NAME", "the author's organisation", organisation),
    HEAD("project", "TEXT", "project or client", project),
    HEAD("reference", "TEXT", "number of the document and its revision", reference),
    HEAD("checked-by", "NAME", "who checks the report", checked_by),
    HEAD("approved-by", "NAME", "who approves the report", approved_by),
    HEAD("date", "DATE", "date of the report; without: that of SOURCE_DATE_EPOCH, or today, in UTC",
         date),
    CLI_TRUSTED_OPTION(Wanted),
};
#undef HEAD

static void confine_report(const Wanted *wanted) {
    CliReach reach = {.programs = true};
    cli_reach_file(&reach, wanted->def.recording);
    cli_reach_scene(&reach, wanted->def.scene);
    cli_reach_output(&reach, wanted->def.directory);
    cli_reach_output(&reach, wanted->summary);
    cli_confine_work(&reach, wanted->trusted);
}

static int report_recording(const Wanted *wanted) {
    JoError error = {0};
    if (!wanted->def.directory && !wanted->summary)
        return cli_report_misuse(&cli_report,
                                 "nothing is asked for: give --out DIR, or --summary FILE");
    const char *inputs[] = {wanted->def.recording, wanted->def.scene};
    if (cli_check_apart(&cli_report, &wanted->summary, 1, inputs, 2, NULL) != JO_OK)
        return JO_USAGE;
    confine_report(wanted);
    if (cli_is_sweep(wanted->def.recording)) {
        if (wanted->summary || wanted->def.scene || !wanted->def.directory)
            return cli_report_misuse(&cli_report, "the runs of a sweep go with --out DIR alone");
        return cli_write_runs_page(&cli_report, wanted->def.recording, wanted->def.directory,
                                   &wanted->def.head, false);
    }
    char *summary = jo_report(&wanted->def, &error);
    if (!summary) /* faults of files were sent as messages */
        return cli_report_error(&cli_report, &error, error.code != JO_FAILED);
    int status = wanted->summary ? cli_write(&cli_report, wanted->summary, summary) : JO_OK;
    jo_free(summary);
    return status;
}

static bool find_report_inputs(Wanted *w) {
    return cli_check_recording(&cli_report, w->def.recording) &&
           (!w->def.scene || (w->def.scene = cli_scene(&cli_report, w->def.scene, NULL)));
}

static int run_report(int argc, char **argv) {
    Wanted wanted = {.def = jo_default_report_def()};
    CliList plain = {0};
    int status = cli_parse(&cli_report, argc, argv, &wanted, &plain);
    if (status == CLI_GO_ON) {
        wanted.def.recording = plain.items[0];
        status = find_report_inputs(&wanted) ? report_recording(&wanted) : JO_INPUT;
    }
    cli_free(&cli_report, &wanted, &plain);
    return status;
}

const CliCommand cli_report = {
    .name = "report",
    .what = "measure a recording, simulated or real",
    .usage = "RECORDING [options]",
    .about =
        "Measures a recording: an SQLite file of `jostle run --record` or of JuPedSim (versions 1 "
        "and 2), text with the columns id, frame, x, y (PeTrack, the archive of Juelich), or CSV "
        "with a header line (ID,Frame,x,y,v_x,v_y; a column storey, level or floor tells storeys "
        "apart). Give one of --out and --summary, or both. For a file of `jostle sweep` with one "
        "variant, --out writes the page of all its seeds.",
    .notes = "exit status: 0 done, 1 writing failed, 2 wrong usage, 3 bad input",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "recording",
    .least = 1,
    .most = 1,
    .run = run_report,
};
