/* The image backend of canvas.h: draws with cairo into memory, written as PNG or handed to a
   video. */
#include <cairo.h>
#include <errno.h>
#include <string.h>

#include "base/mem.h"
#include "base/number/pi.h"
#include "picture/canvas.h"

typedef struct Image {
    JoxCanvas canvas;
    cairo_surface_t *surface;
    cairo_t *cairo;
} Image;

static cairo_t *context_of(JoxCanvas *c) {
    return ((Image *)c)->cairo;
}

static void set_source_ink(cairo_t *cairo, JoxInk ink) {
    cairo_set_source_rgba(cairo, ink.r / 255.0, ink.g / 255.0, ink.b / 255.0, (double)ink.a);
}

static void begin_image(JoxCanvas *c, const char *title) {
    cairo_t *cairo = context_of(c);
    (void)title;
    cairo_reset_clip(cairo);
    cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    cairo_paint(cairo);
}

static void open_image_group(JoxCanvas *c, const char *id, const char *kind) {
    (void)id;
    (void)kind;
    cairo_save(context_of(c));
    const JoxStyle *style = &c->style[c->depth - 1];
    double dash = (double)style->dash;
    cairo_set_line_width(context_of(c), (double)style->width);
    cairo_set_line_join(context_of(c), CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(context_of(c), &dash, dash > 0.0, 0.0);
}

static void close_image_group(JoxCanvas *c) {
    cairo_restore(context_of(c));
}

static void clip_image_group(JoxCanvas *c, JoxV2 low, JoxV2 high) {
    cairo_save(context_of(c));
    cairo_rectangle(context_of(c), (double)low.x, (double)low.y, (double)(high.x - low.x),
                    (double)(high.y - low.y));
    cairo_clip(context_of(c));
}

/* Fills and strokes cairo's current path in the innermost group's style, then clears the path. */
static void paint_path(JoxCanvas *c) {
    const JoxStyle *style = &c->style[c->depth - 1];
    bool strokes = style->line.a > 0.0f;
    if (style->fill.a > 0.0f) {
        set_source_ink(context_of(c), style->fill);
        cairo_fill_preserve(context_of(c));
    }
    if (strokes) {
        set_source_ink(context_of(c), style->line);
        cairo_stroke_preserve(context_of(c));
    }
    cairo_new_path(context_of(c));
}

static void draw_image_line(JoxCanvas *c, const JoxV2 *points, uint32_t count, bool closed,
                            const char *name) {
    (void)name;
    cairo_new_path(context_of(c));
    for (uint32_t i = 0; i < count; i++)
        cairo_line_to(context_of(c), (double)points[i].x, (double)points[i].y);
    if (closed)
        cairo_close_path(context_of(c));
    paint_path(c);
}

static void draw_image_segments(JoxCanvas *c, const JoxV2 *points, uint32_t count) {
    cairo_new_path(context_of(c));
    for (uint32_t i = 0; i + 1 < count; i += 2) {
        cairo_move_to(context_of(c), (double)points[i].x, (double)points[i].y);
        cairo_line_to(context_of(c), (double)points[i + 1].x, (double)points[i + 1].y);
        if (i % 256 == 254) /* cairo's time grows faster than the path's length */
            paint_path(c);
    }
    paint_path(c);
}

static void draw_image_disc(JoxCanvas *c, JoxV2 centre, float radius, const char *id) {
    (void)id;
    cairo_new_path(context_of(c));
    cairo_arc(context_of(c), (double)centre.x, (double)centre.y, (double)radius, 0.0, JOX_TURN);
    paint_path(c);
}

static void draw_image_text(JoxCanvas *c, JoxV2 at, float size, JoxAnchor anchor, bool bold,
                            const char *string) {
    cairo_text_extents_t extents;
    char *clean = jox_strdup(string);
    jox_text_clean(clean);
    cairo_select_font_face(context_of(c), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_of(c), (double)size);
    cairo_text_extents(context_of(c), clean, &extents);
    double back = extents.x_advance * (anchor == JOX_ANCHOR_END      ? 1.0
                                       : anchor == JOX_ANCHOR_MIDDLE ? 0.5
                                                                     : 0.0);
    const JoxStyle *style = &c->style[c->depth - 1];
    cairo_new_path(context_of(c));
    cairo_move_to(context_of(c), (double)at.x - back, (double)at.y);
    if (style->line.a > 0.0f) { /* the halo is painted first, behind the letters */
        cairo_text_path(context_of(c), clean);
        set_source_ink(context_of(c), style->line);
        cairo_stroke(context_of(c));
        cairo_move_to(context_of(c), (double)at.x - back, (double)at.y);
    }
    set_source_ink(context_of(c), style->fill);
    cairo_show_text(context_of(c), clean);
    cairo_new_path(context_of(c));
    jox_free(clean);
}

/* Draws one pixel per cell into a small image and scales it up without smoothing. */
static void draw_image_cells(JoxCanvas *c, const JoxCells *cells) {
    cairo_surface_t *tile =
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, (int)cells->columns, (int)cells->rows);
    uint8_t *data = cairo_image_surface_get_data(tile);
    if (!data) {
        cairo_surface_destroy(tile);
        return;
    }
    int stride = cairo_image_surface_get_stride(tile);
    for (uint32_t r = 0; r < cells->rows; r++) {
        uint32_t *row = (uint32_t *)(void *)(data + (size_t)r * (size_t)stride);
        for (uint32_t x = 0; x < cells->columns; x++) {
            uint8_t level = cells->level[(size_t)r * cells->columns + x];
            const JoxInk *ink = &cells->ink[level];
            row[x] =
                level ? 0xff000000u | (uint32_t)ink->r << 16 | (uint32_t)ink->g << 8 | ink->b : 0;
        }
    }
    cairo_surface_mark_dirty(tile);
    cairo_save(context_of(c));
    cairo_translate(context_of(c), (double)cells->at.x, (double)cells->at.y);
    cairo_scale(context_of(c), (double)cells->size, (double)cells->size);
    cairo_set_source_surface(context_of(c), tile, 0.0, 0.0);
    cairo_pattern_set_filter(cairo_get_source(context_of(c)), CAIRO_FILTER_NEAREST);
    cairo_paint(context_of(c));
    cairo_restore(context_of(c));
    cairo_surface_destroy(tile);
}

static bool write_png(JoxCanvas *c, const char *path, JoxText *error) {
    errno = 0;
    cairo_status_t status = cairo_surface_write_to_png(((Image *)c)->surface, path);
    if (status != CAIRO_STATUS_SUCCESS)
        jox_text_printf(error, "cannot write '%s': %s", path,
                        errno ? strerror(errno) : cairo_status_to_string(status));
    return status == CAIRO_STATUS_SUCCESS;
}

static void release_image(void *canvas) {
    Image *image = canvas;
    cairo_destroy(image->cairo);
    cairo_surface_destroy(image->surface);
}

static void free_image(JoxCanvas *c) {
    jox_heap_unregister(c);
    release_image(c);
    jox_free(c);
}

JoxCanvas *jox_canvas_image(uint32_t width, uint32_t height) {
    static const struct JoxCanvasBackend backend = {.begin = begin_image,
                                                    .open = open_image_group,
                                                    .close = close_image_group,
                                                    .clip = clip_image_group,
                                                    .line = draw_image_line,
                                                    .segments = draw_image_segments,
                                                    .disc = draw_image_disc,
                                                    .text = draw_image_text,
                                                    .cells = draw_image_cells,
                                                    .write = write_png,
                                                    .free = free_image};
    Image *image = jox_alloc(1, sizeof *image);
    image->canvas.backend = &backend;
    image->canvas.width = width;
    image->canvas.height = height;
    image->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
    image->cairo = cairo_create(image->surface);
    jox_heap_register(image, release_image);
    return &image->canvas;
}

/* A pixel of RGB24 takes 32 bits, so rows have no padding. */
const uint8_t *jox_canvas_pixels(JoxCanvas *c) {
    Image *image = (Image *)c;
    cairo_surface_flush(image->surface);
    return cairo_image_surface_get_data(image->surface);
}

bool jox_canvas_has_images(void) {
    return true;
}
