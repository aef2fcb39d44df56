/* The live page of a recording: plays it at the chosen pace, pauses and seeks. Implements the
   source of replay_page.h and jo_view_recording. */
#include <math.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/guard.h"
#include "live/replay_page.h"
#include "run/messages.h"

enum { RECORDING_COOKIE = 0x4a4f5652, MOST_STEPS = 100000 };
static const double LEAP = 2.5; /* s since the last status beyond which the pace is not measured */

JoViewRecordingDef jo_default_view_recording_def(void) {
    return (JoViewRecordingDef){.cookie = RECORDING_COOKIE};
}

/* ---- time ---- */

static void pause_recording(JoxReplayPage *p, bool on) {
    p->page.session.paused = on;
    p->wall = jox_clock_wall();
    p->page.last_status = 0.0;
}

/* Shows the frame of the present time. If it cannot be read, tells the browsers and pauses. */
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
        jox_live_say(&p->page, "error", text.data);
        jox_text_free(&text);
        pause_recording(p, true);
    }
    jox_text_free(&why);
}

/* Jumps to a time, s, kept within the recording. People get new slots, so that no movement is
   drawn. */
static void seek_time(JoxReplayPage *p, double time) {
    p->at = fmin(fmax(time, p->from), p->until);
    p->frame = UINT32_MAX;
    p->page.session.jumps++;
    p->wall = jox_clock_wall();
    p->page.last_status = 0.0;
    jox_replay_forget(p->replay);
    show_present(p);
}

static double play_recording(void *self, double now) {
    JoxReplayPage *p = self;
    const JoxLiveSession *session = &p->page.session;
    if (jox_view_clients(p->page.server) == 0) /* time stands still while no browser is connected */
        p->wall = now;
    if (session->paused)
        return INFINITY;
    p->at = fmin(p->at + (now - p->wall) * session->speed, p->until);
    p->wall = now;
    show_present(p);
    if (p->at >= p->until)
        pause_recording(p, true);
    if (p->frame + 1 >= jox_replay_frames(p->replay))
        return INFINITY;
    const double next = jox_replay_time(p->replay, p->frame + 1) - p->at;
    return fmax(next / session->speed, 0.01);
}

/* ---- messages ---- */

static JoxLiveColour choose_recording_colour(const void *self) {
    const JoxReplayPage *p = self;
    return jox_replay_colour(p->replay);
}

static JoxLiveField choose_recording_field(const void *self) {
    const JoxReplayPage *p = self;
    return jox_replay_first_field(p->replay);
}

static void write_recording_message(void *self, JoxText *out) {
    JoxReplayPage *p = self;
    jox_replay_scene(p->replay, out);
}

static uint64_t find_recording_version(const void *self) {
    const JoxReplayPage *p = self;
    return jox_replay_version(p->replay);
}

static void write_recording_status(void *self, double now, JoxText *out) {
    JoxReplayPage *p = self;
    const JoxLiveSession *session = &p->page.session;
    const double spent = now - p->page.last_status;
    /* long after the last status, as after a jump, the wanted pace stands for the measured one */
    const double factor = spent < LEAP      ? (p->at - p->status_at) / spent
                          : session->paused ? 0.0
                                            : session->speed;
    p->status_at = p->at;
    jox_replay_status(p->replay, session, factor, out);
}

static void pack_recorded_frame(void *self, JoxLiveColour colour, JoxBytes *out) {
    JoxReplayPage *p = self;
    jox_replay_frame(p->replay, colour, &p->page.scales, out);
}

static bool pack_recorded_people(void *self, JoxBytes *out) {
    const JoxReplayPage *p = self;
    return jox_replay_people(p->replay, out);
}

static void pack_recorded_field(void *self, JoxLiveField field, JoxBytes *out) {
    JoxReplayPage *p = self;
    jox_replay_field(p->replay, field, &p->page.scales, out);
}

/* Publishes {"type": "time", ...}: first, last and present time of the recording, s. */
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

/* ---- commands ---- */

static void handle_pause(void *self, const JoxLiveRequest *request) {
    JoxReplayPage *p = self;
    const bool on = jox_command_bool(request->command, "on", true);
    if (!on && p->at >= p->until)
        seek_time(p, p->from); /* continuing at the end plays again */
    pause_recording(p, on);
}

static void handle_step(void *self, const JoxLiveRequest *request) {
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
    pause_recording(p, true);
}

static void handle_seek(void *self, const JoxLiveRequest *request) {
    const double time = jox_command_number(request->command, "time", NAN);
    if (isfinite(time))
        seek_time(self, time);
    else
        jox_live_refuse(request, "time is in seconds");
}

static void handle_restart(void *self, const JoxLiveRequest *request) {
    JoxReplayPage *p = self;
    (void)request;
    seek_time(p, p->from);
}

/* Answers {"type": "who", ...}: the id of the person in a slot, by which `jostle why` explains in a
   new run of the scene what a recording does not hold. */
static void handle_inspect(void *self, const JoxLiveRequest *request) {
    JoxReplayPage *p = self;
    const double wanted = jox_command_number(request->command, "slot", -1.0);
    const uint32_t slot = wanted >= 0.0 && wanted < 4294967295.0 ? (uint32_t)wanted : UINT32_MAX;
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", "who");
    jox_json_whole(&json, "slot", slot);
    jox_json_integer(&json, "id", jox_replay_id(p->replay, slot));
    jox_json_string(&json, "scene", p->def->scene);
    jox_json_end(&json);
    jox_view_send(p->page.server, request->client, text.data);
    jox_text_free(&text);
}

const JoxLiveSource jox_replay_page_source = {
    .colour = choose_recording_colour,
    .field = choose_recording_field,
    .scene = write_recording_message,
    .version = find_recording_version,
    .status = write_recording_status,
    .pack_frame = pack_recorded_frame,
    .pack_people = pack_recorded_people,
    .pack_field = pack_recorded_field,
    .report = publish_time,
    .advance = play_recording,
    .verbs = {[JOX_LIVE_VERB_pause] = handle_pause,
              [JOX_LIVE_VERB_step] = handle_step,
              [JOX_LIVE_VERB_seek] = handle_seek,
              [JOX_LIVE_VERB_restart] = handle_restart,
              [JOX_LIVE_VERB_inspect] = handle_inspect},
};

/* ---- opening and running ---- */

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
    jox_run_report_diagnostics(def->message, def->message_context, &diagnostics, error);
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
    const JoxViewOptions options = {
        .address = def->address, .port = def->port, .page = def->page, .frame = def->frame};
    JoxReplayPage p = {.def = def};
    const bool good =
        jox_replay_page_load(&p, error) && jox_live_page_open(&p.page, &options, error);
    if (good && def->opened)
        jox_run_send_message(def->opened, def->opened_context, jox_view_address(p.page.server));
    if (good) {
        seek_time(&p, p.from);
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
