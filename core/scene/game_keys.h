/* Rows of key_table.c for tallies, which count agents for scores, and for the game that they
   decide. Uses the macros of that file. */
#ifndef JOX_SCENE_GAME_KEYS_H
#define JOX_SCENE_GAME_KEYS_H

/* clang-format off */
#define JOX_TALLY_KEYS \
    {"tally", "memory", TEXT, "", 0, 0, "", READ_TO(jox_key_read_name, JoxTally, memory, memory), .meaning = "name of a memory of behaviours whose values are evaluated"}, \
    {"tally", "state", TEXT, "", 0, 0, "", READ_TO(jox_key_read_name, JoxTally, state, state), .meaning = "only agents in the state of this name"}, \
    {"tally", "group", TEXT, "", 0, 0, "", READ_TO(jox_key_read_group, JoxTally, group, group), .meaning = "only agents of this group"}, \
    {"tally", "take", TEXT, "", 0, 0, "sum", TO(JoxTally, statistic), .choices = "sum|mean|least|greatest", .meaning = "statistic of the values of `memory`"}, \
    {"tally", "unit", TEXT, "", 0, 0, "", READ_TO(jox_key_read_name, JoxTally, unit, unit), .meaning = "unit printed after the number: s, points"},

#define JOX_TALLY_OWNERS \
    {"tally", "Tallies", "`tally` maps names to numbers computed from the agents that are there: their count, or a statistic of a memory. " \
     "It stands in the summary under `tally`, and in a sweep and a comparison as a figure. The last lines of a run print it; of several with " \
     "the same `take` and unit, the greatest is ahead.", \
     .struct_size = sizeof(JoxTally), .name_offset = AT(JoxTally, name), .position_offset = AT(JoxTally, position), .finish = jox_finish_tally},

#define JOX_GAME_KEYS \
    {"game", "ours", TEXT, "", 0, 0, "!", READ_TO(jox_key_read_tally, JoxGame, ours, ours), .meaning = "tally that is the score of the player's side"}, \
    {"game", "theirs", TEXT, "", 0, 0, "!", READ_TO(jox_key_read_tally, JoxGame, theirs, theirs), .meaning = "tally that is the score of the other side"}, \
    {"game", "points", NUMBER, "", 1e-3, 1e6, "", TO(JoxGame, points), .meaning = "a round is won by the first whose score reaches this"}, \
    {"game", "time", NUMBER, "s", 1, 1e5, "", TO(JoxGame, time), .meaning = "a round ends at this time: the greater score wins"}, \
    {"game", "all", TEXT, "", 0, 0, "", READ_TO(jox_key_read_group, JoxGame, all, all), .meaning = "a round ends when the two scores together are the number of agents of this group: the greater score wins"}, \
    {"game", "tie", TEXT, "", 0, 0, "draw", TO(JoxGame, tie), .choices = "draw|ours|theirs", .meaning = "who wins a round that ends with equal scores"}, \
    {"game", "rounds", WHOLE, "", 1, 99, "1", TO(JoxGame, rounds), .meaning = "most rounds of a match; a side that the other can no longer reach has won it"}, \
    {"game", "speed", NUMBER, "m/s", 0.1, 20, "4", TO(JoxGame, speed), .meaning = "speed that the live page asks of the player's agent; its state may allow less (`max_speed`)"}, \
    {"game", "how", TEXT, "", 0, 0, "", TO(JoxGame, how), .meaning = "how to play, in a sentence or two, for the start card of the live page"}, \
    {"game", "button", TEXT, "", 0, 0, "", TO(JoxGame, button), .meaning = "what the player's button does, in a word: the behaviour asks for it by `now.button`"}, \
    {"game", "ball", TEXT, "", 0, 0, "", READ_TO(jox_key_read_name, JoxGame, ball, ball), .meaning = "tag of bodies that the live page marks, so that they are found"}, \
    {"game", "level", TEXT, "", 0, 0, "", TO(JoxGame, level), .meaning = "level that is played, by name; the first without it"}, \
    {"game", "levels", TABLE, "", 0, 0, "", ITEMS(JoxGame, levels, level_count), .example = "levels: {easy: {group: blue, set: {reaction: 0.6}}, normal: {}}", .content = "level*", .meaning = "levels to choose from, in this order"}, \
    {"level", "group", TEXT, "", 0, 0, "", READ_TO(jox_key_read_group, JoxGameLevel, group, group), .meaning = "group for whose agents the level sets values: the other side"}, \
    {"level", "set", VALUES, "", 0, 0, "", READ_TO(jox_key_read_values, JoxGameLevel, set, set_count), .content = "value*", .meaning = "parameters and own values, in place of those that the group sets"},

#define JOX_GAME_OWNERS \
    {"game", "game", "A game of the `player` against the machine, in rounds. The engine decides when a round is over and who won it: " \
     "`jostle run` ends then, its last lines and `game` of its summary tell the winner, and `game.won` is a figure of a sweep. The live page shows " \
     "a start card, score and clock, and plays the rounds of a match: each has the next seed, and writes files of its own if a recording or an input log is written.", \
     .struct_size = sizeof(JoxGame), .position_offset = AT(JoxGame, position), .finish = jox_finish_game}, \
    {"level", "Levels", "`levels` of a game maps names to levels. `--set game.level=hard` chooses one.", \
     .struct_size = sizeof(JoxGameLevel), .name_offset = AT(JoxGameLevel, name), .position_offset = AT(JoxGameLevel, position), .finish = jox_finish_level},
/* clang-format on */

#endif
