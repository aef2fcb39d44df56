/* The text of input logs: read by the rows of verb_table.c, and written. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/lifts.h"
#include "world/verbs/verb_table.h"

enum { LONGEST_LINE = 1200 };

/* ---- words of a line ---- */

/* Reads a line; errors go to `wrong`, their columns to `column` and `end_column`. */
typedef struct Reader {
    const char *line, *at, *end;
    char word[JOX_INPUT_NAME + JOX_INPUT_PATH];
    int number;             /* number of the line */
    int column, end_column; /* of the present word, from 1 */
    bool quoted;
    JoxText *wrong, *hint;
} Reader;

static bool refuse(Reader *r, const char *hint, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static bool refuse(Reader *r, const char *hint, const char *format, ...) {
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    jox_text_add(r->wrong, text);
    jox_text_add(r->hint, hint ? hint : "");
    return false;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/* Reads the next word into r->word; false at the end of the line, and for a word that is too long,
   not closed or has control characters, which is an error. */
static bool next_word(Reader *r) {
    size_t n = 0;
    bool closed = true;
    while (r->at < r->end && is_blank(*r->at))
        r->at++;
    r->column = r->end_column = (int)(r->at - r->line) + 1;
    if (r->at == r->end || *r->at == '#')
        return false;
    r->quoted = *r->at == '"';
    if (r->quoted) {
        r->at++;
        closed = false;
    }
    for (; r->at < r->end && !(r->quoted ? closed : is_blank(*r->at) || *r->at == '#'); r->at++) {
        if (r->quoted && *r->at == '"') {
            closed = true;
            continue;
        }
        r->at += r->quoted && *r->at == '\\' && r->at + 1 < r->end;
        if (n + 1 < sizeof r->word)
            r->word[n] = *r->at;
        n++;
        if ((unsigned char)*r->at < 0x20 || *r->at == 0x7f)
            return refuse(r, "Write it without", "a control character stands in the line");
    }
    JOX_ASSERT(r->at <= r->end);
    r->end_column = (int)(r->at - r->line) + 1;
    r->word[n < sizeof r->word ? n : sizeof r->word - 1] = 0;
    if (!closed)
        return refuse(r, "Write a quote behind it", "the name is not closed");
    if (n >= sizeof r->word)
        return refuse(r, "Shorten it", "the word is too long");
    return true;
}

static bool read_number(Reader *r, const JoxInputWord *word, double *out) {
    char *end;
    *out = r->quoted ? NAN : strtod(r->word, &end);
    char hint[160];
    const char *blank = *word->unit ? " " : "";
    snprintf(hint, sizeof hint, "From %.9g to %.9g%s%s", word->least, word->most, blank,
             word->unit);
    if (r->quoted || end == r->word || *end || isnan(*out))
        return refuse(r, hint, "%s must be a number, not '%.40s'", word->name, r->word);
    if (word->kind != JOX_WORD_NUMBER && *out != floor(*out))
        return refuse(r, hint, "%s must be a whole number, not %.9g", word->name, *out);
    if (!(*out >= word->least && *out <= word->most))
        return refuse(r, NULL, "%s must be from %.9g to %.9g%s%s, not %.9g", word->name,
                      word->least, word->most, blank, word->unit, *out);
    return true;
}

/* Checks the present word, the mode of a lift. */
static bool check_lift_mode(Reader *r) {
    for (uint32_t m = 0; m < JOX_LIFT_MODES; m++)
        if (strcmp(r->word, jox_lift_mode_names[m]) == 0)
            return true;
    return refuse(r, NULL, "a lift has no mode '%.60s': in_use, out_of_use or firemen", r->word);
}

/* Reads one word of a verb into the entry. */
static bool read_word(Reader *r, const JoxInputWord *word, JoxInputEntry *entry) {
    double value;
    uint32_t names = 0;
    if (word->kind == JOX_WORD_NAME || word->kind == JOX_WORD_PATH) {
        const size_t most = word->kind == JOX_WORD_PATH ? JOX_INPUT_PATH : JOX_INPUT_NAME;
        while (names < JOX_INPUT_NAMES && entry->names[names])
            names++;
        size_t n = strlen(r->word);
        if (n == 0 || n > most || names == JOX_INPUT_NAMES)
            return refuse(r, NULL, "%s must have from 1 to %zu bytes", word->name, most);
        entry->names[names] = jox_strdup(r->word);
        return entry->verb != JOX_INPUT_LIFT || names == 0 || check_lift_mode(r);
    }
    if (!read_number(r, word, &value))
        return false;
    JOX_ASSERT(entry->given < JOX_INPUT_NUMBERS);
    if (word->kind == JOX_WORD_NUMBER)
        entry->numbers[entry->given++] = value;
    else
        entry->number = (uint32_t)value;
    return true;
}

/* Reads a verb and its words. */
static bool read_verb(Reader *r, JoxInputEntry *entry) {
    const JoxVerb *verb = NULL;
    const char *names[JOX_INPUT_MOST_VERBS];
    JoxText usage = {0};
    if (!next_word(r))
        return r->wrong->length ? false : refuse(r, "Example: player 0 1.5 0", "there is no verb");
    for (uint32_t v = 0; v < jox_input_verb_count; v++) {
        names[v] = jox_input_verbs[v].name;
        if (strcmp(r->word, jox_input_verbs[v].name) == 0) {
            verb = &jox_input_verbs[v];
            entry->verb = v;
        }
    }
    if (!verb) {
        char hint[300] = "One of";
        for (uint32_t v = 0; v < jox_input_verb_count; v++)
            if (jox_input_verbs[v].tool || v == JOX_INPUT_FILES)
                snprintf(hint + strlen(hint), sizeof hint - strlen(hint), "%s %s", v ? "," : "",
                         names[v]);
        jox_did_you_mean(r->word, names, jox_input_verb_count, hint);
        return refuse(r, hint, "there is no verb '%.40s'", r->word);
    }
    jox_input_append_usage(verb, &usage);
    uint32_t got = 0;
    bool good = true;
    while (good && next_word(r)) {
        if (entry->verb == JOX_INPUT_THROW && got == 1 && !r->quoted && !strcmp(r->word, "here")) {
            entry->here = true; /* replaces three numbers */
            entry->given = 3;
            got = 4;
            continue;
        }
        if (got == verb->most)
            good = refuse(r, NULL, "'%.40s' is one word too many: %s", r->word, usage.data);
        else
            good = read_word(r, &verb->words[got++], entry);
    }
    good = good && !r->wrong->length;
    if (good && got != verb->least && got != verb->most) {
        char hint[80];
        snprintf(hint, sizeof hint, "Example: %s", verb->example);
        good = refuse(r, hint, "%s expects: %s", verb->name, usage.data);
    }
    jox_text_free(&usage);
    return good;
}

bool jox_input_read_line(const char *line, JoxInputEntry *entry, JoxText *wrong) {
    JoxText hint = {0};
    size_t n = strlen(line);
    Reader r = {.line = line, .at = line, .end = line + n, .wrong = wrong, .hint = &hint};
    *entry = (JoxInputEntry){0};
    bool good = n <= LONGEST_LINE
                    ? read_verb(&r, entry)
                    : refuse(&r, NULL, "the line is longer than %d bytes", LONGEST_LINE);
    if (good && !jox_input_verbs[entry->verb].tool)
        good = refuse(&r, NULL, "%s stands in logs alone; files come by being saved",
                      jox_input_verbs[entry->verb].name);
    if (!good && hint.length)
        jox_text_printf(wrong, ". %s", hint.data);
    if (!good)
        jox_input_entry_free(entry);
    jox_text_free(&hint);
    return good;
}

/* ---- a whole log ---- */

typedef struct Parser {
    JoxInputLog *log;
    const char *file, *at, *end;
    int number; /* number of the line */
    JoxDiagnostics *diagnostics;
} Parser;

/* Returns a reader of the next line, without its end. */
static Reader next_line(Parser *p, JoxText *wrong, JoxText *hint) {
    const char *newline = memchr(p->at, '\n', (size_t)(p->end - p->at));
    Reader r = {.line = p->at,
                .at = p->at,
                .end = newline ? newline : p->end,
                .wrong = wrong,
                .hint = hint,
                .column = 1,
                .end_column = 1};
    p->at = newline ? newline + 1 : p->end;
    r.number = ++p->number;
    return r;
}

/* Reads one file of a block: PATH BYTES, the bytes, the end of a line. */
static bool read_file(Parser *p, Reader *r, JoxInputFile *file) {
    static const JoxInputWord BYTES = {"BYTES", JOX_WORD_WHOLE, 0, 16777216, "bytes"};
    double bytes;
    *r = next_line(p, r->wrong, r->hint);
    if (!next_word(r))
        return r->wrong->length
                   ? false
                   : refuse(r, "Example: behaviours/walker.lua 812", "expected a file: PATH BYTES");
    if (!*r->word || strlen(r->word) > JOX_INPUT_PATH)
        return refuse(r, NULL, "the path must have from 1 to %d bytes", JOX_INPUT_PATH);
    file->path = jox_strdup(r->word);
    if (!next_word(r))
        return r->wrong->length ? false
                                : refuse(r, NULL, "how many bytes has '%.200s'?", file->path);
    if (!read_number(r, &BYTES, &bytes))
        return false;
    const int column = r->column, end_column = r->end_column;
    if (next_word(r))
        return refuse(r, NULL, "'%.40s' is one word too many: PATH BYTES", r->word);
    if (r->wrong->length)
        return false;
    r->column = column; /* later errors are about the number of bytes */
    r->end_column = end_column;
    if ((size_t)bytes > JOX_INPUT_LARGEST || (size_t)bytes > (size_t)(p->end - p->at))
        return refuse(r, "Is the log cut off?", "only %zu bytes follow, not %.0f",
                      (size_t)(p->end - p->at), bytes);
    file->length = (size_t)bytes;
    file->text = jox_strndup(p->at, file->length);
    for (size_t i = 0; i < file->length; i++)
        p->number += p->at[i] == '\n';
    p->at += file->length;
    JOX_ASSERT(p->at <= p->end);
    if (p->at < p->end && *p->at == '\n') {
        p->at++;
        p->number++;
        return true;
    }
    return p->at == p->end || refuse(r, "Count the bytes once more",
                                     "behind %.0f bytes '%.200s' does not end", bytes, file->path);
}

static bool read_files(Parser *p, Reader *r, JoxInputEntry *entry) {
    bool good = true;
    entry->files = jox_alloc(entry->number, sizeof *entry->files);
    for (uint32_t f = 0; f < entry->number && good; f++)
        good = read_file(p, r, &entry->files[f]);
    return good;
}

/* Reads an entry; *empty is true if the line has none. */
static bool read_entry(Parser *p, Reader *r, uint32_t last, JoxInputEntry *entry, bool *empty) {
    static const JoxInputWord TICK = {"TICK", JOX_WORD_WHOLE, 0, UINT32_MAX - 1.0, "steps"};
    double tick;
    if (r->end - r->line > LONGEST_LINE) {
        const char *mark = r->line + strspn(r->line, " \t\r");
        *empty = mark < r->end && *mark == '#';
        return *empty || refuse(r, NULL, "the line is longer than %d bytes", LONGEST_LINE);
    }
    *empty = !next_word(r) && !r->wrong->length;
    if (*empty || r->wrong->length)
        return *empty;
    if (!read_number(r, &TICK, &tick))
        return false;
    const Reader begin = *r;
    *entry = (JoxInputEntry){.tick = (uint32_t)tick, .line = p->number};
    if (!read_verb(r, entry) ||
        (jox_input_verbs[entry->verb].words[0].kind == JOX_WORD_FILES && !read_files(p, r, entry)))
        return false;
    r->number = begin.number; /* later errors are about the tick */
    r->column = begin.column;
    r->end_column = begin.end_column;
    return entry->tick >= last ||
           refuse(r, NULL, "ticks must not decrease: %u comes behind %u", entry->tick, last);
}

bool jox_input_parse(JoxInputLog *log, const char *file, const char *text, size_t length,
                     JoxDiagnostics *diagnostics) {
    Parser p = {log, file, text, text + length, 0, diagnostics};
    size_t errors = diagnostics->errors;
    uint32_t last = 0;
    JoxText wrong = {0}, hint = {0};
    while (p.at < p.end) {
        JoxInputEntry entry = {0};
        bool empty = true;
        Reader r = next_line(&p, &wrong, &hint);
        bool good = read_entry(&p, &r, last, &entry, &empty);
        if (good && !empty) {
            last = entry.tick;
            jox_input_add(log, entry);
            continue;
        }
        bool cut = entry.files != NULL && !good; /* the end of its files is unknown */
        jox_input_entry_free(&entry);
        if (good)
            continue;
        jox_text_clean(wrong.data);
        jox_diag_error(diagnostics, ((JoxPosition){file, r.number, r.column, r.end_column}),
                       "bad-input", hint.length ? hint.data : NULL, "%s", wrong.data);
        wrong.length = hint.length = 0;
        if (cut)
            break;
    }
    jox_text_free(&wrong);
    jox_text_free(&hint);
    return diagnostics->errors == errors;
}

/* ---- writing ---- */

static void write_name(const char *name, JoxText *out) {
    bool plain = *name && !strpbrk(name, " \t\r\"#");
    if (plain) {
        jox_text_printf(out, " %s", name);
        return;
    }
    jox_text_add(out, " \"");
    for (; *name; name++)
        jox_text_printf(out, "%s%c", *name == '"' || *name == '\\' ? "\\" : "", *name);
    jox_text_add(out, "\"");
}

/* Writes the shortest text that reads back as the same number. */
static void write_number(double number, JoxText *out) {
    char text[40];
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, number);
        if (strtod(text, NULL) == number)
            break;
    }
    jox_text_printf(out, " %s", text);
}

void jox_input_write(const JoxInputEntry *entry, JoxText *out) {
    JOX_ASSERT(entry->verb < jox_input_verb_count);
    const JoxVerb *verb = &jox_input_verbs[entry->verb];
    uint32_t name = 0, number = 0;
    jox_text_printf(out, "%u %s", entry->tick, verb->name);
    for (uint32_t w = 0; w < verb->most; w++) {
        const JoxInputWord *word = &verb->words[w];
        if (word->kind == JOX_WORD_NAME || word->kind == JOX_WORD_PATH) {
            JOX_ASSERT(name < JOX_INPUT_NAMES && entry->names[name]);
            write_name(entry->names[name++], out);
        } else if (word->kind != JOX_WORD_NUMBER) {
            jox_text_printf(out, " %u", entry->number);
        } else if (entry->here && number < 3) {
            jox_text_add(out, number == 0 ? " here" : "");
            number++;
        } else if (number < entry->given) {
            write_number(entry->numbers[number++], out);
        }
    }
    jox_text_add(out, "\n");
    for (uint32_t f = 0; entry->files && f < entry->number; f++) {
        JoxText path = {0};
        write_name(entry->files[f].path, &path);
        jox_text_printf(out, "%s %zu\n", path.data + 1, entry->files[f].length);
        jox_text_append(out, entry->files[f].text, entry->files[f].length);
        jox_text_add(out, "\n");
        jox_text_free(&path);
    }
}
