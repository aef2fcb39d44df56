/* Names of the language and of shipped files that were changed, and what they are called now. */
#ifndef JOX_BASE_FORMAT_OLD_NAMES_H
#define JOX_BASE_FORMAT_OLD_NAMES_H

typedef enum JoxOldKind {
    JOX_OLD_KEY,      /* of a scene */
    JOX_OLD_WORD,     /* of behaviours */
    JOX_OLD_BEHAVIOUR /* a shipped file, without its ending */
} JoxOldKind;

/* What is called otherwise now; NULL for any other name. */
const char *jox_old_name(JoxOldKind kind, const char *name);

#endif
