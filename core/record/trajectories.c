/* Turns the rows of a recording into frames: sorts them, gives people keys and measures
   velocities. Reads text files, too. */
#include "record/trajectories.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/sort.h"

static const double REACH = 0.2;   /* s: velocities are displacements from -REACH to +REACH */
static const double LONGEST = 1e9; /* s: latest time of a frame */
static const int64_t LARGEST_KEY = 1 << 22; /* with an id at or above this, keys are ranks */
static const size_t LARGEST = 2000000000;   /* bytes: largest text file */

/* ---- order ---- */

typedef struct Place {
    int64_t frame, id;
    size_t row;
} Place;

static int compare_row_frames(const void *a, const void *b, const void *context) {
    (void)context;
    const Place *p = a, *q = b;
    if (p->frame != q->frame)
        return p->frame < q->frame ? -1 : 1;
    return (p->id > q->id) - (p->id < q->id);
}

static int compare_row_ids(const void *a, const void *b, const void *context) {
    (void)context;
    const Place *p = a, *q = b;
    if (p->id != q->id)
        return p->id < q->id ? -1 : 1;
    return (p->frame > q->frame) - (p->frame < q->frame);
}

/* Reorders column `name` by the rows in `places`. */
#define PERMUTE(name)                                                                              \
    if (t->name) {                                                                                 \
        void *fresh = jox_alloc(t->count, sizeof *t->name);                                        \
        for (size_t i = 0; i < t->count; i++)                                                      \
            memcpy((char *)fresh + i * sizeof *t->name, &t->name[places[i].row], sizeof *t->name); \
        jox_free(t->name);                                                                         \
        t->name = fresh;                                                                           \
    }

static void permute_columns(JoxTrajectories *t, const Place *places) {
    PERMUTE(number)
    PERMUTE(id)
    PERMUTE(line)
    PERMUTE(x)
    PERMUTE(y)
    PERMUTE(vx)
    PERMUTE(vy)
    PERMUTE(force)
    PERMUTE(compression)
    PERMUTE(load)
    PERMUTE(radius)
    PERMUTE(axis_x)
    PERMUTE(axis_y)
    PERMUTE(contact_radius)
    PERMUTE(fallen)
    PERMUTE(group)
    PERMUTE(state)
    PERMUTE(face_x)
    PERMUTE(face_y)
}

/* Returns whether every frame has a time that probes can count in; false adds an error. */
static bool check_frame_times(const JoxTrajectories *t, const char *path,
                              JoxDiagnostics *diagnostics) {
    for (size_t i = 0; i < t->count; i++) {
        if (fabs((double)t->number[i]) / t->fps <= LONGEST)
            continue;
        JoxPosition at = {path, (int)t->line[i], t->line[i] ? 1 : 0, 0};
        jox_diag_error(diagnostics, at, "bad-recording", "Are id and frame exchanged?",
                       "frame %lld is more than 30 years from the first at %g frames a second",
                       (long long)t->number[i], t->fps);
        return false;
    }
    return true;
}

/* Sorts rows by frame and finds where each frame begins. Returns false with an error if a person is
   in a frame twice. */
static bool sort_frames(JoxTrajectories *t, Place *places, const char *path,
                        JoxDiagnostics *diagnostics) {
    for (size_t i = 0; i < t->count; i++)
        places[i] = (Place){t->number[i], t->id[i], i};
    jox_sort(places, t->count, sizeof *places, compare_row_frames, NULL, NULL);
    permute_columns(t, places);
    t->first = jox_alloc(t->count + 1, sizeof *t->first);
    for (size_t i = 0; i < t->count; i++) {
        if (i == 0 || t->number[i] != t->number[i - 1]) {
            t->first[t->frame_count++] = i;
        } else if (t->id[i] == t->id[i - 1]) {
            uint32_t later = t->line[i] > t->line[i - 1] ? t->line[i] : t->line[i - 1];
            JoxPosition at = {path, (int)later, later ? 1 : 0, 0};
            jox_diag_error(diagnostics, at, "bad-recording", NULL,
                           "person %lld is in frame %lld twice", (long long)t->id[i],
                           (long long)t->number[i]);
            return false;
        }
    }
    t->first[t->frame_count] = t->count;
    return true;
}

/* ---- keys and velocities ---- */

/* Gives each person a key. Sorts `places` by person, then frame; `row` then refers to the sorted
   columns. */
static void number_people(JoxTrajectories *t, Place *places) {
    for (size_t i = 0; i < t->count; i++)
        places[i] = (Place){t->number[i], t->id[i], i};
    jox_sort(places, t->count, sizeof *places, compare_row_ids, NULL, NULL);
    bool plain = places[0].id >= 0 && places[t->count - 1].id < LARGEST_KEY;
    t->key = jox_alloc(t->count, sizeof *t->key);
    for (size_t i = 0; i < t->count; i++) {
        t->people += i == 0 || places[i].id != places[i - 1].id;
        t->key[places[i].row] = plain ? (uint32_t)places[i].id : t->people - 1;
    }
    t->keys = plain ? (uint32_t)places[t->count - 1].id + 1 : t->people;
}

/* Returns a difference over the shorter way across a periodic edge, m. */
static double wrap_difference(double d, double period) {
    return period > 0.0 ? remainder(d, period) : d;
}

/* Returns a difference along y, m: over the shorter way, and without whole pitches between sheets.
 */
static double wrap_along_y(const JoxTrajectories *t, double d) {
    return wrap_difference(d,
                           jox_has_storeys(&t->storeys) ? (double)t->storeys.pitch : t->period.y);
}

/* Sets velocities to the displacement between the person's first and last rows within REACH, or
   between the adjacent rows if there are none within it. */
static void measure_velocities(JoxTrajectories *t, const Place *places) {
    int64_t reach = (int64_t)floor(REACH * t->fps + 0.5);
    reach = reach > 0 ? reach : 1;
    size_t low = 0, high = 0;
    for (size_t i = 0; i < t->count; i++) {
        while (places[low].id != places[i].id || places[i].frame - places[low].frame > reach)
            low++;
        high = high < i ? i : high;
        while (high + 1 < t->count && places[high + 1].id == places[i].id &&
               places[high + 1].frame - places[i].frame <= reach)
            high++;
        size_t from = low, to = high;
        if (from == i && to == i) { /* no other row within REACH */
            from -= i > 0 && places[i - 1].id == places[i].id;
            to += i + 1 < t->count && places[i + 1].id == places[i].id;
        }
        double spent = (double)(places[to].frame - places[from].frame) / t->fps;
        size_t row = places[i].row, a = places[from].row, b = places[to].row;
        t->vx[row] =
            spent > 0.0 ? (float)(wrap_difference(t->x[b] - t->x[a], t->period.x) / spent) : 0.0f;
        t->vy[row] = spent > 0.0 ? (float)(wrap_along_y(t, t->y[b] - t->y[a]) / spent) : 0.0f;
    }
}

static bool read_text_file(JoxTrajectories *t, const char *path,
                           const JoxTrajectoryOptions *options, JoxDiagnostics *diagnostics) {
    size_t length;
    char *text = jox_read_file(path, LARGEST, &length);
    if (!text) {
        JoxPosition at = {path, 0, 0, 0};
        jox_diag_error(diagnostics, at, "unreadable-file", NULL, "cannot be read: %s",
                       jox_file_error_text(errno));
        return false;
    }
    /* Comments of other programs may be in any 8-bit encoding; zero bytes show UTF-16, which is
       refused. */
    bool good = !memchr(text, 0, length) || jox_diag_check_text(diagnostics, path, text, length);
    good = good && jox_trajectories_add_text(t, path, text, length, options, diagnostics);
    jox_diag_attach_source(diagnostics, path, text, length);
    jox_free(text);
    return good;
}

bool jox_trajectories_finish(JoxTrajectories *t, const char *path, JoxDiagnostics *diagnostics) {
    if (!check_frame_times(t, path, diagnostics))
        return false;
    Place *places = jox_alloc(t->count, sizeof *places);
    const bool good = sort_frames(t, places, path, diagnostics);
    if (good) {
        number_people(t, places);
        if (t->last < t->number[t->count - 1] || (double)t->last / t->fps > LONGEST)
            t->last = t->number[t->count - 1];
        if (!t->has_velocity)
            measure_velocities(t, places);
        t->low = t->high = (JoxV2){t->x[0], t->y[0]};
        for (size_t i = 0; i < t->count; i++) {
            t->low = jox_v2(jox_minf(t->low.x, t->x[i]), jox_minf(t->low.y, t->y[i]));
            t->high = jox_v2(jox_maxf(t->high.x, t->x[i]), jox_maxf(t->high.y, t->y[i]));
        }
    }
    jox_free(places);
    jox_free(t->id);
    jox_free(t->line);
    t->id = NULL;
    t->line = NULL;
    return good;
}

JoxTrajectories *jox_trajectories_read_text(const char *path, const JoxTrajectoryOptions *options,
                                            JoxDiagnostics *diagnostics) {
    JoxTrajectories *t = jox_alloc(1, sizeof *t);
    t->period = options->period;
    if (read_text_file(t, path, options, diagnostics) &&
        jox_trajectories_finish(t, path, diagnostics))
        return t;
    jox_trajectories_free(t);
    return NULL;
}
