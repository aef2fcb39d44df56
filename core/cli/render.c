#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle render SCENE|RECORDING [options]\n\n"
    "Draws a crowd from above, without a display: a scene (.yaml), which is run for it, or a\n"
    "recording as of `jostle report`. Walls, gates and places with their names, bodies, people as\n"
    "discs of their radius, a legend with units, a scale and the time.\n\n"
    "  --out FILE.svg|FILE.png    one picture (default: NAME.png here)\n"
    "  --out FOLDER               frame-000001.png, ... (default with --from, --until or --fps:\n"
    "                             NAME-frames)\n"
    "  --out FILE.mp4             a video, also .mkv and .webm; needs the program ffmpeg, without\n"
    "                             which its frames stay in FILE-frames\n"
    "  --at T                     time of the picture, s (default: the beginning)\n"
    "  --from T, --until T        of frames and videos, s (default: all of the scene's duration,\n"
    "                             or of the recording)\n"
    "  --fps N                    frames a second (default: of every step, or every few, up to "
    "30)\n"
    "  --size WxH                 in pixels, each from 320 to 8192 (default: what suits the area)\n"
    "  --area X0,Y0,X1,Y1         what is shown, m (default: everything)\n"
    "  --colour WHAT[:MOST]       of people: state, group, speed, force, compression, density or\n"
    "                             none; MOST is the value at the end of the bar, as speed:1.5\n"
    "  --field WHAT[:MOST]        on the floor: density (people/m2) or pressure (crowd pressure,\n"
    "                             1/s2, from 10 s on); people are then rings\n"
    "  --paths                    where people and bodies went until then (of many, 500)\n"
    "  --quiet                    no progress\n\n"
    "of a scene, as of `jostle run`: --seed N --dt S --threads N --set PATH=VALUE --input FILE\n"
    "  --mod DIR --no-mods\n"
    "of a recording:\n"
    "  --scene SCENE              whose walls and places are drawn (recordings keep solid walls)\n"
    "  --recorded-fps N           frames a second, where the recording does not say\n"
    "  --unit m|cm                unit of its lengths, where it does not say\n\n"
    "examples:\n"
    "  jostle render scenes/office.yaml --at 8 --out office.svg\n"
    "  jostle render scenes/door-050.yaml --at 20 --colour compression --out door.png\n"
    "  jostle render run.sqlite --field density --from 0 --until 30 --out run.mp4\n\n"
    "exit status: 0 done, 1 writing failed, 2 wrong usage, 3 bad input\n";

static const char *const KNOWN[] = {"out",     "at",     "from",         "until", "fps",   "size",
                                    "area",    "colour", "color",        "field", "paths", "quiet",
                                    "seed",    "dt",     "threads",      "set",   "input", "mod",
                                    "no-mods", "scene",  "recorded-fps", "unit",  "help",  NULL};

typedef struct Wanted {
    JoRenderDef def;
    JoSceneDef scene;
    const char **overrides, **mods;
    double area[4];
    const char *path;
    bool series, of_scene, of_recording; /* options were given that only these have */
} Wanted;

/* "1280x720" */
static void read_size(Wanted *w, CliArgs *args, const char *option) {
    const char *text = cli_value(args, option);
    char rest;
    unsigned width, height;
    if (!text)
        return;
    if (*text == '-' || sscanf(text, "%5ux%5u%c", &width, &height, &rest) != 2 || width < 320 ||
        height < 320 || width > 8192 || height > 8192) {
        fprintf(stderr,
                "jostle render: --size is WIDTHxHEIGHT in pixels, each from 320 to 8192, as "
                "1280x720, not '%s'\n",
                text);
        args->failed = true;
        return;
    }
    w->def.width = width;
    w->def.height = height;
}

/* "0,0,10,5" */
static void read_area(Wanted *w, CliArgs *args, const char *option) {
    const char *text = cli_value(args, option), *at = text;
    bool good = text != NULL;
    for (int i = 0; good && i < 4; i++) {
        char *end;
        w->area[i] = strtod(at, &end);
        good = end != at && *end == (i < 3 ? ',' : 0) && fabs(w->area[i]) <= 1e5;
        at = end + 1;
    }
    good = good && w->area[2] - w->area[0] >= 0.1 && w->area[3] - w->area[1] >= 0.1;
    w->def.area = w->area;
    if (good || !text)
        return;
    fprintf(stderr,
            "jostle render: --area is X0,Y0,X1,Y1 in metres with X0 < X1 and Y0 < Y1, not '%s'\n",
            text);
    args->failed = true;
}

static bool read_scene_option(Wanted *w, CliArgs *args, const char *option) {
    if (!strcmp(option, "seed")) {
        w->scene.seed = cli_whole(args, option, 0, UINT64_MAX);
        w->scene.has_seed = true;
    } else if (!strcmp(option, "dt")) {
        w->scene.dt = cli_number(args, option, 0.001, 0.2);
        w->scene.has_dt = true;
    } else if (!strcmp(option, "threads")) {
        w->scene.threads = (uint32_t)cli_whole(args, option, 1, 64);
    } else if (!strcmp(option, "set")) {
        w->overrides[w->scene.override_count++] = cli_value(args, option);
    } else if (!strcmp(option, "input")) {
        w->scene.input_log = cli_value(args, option);
    } else if (!strcmp(option, "mod")) {
        w->mods[w->scene.mod_count++] = cli_value(args, option);
    } else if (!strcmp(option, "no-mods")) {
        w->scene.named_mods_only = true;
    } else {
        return false;
    }
    w->of_scene = true;
    return true;
}

static bool read_recording_option(Wanted *w, CliArgs *args, const char *option) {
    if (!strcmp(option, "scene")) {
        w->def.plan = cli_value(args, option);
    } else if (!strcmp(option, "recorded-fps")) {
        w->def.recorded_fps = cli_number(args, option, 0.01, 10000);
    } else if (!strcmp(option, "unit")) {
        const char *unit = cli_value(args, option);
        w->def.unit = unit && !strcmp(unit, "cm") ? 0.01 : 1.0;
        if (unit && strcmp(unit, "m") != 0 && strcmp(unit, "cm") != 0) {
            fprintf(stderr, "jostle render: --unit is m or cm, not '%s'\n", unit);
            args->failed = true;
        }
    } else {
        return false;
    }
    w->of_recording = true;
    return true;
}

/* Reads one option; false if there is none of this name. */
static bool read_option(Wanted *w, CliArgs *args, const char *option) {
    JoRenderDef *def = &w->def;
    if (!strcmp(option, "out")) {
        def->out = cli_value(args, option);
    } else if (!strcmp(option, "at")) {
        def->at = cli_number(args, option, -1e9, 1e9);
    } else if (!strcmp(option, "from")) {
        def->from = cli_number(args, option, -1e9, 1e9);
        w->series = true;
    } else if (!strcmp(option, "until")) {
        def->until = cli_number(args, option, -1e9, 1e9);
        w->series = true;
    } else if (!strcmp(option, "fps")) {
        def->fps = cli_number(args, option, 0.001, 1000);
        w->series = true;
    } else if (!strcmp(option, "size")) {
        read_size(w, args, option);
    } else if (!strcmp(option, "area")) {
        read_area(w, args, option);
    } else if (!strcmp(option, "colour") || !strcmp(option, "color")) {
        def->colour = cli_value(args, option);
    } else if (!strcmp(option, "field")) {
        def->field = cli_value(args, option);
    } else if (!strcmp(option, "paths")) {
        def->paths = true;
    } else if (!strcmp(option, "quiet")) {
        def->progress = false;
    } else {
        return read_scene_option(w, args, option) || read_recording_option(w, args, option);
    }
    return true;
}

static bool ends(const char *text, const char *end) {
    size_t n = strlen(text), m = strlen(end);
    return n > m && strcmp(text + n - m, end) == 0;
}

/* NAME.png, or NAME-frames, in the present folder. */
static void usual_out(const Wanted *w, char out[512]) {
    const char *slash = strrchr(w->path, '/'), *name = slash ? slash + 1 : w->path;
    const char *dot = strrchr(name, '.');
    int length = dot && dot > name ? (int)(dot - name) : (int)strlen(name);
    snprintf(out, 512, "%.*s%s", length < 400 ? length : 400, name,
             w->series                ? "-frames"
             : jo_render_has_images() ? ".png"
                                      : ".svg");
}

static int draw(Wanted *w) {
    JoError error = {0};
    char out[512];
    bool scene = ends(w->path, ".yaml") || ends(w->path, ".yml");
    const char *why = scene && w->of_recording
                          ? "--scene, --recorded-fps and --unit are of recordings; this is a scene"
                      : !scene && w->of_scene
                          ? "--seed, --dt, --threads, --set, --input and --mod are of scenes "
                            "(.yaml); this is taken for a recording"
                      : w->def.out && (!*w->def.out || strlen(w->def.out) >= 1000)
                          ? "--out names a file or a folder"
                          : NULL;
    if (why) {
        fprintf(stderr, "jostle render: %s\nTry 'jostle render --help'.\n", why);
        return JO_USAGE;
    }
    usual_out(w, out);
    if (!w->def.out)
        w->def.out = out;
    w->scene.path = w->path;
    w->scene.overrides = w->overrides;
    w->scene.mods = w->mods;
    if (scene)
        w->def.scene = &w->scene;
    else
        w->def.recording = w->path;
    if (jo_render(&w->def, &error))
        return JO_OK;
    if (!*error.file) /* else it was sent as a message, with its place */
        fprintf(stderr, "jostle render: %s\n", error.text);
    return error.code ? (int)error.code : JO_FAILED;
}

int cli_render(int argc, char **argv) {
    CliArgs args = {.argc = argc, .argv = argv, .next = 1, .command = "render"};
    Wanted w = {.def = jo_default_render_def(), .scene = jo_default_scene_def()};
    w.overrides = calloc((size_t)argc, sizeof *w.overrides);
    w.mods = calloc((size_t)argc, sizeof *w.mods);
    w.def.progress = true;
    const char *option, *plain;
    int status = -1;
    while (status < 0 && ((option = cli_next(&args, &plain)) || plain)) {
        if (plain && w.path) {
            fprintf(stderr, "jostle render: one scene or recording at a time; what is '%s'?\n",
                    plain);
            status = JO_USAGE;
        } else if (plain) {
            w.path = plain;
        } else if (!strcmp(option, "help") || !strcmp(option, "h")) {
            fputs(HELP, stdout);
            status = JO_OK;
        } else if (!read_option(&w, &args, option)) {
            status = cli_unknown(&args, option, KNOWN);
        }
    }
    if (status < 0 && args.failed)
        status = JO_USAGE;
    if (status < 0 && !w.path) {
        fprintf(stderr, "jostle render: no scene and no recording given\n"
                        "Try 'jostle render --help'.\n");
        status = JO_USAGE;
    }
    if (status < 0)
        status = draw(&w);
    free(w.overrides);
    free(w.mods);
    return status;
}
