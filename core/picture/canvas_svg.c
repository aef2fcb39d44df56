/* The SVG 1.1 backend of canvas.h: appends elements to a text. Text stays text, layers have ids,
   and each person is one element, so that pages and tests can find them. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/format/quote.h"
#include "base/mem.h"
#include "picture/canvas.h"

typedef struct Svg {
    JoxCanvas canvas;
    JoxText out;    /* the document so far */
    uint32_t clips; /* number of clip paths, which numbers their ids */
    bool ended;     /* the closing </svg> is in `out` */
} Svg;

/* Appends a number of pixels, rounded to 0.01, without trailing zeros. */
static void append_number(JoxText *out, float value) {
    char text[64]; /* the longest float, 1e38, takes 43 characters */
    int length = snprintf(text, sizeof text, "%.2f", value);
    while (length > 1 && text[length - 1] == '0')
        length--;
    if (text[length - 1] == '.')
        length--;
    text[length] = 0;
    jox_text_append(out, strcmp(text, "-0") == 0 ? "0" : text,
                    strcmp(text, "-0") == 0 ? 1 : (size_t)length);
}

static void append_point(JoxText *out, char before, JoxV2 at) {
    jox_text_append(out, &before, 1);
    append_number(out, at.x);
    jox_text_append(out, " ", 1);
    append_number(out, at.y);
}

/* Appends id="..." or class="...". Characters other than ASCII letters, digits, '-' and spaces
   become '-'. */
static void append_identifier(JoxText *out, const char *attribute, const char *text) {
    jox_text_printf(out, " %s=\"", attribute);
    for (const char *c = text; *c; c++) {
        bool plain = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') ||
                     (*c >= '0' && *c <= '9') || *c == '-' || *c == ' ';
        jox_text_append(out, plain ? c : "-", 1);
    }
    jox_text_add(out, "\"");
}

/* Appends a paint attribute (`what`: "fill" or "stroke") with its opacity; "none" for a
   transparent colour. */
static void append_ink(JoxText *out, const char *what, JoxInk colour) {
    if (colour.a <= 0.0f) {
        jox_text_printf(out, " %s=\"none\"", what);
        return;
    }
    jox_text_printf(out, " %s=\"#%02x%02x%02x\"", what, colour.r, colour.g, colour.b);
    if (colour.a < 1.0f)
        jox_text_printf(out, " %s-opacity=\"%.2g\"", what, colour.a);
}

static void begin_svg(JoxCanvas *c, const char *title) {
    Svg *svg = (Svg *)c;
    svg->out.length = 0;
    svg->clips = 0;
    svg->ended = false;
    jox_text_printf(&svg->out,
                    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                    "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%u\" height=\"%u\" "
                    "viewBox=\"0 0 %u %u\" "
                    "font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\">\n<title>",
                    c->width, c->height, c->width, c->height);
    jox_quote_xml(&svg->out, title);
    jox_text_printf(&svg->out, "</title>\n<rect width=\"%u\" height=\"%u\" fill=\"#ffffff\"/>\n",
                    c->width, c->height);
}

static void open_svg_group(JoxCanvas *c, const char *id, const char *kind) {
    JoxText *out = &((Svg *)c)->out;
    const JoxStyle *style = &c->style[c->depth - 1];
    jox_text_add(out, "<g");
    if (id)
        append_identifier(out, "id", id);
    if (kind)
        append_identifier(out, "class", kind);
    append_ink(out, "fill", style->fill);
    append_ink(out, "stroke", style->line);
    if (style->line.a > 0.0f) {
        jox_text_add(out, " stroke-width=\"");
        append_number(out, style->width);
        jox_text_add(out, "\" stroke-linejoin=\"round\"");
    }
    if (style->line.a > 0.0f && style->dash > 0.0f) {
        jox_text_add(out, " stroke-dasharray=\"");
        append_number(out, style->dash);
        jox_text_add(out, "\"");
    }
    jox_text_add(out, ">\n");
}

static void close_svg_group(JoxCanvas *c) {
    jox_text_add(&((Svg *)c)->out, "</g>\n");
}

static void clip_svg_group(JoxCanvas *c, JoxV2 low, JoxV2 high) {
    Svg *svg = (Svg *)c;
    jox_text_printf(&svg->out, "<clipPath id=\"clip%u\"><rect x=\"", svg->clips);
    append_number(&svg->out, low.x);
    jox_text_add(&svg->out, "\" y=\"");
    append_number(&svg->out, low.y);
    jox_text_add(&svg->out, "\" width=\"");
    append_number(&svg->out, high.x - low.x);
    jox_text_add(&svg->out, "\" height=\"");
    append_number(&svg->out, high.y - low.y);
    jox_text_printf(&svg->out, "\"/></clipPath>\n<g clip-path=\"url(#clip%u)\">\n", svg->clips);
    svg->clips++;
}

static void draw_svg_line(JoxCanvas *c, const JoxV2 *points, uint32_t count, bool closed,
                          const char *name) {
    JoxText *out = &((Svg *)c)->out;
    jox_text_add(out, "<path d=\"");
    for (uint32_t i = 0; i < count; i++)
        append_point(out, i ? 'L' : 'M', points[i]);
    jox_text_add(out, closed ? "Z\"" : "\"");
    if (name && *name) {
        jox_text_add(out, "><title>");
        jox_quote_xml(out, name);
        jox_text_add(out, "</title></path>\n");
    } else {
        jox_text_add(out, "/>\n");
    }
}

static void draw_svg_segments(JoxCanvas *c, const JoxV2 *points, uint32_t count) {
    JoxText *out = &((Svg *)c)->out;
    if (count < 2)
        return;
    jox_text_add(out, "<path d=\"");
    for (uint32_t i = 0; i + 1 < count; i += 2) {
        append_point(out, 'M', points[i]);
        append_point(out, 'L', points[i + 1]);
        if (i % 32 == 30)
            jox_text_add(out, "\n");
    }
    jox_text_add(out, "\"/>\n");
}

static void draw_svg_disc(JoxCanvas *c, JoxV2 centre, float radius, const char *id) {
    JoxText *out = &((Svg *)c)->out;
    jox_text_add(out, "<circle");
    if (id)
        append_identifier(out, "id", id);
    jox_text_add(out, " cx=\"");
    append_number(out, centre.x);
    jox_text_add(out, "\" cy=\"");
    append_number(out, centre.y);
    jox_text_add(out, "\" r=\"");
    append_number(out, radius);
    jox_text_add(out, "\"/>\n");
}

static void draw_svg_text(JoxCanvas *c, JoxV2 at, float size, JoxAnchor anchor, bool bold,
                          const char *string) {
    static const char *const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    JoxText *out = &((Svg *)c)->out;
    jox_text_add(out, "<text x=\"");
    append_number(out, at.x);
    jox_text_add(out, "\" y=\"");
    append_number(out, at.y);
    jox_text_add(out, "\" font-size=\"");
    append_number(out, size);
    jox_text_printf(out, "\"%s%s%s>", anchors[anchor], bold ? " font-weight=\"bold\"" : "",
                    c->style[c->depth - 1].line.a > 0.0f ? " paint-order=\"stroke\"" : "");
    jox_quote_xml(out, string);
    jox_text_add(out, "</text>\n");
}

/* Draws all cells of a level as one path of horizontal runs; a transform scales cells to pixels. */
static void draw_svg_cells(JoxCanvas *c, const JoxCells *cells) {
    JoxText *out = &((Svg *)c)->out;
    jox_text_add(out, "<g shape-rendering=\"crispEdges\" transform=\"translate(");
    append_number(out, cells->at.x);
    jox_text_add(out, " ");
    append_number(out, cells->at.y);
    jox_text_printf(out, ") scale(%.6g)\">\n", cells->size);
    for (uint32_t level = 1; level < cells->levels; level++) {
        bool any = false;
        for (uint32_t r = 0; r < cells->rows; r++) {
            const uint8_t *row = cells->level + (size_t)r * cells->columns;
            for (uint32_t x = 0, end; x < cells->columns; x = end) {
                for (end = x + 1; end < cells->columns && row[end] == row[x];)
                    end++;
                if (row[x] != level)
                    continue;
                if (!any) {
                    jox_text_add(out, "<path");
                    append_ink(out, "fill", cells->ink[level]);
                    jox_text_add(out, " d=\"");
                }
                any = true;
                jox_text_printf(out, "M%u %uh%uv1h-%uz", x, r, end - x, end - x);
            }
        }
        if (any)
            jox_text_add(out, "\"/>\n");
    }
    jox_text_add(out, "</g>\n");
}

static bool write_svg(JoxCanvas *c, const char *path, JoxText *error) {
    Svg *svg = (Svg *)c;
    if (!svg->ended)
        jox_text_add(&svg->out, "</svg>\n");
    svg->ended = true;
    FILE *file = jox_file_replace(path);
    bool good = file && fwrite(svg->out.data, 1, svg->out.length, file) == svg->out.length;
    if (file && good)
        good = jox_file_close(file) == 0;
    else if (file)
        jox_file_drop(file); /* if memory ran out, the stream's error flag may not be set */
    if (!good)
        jox_text_printf(error, "cannot write '%s': %s", path, strerror(errno));
    return good;
}

static void free_svg(JoxCanvas *c) {
    jox_text_free(&((Svg *)c)->out);
    jox_free(c);
}

JoxCanvas *jox_canvas_svg(uint32_t width, uint32_t height) {
    static const struct JoxCanvasBackend backend = {.begin = begin_svg,
                                                    .open = open_svg_group,
                                                    .close = close_svg_group,
                                                    .clip = clip_svg_group,
                                                    .line = draw_svg_line,
                                                    .segments = draw_svg_segments,
                                                    .disc = draw_svg_disc,
                                                    .text = draw_svg_text,
                                                    .cells = draw_svg_cells,
                                                    .write = write_svg,
                                                    .free = free_svg};
    Svg *svg = jox_alloc(1, sizeof *svg);
    svg->canvas.backend = &backend;
    svg->canvas.width = width;
    svg->canvas.height = height;
    return &svg->canvas;
}
