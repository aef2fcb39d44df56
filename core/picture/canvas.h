/* A drawing surface with two backends: SVG text (canvas_svg.c) and, through cairo, an image that
   becomes a PNG file or a video frame (canvas_cairo.c). draw*.c draws on it, and the same calls
   give the same picture on both. Coordinates are pixels, x to the right, y down. A canvas serves
   one picture after the other: jox_canvas_begin, then groups opened and closed in pairs with
   shapes between them, then jox_canvas_write or jox_canvas_pixels. */
#ifndef JOX_PICTURE_CANVAS_H
#define JOX_PICTURE_CANVAS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"
#include "base/vec.h"
#include "picture/palette.h"

/* How a group paints its shapes and text. A colour with a = 0 paints nothing. For text, `line`
   is the colour of a halo around the letters. */
typedef struct JoxStyle {
    JoxInk fill, line;
    float width, dash; /* px: line width; length of dashes and gaps, 0 for a solid line */
} JoxStyle;

typedef enum { JOX_ANCHOR_START, JOX_ANCHOR_MIDDLE, JOX_ANCHOR_END } JoxAnchor;

/* A grid of square cells in steps of colour. A cell of level 0 is not drawn, one of level n gets
   ink[n]. */
typedef struct JoxCells {
    JoxV2 at;   /* px: upper left corner of the grid */
    float size; /* px: edge of a cell */
    uint32_t columns, rows;
    const uint8_t *level; /* columns * rows values, row by row from the top */
    const JoxInk *ink;    /* `levels` colours; the first is unused */
    uint32_t levels;
} JoxCells;

enum { JOX_CANVAS_DEPTH = 4 }; /* greatest depth of nested groups */

/* The base of both backends' own structures, each of which implements all calls in a table. The
   functions below forward to it. */
typedef struct JoxCanvas JoxCanvas;
struct JoxCanvas {
    const struct JoxCanvasBackend {
        void (*begin)(JoxCanvas *, const char *title);
        void (*open)(JoxCanvas *, const char *id, const char *kind);
        void (*close)(JoxCanvas *);
        void (*clip)(JoxCanvas *, JoxV2 low, JoxV2 high);
        void (*line)(JoxCanvas *, const JoxV2 *, uint32_t, bool, const char *);
        void (*segments)(JoxCanvas *, const JoxV2 *, uint32_t);
        void (*disc)(JoxCanvas *, JoxV2, float, const char *);
        void (*text)(JoxCanvas *, JoxV2, float, JoxAnchor, bool, const char *);
        void (*cells)(JoxCanvas *, const JoxCells *);
        bool (*write)(JoxCanvas *, const char *path, JoxText *error);
        void (*free)(JoxCanvas *);
    } * backend;
    uint32_t width, height;           /* px */
    JoxStyle style[JOX_CANVAS_DEPTH]; /* styles of the open groups; the innermost is at depth - 1 */
    int depth;                        /* number of open groups */
};

/* Create a canvas, which the caller frees with jox_canvas_free. The image variant returns NULL
   in a build without cairo. */
JoxCanvas *jox_canvas_svg(uint32_t width, uint32_t height);
JoxCanvas *jox_canvas_image(uint32_t width, uint32_t height);
/* Pixels of an image canvas, which stay its own: 4 bytes each (blue, green, red, unused), row by
   row from the top without gaps. */
const uint8_t *jox_canvas_pixels(JoxCanvas *canvas);
bool jox_canvas_has_images(void);

/* Starts a new picture: drops all that was drawn and fills it white. SVG viewers show the title. */
static inline void jox_canvas_begin(JoxCanvas *c, const char *title) {
    c->depth = 0;
    c->backend->begin(c, title);
}
/* Opens a group whose shapes and text are painted in a style. SVG gives the group an id and a
   class; either may be NULL. */
static inline void jox_canvas_open(JoxCanvas *c, const char *id, const char *kind, JoxStyle style) {
    c->style[c->depth++] = style;
    c->backend->open(c, id, kind);
}
static inline void jox_canvas_close(JoxCanvas *c) {
    c->backend->close(c);
    c->depth--;
}
/* Opens a group that is clipped to a box. */
static inline void jox_canvas_clip(JoxCanvas *c, JoxV2 low, JoxV2 high) {
    c->style[c->depth++] = (JoxStyle){0};
    c->backend->clip(c, low, high);
}
/* Draws a line through points, closed to a ring on request. SVG viewers show `name` (or NULL) as
   a tooltip. */
static inline void jox_canvas_line(JoxCanvas *c, const JoxV2 *points, uint32_t count, bool closed,
                                   const char *name) {
    c->backend->line(c, points, count, closed, name);
}
/* Draws separate segments: points[0] to points[1], points[2] to points[3], ... */
static inline void jox_canvas_segments(JoxCanvas *c, const JoxV2 *points, uint32_t count) {
    c->backend->segments(c, points, count);
}
/* Draws a disc. `id`, or NULL, becomes the SVG element's id and must be unique in the picture. */
static inline void jox_canvas_disc(JoxCanvas *c, JoxV2 centre, float radius, const char *id) {
    c->backend->disc(c, centre, radius, id);
}
/* Writes text. `at` lies on the base line; `size` is the font size, px. */
static inline void jox_canvas_text(JoxCanvas *c, JoxV2 at, float size, JoxAnchor anchor, bool bold,
                                   const char *text) {
    c->backend->text(c, at, size, anchor, bold, text);
}
static inline void jox_canvas_cells(JoxCanvas *c, const JoxCells *cells) {
    c->backend->cells(c, cells);
}
/* Writes an SVG or PNG file, according to the backend. Returns false with a sentence in `error`. */
static inline bool jox_canvas_write(JoxCanvas *c, const char *path, JoxText *error) {
    return c->backend->write(c, path, error);
}
static inline void jox_canvas_free(JoxCanvas *c) {
    if (c)
        c->backend->free(c);
}

#endif
