/* A confined process reads its folder, and can do nothing else that reaches beyond itself. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/confine.h"
#include "base/file.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "base/text.h"

static char folder[] = "/tmp/jostle-confine-XXXXXX";

static void path_of(const char *name, char path[256]) {
    snprintf(path, 256, "%s/%s", folder, name);
}

static void write_file(const char *name) {
    char path[256];
    path_of(name, path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(name, file);
    assert_int_equal(fclose(file), 0);
}

/* What becomes of a process that does this under these confines, and reads `own`: its status, or
   minus the signal. */
static int confined_to(JoxConfines confines, int (*act)(void)) {
    char own[256];
    int status;
    path_of("own", own);
    const pid_t child = fork();
    if (child == 0) {
        const char *folders[] = {own, "/nowhere"};
        confines.folders = folders;
        confines.folder_count = 2;
        _exit(jox_confine(&confines) ? act() : 99);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

static int confined(int (*act)(void)) {
    return confined_to((JoxConfines){.memory = (size_t)64 << 20, .seconds = 1}, act);
}

/* Who works, and may write to `out`. */
static int working(int (*act)(void), bool programs, bool serves) {
    char out[256];
    path_of("out", out);
    const char *outputs[] = {out};
    return confined_to((JoxConfines){.works = true,
                                     .programs = programs,
                                     .serves = serves,
                                     .outputs = outputs,
                                     .output_count = 1},
                       act);
}

static int reads(const char *name) {
    char path[256];
    path_of(name, path);
    const int file = open(path, O_RDONLY);
    return file >= 0 ? 0 : errno;
}

static int read_own(void) {
    return reads("own/a");
}

static int read_other(void) {
    return reads("other/a");
}

static int read_by_link(void) {
    return reads("own/link");
}

static int makes(const char *name, int flags) {
    char path[256];
    path_of(name, path);
    return open(path, flags, 0600) >= 0 ? 0 : errno;
}

static int make_file(void) {
    return makes("own/new", O_WRONLY | O_CREAT);
}

static int change_file(void) {
    return makes("own/a", O_RDWR);
}

static int remove_file(void) {
    char path[256];
    path_of("own/a", path);
    return unlink(path) == 0 ? 0 : errno;
}

static int start_process(void) {
    const pid_t child = fork();
    if (child == 0)
        _exit(0);
    return child > 0 ? 0 : errno;
}

static int start_program(void) {
    return execl("/bin/true", "true", (char *)NULL);
}

static int open_socket(void) {
    return socket(AF_INET, SOCK_STREAM, 0) >= 0 ? 0 : errno;
}

/* From the system itself: malloc of a build with sanitizers ends the program where there is none.
 */
static int take_memory(void) {
    const int pages = PROT_READ | PROT_WRITE, own = MAP_PRIVATE | MAP_ANONYMOUS;
    return mmap(NULL, (size_t)256 << 20, pages, own, -1, 0) != MAP_FAILED ? 0 : errno;
}

static int spin(void) {
    for (volatile unsigned i = 0; i + 1 > 0; i = 1)
        continue;
    return 0;
}

static int make_output(void) {
    return makes("out/new", O_WRONLY | O_CREAT);
}

static int cut_file(void) {
    return makes("own/a", O_RDONLY | O_TRUNC);
}

static int signal_parent(void) {
    return kill(getppid(), 0) == 0 ? 0 : errno;
}

static int signal_parent_by_thread(void) {
    return syscall(SYS_tgkill, getppid(), getppid(), 0) == 0 ? 0 : errno;
}

static int run_program(void) {
    int status = 0;
    const pid_t child = fork();
    if (child == 0)
        execl("/bin/sh", "sh", "-c", "cat \"$0/other/a\" 2>&-", folder, (char *)NULL);
    return waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : 99;
}

static int listens(void) {
    const struct sockaddr_in any = {.sin_family = AF_INET};
    const int server = socket(AF_INET, SOCK_STREAM, 0);
    return server >= 0 && bind(server, (const struct sockaddr *)&any, sizeof any) == 0 &&
                   listen(server, 1) == 0
               ? 0
               : errno;
}

static int connects(void) {
    const struct sockaddr_in some = {.sin_family = AF_INET, .sin_port = 1};
    const int client = socket(AF_INET, SOCK_STREAM, 0);
    return connect(client, (const struct sockaddr *)&some, sizeof some) == 0 ? 0 : errno;
}

static int sends_to(void) {
    const struct sockaddr_in some = {.sin_family = AF_INET, .sin_port = 1};
    const int client = socket(AF_INET, SOCK_STREAM, 0);
    const ssize_t sent = sendto(client, "x", 1, MSG_FASTOPEN | MSG_NOSIGNAL,
                                (const struct sockaddr *)&some, sizeof some);
    return sent >= 0 ? 0 : errno;
}

static int sends_datagrams(void) {
    return socket(AF_INET, SOCK_DGRAM, 0) >= 0 ? 0 : errno;
}

static int write_much(void) {
    char path[256];
    path_of("out/large", path);
    const int file = open(path, O_WRONLY | O_CREAT, 0600);
    signal(SIGXFSZ, SIG_IGN);
    return file >= 0 && pwrite(file, "x", 1, 1 << 20) == 1 ? 0 : errno;
}

static int open_many(void) {
    for (int i = 0; i < 40; i++)
        if (dup(0) < 0)
            return errno;
    return 0;
}

/* Of a simulation, too: what one process can take of the machine. */
static void who_works_has_limits(void **state) {
    (void)state;
    char out[256];
    path_of("out", out);
    const char *outputs[] = {out};
    JoxConfines confines = {.works = true, .outputs = outputs, .output_count = 1};
    assert_int_equal(confined_to(confines, write_much), 0);
    assert_int_equal(confined_to(confines, open_many), 0);
    confines.file_size = 1 << 20;
    confines.files = 20;
    confines.memory = (size_t)64 << 20;
    assert_int_equal(confined_to(confines, write_much), EFBIG);
    assert_int_equal(confined_to(confines, open_many), EMFILE);
    assert_int_equal(confined_to(confines, take_memory), ENOMEM);
    path_of("out/large", out);
    assert_int_equal(unlink(out), 0);
}

static void who_works_writes_its_outputs_alone(void **state) {
    (void)state;
    if (!jox_confine_can().files || !jox_confine_can().calls)
        skip();
    assert_int_equal(working(read_own, false, false), 0);
    assert_int_equal(working(read_other, false, false), EACCES);
    assert_int_equal(working(make_output, false, false), 0);
    assert_int_equal(working(make_file, false, false), EACCES);
    assert_int_equal(working(change_file, false, false), EACCES);
    assert_int_equal(working(remove_file, false, false), EACCES);
    assert_int_equal(working(cut_file, false, false), EPERM);
    assert_int_equal(reads("own/a"), 0);
}

static void who_works_reaches_nobody(void **state) {
    (void)state;
    if (!jox_confine_can().calls)
        skip();
    assert_int_equal(working(start_process, false, false), 0);
    assert_int_equal(working(start_program, false, false), -SIGSYS);
    assert_int_equal(working(open_socket, false, false), EPERM);
    assert_int_equal(working(signal_parent, false, false), EPERM);
    assert_int_equal(working(signal_parent_by_thread, false, false), EPERM);
}

static void programs_are_confined_as_who_starts_them(void **state) {
    (void)state;
    if (!jox_confine_can().files || !jox_confine_can().calls)
        skip();
    assert_int_equal(working(start_program, true, false), 0);
    assert_int_equal(working(run_program, true, false), 1); /* cat fails */
    assert_int_equal(working(open_socket, true, false), EPERM);
}

static void who_serves_connects_to_nobody(void **state) {
    (void)state;
    if (!jox_confine_can().calls)
        skip();
    assert_int_equal(working(listens, false, true), 0);
    assert_int_equal(working(connects, false, true), EPERM);
    assert_int_equal(working(sends_to, false, true), EPERM);
    assert_int_equal(working(sends_datagrams, false, true), EPERM);
}

static void it_reads_its_folder_alone(void **state) {
    (void)state;
    if (!jox_confine_can().files)
        skip();
    assert_int_equal(confined(read_own), 0);
    assert_int_equal(confined(read_other), EACCES);
    assert_int_equal(confined(read_by_link), EACCES);
}

static void it_writes_nothing(void **state) {
    (void)state;
    if (!jox_confine_can().files && !jox_confine_can().calls)
        skip();
    assert_int_equal(confined(make_file), EACCES);
    assert_int_equal(confined(change_file), EACCES);
    const int removed = confined(remove_file);
    assert_true(removed == EACCES || removed == EPERM);
    assert_int_equal(reads("own/a"), 0);
}

static void it_starts_nothing_and_has_no_network(void **state) {
    (void)state;
    if (!jox_confine_can().calls)
        skip();
    assert_int_equal(confined(start_process), EPERM);
    assert_int_equal(confined(start_program), -SIGSYS);
    assert_int_equal(confined(open_socket), -SIGSYS);
}

static void its_memory_and_time_are_bounded(void **state) {
    (void)state;
    assert_int_equal(confined(take_memory), ENOMEM);
    const int ended = confined(spin);
    assert_true(ended == -SIGXCPU || ended == -SIGKILL);
}

/* ---- what it read stands for the files ---- */

static char *read_through(const JoxOverlay *overlay, const char *name) {
    char path[256];
    path_of(name, path);
    const JoxOverlay *before = jox_overlay_use(overlay);
    char *text = jox_read_file(path, 1000, NULL);
    const int number = errno;
    jox_overlay_use(before);
    errno = number;
    return text;
}

static void keep(void *context, const char *path, const char *text, size_t length) {
    jox_overlay_put(context, path, text, length);
}

static void what_was_vetted_is_what_is_read(void **state) {
    (void)state;
    JoxOverlay vetted = {0}, listening = {.told = keep, .context = &vetted}, over = {0}, tape = {0};
    char *text = read_through(&listening, "own/a");
    assert_string_equal(text, "own/a");
    jox_free(text);
    assert_int_equal(vetted.count, 1);
    char path[256];
    path_of("own/a", path);
    FILE *file = fopen(path, "w"); /* somebody changes it after it was vetted */
    assert_non_null(file);
    fputs("changed", file);
    assert_int_equal(fclose(file), 0);
    vetted.sealed = true;
    over.under = &vetted;
    over.tape = &tape;
    text = read_through(&over, "own/a");
    assert_string_equal(text, "own/a");
    jox_free(text);
    assert_int_equal(tape.count, 1); /* as if it were from the disk */
    assert_null(read_through(&over, "other/a"));
    assert_int_equal(errno, ENOENT);
    write_file("own/a");
    jox_overlay_free(&vetted);
    jox_overlay_free(&tape);
}

static int make_files(void **state) {
    (void)state;
    char own[256], other[256], out[256], link[256];
    if (!mkdtemp(folder))
        return -1;
    path_of("own", own);
    path_of("other", other);
    path_of("out", out);
    path_of("own/link", link);
    if (mkdir(own, 0700) || mkdir(out, 0700) || mkdir(other, 0700) || symlink("../other/a", link))
        return -1;
    write_file("own/a");
    write_file("other/a");
    return 0;
}

static int remove_files(void **state) {
    static const char *const NAMES[] = {"own/a",   "own/new", "own/link", "other/a",
                                        "out/new", "own",     "out",      "other"};
    char path[256];
    (void)state;
    for (size_t n = 0; n < sizeof NAMES / sizeof *NAMES; n++) {
        path_of(NAMES[n], path);
        remove(path);
    }
    return rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_reads_its_folder_alone),
        cmocka_unit_test(it_writes_nothing),
        cmocka_unit_test(it_starts_nothing_and_has_no_network),
        cmocka_unit_test(its_memory_and_time_are_bounded),
        cmocka_unit_test(who_works_has_limits),
        cmocka_unit_test(who_works_writes_its_outputs_alone),
        cmocka_unit_test(who_works_reaches_nobody),
        cmocka_unit_test(programs_are_confined_as_who_starts_them),
        cmocka_unit_test(who_serves_connects_to_nobody),
        cmocka_unit_test(what_was_vetted_is_what_is_read),
    };
    return cmocka_run_group_tests(tests, make_files, remove_files);
}
