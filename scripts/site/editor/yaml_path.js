// Where in a scene a position is: the keys that lead there. A reader of unfinished YAML, for completion and hints; the engine reads scenes.

const MOST_LINES = 200; // of brackets that are open
const KEY = /^(?:"([^"]*)"|'([^']*)'|([^\s:#{}[\],][^:#{}[\],]*?))\s*:(?=\s|$)/;

/** The text without its comment, and strings as blanks. */
function withoutStrings(line) {
    return line.replace(/"(?:[^"\\]|\\.)*"|'[^']*'/g, (s) => (/^["']\s*$/.test(s) ? s : s[0] + "_".repeat(Math.max(0, s.length - 2)) + s[0])).replace(/(^|\s)#.*$/, "$1");
}

/** The keys that the brackets still open at the end of `text` belong to, outermost first: a name, or "-" for an item of a list. */
function openBrackets(text) {
    const stack = [];
    let key = null, word = "";
    for (const c of withoutStrings(text)) {
        if (c === "{" || c === "[") {
            stack.push({ bracket: c, key });
            [key, word] = [null, ""];
        } else if (c === "}" || c === "]") {
            stack.pop();
            [key, word] = [null, ""];
        } else if (c === ",") [key, word] = [null, ""];
        else if (c === ":" && word.trim()) [key, word] = [word.trim().replace(/^["'&*!-]+|["']$/g, ""), ""];
        else word += c;
    }
    return { stack, key, word: word.trimStart() };
}

/** Keys and list items around the line `first`, outermost first, by the columns at which they begin. */
function blockPath(lines, first) {
    const path = [], begin = (line) => /^(\s*)((?:- +)*)/.exec(line).slice(1).map((s) => s.length);
    const [indent, dashes] = begin(lines[first]);
    let column = indent, inItem = dashes > 0; // the column of what is looked from, and whether that is a dash
    if (inItem) path.unshift("-");
    for (let n = first - 1; n >= 0 && (column > 0 || inItem); n--) {
        const plain = withoutStrings(lines[n]);
        if (!plain.trim()) continue;
        const [dash, more] = begin(plain), at = dash + more, found = KEY.exec(plain.slice(at));
        if (!inItem && more > 0 && at === column) path.unshift("-");
        else if (found && (at < column || (inItem && at === column && more === 0))) {
            path.unshift(found[1] ?? found[2] ?? found[3]);
            if (more > 0) path.unshift("-");
        } else continue;
        [column, inItem] = [dash, more > 0];
    }
    return path;
}

/**
 * Finds out where the end of `text` is: {path, key, word}. `path`: names of keys and "-" for list items; `key`: the key whose value
 * is being written, else null; `word`: what is written of a key or value.
 */
export function pathAt(text) {
    const lines = text.split("\n");
    let first = lines.length - 1; // where the brackets begin that are open
    const depth = (from) => openBrackets(lines.slice(from).join("\n")).stack.length;
    while (first > 0 && /^\s/.test(lines[first]) && depth(first) < depth(first - 1) && lines.length - first < MOST_LINES) first--;
    const path = blockPath(lines, first), { stack, key, word } = openBrackets(lines.slice(first).join("\n").replace(/^\s*(?:- +)*/, ""));
    for (const { bracket, key: of } of stack) {
        if (of !== null) path.push(of);
        if (bracket === "[") path.push("-");
    }
    return { path, key, word };
}

/** The node of the schema's tree (make/words.mjs) at a path, else null. */
export function nodeAt(tree, path) {
    let node = tree;
    for (const name of path) {
        if (!node) return null;
        if (name === "-") node = node.items ?? node;
        else {
            if (!node.keys && !node.any && node.items) node = node.items;
            node = node.keys?.[name] ?? node.any ?? null;
        }
    }
    return node && !node.keys && !node.any && node.items ? { ...node.items, text: node.text } : node;
}
