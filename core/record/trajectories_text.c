/* Reads trajectories from text: columns in a fixed order, or named by a header line. trajectories.c
   calls it. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/mem.h"
#include "record/trajectories.h"

enum { ID, FRAME, X, Y, VX, VY, TIME, STOREY, COLUMNS, MOST_FIELDS = 64, LONGEST_NAME = 64 };
static const char *const NAMES[COLUMNS] = {"id", "frame", "x", "y", "v_x", "v_y", "time", "storey"};
static const float APART = 3.0f; /* m: between storeys, whose heights texts do not have */

typedef struct Text {
    JoxTrajectories *t;
    JoxDiagnostics *diagnostics;
    const char *path;
    int line;
    int column_of[COLUMNS]; /* field of each column; -1: none */
    double unit, fps;       /* m, frames per second; 0: unknown */
    char separator;         /* ' ' stands for blanks and tabs */
    bool named;             /* a header line was read */
    /* A column of storeys: their names or numbers as they come, and the storey of each row. */
    char *storeys[JOX_MOST_STOREYS];
    uint32_t storey_count;
    uint16_t *storey;
    size_t storey_capacity;
    double first_time, last_time, first_frame, last_frame;
} Text;

typedef struct Field {
    const char *at;
    size_t length;
} Field;

static void add_field_error(Text *r, int column, const char *hint, const char *format,
                            const char *word, size_t length) {
    char shown[41];
    snprintf(shown, sizeof shown, "%.*s", (int)(length < 40 ? length : 40), word);
    JoxPosition at = {r->path, r->line, column, column + (int)jox_count_characters(word, length)};
    jox_diag_error(r->diagnostics, at, "bad-recording", hint, format, shown);
}

/* Returns the position after the first occurrence of a word, in any case; NULL if there is none. */
static const char *find_after_word(const char *text, const char *word) {
    size_t n = strlen(word);
    for (; *text; text++)
        if (!strncasecmp(text, word, n))
            return text + n;
    return NULL;
}

/* Returns the unit, m, after a column's name, as in "x/cm", "x_m", "x [m]", "X[in m]"; 0 if there
   is none. */
static double parse_unit(const char *rest) {
    rest += strspn(rest, " \t_/[(");
    if (!strncasecmp(rest, "in ", 3))
        rest += 3;
    size_t n = strspn(rest, "cm");
    if (isalnum((unsigned char)rest[n]))
        return 0.0;
    return n == 1 && *rest == 'm' ? 1.0 : n == 2 && !strncmp(rest, "cm", 2) ? 0.01 : 0.0;
}

/* Takes frame rate and unit from a comment: "# framerate: 25 fps", "# id frame x/m y/m z/m", "# ...
   x [in cm]". */
static void read_comment(Text *r, const char *line, size_t length) {
    char text[512];
    snprintf(text, sizeof text, "%.*s", (int)(length < 511 ? length : 511), line);
    const char *rate = find_after_word(text, "framerate");
    rate = rate ? rate : find_after_word(text, "frame rate");
    rate = rate ? rate : find_after_word(text, "fps");
    if (rate && r->fps == 0.0) {
        double fps = strtod(rate + strspn(rate, " \t:=*"), NULL);
        r->fps = fps > 0.0 && fps <= 1e5 ? fps : 0.0;
    }
    for (const char *at = text; *at && r->unit == 0.0; at++) {
        bool starts = at == text || !isalnum((unsigned char)at[-1]);
        if (starts && (*at == 'x' || *at == 'X') && strchr(" \t/[(", at[1]) && at[1])
            r->unit = parse_unit(at + 1);
    }
}

/* Splits a line at the separator, without blanks and quotation marks around fields. Returns the
   number of fields. */
static uint32_t split_fields(const Text *r, const char *line, size_t length,
                             Field fields[MOST_FIELDS]) {
    uint32_t count = 0;
    size_t at = 0;
    while (at < length && count < MOST_FIELDS) {
        size_t end = at;
        if (r->separator == ' ') {
            while (at < length && (line[at] == ' ' || line[at] == '\t'))
                at++;
            end = at;
            while (end < length && line[end] != ' ' && line[end] != '\t')
                end++;
            if (end == at)
                break;
        } else {
            while (end < length && line[end] != r->separator)
                end++;
        }
        size_t from = at, to = end;
        while (from < to && (line[from] == ' ' || line[from] == '\t' || line[from] == '"'))
            from++;
        while (to > from && (line[to - 1] == ' ' || line[to - 1] == '\t' || line[to - 1] == '"'))
            to--;
        fields[count++] = (Field){line + from, to - from};
        at = end + 1;
    }
    return count;
}

static void choose_separator(Text *r, const char *line, size_t length) {
    r->separator = memchr(line, ',', length)    ? ','
                   : memchr(line, ';', length)  ? ';'
                   : memchr(line, '\t', length) ? '\t'
                                                : ' ';
    if (r->separator == '\t' && memchr(line, ' ', length))
        r->separator = ' ';
}

/* Returns the column that a name stands for, and sets the unit in the name, m; -1 for unused
   names. */
static int find_column(const char *name, double *unit) {
    static const struct {
        const char *text;
        int column;
    } KNOWN[] = {{"id", ID},        {"persid", ID},   {"person", ID},   {"ped_id", ID},
                 {"frame", FRAME},  {"fr", FRAME},    {"v_x", VX},      {"vx", VX},
                 {"v_y", VY},       {"vy", VY},       {"time_s", TIME}, {"time", TIME},
                 {"t_s", TIME},     {"x", X},         {"y", Y},         {"storey", STOREY},
                 {"level", STOREY}, {"floor", STOREY}};
    *unit = 0.0;
    for (size_t k = 0; k < sizeof KNOWN / sizeof *KNOWN; k++)
        if (!strcasecmp(name, KNOWN[k].text))
            return KNOWN[k].column;
    if ((*name == 'x' || *name == 'X' || *name == 'y' || *name == 'Y') && name[1] &&
        strchr(" _/[(", name[1]) && (*unit = parse_unit(name + 1)) > 0.0)
        return tolower((unsigned char)*name) == 'x' ? X : Y;
    return !strncasecmp(name, "time", 4) && name[4] && strchr(" _/[(", name[4]) ? TIME : -1;
}

/* Reads column names and units from a header line. Returns false with errors if a column is
   missing. */
static bool read_header(Text *r, const char *line, size_t length) {
    Field fields[MOST_FIELDS];
    choose_separator(r, line, length);
    uint32_t count = split_fields(r, line, length, fields);
    bool good = true;
    for (int c = 0; c < COLUMNS; c++)
        r->column_of[c] = -1;
    for (uint32_t f = 0; f < count; f++) {
        char name[LONGEST_NAME];
        double unit;
        snprintf(name, sizeof name, "%.*s", (int)fields[f].length, fields[f].at);
        int column = find_column(name, &unit);
        if (column < 0 || r->column_of[column] >= 0)
            continue;
        r->column_of[column] = (int)f;
        if (unit > 0.0 && r->unit == 0.0)
            r->unit = unit;
    }
    for (int c = ID; c <= Y; c++)
        if (r->column_of[c] < 0) {
            add_field_error(r, 1, "A first line names the columns: ID,Frame,x,y",
                            "no column is named '%s'", NAMES[c], strlen(NAMES[c]));
            good = false;
        }
    r->named = true;
    return good;
}

/* Reads a finite number, an integer in the columns id and frame. Returns false with an error. */
static bool parse_field(Text *r, const char *line, const Field *fields, uint32_t count, int column,
                        double *out) {
    uint32_t f = (uint32_t)r->column_of[column];
    if (f >= count) {
        add_field_error(r, 1, "id, frame, x and y are needed in every line", "this line has no %s",
                        NAMES[column], strlen(NAMES[column]));
        return false;
    }
    char text[64], *end;
    snprintf(text, sizeof text, "%.*s", (int)(fields[f].length < 63 ? fields[f].length : 63),
             fields[f].at);
    *out = strtod(text, &end);
    bool number = end != text && *end == 0 && isfinite(*out) && !strpbrk(text, "xX");
    bool whole = column != ID && column != FRAME;
    whole |= number && *out == floor(*out) && fabs(*out) < 1e15;
    if (number && whole && (column < X || fabs(*out) < 1e8))
        return true;
    const int place = (int)jox_count_characters(line, (size_t)(fields[f].at - line)) + 1;
    add_field_error(
        r, place, whole ? "Numbers are written with a point" : "Ids and frames are counted",
        whole ? "this must be a finite number, not '%s'" : "this must be a whole number, not '%s'",
        fields[f].at, fields[f].length);
    return false;
}

/* Sets the storey of a row, by its name or number. Returns false with an error. */
static bool parse_storey(Text *r, const Field *fields, uint32_t count, size_t row) {
    const uint32_t f = (uint32_t)r->column_of[STOREY];
    char name[LONGEST_NAME];
    uint32_t k = 0;
    if (f >= count || fields[f].length == 0) {
        add_field_error(r, 1, "Write it in every line, or leave the column out",
                        "this line has no %s", NAMES[STOREY], strlen(NAMES[STOREY]));
        return false;
    }
    snprintf(name, sizeof name, "%.*s", (int)fields[f].length, fields[f].at);
    while (k < r->storey_count && strcmp(name, r->storeys[k]) != 0)
        k++;
    if (k == JOX_MOST_STOREYS) {
        add_field_error(r, 1, "Is another column meant, such as the height of heads?",
                        "there are more than 200 storeys, '%s' is one too many", name,
                        strlen(name));
        return false;
    }
    if (k == r->storey_count)
        r->storeys[r->storey_count++] = jox_strdup(name);
    JOX_RESERVE(r->storey, r->storey_capacity, row + 1);
    r->storey[row] = (uint16_t)k;
    return true;
}

/* Adds the row of a line. Returns false with an error. Times of the first and last frame give
   the frame rate. */
static bool parse_row(Text *r, const char *line, size_t length) {
    Field fields[MOST_FIELDS];
    double v[COLUMNS] = {0};
    uint32_t count = split_fields(r, line, length, fields);
    for (int c = 0; c < STOREY; c++)
        if (r->column_of[c] >= 0 && !parse_field(r, line, fields, count, c, &v[c]))
            return false;
    JoxTrajectories *t = r->t;
    if (r->column_of[STOREY] >= 0 && !parse_storey(r, fields, count, t->count))
        return false;
    if (r->column_of[TIME] >= 0) {
        bool first = t->count == 0;
        if (first || v[FRAME] < r->first_frame)
            r->first_frame = v[FRAME], r->first_time = v[TIME];
        if (first || v[FRAME] > r->last_frame)
            r->last_frame = v[FRAME], r->last_time = v[TIME];
    }
    size_t row = jox_trajectories_add_row(t);
    t->number[row] = (int64_t)v[FRAME];
    t->line[row] = (uint32_t)r->line;
    t->id[row] = (int64_t)v[ID];
    t->x[row] = (float)v[X];
    t->y[row] = (float)v[Y];
    t->vx[row] = (float)v[VX];
    t->vy[row] = (float)v[VY];
    return true;
}

/* Sets frame rate and unit, and scales the rows. Options take precedence over the file; errors tell
   what neither gives. */
static bool apply_units(Text *r, const JoxTrajectoryOptions *options) {
    JoxTrajectories *t = r->t;
    JoxPosition at = {r->path, 0, 0, 0};
    if (r->fps == 0.0 && r->last_frame > r->first_frame && r->last_time > r->first_time)
        r->fps = (r->last_frame - r->first_frame) / (r->last_time - r->first_time);
    t->fps = options->fps > 0.0 ? options->fps : r->fps;
    double unit = options->unit > 0.0 ? options->unit : r->unit;
    if (t->count == 0)
        jox_diag_error(r->diagnostics, at, "bad-recording", NULL, "nobody is in this recording");
    else if (t->fps <= 0.0)
        jox_diag_error(r->diagnostics, at, "no-frame-rate",
                       options->fps_option ? options->fps_option : "--fps 25",
                       "this recording does not say how many frames a second it has");
    else if (unit <= 0.0)
        jox_diag_error(r->diagnostics, at, "no-unit", "--unit m, or --unit cm",
                       "this recording does not say the unit of its lengths");
    else
        for (size_t i = 0; i < t->count; i++) {
            t->x[i] = (float)(t->x[i] * unit);
            t->y[i] = (float)(t->y[i] * unit);
            t->vx[i] = (float)(t->vx[i] * unit);
            t->vy[i] = (float)(t->vy[i] * unit);
        }
    t->has_velocity = r->named && r->column_of[VX] >= 0 && r->column_of[VY] >= 0;
    return t->count > 0 && t->fps > 0.0 && unit > 0.0;
}

/* Returns the place of a storey among the others, from the lowest up: by number if all names are
   numbers, else in the order in which they came. */
static uint32_t rank_storey(const Text *r, uint32_t storey) {
    uint32_t below = 0;
    for (uint32_t k = 0; k < r->storey_count; k++) {
        char *end;
        const double number = strtod(r->storeys[k], &end);
        if (*end || !isfinite(number))
            return storey;
        below += number < strtod(r->storeys[storey], NULL);
    }
    return below;
}

/* Lays the storeys of a column out, and moves each row to its own. */
static void place_on_storeys(Text *r) {
    JoxTrajectories *t = r->t;
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    uint32_t ranks[JOX_MOST_STOREYS];
    t->storeys.storeys = jox_alloc(r->storey_count, sizeof *t->storeys.storeys);
    t->storeys.storey_count = r->storey_count;
    for (uint32_t k = 0; k < r->storey_count; k++) {
        ranks[k] = rank_storey(r, k);
        while (t->storeys.storeys[ranks[k]].name) /* "1" and "1.0" are two storeys */
            ranks[k]++;
        t->storeys.storeys[ranks[k]] =
            (JoxStorey){jox_strdup(r->storeys[k]), (float)ranks[k] * APART};
    }
    for (size_t i = 0; i < t->count; i++) {
        low = jox_v2(jox_minf(low.x, t->x[i]), jox_minf(low.y, t->y[i]));
        high = jox_v2(jox_maxf(high.x, t->x[i]), jox_maxf(high.y, t->y[i]));
    }
    jox_storeys_lay_out(&t->storeys, low, high);
    for (size_t i = 0; i < t->count; i++)
        t->y[i] += (float)ranks[r->storey[i]] * t->storeys.pitch;
    jox_diag_note(r->diagnostics, ((JoxPosition){r->path, 0, 0, 0}), "storeys-read",
                  "people are on %u storeys, whose heights this file does not have: they are taken "
                  "to be %g m apart",
                  r->storey_count, (double)APART);
}

bool jox_trajectories_add_text(JoxTrajectories *t, const char *path, const char *text,
                               size_t length, const JoxTrajectoryOptions *options,
                               JoxDiagnostics *diagnostics) {
    Text r = {.t = t, .diagnostics = diagnostics, .path = path};
    const size_t errors = diagnostics->errors;
    bool begun = false;
    for (int c = 0; c < COLUMNS; c++)
        r.column_of[c] = c <= Y ? c : -1;
    for (size_t at = jox_byte_order_mark_length(text, length);
         at < length && jox_diag_has_room(diagnostics, JOX_SEVERITY_ERROR);) {
        const char *line = text + at;
        const char *newline = memchr(line, '\n', length - at);
        size_t n = newline ? (size_t)(newline - line) : length - at;
        at += n + 1;
        r.line++;
        while (n > 0 && isspace((unsigned char)line[n - 1]))
            n--;
        size_t blank = 0;
        while (blank < n && isspace((unsigned char)line[blank]))
            blank++;
        if (blank == n)
            continue;
        if (line[blank] == '#') {
            read_comment(&r, line, n);
            continue;
        }
        if (!begun && (isalpha((unsigned char)line[blank]) || line[blank] == '"')) {
            begun = true;
            if (!read_header(&r, line, n))
                return false;
            continue;
        }
        if (!begun)
            choose_separator(&r, line, n);
        begun = true;
        parse_row(&r, line, n);
    }
    const bool good = diagnostics->errors == errors && apply_units(&r, options);
    if (good && r.storey_count > 1)
        place_on_storeys(&r);
    for (uint32_t k = 0; k < r.storey_count; k++)
        jox_free(r.storeys[k]);
    jox_free(r.storey);
    return good;
}
