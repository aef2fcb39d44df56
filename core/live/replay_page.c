/* A recording on its live page: it is played, paused and looked through at the pace people want.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "live/replay_page.h"
#include "run/run.h"

enum { RECORDING_COOKIE = 0x4a4f5652, MOST_STEPS = 100000 };
static const double LEAP = 2.5; /* s since the last status, after which no pace is measured */

JoViewRecordingDef jo_default_view_recording_def(void) {
    return (JoViewRecordingDef){.cookie = RECORDING_COOKIE};
}

/* ---- time ---- */

static void pause(JoxReplayPage *p, bool on) {
    p->page.session.paused = on;
    p->wall = jox_clock_wall();
    p->page.last_status = 0.0;
}

/* Shows the frame of the present time. Where it cannot be read, pages are told, and it waits. */
static void show_present(JoxReplayPage *p) {
    const uint32_t frame = jox_replay_find(p->replay, p->at);
    JoxText why = {0}, text = {0};
    if (frame == p->frame)
        return;
    p->frame = frame;
    p->page.changed = true;
    if (!jox_replay_show(p->replay, frame, &why)) {
        p->page.session.jumps++;
        jox_text_printf(&text, "The recording is damaged at %.2f s: %s.", p->at, why.data);
        jox_live_say(&p->page, JOX_VIEW_ALL, "error", text.data);
        jox_text_free(&text);
        pause(p, true);
    }
    jox_text_free(&why);
}

/* Goes to a time from wherever it was: nobody walks there. */
static void seek(JoxReplayPage *p, double time) {
    p->at = fmin(fmax(time, p->from), p->until);
    p->frame = UINT32_MAX;
    p->page.session.jumps++;
    p->wall = jox_clock_wall();
    p->page.last_status = 0.0;
    jox_replay_forget(p->replay);
    show_present(p);
}

static double advance(void *self, double now) {
    JoxReplayPage *p = self;
    const JoxLiveSession *session = &p->page.session;
    if (jox_view_clients(p->page.server) == 0) /* it waits for somebody to look */
        p->wall = now;
    if (session->paused)
        return INFINITY;
    p->at = fmin(p->at + (now - p->wall) * session->speed, p->until);
    p->wall = now;
    show_present(p);
    if (p->at >= p->until)
        pause(p, true);
    if (p->frame + 1 >= jox_replay_frames(p->replay))
        return INFINITY;
    const double next = jox_replay_time(p->replay, p->frame + 1) - p->at;
    return fmax(next / session->speed, 0.01);
}

/* ---- what pages are shown ---- */

static JoxLiveColour first_colour(const void *self) {
    const JoxReplayPage *p = self;
    return jox_replay_colour(p->replay);
}

static JoxLiveField first_field(const void *self) {
    const JoxReplayPage *p = self;
    return jox_replay_first_field(p->replay);
}

static void describe(void *self, JoxText *out) {
    JoxReplayPage *p = self;
    jox_replay_scene(p->replay, out);
}

static uint64_t version(const void *self) {
    const JoxReplayPage *p = self;
    return jox_replay_version(p->replay);
}

static void add_status(void *self, double now, JoxText *out) {
    JoxReplayPage *p = self;
    const JoxLiveSession *session = &p->page.session;
    const double spent = now - p->page.last_status;
    /* where the last status is long past, as after a leap: what the pace will be */
    const double factor = spent < LEAP      ? (p->at - p->status_at) / spent
                          : session->paused ? 0.0
                                            : session->speed;
    p->status_at = p->at;
    jox_replay_status(p->replay, session, factor, out);
}

static void pack_frame(void *self, JoxLiveColour colour, JoxBytes *out) {
    JoxReplayPage *p = self;
    jox_replay_frame(p->replay, colour, out);
}

static bool pack_people(void *self, JoxBytes *out) {
    const JoxReplayPage *p = self;
    return jox_replay_people(p->replay, out);
}

static void pack_field(void *self, JoxLiveField field, JoxBytes *out) {
    JoxReplayPage *p = self;
    jox_replay_field(p->replay, field, out);
}

/* {"type": "time", ...}: where in the recording it is. */
static void publish_time(void *self) {
    JoxReplayPage *p = self;
    JoxText *text = &p->page.text;
    text->length = 0;
    JoxJson json = jox_json_begin(text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", "time");
    jox_json_number(&json, "from", p->from);
    jox_json_number(&json, "until", p->until);
    jox_json_number(&json, "at", p->at);
    jox_json_end(&json);
    jox_view_publish(p->page.server, JOX_LIVE_TIME_CHANNEL, text->data, text->length);
}

/* ---- what people do ---- */

static void do_pause(void *self, const JoxLiveRequest *request) {
    JoxReplayPage *p = self;
    const bool on = jox_command_bool(request->command, "on", true);
    if (!on && p->at >= p->until)
        seek(p, p->from); /* once more */
    pause(p, on);
}

static void do_step(void *self, const JoxLiveRequest *request) {
    JoxReplayPage *p = self;
    const double n = jox_command_number(request->command, "n", 1.0);
    const uint32_t last = jox_replay_frames(p->replay) - 1;
    if (!(fabs(n) >= 1.0 && fabs(n) <= MOST_STEPS)) {
        jox_live_refuse(request, "n is from 1 to 100,000 frames, or as many back");
        return;
    }
    const double frame = fmin(fmax(floor(p->frame + n), 0.0), last);
    p->at = jox_replay_time(p->replay, (uint32_t)frame);
    p->page.session.jumps += fabs(n) > 1.0;
    show_present(p);
    pause(p, true);
}

static void do_seek(void *self, const JoxLiveRequest *request) {
    const double time = jox_command_number(request->command, "time", NAN);
    if (isfinite(time))
        seek(self, time);
    else
        jox_live_refuse(request, "time is in seconds");
}

static void do_restart(void *self, const JoxLiveRequest *request) {
    JoxReplayPage *p = self;
    (void)request;
    seek(p, p->from);
}

const JoxLiveSource jox_replay_page_source = {
    .colour = first_colour,
    .field = first_field,
    .scene = describe,
    .version = version,
    .status = add_status,
    .pack_frame = pack_frame,
    .pack_people = pack_people,
    .pack_field = pack_field,
    .report = publish_time,
    .advance = advance,
    .verbs = {[JOX_LIVE_VERB_pause] = do_pause,
              [JOX_LIVE_VERB_step] = do_step,
              [JOX_LIVE_VERB_seek] = do_seek,
              [JOX_LIVE_VERB_restart] = do_restart},
};

/* ---- the whole ---- */

bool jox_replay_page_load(JoxReplayPage *p, JoError *error) {
    const JoViewRecordingDef *def = p->def;
    p->page.source = &jox_replay_page_source;
    p->page.self = p;
    p->frame = UINT32_MAX;
    JoxDiagnostics diagnostics = {0};
    const JoxReplayDef replay = {.recording = def->recording,
                                 .scene = def->scene,
                                 .options = {.fps = def->fps, .unit = def->unit}};
    p->replay = jox_replay_open(&replay, &diagnostics);
    jox_run_report(def->message, def->message_context, &diagnostics, error);
    if (!p->replay)
        return false;
    p->from = jox_replay_time(p->replay, 0);
    p->until = jox_replay_time(p->replay, jox_replay_frames(p->replay) - 1);
    return true;
}

void jox_replay_page_end(JoxReplayPage *p) {
    jox_replay_close(p->replay);
    p->replay = NULL;
}

static bool view_recording(const JoViewRecordingDef *def, JoError *error) {
    JoxReplayPage p = {.def = def};
    const bool good =
        jox_replay_page_load(&p, error) &&
        jox_live_page_open(&p.page, def->address, def->port, def->page, def->three, error);
    if (good && def->opened)
        jox_run_message(def->opened, def->opened_context, jox_view_address(p.page.server));
    if (good) {
        seek(&p, p.from);
        jox_live_page_begin(&p.page);
        jox_live_page_run(&p.page, def->stop);
    }
    jox_live_page_close(&p.page);
    jox_replay_page_end(&p);
    return good;
}

bool jo_view_recording(const JoViewRecordingDef *def, JoError *error) {
    JOX_REQUIRE(def && def->cookie == RECORDING_COOKIE && def->recording && def->fps >= 0.0 &&
                    def->unit >= 0.0,
                false);
    JOX_GUARD (NULL, error)
        return false;
    return view_recording(def, error);
}
