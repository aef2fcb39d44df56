// The engine's worker: runs one scene turn by turn, feeds the live page by a port, and checks texts. A second one of it, without a page,
// checks what is being written and tries lessons, so that a large crowd makes neither wait; it is called "second", and gets the module
// that the first one has compiled.
import { BrokenEngineError, Engine } from "../../wasm/engine.mjs";
import { plainPath } from "../project/references.js";
import { observe } from "./observe.js";
import { makeSchedule } from "./schedule.js";

const TOLD = new Set(["scene", "status", "reloaded", "inspect"]); // messages of which the workbench gets a copy
const NEEDS = "This browser cannot run the engine, which needs WebAssembly with SIMD and exceptions: Chrome or Edge 95, Firefox 100, Safari 16.4, or later";
const locate = (name) => new URL(`engine/${name}`, location.href).href;
let takeModule;
const module = self.name === "second" ? new Promise((resolve) => (takeModule = resolve)) : null; // null: loaded and compiled here
const SOON = 30000; // ms
let ready = makeEngine();
let library = null; // promise: the engine has all shipped files
let scene = null, port = null;
let opened = null; // {files, path} of the scene that runs, with the files that it has taken since
let mended = -Infinity; // when a fault of the engine was mended last, ms
let answered = true; // the page has taken the last batch
let begun = false; // it has drawn a picture: until then the crowd waits, as to prepare that takes all processors
const schedule = makeSchedule(turn);

/** Loads an engine; the first worker's has threads where the server's headers allow them, and its module is of no use to another one then. */
async function makeEngine() {
    try {
        return await Engine.create({ wasmBinary: (await module) ?? undefined, locate, shipped: {}, threads: module ? 1 : undefined });
    } catch (error) {
        throw error instanceof WebAssembly.CompileError ? new Error(`${NEEDS}. ${error.message}`) : error;
    }
}

/**
 * What to say of an error. An engine that has stopped by a fault of its own is replaced by a new one, which begins the scene that ran
 * anew; if a fault comes again soon, that waits for a restart.
 */
function textOf(error) {
    if (!(error instanceof BrokenEngineError)) return error.message;
    const lost = scene && opened, again = performance.now() - mended < SOON, why = `a fault of its own (${error.cause?.message ?? error.cause})`;
    mended = performance.now();
    scene = library = null;
    ready = makeEngine();
    ready.catch(() => {}); // told by the next call
    if (!lost || again) return `${why}. It is loaded again: press Restart`;
    calls.open(lost).catch(({ message }) => postMessage({ event: "failed", text: message }));
    return `${why}. A new one begins the scene anew, with the texts that ran: what the crowd had done is lost`;
}

/** Ends the scene by an error from which it cannot go on. */
function stop(error) {
    const text = textOf(error);
    close();
    postMessage({ event: "failed", text });
}

function turn() {
    if (!scene || (!begun && (!port || !answered))) return;
    let wait;
    try {
        wait = scene.turn();
        deliver();
    } catch (error) {
        stop(error);
        return;
    }
    schedule(wait);
}

function tellWorkbench(text) {
    const type = /^\{\s*"type":\s*"(\w+)"/.exec(text)?.[1];
    if (TOLD.has(type)) postMessage({ event: type, message: JSON.parse(text) });
}

/** Sends the page what waits, if it has taken what was sent before. */
function deliver() {
    if (!scene || !port || !answered) return;
    const messages = scene.takeMessages().map(({ text, bytes }) => text ?? bytes);
    for (const message of messages) if (typeof message === "string") tellWorkbench(message);
    if (messages.length === 0) return;
    answered = false;
    port.postMessage({ messages }, messages.filter((message) => typeof message !== "string"));
}

function close() {
    scene?.close();
    scene = null;
}

/** Gives the engine all shipped files, once: texts may name any of them. Returns it. */
async function withLibrary() {
    library ??= Promise.all([ready, fetch(locate("shipped.json")).then((answer) => {
        if (!answer.ok) throw new Error("The playground lacks engine/shipped.json.");
        return answer.json();
    })]).then(([engine, files]) => (engine.ship(files), engine)).catch((error) => {
        library = null; // the next call tries again
        throw error;
    });
    return library;
}

/** Faults with paths as the project has them: "behaviours/a.lua" for "scenes/../behaviours/a.lua"; `path` where a fault names no file. */
const named = (faults, path) => faults.map((fault) => ({ ...fault, file: plainPath(fault.file) || path }));

/** Faults of an error that the engine threw for what is in files; another error is thrown on. */
function faultsOf(error, path) {
    if (!error.errors) throw error;
    return named(error.errors, path);
}

const calls = {
    /** Takes the port of the page that is shown from now on. */
    connect({ port: given }) {
        port = given;
        answered = true;
        port.onmessage = ({ data }) => {
            try {
                if (data.command) scene?.command(data.command);
                else answered = true;
                deliver();
            } catch (error) {
                stop(error);
                return;
            }
            if (data.command || !begun) schedule(0);
            begun ||= Boolean(data.drawn);
        };
        if (scene) greet();
        return null;
    },

    /**
     * Opens a scene in place of the one that runs; if it has errors, that one goes on. Returns {errors, threads}: threads of a step.
     * `installed`: the shipped files that it needs besides `files`, where they are known; without, all are loaded first.
     */
    async open({ files, path, installed }) {
        const engine = await (installed && !library ? ready : withLibrary());
        if (installed) engine.ship(installed);
        let next;
        try {
            next = engine.open({ files, scene: path, page: true, say: (text) => postMessage({ event: "said", text }) });
        } catch (error) {
            return { errors: faultsOf(error, path) };
        }
        close();
        scene = next;
        opened = { files, path };
        greet();
        return { errors: [], threads: engine.threads };
    },

    /** Loads changed files into the scene that runs. Returns {news, errors, taken, unread}: paths; with errors nothing has changed. */
    async reload({ files }) {
        await withLibrary();
        const { live, errors, news, taken, unread } = scene.reload(files);
        opened = { ...opened, files: { ...opened.files, ...Object.fromEntries([...taken, ...unread].map((path) => [path, files[path]])) } };
        schedule(0);
        return { errors: live ? [] : named(errors.filter((fault) => fault.severity === "error"), Object.keys(files)[0]), news, taken, unread };
    },

    async check({ files, path }) {
        return named((await withLibrary()).check(files, path), path);
    },

    /** Runs a scene without a page; returns what observe() says of it, or {errors}. */
    async observe({ files, path, seconds }) {
        const engine = await withLibrary();
        let tried;
        try {
            tried = engine.open({ files, scene: path, say() {} });
        } catch (error) {
            return { errors: faultsOf(error, path) };
        }
        try {
            return { errors: [], ...observe(tried, seconds) };
        } finally {
            tried.close();
        }
    },

    /** Loads all shipped files; returns the module, for another worker. */
    async module() {
        return (await withLibrary()).compiled;
    },

    /** Takes the module, in the worker that waits for it. */
    begin({ module: given }) {
        takeModule(given);
        return null;
    },
};

/** Tells the page that a scene runs, which has to be sent to it from the beginning. */
function greet() {
    port?.postMessage({ open: true });
    answered = true;
    schedule(0);
}

addEventListener("message", async ({ data: { id, what, ...given } }) => {
    try {
        postMessage({ id, result: await calls[what](given) });
    } catch (error) {
        postMessage({ id, error: textOf(error) });
    }
});
