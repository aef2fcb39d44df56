// Unsaved and unshared work, kept in the browser until it equals what was opened.

const KEY = "jostle-draft:";

/** The browser's storage; null where it is forbidden. */
function browserStorage() {
    try {
        return globalThis.localStorage;
    } catch {
        return null;
    }
}

/** Work on one scene or lesson; `name` tells it from that on others. `storage` is the browser's. */
export class Draft {
    constructor(name, storage = browserStorage()) {
        this.key = KEY + name;
        this.storage = storage;
    }

    /** Keeps texts {path: text} that differ from `opened`, or forgets them if none does. `more`: {scene, lesson}. False if the browser keeps nothing. */
    keep(files, opened, more) {
        const same = Object.keys(files).length === Object.keys(opened).length && Object.entries(files).every(([path, text]) => opened[path] === text);
        try {
            if (same) this.storage.removeItem(this.key);
            else this.storage.setItem(this.key, JSON.stringify({ files, ...more, time: Date.now() }));
            return true;
        } catch {
            return false;
        }
    }

    /** Returns {files, scene, lesson, time} of work that was kept, else null; time in ms since 1970. */
    find() {
        try {
            const kept = JSON.parse(this.storage.getItem(this.key));
            return kept && typeof kept.files === "object" && Object.hasOwn(kept.files, kept.scene) ? kept : null;
        } catch {
            return null;
        }
    }

    forget() {
        try {
            this.storage.removeItem(this.key);
        } catch {
            // nothing was kept
        }
    }
}
