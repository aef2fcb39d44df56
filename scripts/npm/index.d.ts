/** Dense crowds that push, scripted in Lua: the engine in WebAssembly. Units are SI. */

/** Texts, or bytes, by path: relative, with "/". */
export type Files = Record<string, string | Uint8Array>;

/** What is wrong with a file. */
export interface Fault {
    file: string;
    /** From 1; 0: unknown. */
    line: number;
    /** From 1, in characters (code points); 0: unknown. */
    column: number;
    /** Column behind the last character. */
    end: number;
    severity: "error" | "warning" | "note";
    /** A name of the kind, as "unknown-key". */
    code: string;
    /** One sentence. */
    text: string;
    /** What to do; "" if that is not known. */
    wayOut: string;
}

/** An error of the engine; its message is that of the first fault. */
export class JostleError extends Error {
    readonly errors: Fault[];
}

/** The engine has stopped by a fault of its own; each later call of it and of its scenes throws this. Make a new Engine. */
export class BrokenEngineError extends Error {}

export interface EngineOptions {
    /** The module, if it is loaded already, or also compiled: `compiled` of another engine. */
    wasmBinary?: ArrayBuffer | ArrayBufferView | WebAssembly.Module;
    /** Returns the address of a file of the package, as "jostle.wasm" or "shipped.json"; default: beside engine.mjs. */
    locate?: (name: string) => string;
    /** Library, behaviours and scenes; default: those of shipped.json. */
    shipped?: Files;
    /**
     * Threads of a step, the caller's included; results are the same for any number. Default: 1; in a worker of a page that is
     * cross-origin isolated one for each processor, 8 at most. In a browser there are more than one only in such a worker.
     */
    threads?: number;
}

export interface SceneOptions {
    /** Files that this lacks are the shipped ones. */
    files?: Files;
    /** Path of the scene's file, as "scenes/office.yaml". */
    scene: string;
    /** Folders of mods. */
    mods?: string[];
    /** Settings, as of `jostle run --set`. */
    set?: Record<string, string | number | boolean> | string[];
    /** Replaces the scene's seed. */
    seed?: number;
    /** Time step, s; replaces the scene's. */
    dt?: number;
    /** Messages for the live page are made; default: false. */
    page?: boolean;
    /** Receives what the scene says: warnings, reloads; default: console.warn. */
    say?: (text: string) => void;
}

/** A row of the language of behaviours. */
export interface Word {
    word: string;
    kind: "condition" | "number" | "target" | "steering" | "distribution" | "word" | "key" | "parameter" | "field";
    signature: string;
    unit: string;
    meaning: string;
    example: string;
    /** Of a key or field: the table that has it. */
    of?: string;
    least?: number;
    greatest?: number;
    default?: number;
}

/** For the live page: JSON in `text`, or `bytes` of a channel. */
export interface Message {
    channel: number;
    text?: string;
    bytes?: ArrayBuffer;
}

/** What a reload changed: of a behaviour, or of the scene's file. */
export interface News {
    file: string;
    time: number;
    machine?: string;
    before?: { state: string; people: number }[];
    after?: { state: string; people: number }[];
    notes?: string;
    done?: string;
    later?: string;
}

export interface Reload {
    /** All files were taken. */
    live: boolean;
    /** Also warnings and notes. */
    errors: Fault[];
    /** Paths of the files whose texts run now. */
    taken: string[];
    /** Paths of the files that nothing reads; they are kept until something does. */
    unread: string[];
    news: News[];
}

/** Events of the last step. Agents are given by id, all else by number. */
export interface Events {
    transitions: { agent: number; machine: number; from: number; to: number }[];
    /** kind: 0 agent, 1 body, 2 wall. */
    touches: { agent: number; kind: number; other: number; began: number; force: number }[];
    hits: { agent: number; body: number; impulse: number; x: number; y: number; z: number }[];
    breaks: { body: number; bonds: number; pieces: number }[];
    entered: { agent: number; group: number; x: number; y: number }[];
    left: { agent: number; group: number; x: number; y: number }[];
    said: { agent: number; signal: number; x: number; y: number }[];
    /** kind: 0 kick, 1 grasp, 2 fall, 3 rise. */
    actions: { agent: number; kind: number; other: number; x: number; y: number }[];
}

export interface Body {
    slot: number;
    name: string;
    x: number; y: number; z: number;
    qx: number; qy: number; qz: number; qw: number;
    vx: number; vy: number; vz: number;
}

export type Column = Float32Array | Float64Array | Uint32Array | Int32Array | Uint16Array | Uint8Array | BigUint64Array;

/** A WebAssembly module with its memory; its scenes take turns in one thread. */
export class Engine {
    private constructor();
    static create(options?: EngineOptions): Promise<Engine>;
    readonly version: string;
    /** Threads of a step. */
    readonly threads: number;
    /** It has stopped by a fault of its own: each call throws a BrokenEngineError. */
    readonly broken: boolean;
    /** The compiled module, for other engines; null: the one with threads, which is for one engine. */
    readonly compiled: WebAssembly.Module | null;
    /** Adds files to those that come with the engine: scenes that are opened from now on find them. */
    ship(files: Files): void;
    /** Ends the engine with its threads and scenes. One with one thread need not be closed. */
    close(): void;
    /** Throws a JostleError if the scene does not load. */
    open(options: SceneOptions): Scene;
    /** Checks a scene, a behaviour, or a mod by its folder, without running it. */
    check(files: Files, path: string): Fault[];
    vocabulary(): Word[];
    reference(what: "behaviours" | "scenes" | "inputs" | "lua-ls" | "luacheck" | "scene-schema" | "mod-schema"): string;
}

/** A scene that runs. */
export class Scene {
    private constructor();
    /** Opens a scene; the first call loads the engine, which all scenes opened so share until it breaks. */
    static load(options: SceneOptions & EngineOptions): Promise<Scene>;
    /** Makes steps at once; default: 1. Throws a JostleError if one fails. */
    step(count?: number): void;
    /** Does one turn of the live page's loop at its pace; returns the time until the next is due, s. */
    turn(): number;
    /** Gives a command of the live page, which the next turn carries out, as {do: "pause", on: true}. */
    command(command: object | string): void;
    /** Takes the messages for the page; call it once the page has handled those taken before. */
    takeMessages(): Message[];
    /** Replaces files at once; if they are wrong, what ran before goes on. */
    reload(files: Files): Reload;
    /** The text of a file, as the scene has it now. */
    read(path: string): string;
    /** Carries out a line of an input log before the next step: "push 7 300 0". Throws a JostleError. */
    input(line: string): void;
    /** Hash of the whole state, 16 hexadecimal digits. */
    readonly hash: string;
    /** Simulated time, s. */
    readonly time: number;
    /** Steps made. */
    readonly tick: number;
    /** Time that the scene lasts, s. */
    readonly duration: number;
    /** Number of people. */
    readonly agents: number;
    /** A number of every agent: "x", "y", m, "vx", "vy", m/s, "id", "state", ... On the engine's memory: valid until the next call, not to be written. */
    column(name: "x" | "y" | "vx" | "vy" | "face_x" | "face_y" | "chest_x" | "chest_y" | "force_x" | "force_y" | "compression" | "load" | "density"): Float32Array;
    column(name: "id" | "slot"): Uint32Array;
    column(name: string): Column;
    events(): Events;
    bodies(): Body[];
    /** The name of a number in columns and events; `machine`: of a state. */
    name(kind: "group" | "machine" | "state" | "signal" | "place" | "body", number: number, machine?: number): string;
    /** What there is to draw besides people: walls, places, groups and states with their colours, bodies. */
    plan(): any;
    /** Figures of the run so far. */
    summary(): any;
    close(): void;
}
