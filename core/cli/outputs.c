/* Checks of output paths: whether a path can be written, is neither an input nor another output,
   and has an ending that fits. Also writes results as text. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/cli.h"

/* Endings that tell what a file holds. */
static const char ENDINGS[] = " csv db db3 gif htm html jpeg jpg json lua mkv mp4 pdf png sqlite "
                              "sqlite3 svg tsv txt webm xlsx xml yaml yml zip ";

static const char SOURCES[] =
    "lua yaml yml"; /* accepted if the file exists; cli_check_apart refuses it if it is read */

/* Returns whether a word is in a list that is separated by blanks. */
static bool is_in_list(const char *word, const char *words) {
    const size_t n = strlen(word);
    for (const char *at = words; *at; at += strcspn(at, " ") + (at[strcspn(at, " ")] == ' '))
        if (strcspn(at, " ") == n && !strncasecmp(at, word, n))
            return true;
    return false;
}

bool cli_ending_fits(const CliOption *option, const char *path, char why[200]) {
    const char *name = jox_path_name(path), *dot = strrchr(name, '.');
    const bool folder = !strcmp(option->writes, "folder");
    struct stat info;
    const bool there = stat(path, &info) == 0;
    if (!dot || dot == name || !is_in_list(dot + 1, ENDINGS) ||
        is_in_list(dot + 1, option->writes) || (there && folder && S_ISDIR(info.st_mode)) ||
        (there && is_in_list(dot + 1, SOURCES)))
        return true;
    if (folder)
        snprintf(why, 200, "is a folder, which is made: '%.60s' looks like a file; '%.*s' would do",
                 path, dot - path < 60 ? (int)(dot - path) : 60, path);
    else
        snprintf(why, 200, "writes %.*s, whatever the name: '%.60s' looks like something else",
                 (int)strcspn(option->writes, " "), option->writes, path);
    return false;
}

static int print_cannot_write(const CliCommand *command, const char *path, const char *why) {
    fprintf(stderr, "jostle %s: cannot write '%s': %s\n", command->name, path, why);
    return JO_FAILED;
}

int cli_check_writable(const CliCommand *command, const char *path) {
    struct stat info;
    char folder[4096];
    const char *slash = strrchr(path, '/');
    if (!strcmp(path, "-"))
        return JO_OK;
    if (stat(path, &info) == 0 && S_ISDIR(info.st_mode))
        return print_cannot_write(command, path, strerror(EISDIR));
    snprintf(folder, sizeof folder, "%.*s.", slash ? (int)(slash - path) + 1 : 0, path);
    const bool there = access(path, F_OK) == 0;
    return access(there ? path : folder, W_OK) == 0
               ? JO_OK
               : print_cannot_write(command, path, strerror(errno));
}

/* Returns whether two paths lead to the same file; paths of files that do not exist are compared as
   text. */
static bool lead_to_same_file(const char *a, const char *b) {
    struct stat one, other;
    const bool first = stat(a, &one) == 0, second = stat(b, &other) == 0;
    if (first && second)
        return S_ISREG(one.st_mode) && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
    return !first && !second && strcmp(a, b) == 0;
}

static int refuse_output(const CliCommand *command, const char *path, const char *why) {
    fprintf(stderr, "jostle %s: '%s' %s; write to another file\n", command->name, path, why);
    return JO_USAGE;
}

int cli_check_apart(const CliCommand *command, const char *const *outputs, size_t output_count,
                    const char *const *inputs, size_t input_count, const JoxOverlay *files) {
    static const char READ[] = "is read for this, and would be replaced";
    for (size_t o = 0; o < output_count; o++) {
        const char *path = outputs[o];
        if (!path || !strcmp(path, "-"))
            continue;
        for (size_t i = 0; i < input_count; i++)
            if (inputs[i] && lead_to_same_file(path, inputs[i]))
                return refuse_output(command, path, READ);
        for (size_t f = 0; files && f < files->count; f++)
            if (lead_to_same_file(path, files->files[f].path))
                return refuse_output(command, path, READ);
        for (size_t b = 0; b < o; b++)
            if (outputs[b] && lead_to_same_file(path, outputs[b]))
                return refuse_output(command, path, "is to be written twice");
    }
    return JO_OK;
}

int cli_write(const CliCommand *command, const char *path, const char *text) {
    JoError error = {0};
    if (!strcmp(path, "-")) {
        cli_output_is_data();
        fputs(text, stdout); /* main reports a failure */
        return JO_OK;
    }
    return jo_write(path, text, &error) ? JO_OK : print_cannot_write(command, path, error.text);
}
