// What the editor completes and explains: words of behaviours in Lua, keys of scenes in YAML.
import { nodeAt, pathAt } from "./yaml_path.js";

const STATES = /^[ \t]*(?:([A-Z]\w*)|\["([^"\n]+)"\])[ \t]*=[ \t]*\{/gm;
const PLACE_WORDS = /\b(?:seek|inside|arrived|near|away_from|field|queue|orbit|along|crosses|wander|drift|spread_over|density|count|queued|left|open|shut|distance)\s*\(?\s*["'][\w-]*$/;

const option = ({ name, type, text }, kind, apply) => ({ label: name, detail: type, info: text, type: kind, apply });

/** Names in a table that a behaviour gives: "memory { hits = 0 }", "own = { first = false }". */
function namesIn(text, opening) {
    const inside = opening.exec(text)?.[1] ?? "";
    return [...inside.matchAll(/([A-Za-z_]\w*)\s*=/g)].map((m) => ({ name: m[1], type: "", text: "declared in this file" }));
}

/** Names of places, tags and teams of the scenes among the files. */
function targetsIn(files) {
    const names = new Set(["anyone", "teammates", "opponents"]);
    for (const text of Object.entries(files).filter(([path]) => path.endsWith(".yaml")).map(([, t]) => t)) {
        const places = /^places:[ \t]*\n((?:[ \t]+[^\n]*\n?)+)/m.exec(text)?.[1] ?? "";
        for (const [, name] of places.matchAll(/^\s+([\w-]+):/gm)) names.add(name);
        for (const [, tags] of text.matchAll(/\btags: *\[([^\]]*)\]/g)) tags.split(",").forEach((t) => names.add(t.trim()));
    }
    return [...names].filter(Boolean).map((name) => ({ name, type: "", text: "a place, tag or group that the scene names" }));
}

/** Options for the end of `before` in a behaviour: {from, options}, `from` in characters from its end; null: none. */
function completeLua(before, text, words, files, asked) {
    const word = /[A-Za-z_]\w*$/.exec(before)?.[0] ?? "", line = before.slice(before.lastIndexOf("\n") + 1), start = line.slice(0, line.length - word.length);
    if (/--/.test(start.replace(/"[^"]*"/g, ""))) return null;
    const quotes = (start.match(/"/g) ?? []).length % 2 === 1;
    if (quotes) {
        const typed = /["']([\w -]*)$/.exec(line)?.[1] ?? "";
        if (/\b(?:to|start)\s*=\s*"[^"]*$/.test(line)) return { from: typed.length, options: [...text.matchAll(STATES)].map((m) => option({ name: m[1] ?? m[2], type: "state", text: "" }, "class")) };
        const places = PLACE_WORDS.test(line) || /\b(?:nearest|neighbours|best|anyone|all)\s*\(?\s*"[\w-]*$/.test(line);
        return places ? { from: typed.length, options: targetsIn(files).map((row) => option(row, "constant")) } : null;
    }
    const space = /(\w+)\.$/.exec(start)?.[1];
    if (space) {
        const declared = { mine: () => namesIn(text, /memory\s*\{([^}]*)\}/), own: () => [...namesIn(text, /\bown\s*=\s*\{([^}]*)\}/), ...words.spaces.own] }[space];
        const rows = declared?.() ?? words.spaces[space] ?? (word || asked ? words.spaces.other : []);
        return { from: word.length, options: rows.map((row) => option(row, "property")) };
    }
    if (/[\w)\]}]:$/.test(start)) return { from: word.length, options: words.methods.map((row) => option(row, "method")) };
    if (!word && !asked) return null;
    const inTable = /(?:^|[{,])\s*$/.test(start);
    const keys = inTable ? words.keys.map((row) => option(row, "keyword", `${row.name} = `)) : [];
    return { from: word.length, options: [...keys, ...words.words.map((row) => option(row, /\(/.test(row.type) ? "function" : "variable"))] };
}

/** Options for the end of `before` in a scene. */
function completeYaml(before, words, files, asked) {
    const line = before.slice(before.lastIndexOf("\n") + 1);
    if (/(^|\s)#/.test(line)) return null;
    const { path, key, word } = pathAt(before);
    if (/\s$/.test(word) || (!word && !asked && !/[{,:]\s$/.test(line))) return null;
    if (key !== null) {
        const node = nodeAt(words.scene, [...path, key]);
        if (key === "behaviour" || key === "mix") {
            const lua = [...new Set([...Object.keys(files).filter((p) => p.endsWith(".lua")).map((p) => p.split("/").pop()), ...words.behaviours])];
            return { from: word.length, options: lua.map((name) => option({ name, type: "behaviour", text: "" }, "constant")) };
        }
        return node?.values ? { from: word.length, options: node.values.map((name) => option({ name: String(name), type: "", text: node.text }, "constant")) } : null;
    }
    const node = nodeAt(words.scene, path);
    if (!node?.keys) return node?.values ? { from: word.length, options: node.values.map((name) => option({ name: String(name), type: "", text: node.text }, "constant")) } : null;
    return { from: word.length, options: Object.entries(node.keys).map(([name, { text }]) => option({ name, type: "key", text: text ?? "" }, "keyword", `${name}: `)) };
}

/**
 * Completes the end of `before`, the text of `path` up to the caret. `words`: {words, keys, spaces, methods, scene, behaviours};
 * `files`: all texts; `asked`: whether the writer asked for it, by Ctrl+Space.
 */
export function complete({ path, before, text, words, files, asked }) {
    const found = path.endsWith(".lua") ? completeLua(before, text, words, files, asked) : path.endsWith(".yaml") ? completeYaml(before, words, files, asked) : null;
    return found && found.options.length ? found : null;
}

/** Explains the word that covers `at` in a text: {name, type, text, from, to}; null: nothing is known of it. */
export function explain({ path, text, at, words }) {
    const from = at - /[A-Za-z_]\w*$|$/.exec(text.slice(0, at))[0].length, to = at + /^\w*/.exec(text.slice(at))[0].length, name = text.slice(from, to);
    if (!name || /^\d/.test(name)) return null;
    const line = text.slice(text.lastIndexOf("\n", from - 1) + 1, from);
    if (path.endsWith(".yaml")) {
        if (/(^|\s)#/.test(line)) return null;
        const { path: keys, key } = pathAt(text.slice(0, from)), isKey = /^\s*:/.test(text.slice(to));
        const node = nodeAt(words.scene, isKey ? [...keys, name] : key !== null ? [...keys, key] : keys);
        return node?.text ? { name: isKey ? name : key ?? name, type: "", text: node.text, from, to } : null;
    }
    if (/--/.test(line)) return null;
    const inQuotes = (line.match(/"/g) ?? []).length % 2 === 1, space = /(\w+)\.$/.exec(line)?.[1];
    if (inQuotes) return null;
    const isKey = /^\s*=[^=]/.test(text.slice(to));
    const rows = space ? words.spaces[space] ?? words.spaces.other : /:$/.test(line) ? words.methods : isKey ? words.keys : [...words.words, ...words.keys];
    const row = rows.find((r) => r.name === name);
    return row ? { ...row, from, to } : null;
}
