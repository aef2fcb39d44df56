/* The file format of checkpoints: a head and a list of named pieces, each with a checksum. Numbers
   are in this machine's representation: a checkpoint cannot be moved to another kind of machine. */
#ifndef JOX_BASE_FORMAT_PIECE_FILE_H
#define JOX_BASE_FORMAT_PIECE_FILE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

typedef struct JoxPiece {
    const char *name; /* up to 15 bytes */
    const char *data; /* a zero follows it */
    size_t length;
} JoxPiece;

/* Write a file to `out`: its head, pieces, and its end. */
void jox_pieces_begin(JoxText *out);
void jox_pieces_add(JoxText *out, const char *name, const void *data, size_t length);
void jox_pieces_end(JoxText *out);

/* Reads the piece at offset *at, 0 for the first, and advances *at to the next one. The piece
   points into the file. False behind the last piece, with `why` "", or with an error in `why`. */
bool jox_pieces_next(const JoxText *file, size_t *at, JoxPiece *piece, char why[200]);

#endif
