#include "base/format/quote.h"

#include <string.h>

#include "base/mem.h"

/* Returns a copy without control characters, for the caller to free. */
static char *copy_cleaned(const char *text) {
    char *clean = jox_strdup(text);
    jox_text_clean(clean);
    return clean;
}

static bool is_plain_character(char c, const char *others) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (c && strchr(others, c));
}

static bool has_plain_characters(const char *text, const char *others) {
    for (; *text; text++)
        if (!is_plain_character(*text, others))
            return false;
    return true;
}

/* Appends the text between two `mark`, with `inner` in place of each `mark` in the text. */
static void enclose(JoxText *out, const char *text, char mark, const char *inner) {
    char *clean = copy_cleaned(text);
    jox_text_append(out, &mark, 1);
    for (const char *c = clean; *c; c++)
        if (*c == mark)
            jox_text_add(out, inner);
        else
            jox_text_append(out, c, 1);
    jox_text_append(out, &mark, 1);
    jox_free(clean);
}

/* Uses double quotes with octal escapes. Single quotes cannot hold every text: gnuplot 5.4 takes a
   pair of them at the beginning of a string, or next to another pair, for the string's end. */
void jox_quote_gnuplot(JoxText *out, const char *text) {
    char *clean = copy_cleaned(text);
    jox_text_append(out, "\"", 1);
    for (const unsigned char *c = (const unsigned char *)clean; *c; c++)
        if (*c >= 0x80 || is_plain_character((char)*c, " -_.,:;()/+=?!*"))
            jox_text_append(out, (const char *)c, 1);
        else
            jox_text_printf(out, "\\%03o", *c);
    jox_text_append(out, "\"", 1);
    jox_free(clean);
}

void jox_quote_css(JoxText *out, const char *text) {
    char *clean = copy_cleaned(text);
    jox_text_append(out, "\"", 1);
    for (const unsigned char *c = (const unsigned char *)clean; *c; c++)
        if (*c >= 0x80 || is_plain_character((char)*c, " -_.,:;()+"))
            jox_text_append(out, (const char *)c, 1);
        else
            jox_text_printf(out, "\\%06x", *c);
    jox_text_append(out, "\"", 1);
    jox_free(clean);
}

void jox_quote_gnuplot_file(JoxText *out, const char *text) {
    JoxText path = {0};
    jox_text_printf(&path, "%s%s", *text == '/' ? "" : "./", text);
    jox_quote_gnuplot(out, path.data);
    jox_text_free(&path);
}

/* Returns the XML entity of a character that must not stand for itself; else NULL. */
static const char *find_entity(char c) {
    switch (c) {
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '&':
        return "&amp;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return NULL;
    }
}

void jox_quote_xml(JoxText *out, const char *text) {
    char *clean = copy_cleaned(text); /* has the same length as the text */
    for (size_t i = 0; clean[i]; i++) {
        const char *stands = find_entity(clean[i]);
        if (stands)
            jox_text_add(out, stands);
        else
            jox_text_append(out, text[i] == '\n' ? text + i : clean + i, 1);
    }
    jox_free(clean);
}

void jox_quote_url(JoxText *out, const char *text) {
    for (; *text; text++)
        jox_text_printf(out, is_plain_character(*text, "-_./") ? "%c" : "%%%02X",
                        (unsigned char)*text);
}

void jox_quote_csv(JoxText *out, const char *text) {
    if (has_plain_characters(text, " -_./:()"))
        jox_text_add(out, text);
    else
        enclose(out, text, '"', "\"\"");
}

void jox_quote_shell(JoxText *out, const char *text) {
    if (*text && has_plain_characters(text, "-_./:=,+@%"))
        jox_text_add(out, text);
    else
        enclose(out, text, '\'', "'\\''");
}

void jox_quote_markdown(JoxText *out, const char *text) {
    char *clean = copy_cleaned(text);
    for (const char *c = clean; *c; c++) {
        const char *stands = *c == '<' || *c == '&' ? find_entity(*c) : NULL;
        if (stands) {
            jox_text_add(out, stands);
            continue;
        }
        if (strchr("\\`*[]|", *c))
            jox_text_append(out, "\\", 1);
        jox_text_append(out, c, 1);
    }
    jox_free(clean);
}

void jox_quote_file_name(JoxText *out, const char *text) {
    char *clean = copy_cleaned(text);
    for (char *c = clean; *c; c++)
        if (*c == '/' || (c == clean && (*c == '.' || *c == '-')))
            *c = '_';
    jox_text_add(out, *clean ? clean : "_");
    jox_free(clean);
}

void jox_quote_put(FILE *out, JoxQuote *quote, const char *text) {
    JoxText quoted = {0};
    quote(&quoted, text);
    if (quoted.data)
        fwrite(quoted.data, 1, quoted.length, out);
    jox_text_free(&quoted);
}
