/* A recording as a live page is shown it: the messages of live.h from the frames of a reader. */
#ifndef JOX_LIVE_REPLAY_H
#define JOX_LIVE_REPLAY_H

#include "base/format/diag.h"
#include "live/live.h"
#include "record/trajectories.h"

typedef struct JoxReplayDef {
    const char *recording;
    const char *scene; /* whose walls, places and bodies are drawn; or NULL */
    JoxTrajectoryOptions options;
} JoxReplayDef;
typedef struct JoxReplay JoxReplay;

/* NULL with errors. */
JoxReplay *jox_replay_open(const JoxReplayDef *def, JoxDiagnostics *diagnostics);
uint32_t jox_replay_frames(const JoxReplay *replay);
/* s; of a frame. */
double jox_replay_time(const JoxReplay *replay, uint32_t frame);
/* The last frame at or before a time. */
uint32_t jox_replay_find(const JoxReplay *replay, double time);
/* Reads a frame; the messages below are of the one that was read last. People who were in the frame
   before it keep their slots. False with a sentence in `why` where the file is damaged. */
bool jox_replay_show(JoxReplay *replay, uint32_t frame, JoxText *why);
/* Nobody is shown: whoever comes next has a slot of its own. */
void jox_replay_forget(JoxReplay *replay);
void jox_replay_scene(const JoxReplay *replay, JoxText *out);
/* Another number whenever the scene message is due again: other bodies came. */
uint64_t jox_replay_version(const JoxReplay *replay);
/* `factor`: simulated seconds in a second, as measured. */
void jox_replay_status(JoxReplay *replay, const JoxLiveSession *session, double factor,
                       JoxText *out);
void jox_replay_frame(JoxReplay *replay, JoxLiveColour colour, JoxBytes *out);
bool jox_replay_people(const JoxReplay *replay, JoxBytes *out);
void jox_replay_field(JoxReplay *replay, JoxLiveField field, JoxBytes *out);
/* What the scene wants to be shown first. */
JoxLiveColour jox_replay_colour(const JoxReplay *replay);
JoxLiveField jox_replay_first_field(const JoxReplay *replay);
void jox_replay_close(JoxReplay *replay);

#endif
