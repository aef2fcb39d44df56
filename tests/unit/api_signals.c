/* Signals belong to the program: no call changes what a signal does or what the caller blocks, and
   none is delivered to a thread of the engine. */
#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "jostle_tools.h"

static char folder[] = "/tmp/jostle-signals-XXXXXX";

static const char SCENE[] =
    "jostle: 1\n"
    "duration: 1\n"
    "places: {hall: {polygon: [[0, 0], [40, 0], [40, 40], [0, 40]]}}\n"
    "groups: {g: {behaviour: stander, count: 1000, fill: grid, in: hall}}\n"; /* work for all */

static const char *in_folder(const char *name) {
    static char paths[4][300];
    static int turn;
    char *path = paths[turn++ % 4];
    snprintf(path, 300, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *name, const char *text) {
    FILE *file = fopen(in_folder(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void quiet(void *context, const char *text) {
    (void)context;
    (void)text;
}

static JoSceneDef def_of_scene(void) {
    JoSceneDef def = jo_default_scene_def();
    def.path = in_folder("scene.yaml");
    def.message = quiet;
    def.named_mods_only = true;
    def.threads = 3;
    return def;
}

/* ---- what the program set ---- */

static struct sigaction actions[NSIG];
static sigset_t blocked;

static void handle(int signal_number) {
    (void)signal_number;
}

static int remember(void **state) {
    (void)state;
    signal(SIGUSR1, handle);
    signal(SIGUSR2, SIG_IGN);
    for (int s = 1; s < NSIG; s++)
        sigaction(s, NULL, &actions[s]);
    return pthread_sigmask(SIG_SETMASK, NULL, &blocked);
}

enum { RESTORER = 0x04000000 }; /* SA_RESTORER, which the C library sets by itself */

static int compare(void **state) {
    (void)state;
    int changed = 0;
    sigset_t now;
    pthread_sigmask(SIG_SETMASK, NULL, &now);
    for (int s = 1; s < NSIG; s++) {
        struct sigaction action;
        if (sigaction(s, NULL, &action) != 0)
            continue;
        bool same = action.sa_handler == actions[s].sa_handler &&
                    ((action.sa_flags ^ actions[s].sa_flags) & ~RESTORER) == 0 &&
                    sigismember(&now, s) == sigismember(&blocked, s);
        if (!same)
            print_error("signal %d (%s) was changed\n", s, strsignal(s));
        changed += !same;
    }
    return changed;
}

/* ---- the engine's threads ---- */

/* Signals that a thread of this process blocks, signal s as bit s - 1. */
static uint64_t blocked_by(const char *thread) {
    char path[300], line[256];
    unsigned long long mask = 0;
    snprintf(path, sizeof path, "/proc/self/task/%s/status", thread);
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file))
        sscanf(line, "SigBlk: %llx", &mask);
    if (file)
        fclose(file);
    return mask;
}

/* How many threads there are beside the calling one; all of them block what a program is sent. */
static int engine_threads(void) {
    static const int SENT[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGCHLD, SIGALRM, SIGUSR1};
    char own[32];
    const uint64_t FAULT = (uint64_t)1 << (SIGSEGV - 1);
    int count = 0;
    snprintf(own, sizeof own, "%d", (int)gettid());
    DIR *threads = opendir("/proc/self/task");
    assert_non_null(threads);
    for (const struct dirent *entry; (entry = readdir(threads));) {
        if (entry->d_name[0] == '.' || strcmp(entry->d_name, own) == 0)
            continue;
        uint64_t mask = blocked_by(entry->d_name);
        for (int i = 0; (mask & FAULT) && i < 1000; i++) { /* it blocks all until it runs */
            usleep(10000);
            mask = blocked_by(entry->d_name);
        }
        for (size_t s = 0; s < sizeof SENT / sizeof *SENT; s++)
            if (!(mask & (uint64_t)1 << (SENT[s] - 1)))
                fail_msg("a thread does not block %s", strsignal(SENT[s]));
        if (mask & FAULT)
            fail_msg("a thread blocks its own faults");
        count++;
    }
    closedir(threads);
    return count;
}

static void threads_of_a_scene(void **state) {
    (void)state;
    JoError error = {0};
    const int before = engine_threads(); /* a sanitizer may have some */
    JoSceneDef def = def_of_scene();
    JoScene *scene = jo_scene_load(&def, &error);
    assert_non_null(scene);
    assert_true(jo_scene_record(scene, in_folder("run.sqlite"), 0.0, &error));
    assert_true(jo_scene_watch(scene, &error));
    for (int i = 0; i < 5; i++)
        assert_true(jo_scene_step(scene, &error));
    assert_in_range(engine_threads() - before, 4, 8); /* two of the pool, recorder, reload */
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);
}

/* ---- calls that run other programs or serve ---- */

static void report(void **state) {
    (void)state;
    JoError error = {0};
    JoReportDef def = jo_default_report_def();
    def.recording = in_folder("run.sqlite");
    def.directory = in_folder("report");
    def.message = quiet;
    char *text = jo_report(&def, &error);
    if (!text)
        fail_msg("%s", error.text);
    jo_free(text);
}

static void reproduction(void **state) {
    (void)state;
    JoError error = {0};
    size_t missed;
    JoReproduceDef def = jo_default_reproduce_def();
    def.list = true;
    def.message = quiet;
    assert_true(jo_reproduce(&def, &missed, &error));
}

static volatile int stop;
static int serving;

static void opened(void *context, const char *address) {
    (void)address;
    serving = engine_threads() - *(const int *)context;
    stop = 1;
}

static void live_page(void **state) {
    (void)state;
    JoError error = {0};
    int before = engine_threads();
    JoViewDef def = jo_default_view_def();
    def.scene = def_of_scene();
    def.page = folder;
    def.stop = &stop;
    def.opened = opened;
    def.opened_context = &before;
    if (!jo_view(&def, &error)) {
        assert_non_null(strstr(error.text, "no live page"));
        skip();
    }
    assert_true(serving > 0);
}

static int make_folder(void **state) {
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    write_file("index.html", "page");
    write_file("scene.yaml", SCENE);
    return 0;
}

static int remove_folder(void **state) {
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(threads_of_a_scene, remember, compare),
        cmocka_unit_test_setup_teardown(report, remember, compare),
        cmocka_unit_test_setup_teardown(reproduction, remember, compare),
        cmocka_unit_test_setup_teardown(live_page, remember, compare)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
