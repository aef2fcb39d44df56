// Keys, and how long the page takes: shown by `?`.
import { byId, el, fill, figure, say } from "../dom.js";

const KEYS = [
    ["Space", "stop and go on"], [".", "one step"], ["1 2 3 4", "tools: look, throw, drag, push"],
    ["T", "from above"], ["F", "follow the chosen person"], ["H", "the whole scene"], ["N", "names"],
    ["C", "next colour"], ["D", "next field on the floor"], ["P", "picture as PNG"],
    ["← ↑ → ↓", "move the eye"], ["Q E", "turn"], ["R V", "rise and sink"], ["+ −", "nearer and farther"],
    ["Enter", "with the picture in focus: act at its middle"], ["Esc", "let go, close"], ["?", "this"],
];

/** Times of the script part of pictures, in ms, over the last second. */
export class Meter {
    constructor() {
        this.spent = [];
        this.messages = 0; // ms spent on messages since the last picture
        this.pictures = 0;
    }

    /** One picture took `ms` of script, with the messages before it. */
    add(ms) {
        this.spent.push(ms + this.messages);
        this.messages = 0;
        this.pictures++;
        if (this.spent.length > 120) this.spent.shift();
    }

    /** {mean, most, median}, ms */
    get() {
        const sorted = [...this.spent].sort((a, b) => a - b), n = sorted.length;
        return { mean: sorted.reduce((a, b) => a + b, 0) / (n || 1), most: sorted[n - 1] ?? 0, median: sorted[n >> 1] ?? 0 };
    }
}

export class Help {
    /** `page`: {meter, view, connection} */
    constructor(page) {
        this.page = page;
        this.node = byId("help");
        this.parts = Object.fromEntries(["script", "draws", "pictures", "frames", "slots"].map((k) => [k, el("dd", {}, "–")]));
        const names = { script: "script a picture", draws: "draw calls", pictures: "pictures a second", frames: "frames received", slots: "slots" };
        fill(this.node, el("h2", {}, "Keys"), el("dl", {}, KEYS.map(([key, text]) => [el("dt", {}, el("kbd", {}, key)), el("dd", {}, text)])),
            el("h2", {}, "Measured"), el("dl", {}, Object.entries(this.parts).map(([k, dd]) => [el("dt", {}, names[k]), dd])));
        setInterval(() => this.measure(), 1000);
    }

    toggle(on = this.node.hidden) {
        this.node.hidden = !on;
        if (on) this.measure();
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
        const t = meter.get();
        say(this.parts.script, `${t.median.toFixed(1)} ms median, ${t.most.toFixed(1)} ms at most`);
        say(this.parts.draws, `${view.renderer.info.render.calls}, ${figure(view.renderer.info.render.triangles)} triangles`);
        say(this.parts.pictures, pictures.toFixed(0));
        say(this.parts.frames, `${frames.toFixed(0)} a second, ${(bytes / 1e6).toFixed(1)} MB/s`);
        say(this.parts.slots, figure(view.crowd.next?.slots ?? 0));
    }
}
