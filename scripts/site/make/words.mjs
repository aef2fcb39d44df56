// Words of behaviours and keys of scenes for the editor: from the definitions and the schema that `jostle reference` makes.

/** The class whose members follow a name and a dot in a behaviour. */
const SPACES = { own: "jostle.Own", now: "jostle.Now", me: "jostle.Me", other: "jostle.Target", mine: null };
/** Classes whose fields are keys of tables. */
const KEYS = ["jostle.Machine", "jostle.State", "jostle.Transition", "jostle.Parameters", "jostle.Kick", "jostle.Throw", "jostle.Signal"];

/** Splits "TYPE TEXT" after the type, which may contain spaces within brackets and after ':' and ','. */
function splitType(line) {
    let depth = 0, at = 0;
    for (; at < line.length; at++) {
        if ("(<".includes(line[at])) depth++;
        else if (")>".includes(line[at])) depth--;
        else if (line[at] === " " && depth === 0 && !":,".includes(line[at - 1])) break;
    }
    return [line.slice(0, at).replaceAll("jostle.", ""), line.slice(at + 1).trim()];
}

function addField(rows, line) {
    const [, name, rest] = /^---@field (\w+)\?? (.*)$/.exec(line) ?? [];
    if (!name) return;
    const [type, text] = splitType(rest);
    rows.push({ name, type, text });
}

/** An explanation without the word itself at its beginning: "`near(target, metres)`: the target is nearer ...". */
const plainText = (text) => text.replace(/^`[^`]*`(?: or `[^`]*`)*: /, "");

function addFunction(found, line, doc) {
    const [, owner, name, parameters] = /^function (?:(\w+)([:.]))?(\w+)\((.*)\) end$/.exec(line)?.filter((_, n) => n !== 2) ?? [];
    if (!name) return;
    const text = plainText(doc.text), given = doc.parameters.map(({ name: of, type }) => `${of}: ${type}`).join(", ") || parameters;
    const row = { name, type: `${name}(${given})${doc.returns ? `: ${doc.returns}` : ""}`, text };
    if (owner) (found.methods[name] ??= row);
    else found.words.set(name, row);
}

/**
 * Reads definitions for lua-language-server. Returns {words, keys, spaces, methods}: rows {name, type, text} of words, of keys of
 * tables, of members by the name before the dot, and of filters after a colon.
 */
export function readDefinitions(text) {
    const classes = {}, found = { words: new Map(), methods: {} };
    let doc = { text: "", parameters: [] }, rows = null;
    for (const line of text.split("\n")) {
        const [, tag, rest] = /^---@(\w+) ?(.*)$/.exec(line) ?? [];
        if (tag === "class") rows = classes[rest.split(":")[0].trim()] = [];
        else if (tag === "field" && rows) addField(rows, line);
        else if (tag === "param") {
            const [, name, type] = /^([\w.]+\??) (\S+)/.exec(rest) ?? [null, rest, "any"];
            doc.parameters.push({ name, type: type.replaceAll("jostle.", "") });
        } else if (tag === "return") doc.returns = rest.replaceAll("jostle.", "").split(" ")[0];
        else if (tag === "type") doc.type = rest.replaceAll("jostle.", "");
        else if (line.startsWith("--- ")) doc.text += (doc.text && " ") + line.slice(4);
        else {
            addFunction(found, line, doc);
            const [, name] = /^(\w+) = /.exec(line) ?? [];
            if (name) found.words.set(name, { name, type: doc.type ?? "", text: plainText(doc.text) });
            if (!line.startsWith("---")) doc = { text: "", parameters: [] };
            if (line === "") rows = null;
        }
    }
    const keys = new Map(KEYS.flatMap((of) => classes[of] ?? []).map((row) => [row.name, row]));
    const spaces = Object.fromEntries(Object.entries(SPACES).filter(([, of]) => of && classes[of]).map(([name, of]) => [name, classes[of]]));
    return { words: [...found.words.values()], keys: [...keys.values()], spaces, methods: Object.values(found.methods) };
}

/** The schema's node without references and choices: what an editor can walk. */
function plainNode(schema, node, depth) {
    const all = [node];
    for (let n = 0; n < all.length && n < 64; n++) {
        const { $ref, allOf, anyOf, oneOf } = all[n];
        if ($ref) all.push(schema.definitions[$ref.split("/").pop()]);
        all.push(...(allOf ?? []), ...(anyOf ?? []), ...(oneOf ?? []));
    }
    const keys = {}, plain = {};
    for (const part of all) {
        for (const [name, child] of Object.entries(part.properties ?? {})) {
            keys[name] ??= depth > 0 ? { text: child.description, ...plainNode(schema, child, depth - 1) } : { text: child.description };
        }
        if (part.enum) plain.values = part.enum;
        for (const [key, child] of [["any", part.additionalProperties], ["items", part.items]]) {
            if (child && typeof child === "object" && depth > 0) plain[key] ??= plainNode(schema, child, depth - 1);
        }
    }
    if (Object.keys(keys).length) plain.keys = keys;
    for (const key of ["any", "items"]) if (plain[key] && Object.keys(plain[key]).length === 0) delete plain[key];
    return plain;
}

/** Reads a JSON Schema. Returns a tree {text, keys, any, items, values}: `any` is the node of free names, `items` of lists. */
export function readSchema(schema) {
    return plainNode(schema, schema, 6);
}
