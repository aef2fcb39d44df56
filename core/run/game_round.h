/* The round of a scene's game: when it is over, and who won it. */
#ifndef JOX_RUN_GAME_ROUND_H
#define JOX_RUN_GAME_ROUND_H

#include "base/format/json_writer.h"
#include "base/text.h"
#include "jostle.h"

typedef enum JoxWinner { JOX_WINNER_NOBODY, JOX_WINNER_OURS, JOX_WINNER_THEIRS } JoxWinner;

/* A round, as it stands or as it ended. */
typedef struct JoxGameRound {
    double ours, theirs; /* scores */
    double seconds;      /* s: when it ended */
    uint32_t winner;     /* JoxWinner; NOBODY: a draw, if it is over */
    uint32_t over;       /* 1: it is */
} JoxGameRound;

/* Attaches the listener that decides the round, if the scene has a game. */
void jox_run_watch_game(JoScene *scene);
/* The round of a scene; NULL if it has no game. */
const JoxGameRound *jox_run_game_round(const JoScene *scene);
/* Returns the name of a side: that of its tally. */
const char *jox_run_side(const JoScene *scene, JoxWinner side);
/* Appends who won: "won by red, 5 to 3", "a draw, 2 to 2". */
void jox_run_say_round(const JoScene *scene, const JoxGameRound *round, JoxText *out);
/* Adds ,"game": {...} to a summary; the sentence of a run's last lines. */
void jox_run_add_game(const JoScene *scene, JoxJson *json);
void jox_run_say_game(const JoScene *scene, JoxText *out);

#endif
