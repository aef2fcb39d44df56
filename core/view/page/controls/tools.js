// Tools: actions on the crowd by the pointer, or by Enter at the cross in the middle.
import { stroke } from "../draw/overlay.js";
import { pickBody, pickPerson } from "../draw/picking.js";

const HAND = 1.5; // m: height from which boxes are thrown
const SLOPE = (35 * Math.PI) / 180; // elevation of a throw's start, rad
const FASTEST = 20; // m/s
const NEWTONS = 250; // N of a push per metre that the pointer is dragged
const HARDEST = 1500; // N
const PERIOD = 50; // ms between commands of one gesture

export const TOOLS = {
    select: { name: "Look", key: "1", hint: "Click a person. Drag turns, right drag pans, the wheel zooms." },
    throw: { name: "Throw", key: "2", hint: "Press where a box starts, drag to where it should land, release." },
    drag: { name: "Drag", key: "3", hint: "Press a body and drag it along." },
    push: { name: "Push", key: "4", hint: `Press a person and drag: ${NEWTONS} N for each metre.` },
};

/** Velocity (m/s) with which a box thrown from `from` comes down at `to`, [x, y] in m, under `gravity`, m/s²; none: the fastest. */
export function throwTo(from, to, gravity, high = HAND) {
    const dx = to[0] - from[0], dy = to[1] - from[1], range = Math.hypot(dx, dy);
    if (range < 0.05) return [0, 0, 0];
    const cos = Math.cos(SLOPE), fall = range * Math.tan(SLOPE) + high;
    const speed = gravity > 0 ? Math.min(FASTEST, Math.sqrt((gravity * range * range) / (2 * cos * cos * fall))) : FASTEST;
    return [(speed * cos * dx) / range, (speed * cos * dy) / range, speed * Math.sin(SLOPE)];
}

/** Points of a flight under `gravity`, m/s², until the floor, every 1/30 s. */
function flight(from, velocity, gravity, high = HAND) {
    const out = [];
    for (let t = 0; t < 6; t += 1 / 30) {
        const z = high + velocity[2] * t - 0.5 * gravity * t * t;
        out.push([from[0] + velocity[0] * t, from[1] + velocity[1] * t, Math.max(0, z)]);
        if (z <= 0) break;
    }
    return out;
}

export class Tools {
    /** `page`: {view, crowd, overlay, connection, inspect(slot), box(): {size, mass}, gravity(), share()} */
    constructor(canvas, page) {
        this.page = page;
        this.canvas = canvas;
        this.gesture = null;
        canvas.addEventListener("pointerdown", (event) => this.down(event));
        canvas.addEventListener("pointermove", (event) => this.move(event));
        canvas.addEventListener("pointerup", (event) => this.up(event));
        canvas.addEventListener("pointercancel", () => this.cancel());
        canvas.addEventListener("focus", () => this.showCross(canvas.matches(":focus-visible")));
        canvas.addEventListener("blur", () => this.showCross(false));
    }

    get tool() {
        return this.page.view.tool;
    }

    showCross(on) {
        this.page.overlay.cross = on;
        this.page.overlay.stale = true;
    }

    spot(event) {
        const box = this.canvas.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
    }

    down(event) {
        this.showCross(false);
        if (event.button !== 0) return;
        const at = this.spot(event);
        this.start = at;
        if (this.tool === "select") return;
        if (this.begin(at)) this.canvas.setPointerCapture(event.pointerId);
    }

    /** Begins a gesture of the active tool at a CSS pixel; false if there is nothing to act on. */
    begin(at) {
        const { view, crowd } = this.page;
        if (this.tool === "throw") {
            const from = view.groundAt(...at);
            this.gesture = from && { kind: "throw", deck: from.deck, floor: from.z, from: from.at, to: from.at };
        } else if (this.tool === "drag") {
            const row = pickBody(view, crowd, view.bodies, ...at);
            if (row === null) return false;
            const { at: place, deck, high } = crowd.findBody(row), to = place.slice(0, 2);
            this.gesture = { kind: "drag", row, deck, high, floor: place[2], to };
            view.bodies.uniforms.chosen.value = row;
            this.page.connection.input("grab", row, ...view.storeys.toPlane(deck, to), high);
        } else if (this.tool === "push") {
            const slot = pickPerson(view, crowd, ...at, this.page.share());
            if (slot === null) return false;
            this.page.inspect(slot);
            this.gesture = { kind: "push", slot, floor: crowd.floor(slot, 1), to: crowd.position(slot, 1) };
        }
        this.gestureTimer = setInterval(() => this.repeat(), PERIOD);
        this.page.overlay.sketch = (pen, project) => this.sketch(pen, project);
        this.page.overlay.stale = true;
        return this.gesture !== null;
    }

    move(event) {
        if (!this.gesture) return;
        this.aim(this.spot(event));
    }

    aim(at) {
        const to = this.page.view.floorAt(...at, this.gesture.floor);
        if (to) this.gesture.to = to;
        this.page.overlay.stale = true;
    }

    /** Sends the repeated commands of a gesture. */
    repeat() {
        const g = this.gesture, { connection, crowd } = this.page;
        if (!g) return;
        if (g.kind === "drag") connection.input("drag", g.row, ...this.inPlane(g), g.high);
        if (g.kind === "push") {
            const force = this.force(), id = this.page.agentId(g.slot);
            if (!crowd.alive(g.slot)) this.cancel();
            else if (force && id !== null) {
                connection.input("push", id, ...force);
                g.sent = true;
            }
        }
    }

    /** Returns where a gesture leads to, as a position of the program's plane. */
    inPlane({ deck, to }) {
        return this.page.view.storeys.toPlane(deck, to);
    }

    /** Returns the force of the present push, N; null while the drag is too short. */
    force() {
        const at = this.page.crowd.position(this.gesture.slot, 1);
        if (!at) return null;
        const dx = this.gesture.to[0] - at[0], dy = this.gesture.to[1] - at[1], length = Math.hypot(dx, dy);
        if (length < 0.1) return null;
        const size = Math.min(HARDEST, NEWTONS * length) / length;
        return [dx * size, dy * size];
    }

    up(event) {
        const at = this.spot(event);
        if (this.gesture) return this.finish();
        // Only a click counts, not the end of a drag that turned the picture.
        if (this.start && Math.hypot(at[0] - this.start[0], at[1] - this.start[1]) < 5 && event.button === 0) {
            if (this.tool === "select") this.page.inspect(pickPerson(this.page.view, this.page.crowd, ...at, this.page.share()));
        }
        this.start = null;
        return undefined;
    }

    finish() {
        const g = this.gesture, { connection } = this.page;
        if (g.kind === "throw") this.release(g.deck, g.from, this.throwTo(g.from, g.to));
        if (g.kind === "drag") {
            connection.input("drag", g.row, ...this.inPlane(g), g.high);
            connection.input("release", g.row);
        }
        this.cancel(true);
    }

    throwTo(from, to) {
        return throwTo(from, to, this.page.gravity());
    }

    release(deck, from, velocity) {
        const { size, mass } = this.page.box();
        this.page.connection.input("box", ...this.page.view.storeys.toPlane(deck, from), HAND, ...velocity, size, mass);
    }

    cancel(done = false) {
        if (!done && this.gesture?.kind === "drag") this.page.connection.input("release", this.gesture.row);
        clearInterval(this.gestureTimer);
        this.gesture = null;
        this.page.overlay.sketch = null;
        this.page.view.bodies.uniforms.chosen.value = -1;
        this.page.view.dirty = true;
    }

    /** Enter or Space on the picture: acts at its middle. A throw goes 5 m away from the eye. */
    act() {
        const { view } = this.page, at = [view.wide / 2, view.high / 2];
        if (this.tool === "select") {
            return this.page.inspect(pickPerson(view, this.page.crowd, ...at, this.page.share(), 80));
        }
        const ahead = view.camera.getWorldDirection(view.camera.position.clone());
        const flat = Math.hypot(ahead.x, ahead.y), unit = flat > 0.01 ? [ahead.x / flat, ahead.y / flat] : [0, 1];
        const onto = view.groundAt(...at);
        if (this.tool === "throw" && onto) {
            const from = [onto.at[0] - 5 * unit[0], onto.at[1] - 5 * unit[1]];
            return this.release(onto.deck, from, this.throwTo(from, onto.at));
        }
        if (!this.begin(at)) return undefined;
        const g = this.gesture;
        g.to = [g.to[0] + 2 * unit[0], g.to[1] + 2 * unit[1]];
        this.keyTimer = setTimeout(() => this.gesture === g && this.finish(), 1000);
        return undefined;
    }

    sketch(pen, project) {
        const g = this.gesture;
        if (!g) return;
        if (g.kind === "throw") {
            const velocity = this.throwTo(g.from, g.to), path = flight(g.from, velocity, this.page.gravity()).map(([x, y, z]) => [x, y, g.floor + z]);
            for (const [style, wide] of [["#000000a0", 5], ["#ffd21f", 2.5]]) {
                stroke(pen, path.map((p) => project(...p)), style, wide);
                stroke(pen, [project(...g.from, g.floor), project(...g.from, g.floor + HAND)], style, wide);
            }
            const end = project(...path[path.length - 1]);
            if (end) this.page.overlay.tag(`${Math.hypot(...velocity).toFixed(1)} m/s`, [end[0], end[1] - 16]);
        } else if (g.kind === "push") {
            const at = this.page.crowd.position(g.slot, 1), force = this.force();
            if (!at || !force) return;
            const high = g.floor + 1.1;
            this.page.overlay.arrow([...at, high], [...g.to, high], "#ffd21f");
            const tip = project(...g.to, high);
            if (tip) this.page.overlay.tag(`${Math.hypot(...force).toFixed(0)} N`, [tip[0], tip[1] - 16]);
        } else {
            const at = this.page.crowd.bodyPosition(g.row);
            if (at) this.page.overlay.arrow(at, [...g.to, g.floor], "#ffd21f");
        }
    }
}
