/* The listener that decides the round of a scene's game, from the scores after each step. The
   command `run` ends a round that is over, the live page shows it; results/ tells the winner. */
#include "run/game_round.h"

#include <math.h>

#include "base/assert.h"
#include "jostle_tools.h"
#include "run/listener.h"
#include "run/run.h"
#include "run/tally_scores.h"

static double count_score(const JoScene *scene, int32_t tally) {
    const double score = jox_run_count_tally(scene, &scene->spec->tallies[tally]);
    return isfinite(score) ? score : 0.0; /* a mean of nobody */
}

static uint32_t count_group(const JoScene *scene, int32_t group) {
    const JoxAgents *a = &scene->world->state.agents;
    uint32_t count = 0;
    for (uint32_t i = 0; i < a->count; i++)
        count += a->group[i] == group;
    return count;
}

/* Whether the rules of the game end a round with these scores now. */
static bool ends_round(const JoScene *scene, const JoxGameRound *round) {
    const JoxGame *game = &scene->spec->game;
    const double half = 0.5 * scene->world->model.def.dt;
    return fmax(round->ours, round->theirs) >= game->points ||
           jo_world_time(scene->world) + half >= game->time ||
           (game->all >= 0 && round->ours + round->theirs >= count_group(scene, game->all));
}

static JoxWinner find_winner(const JoxGame *game, const JoxGameRound *round) {
    static const JoxWinner TIES[] = {[JOX_GAME_TIE_DRAW] = JOX_WINNER_NOBODY,
                                     [JOX_GAME_TIE_OURS] = JOX_WINNER_OURS,
                                     [JOX_GAME_TIE_THEIRS] = JOX_WINNER_THEIRS};
    JOX_ASSERT(game->tie < sizeof TIES / sizeof *TIES);
    return round->ours > round->theirs   ? JOX_WINNER_OURS
           : round->ours < round->theirs ? JOX_WINNER_THEIRS
                                         : TIES[game->tie];
}

static bool judge_round(void *self, JoScene *scene, JoError *error) {
    JoxGameRound *round = self;
    (void)error;
    if (round->over)
        return true;
    round->ours = count_score(scene, scene->spec->game.ours);
    round->theirs = count_score(scene, scene->spec->game.theirs);
    if (!ends_round(scene, round))
        return true;
    round->over = 1;
    round->seconds = jo_world_time(scene->world);
    round->winner = find_winner(&scene->spec->game, round);
    return true;
}

static void list_round_sections(void *self, JoxSections *s) {
    JoxGameRound *round = self;
    JOX_SECTION(s, "round", *round);
}

static const JoxListenerKind GAME = {.name = "game",
                                     .size = sizeof(JoxGameRound),
                                     .frame = judge_round,
                                     .sections = list_round_sections,
                                     .goes_on = true};

void jox_run_watch_game(JoScene *scene) {
    if (scene->spec->game.given)
        jox_run_attach_listener(scene, &GAME, NULL, NULL);
}

const JoxGameRound *jox_run_game_round(const JoScene *scene) {
    return jox_run_find_listener(scene, &GAME);
}

bool jo_scene_over(const JoScene *scene) {
    JOX_REQUIRE(scene, false);
    const JoxGameRound *round = jox_run_game_round(scene);
    return round && round->over;
}

const char *jox_run_side(const JoScene *scene, JoxWinner side) {
    const JoxGame *game = &scene->spec->game;
    JOX_ASSERT(game->given && side != JOX_WINNER_NOBODY);
    return scene->spec->tallies[side == JOX_WINNER_OURS ? game->ours : game->theirs].name;
}

void jox_run_say_round(const JoScene *scene, const JoxGameRound *round, JoxText *out) {
    const bool ours = round->winner != JOX_WINNER_THEIRS;
    if (round->winner == JOX_WINNER_NOBODY)
        jox_text_add(out, "a draw");
    else
        jox_text_printf(out, "won by %.60s", jox_run_side(scene, (JoxWinner)round->winner));
    jox_text_printf(out, ", %.4g to %.4g", ours ? round->ours : round->theirs,
                    ours ? round->theirs : round->ours);
}

void jox_run_add_game(const JoScene *scene, JoxJson *json) {
    const JoxGameRound *round = jox_run_game_round(scene);
    const JoxGame *game = &scene->spec->game;
    if (!round)
        return;
    jox_json_object(json, "game");
    jox_json_string(json, "level", game->level);
    jox_json_bool(json, "over", round->over);
    jox_json_string(
        json, "winner",
        round->winner == JOX_WINNER_NOBODY ? NULL : jox_run_side(scene, (JoxWinner)round->winner));
    jox_json_number(json, "won", round->winner == JOX_WINNER_OURS);
    jox_json_number(json, "lost", round->winner == JOX_WINNER_THEIRS);
    jox_json_number(json, "drawn", round->over && round->winner == JOX_WINNER_NOBODY);
    jox_json_number(json, "ours", round->ours);
    jox_json_number(json, "theirs", round->theirs);
    jox_json_number(json, "seconds", round->over ? round->seconds : NAN);
    jox_json_end(json);
}

void jox_run_say_game(const JoScene *scene, JoxText *out) {
    const JoxGameRound *round = jox_run_game_round(scene);
    if (!round)
        return;
    if (!round->over) {
        jox_text_printf(out, " The round is not over: %.60s %.4g, %.60s %.4g.",
                        jox_run_side(scene, JOX_WINNER_OURS), round->ours,
                        jox_run_side(scene, JOX_WINNER_THEIRS), round->theirs);
        return;
    }
    jox_text_printf(out, " The round ended at %.1f s: ", round->seconds);
    jox_run_say_round(scene, round, out);
    if (scene->spec->game.level)
        jox_text_printf(out, ", level %.60s", scene->spec->game.level);
    jox_text_add(out, ".");
}
