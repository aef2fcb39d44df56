#include "base/format/piece_file.h"

#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/hash.h"

/* The head of a file. */
typedef struct Head {
    char magic[20];   /* name and version of the format */
    uint32_t order;   /* ORDER in the byte order of the machine that wrote it */
    char version[16]; /* version of the engine that wrote it */
} Head;

typedef struct PieceHead {
    char name[16];
    uint64_t length, sum;
} PieceHead;

static const char MAGIC[20] = "jostle checkpoint 1";
static const char LAST[] = "end";
enum { ORDER = 0x01020304 };

static Head make_own_head(void) {
    Head head = {.order = ORDER};
    memcpy(head.magic, MAGIC, sizeof head.magic);
    snprintf(head.version, sizeof head.version, "%s", JOX_VERSION);
    return head;
}

/* Returns the checksum of a piece. It includes name and offset, so that swapped pieces are
   found. */
static uint64_t compute_piece_checksum(const PieceHead *head, size_t at, const void *data) {
    const uint64_t place = at;
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, head->name, sizeof head->name);
    jox_hash_add(&hash, &head->length, sizeof head->length);
    jox_hash_add(&hash, &place, sizeof place);
    if (head->length)
        jox_hash_add(&hash, data, head->length);
    return jox_hash_end(&hash);
}

void jox_pieces_begin(JoxText *out) {
    const Head head = make_own_head();
    jox_text_append(out, (const char *)&head, sizeof head);
}

void jox_pieces_add(JoxText *out, const char *name, const void *data, size_t length) {
    PieceHead head = {.length = length};
    JOX_ASSERT(strlen(name) < sizeof head.name);
    snprintf(head.name, sizeof head.name, "%s", name);
    head.sum = compute_piece_checksum(&head, out->length, data);
    jox_text_append(out, (const char *)&head, sizeof head);
    jox_text_append(out, data, length);
    jox_text_append(out, "", 1);
}

void jox_pieces_end(JoxText *out) {
    jox_pieces_add(out, LAST, "", 0);
}

static bool check_file_head(const JoxText *file, char why[200]) {
    const Head own = make_own_head();
    Head head;
    if (file->length < sizeof head || memcmp(file->data, MAGIC, sizeof MAGIC - 2) != 0) {
        snprintf(why, 200, "it is no checkpoint");
        return false;
    }
    memcpy(&head, file->data, sizeof head);
    head.version[sizeof head.version - 1] = 0;
    if (memcmp(head.magic, own.magic, sizeof own.magic) != 0 || head.order != own.order)
        snprintf(why, 200, "it is of another format, or of another kind of machine");
    else if (strcmp(head.version, own.version) != 0)
        snprintf(why, 200, "it was written by version %s, and this is %s", head.version,
                 own.version);
    else if (memcmp(file->data, &own, sizeof own) != 0)
        snprintf(why, 200, "its head is damaged");
    return !*why;
}

bool jox_pieces_next(const JoxText *file, size_t *at, JoxPiece *piece, char why[200]) {
    PieceHead head;
    *why = 0;
    if (*at == 0 && !check_file_head(file, why))
        return false;
    if (*at == 0)
        *at = sizeof(Head);
    const size_t left = file->length - *at;
    if (left < sizeof head + 1) {
        snprintf(why, 200, "it is cut short");
        return false;
    }
    memcpy(&head, file->data + *at, sizeof head);
    if (head.length > left - sizeof head - 1) {
        snprintf(why, 200, "it is cut short, or damaged");
        return false;
    }
    const char *data = file->data + *at + sizeof head;
    if (head.name[sizeof head.name - 1] || head.sum != compute_piece_checksum(&head, *at, data) ||
        data[head.length]) {
        head.name[sizeof head.name - 1] = 0;
        for (char *c = head.name; *c; c++)
            *c = *c >= 'a' && *c <= 'z' ? *c : '?';
        snprintf(why, 200, "the piece '%s' is damaged: its checksum does not match", head.name);
        return false;
    }
    *piece = (JoxPiece){file->data + *at, data, head.length};
    *at += sizeof head + head.length + 1;
    if (strcmp(piece->name, LAST) != 0)
        return true;
    if (*at != file->length)
        snprintf(why, 200, "something follows its end");
    return false;
}
