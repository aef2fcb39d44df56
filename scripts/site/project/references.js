// Which files a scene reads: behaviours, included scenes, walls, inputs, modules and mods, found by their names in the texts.

const NAME = /[\p{L}\p{N}_./-]+\.(?:lua|yaml|wkt|dxf|geojson|json|xml|input)\b/gu;
/** Endings of files that the engine reads. */
export const ENDINGS = ["lua", "yaml", "wkt", "dxf", "geojson", "json", "xml", "input"];
const BECOME = /\bbecome\s*=\s*["']([\w-]+)["']/g;
const REQUIRE = /\brequire\s*\(?\s*["']([\w.-]+)["']/g;

/** "a/b/../c" as "a/c". */
export function plainPath(path) {
    const parts = [];
    for (const part of path.split("/")) {
        if (part === "..") parts.pop();
        else if (part !== "." && part !== "") parts.push(part);
    }
    return parts.join("/");
}

/** Whether a name can be that of a new file: a path without odd characters, of a kind that the engine reads. */
export const isFileName = (name) => /^(?:[\p{L}\p{N}_-][\p{L}\p{M}\p{N} _.-]*\/)*[\p{L}\p{N}_-][\p{L}\p{M}\p{N} _.-]*$/u.test(name) && ENDINGS.includes(name.split(".").pop()) && !/^\.|\/\./.test(name);

/** What is wrong with the paths of a project, a sentence's end; null if nothing is. */
export function pathsFault(paths) {
    const all = new Set(paths);
    for (const path of all) {
        if (path === "" || path === "__proto__" || plainPath(path) !== path) return `"${path}" is no path of a file`;
        for (let at = path.indexOf("/"); at > 0; at = path.indexOf("/", at + 1)) if (all.has(path.slice(0, at))) return `"${path.slice(0, at)}" is a file, and the folder of "${path}"`;
    }
    return null;
}

export const folderOf = (path) => path.slice(0, path.lastIndexOf("/") + 1);

/** A text without the comments of YAML or Lua: what they name is not read. */
function withoutComments(path, text) {
    return path.endsWith(".lua") ? text.replace(/--\[\[[\s\S]*?\]\]|--[^\n]*/g, "") : text.replace(/(^|\s)#[^\n]*/g, "$1");
}

/** Names of mods that a scene turns on: "mods: {NAME: ...}", or lines below "mods:". */
export function modsNamed(text) {
    const plain = withoutComments("x.yaml", text).replace(/^[ \t]*\n/gm, "");
    const flow = /^mods:[ \t]*\{(.*)\}/m.exec(plain)?.[1];
    if (flow !== undefined) return [...flow.replace(/\{[^}]*\}/g, "").matchAll(/([\w-]+)\s*:/g)].map((m) => m[1]);
    const block = /^mods:[ \t]*\n((?:[ \t]+[^\n]*\n?)+)/m.exec(plain)?.[1] ?? "";
    const indent = /^[ \t]+/.exec(block)?.[0];
    return indent ? block.split("\n").map((line) => new RegExp(`^${indent}([\\w-]+):`).exec(line)?.[1]).filter(Boolean) : [];
}

/** A scene's text with the mod turned on in it. */
export function turnOnMod(text, mod) {
    const flow = /^mods:[ \t]*\{(.*)\}/m.exec(text), block = /^mods:[ \t]*(?:#[^\n]*)?\n(?:[ \t]*(?:#[^\n]*)?\n)*([ \t]+)(?=[\w-])/m.exec(text);
    if (flow) return text.replace(flow[0], () => `mods: {${flow[1].trim() ? `${flow[1]}, ` : ""}${mod}: {}}`);
    if (block) return text.replace(block[0], () => `${block[0]}${mod}: {}\n${block[1]}`);
    return `${text.trimEnd()}\nmods: {${mod}: {}}\n`;
}

/** Paths at which the engine looks for what a file names, the first that exists being read. */
function candidates(path, name) {
    const here = folderOf(path);
    return [here + name, `${here}../behaviours/${name}`, `behaviours/${name}`].map(plainPath);
}

/** The name by which a file in the folder `here` reads the one at `path`. */
function nameFrom(here, path) {
    const from = here.split("/").slice(0, -1), to = path.split("/");
    let same = 0;
    while (same < from.length && same < to.length - 1 && from[same] === to[same]) same++;
    return [...from.slice(same).map(() => ".."), ...to.slice(same)].join("/");
}

/** Texts {path: text} with the file at `path` moved to `to`, also in the texts that name it. */
export function renameFile(texts, path, to) {
    const { [path]: own, ...others } = renamedIn(texts, path, to);
    return own === undefined ? others : { ...others, [to]: own };
}

/** Texts {path: text} in which the file at `path` has the name that it has at `to`. */
export function renamedIn(texts, path, to) {
    const has = (other) => Object.hasOwn(texts, other), base = to.slice(folderOf(to).length), stays = folderOf(path) === folderOf(to);
    const renamed = ([own, text]) => {
        const here = folderOf(own);
        if (own.endsWith(".lua")) {
            return text.replace(REQUIRE, (found, module) => ([`${here}${module}.lua`, `scripts/${module}.lua`].map(plainPath).find(has) === path ? found.replace(module, () => base.replace(/\.lua$/, "")) : found));
        }
        return text.replace(NAME, (name) => (candidates(own, name).find(has) !== path ? name : stays ? folderOf(name) + base : nameFrom(here, to)));
    };
    return Object.fromEntries(Object.entries(texts).map((entry) => [entry[0], renamed(entry)]));
}

/**
 * Returns the paths of all files that the scene at `scene` reads, itself first. `read(path)` returns a text, or undefined where there is
 * no such file; `list(folder)` the paths of files below a folder.
 */
export function filesOf(scene, read, list) {
    const found = [scene];
    const add = (path) => {
        if (!found.includes(path) && read(path) !== undefined) found.push(path);
    };
    const addFirst = (paths) => {
        const path = paths.find((p) => read(p) !== undefined);
        if (path) add(path);
    };
    for (let n = 0; n < found.length; n++) {
        const path = found[n], text = read(path);
        if (text === undefined) continue;
        const plain = withoutComments(path, text);
        if (path.endsWith(".lua")) {
            for (const [, machine] of plain.matchAll(BECOME)) addFirst([`${folderOf(path)}${machine}.lua`, `behaviours/${machine}.lua`]);
            for (const [, module] of plain.matchAll(REQUIRE)) addFirst([`${folderOf(path)}${module}.lua`, `scripts/${module}.lua`].map(plainPath));
        } else {
            for (const [name] of plain.matchAll(NAME)) addFirst(candidates(path, name));
            for (const mod of path.endsWith(".yaml") ? modsNamed(text) : []) list(`${folderOf(path)}mods/${mod}/`).forEach(add);
        }
    }
    return found;
}
