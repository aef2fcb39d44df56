/* Text that another program interprets: one function for each language. They take any bytes, and
   what comes out is one harmless token of that language. SQL has none: its values are bound. */
#ifndef JOX_BASE_FORMAT_QUOTE_H
#define JOX_BASE_FORMAT_QUOTE_H

#include <stdio.h>

#include "base/text.h"

/* Appends `text`, quoted. In all of them control characters and bytes that are not UTF-8 become '?'
   or blanks (jox_text_clean), so that the result stays on one line; jox_quote_xml keeps the ends of
   lines, which mean nothing there. */
typedef void JoxQuote(JoxText *out, const char *text);

/* A gnuplot string in double quotes, with octal escapes for all that gnuplot would expand or that
   would end the string. Text that is shown also needs `noenhanced`, else _ ^ { } are markup. */
JoxQuote jox_quote_gnuplot;
/* The name of a file for gnuplot: as above, with "./" before a relative path, since names that
   begin with < or | would be commands. */
JoxQuote jox_quote_gnuplot_file;
/* Text or the value of an attribute of HTML, SVG and XML; without the attribute's quotes. */
JoxQuote jox_quote_xml;
/* A path in the attribute of a link: all but letters, digits and -_./ becomes %XX. */
JoxQuote jox_quote_url;
/* One field of a CSV file (RFC 4180): in quotes where it needs them. */
JoxQuote jox_quote_csv;
/* One argument of a command for a POSIX shell: in quotes where it needs them. */
JoxQuote jox_quote_shell;
/* A cell of a table of Markdown. */
JoxQuote jox_quote_markdown;
/* One component of a path, to make a file's name of a name: '/' becomes '_', as does a '.' or '-'
   at its beginning. */
JoxQuote jox_quote_file_name;

/* Writes what `quote` makes of a text to a file. */
void jox_quote_put(FILE *out, JoxQuote *quote, const char *text);

#endif
