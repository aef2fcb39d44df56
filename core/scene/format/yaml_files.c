/* Reads YAML files by libyaml into trees, and merges the files that they include. */
#include "scene/format/yaml.h"

#include <errno.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <yaml.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/path.h"
#include "base/hash.h"
#include "base/mem.h"

enum {
    LARGEST = 10 << 20,
    DEEPEST = JOX_YAML_DEEPEST,
    MOST_NODES = 500000,
    MOST_INCLUDES = 16,
    MOST_KEYS = 4096
};

/* ---- parsing ---- */

typedef struct Anchor {
    char *name;
    JoxYaml *node;
} Anchor;

typedef struct Parse {
    JoxArena *arena;
    JoxDiagnostics *diagnostics;
    yaml_parser_t parser;
    yaml_event_t events[DEEPEST + 3]; /* by depth of nesting; unused ones are all zero */
    const char *path, *text;
    JoxYamlRole role;
    size_t length; /* bytes of the text */
    Anchor anchors[256];
    uint32_t anchor_count;
    uint64_t *nodes; /* nodes of all files, counted as if every alias were written out */
    bool failed;
} Parse;

static JoxPosition get_position(const Parse *p, yaml_mark_t from, yaml_mark_t to) {
    int end = to.line == from.line ? (int)to.column + 1 : (int)from.column + 2;
    return (JoxPosition){p->path, (int)from.line + 1, (int)from.column + 1, end};
}

static void report_yaml_error(Parse *p, JoxPosition at, const char *code, const char *text,
                              const char *hint) {
    if (!p->failed)
        jox_diag_error(p->diagnostics, at, code, hint, "%s", text);
    p->failed = true;
}

/* Reports that the whole file is empty, or not a map. */
static void report_no_map(Parse *p, bool empty) {
    static const struct {
        const char *empty, *other, *hint;
    } SAY[] = {
        [JOX_YAML_SCENE] = {"the scene is empty", "a scene must be a map of keys",
                            "See scenes/circle.yaml"},
        [JOX_YAML_MOD] = {"this file of a mod is empty", "a mod.yaml must be a map of keys",
                          "Example: {name: calm, version: 1.0.0, api: 1}"},
        [JOX_YAML_PATCH] = {"this patch is empty", "a patch must be a map of keys",
                            "Example: {patch: tawaf, duration: 60}"},
    };
    report_yaml_error(p, (JoxPosition){p->path, 1, 1, 2}, "bad-yaml",
                      empty ? SAY[p->role].empty : SAY[p->role].other, SAY[p->role].hint);
}

/* Whether a line is indented by a tab, which YAML forbids. */
static bool is_indented_by_tab(const Parse *p, size_t line) {
    const char *at = p->text, *end = p->text + p->length;
    for (; at < end && line > 0; at++)
        line -= *at == '\n';
    while (at < end && *at == ' ')
        at++;
    return at < end && *at == '\t';
}

static bool parse_event(Parse *p, yaml_event_t *event) {
    if (yaml_parser_parse(&p->parser, event))
        return true;
    if (p->parser.error == YAML_MEMORY_ERROR)
        jox_out_of_memory(0);
    yaml_mark_t at = p->parser.problem_mark;
    JoxPosition position = {p->path, (int)at.line + 1, (int)at.column + 1, (int)at.column + 2};
    if (p->parser.error == YAML_READER_ERROR) /* a character that YAML forbids */
        report_yaml_error(p, jox_position_in(p->path, p->text, p->parser.problem_offset),
                          "bad-yaml", p->parser.problem, "Take it out");
    else if (is_indented_by_tab(p, at.line))
        report_yaml_error(p, position, "tab", "this line is indented by a tab", "Indent by spaces");
    else
        report_yaml_error(p, position, "bad-yaml",
                          p->parser.problem ? p->parser.problem : "this is not YAML",
                          "Check indentation and quotes");
    return false;
}

/* Copies the text of a scalar; NULL with an error if it has a zero byte, from "\\0". */
static char *copy_scalar(Parse *p, const yaml_event_t *event, JoxPosition at) {
    const char *text = (const char *)event->data.scalar.value;
    if (strlen(text) == event->data.scalar.length)
        return jox_arena_text(p->arena, text);
    report_yaml_error(p, at, "bad-text", "a text has no zero byte", "Take \\0 or \\x00 out");
    return NULL;
}

static uint64_t count_nodes(const JoxYaml *node, int depth) {
    uint64_t size = 1;
    for (uint32_t i = 0; i < node->count && depth < DEEPEST && size < MOST_NODES; i++)
        size += count_nodes(node->items[i], depth + 1);
    return size;
}

static void keep_anchor(Parse *p, const yaml_char_t *name, JoxYaml *node) {
    if (name && p->anchor_count < 256)
        p->anchors[p->anchor_count++] =
            (Anchor){jox_arena_text(p->arena, (const char *)name), node};
}

static JoxYaml *parse_node(Parse *p, yaml_event_t *event, int depth);

static JoxYaml *resolve_alias(Parse *p, const char *name, JoxPosition at) {
    for (uint32_t i = p->anchor_count; i-- > 0;) {
        if (strcmp(p->anchors[i].name, name) != 0)
            continue;
        *p->nodes += count_nodes(p->anchors[i].node, 0);
        if (*p->nodes > MOST_NODES)
            report_yaml_error(p, at, "too-large", "aliases make this scene too large", NULL);
        return p->anchors[i].node;
    }
    report_yaml_error(p, at, "unknown-anchor", "there is no anchor of this name before", NULL);
    return NULL;
}

static void parse_map_items(Parse *p, JoxYaml *map, int depth) {
    yaml_event_t *event = &p->events[depth + 1];
    JoxYaml *bases[8];
    uint32_t base_count = 0;
    while (!p->failed && parse_event(p, event)) {
        if (event->type == YAML_MAPPING_END_EVENT) {
            yaml_event_delete(event);
            break;
        }
        JoxPosition at = get_position(p, event->start_mark, event->end_mark);
        if (event->type != YAML_SCALAR_EVENT) {
            report_yaml_error(p, at, "bad-key", "keys must be plain names", NULL);
            yaml_event_delete(event);
            break;
        }
        char *key = copy_scalar(p, event, at);
        yaml_event_delete(event);
        if (!key || !parse_event(p, event))
            break;
        JoxYaml *value = parse_node(p, event, depth + 1);
        if (!value)
            break;
        if (map->count >= MOST_KEYS) {
            report_yaml_error(p, at, "too-large", "this map has too many keys", NULL);
        } else if (strcmp(key, "<<") == 0) {
            bool list = value->kind == JOX_YAML_LIST;
            for (uint32_t i = 0; i < (list ? value->count : 1); i++) {
                JoxYaml *base = list ? value->items[i] : value;
                if (base->kind == JOX_YAML_MAP && base_count < 8)
                    bases[base_count++] = base;
                else
                    jox_diag_error(p->diagnostics, value->position, "bad-merge", "<<: *name",
                                   "`<<` takes up to eight maps");
            }
        } else if (jox_yaml_get(map, key))
            jox_diag_error(p->diagnostics, at, "duplicate-key", "Keep one of them",
                           "the key '%s' stands here twice", key);
        else
            jox_yaml_add(p->arena, map, key, at, value);
    }
    for (uint32_t i = 0; i < base_count && !p->failed; i++)
        jox_yaml_merge(p->arena, map, bases[i]);
}

/* Parses the node that begins with `event`, and deletes the event. */
static JoxYaml *parse_node(Parse *p, yaml_event_t *event, int depth) {
    JoxPosition at = get_position(p, event->start_mark, event->end_mark);
    JoxYaml *node = NULL;
    if (depth > DEEPEST || ++*p->nodes > MOST_NODES) {
        report_yaml_error(p, at, "too-large",
                          depth > DEEPEST
                              ? "this is nested too deeply"
                              : "this scene is too large, with the files that it includes",
                          NULL);
    } else if (event->type == YAML_ALIAS_EVENT) {
        node = resolve_alias(p, (const char *)event->data.alias.anchor, at);
    } else {
        node = jox_arena_take(p->arena, 1, sizeof *node);
        node->position = at;
        if (event->type == YAML_SCALAR_EVENT) {
            node->kind = JOX_YAML_SCALAR;
            node->text = copy_scalar(p, event, at);
            node->quoted = event->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
            keep_anchor(p, event->data.scalar.anchor, node);
        } else if (event->type == YAML_SEQUENCE_START_EVENT) {
            node->kind = JOX_YAML_LIST;
            yaml_event_t *item = &p->events[depth + 1];
            while (!p->failed && parse_event(p, item)) {
                if (item->type == YAML_SEQUENCE_END_EVENT) {
                    yaml_event_delete(item);
                    break;
                }
                JoxYaml *child = parse_node(p, item, depth + 1);
                if (child)
                    jox_yaml_add(p->arena, node, NULL, at, child);
            }
            keep_anchor(p, event->data.sequence_start.anchor,
                        node); /* kept after its items, so that they cannot refer to it */
        } else if (event->type == YAML_MAPPING_START_EVENT) {
            node->kind = JOX_YAML_MAP;
            parse_map_items(p, node, depth);
            keep_anchor(p, event->data.mapping_start.anchor, node);
        }
    }
    yaml_event_delete(event);
    return p->failed ? NULL : node;
}

static void free_parse(void *parse) {
    Parse *p = parse;
    for (size_t e = 0; e < sizeof p->events / sizeof *p->events; e++)
        yaml_event_delete(&p->events[e]);
    yaml_parser_delete(&p->parser);
}

static JoxYaml *parse_text(Parse *p, const char *text, size_t length) {
    if (!yaml_parser_initialize(&p->parser))
        jox_out_of_memory(0);
    jox_heap_register(p, free_parse);
    p->text = text;
    p->length = length;
    yaml_parser_set_input_string(&p->parser, (const unsigned char *)text, length);
    yaml_event_t *event = &p->events[0];
    JoxYaml *root = NULL;
    while (!p->failed && parse_event(p, event)) {
        bool end = event->type == YAML_STREAM_END_EVENT;
        bool starts = event->type == YAML_MAPPING_START_EVENT ||
                      event->type == YAML_SEQUENCE_START_EVENT || event->type == YAML_SCALAR_EVENT;
        if (starts && root)
            report_yaml_error(p, get_position(p, event->start_mark, event->end_mark), "bad-yaml",
                              "a file is one document; this is a second", NULL);
        if (starts && !p->failed)
            root = parse_node(p, event, 0);
        else
            yaml_event_delete(event);
        if (end)
            break;
    }
    jox_heap_unregister(p);
    free_parse(p);
    if (!p->failed && (!root || root->kind != JOX_YAML_MAP))
        report_no_map(p, !root);
    return p->failed ? NULL : root;
}

/* ---- files ---- */

static JoxYaml *read_yaml_file(JoxArena *arena, const char *path, const char *text, size_t length,
                               JoxYamlFiles *files, JoxDiagnostics *diagnostics, JoxPosition from);

/* Merges the files that a tree includes into it, in their order; its own keys win. */
static void include_files(JoxArena *arena, JoxYaml *root, const char *path, JoxYamlFiles *files,
                          JoxDiagnostics *diagnostics) {
    JoxYaml *names = jox_yaml_get(root, "include");
    uint32_t count = !names ? 0 : names->kind == JOX_YAML_LIST ? names->count : 1;
    for (uint32_t i = 0; i < count; i++) {
        JoxYaml *name = names->kind == JOX_YAML_LIST ? names->items[i] : names;
        if (name->kind != JOX_YAML_SCALAR) {
            jox_diag_error(diagnostics, name->position, "bad-type", "include: other.yaml",
                           "include names files");
            continue;
        }
        char *beside = jox_arena_beside(arena, path, name->text);
        struct stat info;
        if (files->untrusted && (*name->text == '/' || strstr(name->text, "..") ||
                                 (lstat(beside, &info) == 0 && S_ISLNK(info.st_mode)))) {
            jox_diag_error(diagnostics, name->position, "bad-include",
                           "A mod includes files beside its own, by plain names",
                           "a mod cannot include '%.100s'", name->text);
            continue;
        }
        if (jox_path_is_foreign(path, beside)) {
            jox_diag_error(diagnostics, name->position, "bad-include", "Copy it beside the scene",
                           "'%.200s' lies outside the folder of %.200s", name->text, path);
            continue;
        }
        bool again = false;
        for (uint32_t f = 0; f < files->count; f++)
            again |= strcmp(files->items[f].path, beside) == 0;
        if (again || files->count >= MOST_INCLUDES) {
            jox_diag_error(diagnostics, name->position, "include-cycle", NULL,
                           again ? "'%s' includes itself or is included twice"
                                 : "too many files are included, at '%s'",
                           name->text);
            continue;
        }
        JoxYaml *base = read_yaml_file(arena, beside, NULL, 0, files, diagnostics, name->position);
        if (base)
            jox_yaml_merge(arena, root, base);
    }
}

static JoxYaml *read_yaml_file(JoxArena *arena, const char *path, const char *text, size_t length,
                               JoxYamlFiles *files, JoxDiagnostics *diagnostics, JoxPosition from) {
    char *own = NULL, unread[JOX_UNREAD];
    const char *wrong = NULL;
    if (!text)
        text = own = jox_read_file(path, LARGEST, &length);
    if (!text)
        wrong = errno == EFBIG ? "it is over 10 MB" : jox_unread_text(path, errno, unread);
    else if (length > LARGEST)
        wrong = "it is over 10 MB";
    if (wrong) {
        jox_diag_error(diagnostics, from.line ? from : ((JoxPosition){path, 0, 0, 0}),
                       "unreadable-file", NULL, "cannot read '%s': %s", path, wrong);
        jox_free(own);
        return NULL;
    }
    JoxYamlFile *file = &files->items[files->count++];
    file->path = jox_arena_text(arena, path);
    file->text = memcpy(jox_arena_take(arena, length + 1, 1), text, length);
    file->length = length;
    jox_sha256_hex(text, length, file->sha256);
    jox_free(own);
    Parse *parse = jox_alloc(1, sizeof *parse);
    parse->arena = arena;
    parse->diagnostics = diagnostics;
    parse->path = file->path;
    parse->role = files->role;
    parse->nodes = &files->nodes;
    JoxYaml *root = NULL;
    if (jox_diag_check_text(diagnostics, file->path, file->text, length))
        root = parse_text(parse, file->text, length);
    jox_free(parse);
    if (root)
        include_files(arena, root, file->path, files, diagnostics);
    return root;
}

JoxYaml *jox_yaml_read(JoxArena *arena, const char *path, const char *text, size_t length,
                       JoxYamlFiles *files, JoxDiagnostics *diagnostics) {
    return read_yaml_file(arena, path, text, length, files, diagnostics, (JoxPosition){0});
}

void jox_yaml_attach_sources(const JoxYamlFiles *files, JoxDiagnostics *diagnostics) {
    for (uint32_t i = 0; i < files->count; i++)
        jox_diag_attach_source(diagnostics, files->items[i].path, files->items[i].text,
                               files->items[i].length);
}
