/* Videos: frames go through a pipe to ffmpeg, which need not be there. */
#ifndef JOX_PICTURE_VIDEO_H
#define JOX_PICTURE_VIDEO_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

typedef struct JoxVideo JoxVideo;

/* Whether a program ffmpeg is in a folder of PATH. */
bool jox_video_available(void);
/* Starts ffmpeg, which replaces the file; what it makes follows from the file's ending. Width and
   height are even. NULL with a sentence in `error`. */
JoxVideo *jox_video_open(const char *path, uint32_t width, uint32_t height, double fps,
                         JoxText *error);
/* One frame, as jox_canvas_pixels gives it. False with a sentence once ffmpeg has gone. */
bool jox_video_frame(JoxVideo *video, const uint8_t *pixels, JoxText *error);
/* Waits for ffmpeg to end. False with a sentence if it failed. */
bool jox_video_close(JoxVideo *video, JoxText *error);

#endif
