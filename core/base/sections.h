/* One walk over the state of a world, for five purposes. A module lists its state once, in a
   function that calls jox_section for each column, number and array; the walk's mode decides what
   happens to them:

     hash      cells are added to a 64-bit hash
     save      cells are appended to a buffer
     restore   cells are read from such a buffer
     compare   cells are compared with such a buffer, up to the first difference
     visit     a function is called for each cell (tests)

   Cells are plain bytes: numbers, or structs without pointers and, if they are hashed or compared,
   without padding. The order of the sections, their names and cell sizes are the format of the
   buffer; a buffer of another format, or a damaged one, is refused with a sentence that says why.
   Its numbers are in this machine's representation: it cannot be moved to another kind of
   machine. */
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

/* Called for a cell in the mode visit. `hashed` is false for cells that are not part of the hash.
   The function may write the cell, but must restore it before it returns. */
typedef void JoxCellVisit(void *context, const char *section, size_t index, void *cell, size_t size,
                          bool hashed);

/* A walk; made by one of the functions below. Callers may read `mode`, `hash`, `failed`, `differs`
   and `wrong`, and set `skipped`. */
typedef struct JoxSections {
    JoxSectionsMode mode;
    JoxHash hash;                  /* hash: the result, for jox_hash_end */
    JoxText *out;                  /* save: the buffer */
    size_t start;                  /* save: offset in `out` at which the state begins */
    const unsigned char *at, *end; /* restore, compare: the rest of the buffer */
    const unsigned char *begin;    /* restore, compare: the buffer */
    JoxCellVisit *visit;
    void *context;       /* visit: passed to `visit` */
    const char *module;  /* module of the present section, a prefix of its name */
    const char *skipped; /* hash: a module that is left out, or NULL */
    bool unhashed;       /* present sections are left out of hash and comparison */
    bool failed;         /* restore, compare: the buffer was refused; `wrong` says why */
    bool differs;        /* compare: `wrong` names the first section and cell that differ */
    char wrong[200];
} JoxSections;

JoxSections jox_sections_hash(void);
/* Begins a save, which appends to `out`. */
JoxSections jox_sections_save(JoxText *out);
/* Begin to read a buffer that a save wrote, and that must last as long as the walk. Its checksum is
   verified here, before anything is read. */
JoxSections jox_sections_restore(const void *data, size_t size);
JoxSections jox_sections_compare(const void *data, size_t size);
JoxSections jox_sections_visit(JoxCellVisit *visit, void *context);
/* Ends the walk after the last section; completes a saved buffer. True if nothing failed or
   differed and a buffer that was read was used up. */
bool jox_sections_end(JoxSections *sections);

/* Refuses a state whose form is right but whose content is invalid; for modules, in restore. */
void jox_sections_fail(JoxSections *sections, const char *name, const char *why);
/* Names the module of the sections that follow; a string that outlives the walk. */
void jox_sections_module(JoxSections *sections, const char *module);
/* Whether the sections that follow are left out of hash and comparison: no step reads them (figures
   of a run), or they depend on a run's history and not on its state. */
void jox_sections_unhashed(JoxSections *sections, bool unhashed);

/* Walks over `count` cells of `size` bytes. A state with another count is refused. */
void jox_section(JoxSections *sections, const char *name, void *cells, size_t size, size_t count);
/* The same for booleans: a restored byte other than 0 and 1 is refused. */
void jox_section_bools(JoxSections *sections, const char *name, void *cells, size_t size,
                       size_t count);
/* The same in another order: cell k of the section is cells[order[k]]. Restore writes cells[k]. */
void jox_section_ordered(JoxSections *sections, const char *name, void *cells, size_t size,
                         size_t count, const uint32_t *order);
/* The same for rows of `stride` doubles. The hash leaves out trailing zeros of a row, so that it
   does not depend on the stride. Restore refuses a buffer with another stride. */
void jox_section_rows(JoxSections *sections, const char *name, double *rows, size_t stride,
                      size_t count, const uint32_t *order);
/* Walks over the number of cells of `size` bytes that the next sections have. Restore returns the
   number read, checked against the length of the rest of the buffer; other modes return `count`. */
size_t jox_section_count(JoxSections *sections, const char *name, size_t count, size_t size);
/* Walks over a string of jox_strdup, or NULL. Restore frees the present one. */
void jox_section_string(JoxSections *sections, const char *name, char **string);
/* Walks over a digest of the model that the state belongs to. It is saved but not hashed; restore
   refuses a state with another one. */
void jox_section_model(JoxSections *sections, const char *name, uint64_t digest);

/* Walks over one variable. */
#define JOX_SECTION(sections, name, variable)                                                      \
    _Generic((variable), bool                                                                      \
             : jox_section_bools, default                                                          \
             : jox_section)((sections), (name), &(variable), sizeof(variable), 1)
/* Walks over an array with count and capacity (of any unsigned type), as JOX_RESERVE grows it. */
#define JOX_SECTION_ARRAY(sections, name, array, count, capacity)                                  \
    do {                                                                                           \
        size_t jox_n = jox_section_count((sections), (name), (count), sizeof *(array));            \
        if ((sections)->mode == JOX_SECTIONS_RESTORE) {                                            \
            JOX_RESERVE(array, capacity, jox_n);                                                   \
            (count) = jox_n;                                                                       \
        }                                                                                          \
        jox_section((sections), (name), (array), sizeof *(array), jox_n);                          \
    } while (0)
/* Walks over an array that is in use up to its capacity, such as one indexed by key. */
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
