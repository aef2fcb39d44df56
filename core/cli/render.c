/* The command `render`: draws a scene or a recording by jo_render. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

#include "base/format/path.h"

typedef struct Wanted {
    JoRenderDef def;
    JoSceneDef scene;
    CliList sets, mods;
    double area[4];
    const char *path;
    bool quiet, trusted, from, until, fps, of_scene, of_recording; /* which options are given */
} Wanted;

/* Reads "1280x720" into the size of the picture. */
static bool read_size(void *options, const char *text, char why[160]) {
    Wanted *w = options;
    char rest;
    unsigned width, height;
    if (*text == '-' || sscanf(text, "%5ux%5u%c", &width, &height, &rest) != 2 || width < 320 ||
        height < 320 || width > 8192 || height > 8192) {
        snprintf(why, 160,
                 "is WIDTHxHEIGHT in pixels, each from 320 to 8192, as 1280x720, not '%.60s'",
                 text);
        return false;
    }
    w->def.width = width;
    w->def.height = height;
    return true;
}

/* Reads "0,0,10,5" into the area that is shown, m. */
static bool read_area(void *options, const char *text, char why[160]) {
    Wanted *w = options;
    const char *at = text;
    bool good = true;
    for (int i = 0; good && i < 4; i++) {
        char *end;
        w->area[i] = strtod(at, &end);
        good = end != at && *end == (i < 3 ? ',' : 0) && fabs(w->area[i]) <= 1e5;
        at = end + 1;
    }
    good = good && w->area[2] - w->area[0] >= 0.1 && w->area[3] - w->area[1] >= 0.1;
    w->def.area = w->area;
    if (!good)
        snprintf(why, 160, "is X0,Y0,X1,Y1 in metres with X0 < X1 and Y0 < Y1, not '%.60s'", text);
    return good;
}

static bool read_render_unit(void *options, const char *text, char why[160]) {
    return cli_read_unit(&((Wanted *)options)->def.unit, text, why);
}

static const CliOption OPTIONS[] = {
    {"out", "FILE",
     "FILE.svg or FILE.png: one picture. FILE.mp4, .mkv or .webm: a video, made by the program "
     "ffmpeg; without it the frames stay in FILE-frames. A folder (no ending, or a final '/'): "
     "frame-000001.png, ...",
     "NAME.png here, and NAME-frames with --from, --until or --fps", CLI_TO(Wanted, def.out)},
    {"at", "T", "time of the picture, s", "the beginning", CLI_TO(Wanted, def.at),
     CLI_RANGE(-1e9, 1e9)},
    {"from", "T", "first time of frames and videos, s", "the beginning", CLI_TO(Wanted, def.from),
     CLI_GIVEN(Wanted, from), CLI_RANGE(-1e9, 1e9)},
    {"until", "T", "last time of frames and videos, s",
     "the end of the scene's duration, or of the recording", CLI_TO(Wanted, def.until),
     CLI_GIVEN(Wanted, until), CLI_RANGE(-1e9, 1e9)},
    {"fps", "N", "frames per second", "one for every step, or every few, up to 30",
     CLI_TO(Wanted, def.fps), CLI_GIVEN(Wanted, fps), CLI_RANGE(0.001, 1000)},
    {"size", "WxH", "size in pixels, each from 320 to 8192", "what suits the area",
     .kind = CLI_READ, .read = read_size},
    {"area", "X0,Y0,X1,Y1", "area to show, m", "everything", .kind = CLI_READ, .read = read_area},
    {"colour", "WHAT[:MOST]",
     "colour people by state, group, speed, force, compression, load, density, direction or none; "
     "MOST is the value at the end of the bar, as speed:1.5",
     "what the scene's view says", CLI_TO(Wanted, def.colour)},
    {"color", "WHAT[:MOST]", CLI_TO(Wanted, def.colour)},
    {"field", "WHAT[:MOST]",
     "colour the floor by density (people/m2) or pressure (crowd pressure, 1/s2, from 20 s on, "
     "where it can be measured); people are then drawn as rings",
     CLI_TO(Wanted, def.field)},
    {"paths", NULL, "draw the paths of people and bodies up to that time (at most 500)",
     CLI_TO(Wanted, def.paths)},
    {"quiet", NULL, "print no progress", CLI_TO(Wanted, quiet)},
    CLI_TRUSTED_OPTION(Wanted),
    {"for a scene, as for `jostle run`:", .kind = CLI_HEADING},
    CLI_SCENE_OPTIONS(Wanted, scene),
    {"for a recording:", .kind = CLI_HEADING},
    {"scene", "SCENE", "draw the walls and places of this scene (recordings keep solid walls)",
     CLI_TO(Wanted, def.plan)},
    {"recorded-fps", "N", "frames per second, if the recording does not say",
     CLI_TO(Wanted, def.recorded_fps), CLI_GIVEN(Wanted, of_recording), CLI_RANGE(0.01, 10000)},
    {"unit", "m|cm", "unit of its lengths, if it does not say", .kind = CLI_READ,
     .read = read_render_unit, CLI_GIVEN(Wanted, of_recording)},
};

static bool has_text_ending(const char *text, const char *end) {
    size_t n = strlen(text), m = strlen(end);
    return n > m && strcmp(text + n - m, end) == 0;
}

/* Makes the default output, NAME.png or NAME-frames in the present folder; NAME.svg if the program
   draws no images. */
static void make_default_output(const Wanted *w, char out[512]) {
    const char *name = jox_path_name(w->path);
    const char *dot = strrchr(name, '.');
    int length = dot && dot > name ? (int)(dot - name) : (int)strlen(name);
    snprintf(out, 512, "%.*s%s", length < 400 ? length : 400, name,
             w->from || w->until || w->fps ? "-frames"
             : jo_render_has_images()      ? ".png"
                                           : ".svg");
}

/* Returns which options exclude each other; NULL: none. */
static const char *find_render_misuse(const Wanted *w, bool scene) {
    const bool of_scene = w->of_scene || w->scene.has_seed || w->scene.has_dt;
    const bool of_recording = w->of_recording || w->def.plan;
    return scene && of_recording
               ? "--scene, --recorded-fps and --unit are of recordings; this is a scene"
           : !scene && of_scene
               ? "--seed, --dt, --threads, --set, --input and --mod are of scenes (.yaml); this is "
                 "taken for a recording"
           : w->def.out && (!*w->def.out || strlen(w->def.out) >= 1000)
               ? "--out names a file or a folder"
               : NULL;
}

/* Confines the process to what drawing into the output's folder needs. */
static void confine_render(const Wanted *w, bool scene) {
    CliReach reach = {.programs = true};
    if (scene)
        cli_reach_def(&reach, &w->scene);
    else
        cli_reach_file(&reach, w->path);
    cli_reach_scene(&reach, w->def.plan);
    cli_reach_output(&reach, w->def.out);
    cli_confine_work(&reach, w->trusted);
}

static int render_crowd(Wanted *w) {
    JoError error = {0};
    char out[512];
    const bool scene = has_text_ending(w->path, ".yaml") || has_text_ending(w->path, ".yml");
    const char *why = find_render_misuse(w, scene);
    if (why)
        return cli_report_misuse(&cli_render, why);
    make_default_output(w, out);
    if (!w->def.out)
        w->def.out = out;
    w->def.progress = !w->quiet;
    w->scene.path = w->path;
    w->scene.overrides = w->sets.items;
    w->scene.override_count = w->sets.count;
    w->scene.mods = w->mods.items;
    w->scene.mod_count = w->mods.count;
    if (scene)
        w->def.scene = &w->scene;
    else
        w->def.recording = w->path;
    confine_render(w, scene);
    if (jo_render(&w->def, &error))
        return JO_OK;
    return cli_report_error(&cli_render, &error, *error.file != 0);
}

static bool find_plan_scene(Wanted *w) {
    return !w->def.plan || (w->def.plan = cli_scene(&cli_render, w->def.plan, NULL));
}

static int run_render(int argc, char **argv) {
    Wanted wanted = {.def = jo_default_render_def(), .scene = jo_default_scene_def()};
    CliList plain = {0};
    int status = cli_parse(&cli_render, argc, argv, &wanted, &plain);
    if (status == CLI_GO_ON) {
        wanted.path = cli_scene(&cli_render, plain.items[0], &wanted.mods);
        status = wanted.path && find_plan_scene(&wanted) ? render_crowd(&wanted) : JO_INPUT;
    }
    cli_free(&cli_render, &wanted, &plain);
    return status;
}

const CliCommand cli_render = {
    .name = "render",
    .what = "draw a scene or a recording: pictures, frames, video",
    .usage = "SCENE|RECORDING [options]",
    .about =
        "Draws a crowd from above, without a display: a scene (.yaml), which is simulated for "
        "this, or a recording as for `jostle report`. Shows walls, gates and places with "
        "their names, bodies, people by their torsos or as discs, a legend with units, a scale "
        "and the time.",
    .notes = "examples:\n"
             "  jostle render scenes/office.yaml --at 8 --out office.svg\n"
             "  jostle render scenes/door-050.yaml --at 20 --colour compression --out door.png\n"
             "  jostle render run.sqlite --field density --from 0 --until 30 --out run.mp4\n"
             "\n"
             "exit status: 0 done, 1 writing failed, 2 wrong usage, 3 bad input",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "scene or recording",
    .least = 1,
    .most = 1,
    .none_said = "no scene and no recording given",
    .run = run_render,
};
