// The time bar of a recording.
import { byId, clock, el, fill, say } from "../dom.js";

const PERIOD = 80; // ms between seeks while the bar is dragged

export class Replay {
    constructor(send) {
        this.send = send;
        this.node = byId("replay");
        this.bar = el("input", { type: "range", min: 0, max: 1, step: "any", value: 0, "aria-label": "Time in the recording, s" });
        this.at = el("output", {}, "0:00.0");
        this.end = el("span", { className: "faint" });
        this.bar.addEventListener("input", () => this.seek(Number(this.bar.value)));
        this.bar.addEventListener("keydown", (event) => this.key(event));
        fill(this.node, this.at, this.bar, this.end);
    }

    /** Whole seconds by arrow keys, tens by Page Up and Down. */
    key(event) {
        const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageUp: 10, PageDown: -10 }[event.key];
        if (step === undefined) return;
        event.preventDefault();
        this.bar.value = Number(this.bar.value) + step;
        this.seek(Number(this.bar.value));
    }

    set(scene) {
        this.node.hidden = scene.session !== "replay";
    }

    seek(time) {
        say(this.at, clock(time));
        this.held = performance.now();
        this.wanted = time;
        this.timer ??= setTimeout(() => {
            this.timer = null;
            this.send({ do: "seek", time: this.wanted });
        }, PERIOD);
    }

    /** Takes a `time` message; ignored while the bar is dragged. */
    take({ from, until, at }) {
        this.bar.min = from;
        this.bar.max = until;
        say(this.end, clock(until));
        if (performance.now() - (this.held ?? -Infinity) < 600) return;
        this.bar.value = at;
        this.bar.setAttribute("aria-valuetext", clock(at));
        say(this.at, clock(at));
    }
}

/** Returns what the frames of a recording tell of the person in a slot; null once they have left. */
export function seePerson({ storeys }, crowd, scene, slot) {
    const at = crowd.position(slot, 1);
    if (!at) return null;
    const from = crowd.position(slot, 0) ?? at, passed = crowd.next.time - crowd.previous.time;
    return {
        slot, time: crowd.next.time, x: at[0], y: at[1], ...(storeys.several ? { storey: storeys.decks[crowd.deck(slot)].name, height: crowd.elevation(slot) } : {}), radius: crowd.radius(slot), torso: crowd.torso(slot),
        speed: passed > 0 ? Math.hypot(at[0] - from[0], at[1] - from[1]) / passed : NaN,
        state: scene.states?.[crowd.next.bytes[8 * slot + 5]]?.name, group: scene.groups?.[crowd.group(slot)]?.name,
    };
}
