// How many threads an engine gets, and the module that has them (thread.mjs is one). Threads share the module's memory, which browsers
// allow only to pages that are cross-origin isolated, by the headers Cross-Origin-Opener-Policy: same-origin and
// Cross-Origin-Embedder-Policy: require-corp.

const MOST = 64; // as core/task/pool.c
const USUAL = 8; // more only if they are asked for
const FOR_ROUTES = 2; // a scene computes routes in one more thread, beside its steps; without one left it computes them in the step

const inNode = Boolean(globalThis.process?.versions?.node);
const inPage = typeof document !== "undefined"; // a page's own thread must not wait for others

/** How many processors the machine has. */
async function countProcessors() {
    if (!inNode) return globalThis.navigator?.hardwareConcurrency ?? 1;
    const system = "node:os"; // a name that bundlers for browsers do not follow
    return (await import(system)).availableParallelism();
}

/** Returns how many threads an engine gets, of `wanted` ones, and how many processors there are. undefined: as many as are useful. */
export async function chooseThreads(wanted) {
    if (wanted !== undefined && (!Number.isInteger(wanted) || wanted < 1 || wanted > MOST))
        throw new RangeError(`threads must be a whole number from 1 to ${MOST}, not ${wanted}`);
    const processors = await countProcessors();
    if (inNode) return { threads: wanted ?? 1, processors };
    if (inPage || !globalThis.crossOriginIsolated) return { threads: 1, processors };
    return { threads: wanted ?? Math.min(processors, USUAL), processors };
}

/** Makes a worker: of Node.js one with the interface of a browser's. */
async function makeWorker(address) {
    if (!inNode) return new Worker(address, { type: "module" });
    const threads = "node:worker_threads", { Worker: NodeWorker } = await import(threads);
    const worker = new NodeWorker(new URL(address));
    worker.on("message", (data) => worker.onmessage({ data }));
    worker.on("error", (error) => worker.onerror(error));
    return worker;
}

/** Makes a worker that is ready to become a thread of the module. */
async function addWorker(module, address) {
    const worker = await makeWorker(address);
    await new Promise((resolve, reject) => {
        module.PThread.loadWasmModuleToWorker(worker, resolve);
        worker.onerror = (event) => reject(new Error(event.message || `${address} cannot be loaded`));
    });
    module.PThread.unusedWorkers.push(worker);
    if (inNode) worker.unref(); // the program ends when all else has ended
    return worker;
}

/**
 * Loads the module with threads, and makes the workers of those: all at the beginning, as none can start while the engine steps.
 * @param {{threads: number, processors: number}} count
 * @param {(name: string) => string} addressOf Of a file that lies beside this one.
 * @param {(create: Function, address: string) => Promise<{module: Object}>} instantiate
 * @returns {Promise<{module: Object, workers: Object[]}>}
 */
export async function loadThreads({ threads, processors }, addressOf, instantiate) {
    const { default: create } = await import(addressOf("jostle-threads.mjs"));
    const { module } = await instantiate(create, addressOf("jostle-threads.wasm"));
    const all = Array.from({ length: threads - 1 + FOR_ROUTES }, () => addWorker(module, addressOf("thread.mjs")));
    const workers = await Promise.all(all);
    if (!module._jostle_use_threads(threads, processors)) throw new Error("out of memory");
    return { module, workers };
}
