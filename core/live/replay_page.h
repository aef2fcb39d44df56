/* The live page of a recording: the source (source.h) that page.c plays. */
#ifndef JOX_LIVE_REPLAY_PAGE_H
#define JOX_LIVE_REPLAY_PAGE_H

#include "live/page.h"
#include "live/replay.h"

typedef struct JoxReplayPage {
    JoxLivePage page;
    const JoViewRecordingDef *def;
    JoxReplay *replay;
    double at, from, until; /* s in the recording: present time, first and last frame */
    double wall;            /* wall time when `at` was set, s */
    double status_at;       /* `at` when the last status was sent, s */
    uint32_t frame;         /* the shown frame; UINT32_MAX: none */
} JoxReplayPage;

/* Functions of the source; `self` is a JoxReplayPage. */
extern const JoxLiveSource jox_replay_page_source;
/* Opens the recording that `def` names and makes it the page's source. False with `error`. */
bool jox_replay_page_load(JoxReplayPage *page, JoError *error);
void jox_replay_page_end(JoxReplayPage *page);

#endif
