/* What the files that find, read and order mods share. */
#ifndef JOX_SCENE_MODS_PARTS_H
#define JOX_SCENE_MODS_PARTS_H

#include "scene/format/schema.h"
#include "scene/mods.h"

/* What a mod.yaml says of others, until the order is known. */
typedef struct JoxModNeeds {
    const JoxYaml *root;
    const JoxYaml *const *depends, *const *optional, *const *conflicts, *const *load_after;
    uint32_t depend_count, optional_count, conflict_count, after_count;
    bool wanted, broken;
    enum { JOX_MOD_UNSEEN, JOX_MOD_ON_THE_WAY, JOX_MOD_SOUND } link; /* of what it depends on */
    int depth;
    uint64_t before; /* bits of `found` that come before it */
} JoxModNeeds;

typedef struct JoxModsFind {
    const JoxModsDef *def;
    JoxMods *mods;
    JoxModNeeds needs[JOX_MOST_MODS];
    JoxReader reader;
    char *on; /* the list of mods that are turned on */
} JoxModsFind;

/* mods_read.c: reads the mod in a folder; one that is there already is not read again. */
void jox_mods_read_folder(JoxModsFind *find, const char *folder, bool wanted);
bool jox_mods_is_folder(const char *path);
/* FOLDER/NAME, in the arena. */
char *jox_mods_join(JoxArena *arena, const char *folder, const char *name);
void jox_mods_missing(JoxModsFind *find, JoxPosition at, const char *name, const char *whose);
/* mods_order.c: leaves out what lacks others or goes not together with them, and orders the rest.
 */
void jox_mods_order(JoxModsFind *find);

#endif
