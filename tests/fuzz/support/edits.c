#include "edits.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"

enum { EDIT = 16, MOST_EDITS = 8, HEAD = 24 };

/* The head of a section, before its cells. */
typedef struct Head {
    uint64_t name, size, count;
} Head;

static Head head_at(const JoxText *state, size_t at) {
    Head head;
    memcpy(&head, state->data + at, sizeof head);
    return head;
}

/* A search for a section by the key of an edit. */
typedef struct Search {
    uint16_t key;
    uint64_t name;        /* the name whose low 16 bits follow the key most closely, modulo 2^16 */
    size_t count, wanted; /* sections of this name; number of the one wanted */
    size_t at, before;    /* offset of the section, and of the one before it */
} Search;
typedef void Visit(Search *search, Head head, size_t at, size_t before);

/* Calls a function for each section, with the offsets of its begin and of the one before. */
static void visit_each_section(const JoxText *state, Visit *visit, Search *search) {
    enum { MAGIC = 8 };
    for (size_t at = MAGIC, before = MAGIC; at < state->length - sizeof(uint64_t);) {
        const Head head = head_at(state, at);
        visit(search, head, at, before);
        before = at;
        at += HEAD + head.size * head.count;
    }
}

static void take_name(Search *search, Head head, size_t at, size_t before) {
    const uint64_t was = search->name, is = head.name;
    (void)at, (void)before;
    if (!was || (uint16_t)(is - search->key) < (uint16_t)(was - search->key))
        search->name = is;
}

static void count_name(Search *search, Head head, size_t at, size_t before) {
    (void)at, (void)before;
    search->count += head.name == search->name;
}

static void take_place(Search *search, Head head, size_t at, size_t before) {
    if (head.name != search->name || search->count++ != search->wanted)
        return;
    search->at = at;
    search->before = before;
}

/* Returns the offset of the section that an edit is for, and in *before that of the one before it.
   An edit gives a key of the section's name, which stays valid when sections are added, and its
   number among those of that name. */
static size_t find_section(const JoxText *state, const uint8_t *edit, size_t *before) {
    Search search = {0};
    memcpy(&search.key, edit, sizeof search.key);
    visit_each_section(state, take_name, &search);
    visit_each_section(state, count_name, &search);
    search.wanted = edit[15] % search.count;
    search.count = 0;
    visit_each_section(state, take_place, &search);
    *before = search.before;
    return search.at;
}

static uint64_t whole_number(uint8_t choice, uint64_t was) {
    const uint64_t odd[] = {0,        1,       2,         UINT64_MAX, INT32_MAX,
                            1u << 31, was + 1, was - 1,   was << 1,   UINT64_C(1) << 63,
                            0xffff,   0x8000,  1u << 24u, UINT32_MAX, 64,
                            1000};
    return odd[choice % 16];
}

static double odd_number(uint8_t choice, double was) {
    const double odd[] = {0.0,   -0.0, NAN,  INFINITY, -INFINITY, 1e300, -1e300, 1e30,
                          -1e30, 1e9,  -1e9, 1e-30,    5e-324,    1e4,   -was,   2.0 * was};
    return odd[choice % 16];
}

/* Changes a number within a cell of `size` bytes, if it fits. */
static void put_number(char *cell, size_t size, const uint8_t *edit) {
    uint16_t offset;
    uint64_t value = 0;
    memcpy(&offset, edit + 6, sizeof offset);
    const size_t wide = edit[2] % 4 == 2 ? 4 : edit[2] % 4 == 3 ? 8 : (size_t)1 << edit[3] / 64;
    if (size < wide)
        return;
    char *to = cell + offset % (size / wide) * wide;
    memcpy(&value, edit[2] % 4 ? (const void *)to : edit + 8, wide);
    if (edit[2] % 4 == 1)
        value = whole_number(edit[3], value);
    if (edit[2] % 4 == 2) {
        float was;
        memcpy(&was, to, sizeof was);
        was = (float)odd_number(edit[3], was);
        memcpy(&value, &was, sizeof was);
    }
    if (edit[2] % 4 == 3) {
        double was;
        memcpy(&was, to, sizeof was);
        was = odd_number(edit[3], was);
        memcpy(&value, &was, sizeof was);
    }
    memcpy(to, &value, wide);
}

/* Removes the last cell of a section or repeats it, and corrects the number of cells that is saved
   in the section before. */
static void resize(JoxText *state, size_t at, size_t before, size_t more) {
    Head head = head_at(state, at), counts = head_at(state, before);
    const size_t end_at = at + HEAD + head.size * head.count;
    JoxText now = {0};
    jox_text_append(&now, state->data, end_at);
    const bool counted = counts.name == head.name && counts.size == sizeof(uint64_t) &&
                         counts.count == 1 && before != at;
    if (more % 8 == 0 && head.count) {
        head.count--;
        now.length -= head.size;
    } else if (head.size <= 4096) {
        static const char NOTHING[4096];
        for (size_t k = 0; k < more % 8; k++)
            jox_text_append(&now, head.count ? state->data + end_at - head.size : NOTHING,
                            head.size);
        head.count += more % 8;
    }
    jox_text_append(&now, state->data + end_at, state->length - end_at);
    memcpy(now.data + at, &head, sizeof head);
    if (counted)
        memcpy(now.data + before + HEAD, &head.count, sizeof head.count);
    jox_text_free(state);
    *state = now;
}

static void print_section(void *context, const char *section, size_t index, void *cell, size_t size,
                          bool hashed) {
    uint64_t *name = context;
    const char *dot = strchr(section, '.');
    JoxHash hash = jox_hash_begin();
    (void)cell, (void)hashed;
    jox_hash_add(&hash, section, (size_t)(dot - section));
    jox_hash_add(&hash, ".", 1);
    jox_hash_add(&hash, dot + 1, strlen(dot + 1));
    if (index == 0 && jox_hash_end(&hash) == *name) {
        fprintf(stderr, "%s, cells of %zu bytes\n", section, size);
        *name = 0; /* print it once if several sections have the name */
    }
}

static void edit_section(JoxText *state, const uint8_t *edit, FuzzWalk *walk, void *context) {
    uint16_t number;
    size_t before = 0;
    memcpy(&number, edit + 4, sizeof number);
    const size_t at = find_section(state, edit, &before);
    const Head head = head_at(state, at);
    if (getenv("FUZZ_SHOW")) {
        uint64_t name = head.name;
        JoxSections s = jox_sections_visit(print_section, &name);
        walk(context, &s);
        fprintf(stderr, "  key %u, of %" PRIu64 " cells of %" PRIu64 " bytes: edit %d of cell %u\n",
                (unsigned)(head.name & 0xffff), head.count, head.size, edit[2] % 8, number);
    }
    if (edit[2] % 8 == 7) {
        resize(state, at, before, number);
        return;
    }
    if (head.count == 0)
        return;
    char *cells = state->data + at + HEAD, *cell = cells + number % head.count * head.size;
    if (edit[2] % 8 == 6)
        memcpy(cell, cells + edit[8] % head.count * head.size, head.size);
    else
        put_number(cell, head.size, edit);
}

/* Corrects the checksum of a state. */
static void write_checksum(JoxText *state) {
    const size_t length = state->length - sizeof(uint64_t);
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, state->data, length);
    const uint64_t sum = jox_hash_end(&hash);
    memcpy(state->data + length, &sum, sizeof sum);
}

void fuzz_edit(JoxText *state, const uint8_t *data, size_t size, FuzzWalk *walk, void *context) {
    for (size_t k = 0; k < MOST_EDITS && (k + 1) * EDIT <= size; k++)
        edit_section(state, data + k * EDIT, walk, context);
    write_checksum(state);
}
