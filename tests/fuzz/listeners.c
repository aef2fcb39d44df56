/* Edits what a listener stores in a checkpoint: the first byte chooses the listener, the rest is as
   in state.c. The checkpoint, with correct checksums, is resumed and run for a few steps, to an
   error or to figures and files; listeners must not change the world. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/mem.h"
#include "run/listener.h"
#include "run/resume/checkpoint.h"
#include "support/edits.h"
#include "support/fuzz.h"

/* A scene with each kind of probe, each of which measures something. */
static const char SCENE[] =
    "jostle: 1\n"
    "seed: 1\n"
    "places:\n"
    "  goal: {point: [3.2, 0.8], radius: 0.3}\n"
    "  out: {polygon: [[2.8, 1.8], [3.5, 1.8], [3.5, 2.3], [2.8, 2.3]]}\n"
    "regions: {half: [[0, 0], [1.8, 0], [1.8, 2.4], [0, 2.4]]}\n"
    "walls:\n"
    "  - {line: [[0, 0], [3.6, 0], [3.6, 2.4], [0, 2.4]], closed: true}\n"
    "  - {line: [[2, 1.8], [2, 2.4]], name: gate}\n"
    "bodies:\n"
    "  - {name: ball, at: [0.7, 1.2, 0.12], shape: {sphere: {radius: 0.12}}, mass: 0.5,"
    " velocity: [1, 0, 0], tags: [ball]}\n"
    "groups:\n"
    "  there: {behaviour: own.lua, at: [[0.5, 0.5], [0.5, 1], [1.2, 1.2], [1.2, 0.6]]}\n"
    "  back: {behaviour: own.lua, at: [[2.8, 0.6], [2.4, 1.2]], set: {aim: out}}\n"
    "sources: [{at: goal, like: there, every: 1, people: 1}]\n"
    "sinks: [{at: out}]\n"
    "probes:\n"
    "  door: {flow: [[1.8, 0], [1.8, 2.4]]}\n"
    "  front: {measure: [[0, 0], [2, 0], [2, 2], [0, 2]], every: 0.2, during: [[1.8, 0], [1.8, "
    "2.4]]}\n"
    "  passage: {transit: [[[1, 0], [1, 2.4]], [[2, 0], [2, 2.4]]]}\n"
    "  block: {displacement: true, rest: 0.1, along: [1, 0]}\n"
    "  pieces: {bodies: true}\n"
    "  fields: {map: {area: [[0, 0], [3.6, 2.4]], cell: 0.6}, every: 0.2}\n"
    "  laps: {winding: [1.8, 1.2]}\n"
    "  solved: {failures: 0.2}\n"
    "  order: {lanes: {area: [[0, 0], [3.6, 2.4]], rows: 0.8}, every: 0.1}\n"
    "  swirl: {oscillation: {area: [[0, 0], [3.6, 2.4]], span: 1}, every: 0.1}\n"
    "  arrival: {visit: [Walk, Stay]}\n"
    "  actions: {log: true}\n";
static const char BEHAVIOUR[] =
    "return machine { name = \"m\", version = 1, start = \"Walk\", own = { aim = \"goal\" },\n"
    "  defaults = { speed = normal(1.3, 0.2), push = uniform(0, 60), perception = 3 },\n"
    "  states = {\n"
    "    Walk = { steer = seek(own.aim), lasts = 0.6, { to = \"Stay\", when = lasted } },\n"
    "    Stay = { steer = hold, lasts = 0.2, { to = \"Walk\", when = lasted } } } }\n";

enum { BEGINNING = 128, STEPS = 3 };

static JoxText checkpoint;    /* the file */
static JoxText recording;     /* its bytes */
static const char *names[32]; /* of the listeners in it */
static uint32_t name_count;
static uint64_t later_hash;

static void read_into(const char *path, JoxText *out) {
    enum { LARGEST = 1 << 24 };
    size_t length = 0;
    char *bytes = jox_read_file(path, LARGEST, &length);
    FUZZ_CHECK(bytes);
    jox_text_append(out, bytes, length);
    jox_free(bytes);
}

/* Replaces gnuplot, which is not tested, by a program that does nothing. */
static void replace_gnuplot(void) {
    fuzz_write("bin/none", "", 0);
    FUZZ_CHECK(symlink("/bin/true", fuzz_path("bin/gnuplot")) == 0);
    setenv("PATH", fuzz_path("bin"), 1);
}

static void list_names(void) {
    char why[200];
    JoxPiece piece;
    for (size_t at = 0; jox_pieces_next(&checkpoint, &at, &piece, why);)
        if (strcmp(piece.name, JOX_PIECE_LISTENER) == 0 && name_count < 32)
            names[name_count++] = piece.data;
    FUZZ_CHECK(name_count > 5);
}

static void free_checkpoint(void) {
    jox_text_free(&checkpoint);
    jox_text_free(&recording);
}

static JoScene *resume_bytes(const JoxText *file, JoError *error) {
    JoSceneDef def = jo_default_scene_def();
    char *note = NULL;
    def.message = ignore_message;
    JoScene *scene =
        jo_scene_resume(&def, fuzz_write("one.checkpoint", file->data, file->length), &note, error);
    jo_free(note);
    return scene;
}

/* Attaches the listeners. Drawing a report takes a second, so it is not attached for edits of
 * others. */
static bool attach_listeners(JoScene *scene, bool report, JoError *error) {
    fuzz_write("r.sqlite", recording.data, recording.length);
    return jo_scene_record_on(scene, fuzz_path("r.sqlite"), error) &&
           (!report || jo_scene_report(scene, fuzz_path("report"), error)) &&
           jo_scene_data(scene, fuzz_path("data"), error);
}

static void write_checkpoint_once(void) {
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    fuzz_write("own.lua", BEHAVIOUR, strlen(BEHAVIOUR));
    replace_gnuplot();
    def.path = fuzz_path("scene.yaml");
    def.text = SCENE;
    def.text_length = strlen(SCENE);
    def.message = ignore_message;
    def.named_mods_only = def.resumable = true;
    def.threads = 1;
    JoScene *scene = jo_scene_load(&def, &error);
    FUZZ_CHECK(scene && jo_scene_record(scene, fuzz_path("first.sqlite"), 0.1, &error));
    FUZZ_CHECK(jo_scene_report(scene, fuzz_path("report"), &error));
    FUZZ_CHECK(jo_scene_data(scene, fuzz_path("data"), &error));
    FUZZ_CHECK(jo_scene_checkpoint(scene, fuzz_path("kept"), 0.05, "", &error));
    for (int s = 0; s < BEGINNING; s++)
        FUZZ_CHECK(jo_scene_step(scene, &error));
    read_into(fuzz_path("kept/" JOX_CHECKPOINT_LATEST), &checkpoint);
    jo_scene_finish(scene, &error);
    jo_scene_free(scene);
    read_into(fuzz_path("first.sqlite"), &recording);
    list_names();
    FUZZ_CHECK((scene = resume_bytes(&checkpoint, &error)));
    for (int s = 0; s < STEPS; s++)
        FUZZ_CHECK(jo_scene_step(scene, &error));
    later_hash = jo_world_hash(jo_scene_world(scene));
    jo_scene_free(scene);
    atexit(free_checkpoint);
}

/* ---- one input ---- */

/* Visits the sections of the listener named `context`, in a resumed scene. */
static void visit_listener_sections(void *context, JoxSections *sections) {
    JoError error = {0};
    JoScene *scene = resume_bytes(&checkpoint, &error);
    if (!scene || !attach_listeners(scene, true, &error))
        abort();
    for (uint32_t l = 0; l < scene->listeners.count; l++) {
        const JoxListener *listener = &scene->listeners.items[l];
        if (strcmp(listener->kind->name, context) == 0)
            listener->kind->sections(listener->self, sections);
    }
    jo_scene_free(scene);
}

/* Copies the checkpoint, with edits of the sections of one listener. */
static void edit_listener(const char *name, const uint8_t *data, size_t size, JoxText *out) {
    char why[200];
    JoxPiece piece;
    jox_pieces_begin(out);
    for (size_t at = 0; jox_pieces_next(&checkpoint, &at, &piece, why);) {
        if (piece.data != name) {
            jox_pieces_add(out, piece.name, piece.data, piece.length);
            continue;
        }
        const size_t head = strlen(name) + 1;
        JoxText sections = {0}, whole = {0};
        jox_text_append(&sections, piece.data + head, piece.length - head);
        if (getenv("FUZZ_SHOW"))
            fprintf(stderr, "of the %s:\n", name);
        fuzz_edit(&sections, data, size, visit_listener_sections, (void *)(uintptr_t)name);
        jox_text_append(&whole, name, head);
        jox_text_append(&whole, sections.data, sections.length);
        jox_pieces_add(out, piece.name, whole.data, whole.length);
        jox_text_free(&sections);
        jox_text_free(&whole);
    }
    jox_pieces_end(out);
}

static void run_resumed(JoScene *scene, bool report, bool draw) {
    JoError error = {0};
    bool good = attach_listeners(scene, report, &error);
    FUZZ_CHECK(good || *error.text);
    for (int s = 0; good && s < STEPS; s++)
        good = jo_scene_step(scene, &error);
    FUZZ_CHECK(good || *error.text);
    FUZZ_CHECK(!good || jo_world_hash(jo_scene_world(scene)) == later_hash);
    jo_free(jo_scene_summary(scene));
    for (uint32_t p = 0; jo_scene_probe_name(scene, p); p++)
        jo_free(jo_scene_probe_table(scene, p));
    FUZZ_CHECK((report && !draw) || jo_scene_finish(scene, &error) || *error.text);
}

/* Ignores memory that the library of fonts keeps. */
__attribute__((visibility("default"))) const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:libfontconfig";
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoError error = {0};
    JoxText file = {0};
    if (!name_count)
        write_checkpoint_once();
    if (!size)
        return 0;
    const char *name = names[data[0] % name_count];
    edit_listener(name, data + 1, size - 1, &file);
    JoScene *scene = resume_bytes(&file, &error);
    FUZZ_CHECK(scene || *error.text);
    if (getenv("FUZZ_SHOW"))
        fprintf(stderr, "%s\n", scene ? "it goes on" : error.text);
    if (scene)
        run_resumed(scene, strcmp(name, "report") == 0, data[0] > 230);
    jo_scene_free(scene);
    jox_text_free(&file);
    return 0;
}
