// The bars: time, figures, tools, view. Keys of the whole page.
import { byId, clock, el, figure, fill, say } from "../dom.js";
import { COLOURS, FIELDS } from "../draw/palette.js";
import { TOOLS } from "./tools.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16];

/** Pause, step, speed, restart and seed. `send` takes commands. */
export class TimeBar {
    constructor(send) {
        this.send = send;
        this.paused = false;
        this.pause = el("button", { type: "button", onclick: () => this.toggle(), className: "main" }, "Pause");
        this.step = el("button", { type: "button", title: "One step (.)", onclick: () => this.stepOnce() }, "Step");
        this.speed = el("select", { onchange: () => send({ do: "speed", factor: Number(this.speed.value) }) },
            SPEEDS.map((s) => el("option", { value: String(s), selected: s === 1 }, `${s} ×`)));
        this.seed = el("input", { type: "number", min: 0, step: 1, title: "Seed of the next start" });
        this.restart = el("button", { type: "button", title: "Start again with this seed", onclick: () => this.again() }, "Restart");
        fill(byId("time"), this.pause, this.step, el("label", {}, el("span", { className: "faint" }, "Speed"), this.speed));
        this.live = [el("label", {}, el("span", { className: "faint" }, "Seed"), this.seed), this.restart];
        byId("time").append(...this.live);
    }

    set(scene) {
        const live = scene.session !== "replay";
        for (const node of this.live) node.hidden = !live;
        if (document.activeElement !== this.seed) this.seed.value = scene.seed ?? "";
    }

    toggle() {
        this.show(!this.paused);
        this.send({ do: "pause", on: this.paused });
    }

    stepOnce() {
        if (!this.paused) this.toggle();
        this.send({ do: "step", n: 1 });
    }

    again() {
        const seed = Number(this.seed.value);
        const given = this.seed.value !== "" && Number.isInteger(seed) && seed >= 0;
        this.send(given ? { do: "restart", seed } : { do: "restart" });
    }

    show(paused) {
        this.paused = paused;
        say(this.pause, paused ? "Play" : "Pause");
        this.pause.title = paused ? "Go on (Space)" : "Stop the time (Space)";
    }

    take(status) {
        this.show(Boolean(status.paused));
        if (document.activeElement !== this.speed && status.speed) {
            const value = String(status.speed);
            if (![...this.speed.options].some((o) => o.value === value)) this.speed.append(el("option", { value }, `${value} ×`));
            this.speed.value = value;
        }
    }
}

/** Time, pace against real time, numbers of agents and bodies. */
export class Figures {
    constructor() {
        this.parts = {};
        const pairs = [["time", "Time"], ["rate", "Pace"], ["agents", "Agents"], ["bodies", "Bodies"]];
        fill(byId("figures"), pairs.map(([key, name]) => el("div", {}, el("dt", {}, name), (this.parts[key] = el("dd", {}, "–")))));
    }

    take(status) {
        say(this.parts.time, clock(status.time));
        say(this.parts.rate, `${figure(status.real_time_factor)} ×`);
        say(this.parts.agents, figure(status.agents));
        say(this.parts.bodies, figure(status.bodies));
    }
}

/** Tools and what is shown. `page`: {tool(name), colour(by), field(of), top(), home(), follow(), picture(), names(), help()} */
export class ToolBar {
    constructor(page) {
        this.page = page;
        this.bar = byId("tools");
        this.tools = {};
        this.choice = el("div", { className: "group", role: "group", "aria-label": "Tool" });
        this.colour = this.select(COLOURS, "state", (by) => page.colour(by));
        this.field = this.select(FIELDS, "none", (of) => page.field(of));
        this.top = this.button("From above", "Look straight down (T)", () => page.top(), true);
        this.follow = this.button("Follow", "Follow the chosen person (F)", () => page.follow(), true);
        this.names = this.button("Names", "Names of places and gates (N)", () => page.names(), true);
        const view = el("div", { className: "group", role: "group", "aria-label": "View" }, this.top, this.follow,
            this.button("Whole scene", "Everything in sight (H)", () => page.home()), this.names,
            this.button("Picture", "Save what is seen as a PNG (P)", () => page.picture()),
            this.button("?", "Keys, and how long drawing takes", () => page.help()));
        fill(this.bar, this.choice, el("label", {}, el("span", { className: "faint" }, "Colour by"), this.colour),
            el("label", {}, el("span", { className: "faint" }, "Floor"), this.field), view);
        this.bar.querySelector("button:last-child").setAttribute("aria-label", "Keys and measurements");
    }

    select(choices, chosen, change) {
        const node = el("select", {}, Object.entries(choices).map(([value, c]) => el("option", { value, selected: value === chosen }, c.name)));
        node.addEventListener("change", () => change(node.value));
        return node;
    }

    button(text, title, onclick, toggles = false) {
        return el("button", { type: "button", title, onclick, "aria-pressed": toggles ? "false" : null }, text);
    }

    set(scene) {
        const offered = ["select", ...["throw", "drag", "push"].filter((name) => scene.tools?.[name])];
        this.tools = Object.fromEntries(offered.map((name) => [name, this.button(
            TOOLS[name].name, `${TOOLS[name].hint} (${TOOLS[name].key})`, () => this.page.tool(name), true)]));
        fill(this.choice, Object.values(this.tools));
        this.choice.hidden = offered.length === 1;
    }

    show(tool) {
        for (const [name, button] of Object.entries(this.tools)) button.setAttribute("aria-pressed", String(name === tool));
    }
}

/** Keys that work wherever the focus is, unless one types: {key: function}. */
export function bindKeys(keys, player, typing) {
    window.addEventListener("keydown", (event) => {
        if (typing(event) || event.ctrlKey || event.metaKey || event.altKey) return;
        const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
        // Buttons and tabs keep the keys that belong to them.
        const own = event.target instanceof HTMLElement && event.target.closest("button, [role=tab], [role=button], input");
        if (own && /^( |Enter|Arrow\w+)$/.test(event.key)) return undefined;
        if (player.key(event, true)) return event.preventDefault();
        if (keys[name]?.(event) !== undefined) event.preventDefault();
        return undefined;
    });
    window.addEventListener("keyup", (event) => player.key(event, false));
}
