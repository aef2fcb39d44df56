/* Quoting of text for other programs, one function per language. Each takes any bytes and yields
   one harmless token of its language. SQL needs none: values are bound to statements. */
#ifndef JOX_BASE_FORMAT_QUOTE_H
#define JOX_BASE_FORMAT_QUOTE_H

#include <stdio.h>

#include "base/text.h"

/* Appends `text`, quoted. Control characters and bytes that are not UTF-8 become '?' or blanks
   (jox_text_clean), so that the result is one line; jox_quote_xml keeps line ends, which are
   harmless there. */
typedef void JoxQuote(JoxText *out, const char *text);

/* Writes a gnuplot string in double quotes, with octal escapes for characters that gnuplot would
   expand or that would end the string. Labels need `noenhanced` too, else _ ^ { } are markup. */
JoxQuote jox_quote_gnuplot;
/* Writes a file's name for gnuplot: as above, with "./" before a relative path, since names that
   begin with < or | would be commands. */
JoxQuote jox_quote_gnuplot_file;
/* Writes text or the value of an attribute of HTML, SVG and XML; without the attribute's quotes. */
JoxQuote jox_quote_xml;
/* Writes a string of CSS in double quotes, harmless within <style>, too: all ASCII characters but
   letters, digits, blanks and .,:;()-_+ are written by their code. */
JoxQuote jox_quote_css;
/* Writes a path for the attribute of a link: all except letters, digits and -_./ becomes %XX. */
JoxQuote jox_quote_url;
/* Writes a field of a CSV file (RFC 4180), in quotes if it needs them. */
JoxQuote jox_quote_csv;
/* Writes an argument of a command for a POSIX shell, in quotes if it needs them. */
JoxQuote jox_quote_shell;
/* Writes a cell of a Markdown table. */
JoxQuote jox_quote_markdown;
/* Writes one component of a path, to name a file by a name that a user gave: '/' becomes '_', as
   does a
   '.' or '-' at its beginning. */
JoxQuote jox_quote_file_name;

/* Writes the quoted text to a file. */
void jox_quote_put(FILE *out, JoxQuote *quote, const char *text);

#endif
