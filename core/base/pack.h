/* A result that a program is handed: a struct with arrays and texts, in one piece of memory that
 * one jo_free releases. It is put together in parts, which grow, and have no pointers yet:
 *
 *     JoxPack pack = {0};
 *     JoMods *head = jox_pack_add(&pack, 0, sizeof *head);
 *     jox_pack_list(&pack, 0, &head->items, 1);
 *     JoModInfo *item = jox_pack_add(&pack, 1, sizeof *item);
 *     jox_pack_text(&pack, 1, &item->name, "gentle");
 *     return jox_pack_end(&pack);
 *
 * Part 0 has the struct that is returned. What jox_pack_add returns moves with the next call of it
 * for the same part. */
#ifndef JOX_BASE_PACK_H
#define JOX_BASE_PACK_H

#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

enum { JOX_PACK_PARTS = 5 };

/* Zero-initialise. */
typedef struct JoxPack {
    JoxText parts[JOX_PACK_PARTS + 1]; /* the last: texts */
    struct JoxPackLink {
        uint32_t from, to;    /* parts */
        size_t at, to_offset; /* of the pointer, and of what it points to, bytes */
    } * links;
    size_t link_count, link_capacity;
} JoxPack;

/* Adds `size` bytes, zeroed, behind those of a part; all of a part have one size. */
void *jox_pack_add(JoxPack *pack, uint32_t part, size_t size);
/* Number of bytes of a part so far. */
size_t jox_pack_length(const JoxPack *pack, uint32_t part);
/* The pointer at `field`, which lies in `part`, leads to a copy of the text; NULL stays NULL. */
void jox_pack_text(JoxPack *pack, uint32_t part, const char **field, const char *text);
/* The pointer at `field` leads to what is added to the part `to` next. */
void jox_pack_list(JoxPack *pack, uint32_t part, void *field, uint32_t to);
/* Resolves the pointers and frees all else. The caller's; disown it (mem.h) in a public call. */
void *jox_pack_end(JoxPack *pack);

#endif
