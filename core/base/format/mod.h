/* A mod as data: found and ordered by scene/, applied by scene/ (scenes) and lua/ (behaviours). */
#ifndef JOX_BASE_FORMAT_MOD_H
#define JOX_BASE_FORMAT_MOD_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/diag.h"
#include "base/format/path.h"

enum { JOX_MOST_MODS = 64 };

typedef struct JoxModSetting {
    char *name, *unit, *meaning;
    double value, least, greatest;
    JoxPosition position;
} JoxModSetting;

/* A file that changes a behaviour (.lua) or a scene (.yaml). */
typedef struct JoxModPatch {
    char *path;
    char *target; /* name of what it changes; NULL where it names nothing */
    bool lua, replaces;
    JoxPosition position; /* of the target's name */
} JoxModPatch;

/* What a person said of a mod. */
typedef enum JoxModSwitch {
    JOX_MOD_OFF,     /* nothing: it is taken only where it is named */
    JOX_MOD_CHANGED, /* turned on, but it holds something else since: as above */
    JOX_MOD_ON,
} JoxModSwitch;

typedef struct JoxMod {
    char *name, *title, *version;
    char *folder; /* where its mod.yaml lies */
    JoxModSwitch on;
    uint64_t
        after; /* bits of the mods (by index in the order) that it depends on, through others too */
    JoxModSetting *settings;
    uint32_t setting_count;
    JoxModPatch *patches;
    uint32_t patch_count;
} JoxMod;

/* Whether one dotted path is the other, or leads to it. "" leads to all. */
bool jox_mod_overlaps(const char *a, const char *b);
/* Warns that mod `later` sets at `at` what mod `earlier` has set at `before`, and wins. */
void jox_mod_conflict(JoxDiagnostics *diagnostics, const JoxMod *later, JoxPosition at,
                      const JoxMod *earlier, JoxPosition before, const char *path);

/* The file of the behaviour "mod:name" of one of the mods; ".lua" may be left out. False where it
   names none, or no file below the mod's behaviours. */
bool jox_mod_find(const JoxMod *mods, uint32_t count, const char *name,
                  char path[JOX_LONGEST_PATH]);

/* "NAME" or "NAME >= 1.2": the name, and the version that is asked for, or NULL. */
void jox_mod_need(const char *text, char name[64], const char **version);
/* Below, at or above 0 as version a is older than, like or newer than b: number by number. */
int jox_mod_compare(const char *a, const char *b);

#endif
