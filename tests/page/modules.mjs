// Tests of the page's modules that need no browser: sentences, figures, colours. Prints "ok NAME" or "not ok NAME: why".
//     node tests/page/modules.mjs [NAME...]    some of the tests
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import process from "node:process";
import { amount } from "../../core/view/page/dom.js";
import { roundDown } from "../../core/view/page/controls/compass.js";
import { classColour, outerStates, valueColour, wayColour } from "../../core/view/page/draw/palette.js";
import { elevationsSeen } from "../../core/view/page/draw/figure/levels.js";
import { Storeys, cutFloor, hullOf } from "../../core/view/page/draw/storeys.js";
import { ALONG, STANDING } from "../../core/view/page/draw/scenery_kinds.js";
import { MOST_TRIANGLES, buildScenery } from "../../core/view/page/draw/scenery_mesh.js";
import { endSentences } from "../../core/view/page/panels/end.js";
import { KEYS } from "../../core/view/page/panels/help.js";
import { censusText, hasNewError, newsLines } from "../../core/view/page/panels/news.js";
import { densityText } from "../../core/view/page/panels/scene.js";

// What people who lack one kind of cone see, of linear sRGB (Machado, Oliveira and Fernandes 2009).
const EYES = {
    "all cones": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
};
const XYZ = [[0.4124, 0.3576, 0.1805, 0.9505], [0.2126, 0.7152, 0.0722, 1], [0.0193, 0.1192, 0.9505, 1.089]]; // with the white point
const APART = 10; // least CIEDE2000 between two of the first eight classes

const dot = (row, v) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2];

/** CIELAB of sRGB, 0 to 255, as an eye sees it. */
function labOf(rgb, eye) {
    const linear = rgb.map((c) => (c <= 10 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    const seen = eye.map((row) => Math.min(1, Math.max(0, dot(row, linear))));
    const [x, y, z] = XYZ.map((row) => dot(row, seen) / row[3]).map((v) => (v > 0.008856 ? Math.cbrt(v) : 7.787 * v + 16 / 116));
    return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/** CIEDE2000 of two colours in CIELAB (Sharma, Wu and Dalal 2005). */
function differenceOf([l1, a1, b1], [l2, a2, b2]) {
    const rad = Math.PI / 180, mean = (Math.hypot(a1, b1) + Math.hypot(a2, b2)) / 2;
    const g = 0.5 * (1 - Math.sqrt(mean ** 7 / (mean ** 7 + 25 ** 7)));
    const c1 = Math.hypot((1 + g) * a1, b1), c2 = Math.hypot((1 + g) * a2, b2);
    const hue = (a, b) => (Math.atan2(b, (1 + g) * a) / rad + 360) % 360;
    const h1 = hue(a1, b1), h2 = hue(a2, b2), c = (c1 + c2) / 2, l = (l1 + l2) / 2;
    const turn = c1 * c2 === 0 ? 0 : ((h2 - h1 + 540) % 360) - 180;
    const h = c1 * c2 === 0 ? h1 + h2 : (h1 + turn / 2 + 360) % 360;
    const t = 1 - 0.17 * Math.cos(rad * (h - 30)) + 0.24 * Math.cos(rad * 2 * h) + 0.32 * Math.cos(rad * (3 * h + 6)) - 0.2 * Math.cos(rad * (4 * h - 63));
    const dl = (l2 - l1) / (1 + (0.015 * (l - 50) ** 2) / Math.sqrt(20 + (l - 50) ** 2)), dc = (c2 - c1) / (1 + 0.045 * c);
    const dh = (2 * Math.sqrt(c1 * c2) * Math.sin((rad * turn) / 2)) / (1 + 0.015 * c * t);
    const bend = -Math.sin(rad * 60 * Math.exp(-(((h - 275) / 25) ** 2))) * 2 * Math.sqrt(c ** 7 / (c ** 7 + 25 ** 7));
    return Math.sqrt(dl * dl + dc * dc + dh * dh + bend * dc * dh);
}

/** The least difference of two of some colours to an eye. */
function leastDifference(colours, eye) {
    const seen = colours.map((c) => labOf(c, eye));
    return Math.min(...seen.flatMap((a, i) => seen.slice(0, i).map((b) => differenceOf(a, b))));
}

const page = (path) => readFileSync(new URL(`../../core/view/page/${path}`, import.meta.url), "utf8");
const near = (a, b, by) => Math.abs(a - b) <= by;

const areaOf = (ring) => ring.reduce((sum, [x, y], i) => sum + x * ring[(i + 1) % ring.length][1] - ring[(i + 1) % ring.length][0] * y, 0) / 2;

/** Three storeys of 20 x 10 m: a dog-leg from the first to the second with a half landing, and a ramp over it from the second to the third. */
const DOG_LEG = { name: "dog-leg", kind: "stairs", way: "both", lower: 0, upper: 1, sheet: 3, width: 1, outline: [[1.5, 2], [1.5, 6.5], [3.5, 6.5], [3.5, 2], [2.5, 2], [2.5, 5.5], [2.5, 5.5], [2.5, 2]],
    path: [[2, 2], [2, 6], [3, 6], [3, 2]], flights: [{ from: [2, 2], along: [0, 1], run: 3.5, low: 0, slope: 0.5 }, { from: [3, 5.5], along: [0, -1], run: 3.5, low: 1.75, slope: 0.5 }] };
const RAMP = { name: "ramp", kind: "ramp", way: "both", lower: 1, upper: 2, sheet: 4, width: 2, outline: [[8, 4], [16, 4], [16, 6], [8, 6]], path: [[8, 5], [16, 5]], flights: [{ from: [8, 5], along: [1, 0], run: 8, low: 3.5, slope: 0.5 }] };
const BUILDING = { pitch: 45, origin: -10, list: [{ name: "ground", height: 0 }, { name: "first", height: 3.5 }, { name: "second", height: 7.5 }], stairs: [DOG_LEG, RAMP], lifts: [] };
const WALLS = [0, 1, 2].map((k) => ({ points: [[0, 45 * k], [20, 45 * k], [20, 45 * k + 10], [0, 45 * k + 10]], height: 2 }));

function makeBuilding(changes = {}) {
    const storeys = Object.assign(new Storeys(BUILDING), changes);
    storeys.measure(storeys.unfold({ walls: WALLS, places: [], area: [[0, 0], [20, 10]] }));
    return storeys;
}

const TESTS = {
    "points of sheets go to the plan and back, on storeys and stairs": () => {
        const storeys = makeBuilding();
        for (const [plane, deck, plan] of [[[5, 7], 0, [5, 7]], [[5, 52], 1, [5, 7]], [[19, 99], 2, [19, 9]], [[2, 3 * 45 + 4], 3, [2, 4]], [[10, 4 * 45 + 5], 4, [10, 5]]]) {
            assert.equal(storeys.deckAt(plane), deck);
            assert.deepEqual(storeys.toPlan(deck, plane), plan);
            assert.deepEqual(storeys.toPlane(deck, plan), plane);
        }
    },
    "floors of stairs rise along flights and are level on landings": () => {
        const storeys = makeBuilding(), heights = [[2, 1], [2, 2], [2, 4], [2, 6], [2.5, 6.2], [3, 6], [3, 4], [3, 2], [3, 1]].map((p) => storeys.elevation(3, p));
        assert.deepEqual(heights, [0, 0, 1, 1.75, 1.75, 1.75, 2.5, 3.5, 3.5]);
        assert.deepEqual([[8, 5], [12, 5.9], [16, 4]].map((p) => storeys.elevation(4, p)), [3.5, 5.5, 7.5]);
        assert.equal(storeys.elevation(1, [2, 4]), 3.5);
    },
    "stairs meet the storeys that they lead to however these are shown": () => {
        for (const view of ["stacked", "exploded", "one"]) {
            const storeys = makeBuilding({ view });
            assert(near(storeys.heightAt(3, [2, 2]), storeys.heightAt(0, [2, 2]), 1e-9) && near(storeys.heightAt(3, [3, 2]), storeys.heightAt(1, [3, 2]), 1e-9), view);
            assert(near(storeys.heightAt(4, [16, 5]), storeys.heightAt(2, [16, 5]), 1e-9), view);
        }
        assert.deepEqual(makeBuilding({ view: "stacked" }).at, [0, 3.5, 7.5]);
        const spread = makeBuilding({ view: "exploded" }).at;
        assert(spread[1] - spread[0] > 6 && spread[2] - spread[1] > 6, `${spread}`);
    },
    "a line from the eye finds the floor that is shown, with the point of its sheet": () => {
        const aim = (storeys, from, to) => storeys.hit(from, to.map((v, k) => v - from[k])), eye = [12, -30, 40];
        for (const view of ["stacked", "exploded"]) {
            const storeys = makeBuilding({ view }), [, , top] = storeys.at;
            const hit = aim(storeys, eye, [18, 8, top]);
            assert.equal(hit.deck, 2, view);
            assert(near(hit.at[0], 18, 1e-6) && near(hit.at[1], 8, 1e-6) && near(hit.z, top, 1e-6), view);
            assert.deepEqual(storeys.toPlane(2, [18, 8]), [18, 98]);
        }
        const cut = makeBuilding({ view: "stacked", chosen: 1 });
        assert.equal(aim(cut, eye, [18, 8, 3.5]).deck, 1);
        assert.equal(aim(cut, [12, 5, 40], [12, 5, 0]).deck, 4); // the ramp, which is over the floor
        assert.equal(aim(makeBuilding({ view: "one", chosen: 0 }), eye, [18, 8, 0]).deck, 0);
        const stairs = makeBuilding({ view: "stacked", chosen: 0 }), flight = aim(stairs, [2, -20, 30], [2, 4, 1]), landing = aim(stairs, [2, -20, 30], [2, 6.2, 1.75]);
        assert.deepEqual([flight.deck, landing.deck], [3, 3]);
        assert(near(flight.z, 1, 1e-6) && near(flight.at[1], 4, 1e-6) && near(landing.z, 1.75, 1e-6));
    },
    "floors hide what is under them, but not through the hole of a stair": () => {
        const storeys = makeBuilding({ view: "stacked" }), above = [12, 5, 40];
        assert(storeys.hides([18, 8, 0.9], [18, 8, 40]) && storeys.hides([18, 8, 4.4], [18, 8, 40]) && !storeys.hides([18, 8, 8.4], [18, 8, 40]));
        assert(!storeys.hides([12, 5, 5.9], above)); // on the ramp, under its hole
        assert(!makeBuilding({ view: "one", chosen: 1 }).hides([18, 8, 4.4], [18, 8, 40]));
    },
    "one storey is shown with the stairs that lead to it, others are not": () => {
        const shown = (changes) => makeBuilding(changes).drawnDecks.map((deck) => deck.shown);
        assert.deepEqual(shown({ view: "one", chosen: 0 }), [true, false, false, true, false]);
        assert.deepEqual(shown({ view: "one", chosen: 1 }), [false, true, false, true, true]);
        assert.deepEqual(shown({ view: "stacked", chosen: 1 }), [true, true, false, true, true]);
        assert.deepEqual(shown({ view: "exploded", chosen: 0 }), [true, true, true, true, true]);
    },
    "of many storeys that are spread, the picture holds those about the chosen one": () => {
        const tall = (count, changes) => {
            const list = [...Array(count).keys()].map((k) => ({ name: `${k}`, height: 3 * k })), storeys = Object.assign(new Storeys({ ...BUILDING, list, stairs: [] }), changes);
            storeys.measure(storeys.unfold({ walls: list.map((_, k) => ({ points: WALLS[0].points.map(([x, y]) => [x, y + 45 * k]), height: 2 })), places: [], area: [[0, 0], [20, 10]] }));
            return list.map((_, k) => storeys.isFramed(k)).filter(Boolean).length;
        };
        assert.deepEqual([tall(8, { view: "exploded" }), tall(30, { view: "exploded", chosen: 12 }), tall(30, { view: "stacked" })], [8, 7, 30]);
    },
    "people get the height of their floor, and none where it is not shown": () => {
        const frame = () => ({ slots: 3, stands: new Uint16Array([0, 0, 3, 32768, 2, 65535]), z0: 0, sz: 7.5 / 65535 });
        const lifted = (changes) => {
            const of = frame();
            makeBuilding(changes).lift(of);
            return [...of.floors];
        };
        const stacked = lifted({ view: "stacked" });
        assert(near(stacked[0], 0, 1e-6) && near(stacked[2], 7.5, 1e-6));
        assert.deepEqual(lifted({ view: "one", chosen: 2 }).map(Number.isNaN), [true, true, false]);
        const plain = { slots: 1 };
        new Storeys().lift(plain);
        assert.equal(plain.floors, undefined);
    },
    "floors are cut around holes, which may overlap": () => {
        const square = (x0, y0, x1, y1) => [[x0, y0], [x1, y0], [x1, y1], [x0, y1]], area = (...of) => cutFloor(...of).reduce((sum, quad) => sum + areaOf(quad), 0);
        assert(near(area([square(0, 0, 10, 8)], []), 80, 1e-9));
        assert(near(area([square(0, 0, 10, 8)], [square(1, 1, 3, 3), square(2, 2, 4, 4), square(2, 2, 4, 4), square(9, 7, 12, 9)]), 80 - 7 - 1, 1e-9));
        assert(near(area([[[0, 0], [4, 0], [0, 4]], square(3, 0, 6, 1)], [[[1, 0], [2, 1], [1, 2], [0, 1]]]), 8 + 3 - 0.5 - 2, 1e-9));
        assert.deepEqual(hullOf([[0, 0], [2, 0], [1, 1], [2, 2], [0, 2], [1, 0]]), [[0, 0], [2, 0], [2, 2], [0, 2]]);
    },
    "differences of colours are those that CIEDE2000 was published with": () => {
        const published = [[[50, 2.6772, -79.7751], [50, 0, -82.7485], 2.0425], [[50, 2.5, 0], [73, 25, -18], 27.1492],
            [[2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082], [[50, -1, 2], [50, 0, 0], 2.3669]];
        for (const [a, b, difference] of published) assert(near(differenceOf(a, b), difference, 1e-4), `${differenceOf(a, b)} in place of ${difference}`);
    },
    "the first eight classes are told apart with any colour vision": () => {
        const rainbow = [...Array(8).keys()].map((i) => [0, 120, 240].map((shift) => 255 * Math.min(1, Math.max(0, Math.abs(((45 * i + shift) % 360) / 60 - 3) - 1))));
        const least = (colours) => Math.min(...Object.values(EYES).map((eye) => leastDifference(colours, eye)));
        const classes = [...Array(8).keys()].map(classColour);
        assert(least(classes) > APART, `two classes differ by ${least(classes).toFixed(1)}`);
        assert(least(rainbow) < APART / 5, `even of a rainbow's, two differ by ${least(rainbow).toFixed(1)}`);
    },
    "values are read by lightness with any colour vision, in even steps": () => {
        for (const calm of [false, true]) {
            const colours = [...Array(17).keys()].map((i) => valueColour(i / 16, calm));
            for (const [name, eye] of Object.entries(EYES)) {
                const lightness = colours.map((c) => labOf(c, eye)[0]);
                assert(lightness.every((l, i) => i === 0 || l < lightness[i - 1] - 1), `with ${name} a ramp's lightness is ${lightness}`);
            }
            const seen = colours.map((c) => labOf(c, EYES["all cones"])), steps = seen.slice(1).map((c, i) => differenceOf(seen[i], c));
            assert(Math.max(...steps) < 2 * Math.min(...steps), `the steps of a ramp are ${steps.map((s) => s.toFixed(1))}`);
        }
    },
    "pictures and the page have the same colours": () => {
        const source = (path) => readFileSync(new URL(`../../core/${path}`, import.meta.url), "utf8");
        const hex = ([r, g, b]) => ((r << 16) | (g << 8) | b).toString(16).padStart(6, "0");
        const classes = [...source("base/format/colour.h").split("JOX_CLASS_COLOURS(X)")[1].split("*/")[0].matchAll(/X\(\w+, 0x(\w{6})\)/g)].map((m) => m[1]);
        assert(classes.length >= 8);
        assert.deepEqual(classes, classes.map((_, i) => hex(classColour(i))));
        const stops = (name) => [...source("picture/palette.c").split(`${name}[`)[1].split("};")[0].matchAll(/\{0x(\w\w), 0x(\w\w), 0x(\w\w)\}/g)]
            .map((m) => m.slice(1).join(""));
        for (const [name, colour] of [["RAMP", (share) => valueColour(share)], ["CALM", (share) => valueColour(share, true)], ["WAY", wayColour]]) {
            const given = stops(`${name}`);
            assert.deepEqual(given, given.map((_, i) => hex(colour(i / (given.length - 1)))), name);
        }
    },
    "measured figures that are nothing are 0, with their unit": () => {
        const said = [[6.4e-11, "N"], [-2e-4, "m/s"], [0.25, "m"], [1234, "N"]].map((of) => amount(...of));
        assert.deepEqual(said, ["0 N", "0 m/s", "0.25 m", "1\u202f234 N"]);
    },
    "texts have a contrast of 4.5 to 1 at least, in both themes": () => {
        const css = page("style.css"), themes = css.split("prefers-color-scheme: dark");
        const read = (text) => Object.fromEntries([...text.slice(0, text.indexOf("}")).matchAll(/--([\w-]+): (#\w{6})/g)].map((m) => [m[1], [1, 3, 5].map((i) => parseInt(m[2].slice(i, i + 2), 16))]));
        const light = ([r, g, b]) => dot([0.2126, 0.7152, 0.0722], [r, g, b].map((c) => (c <= 10 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4)));
        const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
        // What lies over the picture is 82 % opaque or more, and that may be black or white.
        const over = (ground, under) => ground.map((c) => 0.82 * c + 0.18 * under);
        for (const c of [read(themes[0]), read(themes[1])]) {
            assert(Object.keys(c).length >= 9, `the colours of a theme are ${Object.keys(c)}`);
            const pairs = [["text", c.ground], ["text", c.soft], ["faint", c.ground], ["faint", c.soft], ["accent", c.ground], ["accent", c.soft], ["accent-text", c.accent],
                ["warn", c.ground], ["warn", c["warn-ground"]], ["text", over(c.ground, 0)], ["text", over(c.ground, 255)]];
            for (const [text, ground] of pairs) assert(contrast(c[text], ground) >= 4.5, `${text} has ${contrast(c[text], ground).toFixed(2)} on ${ground}`);
        }
    },
    "the list of keys has every key": () => {
        const bound = page("main.js").split("bindKeys({")[1].split("}, this.player")[0];
        const keys = [...bound.matchAll(/(?:^|[\s,{])(?:"([^"]+)"|(\w+)): (?:\(|step|turn)/g)].map((m) => m[1] ?? m[2]);
        assert(keys.length > 20, `${keys.length} keys are bound`);
        const names = { " ": "Space", Escape: "Esc", ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", "-": "−", "=": "+" };
        const told = KEYS.flatMap(([text]) => text.split(" "));
        const missing = keys.filter((key) => !told.includes(names[key] ?? (key.length === 1 ? key.toUpperCase() : key)));
        assert.deepEqual(missing, []);
    },
    "a scale bar has a round length": () => assert.deepEqual([140, 99, 7, 0.3].map(roundDown), [100, 50, 5, 0.2]),
    "of the pictures of people far away those in sight are drawn": () => {
        const seen = (...range) => elevationsSeen(range, Math.PI / 8, 5);
        assert.deepEqual(seen(10, 11, 100), [0, 1, 2, 3]);
        assert.deepEqual([seen(1, 40, 50), seen(1, 1, 1), seen(-3, 5, 9)], [[0], [4], [0]]);
        assert.deepEqual(seen(10, Infinity, 1), []); // nobody is in sight
    },
    "outer states share a colour": () => {
        const states = ["Greet", "Guard.Look", "Guard.Walk", "Rest"].map((name) => ({ machine: 0, name, colour: "#000000" }));
        const outer = outerStates({ states, machines: [{ outer: [{ name: "Guard", within: [1, 2] }] }] });
        assert.deepEqual(outer.map((o) => o.name), ["Greet", "Guard", "Guard", "Rest"]);
        assert.equal(new Set(outer.map((o) => o.colour)).size, 3);
    },
    "values stand out from a dark floor too": () => {
        for (const calm of [false, true]) {
            const lightness = [...Array(17).keys()].map((i) => labOf(valueColour(i / 16, calm, true), EYES["all cones"])[0]);
            assert(lightness.every((l, i) => i === 0 || l > lightness[i - 1] + 1), `a ramp's lightness is ${lightness}`);
            assert(lightness[0] > 25, `nothing is as dark as the floor, ${lightness[0]}`);
        }
    },
    "the end of a run is told in sentences": () => {
        const south = { name: "south", people: 97, last: 53 }, east = { name: "east", people: 0, last: null };
        const end = { why: "time", people: 100, left: 97, inside: 3, last: 53.04, exits: [south, east], density: null, falls: 0 };
        assert.deepEqual(endSentences(end), ["97 left by south, the last at 53 s; 3 are still inside."]);
        assert.deepEqual(endSentences({ ...end, left: 99, inside: 1, exits: [south, { ...east, people: 1 }] }),
            ["99 left (97 by south, 1 by east, 1 elsewhere), the last at 53 s; 1 is still inside."]);
        assert.deepEqual(endSentences({ ...end, left: 0, inside: 100, last: null }), ["100 people took part; nobody left."]);
        const failed = { ...end, why: "failed", failure: "a number is not finite", falls: 2, density: { most: 6.14, at: [16.94, 0.5], time: 28, where: ", in hall" } };
        assert.deepEqual(endSentences(failed), ["a number is not finite", "97 left by south, the last at 53 s; 3 are still inside.",
            "Greatest density: 6.14 people per m² (Gaussian, R = 1 m) at 28 s, at (16.9, 0.50) m, in hall – level of service F (Fruin).", "2 falls."]);
        const criteria = [{ name: "time", verdict: "met", figure: 38.456, limit: 45, unit: "s" }, { name: "hall", verdict: "not decided", figure: null, limit: 4, unit: "1/m2" },
            { name: "door", verdict: "not met", figure: 1.5, limit: 1.3, unit: "1/(m s)" }];
        assert.deepEqual(endSentences({ ...end, criteria }).slice(1),
            ["Criterion time: met (38.456, at most 45 s).", "Criterion hall: not decided.", "Criterion door: not met (1.5, at most 1.3 per m and s)."]);
    },
    "a reload is told by counts before and after": () => {
        const before = [{ state: "Wait", people: 0 }, { state: "Walk", people: 120 }, { state: "Old", people: 2 }];
        const after = [{ state: "Walk", people: 120 }, { state: "Sit", people: 0 }, { state: "Wait", people: 2 }];
        assert.equal(censusText({ before, after }), "Wait 0 → 2, Old 2 → 0 (gone), Sit 0 → 0 (new), Walk 120 → 120");
        const lines = newsLines({ machine: "m", before, after, notes: " memory 'seen' of 120 people is kept\n" });
        assert.deepEqual(lines.slice(1), ["Moved, because their state is gone: 2 from Old.", "Memory 'seen' of 120 people is kept."]);
        assert.deepEqual(newsLines({ done: "places, walls", later: "" }), ["Changed: places, walls."]);
    },
    "notes go when another error is saved, not when one is mended": () => {
        const a = { file: "walk.lua", line: 3, text: "no state 'Wlak'" }, b = { ...a, line: 4 };
        assert.deepEqual([[[], [a]], [[a], [a, b]], [[a], [b]]].map(([was, is]) => hasNewError(was, is)), [true, true, true]);
        assert.deepEqual([[[], []], [[a], []], [[a, b], [a]], [[a], [{ ...a }]]].map(([was, is]) => hasNewError(was, is)), [false, false, false, false]);
    },
    "a coarse density has no level of service": () => {
        assert.equal(densityText(0.9, 1), "0.90 per m² (Gaussian, R = 1 m), level of service D");
        assert.equal(densityText(0.6, 1.68), "0.60 per m² (Gaussian, R = 1.68 m), coarse, as people are far apart: no level of service");
    },
    "scenery of any size has finite triangles, and not too many": () => {
        const most = 400000, ends = [0.001, 1000], all = [[1, 1, 1], ...ends.flatMap((x) => ends.flatMap((y) => ends.map((z) => [x, y, z])))];
        for (const kind of [...Object.keys(STANDING), ...Object.keys(ALONG), "line", "ring", "area"]) {
            const corners = [[-3, -3], [-3, -3], [-2.999, -3], [2000, -3], [2000, 2000]];
            for (const size of all) {
                const { pile, paint, text } = buildScenery([{ kind, at: [[5, 2]], through: corners, turns: [30], size }], [], 1), what = `${kind} of ${size} m`;
                const bad = [pile.position, pile.normal, pile.where, pile.part, paint.position].some((rows) => !Number.isFinite(rows.values().reduce((sum, v) => sum + v, 0)));
                assert(!bad, `${what} has numbers that are not finite`);
                assert(pile.triangles + paint.triangles > 0, `${what} has no triangles`);
                assert(pile.triangles + paint.triangles < most && text === "", `${what} has ${pile.triangles} triangles`);
            }
        }
        assert.equal(buildScenery([{ kind: "fence", through: [[-3, -3], [-3, -3]], size: [0, 0.06, 1.1] }], [], 1).pile.triangles, 0);
    },
    "scenery beyond the limit is left out, counted and told": () => {
        const at = Array.from({ length: 60000 }, (_, i) => [i % 250, Math.floor(i / 250)]), turns = at.map(() => 0);
        const tree = { kind: "tree", at, turns, size: [4, 4, 6] }, items = [tree, { kind: "ring", at: [[0, 0]], size: [3, 3, 0] }];
        const one = buildScenery([{ ...tree, at: [[0, 0]] }], [], 1).pile.triangles, limit = 50000, fit = Math.floor(limit / one);
        const { pile, paint, left, text } = buildScenery(items, [], 1, limit);
        assert(limit < MOST_TRIANGLES);
        assert.equal(pile.triangles, fit * one);
        assert.equal(pile.rings.length, fit);
        assert.equal(paint.triangles, 0);
        assert.deepEqual([...left], [["tree", 60000 - fit], ["ring", 1]]);
        assert(text.startsWith("Scenery has more than 0.05 million triangles.") && text.includes(`Not drawn: ${60001 - fit} of its things (tree: ${60000 - fit}, ring: 1).`), text);
    },
};

const wanted = process.argv.slice(2);
let failed = 0;
for (const [name, test] of Object.entries(TESTS)) {
    if (wanted.length && !wanted.includes("modules")) continue;
    try {
        test();
        console.log(`ok ${name}`);
    } catch (error) {
        failed++;
        console.log(`not ok ${name}: ${error.message.split("\n")[0]}`);
    }
}
process.exitCode = failed ? 1 : 0;
