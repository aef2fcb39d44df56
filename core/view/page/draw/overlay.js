// The two-dimensional overlay of the picture: names, the chosen person, arrows of
// forces, the path of a throw. One canvas, so that it costs the 3-D picture no draw call.
import { say } from "../dom.js";

export const FORCE_COLOURS = {
    push: "#e69f00", contact: "#d55e00", deceleration: "#56b4e9", resistance: "#cc79a7",
    external: "#f0e442", body: "#009e73", feet: "#0072b2",
};
const METRES_OF_NEWTON = 1 / 150; // an arrow of 1 m is 150 N
const NEAR = 36; // CSS pixels from the pointer, within which a name is shown
const MOST_NAMES = 8; // shown where nobody asked for names
const TINY = 28; // CSS pixels: places that look smaller get no name then
const WAY_OUT = /exit|door|gate|ausgang|sortie|salida/i; // names of places that are told first
const FONT = "600 12px system-ui, sans-serif";

export class Overlay {
    constructor(canvas, view, crowd) {
        this.canvas = canvas;
        this.view = view;
        this.crowd = crowd;
        this.pen = canvas.getContext("2d");
        this.labels = [];
        this.ranked = []; // labels, those first that are told first
        this.names = "some"; // "all", "some": as many as have room, or "none": only the one under the pointer
        this.playing = false; // a person plays: names that nobody asked for are not shown
        this.covered = []; // nodes over the picture that names keep clear of
        this.pointer = null; // CSS pixels
        this.chosen = null; // slot
        this.forces = null; // forces on the chosen person
        this.players = []; // slots
        this.stale = false; // something changed that only this draws: it is drawn anew though the picture is not
        this.sketch = null; // drawing of the active tool: function(pen, project)
        this.marks = null; // drawing of a game's marks: function(pen)
        this.cross = false; // whether the cross in the middle is shown, for use by keys
        this.blank = true; // nothing is on the canvas
    }

    /** Takes a scene message as storeys have unfolded it. */
    set(scene) {
        this.scene = scene;
        this.labels = this.storeyLabels();
        for (const place of scene.places ?? []) {
            if (place.kind !== "set" && place.points?.length) this.label(place, { text: place.name, at: middle(place), box: boxAround(place.points, place.radius ?? 0) });
        }
        for (const { name, points, deck } of scene.areas ?? []) {
            this.label({ deck }, { text: name, at: middle({ points, kind: "polygon" }), box: boxAround(points, 0), faint: true });
        }
        for (const wall of scene.walls ?? []) {
            if (wall.name) this.label(wall, { text: wall.name, at: middle({ points: wall.points, kind: "line" }), high: wall.height || 2, box: boxAround(wall.points, 0), gate: true });
        }
        // Ways out come first, then large places; names that several gates share are told once.
        const first = (label) => (label.storey ? -1 : label.gate ? 0 : WAY_OUT.test(label.text) ? 1 : label.faint ? 3 : 2);
        this.ranked = this.labels.filter((label, i) => this.labels.findIndex((other) => other.text === label.text) === i)
            .sort((a, b) => first(a) - first(b) || b.box.size - a.box.size);
        this.drawn = "";
    }

    /** Adds a label of something on a deck, unless that is not shown. */
    label({ deck = 0 }, { at, high = 0, ...label }) {
        const { storeys } = this.view;
        if (storeys.drawnDecks[deck]?.shown) this.labels.push({ ...label, at: [...at, storeys.heightAt(deck, at) + high] });
    }

    /** Labels of storeys, at a corner of their floors, and of stairs and lifts. */
    storeyLabels() {
        const { storeys } = this.view, out = [];
        if (!storeys.several) return out;
        storeys.list.forEach(({ name }, k) => {
            const points = storeys.outlines[k].flat();
            if (!storeys.isShown(k) || points.length === 0) return;
            const corner = points.reduce((best, p) => (p[0] + p[1] < best[0] + best[1] ? p : best));
            out.push({ text: name, at: [...corner, storeys.at[k]], box: boxAround(points, 0), storey: true });
        });
        const add = (text, points, z) => out.push({ text, at: [...middle({ points, kind: "polygon" }), z], box: boxAround(points, 0), faint: true });
        storeys.decks.forEach(({ stair, name, lower, upper }, deck) => {
            if (stair && lower < upper && storeys.drawnDecks[deck].shown) add(name, stair.outline, (storeys.at[lower] + storeys.at[upper]) / 2);
        });
        for (const { name, outline, stops } of storeys.lifts) if (storeys.isShown(stops[0].storey, stops.at(-1).storey)) add(name, outline, storeys.at[Math.max(stops[0].storey, Math.min(storeys.chosen, stops.at(-1).storey))]);
        return out;
    }

    /** Takes over that storeys are shown in another way. */
    place() {
        if (this.scene) this.set(this.scene);
    }

    theme(dark) {
        this.dark = dark;
    }

    resize() {
        this.canvas.width = Math.round(this.view.wide * this.view.screenRatio);
        this.canvas.height = Math.round(this.view.high * this.view.screenRatio);
        this.blank = true;
    }

    draw(share) {
        this.stale = false;
        const pen = this.pen, ratio = this.view.screenRatio;
        const still = this.players.length === 0 && this.chosen === null && !this.sketch && !this.cross && !this.marks;
        const blank = still && this.shownNames() === "none" && !this.pointer;
        const stamp = still && !blank ? this.stamp() : "";
        if ((blank && this.blank) || (stamp && stamp === this.drawn)) return; // clearing takes time, too, when the processor draws
        this.blank = blank;
        this.drawn = stamp;
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        pen.clearRect(0, 0, this.view.wide, this.view.high);
        pen.font = FONT;
        pen.textAlign = "center";
        pen.textBaseline = "middle";
        if (this.shownNames() !== "none" || this.pointer) this.drawLabels();
        for (const slot of this.players) if (slot !== this.chosen) this.drawRing(slot, share, this.dark ? "#ffffff" : "#0072b2", this.playing ? null : "player");
        if (this.chosen !== null) this.drawChosen(share);
        this.marks?.(pen);
        this.sketch?.(pen, (x, y, z) => this.view.project(x, y, z));
        if (this.cross && !this.marks) this.drawCross();
    }

    /** What names depend on where nothing else is drawn: the camera, the window, the pointer. */
    stamp() {
        const { camera, wide, high, ratio } = this.view;
        return [this.shownNames(), this.dark, wide, high, ratio, this.pointed, ...camera.matrixWorldInverse.elements, ...camera.projectionMatrix.elements].join();
    }

    /** Sets the position of the pointer, CSS pixels, or null; true if another name has to be shown. */
    point(at) {
        this.pointer = at;
        const near = this.names === "all" || !at ? -1 : this.labels.findIndex((label) => this.near(this.view.project(label.at[0], label.at[1], label.at[2] ?? 0)));
        const changed = near !== this.pointed;
        this.pointed = near;
        return changed;
    }

    near(spot) {
        return spot !== null && this.pointer !== null && Math.hypot(spot[0] - this.pointer[0], spot[1] - this.pointer[1]) < NEAR;
    }

    /** "all", "some" or "none": during a game only names that were asked for. */
    shownNames() {
        return this.playing && this.names === "some" ? "none" : this.names;
    }

    drawLabels() {
        const { wide, high } = this.view, names = this.shownNames();
        const kept = this.covered.map((n) => [n.offsetLeft, n.offsetTop, n.offsetLeft + n.offsetWidth, n.offsetTop + n.offsetHeight]), taken = [...kept];
        const meets = (a, b) => b[0] < a[2] && b[2] > a[0] && b[1] < a[3] && b[3] > a[1];
        let some = 0;
        for (const label of names === "some" ? [...this.ranked, ...this.labels] : this.labels) {
            const spot = this.view.project(label.at[0], label.at[1], label.at[2] ?? 0);
            if (!spot || spot[0] < 0 || spot[1] < 0 || spot[0] > wide || spot[1] > high) continue;
            const half = this.pen.measureText(label.text).width / 2 + 8;
            const box = [spot[0] - half, spot[1] - 12, spot[0] + half, spot[1] + 12];
            const under = kept.find((b) => meets(box, b));
            if (under) { // beside what covers it
                spot[0] -= box[2] - under[0] + 2;
                [box[0], box[2]] = [spot[0] - half, spot[0] + half];
            }
            const asked = names === "all" || this.near(spot);
            if (!asked && (names === "none" || some >= MOST_NAMES || box[0] < 0 || box[2] > wide || this.isTiny(label))) continue;
            if (taken.some((b) => meets(box, b)) || this.view.isCovered(label.at)) continue;
            taken.push(box);
            if (!asked) some++;
            this.tag(label.text, spot, this.nameColour(label));
        }
    }

    /** Returns whether what a label names looks too small for a name that nobody asked for. */
    isTiny({ box, at }) {
        const corners = box.corners.map(([x, y]) => this.view.project(x, y, at[2] ?? 0));
        if (corners.some((c) => !c)) return false; // partly behind the eye: near
        const span = (k) => Math.max(...corners.map((c) => c[k])) - Math.min(...corners.map((c) => c[k]));
        return Math.max(span(0), span(1)) < TINY;
    }

    nameColour(label) {
        if (label.storey) return this.dark ? "#ffffff" : "#20242a";
        if (label.gate) return this.dark ? "#ffab73" : "#a63d00";
        if (label.faint) return this.dark ? "#a5afbc" : "#5a6370";
        return this.dark ? "#6cc0f5" : "#0062a0";
    }

    /** Draws a label on a plate. */
    tag(text, [x, y], colour = this.dark ? "#e8ecf1" : "#20242a") {
        const pen = this.pen, wide = pen.measureText(text).width + 10;
        pen.fillStyle = this.dark ? "rgb(18 21 25 / 78%)" : "rgb(255 255 255 / 84%)";
        roundRect(pen, x - wide / 2, y - 9, wide, 18, 4);
        pen.fill();
        pen.fillStyle = colour;
        pen.fillText(text, x, y + 0.5);
    }

    drawRing(slot, share, colour, text) {
        const spot = this.crowd.position(slot, share), floor = this.crowd.floor(slot, share);
        if (!spot || Number.isNaN(floor)) return null;
        const at = [...spot, floor], r = this.crowd.reach(slot) + 0.15;
        const path = Array.from({ length: 33 }, (_, i) => [at[0] + r * Math.cos((i * Math.PI) / 16), at[1] + r * Math.sin((i * Math.PI) / 16), floor + 0.03]);
        stroke(this.pen, path.map((p) => this.view.project(...p)), "#000000a0", 5);
        stroke(this.pen, path.map((p) => this.view.project(...p)), colour, 2.5);
        const head = this.view.project(at[0], at[1], floor + 2.1);
        if (head && text) this.tag(text, [head[0], head[1] - 24]);
        return at;
    }

    drawChosen(share) {
        const at = this.drawRing(this.chosen, share, "#ffd21f", null);
        const spot = at && this.view.project(at[0], at[1], at[2] + 1.9);
        if (spot) { // so that one person is found in a crowd seen from afar
            stroke(this.pen, [[spot[0] - 7, spot[1] - 16], [spot[0], spot[1] - 5], [spot[0] + 7, spot[1] - 16]], "#000000a0", 6);
            stroke(this.pen, [[spot[0] - 7, spot[1] - 16], [spot[0], spot[1] - 5], [spot[0] + 7, spot[1] - 16]], "#ffd21f", 3);
        }
        if (!at || !this.forces) return;
        for (const force of this.forces) {
            const size = Math.hypot(force.fx, force.fy);
            if (size < 1) continue;
            const k = METRES_OF_NEWTON * Math.min(1, 600 / size);
            this.arrow([at[0], at[1], at[2] + 1.2], [at[0] + k * force.fx, at[1] + k * force.fy, at[2] + 1.2], FORCE_COLOURS[force.kind] ?? "#999999");
        }
    }

    /** An arrow between two points of the scene, m. */
    arrow(from, to, colour) {
        const a = this.view.project(...from), b = this.view.project(...to);
        if (!a || !b) return;
        const angle = Math.atan2(b[1] - a[1], b[0] - a[0]), head = Math.min(10, 0.6 * Math.hypot(b[0] - a[0], b[1] - a[1]));
        const wing = (turn) => [b[0] - head * Math.cos(angle + turn), b[1] - head * Math.sin(angle + turn)];
        for (const [style, wide] of [["#000000b0", 5], [colour, 3]]) {
            stroke(this.pen, [a, b], style, wide);
            stroke(this.pen, [wing(0.5), b, wing(-0.5)], style, wide);
        }
    }

    drawCross() {
        const x = this.view.wide / 2, y = this.view.high / 2;
        for (const [style, wide] of [["#000000b0", 4], ["#ffffff", 2]]) {
            stroke(this.pen, [[x - 12, y], [x + 12, y]], style, wide);
            stroke(this.pen, [[x, y - 12], [x, y + 12]], style, wide);
        }
    }
}

/** Draws a line through points of the screen, interrupted at null. */
export function stroke(pen, points, style, width) {
    pen.strokeStyle = style;
    pen.lineWidth = width;
    pen.lineCap = pen.lineJoin = "round";
    pen.beginPath();
    let down = false;
    for (const p of points) {
        if (!p) down = false;
        else if (down) pen.lineTo(p[0], p[1]);
        else {
            pen.moveTo(p[0], p[1]);
            down = true;
        }
    }
    pen.stroke();
}

function roundRect(pen, x, y, wide, high, r) {
    pen.beginPath();
    pen.moveTo(x + r, y);
    pen.arcTo(x + wide, y, x + wide, y + high, r);
    pen.arcTo(x + wide, y + high, x, y + high, r);
    pen.arcTo(x, y + high, x, y, r);
    pen.arcTo(x, y, x + wide, y, r);
    pen.closePath();
}

/** Returns the corners of the box around points, `more` m wider, and its size, m. */
function boxAround(points, more) {
    const [low, high] = [Math.min, Math.max].map((of, side) => [0, 1].map((k) => of(...points.map((p) => p[k])) + (side ? more : -more)));
    return { corners: [low, [high[0], low[1]], high, [low[0], high[1]]], size: Math.hypot(high[0] - low[0], high[1] - low[1]) };
}

/** Returns where a place's name is written: inside a polygon, at the middle of a line. */
function middle({ points, kind }) {
    if (kind === "line" || kind === "queue") {
        const a = points[0], b = points[points.length - 1];
        return kind === "queue" ? a.slice(0, 2) : [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    }
    let x = 0, y = 0;
    for (const p of points) {
        x += p[0] / points.length;
        y += p[1] / points.length;
    }
    return [x, y];
}

/** Describes the picture in words, for screen readers. */
export function describe(node, status) {
    say(node, `${status.agents} agents and ${status.bodies} bodies at ${status.time.toFixed(0)} seconds`);
}
