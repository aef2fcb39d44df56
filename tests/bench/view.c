/* What a page that looks on costs the run: CPU time of the stepping thread over the same steps of
   the Tawaf, with a client that reads all and discards it, and with none, in turns. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "jostle_tools.h"
#include "unit/view_client.h"

enum { ROUNDS = 5 };
static const double SECONDS = 5.0; /* simulated, each time */

static char folder[] = "/tmp/jostle-bench-XXXXXX";
static volatile int stop;
static double begun, took; /* s of CPU */
static char address[256];
static bool looks_on;
static size_t received, frames;

static double thread_time(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static void *look_on(void *nothing) {
    int port, kind;
    char token[64];
    size_t length;
    if (sscanf(address, "http://127.0.0.1:%d/?token=%63s", &port, token) != 2)
        return nothing;
    int fd = open_socket(port, token);
    char *message;
    while (fd >= 0 && (message = get_message(fd, &kind, &length, 10.0)) != NULL) {
        received += length;
        frames += kind == FRAME_BINARY && length > 100000;
        free(message);
    }
    close(fd);
    return nothing;
}

static pthread_t looker;

/* Both are called by the stepping thread. */
static void opened(void *context, const char *text) {
    (void)context;
    snprintf(address, sizeof address, "%s", text);
    if (looks_on && pthread_create(&looker, NULL, look_on, NULL) != 0)
        looks_on = false;
    begun = thread_time();
}

static void message(void *context, const char *text) {
    (void)context;
    if (strstr(text, "are over")) {
        took = thread_time() - begun;
        stop = 1;
    }
}

static double run_tawaf(bool client) {
    JoViewDef def = jo_default_view_def();
    def.scene.path = "scenes/tawaf.yaml";
    def.scene.message = message;
    def.scene.named_mods_only = true;
    def.page = folder;
    def.fast = true;
    def.watch = false;
    def.seconds = SECONDS;
    def.stop = &stop;
    def.opened = opened;
    stop = 0;
    looks_on = client;
    JoError error = {0};
    if (!jo_view(&def, &error)) {
        fprintf(stderr, "%s\n", error.text);
        exit(1);
    }
    if (client)
        pthread_join(looker, NULL);
    return took;
}

static int compare_times(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void write_empty_file(const char *name) {
    char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (file)
        fclose(file);
}

int main(void) {
    char path[300];
    double alone[ROUNDS], watched[ROUNDS];
    if (!mkdtemp(folder))
        return 1;
    write_empty_file("index.html");
    for (int i = 0; i < ROUNDS; i++) {
        alone[i] = run_tawaf(false);
        watched[i] = run_tawaf(true);
    }
    qsort(alone, ROUNDS, sizeof *alone, compare_times);
    qsort(watched, ROUNDS, sizeof *watched, compare_times);
    double a = alone[ROUNDS / 2], w = watched[ROUNDS / 2];
    printf(
        "the Tawaf for %g s, CPU of the stepping thread (medians of %d): alone %.2f s, with a page "
        "%.2f s: %+.1f %% (%.0f MB in %zu frames)\n",
        SECONDS, ROUNDS, a, w, 100.0 * (w / a - 1.0), (double)received / ROUNDS / 1e6,
        frames / ROUNDS);
    snprintf(path, sizeof path, "%s/index.html", folder);
    unlink(path);
    return rmdir(folder);
}
