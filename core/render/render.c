/* jo_render: writes a picture, a folder of frames or a video of a scene or recording. `jostle
   render` is the caller. */
#include "render/render.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/path.h"
#include "base/guard.h"
#include "base/mem.h"
#include "picture/plot.h"
#include "picture/video.h"
#include "run/messages.h"

enum { RENDER_COOKIE = 0x4a4f524e, LEAST_SIDE = 320, MOST_SIDE = 8192, MOST_FRAMES = 999999 };
static const double MOST_FPS = 30.0; /* the default's upper bound */

/* Kind of output that --out asks for; NONE: an unknown file ending. */
typedef enum Kind { SVG, PNG, VIDEO, FRAMES, NONE } Kind;

/* One call of jo_render. */
typedef struct Job {
    JoxRender render;
    Kind kind;
    JoxCanvas *canvas;
    JoxVideo *video;
    char folder[1024];    /* folder of frames; "" if one file is written */
    uint32_t done, count; /* pictures written, and in all */
    double from, until;   /* s: time range of the pictures */
    double begun, shown;  /* s, wall clock: start of the call, last line of progress */
    int tenth;            /* tenths of the way, in the last line of progress */
} Job;

JoRenderDef jo_default_render_def(void) {
    return (JoRenderDef){.at = NAN, .from = NAN, .until = NAN, .cookie = RENDER_COOKIE};
}

bool jo_render_has_images(void) {
    return jox_canvas_has_images();
}

/* Sets JO_FAILED with a text, which it frees. Returns false. */
static bool fail_with_text(JoError *error, JoxText *why) {
    jox_error(error, JO_FAILED, "%s", why->data ? why->data : "writing failed");
    jox_text_free(why);
    return false;
}

static void forward_message(const JoRenderDef *def, const char *format, const char *what) {
    char text[1200];
    snprintf(text, sizeof text, format, what);
    jox_run_send_message(def->message, def->message_context, text);
}

static const struct {
    const char *ending;
    Kind kind;
} ENDINGS[] = {{".png", PNG}, {".svg", SVG}, {".mp4", VIDEO}, {".mkv", VIDEO}, {".webm", VIDEO}};
enum { ENDING_COUNT = sizeof ENDINGS / sizeof *ENDINGS };

/* Returns what `out` asks for, by its ending. A path is a folder of frames if it is an existing
   folder, ends with '/' or "-frames", or has no ending. */
static Kind find_output_kind(const char *out) {
    struct stat info;
    const char *name = jox_path_name(out), *dot = strrchr(name, '.');
    if (!dot || dot == name || strcmp(dot, "..") == 0 || strstr(dot, "-frames") ||
        (stat(out, &info) == 0 && S_ISDIR(info.st_mode)))
        return FRAMES;
    for (size_t e = 0; e < ENDING_COUNT; e++)
        if (strcasecmp(dot, ENDINGS[e].ending) == 0)
            return ENDINGS[e].kind;
    return NONE;
}

/* Fails with JO_USAGE for an unknown file ending. */
static bool refuse_ending(const char *out, JoError *error) {
    const char *endings[ENDING_COUNT], *dot = strrchr(out, '.');
    char hint[JOX_HINT];
    for (size_t e = 0; e < ENDING_COUNT; e++)
        endings[e] = ENDINGS[e].ending;
    const char *near = jox_did_you_mean(dot, endings, ENDING_COUNT, hint);
    jox_error(error, JO_USAGE,
              "--out: there are no pictures '%.20s'. %s%sOne is .svg or .png, a video .mp4, .mkv "
              "or .webm; a folder of frames ends with '/'",
              dot, near ? near : "", near ? " " : "");
    return false;
}

/* Checks the def's options against each other; on failure sets JO_USAGE with a way out. */
static bool check_render_def(const JoRenderDef *def, Kind kind, JoError *error) {
    if (kind == NONE)
        return refuse_ending(def->out, error);
    bool series = kind == VIDEO || kind == FRAMES;
    const double *a = def->area;
    const char *why =
        !series && (isfinite(def->from) || isfinite(def->until) || def->fps > 0.0)
            ? "one picture shows one moment: --at T; or --out FOLDER, or FILE.mp4, for many"
        : series && isfinite(def->at)
            ? "--at asks for one picture, --out for many: --out FILE.png, or --from and --until"
        : !(def->fps == 0.0 || (def->fps >= 0.001 && def->fps <= 1000.0))
            ? "--fps is from 0.001 to 1000"
        : kind != SVG && !jox_canvas_has_images()
            ? "this build makes no images, as it was made without cairo (CAIRO=0): --out FILE.svg"
        : (def->width || def->height) && (def->width < LEAST_SIDE || def->width > MOST_SIDE ||
                                          def->height < LEAST_SIDE || def->height > MOST_SIDE)
            ? "--size is WIDTHxHEIGHT in pixels, each from 320 to 8192"
        : kind == VIDEO && (def->width % 2 || def->height % 2)
            ? "--size of a video: width and height must be even"
        : a && !(a[2] - a[0] >= 0.1 && a[3] - a[1] >= 0.1 && fabs(a[0]) <= 1e5 &&
                 fabs(a[1]) <= 1e5 && fabs(a[2]) <= 1e5 && fabs(a[3]) <= 1e5)
            ? "--area is x0,y0,x1,y1 in metres, with x0 < x1 and y0 < y1"
            : NULL;
    if (why)
        jox_error(error, JO_USAGE, "%s", why);
    return !why;
}

/* Checks that a file can be written, before an hour of simulation is spent on it. */
static bool require_writable(const char *path, JoError *error) {
    const bool good = jox_file_can_be_written(path);
    if (!good)
        jox_error(error, JO_FAILED, "cannot write '%s': %s", path, strerror(errno));
    return good;
}

/* ---- times ---- */

/* Sets a time, s, to the option's value, or to a default if it was not given. Returns false if
   the crowd has no such time. */
static bool resolve_time(const Job *job, double asked, double usual, double *out, JoError *error) {
    const JoxRender *r = &job->render;
    *out = isfinite(asked) ? asked : usual;
    if (*out >= r->first - 0.5 * r->interval && *out <= r->last + 0.5 * r->interval)
        return true;
    if (r->crowd)
        jox_error(error, JO_INPUT, "%g s is not in this recording, which has %.6g to %.6g s", *out,
                  r->first, r->last);
    else
        jox_error(error, JO_INPUT, "%g s is before the scene begins, which is at 0 s", *out);
    return false;
}

/* Returns the greatest number of frames per second, up to MOST_FPS, at which each frame falls on
   a step. */
static double choose_fps(double interval) {
    double every = ceil(1.0 / (interval * MOST_FPS) - 1e-9);
    return 1.0 / (interval * (every > 1.0 ? every : 1.0));
}

/* Sets the job's times and number of pictures, and the frames per second. */
static bool resolve_times(Job *job, double *fps, JoError *error) {
    const JoxRender *r = &job->render;
    const JoRenderDef *def = r->def;
    double end = r->scene ? jo_scene_duration(r->scene) : r->last;
    if (job->kind == SVG || job->kind == PNG) {
        job->count = 1;
        *fps = 1.0;
        return resolve_time(job, def->at, r->first, &job->from, error) &&
               resolve_time(job, def->at, r->first, &job->until, error);
    }
    *fps = def->fps > 0.0 ? def->fps : choose_fps(r->interval);
    if (!resolve_time(job, def->from, r->first, &job->from, error) ||
        !resolve_time(job, def->until, end, &job->until, error))
        return false;
    double count = floor((job->until - job->from) * *fps + 1e-6) + 1.0;
    if (count >= 1.0 && count <= MOST_FRAMES) {
        job->count = (uint32_t)count;
        return true;
    }
    jox_error(error, JO_USAGE,
              count < 1.0 ? "--from %g s is after --until %g s"
                          : "from %g to %g s there are more than 999,999 frames; a smaller --fps",
              job->from, job->until);
    return false;
}

/* ---- progress ---- */

/* Writes a line of progress to stderr: on a terminal every 0.2 s over the last one, else every
   tenth of the way. */
static void show_render_progress(Job *job, bool ended) {
    double wall = jox_clock_wall(), spent = wall - job->begun;
    double span = job->until - job->render.first, share = 1.0;
    bool terminal = isatty(2);
    if (!job->render.def->progress)
        return;
    if (span > 0.0 && !ended)
        share = (jox_render_time(&job->render) - job->render.first) / span;
    int tenth = (int)(share * 10.0 + 1e-9);
    if (!ended && (terminal ? wall - job->shown < 0.2 : tenth == job->tenth || tenth == 10))
        return;
    job->shown = wall;
    job->tenth = tenth;
    fprintf(stderr, "%s%6.1f of %.1f s, picture %u of %u, %.0f s left%s", terminal ? "\r" : "",
            jox_render_time(&job->render), job->until, job->done, job->count,
            ended || share <= 0.0 ? 0.0 : spent / share - spent, !terminal || ended ? "\n" : "   ");
}

/* ---- output ---- */

/* Prepares the file or folder before any picture is drawn. Without ffmpeg, a video's frames go
   to a folder. */
static bool prepare_output(Job *job, JoError *error) {
    const JoRenderDef *def = job->render.def;
    JoxText why = {0};
    if (job->kind != FRAMES && !require_writable(def->out, error))
        return false;
    if (job->kind == VIDEO && !jox_video_available()) {
        snprintf(job->folder, sizeof job->folder, "%.*s-frames",
                 (int)(strrchr(def->out, '.') - def->out), def->out);
        forward_message(def, "there is no ffmpeg to make a video; its frames go to %s\n",
                        job->folder);
    } else if (job->kind == FRAMES) {
        snprintf(job->folder, sizeof job->folder, "%s", def->out);
    }
    return !*job->folder || jox_plot_folder(job->folder, &why) || fail_with_text(error, &why);
}

/* Creates the canvas, of the given size or one that suits the area, and starts the video. */
static bool open_output(Job *job, double fps, JoError *error) {
    const JoRenderDef *def = job->render.def;
    uint32_t width = def->width, height = def->height;
    JoxText why = {0};
    if (!width || !height)
        jox_draw_size(&job->render.picture, &width, &height);
    job->canvas =
        job->kind == SVG ? jox_canvas_svg(width, height) : jox_canvas_image(width, height);
    if (job->kind == VIDEO && !*job->folder)
        job->video = jox_video_open(def->out, width, height, fps, &why);
    return job->kind != VIDEO || *job->folder || job->video || fail_with_text(error, &why);
}

static void frame_path(const Job *job, uint32_t number, char path[1100]) {
    snprintf(path, 1100, "%s/frame-%06u.png", job->folder, number);
}

/* Draws the current frame and writes it as a file or into the video. */
static bool write_next_picture(Job *job, JoError *error) {
    char path[1100];
    JoxText why = {0};
    jox_draw(job->canvas, jox_render_picture(&job->render));
    job->done++;
    frame_path(job, job->done, path);
    bool good = job->video ? jox_video_frame(job->video, jox_canvas_pixels(job->canvas), &why)
                           : jox_canvas_write(job->canvas,
                                              *job->folder ? path : job->render.def->out, &why);
    return good || fail_with_text(error, &why);
}

/* Closes the video and reports which files were written. Fails if a video was asked for and
   there is no ffmpeg. */
static bool finish_pictures(Job *job, double fps, bool good, JoError *error) {
    const JoRenderDef *def = job->render.def;
    JoxText why = {0};
    if (job->video && !jox_video_close(job->video, &why) && good)
        good = fail_with_text(error, &why);
    jox_text_free(&why);
    if (!good)
        return false;
    char path[1100];
    if (*job->folder) { /* deletes frames that an earlier, longer series left */
        for (uint32_t n = job->done + 1; frame_path(job, n, path), unlink(path) == 0;)
            n++;
        snprintf(path, sizeof path, "%s/frame-000001.png to frame-%06u.png", job->folder,
                 job->done);
    }
    forward_message(def, "pictures: %s\n", *job->folder ? path : def->out);
    if (job->kind == VIDEO && *job->folder) {
        jox_error(error, JO_FAILED,
                  "no video was made, as there is no ffmpeg (Debian: apt-get install ffmpeg); its "
                  "frames are there: ffmpeg -framerate %.9g -i %s/frame-%%06d.png -pix_fmt yuv420p "
                  "%s",
                  fps, job->folder, def->out);
        return false;
    }
    return true;
}

/* Advances to a time, s, and shows progress once per second of simulated time. */
static bool advance_with_progress(Job *job, double time, JoError *error) {
    bool good = true;
    for (double on = jox_render_time(&job->render) + 1.0; good && on < time; on += 1.0) {
        good = jox_render_advance(&job->render, on, error);
        show_render_progress(job, false);
    }
    return good && jox_render_advance(&job->render, time, error);
}

static bool render_pictures(const JoRenderDef *def, JoError *error) {
    Job *job = jox_alloc(1, sizeof *job);
    double fps = 1.0;
    job->kind = find_output_kind(def->out);
    job->render.def = def;
    job->begun = jox_clock_wall();
    job->tenth = -1;
    bool good = check_render_def(def, job->kind, error) && jox_render_load(&job->render, error) &&
                resolve_times(job, &fps, error) && prepare_output(job, error);
    bool began = false;
    for (uint32_t n = 0; good && n < job->count; n++) {
        double time = job->from + (double)n / fps;
        good = advance_with_progress(job, time, error);
        if (good && n == 0) {
            if (job->count == 1)
                jox_render_widen_area(&job->render);
            good = began = open_output(job, fps, error);
        }
        good = good && write_next_picture(job, error);
        show_render_progress(job, n + 1 == job->count && good);
    }
    if (began)
        good = finish_pictures(job, fps, good, error);
    jox_canvas_free(job->canvas);
    jox_render_free(&job->render);
    jox_free(job);
    return good;
}

bool jo_render(const JoRenderDef *def, JoError *error) {
    JOX_REQUIRE(def && def->cookie == RENDER_COOKIE && def->out && *def->out, false);
    JOX_REQUIRE(!def->scene != !def->recording, false);
    JOX_REQUIRE(strlen(def->out) < 1000, false);
    JOX_REQUIRE(def->recorded_fps >= 0.0 && def->recorded_fps <= 1e5, false);
    JOX_REQUIRE(def->unit >= 0.0 && def->unit <= 1e3 && !isinf(def->at), false);
    JOX_GUARD (NULL, error)
        return false;
    return render_pictures(def, error);
}
