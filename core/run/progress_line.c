/* Listeners that print while a run goes on: the line of progress on stderr, and the transitions
   of one agent. */
#include <stdio.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "run/run.h"

typedef struct Progress {
    double until;        /* s, simulated */
    double begun, shown; /* s, wall time */
    int tenth; /* tenth of the run shown last, if stderr is no terminal: each has a line */
} Progress;

static bool begin_progress(void *self, JoScene *scene, const void *until, JoError *error) {
    (void)scene, (void)error;
    *(Progress *)self = (Progress){.until = *(const double *)until, .begun = jox_clock_wall()};
    return true;
}

static bool show_progress(void *self, JoScene *scene, JoError *error) {
    Progress *p = self;
    double time = jo_world_time(scene->world), now = jox_clock_wall(), wall = now - p->begun;
    double share = time / p->until, left = wall / share - wall;
    bool terminal = isatty(STDERR_FILENO), last = share >= 1.0 - 1e-9;
    char agents[JOX_NOUN];
    int tenth = (int)(share * 10.0 + 1e-9);
    (void)error;
    if (terminal ? now - p->shown < 0.2 && !last : tenth == p->tenth)
        return true;
    p->shown = now;
    p->tenth = tenth;
    fprintf(stderr, "%s%6.1f of %.1f s simulated, %.2f x real time, %.0f s left, %s%s",
            terminal ? "\r" : "", time, p->until, time / wall, last ? 0.0 : left,
            jox_noun(agents, scene->world->state.agents.count, "agent"),
            !terminal || last ? "\n" : "   ");
    return true;
}

/* Reports at the end how many Lua functions were called and their share of the time, so that
   authors know without asking. */
static bool report_function_costs(void *self, JoScene *scene, JoError *error) {
    const JoxLuaTotal total = jox_lua_total(scene->lua, scene->world->state.statistics.wall_s);
    char told[JOX_NOUN];
    (void)self, (void)error;
    if (total.calls > 0)
        jox_run_say(scene, "plain Lua functions: %s, %.2f %% of the steps' time\n",
                    jox_noun(told, total.calls, "call"),
                    total.stepping > 0.0 ? 100.0 * total.seconds / total.stepping : 0.0);
    return true;
}

static const JoxListenerKind PROGRESS = {.name = "progress",
                                         .size = sizeof(Progress),
                                         .begin = begin_progress,
                                         .frame = show_progress,
                                         .end = report_function_costs};

void jo_scene_show_progress(JoScene *scene, double until) {
    JOX_REQUIRE(scene && !scene->world->busy, );
    if (until > 0.0 && !jox_run_find_listener(scene, &PROGRESS))
        jox_run_attach_listener(scene, &PROGRESS, &until, NULL);
}

/* ---- trace ---- */

static bool send_trace(void *self, JoScene *scene, JoError *error) {
    (void)self, (void)error;
    if (scene->world->machines.trace.length)
        jox_run_send_text(scene, scene->world->machines.trace.data);
    return true;
}

static const JoxListenerKind TRACE = {.name = "trace", .size = 1, .frame = send_trace};

void jo_scene_trace(JoScene *scene, uint32_t agent_id) {
    JOX_REQUIRE(scene && !scene->world->busy, );
    scene->world->machines.traces = true;
    scene->world->machines.trace_id = agent_id;
    if (!jox_run_find_listener(scene, &TRACE))
        jox_run_attach_listener(scene, &TRACE, NULL, NULL);
}
