/* The live page of a running scene: steps it at the chosen pace. Implements the source of
   scene_page.h and jo_view. */
#include <math.h>
#include <stdio.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "live/live_parts.h"
#include "live/scene_page.h"
#include "run/messages.h"
#include "run/reload.h"
#include "run/results/result_structs.h"
#include "run/why/breakpoints.h"

enum { VIEW_COOKIE = 0x4a4f5644 };
static const double LATE = 0.1; /* s of delay that later steps make up for; more is dropped */

JoViewDef jo_default_view_def(void) {
    return (JoViewDef){.scene = jo_default_scene_def(), .watch = true, .cookie = VIEW_COOKIE};
}

/* ---- time ---- */

static void pause_page_scene(JoxScenePage *s) {
    s->page.session.paused = true;
    s->steps = 0;
    s->page.last_status = 0.0; /* a status is sent at once */
}

/* Pauses the run when its time is over, and when all agents have left for good. */
static void pause_at_end(JoxScenePage *s) {
    const char *way_out =
        s->embedded ? "Continue it, or load it anew in its program" : "Continue or restart it";
    const bool is_over =
        jo_world_time(s->scene->world) + 0.5 * s->scene->world->model.def.dt >= s->until;
    const bool have_left = jox_live_find_end(s->scene, &s->page.session) == JOX_LIVE_ALL_HAVE_LEFT;
    if (is_over) {
        jox_run_say(s->scene, "%g s are over: the scene is paused. %s\n", s->until, way_out);
        s->until = INFINITY;
        s->page.session.end = JOX_LIVE_TIME_IS_UP;
        pause_page_scene(s);
    } else if (have_left && !s->have_left) {
        jox_run_say(s->scene, "everybody has left: the scene is paused. %s\n", way_out);
        pause_page_scene(s);
    }
    s->have_left = have_left;
}

/* Pauses the run where a breakpoint was met, and shows all browsers the agent that met it. */
static void pause_at_breakpoint(JoxScenePage *s) {
    uint32_t agent;
    if (!jox_run_broke(s->scene, &agent))
        return;
    jox_run_say(s->scene, "%s", jo_scene_broke(s->scene));
    jox_scene_page_show_agent(s, JOX_VIEW_ALL, agent);
    s->page.session.broke = jo_scene_broke(s->scene);
    pause_page_scene(s);
}

/* Makes a step. If it fails, the run is paused for good and browsers are told. */
static void step_page_scene(JoxScenePage *s) {
    JoError error = {0};
    if (jo_scene_step(s->scene, &error)) {
        pause_at_breakpoint(s);
        jox_scene_page_judge(s);
        pause_at_end(s);
    } else {
        jox_scene_page_fail(s, &error);
        s->steps = 0;
        jox_run_say(s->scene, "%s\n", error.text);
        jox_live_say(&s->page, "error", error.text);
    }
    s->page.changed = true;
}

/* Returns how long the first step still waits for a browser, s: people see a run from its
   beginning. It waits at most `def->wait`, and not in a run that goes as fast as it can. */
static double wait_for_browser(JoxScenePage *s, double now) {
    if (s->opened == 0.0)
        s->opened = now;
    if (s->def->fast || jox_view_clients(s->page.server) > 0 || now - s->opened >= s->def->wait)
        s->has_started = true;
    return s->has_started ? 0.0 : s->def->wait - (now - s->opened);
}

static double step_when_due(void *self, double now) {
    JoxScenePage *s = self;
    const double waiting = wait_for_browser(s, now);
    if (waiting > 0.0)
        return waiting;
    const JoxLiveSession *session = &s->page.session;
    const double due = s->began + s->scene->world->model.def.dt / session->speed;
    if (session->paused && s->steps == 0) {
        jox_run_swap_reloaded(s->scene); /* saved files are loaded in a pause too */
        return INFINITY;
    }
    if (session->paused) {
        s->steps--;
    } else if (!s->def->fast && due > now) {
        return due - now;
    }
    JOX_ASSERT(!s->failed && s->scene->world->model.def.dt > 0.0);
    s->began = due > now - LATE && due <= now ? due : now;
    step_page_scene(s);
    return 0.0;
}

/* ---- the source ---- */

static JoxLiveColour choose_scene_colour(const void *self) {
    const JoxScenePage *s = self;
    return jox_live_first_colour(s->scene);
}

static JoxLiveField choose_scene_field(const void *self) {
    const JoxScenePage *s = self;
    return (JoxLiveField)s->scene->spec->view.field;
}

static void write_scene_message(void *self, JoxText *out) {
    JoxScenePage *s = self;
    jox_live_scene(s->scene, !s->embedded, out);
}

static uint64_t find_scene_version(const void *self) {
    const JoxScenePage *s = self;
    return jox_live_version(s->scene);
}

static void write_scene_status(void *self, double now, JoxText *out) {
    JoxScenePage *s = self;
    (void)now;
    jox_live_status(s->scene, &s->page.session, out);
}

static void pack_scene_frame(void *self, JoxLiveColour colour, JoxBytes *out) {
    JoxScenePage *s = self;
    jox_live_frame(s->scene, colour, &s->page.scales, out);
}

static bool pack_scene_people(void *self, JoxBytes *out) {
    JoxScenePage *s = self;
    return jox_live_people(s->scene, out);
}

static void pack_scene_field(void *self, JoxLiveField field, JoxBytes *out) {
    JoxScenePage *s = self;
    jox_live_field(s->scene, field, &s->page.scales, out);
}

/* Sends what reloads have changed, and the agents that browsers inspect. */
static void report_scene(void *self) {
    JoxScenePage *s = self;
    s->page.text.length = 0;
    if (jox_live_news(s->scene, &s->page.text))
        jox_view_send(s->page.server, JOX_VIEW_ALL, s->page.text.data);
    jox_scene_page_send_inspected(s);
}

/* Sends errors of files, and the agent at whose breakpoint the run is paused. */
static void greet_browser(void *self, uint32_t client) {
    JoxScenePage *s = self;
    uint32_t agent;
    jox_scene_page_send_errors(s, client);
    if (s->page.session.broke && jox_run_broke(s->scene, &agent))
        jox_scene_page_show_agent(s, client, agent);
}

const JoxLiveSource jox_scene_page_source = {
    .colour = choose_scene_colour,
    .field = choose_scene_field,
    .scene = write_scene_message,
    .version = find_scene_version,
    .status = write_scene_status,
    .pack_frame = pack_scene_frame,
    .pack_people = pack_scene_people,
    .pack_field = pack_scene_field,
    .greet = greet_browser,
    .report = report_scene,
    .left = jox_scene_page_end_inspection,
    .advance = step_when_due,
    .verbs = {[JOX_LIVE_VERB_pause] = jox_scene_page_pause,
              [JOX_LIVE_VERB_step] = jox_scene_page_step,
              [JOX_LIVE_VERB_restart] = jox_scene_page_restart,
              [JOX_LIVE_VERB_play] = jox_scene_page_play,
              [JOX_LIVE_VERB_input] = jox_scene_page_input,
              [JOX_LIVE_VERB_lua] = jox_scene_page_lua,
              [JOX_LIVE_VERB_inspect] = jox_scene_page_inspect},
};

/* ---- opening and running ---- */

static bool run_scene_page(JoxScenePage *s, JoError *error) {
    const JoViewDef *def = s->def;
    if (!jox_scene_page_load(s, error))
        return false;
    if (def->opened)
        jox_run_send_message(def->opened, def->opened_context, jox_view_address(s->page.server));
    jox_live_page_run(&s->page, def->stop);
    if (def->summary)
        *def->summary = jo_scene_summary(s->scene);
    char *troubles = jox_run_troubles(s->scene);
    if (s->failed)
        jox_error(error, JO_FAILED, "%s", s->failure);
    else if (troubles)
        jox_error(error, JO_FAILED, "%s", troubles);
    bool good = !s->failed && !troubles;
    jo_free(troubles);
    return good;
}

bool jox_scene_page_open(JoxScenePage *s, const JoViewDef *def, JoError *error) {
    const JoxViewOptions options = {.address = def->address, .port = def->port, .page = def->page};
    *s = (JoxScenePage){.def = def, .scene_def = def->scene};
    s->page.source = &jox_scene_page_source;
    s->page.self = s;
    return jox_live_page_open(&s->page, &options, error);
}

bool jox_scene_page_close(JoxScenePage *s, JoError *error) {
    const bool ended = jox_scene_page_end(s, error);
    jox_live_page_close(&s->page);
    jox_scene_page_forget_errors(s);
    jox_free(s->errors);
    jox_free(s->overrides);
    jox_free(s->level);
    return ended;
}

static bool view_scene(const JoViewDef *def, JoError *error) {
    JoxScenePage s;
    JoError ending = {0};
    if (!jox_scene_page_open(&s, def, error))
        return false;
    const bool good = run_scene_page(&s, error);
    return jox_scene_page_close(&s, good ? error : &ending) && good;
}

bool jo_view(const JoViewDef *def, JoError *error) {
    JOX_REQUIRE(def && def->cookie == VIEW_COOKIE && def->scene.path, false);
    JOX_GUARD (NULL, error)
        return false;
    return view_scene(def, error);
}
