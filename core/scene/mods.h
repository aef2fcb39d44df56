/* Mods: folders with a mod.yaml, that change scenes and behaviours. Finds them, chooses which of
   them a scene applies, and orders them. Called by run/ before it reads a scene. */
#ifndef JOX_SCENE_MODS_H
#define JOX_SCENE_MODS_H

#include "base/format/mod.h"

typedef struct JoxModsDef {
    const char *const *named; /* folders of mods, or names of mods in the folders searched */
    uint32_t named_count;
    const char *scene;       /* path of the scene: its key `mods` and its folder mods/ are read */
    const char *const *sets; /* "mods.NAME.SETTING=VALUE" among others */
    uint32_t set_count;
    bool named_only;  /* mods that the user has enabled (mods_enabled.h) are not chosen for that */
    bool needed_too;  /* mods that a chosen mod depends on are chosen too */
    uint64_t without; /* bit set of `found`: left out, with the mods that depend on them */
} JoxModsDef;

typedef struct JoxMods {
    JoxMod *items; /* the chosen mods, in order */
    uint32_t count;
    JoxMod *found; /* all mods found; `items` are copies that share their texts */
    uint32_t found_count;
    uint32_t *found_index;   /* index in `found` of each of `items` */
    struct JoxArena *memory; /* owns all of this */
} JoxMods;

/* Finds, reads, chooses and orders mods; free them by jox_mods_free. Chosen are the mods that `def`
   or the scene names and those that the user has enabled, if all that they depend on is chosen.
   They are ordered by the depth of what must come before them, then by name. A mod that is wrong is
   reported in `diagnostics` and left out with the mods that depend on it; the result is never NULL.
   Folders searched: the scene's mods/, jostle/mods in the user's data directory, and the folders
   beside mods that are found. */
JoxMods *jox_mods_find(const JoxModsDef *def, JoxDiagnostics *diagnostics);
void jox_mods_free(JoxMods *mods);
/* Whether a path is a zip archive. */
bool jox_mods_is_archive(const char *path);
/* Returns the index of a mod in `found`, or -1. */
int32_t jox_mods_index(const JoxMods *mods, const char *name);

#endif
