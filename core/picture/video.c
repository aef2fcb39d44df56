#include "picture/video.h"

#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/mem.h"

extern char **environ;

struct JoxVideo {
    pid_t child;
    int pipe;
    size_t size; /* bytes of a frame */
    char *path;
};

bool jox_video_available(void) {
    const char *folders = getenv("PATH");
    while (folders && *folders) {
        char path[1100];
        size_t length = strcspn(folders, ":");
        snprintf(path, sizeof path, "%.*s/ffmpeg", (int)length, folders);
        if (length > 0 && length < 1024 && access(path, X_OK) == 0)
            return true;
        folders += length + (folders[length] == ':');
    }
    return false;
}

/* Starts ffmpeg with `input` as its standard input. Returns 0 or an errno value. */
static int start_ffmpeg(JoxVideo *video, int input, uint32_t width, uint32_t height, double fps) {
    char size[32], rate[32];
    JoxText file = {0};
    posix_spawn_file_actions_t actions;
    snprintf(size, sizeof size, "%ux%u", width, height);
    snprintf(rate, sizeof rate, "%.9g", fps);
    /* "file:" keeps a name from being read as a URL or an option */
    jox_text_printf(&file, "file:%s", video->path);
    const char *arguments[] = {"ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-f",
                               "rawvideo", "-pixel_format", "bgr0", "-video_size", size,
                               "-framerate", rate, "-i", "pipe:0", "-an",
                               /* the pixel format that all players show */
                               "-pix_fmt", "yuv420p", file.data, NULL};
    int failure = posix_spawn_file_actions_init(&actions);
    if (failure)
        return failure;
    failure = posix_spawn_file_actions_adddup2(&actions, input, 0);
    if (!failure)
        failure = posix_spawnp(&video->child, "ffmpeg", &actions, NULL,
                               (char *const *)(void *)arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    jox_text_free(&file);
    return failure;
}

/* Ends ffmpeg when a call is aborted (base/mem.h); the video ends with the frames sent so far. */
static void stop_ffmpeg(void *opened) {
    JoxVideo *video = opened;
    close(video->pipe);
    while (waitpid(video->child, NULL, 0) < 0 && errno == EINTR)
        continue;
}

JoxVideo *jox_video_open(const char *path, uint32_t width, uint32_t height, double fps,
                         JoxText *error) {
    int ends[2];
    JoxVideo *video = jox_alloc(1, sizeof *video);
    video->path = jox_strdup(path);
    video->size = (size_t)width * height * 4;
    /* A socket, not a pipe: with MSG_NOSIGNAL, writing after the reader has ended gives an error
       and no SIGPIPE. */
    int failure = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0 ? 0 : errno;
    if (!failure) {
        failure = start_ffmpeg(video, ends[1], width, height, fps);
        close(ends[1]);
        video->pipe = ends[0];
        if (failure)
            close(ends[0]);
    }
    if (!failure)
        return jox_heap_register(video, stop_ffmpeg);
    jox_text_printf(error, "cannot run ffmpeg: %s", strerror(failure));
    jox_free(video->path);
    jox_free(video);
    return NULL;
}

bool jox_video_frame(JoxVideo *video, const uint8_t *pixels, JoxText *error) {
    size_t done = 0;
    while (done < video->size) {
        ssize_t sent = send(video->pipe, pixels + done, video->size - done, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent < 0) {
            jox_text_printf(error, "ffmpeg stopped before the end of '%s'", video->path);
            return false;
        }
        done += (size_t)sent;
    }
    return true;
}

bool jox_video_close(JoxVideo *video, JoxText *error) {
    int status = 0;
    pid_t ended;
    jox_heap_unregister(video);
    close(video->pipe);
    do
        ended = waitpid(video->child, &status, 0);
    while (ended < 0 && errno == EINTR);
    bool good = ended == video->child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (!good && error->length == 0)
        jox_text_printf(error, "ffmpeg could not make '%s' (status %d)", video->path,
                        WIFEXITED(status) ? WEXITSTATUS(status) : -1);
    jox_free(video->path);
    jox_free(video);
    return good;
}
