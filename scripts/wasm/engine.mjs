/**
 * The engine in WebAssembly: scenes that are opened from texts, stepped or shown by the live page, reloaded while they run.
 * For Node.js, workers and pages alike; README.md has an example. Units are SI. Texts and arrays that calls return are
 * copies, except columns.
 *
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
 *
 * @typedef {Object} Message For the live page: JSON in `text`, or `bytes` of a channel (core/live/README.md).
 * @property {number} channel -1: none.
 * @property {string} [text]
 * @property {ArrayBuffer} [bytes]
 */
import createModule from "./jostle.mjs";
import { chooseThreads, loadThreads } from "./threads.mjs";

const KINDS = ["group", "machine", "state", "signal", "place", "body"]; // of names, as module_read.c counts them
const ARRAYS = [Uint8Array, Uint16Array, Uint32Array, Int32Array, BigUint64Array, Float32Array, Float64Array]; // JoType

// Fields of the events of jostle_read.h: u a whole number, f a float, each of 4 bytes.
const EVENTS = [
    ["transitions", "u:agent u:machine u:from u:to"],
    ["touches", "u:agent u:kind u:other u:began f:force"],
    ["hits", "u:agent u:body f:impulse f:x f:y f:z"],
    ["breaks", "u:body u:bonds u:pieces"],
    ["entered", "u:agent u:group f:x f:y"],
    ["left", "u:agent u:group f:x f:y"],
    ["said", "u:agent u:signal f:x f:y"],
    ["actions", "u:agent u:kind u:other f:x f:y"],
].map(([name, fields]) => ({ name, fields: fields.split(" ").map((field) => field.split(":")) }));

const BODY = ["x", "y", "z", "qx", "qy", "qz", "qw", "vx", "vy", "vz"]; // JoBodyState

/** Turns a diagnostic of the engine into a Fault. */
function makeFault({ file = "", line = 0, column = 0, end = 0, severity = "error", code = "", message = "", hint = "" }) {
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

const MOST_STEPS = 2 ** 32 - 1; // of one call

/** Whole number from 0 to `most`; throws an error that names what it is for. */
function wholeNumber(what, value, most = Number.MAX_SAFE_INTEGER) {
    if (!Number.isInteger(value) || value < 0 || value > most) throw new RangeError(`${what} must be a whole number from 0 to ${most}, not ${value}`);
    return value;
}

/** Files as [path, content] pairs; throws an error that names what is wrong with one. */
function listFiles(files) {
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
const cleanParts = (path) => path.split("/").filter((part) => part && part !== ".");

/** A list of texts; throws an error that names what it is for. */
function listTexts(what, list) {
    if (!Array.isArray(list) || !list.every((item) => typeof item === "string")) throw new TypeError(`${what} must be a list of texts`);
    return list;
}

/** The engine has stopped by a fault of its own, or for want of memory in the middle of one; only a new Engine helps. */
export class BrokenEngineError extends Error {
    /** @param {unknown} cause What the module threw. */
    constructor(cause) {
        super(`the engine has stopped by a fault of its own (${cause?.message ?? cause}), and its scenes with it: make a new Engine`, { cause });
        this.name = "BrokenEngineError";
    }
}

const inNode = Boolean(globalThis.process?.versions?.node);

/** The address of a file that lies beside this one; `locate`: its address, where that is another. */
const addressOf = (name, locate) => (locate ? locate(name) : new URL(name, import.meta.url).href);

/** Reads a file of an address: its bytes, or the server's answer that has them. */
async function readFrom(address) {
    if (inNode && !/^https?:/.test(address)) {
        const files = "node:fs/promises"; // a name that bundlers for browsers do not follow
        const { readFile } = await import(files);
        return readFile(address.startsWith("file:") ? new URL(address) : address);
    }
    const answer = await fetch(address);
    if (!answer.ok) throw new Error(`${address} cannot be loaded: ${answer.status} ${answer.statusText}`);
    return answer;
}

const readTexts = async (address) => {
    const read = await readFrom(address);
    return read instanceof Uint8Array ? JSON.parse(new TextDecoder().decode(read)) : read.json();
};

/** Compiles the module at an address, while it comes if the server says what it is. */
async function compileFrom(address) {
    const read = await readFrom(address);
    if (read instanceof Uint8Array) return WebAssembly.compile(read);
    const type = read.headers.get("Content-Type") ?? "";
    return /^application\/wasm/.test(type) ? WebAssembly.compileStreaming(read) : WebAssembly.compile(await read.arrayBuffer());
}

/** Passes on what the module warns of: not that it waits in the main thread, which Node.js allows. */
const warn = (text) => (inNode && text.startsWith("Blocking on the main thread") ? undefined : console.warn(text));

/** Instantiates a module, made by Emscripten's function `create`: given as bytes, compiled, or by its address. */
async function instantiate(create, wasm) {
    const compiled = wasm instanceof WebAssembly.Module ? wasm : await (typeof wasm === "string" ? compileFrom(wasm) : WebAssembly.compile(wasm));
    const module = await new Promise((resolve, reject) => {
        create({ print: console.log, printErr: warn, instantiateWasm(imports, take) {
            WebAssembly.instantiate(compiled, imports).then((instance) => take(instance, compiled)).catch(reject);
            return {}; // what it needs comes by take()
        } }).then(resolve, reject);
    });
    return { module, compiled };
}

/** One engine: a WebAssembly module with its memory. Scenes of an engine take turns. */
export class Engine {
    /**
     * Loads the engine.
     * @param {Object} [options]
     * @param {BufferSource|WebAssembly.Module} [options.wasmBinary] The module, if it is loaded already, or also compiled: that of
     *     another engine (`compiled`), say, in another worker.
     * @param {(name: string) => string} [options.locate] Returns the address of a file that lies beside this one: "jostle.wasm",
     *     "shipped.json", and of the module with threads "jostle-threads.mjs", "jostle-threads.wasm" and "thread.mjs".
     * @param {Files} [options.shipped] Library, behaviours and scenes that come with the engine; default: those of shipped.json.
     * @param {number} [options.threads] Threads of a step, this one included; results are the same for any number. Default: in
     *     a worker of a page that is cross-origin isolated one for each processor, 8 at most; elsewhere 1. In a browser there
     *     are more than one only in such a worker. With `wasmBinary`, which has no threads, there is one.
     * @returns {Promise<Engine>}
     */
    static async create({ wasmBinary, locate, shipped, threads } = {}) {
        const count = await chooseThreads(wasmBinary ? 1 : threads), at = (name) => addressOf(name, locate);
        const loadOne = () => instantiate(createModule, wasmBinary ?? at("jostle.wasm"));
        const loadSeveral = () => loadThreads(count, at, instantiate).catch((error) => {
            console.warn(`The engine has one thread, as several cannot be started: ${error.message}`);
            return loadOne();
        });
        const [loaded, texts] = await Promise.all([
            count.threads === 1 ? loadOne() : loadSeveral(),
            shipped ?? readTexts(at("shipped.json")),
        ]);
        return new Engine(loaded, texts);
    }

    #fault = null; // what the module threw when it broke
    #closed = false;
    #workers; // of threads
    #views = null; // typed arrays on the module's memory

    /** @private */
    constructor({ module, compiled = null, workers = [] }, shipped) {
        this.#workers = workers;
        this.module = this.#guard(module);
        this.compiled = compiled; // for other engines; null: that with threads, which is for one
        this.encoder = new TextEncoder();
        this.decoder = new TextDecoder();
        this.folders = 0;
        this.shipped = new Map();
        this.ship(shipped);
    }

    /**
     * Adds files to those that come with the engine: scenes that are opened from now on find them.
     * @param {Files} files As of `create`'s `shipped`.
     */
    ship(files) {
        const texts = Object.entries(files).map(([path, content]) => [path, this.#bytes(content)]);
        this.#fill("/jostle", texts);
        for (const [path, bytes] of texts) this.shipped.set(path, bytes);
    }

    /**
     * The module, whose functions throw a BrokenEngineError once one of them has thrown anything: errors of scenes are answers,
     * so what is thrown is a trap, after which the memory is not to be trusted.
     */
    #guard(module) {
        const guarded = Object.create(module);
        for (const [name, call] of Object.entries(module)) {
            if (!name.startsWith("_") || typeof call !== "function") continue;
            guarded[name] = (...given) => {
                if (this.broken) throw new BrokenEngineError(this.#fault);
                if (this.#closed) throw new Error("the engine is closed");
                try {
                    return call(...given);
                } catch (error) {
                    this.#fault = error;
                    this.close();
                    throw new BrokenEngineError(error);
                }
            };
        }
        return guarded;
    }

    /** Whether the engine can do nothing more: it is closed, or broken. @private */
    get hasEnded() {
        return this.#closed || this.broken;
    }

    /** Whether the engine has stopped by a fault of its own: then each call throws a BrokenEngineError. */
    get broken() {
        return this.#fault !== null;
    }

    /** Threads of a step. */
    get threads() {
        return this.module._jostle_threads();
    }

    /** Ends the engine with its threads and scenes. One that has one thread need not be closed. */
    close() {
        this.#closed = true;
        for (const worker of this.#workers) worker.terminate();
    }

    /** Typed arrays on the module's memory, made anew once it has grown, which another thread may cause. @private */
    get memory() {
        const buffer = this.module.wasmMemory?.buffer ?? this.module.HEAPU8.buffer;
        if (this.#views?.bytes.buffer !== buffer)
            this.#views = { bytes: new Uint8Array(buffer), words: new Uint32Array(buffer), integers: new Int32Array(buffer), floats: new Float32Array(buffer), doubles: new Float64Array(buffer) };
        return this.#views;
    }

    /** Version of the engine, as "0.1.0". */
    get version() {
        return this.module.UTF8ToString(this.module._jostle_version());
    }

    /**
     * Opens a scene. Files that `files` lacks are the shipped ones: a scene of the gallery opens without any.
     * @param {Object} options
     * @param {Files} [options.files]
     * @param {string} options.scene Path of the scene's file, as "scenes/office.yaml".
     * @param {string[]} [options.mods] Folders of mods.
     * @param {Object<string, string|number|boolean>|string[]} [options.set] Settings, as of `jostle run --set`.
     * @param {number} [options.seed] Replaces the scene's seed.
     * @param {number} [options.dt] Time step, s; replaces the scene's.
     * @param {boolean} [options.page] Messages for the live page are made; default: false.
     * @param {(text: string) => void} [options.say] Receives what the scene says: warnings, reloads; default: console.warn.
     * @returns {Scene}
     * @throws {JostleError} If the scene does not load.
     */
    open({ files = {}, scene, mods = [], set = [], seed, dt, page = false, say = (text) => console.warn(text) } = {}) {
        if (typeof scene !== "string") throw new TypeError("open({scene}): the path of a scene is missing");
        if (seed !== undefined) wholeNumber("seed", seed);
        if (dt !== undefined && !Number.isFinite(dt)) throw new TypeError(`dt must be a number of seconds, not ${dt}`);
        listTexts("mods", mods);
        const sets = typeof set === "object" && set !== null && !Array.isArray(set) ? Object.entries(set).map(([path, value]) => `${path}=${value}`) : listTexts("set", set);
        const folder = this.#folder(files), plain = scene.startsWith("/") ? scene : cleanParts(scene).join("/"); // as reload names it
        const handle = this.texts([plain, sets, mods], (path, first, second) =>
            this.module._jostle_open(path, first, sets.length, second, mods.length, seed ?? NaN, dt ?? NaN, page));
        if (handle) return new Scene(this, handle, folder, say);
        const error = this.error();
        this.remove(folder);
        throw error;
    }

    /**
     * Checks a file without running it: a scene with its behaviours, a behaviour, or a mod by its folder.
     * @param {Files} files As of `open`.
     * @param {string} path
     * @returns {Fault[]} Errors, warnings and notes; none if nothing is wrong.
     */
    check(files, path) {
        const folder = this.#folder(files);
        try {
            const good = this.texts([path], (at) => this.module._jostle_check(at));
            if (!good) throw this.error();
            return JSON.parse(this.answer() || "[]").map(makeFault);
        } finally {
            this.remove(folder);
        }
    }

    /**
     * The language of behaviours: a row for each word, each key of a machine's tables (`of` says which), each parameter and
     * each field of `me`.
     * @returns {{word: string, kind: string, signature: string, unit: string, meaning: string, example: string, of?: string,
     *     least?: number, greatest?: number, default?: number}[]}
     */
    vocabulary() {
        this.module._jostle_vocabulary();
        return JSON.parse(this.answer());
    }

    /**
     * A page of `jostle reference`: "behaviours", "scenes" or "inputs" (Markdown), "scene-schema" or "mod-schema" (JSON Schema).
     * @param {string} what
     * @returns {string}
     */
    reference(what) {
        const known = this.texts([what], (name) => this.module._jostle_reference(name));
        if (!known) throw new JostleError([makeFault({ message: `there is no reference page '${what}'` })]);
        return this.answer();
    }

    // ---- used by Scene ----

    /** The last answer of the module, a text. @private */
    answer() {
        return this.module.UTF8ToString(this.module._jostle_answer());
    }

    /** The last answer as an error. @private */
    error() {
        return new JostleError((JSON.parse(this.answer() || "{}").errors ?? []).map(makeFault));
    }

    /**
     * Calls a function with addresses of texts, which are freed afterwards. A list of texts becomes one block, each with a
     * zero byte at its end.
     * @private
     */
    texts(list, call) {
        const addresses = list.map((item) => this.put(this.encoder.encode(Array.isArray(item) ? item.map((text) => `${text}\0`).join("") : item)));
        try {
            return call(...addresses);
        } finally {
            for (const address of addresses) this.module._free(address);
        }
    }

    /** Copies bytes into the module's memory, with a zero byte behind them; returns their address. @private */
    put(bytes) {
        const address = this.module._malloc(bytes.length + 1) >>> 0; // addresses come as signed numbers
        if (!address) throw new JostleError([makeFault({ message: "out of memory" })]);
        this.memory.bytes.set(bytes, address);
        this.memory.bytes[address + bytes.length] = 0;
        return address;
    }

    /** Makes a folder of the module's file system the current one. @private */
    enter(folder) {
        this.module.FS.chdir(folder);
    }

    /** Writes a file below a folder. @private */
    write(folder, path, content) {
        const { FS } = this.module, parts = cleanParts(path);
        let at = folder;
        try {
            for (const part of parts.slice(0, -1)) {
                at += `/${part}`;
                if (!FS.analyzePath(at).exists) FS.mkdir(at);
            }
            FS.writeFile(`${at}/${parts.at(-1)}`, this.#bytes(content), { canOwn: true });
        } catch (error) {
            if (error.errno === undefined) throw error;
            throw new TypeError(`'${path}' cannot be a file: a folder has this name, or a file that of its folder`, { cause: error });
        }
    }

    /** Removes a folder with all that it holds. @private */
    remove(folder) {
        const { FS } = this.module;
        const remove = (path) => {
            if (!FS.isDir(FS.stat(path).mode)) return FS.unlink(path);
            for (const name of FS.readdir(path)) if (name !== "." && name !== "..") remove(`${path}/${name}`);
            return FS.rmdir(path);
        };
        this.enter("/");
        remove(folder);
    }

    #bytes(content) {
        return typeof content === "string" ? this.encoder.encode(content) : content;
    }

    /** Makes a folder that holds the shipped files and those given, and makes it the current one. */
    #folder(files) {
        const given = listFiles(files);
        const folder = `/run${++this.folders}`;
        this.module.FS.mkdir(folder);
        try {
            this.#fill(folder, this.shipped);
            this.#fill(folder, given);
        } catch (error) {
            this.remove(folder);
            throw error;
        }
        this.enter(folder);
        return folder;
    }

    #fill(folder, files) {
        if (!this.module.FS.analyzePath(folder).exists) this.module.FS.mkdir(folder);
        for (const [path, content] of files) this.write(folder, path, content);
    }
}

/** A scene that runs. Made by Engine.open; `close` frees it. */
export class Scene {
    static #shared = null; // the engine of scenes that `load` opens

    #engine;
    #module;
    #handle;
    #folder;
    #say;

    /**
     * Opens a scene; the first call loads the engine, which all scenes opened so share until it breaks.
     * @param {Object} options As of Engine.open; in the first call also those of Engine.create.
     * @returns {Promise<Scene>}
     * @throws {JostleError} If the scene does not load.
     */
    static async load({ wasmBinary, locate, shipped, threads, ...options }) {
        if (Scene.#shared && await Scene.#shared.then(({ broken }) => broken, () => false)) Scene.#shared = null;
        Scene.#shared ??= Engine.create({ wasmBinary, locate, shipped, threads }).catch((error) => {
            Scene.#shared = null; // the next call tries again
            throw error;
        });
        return (await Scene.#shared).open(options);
    }

    /** @private */
    constructor(engine, handle, folder, say) {
        this.#engine = engine;
        this.#module = engine.module;
        this.#handle = handle;
        this.#folder = folder;
        this.#say = say;
        this.#tell();
    }

    /** Makes a call of the module for this scene, then passes on what the scene has said. */
    #call(name, ...values) {
        if (!this.#handle) throw new Error("the scene is closed");
        this.#engine.enter(this.#folder);
        return this.#module[`_jostle_${name}`](this.#handle, ...values);
    }

    #tell() {
        if (this.#call("take_said")) this.#say(this.#engine.answer().trimEnd());
    }

    /** Throws the module's last answer. */
    #fail() {
        const error = this.#engine.error();
        this.#tell();
        throw error;
    }

    /**
     * Makes steps at once, whatever the pace of the page.
     * @param {number} [count] Default: 1.
     * @throws {JostleError} If a step fails; the scene stays as it was then.
     */
    step(count = 1) {
        wholeNumber("count", count, MOST_STEPS);
        if (this.#call("step", count) >>> 0 < count) this.#fail();
        this.#tell();
    }

    /**
     * Does one turn of the live page's loop: carries out commands, makes a step if one is due at the page's pace, and makes
     * messages that are due.
     * @returns {number} Time until the next turn is due, s.
     */
    turn() {
        const wait = this.#call("turn");
        if (wait < 0) this.#fail();
        this.#tell();
        return wait;
    }

    /**
     * Gives a command of the live page, which the next turn carries out, as {do: "pause", on: true} (core/live/README.md).
     * @param {Object|string} command An object, or its JSON.
     */
    command(command) {
        this.#engine.texts([typeof command === "string" ? command : JSON.stringify(command)], (json) => this.#call("command", json));
    }

    /**
     * Takes the messages for the page: all texts that wait, and of each channel the newest. Call it only after the page has
     * handled those taken before, so that a slow page gets fewer frames and never falls behind.
     * @returns {Message[]}
     */
    takeMessages() {
        const messages = [];
        for (let at; (at = this.#call("next_message")); ) {
            const [address, length, channel] = [0, 4, 8].map((offset) => this.#engine.memory.integers[(at + offset) >>> 2]);
            const bytes = this.#engine.memory.bytes.slice(address >>> 0, (address >>> 0) + length);
            const isText = channel < 0 || channel >= 16; // JOX_VIEW_FIRST_TEXT
            messages.push(isText ? { channel, text: this.#engine.decoder.decode(bytes) } : { channel, bytes: bytes.buffer });
        }
        return messages;
    }

    /**
     * Replaces files of the running scene at once. People go on in the states that they are in; all files that belong
     * together are taken, or none: what ran before then goes on.
     * @param {Files} files
     * @returns {{live: boolean, errors: Fault[], taken: string[], unread: string[], news: Object[]}} `live`: all files were
     *     taken; `taken`: the paths of those whose texts run now; `unread`: of those that nothing reads, which are kept until
     *     something does; `errors`: also warnings and notes; `news`: of each behaviour {file, time,
     *     machine, before, after, notes}, where before and after are {state, people}[], or of the scene {file, done, later}.
     */
    reload(files) {
        const list = listFiles(files).map(([path, content]) => [cleanParts(path).join("/"), content]), engine = this.#engine;
        const texts = list.flatMap(([path, content]) => [path, content]).map((item) => (typeof item === "string" ? engine.encoder.encode(item) : item));
        const addresses = texts.map((bytes) => engine.put(bytes));
        const table = engine.put(new Uint8Array(12 * list.length)); // JoFile: path, text, length
        list.forEach((_, f) => engine.memory.words.set([addresses[2 * f], addresses[2 * f + 1], texts[2 * f + 1].length], (table >>> 2) + 3 * f));
        let answer;
        try {
            const live = this.#call("reload", table, list.length);
            answer = JSON.parse(engine.answer());
            if (answer.live === undefined) this.#fail();
            if (live) answer.taken = list.map(([path]) => path);
        } finally {
            for (const address of [...addresses, table]) this.#module._free(address);
        }
        const contents = new Map(list);
        for (const path of [...answer.taken, ...answer.unread]) engine.write(this.#folder, path, contents.get(path)); // restarts read them
        this.#tell();
        return { live: answer.live, errors: answer.errors.map(makeFault), taken: answer.taken, unread: answer.unread, news: answer.news?.news ?? [] };
    }

    /**
     * The text of a file, as the scene has it now.
     * @param {string} path
     * @returns {string}
     * @throws {RangeError} If the scene has no such file.
     */
    read(path) {
        if (!this.#handle) throw new Error("the scene is closed");
        const at = `${this.#folder}/${path}`, { FS } = this.#module;
        if (!FS.analyzePath(at).exists || FS.isDir(FS.stat(at).mode)) throw new RangeError(`the scene has no file '${path}'`);
        return FS.readFile(at, { encoding: "utf8" });
    }

    /**
     * Carries out a line of an input log, without its tick, before the next step: "push 7 300 0" (`reference("inputs")`).
     * @param {string} line
     * @throws {JostleError}
     */
    input(line) {
        if (!this.#engine.texts([line], (text) => this.#call("input", text))) this.#fail();
        this.#tell();
    }

    /** Hash of the whole state, 16 hexadecimal digits: that of every other build after the same steps. */
    get hash() {
        this.#call("hash");
        return this.#engine.answer();
    }

    /** Simulated time, s. */
    get time() {
        return this.#call("time");
    }

    /** Steps made. */
    get tick() {
        return this.#call("tick");
    }

    /** Time that the scene lasts, s, as its file says. */
    get duration() {
        return this.#call("duration");
    }

    /** Number of people. */
    get agents() {
        return this.#call("agents") >>> 0;
    }

    /**
     * A number of every agent, by the names of jo_world_column (core/include/jostle_read.h): "x", "y", m, "vx", "vy", m/s,
     * "id", "state", ... The array is the engine's own memory where that has one number behind the other: it holds until the
     * next call for any scene of the engine, and must not be written. Agents change their order from step to step; "id" tells.
     * @param {string} name
     * @returns {Float32Array|Float64Array|Uint32Array|Int32Array|Uint16Array|Uint8Array|BigUint64Array}
     */
    column(name) {
        const at = this.#engine.texts([name], (text) => this.#call("column", text)) >>> 2;
        const [data, stride, count, type] = this.#engine.memory.words.subarray(at, at + 4);
        if (!data && this.agents) throw new RangeError(`there is no column '${name}'`);
        const Numbers = ARRAYS[type], { buffer } = this.#engine.memory.bytes, size = Numbers.BYTES_PER_ELEMENT;
        if (!data || stride === size) return new Numbers(buffer, data, data ? count : 0);
        const one = (i) => new Numbers(buffer, data + i * stride, 1)[0];
        return Numbers.from({ length: count }, (_, i) => one(i)); // one number for all, or numbers among others
    }

    /**
     * Events of the last step, as of jo_world_events (core/include/jostle_read.h): `transitions`, `touches`, `hits`, `breaks`,
     * `entered`, `left`, `said` and `actions`, each a list of objects. Agents are given by id, the rest by number (`name`).
     */
    events() {
        const at = this.#call("events") >>> 2, { words, floats } = this.#engine.memory;
        return Object.fromEntries(EVENTS.map(({ name, fields }, kind) => {
            const data = words[at + kind] >>> 2, count = words[at + EVENTS.length + kind];
            const event = (i) => Object.fromEntries(fields.map(([type, field], f) => [field, (type === "f" ? floats : words)[data + i * fields.length + f]]));
            return [name, Array.from({ length: count }, (_, i) => event(i))];
        }));
    }

    /**
     * The bodies: slot, name, centre of mass x, y, z (m), unit quaternion qx, qy, qz, qw, velocity vx, vy, vz (m/s).
     * @returns {Object[]}
     */
    bodies() {
        const bodies = [], slots = this.#call("body_slots");
        for (let slot = 0; slot < slots; slot++) {
            const at = this.#call("body", slot) >>> 3;
            if (at) bodies.push({ slot, name: this.name("body", slot), ...Object.fromEntries(BODY.map((key, k) => [key, this.#engine.memory.doubles[at + k]])) });
        }
        return bodies;
    }

    /**
     * The name of a number in columns and events.
     * @param {"group"|"machine"|"state"|"signal"|"place"|"body"} kind
     * @param {number} number
     * @param {number} [machine] Of a state.
     * @returns {string} "" if there is none.
     */
    name(kind, number, machine = 0) {
        return this.#module.UTF8ToString(this.#call("name", KINDS.indexOf(kind), machine, number));
    }

    /** What there is to draw besides people: title, walls, places, regions, groups and states with their colours, bodies. */
    plan() {
        this.#call("plan");
        return JSON.parse(this.#engine.answer());
    }

    /** Figures of the run so far, as `jostle run --summary` writes them. */
    summary() {
        this.#call("summary");
        return JSON.parse(this.#engine.answer());
    }

    /** Ends the scene and frees it. */
    close() {
        if (!this.#handle) return;
        if (!this.#engine.hasEnded) this.#call("close");
        this.#handle = 0;
        this.#engine.remove(this.#folder);
    }
}
