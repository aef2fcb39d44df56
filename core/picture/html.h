/* Writes HTML pages: one file with its style inside and pictures as files beside it. Used by
   report, validate and sweep. Every text argument is escaped; pages load nothing from elsewhere. */
#ifndef JOX_PICTURE_HTML_H
#define JOX_PICTURE_HTML_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Write the document's head including <h1>, or without it, and its end. */
void jox_html_begin_head(FILE *out, const char *title);
void jox_html_begin(FILE *out, const char *title);
void jox_html_end(FILE *out);

/* Writes text, escaped by jox_quote_xml. */
void jox_html_text(FILE *out, const char *text);
/* Writes an argument of a command line, quoted as a shell needs it. */
void jox_html_argument(FILE *out, const char *argument);
/* Writes a number with four significant digits, or all digits before the point; a dash if it is
   not finite. */
void jox_html_number(FILE *out, double value);
/* Write an <h2>, an <h3> and a <p>. */
void jox_html_heading(FILE *out, const char *text);
void jox_html_subheading(FILE *out, const char *text);
void jox_html_paragraph(FILE *out, const char *text);

/* Opens a table, which scrolls if it is too wide. `heads` are the column heads separated by '|';
   a leading '>' marks a column of numbers, which is flush right. Each row is jox_html_row and
   then its cells; neither needs an end. */
void jox_html_table(FILE *out, const char *heads);
void jox_html_row(FILE *out);
void jox_html_cell(FILE *out, const char *text);
/* Writes a cell flush right with a number and its unit, or "". Units as in tables ("1/m2") are
   spelled out for readers. */
void jox_html_cell_number(FILE *out, double value, const char *unit);
void jox_html_table_end(FILE *out);
/* Returns a unit of tables and files ("1/m2") as pages write it. */
const char *jox_html_unit(const char *unit);
/* Writes, below a table, a link to the file beside the page that has the same values. */
void jox_html_csv(FILE *out, const char *file);
/* Opens a table of names with texts; jox_html_fact writes a row, none without a text. */
void jox_html_facts(FILE *out);
void jox_html_fact(FILE *out, const char *name, const char *text);

/* Writes a paragraph that begins with `lead` in bold. */
void jox_html_statement(FILE *out, const char *lead, const char *text);

/* Opens a grid of pictures of one size: two in a line, or with `whole` one. */
void jox_html_panels(FILE *out, bool whole);
void jox_html_panels_end(FILE *out);
/* Shows NAME.png of the page's folder with a link to NAME.svg, or the one of both that exists;
   nothing if there is neither. `wide`: as wide as the page. */
void jox_html_figure(FILE *out, const char *folder, const char *name, const char *caption,
                     bool wide);
/* A picture of `count` strips of `width` by `height` px one below the other; the first one has
   `head` px more, for a title. `half`: two thirds as wide as a printed page. */
typedef struct JoxStrips {
    int count, width, height, head;
    bool half;
} JoxStrips;
/* Shows NAME.png so that a printed page may end between two of its strips; nothing if there is
   none. */
void jox_html_strips(FILE *out, const char *folder, const char *name, const char *caption,
                     const JoxStrips *strips);
/* Shows a picture file beside the page with a link to `link` (NULL: to itself). */
void jox_html_picture(FILE *out, const char *file, const char *link, const char *caption);

#endif
