#include "picture/html_sections.h"

#include <stdlib.h>
#include <string.h>

#include "base/format/quote.h"
#include "picture/html.h"

/* As jox_html_heading writes it. */
static const char HEADING[] = "<h2>", HEADING_END[] = "</h2>";

/* Writes a margin box of printed pages with a text, or with a counter of pages if `text` is
   NULL. */
static void put_margin_box(FILE *out, const char *box, const char *text) {
    if (text && !*text)
        return;
    fprintf(out, "@%s{font:8pt system-ui,sans-serif;color:#555;white-space:pre;content:", box);
    if (text)
        jox_quote_put(out, jox_quote_css, text);
    else
        fputs("\"page \" counter(page) \" of \" counter(pages)", out);
    fputs("}", out);
}

void jox_html_begin_printed(FILE *out, const JoxHtmlHead *head) {
    jox_html_begin_head(out, head->title);
    fputs("<style>@page{margin:20mm 15mm 18mm;", out);
    put_margin_box(out, "top-left", head->title);
    put_margin_box(out, "top-right", head->right ? head->right : "");
    put_margin_box(out, "bottom-left", head->foot ? head->foot : "");
    put_margin_box(out, "bottom-right", NULL);
    fputs("}</style>\n<h1>", out);
    jox_html_text(out, head->title);
    fputs("</h1>\n", out);
    if (head->about && *head->about) {
        fputs("<p class=about>", out);
        jox_html_text(out, head->about);
        fputs("</p>\n", out);
    }
}

void jox_html_body_begin(JoxHtmlBody *body) {
    *body = (JoxHtmlBody){0};
    body->out = open_memstream(&body->text, &body->length);
}

/* Returns the next heading of a body and sets `length` to that of its text; NULL: none. */
static const char *find_heading(const char *from, size_t *length) {
    const char *at = strstr(from, HEADING);
    const char *end = at ? strstr(at, HEADING_END) : NULL;
    if (!end)
        return NULL;
    at += sizeof HEADING - 1;
    *length = (size_t)(end - at);
    return at;
}

static void put_contents(FILE *out, const char *body) {
    size_t length;
    int number = 0;
    fputs("<nav><b>Contents</b>\n<ol>\n", out);
    for (const char *at = find_heading(body, &length); at; at = find_heading(at + length, &length))
        fprintf(out, "<li><a href=\"#section-%d\">%.*s</a>\n", ++number, (int)length, at);
    fputs("</ol></nav>\n", out);
}

void jox_html_body_put(FILE *out, JoxHtmlBody *body) {
    fclose(body->out);
    const char *from = body->text;
    size_t length;
    int number = 0;
    put_contents(out, from);
    for (const char *at = find_heading(from, &length); at; at = find_heading(at, &length)) {
        fwrite(from, 1, (size_t)(at - from) - (sizeof HEADING - 1), out);
        number++;
        fprintf(out, "<h2 id=section-%d>%d&ensp;", number, number);
        from = at;
    }
    fputs(from, out);
    free(body->text);
    *body = (JoxHtmlBody){0};
}
