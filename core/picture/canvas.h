/* What pictures are drawn on: SVG, which is text, or an image through cairo, which becomes a PNG
   file or a frame of a video. The same calls give the same picture on both. Pixels, x to the
   right, y down. Nothing is kept between two pictures on one canvas. */
#ifndef JOX_PICTURE_CANVAS_H
#define JOX_PICTURE_CANVAS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"
#include "base/vec.h"
#include "picture/palette.h"

/* What is not opaque at all (a = 0) is not drawn. Of writing, `line` is its halo. */
typedef struct JoxStyle {
    JoxInk fill, line;
    float width, dash; /* px; dash 0: unbroken */
} JoxStyle;

typedef enum { JOX_ANCHOR_START, JOX_ANCHOR_MIDDLE, JOX_ANCHOR_END } JoxAnchor;

/* A field in steps of colour: level 0 is not drawn, level n has ink[n]. */
typedef struct JoxCells {
    JoxV2 at;   /* upper left corner */
    float size; /* of a cell */
    uint32_t columns, rows;
    const uint8_t *level; /* row by row from the uppermost */
    const JoxInk *ink;
    uint32_t levels;
} JoxCells;

enum { JOX_CANVAS_DEPTH = 4 };

typedef struct JoxCanvas JoxCanvas;
struct JoxCanvas {
    const struct JoxCanvasMeans {
        void (*begin)(JoxCanvas *, const char *title);
        void (*open)(JoxCanvas *, const char *id, const char *kind);
        void (*close)(JoxCanvas *);
        void (*clip)(JoxCanvas *, JoxV2 low, JoxV2 high);
        void (*line)(JoxCanvas *, const JoxV2 *, uint32_t, bool, const char *);
        void (*dashes)(JoxCanvas *, const JoxV2 *, uint32_t);
        void (*disc)(JoxCanvas *, JoxV2, float, const char *);
        void (*text)(JoxCanvas *, JoxV2, float, JoxAnchor, bool, const char *);
        void (*cells)(JoxCanvas *, const JoxCells *);
        bool (*write)(JoxCanvas *, const char *path, JoxText *error);
        void (*free)(JoxCanvas *);
    } * means;
    uint32_t width, height;
    JoxStyle style[JOX_CANVAS_DEPTH];
    int depth;
};

JoxCanvas *jox_canvas_svg(uint32_t width, uint32_t height);
/* NULL in a build without cairo. */
JoxCanvas *jox_canvas_image(uint32_t width, uint32_t height);
/* Of an image: rows of 4 bytes, blue, green, red and one that means nothing, without gaps. */
const uint8_t *jox_canvas_pixels(JoxCanvas *canvas);
bool jox_canvas_has_images(void);

/* Begins the picture anew: white. */
static inline void jox_canvas_begin(JoxCanvas *c, const char *title) {
    c->depth = 0;
    c->means->begin(c, title);
}
/* Opens a group with a style. SVG: with an id or a class, either may be NULL. */
static inline void jox_canvas_open(JoxCanvas *c, const char *id, const char *kind, JoxStyle style) {
    c->style[c->depth++] = style;
    c->means->open(c, id, kind);
}
static inline void jox_canvas_close(JoxCanvas *c) {
    c->means->close(c);
    c->depth--;
}
/* Opens a group that shows only what is within the box. */
static inline void jox_canvas_clip(JoxCanvas *c, JoxV2 low, JoxV2 high) {
    c->style[c->depth++] = (JoxStyle){0};
    c->means->clip(c, low, high);
}
/* A line through points, or a ring. `name` (or NULL) is shown by what shows SVG. */
static inline void jox_canvas_line(JoxCanvas *c, const JoxV2 *points, uint32_t count, bool closed,
                                   const char *name) {
    c->means->line(c, points, count, closed, name);
}
/* Segments: from each even point to the next. */
static inline void jox_canvas_dashes(JoxCanvas *c, const JoxV2 *points, uint32_t count) {
    c->means->dashes(c, points, count);
}
/* `id` may be NULL; in SVG it must be another's nowhere. */
static inline void jox_canvas_disc(JoxCanvas *c, JoxV2 centre, float radius, const char *id) {
    c->means->disc(c, centre, radius, id);
}
/* `at` is on the base line; `size` that of the type. */
static inline void jox_canvas_text(JoxCanvas *c, JoxV2 at, float size, JoxAnchor anchor, bool bold,
                                   const char *text) {
    c->means->text(c, at, size, anchor, bold, text);
}
static inline void jox_canvas_cells(JoxCanvas *c, const JoxCells *cells) {
    c->means->cells(c, cells);
}
/* As SVG or PNG, after what it is. False with a sentence in `error`. */
static inline bool jox_canvas_write(JoxCanvas *c, const char *path, JoxText *error) {
    return c->means->write(c, path, error);
}
static inline void jox_canvas_free(JoxCanvas *c) {
    if (c)
        c->means->free(c);
}

#endif
