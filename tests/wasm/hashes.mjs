// hashes.mjs STEPS: reads lines "SCENE [--set PATH=VALUE ...]", runs each scene in WebAssembly for STEPS steps, and prints
// "SCENE HASH"; of a scene that fails "SCENE" and the reason.
import { readFileSync } from "node:fs";
import process from "node:process";
import { Engine } from "../../build/wasm/out/engine.mjs";

const steps = Number(process.argv[2]);
const engine = await Engine.create();
for (const line of readFileSync(0, "utf8").trim().split("\n")) {
    const [scene, ...options] = line.split(" ");
    try {
        const run = engine.open({ scene, set: options.filter((word) => word !== "--set"), say: () => {} });
        run.step(steps);
        console.log(`${scene} ${run.hash}`);
        run.close();
    } catch (error) {
        console.log(`${scene} failed: ${error.message}`);
    }
}
