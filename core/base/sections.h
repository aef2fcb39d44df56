/* One walk over the state of a world. A module lists what it keeps, once, in one function that
   calls jox_section for each column, number and array; the walk's mode decides what is done with
   them:

     hash      the cells are added to a 64-bit hash
     save      they are appended to a buffer
     restore   they are read back from such a buffer
     compare   they are compared with such a buffer, up to the first cell that differs
     visit     a function is called for each cell (tests)

   The cells of a section are plain bytes: numbers, or structs without pointers and, where they are
   hashed or compared, without padding.
   The order of the sections, their names and the sizes of their cells are the format of the buffer:
   a buffer of another format, or a damaged one, is refused with a sentence that says why. Its bytes
   are those of this machine (byte order, floats); it is no format for other machines. */
#ifndef JOX_BASE_SECTIONS_H
#define JOX_BASE_SECTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/hash.h"
#include "base/mem.h"
#include "base/text.h"

typedef enum JoxSectionsMode {
    JOX_SECTIONS_HASH,
    JOX_SECTIONS_SAVE,
    JOX_SECTIONS_RESTORE,
    JOX_SECTIONS_COMPARE,
    JOX_SECTIONS_VISIT
} JoxSectionsMode;

/* A cell of a section, in the mode visit. `hashed` is false for cells that are no part of the hash.
   The function may write the cell, but must put its bytes back before it returns. */
typedef void JoxCellVisit(void *context, const char *section, size_t index, void *cell, size_t size,
                          bool hashed);

/* Start from one of the functions below. The fields are theirs, but for those said to be read. */
typedef struct JoxSections {
    JoxSectionsMode mode;
    JoxHash hash;                  /* hash: the result, for jox_hash_end */
    JoxText *out;                  /* save */
    size_t start;                  /* save: where it began in `out` */
    const unsigned char *at, *end; /* restore, compare: what is still to be read */
    const unsigned char *begin;
    JoxCellVisit *visit;
    void *context;
    const char *module;
    const char *skipped; /* hash: a module that is left out, or NULL; may be set at the start */
    bool unhashed;
    bool failed;  /* restore, compare: the buffer does not fit; `wrong` says why */
    bool differs; /* compare: `wrong` names the first section and cell that differ */
    char wrong[200];
} JoxSections;

JoxSections jox_sections_hash(void);
/* Appends to `out`. */
JoxSections jox_sections_save(JoxText *out);
/* The buffer as a save wrote it; read, not kept. Its length and checksum are verified here, before
   anything is read from it. */
JoxSections jox_sections_restore(const void *data, size_t size);
JoxSections jox_sections_compare(const void *data, size_t size);
JoxSections jox_sections_visit(JoxCellVisit *visit, void *context);
/* After the last section: completes a saved buffer; true if all went well and, restoring or
   comparing, the whole buffer was used. */
bool jox_sections_end(JoxSections *sections);

/* Restoring: what was read is no state, though the buffer has the right form. */
void jox_sections_fail(JoxSections *sections, const char *name, const char *why);
/* Names the module whose sections follow; a string that outlives the walk. */
void jox_sections_module(JoxSections *sections, const char *module);
/* From here on: whether sections are left out of hash and comparison, because no step reads them
   (figures of the run) or because they follow from the history of a run and not from its state. */
void jox_sections_unhashed(JoxSections *sections, bool unhashed);

/* `count` cells of `size` bytes each. `count` is the same in the state that is read back. */
void jox_section(JoxSections *sections, const char *name, void *cells, size_t size, size_t count);
/* Of booleans; restoring, bytes that are none are refused. */
void jox_section_bools(JoxSections *sections, const char *name, void *cells, size_t size,
                       size_t count);
/* The same; cell k of the section is cells[order[k]]. Restoring, cell k becomes cells[k]. */
void jox_section_ordered(JoxSections *sections, const char *name, void *cells, size_t size,
                         size_t count, const uint32_t *order);
/* Rows of `stride` doubles, in that order. In the hash a row ends before its trailing zeros, so
   that rows that are wider than need be hash alike. Restoring, a buffer with other strides is
   refused. */
void jox_section_rows(JoxSections *sections, const char *name, double *rows, size_t stride,
                      size_t count, const uint32_t *order);
/* How many cells of `size` bytes the sections that follow hold. Restoring, returns the number read,
   which what is left of the buffer has room for; otherwise `count`. */
size_t jox_section_count(JoxSections *sections, const char *name, size_t count, size_t size);
/* A string made by jox_strdup, or NULL; restoring frees the one that is there. */
void jox_section_string(JoxSections *sections, const char *name, char **string);
/* What the state belongs to, as a number made of it: saved but not hashed; restoring a state of
   something else is refused. */
void jox_section_model(JoxSections *sections, const char *name, uint64_t digest);

/* A variable. */
#define JOX_SECTION(sections, name, variable)                                                      \
    _Generic((variable), bool                                                                      \
             : jox_section_bools, default                                                          \
             : jox_section)((sections), (name), &(variable), sizeof(variable), 1)
/* A heap array with its count and capacity (of any unsigned type), as JOX_RESERVE grows it. */
#define JOX_SECTION_ARRAY(sections, name, array, count, capacity)                                  \
    do {                                                                                           \
        size_t jox_n = jox_section_count((sections), (name), (count), sizeof *(array));            \
        if ((sections)->mode == JOX_SECTIONS_RESTORE) {                                            \
            JOX_RESERVE(array, capacity, jox_n);                                                   \
            (count) = jox_n;                                                                       \
        }                                                                                          \
        jox_section((sections), (name), (array), sizeof *(array), jox_n);                          \
    } while (0)
/* A heap array all of whose room is in use, such as one by key. */
#define JOX_SECTION_ROOM(sections, name, array, capacity)                                          \
    do {                                                                                           \
        size_t jox_n = jox_section_count((sections), (name), (capacity), sizeof *(array));         \
        if ((sections)->mode == JOX_SECTIONS_RESTORE) {                                            \
            (array) = jox_realloc((array), jox_n, sizeof *(array));                                \
            (capacity) = jox_n;                                                                    \
        }                                                                                          \
        jox_section((sections), (name), (array), sizeof *(array), jox_n);                          \
    } while (0)

#endif
