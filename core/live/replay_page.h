/* A recording on its live page. */
#ifndef JOX_LIVE_REPLAY_PAGE_H
#define JOX_LIVE_REPLAY_PAGE_H

#include "live/page.h"
#include "live/replay.h"

typedef struct JoxReplayPage {
    JoxLivePage page;
    const JoViewRecordingDef *def;
    JoxReplay *replay;
    double at, from, until; /* s of the recording: now, its first and last frame */
    double wall;            /* s of wall time when `at` was so */
    double status_at;       /* `at` of the last status */
    uint32_t frame;         /* that is shown; UINT32_MAX: none */
} JoxReplayPage;

/* What the page asks of a recording; `self` is a JoxReplayPage. */
extern const JoxLiveSource jox_replay_page_source;
/* Opens the recording that `def` names, and makes it what the page shows. False with `error`. */
bool jox_replay_page_load(JoxReplayPage *page, JoError *error);
void jox_replay_page_end(JoxReplayPage *page);

#endif
