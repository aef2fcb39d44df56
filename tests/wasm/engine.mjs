// Tests of the interface of the WebAssembly module (scripts/wasm/engine.mjs) under Node.js. Prints "ok NAME" or "not ok NAME".
import assert from "node:assert/strict";
import { BrokenEngineError, Engine, JostleError, Scene } from "../../build/wasm/out/engine.mjs";

const engine = await Engine.create();

function test(name, work) {
    try {
        work();
        console.log(`ok ${name}`);
    } catch (error) {
        console.log(`not ok ${name}: ${error.stack}`);
    }
}

const YARD = "jostle: 1\nplaces: {yard: {polygon: [[-9, -9], [9, -9], [9, 9], [-9, 9]]}}\ngroups: {some: {behaviour: walk.lua, at: [[0, 0], [2, 0], [4, 0]]}}\n";
const walk = (speed, way = 1) => `return machine { name = "walk", start = "Walk", defaults = { speed = ${speed} },\n  states = { Walk = { steer = drift(${way}, 0) } } }\n`;
const FILES = { "scenes/yard.yaml": YARD, "behaviours/walk.lua": walk(1.5) };

/** Opens the yard; what it says goes to `said`. */
function openYard({ files = FILES, ...options } = {}) {
    const said = [];
    return Object.assign(engine.open({ files, scene: "scenes/yard.yaml", say: (text) => said.push(text), ...options }), { said });
}

async function testLoading() {
    const fails = Scene.load({ scene: "scenes/circle.yaml", locate: (name) => `/nowhere/${name}` });
    await assert.rejects(fails, /nowhere/);
    const options = { scene: "scenes/circle.yaml", set: { "groups.crossing.count": 5 }, say: () => {} };
    const [one, other] = await Promise.all([Scene.load(options), Scene.load(options)]);
    one.step(3);
    other.step(3);
    assert.equal(one.hash, other.hash);
}
await testLoading().then(() => console.log("ok scenes share an engine, which is tried again after a failure"), (error) => console.log(`not ok scenes share an engine: ${error.stack}`));

test("scene is stepped and read", () => {
    const scene = openYard();
    scene.step(20);
    assert.equal(scene.agents, 3);
    assert.equal(scene.tick, 20);
    assert.ok(Math.abs(scene.time - 1) < 1e-9);
    assert.match(scene.hash, /^[0-9a-f]{16}$/);
    assert.ok(scene.column("x") instanceof Float32Array);
    assert.deepEqual([...scene.column("vx")].map((v) => v.toFixed(1)), ["1.5", "1.5", "1.5"]);
    assert.deepEqual([...scene.column("id")].sort(), [0, 1, 2]);
    assert.equal(scene.column("speed").length, 3);
    assert.equal(scene.name("machine", 0), "walk");
    assert.equal(scene.name("state", scene.column("state")[0]), "Walk");
    assert.throws(() => scene.column("nonsense"), RangeError);
    assert.equal(scene.summary().agents, 3);
    assert.equal(scene.plan().states[0].name, "Walk");
    scene.close();
    assert.throws(() => scene.step(), /closed/);
});

test("columns are of the engine's memory", () => {
    const scene = openYard(), x = scene.column("x");
    assert.equal(x.buffer, scene.column("y").buffer);
    scene.close();
});

test("errors of a scene have file, line, column and a way out", () => {
    const wrong = { ...FILES, "behaviours/walk.lua": walk(1.5).replace("steer", "ster") };
    let caught = null;
    try { openYard({ files: wrong }); } catch (error) { caught = error; }
    assert.ok(caught instanceof JostleError);
    const [fault] = caught.errors;
    assert.deepEqual([fault.file, fault.line, fault.column, fault.severity], ["behaviours/walk.lua", 2, 23, "error"]);
    assert.match(fault.wayOut, /Did you mean 'steer'/);
    assert.deepEqual(engine.check(wrong, "behaviours/walk.lua")[0], fault);
    assert.deepEqual(engine.check(FILES, "scenes/yard.yaml"), []);
    assert.throws(() => openYard({ set: { "groups.some.spead": 1 } }), JostleError);
    assert.throws(() => engine.open({ scene: "scenes/none.yaml" }), /none.yaml/);
});

test("reload is taken or leaves all as it was", () => {
    const scene = openYard();
    scene.step(20);
    const refused = scene.reload({ "behaviours/walk.lua": walk("1.5 +") });
    assert.equal(refused.live, false);
    assert.deepEqual([refused.errors[0].file, refused.errors[0].line], ["behaviours/walk.lua", 1]);
    assert.deepEqual(refused.taken, []);
    assert.equal(scene.read("behaviours/walk.lua"), walk(1.5));
    scene.step(1);
    const done = scene.reload({ "behaviours/walk.lua": walk(0.5, -1) });
    assert.equal(done.live, true);
    assert.deepEqual(done.taken, ["behaviours/walk.lua"]);
    assert.deepEqual([done.news[0].before, done.news[0].after], [[{ state: "Walk", people: 3 }], [{ state: "Walk", people: 3 }]]);
    scene.step(60);
    assert.ok([...scene.column("vx")].every((v) => Math.abs(v + 0.5) < 0.01));
    assert.equal(scene.read("behaviours/walk.lua"), walk(0.5, -1));
    scene.close();
});

test("a reload names files that nothing reads, and keeps them", () => {
    const scene = openYard();
    const { live, taken, unread, errors } = scene.reload({ "behaviours/walk.lua": walk(0.5), "behaviours/pace.lua": "return 1\n" });
    assert.deepEqual({ live, taken, unread }, { live: false, taken: ["behaviours/walk.lua"], unread: ["behaviours/pace.lua"] });
    assert.deepEqual(errors.map(({ file, severity, code }) => [file, severity, code]), [["behaviours/pace.lua", "warning", "unread-file"]]);
    assert.equal(scene.reload({ "behaviours/walk.lua": walk("require 'pace'") }).live, true);
    scene.step(60);
    assert.ok(Math.abs(scene.column("vx")[0] - 1) < 0.01);
    scene.close();
});

test("a path may begin with ./, in reload as in open", () => {
    const files = Object.fromEntries(Object.entries(FILES).map(([path, text]) => [`./${path}`, text]));
    const scene = openYard({ files, scene: "./scenes//yard.yaml" });
    assert.equal(scene.reload({ "./scenes/yard.yaml": YARD }).live, true);
    const { live, taken, unread } = scene.reload({ "./behaviours//walk.lua": walk(0.5) });
    assert.deepEqual({ live, taken, unread }, { live: true, taken: ["behaviours/walk.lua"], unread: [] });
    assert.equal(scene.read("behaviours/walk.lua"), walk(0.5));
    scene.step(60);
    assert.ok(Math.abs(scene.column("vx")[0] - 0.5) < 0.01);
    scene.close();
});

test("a reload that changes nothing keeps the hash", () => {
    const [one, other] = [openYard(), openYard()];
    for (const scene of [one, other]) scene.step(10);
    other.reload({ "behaviours/walk.lua": walk(1.5) });
    for (const scene of [one, other]) scene.step(10);
    assert.equal(one.hash, other.hash);
    for (const scene of [one, other]) scene.close();
});

test("events and bodies are read", () => {
    const scene = engine.open({ scene: "scenes/dodgeball.yaml", say: () => {} });
    assert.ok(scene.events().entered.length > 0);
    const seen = { transitions: 0, hits: 0 };
    for (let step = 0; step < 400; step++) {
        scene.step();
        for (const kind of Object.keys(seen)) seen[kind] += scene.events()[kind].length;
    }
    assert.ok(seen.transitions > 0 && seen.hits > 0, JSON.stringify(seen));
    const [ball] = scene.bodies();
    assert.ok(Number.isFinite(ball.z) && Math.abs(Math.hypot(ball.qx, ball.qy, ball.qz, ball.qw) - 1) < 1e-3, JSON.stringify(ball));
    scene.close();
});

test("page gets messages turn by turn, and gives commands", () => {
    const scene = openYard({ page: true });
    scene.turn();
    const first = scene.takeMessages(), texts = first.filter((message) => message.text).map((message) => JSON.parse(message.text));
    assert.ok(texts.some((message) => message.type === "scene"));
    assert.ok(texts.some((message) => message.type === "status"));
    assert.ok(first.some((message) => message.bytes && message.channel < 12 && new DataView(message.bytes).getUint32(0, true) === 1));
    for (let turn = 0; turn < 5; turn++) scene.turn();
    const frames = scene.takeMessages().filter((message) => message.bytes && message.channel < 12);
    assert.ok(frames.length <= 1); // the newest alone
    scene.command({ do: "pause", on: true });
    scene.command({ do: "step", n: 3 });
    scene.turn();
    const before = scene.tick;
    for (let turn = 0; turn < 5; turn++) scene.turn();
    assert.ok(scene.tick - before <= 3);
    scene.reload({ "behaviours/walk.lua": walk(0.2) });
    scene.command({ do: "restart" });
    scene.turn();
    assert.ok(scene.tick <= 1);
    const types = scene.takeMessages().filter((message) => message.text).map((message) => JSON.parse(message.text).type);
    assert.ok(types.includes("reloaded") && types.includes("scene"), types.join());
    scene.step(40);
    assert.ok(Math.abs(scene.column("vx")[0] - 0.2) < 0.01); // the restart reads the reloaded text
    scene.close();
});

test("mods and settings are applied", () => {
    const hash = (options) => {
        const scene = engine.open({ scene: "scenes/tawaf-few.yaml", say: () => {}, ...options });
        scene.step(20);
        const { hash: found } = scene;
        scene.close();
        return found;
    };
    const few = { "groups.pilgrims.count": 100 };
    assert.notEqual(hash({ set: few }), hash({ set: few, seed: 7 }));
    assert.throws(() => hash({ mods: ["scenes/mods/none"] }), JostleError);
});

test("input is carried out", () => {
    const [pushed, other] = [openYard(), openYard()];
    pushed.input("push 0 0 500");
    for (const scene of [pushed, other]) scene.step(1);
    assert.notEqual(pushed.hash, other.hash);
    assert.throws(() => pushed.input("shove 0"), JostleError);
    for (const scene of [pushed, other]) scene.close();
});

test("language is described", () => {
    const rows = engine.vocabulary(), near = rows.find((row) => row.word === "near");
    assert.equal(near.signature, "near(target, metres)");
    assert.ok(rows.every((row) => row.word !== undefined && row.meaning));
    assert.ok(rows.some((row) => row.kind === "parameter" && row.word === "speed" && row.greatest > 0));
    assert.ok(JSON.parse(engine.reference("scene-schema")).properties);
    assert.match(engine.reference("behaviours"), /near/);
    assert.throws(() => engine.reference("nothing"), JostleError);
});

test("lack of memory is an error, and other scenes go on", () => {
    const fail = engine.module._jostle_fail_memory_after, scene = openYard();
    let failed = 0;
    for (let count = 0; count < 4000; count = Math.ceil(1.3 * count + 1)) {
        fail(count);
        try {
            openYard().close();
        } catch (error) {
            assert.match(error.message, /out of memory/);
            failed++;
        } finally {
            fail(-1);
        }
        scene.step(1);
    }
    assert.ok(failed > 10, `${failed} loads failed`);
    scene.close();
});

test("wrong arguments are named, and leave nothing behind", () => {
    const scene = openYard(), left = engine.module.FS.readdir("/").length, open = (options) => () => openYard(options);
    for (const count of [-1, 1.5, NaN, Infinity, "3"]) assert.throws(() => scene.step(count), /count must be a whole number/);
    assert.throws(open({ seed: -1 }), /seed must be a whole number/);
    assert.throws(open({ seed: "abc" }), /seed must be/);
    for (const dt of ["fast", NaN]) assert.throws(open({ dt }), /dt must be a number/);
    assert.throws(open({ sed: 3 }), /open has no option 'sed'/);
    for (const command of ["{", "", {}, { do: 3 }, null]) assert.throws(() => scene.command(command), /a command is an object/);
    assert.throws(open({ mods: "doubles" }), /mods must be a list of texts/);
    assert.throws(open({ set: "a=1" }), /set must be a list of texts/);
    assert.throws(open({ files: null }), /files must be an object/);
    assert.throws(open({ files: new Map(Object.entries(FILES)) }), /Object.fromEntries makes one of a Map/);
    assert.throws(() => engine.open({ scene: "scenes/none.yaml" }), { message: /^scenes\/none.yaml: / });
    assert.throws(open({ files: { ...FILES, "a.lua": 5 } }), /'a.lua' must be a text/);
    assert.throws(open({ files: { ...FILES, "../a.lua": "" } }), /'..\/a.lua' is no path/);
    assert.throws(open({ files: { ...FILES, a: "", "a/b.lua": "" } }), /'a' is a file, and the folder of 'a\/b.lua'/);
    assert.throws(open({ files: { ...FILES, scenes: "" } }), TypeError);
    assert.throws(open({ files: { ...FILES, "scripts": "" } }), /'scripts' cannot be a file/);
    assert.throws(() => engine.open(), /path of a scene is missing/);
    assert.throws(() => scene.reload({ "behaviours/walk.lua": 5 }), /must be a text/);
    assert.equal(scene.read("behaviours/walk.lua"), walk(1.5));
    assert.throws(() => scene.read("behaviours/none.lua"), /no file 'behaviours\/none.lua'/);
    assert.equal(scene.tick, 0);
    assert.equal(engine.module.FS.readdir("/").length, left);
    scene.close();
    assert.throws(() => scene.read("behaviours/walk.lua"), /closed/);
});

async function testHighMemory() {
    const high = await Engine.create();
    for (let n = 0; n < 2; n++) assert.notEqual(high.module._malloc(1.2e9), 0); // untouched: no memory of the machine
    const [scene, low] = [high, engine].map((of) => of.open({ files: FILES, scene: "scenes/yard.yaml", page: true, say: () => {} }));
    assert.ok(scene.column("x").byteOffset > 2 ** 31);
    for (const each of [scene, low]) {
        each.step(20);
        assert.equal(each.reload({ "behaviours/walk.lua": walk(0.5) }).live, true);
        each.step(20);
    }
    assert.equal(scene.hash, low.hash);
    assert.deepEqual([...scene.column("vx")], [...low.column("vx")]);
    scene.turn();
    assert.ok(scene.takeMessages().length > 3);
    const court = high.open({ scene: "scenes/dodgeball.yaml", say: () => {} });
    assert.equal(court.events().entered.length, 2);
    assert.equal(court.bodies()[0].name, "ball");
    for (const each of [scene, low, court]) each.close();
}
await testHighMemory().then(() => console.log("ok a scene runs beyond the first 2 GB of memory"), (error) => console.log(`not ok a scene runs beyond 2 GB: ${error.stack}`));

// Crowds with and without bodies, routes and walls that break: threads change nothing.
const THREADED = [["circle", 40], ["office", 40], ["dodgeball", 100], ["wall-breaking", 40], ["tawaf-few", 10]];

async function testThreads() {
    const several = await Promise.all([2, 3].map((threads) => Engine.create({ threads })));
    assert.deepEqual([engine, ...several].map(({ threads }) => threads), [1, 2, 3]);
    for (const [name, steps] of THREADED) {
        const hashes = [engine, ...several].map((of) => {
            const scene = of.open({ scene: `scenes/${name}.yaml`, say: () => {} });
            scene.step(steps);
            const { hash } = scene;
            scene.close();
            return hash;
        });
        assert.equal(new Set(hashes).size, 1, `${name}: ${hashes.join(" ")}`);
    }
    const [two] = several, scene = two.open({ files: FILES, scene: "scenes/yard.yaml", page: true, say: () => {} });
    scene.turn();
    assert.ok(scene.takeMessages().some(({ bytes }) => bytes instanceof ArrayBuffer)); // which can be sent on, as shared memory cannot
    assert.ok(scene.column("x").buffer instanceof SharedArrayBuffer);
    for (const each of several) each.close();
    assert.throws(() => scene.step(), /the engine is closed/);
    scene.close();
    assert.throws(() => scene.step(), /the scene is closed/);
    await assert.rejects(Engine.create({ threads: 0 }), /threads must be a whole number from 1 to 64/);
}
await testThreads().then(() => console.log("ok hashes are the same with one, two and three threads"), (error) => console.log(`not ok threads: ${error.stack}`));

async function testTrap() {
    const options = { files: FILES, scene: "scenes/yard.yaml", say: () => {} };
    for (const threads of [1, 2]) {
        const broken = await Engine.create({ threads }), scene = broken.open(options);
        assert.throws(() => broken.module._jostle_turn(-8), /the engine has stopped by a fault of its own .* make a new Engine/);
        assert.equal(broken.broken, true);
        for (const call of [() => scene.step(), () => scene.hash, () => broken.open(options), () => broken.check(FILES, "scenes/yard.yaml")]) assert.throws(call, BrokenEngineError);
        scene.close();
    }
    assert.equal(engine.broken, false);
}
await testTrap().then(() => console.log("ok after a trap each call asks for a new engine"), (error) => console.log(`not ok a trap: ${error.stack}`));
