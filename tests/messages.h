/* Message handlers of scenes, for tests and fuzz targets. */
#ifndef JOX_TESTS_MESSAGES_H
#define JOX_TESTS_MESSAGES_H

#include "base/text.h"

static inline void ignore_message(void *context, const char *message) {
    (void)context;
    (void)message;
}

/* Appends a message to the JoxText `text`. */
static inline void append_message(void *text, const char *message) {
    jox_text_add(text, message);
}

#endif
