/* Videos: frames are piped to ffmpeg, which may be missing. render.c is the caller. */
#ifndef JOX_PICTURE_VIDEO_H
#define JOX_PICTURE_VIDEO_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

typedef struct JoxVideo JoxVideo;

/* Returns whether ffmpeg is in a folder of PATH. */
bool jox_video_available(void);
/* Starts ffmpeg, which replaces the file and chooses the format by its ending. Width and height,
   px, must be even. Returns NULL with a sentence in `error`. */
JoxVideo *jox_video_open(const char *path, uint32_t width, uint32_t height, double fps,
                         JoxText *error);
/* Sends one frame in the layout of jox_canvas_pixels. Returns false with a sentence if ffmpeg
   has ended. */
bool jox_video_frame(JoxVideo *video, const uint8_t *pixels, JoxText *error);
/* Waits for ffmpeg to finish the file and frees the video. Returns false with a sentence if
   ffmpeg failed. */
bool jox_video_close(JoxVideo *video, JoxText *error);

#endif
