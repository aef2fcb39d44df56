/* Resumes any bytes as a checkpoint, as they are and with correct checksums: what lies behind the
   checksums must not be trusted either. */
#include <stdlib.h>
#include <string.h>

#include "base/format/piece_file.h"
#include "base/mem.h"
#include "support/fuzz.h"

static void resume_file(const void *data, size_t size) {
    JoSceneDef def = jo_default_scene_def();
    JoError error = {0};
    char *note = NULL;
    def.message = ignore_message;
    JoScene *scene = jo_scene_resume(&def, fuzz_write("f.checkpoint", data, size), &note, &error);
    FUZZ_CHECK(scene || *error.text);
    jo_free(note);
    fuzz_run(scene, 3);
}

/* Copies the pieces, with the names and lengths that they claim, into a well-formed file. */
static void copy_pieces(const uint8_t *data, size_t size, JoxText *out) {
    enum {
        HEAD = 40,
        PIECE = 32,
        NAME = 16
    }; /* bytes of a file's head, of a piece's head, of a name */
    jox_pieces_begin(out);
    for (size_t at = HEAD; at + PIECE < size;) {
        char name[NAME] = {0};
        uint64_t length;
        memcpy(name, data + at, NAME - 1);
        memcpy(&length, data + at + NAME, sizeof length);
        length = length < size - at - PIECE ? length : size - at - PIECE;
        if (strcmp(name, "end") != 0)
            jox_pieces_add(out, name, data + at + PIECE, length);
        at += PIECE + length + 1;
    }
    jox_pieces_end(out);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoxText mended = {0};
    resume_file(data, size);
    copy_pieces(data, size, &mended);
    resume_file(mended.data, mended.length);
    jox_text_free(&mended);
    return 0;
}
