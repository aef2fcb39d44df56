/* Names and structs of checkpoint files, for their writer and their reader. A file is a list of
   pieces with checksums (base/format/piece_file.h). */
#ifndef JOX_RUN_RESUME_CHECKPOINT_H
#define JOX_RUN_RESUME_CHECKPOINT_H

#include "base/format/piece_file.h"
#include "run/run.h"

#define JOX_CHECKPOINT_LATEST "latest.checkpoint"
#define JOX_CHECKPOINT_BEFORE "before.checkpoint"

/* Names of pieces, besides JOX_PIECE_LISTENER. The content of JOX_PIECE_FILE is a path, a zero and
   the text. */
#define JOX_PIECE_NUMBERS "numbers"
#define JOX_PIECE_PATH "path"
#define JOX_PIECE_INPUT "input"
#define JOX_PIECE_SET "set"
#define JOX_PIECE_MOD "mod"
#define JOX_PIECE_NOTE "note"
#define JOX_PIECE_FILE "file"
#define JOX_PIECE_STATE "state"

/* Content of JOX_PIECE_NUMBERS. */
typedef struct JoxCheckpointNumbers {
    uint64_t tick, hash, seed;
    uint64_t log_length; /* bytes of the input log at this tick */
    double dt;           /* s */
    uint32_t has_seed, has_dt, no_density, unused;
} JoxCheckpointNumbers;

/* Options of the listener that writes checkpoints. */
typedef struct JoxCheckpointDef {
    const char *folder, *note;
    double every; /* s of simulated time between checkpoints */
} JoxCheckpointDef;

#endif
