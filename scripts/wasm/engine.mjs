/**
 * The engine in WebAssembly: scenes that are opened from texts, stepped or shown by the live page, reloaded while they run.
 * For Node.js, workers and pages alike; README.md has an example. Units are SI. Texts and arrays that calls return are
 * copies, except columns.
 *
 * @typedef {Object} Message For the live page: JSON in `text`, or `bytes` of a channel (core/live/README.md).
 * @property {number} channel -1: none.
 * @property {string} [text]
 * @property {ArrayBuffer} [bytes]
 */
import createModule from "./jostle.mjs";
import { BrokenEngineError, JostleError, cleanParts, listFiles, listTexts, makeFault, refuseUnknown, textOfCommand, wholeNumber } from "./arguments.mjs";
import { bytesOf, fillFolder, removeFolder, writeFile } from "./folders.mjs";
import { addressOf, instantiate, readTexts } from "./load.mjs";
import { readBody, readColumn, readEvents } from "./memory.mjs";
import { chooseThreads, loadThreads } from "./threads.mjs";

export { BrokenEngineError, JostleError } from "./arguments.mjs";

const KINDS = ["group", "machine", "state", "signal", "place", "body"]; // of names, as module_read.c counts them
const MOST_STEPS = 2 ** 32 - 1; // of one call

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
        const texts = Object.entries(files).map(([path, content]) => [path, bytesOf(content)]);
        fillFolder(this.module.FS, "/jostle", texts);
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
    open({ files = {}, scene, mods = [], set = [], seed, dt, page = false, say = (text) => console.warn(text), ...unknown } = {}) {
        refuseUnknown("open", unknown);
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
        removeFolder(this.module.FS, folder);
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
            removeFolder(this.module.FS, folder);
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
        const addresses = list.map((item) => this.put(bytesOf(Array.isArray(item) ? item.map((text) => `${text}\0`).join("") : item)));
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

    /** Makes a folder that holds the shipped files and those given, and makes it the current one. */
    #folder(files) {
        const given = listFiles(files);
        const folder = `/run${++this.folders}`;
        try {
            fillFolder(this.module.FS, folder, this.shipped);
            fillFolder(this.module.FS, folder, given);
        } catch (error) {
            removeFolder(this.module.FS, folder);
            throw error;
        }
        this.module.FS.chdir(folder);
        return folder;
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
        this.#module.FS.chdir(this.#folder);
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
        this.#engine.texts([textOfCommand(command)], (json) => this.#call("command", json));
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
        const texts = list.flat().map(bytesOf);
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
        for (const path of [...answer.taken, ...answer.unread]) writeFile(engine.module.FS, this.#folder, path, contents.get(path)); // restarts read them
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
        const numbers = readColumn(this.#engine.memory, at);
        if (!numbers && this.agents) throw new RangeError(`there is no column '${name}'`);
        return numbers ?? new Float32Array(0);
    }

    /**
     * Events of the last step, as of jo_world_events (core/include/jostle_read.h): `transitions`, `touches`, `hits`, `breaks`,
     * `entered`, `left`, `said` and `actions`, each a list of objects. Agents are given by id, the rest by number (`name`).
     */
    events() {
        return readEvents(this.#engine.memory, this.#call("events") >>> 2);
    }

    /**
     * The bodies: slot, name, centre of mass x, y, z (m), unit quaternion qx, qy, qz, qw, velocity vx, vy, vz (m/s).
     * @returns {Object[]}
     */
    bodies() {
        const bodies = [], slots = this.#call("body_slots");
        for (let slot = 0; slot < slots; slot++) {
            const at = this.#call("body", slot) >>> 3;
            if (at) bodies.push({ slot, name: this.name("body", slot), ...readBody(this.#engine.memory, at) });
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
        removeFolder(this.#engine.module.FS, this.#folder);
    }
}
