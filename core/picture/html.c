#include "picture/html.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/format/quote.h"

static const char STYLE[] =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;"
    "color:#1a1a1a;background:#fff}h1{font-size:1.7rem}h2{font-size:1.25rem;margin-top:2.5rem;"
    "border-top:1px solid #ccc;padding-top:1rem}h3{font-size:1.05rem;margin:1.6rem 0 .4rem}"
    "table{border-collapse:collapse;margin:1rem 0}"
    "th,td{text-align:left;padding:.25rem .8rem .25rem 0;border-bottom:1px solid #ddd;"
    "vertical-align:top}td.n,th.n{text-align:right}td.n{font-variant-numeric:tabular-nums;"
    "white-space:nowrap}.in{color:#00601f}.out{color:#a40000;font-weight:700}figure{display:"
    "inline-block;margin:.5rem 1rem .5rem 0;vertical-align:top}img{max-width:34rem;width:100%;"
    "border:1px solid #ddd}.plan img{max-width:64rem;max-height:44rem;width:auto}"
    ".panels{display:grid;grid-template-columns:1fr 1fr;gap:1rem;margin:1rem 0}"
    ".panels.whole{grid-template-columns:1fr}.panels figure,figure.wide{display:block;margin:0}"
    ".panels img,figure.wide img{max-width:100%}.summary{background:#f6f6f2;border-left:.3rem solid"
    " #82123f;padding:.4rem 1.2rem;margin:1rem 0}"
    "table.facts{margin:.4rem 0}table.facts th{width:14rem;font-weight:600}"
    ".sign td{height:2.6rem;vertical-align:bottom}nav{margin:1rem 0}nav ol{columns:2;margin:.3rem "
    "0}nav a{color:inherit}.csv{margin:-.6rem 0 1rem;font-size:.85rem;color:#555}"
    ".met{color:#00601f;font-weight:600}.failed{color:#a40000;font-weight:700}"
    "figcaption,small{color:#555}details{margin:.5rem 0}pre{overflow:auto;"
    "background:#f6f6f6;padding:.6rem;font-size:13px}.scroll{overflow-x:auto}code{font-size:.9em;"
    "overflow-wrap:anywhere}"
    ".strip{overflow:hidden}.strips{max-width:64rem}.strips .strip img{max-width:100%;border:0;"
    "display:block}"
    /* In print: no page break within a picture, a strip of one, or a row, nor after a heading, and
       nothing cut off at the right. What must not break is at most a quarter of a page high. */
    "@page{size:A4;margin:15mm}@media print{body{font-size:10pt;max-width:none;margin:0;"
    "padding:0}h1{font-size:16pt}h2{font-size:13pt;margin-top:1.2rem;padding-top:.6rem}"
    "h2,h3{break-after:avoid}p{orphans:3;widows:3}"
    "figure,tr,.strip,.summary p,.sign{break-inside:avoid}.scroll{overflow:visible}"
    "thead{break-inside:avoid;break-after:avoid}table{font-size:8.5pt;margin:.5rem 0;"
    "max-width:100%}th,td{padding:.12rem .7rem .12rem 0}td.n{white-space:normal}"
    "tr.group{break-after:avoid}tr.near{break-before:avoid}.sign table{width:100%}"
    "figure "
    "img{max-height:70mm;width:auto}figcaption{font-size:8.5pt;line-height:1.3}figure.wide,.panels "
    "figure{margin:0 0 .5rem}"
    "figure.wide img{max-height:60mm;width:auto}.plan figure.wide img{max-height:76mm}"
    "figure.strips{break-inside:auto}figure.strips .strip img{max-height:none;width:100%}"
    "figure.strips figcaption{break-before:avoid}figure.strips.half{max-width:125mm}"
    ".csv{break-before:avoid;font-size:7.5pt;margin:-.3rem 0 "
    ".5rem}.panels{display:block;orphans:1;widows:1}.panels "
    "figure{display:inline-block;width:48.5%;margin-right:1%}"
    ".panels.whole figure{display:block;width:100%;margin-right:0}.panels img{max-height:62mm;"
    "width:auto}.panels.whole img{max-height:50mm}"
    ".summary{font-size:9.5pt;-webkit-print-color-adjust:exact;print-color-adjust:exact}"
    "a{color:inherit;text-decoration:none}}";

void jox_html_text(FILE *out, const char *text) {
    jox_quote_put(out, jox_quote_xml, text);
}

void jox_html_argument(FILE *out, const char *argument) {
    JoxText quoted = {0};
    jox_quote_shell(&quoted, argument);
    jox_html_text(out, quoted.data);
    jox_text_free(&quoted);
}

/* Writes the path of a link, encoded by jox_quote_url. */
static void put_link(FILE *out, const char *path) {
    jox_quote_put(out, jox_quote_url, path);
}

void jox_html_begin_head(FILE *out, const char *title) {
    fputs("<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport "
          "content=\"width=device-width\"><title>",
          out);
    jox_html_text(out, title);
    fprintf(out, "</title><style>%s</style>\n", STYLE);
}

void jox_html_begin(FILE *out, const char *title) {
    jox_html_begin_head(out, title);
    fputs("<h1>", out);
    jox_html_text(out, title);
    fputs("</h1>\n", out);
}

void jox_html_end(FILE *out) {
    fputs("</html>\n", out);
}

/* Numbers from 1e6 on and very small ones are written with a power of ten. */
void jox_html_number(FILE *out, double value) {
    char text[40];
    const double size = fabs(value);
    if (!isfinite(value)) {
        fputs("&ndash;", out);
        return;
    }
    const bool whole = size < 1e6 && value == floor(value);
    snprintf(text, sizeof text, whole || (size >= 1e3 && size < 1e6) ? "%.0f" : "%.4g", value);
    const char *power = strchr(text, 'e');
    if (power)
        fprintf(out, "%.*s&nbsp;&times;&nbsp;10<sup>%s%d</sup>", (int)(power - text), text,
                power[1] == '-' ? "&minus;" : "", abs(atoi(power + 1)));
    else
        fputs(text, out);
}

static void put_element(FILE *out, const char *name, const char *text) {
    fprintf(out, "<%s>", name);
    jox_html_text(out, text);
    fprintf(out, "</%s>\n", name);
}

void jox_html_heading(FILE *out, const char *text) {
    put_element(out, "h2", text);
}

void jox_html_subheading(FILE *out, const char *text) {
    put_element(out, "h3", text);
}

void jox_html_paragraph(FILE *out, const char *text) {
    put_element(out, "p", text);
}

void jox_html_statement(FILE *out, const char *lead, const char *text) {
    fputs("<p><b>", out);
    jox_html_text(out, lead);
    fputs("</b> ", out);
    jox_html_text(out, text);
    fputs("</p>\n", out);
}

void jox_html_table(FILE *out, const char *heads) {
    fputs("<div class=scroll><table><thead><tr>", out);
    while (*heads) {
        size_t length = strcspn(heads, "|");
        char head[128];
        snprintf(head, sizeof head, "%.*s", (int)length, heads);
        const bool right = *head == '>';
        fputs(right ? "<th class=n>" : "<th>", out);
        jox_html_text(out, head + right);
        heads += length + (heads[length] == '|');
    }
    fputs("</thead>", out);
}

void jox_html_row(FILE *out) {
    fputs("\n<tr>", out);
}

void jox_html_cell(FILE *out, const char *text) {
    fputs("<td>", out);
    jox_html_text(out, text);
}

const char *jox_html_unit(const char *unit) {
    static const char *const TEXTS[][2] = {
        {"1/m2", "per m\xc2\xb2"},  {"1/s2", "per s\xc2\xb2"},      {"1/s", "per s"},
        {"1/(m s)", "per m and s"}, {"1/(m min)", "per m and min"}, {"m2", "m\xc2\xb2"},
    };
    for (size_t t = 0; t < sizeof TEXTS / sizeof *TEXTS; t++)
        if (strcmp(TEXTS[t][0], unit) == 0)
            return TEXTS[t][1];
    return unit;
}

void jox_html_cell_number(FILE *out, double value, const char *unit) {
    fputs("<td class=n>", out);
    jox_html_number(out, value);
    if (*unit && isfinite(value)) {
        fputs("&nbsp;", out);
        jox_html_text(out, jox_html_unit(unit));
    }
}

void jox_html_table_end(FILE *out) {
    fputs("\n</table></div>\n", out);
}

void jox_html_csv(FILE *out, const char *file) {
    fputs("<p class=csv>This table as CSV: <a href=\"", out);
    put_link(out, file);
    fputs("\">", out);
    jox_html_text(out, file);
    fputs("</a></p>\n", out);
}

void jox_html_fact(FILE *out, const char *name, const char *text) {
    if (!text || !*text)
        return;
    fputs("\n<tr><th>", out);
    jox_html_text(out, name);
    jox_html_cell(out, text);
}

void jox_html_facts(FILE *out) {
    fputs("<div class=scroll><table class=facts>", out);
}

void jox_html_panels(FILE *out, bool whole) {
    fputs(whole ? "<div class=\"panels whole\">\n" : "<div class=panels>\n", out);
}

void jox_html_panels_end(FILE *out) {
    fputs("</div>\n", out);
}

/* Returns whether a file of a folder exists and can be read. */
static bool is_readable_in(const char *folder, const char *file) {
    JoxText path = {0};
    jox_text_printf(&path, "%s/%s", folder, file);
    const bool there = access(path.data, R_OK) == 0;
    jox_text_free(&path);
    return there;
}

/* Writes a picture with its caption as a link to `link` (NULL: to itself). */
static void put_picture(FILE *out, const char *file, const char *link, const char *caption,
                        bool wide) {
    fputs(wide ? "<figure class=wide><a href=\"" : "<figure><a href=\"", out);
    put_link(out, link ? link : file);
    fputs("\"><img src=\"", out);
    put_link(out, file);
    fputs("\" alt=\"", out);
    jox_html_text(out, caption);
    fputs("\"></a><figcaption>", out);
    jox_html_text(out, caption);
    fputs("</figcaption></figure>\n", out);
}

void jox_html_figure(FILE *out, const char *folder, const char *name, const char *caption,
                     bool wide) {
    char png[160], svg[160];
    snprintf(png, sizeof png, "%.150s.png", name);
    snprintf(svg, sizeof svg, "%.150s.svg", name);
    const bool image = is_readable_in(folder, png), drawing = is_readable_in(folder, svg);
    if (image || drawing)
        put_picture(out, image ? png : svg, drawing ? svg : NULL, caption, wide);
}

void jox_html_strips(FILE *out, const char *folder, const char *name, const char *caption,
                     const JoxStrips *strips) {
    char png[160], svg[160];
    snprintf(png, sizeof png, "%.150s.png", name);
    snprintf(svg, sizeof svg, "%.150s.svg", name);
    if (!is_readable_in(folder, png))
        return;
    fprintf(out, "<figure class=\"wide strips%s\">\n", strips->half ? " half" : "");
    for (int k = 0; k < strips->count; k++) {
        const int above = k ? strips->head + k * strips->height : 0;
        fprintf(out, "<div class=strip style=\"aspect-ratio:%d/%d\"><a href=\"", strips->width,
                strips->height + (k ? 0 : strips->head));
        put_link(out, svg);
        fputs("\"><img src=\"", out);
        put_link(out, png);
        fprintf(out, "\" style=\"margin-top:-%.4f%%\" alt=\"", 100.0 * above / strips->width);
        jox_html_text(out, k ? "" : caption);
        fputs("\"></a></div>\n", out);
    }
    fputs("<figcaption>", out);
    jox_html_text(out, caption);
    fputs("</figcaption></figure>\n", out);
}

void jox_html_picture(FILE *out, const char *file, const char *link, const char *caption) {
    put_picture(out, file, link, caption, false);
}
