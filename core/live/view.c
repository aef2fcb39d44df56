/* A scene on its live page: the loop that steps it at the pace people want. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "live/view_parts.h"

enum { VIEW_COOKIE = 0x4a4f5644 };
static const double IDLE = 0.05; /* s, after which it is seen that a run is to end */
static const double LATE = 0.1;  /* s that are caught up with */

JoViewDef jo_default_view_def(void) {
    return (JoViewDef){.scene = jo_default_scene_def(), .watch = true, .cookie = VIEW_COOKIE};
}

static void pause_at_end(JoxViewing *v) {
    if (jo_world_time(v->scene->world) + 0.5 * v->scene->world->model.def.dt < v->until)
        return;
    jox_run_say(v->scene, "%g s are over, and the scene waits; it can go on or be restarted\n",
                v->until);
    v->until = INFINITY;
    v->session.paused = true;
    v->steps = 0;
    v->spoke = 0.0;
}

static void step(JoxViewing *v) {
    JoError error = {0};
    if (jo_scene_step(v->scene, &error)) {
        pause_at_end(v);
    } else {
        v->failed = v->session.paused = true;
        snprintf(v->failure, sizeof v->failure, "%s", error.text);
        v->steps = 0;
        jox_run_say(v->scene, "%s\n", error.text);
        jox_view_say(v->view, JOX_VIEW_ALL, "error", error.text);
    }
    v->changed = true;
}

/* One round: a step if one is due, else a short wait. */
static void advance(JoxViewing *v) {
    double now = jox_clock_wall();
    bool single = v->session.paused && v->steps > 0;
    if (v->session.paused && !single) {
        jox_run_reload(v->scene); /* files are looked at all the same */
        jox_viewing_show(v, now);
        jox_view_wait(v->view, v->changed ? 0.005 : IDLE);
        return;
    }
    bool paced = !v->def->fast && !single;
    if (paced && v->due > now) {
        jox_view_wait(v->view, v->due - now < IDLE ? v->due - now : IDLE);
        return;
    }
    double earliest = now - LATE;
    v->due = (v->due > earliest ? v->due : now) + v->scene->world->model.def.dt / v->session.speed;
    v->steps -= single;
    step(v);
    jox_viewing_show(v, jox_clock_wall());
}

static bool run(JoxViewing *v, JoError *error) {
    const JoViewDef *def = v->def;
    if (!jox_viewing_load(v, error))
        return false;
    if (def->opened)
        def->opened(def->opened_context, jox_view_address(v->view));
    while (!def->stop || !__atomic_load_n(def->stop, __ATOMIC_RELAXED)) {
        jox_viewing_take(v);
        advance(v);
    }
    if (def->summary)
        *def->summary = jo_scene_summary(v->scene);
    char *suspended = jo_scene_suspended(v->scene);
    if (v->failed)
        jox_error(error, JO_FAILED, "%s", v->failure);
    else if (suspended)
        jox_error(error, JO_FAILED, "%s", suspended);
    bool good = !v->failed && !suspended;
    jo_free(suspended);
    return good;
}

static bool view(const JoViewDef *def, JoError *error) {
    JoxViewOptions options = {.address = def->address,
                              .port = def->port,
                              .page = def->page ? def->page : JOX_PAGEDIR,
                              .three = def->three ? def->three : JOX_THREEDIR};
    JoxText why = {0};
    JoxViewing v = {.def = def, .scene_def = def->scene, .session = {.speed = 1.0}};
    v.view = jox_view_open(&options, &why);
    if (!v.view) {
        jox_error(error, JO_FAILED, "%s", why.data);
        jox_text_free(&why);
        return false;
    }
    JoError ending = {0};
    bool good = run(&v, error), ended = jox_viewing_end(&v, good ? error : &ending);
    jox_view_close(v.view);
    jox_viewing_forget_mistakes(&v);
    jox_free(v.mistakes);
    jox_bytes_free(&v.frame);
    jox_bytes_free(&v.people);
    jox_bytes_free(&v.field);
    jox_text_free(&v.text);
    return good && ended;
}

bool jo_view(const JoViewDef *def, JoError *error) {
    JOX_REQUIRE(def && def->cookie == VIEW_COOKIE && def->scene.path, false);
    JOX_GUARD (NULL, error)
        return false;
    return view(def, error);
}
