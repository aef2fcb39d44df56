/* What the writer and the reader of checkpoints share. */
#ifndef JOX_RUN_RESUME_CHECKPOINT_H
#define JOX_RUN_RESUME_CHECKPOINT_H

#include "base/format/piece_file.h"
#include "run/run.h"

#define JOX_CHECKPOINT_LATEST "latest.checkpoint"
#define JOX_CHECKPOINT_BEFORE "before.checkpoint"

/* Names of pieces, besides JOX_PIECE_LISTENER. A file is its path, a zero and its text. */
#define JOX_PIECE_NUMBERS "numbers"
#define JOX_PIECE_PATH "path"
#define JOX_PIECE_INPUT "input"
#define JOX_PIECE_SET "set"
#define JOX_PIECE_MOD "mod"
#define JOX_PIECE_NOTE "note"
#define JOX_PIECE_FILE "file"
#define JOX_PIECE_STATE "state"

typedef struct JoxCheckpointNumbers {
    uint64_t tick, hash, seed, log_length;
    double dt; /* s */
    uint32_t has_seed, has_dt, no_density, unused;
} JoxCheckpointNumbers;

typedef struct JoxCheckpointDef {
    const char *folder, *note;
    double every; /* s, simulated */
} JoxCheckpointDef;

#endif
