/* The file of a checkpoint: a list of named pieces, each with its checksum. Its bytes are those of
   this machine; it is no format for other machines. */
#ifndef JOX_BASE_FORMAT_PIECES_H
#define JOX_BASE_FORMAT_PIECES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

typedef struct JoxPiece {
    const char *name; /* up to 15 bytes */
    const char *data; /* a zero follows it */
    size_t length;
} JoxPiece;

/* Begins a file; adds a piece; ends it. */
void jox_pieces_begin(JoxText *out);
void jox_pieces_add(JoxText *out, const char *name, const void *data, size_t length);
void jox_pieces_end(JoxText *out);

/* The piece that begins at *at, which moves on behind it; begin with 0. False behind the last, or
   with what is wrong in `why` (200 bytes), which is "" otherwise. */
bool jox_pieces_next(const JoxText *file, size_t *at, JoxPiece *piece, char why[200]);

#endif
