/* The match that a person plays on the live page: rounds of the scene's game, each a start of the
   scene with the next seed. Until a match begins the machine plays, and no round counts. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "live/live_parts.h"
#include "live/scene_page.h"
#include "run/game_round.h"
#include "run/input_actions.h"
#include "run/messages.h"

/* Tells the terminal, and browsers unless they show it on a card. */
static void say_match(JoxScenePage *s, JoxText *text, bool has_card) {
    jox_text_add(text, "\n");
    s->reported = has_card;
    jox_run_say(s->scene, "%s", text->data);
    s->reported = false;
    jox_text_free(text);
}

void jox_scene_page_judge(JoxScenePage *s) {
    JoxLiveMatch *match = &s->page.session.match;
    const JoxGameRound *round = jox_run_game_round(s->scene);
    if (!match->on || match->judged || !round || !round->over)
        return;
    match->judged = true;
    match->ours += round->winner == JOX_WINNER_OURS;
    match->theirs += round->winner == JOX_WINNER_THEIRS;
    match->drawn += round->winner == JOX_WINNER_NOBODY;
    s->page.session.paused = true;
    s->steps = 0;
    s->page.last_status = 0.0; /* a status is sent at once */
    JoxText text = {0};
    jox_text_printf(&text, "Round %u, %.1f s: ", match->round, round->seconds);
    jox_run_say_round(s->scene, round, &text);
    if (s->scene->spec->game.rounds > 1)
        jox_text_printf(&text, "; rounds won: %.60s %u, %.60s %u",
                        jox_run_side(s->scene, JOX_WINNER_OURS), match->ours,
                        jox_run_side(s->scene, JOX_WINNER_THEIRS), match->theirs);
    say_match(s, &text, true);
}

/* Makes the scene load with a level; NULL: as it is. */
static void choose_level(JoxScenePage *s, const char *level) {
    const JoSceneDef *own = &s->def->scene;
    if (!level)
        return;
    JoxText setting = {0};
    const char **overrides = jox_alloc(own->override_count + 1, sizeof *overrides);
    jox_text_printf(&setting, "game.level=%s", level);
    for (size_t o = 0; o < own->override_count; o++)
        overrides[o] = own->overrides[o];
    overrides[own->override_count] = setting.data;
    s->scene_def.overrides = overrides;
    s->scene_def.override_count = own->override_count + 1;
    jox_free(s->overrides);
    jox_free(s->level);
    s->overrides = overrides;
    s->level = setting.data;
}

static bool has_level(const JoxGame *game, const char *name) {
    for (uint32_t l = 0; l < game->level_count; l++)
        if (strcmp(game->levels[l].name, name) == 0)
            return true;
    return false;
}

/* Gives the player's agent to the person from the first step on. */
static void begin_playing(JoxScenePage *s) {
    const uint32_t id = jox_live_player_id(s->scene);
    JoxInputEntry entry = {0};
    JoxText wrong = {0};
    JoError error = {0};
    char line[64];
    snprintf(line, sizeof line, "player %u 0 0", id);
    if (id != JOX_NO_INDEX && jox_input_read_line(line, &entry, &wrong) &&
        !jox_run_perform_input(s->scene, &entry, &error))
        jox_live_say(&s->page, "warning", error.text);
    jox_input_entry_free(&entry);
    jox_text_free(&wrong);
}

void jox_scene_page_play(void *self, const JoxLiveRequest *request) {
    JoxScenePage *s = self;
    JoxLiveMatch *match = &s->page.session.match;
    const JoxGame *game = &s->scene->spec->game;
    char level[JOX_VIEW_MOST_COMMAND + 1];
    snprintf(level, sizeof level, "%s", jox_command_text(request->command, "level", ""));
    if (!game->given || s->embedded) {
        jox_live_refuse(request, s->embedded ? "the program that shows this scene begins its rounds"
                                             : "the scene has no `game`");
        return;
    }
    if (*level && !has_level(game, level)) {
        jox_live_refuse(request, "the scene's game has no such level");
        return;
    }
    const JoxLiveMatch before = *match;
    const JoSceneDef def = s->scene_def;
    const bool goes_on =
        match->on && match->judged && !*level && !jox_live_is_match_over(game, match);
    const uint64_t seed = s->scene->world->model.def.seed;
    if (!goes_on)
        *match = (JoxLiveMatch){.on = true};
    match->round++;
    match->judged = false;
    s->scene_def.has_seed = true;
    s->scene_def.seed = before.on ? seed + 1 : seed; /* the first round is the one on show */
    choose_level(s, *level ? level : NULL);
    JoError error = {0};
    if (!jox_scene_page_load(s, &error)) {
        *match = before;
        s->scene_def.has_seed = def.has_seed;
        s->scene_def.seed = def.seed;
        jox_live_refuse(request, error.text);
        return;
    }
    begin_playing(s);
    JoxText text = {0};
    jox_text_printf(&text, "Round %u of %g, seed %llu", match->round, s->scene->spec->game.rounds,
                    (unsigned long long)s->scene_def.seed);
    if (s->scene->spec->game.level)
        jox_text_printf(&text, ", --set game.level=%.60s", s->scene->spec->game.level);
    const bool writes = jox_scene_page_add_files(s, &text);
    say_match(s, &text, !writes);
}

void jox_scene_page_replay_round(JoxScenePage *s) {
    JoxLiveMatch *match = &s->page.session.match;
    if (match->judged)
        *match = (JoxLiveMatch){0};
}
