/* Programs that a call started end with it, though memory runs out in between. */
#include <errno.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/mem.h"
#include "jostle_tools.h"

static char folder[] = "/tmp/jostle-children-XXXXXX";

static const char *in_folder(const char *name) {
    static char paths[8][300];
    static int turn;
    char *path = paths[turn++ % 8];
    snprintf(path, 300, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *name, const char *text) {
    FILE *file = fopen(in_folder(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* In place of `jostle`: a run of seed 1 never ends, one of seed 2 waits for the file "go". */
static const char PROGRAM[] = "#!/bin/sh\n"
                              "cd \"$(dirname \"$0\")\"\n"
                              "case \"$*\" in\n"
                              "*'--seed 1 '*) touch first; exec sleep 1000 ;;\n"
                              "*) touch second; while [ ! -e go ]; do sleep 0.02; done ;;\n"
                              "esac\n"
                              "exit 1\n";
static const char CLAIM[] = "return claim {\n"
                            "  id = 'C', title = 'It ends', source = 'nobody',\n"
                            "  runs = { one = { scene = 'one.yaml', seeds = '1-2' } },\n"
                            "  measure = function(run) return { steps = 1 } end,\n"
                            "  expect = { { 'steps', band = { 1, 1 } } },\n"
                            "}\n";
static const char SCENE[] = "jostle: 1\n"
                            "duration: 1\n"
                            "groups: {g: {behaviour: stander, at: [[0, 0]]}}\n";

static char told[4096];

static void keep(void *context, const char *text) {
    (void)context;
    snprintf(told, sizeof told, "%.4000s", text);
}

/* Once both programs run, there is no more memory; then the second ends. */
static void *take_memory_away(void *context) {
    (void)context;
    for (int i = 0; i < 3000; i++) {
        if (access(in_folder("first"), F_OK) == 0 && access(in_folder("second"), F_OK) == 0)
            break;
        usleep(10000);
    }
    jox_alloc_fail_after(0);
    FILE *file = fopen(in_folder("go"), "w");
    if (file)
        fclose(file);
    return NULL;
}

static void a_reproduction_ends_its_runs(void **state) {
    (void)state;
    JoError error = {0};
    size_t missed;
    pthread_t thread;
    char claims[300], out[300], program[300];
    snprintf(claims, sizeof claims, "%s", folder);
    snprintf(out, sizeof out, "%s/out", folder);
    snprintf(program, sizeof program, "%s/program", folder);
    JoReproduceDef def = jo_default_reproduce_def();
    def.folder = claims;
    def.out = out;
    def.program = program;
    def.jobs = 2;
    def.quiet = true;
    def.message = keep;
    assert_int_equal(pthread_create(&thread, NULL, take_memory_away, NULL), 0);
    bool good = jo_reproduce(&def, &missed, &error);
    pthread_join(thread, NULL);
    jox_alloc_fail_after(UINT64_MAX);
    if (good || strcmp(error.text, "out of memory") != 0)
        fail_msg("'%s', told '%s'", error.text, told);
    assert_int_equal(access(in_folder("first"), F_OK), 0);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* nothing runs, nothing waits to be reaped */
    assert_int_equal(errno, ECHILD);
}

static int make_folder(void **state) {
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    write_file("one.yaml", SCENE);
    write_file("one.lua", CLAIM);
    write_file("program", PROGRAM);
    return chmod(in_folder("program"), 0700);
}

static int remove_folder(void **state) {
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_reproduction_ends_its_runs)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
