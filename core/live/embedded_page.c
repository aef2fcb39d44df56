/* The live page of a scene that a program steps (jo_live_open, jo_live_serve): the source and the
   commands of scene_page.h, without its loop, loading and freeing of scenes. Programs call it. */
#include <math.h>
#include <stdio.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/guard.h"
#include "base/mem.h"
#include "live/scene_page.h"
#include "world/world.h"

enum { LIVE_COOKIE = 0x4a4f4c56 };
static const double FAILED_WAIT = 0.05; /* s between turns once memory is out */

struct JoLive {
    JoxScenePage page;     /* the first member: `self` of the source is also the JoLive */
    JoxLiveSource source;  /* that of scene_page.h, but for `advance` */
    bool only_shows;       /* no steps are made in this turn */
    JoViewDef def;         /* what the files of jo_view read; its message is the scene's own */
    uint64_t shown_tick;   /* tick of the scene at the end of the last turn */
    bool has_shown_finish; /* people were told that the scene is finished */
};

JoLiveDef jo_default_live_def(void) {
    return (JoLiveDef){.watch = true, .cookie = LIVE_COOKIE};
}

/* Makes the steps that are due, unless the program makes them. */
static double advance_live(void *self, double now) {
    const JoLive *live = self;
    return live->only_shows ? INFINITY : jox_scene_page_source.advance(self, now);
}

static JoLive *open_live(JoScene *scene, const JoLiveDef *def, JoError *error) {
    const JoxViewOptions options = {
        .address = def->address, .port = def->port, .page = def->page, .frame = def->frame};
    JoLive *live = jox_alloc(1, sizeof *live);
    JoxScenePage *s = &live->page;
    live->source = jox_scene_page_source;
    live->source.advance = advance_live;
    s->page.source = &live->source;
    s->page.self = s;
    if ((def->watch && !scene->reload && !jo_scene_watch(scene, error)) ||
        !jox_live_page_open(&s->page, &options, error)) {
        jox_free(live);
        return NULL;
    }
    live->def = jo_default_view_def();
    live->def.scene.message = scene->message;
    live->def.scene.message_context = scene->message_context;
    s->def = &live->def;
    s->embedded = s->has_started = true;
    s->scene = scene;
    s->until = jo_scene_duration(scene);
    s->page.session.paused = !def->running;
    scene->diagnosed = jox_scene_page_diagnosed;
    scene->message = jox_scene_page_forward;
    scene->message_context = scene->diagnosed_context = s;
    jox_live_page_begin(&s->page);
    return live;
}

JoLive *jo_live_open(JoScene *scene, const JoLiveDef *def, JoError *error) {
    JOX_REQUIRE(scene && scene->world && !scene->world->busy && def && def->cookie == LIVE_COOKIE,
                NULL);
    JOX_GUARD (scene->heap, error)
        return NULL;
    return open_live(scene, def, error);
}

const char *jo_live_address(const JoLive *live) {
    JOX_REQUIRE(live, "");
    return jox_view_address(live->page.page.server);
}

uint32_t jo_live_watchers(const JoLive *live) {
    JOX_REQUIRE(live, 0);
    return jox_view_clients(live->page.page.server);
}

/* Notes what the program did since the last turn: steps, another state, the end. */
static void note_program(JoLive *live) {
    JoxScenePage *s = &live->page;
    if (s->scene->world->state.tick != live->shown_tick)
        s->page.changed = true;
    if (!s->scene->finished || live->has_shown_finish)
        return;
    live->has_shown_finish = s->failed = s->page.session.paused = true;
    s->steps = 0;
    snprintf(s->failure, sizeof s->failure, "the program has finished the scene");
    jox_live_say(&s->page, "info", s->failure);
}

static double serve_live(JoLive *live, double seconds) {
    const double until = jox_clock_wall() + seconds;
    for (;;) {
        note_program(live);
        const double wait = jox_live_page_turn(&live->page.page);
        live->shown_tick = live->page.scene->world->state.tick;
        const double left = until - jox_clock_wall();
        if (left <= 0.0)
            return wait;
        jox_view_wait(live->page.page.server, fmin(wait, left));
    }
}

double jo_live_serve(JoLive *live, double seconds) {
    JOX_REQUIRE(live && seconds >= 0.0 && !live->page.scene->world->busy, FAILED_WAIT);
    JOX_GUARD (live->page.scene->heap, NULL)
        return FAILED_WAIT;
    return serve_live(live, seconds);
}

void jo_live_show(JoLive *live) {
    JOX_REQUIRE(live && !live->page.scene->world->busy, );
    JOX_GUARD (live->page.scene->heap, NULL)
        return;
    live->only_shows = true;
    serve_live(live, 0.0);
    live->only_shows = false;
}

static void close_live(JoLive *live) {
    JoxScenePage *s = &live->page;
    s->scene->diagnosed = NULL;
    s->scene->message = live->def.scene.message;
    s->scene->message_context = live->def.scene.message_context;
    jox_live_page_close(&s->page);
    jox_scene_page_forget_errors(s);
    jox_free(s->errors);
    jox_free(live);
}

void jo_live_close(JoLive *live) {
    if (!live)
        return;
    JOX_REQUIRE(!live->page.scene->world->busy, );
    JOX_GUARD (live->page.scene->heap, NULL)
        return;
    close_live(live);
}

char *jo_scene_plan(JoScene *scene) {
    JOX_REQUIRE(scene && scene->world && !scene->world->busy, NULL);
    JOX_GUARD (scene->heap, NULL)
        return NULL;
    JoxText text = {0};
    jox_live_scene(scene, false, &text);
    return jox_disown(text.data);
}
