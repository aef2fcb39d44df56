/* Runs of scenes as processes of their own: several at once, the long ones first, and none that is
   there already. */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "base/format/json.h"
#include "base/mem.h"
#include "picture/plot.h"
#include "validate/reproduce.h"

enum { MOST_ARGUMENTS = 200 };

static bool interrupted(const JoxReproduction *all) {
    const volatile int *stop = all->def->stop;
    return stop && __atomic_load_n(stop, __ATOMIC_RELAXED);
}

static char *path_in(const JoxJob *job, const char *name) {
    JoxText path = {0};
    jox_text_printf(&path, "%s/%s", job->folder, name);
    return path.data;
}

static char *read_in(const JoxJob *job, const char *name) {
    size_t length;
    char *path = path_in(job, name), *text = jox_read_file(path, (size_t)16 << 20, &length);
    jox_free(path);
    return text;
}

typedef struct Inputs {
    char *path;     /* of the file that was read last */
    bool any, hold; /* whether there are inputs, and all are as they were */
} Inputs;

/* Of "inputs": [{"path": "...", "sha256": "..."}, ...] each file. */
static bool compare_input(void *context, const JoxJsonItem *item) {
    Inputs *inputs = context;
    if (item->kind == JOX_JSON_ARRAY && !strcmp(item->path, "inputs"))
        inputs->any = true;
    if (item->kind != JOX_JSON_TEXT || strncmp(item->path, "inputs.", 7) != 0)
        return true;
    if (!strcmp(item->key, "path")) {
        jox_free(inputs->path);
        inputs->path = jox_strdup(item->text);
    } else if (!strcmp(item->key, "sha256")) {
        char found[65] = "";
        size_t length;
        char *text = inputs->path ? jox_read_file(inputs->path, (size_t)64 << 20, &length) : NULL;
        if (text)
            jox_sha256_hex(text, length, found);
        inputs->hold &= text && strcmp(found, item->text) == 0;
        jox_free(text);
    }
    return inputs->hold;
}

/* Whether the files that the summary names are still those that were read. */
static bool inputs_hold(const char *summary) {
    Inputs inputs = {.hold = true};
    bool read = jox_json_read(summary, jox_json_own_files, compare_input, &inputs);
    jox_free(inputs.path);
    return read && inputs.any && inputs.hold;
}

/* Done before, by the same program, from the same files. */
static bool is_there(const JoxJob *job) {
    char *key = read_in(job, "run.txt"), *summary = read_in(job, "summary.json");
    bool there = key && summary && strcmp(key, job->key) == 0 && inputs_hold(summary);
    jox_free(key);
    jox_free(summary);
    return there;
}

/* What an earlier run left: a probe that is gone must not be measured, nor half a run taken for a
   whole one. */
static void clear(const JoxJob *job) {
    char **names = jox_folder_names(job->folder, false);
    for (char **name = names; name && *name; name++) {
        char *path = path_in(job, *name);
        remove(path);
        jox_free(path);
    }
    jox_free(names);
}

/* Ends its process, with what that started itself (gnuplot): half a run is of no use. */
static void stop(void *running) {
    JoxJob *job = running;
    kill(-job->process, SIGKILL);
    while (waitpid(job->process, NULL, 0) < 0 && errno == EINTR)
        continue;
}

static void start(const JoxReproduction *all, JoxJob *job) {
    char seed[32], dt[32], duration[32];
    const char *arguments[MOST_ARGUMENTS] = {all->def->program, "run",       job->run->scene,
                                             "--quiet",         "--no-mods", "--no-watch",
                                             "--threads",       "1",         "--no-half-step"};
    int n = 9;
    char *summary = path_in(job, "summary.json"), *log = path_in(job, "log.txt");
    clear(job);
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)job->seed);
    snprintf(dt, sizeof dt, "%.9g", job->run->dt);
    snprintf(duration, sizeof duration, "%.9g", job->run->duration);
    const char *options[][2] = {{"--seed", seed},
                                {"--summary", summary},
                                {job->pictures ? "--report" : "--data", job->folder},
                                {job->run->dt > 0.0 ? "--dt" : NULL, dt},
                                {job->run->duration > 0.0 ? "--for" : NULL, duration}};
    for (size_t o = 0; o < sizeof options / sizeof *options; o++)
        if (options[o][0]) {
            arguments[n++] = options[o][0];
            arguments[n++] = options[o][1];
        }
    for (uint32_t s = 0; s < job->run->set_count && n + 3 < MOST_ARGUMENTS; s++) {
        arguments[n++] = "--set";
        arguments[n++] = job->run->sets[s];
    }
    job->state = JOX_JOB_RUNS;
    job->process = fork();
    if (job->process == 0) {
        setpgid(0, 0);                    /* Ctrl-C is for the parent, which stops all */
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* nothing is left running */
        int out = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
        if (out >= 0) {
            dup2(out, 1);
            dup2(out, 2);
        }
        execv(all->def->program, (char **)(uintptr_t)arguments);
        _exit(127);
    }
    if (job->process > 0) {
        setpgid(job->process, job->process); /* whoever comes first */
        jox_hold(job, stop);
    }
    jox_free(summary);
    jox_free(log);
}

static void end(JoxJob *job, int status) {
    jox_let_go(job);
    job->state = JOX_JOB_DONE;
    job->process = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        char *path = path_in(job, "run.txt");
        FILE *file = jox_file_replace(path);
        if (file) {
            fputs(job->key, file);
            jox_file_close(file);
        }
        jox_free(path);
        return;
    }
    job->state = JOX_JOB_FAILED;
    JoxText why = {0};
    char *log = read_in(job, "log.txt");
    jox_text_printf(&why, "%s, seed %llu: ", job->run->scene, (unsigned long long)job->seed);
    if (WIFSIGNALED(status))
        jox_text_printf(&why, "ended by signal %d. ", WTERMSIG(status));
    else
        jox_text_printf(&why, "ended with status %d. ", WEXITSTATUS(status));
    jox_text_printf(&why, "%.600s", log ? log : "");
    jox_free(log);
    job->failure = why.data;
}

static void show_progress(const JoxReproduction *all, double begun, bool last) {
    uint32_t done = 0, running = 0, reused = 0, failed = 0;
    for (uint32_t j = 0; j < all->job_count; j++) {
        done += all->jobs[j].state >= JOX_JOB_DONE;
        failed += all->jobs[j].state == JOX_JOB_FAILED;
        running += all->jobs[j].state == JOX_JOB_RUNS;
        reused += all->jobs[j].reused;
    }
    double spent = jox_clock_wall() - begun;
    double left = done > reused ? spent / (done - reused) * (double)(all->job_count - done) : NAN;
    static uint32_t shown; /* tenths */
    bool terminal = isatty(2);
    uint32_t tenth = all->job_count ? 10 * done / all->job_count : 10;
    if (all->def->quiet || (!terminal && tenth == shown))
        return;
    shown = tenth;
    fprintf(stderr, "%s%u of %u runs done (%u from before, %u failed), %u running, %.0f s%s",
            terminal ? "\r  " : "  ", done, all->job_count, reused, failed, running, spent,
            terminal ? "" : "\n");
    if (terminal && isfinite(left))
        fprintf(stderr, ", about %.0f s left   ", left);
    if (terminal && last)
        fputs("\n", stderr);
}

static bool comes_first(const JoxJob *a, const JoxJob *b) {
    return a->run->first && !b->run->first;
}

/* The next that waits: the long ones first, else in the order of the claims. */
static JoxJob *next_job(JoxReproduction *all) {
    JoxJob *next = NULL;
    for (uint32_t j = 0; j < all->job_count; j++) {
        JoxJob *job = &all->jobs[j];
        if (job->state == JOX_JOB_WAITS && (!next || comes_first(job, next)))
            next = job;
    }
    return next;
}

/* A job whose process has ended, or NULL; the program's other processes are not waited for. */
static JoxJob *ended_job(JoxReproduction *all, int *status) {
    for (uint32_t j = 0; j < all->job_count; j++)
        if (all->jobs[j].state == JOX_JOB_RUNS &&
            waitpid(all->jobs[j].process, status, WNOHANG) == all->jobs[j].process)
            return &all->jobs[j];
    return NULL;
}

static void stop_all(JoxReproduction *all) {
    for (uint32_t j = 0; j < all->job_count; j++)
        if (all->jobs[j].state == JOX_JOB_RUNS) {
            jox_let_go(&all->jobs[j]);
            stop(&all->jobs[j]);
        }
}

static void look_for_old(JoxReproduction *all) {
    JoxText error = {0};
    for (uint32_t j = 0; j < all->job_count; j++) {
        JoxJob *job = &all->jobs[j];
        if (!jox_plot_folder(job->folder, &error)) {
            job->state = JOX_JOB_FAILED;
            job->failure = jox_strdup(error.data);
            error.length = 0;
        } else if (!all->def->fresh && is_there(job)) {
            job->state = JOX_JOB_DONE;
            job->reused = true;
        }
    }
    jox_text_free(&error);
}

bool jox_reproduce_run(JoxReproduction *all) {
    double begun = jox_clock_wall();
    look_for_old(all);
    uint32_t running = 0;
    while (!interrupted(all)) {
        JoxJob *job = running < all->def->jobs ? next_job(all) : NULL;
        if (job) {
            start(all, job);
            running += job->process > 0;
            if (job->process < 0)
                end(job, 127 << 8);
            continue;
        }
        show_progress(all, begun, false);
        if (running == 0)
            break;
        int status;
        job = ended_job(all, &status);
        if (job) {
            end(job, status);
            running--;
        } else {
            usleep(50000);
        }
    }
    show_progress(all, begun, true);
    const bool whole = !interrupted(all);
    if (!whole)
        stop_all(all);
    return whole;
}
