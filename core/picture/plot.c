#include "picture/plot.h"
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/format/quote.h"
#include "picture/draw_parts.h"
#include "picture/palette.h"

extern char **environ;

bool jox_plot_folder(const char *folder, JoxText *error) {
    char path[1024];
    snprintf(path, sizeof path, "%s", folder);
    for (char *c = path + 1;; c++) {
        char was = *c;
        if (was && was != '/')
            continue;
        *c = 0;
        struct stat info;
        const bool made = mkdir(path, 0777) == 0, there = !made && errno == EEXIST;
        if (!made && !(there && stat(path, &info) == 0 && S_ISDIR(info.st_mode))) {
            jox_text_printf(error, "cannot make the folder '%s': %s", path,
                            there ? "it is no folder" : strerror(errno));
            return false;
        }
        *c = was;
        if (!was)
            return true;
    }
}

FILE *jox_plot_open(const char *folder, const char *name, JoxText *error) {
    char path[1100];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = jox_file_replace(path);
    if (!file)
        jox_text_printf(error, "cannot write '%s': %s", path, jox_file_error_text(errno));
    return file;
}

bool jox_plot_close(FILE *file, const char *what, JoxText *error) {
    const bool good = jox_file_close(file) == 0;
    if (!good)
        jox_text_printf(error, "cannot write %s: %s", what, strerror(errno));
    return good;
}

/* Starts gnuplot on a script of the folder, in that folder, with its standard error connected to
   `errors`. Returns the child, or -1. */
static pid_t start_gnuplot(const char *folder, const char *script, int errors) {
    char command[] = "gnuplot", usual[] = "-d"; /* -d: do not read ~/.gnuplot */
    JoxText path = {0};
    posix_spawn_file_actions_t actions;
    pid_t child = -1;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return -1;
    jox_text_printf(&path, "./%s", script); /* "./" keeps a name from being read as an option */
    char *arguments[] = {command, usual, path.data, NULL};
    if (posix_spawn_file_actions_addchdir_np(&actions, folder) != 0 ||
        posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO) != 0 ||
        posix_spawnp(&child, command, &actions, NULL, arguments, environ) != 0)
        child = -1;
    posix_spawn_file_actions_destroy(&actions);
    jox_text_free(&path);
    return child;
}

/* Waits until a pipe has data or is closed, for at most `seconds` of time in which this process
   runs: counting one-second waits leaves out the time that the machine sleeps. Returns whether
   the pipe is ready. */
static bool wait_for_input(int pipe, int seconds) {
    struct pollfd asked = {.fd = pipe, .events = POLLIN};
    int ready = 0;
    for (int s = 0; s < seconds && ready <= 0; s++)
        ready = poll(&asked, 1, 1000);
    return ready > 0;
}

void jox_plot_read_last_output(int pipe, pid_t child, int seconds, char *last, size_t size) {
    char bytes[512];
    size_t kept = 0;
    ssize_t got = 1;
    while (got != 0) {
        if (child > 0 && !wait_for_input(pipe, seconds)) {
            kill(child, SIGKILL);
            snprintf(last, size, "it said nothing for %d s", seconds);
            return;
        }
        got = read(pipe, bytes, sizeof bytes);
        if (got < 0 && errno != EINTR)
            break;
        for (ssize_t b = 0; b < got; b++) {
            if (kept == size - 1)
                memmove(last, last + 1, --kept);
            last[kept++] = bytes[b] == '\n' ? ' ' : bytes[b];
        }
    }
    while (kept && last[kept - 1] == ' ')
        kept--;
    last[kept] = '\0';
}

/* Gnuplot's messages are reported only on failure, as it also warns of curves without points. */
bool jox_plot_draw_within(const char *folder, const char *script, int seconds, JoxText *error) {
    int errors[2], status = 0;
    char why[300] = "";
    pid_t child = -1, ended;
    if (pipe2(errors, O_CLOEXEC) == 0) {
        child = start_gnuplot(folder, script, errors[1]);
        close(errors[1]);
        jox_plot_read_last_output(errors[0], child, seconds, why, sizeof why);
        close(errors[0]);
    }
    do
        ended = child > 0 ? waitpid(child, &status, 0) : -1;
    while (ended < 0 && child > 0 && errno == EINTR);
    if (ended >= 0 && status == 0)
        return true;
    jox_text_printf(error, "gnuplot could not draw %s/%s%s%s", folder, script,
                    *why ? ": " : " (is gnuplot installed?)", why);
    return false;
}

bool jox_plot_draw(const char *folder, const char *script, JoxText *error) {
    enum { PATIENCE = 300 }; /* s; the largest picture takes a few */
    return jox_plot_draw_within(folder, script, PATIENCE, error);
}

void jox_plot_file(FILE *script, const char *stem, const char *ending) {
    JoxText name = {0};
    jox_text_printf(&name, "%s.%s", stem, ending);
    jox_quote_put(script, jox_quote_gnuplot_file, name.data);
    jox_text_free(&name);
}

void jox_plot_begin(FILE *script, const char *stem, bool svg, int width, int height) {
    fprintf(script, "reset\nset terminal %s size %d,%d font 'sans,%d'\nset output ",
            svg ? "svg background '#ffffff'" : "pngcairo", width, height, svg ? 13 : 12);
    jox_plot_file(script, stem, svg ? "svg" : "png");
    /* noautotitle keeps file names out of the key. Values go from white to dark, as in all
       pictures. */
    fputs("\nset encoding utf8\nset key noautotitle\nset palette defined (0 '#ffffff'", script);
    enum { ANCHORS = 9 };
    for (int a = 0; a < ANCHORS; a++) {
        const JoxInk ink = jox_palette_value((float)a / (ANCHORS - 1));
        fprintf(script, ", %.3f '#%02x%02x%02x'", a ? (double)a / (ANCHORS - 1) : 0.02, ink.r,
                ink.g, ink.b);
    }
    fputs(")\n", script);
}

void jox_plot_title(FILE *script, const char *title) {
    fputs("set title ", script);
    jox_quote_put(script, jox_quote_gnuplot, title);
    fputs(" noenhanced font ',14'\n", script);
}

/* Writes the open or the other wall rings, a blank line after each, and returns their number. */
static uint32_t write_wall_rings(FILE *data, const JoxWalls *walls, const JoxPanels *panels,
                                 bool open) {
    uint32_t count = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        if (walls->rings[r].open != open)
            continue;
        count++;
        for (uint32_t i = 0; i <= walls->rings[r].count; i++) {
            JoxV2 p = walls->vertices[walls->rings[r].first + i % walls->rings[r].count].point;
            if (panels && panels->storeys)
                p = jox_draw_in_panels(panels, p);
            fprintf(data, "%g,%g\n", p.x, p.y);
        }
        fputs("\n", data);
    }
    return count;
}

bool jox_plot_walls(const char *folder, const JoxWalls *walls, const JoxPanels *panels,
                    JoxText *error) {
    FILE *data = jox_plot_open(folder, "walls.dat", error);
    if (!data)
        return false;
    if (write_wall_rings(data, walls, panels, false) == 0)
        fputs("0,NaN\n\n", data);
    fputs("\n", data); /* a second blank line begins the next data set */
    write_wall_rings(data, walls, panels, true);
    return jox_plot_close(data, "walls.dat", error);
}

void jox_plot_wall_lines(FILE *script, const JoxWalls *walls, const char *width) {
    bool open = false;
    for (uint32_t r = 0; r < walls->ring_count; r++)
        open |= walls->rings[r].open;
    if (walls->ring_count)
        fprintf(script, ", \\\n  'walls.dat' index 0 using 1:2 with lines lw %s lc 'black' notitle",
                width);
    if (open)
        fprintf(script,
                ", \\\n  'walls.dat' index 1 using 1:2 with lines lw %s lc '#808080' dt 2 notitle",
                width);
    fputs("\n", script);
}

bool jox_plot_regions(const char *folder, const JoxRegions *regions, const char *title,
                      JoxText *error) {
    FILE *data = jox_plot_open(folder, "regions.csv", error);
    if (!data)
        return false;
    uint64_t people = 0;
    fputs("region,mean speed [m/s],people counted in all samples\n", data);
    for (uint32_t r = 0; r < regions->count; r++) {
        const JoxRegion *region = &regions->items[r];
        people += region->people;
        jox_quote_put(data, jox_quote_csv, region->name);
        if (region->people)
            fprintf(data, ",%.4f,%llu\n", jox_region_speed(region),
                    (unsigned long long)region->people);
        else
            fputs(",,0\n", data);
    }
    if (!jox_plot_close(data, "regions.csv", error))
        return false;
    if (people == 0) /* gnuplot refuses a plot without a value */
        return true;
    if (!(data = jox_plot_open(folder, "regions.plt", error)))
        return false;
    jox_plot_begin(data, "regions", false, 1200, 600);
    jox_plot_title(data, title);
    fputs("set datafile separator comma\nset style fill solid 0.9\nset boxwidth 0.6\nunset key\n"
          "set yrange [0:*]\nset offsets 0.5, 0.5, 0.05, 0\nset grid ytics\n"
          "set xtics noenhanced\nset xlabel 'region'\nset ylabel 'mean speed (m/s)'\n"
          "plot 'regions.csv' skip 1 using 0:2:xtic(1) with boxes lc '#0072b2', "
          "'' skip 1 using 0:2:(sprintf('%.2f', $2)) with labels offset 0,0.7\n",
          data);
    return jox_plot_close(data, "regions.plt", error) &&
           jox_plot_draw(folder, "regions.plt", error);
}
