// A thread of the module with threads: a worker of a browser or of Node.js, in place of the one that Emscripten makes, which is
// for browsers alone. engine.mjs starts it; jostle-threads.mjs sends it "load" once, then "run" for each thread that it becomes.
import createModule from "./jostle-threads.mjs";

const inNode = Boolean(globalThis.process?.versions?.node);
let module = null;

/** Instantiates the module on the memory that all threads share; jostle-threads.mjs then reports that it is loaded. */
async function load({ wasmModule, wasmMemory }) {
    module = await createModule({
        ENVIRONMENT_IS_PTHREAD: true,
        wasmMemory,
        buffer: wasmMemory.buffer,
        printErr: console.warn,
        instantiateWasm(imports, take) {
            const instance = new WebAssembly.Instance(wasmModule, imports);
            take(instance);
            return instance.exports;
        },
    });
}

/** Runs a thread of the engine from its beginning to its end. */
function run({ threadInfoStruct, start_routine: routine, arg, time }) {
    module.__performance_now_clock_drift = performance.now() - time; // ms: all threads have one clock
    module.__emscripten_thread_init(threadInfoStruct, 0, 0, 1);
    module.establishStackSpace();
    module.PThread.threadInit();
    module.__emscripten_thread_exit(module.invokeEntryPoint(routine, arg));
}

function receive({ data }) {
    if (data.cmd === "load") load(data);
    else if (data.cmd === "run") run(data);
}

if (inNode) {
    const threads = "node:worker_threads"; // a name that bundlers for browsers do not follow
    const { parentPort } = await import(threads);
    globalThis.postMessage = (message) => parentPort.postMessage(message);
    parentPort.on("message", (data) => receive({ data }));
} else {
    globalThis.onmessage = receive;
}
