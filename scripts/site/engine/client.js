// The engine in a worker: calls with answers, and what it tells by itself.

export class EngineClient {
    /** `worker`: that of worker.js. `tell(event)`: takes {event: "scene" | "status" | "reloaded" | "inspect" | "said" | "failed", ...}. */
    constructor(worker, tell = () => {}) {
        this.calls = new Map();
        this.count = 0;
        this.worker = worker;
        this.worker.onmessage = ({ data }) => (data.id === undefined ? tell(data) : this.answer(data));
        this.worker.onerror = (event) => {
            event.preventDefault();
            const text = event.message || "The engine could not be loaded: a file of the playground is missing.";
            if (!this.hasAnswered) this.fault = new Error(text); // it is not there: nor will later calls be answered
            for (const { reject } of this.calls.values()) reject(new Error(text));
            this.calls.clear();
            tell({ event: "failed", text });
        };
        if (worker.early) worker.onerror(worker.early); // early.js has met it
    }

    answer({ id, result, error }) {
        this.hasAnswered = true;
        const call = this.calls.get(id);
        this.calls.delete(id);
        if (error) call?.reject(new Error(error));
        else call?.resolve(result);
    }

    /** Calls a function of the worker; resolves with its result. */
    call(what, given = {}, transfer = []) {
        if (this.fault) return Promise.reject(this.fault);
        return new Promise((resolve, reject) => {
            this.calls.set(++this.count, { resolve, reject });
            this.worker.postMessage({ id: this.count, what, ...given }, transfer);
        });
    }
}
