/* jo_migrate: names that are called otherwise now are rewritten where they stand. Which and where
   is what jo_check finds; every other byte of a file stays as it is. */
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

typedef struct Migration {
    const char *const *paths;
    size_t count;
    bool writes;
    JoMessage *message;
    void *context;
    size_t names, errors; /* renamed; left, that are something else */
    JoxText unread;       /* what could not be looked at, a line each */
    JoError *error;
} Migration;

/* Whether a file is one of those given, or lies in a folder that is: no other is written. */
static bool is_given(const Migration *m, const char *file) {
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

/* Whether a diagnostic is of a name that was changed, in a file. */
static bool is_renamed(const JoxDiagnostic *d) {
    return d->now && d->file;
}

static bool is_of_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* Of a name of any script. */
static bool is_of_name(char c) {
    return is_of_word(c) || ((unsigned char)c & 0x80);
}

/* Whether the new name can stand at a place of a file as it is: in Lua, names with spaces, for
   instance, need quotes. */
static bool can_stand(const JoxDiagnostic *d, const char *text, const char *at) {
    const size_t length = strlen(d->file);
    const bool lua = length >= 4 && strcmp(d->file + length - 4, ".lua") == 0;
    bool word = !(d->now[0] >= '0' && d->now[0] <= '9');
    for (const char *c = d->now; *c; c++)
        word = word && is_of_word(*c);
    return word || !lua || (at > text && (at[-1] == '"' || at[-1] == '\''));
}

/* Whether a place of a line is that of a column, in letters or in bytes; a name in quotes has the
   column of its quote. */
static bool is_at(const char *line, const char *at, int column) {
    const int quoted = at > line && (at[-1] == '"' || at[-1] == '\'');
    int letters = 0;
    for (const char *c = line; c < at; c++)
        letters += ((unsigned char)*c & 0xc0) != 0x80;
    const int off[] = {letters + 1 - column, (int)(at - line) + 1 - column};
    return off[0] == 0 || off[1] == 0 || (quoted && (off[0] == 1 || off[1] == 1));
}

/* Where the name of a diagnostic stands in a text: a whole word of its line, the one whose column
   it is, or the only one. NULL: it is not certain which. */
static const char *find_name(const JoxDiagnostic *d, const char *text) {
    const char *line = text, *found = NULL;
    const size_t length = strlen(d->was);
    for (int n = 1; n < d->line && line; n++)
        line = (line = strchr(line, '\n')) ? line + 1 : NULL;
    const char *end = line ? line + strcspn(line, "\n") : NULL;
    uint32_t times = 0, exact = 0;
    for (const char *at = line; at && at + length <= end; at++) {
        if (strncmp(at, d->was, length) != 0 || is_of_name(at[length]) ||
            (at > line && is_of_name(at[-1])))
            continue;
        const bool is = is_at(line, at, d->column);
        if (is || exact == 0)
            found = at;
        exact += is;
        times++;
    }
    return exact == 1 || times == 1 ? found : NULL;
}

/* The text with the new name, to be freed; NULL where it is not certain where the old one is, or
   the new one cannot stand there. */
static char *rewritten(const Migration *m, const JoxDiagnostic *d, const char *text) {
    const char *at = find_name(d, text);
    if (!at || !can_stand(d, text, at))
        return NULL;
    JoxText out = {0}, said = {0};
    jox_text_append(&out, text, (size_t)(at - text));
    jox_text_add(&out, d->now);
    jox_text_add(&out, at + strlen(d->was));
    jox_text_printf(&said, "%s:%d:%d: '%s' %s '%s'\n", d->file, d->line, d->column, d->was,
                    m->writes ? "is now" : "is to be", d->now);
    jox_run_message(m->message, m->context, said.data);
    jox_text_free(&said);
    return out.data;
}

/* Gives a file another text; false with the error. */
static bool write_file(const Migration *m, const char *path, const char *text) {
    FILE *file = jox_file_replace(path);
    const size_t length = strlen(text);
    const bool good = file && fwrite(text, 1, length, file) == length && fflush(file) == 0 &&
                      fsync(fileno(file)) == 0;
    const bool whole = file && (good ? jox_file_close(file) : (jox_file_drop(file), EOF)) == 0;
    if (!whole)
        jox_error(m->error, JO_FAILED, "cannot write '%.300s': %s", path, jox_file_why(errno));
    return whole;
}

/* A line for each file or folder that could not be looked at. */
static void tell_unread(Migration *m, const JoxDiagnostics *all) {
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

/* Rewrites the names of one file, of the diagnostics from `first` on. Those of a line change each
   other's columns: the later ones are left for the next round. */
static bool migrate_file(Migration *m, const JoxDiagnostics *all, size_t first) {
    const char *path = all->items[first].file;
    size_t length;
    char *text = jox_read_file(path, MOST_BYTES, &length);
    if (!text || strlen(text) != length) { /* what holds a zero byte is no text */
        jox_free(text);
        return true;
    }
    uint32_t changed = 0;
    for (size_t i = first; i < all->count; i++) {
        const JoxDiagnostic *d = &all->items[i];
        bool other = !is_renamed(d) || strcmp(d->file, path) != 0;
        for (size_t k = first; k < i && !other; k++)
            other = m->writes && is_renamed(&all->items[k]) && all->items[k].line == d->line &&
                    strcmp(all->items[k].file, path) == 0;
        char *next = other ? NULL : rewritten(m, d, text);
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
    const bool good = !m->writes || !changed || write_file(m, path, text);
    jox_free(text);
    return good;
}

/* The first diagnostic of a renamed name in the file of this one. */
static size_t first_of_file(const JoxDiagnostics *all, size_t i) {
    size_t first = 0;
    while (first < i && !(is_renamed(&all->items[first]) &&
                          jox_path_same(all->items[first].file, all->items[i].file)))
        first++;
    return first;
}

/* One look at all that is given: what is renamed may hide what is wrong behind it. */
static bool migrate_round(Migration *m) {
    JoxDiagnostics all = jox_check_paths(m->paths, m->count);
    bool good = true;
    m->errors = all.errors;
    tell_unread(m, &all);
    for (size_t i = 0; i < all.count && good; i++) {
        const JoxDiagnostic *d = &all.items[i];
        if (!is_renamed(d) || !is_given(m, d->file))
            continue;
        const size_t first = first_of_file(&all, i);
        if (first == i)
            good = migrate_file(m, &all, i);
        else /* the same place by another path */
            m->errors -= !m->writes && strcmp(all.items[first].file, d->file) != 0;
    }
    jox_diag_free(&all);
    return good;
}

static bool migrate(Migration *m) {
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
    const bool good = migrate(&m);
    if (good && m.unread.length)
        jox_run_message(message, context, m.unread.data);
    jox_text_free(&m.unread);
    *names = m.names;
    *errors = m.errors;
    return good;
}
