/* The results of a run as structs, for programs that embed the engine: figures, costs of Lua
   functions, and troubles. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/json.h"
#include "base/format/plurals.h"
#include "base/guard.h"
#include "base/result_block.h"
#include "jostle_tools.h"
#include "run/results/result_structs.h"
#include "run/run.h"
#include "run/standstill.h"
#include "run/wall_checks.h"

enum { HEAD, ITEMS };          /* parts of a pack */
enum { MOST_UNREACHABLE = 5 }; /* places named in troubles */

/* ---- figures ---- */

static JoFigureKind map_figure_kind(JoxJsonKind kind) {
    static const JoFigureKind KINDS[] = {
        [JOX_JSON_NULL] = JO_FIGURE_NONE,     [JOX_JSON_BOOL] = JO_FIGURE_TRUTH,
        [JOX_JSON_NUMBER] = JO_FIGURE_NUMBER, [JOX_JSON_TEXT] = JO_FIGURE_TEXT,
        [JOX_JSON_OBJECT] = JO_FIGURE_TABLE,  [JOX_JSON_ARRAY] = JO_FIGURE_LIST,
    };
    return KINDS[kind];
}

static bool add_figure(void *context, const JoxJsonItem *item) {
    JoxPack *pack = context;
    JoFigure *figure = jox_pack_add(pack, ITEMS, sizeof *figure);
    figure->kind = map_figure_kind(item->kind);
    figure->depth = item->depth;
    figure->number =
        item->kind == JOX_JSON_NUMBER || item->kind == JOX_JSON_BOOL ? item->number : (double)NAN;
    jox_pack_text(pack, ITEMS, &figure->path, item->path);
    jox_pack_text(pack, ITEMS, &figure->name, item->key);
    jox_pack_text(pack, ITEMS, &figure->text, item->text);
    return true;
}

/* Reads the figures from the JSON of jo_scene_summary, so that both always agree. */
JoFigures *jo_scene_figures(const JoScene *scene) {
    JOX_REQUIRE(scene, NULL);
    char *text = jo_scene_summary(scene);
    if (!text)
        return NULL;
    JOX_GUARD (NULL, NULL) {
        jox_free(text);
        return NULL;
    }
    JoxPack pack = {0};
    JoFigures *head = jox_pack_add(&pack, HEAD, sizeof *head);
    jox_pack_list(&pack, HEAD, &head->items, ITEMS);
    jox_json_read(text, jox_json_own_files, add_figure, &pack);
    head->count = (uint32_t)(jox_pack_length(&pack, ITEMS) / sizeof(JoFigure));
    JoFigures *figures = jox_disown(jox_pack_end(&pack));
    jox_free(text);
    return figures;
}

double jo_figure(const JoFigures *figures, const char *path) {
    JOX_REQUIRE(figures && path, NAN);
    for (uint32_t k = 0; k < figures->count; k++)
        if (strcmp(figures->items[k].path, path) == 0)
            return figures->items[k].number;
    return NAN;
}

/* ---- costs and troubles ---- */

JoLuaCosts *jo_scene_lua_costs(const JoScene *scene) {
    JOX_REQUIRE(scene, NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    JoxPack pack = {0};
    JoLuaCosts *head = jox_pack_add(&pack, HEAD, sizeof *head);
    jox_pack_list(&pack, HEAD, &head->items, ITEMS);
    const JoxLuaTotal total = jox_lua_total(scene->lua, scene->world->state.statistics.wall_s);
    head->stepping = total.stepping;
    for (uint32_t m = 0; m < scene->world->model.machines.count; m++) {
        JoLuaCost cost;
        for (uint32_t h = 0;
             jox_lua_cost(scene->lua, scene->world->model.machines.items[m], h, &cost); h++) {
            JoLuaCost *item = jox_pack_add(&pack, ITEMS, sizeof *item);
            *item = cost;
            item->seconds *= total.cut;
            jox_pack_text(&pack, ITEMS, &item->behaviour, cost.behaviour);
            jox_pack_text(&pack, ITEMS, &item->file, cost.file);
            jox_pack_text(&pack, ITEMS, &item->where, cost.where);
            head->count++;
        }
    }
    return jox_disown(jox_pack_end(&pack));
}

static void add_trouble(JoxPack *pack, JoTroubles *head, JoTroubleKind kind, uint64_t count,
                        const char *file, JoxText *text) {
    JoTrouble *item = jox_pack_add(pack, ITEMS, sizeof *item);
    item->kind = kind;
    item->count = count;
    jox_text_clean(text->data);
    jox_pack_text(pack, ITEMS, &item->file, file);
    jox_pack_text(pack, ITEMS, &item->text, text->data);
    head->count++;
    jox_text_free(text);
}

/* Adds functions that are suspended, and those that failed in at least a tenth of their calls. */
static void add_failing_functions(const JoScene *scene, JoxPack *pack, JoTroubles *head) {
    for (uint32_t m = 0; m < scene->world->model.machines.count; m++) {
        JoLuaCost cost;
        for (uint32_t h = 0;
             jox_lua_cost(scene->lua, scene->world->model.machines.items[m], h, &cost); h++) {
            JoxText text = {0};
            if (cost.suspended) {
                jox_text_printf(
                    &text, "behaviour %.200s was suspended: %.200s failed %d times within a second",
                    cost.file, cost.where, JOX_MOST_FAILURES);
                add_trouble(pack, head, JO_TROUBLE_SUSPENDED, JOX_MOST_FAILURES, cost.file, &text);
            } else if (jox_lua_is_failing(&cost)) {
                jox_text_printf(&text, "behaviour %.200s failed: %.200s, in %llu of %llu calls",
                                cost.file, cost.where, (unsigned long long)cost.failures,
                                (unsigned long long)cost.calls);
                add_trouble(pack, head, JO_TROUBLE_FAILED, cost.failures, cost.file, &text);
            }
        }
    }
}

/* Appends how many people of each group cannot reach a place. */
static void say_groups(const JoScene *scene, const JoxKeptPeople *kept, JoxText *out) {
    const JoxAgents *a = &scene->world->state.agents;
    uint32_t *all = jox_alloc((size_t)scene->spec->group_count + 1, sizeof *all);
    for (uint32_t i = 0; i < a->count; i++)
        all[a->group[i]]++;
    for (uint32_t g = 0, told = 0; g < scene->spec->group_count; g++) {
        if (kept->groups[g] == 0)
            continue;
        jox_text_add(out, told++ ? ", " : "; ");
        if (kept->groups[g] < all[g])
            jox_text_printf(out, "%u of the ", kept->groups[g]);
        jox_text_noun(out, all[g], "person|people");
        jox_text_printf(out, " of group '%.60s'", scene->spec->groups[g].name);
    }
    jox_free(all);
}

/* Adds the trouble that people cannot reach a place, as nothing will remove the obstacle. */
static void add_unreachable_place(const JoScene *scene, const JoxKeptPeople *kept, JoxPack *pack,
                                  JoTroubles *head) {
    const char *name = scene->world->machines.places[kept->place].name;
    const bool nobody =
        kept->people == scene->world->state.agents.count && scene->world->state.exits.left == 0;
    JoxText text = {0};
    jox_text_printf(&text, "%s reach '%.60s': ", nobody ? "nobody can" : "some cannot",
                    name ? name : "their goal");
    jox_run_say_hindrance(scene, &kept->why, &text);
    if (kept->why.kind == JOX_HINDRANCE_GATE)
        jox_text_add(&text, ", and nothing opens it");
    say_groups(scene, kept, &text);
    add_trouble(pack, head, JO_TROUBLE_NO_WAY, kept->people, "", &text);
}

/* Adds the first places that people cannot reach, MOST_UNREACHABLE at most. */
static void add_unreachable_places(const JoScene *scene, JoxPack *pack, JoTroubles *head) {
    const uint32_t before = head->count;
    const JoxKeptList *list = jox_run_list_kept_people(scene);
    for (uint32_t k = 0; list && k < list->count; k++)
        if (list->items[k].stands && head->count < before + MOST_UNREACHABLE)
            add_unreachable_place(scene, &list->items[k], pack, head);
}

JoTroubles *jo_scene_troubles(const JoScene *scene) {
    JOX_REQUIRE(scene, NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    const JoxStatistics *s = &scene->world->state.statistics;
    JoxPack pack = {0};
    JoxText text = {0};
    JoTroubles *head = jox_pack_add(&pack, HEAD, sizeof *head);
    jox_pack_list(&pack, HEAD, &head->items, ITEMS);
    add_failing_functions(scene, &pack, head);
    if (s->people_lost) {
        jox_text_printf(&text, "%llu times the numbers of somebody went wrong, who was %s",
                        (unsigned long long)s->people_lost,
                        scene->spec->lost_people == JO_LOST_REMOVE ? "removed"
                                                                   : "put back, at rest");
        add_trouble(&pack, head, JO_TROUBLE_LOST, s->people_lost, "", &text);
    }
    add_unreachable_places(scene, &pack, head);
    return jox_disown(jox_pack_end(&pack));
}

char *jox_run_troubles(const JoScene *scene) {
    JoxText text = {0};
    JoTroubles *troubles = jo_scene_troubles(scene);
    for (uint32_t t = 0; troubles && t < troubles->count; t++)
        jox_text_printf(&text, "%s%s", t ? "; " : "", troubles->items[t].text);
    jo_free(troubles);
    return text.data;
}
