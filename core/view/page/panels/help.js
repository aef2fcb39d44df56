// The list of keys, and times that the page spends; shown by `?`.
import { byId, el, fill, figure, moveFocus, say } from "../dom.js";

export const KEYS = [
    ["Space", "stop and go on"], [".", "one step"], ["1 2 3 4", "tools: look, throw, drag, push"],
    ["T", "from above"], ["F", "follow the chosen person"], ["H", "the whole scene"], ["N", "names: all, none, some"], ["S", "storeys: stacked, exploded, one"], ["PageUp PageDown", "storey above, below"], ["A", "what the scene is about"],
    ["C", "next colour"], ["D", "next field on the floor"], ["P", "picture as PNG"],
    ["← ↑ → ↓", "move the eye"], ["Q E", "turn"], ["R V", "rise and sink"], ["+ −", "nearer and farther"],
    ["Enter", "with the picture in focus: act at its middle"], ["Esc", "let go, close"], ["?", "this"],
];

/** Times of the last 120 pictures, ms: of the script, and of the graphics calls, which include waiting for the card. */
export class Meter {
    constructor() {
        this.spent = [];
        this.calls = [];
        this.messages = 0; // ms spent on messages since the last picture
        this.pictures = 0;
    }

    /** Notes a picture of `ms`, `calls` of it in graphics calls; the messages before it count as script. */
    add(ms, calls) {
        this.spent.push(ms - calls + this.messages);
        this.calls.push(calls);
        this.messages = 0;
        this.pictures++;
        if (this.spent.length > 120) this.spent.shift();
        if (this.calls.length > 120) this.calls.shift();
    }

    /** {median, high, most} of the script, and of the calls, ms; 90 % of pictures take at most `high`. */
    get(times = this.spent) {
        const sorted = [...times].sort((a, b) => a - b), at = (share) => sorted[Math.floor(share * (sorted.length - 1))] ?? 0;
        return { median: at(0.5), high: at(0.9), most: at(1) };
    }
}

export class Help {
    /** `page`: {meter, view, connection} */
    constructor(page) {
        this.page = page;
        this.node = byId("help");
        this.parts = Object.fromEntries(["script", "calls", "draws", "pictures", "frames", "slots"].map((k) => [k, el("dd", {}, "–")]));
        const names = { script: "script a picture", calls: "graphics calls", draws: "draw calls", pictures: "pictures a second", frames: "frames received", slots: "slots" };
        this.close = el("button", { type: "button", className: "close", "aria-label": "Close the list of keys", title: "Close (Esc)", onclick: () => this.toggle(false) }, "×");
        moveFocus(this.node, "dialog");
        fill(this.node, this.close, el("h2", { id: "help-title" }, "Keys"), el("dl", {}, KEYS.map(([key, text]) => [el("dt", {}, el("kbd", {}, key)), el("dd", {}, text)])),
            el("h2", {}, "Measured"), el("dl", {}, Object.entries(this.parts).map(([k, dd]) => [el("dt", {}, names[k]), dd])));
        setInterval(() => this.measure(), 1000);
    }

    toggle(on = this.node.hidden) {
        if (on === !this.node.hidden) return;
        if (on) this.before = document.activeElement;
        this.node.hidden = !on;
        if (!on) return void this.before?.focus?.(); // back to where the focus was
        this.close.focus();
        this.measure();
    }

    measure() {
        const { meter, view, connection } = this.page, now = performance.now();
        const passed = (now - (this.at ?? now - 1000)) / 1000;
        const pictures = (meter.pictures - (this.pictures ?? 0)) / passed;
        const frames = (connection.frames - (this.frames ?? 0)) / passed, bytes = (connection.bytes - (this.bytes ?? 0)) / passed;
        this.at = now;
        this.pictures = meter.pictures;
        this.frames = connection.frames;
        this.bytes = connection.bytes;
        if (this.node.hidden) return;
        const told = (t) => `${t.median.toFixed(1)} ms median, ${t.high.toFixed(1)} ms for 90 %`;
        say(this.parts.script, told(meter.get()));
        say(this.parts.calls, told(meter.get(meter.calls)));
        say(this.parts.draws, `${view.renderer.info.render.calls}, ${figure(view.renderer.info.render.triangles)} triangles`);
        say(this.parts.pictures, pictures.toFixed(0));
        say(this.parts.frames, `${frames.toFixed(0)} a second, ${(bytes / 1e6).toFixed(1)} MB/s`);
        say(this.parts.slots, figure(view.crowd.next?.slots ?? 0));
    }
}
