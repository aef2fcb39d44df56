// Tests of the playground that need no browser: links, archives, words, files of scenes, and the checks of lessons, with the engine
// under node. Prints "ok NAME" or "not ok NAME: why".
//     node tests/site/modules.mjs [NAME...]    some of the tests; SITE: the folder of the site, default build/site
import assert from "node:assert/strict";
import { Buffer } from "node:buffer";
import { execFileSync } from "node:child_process";
import { randomBytes } from "node:crypto";
import { mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { gzipSync } from "node:zlib";
import process from "node:process";
import { pathToFileURL } from "node:url";
import { complete, explain } from "../../scripts/site/editor/completion.js";
import { placeOf } from "../../scripts/site/editor/problems.js";
import { nodeAt, pathAt } from "../../scripts/site/editor/yaml_path.js";
import { EngineClient } from "../../scripts/site/engine/client.js";
import { observe } from "../../scripts/site/engine/observe.js";
import { makeSchedule } from "../../scripts/site/engine/schedule.js";
import { cutPreview } from "../../scripts/site/make/scenes.mjs";
import { addressOf, Draft, listDrafts, MOST_DRAFTS } from "../../scripts/site/project/draft.js";
import { packProject, unpackProject } from "../../scripts/site/project/link.js";
import { filesOf, isFileName, modsNamed, plainPath, renamedIn, turnOnMod } from "../../scripts/site/project/references.js";
import { faultsSaid } from "../../scripts/site/project/said.js";
import { deflate, readZip, writeZip } from "../../scripts/site/project/zip.js";
import { CHECKS } from "../../scripts/site/workbench/lesson_checks.js";
import { lessonFiles } from "../../scripts/site/workbench/opened.js";
import { sceneOf } from "../../scripts/site/workbench/share.js";

const SITE = resolve(process.env.SITE ?? "build/site"), JOSTLE = resolve(process.env.JOSTLE ?? "build/release/jostle");
const read = (path) => readFileSync(join(SITE, path), "utf8");
const words = JSON.parse(read("data/words.json")), { lessons } = JSON.parse(read("data/lessons.json")), shipped = JSON.parse(read("engine/shipped.json"));
const { Engine } = await import(pathToFileURL(join(SITE, "engine/engine.mjs")));
const engine = await Engine.create({ shipped: {} }); // so that a file that is not given is missing

/** Files of a shipped scene, as the workbench finds them. */
function sceneFiles(scene) {
    const paths = filesOf(scene, (path) => shipped[path], (folder) => Object.keys(shipped).filter((path) => path.startsWith(folder)));
    return Object.fromEntries(paths.map((path) => [path, shipped[path]]));
}

const labels = (found) => found?.options.map((o) => o.label) ?? [];
const completed = (path, before, files = {}) => labels(complete({ path, before, text: before, words, files, asked: false }));

/** What the workbench gives the check of a lesson with this scene, without a crowd that runs. */
function givenFor(lesson, texts, live = { news: [], scene: null, status: null, inspect: null }) {
    const run = (files, seconds, path) => {
        let scene;
        try {
            scene = engine.open({ files, scene: path, say() {} });
        } catch (error) {
            return { errors: error.errors };
        }
        try {
            return observe(scene, seconds);
        } finally {
            scene.close();
        }
    };
    return { texts, problems: engine.check(texts, lesson.scene), observe: async (...given) => run(...given), live, lessons, scene: lesson.scene };
}

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/**
 * Runs a lesson as its reader does, who saves it over the one before, restarts and plays where `anew`, and at last chooses a player and
 * stops the time. Returns what the workbench would know of the crowd that runs.
 */
async function playedLive(lesson, before, anew) {
    const scene = engine.open({ files: anew ? lesson.after : before, scene: lesson.scene, page: true, say() {} }), live = { news: [], scene: null, status: null, inspect: null };
    const take = () => scene.takeMessages().filter((m) => m.text).map((m) => JSON.parse(m.text)).forEach((m) => m.type in live && (live[m.type] = m));
    try {
        scene.turn();
        if (!anew) live.news = scene.reload(lesson.after).news;
        scene.command({ do: "play", level: "" });
        for (let n = 0; n < 60; n++) { // of turns: the page's clock is the wall's
            if (scene.plan().groups.some(({ name }) => name === "red")) scene.command({ do: "input", line: "player 0 1 0" });
            if (lesson.title === "Why not?" && n > 40) [{ do: "inspect", find: "3" }, { do: "pause", on: true }].forEach((command) => scene.command(command));
            scene.turn();
            take();
            await pause(25);
        }
    } finally {
        scene.close();
    }
    return live;
}

const tests = {
    async "a link carries a whole project, and a damaged one says so"() {
        const project = { scene: "court.yaml", files: { "court.yaml": "title: ä\n", "dodge.lua": "x".repeat(5000) }, lesson: 3 }, link = await packProject(project);
        assert.deepEqual(await unpackProject(link), project);
        assert.match(link, /^[\w-]+$/);
        assert.ok(link.length < 300, `${link.length} characters`);
        await assert.rejects(unpackProject(link.slice(0, -9)), /damaged or cut short/);
        await assert.rejects(unpackProject(await packProject({ scene: "a.yaml", files: {} })), /lacks its scene/);
        for (const scene of ["constructor", "__proto__"]) await assert.rejects(unpackProject(await packProject({ scene, files: {} })), /lacks its scene/);
        for (const path of ["../b.lua", "/b.lua", "./b.lua", "", "a.yaml/b.lua"]) await assert.rejects(unpackProject(await packProject({ scene: "a.yaml", files: { "a.yaml": "", [path]: "" } })), /is damaged: "/, path);
        const pack = async (text) => Buffer.from(await deflate(new TextEncoder().encode(text))).toString("base64url");
        for (const text of ["null", "5"]) await assert.rejects(unpackProject(await pack(text)), /holds no project/);
        const letters = randomBytes(1.5e6).toString("base64"); // they stay as long
        for (const text of ["x".repeat(5e6), letters]) await assert.rejects(packProject({ scene: "a.yaml", files: { "a.yaml": text } }), /too large for a link/);
    },

    async "an archive is read again, by unzip too, and damage is found"() {
        const files = { "scenes/ä.yaml": "jostle: 1\n", "behaviours/b.lua": "return 1\n".repeat(999) }, zip = await writeZip(files), folder = mkdtempSync(join(tmpdir(), "jostle-site-"));
        assert.deepEqual(await readZip(zip), { files, left: [] });
        writeFileSync(join(folder, "a.zip"), zip);
        execFileSync("python3", ["-c", "import sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); assert z.testzip() is None and z.namelist() == ['scenes/ä.yaml', 'behaviours/b.lua']", join(folder, "a.zip")]);
        zip[45] ^= 1;
        await assert.rejects(readZip(zip), /damaged|invalid|incorrect/i);
        await assert.rejects(readZip(new Uint8Array(40)), /no zip archive/);
        await assert.rejects(readZip(await writeZip({ "../a.lua": "" })), /leads out of/);
        await assert.rejects(readZip(await writeZip({ a: "", "a/b.lua": "" })), /"a" is a file, and the folder of/);
        assert.deepEqual((await readZip(await writeZip({ "./a//b.lua": "", "c\\d.lua": "" }))).files, { "a/b.lua": "", "c/d.lua": "" });
        for (const [made, told] of [[{ "a.lua": "", "./a.lua": "" }, /two files a.lua/], [{ "b/__proto__": "" }, null], [JSON.parse('{"__proto__": "1"}'), /is no path/], [{ "a\\..\\..\\b.lua": "" }, /leads out of/],
            [{ "a.lua": "x".repeat(17e6) }, /more than 16 MB/], [Object.fromEntries(Array.from({ length: 501 }, (_, n) => [`${n}.lua`, ""])), /501 files/]]) {
            const packed = await writeZip(made);
            if (told) await assert.rejects(readZip(packed), told);
            else assert.deepEqual((await readZip(packed)).files, made);
        }
        const script = "import sys, zipfile; z = zipfile.ZipFile(sys.argv[1], 'w'); z.writestr('in.zip', bytes(range(256))); z.writestr('a.yaml', 'jostle: 1'); z.close()";
        execFileSync("python3", ["-c", script, join(folder, "b.zip")]);
        assert.deepEqual(await readZip(new Uint8Array(readFileSync(join(folder, "b.zip")))), { files: { "a.yaml": "jostle: 1" }, left: ["in.zip"] });
        const locked = await writeZip({ "a.lua": "" });
        locked[locked.length - 22 - 46 - 5 + 8] |= 1;
        await assert.rejects(readZip(locked), /locked by a password/);
        rmSync(folder, { recursive: true });
        assert.equal(sceneOf({ "mods/x/mod.yaml": "jostle: 1", "a.yaml": "name: 1", "b.yaml": "jostle: 1" }), "b.yaml");
    },

    "work is kept until it equals what was opened"() {
        const kept = new Map(), storage = { getItem: (k) => kept.get(k) ?? null, setItem: (k, v) => kept.set(k, v), removeItem: (k) => kept.delete(k), key: (n) => [...kept.keys()][n], get length() { return kept.size; } };
        const draft = new Draft("a", storage);
        assert.equal(draft.find(), null);
        assert.ok(draft.keep({ "a.yaml": "2" }, { "a.yaml": "1" }, { scene: "a.yaml", lesson: 2 }).kept);
        assert.deepEqual([draft.find().files, draft.find().lesson], [{ "a.yaml": "2" }, 2]);
        draft.keep({ "a.yaml": "1" }, { "a.yaml": "1" }, { scene: "a.yaml" });
        assert.equal(kept.size, 0);
        assert.equal(new Draft("a", { setItem() { throw new Error("full"); } }).keep({ a: "1" }, {}, {}).kept, false);
        assert.equal(new Draft("a", null).keep({ a: "1" }, {}, {}).why, "This browser keeps nothing");
        assert.match(new Draft("a", storage).keep({ a: "x".repeat(3e6) }, {}, {}).why, /at most 2 MB/);
        // Beyond a number the oldest work goes, and is told; what is there can be listed, opened and removed.
        kept.set("another", "1");
        const keep = (n) => new Draft(`link:${n}`, storage).keep({ "a.yaml": String(n) }, {}, { scene: "a.yaml", title: `T${n}` });
        const { now } = Date;
        let time = 0;
        Date.now = () => ++time;
        for (let n = 0; n < MOST_DRAFTS; n++) assert.deepEqual(keep(n).dropped, []);
        assert.deepEqual(keep(MOST_DRAFTS).dropped, ["T0"]);
        Date.now = now;
        assert.deepEqual([listDrafts(storage).length, listDrafts(storage)[0].title, kept.get("another")], [MOST_DRAFTS, `T${MOST_DRAFTS}`, "1"]);
        assert.deepEqual(["scene:office", "lesson", "link:5"].map((name) => addressOf({ name, lesson: 2 })), ["#scene=office", "#lesson=3", "#work=link%3A5"]);
    },

    "what a run prints is read: errors of functions with their place"() {
        const lua = (body) => `return machine { name = "a", version = 1, start = "A", states = { A = {\n  steer = function(me)\n    ${body}\n    return 0, 0\n  end } } }\n`, said = [];
        const files = { "b/a.lua": lua("local x = me.x + nil"), "s.yaml": "jostle: 1\ngroups: {one: {behaviour: b/a.lua, at: [[0, 0], [2, 0]]}}\n" };
        const scene = engine.open({ files, scene: "s.yaml", say: (text) => said.push(text) });
        scene.step(45);
        scene.close();
        const [fault, ...more] = said.flatMap(faultsSaid);
        assert.deepEqual([fault.file, fault.line, more.length], ["b/a.lua", 3, 0]);
        assert.match(fault.text, /^attempt to perform arithmetic on a nil value \(machine a > state A > steer, while it runs\)$/);
        const { from, to } = placeOf(files["b/a.lua"], fault);
        assert.equal(files["b/a.lua"].slice(from, to), "local x = me.x + nil");
        assert.deepEqual(faultsSaid("b/a.lua:4:63: warning: no transition leads out\n machine a > state B"), []);
    },

    "a file is renamed, also where others name it"() {
        const texts = { "scenes/a.yaml": "include: b.yaml\ngroups: {x: {behaviour: w.lua}}\n# w.lua, ow.lua\n", "scenes/b.yaml": "", "behaviours/w.lua": 'local c = require "c"\n', "behaviours/c.lua": "" };
        assert.match(renamedIn(texts, "behaviours/w.lua", "behaviours/läufer 2.lua")["scenes/a.yaml"], /behaviour: läufer 2.lua}}\n# läufer 2.lua, ow.lua/);
        assert.match(renamedIn(texts, "behaviours/w.lua", "mine/w.lua")["scenes/a.yaml"], /behaviour: \.\.\/mine\/w\.lua}/);
        assert.match(renamedIn(texts, "scenes/b.yaml", "scenes/$&.yaml")["scenes/a.yaml"], /^include: \$&\.yaml/);
        assert.equal(renamedIn(texts, "behaviours/c.lua", "behaviours/d.lua")["behaviours/w.lua"], 'local c = require "d"\n');
        const good = ["a.lua", "läufer.lua", "scenes/見本.yaml", "hall 2.wkt", "a/b/c.geojson"], bad = ["", ".lua", "a", "a.txt", "a.csv", "../a.lua", "/a.lua", "a//b.lua", "a\\b.lua", "a/.b.lua", "a\n.lua", "a\".lua"];
        assert.deepEqual([...good, ...bad].filter(isFileName), good);
    },

    async "what is due at once is done once, however often it is asked for"() {
        let done = 0, channel;
        const { MessageChannel } = globalThis;
        globalThis.MessageChannel = class extends MessageChannel {
            constructor() {
                super();
                channel = this;
            }
        };
        const schedule = makeSchedule(() => done++);
        globalThis.MessageChannel = MessageChannel;
        for (let n = 0; n < 20; n++) schedule(0);
        schedule(0.01);
        await pause(60);
        assert.equal(done, 1);
        schedule(0.02);
        schedule(0);
        await pause(60);
        assert.equal(done, 2);
        channel.port1.close(); // it would keep node
    },

    async "a worker that cannot be loaded is told, whenever that was found out, and answers no call"() {
        const told = [], worker = { postMessage() {} }, event = { message: "", preventDefault() {} }, engineOf = (of) => new EngineClient(of, ({ text }) => told.push(text));
        const waits = engineOf(worker), call = waits.call("open");
        worker.onerror(event);
        await assert.rejects(call, /a file of the playground is missing/);
        await assert.rejects(waits.call("open"), /a file of the playground is missing/);
        await assert.rejects(engineOf({ early: event, postMessage() {} }).call("open"), /a file of the playground is missing/);
        assert.equal(told.length, 2);
    },

    "every word of the reference has a signature and an explanation"() {
        const page = readFileSync("scripts/behaviour.md", "utf8"), known = new Map([...words.words, ...words.keys, ...words.methods].map((row) => [row.name, row]));
        assert.ok(words.words.length > 90 && words.keys.length > 60);
        for (const { name, type, text } of words.words.filter((w) => !/^(own|now|other|test|scene|refused|equal|truthy|fails|patch|replace|none|before|afterwards|around|settings)$/.test(w.name))) {
            assert.ok(type && text, name);
            assert.ok(page.includes(`\`${name}`), `${name} is not on the page`);
        }
        assert.match(known.get("seek").type, /^seek\(target: AnyTarget\): Steering$/);
        assert.match(known.get("steer").type, /^Steering\|fun\(me: Me\): number, number$/);
    },

    "words are completed where they can stand"() {
        assert.ok(completed("a.lua", "return machine {\n  states = {\n    Wait = { steer = se").includes("seek"));
        assert.ok(completed("a.lua", "    Wait = { ste").includes("steer"));
        assert.ok(completed("a.lua", "when = now.sp").includes("speed"));
        assert.deepEqual(completed("a.lua", "local mine = memory { hits = 0 }\nset = { hits = mine.h"), ["hits"]);
        assert.ok(completed("a.lua", 'nearest("ball"):fly').includes("flying"));
        assert.deepEqual(completed("a.lua", '    Wait = {\n      { to = "W'), ["Wait"]);
        assert.ok(completed("a.lua", 'steer = seek "red', { "court.yaml": "places:\n  red_court: {point: [0, 0]}\ngroups:\n" }).includes("red_court"));
        assert.deepEqual(completed("a.lua", "-- a comment on see"), []);
        assert.ok(completed("a.yaml", "groups:\n  red: {beha").includes("behaviour"));
        assert.ok(completed("a.yaml", "groups:\n  red: {fill: h").includes("hex"));
        assert.ok(completed("a.yaml", "groups:\n  red: {behaviour: wal").includes("walker.lua"));
        assert.ok(completed("a.yaml", "du").includes("duration"));
        assert.deepEqual(completed("a.yaml", "# du"), []);
    },

    "keys of scenes are found in blocks, lists and brackets"() {
        const at = (text) => pathAt(text);
        assert.deepEqual(at("bodies:\n  - name: a\n    shape:\n      sphere:\n        r").path, ["bodies", "-", "shape", "sphere"]);
        assert.deepEqual(at("walls:\n- li").path, ["walls", "-"]);
        assert.deepEqual(at("bodies:\n  - {name: a,\n     ma").path, ["bodies", "-"]);
        assert.deepEqual([at("a: 1\nview: {tools: [thr").path, at("floor: wo").key], [["view", "tools", "-"], "floor"]);
        assert.ok(nodeAt(words.scene, ["groups", "any name"]).keys.behaviour);
    },

    "what is under the pointer is explained"() {
        const lua = '    Wait = { steer = hold, -- hold\n      { to = "hold", when = now.speed } },', at = (n) => explain({ path: "a.lua", text: lua, at: n, words })?.name ?? null;
        assert.equal(at(lua.indexOf("hold") + 2), "hold");
        assert.equal(at(lua.indexOf("steer") + 1), "steer");
        assert.equal(at(lua.indexOf("-- hold") + 4), null);
        assert.equal(at(lua.indexOf('"hold"') + 2), null);
        assert.match(explain({ path: "a.lua", text: lua, at: lua.indexOf("speed") + 1, words }).text, /present speed/);
        const yaml = "groups:\n  red: {fill: hex}\n", found = explain({ path: "a.yaml", text: yaml, at: yaml.indexOf("fill") + 1, words });
        assert.match(found.text, /arrangement/);
    },

    "a fault is underlined at its column, after other letters too"() {
        const lua = 'return machine { name = "ä 🙂", version = 1, start = "A", states = { A = { steer = hodl } } }\n', [fault] = engine.check({ "u.lua": lua }, "u.lua");
        const { from, to } = placeOf(lua, fault);
        assert.equal(lua.slice(from, to), "hodl");
        assert.match(fault.wayOut, /hold/);
        const yaml = "{jostle: 1, title: 'ä 🙂', groups: {ä: {behaviour: nö.lua, at: [[0, 0]]}}}\n", [missing] = engine.check({ "u.yaml": yaml }, "u.yaml"), place = placeOf(yaml, missing);
        assert.equal(yaml.slice(place.from, place.to), "nö.lua");
    },

    async "each shipped scene has all the files that it reads"() {
        assert.equal(plainPath("scenes/../behaviours/./a.lua"), "behaviours/a.lua");
        assert.deepEqual(modsNamed("mods: {doubles: {}, rough: {a: 1}}\n"), ["doubles", "rough"]);
        assert.deepEqual(modsNamed("title: a\nmods:\n  doubles: {}\n  rough:\n    push: 1\ngroups: {}\n"), ["doubles", "rough"]);
        for (const [text, mods] of [["title: a\n", []], ["mods: {a: {b: 1}}\n", ["a"]], ["mods: {}\n", []], ["mods: # of it\n  # first\n\n  a:\n    b: 1\ntitle: $&\n", ["a"]]]) {
            assert.deepEqual(modsNamed(turnOnMod(text, "doubles")).sort(), [...mods, "doubles"]);
            assert.equal(turnOnMod(text, "doubles").match(/^mods:/gm).length, 1, text);
        }
        const withLibrary = await Engine.create({ shipped: { "scripts/crowd.lua": shipped["scripts/crowd.lua"] } });
        for (const scene of readdirSync("scenes").filter((name) => name.endsWith(".yaml")).map((name) => `scenes/${name}`)) {
            const journeys = /\bjourney:/.test(shipped[scene]); // made into machines that require what is installed
            const faults = (journeys ? withLibrary : engine).check(sceneFiles(scene), scene).filter((f) => f.severity === "error");
            assert.deepEqual(faults, [], scene);
        }
        const less = sceneFiles("scenes/evacuation.yaml");
        delete less["scripts/crowd.lua"];
        assert.ok(engine.check(less, "scenes/evacuation.yaml").some((f) => f.severity === "error"), "a file that is missing is found");
    },

    async "a scene opens with the files of its own, before all that is shipped is there"() {
        const alone = await Engine.create({ shipped: {} }), again = await Engine.create({ shipped: {}, wasmBinary: alone.compiled });
        for (const scene of ["dodgeball", "evacuation", "exit-lost"]) {
            const { files, installed } = JSON.parse(read(`data/scenes/${scene}.json`));
            again.ship(installed);
            again.open({ files, scene: `scenes/${scene}.yaml` }).close();
        }
        const named = { "a.yaml": "jostle: 1\ngroups: {a: {behaviour: walker.lua, at: [[0, 0]], goal: b}}\nplaces: {b: {point: [5, 5]}}\n" }, missing = again.check(named, "a.yaml").length;
        again.ship(shipped);
        assert.ok(missing > again.check(named, "a.yaml").length, "what is added later is found");
    },

    async "a zip of a scene runs in the native program"() {
        const folder = mkdtempSync(join(tmpdir(), "jostle-site-"));
        for (const name of ["dodgeball", "tawaf-few"]) {
            writeFileSync(join(folder, `${name}.zip`), await writeZip(sceneFiles(`scenes/${name}.yaml`)));
            execFileSync("python3", ["-m", "zipfile", "-e", `${name}.zip`, name], { cwd: folder });
            execFileSync(JOSTLE, ["run", `scenes/${name}.yaml`, "--steps", "5", "--quiet"], { cwd: join(folder, name) });
        }
        rmSync(folder, { recursive: true });
    },

    async "a lesson's own solution passes its check, and what it begins with does not"() {
        assert.deepEqual(Object.keys(CHECKS), lessons.map((l) => l.title));
        for (const [n, lesson] of lessons.entries()) {
            const begun = await CHECKS[lesson.title](givenFor(lesson, lessonFiles(lesson)));
            assert.ok(begun.some((i) => !i.holds), `${lesson.title}: passes from its beginning`);
            const live = n >= 4 ? await playedLive(lesson, lessons[n - 1].after, n > 4) : undefined, solved = await CHECKS[lesson.title](givenFor(lesson, lesson.after, live));
            assert.deepEqual(solved.filter((i) => !i.holds), [], lesson.title);
            const written = await CHECKS[lesson.title](givenFor(lesson, lesson.after));
            assert.ok(n < 4 || written.some((i) => !i.holds), `${lesson.title}: passes without a crowd that runs`);
        }
    },

    async "after a trap the worker makes a new engine, and opens the scene with what ran"() {
        const said = [], own = ["self", "location", "postMessage", "addEventListener", "fetch"].map((name) => [name, Object.getOwnPropertyDescriptor(globalThis, name)]);
        const set = (name, value) => Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });
        const instantiate = WebAssembly.instantiate, memories = [];
        let receive;
        WebAssembly.instantiate = async (...given) => {
            const instance = await instantiate(...given);
            memories.push(...Object.values(instance.exports).filter((item) => item instanceof WebAssembly.Memory));
            return instance;
        };
        set("self", { name: "first" });
        set("location", { href: pathToFileURL(join(SITE, "workbench.html")).href });
        set("postMessage", (message) => said.push(message));
        set("addEventListener", (_, handler) => (receive = (data) => handler({ data })));
        set("fetch", async (address) => ({ ok: true, json: async () => JSON.parse(readFileSync(new URL(address), "utf8")) }));
        const { port1, port2 } = new MessageChannel(), sent = []; // the page
        port1.onmessage = ({ data }) => {
            sent.push(data);
            if (data.messages) port1.postMessage({ drawn: true });
        };
        try {
            await import(pathToFileURL(join(SITE, "worker.js")));
            const call = async (what, given) => {
                await receive({ id: said.length + 1000, what, ...given });
                const { result, error } = said.at(-1);
                assert.equal(error, undefined);
                return result;
            };
            const until = async (done) => { for (let n = 0; n < 1000 && !done(); n++) await new Promise((waited) => setTimeout(waited, 10)); };
            const faults = () => said.filter(({ event }) => event === "failed").map(({ text }) => text);
            await call("connect", { port: port2 });
            const files = sceneFiles("scenes/circle.yaml"), path = "behaviours/antipodal.lua";
            files["scenes/circle.yaml"] = files["scenes/circle.yaml"].replace("1000", "10");
            assert.deepEqual((await call("open", { files, path: "scenes/circle.yaml" })).errors, []);
            assert.deepEqual((await call("reload", { files: { [path]: files[path].replace("version = 1", "version = 7") } })).errors, []);
            const scenes = () => sent.flatMap(({ messages }) => messages ?? []).filter((text) => typeof text === "string" && /"type": *"scene"/.test(text));
            const runs = (reloads) => new RegExp(`"version": 7, "reloads": ${reloads},`).test(scenes().at(-1));
            await until(() => runs(1));
            new Uint8Array(memories[0].buffer).fill(255);
            await until(() => faults().length === 1 && runs(0));
            assert.match(faults()[0], /a fault of its own .*begins the scene anew/);
            assert.ok(runs(0), "the scene does not run anew with what was saved");
            new Uint8Array(memories[1].buffer).fill(255);
            await until(() => faults().length === 2);
            assert.match(faults()[1], /press Restart/); // no endless chain
        } finally {
            port1.close();
            WebAssembly.instantiate = instantiate;
            for (const [name, descriptor] of own) if (descriptor) Object.defineProperty(globalThis, name, descriptor);
        }
    },

    "engine, bodies, page and what starts them are at most 1.5 MB, compressed"() {
        const loaded = ["engine/engine.mjs", "engine/jostle.mjs", "engine/jostle.wasm", "engine/shipped.json", "page/index.html", "page/main.js", "page/style.css", "site.css", "worker.js", "workbench.html", "workbench.js"];
        const sizes = loaded.map((path) => gzipSync(readFileSync(join(SITE, path)), { level: 9 }).length), all = sizes.reduce((sum, size) => sum + size, 0);
        assert.ok(all <= 1.5e6, `${all} bytes: ${loaded.map((path, n) => `${path} ${sizes[n]}`).join(", ")}`);
    },

    "pictures of the first page are small, and come when they are in sight"() {
        const large = readdirSync(join(SITE, "previews")).filter((name) => statSync(join(SITE, "previews", name)).size > 60e3), page = read("index.html");
        assert.deepEqual(large, []);
        assert.equal(page.match(/<img /g).length, page.match(/loading="lazy"/g).length + 1, "all but the first one");
    },

    "previews are cut to the crowd"() {
        const path = join(tmpdir(), `jostle-preview-${process.pid}.svg`);
        execFileSync(JOSTLE, ["render", "scenes/counter.yaml", "--out", path, "--quiet"], { stdio: "ignore" });
        const svg = readFileSync(path, "utf8");
        const { people, svg: cut } = cutPreview(svg);
        assert.equal(people, 20);
        assert.ok(!cut.includes("<text") && cut.includes("viewBox") && cut.length < svg.length);
        rmSync(path);
    },
};

const wanted = process.argv.slice(2);
for (const [name, test] of Object.entries(tests)) {
    if (wanted.length && !wanted.some((w) => name.includes(w))) continue;
    try {
        await test();
        console.log(`ok ${name}`);
    } catch (error) {
        console.log(`not ok ${name}: ${error.message}`);
        process.exitCode = 1;
    }
}
process.exit(); // ports of the worker that was tested stay open
