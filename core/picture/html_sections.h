/* Documents of numbered sections, to print and sign: a head that repeats on every printed page, a
   list of contents, page numbers. The reports of runs and of recordings are such documents. The
   body is written to memory first, by the functions of html.h, since the contents stand before
   it. */
#ifndef JOX_PICTURE_HTML_SECTIONS_H
#define JOX_PICTURE_HTML_SECTIONS_H

#include <stddef.h>
#include <stdio.h>

/* Texts of the document's head; NULL or "": left out. */
typedef struct JoxHtmlHead {
    const char *title;
    const char *about; /* line below the title */
    /* Running texts of each printed page: top right, and bottom left. The title stands top left,
       "page 2 of 14" bottom right. */
    const char *right, *foot;
} JoxHtmlHead;

/* Writes the document's head, up to its title; `jox_html_end` ends it. */
void jox_html_begin_printed(FILE *out, const JoxHtmlHead *head);

/* A body in memory. */
typedef struct JoxHtmlBody {
    FILE *out; /* to write to, from jox_html_body_begin to jox_html_body_put */
    char *text;
    size_t length;
} JoxHtmlBody;

/* Opens a body; its `out` is NULL if there is no memory. */
void jox_html_body_begin(JoxHtmlBody *body);
/* Writes the list of contents, and the body with a number before each <h2>; then frees the body. */
void jox_html_body_put(FILE *out, JoxHtmlBody *body);

#endif
