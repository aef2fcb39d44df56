/* Builds a result of the public API: a struct with arrays and texts, in one block that one jo_free
 * releases. It is built in parts, growing arrays whose addresses change, so that pointers between
 * them are noted and resolved at the end:
 *
 *     JoxPack pack = {0};
 *     JoMods *head = jox_pack_add(&pack, 0, sizeof *head);
 *     jox_pack_list(&pack, 0, &head->items, 1);
 *     JoModInfo *item = jox_pack_add(&pack, 1, sizeof *item);
 *     jox_pack_text(&pack, 1, &item->name, "gentle");
 *     return jox_pack_end(&pack);
 *
 * Part 0 begins with the struct that is returned. The pointer that jox_pack_add returns is valid
 * until the next call for the same part. */
#ifndef JOX_BASE_RESULT_BLOCK_H
#define JOX_BASE_RESULT_BLOCK_H

#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

enum { JOX_PACK_PARTS = 5 };

/* Zero-initialise. */
typedef struct JoxPack {
    JoxText parts[JOX_PACK_PARTS + 1]; /* the last one has the texts */
    struct JoxPackLink {
        uint32_t from, to;    /* part that has the pointer, part that it points into */
        size_t at, to_offset; /* offsets of the pointer and of its target in them, bytes */
    } * links;
    size_t link_count, link_capacity;
} JoxPack;

/* Appends an item of `size` bytes, zeroed, to a part; all items of a part have one size. */
void *jox_pack_add(JoxPack *pack, uint32_t part, size_t size);
/* Length of a part so far, bytes. */
size_t jox_pack_length(const JoxPack *pack, uint32_t part);
/* Sets the pointer at `field`, which lies in `part`, to a copy of the text; NULL stays NULL. */
void jox_pack_text(JoxPack *pack, uint32_t part, const char **field, const char *text);
/* Sets the pointer at `field` to the item that is appended to the part `to` next. */
void jox_pack_list(JoxPack *pack, uint32_t part, void *field, uint32_t to);
/* Returns the finished block, and frees the parts. A public call must disown it (jox_disown). */
void *jox_pack_end(JoxPack *pack);

#endif
