/* The sandbox: what a confined reader, worker or server can do, each tried in a child process. */
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

static void make_confined_path(const char *name, char path[256]) {
    snprintf(path, 256, "%s/%s", folder, name);
}

static void write_named_file(const char *name) {
    char path[256];
    make_confined_path(name, path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(name, file);
    assert_int_equal(fclose(file), 0);
}

/* Runs `act` in a child process that is confined and may read the folder `own`. Returns its exit
   status, or minus the signal that killed it. */
static int run_confined(JoxConfines confines, int (*act)(void)) {
    char own[256];
    int status;
    make_confined_path("own", own);
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

static int run_reader(int (*act)(void)) {
    return run_confined((JoxConfines){.memory = (size_t)64 << 20, .seconds = 1}, act);
}

/* Runs `act` in a confined worker that may write to the folder `out`. */
static int run_confined_worker(int (*act)(void), bool programs, bool serves) {
    char out[256];
    make_confined_path("out", out);
    const char *outputs[] = {out};
    return run_confined((JoxConfines){.works = true,
                                      .programs = programs,
                                      .serves = serves,
                                      .outputs = outputs,
                                      .output_count = 1},
                        act);
}

static int try_reading(const char *name) {
    char path[256];
    make_confined_path(name, path);
    const int file = open(path, O_RDONLY);
    return file >= 0 ? 0 : errno;
}

static int read_own_folder(void) {
    return try_reading("own/a");
}

static int read_other(void) {
    return try_reading("other/a");
}

static int read_by_link(void) {
    return try_reading("own/link");
}

static int try_opening(const char *name, int flags) {
    char path[256];
    make_confined_path(name, path);
    return open(path, flags, 0600) >= 0 ? 0 : errno;
}

static int make_own_file(void) {
    return try_opening("own/new", O_WRONLY | O_CREAT);
}

static int change_file(void) {
    return try_opening("own/a", O_RDWR);
}

static int remove_file(void) {
    char path[256];
    make_confined_path("own/a", path);
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

static int open_stream_socket(void) {
    return socket(AF_INET, SOCK_STREAM, 0) >= 0 ? 0 : errno;
}

/* Allocates by mmap: the malloc of builds with sanitizers would end the program. */
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
    return try_opening("out/new", O_WRONLY | O_CREAT);
}

static int cut_file(void) {
    return try_opening("own/a", O_RDONLY | O_TRUNC);
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

static int listen_to_port(void) {
    const struct sockaddr_in any = {.sin_family = AF_INET};
    const int server = socket(AF_INET, SOCK_STREAM, 0);
    return server >= 0 && bind(server, (const struct sockaddr *)&any, sizeof any) == 0 &&
                   listen(server, 1) == 0
               ? 0
               : errno;
}

static int connect_to_port(void) {
    const struct sockaddr_in some = {.sin_family = AF_INET, .sin_port = 1};
    const int client = socket(AF_INET, SOCK_STREAM, 0);
    return connect(client, (const struct sockaddr *)&some, sizeof some) == 0 ? 0 : errno;
}

static int send_by_address(void) {
    const struct sockaddr_in some = {.sin_family = AF_INET, .sin_port = 1};
    const int client = socket(AF_INET, SOCK_STREAM, 0);
    const ssize_t sent = sendto(client, "x", 1, MSG_FASTOPEN | MSG_NOSIGNAL,
                                (const struct sockaddr *)&some, sizeof some);
    return sent >= 0 ? 0 : errno;
}

static int open_datagram_socket(void) {
    return socket(AF_INET, SOCK_DGRAM, 0) >= 0 ? 0 : errno;
}

static int write_much(void) {
    char path[256];
    make_confined_path("out/large", path);
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

/* Limits of memory, file size and open files hold for a worker. */
static void worker_has_limits(void **state) {
    (void)state;
    char out[256];
    make_confined_path("out", out);
    const char *outputs[] = {out};
    JoxConfines confines = {.works = true, .outputs = outputs, .output_count = 1};
    assert_int_equal(run_confined(confines, write_much), 0);
    assert_int_equal(run_confined(confines, open_many), 0);
    confines.file_size = 1 << 20;
    confines.files = 20;
    confines.memory = (size_t)64 << 20;
    assert_int_equal(run_confined(confines, write_much), EFBIG);
    assert_int_equal(run_confined(confines, open_many), EMFILE);
    assert_int_equal(run_confined(confines, take_memory), ENOMEM);
    make_confined_path("out/large", out);
    assert_int_equal(unlink(out), 0);
}

static void worker_writes_only_its_outputs(void **state) {
    (void)state;
    if (!jox_confine_can().files || !jox_confine_can().calls)
        skip();
    assert_int_equal(run_confined_worker(read_own_folder, false, false), 0);
    assert_int_equal(run_confined_worker(read_other, false, false), EACCES);
    assert_int_equal(run_confined_worker(make_output, false, false), 0);
    assert_int_equal(run_confined_worker(make_own_file, false, false), EACCES);
    assert_int_equal(run_confined_worker(change_file, false, false), EACCES);
    assert_int_equal(run_confined_worker(remove_file, false, false), EACCES);
    assert_int_equal(run_confined_worker(cut_file, false, false), EPERM);
    assert_int_equal(try_reading("own/a"), 0);
}

static void worker_reaches_no_other_process(void **state) {
    (void)state;
    if (!jox_confine_can().calls)
        skip();
    assert_int_equal(run_confined_worker(start_process, false, false), 0);
    assert_int_equal(run_confined_worker(start_program, false, false), -SIGSYS);
    assert_int_equal(run_confined_worker(open_stream_socket, false, false), EPERM);
    assert_int_equal(run_confined_worker(signal_parent, false, false), EPERM);
    assert_int_equal(run_confined_worker(signal_parent_by_thread, false, false), EPERM);
}

static void started_programs_inherit_the_sandbox(void **state) {
    (void)state;
    if (!jox_confine_can().files || !jox_confine_can().calls)
        skip();
    assert_int_equal(run_confined_worker(start_program, true, false), 0);
    assert_int_equal(run_confined_worker(run_program, true, false), 1); /* cat fails */
    assert_int_equal(run_confined_worker(open_stream_socket, true, false), EPERM);
}

static void server_cannot_connect(void **state) {
    (void)state;
    if (!jox_confine_can().calls)
        skip();
    assert_int_equal(run_confined_worker(listen_to_port, false, true), 0);
    assert_int_equal(run_confined_worker(connect_to_port, false, true), EPERM);
    assert_int_equal(run_confined_worker(send_by_address, false, true), EPERM);
    assert_int_equal(run_confined_worker(open_datagram_socket, false, true), EPERM);
}

static void reader_reads_only_its_folder(void **state) {
    (void)state;
    if (!jox_confine_can().files)
        skip();
    assert_int_equal(run_reader(read_own_folder), 0);
    assert_int_equal(run_reader(read_other), EACCES);
    assert_int_equal(run_reader(read_by_link), EACCES);
}

static void reader_writes_nothing(void **state) {
    (void)state;
    if (!jox_confine_can().files && !jox_confine_can().calls)
        skip();
    assert_int_equal(run_reader(make_own_file), EACCES);
    assert_int_equal(run_reader(change_file), EACCES);
    const int removed = run_reader(remove_file);
    assert_true(removed == EACCES || removed == EPERM);
    assert_int_equal(try_reading("own/a"), 0);
}

static void reader_starts_nothing_and_has_no_network(void **state) {
    (void)state;
    if (!jox_confine_can().calls)
        skip();
    assert_int_equal(run_reader(start_process), EPERM);
    assert_int_equal(run_reader(start_program), -SIGSYS);
    assert_int_equal(run_reader(open_stream_socket), -SIGSYS);
}

static void reader_has_memory_and_time_limits(void **state) {
    (void)state;
    assert_int_equal(run_reader(take_memory), ENOMEM);
    const int ended = run_reader(spin);
    assert_true(ended == -SIGXCPU || ended == -SIGKILL);
}

/* ---- overlays of what a confined process has read ---- */

static char *read_through(const JoxOverlay *overlay, const char *name) {
    char path[256];
    make_confined_path(name, path);
    const JoxOverlay *before = jox_overlay_use(overlay);
    char *text = jox_read_file(path, 1000, NULL);
    const int number = errno;
    jox_overlay_use(before);
    errno = number;
    return text;
}

static void put_in_overlay(void *context, const char *path, const char *text, size_t length) {
    jox_overlay_put(context, path, text, length);
}

static void overlay_gives_the_text_that_was_vetted(void **state) {
    (void)state;
    JoxOverlay vetted = {0}, listening = {.told = put_in_overlay, .context = &vetted}, over = {0},
               tape = {0};
    char *text = read_through(&listening, "own/a");
    assert_string_equal(text, "own/a");
    jox_free(text);
    assert_int_equal(vetted.count, 1);
    char path[256];
    make_confined_path("own/a", path);
    FILE *file = fopen(path, "w"); /* the file changes after it was vetted */
    assert_non_null(file);
    fputs("changed", file);
    assert_int_equal(fclose(file), 0);
    vetted.sealed = true;
    over.under = &vetted;
    over.tape = &tape;
    text = read_through(&over, "own/a");
    assert_string_equal(text, "own/a");
    jox_free(text);
    assert_int_equal(tape.count, 1); /* kept as if it came from the disk */
    assert_null(read_through(&over, "other/a"));
    assert_int_equal(errno, ENOENT);
    write_named_file("own/a");
    jox_overlay_free(&vetted);
    jox_overlay_free(&tape);
}

static int make_confined_files(void **state) {
    (void)state;
    char own[256], other[256], out[256], link[256];
    if (!mkdtemp(folder))
        return -1;
    make_confined_path("own", own);
    make_confined_path("other", other);
    make_confined_path("out", out);
    make_confined_path("own/link", link);
    if (mkdir(own, 0700) || mkdir(out, 0700) || mkdir(other, 0700) || symlink("../other/a", link))
        return -1;
    write_named_file("own/a");
    write_named_file("other/a");
    return 0;
}

static int remove_confined_files(void **state) {
    static const char *const NAMES[] = {"own/a",   "own/new", "own/link", "other/a",
                                        "out/new", "own",     "out",      "other"};
    char path[256];
    (void)state;
    for (size_t n = 0; n < sizeof NAMES / sizeof *NAMES; n++) {
        make_confined_path(NAMES[n], path);
        remove(path);
    }
    return rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reader_reads_only_its_folder),
        cmocka_unit_test(reader_writes_nothing),
        cmocka_unit_test(reader_starts_nothing_and_has_no_network),
        cmocka_unit_test(reader_has_memory_and_time_limits),
        cmocka_unit_test(worker_has_limits),
        cmocka_unit_test(worker_writes_only_its_outputs),
        cmocka_unit_test(worker_reaches_no_other_process),
        cmocka_unit_test(started_programs_inherit_the_sandbox),
        cmocka_unit_test(server_cannot_connect),
        cmocka_unit_test(overlay_gives_the_text_that_was_vetted),
    };
    return cmocka_run_group_tests(tests, make_confined_files, remove_confined_files);
}
