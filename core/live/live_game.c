/* The members "game" of the scene message and of a status: the rules of the scene's game, and how
   round and match stand. */
#include <math.h>
#include <string.h>

#include "live/live_parts.h"
#include "run/game_round.h"

/* Adds the names of the bodies that the page marks. */
static void add_balls(const JoxSceneSpec *spec, JoxJson *json) {
    jox_json_array(json, "balls");
    for (uint32_t b = 0; spec->game.ball && b < spec->body_count; b++)
        for (uint32_t t = 0; t < spec->bodies[b].tag_count; t++)
            if (strcmp(spec->bodies[b].tags[t], spec->game.ball) == 0)
                jox_json_string(json, NULL, spec->bodies[b].def.name);
    jox_json_end(json);
}

void jox_live_add_rules(const JoScene *scene, JoxJson *json) {
    const JoxSceneSpec *spec = scene->spec;
    const JoxGame *game = &spec->game;
    if (!game->given) {
        jox_json_null(json, "game");
        return;
    }
    jox_json_object(json, "game");
    jox_json_string(json, "ours", jox_run_side(scene, JOX_WINNER_OURS));
    jox_json_string(json, "theirs", jox_run_side(scene, JOX_WINNER_THEIRS));
    jox_json_number(json, "points", game->points);
    jox_json_number(json, "time", game->time);
    jox_json_number(json, "rounds", game->rounds);
    jox_json_number(json, "speed", game->speed);
    jox_json_string(json, "how", game->how);
    jox_json_string(json, "button", game->button);
    jox_json_string(json, "level", game->level);
    jox_json_array(json, "levels");
    for (uint32_t l = 0; l < game->level_count; l++)
        jox_json_string(json, NULL, game->levels[l].name);
    jox_json_end(json);
    add_balls(spec, json);
    jox_json_end(json);
}

bool jox_live_is_match_over(const JoxGame *game, const JoxLiveMatch *match) {
    const double left = game->rounds - (match->ours + match->theirs + match->drawn);
    return match->judged &&
           fabs((double)match->ours - (double)match->theirs) > left - (left <= 0.0);
}

void jox_live_add_match(const JoScene *scene, const JoxLiveMatch *match, JoxJson *json) {
    static const char *const WINNERS[] = {
        [JOX_WINNER_NOBODY] = "draw", [JOX_WINNER_OURS] = "ours", [JOX_WINNER_THEIRS] = "theirs"};
    const JoxGameRound *round = jox_run_game_round(scene);
    if (!round) {
        jox_json_null(json, "game");
        return;
    }
    jox_json_object(json, "game");
    jox_json_bool(json, "on", match->on);
    jox_json_number(json, "ours", round->ours);
    jox_json_number(json, "theirs", round->theirs);
    jox_json_string(json, "winner", round->over ? WINNERS[round->winner] : NULL);
    jox_json_number(json, "ended", round->over ? round->seconds : NAN);
    jox_json_whole(json, "round", match->round);
    jox_json_numbers_of(json, "won", (double[]){match->ours, match->theirs, match->drawn}, 3, 6);
    jox_json_bool(json, "match_over", jox_live_is_match_over(&scene->spec->game, match));
    jox_json_end(json);
}
