/* The input log: what people did to a running scene, with the step in which it took effect. Played
   back, it drives a run to the same state. Text, one entry a line: TICK VERB ..., with the verbs of
   world/verbs; '#' starts a comment; a name with blanks stands in double quotes, where \" and
   \\ are a quote and a backslash. Ticks count steps from 0 and never decrease. Behind `before N`
   and `files N` follow N files: a line PATH BYTES, the bytes, the end of a line. */
#ifndef JOX_WORLD_INPUT_ENTRIES_H
#define JOX_WORLD_INPUT_ENTRIES_H

#include "base/format/diag.h"
#include "machine/run.h"

/* Rows of jox_input_verbs. */
typedef enum JoxInputVerb {
    JOX_INPUT_PLAYER,
    JOX_INPUT_THROW,
    JOX_INPUT_BOX,
    JOX_INPUT_GRAB,
    JOX_INPUT_DRAG,
    JOX_INPUT_RELEASE,
    JOX_INPUT_PUSH,
    JOX_INPUT_OPEN,
    JOX_INPUT_CLOSE,
    JOX_INPUT_SIGNAL,
    JOX_INPUT_SET,
    JOX_INPUT_BEGAN,
    JOX_INPUT_MADE,
    JOX_INPUT_BEFORE,
    JOX_INPUT_FILES,
    JOX_INPUT_SPAWN,
    JOX_INPUT_REMOVE,
    JOX_INPUT_TELEPORT,
    JOX_INPUT_GOAL,
    JOX_INPUT_STATE,
    JOX_INPUT_MEMORY,
    JOX_INPUT_PARAMETER,
    JOX_INPUT_IMPULSE,
    JOX_INPUT_PLACE,
    JOX_INPUT_VELOCITY,
    JOX_INPUT_DELETE,
    JOX_INPUT_WALL,
    JOX_INPUT_UNWALL,
    JOX_INPUT_SETTING,
    JOX_INPUT_LIFT
} JoxInputVerb;

/* Greatest size of one file, bytes. */
#define JOX_INPUT_LARGEST ((size_t)16 << 20)

enum {
    JOX_INPUT_NUMBERS = 9,
    JOX_INPUT_NAMES = 3,
    JOX_INPUT_NAME = 120,
    JOX_INPUT_PATH = 1000,
    JOX_INPUT_FILE_COUNT = 1024
};

/* The whole text of a file. */
typedef struct JoxInputFile {
    char *path, *text;
    size_t length;
} JoxInputFile;

typedef struct JoxInputEntry {
    uint32_t tick;
    uint32_t verb;                     /* row of jox_input_verbs */
    uint32_t number;                   /* id of an agent, row of a body, or number of files */
    char *names[JOX_INPUT_NAMES];      /* in the order of the line; owned; NULL: none */
    double numbers[JOX_INPUT_NUMBERS]; /* in the order of the line */
    uint32_t given;                    /* number of numbers in the line */
    bool here;                         /* throw: from where the body lies */
    JoxInputFile *files;               /* `number` of them */
    int line;                          /* line of the log; 0: not from a log */
} JoxInputEntry;

/* Zero-initialised is empty. */
typedef struct JoxInputLog {
    JoxInputEntry *entries;
    size_t count, capacity;
    size_t next; /* first entry that was not done yet */
    /* Wanted velocity of each player's agent, m/s; read by machines. */
    struct JoxPlayerInput *present;
    uint32_t present_count;
    size_t present_capacity;
} JoxInputLog;

/* Parses `text` and appends its entries; reports each wrong line as an error in `file`. */
bool jox_input_parse(JoxInputLog *log, const char *file, const char *text, size_t length,
                     JoxDiagnostics *diagnostics);
/* Reads one line without a tick and without files. Returns false with an error and a hint in
   `wrong`. */
bool jox_input_read_line(const char *line, JoxInputEntry *entry, JoxText *wrong);
/* Appends the text of an entry, which jox_input_parse reads back bit for bit. */
void jox_input_write(const JoxInputEntry *entry, JoxText *out);
/* Appends an entry; the log owns it from now on. */
void jox_input_add(JoxInputLog *log, JoxInputEntry entry);
/* Returns the next entry that is due at `tick`, and counts it as done; NULL if there is none. */
const JoxInputEntry *jox_input_take_due(JoxInputLog *log, uint64_t tick);
/* Sets the velocity, m/s, that the player of an agent wants from now on, and whether the player
   holds the button. */
void jox_input_set_player(JoxInputLog *log, uint32_t agent_id, float vx, float vy, bool button);
void jox_input_entry_free(JoxInputEntry *entry);
void jox_input_free(JoxInputLog *log);

#endif
