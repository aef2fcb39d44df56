#include "picture/html.h"

#include <math.h>
#include <string.h>

#include "base/format/quote.h"

static const char STYLE[] =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;"
    "color:#1a1a1a;background:#fff}h1{font-size:1.7rem}h2{font-size:1.25rem;margin-top:2.5rem;"
    "border-top:1px solid #ccc;padding-top:1rem}table{border-collapse:collapse;margin:1rem 0}"
    "th,td{text-align:left;padding:.25rem .8rem .25rem 0;border-bottom:1px solid #ddd;"
    "vertical-align:top}td.n{text-align:right;font-variant-numeric:tabular-nums;"
    "white-space:nowrap}.in{color:#00601f}.out{color:#a40000;font-weight:700}figure{display:"
    "inline-block;margin:.5rem 1rem .5rem 0;vertical-align:top}img{max-width:34rem;width:100%;"
    "border:1px solid #ddd}.plan img{max-width:64rem;max-height:44rem;width:auto}"
    "figcaption,small{color:#555}details{margin:.5rem 0}pre{overflow:auto;"
    "background:#f6f6f6;padding:.6rem;font-size:13px}.scroll{overflow-x:auto}code{font-size:.9em;"
    "overflow-wrap:anywhere}";

void jox_html_text(FILE *out, const char *text) {
    jox_quote_put(out, jox_quote_xml, text);
}

void jox_html_argument(FILE *out, const char *argument) {
    JoxText quoted = {0};
    jox_quote_shell(&quoted, argument);
    jox_html_text(out, quoted.data);
    jox_text_free(&quoted);
}

void jox_html_link(FILE *out, const char *path) {
    jox_quote_put(out, jox_quote_url, path);
}

void jox_html_begin(FILE *out, const char *title) {
    fputs("<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport "
          "content=\"width=device-width\"><title>",
          out);
    jox_html_text(out, title);
    fprintf(out, "</title><style>%s</style>\n<h1>", STYLE);
    jox_html_text(out, title);
    fputs("</h1>\n", out);
}

void jox_html_end(FILE *out) {
    fputs("</html>\n", out);
}

void jox_html_number(FILE *out, double value) {
    if (isfinite(value))
        fprintf(out, fabs(value) < 1e6 && value == floor(value) ? "%.0f" : "%.4g", value);
    else
        fputs("&ndash;", out);
}

static void element(FILE *out, const char *name, const char *text) {
    fprintf(out, "<%s>", name);
    jox_html_text(out, text);
    fprintf(out, "</%s>\n", name);
}

void jox_html_heading(FILE *out, const char *text) {
    element(out, "h2", text);
}

void jox_html_paragraph(FILE *out, const char *text) {
    element(out, "p", text);
}

void jox_html_table(FILE *out, const char *heads) {
    fputs("<div class=scroll><table><tr>", out);
    while (*heads) {
        size_t length = strcspn(heads, "|");
        char head[128];
        snprintf(head, sizeof head, "%.*s", (int)length, heads);
        fputs("<th>", out);
        jox_html_text(out, head);
        heads += length + (heads[length] == '|');
    }
}

void jox_html_row(FILE *out) {
    fputs("\n<tr>", out);
}

void jox_html_cell(FILE *out, const char *text) {
    fputs("<td>", out);
    jox_html_text(out, text);
}

void jox_html_cell_number(FILE *out, double value, const char *unit) {
    fputs("<td class=n>", out);
    jox_html_number(out, value);
    if (*unit && isfinite(value)) {
        fputs("&nbsp;", out);
        jox_html_text(out, unit);
    }
}

void jox_html_table_end(FILE *out) {
    fputs("\n</table></div>\n", out);
}

void jox_html_picture(FILE *out, const char *file, const char *link, const char *caption) {
    fputs("<figure><a href=\"", out);
    jox_html_link(out, link ? link : file);
    fputs("\"><img loading=lazy src=\"", out);
    jox_html_link(out, file);
    fputs("\" alt=\"", out);
    jox_html_text(out, caption);
    fputs("\"></a><figcaption>", out);
    jox_html_text(out, caption);
    fputs("</figcaption></figure>\n", out);
}
