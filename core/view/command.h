/* Reads the commands that the page sends: a flat JSON object with "do" and values that are numbers,
   texts, true, false or null. */
#ifndef JOX_VIEW_COMMAND_H
#define JOX_VIEW_COMMAND_H

#include <stdbool.h>

enum { JOX_COMMAND_MOST_KEYS = 16 };

typedef enum {
    JOX_COMMAND_NULL,
    JOX_COMMAND_BOOL,
    JOX_COMMAND_NUMBER,
    JOX_COMMAND_TEXT
} JoxCommandKind;

typedef struct JoxCommand {
    struct {
        JoxCommandKind kind;
        double number; /* 1 and 0 for true and false */
        char *key, *text;
    } values[JOX_COMMAND_MOST_KEYS];
    int count;
    char *verb;       /* the text of "do" */
    char store[4200]; /* memory of keys and texts */
} JoxCommand;

/* Reads a command. Returns false if it is no such object, or if a text has control characters or is
   not UTF-8, as texts may be shown on a terminal and written into a log of lines. */
bool jox_command_read(const char *json, JoxCommand *command);
/* Return the value of a key; `otherwise` if it is missing or of another kind. */
const char *jox_command_text(const JoxCommand *command, const char *key, const char *otherwise);
double jox_command_number(const JoxCommand *command, const char *key, double otherwise);
bool jox_command_bool(const JoxCommand *command, const char *key, bool otherwise);

#endif
