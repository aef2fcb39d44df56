#include "recording.h"

#include <math.h>

#include "base/mem.h"
#include "live/replay.h"
#include "record/trajectory_reader.h"
#include "scene/wall_files/wall_file.h"

enum { MOST_FRAMES = 50 };
static const JoxTrajectoryOptions OPTIONS = {.fps = 10, .unit = 1};

static void read_by_frames(const char *path) {
    JoxDiagnostics diagnostics = {0};
    JoxTrajectoryReader *reader = jox_trajectory_reader_open(path, &OPTIONS, &diagnostics);
    FUZZ_CHECK((reader != NULL) == (diagnostics.errors == 0));
    fuzz_end_diagnostics(&diagnostics);
    if (!reader)
        return;
    const JoxTrajectoryReaderInfo info = jox_trajectory_reader_info(reader);
    JoxText why = {0};
    JoxTrajectoryReaderFrame frame;
    for (uint32_t f = 0; f < info.frames && f < MOST_FRAMES; f++) {
        why.length = 0;
        if (!jox_trajectory_reader_read(reader, f, &frame, &why)) {
            FUZZ_CHECK(why.length > 0);
            break;
        }
        for (uint32_t i = 0; i < frame.count; i++) {
            FUZZ_CHECK(i == 0 || frame.id[i - 1] < frame.id[i]);
            FUZZ_CHECK(isfinite(frame.x[i]) && isfinite(frame.y[i]));
            FUZZ_CHECK(!frame.state || frame.state[i] == JOX_NO_RECORDED_STATE ||
                       frame.state[i] < info.state_count);
        }
        JoxBodyLook look;
        for (uint32_t b = 0; b < frame.body_count && b < 20; b++)
            for (uint32_t p = 0; jox_trajectory_reader_part(reader, f, b, p, &look) && p < 20;)
                p++;
    }
    jox_text_free(&why);
    jox_trajectory_reader_close(reader);
}

static void read_whole(const char *path) {
    JoxDiagnostics diagnostics = {0};
    JoxTrajectories *t = jox_trajectories_read(path, &OPTIONS, &diagnostics);
    FUZZ_CHECK((t != NULL) == (diagnostics.errors == 0));
    fuzz_end_diagnostics(&diagnostics);
    JoxFrame frame;
    for (uint32_t f = 0; t && f < MOST_FRAMES && jox_trajectories_frame(t, f, &frame); f++)
        for (uint32_t i = 0; i < frame.count; i++)
            FUZZ_CHECK(isfinite(frame.x[i]) && isfinite(frame.vx[i]) && frame.key[i] < frame.keys);
    jox_trajectories_free(t);
}

static void read_plan(const char *path) {
    JoxDiagnostics diagnostics = {0};
    char *text = jox_wall_file_read_recorded(path, &diagnostics);
    FUZZ_CHECK((text != NULL) == (diagnostics.errors == 0));
    jox_free(text);
    fuzz_end_diagnostics(&diagnostics);
}

/* Makes all that is sent of a frame to a live page. */
static void show_frame(JoxReplay *replay, uint32_t frame) {
    const JoxLiveSession session = {.speed = 1};
    JoxLiveScales scales = {0};
    JoxText text = {0};
    JoxBytes bytes = {0};
    FUZZ_CHECK(jox_replay_show(replay, frame, &text) || text.length > 0);
    jox_replay_scene(replay, &text);
    jox_replay_status(replay, &session, 1, &text);
    for (int c = 0; c < JOX_LIVE_COLOUR_COUNT; c++)
        jox_replay_frame(replay, (JoxLiveColour)c, &scales, &bytes);
    jox_replay_people(replay, &bytes);
    for (int f = 0; f < JOX_LIVE_FIELDS; f++)
        jox_replay_field(replay, (JoxLiveField)f, &scales, &bytes);
    jox_text_free(&text);
    jox_bytes_free(&bytes);
}

static void replay_on_page(const char *path) {
    JoxDiagnostics diagnostics = {0};
    const JoxReplayDef def = {.recording = path, .options = OPTIONS};
    JoxReplay *replay = jox_replay_open(&def, &diagnostics);
    FUZZ_CHECK((replay != NULL) == (diagnostics.errors == 0));
    fuzz_end_diagnostics(&diagnostics);
    if (!replay)
        return;
    const uint32_t frames = jox_replay_frames(replay);
    const uint32_t from = jox_replay_find(replay, jox_replay_time(replay, frames / 2));
    FUZZ_CHECK(from < frames);
    for (uint32_t f = from; f < frames && f < from + 3; f++)
        show_frame(replay, f);
    jox_replay_forget(replay);
    show_frame(replay, 0);
    jox_replay_close(replay);
}

void fuzz_recording(const char *path) {
    read_by_frames(path);
    replay_on_page(path);
    read_whole(path);
    read_plan(path);
}
