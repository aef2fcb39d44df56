/* Writes the page of Markdown on the behaviours and library files that mods offer to others
   (`jostle reference mods`). */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/quote.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "run/read_scene.h"
#include "run/run.h"

typedef struct Page {
    JoxLua *lua;
    JoxScope scope;
    JoxText out;
    JoxDiagnostics diagnostics;
} Page;

static void add_description(Page *page, const char *about) {
    if (!about)
        return;
    jox_quote_markdown(&page->out, about);
    jox_text_add(&page->out, "\n\n");
}

/* Adds a file that others can use: a behaviour, or a library that they require. */
static void add_offered_file(Page *page, const JoxMod *mod, const char *stem, const char *path) {
    uint32_t count;
    char *about;
    JoxLuaExport *exports =
        jox_lua_exports(page->lua, path, &page->scope, &count, &about, &page->diagnostics);
    const bool behaviour = count == 1 && strcmp(exports[0].kind, "a machine") == 0;
    if (behaviour) {
        jox_text_printf(&page->out, "### behaviour: %s:%s\n\n", mod->name, stem);
        add_description(page, about);
    } else if (count) {
        jox_text_printf(&page->out, "### require \"%s:%s\"\n\n", mod->name, stem);
        add_description(page, about);
        jox_text_add(&page->out, "| name | what | meaning |\n|---|---|---|\n");
        for (uint32_t e = 0; e < count; e++) {
            jox_text_add(&page->out, "| `");
            jox_quote_markdown(&page->out, *exports[e].name ? exports[e].name : "(the file)");
            jox_text_printf(&page->out, "` | %s | ", exports[e].kind);
            jox_quote_markdown(&page->out, exports[e].doc ? exports[e].doc : "");
            jox_text_add(&page->out, " |\n");
        }
        jox_text_add(&page->out, "\n");
    }
    jox_free(about);
    jox_lua_exports_free(exports, count);
}

static void add_mod_chapter(Page *page, const JoxMod *mod) {
    char folder[JOX_LONGEST_PATH];
    jox_text_printf(&page->out, "## %s %s%s%s\n\n", mod->name, mod->version,
                    *mod->title ? ": " : "", mod->title);
    snprintf(folder, sizeof folder, "%s/behaviours", mod->folder);
    char **names = jox_folder_names(folder, false);
    const size_t before = page->out.length;
    for (size_t n = 0; names && names[n]; n++) {
        char stem[256], path[JOX_LONGEST_PATH];
        const size_t length = strlen(names[n]);
        if (length <= 4 || length > 250 || strcmp(names[n] + length - 4, ".lua") != 0)
            continue;
        snprintf(stem, sizeof stem, "%.*s", (int)(length - 4), names[n]);
        if (snprintf(path, sizeof path, "%s/%s", folder, names[n]) < (int)sizeof path)
            add_offered_file(page, mod, stem, path);
    }
    if (page->out.length == before)
        jox_text_add(&page->out, "It defines nothing that others could use.\n\n");
    jox_free(names);
}

char *jo_mods_reference(const JoSceneDef *def) {
    JOX_REQUIRE(def, NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    Page page = {.lua = jox_lua_create(NULL)};
    JoxMods *mods = jox_run_find_mods(def, 0, &page.diagnostics);
    page.scope = (JoxScope){.mods = mods->items, .mod_count = mods->count};
    jox_text_add(&page.out, "# What mods define\n\n");
    for (uint32_t m = 0; m < mods->count; m++)
        add_mod_chapter(&page, &mods->items[m]);
    if (mods->count == 0)
        jox_text_add(&page.out, "No mod is taken: name one by --mod, or turn it on.\n");
    jox_mods_free(mods);
    jox_lua_free(page.lua);
    jox_run_report_diagnostics(def->message, def->message_context, &page.diagnostics, NULL);
    return jox_disown(page.out.data);
}
