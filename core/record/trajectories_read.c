/* Reads a whole recording into memory: a text file, or all frames of an SQLite file by the
   trajectory reader. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "record/table_rows.h"
#include "record/trajectories.h"
#include "record/trajectory_reader_parts.h"

static bool add_recording_error(JoxDiagnostics *diagnostics, const char *path, const char *hint,
                                const char *message) {
    JoxPosition at = {path, 0, 0, 0};
    jox_diag_error(diagnostics, at, "bad-recording", hint, "%s", message);
    return false;
}

/* Builds the names of states. The first, "", is for people without a machine; with several machines
   the machine's name stands before the state's. */
static void build_recorded_state_names(JoxTrajectories *t, const JoxTrajectoryReader *r) {
    bool several = false;
    if (r->state_count == 0)
        return;
    t->states = jox_alloc(r->state_count + 1, sizeof *t->states);
    t->state_colours = jox_alloc(r->state_count + 1, sizeof *t->state_colours);
    t->states[t->state_count++] = jox_strdup("");
    for (uint32_t s = 1; s < r->state_count; s++)
        several |= strcmp(r->states[s].machine, r->states[0].machine) != 0;
    for (uint32_t s = 0; s < r->state_count; s++) {
        JoxText name = {0};
        if (several)
            jox_text_printf(&name, "%s: ", r->states[s].machine);
        jox_text_add(&name, r->states[s].name);
        t->state_colours[t->state_count] = r->states[s].colour;
        t->states[t->state_count++] = name.data ? name.data : jox_strdup("");
    }
}

/* Makes room for `need` rows in the columns that only our recordings have. */
enum { OWN = 12 }; /* number of such columns */
static void reserve_own_columns(JoxTrajectories *t, const JoxTrajectoryReader *r,
                                size_t capacities[OWN], size_t need) {
    JOX_RESERVE(t->force, capacities[0], need);
    JOX_RESERVE(t->compression, capacities[1], need);
    if (r->loads)
        JOX_RESERVE(t->load, capacities[6], need);
    if (r->radii)
        JOX_RESERVE(t->radius, capacities[7], need);
    if (r->torsos) {
        JOX_RESERVE(t->axis_x, capacities[8], need);
        JOX_RESERVE(t->axis_y, capacities[9], need);
        JOX_RESERVE(t->contact_radius, capacities[10], need);
    }
    if (r->falls)
        JOX_RESERVE(t->fallen, capacities[11], need);
    JOX_RESERVE(t->group, capacities[2], need);
    JOX_RESERVE(t->face_x, capacities[3], need);
    JOX_RESERVE(t->face_y, capacities[4], need);
    if (t->state_count)
        JOX_RESERVE(t->state, capacities[5], need);
}

/* Adds person i of a frame as a row; our own recordings have more columns. */
static void add_person_row(JoxTrajectories *t, const JoxTrajectoryReader *r, uint32_t frame,
                           const JoxTrajectoryReaderFrame *f, uint32_t i, size_t capacities[OWN]) {
    const size_t row = jox_trajectories_add_row(t);
    t->number[row] = r->number[frame];
    t->id[row] = f->id[i];
    t->line[row] = 0;
    t->x[row] = f->x[i];
    t->y[row] = f->y[i];
    t->vx[row] = t->vy[row] = 0.0f;
    if (!r->ours)
        return;
    reserve_own_columns(t, r, capacities, row + 1);
    t->force[row] = f->force[i];
    t->compression[row] = f->compression[i];
    if (f->load)
        t->load[row] = f->load[i];
    if (f->radius)
        t->radius[row] = f->radius[i];
    if (r->torsos) {
        t->axis_x[row] = r->axis_x[i];
        t->axis_y[row] = r->axis_y[i];
        t->contact_radius[row] = r->contact_radius[i];
    }
    if (r->falls)
        t->fallen[row] = f->fallen[i];
    t->group[row] = f->group[i];
    t->face_x[row] = f->face_x[i];
    t->face_y[row] = f->face_y[i];
    if (t->state)
        t->state[row] = f->state[i] == JOX_NO_RECORDED_STATE ? 0 : f->state[i] + 1;
}

static bool read_all_frames(JoxTrajectories *t, JoxTrajectoryReader *r, const char *path,
                            JoxDiagnostics *diagnostics) {
    size_t capacities[OWN] = {0};
    JoxText why = {0};
    bool good = true;
    for (uint32_t frame = 0; good && frame < r->frames; frame++) {
        JoxTrajectoryReaderFrame f;
        good = jox_trajectory_reader_read_people(r, frame, &f, &why);
        for (uint32_t i = 0; good && i < f.count; i++)
            add_person_row(t, r, frame, &f, i, capacities);
    }
    if (!good)
        add_recording_error(diagnostics, path, JOX_ROW_HINT, why.data);
    jox_text_free(&why);
    return good && (t->count > 0 ||
                    add_recording_error(diagnostics, path, NULL, "nobody is in this recording"));
}

JoxTrajectories *jox_trajectories_read(const char *path, const JoxTrajectoryOptions *options,
                                       JoxDiagnostics *diagnostics) {
    if (!jox_is_sqlite(path))
        return jox_trajectories_read_text(path, options, diagnostics);
    JoxTrajectoryReader *r = jox_trajectory_reader_open(path, options, diagnostics);
    if (!r)
        return NULL;
    JOX_ASSERT(!r->in_memory && r->frames > 0 && r->fps > 0.0);
    JoxTrajectories *t = jox_alloc(1, sizeof *t);
    t->period = options->period;
    t->fps = r->fps;
    t->last = r->last;
    build_recorded_state_names(t, r);
    jox_storeys_copy(&t->storeys, &r->outlines.storeys);
    t->lifts = r->outlines.lifts;
    r->outlines.lifts = NULL;
    JoxText why = {0}; /* none: the reader has read the walls before */
    const bool good = read_all_frames(t, r, path, diagnostics) &&
                      jox_trajectories_read_walls(t, r->db, &why) &&
                      jox_trajectories_finish(t, path, diagnostics);
    jox_text_free(&why);
    jox_trajectory_reader_close(r);
    if (good)
        return t;
    jox_trajectories_free(t);
    return NULL;
}
