/* Executes the jobs of jo_reproduce, each as a process: several at once, long ones first, none
   that was done before. */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "base/format/json.h"
#include "base/mem.h"
#include "picture/plot.h"
#include "validate/reproduce.h"

enum { MOST_ARGUMENTS = 200 };

static bool is_interrupted(const JoxReproduction *all) {
    const volatile int *stop = all->def->stop;
    return stop && __atomic_load_n(stop, __ATOMIC_RELAXED);
}

/* Returns the path of a file in the job's folder, for the caller to free. */
static char *make_job_path(const JoxJob *job, const char *name) {
    JoxText path = {0};
    jox_text_printf(&path, "%s/%s", job->folder, name);
    return path.data;
}

char *jox_job_read(const JoxJob *job, const char *name) {
    size_t length;
    char *path = make_job_path(job, name), *text = jox_read_file(path, (size_t)16 << 20, &length);
    jox_free(path);
    return text;
}

/* Comparison of the inputs that a summary lists with the files on disk. */
typedef struct Inputs {
    char *path;     /* "path" of the entry being read */
    bool any, hold; /* there are inputs; all are unchanged */
} Inputs;

/* Handles an item of a summary's "inputs": [{"path": "...", "sha256": "..."}, ...]; compares
   each file with its hash. */
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

/* Returns whether the files that the summary lists are unchanged. */
static bool has_same_inputs(const char *summary) {
    Inputs inputs = {.hold = true};
    bool read = jox_json_read(summary, jox_json_own_files, compare_input, &inputs);
    jox_free(inputs.path);
    return read && inputs.any && inputs.hold;
}

/* Ends the run.txt of a job that wrote its report with pictures. */
static const char PICTURES[] = "pictures\n";

/* Returns whether an earlier call did this job with the same program and files, and with its
   pictures if it needs them. */
static bool is_done_before(const JoxJob *job) {
    char *key = jox_job_read(job, "run.txt"), *summary = jox_job_read(job, "summary.json");
    const size_t length = strlen(job->key);
    bool there = key && summary && strncmp(key, job->key, length) == 0 &&
                 (strcmp(key + length, PICTURES) == 0 || (!key[length] && !job->pictures)) &&
                 has_same_inputs(summary);
    jox_free(key);
    jox_free(summary);
    return there;
}

/* Deletes what an earlier run left, so that neither files of removed probes nor half a run are
   measured. */
static void clear_job_folder(const JoxJob *job) {
    char **names = jox_folder_names(job->folder, false);
    for (char **name = names; name && *name; name++) {
        char *path = make_job_path(job, *name);
        remove(path);
        jox_free(path);
    }
    jox_free(names);
}

/* Kills the job's process group, including a gnuplot that it started. Also runs when the call is
   aborted (base/mem.h). */
static void kill_job(void *running) {
    JoxJob *job = running;
    kill(-job->process, SIGKILL);
    while (waitpid(job->process, NULL, 0) < 0 && errno == EINTR)
        continue;
}

/* Starts the job's process: `jostle run` with the run's options, its output to log.txt. */
static void start_job(const JoxReproduction *all, JoxJob *job) {
    char seed[32], dt[32], duration[32];
    const char *arguments[MOST_ARGUMENTS] = {all->def->program, "run",       job->run->scene,
                                             "--quiet",         "--no-mods", "--no-watch",
                                             "--threads",       "1",         "--no-half-step"};
    int n = 9;
    char *summary = make_job_path(job, "summary.json"), *log = make_job_path(job, "log.txt");
    clear_job_folder(job);
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
        /* Ctrl-C must reach only the parent, which stops all jobs */
        setpgid(0, 0);
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a job does not outlive the parent */
        int out = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
        if (out >= 0) {
            dup2(out, 1);
            dup2(out, 2);
        }
        execv(all->def->program, (char **)(uintptr_t)arguments);
        _exit(127);
    }
    if (job->process > 0) {
        setpgid(job->process, job->process); /* done in parent and child, as either may run first */
        jox_heap_register(job, kill_job);
    }
    jox_free(summary);
    jox_free(log);
}

/* Records how the job's process ended: run.txt with the key on success, else the failure. */
static void finish_job(JoxJob *job, int status) {
    jox_heap_unregister(job);
    job->state = JOX_JOB_DONE;
    job->process = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        char *path = make_job_path(job, "run.txt");
        FILE *file = jox_file_replace(path);
        if (file) {
            fprintf(file, "%s%s", job->key, job->pictures ? PICTURES : "");
            jox_file_close(file);
        }
        jox_free(path);
        return;
    }
    job->state = JOX_JOB_FAILED;
    JoxText why = {0};
    char *log = jox_job_read(job, "log.txt");
    jox_text_printf(&why, "%s, seed %llu: ", job->run->scene, (unsigned long long)job->seed);
    if (WIFSIGNALED(status))
        jox_text_printf(&why, "ended by signal %d. ", WTERMSIG(status));
    else
        jox_text_printf(&why, "ended with status %d. ", WEXITSTATUS(status));
    jox_text_printf(&why, "%.600s", log ? log : "");
    jox_free(log);
    job->failure = why.data;
}

/* Writes a line of progress to stderr: always on a terminal, else at each tenth of the jobs. */
static void show_run_progress(const JoxReproduction *all, double begun, bool last) {
    uint32_t done = 0, running = 0, reused = 0, failed = 0;
    for (uint32_t j = 0; j < all->job_count; j++) {
        done += all->jobs[j].state >= JOX_JOB_DONE;
        failed += all->jobs[j].state == JOX_JOB_FAILED;
        running += all->jobs[j].state == JOX_JOB_RUNS;
        reused += all->jobs[j].reused;
    }
    double spent = jox_clock_wall() - begun;
    double left = done > reused ? spent / (done - reused) * (double)(all->job_count - done) : NAN;
    static uint32_t shown; /* tenths of the jobs in the last line */
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

/* Returns whether job a must start before job b: long runs go first. */
static bool goes_before(const JoxJob *a, const JoxJob *b) {
    return a->run->first && !b->run->first;
}

/* Returns the next waiting job, long ones first, else in the order of the claims; NULL if there
   is none. */
static JoxJob *find_next_job(JoxReproduction *all) {
    JoxJob *next = NULL;
    for (uint32_t j = 0; j < all->job_count; j++) {
        JoxJob *job = &all->jobs[j];
        if (job->state == JOX_JOB_WAITS && (!next || goes_before(job, next)))
            next = job;
    }
    return next;
}

/* Returns a job whose process has ended, or NULL, without waiting. Other child processes of the
   program are left alone. */
static JoxJob *find_ended_job(JoxReproduction *all, int *status) {
    for (uint32_t j = 0; j < all->job_count; j++)
        if (all->jobs[j].state == JOX_JOB_RUNS &&
            waitpid(all->jobs[j].process, status, WNOHANG) == all->jobs[j].process)
            return &all->jobs[j];
    return NULL;
}

static void kill_all_jobs(JoxReproduction *all) {
    for (uint32_t j = 0; j < all->job_count; j++)
        if (all->jobs[j].state == JOX_JOB_RUNS) {
            jox_heap_unregister(&all->jobs[j]);
            kill_job(&all->jobs[j]);
        }
}

/* Creates the jobs' folders and marks the jobs that were done before. */
static void find_finished_jobs(JoxReproduction *all) {
    JoxText error = {0};
    for (uint32_t j = 0; j < all->job_count; j++) {
        JoxJob *job = &all->jobs[j];
        if (!jox_plot_folder(job->folder, &error)) {
            job->state = JOX_JOB_FAILED;
            job->failure = jox_strdup(error.data);
            error.length = 0;
        } else if (!all->def->fresh && is_done_before(job)) {
            job->state = JOX_JOB_DONE;
            job->reused = true;
        }
    }
    jox_text_free(&error);
}

bool jox_reproduce_run(JoxReproduction *all) {
    double begun = jox_clock_wall();
    find_finished_jobs(all);
    uint32_t running = 0;
    while (!is_interrupted(all)) {
        JoxJob *job = running < all->def->jobs ? find_next_job(all) : NULL;
        if (job) {
            start_job(all, job);
            running += job->process > 0;
            if (job->process < 0)
                finish_job(job, 127 << 8);
            continue;
        }
        show_run_progress(all, begun, false);
        if (running == 0)
            break;
        int status;
        job = find_ended_job(all, &status);
        if (job) {
            finish_job(job, status);
            running--;
        } else {
            usleep(50000);
        }
    }
    show_run_progress(all, begun, true);
    const bool whole = !is_interrupted(all);
    if (!whole)
        kill_all_jobs(all);
    return whole;
}
