// Runs the hostile behaviours of tests/attacks in WebAssembly: each ends with an error of the engine or runs, none ends the module.
// Prints "ok NAME" or "not ok NAME".
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { Engine, JostleError } from "../../build/wasm/out/engine.mjs";

const YARD = "jostle: 1\nplaces: {yard: {polygon: [[-9, -9], [9, -9], [9, 9], [-9, 9]]}}\ngroups: {some: {behaviour: ../behaviours/attack.lua, count: 20, in: yard}}\n";
const attacks = new URL("../attacks/", import.meta.url), engine = await Engine.create();
const trapped = [];

function attack(lua) {
    const scene = engine.open({ files: { "scenes/yard.yaml": YARD, "behaviours/attack.lua": lua }, scene: "scenes/yard.yaml", say: () => {} });
    try {
        scene.step(20);
    } finally {
        scene.close();
    }
}

function hashCircle() {
    const scene = engine.open({ scene: "scenes/circle.yaml", set: { "groups.crossing.count": 50 }, say: () => {} });
    scene.step(20);
    const { hash } = scene;
    scene.close();
    return hash;
}

const before = hashCircle(), names = readdirSync(attacks).filter((name) => name.endsWith(".lua"));
for (const name of names) {
    try {
        attack(readFileSync(new URL(name, attacks), "utf8"));
    } catch (error) {
        if (!(error instanceof JostleError)) trapped.push(`${name}: ${error.message}`);
    }
}
assert.ok(names.length > 100);
console.log(trapped.length ? `not ok ${names.length} hostile behaviours end with an error or run: ${trapped.join("; ")}` : `ok ${names.length} hostile behaviours end with an error or run`);
console.log(hashCircle() === before ? "ok   the engine computes as before" : "not ok   the engine computes as before");
