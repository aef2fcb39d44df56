#include "base/result_block.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

enum { ALIGNMENT = 16 };

void *jox_pack_add(JoxPack *pack, uint32_t part, size_t size) {
    JoxText *to = &pack->parts[part];
    JOX_ASSERT(part < JOX_PACK_PARTS && to->length % size == 0);
    JOX_RESERVE(to->data, to->capacity, to->length + size);
    to->length += size;
    return memset(to->data + to->length - size, 0, size);
}

size_t jox_pack_length(const JoxPack *pack, uint32_t part) {
    return pack->parts[part].length;
}

/* Notes that the pointer at `field` in a part will point to an offset in the part `to`. */
static void link_field(JoxPack *pack, uint32_t part, const void *field, uint32_t to,
                       size_t offset) {
    const size_t at = (size_t)((const char *)field - pack->parts[part].data);
    JOX_ASSERT(part < JOX_PACK_PARTS && at + sizeof(void *) <= pack->parts[part].length);
    JOX_RESERVE(pack->links, pack->link_capacity, pack->link_count + 1);
    pack->links[pack->link_count++] = (struct JoxPackLink){part, to, at, offset};
}

void jox_pack_text(JoxPack *pack, uint32_t part, const char **field, const char *text) {
    JoxText *texts = &pack->parts[JOX_PACK_PARTS];
    if (!text)
        return;
    link_field(pack, part, field, JOX_PACK_PARTS, texts->length);
    jox_text_append(texts, text, strlen(text) + 1);
}

void jox_pack_list(JoxPack *pack, uint32_t part, void *field, uint32_t to) {
    link_field(pack, part, field, to, pack->parts[to].length);
}

void *jox_pack_end(JoxPack *pack) {
    size_t begins[JOX_PACK_PARTS + 1], size = 0;
    for (uint32_t p = 0; p <= JOX_PACK_PARTS; p++) {
        begins[p] = size;
        size += (pack->parts[p].length + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    }
    char *all = jox_alloc(size, 1);
    for (uint32_t p = 0; p <= JOX_PACK_PARTS; p++) {
        if (pack->parts[p].length)
            memcpy(all + begins[p], pack->parts[p].data, pack->parts[p].length);
        jox_text_free(&pack->parts[p]);
    }
    for (size_t k = 0; k < pack->link_count; k++) {
        const struct JoxPackLink *link = &pack->links[k];
        const void *to = all + begins[link->to] + link->to_offset;
        memcpy(all + begins[link->from] + link->at, &to, sizeof to);
    }
    jox_free(pack->links);
    *pack = (JoxPack){0};
    return all;
}
