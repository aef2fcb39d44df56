// Loads the files that lie beside this one, and the module: in Node.js, workers and pages.
const inNode = Boolean(globalThis.process?.versions?.node);

/** The address of a file that lies beside this one; `locate`: its address, where that is another. */
export const addressOf = (name, locate) => (locate ? locate(name) : new URL(name, import.meta.url).href);

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

/** The texts, by path, of a JSON file of an address. */
export const readTexts = async (address) => {
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
export async function instantiate(create, wasm) {
    const compiled = wasm instanceof WebAssembly.Module ? wasm : await (typeof wasm === "string" ? compileFrom(wasm) : WebAssembly.compile(wasm));
    const module = await new Promise((resolve, reject) => {
        create({ print: console.log, printErr: warn, instantiateWasm(imports, take) {
            WebAssembly.instantiate(compiled, imports).then((instance) => take(instance, compiled)).catch(reject);
            return {}; // what it needs comes by take()
        } }).then(resolve, reject);
    });
    return { module, compiled };
}
