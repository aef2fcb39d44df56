/* A mod as data. scene/ finds and orders mods and applies them to scenes; lua/ applies them to
   behaviours. */
#ifndef JOX_BASE_FORMAT_MOD_H
#define JOX_BASE_FORMAT_MOD_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/diag.h"
#include "base/format/path.h"
#include "base/text.h"

enum { JOX_MOST_MODS = 64 };

typedef enum JoxSettingKind {
    JOX_SETTING_NUMBER,
    JOX_SETTING_BOOL,
    JOX_SETTING_CHOICE /* one of several texts */
} JoxSettingKind;

typedef struct JoxModSetting {
    char *name, *unit, *meaning;
    char *written; /* the value as mod.yaml has it */
    JoxSettingKind kind;
    double value; /* BOOL: 0 or 1; CHOICE: index of the text. Read by what loads behaviours */
    double shown; /* the value of the behaviours that run */
    double least, greatest;
    char **choices; /* CHOICE */
    uint32_t choice_count;
    JoxPosition position;
} JoxModSetting;

/* A file that changes a behaviour (.lua) or a scene (.yaml). */
typedef struct JoxModPatch {
    char *path;
    char *target;         /* name of what it changes; NULL where it names nothing */
    bool lua, replaces;   /* a behaviour's patch; replaces the target as a whole */
    JoxPosition position; /* position of the target's name */
} JoxModPatch;

/* Whether the user has turned a mod on. A mod that is off is applied only if a scene or the command
   line names it. */
typedef enum JoxModSwitch {
    JOX_MOD_OFF,
    JOX_MOD_CHANGED, /* turned on, but its files have changed since: treated as off */
    JOX_MOD_ON,
} JoxModSwitch;

typedef struct JoxMod {
    char *name, *title, *version;
    char *folder; /* where its mod.yaml lies */
    JoxModSwitch on;
    uint64_t after; /* bit set of mods, by index, that it depends on, directly or through others */
    JoxModSetting *settings;
    uint32_t setting_count;
    JoxModPatch *patches;
    uint32_t patch_count;
} JoxMod;

/* Whether two dotted paths are equal or one is a parent of the other; "" is the parent of all. */
bool jox_mod_overlaps(const char *a, const char *b);
/* Warns that mod `later`, at `at`, sets a path that mod `earlier` has set at `before`; `later`
   wins. */
void jox_mod_conflict(JoxDiagnostics *diagnostics, const JoxMod *later, JoxPosition at,
                      const JoxMod *earlier, JoxPosition before, const char *path);

/* Reads a value of a setting from a text: a plain number in the setting's range, "true" or "false",
   one of its choices. False with a sentence in `why`. */
bool jox_setting_parse(const JoxModSetting *setting, const char *text, double *value, JoxText *why);
/* Returns a value of a setting that is no number, as a text. */
const char *jox_setting_text(const JoxModSetting *setting, double value);

/* Finds the file of a behaviour that is named "mod:name"; ".lua" may be left out. False if there is
   no such mod, or no such file in its folder behaviours/. */
bool jox_mod_find(const JoxMod *mods, uint32_t count, const char *name,
                  char path[JOX_LONGEST_PATH]);

/* Splits a dependency, "NAME" or "NAME >= 1.2", into the name and the least version, or NULL. */
void jox_mod_split_dependency(const char *text, char name[64], const char **version);
/* Compares versions number by number: -1, 0 or 1 if a is older than, equal to or newer than b. */
int jox_mod_compare(const char *a, const char *b);

#endif
