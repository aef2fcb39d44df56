/* Parameters of words and functions, read from their signatures in the vocabulary. Called by
   editor_definitions.c. */
#ifndef JOX_LUA_SIGNATURE_H
#define JOX_LUA_SIGNATURE_H

#include <stdbool.h>

enum { JOX_MOST_SIGNED = 8, JOX_LONGEST_SIGNED = 48 };

/* A parameter, as a signature names it. */
typedef struct JoxSignatureItem {
    char name[JOX_LONGEST_SIGNED]; /* "..." for any number of them */
    bool optional, variadic;
} JoxSignatureItem;

typedef struct JoxSignature {
    JoxSignatureItem items[JOX_MOST_SIGNED];
    int count;
} JoxSignature;

/* Reads the parameters of "near(target, metres)", "heard(name [, metres])" or "print(...)". Names
   that are keywords, or stand there twice, are changed. */
JoxSignature jox_signature_read(const char *text, const char *end);

#endif
