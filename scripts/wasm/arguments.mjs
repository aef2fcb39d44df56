// What callers give the engine, checked, and the errors that it throws.
/**
 * @typedef {Object} Fault What is wrong with a file.
 * @property {string} file
 * @property {number} line From 1; 0: unknown.
 * @property {number} column From 1, in characters (code points); 0: unknown.
 * @property {number} end Column behind the last character.
 * @property {"error"|"warning"|"note"} severity
 * @property {string} code A name of the kind, as "unknown-key".
 * @property {string} text One sentence.
 * @property {string} wayOut What to do; "" if that is not known.
 *
 * @typedef {Object<string, string|Uint8Array>} Files Texts, or bytes, by path: relative, with "/".
 */

/** Turns a diagnostic of the engine into a Fault. */
export function makeFault({ file = "", line = 0, column = 0, end = 0, severity = "error", code = "", message = "", hint = "" }) {
    return { file, line, column, end, severity, code, text: message, wayOut: hint ?? "" };
}

/** An error of the engine; `errors` lists what is wrong, by file, line and column. */
export class JostleError extends Error {
    /** @param {Fault[]} errors */
    constructor(errors) {
        const first = errors[0] ?? makeFault({ message: "the engine has failed" });
        const place = first.file ? `${[first.file, first.line, first.column].filter(Boolean).join(":")}: ` : "";
        super(`${place}${first.text}${first.wayOut ? `. ${first.wayOut}` : ""}`);
        this.name = "JostleError";
        this.errors = errors;
    }
}

/** Whole number from 0 to `most`; throws an error that names what it is for. */
export function wholeNumber(what, value, most = Number.MAX_SAFE_INTEGER) {
    if (!Number.isInteger(value) || value < 0 || value > most) throw new RangeError(`${what} must be a whole number from 0 to ${most}, not ${value}`);
    return value;
}

/** Files as [path, content] pairs; throws an error that names what is wrong with one. */
export function listFiles(files) {
    if (typeof files !== "object" || files === null || Array.isArray(files) || files instanceof Map)
        throw new TypeError(`files must be an object: texts, or bytes, by path${files instanceof Map ? "; Object.fromEntries makes one of a Map" : ""}`);
    const list = Object.entries(files), given = new Set(list.map(([path]) => cleanParts(path).join("/")));
    for (const [path, content] of list) {
        const parts = cleanParts(path);
        if (!parts.length || parts.includes("..")) throw new TypeError(`'${path}' is no path of a file: use relative ones, without ".."`);
        if (typeof content !== "string" && !(content instanceof Uint8Array)) throw new TypeError(`'${path}' must be a text or a Uint8Array`);
        const folder = parts.slice(1).map((_, n) => parts.slice(0, n + 1).join("/")).find((at) => given.has(at));
        if (folder) throw new TypeError(`'${folder}' is a file, and the folder of '${path}'`);
    }
    return list;
}

/** The parts of a path, without "." and empty ones. */
export const cleanParts = (path) => path.split("/").filter((part) => part && part !== ".");

/** A list of texts; throws an error that names what it is for. */
export function listTexts(what, list) {
    if (!Array.isArray(list) || !list.every((item) => typeof item === "string")) throw new TypeError(`${what} must be a list of texts`);
    return list;
}

/** Throws an error if a call was given options that it does not have. */
export function refuseUnknown(call, options) {
    const [first] = Object.keys(options);
    if (first !== undefined) throw new TypeError(`${call} has no option '${first}'`);
}

/** The JSON of a command of the live page, given as an object or as that; throws an error if it is none. */
export function textOfCommand(command) {
    let given = command;
    try {
        if (typeof command === "string") given = JSON.parse(command);
    } catch { /* told below */ }
    if (typeof given?.do !== "string") throw new TypeError('a command is an object, or its JSON, with the command\'s name as "do"');
    return JSON.stringify(given);
}

/** The engine has stopped by a fault of its own, or for want of memory in the middle of one; only a new Engine helps. */
export class BrokenEngineError extends Error {
    /** @param {unknown} cause What the module threw. */
    constructor(cause) {
        super(`the engine has stopped by a fault of its own (${cause?.message ?? cause}), and its scenes with it: make a new Engine`, { cause });
        this.name = "BrokenEngineError";
    }
}
