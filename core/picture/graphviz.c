#include "picture/graphviz.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "picture/plot.h"

extern char **environ;

enum { PATIENCE = 60 }; /* s */

/* Starts dot with these descriptors as its standard input, output and error. Returns 0 or an errno
   value. */
static int start_dot(const char *format, const int standard[3], pid_t *child) {
    char option[16];
    posix_spawn_file_actions_t actions;
    snprintf(option, sizeof option, "-T%.8s", format);
    const char *arguments[] = {"dot", option, NULL};
    int failure = posix_spawn_file_actions_init(&actions);
    if (failure)
        return failure;
    for (int d = 0; d < 3 && !failure; d++)
        failure = posix_spawn_file_actions_adddup2(&actions, standard[d], d);
    if (!failure)
        failure =
            posix_spawnp(child, "dot", &actions, NULL, (char *const *)(void *)arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return failure;
}

/* Sends the whole text; dot reads all of it before it writes. */
static void send_graph(int to, const char *text) {
    size_t left = strlen(text);
    while (left > 0) {
        const ssize_t sent = send(to, text, left, MSG_NOSIGNAL);
        if (sent < 0 && errno != EINTR)
            return; /* dot has ended, and says why */
        text += sent > 0 ? sent : 0;
        left -= sent > 0 ? (size_t)sent : 0;
    }
}

/* Runs dot on a graph; `why` gets what it said. Returns 0, -1 if it failed, or an errno value if it
   could not be started. */
static int run_dot(const char *graph, const char *format, int output, char *why, size_t size) {
    int input[2], errors[2], status = 0;
    pid_t child = -1, ended = -1;
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input) != 0)
        return errno;
    int failure = pipe2(errors, O_CLOEXEC) == 0 ? 0 : errno;
    if (!failure) {
        failure = start_dot(format, (int[]){input[1], output, errors[1]}, &child);
        close(errors[1]);
    }
    close(input[1]);
    if (!failure)
        send_graph(input[0], graph);
    close(input[0]);
    if (child > 0) {
        jox_plot_read_last_output(errors[0], child, PATIENCE, why, size);
        close(errors[0]);
    }
    while (child > 0 && (ended = waitpid(child, &status, 0)) < 0 && errno == EINTR)
        ;
    return failure ? failure : ended > 0 && status == 0 ? 0 : -1;
}

bool jox_graphviz_draw(const char *graph, const char *format, const char *path, JoxText *error) {
    char why[300] = "";
    FILE *file = jox_file_replace(path);
    if (!file) {
        jox_text_printf(error, "cannot write '%s': %s", path, jox_file_error_text(errno));
        return false;
    }
    const int failure = run_dot(graph, format, fileno(file), why, sizeof why);
    if (failure) {
        jox_file_drop(file);
        if (failure == ENOENT)
            jox_text_add(error, "the program dot, which draws graphs, is not installed: install "
                                "Graphviz (Debian: graphviz), or take --dot, which prints the "
                                "graph as text");
        else if (failure > 0)
            jox_text_printf(error, "cannot run dot: %s", strerror(failure));
        else
            jox_text_printf(error, "dot could not draw the graph%s%s", *why ? ": " : "", why);
        return false;
    }
    if (jox_file_close(file) == 0)
        return true;
    jox_text_printf(error, "cannot write '%s': %s", path, strerror(errno));
    return false;
}
