/* Mods: folders with a mod.yaml. Which there are, which are taken, and in what order. */
#ifndef JOX_SCENE_MODS_H
#define JOX_SCENE_MODS_H

#include "base/format/mod.h"

typedef struct JoxModsDef {
    const char *const *named; /* folders, or names of mods in the folders below */
    uint32_t named_count;
    const char *scene;       /* path of the scene: its mods/ is looked into, and its `mods` read */
    const char *const *sets; /* "mods.NAME.SETTING=VALUE" among others */
    uint32_t set_count;
    bool named_only;  /* mods that a person turned on are not taken for that */
    bool needed_too;  /* what a named mod depends on is taken as if it were named */
    uint64_t without; /* bits of `found`: left out, with those that depend on them */
} JoxModsDef;

typedef struct JoxMods {
    JoxMod *items; /* those that are taken, in order */
    uint32_t count;
    JoxMod *found; /* all that were found, by name; a taken one shares its texts */
    uint32_t found_count;
    uint32_t *number; /* of a taken one among the found */
    struct JoxArena *memory;
} JoxMods;

/* Finds, reads, chooses and orders mods. Taken are those that are named, that the scene names, and
   that a person turned on (mods_on.h), where all that they depend on is taken. The order: by depth
   of what they depend on, then by name. What is wrong with one goes to `diagnostics`, and it and
   its dependents are left out; never NULL. Folders looked into: the scene's mods/, and jostle/mods
   in the user's data directory. */
JoxMods *jox_mods_find(const JoxModsDef *def, JoxDiagnostics *diagnostics);
void jox_mods_free(JoxMods *mods);
/* Index in `found`, or -1. */
int32_t jox_mods_index(const JoxMods *mods, const char *name);

#endif
