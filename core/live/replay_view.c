/* A recording on the live page: it is played, stopped and looked through at the pace people want.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "live/replay.h"
#include "live/view_parts.h"

enum { RECORDING_COOKIE = 0x4a4f5652, MOST_STEPS = 100000 };
enum { PEOPLE_CHANNEL = JOX_VIEW_FIRST_TEXT - 1, TIME_CHANNEL = JOX_VIEW_STATUS + 1 };
static const double FRAME = 1.0 / 65.0; /* s, least time between frames */
static const double SPEECH = 0.25;      /* s between figures */
static const double IDLE = 0.05;        /* s, after which it is seen that it is to end */
static const double SLOWEST = 0.01, FASTEST = 1000.0; /* of real time */

typedef struct Playing {
    const JoViewRecordingDef *def;
    JoxReplay *replay;
    JoxView *view;
    JoxLiveSession session;
    double at, from, until;     /* s of the recording: now, its first and last frame */
    double wall, showed, spoke; /* s: when `at` was so; of the last frame, of the last figures */
    double spoke_at;            /* `at` of the last figures */
    uint32_t frame;             /* that is shown; UINT32_MAX: none */
    bool damaged;               /* the frame could not be read */
    JoxWatcher watchers[JOX_VIEW_CLIENTS];
    uint64_t version;
    bool changed, people_known;
    JoxBytes bytes, people;
    JoxText text;
} Playing;

JoViewRecordingDef jo_default_view_recording_def(void) {
    return (JoViewRecordingDef){.cookie = RECORDING_COOKIE};
}

/* ---- what pages are shown ---- */

static void greet(Playing *p, uint32_t client) {
    p->text.length = 0;
    jox_replay_scene(p->replay, &p->text);
    jox_view_send(p->view, client, p->text.data);
    p->people_known = false;
    p->changed = true;
}

/* Whether anybody wants a colour, or a field. */
static bool wants(const Playing *p, int colour, int field) {
    for (uint32_t w = 0; w < JOX_VIEW_CLIENTS; w++)
        if (p->watchers[w].client &&
            ((int)p->watchers[w].colour == colour || (int)p->watchers[w].field == field))
            return true;
    return false;
}

static void show_figures(Playing *p, double now) {
    const double spent = now - p->spoke;
    /* where the last figures are long past, as after a leap: what it will be */
    const double factor = spent < 10.0 * SPEECH ? (p->at - p->spoke_at) / spent
                          : p->session.paused   ? 0.0
                                                : p->session.speed;
    if (jox_replay_people(p->replay, &p->people) || !p->people_known)
        jox_view_publish(p->view, PEOPLE_CHANNEL, p->people.data, p->people.length);
    p->people_known = true;
    p->session.dropped = jox_view_dropped(p->view);
    p->text.length = 0;
    jox_replay_status(p->replay, &p->session, factor, &p->text);
    jox_view_publish(p->view, JOX_VIEW_STATUS, p->text.data, p->text.length);
    p->text.length = 0;
    JoxJson json = jox_json_begin(&p->text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", "time");
    jox_json_number(&json, "from", p->from);
    jox_json_number(&json, "until", p->until);
    jox_json_number(&json, "at", p->at);
    jox_json_end(&json);
    jox_view_publish(p->view, TIME_CHANNEL, p->text.data, p->text.length);
    for (int f = 0; f < JOX_LIVE_FIELDS; f++)
        if (wants(p, -1, f)) {
            jox_replay_field(p->replay, (JoxLiveField)f, &p->bytes);
            jox_view_publish(p->view, (uint32_t)(JOX_VIEW_FIELDS + f), p->bytes.data,
                             p->bytes.length);
        }
    p->spoke = now;
    p->spoke_at = p->at;
}

static void show(Playing *p) {
    const double now = jox_clock_wall();
    if (!jox_view_clients(p->view))
        return;
    const bool figures = now - p->spoke >= SPEECH;
    if (figures && jox_replay_version(p->replay) != p->version) {
        p->version = jox_replay_version(p->replay);
        greet(p, JOX_VIEW_ALL);
    }
    if (p->changed && now - p->showed >= FRAME) {
        for (int c = 0; c < JOX_LIVE_COLOUR_COUNT; c++)
            if (wants(p, c, -1)) {
                jox_replay_frame(p->replay, (JoxLiveColour)c, &p->bytes);
                jox_view_publish(p->view, (uint32_t)(JOX_VIEW_FRAMES + c), p->bytes.data,
                                 p->bytes.length);
            }
        p->showed = now;
        p->changed = false;
    }
    if (figures)
        show_figures(p, now);
}

/* ---- time ---- */

static void pause(Playing *p, bool on) {
    p->session.paused = on;
    p->wall = jox_clock_wall();
    p->spoke = 0.0;
}

/* The frame of the present time. What cannot be read is said, and it waits there. */
static void turn_to(Playing *p) {
    const uint32_t frame = jox_replay_find(p->replay, p->at);
    JoxText why = {0};
    if (frame == p->frame)
        return;
    p->frame = frame;
    p->changed = true;
    p->damaged = !jox_replay_show(p->replay, frame, &why);
    if (p->damaged) {
        JoxText text = {0};
        p->session.jumps++;
        jox_text_printf(&text, "The recording is damaged at %.2f s: %s.", p->at, why.data);
        jox_view_say(p->view, JOX_VIEW_ALL, "error", text.data);
        jox_text_free(&text);
        pause(p, true);
    }
    jox_text_free(&why);
}

/* Goes to a time from wherever it was: nobody walks there. */
static void seek(Playing *p, double time) {
    p->at = fmin(fmax(time, p->from), p->until);
    p->frame = UINT32_MAX;
    p->session.jumps++;
    p->wall = jox_clock_wall();
    p->spoke = 0.0;
    jox_replay_forget(p->replay);
    turn_to(p);
}

static void advance(Playing *p) {
    const double now = jox_clock_wall();
    if (!jox_view_clients(p->view)) /* it waits for somebody to look */
        p->wall = now;
    if (!p->session.paused) {
        p->at = fmin(p->at + (now - p->wall) * p->session.speed, p->until);
        p->wall = now;
        turn_to(p);
        if (p->at >= p->until)
            pause(p, true);
    }
    show(p);
    double wait = p->changed ? FRAME : IDLE;
    if (!p->session.paused && p->frame + 1 < jox_replay_frames(p->replay)) {
        const double next = jox_replay_time(p->replay, p->frame + 1) - p->at;
        wait = fmin(wait, fmax(next / p->session.speed, FRAME));
    }
    jox_view_wait(p->view, wait);
}

/* ---- what people do ---- */

typedef struct Said {
    Playing *p;
    JoxWatcher *by;
    const JoxCommand *command;
} Said;

static void refuse(const Said *said, const char *text) {
    jox_view_refuse(said->p->view, said->by->client, said->command->verb, text);
}

static void do_play(const Said *said) {
    Playing *p = said->p;
    const bool pauses = strcmp(said->command->verb, "pause") == 0;
    const bool on = jox_command_bool(said->command, "on", true);
    if (pauses != on && p->at >= p->until)
        seek(p, p->from); /* once more */
    pause(p, pauses == on);
}

static void do_step(const Said *said) {
    Playing *p = said->p;
    const double n = jox_command_number(said->command, "n", 1.0);
    const uint32_t last = jox_replay_frames(p->replay) - 1;
    if (!(fabs(n) >= 1.0 && fabs(n) <= MOST_STEPS)) {
        refuse(said, "n is from 1 to 100,000 frames, or as many back");
        return;
    }
    const double frame = fmin(fmax(floor(p->frame + n), 0.0), last);
    p->at = jox_replay_time(p->replay, (uint32_t)frame);
    p->session.jumps += fabs(n) > 1.0;
    turn_to(p);
    pause(p, true);
}

static void do_speed(const Said *said) {
    const double factor = jox_command_number(said->command, "factor", NAN);
    if (factor >= SLOWEST && factor <= FASTEST)
        said->p->session.speed = factor;
    else
        refuse(said, "factor is from 0.01 to 1,000 recorded seconds in a second");
    said->p->spoke = 0.0;
}

static void do_seek(const Said *said) {
    const double time = jox_command_number(said->command, "time", NAN);
    if (isfinite(time))
        seek(said->p, time);
    else
        refuse(said, "time is in seconds");
}

static void do_restart(const Said *said) {
    seek(said->p, said->p->from);
}

static void do_colour(const Said *said) {
    const int colour = jox_live_colour(jox_command_text(said->command, "by", ""));
    if (colour < 0) {
        refuse(said, "by is state, speed, force, compression, density or group");
        return;
    }
    said->by->colour = (JoxLiveColour)colour;
    said->p->changed = true;
}

static void do_field(const Said *said) {
    const int field = jox_live_field_named(jox_command_text(said->command, "of", ""));
    if (field < 0) {
        refuse(said, "of is density, pressure or none");
        return;
    }
    said->by->field = (JoxLiveField)field;
    said->p->spoke = 0.0;
}

static uint32_t channels(const JoxWatcher *watcher) {
    return jox_viewing_channels(watcher) | 1u << TIME_CHANNEL;
}

static void do_command(Playing *p, JoxWatcher *by, const char *json) {
    static const struct {
        const char *verb;
        void (*deed)(const Said *said);
    } VERBS[] = {{"play", do_play},   {"pause", do_play},   {"step", do_step},
                 {"seek", do_seek},   {"speed", do_speed},  {"restart", do_restart},
                 {"field", do_field}, {"colour", do_colour}};
    JoxCommand command = {0};
    if (!jox_command_read(json, &command))
        return; /* the server has dropped those */
    Said said = {p, by, &command};
    for (size_t v = 0; v < sizeof VERBS / sizeof *VERBS; v++)
        if (!strcmp(VERBS[v].verb, command.verb)) {
            VERBS[v].deed(&said);
            jox_view_listen(p->view, by->client, channels(by));
            return;
        }
    refuse(&said, "what is recorded has happened: it can be played, paused and looked at");
}

static JoxWatcher *find(Playing *p, uint32_t client) {
    for (uint32_t w = 0; w < JOX_VIEW_CLIENTS; w++)
        if (p->watchers[w].client == client)
            return &p->watchers[w];
    return NULL;
}

static void take(Playing *p) {
    char text[JOX_VIEW_MOST_COMMAND + 1];
    uint32_t client;
    JoxViewTaken what;
    while ((what = jox_view_take(p->view, &client, text, sizeof text)) != JOX_VIEW_NOTHING) {
        JoxWatcher *by = find(p, what == JOX_VIEW_JOINED ? 0 : client);
        if (what == JOX_VIEW_JOINED && by) {
            *by = (JoxWatcher){.client = client,
                               .colour = jox_replay_colour(p->replay),
                               .field = jox_replay_first_field(p->replay)};
            greet(p, client);
            p->spoke = 0.0;
            jox_view_listen(p->view, client, channels(by));
        } else if (what == JOX_VIEW_LEFT && by) {
            *by = (JoxWatcher){0};
        } else if (what == JOX_VIEW_COMMAND && by) {
            do_command(p, by, text);
        }
    }
}

/* ---- the whole ---- */

static bool open_recording(Playing *p, JoError *error) {
    const JoViewRecordingDef *def = p->def;
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

static bool open_view(Playing *p, JoError *error) {
    const JoViewRecordingDef *def = p->def;
    const JoxViewOptions options = {.address = def->address,
                                    .port = def->port,
                                    .page = def->page ? def->page : JOX_PAGEDIR,
                                    .three = def->three ? def->three : JOX_THREEDIR};
    JoxText why = {0};
    p->view = jox_view_open(&options, &why);
    if (!p->view)
        jox_error(error, JO_FAILED, "%s", why.data);
    jox_text_free(&why);
    return p->view != NULL;
}

static bool view_recording(const JoViewRecordingDef *def, JoError *error) {
    Playing p = {.def = def, .frame = UINT32_MAX, .session = {.speed = 1.0}};
    const bool good = open_recording(&p, error) && open_view(&p, error);
    if (good && def->opened)
        def->opened(def->opened_context, jox_view_address(p.view));
    if (good)
        seek(&p, p.from);
    while (good && (!def->stop || !*def->stop)) {
        take(&p);
        advance(&p);
    }
    jox_view_close(p.view);
    jox_replay_close(p.replay);
    jox_bytes_free(&p.bytes);
    jox_bytes_free(&p.people);
    jox_text_free(&p.text);
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
