/* Reads a zip archive as a mod: its bytes, as they are and with the checksums of its entries made
   right; every file in it, by the names that it lists; then a scene runs with it. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/text.h"
#include "base/zip.h"
#include "support/fuzz.h"

enum { DEEPEST = 3, LARGEST = 1 << 20 };

static const char SCENE[] = "jostle: 1\n"
                            "places:\n"
                            "  hall: {polygon: [[0, 0], [6, 0], [6, 6], [0, 6]]}\n"
                            "groups:\n"
                            "  red: {behaviour: base.lua, count: 3, in: hall}\n";
static const char LUA[] =
    "return machine { name = \"base\", start = \"A\", defaults = { speed = 1 }, states = {\n"
    "A = { steer = hold, push = 10, { to = \"B\", when = after(0.1) } },\n"
    "B = { steer = hold, { to = \"A\", when = after(0.1) } } } }\n";

/* Reads all below a folder; what is refused has a reason, what is listed is within the archive. */
static void read_all_below(const char *folder, int depth) {
    char **names = jox_folder_names(folder, true);
    for (size_t n = 0; names && names[n]; n++) {
        char path[2000], why[JOX_UNREAD];
        size_t length = 0;
        FUZZ_CHECK(*names[n] && !strchr(names[n], '/') && strcmp(names[n], "..") != 0);
        snprintf(path, sizeof path, "%s/%s", folder, names[n]);
        if (jox_is_folder(path) && depth < DEEPEST)
            read_all_below(path, depth + 1);
        char *text = jox_zip_read(path, LARGEST, &length);
        FUZZ_CHECK(!text || (length <= LARGEST && text[length] == 0));
        FUZZ_CHECK(text || *jox_unread_text(path, EBADMSG, why));
        jox_free(text);
    }
    jox_free(names);
}

static void read_archive(const char *path) {
    JOX_GUARD (NULL, NULL)
        return;
    char *fault = jox_zip_fault(path);
    FUZZ_CHECK(!fault || *fault);
    if (!fault)
        read_all_below(path, 0);
    else
        FUZZ_CHECK(!jox_zip_names(path, true));
    jox_free(fault);
}

static void run_with_mod(const char *mod) {
    char scene[256];
    const char *mods[] = {mod};
    JoSceneDef def = jo_default_scene_def();
    JoError error = {0};
    snprintf(scene, sizeof scene, "%s", fuzz_path("base.yaml"));
    def.path = scene;
    def.mods = mods;
    def.mod_count = 1;
    def.named_mods_only = true;
    def.message = ignore_message;
    fuzz_run(jo_scene_load(&def, &error), 4);
    jo_free(jo_mods_list(&def));
}

/* Checksum of zip archives (CRC-32 of ISO 3309). */
static uint32_t find_checksum(const uint8_t *data, size_t size) {
    uint32_t crc = ~0u;
    for (size_t i = 0; i < size; i++) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1u)));
    }
    return ~crc;
}

static uint32_t read_number(const uint8_t *at, int bytes) {
    uint32_t number = 0;
    for (int b = 0; b < bytes; b++)
        number |= (uint32_t)at[b] << 8 * b;
    return number;
}

static void write_checksum(uint8_t *at, uint32_t crc) {
    for (int b = 0; b < 4; b++)
        at[b] = (uint8_t)(crc >> 8 * b);
}

/* Gives entries that are stored, not deflated, the checksum of their content, in both places that
   have it, so that mutations of it reach the readers of a mod. */
static void mend_checksums(uint8_t *data, size_t size) {
    for (size_t at = 0; at + 46 <= size; at++) {
        if (memcmp(data + at, "PK\1\2", 4) != 0 || read_number(data + at + 10, 2) != 0)
            continue;
        const size_t head = read_number(data + at + 42, 4), length = read_number(data + at + 20, 4);
        if (head + 30 > size || memcmp(data + head, "PK\3\4", 4) != 0)
            continue;
        const size_t from =
            head + 30 + read_number(data + head + 26, 2) + read_number(data + head + 28, 2);
        if (from > size || length > size - from)
            continue;
        const uint32_t crc = find_checksum(data + from, length);
        write_checksum(data + at + 16, crc);
        write_checksum(data + head + 14, crc);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[256];
    uint8_t *mended = malloc(size + 1);
    fuzz_write("base.lua", LUA, sizeof LUA - 1);
    fuzz_write("base.yaml", SCENE, sizeof SCENE - 1);
    snprintf(path, sizeof path, "%s", fuzz_write("mods/fuzz.zip", data, size));
    read_archive(path);
    if (size)
        memcpy(mended, data, size);
    mend_checksums(mended, size);
    fuzz_write("mods/fuzz.zip", mended, size);
    free(mended);
    read_archive(path);
    run_with_mod(path);
    return 0;
}
