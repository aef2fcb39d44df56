/* State and functions shared by the files that find, read and order mods. jox_mods_find makes the
   JoxModsFind, which mods_read.c fills and mods_order.c reads. */
#ifndef JOX_SCENE_MODS_PARTS_H
#define JOX_SCENE_MODS_PARTS_H

#include "scene/format/keys.h"
#include "scene/mods.h"

/* Relations of a mod to others, from its mod.yaml, and what follows from them. */
typedef struct JoxModNeeds {
    const JoxYaml *root; /* the mod.yaml */
    const JoxYaml *const *depends, *const *optional, *const *conflicts, *const *load_after;
    uint32_t depend_count, optional_count, conflict_count, after_count;
    bool wanted, broken; /* named or enabled; must be left out */
    enum {
        JOX_MOD_UNSEEN,
        JOX_MOD_ON_THE_WAY,
        JOX_MOD_SEEN
    } visit;         /* state of the check of its dependencies */
    int depth;       /* longest chain of mods that come before it */
    uint64_t before; /* bit set of `found`: mods that come before it */
} JoxModNeeds;

typedef struct JoxModsFind {
    const JoxModsDef *def;
    JoxMods *mods;
    JoxModNeeds needs[JOX_MOST_MODS]; /* by index in mods->found */
    JoxReader reader;
    char *enabled; /* text of the list of enabled mods (mods_enabled.h), or NULL */
} JoxModsFind;

/* mods_read.c. Reads the mod in a folder and appends it to `found`, unless it is there already.
   `wanted`: it is named. */
void jox_mods_read_folder(JoxModsFind *find, const char *folder, bool wanted);
/* Whether a path is a folder, or an archive, also one that is refused. */
bool jox_mods_is_place(const char *path);
/* Returns FOLDER/NAME, in the arena. */
char *jox_mods_join(JoxArena *arena, const char *folder, const char *name);
/* Reports that there is no mod `name`. `needed_by`: the mod or "the scene" that needs it; or "". */
void jox_mods_report_missing(JoxModsFind *find, JoxPosition at, const char *name,
                             const char *needed_by);
/* mod_settings.c. Reads the scene's values of the settings of mod `m`. */
void jox_mods_read_values(JoxModsFind *find, uint32_t m, const JoxYaml *values);
/* Sets "mods.NAME.SETTING=VALUE" of the command line. */
void jox_mods_apply_overrides(JoxModsFind *find);
/* mods_order.c. Leaves out mods whose dependencies are missing or that conflict, and orders the
   others in mods->items. */
void jox_mods_order(JoxModsFind *find);

#endif
