#include "base/sections.h"

#include <stdio.h>
#include <string.h>

#include "base/assert.h"

static const char MAGIC[8] = {'j', 'o', 's', 't', 'a', 't', 'e', '1'};

/* Header of a section in a buffer; its cells follow. */
typedef struct SectionHead {
    uint64_t name; /* hash of "module.name" */
    uint64_t size; /* size of a cell, or of a row, bytes */
    uint64_t count;
} SectionHead;

enum { CHUNK = 4096 }; /* bytes of cells that are gathered and then hashed at once */

/* ---- begin and end ---- */

JoxSections jox_sections_hash(void) {
    return (JoxSections){.mode = JOX_SECTIONS_HASH, .hash = jox_hash_begin(), .module = ""};
}

JoxSections jox_sections_save(JoxText *out) {
    JoxSections s = {.mode = JOX_SECTIONS_SAVE, .out = out, .start = out->length, .module = ""};
    jox_text_append(out, MAGIC, sizeof MAGIC);
    return s;
}

static uint64_t compute_state_checksum(const void *data, size_t size) {
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, data, size);
    return jox_hash_end(&hash);
}

void jox_sections_fail(JoxSections *s, const char *name, const char *why) {
    if (s->failed || s->differs)
        return;
    s->failed = true;
    snprintf(s->wrong, sizeof s->wrong, "%s%s%s%s%s", s->module, *s->module ? "." : "", name,
             *name ? ": " : "", why);
}

/* Begins a walk that reads a buffer: checks its magic number and checksum, and leaves the checksum,
   at its end, out of what is read. */
static JoxSections begin_reading(JoxSectionsMode mode, const void *data, size_t size) {
    JoxSections s = {.mode = mode, .module = "", .begin = data, .at = data};
    uint64_t sum = 0;
    if (!data || size < sizeof MAGIC + sizeof sum || memcmp(data, MAGIC, sizeof MAGIC) != 0) {
        jox_sections_fail(&s, "", "this is not the state of a world");
        s.end = s.at;
        return s;
    }
    s.end = s.begin + size - sizeof sum;
    memcpy(&sum, s.end, sizeof sum);
    if (sum != compute_state_checksum(data, size - sizeof sum))
        jox_sections_fail(&s, "", "the state is damaged: its checksum does not match");
    s.at += sizeof MAGIC;
    return s;
}

JoxSections jox_sections_restore(const void *data, size_t size) {
    return begin_reading(JOX_SECTIONS_RESTORE, data, size);
}

JoxSections jox_sections_compare(const void *data, size_t size) {
    return begin_reading(JOX_SECTIONS_COMPARE, data, size);
}

JoxSections jox_sections_visit(JoxCellVisit *visit, void *context) {
    return (JoxSections){
        .mode = JOX_SECTIONS_VISIT, .visit = visit, .context = context, .module = ""};
}

bool jox_sections_end(JoxSections *s) {
    if (s->mode == JOX_SECTIONS_SAVE) {
        uint64_t sum = compute_state_checksum(s->out->data + s->start, s->out->length - s->start);
        jox_text_append(s->out, (const char *)&sum, sizeof sum);
    }
    bool reads = s->mode == JOX_SECTIONS_RESTORE || s->mode == JOX_SECTIONS_COMPARE;
    s->module = "";
    if (reads && s->at != s->end)
        jox_sections_fail(s, "", "the state has sections that this world does not know");
    return !s->failed && !s->differs;
}

void jox_sections_module(JoxSections *s, const char *module) {
    s->module = module;
}

void jox_sections_unhashed(JoxSections *s, bool unhashed) {
    s->unhashed = unhashed;
}

/* ---- one section ---- */

/* Sections are identified by hashes of their names, which keep the headers short. */
static uint64_t hash_section_name(const JoxSections *s, const char *name) {
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, s->module, strlen(s->module));
    jox_hash_add(&hash, ".", 1);
    jox_hash_add(&hash, name, strlen(name));
    return jox_hash_end(&hash);
}

static void write_section_head(JoxSections *s, const char *name, size_t size, size_t count) {
    SectionHead head = {hash_section_name(s, name), size, count};
    jox_text_append(s->out, (const char *)&head, sizeof head);
}

/* Reads the header of the next section, and checks that the buffer holds all its cells. */
static bool read_section_head(JoxSections *s, const char *name, size_t size, uint64_t *count) {
    SectionHead head;
    if (s->failed || s->differs)
        return false;
    if ((size_t)(s->end - s->at) < sizeof head) {
        jox_sections_fail(s, name, "the state ends before this section");
        return false;
    }
    memcpy(&head, s->at, sizeof head);
    if (head.name != hash_section_name(s, name)) {
        jox_sections_fail(
            s, name,
            "the state has another section in this place: it is of another version, or damaged");
        return false;
    }
    s->at += sizeof head;
    size_t left = (size_t)(s->end - s->at);
    if (head.size != size || (size && head.count > left / size)) {
        jox_sections_fail(
            s, name,
            "the state has cells of another size here: it is of another version, or damaged");
        return false;
    }
    *count = head.count;
    return true;
}

static bool is_hashed(const JoxSections *s) {
    return !s->unhashed && !(s->skipped && strcmp(s->skipped, s->module) == 0);
}

static const unsigned char *find_section_cell(const void *cells, size_t size, size_t k,
                                              const uint32_t *order) {
    return (const unsigned char *)cells + size * (order ? order[k] : k);
}

/* Adds cells to the hash. Ordered cells are gathered into chunks, since a call per cell would be
   slow. The size of a chunk is part of the hash: another CHUNK gives another result. */
static void hash_cells(JoxSections *s, const void *cells, size_t size, size_t count,
                       const uint32_t *order) {
    unsigned char chunk[CHUNK];
    size_t used = 0;
    if (!is_hashed(s) || count == 0)
        return;
    if (!order || size > CHUNK) {
        for (size_t k = 0; order && k < count; k++)
            jox_hash_add(&s->hash, find_section_cell(cells, size, k, order), size);
        if (!order)
            jox_hash_add(&s->hash, cells, size * count);
        return;
    }
    for (size_t k = 0; k < count; k++) {
        if (used + size > CHUNK) {
            jox_hash_add(&s->hash, chunk, used);
            used = 0;
        }
        memcpy(chunk + used, find_section_cell(cells, size, k, order), size);
        used += size;
    }
    jox_hash_add(&s->hash, chunk, used);
}

/* Compares cells with the buffer up to the first that differs. */
static void compare_cells(JoxSections *s, const char *name, const void *cells, size_t size,
                          size_t count, const uint32_t *order) {
    for (size_t k = 0; k < count && !s->unhashed; k++) {
        if (memcmp(s->at + k * size, find_section_cell(cells, size, k, order), size) == 0)
            continue;
        s->differs = true;
        snprintf(s->wrong, sizeof s->wrong, "%s.%s: cell %zu of %zu differs", s->module, name, k,
                 count);
        return;
    }
    s->at += count * size;
}

/* Calls the visitor for each cell, with the name "module.section". */
static void visit_cells(JoxSections *s, const char *name, void *cells, size_t size, size_t count,
                        const uint32_t *order) {
    char full[120];
    snprintf(full, sizeof full, "%s.%s", s->module, name);
    for (size_t k = 0; k < count; k++)
        s->visit(s->context, full, k, (char *)cells + size * (order ? order[k] : k), size,
                 !s->unhashed);
}

void jox_section_ordered(JoxSections *s, const char *name, void *cells, size_t size, size_t count,
                         const uint32_t *order) {
    uint64_t saved = 0;
    JOX_ASSERT(cells || count == 0);
    switch (s->mode) {
    case JOX_SECTIONS_HASH:
        hash_cells(s, cells, size, count, order);
        return;
    case JOX_SECTIONS_SAVE:
        write_section_head(s, name, size, count);
        for (size_t k = 0; order && k < count; k++)
            jox_text_append(s->out, (const char *)find_section_cell(cells, size, k, order), size);
        if (!order && count)
            jox_text_append(s->out, cells, size * count);
        return;
    case JOX_SECTIONS_VISIT:
        visit_cells(s, name, cells, size, count, order);
        return;
    case JOX_SECTIONS_RESTORE:
    case JOX_SECTIONS_COMPARE:
        break;
    }
    if (!read_section_head(s, name, size, &saved))
        return;
    if (saved != count) {
        jox_sections_fail(s, name, "the section has another number of cells");
        return;
    }
    if (s->mode == JOX_SECTIONS_COMPARE) {
        compare_cells(s, name, cells, size, count, order);
        return;
    }
    if (count)
        memcpy(cells, s->at, size * count);
    s->at += size * count;
}

void jox_section(JoxSections *s, const char *name, void *cells, size_t size, size_t count) {
    jox_section_ordered(s, name, cells, size, count, NULL);
}

void jox_section_bools(JoxSections *s, const char *name, void *cells, size_t size, size_t count) {
    jox_section(s, name, cells, size, count);
    unsigned char *bytes = cells;
    for (size_t k = 0; s->mode == JOX_SECTIONS_RESTORE && k < size * count; k++) {
        if (bytes[k] <= 1)
            continue;
        jox_sections_fail(s, name, "a cell is neither true nor false");
        bytes[k] = 0;
    }
}

void jox_section_rows(JoxSections *s, const char *name, double *rows, size_t stride, size_t count,
                      const uint32_t *order) {
    if (s->mode != JOX_SECTIONS_HASH) {
        jox_section_ordered(s, name, rows, stride * sizeof *rows, stride ? count : 0, order);
        return;
    }
    static const double ZERO = 0.0;
    for (size_t k = 0; k < count && is_hashed(s); k++) {
        const double *row = stride ? rows + stride * (order ? order[k] : k) : rows;
        size_t used = stride;
        while (used && memcmp(&row[used - 1], &ZERO, sizeof ZERO) == 0)
            used--;
        jox_hash_add(&s->hash, &used, sizeof used);
        if (used)
            jox_hash_add(&s->hash, row, used * sizeof *row);
    }
}

size_t jox_section_count(JoxSections *s, const char *name, size_t count, size_t size) {
    uint64_t number = count, cells = 0;
    if (s->mode == JOX_SECTIONS_VISIT)
        return count;
    if (s->mode != JOX_SECTIONS_RESTORE) {
        jox_section(s, name, &number, sizeof number, 1);
        return count;
    }
    if (!read_section_head(s, name, sizeof number, &cells) || cells != 1) {
        jox_sections_fail(s, name, "the section is no number");
        return 0;
    }
    memcpy(&number, s->at, sizeof number);
    s->at += sizeof number;
    if (number > (size_t)(s->end - s->at) / (size ? size : 1)) {
        jox_sections_fail(s, name, "the number is greater than the state has room for");
        return 0;
    }
    return number;
}

void jox_section_string(JoxSections *s, const char *name, char **string) {
    size_t nul = s->mode != JOX_SECTIONS_VISIT; /* visitors write cells, but not the final zero */
    size_t length = jox_section_count(s, name, *string ? strlen(*string) + nul : 0, 1);
    if (s->mode == JOX_SECTIONS_RESTORE) {
        jox_free(*string);
        *string = length && !s->failed ? jox_alloc(length, 1) : NULL;
        length = *string ? length : 0;
    }
    jox_section(s, name, *string, 1, length);
    if (s->mode == JOX_SECTIONS_RESTORE && *string)
        (*string)[length - 1] = 0;
}

void jox_section_model(JoxSections *s, const char *name, uint64_t digest) {
    uint64_t saved = digest;
    if (s->mode == JOX_SECTIONS_HASH || s->mode == JOX_SECTIONS_VISIT)
        return;
    jox_section(s, name, &saved, sizeof saved, 1);
    if (saved != digest)
        jox_sections_fail(s, name, "it has changed since the state was saved");
}
