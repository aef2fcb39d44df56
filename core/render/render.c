/* jo_render: pictures, frames and videos. */
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

enum { RENDER_COOKIE = 0x4a4f524e, LEAST_SIDE = 320, MOST_SIDE = 8192, MOST_FRAMES = 999999 };
static const double MOST_FPS = 30.0; /* unless asked for */

typedef enum Kind { SVG, PNG, VIDEO, FRAMES, NONE } Kind;

typedef struct Job {
    JoxRender render;
    Kind kind;
    JoxCanvas *canvas;
    JoxVideo *video;
    char folder[1024]; /* of frames */
    uint32_t done, count;
    double from, until, begun, shown; /* s */
    int tenth;
} Job;

JoRenderDef jo_default_render_def(void) {
    return (JoRenderDef){.at = NAN, .from = NAN, .until = NAN, .cookie = RENDER_COOKIE};
}

bool jo_render_has_images(void) {
    return jox_canvas_has_images();
}

static bool fail(JoError *error, JoxText *why) {
    jox_error(error, JO_FAILED, "%s", why->data ? why->data : "writing failed");
    jox_text_free(why);
    return false;
}

static void say(const JoRenderDef *def, const char *format, const char *what) {
    char text[1200];
    snprintf(text, sizeof text, format, what);
    jox_run_message(def->message, def->message_context, text);
}

static const struct {
    const char *ending;
    Kind kind;
} ENDINGS[] = {{".png", PNG}, {".svg", SVG}, {".mp4", VIDEO}, {".mkv", VIDEO}, {".webm", VIDEO}};
enum { ENDING_COUNT = sizeof ENDINGS / sizeof *ENDINGS };

/* By the ending; a folder is one that is there, that ends with '/' or "-frames", or whose name has
   no ending. */
static Kind kind_of(const char *out) {
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

/* JO_USAGE for a file of an ending that there is not. */
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

/* Whether the def makes sense; else JO_USAGE with the way out. */
static bool check(const JoRenderDef *def, Kind kind, JoError *error) {
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

/* That a file can be written is found out before an hour of simulation. */
static bool writable(const char *path, JoError *error) {
    const bool good = jox_file_can_be_written(path);
    if (!good)
        jox_error(error, JO_FAILED, "cannot write '%s': %s", path, strerror(errno));
    return good;
}

/* ---- times ---- */

/* A time of the def, or what stands for it; false where there is none such. */
static bool find_time(const Job *job, double asked, double usual, double *out, JoError *error) {
    const JoxRender *r = &job->render;
    *out = isfinite(asked) ? asked : usual;
    if (*out >= r->first - 0.5 * r->pace && *out <= r->last + 0.5 * r->pace)
        return true;
    if (r->crowd)
        jox_error(error, JO_INPUT, "%g s is not in this recording, which has %.6g to %.6g s", *out,
                  r->first, r->last);
    else
        jox_error(error, JO_INPUT, "%g s is before the scene begins, which is at 0 s", *out);
    return false;
}

/* The most frames a second, up to MOST_FPS, that fall on steps. */
static double usual_fps(double pace) {
    double every = ceil(1.0 / (pace * MOST_FPS) - 1e-9);
    return 1.0 / (pace * (every > 1.0 ? every : 1.0));
}

static bool find_times(Job *job, double *fps, JoError *error) {
    const JoxRender *r = &job->render;
    const JoRenderDef *def = r->def;
    double end = r->scene ? jo_scene_duration(r->scene) : r->last;
    if (job->kind == SVG || job->kind == PNG) {
        job->count = 1;
        *fps = 1.0;
        return find_time(job, def->at, r->first, &job->from, error) &&
               find_time(job, def->at, r->first, &job->until, error);
    }
    *fps = def->fps > 0.0 ? def->fps : usual_fps(r->pace);
    if (!find_time(job, def->from, r->first, &job->from, error) ||
        !find_time(job, def->until, end, &job->until, error))
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

static void progress(Job *job, bool ended) {
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

/* Where pictures go, before any is made. */
static bool prepare(Job *job, JoError *error) {
    const JoRenderDef *def = job->render.def;
    JoxText why = {0};
    if (job->kind != FRAMES && !writable(def->out, error))
        return false;
    if (job->kind == VIDEO && !jox_video_available()) {
        snprintf(job->folder, sizeof job->folder, "%.*s-frames",
                 (int)(strrchr(def->out, '.') - def->out), def->out);
        say(def, "there is no ffmpeg to make a video; its frames go to %s\n", job->folder);
    } else if (job->kind == FRAMES) {
        snprintf(job->folder, sizeof job->folder, "%s", def->out);
    }
    return !*job->folder || jox_plot_folder(job->folder, &why) || fail(error, &why);
}

/* The canvas, of the size asked for or that suits the area, and the video. */
static bool begin(Job *job, double fps, JoError *error) {
    const JoRenderDef *def = job->render.def;
    uint32_t width = def->width, height = def->height;
    JoxText why = {0};
    if (!width || !height)
        jox_draw_size(job->render.picture.low, job->render.picture.high, &width, &height);
    job->canvas =
        job->kind == SVG ? jox_canvas_svg(width, height) : jox_canvas_image(width, height);
    if (job->kind == VIDEO && !*job->folder)
        job->video = jox_video_open(def->out, width, height, fps, &why);
    return job->kind != VIDEO || *job->folder || job->video || fail(error, &why);
}

static void frame_path(const Job *job, uint32_t number, char path[1100]) {
    snprintf(path, 1100, "%s/frame-%06u.png", job->folder, number);
}

static bool put(Job *job, JoError *error) {
    char path[1100];
    JoxText why = {0};
    jox_draw(job->canvas, jox_render_picture(&job->render));
    job->done++;
    frame_path(job, job->done, path);
    bool good = job->video ? jox_video_frame(job->video, jox_canvas_pixels(job->canvas), &why)
                           : jox_canvas_write(job->canvas,
                                              *job->folder ? path : job->render.def->out, &why);
    return good || fail(error, &why);
}

/* Says what there is now. */
static bool end(Job *job, double fps, bool good, JoError *error) {
    const JoRenderDef *def = job->render.def;
    JoxText why = {0};
    if (job->video && !jox_video_close(job->video, &why) && good)
        good = fail(error, &why);
    jox_text_free(&why);
    if (!good)
        return false;
    char path[1100];
    if (*job->folder) { /* frames of a longer series before this one */
        for (uint32_t n = job->done + 1; frame_path(job, n, path), unlink(path) == 0;)
            n++;
        snprintf(path, sizeof path, "%s/frame-000001.png to frame-%06u.png", job->folder,
                 job->done);
    }
    say(def, "pictures: %s\n", *job->folder ? path : def->out);
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

/* Long ways to the first picture show how far they are. */
static bool go_on(Job *job, double time, JoError *error) {
    bool good = true;
    for (double on = jox_render_time(&job->render) + 1.0; good && on < time; on += 1.0) {
        good = jox_render_advance(&job->render, on, error);
        progress(job, false);
    }
    return good && jox_render_advance(&job->render, time, error);
}

static bool draw_all(const JoRenderDef *def, JoError *error) {
    Job *job = jox_alloc(1, sizeof *job);
    double fps = 1.0;
    job->kind = kind_of(def->out);
    job->render.def = def;
    job->begun = jox_clock_wall();
    job->tenth = -1;
    bool good = check(def, job->kind, error) && jox_render_load(&job->render, error) &&
                find_times(job, &fps, error) && prepare(job, error);
    bool began = false;
    for (uint32_t n = 0; good && n < job->count; n++) {
        double time = job->from + (double)n / fps;
        good = go_on(job, time, error);
        if (good && n == 0) {
            if (job->count == 1)
                jox_render_widen(&job->render);
            good = began = begin(job, fps, error);
        }
        good = good && put(job, error);
        progress(job, n + 1 == job->count && good);
    }
    if (began)
        good = end(job, fps, good, error);
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
    return draw_all(def, error);
}
