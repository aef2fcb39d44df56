/* A recording on a live page: reads frames (record/trajectory_reader.h) and makes the messages of
   live.h of them. Called by replay_page.c: open, then show a frame, then ask for messages of it. */
#ifndef JOX_LIVE_REPLAY_H
#define JOX_LIVE_REPLAY_H

#include "base/format/diag.h"
#include "live/live.h"
#include "record/trajectories.h"

typedef struct JoxReplayDef {
    const char *recording;
    const char *scene; /* scene file for what the recording lacks, as places; or NULL */
    JoxTrajectoryOptions options;
} JoxReplayDef;
typedef struct JoxReplay JoxReplay;

/* Opens a recording; NULL with errors. The caller closes it. */
JoxReplay *jox_replay_open(const JoxReplayDef *def, JoxDiagnostics *diagnostics);
uint32_t jox_replay_frames(const JoxReplay *replay);
/* Time of a frame, s. */
double jox_replay_time(const JoxReplay *replay, uint32_t frame);
/* Returns the last frame at or before a time, s. */
uint32_t jox_replay_find(const JoxReplay *replay, double time);
/* Reads a frame; the messages below are of the frame that was read last. People who were in the
   frame shown before keep their slots. False with a sentence in `why` if the file is damaged. */
bool jox_replay_show(JoxReplay *replay, uint32_t frame, JoxText *why);
/* Empties the shown frame: people of the next one get new slots, so that the page does not draw
   their movement from where they were. */
void jox_replay_forget(JoxReplay *replay);
/* Returns the id of the person in a slot; -1: nobody is. */
int64_t jox_replay_id(const JoxReplay *replay, uint32_t slot);
void jox_replay_scene(const JoxReplay *replay, JoxText *out);
/* Returns a number that changes when the scene message must be sent again: bodies or walls have
   changed. */
uint64_t jox_replay_version(const JoxReplay *replay);
/* `factor`: the measured pace, simulated seconds per second. */
void jox_replay_status(JoxReplay *replay, const JoxLiveSession *session, double factor,
                       JoxText *out);
void jox_replay_frame(JoxReplay *replay, JoxLiveColour colour, JoxLiveScales *scales,
                      JoxBytes *out);
bool jox_replay_people(const JoxReplay *replay, JoxBytes *out);
void jox_replay_field(JoxReplay *replay, JoxLiveField field, JoxLiveScales *scales, JoxBytes *out);
/* The colour and field that a page begins with: the scene's `view`, else defaults. */
JoxLiveColour jox_replay_colour(const JoxReplay *replay);
JoxLiveField jox_replay_first_field(const JoxReplay *replay);
void jox_replay_close(JoxReplay *replay);

#endif
