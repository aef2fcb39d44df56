// The contents of the bar (time, tools, view, figures), and the keys of the page.
import { byId, clock, el, figure, fill, say } from "../dom.js";
import { iconButton, iconLabel } from "./bar.js";
import { icon } from "./icons.js";
import { COLOURS, FIELDS } from "../draw/palette.js";
import { TOOLS } from "./tools.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16];

// Ranks: if the bar is too narrow, the controls with the highest rank go into the menu first.
export const WORDS = 10.5; // rank at which buttons lose their words
const RANK = { step: 0.5, top: 1, speed: 2, time: 3, home: 4, colour: 5, field: 6, names: 7, follow: 8, picture: 9, help: 10, bodies: 11, seed: 12 };

/** Pause, step, speed, restart and seed. `send` takes commands. */
export class TimeBar {
    constructor(send, bar) {
        this.send = send;
        this.bar = bar;
        this.paused = null;
        this.pause = el("button", { type: "button", onclick: () => this.toggle(), className: "main iconed" });
        this.step = iconButton("step", "Step", "One step (.)", () => this.stepOnce());
        this.speed = el("select", { onchange: () => send({ do: "speed", factor: Number(this.speed.value) }) },
            SPEEDS.map((s) => el("option", { value: String(s), selected: s === 1 }, `${s} ×`)));
        this.seed = el("input", { type: "number", min: 0, step: 1, title: "Seed of the next start" });
        this.restart = iconButton("restart", "Restart", "Start again with this seed", () => this.again());
        bar.add(byId("time"), this.pause);
        bar.add(byId("time"), this.step, RANK.step);
        bar.add(byId("time"), this.restart);
        bar.add(byId("time"), el("label", { title: "Speed" }, el("span", { className: "words" }, "Speed"), this.speed), RANK.speed);
        this.live = [this.restart, bar.add(byId("time"), el("label", {}, el("span", { className: "faint" }, "Seed"), this.seed), RANK.seed)];
        this.show(false);
    }

    set(scene) {
        for (const node of this.live) node.hidden = !scene.restarts;
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
        if (paused === this.paused) return;
        this.paused = paused;
        fill(this.pause, icon(paused ? "play" : "pause"), el("span", { className: "words" }, paused ? "Play" : "Pause"));
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
    constructor(bar) {
        this.parts = {};
        const list = (pairs) => el("dl", { className: "figures" }, pairs.map(([key, name]) =>
            el("div", {}, el("dt", {}, name), (this.parts[key] = el("dd", { className: key }, "–")))));
        bar.add(byId("figures"), list([["time", "Time"]]), RANK.time);
        bar.add(byId("figures"), list([["rate", "Pace"], ["agents", "Agents"]]));
        bar.add(byId("figures"), list([["bodies", "Bodies"]]), RANK.bodies);
    }

    take(status) {
        say(this.parts.time, clock(status.time));
        say(this.parts.rate, `${figure(status.real_time_factor)} ×`);
        say(this.parts.agents, figure(status.agents));
        say(this.parts.bodies, figure(status.bodies));
    }
}

/** Tools and what is shown. `page`: {tool(name), colour(by), field(of), top(), home(), follow(), picture(), names(), help(), about()} */
export class ToolBar {
    constructor(page, bar) {
        this.page = page;
        this.bar = bar;
        this.tools = {};
        this.choice = byId("tools");
        this.colour = this.select(COLOURS, "state", (by) => page.colour(by));
        this.field = this.select(FIELDS, "none", (of) => page.field(of));
        this.top = iconButton("top", "From above", "Look straight down (T)", () => page.top(), true);
        this.follow = iconButton("follow", "Follow", "Follow the chosen person (F)", () => page.follow(), true);
        this.names = iconButton("names", "Names", "Names: all, none, or as many as have room (N)", () => page.names(), true);
        this.names.setAttribute("aria-pressed", "mixed");
        const home = iconButton("home", "Whole scene", "The whole scene (H)", () => page.home());
        const picture = iconButton("picture", "Picture", "Save what is seen as a PNG (P)", () => page.picture());
        this.about = iconButton("about", "About", "What this scene shows, and what to try (A)", () => page.about(), true);
        bar.add(byId("show"), this.about);
        const help = iconButton("help", "Keys", "Keys, and how long drawing takes (?)", () => page.help());
        const colour = iconLabel("colour", "Colour by", this.colour), field = iconLabel("floor", "Floor", this.field);
        for (const [rank, node] of Object.entries({ colour, field, top: this.top, follow: this.follow, home, names: this.names, picture, help })) bar.add(byId("show"), node, RANK[rank]);
    }

    select(choices, chosen, change) {
        const node = el("select", {}, Object.entries(choices).map(([value, c]) => el("option", { value, selected: value === chosen }, c.name)));
        node.addEventListener("change", () => change(node.value));
        return node;
    }

    set(scene) {
        const offered = ["select", ...["throw", "drag", "push"].filter((name) => scene.tools?.[name])];
        if (offered.join() !== Object.keys(this.tools).join()) {
            this.tools = Object.fromEntries(offered.map((name) => [name,
                iconButton(name, TOOLS[name].name, `${TOOLS[name].hint} (${TOOLS[name].key})`, () => this.page.tool(name), true)]));
            fill(this.choice, Object.values(this.tools));
            this.choice.hidden = offered.length === 1;
            this.bar.fold();
        }
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
        if (own && /^( |Enter|Arrow\w+|Page\w+)$/.test(event.key)) return undefined;
        if (player.key(event, true)) return event.preventDefault();
        if (keys[name]?.(event) !== undefined) event.preventDefault();
        return undefined;
    });
    window.addEventListener("keyup", (event) => player.key(event, false));
}
