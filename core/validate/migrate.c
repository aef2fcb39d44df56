/* jo_migrate: replaces renamed names in scenes, behaviours and mods. jo_check finds which and
   where; every other byte of a file stays as it is. `jostle migrate` is the caller. */
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/noun.h"
#include "base/format/path.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "run/run.h"
#include "validate/check.h"

enum { MOST_BYTES = 64 << 20, MOST_ROUNDS = 100 };

/* State of one call. */
typedef struct Migration {
    const char *const *paths;
    size_t count;
    bool writes;
    JoMessage *message;
    void *context;
    size_t names, errors; /* names replaced (or to be replaced); other errors that are left */
    JoxText unread;       /* files and folders that could not be read, a line each */
    JoError *error;
} Migration;

/* Returns whether a file was given, or is in a folder that was; no other file is written. */
static bool is_given_file(const Migration *m, const char *file) {
    char real[PATH_MAX], given[PATH_MAX];
    if (!realpath(file, real))
        return false;
    for (size_t p = 0; p < m->count; p++) {
        const size_t length = realpath(m->paths[p], given) ? strlen(given) : 0;
        if (length && strncmp(real, given, length) == 0 &&
            (real[length] == 0 || real[length] == '/'))
            return true;
    }
    return false;
}

/* Returns whether a diagnostic is about a renamed name in a file. */
static bool is_rename(const JoxDiagnostic *d) {
    return d->now && d->file;
}

/* Returns whether a character can be part of a Lua name. */
static bool is_word_char(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* Returns whether a byte can be part of a name in any script (UTF-8). */
static bool is_name_char(char c) {
    return is_word_char(c) || ((unsigned char)c & 0x80);
}

/* Returns whether the new name can replace the old one without adding quotes; in Lua, a name
   with spaces for instance needs them. */
static bool fits_unquoted(const JoxDiagnostic *d, const char *text, const char *at) {
    const size_t length = strlen(d->file);
    const bool lua = length >= 4 && strcmp(d->file + length - 4, ".lua") == 0;
    bool word = !(d->now[0] >= '0' && d->now[0] <= '9');
    for (const char *c = d->now; *c; c++)
        word = word && is_word_char(*c);
    return word || !lua || (at > text && (at[-1] == '"' || at[-1] == '\''));
}

/* Returns whether a position in a line is at a column, counted in characters or in bytes. A name
   in quotes has the column of its quote. */
static bool is_at_column(const char *line, const char *at, int column) {
    const int quoted = at > line && (at[-1] == '"' || at[-1] == '\'');
    int letters = 0;
    for (const char *c = line; c < at; c++)
        letters += ((unsigned char)*c & 0xc0) != 0x80;
    const int off[] = {letters + 1 - column, (int)(at - line) + 1 - column};
    return off[0] == 0 || off[1] == 0 || (quoted && (off[0] == 1 || off[1] == 1));
}

/* Finds the old name of a diagnostic in a text: a whole word in its line, at its column or the
   only one. Returns NULL if that is ambiguous. */
static const char *find_old_name(const JoxDiagnostic *d, const char *text) {
    const char *line = text, *found = NULL;
    const size_t length = strlen(d->was);
    for (int n = 1; n < d->line && line; n++)
        line = (line = strchr(line, '\n')) ? line + 1 : NULL;
    const char *end = line ? line + strcspn(line, "\n") : NULL;
    uint32_t times = 0, exact = 0;
    for (const char *at = line; at && at + length <= end; at++) {
        if (strncmp(at, d->was, length) != 0 || is_name_char(at[length]) ||
            (at > line && is_name_char(at[-1])))
            continue;
        const bool is = is_at_column(line, at, d->column);
        if (is || exact == 0)
            found = at;
        exact += is;
        times++;
    }
    return exact == 1 || times == 1 ? found : NULL;
}

/* Returns the text with the new name, for the caller to free, and reports the replacement; NULL
   if the position is ambiguous or the new name does not fit there. */
static char *replace_name(const Migration *m, const JoxDiagnostic *d, const char *text) {
    const char *at = find_old_name(d, text);
    if (!at || !fits_unquoted(d, text, at))
        return NULL;
    JoxText out = {0}, said = {0};
    jox_text_append(&out, text, (size_t)(at - text));
    jox_text_add(&out, d->now);
    jox_text_add(&out, at + strlen(d->was));
    jox_text_printf(&said, "%s:%d:%d: '%s' %s '%s'\n", d->file, d->line, d->column, d->was,
                    m->writes ? "is now" : "becomes", d->now);
    jox_run_message(m->message, m->context, said.data);
    jox_text_free(&said);
    return out.data;
}

/* Replaces a file by a text. Returns false with the error. */
static bool write_migrated_file(const Migration *m, const char *path, const char *text) {
    FILE *file = jox_file_replace(path);
    const size_t length = strlen(text);
    const bool good = file && fwrite(text, 1, length, file) == length && fflush(file) == 0 &&
                      fsync(fileno(file)) == 0;
    const bool whole = file && (good ? jox_file_close(file) : (jox_file_drop(file), EOF)) == 0;
    if (!whole)
        jox_error(m->error, JO_FAILED, "cannot write '%.300s': %s", path, jox_file_why(errno));
    return whole;
}

/* Collects a line for each file or folder that could not be read. */
static void collect_unread(Migration *m, const JoxDiagnostics *all) {
    JoxDiagnostics unread = {.limit = all->count};
    for (size_t i = 0; i < all->count; i++) {
        const JoxDiagnostic *d = &all->items[i];
        if (strcmp(d->code, JOX_CHECK_UNREADABLE) == 0 || strcmp(d->code, JOX_CHECK_UNREAD) == 0)
            jox_diag_add(&unread, d->severity, (JoxPosition){d->file, d->line, d->column, 0},
                         d->code, d->hint, d->context, d->source, "%s", d->message);
    }
    jox_text_free(&m->unread);
    jox_diag_print(&unread, &m->unread);
    jox_diag_free(&unread);
}

/* Replaces the names in one file, for its diagnostics from `first` on. A replacement moves the
   columns behind it, so other diagnostics of the same line are left for the next round. */
static bool migrate_file(Migration *m, const JoxDiagnostics *all, size_t first) {
    const char *path = all->items[first].file;
    size_t length;
    char *text = jox_read_file(path, MOST_BYTES, &length);
    if (!text || strlen(text) != length) { /* a file with a zero byte is not text */
        jox_free(text);
        return true;
    }
    uint32_t changed = 0;
    for (size_t i = first; i < all->count; i++) {
        const JoxDiagnostic *d = &all->items[i];
        bool other = !is_rename(d) || strcmp(d->file, path) != 0;
        for (size_t k = first; k < i && !other; k++)
            other = m->writes && is_rename(&all->items[k]) && all->items[k].line == d->line &&
                    strcmp(all->items[k].file, path) == 0;
        char *next = other ? NULL : replace_name(m, d, text);
        if (!next)
            continue;
        changed++;
        m->errors -= !m->writes;
        if (m->writes) {
            jox_free(text);
            text = next;
        } else {
            jox_free(next);
        }
    }
    m->names += changed;
    const bool good = !m->writes || !changed || write_migrated_file(m, path, text);
    jox_free(text);
    return good;
}

/* Returns the index of the first rename in the same file as diagnostic i. */
static size_t find_first_in_file(const JoxDiagnostics *all, size_t i) {
    size_t first = 0;
    while (first < i && !(is_rename(&all->items[first]) &&
                          jox_path_same(all->items[first].file, all->items[i].file)))
        first++;
    return first;
}

/* Checks all paths and replaces names once. A renamed name may hide errors behind it, so the
   caller repeats this. */
static bool migrate_round(Migration *m) {
    JoxDiagnostics all = jox_check_paths(m->paths, m->count);
    bool good = true;
    m->errors = all.errors;
    collect_unread(m, &all);
    for (size_t i = 0; i < all.count && good; i++) {
        const JoxDiagnostic *d = &all.items[i];
        if (!is_rename(d) || !is_given_file(m, d->file))
            continue;
        const size_t first = find_first_in_file(&all, i);
        if (first == i)
            good = migrate_file(m, &all, i);
        else /* the same file by another path */
            m->errors -= !m->writes && strcmp(all.items[first].file, d->file) != 0;
    }
    jox_diag_free(&all);
    return good;
}

static bool migrate_paths(Migration *m) {
    size_t before;
    int rounds = 0;
    do {
        before = m->names;
        if (!migrate_round(m))
            return false;
    } while (m->writes && m->names > before && ++rounds < MOST_ROUNDS);
    return true;
}

bool jo_migrate(const char *const *paths, size_t count, bool write, JoMessage *message,
                void *context, size_t *names, size_t *errors, JoError *error) {
    JOX_REQUIRE(paths && message && names && errors, false);
    JOX_GUARD (NULL, error)
        return false;
    Migration m = {.paths = paths,
                   .count = count,
                   .writes = write,
                   .message = message,
                   .context = context,
                   .error = error};
    const bool good = migrate_paths(&m);
    if (good && m.unread.length)
        jox_run_message(message, context, m.unread.data);
    jox_text_free(&m.unread);
    *names = m.names;
    *errors = m.errors;
    return good;
}
