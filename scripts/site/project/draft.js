// Unsaved and unshared work, kept in the browser until it equals what was opened, or is removed on the first page.

const KEY = "jostle-draft:";
const LARGEST = 2e6; // characters of one piece of work; browsers keep some five million in all
/** Pieces of work that are kept; beyond, the oldest goes. */
export const MOST_DRAFTS = 20;

/** The browser's storage; null where it is forbidden. */
function browserStorage() {
    try {
        return globalThis.localStorage;
    } catch {
        return null;
    }
}

/** Reads what is kept under a key: {files, scene, lesson, title, time}; null if there is nothing that can be used. */
function readKept(storage, key) {
    try {
        const kept = JSON.parse(storage.getItem(key));
        return kept && typeof kept.files === "object" && Object.hasOwn(kept.files, kept.scene) ? kept : null;
    } catch {
        return null;
    }
}

/** What is kept, the latest first: [{name, title, time, size}], time in ms since 1970, size in characters. */
export function listDrafts(storage = browserStorage()) {
    const found = [];
    for (let n = 0; n < (storage?.length ?? 0); n++) {
        const key = storage.key(n), kept = key.startsWith(KEY) ? readKept(storage, key) : null;
        if (kept) found.push({ name: key.slice(KEY.length), title: kept.title || kept.scene, lesson: kept.lesson, time: kept.time, size: storage.getItem(key).length });
    }
    return found.sort((a, b) => b.time - a.time);
}

/** The fragment of the workbench's address that opens a piece of work. */
export function addressOf({ name, lesson }) {
    if (name.startsWith("scene:")) return `#scene=${name.slice("scene:".length)}`;
    return name === "lesson" ? `#lesson=${(lesson ?? 0) + 1}` : `#work=${encodeURIComponent(name)}`;
}

/** Work on one scene or lesson; `name` tells it from that on others. `storage` is the browser's. */
export class Draft {
    constructor(name, storage = browserStorage()) {
        this.name = name;
        this.key = KEY + name;
        this.storage = storage;
    }

    /**
     * Keeps texts {path: text} that differ from `opened`, or forgets them if none does. `more`: {scene, lesson, title}. Returns {kept,
     * why: what kept it from that, dropped: titles of work that had to go}.
     */
    keep(files, opened, more) {
        const same = Object.keys(files).length === Object.keys(opened).length && Object.entries(files).every(([path, text]) => opened[path] === text);
        const dropped = [];
        try {
            if (same) this.storage.removeItem(this.key);
            else {
                const text = JSON.stringify({ files, ...more, time: Date.now() });
                if (text.length > LARGEST) return { kept: false, dropped, why: `The browser keeps at most ${LARGEST / 1e6} MB of work` };
                this.storage.setItem(this.key, text);
                for (const old of listDrafts(this.storage).slice(MOST_DRAFTS)) {
                    dropped.push(old.title);
                    this.storage.removeItem(KEY + old.name);
                }
            }
            return { kept: true, dropped, why: "" };
        } catch (error) {
            return { kept: false, dropped, why: error?.name === "QuotaExceededError" ? "The browser's storage is full (the first page lists what is kept, and removes it)" : "This browser keeps nothing" };
        }
    }

    /** Returns {files, scene, lesson, title, time} of work that was kept, else null; time in ms since 1970. */
    find() {
        return readKept(this.storage, this.key);
    }

    forget() {
        try {
            this.storage.removeItem(this.key);
        } catch {
            // nothing was kept
        }
    }
}
