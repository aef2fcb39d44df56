/* Pages for people: one HTML file with the style in it, pictures as files beside it. Every text is
   escaped; nothing is fetched from elsewhere. */
#ifndef JOX_PICTURE_HTML_H
#define JOX_PICTURE_HTML_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* The head up to and with <h1>, and what closes the page. */
void jox_html_begin(FILE *out, const char *title);
void jox_html_end(FILE *out);

/* Text as it reads, by jox_quote_xml. */
void jox_html_text(FILE *out, const char *text);
/* An argument of a command line, as one types it in a shell. */
void jox_html_argument(FILE *out, const char *argument);
/* The path of a link, by jox_quote_url. */
void jox_html_link(FILE *out, const char *path);
/* Four digits, or all before the point; a dash where it is not finite. */
void jox_html_number(FILE *out, double value);
/* <h2> and <p>, escaped. */
void jox_html_heading(FILE *out, const char *text);
void jox_html_subheading(FILE *out, const char *text); /* <h3> */
void jox_html_paragraph(FILE *out, const char *text);

/* A table that scrolls where it is too wide: heads in order, parted by '|', those of
   numbers begun by '>'. Rows are made of
   jox_html_row, then cells, which need no end. */
void jox_html_table(FILE *out, const char *heads);
void jox_html_row(FILE *out);
void jox_html_cell(FILE *out, const char *text);
/* Flush right; `unit`, as "1/m2", is told as people read it and may be "". */
void jox_html_cell_number(FILE *out, double value, const char *unit);
void jox_html_table_end(FILE *out);

/* A paragraph that begins with words in bold. */
void jox_html_statement(FILE *out, const char *lead, const char *text);

/* Pictures of one size, side by side unless each takes a `whole` line. */
void jox_html_panels(FILE *out, bool whole);
void jox_html_panels_end(FILE *out);
/* NAME.png of the page's folder with NAME.svg behind it, or that alone; nothing where there is
   neither. `wide`: across the page. */
void jox_html_figure(FILE *out, const char *folder, const char *name, const char *caption,
                     bool wide);
/* A picture beside the page, which links to `link` (NULL: to itself). */
void jox_html_picture(FILE *out, const char *file, const char *link, const char *caption);

#endif
